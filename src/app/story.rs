//! What a run came to, in words and figures.

use super::quantity::fixed;
use crate::experiment::scenario::{Place, Start};
use crate::experiment::{Crossing, Method, Run};

/// What is known at the cursor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Nothing touches, nothing noticed.
    Free,
    /// The beam holds the backbone, unnoticed.
    Contact,
    /// The centrode's deviation has crossed its threshold.
    Detected,
}

impl Phase {
    /// At a time (s) of a run.
    #[must_use]
    pub fn at(run: &Run, time: f64) -> Self {
        if run.detection.is_some_and(|detection| detection.time <= time) {
            Self::Detected
        } else if run.sample_at(time).in_contact {
            Self::Contact
        } else {
            Self::Free
        }
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Free => "Free",
            Self::Contact => "In contact",
            Self::Detected => "Detected",
        }
    }
}

/// One figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What it is.
    pub name: &'static str,
    /// Its number; “–” where there is none.
    pub value: String,
    /// Its unit.
    pub unit: &'static str,
}

/// When the beam is met, s: the time asked for rather than the first sample after it.
fn contact_time(run: &Run) -> Option<f64> {
    let (first, scenario) = (run.contact_time?, run.plan.scenario());
    match scenario.contact.start {
        Start::Time(asked) if asked <= first && first - asked < 1.5 / scenario.loop_rate => Some(asked),
        _ => Some(first),
    }
}

/// Where the beam is, with its preposition.
fn place(run: &Run) -> String {
    match run.plan.scenario().contact.place {
        Place::Disk(disk) => format!("on disk {disk}"),
        Place::ArcLength(s) => format!("at {} mm", fixed(s * 1e3, 1)),
        Place::Nowhere => "nowhere".into(),
    }
}

fn seconds(duration: f64) -> String {
    format!("{} s", fixed(duration, 2))
}

/// What the centrode's deviation made of the run.
fn centrode(run: &Run) -> String {
    let xi2 = run.plan.scenario().detection.xi2.value();
    match (contact_time(run), run.detection) {
        (None, None) if run.plan.contact().is_some() => {
            "The motion never reaches the beam, and nothing was noticed.".into()
        }
        (None, None) => "Nothing touches the robot, and nothing was noticed.".into(),
        (None, Some(alarm)) => format!("False alarm at {} s: nothing touches the robot.", fixed(alarm.time, 3)),
        (Some(contact), None) => {
            let met = met(run, contact);
            match xi2 {
                None => format!("{met} was not looked for: ξ2 is off."),
                Some(xi2) => format!("{met} was not noticed; ξ2 is {} mm.", fixed(xi2 * 1e3, 1)),
            }
        }
        (Some(contact), Some(alarm)) if alarm.time < contact => format!(
            "False alarm at {} s, {} before the contact {}.",
            fixed(alarm.time, 3),
            seconds(contact - alarm.time),
            place(run)
        ),
        (Some(contact), Some(alarm)) => {
            let truth = run.plan.contact().map_or(f64::NAN, |planned| planned.arc_length);
            let opened = if run.sample_at(alarm.time).in_contact { "" } else { ", after it had opened again" };
            format!(
                "{} was noticed {} later{opened}; the estimate is {} mm, the truth {} mm.",
                met(run, contact),
                seconds(alarm.time - contact),
                fixed(alarm.location * 1e3, 1),
                fixed(truth * 1e3, 1)
            )
        }
    }
}

fn met(run: &Run, contact: f64) -> String {
    if contact <= 0.0 {
        format!("Contact {} from the start", place(run))
    } else {
        format!("Contact {} at {} s", place(run), fixed(contact, 3))
    }
}

/// The first alarm of the joint forces.
fn joint_alarm(run: &Run) -> Option<&Crossing> {
    run.crossings.iter().find(|crossing| crossing.method == Method::Jfd)
}

/// What the joint forces made of it.
fn joint_forces(run: &Run) -> String {
    if run.plan.scenario().detection.xi1.value().is_none() {
        return "Joint forces were not looked at: ξ1 is off.".into();
    }
    match (joint_alarm(run), contact_time(run)) {
        (None, _) => "Joint forces raised no alarm.".into(),
        (Some(alarm), Some(contact)) if alarm.time >= contact => {
            format!("Joint forces raised theirs {} after the contact.", seconds(alarm.time - contact))
        }
        (Some(alarm), Some(contact)) => format!(
            "Joint forces raised a false alarm at {} s, {} before the contact.",
            fixed(alarm.time, 3),
            seconds(contact - alarm.time)
        ),
        (Some(alarm), None) => format!("Joint forces raised a false alarm at {} s.", fixed(alarm.time, 3)),
    }
}

/// The run in one sentence.
#[must_use]
pub fn sentence(run: &Run) -> String {
    centrode(run)
}

/// The run in words: both methods.
#[must_use]
pub fn words(run: &Run) -> String {
    format!("{} {}", centrode(run), joint_forces(run))
}

/// The run in figures.
#[must_use]
pub fn figures(run: &Run) -> Vec<Figure> {
    let detection = run.detection;
    let contact = contact_time(run).unwrap_or(f64::NAN);
    let detected = detection.map_or(f64::NAN, |detection| detection.time);
    let estimate = detection.map_or(f64::NAN, |detection| detection.location * 1e3);
    let truth = match run.contact_time {
        Some(_) => run.plan.contact().map_or(f64::NAN, |planned| planned.arc_length * 1e3),
        None => f64::NAN,
    };
    let delay = detected - contact;
    let error = estimate - truth;
    let signed = |value: f64, decimals| {
        let text = fixed(value, decimals);
        if value > 0.0 && text.contains(['1', '2', '3', '4', '5', '6', '7', '8', '9']) {
            format!("+{text}")
        } else {
            text
        }
    };
    let figure = |name, value, unit| Figure { name, value, unit };
    vec![
        figure("Contact", fixed(contact, 3), "s"),
        figure("Detected", fixed(detected, 3), "s"),
        figure("Delay", signed(delay, 3), "s"),
        figure(
            "θL at detection",
            fixed(detection.map_or(f64::NAN, |detection| detection.theta_l.to_degrees()), 1),
            "°",
        ),
        figure("Estimate", fixed(estimate, 1), "mm"),
        figure("Truth", fixed(truth, 1), "mm"),
        figure("Error", signed(error, 1), "mm"),
        figure("Joint force alarm", fixed(joint_alarm(run).map_or(f64::NAN, |alarm| alarm.time), 3), "s"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::scenario::Threshold;
    use crate::experiment::{Scenario, preset, simulate};

    fn run(name: &str, change: impl FnOnce(&mut Scenario)) -> Run {
        let mut scenario = preset::find(name).and_then(preset::Preset::scenario).expect(name);
        change(&mut scenario);
        simulate(&scenario).expect(name)
    }

    #[test]
    fn a_detection_is_told_with_its_delay_and_place() {
        let said = sentence(&run("paper", |_| {}));
        assert!(said.starts_with("Contact on disk 2 at 5.800 s was noticed 0.48 s later; the estimate is "), "{said}");
        assert!(said.ends_with("the truth 15.0 mm."), "{said}");
    }

    #[test]
    fn every_outcome_has_its_words() {
        for (name, change, part) in [
            (
                "free",
                (|s| s.detection.min_speed = 1.0) as fn(&mut Scenario),
                "Nothing touches the robot, and nothing was noticed.",
            ),
            ("static-resolution", |_| {}, "False alarm at "),
            ("paper", |s| s.detection.xi2 = Threshold::OFF, "was not looked for: ξ2 is off."),
            ("paper", |s| s.detection.xi2 = Threshold::On(1.0), "was not noticed; ξ2 is 1000.0 mm."),
            ("paper", |s| s.detection.xi1 = Threshold::OFF, "ξ1 is off."),
            ("static-resolution", |s| s.contact = Scenario::default().contact, " before the contact on disk 2."),
            ("mid-gap", |_| {}, "Contact at 18.0 mm at "),
            (
                "paper",
                |s| s.contact.start = crate::experiment::scenario::Start::Time(9.0),
                "The motion never reaches the beam",
            ),
            ("out-and-in", |_| {}, "from the start"),
        ] {
            let said = words(&run(name, change));
            assert!(said.contains(part), "{name}: {said}");
        }
    }

    #[test]
    fn figures_that_do_not_exist_are_dashes() {
        let figures = figures(&run("free", |s| s.detection.min_speed = 1.0));
        assert!(figures.iter().take(7).all(|figure| figure.value == "–"), "{figures:?}");
    }

    #[test]
    fn the_phase_follows_the_cursor() {
        let run = run("paper", |_| {});
        assert_eq!([1.0, 6.0, 6.5].map(|time| Phase::at(&run, time)), [Phase::Free, Phase::Contact, Phase::Detected]);
    }
}
