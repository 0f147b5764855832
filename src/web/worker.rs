//! Studies, and the placing of contacts on several segments, in a Web Worker: both ends.
//!
//! The worker loads this same module and drives a [`StudyWorker`]; the page's end is a [`Helper`] that hands requests to
//! the page (`web/studies.js`) and keeps what comes back until the next frame.

use super::with_hooks;
use crate::app::helper::Helper;
use centrode_core::study::remote::Remote;
use std::cell::RefCell;
use wasm_bindgen::prelude::*;

/// The worker's end.
#[wasm_bindgen]
pub struct StudyWorker(Remote);

#[wasm_bindgen]
impl StudyWorker {
    /// Takes a request (JSON).
    ///
    /// # Errors
    /// Throws a message when it is none.
    #[wasm_bindgen(constructor)]
    pub fn new(request: &str) -> Result<StudyWorker, JsValue> {
        Remote::new(request).map(Self).map_err(|error| JsValue::from_str(&error))
    }

    /// Makes one run; returns whether any are left.
    pub fn step(&mut self) -> bool {
        self.0.step()
    }

    /// What has grown since the last answer.
    ///
    /// # Errors
    /// Throws a message when it cannot be written.
    pub fn answer(&mut self) -> Result<Vec<u8>, JsValue> {
        self.0.answer().map_err(|error| JsValue::from_str(&error))
    }
}

thread_local! {
    static ANSWERS: RefCell<Vec<Vec<u8>>> = const { RefCell::new(Vec::new()) };
    static FAILURE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// An answer of the worker has come.
#[wasm_bindgen]
pub fn study_answered(answer: Vec<u8>) {
    ANSWERS.with_borrow_mut(|answers| answers.push(answer));
    super::repaint();
}

/// There is no worker, or no longer, and why: studies are made between frames from now on.
#[wasm_bindgen]
pub fn study_failed(reason: String) {
    FAILURE.set(Some(reason));
    super::repaint();
}

/// The page's end.
#[derive(Debug)]
pub struct Worker;

impl Helper for Worker {
    fn ask(&mut self, request: Option<&str>) {
        with_hooks(|hooks| hooks.study(request.map(ToOwned::to_owned)));
    }

    fn take(&mut self) -> Vec<Vec<u8>> {
        ANSWERS.take()
    }

    fn failure(&self) -> Option<String> {
        FAILURE.with_borrow(Clone::clone)
    }

    fn replace(&mut self) -> bool {
        let mut replaced = false;
        with_hooks(|hooks| replaced = hooks.replace_worker());
        ANSWERS.take();
        replaced
    }
}
