//! Segments in series against the references handed to the project: free, and against planes, with and without torsion.

use centrode_core::model::chain::free::by_theta_l_and_delta;
use centrode_core::model::chain::joints::{configurations_from_joints, joints};
use centrode_core::model::chain::{Contact, Disk, Rod, Settled, Torsion, free, settle};
use centrode_core::model::{Configuration, Twist, Vec3};
use serde::Deserialize;

#[derive(Deserialize)]
struct Reference<T> {
    cases: Vec<T>,
}

#[derive(Deserialize)]
#[allow(non_snake_case)]
struct Inputs {
    L: Vec<f64>,
    EI: Vec<f64>,
    theta_L: Vec<f64>,
    delta: Vec<f64>,
    contacts: Vec<Plane>,
}

#[derive(Deserialize)]
struct Plane {
    /// From the base of the chain.
    s: f64,
    segment: usize,
    normal: [f64; 3],
    offset: f64,
}

#[derive(Deserialize)]
struct Rigid {
    id: u32,
    #[serde(flatten)]
    inputs: Inputs,
    joints: Joints,
    out: Answer,
}

#[derive(Deserialize)]
struct Joints {
    r: f64,
    gamma: Vec<f64>,
    q: Vec<[f64; 3]>,
}

#[derive(Deserialize)]
#[allow(non_snake_case)]
struct Answer {
    active: Vec<usize>,
    force: Vec<f64>,
    gap: Vec<f64>,
    moment_M: Vec<[f64; 2]>,
    disks: Vec<Pose>,
    twist_per_rate: Vec<Vec<[f64; 6]>>,
    twist_per_U: Vec<Vec<[f64; 6]>>,
    dforce_per_rate: Vec<Vec<f64>>,
    /// JSON has no infinity: none is read where nothing presses.
    smallest_reduced_eigenvalue: Option<f64>,
}

#[derive(Deserialize)]
struct Twisting {
    id: u32,
    #[serde(flatten)]
    inputs: Inputs,
    #[serde(rename = "GJ_over_EI")]
    torsion: f64,
    active: Vec<usize>,
    force: Vec<f64>,
    smallest_reduced_eigenvalue: f64,
    disks: Vec<Pose>,
    twist_per_rate: Vec<Vec<[f64; 6]>>,
}

#[derive(Deserialize)]
struct Pose {
    position: [f64; 3],
    rotation: [[f64; 3]; 3],
}

fn rigid() -> Vec<Rigid> {
    let text = include_str!("../data/chain.json").replace("Infinity", "null");
    serde_json::from_str::<Reference<Rigid>>(&text).expect("reference data").cases
}

fn twisting() -> Vec<Twisting> {
    let text = include_str!("../data/chain_torsion.json");
    serde_json::from_str::<Reference<Twisting>>(text).expect("reference data").cases
}

impl Inputs {
    fn configurations(&self) -> Vec<Configuration> {
        self.theta_L
            .iter()
            .zip(&self.delta)
            .map(|(theta_l, delta)| Configuration::from_theta_l(*theta_l, *delta))
            .collect()
    }

    fn rods(&self, torsion: Torsion) -> Vec<Rod> {
        let each = self.L.iter().zip(&self.EI);
        each.map(|(&length, &bending_stiffness)| Rod { length, bending_stiffness, torsion }).collect()
    }

    fn planes(&self) -> Vec<Contact> {
        let contact = |plane: &Plane| {
            let segment = plane.segment - 1;
            let at = plane.s - self.L[..segment].iter().sum::<f64>();
            Contact { segment, at, normal: plane.normal.into(), offset: plane.offset }
        };
        self.contacts.iter().map(contact).collect()
    }

    fn settle(&self, torsion: Torsion) -> Settled {
        settle(&self.rods(torsion), &self.configurations(), &self.planes()).expect("stable")
    }

    fn length(&self) -> f64 {
        self.L.iter().sum()
    }
}

fn near(what: &str, ours: &[f64], reference: &[f64], tolerance: f64) {
    assert_eq!(ours.len(), reference.len(), "{what}");
    for (i, (a, b)) in ours.iter().zip(reference).enumerate() {
        assert!(
            (a - b).abs() <= tolerance,
            "{what}[{i}]: {a:e} against {b:e}, off by {:e} > {tolerance:e}",
            (a - b).abs()
        );
    }
}

/// Every end disk: poses, and twists by the rates of θL and δ.
fn check_disks(
    id: u32,
    disks: &[Disk],
    at: &[Configuration],
    poses: &[Pose],
    twists: &[Vec<[f64; 6]>],
    tolerance: f64,
) {
    for (k, (disk, pose)) in disks.iter().zip(poses).enumerate() {
        let what = |name: &str| format!("case {id}, disk {k}, {name}");
        near(&what("position"), disk.pose.position.as_slice(), &pose.position, tolerance * 0.1);
        near(&what("rotation"), disk.pose.rotation.transpose().as_slice(), pose.rotation.as_flattened(), tolerance);
        let ours = disk.by_configuration(at).into_iter().flatten().map(Twist::to_array);
        for (column, (ours, reference)) in ours.zip(&twists[k]).enumerate() {
            near(&what(&format!("twist {column}, linear")), &ours[..3], &reference[..3], tolerance * 0.1);
            near(&what(&format!("twist {column}, angular")), &ours[3..], &reference[3..], tolerance);
        }
        assert_eq!(twists[k].len(), 2 * at.len());
    }
    assert_eq!((disks.len(), poses.len()), (at.len(), at.len()));
}

#[test]
fn free_chains_agree_with_the_reference() {
    let cases: Vec<Rigid> = rigid().into_iter().filter(|case| case.inputs.contacts.is_empty()).collect();
    assert!(cases.len() >= 3);
    for case in &cases {
        let at = case.inputs.configurations();
        check_disks(case.id, &free(&case.inputs.L, &at), &at, &case.out.disks, &case.out.twist_per_rate, 1e-12);
        let settled = case.inputs.settle(Torsion::Rigid);
        assert_eq!(settled.disks, free(&case.inputs.L, &at));
        for (ours, reference) in settled.moments.iter().zip(&case.out.moment_M) {
            near("moment", ours.as_slice(), reference, 1e-10);
        }
        for (disk, reference) in settled.disks.iter().zip(&case.out.twist_per_U) {
            for (ours, reference) in disk.by_bends.iter().flatten().zip(reference) {
                near("twist by U", &ours.to_array(), reference, 1e-12);
            }
        }
    }
}

#[test]
fn joint_values_agree_with_the_reference_and_lead_back() {
    for case in rigid() {
        let (at, Joints { r, gamma, q }) = (case.inputs.configurations(), &case.joints);
        let ours = joints(*r, gamma, &at);
        let reference: Vec<Vec3> = q.iter().map(|q| Vec3::from(*q)).collect();
        for (ours, reference) in ours.iter().zip(&reference) {
            near("joints", ours.as_slice(), reference.as_slice(), 1e-12 * r);
        }
        let back = configurations_from_joints(*r, gamma, &reference);
        for (back, at) in back.iter().zip(&at) {
            assert!((back.bend() - at.bend()).abs() < 1e-12, "case {}", case.id);
        }
        let again = joints(*r, gamma, &back);
        again.iter().zip(&reference).for_each(|(a, b)| near("there and back", a.as_slice(), b.as_slice(), 1e-12 * r));
    }
}

#[test]
fn chains_without_torsion_agree_with_the_reference() {
    for case in rigid() {
        let settled = case.inputs.settle(Torsion::Rigid);
        let (at, out, id) = (case.inputs.configurations(), &case.out, case.id);
        let largest = out.force.iter().fold(0.0f64, |a, b| a.max(*b));
        assert_eq!(settled.active, out.active, "case {id}");
        near("force", &settled.forces, &out.force, 1e-9 * largest);
        near("gap", &settled.gaps, &out.gap, 1e-10 * case.inputs.length());
        check_disks(id, &settled.disks, &at, &out.disks, &out.twist_per_rate, 1e-9);
        for (ours, reference) in settled.moments.iter().zip(&out.moment_M) {
            near("moment", ours.as_slice(), reference, 1e-9 * case.inputs.length() * largest + 1e-10);
        }
        for (place, reference) in out.active.iter().zip(&out.dforce_per_rate) {
            let by = settled.forces_by_bends[*place].iter().zip(&at);
            let ours: Vec<f64> = by.flat_map(|(by, at)| by_theta_l_and_delta(*at, [by.x, by.y])).collect();
            near("force by rate", &ours, reference, 1e-8 * largest);
        }
        if let Some(margin) = out.smallest_reduced_eigenvalue {
            near("margin", &[settled.margin], &[margin], 1e-8);
        }
    }
}

#[test]
fn chains_that_twist_agree_with_the_reference() {
    for case in twisting() {
        let settled = case.inputs.settle(Torsion::Ratio(case.torsion));
        let largest = case.force.iter().fold(0.0f64, |a, b| a.max(*b));
        assert_eq!(settled.active, case.active, "case {}", case.id);
        near("force", &settled.forces, &case.force, 1e-9 * largest);
        check_disks(case.id, &settled.disks, &case.inputs.configurations(), &case.disks, &case.twist_per_rate, 1e-9);
        near("margin", &[settled.margin], &[case.smallest_reduced_eigenvalue], 1e-8);
    }
}
