//! What the signs of a panel mean, in rows above its data.

use super::{Form, Ink, Item, Look, Paint, Pen};
use crate::chart::clip::{Rect, Spot};
use crate::chart::font::width;
use crate::chart::{Panel, Role, Style, Vertical};

/// Height of a row, in sizes of the text.
const ROW: f64 = 1.45;
/// Width of a sign with the space behind it.
const SIGN: f64 = 3.0;
/// Space between entries.
const GAP: f64 = 1.4;

/// What stands for something.
#[derive(Clone, Copy, PartialEq)]
enum Sign {
    Series(Style, Role),
    Vertical(Role),
    Span(Role, bool),
    Bar(Role),
    Interval(Role),
}

/// An entry: its sign, its name, and whether it stands back.
type Entry<'a> = (Sign, &'a str, bool);

fn entries(panel: &Panel) -> Vec<Entry<'_>> {
    let series = panel.series.iter().map(|s| (Sign::Series(s.style, s.role), s.name.as_str(), s.faint));
    let verticals = panel.verticals.iter().map(|v| (Sign::Vertical(v.role), v.name, false));
    let spans = panel.spans.iter().map(|s| (Sign::Span(s.role, s.low), s.name, false));
    let bars = panel.bars.iter().map(|b| (Sign::Bar(b.role), b.name.as_str(), false));
    let intervals = panel.intervals.iter().map(|i| (Sign::Interval(i.role), i.name.as_str(), false));
    let mut entries: Vec<Entry<'_>> = Vec::new();
    for entry in bars.chain(series).chain(intervals).chain(verticals).chain(spans) {
        if !entry.1.is_empty() && !entries.contains(&entry) {
            entries.push(entry);
        }
    }
    entries
}

impl Pen<'_> {
    /// Place of each entry: distance from the left, and row.
    fn rows(&self, entries: &[Entry<'_>], room: f64) -> Vec<(f64, usize)> {
        let t = self.t;
        let (mut x, mut row) = (0.0, 0);
        let place = |(_, name, _): &Entry<'_>| {
            let wide = SIGN * t + width(name, t, false);
            if x > 0.0 && x + wide > room {
                (x, row) = (0.0, row + 1);
            }
            let place = (x, row);
            x += wide + GAP * t;
            place
        };
        entries.iter().map(place).collect()
    }

    /// Height that [`Pen::legend`] takes.
    pub(super) fn legend_height(&self, panel: &Panel, room: f64) -> f64 {
        let rows = self.rows(&entries(panel), room);
        rows.last().map_or(0.0, |(_, row)| (row + 1) as f64 * ROW * self.t + 0.3 * self.t)
    }

    /// Entries in rows, the first of which has its middle at `y`.
    pub(super) fn legend(&mut self, panel: &Panel, [left, y]: Spot, room: f64) {
        let t = self.t;
        let entries = entries(panel);
        let rows = self.rows(&entries, room);
        for ((sign, name, faint), (x, row)) in entries.into_iter().zip(rows) {
            let at = [left + x, y + row as f64 * ROW * t];
            self.sign(sign, [at[0] + 1.15 * t, at[1]]);
            let ink = if faint { Ink::Dim } else { Ink::Text };
            self.text(name, [at[0] + SIGN * t, at[1]], Look { ink, ..Look::PLAIN });
        }
    }

    fn dashes(&mut self, line: &[Spot], style: Style, role: Role) {
        // A little shorter than in the chart, so that whole dashes show.
        let dash = style.dash().map(|dash| dash.map(|length| 0.92 * length * self.t));
        self.line(line, Ink::Role(role), 0.13 * self.t, dash);
    }

    fn sign(&mut self, sign: Sign, [x, y]: Spot) {
        let t = self.t;
        let line = [[x - 1.15 * t, y], [x + 1.15 * t, y]];
        match sign {
            Sign::Series(Style::Line, role) => self.line(&line, Ink::Role(role), 0.16 * t, None),
            Sign::Series(Style::Heavy, role) => {
                self.line(&line, Ink::Role(role), 0.27 * t, None);
            }
            Sign::Series(Style::Thin, role) => self.line(&line, Ink::Role(role), 0.1 * t, None),
            Sign::Vertical(role) => self.dashes(&line, Vertical::style(role), role),
            Sign::Series(style, role) if style.dash().is_some() => self.dashes(&line, style, role),
            Sign::Series(Style::Triangles, role) => self.mark([x, y], Form::Triangle, role, Ink::Ground),
            Sign::Series(Style::Circles, role) => self.mark([x, y], Form::Circle, role, Ink::Ground),
            Sign::Series(Style::Dots | Style::Targets, role) => self.mark([x, y], Form::Dot, role, Ink::Ground),
            Sign::Series(Style::Rings, role) => self.mark([x, y], Form::Ring, role, Ink::Ground),
            Sign::Series(_, role) => self.mark([x, y], Form::Diamond, role, Ink::Ground),
            Sign::Interval(role) => {
                self.line(&line, Ink::Role(role), 0.12 * t, None);
                self.mark([x, y], Form::Dot, role, Ink::Ground);
            }
            Sign::Bar(role) | Sign::Span(role, _) => {
                let half = if matches!(sign, Sign::Span(_, true)) { 0.19 } else { 0.45 };
                let opacity = if matches!(sign, Sign::Span(_, false)) { super::data::SHADE } else { 1.0 };
                let rect = Rect { left: x - 1.15 * t, right: x + 1.15 * t, top: y - half * t, bottom: y + half * t };
                self.add(Item::Fill(rect, Paint { ink: Ink::Role(role), opacity }));
            }
        }
    }
}
