//! Colours for numbers: even to the eye, in order for the colour-blind as well (viridis).

use super::Color;

/// Nine colours of viridis, evenly spaced, from dark to light.
const VIRIDIS: [Color; 9] = [
    Color::hex(0x440154),
    Color::hex(0x482777),
    Color::hex(0x3f4a8a),
    Color::hex(0x31678e),
    Color::hex(0x26838f),
    Color::hex(0x1f9d8a),
    Color::hex(0x6cce5a),
    Color::hex(0xb6de2b),
    Color::hex(0xfee825),
];

/// The colour of a share from 0 (dark) to 1 (light); clear for NaN.
///
/// A uniform cubic B-spline between `VIRIDIS`, whose ends are those of the list.
#[must_use]
pub fn colormap(share: f64) -> Color {
    if share.is_nan() {
        return Color::CLEAR;
    }
    let last = VIRIDIS.len() - 1;
    let place = share.clamp(0.0, 1.0) as f32 * last as f32;
    let left = (place as usize).min(last - 1);
    let t = place - left as f32;
    let rest = 1.0 - t;
    let weights = [
        rest * rest * rest,
        4.0 - 6.0 * t * t + 3.0 * t * t * t,
        4.0 - 6.0 * rest * rest + 3.0 * rest * rest * rest,
        t * t * t,
    ];
    let channel = |of: fn(&Color) -> f32| {
        let [from, to] = [of(&VIRIDIS[left]), of(&VIRIDIS[left + 1])];
        // Beyond an end the list goes on as straight as it comes.
        let before = if left == 0 { 2.0 * from - to } else { of(&VIRIDIS[left - 1]) };
        let after = if left + 1 == last { 2.0 * to - from } else { of(&VIRIDIS[left + 2]) };
        let [a, b, c, d] = weights;
        (a * before + b * from + c * to + d * after) / 6.0
    };
    Color::rgba(channel(|color| color.r), channel(|color| color.g), channel(|color| color.b), 1.0)
}

/// A shade for one of a family of lines by its share from 0 to 1, which stands out from a dark or a light background.
#[must_use]
pub fn member(share: f64, dark: bool) -> Color {
    let [low, high] = if dark { [0.35, 1.0] } else { [0.0, 0.7] };
    colormap(low + (high - low) * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn larger_is_lighter() {
        let luminance = |share: f64| Color::luminance(colormap(share));
        let shares: Vec<f64> = (0..=50).map(|k| f64::from(k) / 50.0).collect();
        assert!(shares.windows(2).all(|pair| luminance(pair[0]) < luminance(pair[1])));
        assert_eq!(colormap(-1.0), colormap(0.0));
        let near = |one: Color, other: Color| {
            let apart = [one.r - other.r, one.g - other.g, one.b - other.b];
            apart.iter().all(|difference| difference.abs() < 1e-6)
        };
        assert!(near(colormap(0.0), VIRIDIS[0]) && near(colormap(1.0), VIRIDIS[8]));
        assert_eq!(colormap(f64::NAN), Color::CLEAR);
    }

    #[test]
    fn members_can_be_seen() {
        use crate::scene::palette::Palette;
        for dark in [false, true] {
            let background = Palette::for_dark(dark).halo;
            for share in [0.0, 0.5, 1.0] {
                assert!(member(share, dark).contrast(background) > 2.0, "{share} on dark {dark}");
            }
        }
    }
}
