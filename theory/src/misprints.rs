//! The misprints with their proof in numbers: what is printed, what the derivative of Eqs. 3 and 4 says, and what the code computes.

use crate::math;
use anyhow::{Context, Result};
use centrode_core::chart::notation::number;
use centrode_core::model::joints::joint_jacobian;
use centrode_core::model::{Arc, Configuration, Vec3};
use centrode_core::scenario::Scenario;
use std::fmt::Write;

/// Where the numbers are compared: θL and δ in rad, and the share of the backbone below.
const THETA_L: f64 = 0.6;
const DELTA: f64 = 0.8;
const SHARE: f64 = 0.6;
/// Step of the central differences, rad.
const STEP: f64 = 1e-5;

/// A misprint: where it is, what is printed and what is right (TeX), why, and a number of each with that of the proof.
struct Misprint {
    place: &'static str,
    printed: &'static str,
    right: &'static str,
    why: &'static str,
    values: [f64; 3],
    /// Decimals, the unit shown, and what values are multiplied by to be shown in it.
    shown: (usize, &'static str, f64),
}

/// The entry of the Jacobian by central differences of pose: linear rows 0 to 2, angular rows 3 to 5.
fn derivative(length: f64, s: f64, column: usize) -> [f64; 6] {
    let pose = |step: f64| {
        let (by_theta, by_delta) = if column == 0 { (step, 0.0) } else { (0.0, step) };
        let configuration = Configuration::from_theta_l(THETA_L + by_theta, DELTA + by_delta);
        Arc { length, configuration }.pose(s)
    };
    let (back, here, on) = (pose(-STEP), pose(0.0), pose(STEP));
    let linear = (on.position - back.position) / (2.0 * STEP);
    let omega = (on.rotation - back.rotation) / (2.0 * STEP) * here.rotation.transpose();
    [linear.x, linear.y, linear.z, omega[(2, 1)], omega[(0, 2)], omega[(1, 0)]]
}

fn kinematics(length: f64) -> Vec<Misprint> {
    let s = SHARE * length;
    let configuration = Configuration::from_theta_l(THETA_L, DELTA);
    let ours = Arc { length, configuration }.jacobian(s).to_rows();
    let truth = [derivative(length, s, 0), derivative(length, s, 1)];
    let over = -configuration.bend();
    let (sin_s, cos_s) = (std::f64::consts::FRAC_PI_2 + s / length * over).sin_cos();
    let (sin_d, cos_d) = DELTA.sin_cos();
    let v1 = s * over * cos_s - length * (sin_s - 1.0);
    let printed_v1 = over.sin() * cos_s - length * (sin_s - 1.0);
    let entry = |row: usize, column: usize, printed: f64| [printed, truth[column][row], ours[row][column]];
    vec![
        Misprint {
            place: "Eq. 9, first term of <i>v</i><sub>1</sub>",
            printed: r"\sin(\theta_L-\theta_0)\cos\theta_s",
            right: r"s\,(\theta_L-\theta_0)\cos\theta_s",
            why: "The other term is a length, so this one must be a length.",
            values: entry(0, 0, cos_d * printed_v1 / (over * over)),
            shown: (3, "mm", 1e3),
        },
        Misprint {
            place: "Eq. 8, row 2, column 1",
            printed: r"+\sin\delta\,v_1/(\theta_L-\theta_0)^2",
            right: r"-\sin\delta\,v_1/(\theta_L-\theta_0)^2",
            why: "It is the derivative of the second component of Eq. 3, which has the minus.",
            values: entry(1, 0, sin_d * v1 / (over * over)),
            shown: (3, "mm", 1e3),
        },
        Misprint {
            place: "Eq. 8, rows 4 and 5, column 1",
            printed: r"-\sin\delta,\; -\cos\delta",
            right: r"-\tfrac{s}{L}\sin\delta,\; -\tfrac{s}{L}\cos\delta",
            why: "By Eq. 6 only the share s/L of the bend lies below. Both agree at the tip alone.",
            values: entry(3, 0, -sin_d),
            shown: (5, "", 1.0),
        },
        Misprint {
            place: "Eq. 8, rows 4 to 6, column 2",
            printed: r"\cos\delta\sin\theta_s,\; -\sin\delta\sin\theta_s,\; \cos\theta_s-1",
            right: r"\cos\delta\cos\theta_s,\; -\sin\delta\cos\theta_s,\; \sin\theta_s-1",
            why: "A straight segment does not turn when its bending direction changes; as printed, it would.",
            values: entry(3, 1, cos_d * sin_s),
            shown: (5, "", 1.0),
        },
    ]
}

fn statics() -> Result<Vec<Misprint>> {
    let segment = Scenario::default().robot.segment();
    let configuration = Configuration::from_theta_l(THETA_L, DELTA);
    let gradient = segment.energy_gradient(&configuration);
    let tau = segment.forces_from_load(&configuration, &gradient);
    // J_ψq as the pseudoinverse of J_qψ; its transpose cannot take three forces, so it is taken as it is.
    let j = joint_jacobian(segment.pitch_radius, &configuration);
    let square = |a: usize, b: usize| j.iter().map(|row| row[a] * row[b]).sum::<f64>();
    let (aa, ab, bb) = (square(0, 0), square(0, 1), square(1, 1));
    let det = aa * bb - ab * ab;
    let force = |k: usize| j.iter().zip(tau.iter()).map(|(row, tau)| row[k] * tau).sum::<f64>();
    let inverse = [(bb * force(0) - ab * force(1)) / det, (aa * force(1) - ab * force(0)) / det];
    let printed = (inverse[0] - gradient.theta_l).hypot(inverse[1] - gradient.delta());
    let epsilon = Scenario::default().load_cells.epsilon_tau;
    let pulled = tau.add_scalar(60.0);
    let errors = [epsilon, -epsilon, epsilon];
    let read = Vec3::from_fn(|i, _| pulled[i] / (1.0 - errors[i]));
    let theta = segment.residual(&configuration, &read);
    (det > 0.0).then_some(()).context("a bent segment")?;
    Ok(vec![
        Misprint {
            place: "Eq. 12",
            printed: r"\v{J}_{\psi q}^{\mathsf T}\,\tauv_{lc}",
            right: r"\Jq^{\mathsf T}\,\tauv_{lc}",
            why: "Eqs. 11 and 14 have it so. With the printed matrix the deviation does not vanish for forces in balance.",
            values: [printed, 0.0, segment.residual(&configuration, &tau)],
            shown: (3, "N·m", 1.0),
        },
        Misprint {
            place: "Eq. 16",
            printed: r"\Theta \le \varepsilon_\tau\,\norm{\Jq^{\mathsf T}\,\tauv_{lc}}",
            right: r"\Theta \le \max_{\pm}\,\varepsilon_\tau\norm{\Jq^{\mathsf T}\operatorname{diag}(\pm1)\,\tauv_{lc}}",
            why: "It holds where the three cells err alike. Where they err apart, and the backbones are pulled by 60 N each, errors \
                  within the same ε_τ cause more.",
            values: [
                segment.common_error_bound(&configuration, &read, epsilon),
                theta,
                segment.independent_error_bound(&configuration, &read, epsilon),
            ],
            shown: (1, "mN·m", 1e3),
        },
    ])
}

/// All of them, with the numbers of a segment bent to θL = 0.6 rad.
fn all() -> Result<Vec<Misprint>> {
    let mut all = kinematics(Scenario::default().robot.length);
    all.extend(statics()?);
    Ok(all)
}

/// The table as HTML.
pub fn table() -> Result<String> {
    let mut text = String::from("<div class=\"misprints\">\n");
    for misprint in all()? {
        let Misprint { place, printed, right, why, values, shown: (decimals, unit, scale) } = misprint;
        let labels = if place == "Eq. 16" {
            ["as printed", "Θ of such cells", "ours"]
        } else {
            ["as printed", "proof", "ours"]
        };
        writeln!(
            text,
            "<section class=\"misprint\"><h3>{place}</h3><dl><div><dt>Printed</dt><dd>{}</dd></div>",
            math::inline(printed)?
        )?;
        writeln!(
            text,
            "<div><dt>Right</dt><dd>{}</dd></div></dl><p>{}</p><p class=\"proof\">",
            math::inline(right)?,
            math::symbols(why)
        )?;
        for (label, value) in labels.into_iter().zip(values) {
            let value = format!("{} {unit}", number(scale * value, decimals));
            writeln!(text, "<span><span class=\"label\">{label}</span> {}</span>", value.trim_end())?;
        }
        text.push_str("</p></section>\n");
    }
    text.push_str("</div>");
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_printed_is_wrong_and_ours_is_right() {
        for misprint in all().unwrap() {
            let [printed, proof, ours] = misprint.values;
            if misprint.place == "Eq. 16" {
                assert!(proof > 1.5 * printed && proof <= ours + 1e-12, "{:?}", misprint.values);
            } else {
                assert!((ours - proof).abs() < 1e-9, "{}: {:?}", misprint.place, misprint.values);
                assert!((printed - proof).abs() > 1e-3, "{}: {:?}", misprint.place, misprint.values);
            }
        }
    }
}
