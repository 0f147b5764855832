//! One control: label, reset, switch, field, slider, and what was refused.

use egui::{Align2, Rect, Sense, Ui, vec2};

use crate::app::command::Command;
use crate::app::controls::control::{Choice, Control};
use crate::app::theme::Theme;
use crate::app::widgets::field::{Field, field};
use crate::app::widgets::icon::{self, Icon};
use crate::app::widgets::rail::Rail;
use crate::app::widgets::segmented::{segmented, several};
use crate::app::widgets::slider::{Slider, slider};
use crate::app::widgets::text;
use crate::app::widgets::toggle::toggle;
use centrode_core::scenario::Scenario;

/// What a finger hits, points.
pub const TARGET: f32 = 44.0;
/// Heights of the line with the field and of the slider; larger for a finger.
const HEIGHTS: (f32, f32) = (24.0, 19.0);
const TOUCH: (f32, f32) = (TARGET, TARGET);
const FIELD: f32 = 84.0;
/// So many options of which any can hold stand in a row.
const IN_A_ROW: usize = 3;

/// What a row needs to know besides its control.
pub struct Context<'a> {
    /// The scenario as it is.
    pub scenario: &'a Scenario,
    /// The preset's, for notch and reset.
    pub base: &'a Scenario,
    /// What was refused last, in words.
    pub note: Option<&'a str>,
    /// The value to show while it is switched off, in the unit shown.
    pub remembered: Option<f64>,
    /// Whether it is to be large enough for a finger.
    pub touch: bool,
}

/// Label and reset button; returns whether it was reset.
fn heading(ui: &mut Ui, rect: Rect, key: &str, (label, tip): (&str, &str), differs: bool) -> bool {
    let theme = Theme::of(ui);
    let ink = if differs { theme.ink } else { theme.ink.lerp_to_gamma(theme.dim, 0.35) };
    let drawn = text::paint_rich(ui, rect.left_center(), Align2::LEFT_CENTER, label, 13.0, ink);
    ui.interact(drawn.expand(2.0), ui.make_persistent_id(("label", key)), Sense::hover()).on_hover_text(tip);
    if !differs {
        return false;
    }
    let side = if rect.height() < TARGET { 22.0 } else { TARGET };
    let place = Rect::from_center_size(drawn.right_center() + vec2(4.0 + 0.5 * side, 0.0), vec2(side, side));
    ui.push_id(key, |ui| icon::button(ui, place, Icon::Reset, &format!("Reset {label}"), icon::Look::Plain))
        .inner
        .clicked()
}

/// A number that can be slid and typed, in the unit shown.
pub struct Row<'a> {
    /// Identity.
    pub key: &'a str,
    /// Name.
    pub label: &'a str,
    /// What it does, in a sentence or two.
    pub tip: &'a str,
    /// Whether it differs from where it goes back to.
    pub differs: bool,
    /// Text and unit of the field.
    pub shown: (&'a str, &'a str),
    /// Whether a keyboard of digits will do for it.
    pub digits: bool,
    /// The value; none while it is switched off.
    pub value: Option<f64>,
    /// The value to show meanwhile.
    pub remembered: Option<f64>,
    /// How values lie along the slider.
    pub rail: Rail,
    /// Where it goes back to.
    pub notch: Option<f64>,
    /// What it is called when it is switched on, where it can be.
    pub switch: Option<&'static str>,
    /// What was refused last, in words.
    pub note: Option<&'a str>,
    /// Whether it is to be large enough for a finger.
    pub touch: bool,
}

/// What is asked of a row.
#[derive(Debug, Clone, PartialEq)]
pub enum Asked {
    /// The value it goes back to.
    Reset,
    /// What was typed.
    Typed(String),
    /// To be switched on or off.
    Switch(bool),
    /// A value.
    Slid(f64),
}

/// Shows a row; returns what is asked of it.
pub fn row(ui: &mut Ui, row: &Row<'_>) -> Option<Asked> {
    let (line_height, rail_height) = if row.touch { TOUCH } else { HEIGHTS };
    let width = ui.available_width();
    let (rect, _) = ui.allocate_exact_size(vec2(width, line_height + rail_height), Sense::hover());
    let line = Rect::from_min_size(rect.min, vec2(width, line_height));
    let reset = heading(ui, line, row.key, (row.label, row.tip), row.differs);
    let mut asked = reset.then_some(Asked::Reset);

    let (shown, unit) = row.shown;
    let wide = if row.touch { FIELD + 12.0 } else { FIELD };
    let place = Rect::from_min_max(line.right_top() - vec2(wide, 0.0), line.right_bottom());
    let name = format!("{} value", row.label);
    let entry = Field { label: &name, key: row.key, shown, unit, digits: row.digits, refused: row.note.is_some() };
    asked = field(ui, place, &entry).map(Asked::Typed).or(asked);
    if let Some(on) = row.switch {
        let wide = if row.touch { TARGET } else { 32.0 };
        let place = Rect::from_center_size(place.left_center() - vec2(6.0 + 0.5 * wide, 0.0), vec2(wide, line_height));
        if toggle(ui, place, &format!("{} {on}", row.label), row.value.is_some()) {
            asked = Some(Asked::Switch(row.value.is_none()));
        }
    }

    let track = Rect::from_min_size(line.left_bottom(), vec2(width, rail_height));
    let spoken = if unit.is_empty() { shown.to_owned() } else { format!("{shown} {unit}") };
    let slid = Slider {
        key: row.key,
        label: row.label,
        spoken: &spoken,
        rail: row.rail,
        value: row.value.or(row.remembered).unwrap_or(0.0),
        notch: row.notch,
        on: row.value.is_some(),
    };
    let (response, moved) = slider(ui, track, &slid);
    response.on_hover_ui(|ui| {
        ui.label(row.tip);
    });
    if let Some(note) = row.note {
        refusal(ui, note);
    }
    ui.add_space(5.0);
    moved.map(Asked::Slid).or(asked)
}

/// Shows a number's row.
pub fn number(ui: &mut Ui, control: &'static Control, context: &Context<'_>, out: &mut Vec<Command>) {
    let Context { scenario, base, note, remembered, touch } = *context;
    let (shown, unit) = control.text(scenario);
    let asked = row(
        ui,
        &Row {
            key: control.key,
            label: control.label(scenario),
            tip: &control.tip(),
            differs: control.differs(scenario, base),
            shown: (&shown, unit),
            digits: control.range(scenario).0 >= 0.0 && control.words.is_none(),
            value: control.value(scenario),
            remembered,
            rail: Rail { range: control.range(scenario), scale: control.scale },
            notch: control.value(base),
            switch: control.has_off().then_some(if control.of.off() == Some("auto") { "given" } else { "on" }),
            note,
            touch,
        },
    );
    out.extend(asked.map(|asked| match asked {
        Asked::Reset => Command::Reset(control),
        Asked::Typed(text) => Command::Enter(control, text),
        Asked::Switch(on) => Command::Switch(control, on),
        Asked::Slid(value) => Command::Set(control, value),
    }));
}

/// Shows a choice's row.
pub fn choice(ui: &mut Ui, choice: &'static Choice, context: &Context<'_>, out: &mut Vec<Command>) {
    let width = ui.available_width();
    let (line_height, _) = if context.touch { TOUCH } else { HEIGHTS };
    let rows = if choice.of.is_words() { choice.options.len().div_ceil(IN_A_ROW) } else { 1 };
    // Rows of boxes have a gap between them.
    let gap = if choice.of.is_words() { 2.0 } else { 0.0 };
    let height = if context.touch { TARGET + gap } else { 28.0 } * rows as f32;
    let (rect, _) = ui.allocate_exact_size(vec2(width, line_height + height), Sense::hover());
    let line = Rect::from_min_size(rect.min, vec2(width, line_height));
    let differs = choice.differs(context.scenario, context.base);
    if heading(ui, line, choice.of.path, (choice.label, &choice.tip()), differs) {
        out.push(Command::ResetChoice(choice));
    }
    let place = Rect::from_min_size(line.left_bottom(), vec2(width, height));
    let picked = if choice.of.is_words() {
        let holds = |option| choice.of.holds(context.scenario, option);
        several(ui, place, choice.label, (choice.options, IN_A_ROW), holds)
    } else {
        segmented(ui, place, choice.label, choice.options, choice.of.chosen(context.scenario))
    };
    out.extend(picked.map(|option| Command::Pick(choice, option)));
    if let Some(note) = context.note {
        refusal(ui, note);
    }
    ui.add_space(6.0);
}

/// Says what was refused.
pub fn refusal(ui: &mut Ui, note: &str) {
    let theme = Theme::of(ui);
    ui.add(egui::Label::new(egui::RichText::new(note).size(12.0).color(theme.error)).wrap());
}
