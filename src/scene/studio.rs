//! Background and light.

use glam::Vec3;

use super::Color;

/// The room in which a scene is shown: background and light, fixed in the scene except for fill and rim, which follow the viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Studio {
    /// Background behind the middle of the picture. Alpha below 1 lets through what is drawn under the view.
    pub inner: Color,
    /// Background in the corners.
    pub outer: Color,
    /// Direction toward the key light, which casts the shadows; any length.
    pub key_from: Vec3,
    /// Strength of the key light.
    pub key: f32,
    /// Strength of the fill light, from the viewer's left.
    pub fill: f32,
    /// Light from above, on all sides.
    pub sky: Color,
    /// Light from below, on all sides.
    pub floor: Color,
    /// Light from behind, which draws the edges.
    pub rim: f32,
    /// How dark shadows on bodies are, 0..1.
    pub shadow: f32,
}

impl Studio {
    /// On white.
    pub const LIGHT: Self = Self {
        inner: Color::hex(0xFFFFFF),
        outer: Color::hex(0xF0F3F6),
        key_from: Vec3::new(-0.30, -0.50, 1.45),
        key: 0.78,
        fill: 0.20,
        sky: Color::hex(0xA9B2BD),
        floor: Color::hex(0x9A9895),
        rim: 0.10,
        shadow: 0.55,
    };

    /// On near-black.
    pub const DARK: Self = Self {
        inner: Color::hex(0x20262E),
        outer: Color::hex(0x11151A),
        key_from: Vec3::new(-0.30, -0.50, 1.45),
        key: 0.85,
        fill: 0.16,
        sky: Color::hex(0x808A97),
        floor: Color::hex(0x595C63),
        rim: 0.30,
        shadow: 0.65,
    };
}
