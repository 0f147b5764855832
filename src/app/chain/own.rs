//! The numbers of segments in series that an experiment with one does not have, a row each.

use crate::app::controls::control::Scale;
use crate::app::controls::quantity::{number, parse};
use centrode_core::scenario::ChainScenario;
use centrode_core::scenario::chain::Stands;
use centrode_core::scenario::keys::Quantity;
use std::f64::consts::PI;

/// Of what it is a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Of {
    /// The chosen segment.
    Segment,
    /// The chosen contact.
    Contact,
    /// The whole experiment.
    All,
}

/// A number that can be slid and typed.
#[derive(Debug)]
pub struct Own {
    /// Its key behind that of what it is of.
    pub key: &'static str,
    /// Of what.
    pub of: Of,
    /// Name, also to assistive technology and tests.
    pub label: &'static str,
    /// What it does, in a sentence or two.
    pub tip: &'static str,
    /// What its number is.
    pub quantity: Quantity,
    /// Digits after the point.
    pub decimals: usize,
    /// How values lie along the slider.
    pub scale: Scale,
    /// The word that stands in its place in a file while it is switched off; none where it cannot be.
    pub off: Option<&'static str>,
    /// Ends of the slider, SI, for a segment or contact from 0.
    pub range: fn(&ChainScenario, usize) -> (f64, f64),
    /// The value, SI; none while it is switched off, or where there is none.
    pub get: fn(&ChainScenario, usize) -> Option<f64>,
}

impl Own {
    /// Its path in a file, for a segment or contact from 0.
    #[must_use]
    pub fn path(&self, place: usize) -> String {
        match self.of {
            Of::Segment => format!("segment[{}].{}", place + 1, self.key),
            Of::Contact => format!("contact[{}].{}", place + 1, self.key),
            Of::All => self.key.into(),
        }
    }

    /// The value in the unit shown.
    #[must_use]
    pub fn value(&self, scenario: &ChainScenario, place: usize) -> Option<f64> {
        (self.get)(scenario, place).map(|value| self.quantity.shown(value))
    }

    /// Ends of the slider in the unit shown.
    #[must_use]
    pub fn rail(&self, scenario: &ChainScenario, place: usize) -> (f64, f64) {
        let (low, high) = (self.range)(scenario, place);
        (self.quantity.shown(low), self.quantity.shown(high))
    }

    /// Text and unit of the field.
    #[must_use]
    pub fn text(&self, value: Option<f64>) -> (String, &'static str) {
        match value {
            Some(value) => (number(value, self.decimals), self.quantity.unit()),
            None => (self.off.unwrap_or("–").into(), ""),
        }
    }

    /// What a person typed, SI; none where that switches it off.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn read(&self, text: &str) -> Result<Option<f64>, String> {
        if self.off.is_some_and(|off| text.trim().eq_ignore_ascii_case(off)) {
            return Ok(None);
        }
        parse(self.quantity, text).map(|value| Some(self.quantity.si(value)))
    }
}

fn times(scenario: &ChainScenario, _: usize) -> (f64, f64) {
    (0.0, scenario.common().motion.end)
}

fn turns(_: &ChainScenario, _: usize) -> (f64, f64) {
    (-PI, PI)
}

/// Direction of bending after the motion, and when it turns.
pub static TURN: [Own; 3] = [
    Own {
        key: "motion.delta_end",
        of: Of::Segment,
        label: "Direction δ at the end",
        tip: "Direction of the bending plane after the motion.",
        quantity: Quantity::Angle,
        decimals: 0,
        scale: Scale::Linear(1.0),
        off: None,
        range: turns,
        get: |scenario, segment| Some(scenario.segments.get(segment)?.delta_end),
    },
    Own {
        key: "motion.delta_start",
        of: Of::Segment,
        label: "δ starts to turn",
        tip: "When the bending plane starts to turn.",
        quantity: Quantity::Time,
        decimals: 2,
        scale: Scale::Linear(0.05),
        off: None,
        range: times,
        get: |scenario, segment| Some(scenario.segments.get(segment)?.delta_start),
    },
    Own {
        key: "motion.delta_finish",
        of: Of::Segment,
        label: "δ is turned",
        tip: "When the bending plane has its last direction.",
        quantity: Quantity::Time,
        decimals: 2,
        scale: Scale::Linear(0.05),
        off: None,
        range: times,
        get: |scenario, segment| Some(scenario.segments.get(segment)?.delta_finish),
    },
];

/// What only segments in series have.
pub static BODY: [Own; 2] = [
    Own {
        key: "torsion",
        of: Of::Segment,
        label: "Stiffness in torsion",
        tip: "GJ over EI: about 0.8 for a solid rod, more for tubes that hold each other. Switched off, the segment does not twist at all.",
        quantity: Quantity::Count,
        decimals: 1,
        scale: Scale::Log(0.1),
        off: Some("rigid"),
        range: |_, _| (0.0, 100.0),
        get: |scenario, segment| match scenario.segments.get(segment)?.torsion {
            centrode_core::model::chain::Torsion::Ratio(ratio) => Some(ratio),
            centrode_core::model::chain::Torsion::Rigid => None,
        },
    },
    Own {
        key: "joint_offset",
        of: Of::Segment,
        label: "Joint offset γ",
        tip: "Angle by which the segment's secondary backbones are turned on the pitch circle, so that they pass those of the others.",
        quantity: Quantity::Angle,
        decimals: 0,
        scale: Scale::Linear(1.0),
        off: None,
        range: turns,
        get: |scenario, segment| Some(scenario.segments.get(segment)?.joint_offset),
    },
];

/// Where a contact is.
pub static AT: Own = Own {
    key: "at",
    of: Of::Contact,
    label: "Place on the segment",
    tip: "Arc length of the contact from the base of its segment.",
    quantity: Quantity::Length,
    decimals: 1,
    scale: Scale::Linear(0.1),
    off: None,
    range: |scenario, contact| {
        let length = scenario
            .contacts
            .get(contact)
            .and_then(|contact| scenario.segments.get(contact.segment))
            .map_or(0.03, |segment| segment.alone.scenario().robot.length);
        (0.02 * length, length)
    },
    get: |scenario, contact| Some(scenario.contacts.get(contact)?.at),
};

/// Since when it stands.
pub static TIME: Own = Own {
    key: "time",
    of: Of::Contact,
    label: "Stands from",
    tip: "From this time on the beam stands where the backbone is then.",
    quantity: Quantity::Time,
    decimals: 2,
    scale: Scale::Linear(0.01),
    off: None,
    range: times,
    get: |scenario, contact| match scenario.contacts.get(contact)?.stands {
        Stands::From { time, .. } | Stands::Clamped { time } => Some(time),
        Stands::Always { .. } => None,
    },
};

/// How a plane is turned.
pub static TILT: Own = Own {
    key: "tilt",
    of: Of::Contact,
    label: "Tilt",
    tip: "Angle by which the plane's normal is turned out of the bending plane, about the backbone.",
    quantity: Quantity::Angle,
    decimals: 0,
    scale: Scale::Linear(1.0),
    off: None,
    range: |_, _| (-0.5 * PI, 0.5 * PI),
    get: |scenario, contact| match scenario.contacts.get(contact)?.stands {
        Stands::From { tilt, .. } => Some(tilt),
        _ => None,
    },
};

/// Where a plane stands that is given by its normal.
pub static OFFSET: Own = Own {
    key: "offset",
    of: Of::Contact,
    label: "Offset of the plane",
    tip: "Distance of the plane from the base of the robot, along its normal.",
    quantity: Quantity::Length,
    decimals: 2,
    scale: Scale::Linear(0.05),
    off: None,
    range: |_, _| (-0.1, 0.1),
    get: |scenario, contact| match scenario.contacts.get(contact)?.stands {
        Stands::Always { offset, .. } => Some(offset),
        _ => None,
    },
};

/// Thresholds of the screw motion deviation.
pub static SCREW: [Own; 2] = [
    Own {
        key: "detection.smd_distance",
        of: Of::All,
        label: "ξd (screw axis distance)",
        tip: "The screw motion deviation alarms where the screw axes are farther apart than this at the end disk.",
        quantity: Quantity::Length,
        decimals: 2,
        scale: Scale::Linear(0.1),
        off: None,
        range: |_, _| (0.0, 0.02),
        get: |scenario, _| Some(scenario.smd?.distance),
    },
    Own {
        key: "detection.smd_angle",
        of: Of::All,
        label: "ξα (screw axis angle)",
        tip: "The screw motion deviation alarms where the angle between the screw axes is larger than this.",
        quantity: Quantity::Angle,
        decimals: 1,
        scale: Scale::Linear(0.5),
        off: None,
        range: |_, _| (0.0, 0.5),
        get: |scenario, _| Some(scenario.smd?.angle),
    },
];

/// All of them.
pub fn all() -> impl Iterator<Item = &'static Own> {
    TURN.iter().chain(&BODY).chain([&AT, &TIME, &TILT, &OFFSET]).chain(&SCREW)
}
