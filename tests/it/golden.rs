//! Every quantity of the model against the 40-digit reference.

use centrode_core::model::joints::{configuration_from_joints, joint_jacobian, joints};
use centrode_core::model::{Configuration, Constrained, Rate, Segment};
use serde::Deserialize;

#[derive(Deserialize)]
struct Row {
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
    centrode: [f64; 3],
    constrained_position: [f64; 3],
    constrained_twist: [f64; 6],
    constrained_centrode: [f64; 3],
}

fn rows() -> Vec<Row> {
    serde_json::from_str(include_str!("../data/golden.json")).expect("reference data")
}

fn check(what: &str, row: usize, ours: &[f64], reference: &[f64], tolerance: f64) {
    assert_eq!(ours.len(), reference.len());
    for (i, (a, b)) in ours.iter().zip(reference).enumerate() {
        let error = (a - b).abs();
        assert!(error <= tolerance, "row {row}, {what}[{i}]: {a:e} against {b:e}, off by {error:e} > {tolerance:e}");
    }
}

#[test]
fn every_quantity_agrees_with_the_reference() {
    let rows = rows();
    assert_eq!(rows.len(), 28);
    for (n, row) in rows.iter().enumerate() {
        let segment =
            Segment { length: row.length, pitch_radius: row.pitch_radius, ep_ip: row.ep_ip, es_is: row.es_is };
        let configuration = Configuration::from_theta_l(row.theta_l, row.delta);
        let rate = Rate { theta_l: row.rate[0], delta: row.rate[1] };
        let length = 1e-12 * row.length;
        let bend = configuration.bend().abs();
        let stiffness = row.ep_ip + 3.0 * row.es_is;
        // The speed of a tip that turns at the given rate.
        let speed = row.rate[0].abs().max(row.rate[1].abs());

        let arc = segment.arc(configuration);
        let (pose, jacobian) = arc.pose_and_jacobian(row.s);
        check("position", n, pose.position.as_slice(), &row.position, length);
        check("rotation", n, pose.rotation.transpose().as_slice(), row.rotation.as_flattened(), 1e-12);
        let entries = jacobian.to_rows();
        check("jacobian_x linear", n, entries[..3].as_flattened(), row.jacobian_x[..3].as_flattened(), length);
        check("jacobian_x angular", n, entries[3..].as_flattened(), row.jacobian_x[3..].as_flattened(), 1e-12);
        let jacobian_q = joint_jacobian(row.pitch_radius, &configuration);
        check("jacobian_q", n, jacobian_q.as_flattened(), row.jacobian_q.as_flattened(), 1e-12 * row.pitch_radius);

        let q = joints(row.pitch_radius, &configuration);
        check("joint", n, q.as_slice(), &row.joint, 1e-11 * row.pitch_radius * bend);
        let energy = segment.energy(&configuration);
        check("energy", n, &[energy], &[row.energy], 1e-11 * bend * bend * stiffness / row.length);
        let gradient = segment.energy_gradient(&configuration);
        let ours = [gradient.theta_l, gradient.delta()];
        check("energy_gradient", n, &ours, &row.energy_gradient, 1e-11 * bend * stiffness / row.length);

        let (tip, tip_jacobian) = arc.pose_and_jacobian(row.length);
        let centrode = tip_jacobian.centrode(&tip.position, rate).expect("it moves");
        check("centrode", n, centrode.as_slice(), &row.centrode, length);

        let held = Constrained::new(row.length, row.s_c, configuration.bend(), configuration);
        check("constrained_position", n, held.tip_pose().position.as_slice(), &row.constrained_position, length);
        let twist = held.tip_twist(rate).to_array();
        check("constrained_twist linear", n, &twist[..3], &row.constrained_twist[..3], length * speed);
        check("constrained_twist angular", n, &twist[3..], &row.constrained_twist[3..], 1e-12 * speed);
        let centrode = held.centrode(rate).expect("it moves");
        check("constrained_centrode", n, centrode.as_slice(), &row.constrained_centrode, length);

        let back = joints(row.pitch_radius, &configuration_from_joints(row.pitch_radius, &q));
        check("joints there and back", n, back.as_slice(), &row.joint, 1e-11 * row.pitch_radius * bend);
    }
}

/// Sign errors that a symmetric row would hide: the reference must hold rows with both rates and both bends.
#[test]
fn the_reference_covers_both_signs_and_both_rates() {
    let rows = rows();
    let bend = |row: &Row| Configuration::from_theta_l(row.theta_l, row.delta).bend();
    assert!(rows.iter().any(|row| bend(row) < -0.5 && row.rate[1] != 0.0));
    assert!(rows.iter().any(|row| bend(row) > 0.5 && row.rate[1] != 0.0));
    assert!(rows.iter().any(|row| bend(row).abs() < 1e-8));
}
