//! The pieces of a study, numbered, and what a range of them has.

use super::Study;
use super::tally::Tally;
use crate::study::shared::KEPT;
use std::ops::Range;

/// Repeats that a batch makes in its turn where there are many batches.
const TURN: u64 = 64;

impl Study {
    /// Which batch and which repeat the `piece`-th piece of work is, of [`Progress::of`](crate::study::Progress::of): the batches take
    /// turns, so that whoever stops early has equally many repeats of each.
    #[must_use]
    pub fn piece(&self, piece: u64) -> (usize, u64) {
        let (round, within, size) = self.place(piece);
        ((within / size % self.batches.len() as u64) as usize, round * self.turn() + within % size)
    }

    /// How many repeats of each batch a range of pieces has.
    #[must_use]
    pub fn repeats_in(&self, pieces: &Range<u64>) -> Vec<u64> {
        let before = |piece: u64, batch: usize| {
            let (round, within, size) = self.place(piece);
            let own = within.saturating_sub(batch as u64 * size).min(size);
            (round * self.turn() + own).min(self.spec.repeats as u64)
        };
        let repeats = |batch: usize| before(pieces.end, batch).saturating_sub(before(pieces.start, batch));
        (0..self.batches.len()).map(repeats).collect()
    }

    /// Counts in what a range of pieces came to elsewhere, each batch with its tally. Returns whether these can be its runs, and all of
    /// them; where they cannot, what is counted in is of no use.
    pub fn join(&mut self, pieces: &Range<u64>, tallies: &[(u32, Tally)]) -> bool {
        let mut left = self.repeats_in(pieces);
        for (batch, tally) in tallies {
            let Some(runs) = left.get_mut(*batch as usize) else { return false };
            let runs = std::mem::take(runs);
            if runs == 0 || !self.batches[*batch as usize].join(tally, runs) {
                return false;
            }
        }
        left.iter().all(|&runs| runs == 0)
    }

    /// Where not all batches keep what their repeats share, each takes several in its turn.
    fn turn(&self) -> u64 {
        if self.batches.len() > KEPT { TURN } else { 1 }
    }

    /// The round of a piece, its place in it, and how many repeats each batch makes in it.
    fn place(&self, piece: u64) -> (u64, u64, u64) {
        let (batches, turn) = (self.batches.len() as u64, self.turn());
        let round = piece / (turn * batches);
        let size = turn.min((self.spec.repeats as u64).saturating_sub(round * turn)).max(1);
        (round, piece - round * turn * batches, size)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::spec;
    use super::super::{MAX_REPEATS, Spec};
    use super::*;
    use crate::study::Job;

    #[test]
    fn pieces_are_every_repeat_of_every_batch_once_and_many_batches_take_long_turns() {
        for (cells, repeats) in [(2, 3), (20, 150), (20, 64), (20, 1)] {
            let study = Study::new(Spec { repeats, ..spec(cells) }).expect("possible");
            let of = study.progress().of;
            let pieces: Vec<(usize, u64)> = (0..of).map(|piece| study.piece(piece)).collect();
            let turns = 1 + pieces.windows(2).filter(|pair| pair[0].0 != pair[1].0).count();
            assert!(
                study.batches().len() <= KEPT || turns <= of as usize / repeats.min(22),
                "{cells} {repeats}: {turns}"
            );
            let mut all = pieces;
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len() as u64, of);
            assert!(all.iter().all(|&(batch, repeat)| batch < study.batches().len() && repeat < repeats as u64));
        }
    }

    #[test]
    fn repeats_in_a_range_are_those_of_its_pieces() {
        for (cells, repeats) in [(1, 5), (2, 3), (20, 150), (20, 64)] {
            let study = Study::new(Spec { repeats, ..spec(cells) }).expect("possible");
            let of = study.progress().of;
            for range in [0..of, 0..0, 1..2, of / 3..of / 2, of - 1..of, of / 7 + 1..of - 2] {
                let mut counted = vec![0; study.batches().len()];
                range.clone().for_each(|piece| counted[study.piece(piece).0] += 1);
                assert_eq!(study.repeats_in(&range), counted, "{cells} {repeats} {range:?}");
            }
        }
        // As many as there may be are no more work.
        let most = Study::new(Spec { repeats: MAX_REPEATS, ..spec(100) }).expect("possible");
        let of = most.progress().of;
        assert!(most.repeats_in(&(0..of)).iter().all(|&repeats| repeats == MAX_REPEATS as u64));
    }
}
