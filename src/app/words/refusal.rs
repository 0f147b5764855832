//! Refusals in the page's own terms: a control's label for its key, and the unit it shows for SI.

use crate::app::chain;
use crate::app::controls::control::Control;
use crate::app::controls::quantity::number;
use crate::app::controls::table;
use centrode_core::scenario::chain::Fault;
use centrode_core::scenario::keys::{Quantity, Units, Value};
use centrode_core::scenario::{ChainError, Refused, ScenarioError};

/// The control of what is refused; none when no control sets it.
#[must_use]
pub fn control(refusal: &ScenarioError) -> Option<&'static Control> {
    match refusal {
        ScenarioError::Value(refused) => table::control_of(&refused.key),
        _ => None,
    }
}

/// Why a scenario is refused. A key that no control sets keeps its own name.
#[must_use]
pub fn told(refusal: &ScenarioError) -> String {
    match (refusal, control(refusal)) {
        (ScenarioError::Value(refused), Some(control)) => {
            let Refused { key, quantity, value, allowed } = &**refused;
            let said = match value {
                Value::Number(si) => with_unit(*si, *quantity, control.decimals),
                other => other.told(*quantity, Units::Shown),
            };
            format!("{} {said}: {}", label(control, key), allowed.words(*quantity, Units::Shown))
        }
        (ScenarioError::Value(refused), None) => refused.told(Units::Shown),
        _ => refusal.to_string(),
    }
}

/// Why an experiment with several segments is refused.
#[must_use]
pub fn of_chain(refusal: &ChainError) -> String {
    let Fault::Scenario(ScenarioError::Value(refused)) = &refusal.fault else { return refusal.fault.to_string() };
    let Refused { key, quantity, value, allowed } = &**refused;
    let Some(name) = called_in_chain(key) else { return refused.told(Units::Shown) };
    format!("{name} {}: {}", value.told(*quantity, Units::Shown), allowed.words(*quantity, Units::Shown))
}

/// The same of a file, with the line where there is one.
#[must_use]
pub fn of_chain_file(refusal: &ChainError) -> String {
    match refusal.line {
        Some(line) => format!("Line {line}: {}", of_chain(refusal)),
        None => of_chain(refusal),
    }
}

/// What the page calls a key of an experiment with several segments; none when no control sets it.
fn called_in_chain(key: &str) -> Option<String> {
    let (of, own) = match key.split_once("].") {
        Some((of, own)) => (Some(of.replace('[', " ")), own),
        None => (None, key),
    };
    let label = chain::own::all().find(|row| row.key == own).map(|row| row.label);
    let label = label.or_else(|| called(own)).or_else(|| called(&format!("robot.{own}")))?;
    Some(of.map_or_else(|| label.into(), |of| format!("{label} of {of}")))
}

/// What the page calls a key; none when no control sets it.
#[must_use]
pub fn called(key: &str) -> Option<&'static str> {
    table::control_of(key).map(|control| label(control, key))
}

/// What a control is called while it holds this key.
fn label(control: &Control, key: &str) -> &'static str {
    match key {
        "contact.arc_length" => "Contact place",
        "contact.bend" => "Contact bend",
        _ => control.label,
    }
}

fn with_unit(si: f64, quantity: Quantity, decimals: usize) -> String {
    Quantity::joined(&number(quantity.shown(si), decimals), quantity.unit())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::controls::table;
    use crate::app::memo::check;
    use centrode_core::scenario::Scenario;

    #[test]
    fn a_refusal_speaks_the_language_of_its_control() {
        for (key, typed, said) in [
            ("contact.disk", "9", "Contact disk 9: a disk from 1 to 3, the robot's spacer disks, or 0 for no contact"),
            ("contact.disk", "50 mm", "Contact place 50 mm: a number from 0 mm to robot.length = 30 mm"),
            ("contact.time", "-1", "Contact time −1.00 s: a finite number, 0 s or more"),
            ("contact.time", "400°", "Contact bend 400.00°: a finite angle, less than one turn (360°) from straight"),
            ("tracker.position_noise", "-1", "Position noise −1.000 mm: a number from 0 mm to 1000 mm"),
            ("load_cells.epsilon_tau", "100", "Load cell error ε_τ 100.0 %: from 0 % to below 100 %"),
            ("detection.xi1", "-5", "ξ1 (joint force) −5.0 mN·m: a finite number, 0 mN·m or more, or \"off\""),
            (
                "robot.primary.youngs_modulus",
                "0",
                "Young's modulus, primary 0.0 GPa: a number from 0.001 GPa to 10000 GPa",
            ),
            ("motion.finish", "2", "Motion ends 2.00 s: a time after motion.start = 3 s"),
            (
                "motion.end",
                "300",
                "Run ends 300.00 s: at most 200000 samples in a run that is kept in memory; this one has 300001",
            ),
            (
                "filter.length",
                "20000",
                "Filter length N 20000: a whole number from 1 to 10001; the run has 10001 samples",
            ),
            ("motion.end", "0.4", "Filter length N 500: a whole number from 1 to 401"),
            ("robot.length", "20", "robot.disks[2] = 22.5 mm is not allowed"),
        ] {
            let control = table::control(key).expect(key);
            let mut scenario = Scenario::default();
            control.enter(&mut scenario, typed).expect(typed);
            let refused = told(&check(&scenario).expect_err(typed));
            assert!(refused.starts_with(said), "{refused}");
        }
    }
}
