//! Logs in an MCAP container: messages of ROS.

pub mod container;
pub mod message;
pub mod write;

use super::error::{LogError, quoted};
use super::gather::Clock;
use super::header::{Column, Origin};
use super::report::{Happening, Place};
use super::rotation::Orientation;
use super::units::Dimension;
use super::{Format, Log, Options, Progress};
use crate::model::configuration::bend_from_theta_l;
use container::{Fields, MAGIC, chunk, op, record};
use message::{Content, Encoding, Kind, read};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A topic of a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Topic {
    /// Its name.
    pub name: String,
    /// The type of its messages.
    pub schema: String,
    /// How they are written.
    pub encoding: String,
    /// Messages so far.
    pub messages: u64,
}

/// Reads an MCAP file message by message.
#[derive(Debug)]
pub struct McapReader {
    bytes: Vec<u8>,
    at: usize,
    /// Records of the chunk that is being read, and where the next one begins.
    chunk: Vec<u8>,
    within: usize,
    schemas: BTreeMap<u16, String>,
    channels: Vec<Channel>,
    /// Places of channels by number; those of one topic, schema and encoding are one, as when two programs publish it.
    places: BTreeMap<u16, usize>,
    known: BTreeMap<[String; 3], usize>,
    wanted: Vec<String>,
    /// Whether those may be of another file.
    partly: bool,
    /// Whose joints are read, of how many segments.
    segment: Option<(usize, usize)>,
    /// Whether one of those tells where the marker is: then no other pose is read.
    pose_chosen: bool,
    messages: u64,
    /// What stamps are counted from, ns.
    origin: Option<i64>,
    cut: bool,
}

/// A channel, and what its messages held.
#[derive(Debug)]
struct Channel {
    topic: Topic,
    kind: Option<(Kind, Encoding)>,
    clock: Clock,
    log: Log,
}

impl McapReader {
    /// Before the first record.
    ///
    /// # Errors
    /// When the file is no MCAP.
    pub fn new(bytes: Vec<u8>, options: &Options) -> Result<Self, LogError> {
        if !bytes.starts_with(MAGIC) {
            return Err(LogError::file("is no MCAP: it does not begin as one"));
        }
        Ok(Self {
            at: MAGIC.len(),
            bytes,
            chunk: Vec::new(),
            within: 0,
            schemas: BTreeMap::new(),
            channels: Vec::new(),
            places: BTreeMap::new(),
            known: BTreeMap::new(),
            wanted: options.topics.clone(),
            partly: options.partly,
            segment: options.segment,
            pose_chosen: false,
            messages: 0,
            origin: None,
            cut: false,
        })
    }

    /// The topics seen so far.
    pub fn topics(&self) -> impl Iterator<Item = &Topic> {
        self.channels.iter().map(|channel| &channel.topic)
    }

    /// Reads at most `count` more records.
    ///
    /// # Errors
    /// The first message that cannot be read.
    pub fn work(&mut self, count: usize) -> Result<Progress, LogError> {
        let of = self.bytes.len();
        for _ in 0..count {
            if !self.step()? {
                return Ok(Progress { done: of, of });
            }
        }
        Ok(Progress { done: self.at.min(of.saturating_sub(1)), of })
    }

    /// Reads one record; whether there may be another.
    fn step(&mut self) -> Result<bool, LogError> {
        if self.within < self.chunk.len() {
            let records = std::mem::take(&mut self.chunk);
            let next = record(&records, self.within);
            let Some(next) = next else {
                return Err(LogError::line(self.messages, "a chunk ends within a record"));
            };
            self.within = next.body.end;
            let body = records.get(next.body).unwrap_or_default();
            let done = self.take(next.op, body);
            self.chunk = records;
            return done.map(|()| true);
        }
        if self.bytes.get(self.at..).is_none_or(<[u8]>::is_empty) {
            // A whole file ends with the magic bytes behind a footer.
            self.cut = true;
            return Ok(false);
        }
        let Some(next) = record(&self.bytes, self.at) else {
            self.cut = true;
            self.at = self.bytes.len();
            return Ok(false);
        };
        self.at = next.body.end;
        match next.op {
            op::DATA_END | op::FOOTER => {
                self.at = self.bytes.len();
                return Ok(false);
            }
            op::CHUNK => {
                self.chunk = chunk(self.bytes.get(next.body).unwrap_or_default(), self.messages)?;
                self.within = 0;
            }
            op => {
                let bytes = std::mem::take(&mut self.bytes);
                let done = self.take(op, bytes.get(next.body).unwrap_or_default());
                self.bytes = bytes;
                done?;
            }
        }
        Ok(true)
    }

    /// Takes a schema, a channel or a message; other records say nothing that is needed.
    fn take(&mut self, op: u8, body: &[u8]) -> Result<(), LogError> {
        let mut fields = Fields(body);
        match op {
            op::SCHEMA => {
                let schema = fields.u16().zip(fields.text());
                let (id, name) = schema.ok_or_else(|| LogError::line(self.messages, "a schema is cut"))?;
                self.schemas.insert(id, name);
            }
            op::CHANNEL => {
                let ids = fields.u16().zip(fields.u16());
                let names = fields.text().zip(fields.text());
                let ((id, schema), (name, encoding)) =
                    ids.zip(names).ok_or_else(|| LogError::line(self.messages, "a channel is cut"))?;
                let schema = self.schemas.get(&schema).cloned().unwrap_or_default();
                let kind = Kind::of(&schema).zip(Encoding::of(&encoding));
                self.pose_chosen |= kind.is_some_and(|(kind, _)| kind.is_pose()) && self.wanted.contains(&name);
                let place =
                    *self.known.entry([name, schema, encoding]).or_insert_with_key(|[name, schema, encoding]| {
                        let [name, schema, encoding] = [name, schema, encoding].map(String::clone);
                        let topic = Topic { name, schema, encoding, messages: 0 };
                        let log = Log::new(Format::Mcap, Vec::new());
                        self.channels.push(Channel { topic, kind, clock: Clock::default(), log });
                        self.channels.len() - 1
                    });
                // Channels are often repeated.
                self.places.entry(id).or_insert(place);
            }
            op::MESSAGE => return self.message(fields),
            _ => {}
        }
        Ok(())
    }

    fn message(&mut self, mut fields: Fields<'_>) -> Result<(), LogError> {
        self.messages += 1;
        let number = self.messages;
        let head = fields.u16().zip(fields.u32()).zip(fields.u64().zip(fields.u64()));
        let ((id, _), (logged, _)) = head.ok_or_else(|| LogError::line(number, "a message is cut"))?;
        let channel = self.places.get(&id).and_then(|place| self.channels.get_mut(*place));
        let Channel { topic, kind, clock, log } =
            channel.ok_or_else(|| LogError::line(number, "a message is of no channel"))?;
        topic.messages += 1;
        let Some((kind, encoding)) = *kind else { return Ok(()) };
        if self.pose_chosen && kind.is_pose() && !self.wanted.contains(&topic.name) {
            return Ok(());
        }
        let refuse = |what: String| LogError {
            place: Place { line: Some(number), column: None, name: topic.name.clone() },
            what: format!("the message {what}"),
            allowed: String::new(),
            way: "".into(),
        };
        let (stamp, content) = read(kind, encoding, fields.0).map_err(refuse)?;
        let stamp = stamp.unwrap_or(logged.cast_signed());
        // Doubles of seconds since 1970 would lose the nanoseconds.
        const LONG: u64 = 1_000_000 * 1_000_000_000;
        let origin = *self.origin.get_or_insert(if stamp.unsigned_abs() > LONG { stamp } else { 0 });
        let time = stamp.saturating_sub(origin) as f64 / 1e9;
        let numbers = match &content {
            Content::Pose(position, quaternion) => [&position[..], &quaternion[..]].concat(),
            Content::Joints(_, positions, efforts) => [&positions[..], &efforts[..]].concat(),
            Content::Wrench(force) => force.to_vec(),
        };
        if let Some(number) = numbers.iter().find(|number| number.abs() > Dimension::Length.most()) {
            return Err(refuse(format!("holds {number}, which is far too large")));
        }
        log.report.rows += 1;
        if !clock.takes(time, || Place::line(number), &mut log.report) {
            return Ok(());
        }
        match content {
            Content::Pose(position, quaternion) => {
                log.reading(time, number, position, Orientation::Quaternion(quaternion));
            }
            Content::Wrench(force) => log.forces(time, number, force),
            Content::Joints(names, positions, efforts) => {
                let names = match self.segment {
                    Some((segment, of)) => super::chain::joints_of(names, segment, of),
                    None => names,
                };
                let read = joints(log, time, number, &names, &positions, &efforts);
                // Of several segments, a message may tell of others alone.
                return if self.segment.is_some() { Ok(()) } else { read.map_err(refuse) };
            }
        }
        Ok(())
    }

    /// What was read, of one topic of each kind.
    ///
    /// # Errors
    /// When several topics could be meant.
    pub fn finish(self) -> Result<Log, LogError> {
        let Self { channels, wanted, partly, messages, origin, cut, .. } = self;
        let listed = |kept: &dyn Fn(&Topic) -> bool| {
            let told = |channel: &Channel| {
                let Topic { name, schema, messages, .. } = &channel.topic;
                format!("{name} ({schema}, {messages} messages)")
            };
            channels.iter().filter(|channel| kept(&channel.topic)).map(told).collect::<Vec<_>>().join(", ")
        };
        for name in &wanted {
            if !partly && !channels.iter().any(|channel| channel.topic.name == *name) {
                let what = format!("there is no topic {}", quoted(name.as_bytes()));
                return Err(LogError { allowed: listed(&|_| true), ..LogError::file(what) });
            }
        }
        let mut log = Log::new(Format::Mcap, Vec::new());
        log.origin = origin.unwrap_or(0) as f64 / 1e9;
        log.report.rows = messages;
        log.topics = channels.iter().map(|channel| channel.topic.clone()).collect();
        if cut {
            log.report.add(Happening::Cut, Place::line(messages), None);
        }
        let mut columns = Vec::new();
        type IsOf = fn(Kind) -> bool;
        let roles: [(&str, IsOf); 3] = [
            ("where the marker is", Kind::is_pose),
            ("the joints", |kind| kind == Kind::Joints),
            ("the load cells", |kind| kind == Kind::Wrench),
        ];
        for (what, of) in roles {
            let mut fitting: Vec<&Channel> = channels
                .iter()
                .filter(|channel| channel.kind.is_some_and(|(kind, _)| of(kind)) && channel.topic.messages > 0)
                .collect();
            let chosen = |channel: &&Channel| wanted.contains(&channel.topic.name);
            if fitting.iter().any(chosen) {
                fitting.retain(chosen);
            }
            if fitting.len() > 1 {
                let names: Vec<&String> = fitting.iter().map(|channel| &channel.topic.name).collect();
                let what = format!("several topics could be {what}");
                return Err(LogError {
                    allowed: listed(&|topic| names.contains(&&topic.name)),
                    ..LogError::file(what).or(": choose one with --topic")
                });
            }
            let Some(channel) = fitting.first() else { continue };
            let part = &channel.log;
            for (place, role) in roles_of(part).into_iter().enumerate() {
                let header = format!("{} {}", channel.topic.name, role.key());
                let unit = role.dimension().si().name;
                columns.push(Column { place, header, role: Some(role), unit, unit_given: true, origin: Origin::Named });
            }
            for count in &part.report.counts {
                let first = Place { name: channel.topic.name.clone(), ..count.first.clone() };
                log.report.add_many(count.what, count.count, first, count.time);
            }
            log.report.notes.extend(part.report.notes.iter().cloned());
            if !part.readings.is_empty() {
                log.readings = part.readings.clone();
            }
            if !part.commands.is_empty() || !part.joints.is_empty() {
                (log.commands, log.joints) = (part.commands.clone(), part.joints.clone());
            }
            if log.forces.is_empty() {
                log.forces = part.forces.clone();
            }
        }
        if columns.is_empty() {
            let what = "holds no messages that are read: geometry_msgs/PoseStamped, TransformStamped, WrenchStamped and \
                        sensor_msgs/JointState in CDR or JSON";
            let there = listed(&|_| true);
            return Err(LogError::file(if there.is_empty() {
                what.into()
            } else {
                format!("{what}; there is {there}")
            }));
        }
        let unread = |topic: &Topic| Kind::of(&topic.schema).is_some() && Encoding::of(&topic.encoding).is_none();
        if channels.iter().any(|channel| unread(&channel.topic)) {
            log.report.notes.push(format!("not read, neither CDR nor JSON: {}", listed(&unread)));
        }
        log.columns = columns;
        Ok(log)
    }
}

/// What a topic's messages held.
fn roles_of(log: &Log) -> Vec<super::Role> {
    use super::Role;
    let mut roles = Vec::new();
    if !log.readings.is_empty() {
        roles.extend([Role::X, Role::Y, Role::Z, Role::Qx, Role::Qy, Role::Qz, Role::Qw]);
    }
    if !log.commands.is_empty() {
        roles.extend([Role::Bend, Role::Delta]);
    } else if !log.joints.is_empty() {
        roles.extend([Role::Q1, Role::Q2, Role::Q3]);
    }
    if !log.forces.is_empty() {
        roles.extend([Role::Tau1, Role::Tau2, Role::Tau3]);
    }
    roles
}

/// Takes joints by their names: `bend` or `theta_l`, and `delta`; or `q1`, `q2` and `q3`, or three others in their order. The
/// efforts of those three are the load cells.
fn joints(
    log: &mut Log,
    time: f64,
    message: u64,
    names: &[String],
    positions: &[f64],
    efforts: &[f64],
) -> Result<(), String> {
    let find = |name: &str| names.iter().position(|other| other == name);
    let position = |place: usize| positions.get(place).copied().unwrap_or(f64::NAN);
    let bend = find("bend").map(position).or_else(|| find("theta_l").map(|place| bend_from_theta_l(position(place))));
    let three = [find("q1"), find("q2"), find("q3")];
    let three = match three {
        [Some(a), Some(b), Some(c)] => Some([a, b, c]),
        _ if names.len() == 3 && bend.is_none() && !names.iter().any(String::is_empty) => Some([0, 1, 2]),
        _ => None,
    };
    if let Some(bend) = bend {
        log.command(time, message, bend, find("delta").map(position));
    } else if let Some(three) = three {
        log.joints(time, message, three.map(position));
    } else {
        return Err(format!(
            "holds joints {}, neither bend or theta_l, nor q1, q2 and q3, nor three",
            quoted(names.join(", ").as_bytes())
        ));
    }
    if let Some(three) = three.filter(|_| !efforts.is_empty()) {
        log.forces(time, message, three.map(|place| efforts.get(place).copied().unwrap_or(f64::NAN)));
    }
    Ok(())
}
