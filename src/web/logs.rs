//! Logs: files that the page keeps by number, and the worker that reads them (`web/logs.js`, `web/log-worker.js`).

use super::{repaint, with_hooks};
use crate::app::App;
use crate::app::helper::Helper;
use crate::app::log::file::{File, is_log};
use centrode_core::record::log::remote::Remote;
use std::cell::RefCell;
use wasm_bindgen::prelude::*;

/// The worker's end.
#[wasm_bindgen]
pub struct LogWorker(Remote);

#[wasm_bindgen]
impl LogWorker {
    /// Takes a request (JSON) and the file.
    ///
    /// # Errors
    /// Throws a message when it is none.
    #[wasm_bindgen(constructor)]
    pub fn new(request: &str, bytes: Vec<u8>) -> Result<LogWorker, JsValue> {
        Remote::new(request, bytes).map(Self).map_err(|error| JsValue::from_str(&error))
    }

    /// Reads some rows; returns whether any are left.
    pub fn step(&mut self) -> bool {
        self.0.step()
    }

    /// How far it has come, or what came of it.
    ///
    /// # Errors
    /// Throws a message when it cannot be written.
    pub fn answer(&mut self) -> Result<Vec<u8>, JsValue> {
        self.0.answer().map_err(|error| JsValue::from_str(&error))
    }
}

/// What has come in.
enum Arrival {
    Chosen(File),
    Fetched(u32, Result<Vec<u8>, String>),
    Nothing,
}

thread_local! {
    static ARRIVALS: RefCell<Vec<Arrival>> = const { RefCell::new(Vec::new()) };
    static ANSWERS: RefCell<Vec<Vec<u8>>> = const { RefCell::new(Vec::new()) };
    static FAILURE: RefCell<Option<String>> = const { RefCell::new(None) };
}

fn arrive(arrival: Arrival) {
    ARRIVALS.with_borrow_mut(|arrivals| arrivals.push(arrival));
    repaint();
}

/// Whether a file is a log rather than a scenario, by its name and its first bytes.
#[wasm_bindgen]
#[must_use]
pub fn looks_like_log(name: &str, head: &[u8]) -> bool {
    is_log(name, head)
}

/// A log was chosen or dropped: its name, its size (bytes), its first bytes, and the number under which the page keeps it.
#[wasm_bindgen]
pub fn log_chosen(name: &str, size: f64, head: &[u8], number: u32) {
    arrive(Arrival::Chosen(File::there(name, size as u64, head, number)));
}

/// The person left the dialog without a log.
#[wasm_bindgen]
pub fn log_not_chosen() {
    arrive(Arrival::Nothing);
}

/// The bytes of a log that were asked for.
#[wasm_bindgen]
pub fn log_fetched(number: u32, bytes: Vec<u8>) {
    arrive(Arrival::Fetched(number, Ok(bytes)));
}

/// The bytes of a log that were asked for cannot be had, or the worker could not read them.
#[wasm_bindgen]
pub fn log_unreadable(number: u32, reason: String) {
    arrive(Arrival::Fetched(number, Err(reason)));
}

/// An answer of the worker has come.
#[wasm_bindgen]
pub fn log_answered(answer: Vec<u8>) {
    ANSWERS.with_borrow_mut(|answers| answers.push(answer));
    repaint();
}

/// There is no worker, and why: logs are read between frames from now on.
#[wasm_bindgen]
pub fn log_worker_failed(reason: String) {
    FAILURE.set(Some(reason));
    repaint();
}

/// Gives the interface what has come in.
pub fn take_in(app: &mut App) {
    for arrival in ARRIVALS.take() {
        match arrival {
            Arrival::Chosen(file) => app.log_chosen(file),
            Arrival::Nothing => app.none_chosen(),
            Arrival::Fetched(number, bytes) => app.log_fetched(number, bytes),
        }
    }
}

/// The page's end.
#[derive(Debug)]
pub struct Clerk;

impl Helper for Clerk {
    fn ask(&mut self, request: Option<&str>) {
        // What was asked before is answered no more.
        ANSWERS.take();
        with_hooks(|hooks| hooks.read_log(request.map(ToOwned::to_owned)));
    }

    fn take(&mut self) -> Vec<Vec<u8>> {
        ANSWERS.take()
    }

    fn failure(&self) -> Option<String> {
        FAILURE.with_borrow(Clone::clone)
    }
}
