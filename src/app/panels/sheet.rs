//! The sheet of a small screen: drawn out by its handle or its head, by keys, and past the ends of what scrolls in it.

use egui::accesskit::{Action, ActionData};
use egui::scroll_area::{DragScroll, ScrollSource};
use egui::{
    Align2, Context, CursorIcon, EventFilter, Id, Key, Rect, Response, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2,
};

use crate::app::command::Command;
use crate::app::fonts;
use crate::app::layout::sheet::{Handle, Sheet, Stop};
use crate::app::layout::tab_strip;
use crate::app::state::State;
use crate::app::theme::{ROUND, Theme};
use crate::app::widgets::{finger, focus, text};

/// How long it takes to come to rest, s.
const REST: f32 = 0.16;
/// How far ahead of a finger that lets go the sheet comes to rest, s of the finger's way.
const AHEAD: f32 = 0.15;

/// A sheet in a hand.
#[derive(Debug, Clone, Copy, Default)]
struct Drag {
    /// As it was last shown: how long it is at each stop, where it stands, and whether it comes from the right.
    lengths: [f32; 3],
    at: f32,
    beside: bool,
    /// How far it has been drawn out since, points; none while it is left alone.
    pulled: Option<f32>,
}

fn id() -> Id {
    Id::unique("sheet")
}

fn drag(ctx: &Context) -> Drag {
    ctx.data(|data| data.get_temp(id())).unwrap_or_default()
}

/// Draws the sheet out by so many points.
fn pull(ui: &Ui, points: f32) {
    // A pass that is done again has had its pull already, and on the way to where a finger comes down nothing is pulled.
    if ui.ctx().current_pass_index() == 0 && !ui.input(|input| input.pointer.any_pressed()) {
        let drag = drag(ui.ctx());
        let pulled = Some(drag.pulled.unwrap_or_default() + points);
        ui.data_mut(|data| data.insert_temp(id(), Drag { pulled, ..drag }));
    }
}

/// How the sheet stands now. On a stage it stands half way unless it holds controls, and beside a lesson always; `still` leaves out
/// the way from one stop to another.
pub fn place(ui: &Ui, state: &State, still: bool, out: &mut Vec<Command>) -> Sheet {
    let ctx = ui.ctx();
    let fixed = state.lesson.is_some() || !state.sheet && !state.stage.is_run();
    let rests = if fixed { Stop::Half } else { state.stop }.at();
    let drag = drag(ctx);
    let Some(pulled) = drag.pulled.filter(|_| !fixed) else {
        let at = ctx.animate_value_with_time(id(), rests, if still || fixed { 0.0 } else { REST });
        return Sheet { controls: state.sheet, at };
    };
    let length = Handle::length(drag.lengths, drag.at) + pulled;
    let at = Handle::place(drag.lengths, length);
    ctx.animate_value_with_time(id(), at, 0.0);
    let (down, velocity) = ui.input(|input| (input.pointer.any_down(), input.pointer.velocity()));
    let speed = if drag.beside { -velocity.x } else { -velocity.y };
    if !down {
        out.push(Command::DrawSheet(Stop::nearest(Handle::place(drag.lengths, length + AHEAD * speed))));
    }
    ctx.data_mut(|data| data.insert_temp(id(), Drag { at, pulled: down.then_some(0.0), ..drag }));
    Sheet { controls: state.sheet, at }
}

/// Paints the sheet under what stands in it. By its head it is drawn out.
pub fn sheet(ui: &Ui, handle: Option<&Handle>, Sheet { controls, at }: Sheet) {
    let theme = Theme::of(ui);
    let Some(handle) = handle else {
        ui.data_mut(|data| data.remove::<Drag>(id()));
        return;
    };
    let shown = Drag { lengths: handle.lengths, at, beside: handle.beside, pulled: drag(ui.ctx()).pulled };
    ui.data_mut(|data| data.insert_temp(id(), shown));
    ui.painter().rect_filled(handle.sheet, f32::from(ROUND), theme.panel);
    let (head, below) = handle.split();
    if controls && !handle.beside {
        let at = head.left_center() + vec2(16.0, 4.0);
        text::paint(ui, at, Align2::LEFT_CENTER, "Controls", fonts::strong(13.0), theme.ink);
    }
    // Tabs, too, are taps on the head.
    let strip = if controls { head } else { head.union(tab_strip(below).0) };
    finger::claim(ui, strip);
    let response = ui.interact(strip, ui.scope_id().with("head"), Sense::drag());
    drawn(ui, &response, handle);
}

fn drawn(ui: &Ui, response: &Response, handle: &Handle) {
    if response.dragged() {
        let moved = response.drag_delta();
        pull(ui, if handle.beside { -moved.x } else { -moved.y });
    }
}

/// Shows the handle, over all that it reaches over.
pub fn handle(ui: &Ui, handle: &Handle, stop: Stop, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    finger::claim(ui, handle.grip);
    let response = ui.interact(handle.grip, ui.scope_id().with("handle"), Sense::click_and_drag());
    let response = response.on_hover_and_drag_cursor(if handle.beside {
        CursorIcon::ResizeHorizontal
    } else {
        CursorIcon::ResizeVertical
    });
    describe(ui, &response, stop);
    drawn(ui, &response, handle);
    let asked = if response.clicked() { Some(stop.next()) } else { by_key(ui, &response, stop) };
    out.extend(asked.filter(|asked| *asked != stop).map(Command::DrawSheet));
    let (head, _) = handle.split();
    let (center, size) = match handle.beside {
        true => (head.center(), vec2(4.0, 40.0)),
        false => (pos2(head.center().x, head.top() + 12.0), vec2(40.0, 4.0)),
    };
    let bar = Rect::from_center_size(center, size);
    let held = response.dragged() || response.hovered();
    ui.painter().rect_filled(bar, 2.0, if held { theme.accent } else { theme.edge });
    focus::around(ui, response.id, bar.expand(5.0));
}

fn describe(ui: &Ui, response: &Response, stop: Stop) {
    response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), f64::from(stop.at()), "Height of the sheet"));
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_min_numeric_value(0.0);
        node.set_max_numeric_value(f64::from(Stop::Full.at()));
        node.set_numeric_value_step(1.0);
        node.set_value(stop.name());
        for action in [Action::SetValue, Action::Increment, Action::Decrement] {
            node.add_action(action);
        }
    });
}

/// The stop that keys or a screen reader ask for.
fn by_key(ui: &Ui, response: &Response, stop: Stop) -> Option<Stop> {
    let mut at = stop.at();
    if response.has_focus() {
        let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..Default::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        ui.input(|input| {
            let presses = |keys: [Key; 3]| keys.map(|key| input.num_presses(key) as f32).iter().sum::<f32>();
            at += presses([Key::ArrowUp, Key::ArrowRight, Key::PageUp]);
            at -= presses([Key::ArrowDown, Key::ArrowLeft, Key::PageDown]);
            at = if input.key_pressed(Key::Home) { 0.0 } else { at };
            at = if input.key_pressed(Key::End) { Stop::Full.at() } else { at };
        });
    }
    ui.input(|input| {
        at += input.num_accesskit_action_requests(response.id, Action::Increment) as f32;
        at -= input.num_accesskit_action_requests(response.id, Action::Decrement) as f32;
        for request in input.accesskit_action_requests(response.id, Action::SetValue) {
            if let Some(ActionData::NumericValue(value)) = request.data {
                at = value as f32;
            }
        }
    });
    (at != stop.at() && at.is_finite()).then(|| Stop::nearest(at))
}

/// Shows what scrolls. On a sheet that comes from below, a finger that goes on past an end takes the sheet along.
pub fn scrolled<R>(ui: &mut Ui, content: impl FnOnce(&mut Ui) -> R) -> R {
    let mut area = ScrollArea::vertical().auto_shrink(false);
    if finger::is_welcome(ui) {
        // Past its ends the sheet moves.
        ui.spacing_mut().scroll.kinetic.rubber_band = false;
        // Otherwise the very first finger is not known for one.
        area = area.scroll_source(ScrollSource { drag: DragScroll::Always, ..ScrollSource::ALL });
    }
    let output = area.show(ui, content);
    let dragged = ui.ctx().is_being_dragged(output.id.with("area")) || finger::is_passed(ui);
    let down = ui.input(|input| input.pointer.delta().y);
    let most = output.content_size.y - output.inner_rect.height();
    if most > 0.5 {
        finger::claim(ui, output.inner_rect);
    }
    let ended =
        if down > 0.0 { output.state.clamped_offset().y <= 0.0 } else { output.state.clamped_offset().y >= most - 0.5 };
    if dragged && ended {
        hand_over(ui, down);
    }
    output.inner
}

/// Shows what does not scroll: whatever a finger is not wanted for in it takes the sheet along.
pub fn still<R>(ui: &mut Ui, content: impl FnOnce(&mut Ui) -> R) -> R {
    let shown = content(ui);
    if finger::is_passed(ui) {
        hand_over(ui, ui.input(|input| input.pointer.delta().y));
    }
    shown
}

fn hand_over(ui: &Ui, down: f32) {
    let drag = drag(ui.ctx());
    if ui.input(|input| input.any_touches()) && !drag.beside && drag.lengths != [0.0; 3] && down != 0.0 {
        pull(ui, -down);
    }
}
