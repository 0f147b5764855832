//! The page: the chapters' texts with what is computed put in their places.
//!
//! A text is HTML. In it `$…$` is TeX in a line and `$$…$$` on a line of its own, and `{{…}}` is replaced: `eq 19`, `fig half | caption`,
//! `open NAME | words` (a link to a state of the page), `fact NAME`, `symbols`, `misprints`.

use crate::equations::{Equation, equations};
use crate::facts::Facts;
use crate::figures::{Colours, figure};
use crate::symbols::{self, breakable};
use crate::{math, misprints, states};
use anyhow::{Context, Result, bail};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write;

/// A chapter: its anchor, its title and its text.
type Chapter = (&'static str, &'static str, &'static str);

/// The chapters, in reading order.
pub const CHAPTERS: [Chapter; 11] = [
    ("centrode", "What a fixed centrode is", include_str!("../text/centrode.html")),
    ("kinematics", "How the segment moves", include_str!("../text/kinematics.html")),
    ("statics", "What the joints feel", include_str!("../text/statics.html")),
    ("detection", "How contact is noticed", include_str!("../text/detection.html")),
    ("location", "Where the contact is", include_str!("../text/location.html")),
    ("half", "Why the deviation is near half the distance", include_str!("../text/half.html")),
    ("touch", "Clamp and touch", include_str!("../text/touch.html")),
    ("filter", "Why the filter biases the place", include_str!("../text/filter.html")),
    ("bound", "What no detector can beat", include_str!("../text/bound.html")),
    ("misprints", "Misprints, with their proof", include_str!("../text/misprints.html")),
    ("symbols", "Symbols", include_str!("../text/symbols.html")),
];

const FRAME: &str = include_str!("../text/page.html");
const STYLE: &str = include_str!("../style.css");
const FONT: &[u8] = include_bytes!("../font/STIXTwoMath.woff2");

/// What the texts are filled with.
struct Filler<'a> {
    facts: &'a Facts,
    equations: Vec<Equation>,
    colours: Colours,
    figures: usize,
}

/// Writes the page.
pub fn page(facts: &Facts) -> Result<String> {
    let mut filler = Filler { facts, equations: equations(), colours: Colours::default(), figures: 0 };
    let (mut contents, mut chapters) = (String::new(), String::new());
    for (k, (id, title, text)) in CHAPTERS.into_iter().enumerate() {
        let filled = filler.fill(text).with_context(|| format!("chapter {id}"))?;
        writeln!(contents, "<li><a href=\"#{id}\">{title}</a></li>")?;
        writeln!(
            chapters,
            "<section id=\"{id}\" aria-labelledby=\"{id}-title\">\n<h2 id=\"{id}-title\"><span class=\"count\">{}</span> {title}</h2>\n{filled}\n</section>",
            k + 1
        )?;
    }
    let style = STYLE
        .replace("@LIGHT@", &filler.colours.variables(false))
        .replace("@DARK@", &filler.colours.variables(true))
        .replace("@FONT@", &STANDARD.encode(FONT));
    let frame = filler.fill(FRAME)?;
    Ok(frame.replace("@STYLE@", &style).replace("@CONTENTS@", &contents).replace("@CHAPTERS@", &chapters))
}

impl Filler<'_> {
    fn fill(&mut self, text: &str) -> Result<String> {
        let mut filled = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once("{{") {
            filled.push_str(before);
            let (order, behind) = after.split_once("}}").context("a {{ without }}")?;
            let made = self.order(order.trim()).with_context(|| format!("{{{{{order}}}}}"))?;
            filled.push_str(&made);
            rest = behind;
        }
        filled.push_str(rest);
        mathematics(&filled)
    }

    fn order(&mut self, order: &str) -> Result<String> {
        let (what, of) = order.split_once(' ').unwrap_or((order, ""));
        let (of, words) = of.split_once('|').map_or((of.trim(), ""), |(of, words)| (of.trim(), words.trim()));
        match what {
            "eq" => self.equation(of.parse()?),
            "fig" => self.figure(of, words),
            "open" => Ok(format!("<a class=\"open\" href=\"{}\">{words}</a>", address(of)?)),
            "fact" => Ok(self.facts.get(of)?.to_owned()),
            "symbols" => symbols::table(),
            "misprints" => misprints::table(),
            _ => bail!("there is nothing called {what:?}"),
        }
    }

    fn equation(&self, number: u8) -> Result<String> {
        let found = self.equations.iter().find(|equation| equation.number == number);
        let Equation { name, tex, code, .. } = found.with_context(|| format!("there is no equation {number}"))?;
        let code: Vec<String> = code.iter().map(|code| format!("<code>{}</code>", breakable(code))).collect();
        Ok(format!(
            "<div class=\"equation\" id=\"eq-{number}\" role=\"group\" aria-label=\"Equation {number}: {name}\">\
             <div class=\"math\" tabindex=\"0\">{}</div><a class=\"number\" href=\"#eq-{number}\" aria-label=\"Equation {number}\">({number})</a>\
             <p class=\"code\">{}</p></div>",
            math::block(tex)?,
            code.join(" ")
        ))
    }

    fn figure(&mut self, name: &str, words: &str) -> Result<String> {
        let made = figure(name)?;
        self.figures += 1;
        let (state, shows) = made.state;
        Ok(format!(
            "<figure id=\"fig-{name}\">{}<figcaption><b>Figure {}.</b> {words} <a class=\"open\" href=\"{}\">Open {shows}</a></figcaption></figure>",
            made.drawings(&self.colours),
            self.figures,
            address(state)?
        ))
    }
}

/// The address of a state, as an attribute has it.
fn address(state: &str) -> Result<String> {
    Ok(states::find(state)?.address()?.replace('&', "&amp;"))
}

/// Replaces TeX between dollars.
fn mathematics(text: &str) -> Result<String> {
    let mut filled = String::new();
    for (k, part) in text.split("$$").enumerate() {
        if k % 2 == 1 {
            write!(
                filled,
                "<div class=\"display\"><div class=\"math\" tabindex=\"0\">{}</div></div>",
                math::block(part)?
            )?;
            continue;
        }
        for (k, part) in part.split('$').enumerate() {
            if k % 2 == 1 {
                filled.push_str(&math::inline(part)?);
            } else {
                filled.push_str(part);
            }
        }
    }
    Ok(filled)
}
