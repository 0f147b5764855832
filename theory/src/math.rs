//! Mathematics as it is written in the sources, TeX, and as browsers render it, MathML Core.

use anyhow::{Result, anyhow};
use centrode_core::chart::notation::{printed, runs};
use math_core::{LatexToMathML, MathCoreConfig, MathDisplay};

/// Short names for what stands in many equations.
const MACROS: &[(&str, &str)] = &[
    ("v", r"\mathbf{#1}"),
    ("Jx", r"\mathbf{J}_{x\psi}"),
    ("Jq", r"\mathbf{J}_{q\psi}"),
    ("psiv", r"\boldsymbol{\psi}"),
    ("tauv", r"\boldsymbol{\tau}"),
    ("omegav", r"\boldsymbol{\omega}"),
    ("nuv", r"\boldsymbol{\nu}"),
    ("etav", r"\boldsymbol{\eta}"),
    ("Om", r"\boldsymbol{\Omega}"),
    ("norm", r"\left\Vert\, #1 \,\right\Vert"),
    ("d", r"\mathrm{d}"),
];

/// TeX of more characters may be wider than a phone.
const LONG: usize = 100;

/// Math in a line of text.
pub fn inline(tex: &str) -> Result<String> {
    convert(tex, MathDisplay::Inline)
}

/// Math on a line of its own. What `\qquad` parts goes below each other where there is no room.
pub fn block(tex: &str) -> Result<String> {
    let parts: Vec<&str> = tex.split(r"\qquad").collect();
    let longest = parts.iter().map(|part| part.len()).max().unwrap_or(0);
    // What may have to be scrolled on a phone can be reached by the keyboard.
    let focus = if longest > LONG { " tabindex=\"0\"" } else { "" };
    let maths: Vec<String> = parts.into_iter().map(|part| convert(part, MathDisplay::Block)).collect::<Result<_>>()?;
    Ok(format!("<div class=\"math\"{focus}>{}</div>", maths.concat()))
}

fn convert(tex: &str, display: MathDisplay) -> Result<String> {
    let macros = MACROS.iter().map(|&(name, text)| (name.to_owned(), text.to_owned())).collect();
    let converter = LatexToMathML::new(MathCoreConfig { macros, ..MathCoreConfig::default() })
        .map_err(|(error, ..)| anyhow!("macros: {error}"))?;
    let converted = converter.convert_with_local_state(tex, display).map_err(|error| anyhow!("{tex}: {error}"))?;
    Ok(converted.mathml)
}

/// Text in the notation of charts, with indices below the line.
#[must_use]
pub fn symbols(text: &str) -> String {
    let run = |run: centrode_core::chart::notation::Stretch| {
        let text = escaped(&run.text);
        if run.low { format!("<sub>{text}</sub>") } else { text }
    };
    runs(&printed(text)).into_iter().map(run).collect()
}

/// Text as HTML has it.
#[must_use]
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
