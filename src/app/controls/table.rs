//! Every control of the page, a row each.

use crate::app::controls::control::{Choice, Control, Group, Scale, Words};
use crate::app::controls::quantity::Quantity;
use crate::app::controls::{contact, span};
use Quantity::{Angle, AngularSpeed, Count, Frequency, Length, Modulus, Moment, Ratio, Time};
use Scale::{Linear, Log, LogWhole, Stops, Whole};
use centrode_core::scenario::Scenario;
use centrode_core::scenario::{Averaging, Mounting, Start, Threshold};

/// The parts of a row that a field of the scenario gives.
struct Field(fn(&Scenario) -> Option<f64>, fn(&mut Scenario, f64), fn(&Scenario, &mut Scenario));

macro_rules! field {
    ($($path:ident).+) => {
        Field(|s| Some(s.$($path).+), |s, v| s.$($path).+ = v, |from, to| to.$($path).+ = from.$($path).+)
    };
    (whole $($path:ident).+) => {
        Field(|s| Some(s.$($path).+ as f64), |s, v| s.$($path).+ = v as u64, |from, to| to.$($path).+ = from.$($path).+)
    };
    (part $i:literal of $($path:ident).+) => {
        Field(|s| Some(s.$($path).+[$i]), |s, v| s.$($path).+[$i] = v, |from, to| to.$($path).+[$i] = from.$($path).+[$i])
    };
    (threshold $($path:ident).+) => {
        Field(|s| s.$($path).+.value(), |s, v| s.$($path).+ = Threshold::On(v), |from, to| to.$($path).+ = from.$($path).+)
    };
}

mod forces;

type Range = fn(&Scenario) -> (f64, f64);

/// A row, its columns in order.
#[expect(clippy::too_many_arguments)]
const fn row(
    key: &'static str,
    label: &'static str,
    quantity: Quantity,
    decimals: usize,
    scale: Scale,
    range: Range,
    field: Field,
    tip: &'static str,
) -> Control {
    let Field(get, set, copy) = field;
    Control { key, label, quantity, decimals, scale, range, tip, get, set, copy, off: None, words: None }
}

const fn with_words(control: Control, words: Words) -> Control {
    Control { words: Some(words), ..control }
}

const fn with_off(control: Control, off: fn(&mut Scenario)) -> Control {
    Control { off: Some(off), ..control }
}

const RUN: Range = |s| (0.0, s.motion.end);

const CONTACT: &[Control] = &[
    with_words(
        row(
            "contact.disk",
            "Contact disk",
            Count,
            0,
            Stops,
            |s| (0.0, s.robot.disks.len() as f64),
            Field(|s| Some(span::disk(s)), contact::set_disk, |from, to| to.contact.place = from.contact.place),
            "Where the beam meets the backbone: at a disk, or type an arc length such as 18 mm.",
        ),
        Words { label: |_| None, show: contact::show_place, enter: contact::enter_place },
    ),
    with_words(
        row(
            "contact.time",
            "Contact time",
            Time,
            2,
            Linear(0.01),
            RUN,
            Field(
                |s| Some(span::contact_start(s)),
                |s, v| s.contact.start = Start::Time(v),
                |from, to| to.contact.start = from.contact.start,
            ),
            "When the backbone reaches the beam. A bend can be typed instead, such as 56°.",
        ),
        Words { label: contact::label_start, show: contact::show_start, enter: contact::enter_start },
    ),
    row(
        "motion.delta",
        "Bending direction δ",
        Angle,
        0,
        Linear(1.0),
        |_| (-180.0, 180.0),
        field!(motion.delta),
        "Turns the bending plane about the straight backbone.",
    ),
];

const SENSORS: &[Control] = &[
    row(
        "load_cells.epsilon_tau",
        "Load cell error ε_τ",
        Ratio,
        1,
        Linear(0.5),
        |_| (0.0, 50.0),
        field!(load_cells.epsilon_tau),
        "Relative error of the three load cells, which sets the bound ε_c; friction counts as one.",
    ),
    row(
        "tracker.position_noise",
        "Position noise",
        Length,
        3,
        Log(0.001),
        |_| (0.0, 1.0),
        field!(tracker.position_noise),
        "Standard deviation of the tracker's white noise on each coordinate.",
    ),
    row(
        "tracker.orientation_noise",
        "Orientation noise",
        Angle,
        3,
        Log(0.001),
        |_| (0.0, 1.0),
        field!(tracker.orientation_noise),
        "Standard deviation of the white noise that turns the marker about each axis of the base.",
    ),
    row(
        "seed",
        "Seed",
        Count,
        0,
        Whole,
        |_| (0.0, 99.0),
        field!(whole seed),
        "Each number gives different noise; the same number gives the same run again.",
    ),
];

const FILTER: &[Control] = &[row(
    "filter.length",
    "Filter length N",
    Count,
    0,
    LogWhole,
    |s| (1.0, (s.motion.end * s.loop_rate).floor().clamp(2.0, 2000.0)),
    field!(whole filter.length),
    "Readings in the moving average: longer is calmer and later. 1 does not filter.",
)];

const THRESHOLDS: &[Control] = &[
    with_off(
        row(
            "detection.xi2",
            "ξ2 (centrode)",
            Length,
            1,
            Linear(0.1),
            |_| (0.0, 20.0),
            field!(threshold detection.xi2),
            "Alarm when the sensor's centrode is farther than this from the model's.",
        ),
        |s| s.detection.xi2 = Threshold::OFF,
    ),
    with_off(
        row(
            "detection.xi1",
            "ξ1 (joint force)",
            Moment,
            1,
            Linear(1.0),
            |_| (0.0, 100.0),
            field!(threshold detection.xi1),
            "Alarm when the joint force deviation Θ exceeds this.",
        ),
        |s| s.detection.xi1 = Threshold::OFF,
    ),
    row(
        "detection.xi1_factor",
        "k in k·ε_c(θL)",
        Count,
        2,
        Linear(0.05),
        |_| (0.0, 5.0),
        field!(detection.xi1_factor),
        "ξ1 as a multiple of the bound ε_c at the shape, while ξ1 follows the shape. Below 1, friction alone alarms.",
    ),
    row(
        "detection.armed_from",
        "Armed from",
        Time,
        2,
        Linear(0.05),
        RUN,
        field!(detection.armed_from),
        "No alarm is raised before this time.",
    ),
];

const MOTION: &[Control] = &[
    row(
        "motion.theta_start",
        "θL at the start",
        Angle,
        1,
        Linear(1.0),
        |_| (-90.0, 180.0),
        field!(motion.theta_start),
        "Tangent angle of the tip before the motion; 90° is straight.",
    ),
    row(
        "motion.theta_end",
        "θL at the end",
        Angle,
        1,
        Linear(1.0),
        |_| (-90.0, 180.0),
        field!(motion.theta_end),
        "Tangent angle of the tip after the motion.",
    ),
    row(
        "motion.start",
        "Motion starts",
        Time,
        2,
        Linear(0.05),
        // A step at least remains for the motion.
        |s| (0.0, (s.motion.finish - 0.05).max(s.motion.finish / 2.0)),
        field!(motion.start),
        "The robot rests before.",
    ),
    row(
        "motion.finish",
        "Motion ends",
        Time,
        2,
        Linear(0.05),
        |s| (s.motion.start + 0.05, s.motion.end.max(s.motion.start + 0.1)),
        field!(motion.finish),
        "The robot rests after.",
    ),
    row(
        "motion.end",
        "Run ends",
        Time,
        2,
        Linear(0.1),
        |s| {
            // The filter is not longer than the run.
            let low = (s.filter.length as f64 / s.loop_rate).max(1.0);
            (low, (low + 1.0).max(20.0))
        },
        field!(motion.end),
        "How long the experiment lasts.",
    ),
];

const ROBOT: &[Control] = &[
    row(
        "robot.length",
        "Length L",
        Length,
        1,
        Linear(0.5),
        |s| {
            let low = s.robot.disks.last().map_or(10.0, |&disk| Length.shown(disk));
            (low, (2.0 * low).max(100.0))
        },
        field!(robot.length),
        "Primary backbone, base disk to end disk.",
    ),
    row(
        "robot.pitch_radius",
        "Pitch radius r",
        Length,
        2,
        Linear(0.05),
        |_| (0.5, 8.0),
        field!(robot.pitch_radius),
        "Circle on which the three secondary backbones stand.",
    ),
    row(
        "robot.primary.youngs_modulus",
        "Young's modulus, primary",
        Modulus,
        1,
        Linear(0.5),
        |_| (1.0, 120.0),
        field!(robot.primary.youngs_modulus),
        "Modulus of elasticity of the central tube.",
    ),
    row(
        "robot.secondary.youngs_modulus",
        "Young's modulus, secondary",
        Modulus,
        1,
        Linear(0.5),
        |_| (1.0, 120.0),
        field!(robot.secondary.youngs_modulus),
        "Modulus of elasticity of each of the three outer tubes.",
    ),
];

const DEVICES: &[Control] = &[
    row(
        "tracker.rate",
        "Tracker rate",
        Frequency,
        0,
        Linear(5.0),
        |_| (10.0, 500.0),
        field!(tracker.rate),
        "How often the tracker has a new reading; the loop holds the last one.",
    ),
    row(
        "tracker.latency",
        "Tracker latency",
        Time,
        3,
        Linear(0.005),
        |_| (0.0, 0.2),
        field!(tracker.latency),
        "Age of a reading when it arrives.",
    ),
    row(
        "tracker.position_resolution",
        "Position resolution",
        Length,
        3,
        Log(0.001),
        |_| (0.0, 1.0),
        field!(tracker.position_resolution),
        "Coordinates are rounded to multiples of this; 0 does not round.",
    ),
    row(
        "tracker.orientation_resolution",
        "Orientation resolution",
        Angle,
        3,
        Log(0.001),
        |_| (0.0, 1.0),
        field!(tracker.orientation_resolution),
        "Angles are rounded to multiples of this; 0 does not round.",
    ),
    row(
        "detection.min_speed",
        "Speed floor",
        AngularSpeed,
        2,
        Linear(0.05),
        |_| (0.0, 10.0),
        field!(detection.min_speed),
        "Centrodes are judged only while the end disk turns faster.",
    ),
];

const DEVICE_CHOICES: &[Choice] = &[
    Choice {
        key: "filter.averaging",
        label: "Averaging",
        tip: "Average the six readings one by one, as in the paper, or the rotations themselves.",
        options: &["readings", "rotations"],
        get: |s| usize::from(s.filter.averaging == Averaging::Rotations),
        set: |s, i| s.filter.averaging = if i == 0 { Averaging::Readings } else { Averaging::Rotations },
        copy: |from, to| to.filter.averaging = from.filter.averaging,
    },
    Choice {
        key: "tracker.mounting",
        label: "Mounting",
        tip: "Marker's x axis along the bending axis, or aligned with the end disk: singular at 90° of bend.",
        options: &["bending axis", "aligned"],
        get: |s| usize::from(s.tracker.mounting == Mounting::Aligned),
        set: |s, i| s.tracker.mounting = if i == 0 { Mounting::BendingAxis } else { Mounting::Aligned },
        copy: |from, to| to.tracker.mounting = from.tracker.mounting,
    },
];

/// All of them, in the order shown.
pub static GROUPS: &[Group] = &[
    Group { name: "Contact", folded: false, controls: CONTACT, choices: &[], note: "" },
    Group { name: "Sensors", folded: false, controls: SENSORS, choices: &[], note: "" },
    Group { name: "Filter", folded: false, controls: FILTER, choices: &[], note: "" },
    Group { name: "Thresholds", folded: false, controls: THRESHOLDS, choices: forces::XI1_CHOICES, note: "" },
    Group { name: "Motion", folded: true, controls: MOTION, choices: &[], note: "" },
    Group { name: "Robot", folded: true, controls: ROBOT, choices: &[], note: "" },
    Group { name: "Tracker", folded: true, controls: DEVICES, choices: DEVICE_CHOICES, note: "" },
    Group {
        name: "Load cells",
        folded: true,
        controls: forces::CELLS,
        choices: forces::CELL_CHOICES,
        note: forces::PRELOAD_NOTE,
    },
    Group { name: "Load on the tip", folded: true, controls: forces::LOAD, choices: &[], note: "" },
];

/// The control of a key.
#[must_use]
pub fn control(key: &str) -> Option<&'static Control> {
    GROUPS.iter().flat_map(|group| group.controls).find(|control| control.key == key)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::memo::check;

    #[test]
    fn every_row_sets_what_it_gets_and_copies_it() {
        for control in GROUPS.iter().flat_map(|group| group.controls) {
            let preset = Scenario::default();
            let (low, high) = (control.range)(&preset);
            for value in [low, high, (low + high) / 2.0] {
                let value = if control.scale.is_whole() { value.round() } else { value };
                let mut scenario = preset.clone();
                control.slide(&mut scenario, value);
                let got = control.value(&scenario).expect(control.key);
                assert!((got - value).abs() <= 1e-9 * value.abs().max(1.0), "{}: {got} ≠ {value}", control.key);
                (control.copy)(&preset, &mut scenario);
                assert_eq!(scenario, preset, "{}", control.key);
            }
        }
    }

    #[test]
    fn both_ends_of_every_slider_can_be_run() {
        let preset = Scenario::default();
        for control in GROUPS.iter().flat_map(|group| group.controls) {
            let (low, high) = (control.range)(&preset);
            assert!(low < high, "{}", control.key);
            for value in [low, high] {
                let mut scenario = preset.clone();
                control.slide(&mut scenario, value);
                assert_eq!(check(&scenario), Ok(()), "{} = {value}", control.key);
            }
        }
    }

    #[test]
    fn the_key_is_a_key_of_the_scenario() {
        let toml = Scenario::default().to_toml();
        for key in GROUPS
            .iter()
            .flat_map(|group| group.controls.iter().map(|c| c.key).chain(group.choices.iter().map(|c| c.key)))
        {
            let name = key.rsplit('.').next().and_then(|name| name.split('[').next()).expect("name");
            assert!(toml.lines().any(|line| line.starts_with(&format!("{name} ="))), "{key}");
        }
    }

    #[test]
    fn a_threshold_can_be_typed_off() {
        let xi2 = control("detection.xi2").expect("a row");
        let mut scenario = Scenario::default();
        xi2.enter(&mut scenario, "off").expect("off");
        assert_eq!((scenario.detection.xi2, xi2.value(&scenario)), (Threshold::OFF, None));
        xi2.enter(&mut scenario, "6.5").expect("on");
        assert_eq!(scenario.detection.xi2, Threshold::On(0.0065));
    }
}
