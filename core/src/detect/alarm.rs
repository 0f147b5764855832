//! Evidence against thresholds: crossings, and the events that a person wants to hear of.

use super::evidence::Judgement;
use super::judge::Settings;
use super::statistic::Method;
use crate::model::{Configuration, Location, Rate, locate};
use serde::Serialize;

/// A threshold crossed upward.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Crossing {
    /// Which value crossed.
    pub method: Method,
    /// When, s.
    pub time: f64,
    /// θL commanded then, rad.
    pub theta_l: f64,
    /// The value: ‖c_m − c_s‖ in m, or Θ in N·m.
    pub value: f64,
    /// The threshold: ξ2 in m, or ξ1 in N·m.
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
    /// The value that raised it: ‖c_m − c_s‖ in m, or Θ in N·m.
    pub value: f64,
    /// The threshold then: ξ2 in m, or ξ1 in N·m.
    pub threshold: f64,
    /// θL commanded then, rad.
    pub theta_l: f64,
    /// Where Eq. 24 places the contact then; none for a detector that does not say.
    #[serde(skip)]
    pub location: Option<Location>,
}

/// The first alarm of the centrode, with the place that Eq. 24 gives it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
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
    /// The first of some events that places its contact.
    #[must_use]
    pub fn first(events: &[Event]) -> Option<Self> {
        events.iter().find_map(|event| {
            let Location { arc_length, distance } = event.location?;
            Some(Self { time: event.raised, theta_l: event.theta_l, location: arc_length, distance })
        })
    }
}

/// The state of one detector.
#[derive(Debug, Clone)]
struct Lamp {
    detector: Method,
    above: bool,
    /// Place of the event that stands, among all events.
    standing: Option<usize>,
    /// Since when its value has been low, s.
    low_since: Option<f64>,
}

/// All detectors, one instant after the other. What it keeps grows with the events, and with the crossings unless they are taken.
#[derive(Debug, Clone)]
pub struct Alarms {
    settings: Settings,
    lamps: Vec<Lamp>,
    crossings: Vec<Crossing>,
    events: Vec<Event>,
}

impl Alarms {
    /// Before the first instant, with every detector.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        let lamp = |detector| Lamp { detector, above: false, standing: None, low_since: None };
        Self {
            settings: settings.clone(),
            lamps: Method::ALL.map(lamp).into(),
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
            let Some(above) = statistic.above(threshold) else { continue };
            let (theta_l, value) = (configuration.theta_l(), statistic.value);
            let was = std::mem::replace(&mut lamp.above, above);
            if above && !was {
                crossings.push(Crossing { method, time, theta_l, value, threshold });
            }
            match lamp.standing {
                None if above => {
                    let location = (method == Method::Fcd)
                        .then(|| {
                            locate(settings.segment.length, *configuration, Rate::BENDING, &judgement.sensor_centrode)
                        })
                        .flatten();
                    (lamp.standing, lamp.low_since) = (Some(events.len()), None);
                    let (detector, raised, cleared) = (method, time, None);
                    events.push(Event { detector, raised, cleared, value, threshold, theta_l, location });
                }
                Some(place) => {
                    let low = statistic.above(thresholds.release * threshold) == Some(false);
                    lamp.low_since = low.then(|| lamp.low_since.unwrap_or(time));
                    if lamp.low_since.is_some_and(|since| time - since >= thresholds.hold) {
                        events[place].cleared = Some(time);
                        lamp.standing = None;
                    }
                }
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
