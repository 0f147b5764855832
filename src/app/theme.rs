//! Colours and measures of the interface.
//!
//! Colour means something: those of the signals come from the scene's palette and are the same everywhere. What can be
//! touched has the one accent, which no signal uses; everything else is grey.

use egui::{Color32, CornerRadius, Margin, Shadow, Stroke, Vec2, vec2};
use serde::{Deserialize, Serialize};

use crate::app::fonts;
use crate::scene::Color;
use crate::scene::palette::{Palette, Shade};

/// Corner radius of a card, points.
pub const ROUND: u8 = 10;
/// Space between cards, points.
pub const GAP: f32 = 8.0;
/// The least size of what a mouse works, points.
pub const MOUSE: Vec2 = vec2(32.0, 28.0);

/// Which theme is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ThemeChoice {
    /// As the system says.
    #[default]
    System,
    /// Light.
    Light,
    /// Dark.
    Dark,
    /// Light, with stronger colours, larger type and thicker lines.
    Projector,
}

impl ThemeChoice {
    /// The next one in the switch's cycle.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::System => Self::Dark,
            Self::Dark => Self::Light,
            Self::Light => Self::Projector,
            Self::Projector => Self::System,
        }
    }

    /// Its name in a link; none while nobody has chosen one.
    #[must_use]
    pub fn key(self) -> Option<&'static str> {
        match self {
            Self::System => None,
            Self::Light => Some("light"),
            Self::Dark => Some("dark"),
            Self::Projector => Some("projector"),
        }
    }

    /// The one of this name in a link.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let known = [Self::Light, Self::Dark, Self::Projector].into_iter().find(|theme| theme.key() == Some(name));
        known.or((name == "system").then_some(Self::System))
    }

    /// In egui's terms.
    #[must_use]
    pub fn preference(self) -> egui::ThemePreference {
        match self {
            Self::System => egui::ThemePreference::System,
            Self::Light | Self::Projector => egui::ThemePreference::Light,
            Self::Dark => egui::ThemePreference::Dark,
        }
    }
}

/// Every colour the interface uses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Theme {
    /// What the page is seen on.
    pub shade: Shade,
    /// Whether the background is dark.
    pub dark: bool,
    /// How many times thicker lines are than on a screen.
    pub weight: f32,
    /// The model without constraint.
    pub model: Color32,
    /// The model with the constraint.
    pub constrained: Color32,
    /// What the sensor says.
    pub sensor: Color32,
    /// What the load cells say.
    pub force: Color32,
    /// A detection.
    pub detection: Color32,
    /// A detection in words, and what is behind words of it.
    pub alarm: Color32,
    /// Robot.
    pub robot: Color32,
    /// Obstacle, and contact with it.
    pub obstacle: Color32,
    /// Text.
    pub ink: Color32,
    /// Text that matters less: units, hints.
    pub dim: Color32,
    /// Lines and rails.
    pub faint: Color32,
    /// Lines by which a control or its state is known.
    pub edge: Color32,
    /// Behind everything.
    pub surface: Color32,
    /// Cards.
    pub panel: Color32,
    /// Fields and buttons on a card.
    pub raised: Color32,
    /// What can be touched, and what has the focus.
    pub accent: Color32,
    /// Text and signs on the accent.
    pub on_accent: Color32,
    /// A refusal.
    pub error: Color32,
}

fn color(color: Color) -> Color32 {
    let [r, g, b, a] = color.to_bytes();
    Color32::from_rgba_unmultiplied(r, g, b, a)
}

impl Theme {
    /// The theme this `ui` is drawn in.
    #[must_use]
    pub fn of(ui: &egui::Ui) -> Self {
        let visuals = ui.visuals();
        // The style says it by its lines.
        Self::new(match visuals.dark_mode {
            true => Shade::Dark,
            false if visuals.window_stroke.width > 1.0 => Shade::Projector,
            false => Shade::Light,
        })
    }

    /// The theme of a shade.
    #[must_use]
    pub fn new(shade: Shade) -> Self {
        let dark = shade == Shade::Dark;
        let three = |light: u32, dark: u32, projector: u32| {
            color(Color::hex(match shade {
                Shade::Dark => dark,
                Shade::Light => light,
                Shade::Projector => projector,
            }))
        };
        let hex = |light: u32, dark: u32| three(light, dark, light);
        let palette = Palette::of(shade);
        Self {
            shade,
            dark,
            weight: palette.weight,
            model: color(palette.model),
            constrained: color(palette.constrained),
            sensor: color(palette.sensor),
            force: color(palette.force),
            detection: color(palette.detection),
            alarm: three(0xB84F00, 0xFF7F3A, 0xA84400),
            robot: three(0x788491, 0xAEBBC8, 0x5A6572),
            obstacle: color(palette.stone),
            ink: color(palette.ink),
            dim: color(palette.ink_dim),
            faint: three(0xDCE1E7, 0x2C343E, 0xA9B1BA),
            edge: three(0x7C8792, 0x6B7785, 0x6B747E),
            surface: hex(0xE9EDF1, 0x0C0F13),
            panel: hex(0xFFFFFF, 0x161B21),
            raised: hex(0xF1F4F7, 0x20262E),
            accent: color(palette.choice),
            on_accent: hex(0xFFFFFF, 0x14101F),
            error: three(0xB3203E, 0xFF8296, 0x9A1532),
        }
    }

    /// A line that is so wide on a screen, points.
    #[must_use]
    pub fn line(&self, width: f32, color: Color32) -> Stroke {
        Stroke::new(self.weight * width, color)
    }

    fn visuals(&self) -> egui::Visuals {
        let mut visuals = if self.dark { egui::Visuals::dark() } else { egui::Visuals::light() };
        let radius = CornerRadius::same(6);
        let state = |fill: Color32, text: Color32, edge: Color32| egui::style::WidgetVisuals {
            bg_fill: fill,
            weak_bg_fill: fill,
            bg_stroke: Stroke::new(self.weight, edge),
            corner_radius: radius,
            fg_stroke: Stroke::new(1.0, text),
            expansion: 0.0,
        };
        let hover = self.raised.lerp_to_gamma(self.ink, 0.06);
        let none = Color32::TRANSPARENT;
        visuals.widgets = egui::style::Widgets {
            noninteractive: state(self.panel, self.ink, self.faint),
            inactive: state(self.raised, self.ink, if self.weight > 1.0 { self.edge } else { none }),
            hovered: state(hover, self.ink, none),
            active: state(hover, self.ink, self.accent),
            open: state(hover, self.ink, self.faint),
        };
        visuals.weak_text_color = Some(self.dim);
        visuals.selection.bg_fill = self.accent.gamma_multiply(if self.dark { 0.35 } else { 0.20 });
        visuals.selection.stroke = Stroke::new(1.0, self.ink);
        visuals.hyperlink_color = self.accent;
        visuals.faint_bg_color = self.raised;
        visuals.extreme_bg_color = self.raised;
        visuals.text_edit_bg_color = Some(self.raised);
        visuals.code_bg_color = self.raised;
        visuals.warn_fg_color = self.alarm;
        visuals.error_fg_color = self.error;
        visuals.panel_fill = self.surface;
        visuals.window_fill = self.panel;
        visuals.window_stroke = Stroke::new(self.weight, self.faint);
        visuals.window_corner_radius = CornerRadius::same(ROUND);
        visuals.menu_corner_radius = CornerRadius::same(8);
        let shadow = Shadow {
            offset: [0, 6],
            blur: 24,
            spread: 0,
            color: Color32::from_black_alpha(if self.dark { 120 } else { 40 }),
        };
        visuals.window_shadow = shadow;
        visuals.popup_shadow = shadow;
        visuals.striped = false;
        visuals.interact_cursor = Some(egui::CursorIcon::PointingHand);
        visuals
    }
}

/// Sets fonts, and the styles of both themes.
pub fn install(ctx: &egui::Context) {
    fonts::install(ctx);
    for (theme, shade) in [(egui::Theme::Dark, Shade::Dark), (egui::Theme::Light, Shade::Light)] {
        let mut style = (*ctx.style_of(theme)).clone();
        style.visuals = Theme::new(shade).visuals();
        style.text_styles = fonts::text_styles();
        style.drag_value_text_style = egui::TextStyle::Body;
        style.spacing.item_spacing = vec2(8.0, 6.0);
        style.spacing.button_padding = vec2(10.0, 5.0);
        style.spacing.interact_size = MOUSE;
        style.spacing.menu_margin = Margin::same(6);
        style.spacing.window_margin = Margin::same(20);
        style.spacing.tooltip_width = 280.0;
        style.interaction.selectable_labels = false;
        style.interaction.tooltip_delay = 0.35;
        style.explanation_tooltips = false;
        ctx.set_style_of(theme, style);
    }
}

/// Leaves out what moves on its way from one state to another, and what goes on scrolling once a finger has let go.
pub fn hold_still(ctx: &egui::Context) {
    ctx.all_styles_mut(|style| {
        style.animation_time = 0.0;
        style.scroll_animation = egui::style::ScrollAnimation::none();
        style.spacing.scroll.kinetic.decay_time = 0.0;
        style.spacing.scroll.kinetic.rubber_band = false;
    });
}

/// How many times larger everything is for a projector.
const LARGER: f32 = 1.25;
/// Where the page is less wide, points, larger type would leave no room for what it says.
const NARROW: f32 = 1000.0;

/// Shows the page in the theme that is wanted from now on, where that is another.
pub fn follow(ctx: &egui::Context, choice: ThemeChoice) {
    let last = ctx.data_mut(|data| std::mem::replace(data.get_temp_mut_or_default(egui::Id::NULL), choice));
    if last != choice {
        choose(ctx, choice);
    }
}

/// Shows the page in a theme.
pub fn choose(ctx: &egui::Context, choice: ThemeChoice) {
    let projector = choice == ThemeChoice::Projector;
    let mut style = (*ctx.style_of(egui::Theme::Light)).clone();
    style.visuals = Theme::new(if projector { Shade::Projector } else { Shade::Light }).visuals();
    ctx.set_style_of(egui::Theme::Light, style);
    ctx.set_theme(choice.preference());
    let width = ctx.content_rect().width() * ctx.zoom_factor();
    ctx.set_zoom_factor(if projector && width >= NARROW { LARGER } else { 1.0 });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::charts::paint;
    use centrode_core::chart::Chart;
    use centrode_core::chart::layout::{Ink, Item, Page, Paint, layout};
    use centrode_core::detect::Method;
    use centrode_core::run::simulate;
    use centrode_core::scenario::preset::PRESETS;
    use centrode_core::study::course;

    fn contrast(a: Color32, b: Color32) -> f32 {
        let scene = |c: Color32| Color::hex(u32::from(c.r()) << 16 | u32::from(c.g()) << 8 | u32::from(c.b()));
        scene(a).contrast(scene(b))
    }

    const SHADES: [Shade; 3] = [Shade::Dark, Shade::Light, Shade::Projector];

    /// WCAG 2.2, 1.4.3: text, 4.5 to 1.
    #[test]
    fn text_can_be_read_on_everything_it_stands_on() {
        for theme in SHADES.map(Theme::new) {
            for ground in [theme.surface, theme.panel, theme.raised] {
                for (text, least) in [(theme.ink, 10.0), (theme.dim, 4.5), (theme.error, 4.5), (theme.accent, 4.5)] {
                    assert!(contrast(text, ground) > least, "{text:?} on {ground:?}: {}", contrast(text, ground));
                }
            }
            for ground in [theme.panel, theme.raised] {
                assert!(contrast(theme.alarm, ground) > 4.5, "{:?} on {ground:?}", theme.alarm);
            }
            assert!(contrast(theme.on_accent, theme.accent) > 4.5);
            // The word on the chip.
            let word = if theme.dark { theme.surface } else { theme.panel };
            assert!(contrast(word, theme.alarm) > 4.5);
        }
    }

    /// WCAG 2.2, 1.4.11: lines, marks and controls, 3 to 1.
    #[test]
    fn lines_and_controls_stand_out() {
        for theme in SHADES.map(Theme::new) {
            let lines = [
                ("model", theme.model),
                ("constrained", theme.constrained),
                ("sensor", theme.sensor),
                ("force", theme.force),
                ("detection", theme.detection),
                ("likelihood", color(Palette::of(theme.shade).likelihood)),
                ("robot", theme.robot),
                ("obstacle", theme.obstacle),
                ("edge", theme.edge),
                ("accent", theme.accent),
            ];
            for ground in [theme.surface, theme.panel, theme.raised] {
                for (name, line) in lines {
                    let found = contrast(line, ground);
                    assert!(found >= 3.0, "{name} in {:?} on {ground:?}: {found}", theme.shade);
                }
            }
        }
    }

    /// What is behind the lines of a plot before alarms are armed, and in contact.
    fn shaded(theme: &Theme) -> Vec<Color32> {
        let run = simulate(&PRESETS[0].scenario().expect("valid")).expect("a run");
        let chart = Chart {
            panels: vec![course::statistic(&run, &[Method::Fcd], 0.01), course::angle(&run)],
            ..Chart::default()
        };
        let drawing = layout(&chart, &Page::screen([400.0, 200.0], 12.0));
        let fills = drawing.shapes.iter().filter_map(|item| match item {
            Item::Fill(_, Paint { ink: Ink::Role(role), opacity }) if *opacity < 1.0 => {
                let shade = paint::color(Ink::Role(*role), theme);
                Some(theme.panel.lerp_to_gamma(shade, *opacity as f32))
            }
            _ => None,
        });
        fills.collect()
    }

    #[test]
    fn lines_of_plots_stand_out_where_these_are_shaded() {
        for theme in SHADES.map(Theme::new) {
            let grounds = shaded(&theme);
            assert!(grounds.len() >= 2, "{grounds:?}");
            let likelihood = color(Palette::of(theme.shade).likelihood);
            for line in
                [theme.sensor, theme.force, theme.robot, theme.detection, theme.model, likelihood, theme.constrained]
            {
                for ground in &grounds {
                    let found = contrast(line, *ground);
                    assert!(found >= 3.0, "{line:?} in {:?} on {ground:?}: {found}", theme.shade);
                }
            }
        }
    }

    #[test]
    fn a_projector_has_thicker_lines_and_the_rest_of_the_cycle_none() {
        let ctx = egui::Context::default();
        install(&ctx);
        let mut seen = Vec::new();
        let mut choice = ThemeChoice::System;
        for _ in 0..4 {
            choice = choice.next();
            choose(&ctx, choice);
            let style = ctx.style_of(if choice == ThemeChoice::Dark { egui::Theme::Dark } else { egui::Theme::Light });
            seen.push((choice, style.visuals.window_stroke.width > 1.0));
        }
        let wanted = [
            (ThemeChoice::Dark, false),
            (ThemeChoice::Light, false),
            (ThemeChoice::Projector, true),
            (ThemeChoice::System, false),
        ];
        assert_eq!(seen, wanted);
    }
}
