//! The paper's equations, as they are right, and what computes each of them; and those of segments in series, which are not the paper's.

mod chain;

pub use chain::{Law, laws};

use crate::code::{function, item};

/// An equation.
#[derive(Debug)]
pub struct Equation {
    /// Its number in the paper.
    pub number: u8,
    /// What it is, for who hears it.
    pub name: &'static str,
    /// TeX.
    pub tex: &'static str,
    /// What computes it, in `centrode-core`.
    pub code: Vec<&'static str>,
}

fn row(number: u8, name: &'static str, tex: &'static str, code: Vec<&'static str>) -> Equation {
    Equation { number, name, tex, code }
}

/// All of them, in the paper's order.
#[must_use]
pub fn equations() -> Vec<Equation> {
    [kinematics(), statics(), detection(), location()].into_iter().flatten().collect()
}

fn kinematics() -> Vec<Equation> {
    let arc = || function!(model::Arc::jacobian);
    vec![
        row(1, "twist of the end disk", r"\v{t}_L = \Jx\,\dot\psiv", vec![function!(model::Jacobian::twist)]),
        row(
            2,
            "joint speeds",
            r"\dot{\v{q}} = \Jq\,\dot\psiv, \qquad
              \Jq = \begin{bmatrix} r\cos\delta_1 & -r(\theta_L-\theta_0)\sin\delta_1 \\
              r\cos\delta_2 & -r(\theta_L-\theta_0)\sin\delta_2 \\
              r\cos\delta_3 & -r(\theta_L-\theta_0)\sin\delta_3 \end{bmatrix}",
            vec![item!(model::joints), function!(model::joints::joint_jacobian)],
        ),
        row(
            3,
            "position along the backbone",
            r"\v{p}(s) = \frac{L}{\theta_L-\theta_0}\begin{bmatrix} \cos\delta\,(\sin\theta_s-1) \\
              -\sin\delta\,(\sin\theta_s-1) \\ -\cos\theta_s \end{bmatrix}",
            vec![function!(model::Arc::pose)],
        ),
        row(
            4,
            "orientation along the backbone",
            r"\v{R}(s) = e^{-\delta\,[\v{e}_3]_\times}\; e^{(\theta_0-\theta_s)\,[\v{e}_2]_\times}\; e^{\delta\,[\v{e}_3]_\times}",
            vec![function!(model::Arc::pose)],
        ),
        row(
            5,
            "tangent angle along the backbone",
            r"\theta_s = \frac{\pi}{2} - \frac{s}{L}\,(\theta_0-\theta_L)",
            vec![function!(model::Arc::pose), function!(model::configuration::bend_from_theta_l)],
        ),
        row(
            6,
            "rates along the backbone",
            r"\dot\psiv(s) = \begin{bmatrix} s/L & 0 \\ 0 & 1 \end{bmatrix}\dot\psiv",
            vec![arc()],
        ),
        row(7, "twist along the backbone", r"\v{t}(s) = \Jx(s)\,\dot\psiv", vec![function!(model::Jacobian::twist)]),
        row(
            8,
            "Jacobian along the backbone",
            r"\Jx(s) = \begin{bmatrix}
              \dfrac{\cos\delta\,v_1}{(\theta_L-\theta_0)^2} & \dfrac{L\sin\delta\,(1-\sin\theta_s)}{\theta_L-\theta_0} \\
              -\dfrac{\sin\delta\,v_1}{(\theta_L-\theta_0)^2} & \dfrac{L\cos\delta\,(1-\sin\theta_s)}{\theta_L-\theta_0} \\
              \dfrac{v_2}{(\theta_L-\theta_0)^2} & 0 \\
              -\frac{s}{L}\sin\delta & \cos\delta\cos\theta_s \\
              -\frac{s}{L}\cos\delta & -\sin\delta\cos\theta_s \\
              0 & \sin\theta_s-1 \end{bmatrix}",
            vec![arc()],
        ),
        row(
            9,
            "abbreviations in the Jacobian",
            r"\begin{aligned} v_1 &= s(\theta_L-\theta_0)\cos\theta_s - L(\sin\theta_s-1) \\
              v_2 &= L\cos\theta_s + s(\theta_L-\theta_0)\sin\theta_s \end{aligned}",
            vec![arc(), item!(model::special)],
        ),
    ]
}

fn statics() -> Vec<Equation> {
    let cells = || item!(sensors::cells);
    vec![
        row(
            10,
            "elastic energy",
            r"E = \int_0^L \frac{EI}{2}\left(\frac{\mathrm{d}\theta}{\mathrm{d}s}\right)^{2}\mathrm{d}s
              = (\theta_L-\theta_0)^2\left[\frac{E_P I_P}{2L} + \sum_{i=1}^{3}\frac{E_S I_S}{2L_i}\right]",
            vec![function!(model::Segment::energy), function!(model::Segment::energy_gradient)],
        ),
        row(
            11,
            "balance of joint forces",
            r"\Jq^{\mathsf T}\,\tauv = \nabla E - \Jx^{\mathsf T}\,\v{W}_e",
            vec![function!(model::Segment::joint_forces)],
        ),
        row(
            12,
            "joint force deviation",
            r"\Theta = \norm{\Jq^{\mathsf T}\,\tauv_{lc} - \nabla E} > \xi_1",
            vec![function!(model::Segment::residual), function!(detect::Method::Jfd)],
        ),
        row(
            13,
            "error of the load cells",
            r"\tauv = \tauv_{lc} - \tauv_f = (1-\varepsilon_\tau)\,\tauv_{lc}",
            vec![cells()],
        ),
        row(
            14,
            "balance with that error",
            r"\Jq^{\mathsf T}(1-\varepsilon_\tau)\,\tauv_{lc} - \nabla E = \v{0}",
            vec![cells()],
        ),
        row(
            15,
            "deviation that the error leaves",
            r"\varepsilon_c = \norm{\Jq^{\mathsf T}(1-\varepsilon_\tau)\,\tauv_{lc} - \nabla E}",
            vec![cells(), function!(model::Segment::residual)],
        ),
        row(
            16,
            "detectability bound",
            r"\varepsilon_c = \varepsilon_\tau\,\norm{\Jq^{\mathsf T}\,\tauv_{lc}}",
            vec![
                function!(model::Segment::common_error_bound),
                function!(model::Segment::independent_error_bound),
                function!(model::Segment::shape_bound),
            ],
        ),
    ]
}

fn detection() -> Vec<Equation> {
    vec![
        row(
            17,
            "centrode of the model",
            r"\v{c}_m = \frac{\Om_m(\dot{\v{p}}_m - \Om_m\v{p}_m)}{\omegav_m^{\mathsf T}\omegav_m}",
            vec![item!(model::centrode), function!(model::Jacobian::centrode)],
        ),
        row(
            18,
            "centrode of the sensor",
            r"\v{c}_s = \frac{\Om_s(\dot{\v{p}}_s - \Om_s\v{p}_s)}{\omegav_s^{\mathsf T}\omegav_s},
              \qquad \Om_s = \dot{\v{R}}_s\v{R}_s^{\mathsf T}",
            vec![function!(model::centrode::centrode), item!(detect::filter)],
        ),
        row(
            19,
            "detection of contact",
            r"\norm{\v{c}_m - \v{c}_s} > \xi_2",
            vec![item!(detect::Method), function!(detect::judge)],
        ),
    ]
}

fn location() -> Vec<Equation> {
    let constrained = || item!(model::Constrained);
    vec![
        row(
            20,
            "twist of the part that moves",
            r"\tilde{\v{t}} = \tilde{\v{J}}_{x\psi}\,\dot{\tilde{\psiv}}, \qquad \dot{\tilde{\psiv}} = \dot\psiv",
            vec![constrained(), field_upper()],
        ),
        row(
            21,
            "twist of the end disk in contact",
            r"\v{t}_c = \v{T}\,\tilde{\v{t}} = \v{T}\,\tilde{\v{J}}_{x\psi}\,\dot{\tilde{\psiv}} = \bar{\v{J}}_{x\psi}\,\dot\psiv",
            vec![function!(model::Constrained::tip_twist)],
        ),
        row(
            22,
            "rotation of twists",
            r"\v{T} = \begin{bmatrix} \v{R}(s_c) & \v{0} \\ \v{0} & \v{R}(s_c) \end{bmatrix}",
            vec![function!(model::Constrained::tip_pose_and_jacobian), function!(model::Twist::rotated)],
        ),
        row(
            23,
            "centrode in contact",
            r"\v{c}_c(s_c) = \frac{\Om_c(\dot{\v{p}}_c - \Om_c\v{p}_c)}{\omegav_c^{\mathsf T}\omegav_c},
              \qquad \v{p}_c = \v{p}(s_c) + \v{R}(s_c)\,\tilde{\v{p}}_c",
            vec![function!(model::Constrained::centrode)],
        ),
        row(
            24,
            "place of the contact",
            r"s_c = \operatorname*{arg\,min}_{0 < s < L}\; \norm{\v{c}_c(s) - \v{c}_s}",
            vec![function!(model::locate)],
        ),
    ]
}

fn field_upper() -> &'static str {
    crate::code::field!(model::Constrained.upper)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_is_there_once_and_in_order() {
        let numbers: Vec<u8> = equations().iter().map(|equation| equation.number).collect();
        assert_eq!(numbers, (1..=24).collect::<Vec<u8>>());
        assert!(equations().iter().all(|equation| !equation.code.is_empty()));
    }

    #[test]
    fn the_readme_names_nothing_else() {
        let readme = include_str!("../../README.md");
        let rows = readme.lines().filter(|line| line.starts_with("| "));
        let mut compared = 0;
        for row in rows {
            let cells: Vec<&str> = row.split('|').map(str::trim).collect();
            let [_, _, numbers, names, _] = cells[..] else { continue };
            let Some(first) = numbers.split([',', '–']).next().and_then(|text| text.trim().parse::<u8>().ok()) else {
                continue;
            };
            let last =
                numbers.rsplit([',', '–']).next().and_then(|text| text.trim().parse::<u8>().ok()).unwrap_or(first);
            let named: Vec<&str> = equations()
                .into_iter()
                .filter(|equation| (first..=last).contains(&equation.number))
                .flat_map(|equation| equation.code)
                .collect();
            for name in names.split('`').skip(1).step_by(2).filter(|name| !name.starts_with("study")) {
                let last = name.rsplit("::").next().unwrap_or(name);
                assert!(
                    named.iter().any(|other| *other == name || other.ends_with(last)),
                    "{name} of {numbers}: {named:?}"
                );
                compared += 1;
            }
        }
        assert!(compared > 15, "{compared} names");
    }
}
