//! Requests of a host page (`web/messages.js`): answered at once, for a frame that is out of sight gets no frames to paint.

use super::outside::hand_out;
use super::{RUNNER, Shell, repaint};
use wasm_bindgen::prelude::*;

/// Takes a request, JSON; the answer and what follows from it go out by `Hooks::post`.
#[wasm_bindgen]
pub fn request(json: &str) {
    with_shell(|shell| shell.app.request(json));
}

/// Tells the host page that it can ask from now on.
#[wasm_bindgen]
pub fn host_ready() {
    with_shell(|shell| shell.app.ready());
}

/// Does something with the interface, unless it is gone; hands out what comes of it.
fn with_shell(act: impl FnOnce(&mut Shell)) {
    let runner = RUNNER.with_borrow(Clone::clone);
    let effects = runner.as_ref().and_then(eframe::WebRunner::app_mut::<Shell>).map(|mut shell| {
        act(&mut shell);
        shell.app.take_effects()
    });
    effects.into_iter().flatten().for_each(hand_out);
    repaint();
}
