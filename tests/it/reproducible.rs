//! The same scenario gives the same bits. The browser tests compare these fingerprints with the page's.

use centrode_core::run::simulate;
use centrode_core::scenario::Scenario;
use centrode_core::scenario::preset::PRESETS;

#[test]
fn a_scenario_has_one_fingerprint() {
    for preset in PRESETS {
        let scenario = preset.scenario().expect(preset.name);
        let fingerprint = || simulate(&scenario).expect("valid").fingerprint();
        assert_eq!(fingerprint(), fingerprint(), "{}", preset.name);
    }
}

#[test]
fn a_seed_changes_the_fingerprint_only_where_there_is_noise() {
    let fingerprint = |seed, noise| {
        let mut scenario = Scenario { seed, ..Scenario::default() };
        scenario.tracker.position_noise = noise;
        simulate(&scenario).expect("valid").fingerprint()
    };
    assert_ne!(fingerprint(1, 1e-5), fingerprint(2, 1e-5));
    assert_eq!(fingerprint(1, 0.0), fingerprint(2, 0.0));
}
