//! A simulated experiment as an MCAP file: `PoseStamped` for each new reading of the tracker, `JointState` for each instant.

use super::container::{MAGIC, op};
use crate::model::joints::joints;
use crate::model::orientation::quaternion_from_euler;
use crate::record::Entry;

/// Topic of the tracker's readings.
pub const POSE: &str = "/tracker/pose";
/// Topic of commands and load cells.
pub const JOINTS: &str = "/joint_states";

const POSE_CHANNEL: u16 = 1;
const JOINT_CHANNEL: u16 = 2;

const HEADER_TEXT: &str = "================================================================================\n\
                           MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n\
                           ================================================================================\n\
                           MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
const POSE_TEXT: &str = "std_msgs/Header header\ngeometry_msgs/Pose pose\n\
                         ================================================================================\n\
                         MSG: geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n\
                         ================================================================================\n\
                         MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n\
                         ================================================================================\n\
                         MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n";
const JOINT_TEXT: &str =
    "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n";

/// Names of the joints: the command twice, for bend and δ keep their last bits; the efforts of q1, q2 and q3 are the load cells.
const NAMES: [&str; 5] = ["bend", "delta", "q1", "q2", "q3"];

fn record(out: &mut Vec<u8>, op: u8, body: &[u8]) {
    out.push(op);
    out.extend((body.len() as u64).to_le_bytes());
    out.extend(body);
}

fn text(body: &mut Vec<u8>, text: &str) {
    body.extend((text.len() as u32).to_le_bytes());
    body.extend(text.as_bytes());
}

/// The beginning of a file: magic bytes, header, schemas and channels.
pub fn begin(out: &mut Vec<u8>) {
    out.extend(MAGIC);
    let mut body = Vec::new();
    text(&mut body, "ros2");
    text(&mut body, "centrode");
    record(out, op::HEADER, &body);
    let types = [
        (POSE_CHANNEL, POSE, "geometry_msgs/msg/PoseStamped", POSE_TEXT),
        (JOINT_CHANNEL, JOINTS, "sensor_msgs/msg/JointState", JOINT_TEXT),
    ];
    for (id, topic, schema, definition) in types {
        let mut body = id.to_le_bytes().to_vec();
        text(&mut body, schema);
        text(&mut body, "ros2msg");
        text(&mut body, &format!("{definition}{HEADER_TEXT}"));
        record(out, op::SCHEMA, &body);
        let mut body = [id.to_le_bytes(), id.to_le_bytes()].concat();
        text(&mut body, topic);
        text(&mut body, "cdr");
        // No metadata.
        body.extend(0u32.to_le_bytes());
        record(out, op::CHANNEL, &body);
    }
}

/// A message in CDR, least significant bytes first.
struct Cdr(Vec<u8>);

impl Cdr {
    /// Behind the stamp of a time (s) and the frame's name.
    fn stamped(time: f64) -> Self {
        let mut cdr = Self(vec![0, 1, 0, 0]);
        let nanoseconds = stamp(time);
        cdr.u32((nanoseconds / 1_000_000_000) as u32);
        cdr.u32((nanoseconds % 1_000_000_000) as u32);
        cdr.text("base");
        cdr
    }

    fn align(&mut self, size: usize) {
        let length = (self.0.len() - 4).next_multiple_of(size) + 4;
        self.0.resize(length, 0);
    }

    fn u32(&mut self, value: u32) {
        self.align(4);
        self.0.extend(value.to_le_bytes());
    }

    fn f64(&mut self, value: f64) {
        self.align(8);
        self.0.extend(value.to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.u32(text.len() as u32 + 1);
        self.0.extend(text.as_bytes());
        self.0.push(0);
    }

    fn list(&mut self, values: &[f64]) {
        self.u32(values.len() as u32);
        values.iter().for_each(|value| self.f64(*value));
    }
}

/// A time (s) in ns.
fn stamp(time: f64) -> u64 {
    libm::rint(time * 1e9) as u64
}

fn message(out: &mut Vec<u8>, channel: u16, sequence: u32, time: f64, data: &[u8]) {
    let mut body = channel.to_le_bytes().to_vec();
    body.extend(sequence.to_le_bytes());
    // When it was logged, and when it was published.
    body.extend(stamp(time).to_le_bytes());
    body.extend(stamp(time).to_le_bytes());
    body.extend(data);
    record(out, op::MESSAGE, &body);
}

/// Appends a new reading of the tracker.
pub fn pose(out: &mut Vec<u8>, sequence: u32, entry: &Entry) {
    let mut cdr = Cdr::stamped(entry.time);
    let [w, x, y, z] = quaternion_from_euler(&entry.reading.angles);
    entry.reading.position.iter().chain(&[x, y, z, w]).for_each(|part| cdr.f64(*part));
    message(out, POSE_CHANNEL, sequence, entry.time, &cdr.0);
}

/// Appends command and load cells of an instant; `pitch_radius` (m) is the robot's.
pub fn state(out: &mut Vec<u8>, sequence: u32, entry: &Entry, pitch_radius: f64) {
    let mut cdr = Cdr::stamped(entry.time);
    cdr.u32(NAMES.len() as u32);
    NAMES.iter().for_each(|name| cdr.text(name));
    let q = joints(pitch_radius, &entry.configuration);
    cdr.list(&[entry.configuration.bend(), entry.configuration.delta(), q.x, q.y, q.z]);
    cdr.list(&[]);
    cdr.list(&[f64::NAN, f64::NAN, entry.tau_lc.x, entry.tau_lc.y, entry.tau_lc.z]);
    message(out, JOINT_CHANNEL, sequence, entry.time, &cdr.0);
}

/// The end of a file.
pub fn end(out: &mut Vec<u8>) {
    record(out, op::DATA_END, &0u32.to_le_bytes());
    // No summary: its place and checksum are zeros.
    record(out, op::FOOTER, &[0; 20]);
    out.extend(MAGIC);
}
