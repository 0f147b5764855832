//! What fingers need: targets that are large enough, and a word of who a drag is for.

use egui::{Context, Id, Pos2, Rect, Ui, Vec2, vec2};

use crate::app::controls::row::TARGET;
use crate::app::theme::MOUSE;

/// Lets everything from now on be large enough for a finger, menus and windows included, or as large as a mouse needs it.
pub fn welcome(ui: &mut Ui, fingers: bool) {
    let size = if fingers { Vec2::splat(TARGET) } else { MOUSE };
    ui.spacing_mut().interact_size = size;
    if ui.ctx().style_of(ui.theme()).spacing.interact_size != size {
        ui.ctx().all_styles_mut(|style| style.spacing.interact_size = size);
    }
}

/// Whether fingers work what is shown here.
#[must_use]
pub fn is_welcome(ui: &Ui) -> bool {
    ui.spacing().interact_size.y >= TARGET
}

/// A height or width, or what a finger needs where there are fingers.
#[must_use]
pub fn at_least(ui: &Ui, size: f32) -> f32 {
    if is_welcome(ui) { size.max(TARGET) } else { size }
}

/// A place, and around it what a finger needs where there are fingers.
#[must_use]
pub fn around(ui: &Ui, rect: Rect) -> Rect {
    Rect::from_center_size(rect.center(), vec2(at_least(ui, rect.width()), at_least(ui, rect.height())))
}

/// Whether what the pointer does in this frame is a finger's doing.
#[must_use]
pub fn is_down(ui: &Ui) -> bool {
    let touch = |event: &egui::Event| matches!(event, egui::Event::Touch { .. });
    ui.input(|input| input.any_touches() || input.events.iter().any(touch))
}

fn id() -> Id {
    Id::unique("finger")
}

/// Says that a widget leaves the drag of this frame to whatever scrolls around it.
pub fn pass(ui: &Ui) {
    let frame = ui.ctx().cumulative_frame_nr();
    ui.data_mut(|data| data.insert_temp(id(), frame));
}

/// Whether a widget has done so.
#[must_use]
pub fn is_passed(ui: &Ui) -> bool {
    let frame = ui.ctx().cumulative_frame_nr();
    ui.data(|data| data.get_temp::<u64>(id())) == Some(frame)
}

/// Where a drag is for what stands there, in the last pass.
#[derive(Debug, Clone, Default)]
struct Claims {
    pass: u64,
    rects: Vec<Rect>,
}

/// Says that a finger that comes down in `rect` is for what stands there, whichever way it goes: it turns, moves or scrolls that.
pub fn claim(ui: &Ui, rect: Rect) {
    let (pass, rect) = (ui.ctx().cumulative_pass_nr(), rect.intersect(ui.clip_rect()));
    ui.data_mut(|data| {
        let claims = data.get_temp_mut_or_default::<Claims>(id());
        if claims.pass != pass {
            *claims = Claims { pass, rects: Vec::new() };
        }
        claims.rects.push(rect);
    });
}

/// Whether a finger that comes down here is for what stands there. Elsewhere a page around this one may scroll.
#[must_use]
pub fn is_claimed(ctx: &Context, at: Pos2) -> bool {
    let page = egui::LayerId::background();
    ctx.layer_id_at(at).is_some_and(|layer| layer != page)
        || ctx.data(|data| {
            let claims = data.get_temp::<Claims>(id()).unwrap_or_default();
            claims.rects.iter().any(|rect| rect.contains(at))
        })
}
