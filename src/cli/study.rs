//! `centrode study`: what every threshold would cost, and which to take.

mod compare;
mod table;
mod text;
mod work;

use super::ScenarioArgs;
use super::draw::{self, Format};
use super::estimating::Estimating;
use super::output::{Failure, NewFile, json};
use centrode_core::detect::Method;
use centrode_core::scenario::link::Page;
use centrode_core::scenario::{Override, Scenario, Xi1Rule};
use centrode_core::study::Job;
use centrode_core::study::export::signed;
use centrode_core::study::tuning::chart::chart;
use centrode_core::study::tuning::levels::Levels;
use centrode_core::study::tuning::recommend::{Verdict, Wish, recommend_among};
use centrode_core::study::tuning::sweep::{Sweep, SweepError, combinations};
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::tuning::{Point, Spec, Study};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;

/// Flags of `centrode study`.
#[derive(Debug, Args)]
pub struct StudyArgs {
    /// Without a file, preset or link, `bench`: the default scenario has no noise. Repeats, method and false alarms are those of a link
    /// where they are not given.
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Repeats of each combination, with contact and without; 200 by itself.
    #[arg(long, value_name = "N")]
    repeats: Option<usize>,
    /// An alarm later than this after contact counts as missed, in s; 1 by itself.
    #[arg(long, value_name = "SECONDS")]
    late: Option<f64>,
    /// Compare values of a key, as in filter.length=100:1000:10 (ten values) or contact.disk=1,2,3; may be repeated. Values
    /// of detection.xi2 or detection.xi1 take the place of the usual thresholds.
    #[arg(long = "sweep", value_name = "KEY=VALUES")]
    sweeps: Vec<String>,
    /// How alarms are raised, for the recommendation: by the centrode (fcd, by itself), by joint forces, by either, by both at once.
    #[arg(long = "method", value_name = "METHOD", value_enum)]
    rule: Option<RuleArg>,
    /// The share of runs without contact that may alarm, above 0 and below 1; 0.05 by itself.
    #[arg(long, value_name = "RATE")]
    false_alarms: Option<f64>,
    /// Compare these detectors, at their own thresholds, at equal false alarms and over all thresholds, and place the contacts that
    /// one of them finds. Says which threshold of which detector to take.
    #[arg(long, value_name = "KEY,…", value_delimiter = ',')]
    detectors: Vec<String>,
    /// With --detectors: the share of runs without contact that may alarm, above 0 and below 1; 0.01 by itself.
    #[arg(long, value_name = "RATE", requires = "detectors")]
    rate: Option<f64>,
    #[command(flatten)]
    estimating: Estimating,
    /// Print JSON instead of a summary, in SI units: every cell with its curves.
    #[arg(long)]
    json: bool,
    /// Write every threshold of every cell, or detector, to a CSV file, units in the header.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw operating curves and delays to a file, .svg or .png; with --detectors, their delays and the errors of places.
    #[arg(long, value_name = "FILE.{svg,png}")]
    svg: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum RuleArg {
    Fcd,
    Jfd,
    Or,
    And,
}

impl From<RuleArg> for Rule {
    fn from(rule: RuleArg) -> Self {
        match rule {
            RuleArg::Fcd => Self::Fcd,
            RuleArg::Jfd => Self::Jfd,
            RuleArg::Or => Self::Or,
            RuleArg::And => Self::And,
        }
    }
}

/// What a study comes to. SI units; null where a value is not defined.
#[derive(Debug, Serialize)]
struct Report<'a> {
    scenario: &'a Scenario,
    repeats: usize,
    /// s
    late: f64,
    /// Whether it was interrupted: cells say how many runs they hold.
    partial: bool,
    wish: Wish,
    cells: Vec<CellReport<'a>>,
    /// Among all cells; null where they differ in more than can be tuned.
    recommendation: Option<Recommendation<'a>>,
}

#[derive(Debug, Serialize)]
struct CellReport<'a> {
    /// What it changes in the scenario.
    set: &'a [Override],
    runs_free: u64,
    /// Null without a contact.
    runs_contact: Option<u64>,
    /// Truth, s; null when contact never begins.
    contact_time: Option<f64>,
    /// At the scenario's own thresholds; null where one is off.
    own: ByRule<Option<Point>>,
    /// At all thresholds, without the inner points of stretches in which nothing else changes.
    curves: ByRule<Vec<Point>>,
    /// Which threshold to take in this cell.
    advised: Verdict,
}

#[derive(Debug, Serialize)]
struct ByRule<T> {
    fcd: T,
    jfd: T,
    or: T,
    and: T,
}

impl<T> ByRule<T> {
    fn of(of: impl Fn(Rule) -> T) -> Self {
        Self { fcd: of(Rule::Fcd), jfd: of(Rule::Jfd), or: of(Rule::Or), and: of(Rule::And) }
    }
}

#[derive(Debug, Serialize)]
struct Recommendation<'a> {
    #[serde(flatten)]
    verdict: &'a Verdict,
    /// What the cell to take changes in the scenario, and its filter length.
    set: Option<&'a [Override]>,
    filter_length: Option<u64>,
}

impl StudyArgs {
    /// Repeats, counts and reports.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        let scenario = self.scenario.scenario_or("bench")?;
        let page = self.scenario.page()?;
        let linked = page.as_ref().and_then(|page| Rule::ALL.iter().copied().find(|rule| rule.name() == page.rule));
        let wish = Wish {
            rule: self.rule.map(Rule::from).or(linked).unwrap_or(Rule::Fcd),
            false_alarm_rate: self.false_alarms.or(page.as_ref().map(|page| page.false_alarms)).unwrap_or(0.05),
        };
        if !(wish.false_alarm_rate > 0.0 && wish.false_alarm_rate < 1.0) {
            let line = format!("--false-alarms {}: a share above 0 and below 1 is expected", wish.false_alarm_rate);
            return Err(Failure::Input(line));
        }
        let linked = page.and_then(|page| usize::try_from(page.repeats).ok());
        let repeats = self.repeats.or(linked).unwrap_or(200);
        if !self.detectors.is_empty() {
            return compare::execute(self, &scenario, repeats, out);
        }
        if self.estimating.is_given() {
            let line = "--detector and --after place contacts, which a study of thresholds does not: name --detectors to compare";
            return Err(Failure::Input(line.into()));
        }
        let study = Study::new(self.spec(&scenario, repeats)?).map_err(|error| Failure::Input(error.to_string()))?;
        let format = self.svg.as_deref().map(|path| Format::of("--svg", path)).transpose()?;
        // A file that cannot be written is said before the work, not after it.
        let [table, mut drawing] = [&self.csv, &self.svg].map(|path| path.as_deref().map(NewFile::create));
        let (table, drawing) = (table.transpose()?, drawing.take().transpose()?);

        let (study, partial) = work::work(study);
        // Cells that differ in what is to be found are no alternatives: each has its own advice.
        let cells = if is_tuned(&study) { 0..study.cells().len() } else { 0..1 };
        let verdict = recommend_among(&study, cells, &wish);
        if let Some(file) = table {
            table::csv(file, &study, partial)?;
        }
        if let (Some(mut file), Some(format)) = (drawing, format) {
            let page = Page {
                rule: wish.rule.name(),
                false_alarms: wish.false_alarm_rate,
                repeats: repeats as u64,
                ..Page::of("tuning")
            };
            let chart = signed(chart(&study, &wish, &verdict, partial), &scenario, page);
            draw::write(&mut file, &chart, format)?;
            file.finish()?;
        }
        if self.json {
            json(out, &report(&study, wish, &verdict, partial))?;
        } else {
            text::text(out, &study, &wish, &verdict, partial)?;
        }
        out.flush()?;
        if partial {
            let progress = study.progress();
            let line =
                format!("interrupted after {} of {} runs; the results written are partial", progress.done, progress.of);
            return Err(Failure::Interrupted(line));
        }
        Ok(())
    }

    fn spec(&self, scenario: &Scenario, repeats: usize) -> Result<Spec, Failure> {
        let mut levels = Levels::default();
        let (mut others, mut seen) = (Vec::new(), Vec::new());
        let rule = scenario.detection.xi1_rule;
        for text in &self.sweeps {
            let refused = |error: SweepError| Failure::Input(format!("--sweep {text}: {error}"));
            let sweep: Sweep = text.parse().map_err(refused)?;
            let detector = match (sweep.key.as_str(), rule) {
                ("detection.xi2", _) => Method::Fcd,
                ("detection.xi1", Xi1Rule::Constant) | ("detection.xi1_factor", Xi1Rule::Bound) => Method::Jfd,
                ("detection.xi1" | "detection.xi1_factor", _) => {
                    let other = if rule == Xi1Rule::Constant { "detection.xi1" } else { "detection.xi1_factor" };
                    let line = format!("--sweep {text}: this detection.xi1_rule does not use it; sweep {other}");
                    return Err(Failure::Input(line));
                }
                _ => {
                    others.push(sweep);
                    continue;
                }
            };
            if seen.contains(&detector) {
                return Err(refused(SweepError::Twice(sweep.key)));
            }
            seen.push(detector);
            levels.put(detector, sweep.levels().map_err(refused)?);
        }
        let cells = combinations(&others).map_err(|error| Failure::Input(format!("--sweep: {error}")))?;
        let usual = Spec::of(scenario.clone(), repeats);
        Ok(Spec { late: self.late.unwrap_or(usual.late), cells, levels, ..usual })
    }
}

fn report<'a>(study: &'a Study, wish: Wish, verdict: &'a Verdict, partial: bool) -> Report<'a> {
    let cells = study.cells().iter().enumerate().map(|(k, cell)| {
        let (runs_free, runs_contact) = study.repeats(k);
        let own = |rule| study.own(k, rule).map(|level| study.point(k, rule, level));
        CellReport {
            set: &cell.set,
            runs_free,
            runs_contact,
            contact_time: study.contact_time(k),
            own: ByRule::of(own),
            curves: ByRule::of(|rule| thinned(study.curve(k, rule))),
            advised: recommend_among(study, [k], &wish),
        }
    });
    let taken = match verdict {
        Verdict::Take { cell, .. } => Some(&study.cells()[*cell]),
        _ => None,
    };
    Report {
        scenario: &study.spec().scenario,
        repeats: study.spec().repeats,
        late: study.spec().late,
        partial,
        wish,
        cells: cells.collect(),
        recommendation: is_tuned(study).then(|| Recommendation {
            verdict,
            set: taken.map(|cell| &cell.set[..]),
            filter_length: taken.map(|cell| cell.scenario.filter.length),
        }),
    }
}

/// Whether the cells differ in nothing but what can be tuned: filter and detection.
fn is_tuned(study: &Study) -> bool {
    let mut sets = study.cells().iter().flat_map(|cell| &cell.set);
    sets.all(|set| set.path().starts_with("filter.") || set.path().starts_with("detection."))
}

/// Without the points between two that say the same.
fn thinned(points: Vec<Point>) -> Vec<Point> {
    let says = |k: usize| {
        let Point { false_alarms, detection, .. } = &points[k];
        let counts = detection.map(|seen| (seen.early.count, seen.detected.count, seen.late));
        let delays = detection.map(|seen| [seen.mean, seen.mean_error, seen.median, seen.ninety].map(f64::to_bits));
        (false_alarms.rate.count, false_alarms.watched.to_bits(), counts, delays)
    };
    let last = points.len().saturating_sub(1);
    let kept = (0..points.len()).filter(|&k| k == 0 || k == last || says(k) != says(k - 1) || says(k) != says(k + 1));
    kept.map(|k| points[k]).collect()
}
