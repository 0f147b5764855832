//! `centrode model --chain`: segments in series against planes, in one configuration.

use crate::cli::output::{Failure, json};
use crate::cli::read;
use centrode_core::model::chain::free::by_theta_l_and_delta;
use centrode_core::model::chain::{Settled, Torsion};
use centrode_core::model::{Configuration, Twist};
use centrode_core::scenario::ChainSetup;
use centrode_core::scenario::text::number;
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

/// The answer: m, rad, N and N·m, all in {B}. Contacts and segments stand in the order of the file.
#[derive(Debug, Serialize)]
struct Answer {
    /// End disks, from the base.
    disks: Vec<Disk>,
    /// Of each disk: its twist by θL of the first segment, by its δ, by θL of the second …; linear first.
    twist_per_rate: Vec<Vec<[f64; 6]>>,
    /// F of each contact, N; 0 where it does not press. The force on the robot is −F n.
    contact_forces: Vec<f64>,
    /// The contacts that press, by their places in the file from 0.
    active: Vec<usize>,
    stability_margin: f64,
    /// How far each contact's point is from its plane, m.
    gaps: Vec<f64>,
    /// Of each contact: its force by θL of the first segment, by its δ …, N/rad.
    force_per_rate: Vec<Vec<f64>>,
    /// M = ∂E*/∂U of each segment, N·m, about x and y of the segment's base.
    moments: Vec<[f64; 2]>,
    /// Elastic energy, J.
    energy: f64,
}

#[derive(Debug, Serialize)]
struct Disk {
    position: [f64; 3],
    /// Rows of `base_from_disk`.
    rotation: [[f64; 3]; 3],
}

/// Reads, solves and prints.
pub(super) fn execute(path: &Path, as_json: bool, out: &mut impl Write) -> Result<(), Failure> {
    let refused = |why: String| Failure::Input(format!("{}: {why}", path.display()));
    let setup = ChainSetup::from_bytes(&read(path)?).map_err(|error| refused(error.to_string()))?;
    let settled = setup.settle().map_err(|unsettled| refused(unsettled.to_string()))?;
    let answer = Answer::new(&settled, &setup.configurations);
    if as_json { json(out, &answer) } else { Ok(table(out, &setup, &answer)?) }
}

impl Answer {
    fn new(settled: &Settled, at: &[Configuration]) -> Self {
        let disk = |disk: &centrode_core::model::chain::Disk| Disk {
            position: disk.pose.position.into(),
            rotation: disk.pose.rotation.transpose().into(),
        };
        let twists = |disk: &centrode_core::model::chain::Disk| {
            disk.by_configuration(at).into_iter().flatten().map(Twist::to_array).collect()
        };
        let by_rate = |force: &Vec<centrode_core::model::chain::Bends>| {
            force.iter().zip(at).flat_map(|(by, at)| by_theta_l_and_delta(*at, [by.x, by.y])).collect()
        };
        Self {
            disks: settled.disks.iter().map(disk).collect(),
            twist_per_rate: settled.disks.iter().map(twists).collect(),
            contact_forces: settled.forces.clone(),
            active: settled.active.clone(),
            stability_margin: settled.margin,
            gaps: settled.gaps.clone(),
            force_per_rate: settled.forces_by_bends.iter().map(by_rate).collect(),
            moments: settled.moments.iter().map(|moment| (*moment).into()).collect(),
            energy: settled.energy,
        }
    }
}

/// Millimetres and degrees, segment by segment.
fn table(out: &mut impl Write, setup: &ChainSetup, answer: &Answer) -> io::Result<()> {
    let mut row = |title: &str, values: &[f64], unit: &str| {
        write!(out, "{title:<26}")?;
        for &value in values {
            // What rounds to nothing has no sign.
            write!(out, " {:>12.6}", if value.abs() < 5e-7 { 0.0 } else { value })?;
        }
        writeln!(out, "  {unit}")
    };
    let scaled = |values: &[f64], scale: f64| values.iter().map(|value| value * scale).collect::<Vec<_>>();
    for (k, (rod, at)) in setup.rods.iter().zip(&setup.configurations).enumerate() {
        let name = |what: &str| format!("segment {}, {what}", k + 1);
        row(&name("length"), &[rod.length * 1e3], "mm")?;
        row(&name("theta_l, delta"), &scaled(&[at.theta_l(), at.delta()], 1f64.to_degrees()), "deg")?;
        let torsion = match rod.torsion {
            Torsion::Rigid => "N·m², rigid in torsion".into(),
            Torsion::Ratio(ratio) => format!("N·m², GJ/EI = {}", number(ratio)),
        };
        row(&name("stiffness"), &[rod.bending_stiffness], &torsion)?;
        row("  disk position", &scaled(&answer.disks[k].position, 1e3), "mm")?;
        for (i, line) in answer.disks[k].rotation.iter().enumerate() {
            row(if i == 0 { "  disk rotation" } else { "" }, line, "")?;
        }
        for (column, twist) in answer.twist_per_rate[k].iter().enumerate().take(2 * k + 2) {
            let by = format!("{} {}", if column.is_multiple_of(2) { "theta_l" } else { "delta" }, column / 2 + 1);
            row(&format!("  linear by {by}"), &scaled(&twist[..3], 1e3), "mm/rad")?;
            row(&format!("  angular by {by}"), &twist[3..], "")?;
        }
        row("  moment", &scaled(&answer.moments[k], 1e3), "mN·m")?;
    }
    for (k, contact) in setup.contacts.iter().enumerate() {
        let pressed = if answer.active.contains(&k) { "presses" } else { "open" };
        let name = format!("contact {} on segment {}", k + 1, contact.segment + 1);
        row(&name, &[contact.at * 1e3], &format!("mm from the segment's base, {pressed}"))?;
        row("  force, gap", &[answer.contact_forces[k], answer.gaps[k] * 1e3], "N, mm")?;
    }
    row("elastic energy", &[answer.energy * 1e3], "mJ")?;
    row("stability margin", &[answer.stability_margin], "(1 without a force, 0 where the chain buckles)")
}
