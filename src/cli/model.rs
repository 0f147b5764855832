//! `centrode model`: every quantity of the model in one configuration.

mod chain;

use super::output::{Failure, json};
use centrode_core::model::contact::Meeting;
use centrode_core::model::contact::branch::{Branch, Ending, Surface};
use centrode_core::model::joints::{joint_jacobian, joints};
use centrode_core::model::{Assumed, Assumption, Configuration, Constrained, Rate, Segment, Touched, locate};
use centrode_core::plant::Shape;
use centrode_core::scenario::Robot;
use centrode_core::scenario::plan::{LENGTHS, MAX_TURN, RADII, check_bend, is_between};
use centrode_core::scenario::text::number;
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::f64::consts::FRAC_PI_2;
use std::io::Write;
use std::path::PathBuf;

/// Flags of `centrode model`; SI units and radians.
#[derive(Debug, Args)]
pub struct ModelArgs {
    /// Segments in series against planes, from a file (see docs/CHAIN.md), in place of one segment.
    #[arg(long, value_name = "FILE.toml", conflicts_with_all = [
        "theta_l", "delta", "s", "contact", "kind", "bend_at_contact", "rounding", "rate", "length", "pitch_radius", "ep_ip", "es_is",
    ])]
    chain: Option<PathBuf>,
    /// Tangent angle at the end disk, rad; pi/2 is straight.
    #[arg(long, value_name = "RAD", allow_hyphen_values = true, required_unless_present = "chain", default_value_t = FRAC_PI_2)]
    theta_l: f64,
    /// Direction of the bending plane, rad.
    #[arg(long, value_name = "RAD", allow_hyphen_values = true, default_value_t = 0.0)]
    delta: f64,
    /// Arc length at which pose and Jacobian are taken, m; the tip when left out.
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    s: Option<f64>,
    /// Arc length at which the segment is held, m; the base when left out.
    #[arg(long, value_name = "M", allow_hyphen_values = true, default_value_t = 0.0)]
    contact: f64,
    /// How the segment is held there.
    #[arg(long, value_enum, default_value_t = Kind::Clamp)]
    kind: Kind,
    /// Bend φ of the whole segment when contact began, rad; that of --theta-l when left out.
    #[arg(long, value_name = "RAD", allow_hyphen_values = true)]
    bend_at_contact: Option<f64>,
    /// Radius of a round beam and of the backbone's envelope together, m; for the cylinder.
    #[arg(long, value_name = "M", allow_hyphen_values = true, default_value_t = ROUNDING)]
    rounding: f64,
    /// Velocity of (theta_l, delta), rad/s.
    #[arg(long, value_name = "TL,D", allow_hyphen_values = true, value_parser = rate, default_value = "-1,0")]
    rate: Rate,
    /// Length of the primary backbone, m.
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    length: Option<f64>,
    /// Radius of the pitch circle, m.
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    pitch_radius: Option<f64>,
    /// Bending stiffness of the primary backbone, N·m².
    #[arg(long, value_name = "N.m2", allow_hyphen_values = true)]
    ep_ip: Option<f64>,
    /// Bending stiffness of each secondary backbone, N·m².
    #[arg(long, value_name = "N.m2", allow_hyphen_values = true)]
    es_is: Option<f64>,
    /// Print JSON instead of a table.
    #[arg(long)]
    json: bool,
}

/// As the default scenario has it, m.
const ROUNDING: f64 = 0.0035;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Position and slope, as in the paper.
    Clamp,
    /// The position along the normal: a flat beam.
    Plane,
    /// The same against a round beam, along which the backbone slides.
    Cylinder,
}

fn rate(text: &str) -> Result<Rate, String> {
    let (theta_l, delta) = text.split_once(',').ok_or("two numbers with a comma between them, as in -0.3,0.1")?;
    let number = |text: &str| match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("{:?} is not a finite number", text.trim())),
    };
    Ok(Rate { theta_l: number(theta_l)?, delta: number(delta)? })
}

/// The answer, with the reference data's keys. Lengths in m, angles in rad, all in {B}.
#[derive(Debug, Serialize)]
struct Answer {
    length: f64,
    pitch_radius: f64,
    ep_ip: f64,
    es_is: f64,
    theta_l: f64,
    delta: f64,
    s: f64,
    s_c: f64,
    rate: [f64; 2],
    position: [f64; 3],
    rotation: [[f64; 3]; 3],
    jacobian_x: [[f64; 2]; 6],
    jacobian_q: [[f64; 2]; 3],
    joint: [f64; 3],
    energy: f64,
    energy_gradient: [f64; 2],
    /// Null while nothing moves.
    centrode: Option<[f64; 3]>,
    constrained_position: [f64; 3],
    constrained_twist: [f64; 6],
    /// Null while nothing moves.
    constrained_centrode: Option<[f64; 3]>,
    bend_at_contact: f64,
    /// Force of the beam on the segment, N, along −n of its tangent plane: positive while the segment bends on.
    contact_force: f64,
    /// Slope of the backbone at the contact, rad.
    contact_slope: f64,
    /// Curvature above the contact, 1/m.
    curvature_above: f64,
    /// Curvature at the base, 1/m.
    curvature_base: f64,
    /// Arc length of the contact now, m: a round beam slides.
    contact_arc_length: f64,
    contact_position: [f64; 3],
    tip_position: [f64; 3],
    /// Derivative of the tip's position by the bend, m/rad.
    tip_rate: [f64; 3],
    /// What Eq. 24 makes of the constrained centrode with the bend at contact known, by what it takes the contact to be.
    located_clamp: Option<Located>,
    located_plane: Option<Located>,
}

/// An answer of Eq. 24, m.
#[derive(Debug, Clone, Copy, Serialize)]
struct Located {
    arc_length: f64,
    distance: f64,
}

/// The segment where it is held.
struct Held {
    shape: Shape,
    force: f64,
    slope: f64,
    above: f64,
    base: f64,
    arc_length: f64,
}

impl ModelArgs {
    /// Evaluates and prints.
    pub fn execute(&self, out: &mut impl Write) -> Result<(), Failure> {
        if let Some(path) = &self.chain {
            return chain::execute(path, self.json, out);
        }
        let answer = self.answer()?;
        if self.json { json(out, &answer) } else { Ok(table(out, &answer)?) }
    }

    fn segment(&self) -> Result<Segment, Failure> {
        let default = Robot::default().segment();
        let segment = Segment {
            length: self.length.unwrap_or(default.length),
            pitch_radius: self.pitch_radius.unwrap_or(default.pitch_radius),
            ep_ip: self.ep_ip.unwrap_or(default.ep_ip),
            es_is: self.es_is.unwrap_or(default.es_is),
        };
        for (flag, value, (least, most)) in
            [("--length", segment.length, LENGTHS), ("--pitch-radius", segment.pitch_radius, RADII)]
        {
            let allowed = format!("a number from {} m to {} m", number(least), number(most));
            demand((least..=most).contains(&value), flag, value, &allowed)?;
        }
        for (flag, value) in [("--ep-ip", segment.ep_ip), ("--es-is", segment.es_is)] {
            demand((0.0..=1e12).contains(&value), flag, value, "a number from 0 to 1e12 N·m²")?;
        }
        Ok(segment)
    }

    fn answer(&self) -> Result<Answer, Failure> {
        let segment = self.segment()?;
        let length = segment.length;
        let s = self.s.unwrap_or(length);
        let configuration = Configuration::from_theta_l(self.theta_l, self.delta);
        check_bend(&segment, "--theta-l", self.theta_l, configuration.bend())
            .map_err(|error| Failure::Input(error.to_string()))?;
        demand(self.delta.abs() <= MAX_TURN, "--delta", self.delta, &format!("an angle within ±{MAX_TURN} rad"))?;
        for (flag, value) in [("--s", s), ("--contact", self.contact)] {
            demand((0.0..=length).contains(&value), flag, value, &format!("from 0 to the length, {length} m"))?;
        }
        let arc = segment.arc(configuration);
        let (pose, jacobian) = arc.pose_and_jacobian(s);
        let (tip, tip_jacobian) = arc.pose_and_jacobian(length);
        let met = self.bend_at_contact.unwrap_or_else(|| configuration.bend());
        check_bend(&segment, "--bend-at-contact", met, met).map_err(|error| Failure::Input(error.to_string()))?;
        let held = self.held(&segment, met, configuration)?;
        let (held_tip, held_jacobian) = held.shape.tip_pose_and_jacobian();
        let bending = held_jacobian.centrode(&held_tip.position, Rate::BENDING);
        let located = |kind| {
            let found = locate(Assumption { kind, met: Some(met) }, length, configuration, Rate::BENDING, &bending?)?;
            Some(Located { arc_length: found.arc_length, distance: found.distance })
        };
        let constrained_centrode = held_jacobian.centrode(&held_tip.position, self.rate);
        let gradient = segment.energy_gradient(&configuration);
        Ok(Answer {
            length,
            pitch_radius: segment.pitch_radius,
            ep_ip: segment.ep_ip,
            es_is: segment.es_is,
            theta_l: self.theta_l,
            delta: self.delta,
            s,
            s_c: self.contact,
            rate: [self.rate.theta_l, self.rate.delta],
            position: pose.position.into(),
            rotation: pose.rotation.transpose().into(),
            jacobian_x: jacobian.to_rows(),
            jacobian_q: joint_jacobian(segment.pitch_radius, &configuration),
            joint: joints(segment.pitch_radius, &configuration).into(),
            energy: segment.energy(&configuration),
            energy_gradient: [gradient.theta_l, gradient.delta()],
            centrode: tip_jacobian.centrode(&tip.position, self.rate).map(Into::into),
            constrained_position: held_tip.position.into(),
            constrained_twist: held_jacobian.twist(self.rate).to_array(),
            constrained_centrode: constrained_centrode.map(Into::into),
            bend_at_contact: met,
            contact_force: held.force,
            contact_slope: held.slope,
            curvature_above: held.above,
            curvature_base: held.base,
            contact_arc_length: held.arc_length,
            contact_position: held.shape.pose(held.arc_length).position.into(),
            tip_position: held_tip.position.into(),
            tip_rate: held_jacobian.twist(Rate::BENDING).linear.into(),
            located_clamp: located(Assumed::Clamp),
            located_plane: located(Assumed::Plane),
        })
    }
}

impl ModelArgs {
    /// The segment as it is held since the bend `met` (rad).
    fn held(&self, segment: &Segment, met: f64, configuration: Configuration) -> Result<Held, Failure> {
        let (length, bend) = (segment.length, configuration.bend());
        let surface = match self.kind {
            Kind::Clamp => {
                let held = Constrained::new(length, self.contact, met, configuration);
                let (slope, upper) = (held.lower.configuration.bend(), length - self.contact);
                let above = if upper > 0.0 { (bend - slope) / upper } else { f64::NAN };
                let (base, arc_length) = (met / length, self.contact);
                return Ok(Held { shape: Shape::Held(held), force: 0.0, slope, above, base, arc_length });
            }
            Kind::Plane => Surface::Plane,
            Kind::Cylinder => {
                let allowed = format!("from 0 to the length, {} m", number(length));
                demand((0.0..=length).contains(&self.rounding), "--rounding", self.rounding, &allowed)?;
                Surface::Cylinder { rounding: self.rounding / length }
            }
        };
        let inside = is_between(self.contact, length);
        let allowed = "a place between the base and the end disk, for a beam that only touches (--kind)";
        demand(inside, "--contact", self.contact, allowed)?;
        let side = if bend < met { -1.0 } else { 1.0 };
        let branch = Branch::new(Meeting { place: self.contact / length, bend: met, side }, surface, bend);
        if let Some((end, how)) = branch.ending() {
            let how = match how {
                Ending::Snaps => "the segment snaps off the beam at",
                Ending::SlidesOff => "the beam slides over the segment's end at",
                Ending::Wraps => "the segment would lie along the round beam, which is not modelled, from",
                Ending::Opens => "the segment comes off the beam at",
            };
            let allowed = format!("met at a bend of {} rad, {how} a bend of {} rad", number(met), number(end));
            return Err(Failure::Input(format!("--theta-l = {} is not allowed: {allowed}", number(self.theta_l))));
        }
        let touched = Touched::new(length, std::sync::Arc::new(branch), configuration).detailed();
        let touching = touched.touching().ok_or_else(|| {
            Failure::Input(format!("--theta-l = {} is not allowed: no shape was found", number(self.theta_l)))
        })?;
        Ok(Held {
            force: touching.force() * segment.bending_stiffness() / (length * length),
            slope: touching.slope(),
            above: touching.curvature_above() / length,
            base: touching.curvature_base(touched.branch().basis()) / length,
            arc_length: touching.at.place * length,
            shape: Shape::Touched(touched),
        })
    }
}

fn demand(ok: bool, flag: &str, value: f64, allowed: &str) -> Result<(), Failure> {
    if ok { Ok(()) } else { Err(Failure::Input(format!("{flag} = {} is not allowed: {allowed}", number(value)))) }
}

fn table(out: &mut impl Write, answer: &Answer) -> std::io::Result<()> {
    let Answer { length, theta_l, delta, s, s_c, rate, .. } = answer;
    let mut rows = |title: &str, unit: &str, scale: f64, rows: &[&[f64]]| {
        for (i, row) in rows.iter().enumerate() {
            let (title, unit) = if i == 0 { (title, unit) } else { ("", "") };
            write!(out, "{title:<22}")?;
            row.iter().try_for_each(|x| match x * scale {
                // A motion that is none has no axis.
                x if x.is_nan() => write!(out, " {:>14}", "undefined"),
                // What rounds to nothing has no sign.
                x if x.abs() < 5e-7 => write!(out, " {:>14.6}", 0.0),
                x => write!(out, " {x:>14.6}"),
            })?;
            writeln!(out, "  {unit}")?;
        }
        Ok::<(), std::io::Error>(())
    };
    rows("length", "mm", 1e3, &[&[*length]])?;
    rows("theta_l, delta", "deg", 1f64.to_degrees(), &[&[*theta_l, *delta]])?;
    rows("rate", "rad/s", 1.0, &[rate])?;
    rows("s, contact", "mm", 1e3, &[&[*s, *s_c]])?;
    rows("position(s)", "mm", 1e3, &[&answer.position])?;
    rows("rotation(s)", "", 1.0, &answer.rotation.each_ref().map(|row| &row[..]))?;
    let (linear, angular) = answer.jacobian_x.split_at(3);
    rows("jacobian_x linear", "mm/rad", 1e3, &[&linear[0], &linear[1], &linear[2]])?;
    rows("jacobian_x angular", "1", 1.0, &[&angular[0], &angular[1], &angular[2]])?;
    rows("jacobian_q", "mm/rad", 1e3, &answer.jacobian_q.each_ref().map(|row| &row[..]))?;
    rows("joint", "mm", 1e3, &[&answer.joint])?;
    rows("energy", "mJ", 1e3, &[&[answer.energy]])?;
    rows("energy_gradient", "mN·m", 1e3, &[&answer.energy_gradient])?;
    let undefined = [f64::NAN; 3];
    rows("centrode", "mm", 1e3, &[&answer.centrode.unwrap_or(undefined)])?;
    rows("constrained position", "mm", 1e3, &[&answer.constrained_position])?;
    rows("constrained linear", "mm/s", 1e3, &[&answer.constrained_twist[..3]])?;
    rows("constrained angular", "rad/s", 1.0, &[&answer.constrained_twist[3..]])?;
    rows("constrained centrode", "mm", 1e3, &[&answer.constrained_centrode.unwrap_or(undefined)])?;
    rows("bend, slope at contact", "deg", 1f64.to_degrees(), &[&[answer.bend_at_contact, answer.contact_slope]])?;
    rows("contact at", "mm", 1e3, &[&[answer.contact_arc_length], &answer.contact_position])?;
    rows("contact force", "N", 1.0, &[&[answer.contact_force]])?;
    rows("curvature base, above", "1/m", 1.0, &[&[answer.curvature_base, answer.curvature_above]])?;
    rows("tip by bend", "mm/rad", 1e3, &[&answer.tip_rate])?;
    let located = |located: Option<Located>| located.map_or([f64::NAN; 2], |found| [found.arc_length, found.distance]);
    rows("Eq. 24 with clamp", "mm", 1e3, &[&located(answer.located_clamp)])?;
    rows("Eq. 24 with plane", "mm", 1e3, &[&located(answer.located_plane)])
}
