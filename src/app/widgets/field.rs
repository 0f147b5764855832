//! A field for a typed value: what is typed counts when it is left, Escape takes it back.

use egui::text::CCursorRange;
use egui::{Align, Align2, Id, Key, Layout, Margin, Rect, Stroke, StrokeKind, TextEdit, Ui, UiBuilder, vec2};

use crate::app::fonts;
use crate::app::mirror;
use crate::app::theme::Theme;
use crate::app::widgets::{focus, text};

/// What a field shows.
pub struct Field<'a> {
    /// Name for assistive technology.
    pub label: &'a str,
    /// Identity.
    pub key: &'a str,
    /// The value's text.
    pub shown: &'a str,
    /// Its unit, dimmed; empty for none.
    pub unit: &'a str,
    /// Whether a keyboard of digits will do: no sign, no words.
    pub digits: bool,
    /// Whether what was typed last was refused.
    pub refused: bool,
}

/// Shows a field; returns what was typed when it is left.
pub fn field(ui: &mut Ui, rect: Rect, field: &Field<'_>) -> Option<String> {
    let theme = Theme::of(ui);
    let id = Id::unique(("field", field.key));
    let draft = ui.data(|data| data.get_temp::<String>(id));
    let mut typed = draft.unwrap_or_else(|| field.shown.to_owned());

    focus::around(ui, id, rect);
    let hovered = ui.rect_contains_pointer(rect);
    let edge = if field.refused {
        theme.error
    } else if hovered {
        theme.faint.lerp_to_gamma(theme.dim, 0.4)
    } else {
        theme.raised
    };
    ui.painter().rect(rect, 6.0, theme.raised, Stroke::new(1.0, edge), StrokeKind::Inside);
    let unit_width = if field.unit.is_empty() {
        0.0
    } else {
        let right = rect.right_center() - vec2(8.0, 0.0);
        text::paint(ui, right, Align2::RIGHT_CENTER, field.unit, fonts::regular(12.0), theme.dim).width() + 4.0
    };

    let inside = Rect::from_min_max(rect.min, rect.max - vec2(unit_width + 8.0, 0.0));
    let mut child = ui.new_child(UiBuilder::new().max_rect(inside).layout(Layout::right_to_left(Align::Center)));
    // No least height: the text is to stand in the middle.
    child.spacing_mut().interact_size.y = 0.0;
    let output = TextEdit::singleline(&mut typed)
        .id(id)
        .frame(egui::Frame::NONE)
        .margin(Margin { left: 8, right: 0, top: 0, bottom: 0 })
        .desired_width(inside.width() - 8.0)
        .align(Align2::RIGHT_CENTER)
        .font(fonts::regular(13.0))
        .min_size(inside.size())
        .char_limit(200)
        .show(&mut child);
    let response = &output.response.response;
    ui.ctx().accesskit_node_builder(id, |node| node.set_label(field.label));
    if field.digits {
        mirror::mark_digits(ui, id);
    }

    if response.gained_focus() {
        let mut state = output.state.clone();
        state.cursor.set_char_range(Some(CCursorRange::select_all(&output.galley)));
        state.store(ui.ctx(), id);
    }
    let left = response.lost_focus() || (response.changed() && !response.has_focus());
    let taken_back = ui.input(|input| input.key_pressed(Key::Escape));
    if !left {
        if response.changed() {
            ui.data_mut(|data| data.insert_temp(id, typed));
        }
        return None;
    }
    ui.data_mut(|data| data.remove_temp::<String>(id));
    (!taken_back && typed != field.shown).then_some(typed)
}
