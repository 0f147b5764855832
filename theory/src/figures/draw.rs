//! A chart as SVG inside the page: its colours are variables, which follow dark, light and paper.

use super::Figure;
use centrode::scene::palette::Palette;
use centrode::show::ink;
use centrode_core::chart::layout::{Ink, Page, layout};
use centrode_core::chart::svg;
use std::cell::RefCell;
use std::fmt::Write;

/// Size of the text on a wide screen and on a narrow one, points.
const TEXT: [f64; 2] = [12.5, 11.0];
/// Which of the two drawings is for which screen.
const CLASSES: [&str; 2] = ["wide", "narrow"];

/// The colours that figures use, each on a light and on a dark ground.
#[derive(Debug, Default)]
pub struct Colours(RefCell<Vec<[String; 2]>>);

impl Colours {
    /// A colour as CSS has it: itself where it is the same on both grounds, else a variable.
    fn css(&self, ink: Ink) -> String {
        let hex = |dark: bool| {
            let [r, g, b, _] = ink::color(ink, &Palette::for_dark(dark), dark).to_bytes();
            format!("#{r:02x}{g:02x}{b:02x}")
        };
        let pair = [hex(false), hex(true)];
        if pair[0] == pair[1] {
            return pair[0].clone();
        }
        let mut pairs = self.0.borrow_mut();
        let place = pairs.iter().position(|known| *known == pair).unwrap_or_else(|| {
            pairs.push(pair);
            pairs.len() - 1
        });
        format!("var(--ink-{place})")
    }

    /// The variables on a light or a dark ground.
    #[must_use]
    pub fn variables(&self, dark: bool) -> String {
        let mut text = String::new();
        for (place, pair) in self.0.borrow().iter().enumerate() {
            // Writing to a string does not fail.
            let _ = write!(text, "--ink-{place}:{};", pair[usize::from(dark)]);
        }
        text
    }
}

impl Figure {
    /// Its drawings, of which the page shows the one that fits the screen.
    #[must_use]
    pub fn drawings(&self, colours: &Colours) -> String {
        let mut text = String::new();
        for ((size, letters), class) in self.sizes.into_iter().zip(TEXT).zip(CLASSES) {
            let drawing = layout(&self.chart, &Page { pixel: 0.5, ..Page::screen(size, letters) });
            let drawn = svg::painted(&drawing, &self.chart, &|ink| colours.css(ink));
            // Inside a page the name space is known.
            let plain = drawn.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1);
            text.push_str(&plain.replacen("<svg ", &format!("<svg class=\"{class}\" role=\"img\" "), 1));
        }
        text
    }
}
