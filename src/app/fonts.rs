//! Type: Inter in two weights, cut down to what the page writes, with tabular figures.

use std::collections::BTreeMap;
use std::sync::Arc;

use egui::{FontData, FontDefinitions, FontFamily, FontId, TextStyle};

/// The regular weight, as a file.
pub const REGULAR: &[u8] = include_bytes!("../../assets/fonts/Inter-Regular.otf");
/// The heavier weight, as a file.
pub const SEMIBOLD: &[u8] = include_bytes!("../../assets/fonts/Inter-SemiBold.otf");

/// The heavier weight.
#[must_use]
pub fn strong_family() -> FontFamily {
    FontFamily::Name("strong".into())
}

/// The heavier weight at a size in points.
#[must_use]
pub fn strong(size: f32) -> FontId {
    FontId::new(size, strong_family())
}

/// The regular weight at a size in points.
#[must_use]
pub fn regular(size: f32) -> FontId {
    FontId::new(size, FontFamily::Proportional)
}

/// Both weights, and nothing else.
#[must_use]
pub fn definitions() -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    for (name, bytes) in [("regular", REGULAR), ("strong", SEMIBOLD)] {
        fonts.font_data.insert(name.into(), Arc::new(FontData::from_static(bytes)));
    }
    for family in [FontFamily::Proportional, FontFamily::Monospace] {
        fonts.families.insert(family, vec!["regular".into()]);
    }
    fonts.families.insert(strong_family(), vec!["strong".into(), "regular".into()]);
    fonts
}

/// Sizes of egui's text styles.
#[must_use]
pub fn text_styles() -> BTreeMap<TextStyle, FontId> {
    [
        (TextStyle::Heading, strong(17.0)),
        (TextStyle::Body, regular(13.5)),
        (TextStyle::Button, regular(13.5)),
        (TextStyle::Monospace, regular(13.0)),
        (TextStyle::Small, regular(11.5)),
    ]
    .into()
}

/// Makes egui use them.
pub fn install(ctx: &egui::Context) {
    ctx.set_fonts(definitions());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::controls::table;
    use crate::app::words;
    use centrode_core::scenario::preset::PRESETS;
    use egui::epaint::text::{Fonts, TextOptions};

    #[test]
    fn every_text_can_be_written() {
        let mut texts: Vec<String> = vec!["Θ ‖c_m − c_s‖ ξ₁ ξ₂ ε_c ± × · … – “quoted” ← → ↑ ↓ 0123456789".into()];
        for group in table::GROUPS {
            texts.extend([group.name, group.note].map(String::from));
            for control in group.controls {
                texts.extend([control.label.into(), control.tip(), control.quantity().unit().into()]);
            }
            for choice in group.choices {
                texts.extend([choice.label.into(), choice.tip()]);
                texts.extend(choice.options.iter().map(|option| (*option).into()));
            }
        }
        for preset in PRESETS {
            texts.extend([preset.name.into(), preset.summary().into()]);
        }
        for (title, body) in words::help::PARAGRAPHS {
            texts.extend([(*title).into(), (*body).into()]);
        }
        let keys =
            words::keys::KEYS.iter().flat_map(|(place, keys)| [(*place, "")].into_iter().chain(keys.iter().copied()));
        texts.extend(keys.flat_map(|(key, what)| [key.into(), what.into()]));

        let mut fonts = Fonts::new(TextOptions::default(), definitions());
        let mut view = fonts.with_pixels_per_point(1.0);
        for font in [regular(13.0), strong(13.0)] {
            for character in texts.iter().flat_map(|text| text.chars()) {
                assert!(character == '\n' || view.has_glyph(&font, character), "{font:?} lacks {character:?}");
            }
        }
    }

    #[test]
    fn figures_are_tabular() {
        let mut fonts = Fonts::new(TextOptions::default(), definitions());
        let mut view = fonts.with_pixels_per_point(1.0);
        for font in [regular(13.0), strong(13.0)] {
            let widths: Vec<f32> = "0123456789".chars().map(|digit| view.glyph_width(&font, digit)).collect();
            assert!(widths.iter().all(|width| (width - widths[0]).abs() < 1e-3), "{widths:?}");
        }
    }
}
