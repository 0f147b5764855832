//! Segments in series (docs/CHAIN.md): one configuration of them, as `centrode model --chain` reads it, and whole experiments.

mod draft;
mod group;
mod inputs;
mod plan;
mod read;

use crate::model::Configuration;
use crate::model::chain::{Contact, Rod, Settled, Torsion, Unsettled, settle, stiffnesses};
use crate::model::configuration::bend_from_theta_l;
use crate::scenario::keys::allowed::Limit;
use crate::scenario::keys::{self, Allowed, Quantity, Value};
use crate::scenario::plan::{LENGTHS, MAX_TURN};
use crate::scenario::refusal::ScenarioError;
use crate::scenario::{Scenario, Tube};
use group::Group;
use std::f64::consts::TAU;
use std::fmt;
use thiserror::Error;
use toml::de::DeTable;

pub use crate::model::chain::path::Stands;
pub use draft::{ChainDraft, Change};
pub use inputs::{ChainContact, ChainScenario, ChainSegment, Smd, Tracked};
pub use plan::ChainPlan;

/// A chain with the configuration of each segment and what it meets: what follows can be solved or has no stable shape.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainSetup {
    /// From the base.
    pub rods: Vec<Rod>,
    /// Of each segment.
    pub configurations: Vec<Configuration>,
    /// In the order of the file.
    pub contacts: Vec<Contact>,
}

/// Why a file is refused: at which line, and what is allowed there.
#[derive(Debug, Clone, PartialEq, Error)]
pub struct ChainError {
    /// From 1; none where the fault is the text's as a whole.
    pub line: Option<usize>,
    /// What is wrong.
    pub fault: Fault,
}

/// What is wrong with a file.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Fault {
    /// As in a scenario.
    #[error("{0}")]
    Scenario(ScenarioError),
    /// A key that is needed.
    #[error("{key} is missing: {allowed}")]
    Missing {
        /// Dotted key.
        key: String,
        /// What it would have to be.
        allowed: String,
    },
}

impl fmt::Display for ChainError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.fault),
            None => write!(f, "{}", self.fault),
        }
    }
}

/// More segments and contacts than this are refused: the work grows with the third power of their number.
pub const MOST: usize = 12;

const SEGMENT: [&str; 7] = ["length", "bending_stiffness", "primary", "secondary", "torsion", "theta_l", "delta"];
const CONTACT: [&str; 4] = ["segment", "at", "normal", "offset"];
const TUBE: [&str; 3] = ["outer_diameter", "inner_diameter", "youngs_modulus"];

const STIFFNESS: &str = "a bending stiffness from 1e-12 to 1e12 N·m², or tubes (primary and secondary)";
const EVERY: &str =
    "bending_stiffness for every segment or tubes for every segment: distal tubes run inside proximal ones";
const TORSION: &str = "a stiffness in torsion over that in bending, GJ/EI, from 1e-3 to 1e6, or \"rigid\"";
const NORMAL: &str = "a unit vector [x, y, z], its length 1 to six digits";
/// A unit vector's length may be this far from 1.
const UNIT: f64 = 1e-6;
/// A contact at the base cannot be met: it stands at least this share of the length above it.
const ABOVE_BASE: f64 = 1e-5;
/// What is nearer than this share of the length to the end disk is the end disk, written with rounding.
const AT_END: f64 = 1e-12;

impl ChainSetup {
    /// Reads TOML from bytes.
    ///
    /// ```
    /// use centrode_core::scenario::ChainSetup;
    ///
    /// let text = "
    /// [[segment]]
    /// length = 0.03
    /// bending_stiffness = 0.005
    /// torsion = 5
    /// theta_l = 1.0
    ///
    /// [[contact]]
    /// segment = 1
    /// at = 0.015
    /// normal = [1.0, 0.0, 0.0]
    /// offset = 0.001
    /// ";
    /// let setup = ChainSetup::from_bytes(text.as_bytes())?;
    /// assert!(setup.settle().expect("a stable shape").forces[0] > 0.0);
    /// let refused = ChainSetup::from_bytes(text.replace("segment = 1", "segment = 2").as_bytes()).expect_err("only one");
    /// assert_eq!(refused.to_string(), "line 9: contact[1].segment = 2 is not allowed: a whole number from 1 to 1");
    /// # Ok::<(), centrode_core::scenario::ChainError>(())
    /// ```
    ///
    /// # Errors
    /// The first thing that is wrong, with its line and key and what is allowed.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ChainError> {
        let text = group::text(bytes)?;
        let table = group::parsed(text)?;
        let spans = DeTable::parse(text).ok();
        let top = Group::top(text, &table, spans.as_ref().map(|spans| spans.get_ref()));
        top.knows(&["segment", "contact"])?;
        let segments = top.tables("segment", MOST)?;
        if segments.is_empty() {
            return Err(top.missing("segment", "one table [[segment]] for each segment, from the base"));
        }
        let mut rods = Vec::new();
        let stiffness = bending_stiffnesses(&segments)?;
        let mut configurations = Vec::new();
        for (segment, bending_stiffness) in segments.iter().zip(stiffness) {
            segment.knows(&SEGMENT)?;
            let length = segment.number("length", Quantity::Length, between(LENGTHS.0, LENGTHS.1), None)?;
            rods.push(Rod { length, bending_stiffness, torsion: torsion(segment)? });
            configurations.push(configuration(segment)?);
        }
        let contacts = top.tables("contact", MOST)?;
        let contacts = contacts.iter().map(|group| contact(group, &rods)).collect::<Result<_, _>>()?;
        Ok(Self { rods, configurations, contacts })
    }

    /// The shape.
    ///
    /// # Errors
    /// When no stable shape is found.
    pub fn settle(&self) -> Result<Settled, Unsettled> {
        settle(&self.rods, &self.configurations, &self.contacts)
    }
}

fn between(least: f64, most: f64) -> Allowed {
    Allowed::Range(Limit::At(least), Limit::At(most))
}

/// Of every segment, N·m²: as given, or of all tubes.
fn bending_stiffnesses(segments: &[Group]) -> Result<Vec<f64>, ChainError> {
    let tubed = |segment: &Group| segment.has("primary") || segment.has("secondary");
    if segments.iter().any(tubed) {
        if let Some(segment) = segments.iter().find(|segment| segment.has("bending_stiffness")) {
            return Err(segment.refuse_as_written("bending_stiffness", Quantity::Count, Allowed::Need(EVERY)));
        }
        if let Some(segment) = segments.iter().find(|segment| !tubed(segment)) {
            return Err(segment.missing("primary", EVERY));
        }
        let robot = Scenario::default().robot;
        let each = segments.iter().map(|segment| {
            let tube = |key, otherwise: &Tube| Ok::<_, ChainError>(tube(segment, key, otherwise)?.bending_stiffness());
            Ok((tube("primary", &robot.primary)?, tube("secondary", &robot.secondary)?))
        });
        return Ok(stiffnesses(&each.collect::<Result<Vec<_>, ChainError>>()?));
    }
    let given = |segment: &Group| {
        if !segment.has("bending_stiffness") {
            return Err(segment.missing("bending_stiffness", STIFFNESS));
        }
        let value = segment.number("bending_stiffness", Quantity::Count, Allowed::Number, None)?;
        if (1e-12..=1e12).contains(&value) {
            return Ok(value);
        }
        Err(segment.refuse("bending_stiffness", Quantity::Count, Value::Number(value), Allowed::Need(STIFFNESS)))
    };
    segments.iter().map(given).collect()
}

/// A tube; what it does not say is as in the default scenario.
fn tube(segment: &Group, key: &'static str, otherwise: &Tube) -> Result<Tube, ChainError> {
    let Some(group) = segment.table(key, "a table of keys: outer_diameter, inner_diameter, youngs_modulus")? else {
        return Ok(otherwise.clone());
    };
    group.knows(&TUBE)?;
    let allowed = |key: &str| keys::find(&format!("robot.primary.{key}")).map_or(Allowed::Number, |key| key.allowed);
    let of = |key, quantity, allowed, default| group.number(key, quantity, allowed, Some(default));
    let outer_diameter = of("outer_diameter", Quantity::Length, allowed("outer_diameter"), otherwise.outer_diameter)?;
    let inside = Allowed::Range(Limit::At(0.0), Limit::Beyond(outer_diameter));
    let inner_diameter = of("inner_diameter", Quantity::Length, inside, otherwise.inner_diameter)?;
    let youngs_modulus = of("youngs_modulus", Quantity::Modulus, allowed("youngs_modulus"), otherwise.youngs_modulus)?;
    Ok(Tube { outer_diameter, inner_diameter, youngs_modulus })
}

fn torsion(segment: &Group) -> Result<Torsion, ChainError> {
    match segment.value("torsion") {
        None => Ok(Torsion::Rigid),
        Some(toml::Value::String(word)) if word == "rigid" => Ok(Torsion::Rigid),
        Some(value) => match group::float(value) {
            Some(ratio) if (1e-3..=1e6).contains(&ratio) => Ok(Torsion::Ratio(ratio)),
            _ => Err(segment.refuse_as_written("torsion", Quantity::Count, Allowed::Need(TORSION))),
        },
    }
}

fn configuration(segment: &Group) -> Result<Configuration, ChainError> {
    let theta_l = segment.number("theta_l", Quantity::Angle, Allowed::Number, None)?;
    if bend_from_theta_l(theta_l).is_nan() || bend_from_theta_l(theta_l).abs() >= TAU {
        return Err(segment.refuse("theta_l", Quantity::Angle, Value::Number(theta_l), Allowed::Turn));
    }
    let delta = segment.number("delta", Quantity::Angle, between(-MAX_TURN, MAX_TURN), Some(0.0))?;
    Ok(Configuration::from_theta_l(theta_l, delta))
}

fn contact(group: &Group, rods: &[Rod]) -> Result<Contact, ChainError> {
    group.knows(&CONTACT)?;
    let segment = group.whole("segment", 1, rods.len())? - 1;
    let length = rods[segment].length;
    let above = Limit::Beyond(ABOVE_BASE * length);
    let at = group.number("at", Quantity::Length, Allowed::Number, None)?;
    let at = if (at - length).abs() <= AT_END * length { length } else { at };
    let on = Allowed::Range(above, Limit::At(length));
    if !on.has(at) {
        return Err(group.refuse("at", Quantity::Length, Value::Number(at), on));
    }
    let normal = group.vector("normal", NORMAL)?;
    if (normal.norm() - 1.0).abs() > UNIT || !normal.norm().is_finite() {
        return Err(group.refuse_as_written("normal", Quantity::Count, Allowed::Need(NORMAL)));
    }
    let offset = group.number("offset", Quantity::Length, between(-1e3, 1e3), None)?;
    Ok(Contact { segment, at, normal, offset })
}
