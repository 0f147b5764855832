//! Where the calibration filter places the contact that its alarm tells of, at the alarm and as more is read.
//!
//! One estimate costs more than a frame may: [`Placed::work`] makes one at a time, first what is shown.

use centrode_core::detect::calibration::marginal::Estimate;
use centrode_core::detect::calibration::noise::{SUSPECT, Whiteness};
use centrode_core::detect::estimates::{Placing, marginal};
use centrode_core::detect::{Event, Method};
use centrode_core::run::Run;
use centrode_core::scenario::Estimator;

/// Estimates are made so long after the alarm, s: densely at first, where the interval narrows fast.
pub const AFTER: [f64; 13] = [0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.75, 1.0, 1.5, 2.0];

/// The detectors of the calibration filter; the first that judges is the one whose alarm is placed.
const DETECTORS: [Method; 2] = [Method::Cusum, Method::Glr];

/// So many alarms of a run are placed: there are several where contacts are left again.
const ALARMS: usize = 16;

/// An alarm whose contact is placed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alarm {
    /// Whose it is.
    pub detector: Method,
    /// When it was raised, s.
    pub raised: f64,
    /// When it was cleared, s; none where it stands at the end.
    pub cleared: Option<f64>,
}

/// What estimates depend on: the readings as they were heard, the alarms, and with what contacts are placed.
#[derive(Debug, Clone, PartialEq)]
struct Key {
    heard: u64,
    alarms: Vec<Alarm>,
    placing: Placing,
    end: f64,
}

/// One estimate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place<'a> {
    /// It is being made.
    Due,
    /// The readings do not place the contact.
    Unknown,
    /// It is there.
    At(&'a Estimate),
}

/// What is known of an alarm's contact at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shown<'a> {
    /// The alarm.
    pub alarm: Alarm,
    /// What was known when it was raised.
    pub first: Place<'a>,
    /// What was last known, …
    pub latest: Place<'a>,
    /// … so long after the alarm, s.
    pub after: f64,
}

impl<'a> Shown<'a> {
    /// The last estimate, where there is one.
    #[must_use]
    pub fn estimate(&self) -> Option<&'a Estimate> {
        match self.latest {
            Place::At(estimate) => Some(estimate),
            Place::Due | Place::Unknown => None,
        }
    }
}

/// The estimates of one run, as far as they have been made.
#[derive(Debug, Default)]
pub struct Placed {
    key: Option<Key>,
    /// The detector that judges.
    detector: Option<Method>,
    /// One for each alarm and each time after it that the run holds: the estimate, if there is any; none where it is not made yet.
    made: Vec<Vec<Option<Option<Estimate>>>>,
    whiteness: Option<Whiteness>,
    unmeasured: bool,
}

impl Placed {
    /// Forgets what another run left; `heard` is another number for other readings.
    pub fn renew(&mut self, run: &Run, heard: u64) {
        let settings = &run.judged.settings;
        self.detector = DETECTORS.into_iter().find(|&method| settings.thresholds.judges(method));
        let events = self.detector.map_or_else(Vec::new, |detector| run.judged.contacts(detector));
        let alarm = |event: &Event| Alarm { detector: event.detector, raised: event.raised, cleared: event.cleared };
        let alarms: Vec<Alarm> = events.into_iter().take(ALARMS).map(alarm).collect();
        let key = Key { heard, alarms, placing: settings.placing, end: run.sample(run.len() - 1).time };
        if self.key.as_ref() == Some(&key) {
            return;
        }
        let places = settings.placing.estimators.has(Estimator::Marginal) && run.judged.watched.is_some();
        let held = |alarm: &Alarm| AFTER.iter().take_while(|&after| alarm.raised + after <= key.end).count();
        self.made = key.alarms.iter().map(|alarm| vec![None; if places { held(alarm) } else { 0 }]).collect();
        self.whiteness = run.judged.whiteness();
        self.unmeasured = run.judged.noise_unmeasured();
        self.key = Some(key);
    }

    /// Makes one estimate that is missing: the one that is due at a time (s), else the first. Returns whether more are missing.
    pub fn work(&mut self, run: &Run, time: f64) -> bool {
        let Some(watched) = &run.judged.watched else { return false };
        let due = self.due(time).and_then(|(alarm, which)| Some([alarm, which?]));
        let all =
            self.made.iter().enumerate().flat_map(|(alarm, made)| (0..made.len()).map(move |which| [alarm, which]));
        let missing = |&[alarm, which]: &[usize; 2]| self.made[alarm][which].is_none();
        let Some([alarm, which]) = due.into_iter().chain(all).find(missing) else { return false };
        let raised = self.alarms()[alarm].raised;
        let estimate = marginal(watched, &run.judged.settings.placing, raised, raised + AFTER[which]);
        self.made[alarm][which] = Some(estimate);
        self.is_working()
    }

    /// Whether estimates are missing.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.made.iter().flatten().any(Option::is_none)
    }

    /// The detector whose alarms are placed; none where neither judges.
    #[must_use]
    pub fn detector(&self) -> Option<Method> {
        self.detector
    }

    /// Its alarms in the whole run, in order.
    #[must_use]
    pub fn alarms(&self) -> &[Alarm] {
        self.key.as_ref().map_or(&[], |key| &key.alarms)
    }

    /// The last alarm that was raised by a time (s). A playback position is rounded: that of the alarm counts as the alarm's.
    #[must_use]
    pub fn alarm_at(&self, time: f64) -> Option<Alarm> {
        self.number_at(time).map(|alarm| self.alarms()[alarm])
    }

    fn number_at(&self, time: f64) -> Option<usize> {
        self.alarms().iter().rposition(|alarm| alarm.raised <= time + 1e-9)
    }

    /// Which alarm counts at a time (s), and the last of its estimates that is not later.
    fn due(&self, time: f64) -> Option<(usize, Option<usize>)> {
        let alarm = self.number_at(time)?;
        let passed = |after: &&f64| self.alarms()[alarm].raised + **after <= time + 1e-9;
        let made = self.made[alarm].len();
        Some((alarm, AFTER.iter().take(made).take_while(passed).count().checked_sub(1)))
    }

    /// The alarm that stands at a time (s), and the longest of [`AFTER`] since it that is not longer than what has passed less `lag` (s).
    #[must_use]
    pub fn passed(&self, time: f64, lag: f64) -> Option<(Alarm, f64)> {
        let alarm = self.alarm_at(time).filter(|alarm| alarm.cleared.is_none_or(|cleared| cleared > time))?;
        let after = AFTER.into_iter().rfind(|after| alarm.raised + after + lag <= time + 1e-9)?;
        Some((alarm, after))
    }

    /// What is known at a time (s); none before an alarm, once its contact has been left, and where contacts are not placed.
    #[must_use]
    pub fn at(&self, time: f64) -> Option<Shown<'_>> {
        let (number, due) = self.due(time)?;
        let (alarm, due) = (self.alarms()[number], due?);
        if alarm.cleared.is_some_and(|cleared| cleared <= time) {
            return None;
        }
        let place = |which: usize| match &self.made[number][which] {
            None => Place::Due,
            Some(None) => Place::Unknown,
            Some(Some(estimate)) => Place::At(estimate),
        };
        Some(Shown { alarm, first: place(0), latest: place(due), after: AFTER[due] })
    }

    /// Whether the tracker's noise is taken on trust, for it could not be measured.
    #[must_use]
    pub fn is_unmeasured(&self) -> bool {
        self.unmeasured
    }

    /// How seldom white innovations look like those of the run, where that is so seldom that they are not taken for white.
    #[must_use]
    pub fn suspect(&self) -> Option<f64> {
        self.whiteness.map(|whiteness| whiteness.p_value).filter(|p| *p < SUSPECT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::run::simulate;
    use centrode_core::scenario::preset::find;
    use centrode_core::scenario::{Plan, Threshold};

    fn bench() -> Run {
        let mut scenario = find("bench").and_then(|preset| preset.scenario()).expect("preset");
        scenario.detection.detectors.set(Method::Cusum, true);
        simulate(&scenario).expect("run")
    }

    #[test]
    fn what_is_shown_is_made_first_and_all_of_it_in_the_end() {
        let run = bench();
        let mut placed = Placed::default();
        placed.renew(&run, 0);
        let alarm = *placed.alarms().first().expect("an alarm");
        assert_eq!((alarm.detector, placed.at(alarm.raised - 0.01)), (Method::Cusum, None));
        let late = alarm.raised + 0.6;
        assert!(placed.at(late).is_some_and(|shown| shown.latest == Place::Due && shown.after == 0.5));
        assert!(placed.work(&run, late), "one at a time");
        let shown = placed.at(late).expect("after the alarm");
        assert_eq!((shown.first, shown.alarm), (Place::Due, alarm));
        let width = |estimate: &Estimate| estimate.place.high - estimate.place.low;
        let narrow = width(shown.estimate().expect("made"));
        let steps = 1 + std::iter::repeat_with(|| placed.work(&run, late)).take_while(|more| *more).count();
        assert_eq!((steps, placed.is_working()), (AFTER.len() - 1, false));
        let Some(Shown { first: Place::At(first), .. }) = placed.at(late) else { panic!("made") };
        assert!(width(first) > 2.0 * narrow, "more readings say more");
    }

    #[test]
    fn estimates_stand_while_what_they_are_made_of_does() {
        let mut run = bench();
        let mut placed = Placed::default();
        placed.renew(&run, 0);
        while placed.work(&run, 0.0) {}
        let mut scenario = run.plan.scenario().clone();
        let mut again = |scenario: &centrode_core::scenario::Scenario, placed: &mut Placed| {
            run.update(Plan::new(scenario).expect("possible"));
            placed.renew(&run, 0);
        };
        scenario.detection.xi2 = Threshold::On(0.006);
        again(&scenario, &mut placed);
        assert!(!placed.is_working(), "the alarm of another detector");
        scenario.detection.cusum = Threshold::On(1000.0);
        again(&scenario, &mut placed);
        assert!(placed.is_working(), "a later alarm");
        scenario.detection.cusum = Threshold::OFF;
        again(&scenario, &mut placed);
        assert_eq!((placed.detector(), placed.is_working()), (None, false), "neither judges");
    }

    #[test]
    fn a_contact_that_has_been_left_is_shown_no_more_and_the_next_one_has_its_own_estimates() {
        let mut run = bench();
        let first = *run.judged.first(Method::Cusum).expect("an alarm");
        run.judged.events = vec![
            Event { cleared: Some(first.raised + 1.0), ..first },
            Event { raised: first.raised + 1.5, cleared: None, ..first },
        ];
        let watched = run.judged.watched.as_mut().expect("watched");
        let left = watched.at(first.raised + 1.0).expect("a reading");
        watched.heard[left].cusum = 0.0;
        let mut placed = Placed::default();
        placed.renew(&run, 0);
        while placed.work(&run, first.raised + 2.0) {}
        let shown = |after: f64| placed.at(first.raised + after).map(|shown| (shown.alarm.raised, shown.after));
        assert_eq!(shown(0.5), Some((first.raised, 0.5)));
        assert_eq!(
            (shown(1.2), placed.alarm_at(first.raised + 1.2).map(|alarm| alarm.raised)),
            (None, Some(first.raised))
        );
        assert_eq!(shown(1.76), Some((first.raised + 1.5, 0.25)));
    }
}
