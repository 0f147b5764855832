//! Colours for numbers: even to the eye, in order for the colour-blind as well (viridis).

use super::Color;
use colorgrad::{BasisGradient, Gradient};
use std::sync::LazyLock;

static VIRIDIS: LazyLock<BasisGradient> = LazyLock::new(colorgrad::preset::viridis);

/// The colour of a share from 0 (dark) to 1 (light); clear for NaN.
#[must_use]
pub fn colormap(share: f64) -> Color {
    if share.is_nan() {
        return Color::CLEAR;
    }
    let [r, g, b, a] = VIRIDIS.at(share.clamp(0.0, 1.0) as f32).to_array();
    Color::rgba(r, g, b, a)
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
