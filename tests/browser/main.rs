//! The built page in a real Chromium, on WebGL 2, on WebGPU and on neither. Run by `cargo xtask test browser`.
//!
//! To add a test: open the page, do what a person does, wait for what the page then says.
//!
//! ```ignore
//! #[test]
//! fn no_disk_means_no_detection() {
//!     let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
//!     page.type_number("Contact disk", "0");                      // or page.drag("Slider", "Contact disk", 0.5, 0.0)
//!     page.wait("no detection", |page| page.data("detectionTime").is_none().then_some(()));
//!     assert!(page.problems().is_empty(), "{:?}", page.problems());
//! }
//! ```
//!
//! `page.data(key)` and `page.number(key)` read the text mirror, which `App::report` feeds; `page.widgets()` lists every widget
//! with role, name, value and bounds (`?test` only); `page.picture()` gives pixels; `page.eval(script)` runs JavaScript, in which
//! `centrode` holds the wasm module's exports. Software rendering is slow: wait for a state, never for time alone.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "tests read files, run programs and wait for them"
)]

mod axe;
mod carried;
mod core;
mod detectors;
mod elements;
mod embed;
mod engines;
mod failures;
#[allow(dead_code, unused_imports, reason = "a harness for tests to come, and for the pictures")]
mod harness;
mod lesson;
mod links;
mod logs;
mod lost;
mod memory;
mod paper;
mod phone;
mod saving;
mod segments;
mod start;
mod storm;
mod theory;
mod tuning;
