//! Drives the built page in a real Chromium, over its DevTools protocol. No Node, no downloaded driver.

mod chromium;
pub mod host;
mod page;
mod picture;

pub use chromium::Renderer;
pub use page::{Options, Page, Widget};
pub use picture::{Area, Picture};
