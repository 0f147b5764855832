//! What a run came to, in words and figures.

use crate::app::charts::notation::number;
use centrode_core::detect::{Event, Method};
use centrode_core::plant::Happening;
use centrode_core::run::Run;
use centrode_core::scenario::{ContactKind, Place};

/// What is known at the cursor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Nothing touches, nothing noticed.
    Free,
    /// The beam holds the backbone, unnoticed.
    Contact,
    /// The centrode's deviation has crossed its threshold, after the contact; in a log, any detector has raised an alarm.
    Detected,
    /// It has crossed its threshold before any contact.
    FalseAlarm,
    /// Nothing noticed in a log, which does not say what touches.
    Quiet,
}

impl Phase {
    /// At a time (s) of a run.
    #[must_use]
    pub fn at(run: &Run, time: f64) -> Self {
        if run.is_recorded() {
            let alarmed = run.events().first().is_some_and(|event| event.raised <= time);
            return if alarmed { Self::Detected } else { Self::Quiet };
        }
        match run.detection().filter(|detection| detection.time <= time) {
            Some(alarm) if run.contact_time().is_some_and(|contact| contact <= alarm.time) => Self::Detected,
            Some(_) => Self::FalseAlarm,
            None if run.sample_at(time).in_contact => Self::Contact,
            None => Self::Free,
        }
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Free => "Free",
            Self::Contact => "In contact",
            Self::Detected => "Detected",
            Self::FalseAlarm => "False alarm",
            Self::Quiet => "No alarm",
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

/// Where the beam is, with its preposition.
fn place(run: &Run) -> String {
    let contact = &run.plan.scenario().contact;
    let place = match contact.place {
        Place::Disk(disk) => format!("on disk {disk}"),
        Place::ArcLength(s) => format!("at {} mm", number(s * 1e3, 1)),
        Place::Nowhere => "nowhere".into(),
    };
    match contact.kind {
        ContactKind::Clamp => place,
        ContactKind::Plane => format!("{place} with a flat beam"),
        ContactKind::Cylinder => format!("{place} with a round beam"),
    }
}

/// How and when the segment lost the beam without the motion taking it off; none while it does not.
#[must_use]
pub fn let_go(run: &Run) -> Option<(&'static str, f64)> {
    run.plant_events().iter().find_map(|event| match event.what {
        Happening::Snapped => Some(("snaps off", event.time)),
        Happening::SlidOff => Some(("slides off", event.time)),
        Happening::Wrapped => Some(("would wrap", event.time)),
        Happening::Met | Happening::Opened => None,
    })
}

/// The same as a sentence.
fn lost(run: &Run) -> String {
    let Some((how, time)) = let_go(run) else { return String::new() };
    let time = number(time, 3);
    if run.plant_events().iter().any(|event| event.what == Happening::Wrapped) {
        return format!(
            " From {time} s on it would lie along the round beam, which is not modelled: it is shown free."
        );
    }
    format!(" The segment {how} at {time} s and is free from then on.")
}

fn seconds(duration: f64) -> String {
    format!("{} s", number(duration, 2))
}

/// What the centrode's deviation made of the run.
fn centrode(run: &Run) -> String {
    let detection = &run.plan.scenario().detection;
    let judges = detection.detectors.has(Method::Fcd);
    let off =
        format!("{}, so the centrode raised no alarm.", if judges { "ξ2 is off" } else { "FCD is not switched on" });
    let xi2 = detection.xi2.value().filter(|_| judges);
    match (run.contact_time(), run.detection()) {
        (None, None) => {
            let beam = run.plan.contact().is_some();
            let free = if beam { "The motion never reaches the beam" } else { "Nothing touches the robot" };
            if xi2.is_some() { format!("{free}, and no alarm was raised.") } else { format!("{free}; {off}") }
        }
        (None, Some(alarm)) => format!("{}: nothing touches the robot.", false_alarm(run, alarm.time)),
        (Some(contact), None) => {
            let met = met(run, contact);
            match xi2 {
                None => format!("{met}; {off}"),
                Some(xi2) => format!("{met} was not noticed; ξ2 is {} mm.", number(xi2 * 1e3, 1)),
            }
        }
        (Some(contact), Some(alarm)) if alarm.time < contact => format!(
            "{}, {} before the contact {}.",
            false_alarm(run, alarm.time),
            seconds(contact - alarm.time),
            place(run)
        ),
        (Some(contact), Some(alarm)) => {
            let truth = run.plan.contact().map_or(f64::NAN, |planned| planned.arc_length);
            let opened = if run.sample_at(alarm.time).in_contact { "" } else { ", after the contact had ended" };
            let ending = if ended(run, alarm.time) { format!(", {ENDED}") } else { String::new() };
            format!(
                "{} was noticed at {} s, {} later{opened}{ending}; the estimate is {} mm, the truth {} mm.",
                met(run, contact),
                number(alarm.time, 3),
                seconds(alarm.time - contact),
                number(alarm.location * 1e3, 1),
                number(truth * 1e3, 1)
            )
        }
    }
}

fn false_alarm(run: &Run, time: f64) -> String {
    let ending = if ended(run, time) { format!(" {ENDED}") } else { String::new() };
    format!("False alarm at {} s{ending}", number(time, 3))
}

const ENDED: &str = "as the motion came to rest, where noise dominates";

/// Whether the sensor turned so slowly at a time (s), late in the motion, that its centrode was mostly noise.
fn ended(run: &Run, time: f64) -> bool {
    let scenario = run.plan.scenario();
    let slow = run.sample_at(time).judgement.speed < 3.0 * scenario.detection.min_speed;
    slow && time > f64::midpoint(scenario.motion.start, scenario.motion.finish)
}

fn met(run: &Run, contact: f64) -> String {
    if contact <= 0.0 {
        format!("Contact {} from the start", place(run))
    } else {
        format!("Contact {} at {} s", place(run), number(contact, 3))
    }
}

/// The first alarm of the joint forces.
fn joint_alarm(run: &Run) -> Option<&Event> {
    run.judged.first(Method::Jfd)
}

/// What the joint forces made of it.
fn joint_forces(run: &Run) -> String {
    if !run.plan.scenario().detection.detectors.has(Method::Jfd) {
        return "JFD is not switched on, so joint forces raised no alarm.".into();
    }
    if run.plan.scenario().detection.xi1.value().is_none() {
        return "ξ1 is off, so joint forces raised no alarm.".into();
    }
    match (joint_alarm(run), run.contact_time()) {
        (None, _) if run.samples().any(|sample| sample.in_contact && sample.judgement.residual.is_nan()) => {
            "Joint forces are not defined while the beam holds the robot so near its tip.".into()
        }
        (None, _) => "Joint forces raised no alarm.".into(),
        (Some(alarm), Some(contact)) if alarm.raised >= contact => {
            format!("Joint forces alarmed {} after the contact.", seconds(alarm.raised - contact))
        }
        (Some(alarm), Some(contact)) => format!(
            "Joint forces raised a false alarm at {} s, {} before the contact.",
            number(alarm.raised, 3),
            seconds(contact - alarm.raised)
        ),
        (Some(alarm), None) if loaded_by(run, alarm.raised) => format!(
            "Joint forces noticed the load on the tip at {} s, {} after it began.",
            number(alarm.raised, 3),
            seconds(alarm.raised - run.plan.scenario().load.start)
        ),
        (Some(alarm), None) => format!("Joint forces raised a false alarm at {} s.", number(alarm.raised, 3)),
    }
}

/// Whether a load has begun to act on the tip by a time (s).
pub(super) fn loaded_by(run: &Run, time: f64) -> bool {
    let load = &run.plan.scenario().load;
    time >= load.start && (load.force != [0.0; 3] || load.moment != [0.0; 3])
}

/// The run in one sentence.
#[must_use]
pub fn sentence(run: &Run) -> String {
    centrode(run) + &lost(run)
}

/// The run in words: both methods.
#[must_use]
pub fn words(run: &Run) -> String {
    format!("{}{} {}", centrode(run), lost(run), joint_forces(run))
}

/// The run in figures.
#[must_use]
pub fn figures(run: &Run) -> Vec<Figure> {
    let detection = run.detection();
    let contact = run.contact_time().unwrap_or(f64::NAN);
    let detected = detection.map_or(f64::NAN, |detection| detection.time);
    let estimate = detection.map_or(f64::NAN, |detection| detection.location * 1e3);
    let truth = match run.contact_time() {
        Some(_) => run.plan.contact().map_or(f64::NAN, |planned| planned.arc_length * 1e3),
        None => f64::NAN,
    };
    let delay = detected - contact;
    let error = estimate - truth;
    let signed = |value: f64, decimals| {
        let text = number(value, decimals);
        if value > 0.0 && text.contains(['1', '2', '3', '4', '5', '6', '7', '8', '9']) {
            format!("+{text}")
        } else {
            text
        }
    };
    let figure = |name, value, unit| Figure { name, value, unit };
    vec![
        figure("Contact", number(contact, 3), "s"),
        figure("Detected", number(detected, 3), "s"),
        figure("Delay", signed(delay, 3), "s"),
        figure(
            "θL at detection",
            number(detection.map_or(f64::NAN, |detection| detection.theta_l.to_degrees()), 1),
            "°",
        ),
        figure("Estimate", number(estimate, 1), "mm"),
        figure("Truth", number(truth, 1), "mm"),
        figure("Error", signed(error, 1), "mm"),
        figure("Joint force alarm", number(joint_alarm(run).map_or(f64::NAN, |alarm| alarm.raised), 3), "s"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::run::simulate;
    use centrode_core::scenario::Threshold;
    use centrode_core::scenario::{Scenario, preset};

    fn run(name: &str, change: impl FnOnce(&mut Scenario)) -> Run {
        let mut scenario = preset::find(name).and_then(preset::Preset::scenario).expect(name);
        change(&mut scenario);
        simulate(&scenario).expect(name)
    }

    #[test]
    fn a_detection_is_told_with_its_delay_and_place() {
        let said = sentence(&run("paper", |_| {}));
        assert!(
            said.starts_with("Contact on disk 2 at 5.801 s was noticed at 6.280 s, 0.48 s later; the estimate is "),
            "{said}"
        );
        assert!(said.ends_with("the truth 15.0 mm."), "{said}");
    }

    #[test]
    fn every_outcome_has_its_words() {
        for (name, change, part) in [
            (
                "free",
                (|s| s.detection.min_speed = 1.0) as fn(&mut Scenario),
                "Nothing touches the robot, and no alarm was raised.",
            ),
            ("static-resolution", |_| {}, "False alarm at "),
            (
                "paper",
                |s| s.detection.xi2 = Threshold::OFF,
                "Contact on disk 2 at 5.801 s; ξ2 is off, so the centrode raised no alarm.",
            ),
            ("paper", |s| s.detection.xi2 = Threshold::On(1.0), "was not noticed; ξ2 is 1000.0 mm."),
            ("paper", |s| s.detection.xi1 = Threshold::OFF, "ξ1 is off, so joint forces raised no alarm."),
            ("paper", |_| {}, "Joint forces alarmed 0."),
            ("free", |s| s.detection.xi2 = Threshold::OFF, "Nothing touches the robot; ξ2 is off"),
            (
                "paper",
                |s| s.contact.place = Place::ArcLength(0.03),
                "Joint forces are not defined while the beam holds the robot so near its tip.",
            ),
            (
                "free",
                |s| {
                    s.detection.armed_from = 7.0;
                    s.detection.xi2 = Threshold::On(0.003);
                    s.tracker.position_noise = 1e-3;
                    s.filter.length = 50;
                    s.detection.min_speed = 0.1;
                },
                " s as the motion came to rest, where noise dominates: nothing touches",
            ),
            ("static-resolution", |s| s.contact = Scenario::default().contact, " before the contact on disk 2."),
            ("mid-gap", |_| {}, "Contact at 18.0 mm at "),
            (
                "paper",
                |s| s.contact.start = centrode_core::scenario::Start::Time(9.0),
                "The motion never reaches the beam",
            ),
            ("letting-go", |_| {}, "from the start"),
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

    #[test]
    fn an_alarm_without_contact_is_false() {
        let contact = Scenario::default().contact;
        for early in [run("static-resolution", |_| {}), run("static-resolution", |s| s.contact = contact)] {
            let alarm = early.detection().expect("an alarm").time;
            assert_eq!(Phase::at(&early, alarm), Phase::FalseAlarm);
            assert_eq!(Phase::at(&early, early.plan.scenario().motion.end), Phase::FalseAlarm);
            assert_eq!(Phase::at(&early, alarm - 0.1), Phase::Free);
        }
    }

    #[test]
    fn words_and_figures_tell_the_same_times() {
        let run = run("paper", |_| {});
        let (contact, alarm) = (run.contact_time().expect("contact"), run.detection().expect("alarm").time);
        let shown = figures(&run);
        assert_eq!(shown[0].value, number(contact, 3));
        assert_eq!(shown[1].value, number(alarm, 3));
        assert_eq!(shown[2].value, format!("+{}", number(alarm - contact, 3)));
        let said = sentence(&run);
        assert!(said.contains(&shown[0].value) && said.contains(&shown[1].value), "{said}");
    }
}
