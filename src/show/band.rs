//! The place of a contact as a band along the backbone: as wide and as opaque as it is probable.

use centrode_core::detect::calibration::marginal::{Estimate, Place};

/// More steps than this are not told apart.
const STEPS: usize = 72;
/// Steps less probable than this share of the likeliest are left out, unless the interval holds them.
const LEAST: f64 = 0.01;

/// One step along the band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Arc length of its middle, m.
    pub at: f64,
    /// Half its length, m.
    pub half: f64,
    /// How wide it is, 0..1: the root of its probability density against the largest, so that tails can be seen.
    pub strength: f32,
    /// How opaque it is, 0..1: within the interval of 95 % it is never faint.
    pub opacity: f32,
}

/// The band of an estimate, from the base on.
#[must_use]
pub fn steps(estimate: &Estimate) -> Vec<Step> {
    let most = most(&estimate.posterior);
    steps_of(&estimate.posterior, most, [estimate.place.low, estimate.place.high])
}

/// The largest of these densities.
pub fn most(posterior: &[[f64; 2]]) -> f64 {
    posterior.iter().map(|[_, density]| *density).fold(0.0, f64::max)
}

/// The band of places (m) with their densities, of which `most` is the largest on the whole backbone; the interval of 95 % lies between
/// `low` and `high` (m).
#[must_use]
pub fn steps_of(posterior: &[[f64; 2]], most: f64, [low, high]: [f64; 2]) -> Vec<Step> {
    let [Some(&[first, _]), Some(&[second, _])] = [posterior.first(), posterior.get(1)] else { return Vec::new() };
    let grid = second - first;
    let inside = |at: f64, half: f64| low <= at + half && at - half <= high;
    let shown: Vec<[f64; 2]> =
        posterior.iter().copied().filter(|&[at, density]| density > LEAST * most || inside(at, 0.5 * grid)).collect();
    let together = shown.len().div_ceil(STEPS).max(1);
    let step = |cells: &[[f64; 2]]| {
        let count = cells.len() as f64;
        let [at, density] = [0, 1].map(|i| cells.iter().map(|cell| cell[i]).sum::<f64>() / count);
        let half = 0.5 * grid * count;
        let strength = (density / most).sqrt() as f32;
        let opacity = if inside(at, half) { 0.45 + 0.4 * strength } else { 0.35 * strength };
        Step { at, half, strength, opacity }
    };
    shown.chunks(together).map(step).collect()
}

/// An estimate's interval in words: its ends as mm.
#[must_use]
pub fn interval(estimate: &Estimate) -> String {
    between(&estimate.place)
}

/// An interval in words.
#[must_use]
pub fn between(place: &Place) -> String {
    let [low, high] = [place.low, place.high].map(|end| end * 1e3);
    format!("{low:.1}–{high:.1} mm")
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::detect::calibration::STATES;

    /// A normal density on a grid of 0.1 mm.
    fn normal(mean: f64, deviation: f64) -> Estimate {
        let density = |at: f64| (-0.5 * ((at - mean) / deviation).powi(2)).exp() / (2.506_628_3 * deviation);
        let posterior = (1..300).map(|k| f64::from(k) * 1e-4).map(|at| [at, density(at)]).collect();
        let (low, high) = (mean - 1.96 * deviation, mean + 1.96 * deviation);
        let place = Place { mean, mode: mean, low, high };
        let calibration = [[0.0; STATES]; 2];
        Estimate { place, began: 0.0, kinds: Vec::new(), calibration, posterior, evidence: 10.0, ratio: 8.0 }
    }

    #[test]
    fn the_band_is_strongest_where_the_contact_likely_is_and_fades_beyond_the_interval() {
        for deviation in [0.0001, 0.001, 0.004] {
            let estimate = normal(0.015, deviation);
            let steps = steps(&estimate);
            assert!((3..=STEPS).contains(&steps.len()), "{} for {deviation}", steps.len());
            assert!(steps.windows(2).all(|two| (two[0].at + two[0].half - two[1].at + two[1].half).abs() < 1e-9));
            let strongest = steps.iter().max_by(|a, b| a.strength.total_cmp(&b.strength)).expect("steps");
            assert!((strongest.at - 0.015).abs() < 2.0 * strongest.half, "{strongest:?}");
            for step in &steps {
                let out = (step.at - 0.015).abs() > 1.96 * deviation + step.half;
                assert_eq!(out, step.opacity < 0.4, "{step:?} for {deviation}");
            }
        }
        assert_eq!(interval(&normal(0.015, 0.0001)), "14.8–15.2 mm");
    }
}
