//! Seeds of repeats, derived from a scenario's own.

use crate::scenario::plan::MAX_SEED;

/// Seed of repeat `k` of a scenario with `seed`: the scenario's own for the first, well-mixed ones for the others
/// (the finaliser of SplitMix64). Depends on nothing but the two, so that repeats may be run in any order.
#[must_use]
pub fn repeat_seed(seed: u64, k: u64) -> u64 {
    if k == 0 {
        return seed;
    }
    let mut x = seed.wrapping_add(k.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (x ^ (x >> 31)) & MAX_SEED
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn repeats_of_neighbouring_seeds_share_no_seed() {
        let seeds: BTreeSet<u64> =
            (0..100).flat_map(|seed| (0..1000).map(move |k| repeat_seed(seed, k))).filter(|&seed| seed > 99).collect();
        assert_eq!(seeds.len(), 100 * 999);
        assert!(seeds.iter().all(|&seed| seed <= MAX_SEED));
    }

    #[test]
    fn the_first_repeat_is_the_scenario_itself() {
        assert_eq!(repeat_seed(7, 0), 7);
    }
}
