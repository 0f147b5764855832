//! What becomes of a contact in a simulated run: it is met, and may be left again.

use crate::model::Configuration;
use crate::model::contact::branch::Ending;
use crate::scenario::Plan;
use crate::scenario::plan::PlannedContact;
use serde::Serialize;

/// What happens to a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Happening {
    /// The backbone meets the beam.
    Met,
    /// The motion takes it off the beam again.
    Opened,
    /// Its shape loses its stability, and it snaps off the beam: from then on it is free.
    Snapped,
    /// The beam slides over its end: from then on it is free.
    SlidOff,
    /// It would lie along the round beam from then on, which is not modelled: it is shown free.
    Wrapped,
}

/// An event of the plant. It is truth, which no detector sees.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PlantEvent {
    /// What happens.
    pub what: Happening,
    /// Which of the plan's contacts, counted from 0.
    pub contact: usize,
    /// The first instant of the loop at which it has happened, s.
    pub time: f64,
    /// True bend φ of the whole segment at which it happens, rad.
    pub bend: f64,
}

/// Looks at contacts from one instant to the next.
#[derive(Debug, Clone, Default)]
pub struct Watch {
    held: Option<usize>,
    events: Vec<PlantEvent>,
}

impl Watch {
    /// The next instant: which contact holds in the commanded configuration.
    pub fn look(&mut self, plan: &Plan, time: f64, configuration: &Configuration, held: Option<usize>) {
        let before = std::mem::replace(&mut self.held, held);
        if before == held {
            return;
        }
        if let Some(contact) = before {
            let (what, bend) = left(&plan.contacts()[contact], plan.true_robot().bend(configuration.bend()));
            self.events.push(PlantEvent { what, contact, time, bend });
        }
        if let Some(contact) = held {
            let bend = plan.contacts()[contact].bend;
            self.events.push(PlantEvent { what: Happening::Met, contact, time, bend });
        }
    }

    /// What has happened so far, in order.
    #[must_use]
    pub fn events(&self) -> &[PlantEvent] {
        &self.events
    }

    /// The first instant in contact so far, s.
    #[must_use]
    pub fn contact_time(&self) -> Option<f64> {
        self.events.iter().find(|event| event.what == Happening::Met).map(|event| event.time)
    }
}

/// How a contact ended that holds no more at a bend (rad), and at which bend.
fn left(contact: &PlannedContact, bend: f64) -> (Happening, f64) {
    match contact.branch().and_then(|branch| branch.ending()) {
        Some((at, how)) if contact.side * (bend - at) > 0.0 => match how {
            Ending::Snaps => (Happening::Snapped, at),
            Ending::SlidesOff => (Happening::SlidOff, at),
            Ending::Wraps => (Happening::Wrapped, at),
            Ending::Opens => (Happening::Opened, at),
        },
        _ => (Happening::Opened, contact.bend),
    }
}
