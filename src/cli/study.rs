//! `centrode study`: what every threshold would cost, and which to take.

mod compare;
mod merge;
mod outputs;
mod report;
mod share;
mod table;
mod text;
mod work;

use super::ScenarioArgs;
use super::estimating::Estimating;
use super::output::Failure;
use centrode_core::detect::Method;
use centrode_core::scenario::{Scenario, Xi1Rule};
use centrode_core::study::tuning::levels::Levels;
use centrode_core::study::tuning::recommend::Wish;
use centrode_core::study::tuning::sweep::{Sweep, SweepError, combinations};
use centrode_core::study::tuning::watch::Rule;
use centrode_core::study::tuning::{Spec, Study};
use clap::{Args, Subcommand, ValueEnum};
use merge::MergeArgs;
use outputs::Outputs;
use share::ShareArgs;
use std::io::Write;

/// Flags of `centrode study`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
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
    #[command(flatten)]
    outputs: Outputs,
    #[command(flatten)]
    share: ShareArgs,
    #[command(subcommand)]
    merge: Option<StudyCommand>,
}

#[derive(Debug, Subcommand)]
enum StudyCommand {
    /// Put the shares of a study together that --shard made: prints and writes what the whole study would, to the bit.
    Merge(MergeArgs),
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

impl StudyArgs {
    /// Repeats, counts and reports.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        if let Some(StudyCommand::Merge(merge)) = &self.merge {
            return merge.execute(out);
        }
        let scenario = self.scenario.scenario_or("bench")?;
        let page = self.scenario.page()?;
        let linked = page.as_ref().and_then(|page| Rule::ALL.iter().copied().find(|rule| rule.name() == page.rule));
        let wish = Wish {
            rule: self.rule.map(Rule::from).or(linked).unwrap_or(Rule::Fcd),
            false_alarm_rate: self.false_alarms.or(page.as_ref().map(|page| page.false_alarms)).unwrap_or(0.05),
        };
        possible(&wish)?;
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
        if let Some((share, file)) = self.share.open(&self.outputs)? {
            return share::thresholds(share, file, study, wish);
        }
        let files = self.outputs.open()?;
        let (study, partial) = work::work(study);
        report::write(&study, wish, partial, files, out)
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

/// Whether the share of false alarms can be held to.
fn possible(wish: &Wish) -> Result<(), Failure> {
    if wish.false_alarm_rate > 0.0 && wish.false_alarm_rate < 1.0 {
        return Ok(());
    }
    let line = format!("--false-alarms {}: a share above 0 and below 1 is expected", wish.false_alarm_rate);
    Err(Failure::Input(line))
}

/// Whether the cells differ in nothing but what can be tuned: filter and detection.
fn is_tuned(study: &Study) -> bool {
    let mut sets = study.cells().iter().flat_map(|cell| &cell.set);
    sets.all(|set| set.path().starts_with("filter.") || set.path().starts_with("detection."))
}
