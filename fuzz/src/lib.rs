//! What each target does with the bytes that it is given, and what must hold of it.
//!
//! `cargo xtask fuzz` runs them on what libFuzzer thinks of; the tests of the project run them on the files of `corpus/`.

mod bytes;
pub mod experiment;
pub mod logs;
pub mod messages;
mod relations;
pub mod texts;

use centrode_core::record::log::Format;

/// A target: its name, which is also that of its folder in `corpus/`, and what it does.
pub type Target = (&'static str, fn(&[u8]));

/// All of them.
pub const TARGETS: [Target; 12] = [
    ("scenario", texts::scenario),
    ("overrides", texts::overrides),
    ("link", texts::link),
    ("csv", |bytes| logs::read(Format::Csv, bytes)),
    ("tum", |bytes| logs::read(Format::Tum, bytes)),
    ("euroc", |bytes| logs::read(Format::Euroc, bytes)),
    ("ndi", |bytes| logs::read(Format::Ndi, bytes)),
    ("mcap", |bytes| logs::read(Format::Mcap, bytes)),
    ("several", logs::read_several),
    ("messages", messages::messages),
    ("run", experiment::run),
    ("chain", experiment::chain),
];

/// Runs a target on some bytes.
///
/// # Panics
/// When something does not hold that must, or there is no such target.
pub fn run(name: &str, bytes: &[u8]) {
    let (_, target) = TARGETS.iter().find(|(known, _)| *known == name).expect("a target of this name");
    target(bytes);
}
