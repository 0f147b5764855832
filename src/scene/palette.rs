//! One colour per meaning, for a light and for a dark background.
//!
//! The four signal colours are Okabe and Ito's, which stay apart for colour-blind readers. On a dark background blue
//! and vermilion are lifted toward white, as printed they would sink. On a light one amber and green are darker in the same
//! hue: as printed they have contrasts of 2.2 to 1 on white, and of 2.9 to 1 on the page's own grey.

use super::{Color, Studio};

/// What the page is seen on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shade {
    /// A screen, on a dark background.
    Dark,
    /// A screen, on a light background.
    Light,
    /// A wall in a room that is not dark.
    Projector,
}

/// The colours of everything the views and plots name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Palette {
    /// Background and light of the 3D view.
    pub studio: Studio,
    /// The model without constraint.
    pub model: Color,
    /// The model with the constraint.
    pub constrained: Color,
    /// What the sensor says.
    pub sensor: Color,
    /// What the load cells say, and what loads them: Okabe and Ito's reddish purple, darker on white so that a thin line
    /// can be read.
    pub force: Color,
    /// A log likelihood ratio: Okabe and Ito's sky blue, darker on white so that a thin line can be read.
    pub likelihood: Color,
    /// A detection.
    pub detection: Color,
    /// What a person can touch, and what he chose: no signal has it.
    pub choice: Color,
    /// Backbones.
    pub steel: Color,
    /// The primary backbone, a shade apart from the others.
    pub steel_primary: Color,
    /// Backbones of segments in series, from the base and over again: as bright as they are thin, and of three tempers.
    pub steels: [Color; 3],
    /// Disks.
    pub disk: Color,
    /// The orientation mark on a disk.
    pub mark: Color,
    /// The obstacle.
    pub stone: Color,
    /// Text and thin lines over the background.
    pub ink: Color,
    /// The same, for what matters less.
    pub ink_dim: Color,
    /// Edge that parts a marker from what is behind it.
    pub halo: Color,
    /// Grid lines of the floor.
    pub grid: Color,
    /// Light on the floor.
    pub glow: Color,
    /// Darkness of the shadows on the floor, 0..1.
    pub ground_shadow: f32,
    /// How many times thicker lines are than on a screen.
    pub weight: f32,
}

impl Palette {
    /// For a light background.
    pub const LIGHT: Self = Self {
        studio: Studio::LIGHT,
        model: Color::hex(0x0072B2),
        constrained: Color::hex(0xAF7900),
        sensor: Color::hex(0x00966D),
        force: Color::hex(0xA94A82),
        likelihood: Color::hex(0x2B8BBC),
        detection: Color::hex(0xD55E00),
        choice: Color::hex(0x5A47D1),
        steel: Color::hex(0xD5DBE2),
        steel_primary: Color::hex(0xF0F2F5),
        steels: [Color::hex(0x7D8DA0), Color::hex(0xD5DBE2), Color::hex(0xD9B978)],
        disk: Color::hex(0xAEBBC8),
        mark: Color::hex(0x39424E),
        stone: Color::hex(0x69635A),
        ink: Color::hex(0x1D232B),
        ink_dim: Color::hex(0x616B76),
        halo: Color::hex(0xFFFFFF),
        grid: Color::rgba(0.16, 0.22, 0.30, 0.26),
        glow: Color::rgba(1.0, 1.0, 1.0, 0.0),
        ground_shadow: 0.24,
        weight: 1.0,
    };

    /// For a dark background.
    pub const DARK: Self = Self {
        studio: Studio::DARK,
        model: Color::hex(0x56A9DE),
        constrained: Color::hex(0xF0B03A),
        sensor: Color::hex(0x2BC495),
        force: Color::hex(0xE295C1),
        likelihood: Color::hex(0x7CCBF2),
        detection: Color::hex(0xFF7F3A),
        choice: Color::hex(0xA394FF),
        steel: Color::hex(0xD3DAE2),
        steel_primary: Color::hex(0xF0F3F6),
        steels: [Color::hex(0x74879C), Color::hex(0xD3DAE2), Color::hex(0xE0BF7C)],
        disk: Color::hex(0x93A6B8),
        mark: Color::hex(0xE8EDF2),
        stone: Color::hex(0x8C8477),
        ink: Color::hex(0xE6EBF0),
        ink_dim: Color::hex(0x93A0AE),
        halo: Color::hex(0x14181D),
        grid: Color::rgba(0.75, 0.84, 0.95, 0.22),
        glow: Color::rgba(0.62, 0.72, 0.85, 0.10),
        ground_shadow: 0.55,
        weight: 1.0,
    };

    /// For a projector, which washes colours out: every signal has at least five times less light than the white behind it.
    pub const PROJECTOR: Self = Self {
        model: Color::hex(0x005A8C),
        constrained: Color::hex(0x9A5F00),
        sensor: Color::hex(0x00664A),
        force: Color::hex(0x8A2F66),
        likelihood: Color::hex(0x1A6A94),
        detection: Color::hex(0xA84400),
        choice: Color::hex(0x4433B8),
        mark: Color::hex(0x20262E),
        stone: Color::hex(0x57524A),
        ink: Color::hex(0x000000),
        ink_dim: Color::hex(0x3C444D),
        weight: 1.6,
        ..Self::LIGHT
    };

    /// The palette of a shade.
    #[must_use]
    pub const fn of(shade: Shade) -> Self {
        match shade {
            Shade::Dark => Self::DARK,
            Shade::Light => Self::LIGHT,
            Shade::Projector => Self::PROJECTOR,
        }
    }

    /// The palette for a dark or a light theme.
    pub const fn for_dark(dark: bool) -> Self {
        if dark { Self::DARK } else { Self::LIGHT }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signals_and_text_can_be_read() {
        for palette in [Palette::LIGHT, Palette::DARK, Palette::PROJECTOR] {
            for background in [palette.studio.inner, palette.studio.outer] {
                assert!(palette.ink.contrast(background) > 12.0);
                assert!(palette.ink_dim.contrast(background) > 4.5);
                // Graphics, not text: WCAG asks for 3.
                let Palette { model, constrained, sensor, force, likelihood, detection, choice, .. } = palette;
                for signal in [model, constrained, sensor, force, likelihood, detection, choice] {
                    assert!(signal.contrast(background) >= 3.0, "{signal:?} {}", signal.contrast(background));
                }
            }
        }
    }

    #[test]
    fn light_signals_are_okabe_and_itos() {
        let light = Palette::LIGHT;
        assert_eq!(light.model, Color::hex(0x0072B2));
        // Amber and green, darker.
        let (amber, printed) = (light.constrained, Color::hex(0xE69F00));
        assert!((amber.g / amber.r - printed.g / printed.r).abs() < 0.01 && amber.b == printed.b, "another hue");
        let (green, printed) = (light.sensor, Color::hex(0x009E73));
        assert!((green.b / green.g - printed.b / printed.g).abs() < 0.01 && green.r == printed.r, "another hue");
        assert!(green.g > 0.94 * printed.g, "no darker than it has to be");
        assert_eq!(light.detection, Color::hex(0xD55E00));
    }
}
