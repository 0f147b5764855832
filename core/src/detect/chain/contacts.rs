//! Which segments carry contacts, where on the backbone, and since when.

use super::{ChainJudged, ChainMethod};
use crate::detect::Method;
use crate::detect::calibration::marginal::{Estimate, Place};
use crate::detect::calibration::watched::Watched;
use crate::scenario::{Estimator, Kind};
use libm::exp;

/// A contact that alarms tell of.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainContactFound {
    /// The first alarm of it, s.
    pub alarm: f64,
    /// The segment whose end disk raised it, from 0.
    pub raised_by: usize,
    /// The segments whose end disks alarm because of it, rising; the last of them carries it.
    pub deviating: Vec<usize>,
    /// Where it is, as more is read.
    pub estimates: Vec<ChainEstimate>,
}

/// What is known of a contact some time after its alarm.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainEstimate {
    /// Time since the alarm, s.
    pub after: f64,
    /// Time at which it was made, s.
    pub time: f64,
    /// The likeliest segment, from 0.
    pub segment: usize,
    /// Probability of each segment; of one that was told by its alarm alone, 1.
    pub probabilities: Vec<f64>,
    /// Arc lengths from that segment's base, m.
    pub place: Place,
    /// Arc lengths from the base of the chain, over all segments, m.
    pub along: Along,
    /// When it began, s; none where the estimator does not say.
    pub began: Option<f64>,
    /// Of every segment that was thought of: arc lengths from its base (m) and probability densities (1/m), the probability of the segment
    /// counted in.
    pub posterior: Vec<Vec<[f64; 2]>>,
}

/// An interval along the whole backbone that holds the contact with a probability of 95 %, 2.5 % on either side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Along {
    /// m.
    pub mean: f64,
    /// m.
    pub low: f64,
    /// m.
    pub high: f64,
}

impl ChainJudged {
    /// The contacts that a detector tells of, each with what is known of it so long after its alarm (s).
    ///
    /// An alarm of a segment below one that deviates tells nothing new: segments below a contact deflect as well. One of a segment above
    /// tells of the same contact where the readings say that it began before the first alarm, and else of another.
    #[must_use]
    pub fn contacts(&self, detector: ChainMethod, after: &[f64]) -> Vec<ChainContactFound> {
        let mut found: Vec<ChainContactFound> = Vec::new();
        for event in self.events.iter().filter(|event| event.detector == detector) {
            let (segment, alarm) = (event.segment, event.raised);
            let standing = found.last_mut().filter(|last| self.stands(detector, last, alarm));
            match standing {
                Some(last) if last.deviating.iter().any(|other| segment <= *other) || self.began_before(segment, alarm, last.alarm) => {
                    last.deviating.push(segment);
                    last.deviating.sort_unstable();
                    last.deviating.dedup();
                }
                _ => {
                    let deviating = vec![segment];
                    found.push(ChainContactFound { alarm, raised_by: segment, deviating, estimates: Vec::new() });
                }
            }
        }
        for contact in &mut found {
            let estimates = after.iter().filter_map(|&after| self.estimate(detector, contact, after));
            contact.estimates = estimates.collect();
        }
        found
    }

    /// Whether an alarm of a contact still stands at a time (s).
    fn stands(&self, detector: ChainMethod, contact: &ChainContactFound, time: f64) -> bool {
        self.events.iter().any(|event| {
            let of = event.detector == detector && contact.deviating.contains(&event.segment);
            of && event.raised >= contact.alarm && event.raised <= time && event.cleared.is_none_or(|cleared| cleared > time)
        })
    }

    /// Whether what a segment alarms of had begun by an earlier alarm.
    fn began_before(&self, segment: usize, alarm: f64, before: f64) -> bool {
        let watched = self.segments.get(segment).and_then(|judged| judged.watched.as_ref());
        let Some(watched) = watched else { return alarm - before < SAME };
        let began = || {
            let reading = watched.at(alarm)?;
            watched.estimate(reading, reading, &kinds(self, segment), 1).map(|estimate| estimate.began)
        };
        began().map_or(alarm - before < SAME, |began| began <= before)
    }

    fn estimate(&self, detector: ChainMethod, contact: &ChainContactFound, after: f64) -> Option<ChainEstimate> {
        let time = contact.alarm + after;
        if self.relative.first()?.entries.last()?.time < time {
            return None;
        }
        self.marginal(contact, after, time).or_else(|| self.by_centrode(detector, contact, after, time))
    }

    /// Every segment is asked for the probability of its readings with a contact, over that without.
    fn marginal(&self, contact: &ChainContactFound, after: f64, time: f64) -> Option<ChainEstimate> {
        let watched: Vec<&Watched> = self.segments.iter().map(|judged| judged.watched.as_ref()).collect::<Option<_>>()?;
        let raised = watched.get(contact.raised_by)?;
        let latest = raised.at(contact.alarm)?;
        // As early as any segment that deviates by now leaves open.
        let earliest = contact.deviating.iter().filter_map(|&segment| watched[segment].earliest(latest)).min();
        let between = [earliest.or_else(|| raised.earliest(latest))?, latest];
        let ask = |(segment, watched): (usize, &&Watched)| {
            watched.begun(between, watched.at(time)?, &kinds(self, segment), self.settings.segments[segment].placing.beginnings)
        };
        let each: Vec<Option<Estimate>> = watched.iter().enumerate().map(ask).collect();
        let ratios: Vec<f64> =
            each.iter().map(|estimate| estimate.as_ref().map_or(f64::NEG_INFINITY, |estimate| estimate.ratio)).collect();
        let probabilities = shares(&ratios)?;
        let segment = (0..probabilities.len()).max_by(|&a, &b| probabilities[a].total_cmp(&probabilities[b]))?;
        let posterior: Vec<Vec<[f64; 2]>> = each
            .iter()
            .zip(&probabilities)
            .map(|(estimate, share)| {
                let density = estimate.iter().flat_map(|estimate| &estimate.posterior);
                density.map(|[place, density]| [*place, density * share]).collect()
            })
            .collect();
        let chosen = each[segment].as_ref()?;
        let along = self.along(&posterior, segment, &chosen.place);
        let (place, began) = (chosen.place, Some(chosen.began));
        Some(ChainEstimate { after, time, segment, probabilities, place, along, began, posterior })
    }

    /// Arc length of a segment's base from that of the chain, m.
    fn base(&self, segment: usize) -> f64 {
        self.settings.segments[..segment].iter().map(|settings| settings.segment.length).sum()
    }

    fn along(&self, posterior: &[Vec<[f64; 2]>], chosen: usize, place: &Place) -> Along {
        let mut cells: Vec<[f64; 3]> = Vec::new();
        for (segment, density) in posterior.iter().enumerate() {
            let base = self.base(segment);
            let width = density.get(1).map_or(0.0, |next| next[0] - density[0][0]);
            cells.extend(density.iter().map(|[at, here]| [base + at, here * width, width]));
        }
        let total: f64 = cells.iter().map(|cell| cell[1]).sum();
        if total <= 0.0 {
            let base = self.base(chosen);
            return Along { mean: base + place.mean, low: base + place.low, high: base + place.high };
        }
        let quantile = |share: f64| {
            let mut sum = 0.0;
            for [at, here, width] in &cells {
                if sum + here >= share * total {
                    return at + ((share * total - sum) / here - 0.5) * width;
                }
                sum += here;
            }
            cells.last().map_or(f64::NAN, |cell| cell[0])
        };
        let mean = cells.iter().map(|[at, here, _]| at * here).sum::<f64>() / total;
        Along { mean, low: quantile(0.025), high: quantile(0.975) }
    }

    /// Eq. 24 on the most distal segment that deviates by then.
    fn by_centrode(&self, detector: ChainMethod, contact: &ChainContactFound, after: f64, time: f64) -> Option<ChainEstimate> {
        let deviates = |segment: &&usize| {
            self.events.iter().any(|event| event.detector == detector && event.segment == **segment && event.raised <= time)
        };
        let segment = *contact.deviating.iter().rev().find(deviates)?;
        let judged = self.segments.get(segment)?;
        let place = judged.estimate(&self.relative[segment], contact.alarm, after, Estimator::Eq24)?.location;
        let probabilities = (0..self.segments.len()).map(|k| f64::from(u8::from(k == segment))).collect();
        let along = self.along(&[], segment, &place);
        Some(ChainEstimate { after, time, segment, probabilities, place, along, began: None, posterior: Vec::new() })
    }

    /// The detector by which contacts are told apart where nothing else is said: the first of these that judges.
    #[must_use]
    pub fn teller(&self) -> Option<ChainMethod> {
        let asked = [Method::Cusum, Method::Glr, Method::FcdConsistent, Method::FcdVelocity, Method::Fcd];
        let method = asked.into_iter().find(|method| self.settings.methods.contains(method)).map(ChainMethod::Of);
        let told = self.settings.tracked == crate::scenario::chain::Tracked::All;
        method.filter(|_| told).or(self.settings.smd.map(|_| ChainMethod::Smd))
    }
}

/// Without the calibration filter, alarms of segments above within this time (s) tell of the same contact.
const SAME: f64 = 0.5;

/// What kinds of contact are thought possible on a segment.
fn kinds(judged: &ChainJudged, segment: usize) -> Vec<Kind> {
    judged.settings.segments[segment].placing.plants.iter().collect()
}

/// The probability of each segment to carry the most distal contact, every one as likely beforehand, from the logarithms of the
/// ratios for each. Those above a contact are free. Those below it may deflect or not, as likely the one as the other: how is not
/// asked, so that what the segments above have to say decides.
fn shares(ratios: &[f64]) -> Option<Vec<f64>> {
    let mut below = 0.0;
    let logs: Vec<f64> = ratios
        .iter()
        .map(|ratio| {
            let here = below + ratio;
            below += deflected(*ratio);
            here
        })
        .collect();
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if !most.is_finite() {
        return None;
    }
    let weights: Vec<f64> = logs.iter().map(|log| exp(log - most)).collect();
    let total: f64 = weights.iter().sum();
    Some(weights.into_iter().map(|weight| weight / total).collect())
}

/// The logarithm of ½ (1 + e^ratio).
fn deflected(ratio: f64) -> f64 {
    let most = ratio.max(0.0);
    most + libm::log(0.5 * (exp(-most) + exp(ratio - most)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_distal_segment_that_deviates_is_to_blame() {
        let likeliest = |ratios: &[f64]| {
            let shares = shares(ratios).expect("finite");
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            (0..shares.len()).max_by(|&a, &b| shares[a].total_cmp(&shares[b])).expect("some")
        };
        assert_eq!(likeliest(&[300.0, -4.0, -5.0]), 0);
        assert_eq!(likeliest(&[300.0, 20.0, -5.0]), 1);
        assert_eq!(likeliest(&[300.0, 2000.0, 9.0]), 2);
        assert_eq!(likeliest(&[-3.0, -3.0, 40.0]), 2);
        assert_eq!(shares(&[f64::NEG_INFINITY; 2]), None);
    }
}
