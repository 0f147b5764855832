//! What the calibration filter's alarm says of a contact, at the playback position.

use crate::app::charts::notation::number;
use crate::app::memo::placed::{Alarm, Place, Placed, Shown};
use crate::app::words::story::loaded_by;
use centrode_core::detect::Method;
use centrode_core::detect::calibration::marginal::Estimate;
use centrode_core::plant::Happening;
use centrode_core::run::Run;
use centrode_core::scenario::{Estimator, Kind};

/// From this probability on, one kind of contact is named.
const SURE: f64 = 0.95;

/// What is known at a time (s); none where neither detector of the calibration filter judges.
#[must_use]
pub fn sentence(run: &Run, placed: &Placed, time: f64) -> Option<String> {
    let name = match placed.detector()? {
        Method::Glr => "GLR",
        _ => "CUSUM",
    };
    if placed.alarms().is_empty() {
        return Some(format!("{name} raises no alarm."));
    }
    let Some(alarm) = placed.alarm_at(time) else { return Some(format!("{name} has raised no alarm yet.")) };
    let told = alarmed(run, name, alarm);
    if let Some(cleared) = alarm.cleared.filter(|cleared| *cleared <= time) {
        return Some(format!("{told}; cleared at {} s.", number(cleared, 2)));
    }
    let beside = beside(run, placed, time);
    Some(match placed.at(time) {
        None => format!("{told}.{beside}"),
        Some(shown) => format!("{told}; {}{beside}", place(&shown)),
    })
}

/// Where Eq. 24 places the contact of the same alarm, at once and once the average holds nothing from before, as far as that is asked for.
fn beside(run: &Run, placed: &Placed, time: f64) -> String {
    let settings = &run.judged.settings;
    let span = settings.filter_span();
    let said = |estimator: Estimator| {
        let lag = if estimator == Estimator::Settled { span } else { 0.0 };
        let Some((alarm, after)) = placed.passed(time, lag) else {
            return format!(" Eq. 24 settles {} s after the alarm.", number(span, 2));
        };
        let name = if estimator == Estimator::Settled { "Eq. 24, settled" } else { "Eq. 24" };
        match run.judged.estimate(&run.recording, alarm.raised, after, estimator) {
            Some(made) => format!(" {name}: {} mm.", number(made.location.mode * 1e3, 1)),
            None => format!(" {name}: no place, for the sensor has no centrode then."),
        }
    };
    let plain = [Estimator::Eq24, Estimator::Settled];
    plain.into_iter().filter(|&estimator| settings.placing.estimators.has(estimator)).map(said).collect()
}

/// The alarm, against the truth where that is known.
fn alarmed(run: &Run, name: &str, Alarm { raised, .. }: Alarm) -> String {
    let (at, seconds) = (number(raised, 3), |duration: f64| format!("{} s", number(duration, 2)));
    let before = run.plant_events().iter().rfind(|event| event.time <= raised);
    if let Some(left) = before.filter(|event| event.what != Happening::Met) {
        return format!("{name} raises an alarm at {at} s, {} after the contact was left", seconds(raised - left.time));
    }
    match run.contact_time() {
        _ if run.is_recorded() => format!("{name} tells of a contact at {at} s"),
        Some(contact) if contact <= raised => {
            format!("{name} tells of a contact {} after touch", seconds(raised - contact))
        }
        Some(contact) => {
            format!("{name} raises a false alarm at {at} s, {} before the contact", seconds(contact - raised))
        }
        None if loaded_by(run, raised) => {
            let since = raised - run.plan.scenario().load.start;
            format!("{name} raises an alarm at {at} s, {} after the load on the tip begins", seconds(since))
        }
        None => format!("{name} raises a false alarm at {at} s, for nothing touches the robot"),
    }
}

/// Where the contact is placed, and what it is thought to be.
fn place(shown: &Shown<'_>) -> String {
    let latest = match shown.latest {
        Place::Due => return "placing …".into(),
        Place::Unknown => return "the readings do not place it.".into(),
        Place::At(estimate) => estimate,
    };
    let mm = |value: f64| number(value * 1e3, 1);
    let ends = |estimate: &Estimate| [mm(estimate.place.low), mm(estimate.place.high)];
    let place = match shown.first {
        Place::At(first) if shown.after > 0.0 => {
            let ([low, high], [then_low, then_high]) = (ends(first), ends(latest));
            let width = |estimate: &Estimate| estimate.place.high - estimate.place.low;
            let becomes = if width(latest) < width(first) { "narrows" } else { "changes" };
            let after = number(shown.after, 2);
            format!("{low} to {high} mm with 95 %, which {becomes} to {then_low}–{then_high} mm {after} s later")
        }
        _ => {
            let [low, high] = ends(latest);
            format!("{low} to {high} mm with 95 %")
        }
    };
    format!("{place}.{}", kind(latest).unwrap_or_default())
}

/// What the contact is thought to be, where more than one kind was thought possible.
fn kind(estimate: &Estimate) -> Option<String> {
    if estimate.kinds.len() < 2 {
        return None;
    }
    let (kind, share) = estimate.kinds.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let name = |kind: Kind| match kind {
        Kind::Clamp => "clamp",
        Kind::Plane => "plane",
    };
    Some(if *share >= SURE {
        format!(" A {}, {}.", name(*kind), percent(*share))
    } else {
        format!(" Clamp or plane: cannot tell yet ({} {}).", percent(*share), name(*kind))
    })
}

/// A probability as a person says it: nothing but zero and one is certain.
#[must_use]
pub fn percent(share: f64) -> String {
    match share {
        share if share.is_nan() => "–".into(),
        share if share < 0.005 => "< 1 %".into(),
        share if share > 0.995 => "> 99 %".into(),
        share => format!("{} %", number(share * 100.0, 0)),
    }
}

/// A warning where the noise of the tracker is not known, or innovations are not white.
#[must_use]
pub fn warning(placed: &Placed) -> Option<String> {
    if placed.is_unmeasured() {
        return Some(
            "The tracker's noise could not be measured, for the robot is not at rest before it moves: it is taken for the position noise and \
             orientation noise that are set."
                .into(),
        );
    }
    let p = placed.suspect()?;
    let p = if p < 1e-99 { "p < 1e-99".into() } else { format!("p = {p:.0e}") };
    Some(format!(
        "Innovations are not white ({p}): thresholds and intervals hold for white ones. Assumed noise correlation and assumed drift \
         (prior.colour, prior.drift) make room for what is left, unless a contact was missed."
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::run::simulate;
    use centrode_core::scenario::preset::find;
    use centrode_core::scenario::{Choice, Contact, Scenario};

    fn made(scenario: &Scenario) -> (Run, Placed) {
        let run = simulate(scenario).expect("run");
        let mut placed = Placed::default();
        placed.renew(&run, 0);
        (run, placed)
    }

    fn bench() -> Scenario {
        let mut scenario = find("bench").and_then(|preset| preset.scenario()).expect("preset");
        scenario.detection.detectors.set(centrode_core::detect::Method::Cusum, true);
        scenario
    }

    #[test]
    fn the_sentence_follows_the_cursor() {
        let (run, mut placed) = made(&bench());
        let raised = placed.alarms().first().expect("an alarm").raised;
        let say = |placed: &Placed, time| sentence(&run, placed, time).expect("it judges");
        assert_eq!(say(&placed, raised - 0.01), "CUSUM has raised no alarm yet.");
        assert!(say(&placed, raised).ends_with(" s after touch; placing …"));
        while placed.work(&run, raised) {}
        let [at, later] = [0.0, 0.6].map(|after| say(&placed, raised + after));
        assert!(at.starts_with("CUSUM tells of a contact 0.0") && !at.contains("narrows"), "{at}");
        assert!(at.contains(" mm with 95 %. Clamp or plane: cannot tell yet ("), "{at}");
        assert!(later.contains(" mm with 95 %, which narrows to ") && later.contains(" mm 0.50 s later. "), "{later}");
    }

    #[test]
    fn every_estimator_that_is_asked_for_has_its_say() {
        let mut scenario = bench();
        let say = |scenario: &Scenario, after: f64| {
            let (run, mut placed) = made(scenario);
            let raised = placed.alarms().first().expect("an alarm").raised;
            while placed.work(&run, raised + after) {}
            sentence(&run, &placed, raised + after).expect("it judges")
        };
        assert!(!say(&scenario, 1.5).contains("Eq. 24"));
        scenario.estimation.estimators = Choice::of(Estimator::ALL);
        let [early, late] = [0.1, 1.5].map(|after| say(&scenario, after));
        let span = scenario.filter.length as f64 / scenario.loop_rate;
        assert!(early.contains(" mm with 95 %") && early.contains(" Eq. 24: "), "{early}");
        assert!(early.ends_with(&format!(" Eq. 24 settles {} s after the alarm.", number(span, 2))), "{early}");
        assert!(late.contains(" Eq. 24, settled: ") && late.ends_with(" mm."), "{late}");
        scenario.estimation.estimators = Choice::of(&[Estimator::Eq24]);
        let plain = say(&scenario, 1.5);
        assert!(plain.contains(" after touch. Eq. 24: ") && !plain.contains("95 %"), "{plain}");
    }

    #[test]
    fn without_touch_an_alarm_is_false() {
        let mut scenario = bench();
        scenario.detection.cusum = centrode_core::scenario::Threshold::On(1.5);
        let (run, placed) = made(&scenario);
        let said = sentence(&run, &placed, 9.0).expect("it judges");
        assert!(said.contains("false alarm") && said.contains(" s before the contact; "), "{said}");
        scenario.contact = Contact { place: centrode_core::scenario::Place::Nowhere, ..Contact::default() };
        let (run, placed) = made(&scenario);
        let said = sentence(&run, &placed, 9.0).expect("it judges");
        assert!(said.contains(", for nothing touches the robot; cleared at "), "{said}");
        scenario.detection.cusum = centrode_core::scenario::Threshold::OFF;
        let (run, placed) = made(&scenario);
        assert_eq!(sentence(&run, &placed, 9.0), None);
    }

    #[test]
    fn noise_that_is_taken_for_white_and_is_not_is_warned_of() {
        let mut scenario = bench();
        assert_eq!(warning(&made(&scenario).1), None);
        scenario.tracker.position_noise = 5e-4;
        scenario.tracker.orientation_noise = 1e-3;
        scenario.calibration.colour = 0.8;
        scenario.prior.colour = centrode_core::scenario::Estimated::Known(0.0);
        let said = warning(&made(&scenario).1).expect("far from white");
        assert!(said.starts_with("Innovations are not white (p "), "{said}");
    }

    #[test]
    fn nothing_is_certain() {
        let said = [0.0, 0.0049, 0.25, 0.9951, 1.0, f64::NAN].map(percent);
        assert_eq!(said, ["< 1 %", "< 1 %", "25 %", "> 99 %", "> 99 %", "–"]);
    }
}
