//! What is said aloud as the state changes.

use crate::app::charts::notation::number;
use crate::app::words::story::{Phase, let_go};
use centrode_core::run::Run;

/// The state at a time (s) in a sentence that holds for as long as the state does.
#[must_use]
pub fn said(run: &Run, time: f64) -> String {
    let alarm = run.detection();
    match Phase::at(run, time) {
        Phase::Quiet => "No alarm.".into(),
        Phase::Detected if run.is_recorded() => match run.events().first() {
            Some(event) => format!("Alarm at {} s.", number(event.raised, 3)),
            None => "Alarm.".into(),
        },
        Phase::Free => match let_go(run).filter(|(_, lost)| *lost <= time) {
            Some((_, lost)) => format!("Free again since {} s.", number(lost, 3)),
            None => "Free: nothing touches the robot.".into(),
        },
        Phase::Contact => match run.contact_time() {
            Some(contact) => format!("In contact since {} s, not detected yet.", number(contact, 3)),
            None => "In contact.".into(),
        },
        Phase::FalseAlarm => match alarm {
            Some(alarm) => format!("False alarm at {} s.", number(alarm.time, 3)),
            None => "False alarm.".into(),
        },
        Phase::Detected => match (alarm, run.contact_time()) {
            (Some(alarm), Some(contact)) => format!(
                "Detected at {} s, {} s after the contact, at {} mm.",
                number(alarm.time, 3),
                number(alarm.time - contact, 2),
                number(alarm.location * 1e3, 1)
            ),
            _ => "Detected.".into(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::state::shipped;
    use centrode_core::run::simulate;
    use centrode_core::scenario::preset;

    #[test]
    fn every_state_of_a_run_is_said_once() {
        let run = simulate(&shipped(preset::find("bench").expect("a preset"))).expect("a run");
        let mut sentences: Vec<String> = (0..800).map(|k| said(&run, 0.01 * f64::from(k))).collect();
        sentences.dedup();
        assert_eq!(sentences.len(), 3, "{sentences:?}");
        assert_eq!(sentences[0], "Free: nothing touches the robot.");
        assert_eq!(sentences[1], "In contact since 5.801 s, not detected yet.");
        assert!(sentences[2].starts_with("Detected at 6.260 s, 0.46 s after the contact, at 13."), "{}", sentences[2]);
    }
}
