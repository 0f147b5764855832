//! What the page says of a log.

use crate::app::charts::notation::number;
use crate::app::memo::recorded::Recorded;
use crate::app::panels::notice::{Notice, Row};
use crate::app::words::story::Figure;
use centrode_core::detect::Method;
use centrode_core::detect::outlook::Outlook;
use centrode_core::record::log::chain::ChainColumn;
use centrode_core::record::log::{Column, Commands, Format, Rate, Report};
use centrode_core::run::Run;
use centrode_core::scenario::text;
use centrode_core::study::about::ChainAbout;
use centrode_core::study::course::{has_plot, measure};

/// What only a simulation knows.
const NO_TRUTH: &str = "A log does not say when contact began, where it was, or which shape the robot truly had. Delays, errors of \
    the estimate and shaded contact are therefore missing, and the robot is drawn as commanded, as if nothing touched it.";

/// Whether a detector can judge a log, and what it lacks.
fn outlook(recorded: &Recorded, method: Method) -> Option<&Outlook> {
    recorded.about.detectors.iter().find(|outlook| outlook.detector == method)
}

/// What a detector made of a log.
fn detector(run: &Run, recorded: &Recorded, method: Method) -> String {
    let (name, within) = match method {
        Method::Fcd => ("The centrode", "the centrode"),
        Method::Jfd => ("Joint forces", "joint forces"),
        Method::FcdConsistent => ("The consistent centrode", "the consistent centrode"),
        Method::FcdVelocity => ("The velocity", "the velocity"),
        Method::Cusum => ("CUSUM", "CUSUM"),
        Method::Glr => ("GLR", "GLR"),
    };
    if let Some(outlook) = outlook(recorded, method).filter(|outlook| !outlook.works) {
        return format!("{name} raised no alarm: {}.", outlook.why);
    }
    let thresholds = &run.plan.scenario().detection;
    if !thresholds.detectors.has(method) {
        return format!("{} is not switched on, so {within} raised no alarm.", method.key().to_uppercase());
    }
    let (off, key) = (thresholds.of(method).value().is_none(), measure(method).threshold.replace('_', ""));
    let events = || run.events().iter().filter(|event| event.detector == method);
    match (off, events().next()) {
        (true, _) => format!("{key} is off, so {within} raised no alarm."),
        (false, None) if !thresholds.waits(method) => format!("{name} raised no alarm."),
        (false, None) => {
            format!("{name} raised no alarm from {} s on.", number(thresholds.armed_from, 2))
        }
        (false, Some(first)) => {
            let place = match &first.detection {
                Some(found) if found.location.is_finite() => {
                    format!("; the estimated place of contact is {} mm", number(found.location * 1e3, 1))
                }
                _ => String::new(),
            };
            let more = match events().count() {
                1 => String::new(),
                count => format!(", the first of {count}"),
            };
            format!("{name} raised an alarm at {} s{more}{place}.", number(first.raised, 3))
        }
    }
}

/// A log in a sentence: what the centrode made of it, or where it cannot judge, the next detector.
#[must_use]
pub fn sentence(run: &Run, recorded: &Recorded) -> String {
    let detectors = run.plan.scenario().detection.detectors;
    let works = |&method: &Method| outlook(recorded, method).is_none_or(|outlook| outlook.works);
    // Of those that judge, the first that works.
    let told = detectors.iter().find(works).or_else(|| detectors.iter().next());
    detector(run, recorded, told.unwrap_or(Method::Fcd))
}

/// A log in words: the detectors that judge, and what is not known.
#[must_use]
pub fn words(run: &Run, recorded: &Recorded) -> String {
    let detectors = run.plan.scenario().detection.detectors;
    let shown = detectors.iter().filter(|&method| has_plot(run, method));
    let all: Vec<String> = shown.map(|method| detector(run, recorded, method)).collect();
    format!("{} A log does not say whether anything touched the robot.", all.join(" "))
}

/// A log in figures.
#[must_use]
pub fn figures(run: &Run) -> Vec<Figure> {
    let figure = |name, value: f64, decimals, unit| Figure { name, value: number(value, decimals), unit };
    let found = run.detection();
    let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
    let count = |method| run.events().iter().filter(|event| event.detector == method).count() as f64;
    vec![
        figure("Detected", known(found.map(|found| found.time)), 3, "s"),
        figure("θL at detection", known(found.map(|found| found.theta_l.to_degrees())), 1, "°"),
        figure("Estimate", known(found.map(|found| found.location * 1e3)), 1, "mm"),
        figure("Centrode alarms", count(Method::Fcd), 0, ""),
        figure("Joint force alarm", known(run.judged.first(Method::Jfd).map(|event| event.raised)), 3, "s"),
        figure("Joint force alarms", count(Method::Jfd), 0, ""),
        figure("Log ends", run.sample(run.len() - 1).time, 3, "s"),
    ]
}

/// A log in a line: how it is written, how long it is, how fast the loop ran.
#[must_use]
pub fn facts(recorded: &Recorded) -> String {
    facts_of(recorded.log.format, recorded.about.report.rows, recorded.about.loop_rate)
}

/// The same by its parts; `loop_rate` in Hz.
#[must_use]
pub fn facts_of(format: Format, rows: u64, loop_rate: f64) -> String {
    format!("{} · {rows} rows · loop at {} Hz", format.name(), text::number(loop_rate))
}

/// What a log lacks for the paper's detectors; empty for nothing.
#[must_use]
pub fn missing(recorded: &Recorded) -> String {
    let paper = recorded.about.detectors.iter().filter(|outlook| outlook.detector.is_of_paper());
    let whys: Vec<&str> = paper.map(|outlook| outlook.why.as_str()).filter(|why| !why.is_empty()).collect();
    whys.join(" · ")
}

/// How a log was read, with everything that was dropped, held or left undefined.
#[must_use]
pub fn report(name: &str, recorded: &Recorded) -> Notice {
    let about = &recorded.about;
    let used: Vec<String> = recorded.log.columns.iter().filter_map(Column::told).collect();
    let mut rows = vec![row("Columns", used.join(", "))];
    rows.extend(unused(recorded.log.columns.iter()));
    rows.push(rate(about.loop_rate, about.loop_rate_from));
    rows.push(row("Commands", about.commands.told().into()));
    for Outlook { detector, works, why } in &about.detectors {
        let how = if *works { "works" } else { "cannot work" };
        let why = if why.is_empty() { format!("It {how}.") } else { format!("It {how}: {why}.") };
        rows.push(row(measure(*detector).detector, why));
    }
    rows.push(done(&about.report));
    rows.push(row("Not known", NO_TRUTH.into()));
    noticed(name, facts(recorded), rows)
}

/// How a log of several trackers was read, likewise.
#[must_use]
pub fn chain_report(name: &str, about: &ChainAbout) -> Notice {
    let of = |segment: Option<usize>| {
        let own = about.columns.iter().filter(|own| own.segment == segment);
        own.filter_map(|own: &ChainColumn| own.column.told()).collect::<Vec<_>>().join(", ")
    };
    let mut rows: Vec<Row> = std::iter::once(("All segments".to_owned(), of(None)))
        .chain((1..=about.commands.len()).map(|segment| (format!("Segment {segment}"), of(Some(segment)))))
        .filter(|(_, told)| !told.is_empty())
        .map(|(of, told)| row(&of, told))
        .collect();
    rows.extend(unused(about.columns.iter().map(|own| &own.column)));
    rows.push(rate(about.loop_rate, about.loop_rate_from));
    let commands = if about.commands.contains(&Commands::Log) { Commands::Log } else { Commands::Motion };
    rows.push(row("Commands", commands.told().into()));
    rows.push(done(&about.report));
    rows.push(row("Not known", NO_TRUTH.into()));
    noticed(name, facts_of(about.format, about.rows, about.loop_rate), rows)
}

fn row(written: &str, why: String) -> Row {
    Row { written: written.into(), why, used: String::new() }
}

fn unused<'a>(columns: impl Iterator<Item = &'a Column>) -> Option<Row> {
    let unused: Vec<&str> =
        columns.filter(|column| column.role.is_none()).map(|column| column.header.as_str()).collect();
    (!unused.is_empty()).then(|| row("Not used", unused.join(", ")))
}

fn rate(loop_rate: f64, from: Rate) -> Row {
    row("Loop", format!("{} Hz: {}", text::number(loop_rate), from.told()))
}

fn done(report: &Report) -> Row {
    let sentences: Vec<String> = report.sentences().collect();
    let done =
        if sentences.is_empty() { "Nothing was dropped, held or left undefined.".into() } else { sentences.join("\n") };
    row("What was done with the rows", done)
}

fn noticed(name: &str, facts: String, rows: Vec<Row>) -> Notice {
    let title = format!("How {name} was read");
    let text = format!("{facts}. Nothing was interpolated.");
    let listed: String = rows.iter().map(|Row { written, why, .. }| format!("{written}: {why}\n")).collect();
    Notice { details: format!("{title}\n{text}\n{listed}"), title, text, rows }
}

/// What is said of a log that was not read.
#[must_use]
pub fn not_read(name: &str, why: &str) -> Notice {
    let title = format!("{name} was not read");
    let text = format!("{why}.");
    Notice { details: format!("{title}\n{text}"), title, text, rows: Vec::new() }
}

/// What is said of a log that is larger than the page takes.
#[must_use]
pub fn too_large(size: u64, most: u64) -> String {
    format!(
        "It has {} MiB, and the page reads logs of at most {} MiB: cut it into parts, or use `centrode analyze`, which reads up to 1 GiB",
        size.div_ceil(1 << 20),
        most >> 20
    )
}

/// Whether a control, by its key, makes simulations alone and does nothing to the log that is shown.
#[must_use]
pub fn idle(key: &str, recorded: &Recorded) -> bool {
    let motion = recorded.about.commands == Commands::Motion;
    match key {
        "motion.delta" => false,
        _ if key.starts_with("motion.") => !motion,
        "load_cells.epsilon_tau" | "tracker.mounting" => false,
        "seed" => true,
        _ => ["contact.", "load.", "load_cells.", "tracker."].iter().any(|group| key.starts_with(group)),
    }
}
