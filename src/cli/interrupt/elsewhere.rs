//! Interrupts and modes of files where there is no Unix.

use std::fs::Permissions;

/// Calls `heard` at every interrupt, in a thread of its own.
pub fn on_interrupt(heard: impl Fn() + Send + 'static) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(heard)
}

/// What the system gives.
pub fn usual_permissions() -> Option<Permissions> {
    None
}
