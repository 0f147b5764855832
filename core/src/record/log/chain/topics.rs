//! The topics of an MCAP file by disk.

use super::columns::of_disk;
use super::names::{digits, first_number};
use super::read::{Read, told};
use super::{ChainOptions, Expected};
use crate::record::log::mcap::Topic;
use crate::record::log::mcap::message::Kind;
use crate::record::log::{Format, Log, LogError, Options, Reader};

/// Reads a pose for each disk, and commands of joints that name their segments, or topics of which do.
pub fn read(
    name: &str,
    bytes: Vec<u8>,
    of: &Expected,
    (options, shared): (&ChainOptions, &Options),
) -> Result<Read, LogError> {
    let first = Options { segment: Some((0, of.segments)), ..shared.clone() };
    let there = topics(name, bytes.clone(), &first)?;
    let wanted = |topic: &&Topic| options.shared.topics.is_empty() || options.shared.topics.contains(&topic.name);
    let of_kind = |is: fn(Kind) -> bool| -> Vec<&Topic> {
        let fits = |topic: &&Topic| topic.messages > 0 && Kind::of(&topic.schema).is_some_and(is);
        let chosen: Vec<&Topic> = there.iter().filter(fits).filter(wanted).collect();
        if chosen.is_empty() { there.iter().filter(fits).collect() } else { chosen }
    };
    let mut poses = of_kind(Kind::is_pose);
    let order = |topic: &&Topic| options.shared.topics.iter().position(|wanted| *wanted == topic.name);
    poses.sort_by_key(|topic| order(topic));
    let joints = of_kind(|kind| kind == Kind::Joints);
    let disks: Vec<usize> = of.trackers().collect();
    let mut notes = Vec::new();
    if of.commands_alone {
        poses.clear();
    } else if !poses.is_empty() && poses.len() != disks.len() {
        let listed: Vec<&str> = poses.iter().map(|topic| topic.name.as_str()).collect();
        let what =
            format!("{} topics tell where a marker is ({}), and {}", poses.len(), listed.join(", "), told(disks.len()));
        return Err(LogError::file(what).or(": name them in order from the base, each with --topic"));
    } else if options.shared.topics.is_empty() && poses.len() > 1 {
        if let Some(numbers) = poses.iter().map(|topic| number(topic)).collect::<Option<Vec<u64>>>() {
            let first = first_number(numbers.iter().copied(), of.segments);
            poses.sort_by_key(|topic| number(topic).map(|number| number.wrapping_sub(first)));
        }
        let listed: Vec<&str> = poses.iter().map(|topic| topic.name.as_str()).collect();
        notes.push(format!("topics are taken for the disks from the base: {}", listed.join(", ")));
    }
    let (mut logs, mut rows) = (Vec::new(), 0);
    for disk in 0..of.segments {
        let pose = disks.iter().position(|other| *other == disk).and_then(|place| poses.get(place));
        let own = |topic: &&&Topic| number(topic) == Some(disk as u64 + 1);
        let told = if joints.len() > 1 { joints.iter().find(own) } else { joints.first() };
        let told = told.filter(|_| of.disk.is_none_or(|only| only == disk));
        let topics: Vec<String> = pose.into_iter().chain(told).map(|topic| topic.name.clone()).collect();
        if topics.is_empty() {
            continue;
        }
        let options = Options { topics, partly: true, segment: Some((disk, of.segments)), ..shared.clone() };
        let mut log = Log::read(name, bytes.clone(), &options).map_err(|error| of_disk(error, disk))?;
        rows = log.report.rows;
        if pose.is_none() {
            log.readings = Default::default();
        }
        log.topics.clone_from(&there);
        logs.push((disk, log));
    }
    Ok(Read { format: Format::Mcap, logs, rows, notes, joints_either_way: false })
}

/// The topics of a file.
fn topics(name: &str, bytes: Vec<u8>, shared: &Options) -> Result<Vec<Topic>, LogError> {
    let mut reader = Reader::new(name, bytes, shared)?;
    while !reader.work(usize::MAX)?.is_done() {}
    Ok(reader.topics())
}

/// The last number in a topic's name.
fn number(topic: &Topic) -> Option<u64> {
    digits(&topic.name).first().and_then(|&(start, end)| topic.name[start..end].parse().ok())
}
