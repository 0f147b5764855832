//! Evidence against thresholds: crossings, and the events that a person wants to hear of.

use super::evidence::Judgement;
use super::judge::Settings;
use super::latch::{Latch, Turn};
use super::statistic::Method;
use crate::model::{Configuration, Location, Rate, locate};
use serde::Serialize;

/// A threshold crossed upward.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Crossing {
    /// Which value crossed.
    pub method: Method,
    /// When, s.
    pub time: f64,
    /// θL commanded then, rad.
    pub theta_l: f64,
    /// The value, SI, in the unit of the method's [`Method::quantity`].
    pub value: f64,
    /// The threshold, likewise.
    pub threshold: f64,
}

/// A contact as one detector knows it, from its alarm until the value has fallen again.
///
/// It is raised when the value exceeds the threshold, and cleared once the value has stayed at or below `detection.release` of it
/// for `detection.hold`: noise around a threshold is one event, not many, and none is shorter than that.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Event {
    /// The detector.
    pub detector: Method,
    /// When it was raised, s.
    pub raised: f64,
    /// When it was cleared, s; none while it stands at the end.
    pub cleared: Option<f64>,
    /// The value that raised it, SI, in the unit of the detector's [`Method::quantity`].
    pub value: f64,
    /// The threshold then, likewise.
    pub threshold: f64,
    /// θL commanded then, rad.
    pub theta_l: f64,
    /// Where Eq. 24 places the contact: at the first crossing of the event at which it has an answer; none for a detector that does
    /// not say.
    #[serde(skip)]
    pub detection: Option<Detection>,
}

/// An alarm of the centrode, with the place that Eq. 24 gives it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Detection {
    /// When, s.
    pub time: f64,
    /// θL commanded then, rad.
    pub theta_l: f64,
    /// Estimated arc length of the contact, m.
    pub location: f64,
    /// ‖c_c(location) − c_s‖, m: how well the estimate explains the sensor.
    pub distance: f64,
}

impl Detection {
    /// Of the first of some events of [`Method::Fcd`] that places its contact: what the paper detects.
    #[must_use]
    pub fn first(events: &[Event]) -> Option<Self> {
        events.iter().filter(|event| event.detector == Method::Fcd).find_map(|event| event.detection)
    }
}

/// The state of one detector.
#[derive(Debug, Clone)]
struct Lamp {
    detector: Method,
    latch: Latch,
    /// Place of its last event, among all events.
    last: usize,
}

/// The detectors that judge, one instant after the other. What it keeps grows with the events, and with the crossings unless they are
/// taken.
#[derive(Debug, Clone)]
pub struct Alarms {
    settings: Settings,
    lamps: Vec<Lamp>,
    crossings: Vec<Crossing>,
    events: Vec<Event>,
}

impl Alarms {
    /// Before the first instant.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        let lamp = |detector| Lamp { detector, latch: Latch::default(), last: 0 };
        Self {
            settings: settings.clone(),
            lamps: settings.thresholds.detectors.iter().map(lamp).collect(),
            crossings: Vec::new(),
            events: Vec::new(),
        }
    }

    /// Judges the next instant.
    pub fn look(&mut self, time: f64, configuration: &Configuration, judgement: &Judgement) {
        let Self { settings, lamps, crossings, events } = self;
        let thresholds = &settings.thresholds;
        for lamp in lamps {
            let method = lamp.detector;
            let Some(threshold) = method.threshold(judgement, thresholds) else { continue };
            let statistic = method.statistic(judgement, time, thresholds);
            let Some(above) = statistic.above(threshold) else {
                lamp.latch.unknown();
                continue;
            };
            let (theta_l, value) = (configuration.theta_l(), statistic.value);
            let low = statistic.above(thresholds.release * threshold) == Some(false);
            let (crossed, turn) = lamp.latch.look(time, above, low, thresholds.hold);
            if crossed {
                crossings.push(Crossing { method, time, theta_l, value, threshold });
            }
            let detect = || {
                let sensor = method.places().then_some(&judgement.sensor_centrode)?;
                let Location { arc_length, distance } =
                    locate(settings.assumption, settings.segment.length, *configuration, Rate::BENDING, sensor)?;
                Some(Detection { time, theta_l, location: arc_length, distance })
            };
            match turn {
                Some(Turn::Raised) => {
                    lamp.last = events.len();
                    let (detector, raised, cleared) = (method, time, None);
                    let detection = detect();
                    events.push(Event { detector, raised, cleared, value, threshold, theta_l, detection });
                }
                _ if crossed && events[lamp.last].detection.is_none() => events[lamp.last].detection = detect(),
                Some(Turn::Cleared) => events[lamp.last].cleared = Some(time),
                None => {}
            }
        }
    }

    /// Threshold crossings so far, in order.
    #[must_use]
    pub fn crossings(&self) -> &[Crossing] {
        &self.crossings
    }

    /// Takes the crossings so far out, so that a long run does not gather them.
    pub fn take_crossings(&mut self) -> Vec<Crossing> {
        std::mem::take(&mut self.crossings)
    }

    /// Events so far, in the order in which they were raised.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Crossings and events, at the end.
    #[must_use]
    pub fn finish(self) -> (Vec<Crossing>, Vec<Event>) {
        (self.crossings, self.events)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Vec3;
    use crate::scenario::{Plan, Scenario, Threshold};

    /// Events of a deviation (m) every 0.01 s from 0 s on, with ξ2 = 10 mm, release at 8 mm after 0.1 s.
    fn events(deviations: &[f64]) -> Vec<Event> {
        let mut scenario = Scenario::default();
        scenario.detection.armed_from = 0.0;
        scenario.detection.xi1 = Threshold::OFF;
        scenario.detection.xi2 = Threshold::On(0.010);
        (scenario.detection.release, scenario.detection.hold) = (0.8, 0.095);
        let settings = Settings::of(&Plan::new(&scenario).expect("valid"));
        let mut alarms = Alarms::new(&settings);
        for (k, &deviation) in deviations.iter().enumerate() {
            let sensor_centrode = Vec3::new(0.001, 0.0, 0.01);
            let judgement = Judgement { sensor_centrode, deviation, speed: 1.0, ..Judgement::UNDEFINED };
            alarms.look(k as f64 * 0.01, &Configuration::new(0.5, 0.0), &judgement);
        }
        alarms.finish().1
    }

    #[test]
    fn an_event_ends_once_its_value_has_stayed_low() {
        let part = |value: f64, count: usize| vec![value; count];
        let times = |parts: &[Vec<f64>]| -> Vec<(f64, Option<f64>)> {
            let round = |time: f64| (time * 100.0).round() / 100.0;
            events(&parts.concat()).iter().map(|event| (round(event.raised), event.cleared.map(round))).collect()
        };
        // Up, between release and threshold, up again: one event that stands at the end.
        let noise = [part(0.0, 5), part(0.012, 3), part(0.009, 30), part(0.011, 2)];
        assert_eq!(times(&noise), [(0.05, None)]);
        // Low too briefly, then long enough, then another.
        let two = [part(0.012, 2), part(0.007, 9), part(0.009, 1), part(0.008, 12), part(0.012, 1)];
        assert_eq!(times(&two), [(0.0, Some(0.22)), (0.24, None)]);
        // What is not defined in between is not low.
        let gap = [part(0.012, 1), part(0.0, 1), part(f64::NAN, 50), part(0.0, 1), part(f64::NAN, 50)];
        assert_eq!(times(&gap), [(0.0, None)]);
        assert!(events(&[0.0, 0.012])[0].detection.is_some_and(|detection| detection.time == 0.01));
    }
}
