//! Equations of segments in series, which are not the paper's and have no numbers.

use crate::code::{field, function, item};

/// An equation that is not the paper's.
#[derive(Debug)]
pub struct Law {
    /// Its name in the text and in addresses.
    pub id: &'static str,
    /// What it is, for who hears it.
    pub name: &'static str,
    /// TeX.
    pub tex: &'static str,
    /// What computes it, in `centrode-core`.
    pub code: Vec<&'static str>,
}

fn row(id: &'static str, name: &'static str, tex: &'static str, code: Vec<&'static str>) -> Law {
    Law { id, name, tex, code }
}

/// All of them, in the order of the text.
#[must_use]
pub fn laws() -> Vec<Law> {
    [shapes(), detection()].into_iter().flatten().collect()
}

fn shapes() -> Vec<Law> {
    vec![
        row(
            "chain-poses",
            "end disks of a chain that nothing touches",
            r"\v{R}_k = \v{R}_{k-1}\,e^{[(\v{U}_k,\,0)]_\times}, \qquad \v{p}_k = \v{p}_{k-1} + \v{R}_{k-1}\,\v{p}(\v{U}_k)",
            vec![function!(model::chain::bends), function!(model::chain::free::poses)],
        ),
        row(
            "chain-twists",
            "twist of disk k by segment j",
            r"\omegav_{kj} = \v{R}_{j-1}\,\omegav_j, \qquad
              \dot{\v{p}}_{kj} = \v{R}_{j-1}\,\dot{\v{p}}_j + \omegav_{kj}\times(\v{p}_k - \v{p}_j), \qquad j \le k",
            vec![function!(model::chain::free), field!(model::chain::Disk.by_bends)],
        ),
        row(
            "chain-joints",
            "joint values of a chain",
            r"q_{km} = -r\sum_{j \le k}\varphi_j\cos\left(\delta_j + \gamma_k + (m-1)\beta\right)",
            vec![function!(model::chain::joints::joints), function!(model::chain::joints::configurations_from_joints)],
        ),
        row(
            "chain-stiffness",
            "bending stiffness of each segment",
            r"EI_k = E_P I_{P,k} + 3\sum_{j \ge k} E_S I_{S,j}",
            vec![function!(model::chain::stiffnesses)],
        ),
        row(
            "chain-energy",
            "the shape of least energy",
            r"\min\ \sum_k\int_0^{\ell_k}\tfrac12\left(EI_k\,(u_1^2+u_2^2) + GJ_k\,u_3^2\right)\d s, \qquad
              \int_0^{\ell_k}(u_1, u_2)\,\d s = \v{U}_k, \qquad \v{n}\cdot\v{p}(s_c) \le d",
            vec![function!(model::chain::settle), item!(model::chain::path::Path)],
        ),
        row(
            "chain-margin",
            "stability margin",
            r"\mu = \min_{v}\ \frac{\partial^2_v\left(E + F\,\v{n}\cdot\v{p}(s_c)\right)}{\partial^2_v E}",
            vec![field!(model::chain::Settled.margin), item!(model::chain::path::What)],
        ),
    ]
}

fn detection() -> Vec<Law> {
    vec![
        row(
            "chain-relative",
            "motion of a disk relative to the one below",
            r"\omegav = \v{R}_{k-1}^{\mathsf T}(\omegav_k - \omegav_{k-1}), \qquad
              \dot{\v{p}} = \v{R}_{k-1}^{\mathsf T}\left(\dot{\v{p}}_k - \dot{\v{p}}_{k-1} - \omegav_{k-1}\times(\v{p}_k - \v{p}_{k-1})\right)",
            vec![function!(model::chain::path::relative_twist), function!(detect::chain::relative)],
        ),
        row(
            "chain-probability",
            "probability of each segment",
            r"P(k) = \frac{e^{\Lambda_k}}{1 + \sum_j e^{\Lambda_j}}",
            vec![field!(detect::chain::ChainEstimate.probabilities), function!(detect::chain::ChainJudged::contacts)],
        ),
        row(
            "chain-screw",
            "screw motion deviation",
            r"\norm{\v{f}_m - \v{f}_s} > \xi_d \quad\text{or}\quad \alpha > \xi_\alpha, \qquad
              \alpha = \operatorname{atan2}\left(\norm{\v{l}_m\times\v{l}_s},\ \v{l}_m\cdot\v{l}_s\right)",
            vec![
                item!(detect::chain::ChainMethod),
                field!(detect::Judgement.consistent),
                field!(detect::Judgement.turned),
            ],
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::CHAPTERS;

    #[test]
    fn each_stands_in_the_text_once() {
        let texts: String = CHAPTERS.iter().map(|(.., text)| *text).collect();
        for law in laws() {
            assert_eq!(texts.matches(&format!("{{{{law {}}}}}", law.id)).count(), 1, "{}", law.id);
            assert!(!law.code.is_empty() && !law.name.is_empty());
        }
    }
}
