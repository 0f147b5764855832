//! No number that the program computes has moved since its fingerprint was stored.
//!
//! Where one is meant to: `cargo xtask renew fingerprints`, and a line in the changelog that says why.

use centrode_core::fingerprints::{Fingerprints, fingerprints};

#[test]
fn everything_computed_has_the_stored_fingerprint() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/fingerprints.json");
    let ours = fingerprints().expect("presets are valid");
    if std::env::var_os("UPDATE_FINGERPRINTS").is_some() {
        let text = serde_json::to_string_pretty(&ours).expect("JSON");
        std::fs::write(path, text + "\n").expect("written");
    }
    let stored = std::fs::read_to_string(path).expect("the stored fingerprints");
    let stored: Fingerprints = serde_json::from_str(&stored).expect("JSON");
    assert_eq!(ours, stored);
}
