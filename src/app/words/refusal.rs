//! Refusals in a control's own terms: its label for the key, the unit it shows for SI.

use std::f64::consts::TAU;

use crate::app::controls::control::Control;
use crate::app::controls::quantity::{Quantity, number, round_to};
use crate::app::memo::Refusal;
use centrode_core::scenario::ScenarioError;

/// Why a change was refused, to stand beside the control that asked for it. Keys that are not the control's stay as
/// they are.
#[must_use]
pub fn told(control: Option<&Control>, refusal: &Refusal) -> String {
    let own = |key: &str| control.and_then(|control| Some((control, name(control, key)?)));
    match refusal {
        Refusal::Impossible(ScenarioError::Value { key, value, allowed }) => match own(key) {
            Some((control, (label, quantity))) => {
                let shown = value.parse().map_or_else(
                    |_| value.clone(),
                    |si| with_unit(&number(quantity.shown(si), control.decimals), quantity.unit()),
                );
                format!("{label} {shown}: {}", translated(allowed, quantity))
            }
            None => refusal.to_string(),
        },
        Refusal::TooLong { end, .. } => match own("motion.end") {
            Some((control, (label, quantity))) => {
                let shown = with_unit(&number(*end, control.decimals), quantity.unit());
                refusal.to_string().replacen(&format!("motion.end = {end} s"), &format!("{label} {shown}"), 1)
            }
            None => refusal.to_string(),
        },
        Refusal::Impossible(_) => refusal.to_string(),
    }
}

/// What a control calls a key, and what its values are; none for a key that is not its own.
fn name(control: &Control, key: &str) -> Option<(&'static str, Quantity)> {
    match (control.key, key) {
        ("contact.disk", "contact.arc_length") => Some(("Contact place", Quantity::Length)),
        ("contact.time", "contact.bend") => Some(("Contact bend", Quantity::Angle)),
        (own, key) if own == key => Some((control.label, control.quantity)),
        _ => None,
    }
}

fn with_unit(number: &str, unit: &str) -> String {
    if unit.is_empty() { number.into() } else { format!("{number} {unit}") }
}

/// A text in which each number with the SI unit is given in the unit shown. A ratio's numbers stand alone.
fn translated(text: &str, quantity: Quantity) -> String {
    let mut said: Vec<String> = Vec::new();
    let mut words = text.split(' ').peekable();
    while let Some(word) = words.next() {
        let digits = word.trim_start_matches('(');
        let value = if digits == "2π" { Some(TAU) } else { digits.parse::<f64>().ok() };
        let next = words.peek().copied().unwrap_or_default();
        let unit = next.trim_end_matches([',', ';', ')']);
        let alone = quantity == Quantity::Ratio;
        match value.filter(|_| alone || (!unit.is_empty() && unit == quantity.si_unit())) {
            Some(si) => {
                let shown = round_to(quantity.shown(si), 6).to_string().replace('-', "−");
                let tail = if alone { "" } else { &next[unit.len()..] };
                let head = &word[..word.len() - digits.len()];
                said.push(format!("{head}{shown} {}{tail}", quantity.unit()));
                if !alone {
                    words.next();
                }
            }
            None => said.push(word.into()),
        }
    }
    said.join(" ")
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
            ("contact.disk", "50 mm", "Contact place 50 mm: an arc length from 0 to robot.length = 30 mm"),
            ("contact.time", "-1", "Contact time −1.00 s: a finite number, 0 s or more"),
            ("contact.time", "400°", "Contact bend 400.00 °: a finite angle, less than one turn (360 °) from straight"),
            ("tracker.position_noise", "-1", "Position noise −1.000 mm: a number from 0 mm to 1000 mm"),
            ("load_cells.epsilon_tau", "100", "Load cell error ε_τ 100.0 %: from 0 % to below 100 %"),
            ("detection.xi1", "-5", "ξ1 (joint force) −5.0 mN·m: a finite number, 0 mN·m or more, or \"off\""),
            (
                "robot.primary.youngs_modulus",
                "0",
                "Young's modulus, primary 0.0 GPa: a number from 0.001 GPa to 10000 GPa",
            ),
            ("motion.finish", "2", "Motion ends 2.00 s: a time after motion.start = 3 s"),
            ("motion.end", "300", "Run ends 300.00 s at loop_rate = 1000 Hz is a run of 300001 samples"),
            ("robot.length", "20", "robot.disks[2] = 0.0225 is not allowed"),
        ] {
            let control = table::control(key).expect(key);
            let mut scenario = Scenario::default();
            control.enter(&mut scenario, typed).expect(typed);
            let refused = told(Some(control), &check(&scenario).expect_err(typed));
            assert!(refused.starts_with(said), "{refused}");
        }
    }
}
