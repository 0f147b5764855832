//! A chart's numbers as CSV, SI units in the header.

use super::ticks::Tick;
use super::{Axis, Chart, Panel, Role};

/// A number as it is read back; what is not defined stays empty.
#[must_use]
pub fn cell(value: f64) -> String {
    if value.is_nan() { String::new() } else { value.to_string() }
}

/// One field; what would end it early is quoted.
fn field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.into() }
}

fn row(text: &mut String, fields: &[&str]) {
    text.push_str(&line(fields));
}

/// A row of fields, with its end; what would end a field early is quoted.
#[must_use]
pub fn line(fields: impl IntoIterator<Item = impl AsRef<str>>) -> String {
    let fields: Vec<String> = fields.into_iter().map(|part| field(part.as_ref())).collect();
    fields.join(",") + "\n"
}

/// The numbers of the curves, marks, bars, intervals, lines and spans, one row each: kind, place of the series, name, x, y. A gap
/// is a row with an empty y; of what stands over the whole height y is empty. A span has a row for both ends, a bar for two
/// opposite corners, an interval for an end, its mark and the other end. A map has a row for each cell with its middle, and a sixth column
/// with the values in the unit shown. A chart of several panels is written panel by panel, each with its own header.
///
/// ```
/// use centrode_core::chart::csv::csv;
/// use centrode_core::chart::{Axis, Chart, Panel, Role, Series, Style};
///
/// let mut panel = Panel::new(Axis::new("t", "s", "s", 1.0), Axis::new("Θ", "N·m", "mN·m", 1e3));
/// panel.series.push(Series::new("measured", Role::Force, Style::Line, vec![[0.0, 0.002], [0.5, 0.003]]));
/// let text = csv(&Chart { panels: vec![panel], ..Chart::default() });
/// assert_eq!(text.lines().next(), Some("kind,series,name,t [s],Θ [N·m]"));
/// assert_eq!(text.lines().last(), Some("line,0,measured,0.5,0.003"));
/// ```
#[must_use]
pub fn csv(chart: &Chart) -> String {
    let mut text = String::new();
    chart.panels.iter().for_each(|panel| of_panel(&mut text, panel));
    text
}

/// Rows of numbers below a header.
#[must_use]
pub fn table<const N: usize>(header: [&str; N], rows: impl Iterator<Item = [f64; N]>) -> String {
    let mut text = String::new();
    row(&mut text, &header);
    for values in rows {
        text.push_str(&values.map(cell).join(","));
        text.push('\n');
    }
    text
}

fn of_panel(text: &mut String, panel: &Panel) {
    let title = |axis: &Axis| format!("{} [{}]", axis.name, axis.si_unit);
    let value = panel.map.as_ref().map(|map| format!("value [{}]", map.unit));
    // Where there is a map each row has a value, though mostly an empty one.
    let mut row = |fields: [&str; 5], value: &str| match panel.map {
        Some(_) => row(text, &[&fields[..], &[value]].concat()),
        None => row(text, &fields),
    };
    row(["kind", "series", "name", &title(&panel.x), &title(&panel.y)], value.as_deref().unwrap_or_default());
    for (k, series) in panel.series.iter().enumerate() {
        for [x, y] in &series.points {
            row([series.style.name(), &k.to_string(), &series.name, &cell(*x), &cell(*y)], "");
        }
    }
    let bars = panel.bars.iter().map(|bars| ("bar", &bars.name, bars.corners.as_flattened()));
    let intervals = panel.intervals.iter().map(|all| ("interval", &all.name, all.ends.as_flattened()));
    for (kind, name, points) in bars.chain(intervals) {
        for [x, y] in points {
            row([kind, "", name, &cell(*x), &cell(*y)], "");
        }
    }
    if let Some(map) = &panel.map {
        let middle = |[from, to]: [f64; 2], k: usize, of: usize| from + (to - from) * (k as f64 + 0.5) / of as f64;
        for (k, value) in map.values.iter().enumerate() {
            let x = place(&panel.x, middle(map.x, k % map.columns, map.columns));
            let y = place(&panel.y, middle(map.y, k / map.columns, map.rows()));
            row(["cell", "", "", &x, &y], &cell(value * map.scale));
        }
    }
    for vertical in &panel.verticals {
        let kind = match vertical.role {
            Role::Detection => "detection",
            Role::Contact => "contact",
            _ => "vertical",
        };
        row([kind, "", vertical.name, &cell(vertical.x), ""], "");
    }
    for span in &panel.spans {
        for x in span.ends {
            row(["span", "", span.name, &cell(x), ""], "");
        }
    }
}

/// A place on an axis: the name of the category where it is one.
fn place(axis: &Axis, value: f64) -> String {
    let near = |tick: &&Tick| (tick.value - value).abs() < 1e-9 && !tick.text.is_empty();
    axis.ticks.iter().find(near).map_or_else(|| cell(value), |tick| tick.text.clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::{Bars, Intervals, Map, Series, Span, Style, Vertical};

    #[test]
    fn what_is_not_defined_is_empty() {
        assert_eq!(table(["a [m]", "b"], [[0.25, f64::NAN], [-1.0, 2.0]].into_iter()), "a [m],b\n0.25,\n-1,2\n");
    }

    #[test]
    fn every_number_has_a_row_and_names_are_quoted() {
        let axis = |name| Axis::new(name, "s", "s", 1.0);
        let mut panel = Panel::new(axis("t"), axis("y"));
        panel.series = vec![Series::new("a, \"b\"", Role::Model, Style::Line, vec![[0.5, 1e-9], [1.0, f64::NAN]])];
        panel.verticals = vec![Vertical { name: "detection", x: 2.0, role: Role::Detection }];
        panel.spans = vec![Span { name: "not armed", role: Role::Aside, low: false, ends: [0.0, 1.0] }];
        panel.bars = vec![Bars { name: "found".into(), role: Role::Sensor, corners: vec![[[0.0, 1.0], [0.1, 0.5]]] }];
        let ends = vec![[[f64::NAN; 2], [3.0, 2.0], [4.0, 2.0]]];
        panel.intervals = vec![Intervals { name: "median".into(), role: Role::Sensor, ends }];
        let text = csv(&Chart { panels: vec![panel], ..Chart::default() });
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "kind,series,name,t [s],y [s]");
        assert_eq!(lines[1..3], ["line,0,\"a, \"\"b\"\"\",0.5,0.000000001", "line,0,\"a, \"\"b\"\"\",1,"]);
        assert_eq!(lines[3..5], ["bar,,found,0,1", "bar,,found,0.1,0.5"]);
        assert_eq!(lines[5..8], ["interval,,median,,", "interval,,median,3,2", "interval,,median,4,2"]);
        assert_eq!(lines[8..], ["detection,,detection,2,", "span,,not armed,0,", "span,,not armed,1,"]);
    }

    #[test]
    fn a_map_has_a_row_for_each_cell_and_categories_their_names() {
        let x = Axis::categories("N", ["50", "100"].map(String::from), false);
        let mut panel = Panel::new(x, Axis::new("y", "m", "mm", 1e3));
        panel.series = vec![Series::new("", Role::Choice, Style::Rings, vec![[1.0, 0.5]])];
        panel.map = Some(Map {
            unit: "ms",
            scale: 1e3,
            columns: 2,
            values: vec![0.25, f64::NAN],
            faint: Vec::new(),
            x: [-0.5, 1.5],
            y: [0.0, 1.0],
            ends: [0.0, 1.0],
            level: None,
            line: Vec::new(),
        });
        let text = csv(&Chart { panels: vec![panel], ..Chart::default() });
        assert_eq!(
            text.lines().collect::<Vec<_>>(),
            ["kind,series,name,N [1],y [m],value [ms]", "rings,0,,1,0.5,", "cell,,,50,0.5,250", "cell,,,100,0.5,"]
        );
    }
}
