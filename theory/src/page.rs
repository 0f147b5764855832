//! The page: the chapters' texts with what is computed put in their places.
//!
//! A text is HTML. In it `$…$` is TeX in a line and `$$…$$` on a line of its own, and `{{…}}` is replaced: `eq 19`, `law NAME` (an equation that is
//! not the paper's), `fig half | caption`, `open NAME | words` (a link to a state of the page), `fact NAME`, `symbols`, `misprints`.

use crate::equations::{Equation, Law, equations, laws};
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
pub const CHAPTERS: [Chapter; 12] = [
    ("centrode", "What a fixed centrode is", include_str!("../text/centrode.html")),
    ("kinematics", "How the segment moves", include_str!("../text/kinematics.html")),
    ("statics", "What the joints feel", include_str!("../text/statics.html")),
    ("detection", "How contact is noticed", include_str!("../text/detection.html")),
    ("location", "Where the contact is", include_str!("../text/location.html")),
    ("half", "Why the deviation is near half the distance", include_str!("../text/half.html")),
    ("touch", "Clamp and touch", include_str!("../text/touch.html")),
    ("filter", "Why the filter biases the place", include_str!("../text/filter.html")),
    ("bound", "What no detector can beat", include_str!("../text/bound.html")),
    ("chain", "Segments in series", include_str!("../text/chain.html")),
    ("misprints", "Misprints, with their proof", include_str!("../text/misprints.html")),
    ("symbols", "Symbols", include_str!("../text/symbols.html")),
];

const FRAME: &str = include_str!("../text/page.html");
const STYLE: &str = include_str!("../style.css");
const ICON: &[u8] = include_bytes!("../../assets/icons/icon.svg");
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
    let frame = frame.replace("@ICON@", &STANDARD.encode(ICON));
    Ok(frame.replace("@STYLE@", &style).replace("@CONTENTS@", &contents).replace("@CHAPTERS@", &chapters))
}

impl Filler<'_> {
    fn fill(&mut self, text: &str) -> Result<String> {
        mathematics(&self.orders(&self.numbered(text))?)
    }

    /// Makes links of the numbers of equations in brackets, such as (19), that are none yet.
    fn numbered(&self, text: &str) -> String {
        let number = |Equation { number, .. }: &Equation| {
            (format!("({number})"), format!("<a href=\"#eq-{number}\">({number})</a>"))
        };
        self.equations
            .iter()
            .map(number)
            .fold(text.to_owned(), |text, (plain, link)| text.replace(&link, &plain).replace(&plain, &link))
    }

    /// Replaces `{{…}}`; the words of a link may hold a number.
    fn orders(&mut self, text: &str) -> Result<String> {
        let mut filled = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once("{{") {
            filled.push_str(before);
            let end = closing(after).with_context(|| format!("{{{{ without }}}} at {after:.20}"))?;
            let order = self.orders(&after[..end])?;
            filled.push_str(&self.order(order.trim()).with_context(|| format!("{{{{{order}}}}}"))?);
            rest = &after[end + 2..];
        }
        filled.push_str(rest);
        Ok(filled)
    }

    fn order(&mut self, order: &str) -> Result<String> {
        let (what, of) = order.split_once(' ').unwrap_or((order, ""));
        let (of, words) = of.split_once('|').map_or((of.trim(), ""), |(of, words)| (of.trim(), words.trim()));
        match what {
            "eq" => self.equation(of.parse()?),
            "law" => law(of),
            "fig" => self.figure(of, words),
            "open" => open(of, words),
            "fact" => Ok(self.facts.get(of)?.to_owned()),
            "symbols" => symbols::table(),
            "misprints" => misprints::table(),
            _ => bail!("there is nothing called {what:?}"),
        }
    }

    fn equation(&self, number: u8) -> Result<String> {
        let found = self.equations.iter().find(|equation| equation.number == number);
        let Equation { name, tex, code, .. } = found.with_context(|| format!("there is no equation {number}"))?;
        Ok(format!(
            "<div class=\"equation\" id=\"eq-{number}\" role=\"group\" aria-label=\"Equation {number}: {name}\">\
             {}<a class=\"number\" href=\"#eq-{number}\" aria-label=\"Equation {number}\">({number})</a>\
             <p class=\"code\">{}</p></div>",
            math::block(tex)?,
            coded(code)
        ))
    }

    fn figure(&mut self, name: &str, words: &str) -> Result<String> {
        let made = figure(name)?;
        self.figures += 1;
        let (state, shows) = made.state;
        Ok(format!(
            "<figure id=\"fig-{name}\">{}<figcaption><b>Figure {}.</b> {words} {}</figcaption></figure>",
            made.drawings(&self.colours),
            self.figures,
            open(state, &format!("Open {shows}"))?
        ))
    }
}

/// An equation of ours: without a number, with the functions that compute it.
fn law(id: &str) -> Result<String> {
    let found = laws().into_iter().find(|law| law.id == id);
    let Law { name, tex, code, .. } = found.with_context(|| format!("there is no equation called {id:?}"))?;
    Ok(format!(
        "<div class=\"equation\" id=\"law-{id}\" role=\"group\" aria-label=\"Equation: {name}\">{}<p class=\"code\">{}</p></div>",
        math::block(tex)?,
        coded(&code)
    ))
}

/// Places in the code.
fn coded(code: &[&str]) -> String {
    let code: Vec<String> = code.iter().map(|code| format!("<code>{}</code>", breakable(code))).collect();
    code.join(" ")
}

/// Where the `}}` is that belongs to a `{{` before a text.
fn closing(text: &str) -> Option<usize> {
    let (mut depth, mut at) = (0, 0);
    while let Some(pair) = text.as_bytes().get(at..at + 2) {
        match pair {
            b"}}" if depth == 0 => return Some(at),
            b"}}" => depth -= 1,
            b"{{" => depth += 1,
            _ => {
                at += 1;
                continue;
            }
        }
        at += 2;
    }
    None
}

/// A link to a state of the page. On paper its fragment stands behind it, which the command takes as well.
fn open(state: &str, words: &str) -> Result<String> {
    let address = states::find(state)?.address()?.replace('&', "&amp;");
    let fragment = address.trim_start_matches("./");
    Ok(format!("<a class=\"open\" href=\"{address}\" data-fragment=\"{fragment}\">{words}</a>"))
}

/// Replaces TeX between dollars.
fn mathematics(text: &str) -> Result<String> {
    let mut filled = String::new();
    for (k, part) in text.split("$$").enumerate() {
        if k % 2 == 1 {
            write!(filled, "<div class=\"display\">{}</div>", math::block(part)?)?;
            continue;
        }
        let mut parts = part.split('$');
        filled.push_str(parts.next().unwrap_or_default());
        while let (Some(tex), Some(text)) = (parts.next(), parts.next()) {
            // A sign behind it does not begin a line.
            let signs = text.len() - text.trim_start_matches([',', '.', ';', ':', ')']).len();
            let (sign, text) = text.split_at(signs);
            let math = math::inline(tex)?;
            if sign.is_empty() {
                filled.push_str(&math);
            } else {
                write!(filled, "<span class=\"whole\">{math}{sign}</span>")?;
            }
            filled.push_str(text);
        }
    }
    Ok(filled)
}
