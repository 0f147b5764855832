//! What a key may hold, as data; words and units are made where a person reads them.

use crate::model::Segment;
use crate::model::configuration::bend_from_theta_l;
use crate::scenario::Scenario;
use crate::scenario::keys::quantity::{Quantity, Units, readable};
use crate::scenario::keys::value::Value;
use crate::scenario::keys::{self, Key};
use crate::scenario::plan::{MAX_FILTER, MAX_SAMPLES, steps};
use std::f64::consts::TAU;

/// An end of a range; numbers in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit {
    /// None: any finite number.
    None,
    /// This number, which is itself allowed.
    At(f64),
    /// This number, which is not itself allowed.
    Beyond(f64),
    /// What another key holds, which is itself allowed; with its value where a scenario is at hand.
    Key(&'static str, Option<f64>),
    /// What another key holds, which is not itself allowed.
    BeyondKey(&'static str, Option<f64>),
}

impl Limit {
    /// The same with the other key's value.
    fn of(self, scenario: &Scenario) -> Self {
        let value = |path| keys::find(path).and_then(|key| key.number(scenario));
        match self {
            Self::Key(path, _) => Self::Key(path, value(path)),
            Self::BeyondKey(path, _) => Self::BeyondKey(path, value(path)),
            plain => plain,
        }
    }

    /// The same with the other key's name within a group.
    fn within(self, group: &str) -> Self {
        let own = |path: &'static str| path.strip_prefix(group).unwrap_or(path);
        match self {
            Self::Key(path, value) => Self::Key(own(path), value),
            Self::BeyondKey(path, value) => Self::BeyondKey(own(path), value),
            plain => plain,
        }
    }

    /// The number, and whether it is itself allowed.
    fn number(self) -> (Option<f64>, bool) {
        match self {
            Self::None => (None, true),
            Self::At(value) => (Some(value), true),
            Self::Beyond(value) => (Some(value), false),
            Self::Key(_, value) => (value, true),
            Self::BeyondKey(_, value) => (value, false),
        }
    }

    fn words(self, quantity: Quantity, units: Units) -> String {
        match self {
            Self::None => String::new(),
            Self::At(value) | Self::Beyond(value) => quantity.amount(value, units),
            Self::Key(path, value) | Self::BeyondKey(path, value) => {
                value.map_or_else(|| path.into(), |value| format!("{path} = {}", quantity.amount(value, units)))
            }
        }
    }
}

/// What a key may hold.
///
/// The table of keys says it in general; a refusal says it for the scenario at hand, with what other keys hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Allowed {
    /// Any number.
    Number,
    /// A number from one end to the other.
    Range(Limit, Limit),
    /// A whole number, both ends included.
    Whole(u64, u64),
    /// One of these words.
    Words(&'static [&'static str]),
    /// Any of these words, each at most once.
    Some(&'static [&'static str]),
    /// A number of 0 or more, or the word `off`.
    Threshold,
    /// A number from 0 to one end, or the word `auto`.
    Estimated(Limit),
    /// Three numbers, each at most this far from 0.
    Vector(f64),
    /// Arc lengths of disks, rising.
    Disks,
    /// The arc length of one of them (m): above that of the disk before it, and at most the robot's length.
    NextDisk {
        /// Arc length of the disk before it, m; 0 for the first.
        before: f64,
        /// The robot's length, m.
        length: f64,
    },
    /// A bend that the model holds at; the value is that bend, or θL where the flag is set.
    Bend {
        /// Whether the key holds θL (π/2 is straight) in place of the bend (0 is straight).
        theta_l: bool,
    },
    /// Less than a turn from straight.
    Turn,
    /// A bend (rad) at which no secondary backbone is used up.
    Reach(f64),
    /// The number of a disk, or 0; with how many there are where a scenario is at hand.
    Disk(Option<u64>),
    /// The end of a run that is not too long; with the loop's rate (Hz) where a scenario is at hand.
    RunEnd(Option<f64>),
    /// The length of a filter that is no longer than the run; with the run's samples where a scenario is at hand.
    FilterLength(Option<u64>),
    /// The end of a run that can be kept in memory: at most so many samples (of a run that has how many).
    Kept(usize, usize),
    /// Nothing, while this key is given.
    Without(&'static str),
    /// The keys of this group.
    Group(&'static str),
    /// Cells of a study that have at most so many thresholds together.
    Thresholds(usize),
    /// What a study needs of it, in words.
    Need(&'static str),
}

/// A number of 0 or more.
pub const NOT_NEGATIVE: Allowed = Allowed::Range(Limit::At(0.0), Limit::None);

impl Allowed {
    /// The same with what other keys of a scenario hold.
    #[must_use]
    pub fn of(self, scenario: &Scenario) -> Self {
        match self {
            Self::Range(least, most) => Self::Range(least.of(scenario), most.of(scenario)),
            Self::Disk(_) => Self::Disk(Some(scenario.robot.disks.len() as u64)),
            Self::RunEnd(_) => Self::RunEnd(Some(scenario.loop_rate)),
            Self::FilterLength(_) => Self::FilterLength(Some(steps(scenario) as u64 + 1)),
            general => general,
        }
    }

    /// The same with names of keys as they are within a group of a scenario, such as `robot.`, where it stands elsewhere.
    #[must_use]
    pub fn within(self, group: &str) -> Self {
        match self {
            Self::Range(least, most) => Self::Range(least.within(group), most.within(group)),
            Self::NextDisk { before, length } => Self::Range(Limit::Beyond(before), Limit::At(length)),
            Self::Disks => Self::Need("a list of arc lengths in rising order, each above 0 and at most the length"),
            general => general,
        }
    }

    /// Whether a number is within a range; true for what is no range.
    #[must_use]
    pub fn has(self, value: f64) -> bool {
        let Self::Range(least, most) = self else { return true };
        let above = match least.number() {
            (Some(least), true) => value >= least,
            (Some(least), false) => value > least,
            (None, _) => true,
        };
        let below = match most.number() {
            (Some(most), true) => value <= most,
            (Some(most), false) => value < most,
            (None, _) => true,
        };
        value.is_finite() && above && below
    }

    /// In words, for a value of this quantity.
    #[must_use]
    pub fn words(self, quantity: Quantity, units: Units) -> String {
        let amount = |si| quantity.amount(si, units);
        match self {
            Self::Number => "a number".into(),
            Self::Range(least, most) => range(least, most, quantity, units),
            Self::Whole(least, u64::MAX) => format!("a whole number, {least} or more"),
            Self::Whole(least, most) => format!("a whole number from {least} to {most}"),
            Self::Words(words) => quoted(words, " or "),
            Self::Some(words) => format!("a list of any of {}, each at most once", quoted(words, ", ")),
            Self::Threshold => format!("a finite number, {} or more, or \"off\"", amount(0.0)),
            Self::Estimated(most) => {
                format!("{}, or \"auto\"", range(Limit::At(0.0), most, quantity, units))
            }
            Self::Vector(most) => format!("three numbers, [x, y, z], each from {} to {}", amount(-most), amount(most)),
            Self::Disks => "a list of arc lengths in rising order, each above 0 and at most robot.length".into(),
            Self::NextDisk { before, length } => format!(
                "an arc length above the disk before it ({}) and at most robot.length = {}",
                amount(before),
                amount(length)
            ),
            Self::Bend { .. } => format!(
                "an angle less than one turn ({}) from straight, at which each secondary backbone has some length left",
                turn(units)
            ),
            Self::Turn => format!("a finite angle, less than one turn ({}) from straight", turn(units)),
            Self::Reach(most) => format!(
                "a bend below length/pitch_radius = {}, or a secondary backbone would have no length left",
                Quantity::Angle.amount(most, units)
            ),
            Self::Disk(None) => "the number of a disk, or 0 for no contact".into(),
            Self::Disk(Some(0)) => {
                "0 for no contact, because the robot has no spacer disks (contact.arc_length needs none)".into()
            }
            Self::Disk(Some(count)) => {
                format!("a disk from 1 to {count}, the robot's spacer disks, or 0 for no contact")
            }
            Self::RunEnd(None) => {
                format!("a finite time above {}; a run has at most {MAX_SAMPLES:e} samples", amount(0.0))
            }
            Self::RunEnd(Some(rate)) => format!(
                "a run of at most {MAX_SAMPLES:e} samples, which at loop_rate = {} last {}",
                Quantity::Frequency.amount(rate, units),
                amount(MAX_SAMPLES / rate)
            ),
            Self::FilterLength(None) => {
                let most = readable(MAX_FILTER as f64);
                format!("a whole number from 1 to {most}, and no more than the run has samples")
            }
            Self::FilterLength(Some(samples)) => format!(
                "a whole number from 1 to {}; the run has {samples} samples (motion.end · loop_rate)",
                MAX_FILTER.min(samples)
            ),
            Self::Kept(most, samples) => format!(
                "at most {most} samples in a run that is kept in memory; this one has {samples} (motion.end · loop_rate)"
            ),
            Self::Without(other) => format!("{other} is given as well; give one of the two, not both"),
            Self::Group(path) => format!("a table of keys: {}", keys::names(path).join(", ")),
            Self::Thresholds(most) => {
                format!("at most {most} thresholds in all cells; compare fewer values or thresholds")
            }
            Self::Need(words) => words.into(),
        }
    }
}

fn quoted(words: &[&str], between: &str) -> String {
    let words: Vec<_> = words.iter().map(|word| format!("\"{word}\"")).collect();
    words.join(between)
}

fn turn(units: Units) -> &'static str {
    match units {
        Units::Si => "2π rad",
        Units::Shown => "360°",
    }
}

fn range(least: Limit, most: Limit, quantity: Quantity, units: Units) -> String {
    let (from, to) = (least.words(quantity, units), most.words(quantity, units));
    let time = quantity == Quantity::Time;
    match (least, most) {
        (Limit::None, Limit::None) => "a finite number".into(),
        (Limit::None, Limit::At(_) | Limit::Key(..)) => format!("a finite number, at most {to}"),
        (Limit::None, _) => format!("a finite number below {to}"),
        (Limit::At(_), Limit::None) => format!("a finite number, {from} or more"),
        (Limit::Key(..), Limit::None) if time => format!("a time at or after {from}"),
        (Limit::Key(..), Limit::None) => format!("a finite number, at least {from}"),
        (Limit::BeyondKey(..), Limit::None) if time => format!("a time after {from}"),
        (_, Limit::None) => format!("a finite number above {from}"),
        (Limit::At(_) | Limit::Key(..), Limit::At(_) | Limit::Key(..)) => format!("a number from {from} to {to}"),
        (Limit::At(_) | Limit::Key(..), _) => format!("from {from} to below {to}"),
        (_, Limit::At(_) | Limit::Key(..)) => format!("a number above {from} and at most {to}"),
        (_, _) => format!("a number above {from} and below {to}"),
    }
}

/// What is wrong with a bend (rad) of a segment, if anything.
#[must_use]
pub fn bend_refused(segment: &Segment, bend: f64) -> Option<Allowed> {
    if bend.is_nan() || bend.abs() >= TAU {
        return Some(Allowed::Turn);
    }
    let left = segment.shortest_backbone(bend) > 0.0;
    (!left).then(|| Allowed::Reach(segment.length / segment.pitch_radius))
}

/// What is wrong with a value: the part of the list it is in, the value, and what is allowed in its place.
pub(super) type Fault = (Option<usize>, Value, Allowed);

impl Key {
    /// What is wrong with what a scenario holds under this key; none when nothing is.
    pub(super) fn fault(&self, scenario: &Scenario) -> Option<Fault> {
        let allowed = self.allowed.of(scenario);
        let number = |fault: &dyn Fn(f64) -> Option<Allowed>| {
            let value = self.number(scenario)?;
            fault(value).map(|allowed| (None, Value::Number(value), allowed))
        };
        let whole = |fault: &dyn Fn(u64) -> bool| {
            let value = self.whole(scenario)?;
            fault(value).then_some((None, Value::Whole(value), allowed))
        };
        match allowed {
            Allowed::Range(..) => number(&|value| (!allowed.has(value)).then_some(allowed)),
            Allowed::Threshold => number(&|value| (!NOT_NEGATIVE.has(value)).then_some(allowed)),
            Allowed::Estimated(most) => {
                let range = Allowed::Range(Limit::At(0.0), most);
                number(&|value| (!range.has(value)).then_some(allowed))
            }
            Allowed::Bend { theta_l } => number(&|value| {
                let bend = if theta_l { bend_from_theta_l(value) } else { value };
                bend_refused(&scenario.robot.segment(), bend)
            }),
            Allowed::RunEnd(_) => number(&|end| {
                let positive = Allowed::Range(Limit::Beyond(0.0), Limit::None);
                if positive.has(end) {
                    (steps(scenario) + 1.0 > MAX_SAMPLES).then_some(allowed)
                } else {
                    Some(positive)
                }
            }),
            Allowed::Whole(least, most) => whole(&|value| !(least..=most).contains(&value)),
            Allowed::Disk(count) => whole(&|disk| count.is_some_and(|count| disk > count)),
            Allowed::FilterLength(samples) => {
                whole(&|length| length < 1 || length > samples.unwrap_or(MAX_FILTER).min(MAX_FILTER))
            }
            Allowed::Vector(most) => {
                let allowed = Allowed::Range(Limit::At(-most), Limit::At(most));
                let (part, value) = self.list(scenario)?.iter().copied().enumerate().find(|(_, v)| !allowed.has(*v))?;
                Some((Some(part), Value::Number(value), allowed))
            }
            Allowed::Disks => {
                let length = scenario.robot.length;
                let mut before = 0.0;
                for (part, &disk) in self.list(scenario)?.iter().enumerate() {
                    if !(disk > before && disk <= length) {
                        return Some((Some(part), Value::Number(disk), Allowed::NextDisk { before, length }));
                    }
                    before = disk;
                }
                None
            }
            _ => None,
        }
    }
}
