//! Seeded normal deviates, the same bits on every machine.

use libm::{log, sqrt};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What a stream of noise belongs to: silencing one leaves the others' draws alone.
#[derive(Debug, Clone, Copy)]
#[repr(u64)]
pub enum Source {
    /// The tracker's readings.
    Tracker = 1,
    /// The load cells' readings.
    LoadCells = 2,
    /// The load cells' relative errors.
    CellErrors = 3,
    /// The errors of calibration.
    Calibration = 4,
    /// The tracker's drift.
    Drift = 5,
}

/// A stream of standard normal deviates.
#[derive(Debug, Clone)]
pub struct Normal {
    generator: ChaCha8Rng,
    spare: Option<f64>,
}

impl Normal {
    /// The stream of one source under one seed.
    #[must_use]
    pub fn new(seed: u64, source: Source) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(source as u64);
        Self { generator, spare: None }
    }

    /// The next deviate (Marsaglia's polar method).
    pub fn draw(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        loop {
            let (x, y) = (self.symmetric(), self.symmetric());
            let square = x * x + y * y;
            if square > 0.0 && square < 1.0 {
                let scale = sqrt(-2.0 * log(square) / square);
                self.spare = Some(y * scale);
                return x * scale;
            }
        }
    }

    /// The next number of an even distribution in [−1, 1), 53 bits.
    pub fn symmetric(&mut self) -> f64 {
        (self.generator.next_u64() >> 11) as f64 * (1.0 / (1u64 << 52) as f64) - 1.0
    }
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "what a test compares with need not have the same bits everywhere")]
mod tests {
    use super::*;

    #[test]
    fn deviates_have_the_moments_of_a_normal_law() {
        let mut normal = Normal::new(7, Source::Tracker);
        let draws: Vec<f64> = (0..200_000).map(|_| normal.draw()).collect();
        let moment = |power: i32| draws.iter().map(|x| x.powi(power)).sum::<f64>() / draws.len() as f64;
        // Standard errors: 1, √2, √15 and √96 over √200000.
        for (power, expected, error) in [(1, 0.0, 0.0023), (2, 1.0, 0.0032), (3, 0.0, 0.0087), (4, 3.0, 0.022)] {
            assert!((moment(power) - expected).abs() < 4.0 * error, "moment {power}: {}", moment(power));
        }
    }

    #[test]
    fn sources_and_seeds_are_separate_streams() {
        let first = |seed, source| Normal::new(seed, source).draw();
        assert_eq!(first(1, Source::Tracker), first(1, Source::Tracker));
        assert_ne!(first(1, Source::Tracker), first(2, Source::Tracker));
        assert_ne!(first(1, Source::Tracker), first(1, Source::LoadCells));
    }
}
