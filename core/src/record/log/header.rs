//! Which column of a log is what: by its header, by a guess, or as a person mapped it.

use super::error::{LogError, quoted};
use super::units::{Dimension, Unit};
use serde::{Deserialize, Serialize};
use std::fmt;

macro_rules! roles {
    ($($role:ident, $key:literal, $dimension:ident, [$($alias:literal),*], $sentence:literal;)*) => {
        /// What a column can be.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        pub enum Role { $(#[doc = $sentence] $role),* }

        impl Role {
            /// All of them, in the order of a written log.
            pub const ALL: &'static [Self] = &[$(Self::$role),*];

            /// Its name in headers and in `--map`.
            #[must_use]
            pub const fn key(self) -> &'static str {
                match self { $(Self::$role => $key),* }
            }

            /// What its numbers are.
            #[must_use]
            pub const fn dimension(self) -> Dimension {
                match self { $(Self::$role => Dimension::$dimension),* }
            }

            /// What it means, in a sentence.
            #[must_use]
            pub const fn sentence(self) -> &'static str {
                match self { $(Self::$role => $sentence),* }
            }

            /// Other names, letters and digits alone. A long one also counts at the end of a name.
            const fn aliases(self) -> &'static [&'static str] {
                match self { $(Self::$role => &[$($alias),*]),* }
            }
        }
    };
}

roles! {
    Time, "time", Time, ["t", "timestamp", "stamp", "seconds", "secs", "sec"], "Time of the row.";
    X, "x", Length, ["tx", "px", "positionx", "translationx", "posx", "xpos", "trackerx", "markerx"], "Position of the marker along x.";
    Y, "y", Length, ["ty", "py", "positiony", "translationy", "posy", "ypos", "trackery", "markery"], "Position of the marker along y.";
    Z, "z", Length, ["tz", "pz", "positionz", "translationz", "posz", "zpos", "trackerz", "markerz"], "Position of the marker along z.";
    Azimuth, "azimuth", Angle, ["yaw"], "First Euler angle of the marker, about z.";
    Elevation, "elevation", Angle, ["pitch"], "Second Euler angle, about the new y.";
    Roll, "roll", Angle, [], "Third Euler angle, about the newest x.";
    Qx, "qx", None, ["quatx", "quaternionx", "orientationx"], "Quaternion of the marker: x.";
    Qy, "qy", None, ["quaty", "quaterniony", "orientationy"], "Quaternion of the marker: y.";
    Qz, "qz", None, ["quatz", "quaternionz", "orientationz"], "Quaternion of the marker: z.";
    Qw, "qw", None, ["q0", "quatw", "quaternionw", "orientationw"], "Quaternion of the marker: the scalar.";
    Rx, "rx", Angle, ["rotvecx"], "Rotation vector of the marker: x.";
    Ry, "ry", Angle, ["rotvecy"], "Rotation vector of the marker: y.";
    Rz, "rz", Angle, ["rotvecz"], "Rotation vector of the marker: z.";
    ThetaL, "theta_l", Angle, ["theta", "thetal"], "Commanded θL; a quarter turn is straight.";
    Bend, "bend", Angle, ["bendangle"], "Commanded bend, a quarter turn less θL: small bends keep their digits.";
    Delta, "delta", Angle, [], "Commanded bending-plane angle δ.";
    Q1, "q1", Length, ["joint1"], "Commanded joint value of the first secondary backbone.";
    Q2, "q2", Length, ["joint2"], "Commanded joint value of the second one.";
    Q3, "q3", Length, ["joint3"], "Commanded joint value of the third one.";
    Tau1, "tau_1", Force, ["tau1", "taulc1", "force1", "loadcell1"], "First load cell.";
    Tau2, "tau_2", Force, ["tau2", "taulc2", "force2", "loadcell2"], "Second load cell.";
    Tau3, "tau_3", Force, ["tau3", "taulc3", "force3", "loadcell3"], "Third load cell.";
    Quality, "quality", None, ["valid", "tracked", "visible", "status"], "What the tracker thinks of its reading.";
}

impl Role {
    /// Where a tracker is.
    pub const POSITION: [Self; 3] = [Self::X, Self::Y, Self::Z];
    /// How it is turned: Euler angles, a quaternion or a rotation vector.
    pub const ORIENTATION: [Self; 10] = [
        Self::Azimuth,
        Self::Elevation,
        Self::Roll,
        Self::Qx,
        Self::Qy,
        Self::Qz,
        Self::Qw,
        Self::Rx,
        Self::Ry,
        Self::Rz,
    ];
}

/// An alias as long as this counts at the end of a name, too.
const LONG: usize = 5;

/// How a column came to be what it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// Its name looks like it.
    Guessed,
    /// The format or its name says so.
    Named,
    /// A person said so.
    Mapped,
}

/// One column of a log, as it was understood.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Column {
    /// Where in a row, from 0.
    pub place: usize,
    /// Its header, as it stands in the file.
    pub header: String,
    /// What it is; none for a column that is not used.
    pub role: Option<Role>,
    /// Unit of its numbers.
    pub unit: &'static str,
    /// Whether the header names that unit; otherwise SI is taken.
    pub unit_given: bool,
    /// How that was decided.
    pub origin: Origin,
}

impl Column {
    /// A column that the format itself says what it is, in a given unit.
    #[must_use]
    pub fn fixed(place: usize, header: &str, role: Role, unit: &'static str) -> Self {
        Self { place, header: header.into(), role: Some(role), unit, unit_given: true, origin: Origin::Named }
    }

    /// A column that is not used.
    #[must_use]
    pub fn unused(place: usize, header: &str) -> Self {
        Self { place, header: header.into(), role: None, unit: "", unit_given: false, origin: Origin::Guessed }
    }

    /// What it was taken for, in a few words; none for a column that is not used.
    #[must_use]
    pub fn told(&self) -> Option<String> {
        let role = self.role?;
        let unit = if self.unit_given || self.unit == "1" { "" } else { " (no unit given)" };
        let (key, name) = (role.key(), format!("{} [{}]", role.key(), self.unit));
        let said = self.header == name || self.header == key;
        Some(if said { name } else { format!("{:?} as {name}{unit}", self.header) })
    }

    /// The unit of its numbers.
    #[must_use]
    pub fn scale(&self) -> Unit {
        let dimension = self.role.map_or(Dimension::None, Role::dimension);
        dimension.unit(self.unit).unwrap_or(dimension.si())
    }
}

/// What a mapping calls a column that is not to be used.
const UNUSED: &str = "unused";

/// A column that a person says what it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mapping {
    /// What it is; none for a column that is not to be used, whatever it looks like.
    pub role: Option<Role>,
    /// The unit, where the header does not tell it or tells it wrong.
    pub unit: Option<&'static str>,
    /// The column's header, its name without the unit, or `#` and its number from 1.
    pub column: String,
}

impl Mapping {
    /// Reads `name=column` or `name [unit]=column`, as in `x=Tx (mm)`.
    ///
    /// # Errors
    /// When it is not of that form, or there is no such name or unit.
    pub fn parse(text: &str) -> Result<Self, LogError> {
        let malformed = || LogError::file(format!("{text:?} is no mapping: write name=column, as in x=\"Tx (mm)\""));
        let (key, column) = text.split_once('=').ok_or_else(malformed)?;
        let (key, unit) = with_unit(key.trim());
        let column = column.trim();
        if key.is_empty() || column.is_empty() {
            return Err(malformed());
        }
        if key == UNUSED && unit.is_none() {
            return Ok(Self { role: None, unit: None, column: column.into() });
        }
        let role = Role::ALL.iter().copied().find(|role| role.key() == key).ok_or_else(|| LogError {
            allowed: Role::ALL.iter().map(|role| role.key()).chain([UNUSED]).collect::<Vec<_>>().join(", "),
            ..LogError::file(format!("a log has no column called {key:?}"))
        })?;
        let unit = match unit {
            None => None,
            Some(name) => Some(known_unit(role, name).ok_or_else(|| LogError {
                allowed: role.dimension().names().into(),
                ..LogError::file(format!("{key} has no unit {name:?}"))
            })?),
        };
        Ok(Self { role: Some(role), unit, column: column.into() })
    }

    /// Whether it means the column in a place (from 0) with this header.
    #[must_use]
    pub fn is_of(&self, place: usize, header: &str) -> bool {
        let number = self.column.strip_prefix('#').and_then(|number| number.parse::<usize>().ok());
        header == self.column || with_unit(header).0 == self.column || number == Some(place + 1)
    }
}

impl fmt::Display for Mapping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let key = self.role.map_or(UNUSED, Role::key);
        match self.unit {
            Some(unit) => write!(f, "{key} [{unit}]={}", self.column),
            None => write!(f, "{key}={}", self.column),
        }
    }
}

fn known_unit(role: Role, name: &str) -> Option<&'static str> {
    role.dimension().unit(name).map(|unit| unit.name)
}

/// A header's name and unit: `x [mm]` and `x (mm)`.
pub(super) fn with_unit(header: &str) -> (&str, Option<&str>) {
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((name, unit)) = header.strip_suffix(close).and_then(|rest| rest.rsplit_once(open)) {
            return (name.trim(), Some(unit.trim()));
        }
    }
    (header, None)
}

/// Letters and digits alone, small.
pub(super) fn plain(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// What a name looks like.
fn guessed(name: &str) -> Option<Role> {
    let name = plain(name);
    let is = |role: &Role| {
        let ends = |alias: &&str| alias.len() >= LONG && name.ends_with(*alias);
        let key = plain(role.key());
        name == key
            || role.aliases().contains(&name.as_str())
            || role.aliases().iter().any(ends)
            || (key.len() >= LONG && name.ends_with(&key))
    };
    Role::ALL.iter().copied().find(is)
}

/// A name that ends in a unit of what it looks like: `pos_x_mm`.
fn with_suffix(name: &str) -> Option<(Role, &str)> {
    let (rest, unit) = name.rsplit_once('_').filter(|(_, unit)| !unit.is_empty())?;
    let role = guessed(rest).filter(|role| known_unit(*role, unit).is_some())?;
    guessed(name).is_none().then_some((role, unit))
}

/// What a name without a unit behind it is, or looks like.
pub(super) fn looks_like(name: &str) -> Option<Role> {
    let named = Role::ALL.iter().copied().find(|role| role.key() == name);
    named.or_else(|| guessed(name)).or_else(|| with_suffix(name).map(|(role, _)| role))
}

/// What each column of a header in line `line` is.
///
/// # Errors
/// When a mapping names a column that does not exist, two columns could be the same, or a unit is not known.
pub fn columns(headers: &[String], line: u64, mappings: &[Mapping]) -> Result<Vec<Column>, LogError> {
    let scalar_first = headers.iter().any(|header| plain(with_unit(header).0) == "q0");
    let mut columns = Vec::with_capacity(headers.len());
    for (place, header) in headers.iter().enumerate() {
        let (name, unit) = with_unit(header);
        let mapped = mappings.iter().find(|mapping| mapping.is_of(place, header));
        let (role, origin, unit) = if let Some(mapping) = mapped {
            (mapping.role, Origin::Mapped, mapping.unit.or(unit))
        } else if scalar_first && matches!(name, "q1" | "q2" | "q3") {
            // Beside a q0 they are no joints.
            let role = [Role::Qx, Role::Qy, Role::Qz][usize::from(name.as_bytes()[1] - b'1')];
            (Some(role), Origin::Guessed, unit)
        } else if let Some(role) = Role::ALL.iter().copied().find(|role| role.key() == name) {
            (Some(role), Origin::Named, unit)
        } else {
            match (unit, with_suffix(name)) {
                (None, Some((role, unit))) => (Some(role), Origin::Guessed, Some(unit)),
                _ => (guessed(name), Origin::Guessed, unit),
            }
        };
        let known = match (role, unit) {
            (Some(role), Some(name)) => match known_unit(role, name) {
                Some(unit) => Some(unit),
                // A column that only looks like one, in a unit that it cannot have, is another.
                None if origin == Origin::Guessed => {
                    columns.push(Column::unused(place, header));
                    continue;
                }
                None => {
                    let what = format!("unknown unit {} of {}", quoted(name.as_bytes()), role.key());
                    return Err(LogError::cell(line, place, header, what, role.dimension().names()));
                }
            },
            _ => None,
        };
        let si = role.map_or("", |role| role.dimension().si().name);
        let (unit, unit_given) = (known.unwrap_or(si), known.is_some());
        columns.push(Column { place, header: header.clone(), role, unit, unit_given, origin });
    }
    for mapping in mappings {
        if !columns.iter().any(|column| mapping.is_of(column.place, &column.header)) {
            let what = format!("there is no column {}", quoted(mapping.column.as_bytes()));
            let allowed = headers.iter().take(40).cloned().collect::<Vec<_>>().join(", ");
            return Err(LogError { allowed, ..LogError::line(line, what) });
        }
    }
    settle(&mut columns, line)?;
    Ok(columns)
}

/// Of columns that could be the same one is taken: the mapped one, else the one with the exact name.
fn settle(columns: &mut [Column], line: u64) -> Result<(), LogError> {
    for role in Role::ALL {
        let best = columns.iter().filter(|column| column.role == Some(*role)).map(|column| column.origin).max();
        let Some(best) = best else { continue };
        let mut found: Option<(usize, String)> = None;
        for column in columns.iter_mut().filter(|column| column.role == Some(*role)) {
            if column.origin < best {
                column.role = None;
            } else if let Some((place, header)) = &found {
                let key = role.key();
                let what = format!(
                    "columns {} ({header}) and {} ({}) could both be {key}",
                    place + 1,
                    column.place + 1,
                    column.header
                );
                return Err(LogError::line(line, what).or(format!(": say which with --map {key}=column")));
            } else {
                found = Some((column.place, column.header.clone()));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn roles(headers: &[&str], mappings: &[&str]) -> Result<Vec<String>, String> {
        let headers: Vec<String> = headers.iter().map(|header| (*header).into()).collect();
        let mappings = mappings.iter().map(|text| Mapping::parse(text)).collect::<Result<Vec<_>, _>>();
        let columns = mappings.and_then(|mappings| columns(&headers, 1, &mappings)).map_err(|e| e.to_string())?;
        let told = |column: &Column| column.role.map_or("-".into(), |role| format!("{} {}", role.key(), column.unit));
        Ok(columns.iter().map(told).collect())
    }

    #[test]
    fn headers_are_named_guessed_or_mapped() {
        let of = |headers: &[&str], mappings: &[&str]| roles(headers, mappings).expect("columns").join(", ");
        assert_eq!(of(&["time [ms]", "x [mm]", "theta_l [deg]", "q1"], &[]), "time ms, x mm, theta_l deg, q1 m");
        assert_eq!(of(&["Time", "Tx (mm)", "pose.position.y", "Marker Z"], &[]), "time s, x mm, y m, z m");
        assert_eq!(of(&["q0", "q1", "q2", "q3"], &[]), "qw 1, qx 1, qy 1, qz 1");
        assert_eq!(of(&["time_ns", "pos_x_mm", "rate"], &[]), "time ns, x mm, -");
        assert_eq!(of(&["a", "b"], &["x [mm]=a", "time=#2"]), "x mm, time s");
        assert_eq!(of(&["x", "Tx (mm)"], &[]), "x m, -", "the exact name goes first");
        assert_eq!(of(&["x", "Tx (mm)"], &["x=Tx (mm)"]), "-, x mm", "a mapping goes before it");
        assert_eq!(of(&["x", "Marker Status"], &["unused=Marker Status"]), "x m, -");
        assert_eq!(of(&["theta_l_rate [rad/s]", "tau_lc_1 [N]"], &[]), "-, tau_1 N");
    }

    #[test]
    fn what_is_not_clear_is_refused() {
        for (headers, mappings, parts) in [
            (&["x [inch]"][..], &[][..], &["column 1", "inch", "m, mm, µm"][..]),
            (&["Tx", "Px"], &[], &["columns 1 (Tx) and 2 (Px)", "--map x="]),
            (&["x"], &["x=Tx"], &["no column \"Tx\"", "allowed: x"]),
            (&["x"], &["u=x"], &["\"u\"", "tau_3"]),
            (&["x"], &["x"], &["name=column"]),
            (&["x"], &["x [deg]=x"], &["\"deg\"", "mm"]),
        ] {
            let message = roles(headers, mappings).expect_err("refused");
            for part in parts {
                assert!(message.contains(part), "{message:?} lacks {part:?}");
            }
        }
    }
}
