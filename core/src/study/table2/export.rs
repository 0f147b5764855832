//! Table II as numbers and as LaTeX.

use super::{Disk, Spread, Table2};
use crate::chart::csv::{cell, line};
use crate::scenario::ContactKind;
use std::fmt::Write;

const DEGREES: f64 = 180.0 / std::f64::consts::PI;

/// A quantity of a disk with its scatter.
#[derive(Debug, Clone, Copy)]
pub struct Quantity {
    /// Name and unit in CSV.
    pub key: &'static str,
    /// SI unit.
    pub si_unit: &'static str,
    /// Name in a table, with the unit shown.
    pub label: &'static str,
    /// Head of its column in LaTeX, with the unit shown.
    pub head: &'static str,
    /// Values are multiplied by this to be shown.
    pub scale: f64,
    /// Digits shown.
    pub digits: usize,
    /// Its values.
    pub of: fn(&Disk) -> Spread,
}

/// What is told of each disk.
pub const QUANTITIES: [Quantity; 4] = [
    Quantity {
        key: "detection_time",
        si_unit: "s",
        label: "detected at [s]",
        head: "Detected (s)",
        scale: 1.0,
        digits: 3,
        of: |disk| disk.detection_time,
    },
    Quantity {
        key: "delay",
        si_unit: "s",
        label: "after contact [s]",
        head: "Delay (s)",
        scale: 1.0,
        digits: 3,
        of: |disk| disk.delay,
    },
    Quantity {
        key: "theta_l",
        si_unit: "rad",
        label: "θL then [°]",
        head: "$\\theta_L$ ($^\\circ$)",
        scale: DEGREES,
        digits: 2,
        of: |disk| disk.theta_l,
    },
    Quantity {
        key: "location",
        si_unit: "m",
        label: "located at [mm]",
        head: "Estimate (mm)",
        scale: 1e3,
        digits: 2,
        of: |disk| disk.location,
    },
];

/// All tables as CSV, a disk to a row, units in the header. In the rows of `ours` the calibration filter detects and locates, and
/// `covered` is how often its 95 % interval holds the true place.
#[must_use]
pub fn csv(table: &Table2) -> String {
    let fixed = [
        "table",
        "disk",
        "arc_length [m]",
        "contact_time [s]",
        "repeats",
        "found",
        "false_alarms",
        "location_bias [m]",
    ];
    let titles = QUANTITIES.iter().flat_map(|quantity| {
        ["mean", "deviation"].map(|kind| format!("{}_{kind} [{}]", quantity.key, quantity.si_unit))
    });
    let mut text = line(fixed.into_iter().map(String::from).chain(titles).chain(["covered".into()]));
    let plain = |disks: &[Disk; 3]| disks.map(|disk| (disk, f64::NAN));
    let mut tables = vec![
        ("paper", plain(&table.paper)),
        ("simulated", plain(&table.simulated)),
        (table.other_kind.name(), plain(&table.other)),
    ];
    tables.extend(table.ours.map(|ours| ("ours", ours.map(|ours| (ours.disk, ours.covered)))));
    for (name, disks) in &tables {
        for (disk, covered) in disks {
            let fixed = [
                (*name).into(),
                disk.disk.to_string(),
                cell(disk.arc_length),
                cell(disk.contact_time),
                disk.repeats.to_string(),
                disk.found.to_string(),
                disk.false_alarms.map_or(String::new(), |count| count.to_string()),
                cell(disk.bias),
            ];
            let values = QUANTITIES.iter().map(|quantity| (quantity.of)(disk));
            let values = values.flat_map(|spread| [cell(spread.mean), cell(spread.deviation)]);
            text.push_str(&line(fixed.into_iter().chain(values).chain([cell(*covered)])));
        }
    }
    text
}

/// All tables as a plain `tabular` that needs no package, units in the head; where `cusum` judges, with the rows in which the calibration
/// filter detects and locates, and a column for how often its 95 % interval holds the true place. `made` says what made it, in comments above.
///
/// ```
/// use centrode_core::scenario::Scenario;
/// use centrode_core::study::table2::Table2Job;
/// use centrode_core::study::table2::export::latex;
///
/// let job = Table2Job::new(&Scenario::default(), 2)?;
/// let text = latex(&job.table(), "Centrode #preset=bench");
/// assert!(text.starts_with("% Centrode #preset=bench\n") && text.contains("\\begin{tabular}"));
/// # Ok::<(), centrode_core::scenario::ScenarioError>(())
/// ```
#[must_use]
pub fn latex(table: &Table2, made: &str) -> String {
    let mut text = String::new();
    // A line break would end the comment, and so does a carriage return for some.
    for remark in made
        .split(['\n', '\r'])
        .chain(["Mean and standard deviation where contact was found; -- is not known, or not defined."])
    {
        text.push_str(&format!("% {remark}\n"));
    }
    let fixed = ["", "Disk", "$s_c$ (mm)", "Contact (s)", "Found", "False alarms"];
    let heads: Vec<&str> = fixed.into_iter().chain(QUANTITIES.iter().map(|quantity| quantity.head)).collect();
    let last = if table.ours.is_some() { &["Bias (mm)", "95 \\% hold"][..] } else { &["Bias (mm)"] };
    // Writing to a string does not fail.
    let _ = writeln!(text, "\\begin{{tabular}}{{l{}}}\n\\hline", "r".repeat(heads.len() + last.len() - 1));
    let _ = writeln!(text, "{} & {} \\\\\n\\hline", heads.join(" & "), last.join(" & "));
    let simulated = |kind: ContactKind| format!("Simulated by Centrode, {}", kind.name());
    let plain = |disks: &[Disk; 3]| disks.map(|disk| (disk, f64::NAN));
    let mut sets = vec![
        ("Paper".into(), plain(&table.paper)),
        (simulated(table.kind), plain(&table.simulated)),
        (simulated(table.other_kind), plain(&table.other)),
    ];
    let by_cusum = format!("{}, by CUSUM", simulated(table.kind));
    sets.extend(table.ours.map(|ours| (by_cusum, ours.map(|ours| (ours.disk, ours.covered)))));
    for (name, disks) in &sets {
        for (k, (disk, covered)) in disks.iter().enumerate() {
            let fixed = [
                escaped(if k == 0 { name } else { "" }),
                disk.disk.to_string(),
                math(disk.arc_length * 1e3, 2),
                math(disk.contact_time, 3),
                format!("{} of {}", disk.found, disk.repeats),
                disk.false_alarms.map_or("--".into(), |count| count.to_string()),
            ];
            let values = QUANTITIES.iter().map(|quantity| spread(quantity, disk));
            let last = [math(disk.bias * 1e3, 2), share(*covered)].into_iter().take(last.len());
            let cells: Vec<String> = fixed.into_iter().chain(values).chain(last).collect();
            let _ = writeln!(text, "{} \\\\", cells.join(" & "));
        }
        text.push_str("\\hline\n");
    }
    text.push_str("\\end{tabular}\n");
    text
}

/// A number in LaTeX, which sets its minus; a dash where it is not defined.
fn math(value: f64, digits: usize) -> String {
    if value.is_finite() { format!("${value:.digits$}$") } else { "--".into() }
}

/// A share in LaTeX, which sets its percent.
fn share(value: f64) -> String {
    if value.is_finite() { format!("${:.0}\\,\\%$", value * 100.0) } else { "--".into() }
}

fn spread(quantity: &Quantity, disk: &Disk) -> String {
    let Spread { mean, deviation } = (quantity.of)(disk);
    let digits = quantity.digits;
    if mean.is_finite() && deviation.is_finite() {
        format!("${:.digits$} \\pm {:.digits$}$", mean * quantity.scale, deviation * quantity.scale)
    } else {
        math(mean * quantity.scale, digits)
    }
}

/// A text as LaTeX has it, whatever its characters.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                escaped.push('\\');
                escaped.push(character);
            }
            '~' => escaped.push_str("\\textasciitilde{}"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '\\' => escaped.push_str("\\textbackslash{}"),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;
    use crate::study::Job;
    use crate::study::table2::Table2Job;

    fn table(repeats: usize) -> Table2 {
        let mut scenario = Scenario::default();
        scenario.detection.detectors.set(crate::detect::Method::Cusum, true);
        let mut job = Table2Job::new(&scenario, repeats).expect("possible");
        job.finish();
        job.table()
    }

    #[test]
    fn every_row_has_as_many_cells_as_the_head_and_units_stand_there() {
        let text = latex(&table(2), "one\ntwo");
        assert!(text.starts_with("% one\n% two\n% Mean"), "{text}");
        let rows: Vec<&str> = text.lines().filter(|line| line.ends_with("\\\\")).collect();
        assert_eq!(rows.len(), 1 + 12);
        assert!(text.contains("clamp, by CUSUM") && rows[0].ends_with("& 95 \\% hold \\\\"), "{text}");
        // Without the filter there is neither.
        let plain = latex(&Table2 { ours: None, ..table(2) }, "one");
        assert!(
            !plain.contains("CUSUM") && !plain.contains("hold") && plain.matches("\\\\\n").count() == 1 + 9,
            "{plain}"
        );
        assert!(rows.iter().all(|row| row.matches('&').count() == rows[0].matches('&').count()), "{text}");
        let columns = text.lines().find_map(|line| line.strip_prefix("\\begin{tabular}{")).expect("a tabular");
        assert_eq!(columns.trim_end_matches('}').len(), rows[0].matches('&').count() + 1);
        for unit in ["(mm)", "(s)", "($^\\circ$)"] {
            assert!(rows[0].contains(unit), "{}", rows[0]);
        }
        // Outside of comments nothing needs another font or package.
        assert!(text.lines().filter(|line| !line.starts_with('%')).all(str::is_ascii) && !text.contains("rule"));
        assert!(text.contains("\\pm") && !text.contains("NaN"), "{text}");
    }

    #[test]
    fn what_latex_takes_for_a_command_is_escaped() {
        assert_eq!(escaped("a_b & 5 % #1 {x} $"), "a\\_b \\& 5 \\% \\#1 \\{x\\} \\$");
        assert_eq!(escaped("~^\\"), "\\textasciitilde{}\\textasciicircum{}\\textbackslash{}");
        assert_eq!(math(-0.25, 1), "$-0.2$");
        assert_eq!(math(f64::NAN, 1), "--");
    }

    #[test]
    fn csv_has_a_row_for_each_disk() {
        let text = csv(&table(2));
        assert_eq!(text.lines().count(), 1 + 12);
        let width = |line: &str| line.split(',').count();
        assert!(text.lines().all(|line| width(line) == 9 + 2 * QUANTITIES.len()), "{text}");
        assert!(
            text.starts_with("table,disk,arc_length [m],")
                && text.contains("\nsimulated,3,")
                && text.contains("\nplane,3,")
        );
    }
}
