//! Texts that people write: what is read can be written, and reads the same again.

use centrode_core::scenario::chain::{ChainDraft, ChainScenario};
use centrode_core::scenario::link::Link;
use centrode_core::scenario::preset::CHAINS;
use centrode_core::scenario::text::Draft;
use centrode_core::scenario::{Override, Plan, Scenario};
use std::sync::LazyLock;

/// A scenario's file, of one segment or of several.
pub fn scenario(bytes: &[u8]) {
    if ChainScenario::is_of(bytes) {
        if let Ok(draft) = ChainDraft::from_bytes(bytes) {
            written_again(&draft);
        }
        return;
    }
    let Ok(scenario) = Draft::from_bytes(bytes).and_then(Draft::finish) else { return };
    assert_eq!(Scenario::from_toml(&scenario.to_toml()).as_ref(), Ok(&scenario));
    // What a table allows may still be impossible together, which is told.
    let _ = Plan::new(&scenario);
}

/// What values of keys change.
static THREE: LazyLock<ChainDraft> = LazyLock::new(|| ChainDraft::of(&CHAINS[0]));

/// Values of keys, a line each, as `--set` takes them: for one segment and for several.
pub fn overrides(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let mut scenario = Scenario::default();
    for line in text.lines() {
        let Ok(read) = line.parse::<Override>() else { continue };
        assert_eq!(String::from(read.clone()).parse::<Override>().as_ref(), Ok(&read));
        read.apply(&mut scenario);
    }
    let _ = Plan::new(&scenario);
    let chain = text.lines().take(8).fold(None, |draft: Option<ChainDraft>, line| {
        let changed = draft.as_ref().unwrap_or(&THREE).overridden([line]);
        changed.ok().or(draft)
    });
    if let Some(draft) = chain {
        written_again(&draft);
    }
}

/// The fragment of an address.
pub fn link(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let (link, _) = Link::read(text);
    // Longer than a link may be: that is told.
    let Ok(fragment) = link.fragment() else { return };
    let (again, broken) = Link::read(&fragment);
    assert!(broken.is_empty(), "{fragment}: {broken:?}");
    assert_eq!(again, link, "{fragment}");
}

fn written_again(draft: &ChainDraft) {
    let again = ChainDraft::from_bytes(draft.to_toml().as_bytes()).expect("what was written can be read");
    assert_eq!(again.scenario().ok(), draft.scenario().ok());
}
