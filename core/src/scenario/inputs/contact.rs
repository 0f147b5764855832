//! What the backbone meets.

use serde::{Deserialize, Serialize};
use std::num::NonZeroU64;

/// A fixed beam that meets the backbone; holds while the bend is beyond its value at contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "ContactKeys", into = "ContactKeys")]
pub struct Contact {
    /// Where along the backbone (the paper tests disks 1, 2, 3; default disk 2).
    pub place: Place,
    /// When, or at which bend (default 5.80 s, illustrative: it gives Table II's detection time for disk 2).
    pub start: Start,
    /// How it holds the backbone.
    pub kind: ContactKind,
    /// Radius of a round beam and of the backbone's round envelope together, m (illustrative). For [`ContactKind::Cylinder`].
    pub rounding: f64,
}

impl Default for Contact {
    fn default() -> Self {
        Self { place: Place::disk(2), start: Start::Time(5.80), kind: ContactKind::Clamp, rounding: 0.0035 }
    }
}

/// How a beam holds the backbone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ContactKind {
    /// As the paper has it (Eqs. 20–23): position and slope are held, and the part below keeps its shape.
    #[default]
    Clamp,
    /// A flat, frictionless side against a disk: only the position along its normal is held.
    Plane,
    /// A round, frictionless beam against the backbone's round envelope, along which the contact slides.
    Cylinder,
}

impl ContactKind {
    /// All of them.
    pub const ALL: &[Self] = &[Self::Clamp, Self::Plane, Self::Cylinder];

    /// What it is shown beside: a flat beam that only touches, or a clamp where it is flat itself.
    #[must_use]
    pub fn other(self) -> Self {
        if self == Self::Plane { Self::Clamp } else { Self::Plane }
    }

    /// As files have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Clamp => "clamp",
            Self::Plane => "plane",
            Self::Cylinder => "cylinder",
        }
    }
}

/// Where the beam meets the backbone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// No beam.
    Nowhere,
    /// At a spacer disk, counted from 1 at the base.
    Disk(NonZeroU64),
    /// At an arc length, m.
    ArcLength(f64),
}

impl Place {
    /// At the spacer disk of this number; 0 is nowhere.
    #[must_use]
    pub fn disk(number: u64) -> Self {
        NonZeroU64::new(number).map_or(Self::Nowhere, Self::Disk)
    }
}

/// When the beam meets the backbone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Start {
    /// At the bend commanded at this time, s.
    Time(f64),
    /// At this bend φ, rad.
    Bend(f64),
}

/// [`Contact`] as the file's keys.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ContactKeys {
    #[serde(skip_serializing_if = "Option::is_none")]
    disk: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    arc_length: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bend: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    kind: Option<ContactKind>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rounding: Option<f64>,
}

impl TryFrom<ContactKeys> for Contact {
    type Error = &'static str;

    fn try_from(keys: ContactKeys) -> Result<Self, Self::Error> {
        let default = Self::default();
        let place = match (keys.disk, keys.arc_length) {
            (Some(_), Some(_)) => {
                return Err("holds both disk and arc_length; only one of them is allowed");
            }
            (Some(disk), None) => Place::disk(disk),
            (None, Some(s)) => Place::ArcLength(s),
            (None, None) => default.place,
        };
        let start = match (keys.time, keys.bend) {
            (Some(_), Some(_)) => {
                return Err("holds both time and bend; only one of them is allowed");
            }
            (Some(time), None) => Start::Time(time),
            (None, Some(bend)) => Start::Bend(bend),
            (None, None) => default.start,
        };
        let (kind, rounding) = (keys.kind.unwrap_or(default.kind), keys.rounding.unwrap_or(default.rounding));
        Ok(Self { place, start, kind, rounding })
    }
}

impl From<Contact> for ContactKeys {
    fn from(contact: Contact) -> Self {
        let (disk, arc_length) = match contact.place {
            Place::Nowhere => (Some(0), None),
            Place::Disk(disk) => (Some(disk.get()), None),
            Place::ArcLength(s) => (None, Some(s)),
        };
        let (time, bend) = match contact.start {
            Start::Time(time) => (Some(time), None),
            Start::Bend(bend) => (None, Some(bend)),
        };
        let (kind, rounding) = (Some(contact.kind), Some(contact.rounding));
        Self { disk, arc_length, time, bend, kind, rounding }
    }
}
