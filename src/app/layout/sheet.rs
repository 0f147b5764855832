//! The sheet of a small screen: how far it is drawn out, and where that puts it.

use egui::{Rect, vec2};
use serde::{Deserialize, Serialize};

use super::Cut;
use crate::app::controls::row::TARGET;
use crate::app::theme::GAP;

/// Height of the strip at the top of a sheet, width of the one at its side, points.
const HEAD: f32 = 28.0;
const SIDE: f32 = 14.0;
/// How long the handle is, points.
const GRIP: f32 = 96.0;
/// A view that is lower or narrower than this is not shown, points.
const LEAST: f32 = 90.0;

/// Where a sheet comes to rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stop {
    /// Its head alone.
    Peek,
    /// The 3D view has the other half.
    #[default]
    Half,
    /// The 3D view is behind it.
    Full,
}

impl Stop {
    /// All of them, from the shortest.
    pub const ALL: [Self; 3] = [Self::Peek, Self::Half, Self::Full];

    /// The one at or nearest to a place between the first (0) and the last (2).
    #[must_use]
    pub fn nearest(at: f32) -> Self {
        Self::ALL[(at.round().max(0.0) as usize).min(Self::ALL.len() - 1)]
    }

    /// Its place, 0 to 2.
    #[must_use]
    pub fn at(self) -> f32 {
        f32::from(self as u8)
    }

    /// The one that a tap leads to: the next longer one, and after the last the first.
    #[must_use]
    pub fn next(self) -> Self {
        Self::ALL[(self as usize + 1) % Self::ALL.len()]
    }

    /// What it is called.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Peek => "peek",
            Self::Half => "half",
            Self::Full => "full",
        }
    }
}

/// How a sheet stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sheet {
    /// Whether it holds the controls, and not the tabs.
    pub controls: bool,
    /// How far it is drawn out: 0 at [`Stop::Peek`] to 2 at [`Stop::Full`].
    pub at: f32,
}

/// A sheet on the page, and the handle by which it is drawn out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Handle {
    /// All of the sheet.
    pub sheet: Rect,
    /// What a finger hits; it reaches over the 3D view.
    pub grip: Rect,
    /// Whether the sheet comes from the right, and not from below.
    pub beside: bool,
    /// How long it is at each stop, points.
    pub lengths: [f32; 3],
}

impl Handle {
    /// The place, 0 to 2, at which the sheet is so long.
    #[must_use]
    pub fn place(lengths: [f32; 3], length: f32) -> f32 {
        let [peek, half, full] = lengths;
        if length < half {
            ((length - peek) / (half - peek).max(1.0)).max(0.0)
        } else {
            (1.0 + (length - half) / (full - half).max(1.0)).min(2.0)
        }
    }

    /// How long the sheet is at a place.
    #[must_use]
    pub fn length(lengths: [f32; 3], at: f32) -> f32 {
        let [peek, half, full] = lengths;
        if at < 1.0 { egui::lerp(peek..=half, at.max(0.0)) } else { egui::lerp(half..=full, at.min(2.0) - 1.0) }
    }

    /// The strip with the handle, and what is left of the sheet.
    #[must_use]
    pub fn split(&self) -> (Rect, Rect) {
        match self.beside {
            true => self.sheet.split_left_right_at_x(self.sheet.left() + SIDE),
            false => self.sheet.split_top_bottom_at_y(self.sheet.top() + HEAD),
        }
    }
}

/// Draws a sheet out from below in a room; gives what is left for the view, too.
pub(super) fn below(room: Rect, sheet: Sheet) -> (Option<Rect>, Handle) {
    let half = room.height() * if sheet.controls { 0.64 } else { 0.56 };
    let lengths = [HEAD + TARGET + GAP, half, room.height() - GAP];
    let mut rest = Cut(room);
    let place = rest.bottom(Handle::length(lengths, sheet.at));
    let middle = place.center_top() + vec2(0.0, HEAD - 0.5 * TARGET);
    let grip = Rect::from_center_size(middle, vec2(GRIP, TARGET));
    let view = (rest.0.height() >= LEAST).then_some(rest.0);
    (view, Handle { sheet: place, grip, beside: false, lengths })
}

/// Draws a sheet out from the right.
pub(super) fn beside(room: Rect, sheet: Sheet) -> (Option<Rect>, Handle) {
    let half = 0.5 * room.width();
    let lengths = [(0.36 * room.width()).max(250.0).min(half), half, room.width() - TARGET + SIDE + GAP];
    let mut rest = Cut(room);
    let place = rest.right(Handle::length(lengths, sheet.at));
    let middle = place.left_center() + vec2(SIDE - 0.5 * TARGET, 0.0);
    let grip = Rect::from_center_size(middle, vec2(TARGET, GRIP));
    let view = (rest.0.width() >= LEAST).then_some(rest.0);
    (view, Handle { sheet: place, grip, beside: true, lengths })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_and_a_length_say_the_same() {
        let lengths = [80.0, 200.0, 440.0];
        for at in [0.0, 0.3, 1.0, 1.75, 2.0] {
            let length = Handle::length(lengths, at);
            assert!((Handle::place(lengths, length) - at).abs() < 1e-5, "{at}: {length}");
        }
        assert_eq!(Handle::place(lengths, 10.0), 0.0);
        assert_eq!(Handle::place(lengths, 900.0), 2.0);
    }

    #[test]
    fn taps_go_through_all_stops() {
        assert_eq!(Stop::ALL.map(Stop::next), [Stop::Half, Stop::Full, Stop::Peek]);
        for stop in Stop::ALL {
            assert_eq!(Stop::nearest(stop.at()), stop);
        }
        assert_eq!((Stop::nearest(-3.0), Stop::nearest(9.0)), (Stop::Peek, Stop::Full));
    }
}
