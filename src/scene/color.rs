//! Colours.

/// An sRGB colour with straight (not premultiplied) alpha; every component lies in 0..=1.
///
/// sRGB because that is what a palette, a plot and a style sheet hold; the renderer decodes it where it lights things.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Color {
    /// Red, sRGB-encoded.
    pub r: f32,
    /// Green, sRGB-encoded.
    pub g: f32,
    /// Blue, sRGB-encoded.
    pub b: f32,
    /// Opacity.
    pub a: f32,
}

impl Color {
    /// Fully transparent.
    pub const CLEAR: Self = Self::rgba(0.0, 0.0, 0.0, 0.0);
    /// Opaque white.
    pub const WHITE: Self = Self::rgba(1.0, 1.0, 1.0, 1.0);
    /// Opaque black.
    pub const BLACK: Self = Self::rgba(0.0, 0.0, 0.0, 1.0);

    /// A colour from its components.
    pub const fn rgba(r: f32, g: f32, b: f32, a: f32) -> Self {
        Self { r, g, b, a }
    }

    /// An opaque colour from `0xRRGGBB`.
    pub const fn hex(rgb: u32) -> Self {
        Self::rgba(
            ((rgb >> 16) & 0xff) as f32 / 255.0,
            ((rgb >> 8) & 0xff) as f32 / 255.0,
            (rgb & 0xff) as f32 / 255.0,
            1.0,
        )
    }

    /// The same colour with this opacity.
    #[must_use]
    pub const fn alpha(self, a: f32) -> Self {
        Self { a, ..self }
    }

    /// The colour `t` of the way to `other`, mixed in sRGB.
    #[must_use]
    pub fn mix(self, other: Self, t: f32) -> Self {
        let lerp = |a: f32, b: f32| a + (b - a) * t;
        Self::rgba(lerp(self.r, other.r), lerp(self.g, other.g), lerp(self.b, other.b), lerp(self.a, other.a))
    }

    /// The components in order red, green, blue, alpha.
    pub const fn to_array(self) -> [f32; 4] {
        [self.r, self.g, self.b, self.a]
    }

    /// The components as bytes; what is out of range (or NaN) is clamped.
    pub fn to_bytes(self) -> [u8; 4] {
        self.to_array().map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
    }

    /// The components decoded to linear light; alpha unchanged.
    pub fn to_linear(self) -> [f32; 4] {
        let decode = |v: f32| {
            if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
        };
        [decode(self.r), decode(self.g), decode(self.b), self.a]
    }

    /// Relative luminance (0 black, 1 white) as WCAG defines it; alpha is ignored.
    pub fn luminance(self) -> f32 {
        let [r, g, b, _] = self.to_linear();
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    /// Contrast ratio (1 to 21) as WCAG defines it; alpha is ignored.
    pub fn contrast(self, other: Self) -> f32 {
        let (a, b) = (self.luminance(), other.luminance());
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hex_and_bytes_agree() {
        assert_eq!(Color::hex(0x0072B2).to_bytes(), [0x00, 0x72, 0xB2, 0xFF]);
        assert_eq!(Color::rgba(2.0, -1.0, f32::NAN, 0.5).to_bytes(), [255, 0, 0, 128]);
    }

    #[test]
    fn contrast_spans_its_range() {
        assert!((Color::WHITE.contrast(Color::BLACK) - 21.0).abs() < 1e-3);
        assert!((Color::WHITE.contrast(Color::WHITE) - 1.0).abs() < 1e-6);
    }
}
