//! Drives the built page in real browsers: Chromium over its DevTools protocol, Firefox and WebKit by WebDriver's commands. No Node, no
//! downloaded driver.

mod chromium;
mod driven;
mod hands;
pub mod host;
mod page;
mod picture;
mod wire;

pub use chromium::Renderer;
pub use driven::Engine;
pub use page::{Options, Page, WIDGETS, Widget};
pub use picture::{Area, Picture};
