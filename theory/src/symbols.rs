//! The table of symbols: names and units are the page's own, beside them how each is written and where it is in the code.

use crate::code::{field, function, item};
use crate::math;
use anyhow::{Result, ensure};
use centrode_core::symbols::SYMBOLS;
use std::fmt::Write;

/// By its name in addresses: TeX, a place in the code, and the equations in which it stands first.
type Row = (&'static str, &'static str, &'static str, &'static [u8]);

fn rows() -> Vec<Row> {
    [geometry(), statics(), detection()].concat()
}

fn geometry() -> Vec<Row> {
    vec![
        ("l", "L", field!(model::Segment.length), &[2]),
        ("s", "s", function!(model::Arc::pose), &[3]),
        ("r", "r", field!(model::Segment.pitch_radius), &[2]),
        ("beta", r"\beta", function!(model::joints::backbone_directions), &[2]),
        ("theta-0", r"\theta_0", function!(model::configuration::bend_from_theta_l), &[2]),
        ("theta-l", r"\theta_L", function!(model::Configuration::theta_l), &[2]),
        ("theta-s", r"\theta_s", function!(model::Arc::pose), &[5]),
        ("phi", r"\varphi", function!(model::Configuration::bend), &[]),
        ("phi-s", r"\varphi_s", function!(model::Arc::pose), &[]),
        ("delta", r"\delta", function!(model::Configuration::delta), &[2]),
        ("gamma", r"\gamma", field!(scenario::chain::ChainSegment.joint_offset), &[]),
        ("u", r"\v{U}", function!(model::chain::bends), &[]),
        ("psi", r"\psiv", item!(model::Configuration), &[1]),
        ("q", "q_i", function!(model::joints::joints), &[2]),
        ("l-i", "L_i", function!(model::Segment::shortest_backbone), &[10]),
        ("p", r"\v{p}", field!(model::Pose.position), &[3]),
        ("rot", r"\v{R}", field!(model::Pose.rotation), &[4]),
        ("t", r"\v{t}", item!(model::Twist), &[1, 7]),
        ("j-x", r"\Jx", item!(model::Jacobian), &[1, 8]),
        ("j-q", r"\Jq", function!(model::joints::joint_jacobian), &[2]),
        ("omega", r"\omegav", field!(model::Twist.angular), &[17]),
        ("omega-matrix", r"\Om", function!(model::centrode::centrode), &[17]),
    ]
}

fn statics() -> Vec<Row> {
    vec![
        ("e", "E", function!(model::Segment::energy), &[10]),
        ("ep-ip", "E_P I_P", field!(model::Segment.ep_ip), &[10]),
        ("es-is", "E_S I_S", field!(model::Segment.es_is), &[10]),
        ("ei", "EI", field!(model::chain::Rod.bending_stiffness), &[]),
        ("gj", "GJ", field!(model::chain::Rod.torsion), &[]),
        ("mu", r"\mu", field!(model::chain::Settled.margin), &[]),
        ("tau", r"\tauv", function!(model::Segment::joint_forces), &[11]),
        ("tau-lc", r"\tauv_{lc}", field!(run::Sample.tau_lc), &[12]),
        ("epsilon-tau", r"\varepsilon_\tau", field!(scenario::LoadCells.epsilon_tau), &[13]),
        ("w-e", r"\v{W}_e", item!(model::Wrench), &[11]),
        ("theta", r"\Theta", function!(model::Segment::residual), &[12]),
        ("epsilon-c", r"\varepsilon_c", function!(model::Segment::common_error_bound), &[15, 16]),
        ("xi1", r"\xi_1", field!(scenario::Thresholds.xi1), &[12]),
        ("k", "k", field!(scenario::Thresholds.xi1_factor), &[]),
    ]
}

fn detection() -> Vec<Row> {
    vec![
        ("c-m", r"\v{c}_m", field!(detect::Judgement.model_centrode), &[17]),
        ("c-s", r"\v{c}_s", field!(detect::Judgement.sensor_centrode), &[18]),
        ("c-c", r"\v{c}_c", function!(model::Constrained::centrode), &[23]),
        ("deviation", r"\norm{\v{c}_m-\v{c}_s}", field!(detect::Judgement.deviation), &[19]),
        ("xi2", r"\xi_2", field!(scenario::Thresholds.xi2), &[19]),
        ("s-c", "s_c", field!(model::Location.arc_length), &[24]),
        ("phi-c", r"\varphi_c", field!(model::Assumption.met), &[]),
        ("kappa", r"\kappa", item!(model::contact), &[]),
        ("f", "F", item!(model::contact), &[]),
        ("n", "N", field!(scenario::Filter.length), &[]),
        ("c-f", r"\v{c}_f", field!(detect::Judgement.consistent), &[]),
        ("xi-f", r"\xi_f", field!(scenario::Thresholds.consistent), &[]),
        ("screw-distance", r"\norm{\v{f}_m-\v{f}_s}", field!(detect::Judgement.consistent), &[]),
        ("xi-d", r"\xi_d", field!(scenario::chain::Smd.distance), &[]),
        ("screw-angle", r"\alpha", field!(detect::Judgement.turned), &[]),
        ("xi-angle", r"\xi_\alpha", field!(scenario::chain::Smd.angle), &[]),
        ("xi-v", r"\xi_v", field!(scenario::Thresholds.velocity), &[]),
        ("nu", r"\boldsymbol{\nu}", item!(detect::calibration::filter), &[]),
        ("eta", r"\boldsymbol{\eta}", item!(scenario::Calibration), &[]),
        ("g", "g", field!(detect::Judgement.cusum), &[]),
        ("h", "h", field!(scenario::Thresholds.cusum), &[]),
        ("lambda", r"\Lambda", field!(detect::Judgement.glr), &[]),
        ("h-lambda", r"h_\Lambda", field!(scenario::Thresholds.glr), &[]),
    ]
}

/// The table as HTML.
pub fn table() -> Result<String> {
    let rows = rows();
    ensure!(rows.len() == SYMBOLS.len(), "{} rows for {} symbols", rows.len(), SYMBOLS.len());
    let mut text = String::from(
        "<table class=\"symbols\"><thead><tr><th scope=\"col\">Symbol</th><th scope=\"col\">Meaning</th>\
         <th scope=\"col\">Unit</th><th scope=\"col\">In the code</th><th scope=\"col\">Eq.</th></tr></thead><tbody>\n",
    );
    for (symbol, (id, tex, code, numbers)) in SYMBOLS.iter().zip(rows) {
        ensure!(symbol.id == id, "{id} stands where {} should", symbol.id);
        let links: Vec<String> = numbers.iter().map(|n| format!("<a href=\"#eq-{n}\">{n}</a>")).collect();
        let name = math::symbols(symbol.name);
        writeln!(
            text,
            "<tr id=\"{}\"><th scope=\"row\">{}</th><td>{name}</td><td>{}</td><td><code>{}</code></td><td>{}</td></tr>",
            symbol.anchor(),
            math::inline(tex)?,
            symbol.unit.replace('1', if symbol.unit == "1" { "–" } else { "1" }),
            breakable(code),
            links.join(", ")
        )?;
    }
    text.push_str("</tbody></table>");
    Ok(text)
}

/// A path in the code that may be broken behind its colons.
pub fn breakable(code: &str) -> String {
    code.replace("::", "::<wbr>").replace('.', ".<wbr>")
}
