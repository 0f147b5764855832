//! What a run of several segments came to, in words and figures.

use crate::app::chain::memo::Memo;
use crate::app::charts::notation::number;
use crate::app::panels::readout;
use crate::app::panels::transport::{Mark, Track};
use crate::app::words::placed::percent;
use crate::app::words::story::{Figure, Phase};
use centrode_core::detect::chain::{ChainEstimate, ChainMethod};
use centrode_core::model::chain::path::What;
use centrode_core::scenario::chain::Tracked;
use centrode_core::study::chain::ChainRun;
use centrode_core::study::chain::placing::Told;

fn millimetres(length: f64) -> String {
    number(length * 1e3, 1)
}

/// Times at which contacts are met, s, with their place in the list.
fn met(run: &ChainRun) -> impl Iterator<Item = (usize, f64)> {
    run.plan.path().happened().iter().filter_map(|event| match event.what {
        What::Met(place) => Some((place, event.time)),
        _ => None,
    })
}

/// How many contacts press at a time (s): truth.
fn pressing(run: &ChainRun, time: f64) -> usize {
    run.plan.path().at(time, &run.plan.bends(time)).active.len()
}

/// What is known at a time (s).
#[must_use]
pub fn phase(memo: &Memo, time: f64) -> Phase {
    let run = memo.run();
    if memo.about().is_some() {
        return if memo.alarm(time).is_some() { Phase::Detected } else { Phase::Quiet };
    }
    let first = met(run).map(|(_, time)| time).fold(f64::INFINITY, f64::min);
    match memo.alarm(time) {
        Some(_) if memo.told().iter().any(|told| told.found.alarm <= time && told.found.alarm >= first) => {
            Phase::Detected
        }
        Some(_) => Phase::FalseAlarm,
        None if pressing(run, time) > 0 => Phase::Contact,
        None => Phase::Free,
    }
}

/// Where a contact is, in words.
fn placed(estimate: &ChainEstimate) -> String {
    if estimate.nothing > 0.5 {
        return format!("a false alarm ({})", percent(estimate.nothing));
    }
    let sure = percent(estimate.probabilities.get(estimate.segment).copied().unwrap_or(f64::NAN));
    let place = &estimate.place;
    let width = if place.low < place.high {
        format!(", 95 % from {} to {} mm", millimetres(place.low), millimetres(place.high))
    } else {
        String::new()
    };
    format!("segment {} ({sure}), {} mm from its base{width}", estimate.segment + 1, millimetres(place.mean))
}

/// Which disks deviate, in words.
fn disks(segments: &[usize]) -> String {
    let all: Vec<String> = segments.iter().map(|segment| (segment + 1).to_string()).collect();
    match all.as_slice() {
        [one] => format!("disk {one} deviates"),
        [others @ .., last] => format!("disks {} and {last} deviate", others.join(", ")),
        [] => "no disk deviates".into(),
    }
}

/// A contact that is told, as far as it is known at a time (s).
fn told(number_of: usize, one: &Told, time: f64) -> String {
    let at = number(one.found.alarm, 3);
    let which = disks(&one.found.deviating);
    let blamed = one.found.deviating.last().map_or(String::new(), |last| {
        if one.found.deviating.len() > 1 {
            format!("; the last of them, {}, carries it", last + 1)
        } else {
            String::new()
        }
    });
    let place = match one.at(time) {
        Some(estimate) => format!(" Placed {} s later: {}.", number(estimate.after, 2), placed(estimate)),
        None if one.found.alarm > time => String::new(),
        None => " Not placed yet.".into(),
    };
    format!("Contact {}: alarm at {at} s, {which}{blamed}.{place}", number_of + 1)
}

/// What the run came to.
#[must_use]
pub fn sentence(memo: &Memo) -> String {
    if memo.about().is_some() {
        return "A log does not say whether anything touched the robot.".into();
    }
    let run = memo.run();
    let touched: Vec<usize> = met(run).map(|(place, _)| place).collect();
    let mut said = match touched.len() {
        0 if run.plan.scenario().contacts.is_empty() => "Nothing touches the robot.".to_owned(),
        0 => "No beam is reached.".into(),
        _ => {
            let each = met(run).map(|(place, time)| {
                let contact = &run.plan.scenario().contacts[place];
                format!("segment {} at {} mm from {} s", contact.segment + 1, millimetres(contact.at), number(time, 2))
            });
            format!("Touched: {}.", each.collect::<Vec<_>>().join("; "))
        }
    };
    for event in run.plan.path().happened() {
        match event.what {
            What::Opened(place) => {
                said += &format!(" It comes off contact {} at {} s.", place + 1, number(event.time, 2))
            }
            What::Buckled => {
                said += &format!(" At {} s it buckles out of its plane, and the run ends.", number(event.time, 2))
            }
            What::Lost => {
                said +=
                    &format!(" At {} s no shape near that of before is found, and the run ends.", number(event.time, 2))
            }
            What::Met(_) => {}
        }
    }
    said
}

/// Everything that is read out at a time (s).
#[must_use]
pub fn readout(memo: &Memo, time: f64) -> readout::Told {
    let run = memo.run();
    let mut more: Vec<(String, bool)> =
        memo.told().iter().enumerate().map(|(number, one)| (told(number, one, time), false)).collect();
    if memo.is_working() {
        more.push(("Placing contacts …".into(), false));
    } else if memo.teller().is_none() {
        more.push(("No detector judges that tells of contacts.".into(), true));
    } else if more.is_empty() {
        more.push((format!("{} tells of no contact.", teller(memo)), false));
    }
    if run.plan.scenario().tracked == Tracked::Tip {
        more.push((
            "With a tracker on the last end disk alone, its motion has to tell of every segment.".into(),
            false,
        ));
    }
    readout::Told { words: sentence(memo), more, figures: figures(memo, time) }
}

fn teller(memo: &Memo) -> &'static str {
    match memo.teller() {
        Some(ChainMethod::Smd) => "The screw motion deviation",
        Some(ChainMethod::Of(centrode_core::detect::Method::Cusum)) => "CUSUM",
        Some(ChainMethod::Of(centrode_core::detect::Method::Glr)) => "GLR",
        _ => "The centrode deviation",
    }
}

fn figures(memo: &Memo, time: f64) -> Vec<Figure> {
    let run = memo.run();
    let figure = |name, value: Option<String>, unit| Figure { name, value: value.unwrap_or("–".into()), unit };
    let found = memo.told().len();
    let told = figure("Contacts told", (!memo.is_working() || found > 0).then(|| found.to_string()), "");
    let first = met(run).next().map(|(_, time)| time);
    let alarm = memo.told().first().map(|told| told.found.alarm);
    let detected = figure("Detected", alarm.map(|alarm| number(alarm, 3)), "s");
    if memo.about().is_some() {
        return vec![told, detected, figure("Log ends", Some(number(memo.end(), 3)), "s")];
    }
    let delay = first.zip(alarm).map(|(met, alarm)| number(alarm - met, 2));
    let truth = run.plan.path().at(time, &run.plan.bends(time));
    let force = truth.forces.iter().copied().filter(|force| force.is_finite()).fold(0.0, f64::max);
    vec![
        figure("Contacts now", Some(truth.active.len().to_string()), ""),
        figure("Largest force", Some(number(force, 2)), "N"),
        figure("Stability margin", Some(number(truth.margin, 2)), ""),
        told,
        detected,
        figure("Delay", delay, "s"),
    ]
}

/// The state at a time (s) in a sentence that holds for as long as the state does.
#[must_use]
pub fn said(memo: &Memo, time: f64) -> String {
    let run = memo.run();
    match phase(memo, time) {
        Phase::Detected => {
            let last = memo.told().iter().enumerate().rfind(|(_, told)| told.found.alarm <= time);
            last.map_or_else(|| "Detected.".into(), |(number, one)| told(number, one, time))
        }
        Phase::FalseAlarm => "False alarm.".into(),
        Phase::Contact => format!("In contact with {}, not detected yet.", things(pressing(run, time))),
        Phase::Free => "Free: nothing touches the robot.".into(),
        Phase::Quiet => "No alarm.".into(),
    }
}

fn things(count: usize) -> String {
    if count == 1 { "one beam".into() } else { format!("{count} beams") }
}

/// What stands on the rail of playback.
#[must_use]
pub fn track(memo: &Memo) -> Track {
    let run = memo.run();
    let mut said = format!("Armed from {} s", number(run.plan.scenario().common().detection.armed_from, 2));
    let mut marks = Vec::new();
    for event in run.plan.path().happened() {
        let at = number(event.time, 3);
        match event.what {
            What::Met(place) => {
                marks.push(Mark::Contact(event.time));
                said += &format!(" · contact {} at {at} s", place + 1);
            }
            What::Opened(place) => {
                marks.push(Mark::LetGo(event.time));
                said += &format!(" · comes off contact {} at {at} s", place + 1);
            }
            What::Buckled => said += &format!(" · buckles at {at} s"),
            What::Lost => said += &format!(" · shape lost at {at} s"),
        }
    }
    for told in memo.told() {
        marks.push(Mark::Alarm(told.found.alarm));
        said += &format!(" · alarm at {} s", number(told.found.alarm, 3));
    }
    Track { end: memo.end(), armed_from: run.plan.scenario().common().detection.armed_from, marks, said }
}
