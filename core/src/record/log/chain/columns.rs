//! Which columns of a CSV file tell of which disk, and what each of them is.

use super::names::{Named, named};
use super::{ChainMapping, Expected};
use crate::record::log::Role;
use crate::record::log::error::{LogError, quoted};
use crate::record::log::header::{Column, Mapping, columns, looks_like, plain, with_unit};
use crate::scenario::chain::Tracked;

/// Whose a column is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Owner {
    All,
    Disk(usize),
    Nobody,
}

/// The columns of a file by disk.
#[derive(Debug)]
pub struct Divided {
    /// Disks (from 0) of which the file tells, each with the columns as its reader takes them.
    pub disks: Vec<(usize, Vec<Column>)>,
    /// Whether joints could be numbered the other way round.
    pub joints_either_way: bool,
}

/// Whether it is of a tracker's reading.
fn reads(role: Role) -> bool {
    Role::POSITION.contains(&role) || Role::ORIENTATION.contains(&role)
}

const BENDS: [Role; 5] = [Role::ThetaL, Role::Bend, Role::Q1, Role::Q2, Role::Q3];

/// What the columns of a header tell.
struct Table<'a> {
    headers: &'a [String],
    named: Vec<Named>,
    roles: Vec<Option<Role>>,
    /// What a person says of each column.
    said: Vec<Option<&'a ChainMapping>>,
    of: &'a Expected,
    /// Whether each row is of one disk.
    long: bool,
}

/// Whether columns of a header tell of disks by their names, so that rows do not.
#[must_use]
pub fn names_disks(headers: &[String], line: u64, mappings: &[ChainMapping], segments: usize) -> bool {
    let told = |rest: &str| looks_like(with_unit(rest).0).is_some_and(reads);
    let by_name = named(headers, line, segments)
        .is_ok_and(|(named, _)| named.iter().any(|of| of.disk.is_some() && told(&of.rest)));
    let mapped = |mapping: &ChainMapping| mapping.disk.is_some() && mapping.mapping.role.is_some_and(reads);
    by_name || mappings.iter().any(mapped)
}

/// Divides the columns of a header. `long` says that each row is of one disk, by another column.
///
/// # Errors
/// When it is not clear what a column is, or of which disk.
pub fn divide(
    headers: &[String],
    line: u64,
    (mappings, of): (&[ChainMapping], &Expected),
    long: bool,
) -> Result<Divided, LogError> {
    let (named, joints_either_way) = named(headers, line, of.segments)?;
    let said = headers
        .iter()
        .enumerate()
        .map(|(place, header)| mappings.iter().find(|said| !said.tells_disk && said.mapping.is_of(place, header)));
    let said: Vec<Option<&ChainMapping>> = said.collect();
    known(headers, line, mappings)?;
    // Beside a q0 they are no joints.
    let scalar_first = named.iter().any(|of| of.disk.is_none() && plain(with_unit(&of.rest).0) == "q0");
    let roles = named.iter().zip(&said).map(|(named, said)| match (said, looks_like(with_unit(&named.rest).0)) {
        (Some(said), _) => said.mapping.role,
        (None, Some(Role::Q1 | Role::Q2 | Role::Q3)) if scalar_first && named.disk.is_none() => Some(Role::Qx),
        (None, role) => role,
    });
    let mut table = Table { headers, roles: roles.collect(), said, named, of, long };
    table.count_repeats();
    let owners = table.owners(line)?;
    let mut disks = Vec::new();
    for disk in 0..of.segments {
        let mine = |owner: &Owner| *owner == Owner::All || *owner == Owner::Disk(disk);
        let tells = |(owner, role): (&Owner, &Option<Role>)| {
            let of_one = long || *owner == Owner::Disk(disk);
            of_one && mine(owner) && role.is_some_and(|role| reads(role) || BENDS.contains(&role))
        };
        let tells = owners.iter().zip(&table.roles).any(tells);
        if tells && of.disk.is_none_or(|only| only == disk || !long) {
            disks.push((disk, table.columns(disk, line, &owners)?));
        }
    }
    if disks.is_empty() {
        let headers = headers.iter().take(12).map(String::as_str).collect::<Vec<_>>().join(", ");
        let what = format!(
            "no column tells of a disk by its name, as x_1, disk1.x or theta_l_1 would, among {}",
            quoted(headers.as_bytes())
        );
        return Err(LogError::line(line, what).or(": say which is which with --map x_1=column"));
    }
    Ok(Divided { disks, joints_either_way })
}

/// Refuses a mapping of a column that there is not.
fn known(headers: &[String], line: u64, mappings: &[ChainMapping]) -> Result<(), LogError> {
    let there =
        |said: &ChainMapping| headers.iter().enumerate().any(|(place, header)| said.mapping.is_of(place, header));
    match mappings.iter().find(|said| !there(said)) {
        None => Ok(()),
        Some(said) => {
            let what = format!("there is no column {}", quoted(said.mapping.column.as_bytes()));
            let allowed = headers.iter().take(40).cloned().collect::<Vec<_>>().join(", ");
            Err(LogError { allowed, ..LogError::line(line, what) })
        }
    }
}

impl Table<'_> {
    /// Columns of one name, as many as there are disks with trackers, are of these in their order.
    fn count_repeats(&mut self) {
        let numbered = |role: Role| self.disks_with(|other| other == role) > 0;
        let wanted = if self.long || self.of.disk.is_some() { 0 } else { self.of.segments };
        let mut found: Vec<(usize, usize)> = Vec::new();
        for (place, role) in self.roles.iter().enumerate() {
            let Some(role) = role.filter(|role| reads(*role) || BENDS.contains(role) || *role == Role::Delta) else {
                continue;
            };
            let same: Vec<usize> =
                (0..self.headers.len()).filter(|other| self.headers[*other] == self.headers[place]).collect();
            if wanted > 1 && same.len() == wanted && !numbered(role) {
                found.extend(same.iter().position(|other| *other == place).map(|disk| (place, disk)));
            }
        }
        for (place, disk) in found {
            self.named[place].disk = Some(disk);
        }
    }

    /// The disk that a column tells by its name, or by what a person says of it.
    fn disk(&self, place: usize) -> Option<usize> {
        self.said[place].map_or(self.named[place].disk, |said| said.disk)
    }

    /// How many columns of some role name their disk.
    fn disks_with(&self, is: impl Fn(Role) -> bool) -> usize {
        (0..self.headers.len())
            .filter(|place| self.disk(*place).is_some() && self.roles[*place].is_some_and(&is))
            .count()
    }

    fn owners(&self, line: u64) -> Result<Vec<Owner>, LogError> {
        let one = |disk: Option<usize>| disk.map_or(Owner::Nobody, Owner::Disk);
        let numbered_readings = self.disks_with(reads) > 0;
        let numbered_bends = self.disks_with(|role| BENDS.contains(&role)) > 0;
        let numbered_delta = self.disks_with(|role| role == Role::Delta) > 0;
        let last = self.of.segments - 1;
        let alone = (last == 0).then_some(0);
        let of_file = self.of.disk;
        let owner = |place: usize| {
            if let Some(disk) = self.disk(place) {
                let reads = self.roles[place].is_some_and(reads);
                return Ok(if reads && self.of.commands_alone { Owner::Nobody } else { Owner::Disk(disk) });
            }
            Ok(match self.roles[place] {
                Some(Role::Time | Role::Quality) => Owner::All,
                Some(role) if reads(role) => match of_file {
                    _ if self.of.commands_alone => Owner::Nobody,
                    _ if self.long => Owner::All,
                    Some(disk) => Owner::Disk(disk),
                    None if numbered_readings => Owner::Nobody,
                    None if self.of.tracked == Tracked::Tip => Owner::Disk(last),
                    None if role == Role::X && alone.is_none() => return Err(self.unnumbered(place, line)),
                    None => one(alone),
                },
                Some(Role::Delta) if numbered_delta => Owner::Nobody,
                Some(Role::Delta) if numbered_bends || self.long => Owner::All,
                Some(role) if BENDS.contains(&role) || role == Role::Delta => match of_file.or(alone) {
                    _ if numbered_bends => Owner::Nobody,
                    _ if self.long => Owner::All,
                    Some(disk) => Owner::Disk(disk),
                    None if role == Role::Delta => Owner::Nobody,
                    None => return Err(self.of_no_segment(place, line)),
                },
                _ => Owner::Nobody,
            })
        };
        (0..self.headers.len()).map(owner).collect()
    }

    fn unnumbered(&self, place: usize, line: u64) -> LogError {
        let segments = self.of.segments;
        let what = format!("does not say which disk it tells of, and {segments} end disks carry trackers");
        let allowed = "names with the disk's number, as in x_1, or a column disk; or tracker.disks = \"tip\"";
        LogError::cell(line, place, &self.headers[place], what, allowed)
    }

    fn of_no_segment(&self, place: usize, line: u64) -> LogError {
        let segments = self.of.segments;
        let what = format!("does not say which of the {segments} segments it commands");
        LogError::cell(line, place, &self.headers[place], what, "names with the segment's number, as in theta_l_1")
    }

    /// The columns as the reader of one disk takes them.
    fn columns(&self, disk: usize, line: u64, owners: &[Owner]) -> Result<Vec<Column>, LogError> {
        let (mut names, mut said) = (Vec::new(), Vec::new());
        for (place, owner) in owners.iter().enumerate() {
            let mine = *owner == Owner::All || *owner == Owner::Disk(disk);
            names.push(if mine { self.named[place].rest.clone() } else { String::new() });
            if let Some(of) = self.said[place].filter(|of| mine || of.mapping.role.is_none()) {
                said.push(Mapping { column: format!("#{}", place + 1), ..of.mapping.clone() });
            }
        }
        let mut columns = columns(&names, line, &said).map_err(|error| {
            let way = error.way.replace("=column", &format!("_{}=column", disk + 1)).into();
            of_disk(LogError { way, ..error }, disk)
        })?;
        for column in &mut columns {
            column.header.clone_from(&self.headers[column.place]);
            if matches!(column.role, Some(Role::Tau1 | Role::Tau2 | Role::Tau3)) {
                column.role = None;
            }
        }
        Ok(columns)
    }
}

/// A refusal that names the disk.
pub fn of_disk(error: LogError, disk: usize) -> LogError {
    LogError { what: format!("disk {}: {}", disk + 1, error.what), ..error }
}
