//! `centrode study merge`: the whole from its shares.

use super::outputs::Outputs;
use super::{RuleArg, compare, possible, report};
use crate::cli::output::Failure;
use centrode_core::study::compare::{Compare, Spec};
use centrode_core::study::share::{Merge, MergeError, Whole};
use centrode_core::study::tuning::recommend::Wish;
use centrode_core::study::tuning::watch::Rule;
use clap::Args;
use std::fs;
use std::io::Write;
use std::path::PathBuf;

/// Flags of `centrode study merge`.
#[derive(Debug, Args)]
pub struct MergeArgs {
    /// The shares, in any order; one that is given twice counts once.
    #[arg(required = true, value_name = "PART.json")]
    parts: Vec<PathBuf>,
    /// How alarms are raised, for the recommendation, instead of what the shares were made with.
    #[arg(long = "method", value_name = "METHOD", value_enum)]
    rule: Option<RuleArg>,
    /// The share of runs without contact that may alarm, instead of what the shares were made with.
    #[arg(long, value_name = "RATE")]
    false_alarms: Option<f64>,
    /// The same where detectors are compared.
    #[arg(long, value_name = "RATE")]
    rate: Option<f64>,
    #[command(flatten)]
    outputs: Outputs,
}

impl MergeArgs {
    /// Puts the shares together and reports.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        let refused = |error: MergeError| Failure::Input(error.to_string());
        let mut merge = Merge::default();
        for path in &self.parts {
            let name = path.display().to_string();
            let bytes = fs::read(path).map_err(|error| Failure::Input(format!("cannot read {name}: {error}")))?;
            merge.add(&name, &bytes).map_err(refused)?;
        }
        match merge.finish().map_err(refused)? {
            Whole::Thresholds(study, asked) => {
                let wish = self.wish(asked)?;
                report::write(&study, wish, false, self.outputs.open()?, out)
            }
            Whole::Detectors(compare, judging) => {
                let compare = self.at_rate(*compare)?;
                compare::write(&compare, judging, self.outputs.open()?, out)
            }
        }
    }

    /// What the advice is to hold to.
    fn wish(&self, asked: Wish) -> Result<Wish, Failure> {
        if self.rate.is_some() {
            return Err(Failure::Input(
                "--rate: these are shares of a study of thresholds; --false-alarms is meant".into(),
            ));
        }
        let wish = Wish {
            rule: self.rule.map_or(asked.rule, Rule::from),
            false_alarm_rate: self.false_alarms.unwrap_or(asked.false_alarm_rate),
        };
        possible(&wish).map(|()| wish)
    }

    /// The comparison at the rate of false alarms that is wished for.
    fn at_rate(&self, compare: Compare) -> Result<Compare, Failure> {
        if self.rule.is_some() || self.false_alarms.is_some() {
            let line = "--method, --false-alarms: these are shares of a comparison of detectors, which has --rate";
            return Err(Failure::Input(line.into()));
        }
        let Some(rate) = self.rate else { return Ok(compare) };
        let spec = Spec { rate, ..compare.spec().clone() };
        let mut other = Compare::new(spec).map_err(|error| Failure::Input(error.to_string()))?;
        other.adopt(&compare);
        Ok(other)
    }
}
