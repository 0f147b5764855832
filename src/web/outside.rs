//! The address and files: what comes in waits here for the next frame, what goes out is handed to the page
//! (`web/address.js`, `web/files.js`).

use super::{repaint, with_hooks};
use crate::app::App;
use crate::app::fonts::{REGULAR, SEMIBOLD};
use crate::app::link::Effect;
use crate::render::Pixels;
use std::cell::RefCell;
use wasm_bindgen::prelude::*;

/// What has come in.
enum Arrival {
    /// A link.
    Link(String),
    /// A file, or why it could not be read.
    File(String, Result<Vec<u8>, String>),
    /// That a file could not be saved, and why.
    Unsaved(String, String),
    /// That progress could not be kept.
    Unkept,
}

thread_local! {
    static ARRIVALS: RefCell<Vec<Arrival>> = const { RefCell::new(Vec::new()) };
}

fn arrive(arrival: Arrival) {
    ARRIVALS.with_borrow_mut(|arrivals| arrivals.push(arrival));
    repaint();
}

/// The person went back, forward, or edited the address: its fragment, without `#`.
#[wasm_bindgen]
pub fn go(fragment: String) {
    arrive(Arrival::Link(fragment));
}

/// A file was chosen or dropped.
#[wasm_bindgen]
pub fn file_opened(name: String, bytes: Vec<u8>) {
    arrive(Arrival::File(name, Ok(bytes)));
}

/// A file was chosen or dropped, and could not be read.
#[wasm_bindgen]
pub fn file_failed(name: String, reason: String) {
    arrive(Arrival::File(name, Err(reason)));
}

/// A file could not be saved.
#[wasm_bindgen]
pub fn save_failed(name: String, reason: String) {
    arrive(Arrival::Unsaved(name, reason));
}

/// How far the person has come could not be kept.
#[wasm_bindgen]
pub fn progress_not_kept() {
    arrive(Arrival::Unkept);
}

/// Gives the interface what has come in.
pub fn take_in(app: &mut App) {
    for arrival in ARRIVALS.take() {
        match arrival {
            Arrival::Link(fragment) => app.go(&fragment),
            Arrival::File(name, bytes) => app.opened(&name, bytes),
            Arrival::Unsaved(name, reason) => app.not_saved(&name, &reason),
            Arrival::Unkept => app.progress_not_kept(),
        }
    }
}

/// Gives the page what goes out.
pub fn hand_out(effect: Effect) {
    with_hooks(|hooks| match effect {
        Effect::Address { fragment, step } => hooks.address(&fragment, step),
        Effect::Save { name, kind, bytes } => hooks.save(&name, kind, &bytes),
        Effect::Picture { name, svg, scale } => hooks.picture(&name, &svg, scale, REGULAR, SEMIBOLD),
        Effect::Pixels { name, pixels: Pixels { size: [width, height], rgba } } => {
            hooks.pixels(&name, width, height, &rgba);
        }
        Effect::Keep(progress) => hooks.keep(&progress),
        Effect::Open(page) => hooks.open(&page),
        Effect::Choose => hooks.choose(),
        Effect::Post(json) => hooks.post(&json),
        Effect::ChooseLog => hooks.choose_log(),
        Effect::Fetch(number) => hooks.fetch_log(number),
    });
}
