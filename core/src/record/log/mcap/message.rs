//! Messages of ROS: which of them are read, and how, from CDR and JSON.

use serde_json::Value;

/// A type of messages that is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// `geometry_msgs/PoseStamped`.
    Pose,
    /// `geometry_msgs/TransformStamped`.
    Transform,
    /// `sensor_msgs/JointState`.
    Joints,
    /// `geometry_msgs/WrenchStamped`.
    Wrench,
}

impl Kind {
    /// The kind that a schema's name means, with or without the `msg` of ROS 2.
    #[must_use]
    pub fn of(schema: &str) -> Option<Self> {
        match schema.rsplit(['/', '.']).next()? {
            "PoseStamped" => Some(Self::Pose),
            "TransformStamped" => Some(Self::Transform),
            "JointState" => Some(Self::Joints),
            "WrenchStamped" => Some(Self::Wrench),
            _ => None,
        }
    }

    /// Whether it tells where the marker is.
    #[must_use]
    pub fn is_pose(self) -> bool {
        matches!(self, Self::Pose | Self::Transform)
    }
}

/// How messages are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// Common data representation, of either byte order.
    Cdr,
    /// JSON.
    Json,
}

impl Encoding {
    /// The encoding of a name.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        match name {
            "cdr" => Some(Self::Cdr),
            "json" => Some(Self::Json),
            _ => None,
        }
    }
}

/// What a message says.
#[derive(Debug, Clone, PartialEq)]
pub enum Content {
    /// Position, m, and quaternion, scalar first.
    Pose([f64; 3], [f64; 4]),
    /// Names, positions and efforts of joints.
    Joints(Vec<String>, Vec<f64>, Vec<f64>),
    /// Force, N.
    Wrench([f64; 3]),
}

/// Reads a message: its stamp in ns, when it has one, and its content.
///
/// # Errors
/// What is wrong with it.
pub fn read(kind: Kind, encoding: Encoding, data: &[u8]) -> Result<(Option<i64>, Content), String> {
    match encoding {
        Encoding::Cdr => cdr(kind, data),
        Encoding::Json => json(kind, data),
    }
}

fn stamp(seconds: i64, nanoseconds: i64) -> Option<i64> {
    let stamp = seconds.checked_mul(1_000_000_000)?.checked_add(nanoseconds)?;
    // A message that was never stamped has zeros.
    (stamp != 0).then_some(stamp)
}

/// A message in the common data representation.
struct Cdr<'a> {
    data: &'a [u8],
    at: usize,
    big: bool,
}

impl<'a> Cdr<'a> {
    fn new(data: &'a [u8]) -> Result<Self, String> {
        let (head, data) = data.split_first_chunk::<4>().ok_or("is shorter than the head of a CDR message")?;
        match head[1] {
            0 => Ok(Self { data, at: 0, big: true }),
            1 => Ok(Self { data, at: 0, big: false }),
            other => Err(format!("is CDR of kind {other}; allowed: plain CDR, 0 or 1")),
        }
    }

    /// Numbers stand at multiples of their size.
    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        self.at = self.at.next_multiple_of(N);
        let bytes = self.data.get(self.at..).and_then(|rest| rest.first_chunk::<N>()).ok_or("ends too early")?;
        self.at += N;
        Ok(*bytes)
    }

    fn u32(&mut self) -> Result<u32, String> {
        let bytes = self.take::<4>()?;
        Ok(if self.big { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) })
    }

    fn f64(&mut self) -> Result<f64, String> {
        let bytes = self.take::<8>()?;
        Ok(if self.big { f64::from_be_bytes(bytes) } else { f64::from_le_bytes(bytes) })
    }

    fn text(&mut self) -> Result<String, String> {
        let length = self.u32()? as usize;
        let bytes = self.data.get(self.at..).and_then(|rest| rest.get(..length)).ok_or("ends within a text")?;
        self.at += length;
        Ok(String::from_utf8_lossy(bytes.strip_suffix(b"\0").unwrap_or(bytes)).into_owned())
    }

    /// Items behind their number; `size` is the least of one, bytes.
    fn list<T>(&mut self, size: usize, item: impl Fn(&mut Self) -> Result<T, String>) -> Result<Vec<T>, String> {
        let count = self.u32()? as usize;
        if count > self.data.len() / size {
            return Err(format!("says that a list has {count} items, more than it has room for"));
        }
        (0..count).map(|_| item(self)).collect()
    }

    fn vector<const N: usize>(&mut self) -> Result<[f64; N], String> {
        let mut vector = [0.0; N];
        for part in &mut vector {
            *part = self.f64()?;
        }
        Ok(vector)
    }
}

fn cdr(kind: Kind, data: &[u8]) -> Result<(Option<i64>, Content), String> {
    let mut cdr = Cdr::new(data)?;
    let seconds = cdr.u32()?.cast_signed();
    let stamp = stamp(i64::from(seconds), i64::from(cdr.u32()?));
    cdr.text()?;
    let content = match kind {
        Kind::Pose | Kind::Transform => {
            if kind == Kind::Transform {
                cdr.text()?;
            }
            let position = cdr.vector()?;
            let [x, y, z, w] = cdr.vector()?;
            Content::Pose(position, [w, x, y, z])
        }
        Kind::Joints => {
            let names = cdr.list(4, Cdr::text)?;
            let positions = cdr.list(8, Cdr::f64)?;
            cdr.list(8, Cdr::f64)?;
            Content::Joints(names, positions, cdr.list(8, Cdr::f64)?)
        }
        Kind::Wrench => Content::Wrench(cdr.vector()?),
    };
    Ok((stamp, content))
}

fn json(kind: Kind, data: &[u8]) -> Result<(Option<i64>, Content), String> {
    let value: Value = serde_json::from_slice(data).map_err(|error| format!("is no JSON: {error}"))?;
    let time = &value["header"]["stamp"];
    let whole = |key: &str| time[key].as_i64();
    let stamp = whole("sec").and_then(|sec| stamp(sec, whole("nanosec").or_else(|| whole("nsec")).unwrap_or(0)));
    let content = match kind {
        Kind::Pose => {
            let pose = &value["pose"];
            Content::Pose(
                parts(&pose["position"], ["x", "y", "z"])?,
                parts(&pose["orientation"], ["w", "x", "y", "z"])?,
            )
        }
        Kind::Transform => {
            let transform = &value["transform"];
            let position = parts(&transform["translation"], ["x", "y", "z"])?;
            Content::Pose(position, parts(&transform["rotation"], ["w", "x", "y", "z"])?)
        }
        Kind::Joints => {
            let list = |key: &str| value[key].as_array().map(Vec::as_slice).unwrap_or_default();
            let names = list("name").iter().map(|name| name.as_str().unwrap_or_default().into()).collect();
            let numbers = |key: &str| list(key).iter().map(number).collect::<Result<Vec<f64>, String>>();
            Content::Joints(names, numbers("position")?, numbers("effort")?)
        }
        Kind::Wrench => Content::Wrench(parts(&value["wrench"]["force"], ["x", "y", "z"])?),
    };
    Ok((stamp, content))
}

/// A number; NaN for null, for JSON has no other word for it.
fn number(value: &Value) -> Result<f64, String> {
    match value {
        Value::Null => Ok(f64::NAN),
        Value::String(text) if text.eq_ignore_ascii_case("nan") => Ok(f64::NAN),
        other => other.as_f64().ok_or_else(|| format!("has {} where a number belongs", short(other))),
    }
}

fn short(value: &Value) -> String {
    super::super::error::quoted(value.to_string().as_bytes())
}

fn parts<const N: usize>(value: &Value, keys: [&str; N]) -> Result<[f64; N], String> {
    let mut parts = [0.0; N];
    for (part, key) in parts.iter_mut().zip(keys) {
        *part = match value.get(key) {
            Some(value) => number(value)?,
            None => return Err(format!("has no number called {key}")),
        };
    }
    Ok(parts)
}
