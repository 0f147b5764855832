//! Requests of a host page (`web/messages.js`): answered at once, for a frame that is out of sight gets no frames to paint.

use super::outside::hand_out;
use super::{ASIDE, RUNNER, Shell, repaint};
use crate::app::App;
use wasm_bindgen::prelude::*;

/// Takes a request, JSON; the answer and what follows from it go out by `Hooks::post`.
#[wasm_bindgen]
pub fn request(json: &str) {
    with_app(|app| app.request(json));
}

/// Tells the host page that it can ask from now on.
#[wasm_bindgen]
pub fn host_ready() {
    with_app(App::ready);
}

/// Does something with the interface, unless it is gone; hands out what comes of it.
fn with_app(act: impl FnOnce(&mut App)) {
    let does = |app: &mut App| {
        act(app);
        app.take_effects()
    };
    let runner = RUNNER.with_borrow(Clone::clone);
    let effects = match runner.as_ref().and_then(eframe::WebRunner::app_mut::<Shell>) {
        Some(mut shell) => shell.app.as_mut().map(does),
        None => ASIDE.with_borrow_mut(|aside| aside.as_mut().map(|(app, _)| does(app))),
    };
    effects.into_iter().flatten().for_each(hand_out);
    repaint();
}
