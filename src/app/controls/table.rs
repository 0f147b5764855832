//! Every control of the page, a row each: its label and how it slides. What it sets and means, its unit and the ends of
//! its slider are those of the table of keys.

use crate::app::controls::control::{Choice, Control, Group, Scale, Words};
use crate::app::controls::{contact, span};
use Scale::{Linear, Log, LogWhole, Stops, Whole};
use centrode_core::scenario::keys::{self, Key};
use centrode_core::scenario::{ContactKind, Method, Scenario};

mod calibration;
mod forces;

/// The key of a path; a constant of a path that does not exist does not compile.
const fn key(path: &str) -> &'static Key {
    match keys::find(path) {
        Some(key) => key,
        None => panic!("there is no such key"),
    }
}

/// A row: key, label, digits after the point, and how values lie along the slider.
const fn row(path: &'static str, label: &'static str, decimals: usize, scale: Scale) -> Control {
    Control { key: path, of: key(path), part: None, label, decimals, scale, hint: "", words: None, only: None }
}

impl Control {
    const fn with_words(self, hint: &'static str, words: Words) -> Self {
        Self { hint, words: Some(words), ..self }
    }

    const fn only_for(self, hint: &'static str, only: fn(&Scenario) -> bool) -> Self {
        Self { hint, only: Some(only), ..self }
    }
}

const CONTACT: &[Control] = &[
    row("contact.disk", "Contact disk", 0, Stops).with_words(
        "Or type an arc length, such as 18 mm.",
        Words { place: span::disk, label: |_| None, show: contact::show_place, enter: contact::enter_place },
    ),
    row("contact.time", "Contact time", 2, Linear(0.01)).with_words(
        "Or type a bend, such as 56°.",
        Words {
            place: span::contact_start,
            label: contact::label_start,
            show: contact::show_start,
            enter: contact::enter_start,
        },
    ),
    row("motion.delta", "Bending direction δ", 0, Linear(1.0)),
    row("contact.rounding", "Rounding", 1, Linear(0.1))
        .only_for("A larger one is a thicker beam.", |scenario| scenario.contact.kind == ContactKind::Cylinder),
];

const CONTACT_CHOICES: &[Choice] =
    &[Choice { of: key("contact.kind"), label: "Beam", hint: "", options: &["Clamp", "Plane", "Cylinder"] }];

const SENSORS: &[Control] = &[
    row("load_cells.epsilon_tau", "Load cell error ε_τ", 1, Linear(0.5)),
    row("tracker.position_noise", "Position noise", 3, Log(0.001)),
    row("tracker.orientation_noise", "Orientation noise", 3, Log(0.001)),
    row("seed", "Seed", 0, Whole),
];

const FILTER: &[Control] = &[row("filter.length", "Filter length N", 0, LogWhole)];

const THRESHOLDS: &[Control] = &[
    row("detection.xi2", "ξ2 (centrode)", 1, Linear(0.1)),
    row("detection.xi1", "ξ1 (joint force)", 1, Linear(1.0)),
    row("detection.xi1_factor", "k in k·ε_c(θL)", 2, Linear(0.05)),
    row("detection.armed_from", "Armed from", 2, Linear(0.05)),
    row("detection.release", "Release", 0, Linear(1.0)),
    row("detection.hold", "Hold", 2, Linear(0.01)),
    row("detection.consistent", "ξf (consistent centrode)", 2, Linear(0.05))
        .only_for("", |scenario| scenario.detection.detectors.has(Method::FcdConsistent)),
    row("detection.velocity", "ξv (velocity)", 2, Linear(0.05))
        .only_for("", |scenario| scenario.detection.detectors.has(Method::FcdVelocity)),
    row("detection.cusum", "h (CUSUM)", 2, Linear(0.05))
        .only_for("", |scenario| scenario.detection.detectors.has(Method::Cusum)),
    row("detection.glr", "hΛ (GLR)", 2, Linear(0.05))
        .only_for("", |scenario| scenario.detection.detectors.has(Method::Glr)),
];

const MOTION: &[Control] = &[
    row("motion.theta_start", "θL at the start", 1, Linear(1.0)),
    row("motion.theta_end", "θL at the end", 1, Linear(1.0)),
    row("motion.start", "Motion starts", 2, Linear(0.05)),
    row("motion.finish", "Motion ends", 2, Linear(0.05)),
    row("motion.end", "Run ends", 2, Linear(0.1)),
];

const ROBOT: &[Control] = &[
    row("robot.length", "Length L", 1, Linear(0.5)),
    row("robot.pitch_radius", "Pitch radius r", 2, Linear(0.05)),
    row("robot.primary.youngs_modulus", "Young's modulus, primary", 1, Linear(0.5)),
    row("robot.secondary.youngs_modulus", "Young's modulus, secondary", 1, Linear(0.5)),
];

const DEVICES: &[Control] = &[
    row("tracker.rate", "Tracker rate", 0, Linear(5.0)),
    row("tracker.latency", "Tracker latency", 3, Linear(0.005)),
    row("tracker.position_resolution", "Position resolution", 3, Log(0.001)),
    row("tracker.orientation_resolution", "Orientation resolution", 3, Log(0.001)),
    row("detection.min_speed", "Speed floor", 2, Linear(0.05)),
];

const DEVICE_CHOICES: &[Choice] = &[
    Choice { of: key("filter.averaging"), label: "Averaging", hint: "", options: &["readings", "rotations"] },
    Choice { of: key("tracker.mounting"), label: "Mounting", hint: "", options: &["bending axis", "aligned"] },
];

/// All of them, in the order shown.
pub static GROUPS: &[Group] = &[
    Group { name: "Contact", folded: false, controls: CONTACT, choices: CONTACT_CHOICES, note: "" },
    Group { name: "Sensors", folded: false, controls: SENSORS, choices: &[], note: "" },
    Group { name: "Filter", folded: false, controls: FILTER, choices: &[], note: "" },
    Group { name: "Thresholds", folded: false, controls: THRESHOLDS, choices: forces::CHOICES, note: "" },
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
    Group {
        name: "Calibration errors",
        folded: true,
        controls: calibration::ERRORS,
        choices: calibration::ERROR_CHOICES,
        note: calibration::ERROR_NOTE,
    },
    Group {
        name: "Calibration filter",
        folded: true,
        controls: calibration::PRIOR,
        choices: &[],
        note: calibration::PRIOR_NOTE,
    },
];

/// The control of a key.
#[must_use]
pub fn control(key: &str) -> Option<&'static Control> {
    GROUPS.iter().flat_map(|group| group.controls).find(|control| control.key == key)
}

/// The control that sets a key, or the key that can be given in its place; a path may end with the place in a list.
#[must_use]
pub fn control_of(path: &str) -> Option<&'static Control> {
    let instead = |path| keys::find(path).and_then(Key::other).and_then(|other| control(other.path));
    control(path).or_else(|| instead(path))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::memo::check;
    use centrode_core::scenario::{Estimated, Threshold};

    #[test]
    fn every_row_sets_what_it_gets_and_copies_it() {
        for control in GROUPS.iter().flat_map(|group| group.controls) {
            let preset = Scenario::default();
            let (low, high) = control.range(&preset);
            for value in [low, high, (low + high) / 2.0] {
                let value = if control.of.is_whole() { value.round() } else { value };
                let mut scenario = preset.clone();
                control.slide(&mut scenario, value);
                let got = control.value(&scenario).expect(control.key);
                assert!((got - value).abs() <= 1e-9 * value.abs().max(1.0), "{}: {got} ≠ {value}", control.key);
                control.copy(&preset, &mut scenario);
                assert_eq!(scenario, preset, "{}", control.key);
            }
        }
    }

    #[test]
    fn both_ends_of_every_slider_can_be_run() {
        let preset = Scenario::default();
        for control in GROUPS.iter().flat_map(|group| group.controls) {
            let (low, high) = control.range(&preset);
            assert!(low < high, "{}", control.key);
            for value in [low, high] {
                let mut scenario = preset.clone();
                control.slide(&mut scenario, value);
                assert_eq!(check(&scenario), Ok(()), "{} = {value}", control.key);
            }
        }
    }

    #[test]
    fn a_choice_has_an_option_for_each_word() {
        for choice in GROUPS.iter().flat_map(|group| group.choices) {
            let words = choice.of.words().len() + choice.of.any_of().len();
            assert_eq!(choice.options.len(), words, "{}", choice.of.path);
        }
    }

    #[test]
    fn every_key_that_is_given_instead_has_the_control_of_the_other() {
        assert_eq!(control_of("contact.bend").map(|control| control.key), Some("contact.time"));
        assert_eq!(control_of("contact.arc_length").map(|control| control.key), Some("contact.disk"));
        assert_eq!(control_of("load.force[1]").map(|control| control.label), Some("Force y"));
        assert!(control_of("robot.disks[1]").is_none());
    }

    #[test]
    fn a_noise_can_be_typed_auto_and_a_number() {
        let noise = control("prior.position_noise").expect("a row");
        let mut scenario = Scenario::default();
        assert_eq!((noise.text(&scenario), noise.value(&scenario)), (("auto".into(), ""), None));
        noise.enter(&mut scenario, "0.2").expect("a number");
        assert_eq!(scenario.prior.position_noise, Estimated::Known(0.0002));
        assert!(noise.enter(&mut scenario, "off").is_err());
        noise.enter(&mut scenario, " Auto ").expect("auto");
        assert_eq!(scenario.prior.position_noise, Estimated::AUTO);
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
