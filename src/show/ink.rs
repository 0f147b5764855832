//! The colours of a chart's inks: the same as those of the 3D view.

use crate::scene::Color;
use crate::scene::colormap::{colormap, member};
use crate::scene::palette::Palette;
use centrode_core::chart::Role;
use centrode_core::chart::layout::Ink;

/// The colour of an ink on a light or a dark ground.
#[must_use]
pub fn color(ink: Ink, palette: &Palette, dark: bool) -> Color {
    match ink {
        Ink::Role(role) => of_role(role, palette, dark),
        Ink::Text => palette.ink,
        Ink::Dim => palette.ink_dim,
        Ink::Grid => palette.ink_dim.mix(palette.halo, 0.78),
        Ink::Ground => palette.halo,
        Ink::White => Color::WHITE,
        Ink::Black => Color::hex(0),
        Ink::Map(share) => colormap(share),
    }
}

fn of_role(role: Role, palette: &Palette, dark: bool) -> Color {
    match role {
        Role::Model => palette.model,
        Role::Constrained => palette.constrained,
        Role::Sensor => palette.sensor,
        Role::Likelihood => palette.likelihood,
        Role::Force => palette.force,
        Role::Bound => palette.ink,
        Role::Robot | Role::Aside => palette.ink_dim,
        Role::Detection => palette.detection,
        Role::Contact => palette.stone,
        Role::Choice => palette.choice,
        Role::Member(share) => member(share, dark),
    }
}
