//! What is written from the table of keys is what stands in the repository: `cargo xtask renew keys` writes it anew.

use centrode_core::scenario::keys::{KEYS, document};
use centrode_core::scenario::{Plan, Scenario};
use std::path::Path;

/// Compares a file of the repository with what it should say, or writes it when asked to.
fn current(path: &str, text: &str) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        std::fs::write(&file, text).expect(path);
    }
    let stored = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(stored == text, "{path} is out of date: cargo xtask renew keys");
}

#[test]
fn the_commented_default_is_written_from_the_table() {
    current("core/assets/scenario.toml", &document::commented_default());
}

#[test]
fn the_reference_is_written_from_the_table() {
    current("docs/KEYS.md", &document::reference());
}

#[test]
fn both_ends_of_every_slider_are_possible() {
    let base = Scenario::default();
    for key in KEYS {
        let (low, high) = key.usual(&base);
        assert!(low < high, "{}", key.path);
        for value in
            [low, high].into_iter().filter(|_| !matches!(key.usual, centrode_core::scenario::keys::Usual::None))
        {
            let mut scenario = base.clone();
            key.set_number(&mut scenario, value);
            key.set_part(&mut scenario, 0, value);
            assert!(Plan::new(&scenario).is_ok(), "{} = {value}", key.path);
        }
    }
}
