//! What shows where the keyboard is.

use egui::{Id, Rect, Stroke, StrokeKind, Ui};

use crate::app::theme::Theme;

/// How far the frame stands out from a widget, points.
const OUT: f32 = 2.5;
/// Width of its line, and of the seam within, which parts it from what is of the same colour, points.
const LINE: f32 = 2.0;
const SEAM: f32 = 1.5;

/// The widget whose frame stands around more than itself, and around what.
#[derive(Clone, Copy)]
struct Around(Id, Rect);

/// Says that the frame of a widget is to stand around a rectangle.
pub fn around(ui: &Ui, widget: Id, rect: Rect) {
    if ui.memory(|memory| memory.has_focus(widget)) {
        ui.data_mut(|data| data.insert_temp(Id::NULL, Around(widget, rect)));
    }
}

/// Frames the widget that has the keyboard, whichever it is. At the end of a pass: nothing of its layer is painted over it.
pub fn frame(ui: &Ui) {
    let has_keyboard = ui.input(|input| input.focused);
    let Some(widget) = ui.memory(egui::Memory::focused).filter(|_| has_keyboard) else { return };
    let Some(response) = ui.ctx().read_response(widget) else { return };
    let around = ui.data(|data| data.get_temp::<Around>(Id::NULL)).filter(|around| around.0 == widget);
    // What is scrolled half out of sight is framed where it can be seen.
    let rect = around.map_or(response.interact_rect, |around| around.1);
    if !rect.is_positive() {
        return;
    }
    let theme = Theme::of(ui);
    let rect = rect.expand(OUT).intersect(ui.ctx().content_rect());
    let painter = ui.ctx().layer_painter(response.layer_id);
    painter.rect_stroke(rect.shrink(LINE), 6.0, Stroke::new(SEAM, theme.panel), StrokeKind::Inside);
    painter.rect_stroke(rect, 7.0, Stroke::new(LINE, theme.accent), StrokeKind::Inside);
}
