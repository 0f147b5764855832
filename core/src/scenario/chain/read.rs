//! Reading experiments with several segments from TOML: [[segment]], [[contact]], and what is common to all.

use super::group::{Group, parsed, text, whole};
use super::inputs::{ChainContact, ChainScenario, ChainSegment, Smd, Tracked, seed_of};
use super::{ABOVE_BASE, AT_END, ChainError, Fault, MOST, NORMAL, Stands, UNIT, between, torsion};
use crate::model::configuration::bend_from_theta_l;
use crate::scenario::keys::allowed::Limit;
use crate::scenario::keys::{Allowed, Quantity, Value};
use crate::scenario::plan::{MAX_TIME, MAX_TURN};
use crate::scenario::refusal::{Refused, ScenarioError};
use crate::scenario::text::read_table;
use crate::scenario::{Motion, Place, Plan};
use toml::de::DeTable;
use toml::{Table, Value as Toml};

/// Keys of a segment that are those of a scenario's robot, and of its motion.
const ROBOT: [&str; 5] = ["length", "pitch_radius", "disks", "primary", "secondary"];
const MOTION: [&str; 5] = ["theta_start", "theta_end", "delta", "start", "finish"];
const OWN: [&str; 3] = ["joint_offset", "torsion", "motion"];
const TURN: [&str; 3] = ["delta_end", "delta_start", "delta_finish"];
const CONTACT: [&str; 9] = ["segment", "disk", "at", "kind", "time", "bend", "tilt", "normal", "offset"];
/// Of a contact: keys that are set, and those that say the same in another way, in whose place they are.
const INSTEAD_OF: [(&[&str], &[&str]); 5] = [
    (&["disk"], &["at"]),
    (&["at"], &["disk"]),
    (&["time"], &["bend", "normal", "offset"]),
    (&["bend"], &["time", "normal", "offset"]),
    (&["normal", "offset"], &["time", "bend", "tilt"]),
];
/// What a scenario of one segment has in their place.
const ALONE: [&str; 4] = ["robot", "motion", "load", "load_cells"];

const INSTEAD: &str = "not in an experiment with [[segment]]: what it says stands in [[segment]] and [[contact]]; joint forces are not simulated there";
const DETECTORS: &str = "a list of any of fcd, fcd-consistent, fcd-velocity, cusum, glr, smd";
const TRACKED: &str = "\"all\" or \"tip\"";
const KIND: &str = "\"plane\" or \"clamp\"";
const EITHER: &str = "a disk or an arc length (at), not both and not neither";
const WHEN: &str = "a time, a bend of its segment, or, of a plane, a normal with an offset: one of these";
const REACHED: &str = "a bend that the motion of its segment passes";
const IDLE: &str = "an offset with a normal alone, a tilt with a time or a bend";
const TWICE: &str = "a place on the backbone that no other contact has";
const ESTIMATION: &str =
    "not with [[segment]]: planes and clamps are weighed by all readings (estimation.beginnings alone holds)";
const RESTS: &str = "a clamp only while the segments below it rest: what moves under a clamp changes the shape below it, which is not modelled";
const BELOW: &str = "a contact that comes to stand above a clamp that holds by then: below, nothing moves any more";

impl ChainScenario {
    /// Whether a text is one of these rather than a [`Scenario`](crate::scenario::Scenario).
    #[must_use]
    pub fn is_of(toml: &[u8]) -> bool {
        let table = std::str::from_utf8(toml).ok().and_then(|text| text.parse::<Table>().ok());
        table.is_some_and(|table| table.contains_key("segment"))
    }

    /// Reads TOML from bytes, with values of keys in place of those in the text: `segment[2].motion.theta_end=0.9`.
    ///
    /// # Errors
    /// The first thing that is wrong, with its key, its line where it is in the text, and what is allowed.
    pub fn from_bytes(bytes: &[u8], overrides: &[String]) -> Result<Self, ChainError> {
        let text = text(bytes)?;
        let mut table = parsed(text)?;
        let spans = if overrides.is_empty() { DeTable::parse(text).ok() } else { None };
        overrides.iter().try_for_each(|text| replace(&mut table, text).map_err(whole))?;
        Self::read(&Group::top(text, &table, spans.as_ref().map(|spans| spans.get_ref())), &table)
    }

    pub(super) fn read(top: &Group, table: &Table) -> Result<Self, ChainError> {
        if let Some(alone) = ALONE.iter().find(|key| table.contains_key(**key)) {
            return Err(top.refuse(alone, Quantity::Word, Value::Other("…".into()), Allowed::Need(INSTEAD)));
        }
        for key in ["plants", "estimators", "kind"] {
            if let Some(given) = table.get("estimation").and_then(|estimation| estimation.get(key)) {
                return Err(top.refuse_at(["estimation", key], given, Allowed::Need(ESTIMATION)));
            }
        }
        let end = top.number("end", Quantity::Time, between(0.0, MAX_TIME), Some(10.0))?;
        let mut common = table.clone();
        ["segment", "contact", "end"].iter().for_each(|key| drop(common.remove(*key)));
        let tracked = tracked(top, &mut common)?;
        let smd = smd(top, &mut common)?;
        let segments = top.tables("segment", MOST)?;
        if segments.is_empty() {
            return Err(top.missing("segment", "one table [[segment]] for each segment, from the base"));
        }
        let segments = segments
            .iter()
            .enumerate()
            .map(|(place, group)| segment(group, place, &common, end))
            .collect::<Result<Vec<_>, _>>()?;
        let groups = top.tables("contact", MOST)?;
        let contacts = groups.iter().map(|group| contact(group, &segments)).collect::<Result<Vec<_>, _>>()?;
        for (place, contact) in contacts.iter().enumerate() {
            check_clamp(&groups[place], contact, &segments, &contacts)?;
        }
        Ok(Self { segments, contacts, tracked, smd })
    }
}

/// Puts one value in the place of another: `key=value`, the value TOML or a bare word. What a contact cannot have beside it goes: a disk
/// where an arc length is set.
pub(super) fn replace(table: &mut Table, text: &str) -> Result<(), ScenarioError> {
    let none = || ScenarioError::Override { text: text.into() };
    let (path, value) = text.split_once('=').ok_or_else(none)?;
    let (path, value) = (path.trim(), value.trim());
    if path.is_empty() || value.is_empty() || value.contains('\n') {
        return Err(none());
    }
    let parsed = format!("v = {value}").parse::<Table>().or_else(|_| format!("v = {value:?}").parse::<Table>());
    let value = parsed.ok().and_then(|mut table| table.remove("v")).ok_or_else(none)?;
    let parts: Vec<&str> = path.split('.').collect();
    let (last, groups) = parts.split_last().ok_or_else(none)?;
    let mut at = table;
    for part in groups {
        at = inner(at, part).ok_or_else(none)?;
    }
    at.insert((*last).into(), value);
    if matches!(groups, [contact] if contact.starts_with("contact[")) {
        let replaced = INSTEAD_OF.iter().filter(|(set, _)| set.contains(last)).flat_map(|(_, others)| *others);
        replaced.for_each(|other| drop(at.remove(*other)));
    }
    Ok(())
}

/// The table under a key, or the one of a list that a number from 1 in brackets tells.
pub(super) fn inner<'t>(table: &'t mut Table, part: &str) -> Option<&'t mut Table> {
    let Some((key, number)) = part.strip_suffix(']').and_then(|part| part.split_once('[')) else {
        return table.entry(part).or_insert_with(|| Toml::Table(Table::new())).as_table_mut();
    };
    let place = number.parse::<usize>().ok()?.checked_sub(1)?;
    table.get_mut(key)?.as_array_mut()?.get_mut(place)?.as_table_mut()
}

fn tracked(top: &Group, common: &mut Table) -> Result<Tracked, ChainError> {
    let Some(tracker) = common.get_mut("tracker").and_then(Toml::as_table_mut) else { return Ok(Tracked::All) };
    match tracker.remove("disks") {
        None => Ok(Tracked::All),
        Some(Toml::String(word)) if word == "all" => Ok(Tracked::All),
        Some(Toml::String(word)) if word == "tip" => Ok(Tracked::Tip),
        Some(other) => Err(top.refuse_at(["tracker", "disks"], &other, Allowed::Need(TRACKED))),
    }
}

/// The screw motion deviation, which judges besides those that judge one segment. By default these are fcd, cusum and it.
fn smd(top: &Group, common: &mut Table) -> Result<Option<Smd>, ChainError> {
    let entry = common.entry("detection").or_insert_with(|| Toml::Table(Table::new()));
    let Some(detection) = entry.as_table_mut() else { return Ok(None) };
    let mut smd = Smd::default();
    for (key, quantity, value) in
        [("smd_distance", Quantity::Length, &mut smd.distance), ("smd_angle", Quantity::Angle, &mut smd.angle)]
    {
        let Some(given) = detection.remove(key) else { continue };
        let number = super::group::float(&given).filter(|number| *number >= 0.0 && number.is_finite());
        let allowed = Allowed::Need(if quantity == Quantity::Length { "0 m or more" } else { "0 rad or more" });
        *value = number.ok_or_else(|| top.refuse_at(["detection", key], &given, allowed))?;
    }
    let names =
        detection.entry("detectors").or_insert_with(|| Toml::Array(["fcd", "cusum", "smd"].map(Into::into).into()));
    let refused = |names: &Toml| top.refuse_at(["detection", "detectors"], names, Allowed::Need(DETECTORS));
    let Some(list) = names.as_array_mut() else { return Err(refused(names)) };
    if list.iter().any(|name| name.as_str() == Some("jfd")) {
        return Err(refused(names));
    }
    let before = list.len();
    list.retain(|name| name.as_str() != Some("smd"));
    match before - list.len() {
        0 => Ok(None),
        1 => Ok(Some(smd)),
        _ => Err(refused(names)),
    }
}

/// A segment: its robot and motion are read and checked as those of an experiment with it alone.
fn segment(group: &Group, place: usize, common: &Table, end: f64) -> Result<ChainSegment, ChainError> {
    let known: Vec<&str> = ROBOT.into_iter().chain(OWN).collect();
    group.knows(&known)?;
    let told = group.table("motion", "a table of keys: theta_start, theta_end, delta, start, finish, delta_end, …")?;
    if let Some(motion) = &told {
        motion.knows(&MOTION.into_iter().chain(TURN).collect::<Vec<_>>())?;
    }
    let pick = |from: Option<&Group>, keys: &[&str]| {
        let each = keys.iter().filter_map(|key| Some(((*key).to_owned(), from?.value(key)?.clone())));
        each.collect::<Table>()
    };
    let mut table = common.clone();
    let robot = pick(Some(group), &ROBOT);
    let mut motion = pick(told.as_ref(), &MOTION);
    // Without an end it stays where it starts.
    let still = motion.get("theta_start").cloned().unwrap_or(Toml::Float(std::f64::consts::FRAC_PI_2));
    motion.entry("theta_end").or_insert(still);
    motion.insert("end".into(), Toml::Float(end));
    table.insert("robot".into(), Toml::Table(robot));
    table.insert("motion".into(), Toml::Table(motion));
    let refused = |error| group.own(error, &[("robot.", ""), ("motion.end", "end"), ("motion.", "motion.")]);
    let mut alone = read_table(&table).map_err(refused)?;
    alone.contact.place = Place::Nowhere;
    let alone = Plan::new(&alone).map_err(refused)?;
    let alone = alone.with_seed(seed_of(alone.scenario().seed, place));
    let angle = between(-MAX_TURN, MAX_TURN);
    let joint_offset = group.number("joint_offset", Quantity::Angle, angle, Some(0.0))?;
    let Motion { delta, start, finish, .. } = alone.scenario().motion;
    let (delta_end, delta_start, delta_finish) = match &told {
        None => (delta, start, finish),
        Some(motion) => (
            motion.number("delta_end", Quantity::Angle, angle, Some(delta))?,
            motion.number("delta_start", Quantity::Time, between(-MAX_TIME, MAX_TIME), Some(start))?,
            motion.number("delta_finish", Quantity::Time, between(-MAX_TIME, MAX_TIME), Some(finish))?,
        ),
    };
    if delta_finish <= delta_start {
        let from = told.as_ref().unwrap_or(group);
        let value = Value::Number(delta_finish);
        return Err(from.refuse("delta_finish", Quantity::Time, value, Allowed::Need("a time after delta_start")));
    }
    Ok(ChainSegment { torsion: torsion(group)?, alone, joint_offset, delta_end, delta_start, delta_finish })
}

fn contact(group: &Group, segments: &[ChainSegment]) -> Result<ChainContact, ChainError> {
    group.knows(&CONTACT)?;
    let segment = group.whole("segment", 1, segments.len())? - 1;
    let own = &segments[segment].alone.scenario().robot;
    let length = own.length;
    let at = match (group.has("disk"), group.has("at")) {
        (true, false) if own.disks.is_empty() => {
            return Err(group.refuse_as_written(
                "disk",
                Quantity::Count,
                Allowed::Need("at: its segment has no spacer disks"),
            ));
        }
        (true, false) => own.disks[group.whole("disk", 1, own.disks.len())? - 1],
        (false, true) => group.number("at", Quantity::Length, Allowed::Number, None)?,
        (false, false) => return Err(group.missing("at", EITHER)),
        (true, true) => return Err(group.refuse_as_written("at", Quantity::Length, Allowed::Need(EITHER))),
    };
    let at = if (at - length).abs() <= AT_END * length { length } else { at };
    let on = Allowed::Range(Limit::Beyond(ABOVE_BASE * length), Limit::At(length));
    if !on.has(at) {
        return Err(group.refuse("at", Quantity::Length, Value::Number(at), on));
    }
    Ok(ChainContact { segment, at, stands: stands(group, &segments[segment])? })
}

/// Where a contact stands, and since when.
fn stands(group: &Group, segment: &ChainSegment) -> Result<Stands, ChainError> {
    let clamp = match group.value("kind").map(|kind| kind.as_str()) {
        None | Some(Some("plane")) => false,
        Some(Some("clamp")) => true,
        _ => return Err(group.refuse_as_written("kind", Quantity::Word, Allowed::Need(KIND))),
    };
    let given = ["time", "bend", "normal"].map(|key| group.has(key));
    if given.iter().filter(|given| **given).count() != 1 || (clamp && given[2]) {
        let key = ["normal", "bend", "time"].into_iter().find(|key| group.has(key));
        return Err(match key {
            Some(key) => group.refuse_as_written(key, Quantity::Word, Allowed::Need(WHEN)),
            None => group.missing("time", WHEN),
        });
    }
    let idle = if given[2] { "tilt" } else { "offset" };
    if group.has(idle) {
        return Err(group.refuse_as_written(idle, Quantity::Word, Allowed::Need(IDLE)));
    }
    if given[2] {
        let normal = group.vector("normal", NORMAL)?;
        if (normal.norm() - 1.0).abs() > UNIT || !normal.norm().is_finite() {
            return Err(group.refuse_as_written("normal", Quantity::Count, Allowed::Need(NORMAL)));
        }
        let offset = group.number("offset", Quantity::Length, between(-1e3, 1e3), None)?;
        return Ok(Stands::Always { normal: normal.normalize(), offset });
    }
    let end = segment.motion().end;
    let time = if given[0] {
        group.number("time", Quantity::Time, between(0.0, end), None)?
    } else {
        let bend = group.number("bend", Quantity::Angle, Allowed::Number, None)?;
        let refused = || group.refuse("bend", Quantity::Angle, Value::Number(bend), Allowed::Need(REACHED));
        passes(segment, bend).filter(|time| (0.0..=end).contains(time)).ok_or_else(refused)?
    };
    let tilt = group.number("tilt", Quantity::Angle, between(-MAX_TURN, MAX_TURN), Some(0.0))?;
    if clamp && group.has("tilt") {
        return Err(group.refuse_as_written("tilt", Quantity::Angle, Allowed::Need("no tilt of a clamp")));
    }
    Ok(if clamp { Stands::Clamped { time } } else { Stands::From { time, tilt } })
}

/// When a segment's commanded bend (rad) is this much, s.
fn passes(segment: &ChainSegment, bend: f64) -> Option<f64> {
    let motion = segment.motion();
    let over = |time: f64| bend_from_theta_l(segment.command(time)[0].0) - bend;
    let (mut low, mut high) = (motion.start, motion.finish);
    let rising = over(high) > over(low);
    if over(low) == over(high) || over(low).min(over(high)) > 0.0 || over(low).max(over(high)) < 0.0 {
        return None;
    }
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if (over(middle) < 0.0) == rising { low = middle } else { high = middle }
    }
    Some(high)
}

/// Whether what is below a clamp rests, and nothing comes to stand there later.
fn check_clamp(
    group: &Group,
    contact: &ChainContact,
    segments: &[ChainSegment],
    contacts: &[ChainContact],
) -> Result<(), ChainError> {
    if let Stands::Clamped { time } = contact.stands
        && !segments[..contact.segment].iter().all(|segment| segment.rests_after(time))
    {
        return Err(group.refuse_as_written("kind", Quantity::Word, Allowed::Need(RESTS)));
    }
    let twice = |other: &&ChainContact| (other.segment, other.at) == (contact.segment, contact.at);
    if contacts.iter().filter(twice).count() > 1 {
        let key = if group.has("disk") { "disk" } else { "at" };
        return Err(group.refuse_as_written(key, Quantity::Word, Allowed::Need(TWICE)));
    }
    let (Stands::Clamped { time } | Stands::From { time, .. }) = contact.stands else { return Ok(()) };
    let below = |clamp: &&ChainContact| match clamp.stands {
        Stands::Clamped { time: held } => {
            held <= time && *clamp != contact && (clamp.segment, clamp.at) >= (contact.segment, contact.at)
        }
        _ => false,
    };
    match contacts.iter().find(below) {
        Some(_) => Err(group.refuse_as_written("segment", Quantity::Count, Allowed::Need(BELOW))),
        None => Ok(()),
    }
}

impl Group<'_> {
    /// An error of a scenario, with its keys as they stand here.
    fn own(&self, error: ScenarioError, names: &[(&str, &str)]) -> ChainError {
        let renamed = |key: &str| {
            let (_, name, rest) = names.iter().find_map(|(from, to)| Some((from, to, key.strip_prefix(from)?)))?;
            Some(if *name == "end" { "end".to_owned() } else { format!("{name}{rest}") })
        };
        match error {
            ScenarioError::Value(refused) => match renamed(&refused.key) {
                Some(key) if key != "end" => {
                    let Refused { quantity, value, allowed, .. } = *refused;
                    self.refuse(&key, quantity, value, allowed.within("robot."))
                }
                Some(key) => whole(ScenarioError::Value(Box::new(Refused { key, ..*refused }))),
                None => whole(ScenarioError::Value(refused)),
            },
            ScenarioError::UnknownKey { key, known } => match renamed(&key) {
                Some(key) => self.at(&key, ScenarioError::UnknownKey { key: self.key(&key), known }),
                None => whole(ScenarioError::UnknownKey { key, known }),
            },
            other => whole(other),
        }
    }

    fn refuse_at(&self, path: [&str; 2], value: &Toml, allowed: Allowed) -> ChainError {
        let error = Refused::error(path.join("."), Quantity::Word, Value::Other(value.to_string()), allowed);
        ChainError { line: self.line_of(path), fault: Fault::Scenario(error) }
    }
}
