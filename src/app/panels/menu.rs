//! A menu: whoever opens it with a key goes on with keys in it, and has the keyboard back at its button when it closes.

use egui::{Context, FocusDirection, Id, PointerButton, Popup, Response, Ui};

/// How far the keyboard has come into a menu that a key opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Keys {
    /// It goes in once the menu has been measured, in this pass or a later one.
    Enter(u64),
    /// It is in.
    In,
}

fn keys(menu: Id) -> Id {
    menu.with("keys")
}

/// Lets the keyboard go into a menu as soon as it is shown; its button has to have the focus.
pub fn enter(ctx: &Context, menu: Id) {
    let pass = ctx.cumulative_pass_nr();
    ctx.data_mut(|data| data.insert_temp(keys(menu), Keys::Enter(pass + 1)));
}

/// Shows the menu of a button while it is open.
pub fn show(ui: &Ui, button: &Response, name: &str, width: f32, content: impl FnOnce(&mut Ui)) {
    let ctx = ui.ctx();
    let id = Popup::default_response_id(button);
    let was_open = Popup::is_id_open(ctx, id);
    if button.clicked() && !button.clicked_by(PointerButton::Primary) {
        button.request_focus();
        enter(ctx, id);
    }
    let state = ctx.data(|data| data.get_temp::<Keys>(keys(id)));
    // Before its first frame a menu has no entries.
    let enters = matches!(state, Some(Keys::Enter(from)) if from <= ctx.cumulative_pass_nr());
    if was_open && enters && button.has_focus() {
        ctx.memory_mut(|memory| memory.move_focus(FocusDirection::Down));
        ctx.data_mut(|data| data.insert_temp(keys(id), Keys::In));
    }
    Popup::menu(button).accessible_name(name).width(width).show(content);
    let is_open = Popup::is_id_open(ctx, id);
    if is_open && matches!(state, Some(Keys::Enter(_))) {
        ctx.request_repaint();
    }
    if !is_open && was_open && state.is_some() {
        ctx.data_mut(|data| data.remove::<Keys>(keys(id)));
        button.request_focus();
    }
}
