//! What the cells of a row are taken for.

use crate::record::log::error::{LogError, quoted};
use crate::record::log::header::{Column, Origin, Role};
use crate::record::log::units::Unit;

/// Where a value stands, and its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Slot {
    /// Place in the row, from 0.
    pub place: usize,
    /// Unit of the number.
    pub unit: Unit,
    /// Numbers in SI go this far either way.
    pub most: f64,
    /// Header, for messages.
    pub header: String,
}

/// How the marker's orientation is written.
#[derive(Debug, Clone, PartialEq)]
pub enum Turn {
    /// Azimuth, elevation, roll.
    Euler([Slot; 3]),
    /// Scalar first.
    Quaternion([Slot; 4]),
    /// Rotation vector.
    Vector([Slot; 3]),
}

/// How the command is written.
#[derive(Debug, Clone, PartialEq)]
pub enum Ordered {
    /// Bend, and δ where there is one.
    Bend(Slot, Option<Slot>),
    /// θL, and δ where there is one.
    ThetaL(Slot, Option<Slot>),
    /// Joint values.
    Joints([Slot; 3]),
}

/// The plan of a row.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Time.
    pub time: Slot,
    /// Nanoseconds beside whole seconds.
    pub nanoseconds: Option<Slot>,
    /// Position.
    pub position: Option<[Slot; 3]>,
    /// Orientation.
    pub turn: Option<Turn>,
    /// Command.
    pub ordered: Option<Ordered>,
    /// Load cells.
    pub forces: Option<[Slot; 3]>,
    /// Quality, and whether its words count.
    pub quality: Option<Slot>,
}

const POSITION: [Role; 3] = [Role::X, Role::Y, Role::Z];
const EULER: [Role; 3] = [Role::Azimuth, Role::Elevation, Role::Roll];
const QUATERNION: [Role; 4] = [Role::Qw, Role::Qx, Role::Qy, Role::Qz];
const VECTOR: [Role; 3] = [Role::Rx, Role::Ry, Role::Rz];
const JOINTS: [Role; 3] = [Role::Q1, Role::Q2, Role::Q3];
const FORCES: [Role; 3] = [Role::Tau1, Role::Tau2, Role::Tau3];

impl Row {
    /// From the columns of a file with its header in `line`; columns that are not needed lose their role.
    ///
    /// # Errors
    /// When the time is missing, a part of what belongs together, or everything.
    pub fn new(columns: &mut [Column], line: u64, notes: &mut Vec<String>) -> Result<Self, LogError> {
        let position = group(columns, POSITION, line, notes)?;
        let euler = group(columns, EULER, line, notes)?;
        let quaternion = group(columns, QUATERNION, line, notes)?;
        let vector = group(columns, VECTOR, line, notes)?;
        let joints = group(columns, JOINTS, line, notes)?;
        let forces = group(columns, FORCES, line, notes)?;
        let turn = match (euler, quaternion, vector) {
            (Some(euler), ..) => Some(Turn::Euler(euler)),
            (_, Some(quaternion), _) => Some(Turn::Quaternion(quaternion)),
            (.., vector) => vector.map(Turn::Vector),
        };
        let delta = slot(columns, Role::Delta);
        let ordered = match (slot(columns, Role::Bend), slot(columns, Role::ThetaL), joints) {
            (Some(bend), ..) => Some(Ordered::Bend(bend, delta)),
            (_, Some(theta_l), _) => Some(Ordered::ThetaL(theta_l, delta)),
            (.., joints) => joints.map(Ordered::Joints),
        };
        // Of two ways to write the same one is read.
        match &turn {
            Some(Turn::Euler(_)) => leave(columns, &[&QUATERNION[..], &VECTOR].concat()),
            Some(Turn::Quaternion(_)) => leave(columns, &VECTOR),
            _ => {}
        }
        match &ordered {
            Some(Ordered::Bend(..)) => leave(columns, &[&[Role::ThetaL][..], &JOINTS].concat()),
            Some(Ordered::ThetaL(..)) => leave(columns, &JOINTS),
            Some(Ordered::Joints(_)) | None => leave(columns, &[Role::Delta]),
        }
        if turn.is_some() && position.is_none() {
            return Err(LogError::line(line, "there is an orientation, but no position: name columns x, y and z"));
        }
        if position.is_none() && ordered.is_none() && forces.is_none() {
            let headers = columns.iter().take(12).map(|column| column.header.as_str()).collect::<Vec<_>>().join(", ");
            let what = format!(
                "neither a position (x, y, z) nor a command (theta_l, bend, or q1, q2, q3) nor load cells (tau_1, tau_2, \
                 tau_3) among the columns {}",
                quoted(headers.as_bytes())
            );
            return Err(LogError::line(line, what).or(": say what they are with --map name=column"));
        }
        let time = slot(columns, Role::Time).ok_or_else(|| {
            LogError::line(line, "no column is the time: name it \"time [s]\"").or(", or use --map time=column")
        })?;
        Ok(Self { time, nanoseconds: None, position, turn, ordered, forces, quality: slot(columns, Role::Quality) })
    }
}

fn slot(columns: &[Column], role: Role) -> Option<Slot> {
    let column = columns.iter().find(|column| column.role == Some(role))?;
    let (unit, most) = (column.scale(), role.dimension().most());
    Some(Slot { place: column.place, unit, most, header: column.header.clone() })
}

fn leave(columns: &mut [Column], roles: &[Role]) {
    for column in columns {
        column.role = column.role.filter(|role| !roles.contains(role));
    }
}

/// Columns that are of use together only.
fn group<const N: usize>(
    columns: &mut [Column],
    roles: [Role; N],
    line: u64,
    notes: &mut Vec<String>,
) -> Result<Option<[Slot; N]>, LogError> {
    let slots = roles.map(|role| slot(columns, role));
    let missing: Vec<_> =
        roles.iter().zip(&slots).filter(|(_, slot)| slot.is_none()).map(|(role, _)| role.key()).collect();
    if let Some(slots) = slots.into_iter().collect::<Option<Vec<_>>>() {
        return Ok(slots.try_into().ok());
    }
    let there: Vec<&Column> =
        columns.iter().filter(|column| column.role.is_some_and(|role| roles.contains(&role))).collect();
    let Some(first) = there.first() else { return Ok(None) };
    let what = format!("{} is there without {}", first.header, missing.join(", "));
    if there.iter().any(|column| column.origin > Origin::Guessed) {
        return Err(LogError::line(line, what));
    }
    notes.push(format!("{what}: not used"));
    leave(columns, &roles);
    Ok(None)
}
