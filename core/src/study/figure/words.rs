//! Captions: every parameter that matters, as a person reads it.

use crate::chart::Axis;
use crate::chart::ticks::Steps;
use crate::model::Segment;
use crate::model::configuration::theta_l_from_bend;
use crate::scenario::text::number;
use crate::scenario::{CellErrors, ContactKind, Place, Start, Xi1Rule};
use crate::scenario::{Plan, Scenario};

/// Time.
pub fn time() -> Axis {
    Axis::new("t", "s", "s", 1.0)
}

/// The tangent angle θL.
pub fn angle() -> Axis {
    Axis { steps: Steps::Degrees, ..Axis::new("θ_L", "rad", "°", DEGREES) }
}

/// One degree's worth of a radian, inverted.
const DEGREES: f64 = 180.0 / std::f64::consts::PI;
/// Lengths are shown in mm, moments in mN·m.
pub const MILLI: f64 = 1e3;

/// A number to read: seven digits after the point at most.
pub fn plain(value: f64) -> String {
    let shown = libm::rint(value * 1e7) / 1e7;
    number(if shown.is_finite() { shown + 0.0 } else { value }).replace('-', "−")
}

/// An angle in degrees.
pub fn degrees(value: f64) -> String {
    format!("{}°", plain(libm::rint(value * DEGREES * 1e4) / 1e4))
}

/// A length in mm.
pub fn millimetres(value: f64) -> String {
    format!("{} mm", plain(value * MILLI))
}

/// A share in percent.
pub fn percent(value: f64) -> String {
    format!("{} %", plain(value * 100.0))
}

/// `…: parts.` with the words that tell simulation from measurement.
pub fn caption(parts: &[String]) -> String {
    format!("Simulated by Centrode, not the paper's measurement: {}.", parts.join("; "))
}

/// L and r.
pub fn robot(scenario: &Scenario) -> String {
    let robot = &scenario.robot;
    format!("L = {}, r = {}, δ = {}", millimetres(robot.length), millimetres(robot.pitch_radius), {
        degrees(scenario.motion.delta)
    })
}

/// The motion of θL.
pub fn motion(scenario: &Scenario) -> String {
    let motion = &scenario.motion;
    let (from, to) = (degrees(motion.theta_start), degrees(motion.theta_end));
    format!("θ_L from {from} to {to} between {} s and {} s", plain(motion.start), plain(motion.finish))
}

/// Where the beam stands, and what it is.
pub fn contact(plan: &Plan) -> String {
    let contact = &plan.scenario().contact;
    let with = match contact.kind {
        _ if plan.contact().is_none() => String::new(),
        ContactKind::Clamp => String::new(),
        ContactKind::Plane => ", of a flat beam that only touches".into(),
        ContactKind::Cylinder => format!(", of a round beam with ρ = {}", millimetres(contact.rounding)),
    };
    place(plan) + &with
}

/// Where the beam stands.
pub fn place(plan: &Plan) -> String {
    let scenario = plan.scenario();
    let Some(contact) = plan.contact() else { return "no contact".into() };
    let place = match scenario.contact.place {
        Place::Disk(disk) => format!("on disk {disk}, s_c = {}", millimetres(contact.arc_length)),
        _ => format!("at s_c = {}", millimetres(contact.arc_length)),
    };
    match scenario.contact.start {
        Start::Time(time) => format!("contact {place}, at {} s", plain(time)),
        Start::Bend(bend) => format!("contact {place}, at θ_L = {}", degrees(theta_l_from_bend(bend))),
    }
}

/// The load cells' errors, noise and preload.
pub fn cells(scenario: &Scenario) -> String {
    let cells = &scenario.load_cells;
    let errors = match cells.errors {
        CellErrors::Common => "common to the load cells",
        CellErrors::Independent => "drawn for each load cell within ±ε_τ",
    };
    let (noise, preload) = (plain(cells.noise), plain(cells.preload));
    format!("ε_τ = {}, {errors}; load cell noise {noise} N, preload {preload} N", percent(cells.epsilon_tau))
}

/// Tracker noise and the moving average.
pub fn tracker(scenario: &Scenario) -> String {
    let tracker = &scenario.tracker;
    let (position, turn) = (millimetres(tracker.position_noise), degrees(tracker.orientation_noise));
    format!("tracker noise {position} and {turn} at {} Hz; N = {}", plain(tracker.rate), scenario.filter.length)
}

/// ξ2 and when it is looked at.
pub fn detection(scenario: &Scenario) -> String {
    let detection = &scenario.detection;
    let threshold = detection.xi2.value().map_or_else(|| "off".into(), millimetres);
    format!("ξ2 = {threshold}, armed from {} s", plain(detection.armed_from))
}

/// Both thresholds and when they are looked at.
pub fn thresholds(scenario: &Scenario) -> String {
    let set = &scenario.detection;
    let off = || "off".into();
    let xi1 = match set.xi1_rule {
        Xi1Rule::Bound => set.xi1.value().map(|_| format!("{}·ε_c(θ_L)", plain(set.xi1_factor))),
        Xi1Rule::Constant => set.xi1.value().map(|xi1| format!("{} mN·m", plain(xi1 * MILLI))),
    };
    format!("ξ1 = {}, {}", xi1.unwrap_or_else(off), detection(scenario))
}

/// Seed and repeats.
pub fn seed(scenario: &Scenario, repeats: usize) -> String {
    match repeats {
        1 => format!("seed {}", scenario.seed),
        _ => format!("seed {}, {repeats} repeats", scenario.seed),
    }
}

/// Bending stiffnesses of the backbones.
pub fn stiffness(segment: &Segment) -> String {
    // Digits that the input has not are noise to a reader.
    let shown = |value: f64| plain(libm::rint(value * 1e7) / 1e4);
    format!("E_P·I_P = {} and E_S·I_S = {} mN·m² (illustrative)", shown(segment.ep_ip), shown(segment.es_is))
}
