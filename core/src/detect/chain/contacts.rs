//! Which segments carry contacts, where on the backbone, and since when.

use super::course::KnownContact;
use super::heard::{Asked, Each, Heard, Last};
use super::{ChainEvent, ChainJudged, ChainMethod};
use crate::detect::calibration::jointly::Placed;
use crate::detect::calibration::marginal::Place;
use crate::detect::calibration::watched::Watched;
use crate::detect::{Method, Settings};
use crate::model::chain::{Rod, Torsion, stiffnesses};
use crate::scenario::chain::Tracked;
use crate::scenario::{Estimator, Kind};
use libm::exp;
use serde::{Deserialize, Serialize};

/// A contact that alarms tell of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChainContactFound {
    /// The first alarm of it, s.
    pub alarm: f64,
    /// The segment whose end disk raised it, from 0.
    pub raised_by: usize,
    /// The segments whose end disks alarm because of it, rising; the last of them carries it.
    pub deviating: Vec<usize>,
    /// Where it is, as more is read.
    pub estimates: Vec<ChainEstimate>,
    /// The contacts that are thought to hold already.
    before: Vec<KnownContact>,
}

/// What is known of a contact some time after its alarm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChainEstimate {
    /// Time since the alarm, s.
    pub after: f64,
    /// Time at which it was made, s.
    pub time: f64,
    /// The likeliest segment, from 0.
    pub segment: usize,
    /// Probability of each segment; of one that was told by its alarm alone, 1.
    pub probabilities: Vec<f64>,
    /// Probability that nothing touches: that the alarm is a false one.
    pub nothing: f64,
    /// Arc lengths from that segment's base, m.
    pub place: Place,
    /// Arc lengths from the base of the chain, over all segments, m.
    pub along: Along,
    /// When it began, s; none where the estimator does not say.
    pub began: Option<f64>,
    /// Probability of each kind of contact on that segment; empty where the estimator does not say.
    pub kinds: Vec<(Kind, f64)>,
    /// By how much the normal of a plane there is turned about the backbone's tangent from the bending plane, rad: the likeliest; none where
    /// the estimator does not say.
    pub tilt: Option<f64>,
    /// Of every segment that was thought of: arc lengths from its base (m) and probability densities (1/m), the probability of the segment
    /// counted in.
    pub posterior: Vec<Vec<[f64; 2]>>,
}

/// An interval along the whole backbone that holds the contact with a probability of 95 %, 2.5 % on either side.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
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
        // Each with its place in what is found.
        let mut known: Vec<(usize, KnownContact)> = Vec::new();
        for event in self.events.iter().filter(|event| event.detector == detector) {
            let (segment, alarm) = (event.segment, event.raised);
            let standing = found.last().is_some_and(|last| self.stands(detector, last, event));
            let same = standing
                && found.last().is_some_and(|last| {
                    last.deviating.iter().any(|other| segment <= *other)
                        || self.began_before(&known, segment, alarm, last.alarm)
                });
            match found.last_mut().filter(|_| same) {
                Some(last) => {
                    last.deviating.push(segment);
                    last.deviating.sort_unstable();
                    last.deviating.dedup();
                }
                None => {
                    let clear = |last: &ChainContactFound| self.clear(segment, alarm).max(0.5 * (last.alarm + alarm));
                    if standing
                        && let Some(last) = found.last()
                        && let Some(contact) = self.settled(detector, last, clear(last))
                    {
                        known.push((found.len() - 1, contact));
                    }
                    if !standing {
                        known.retain(|(of, _)| self.stands(detector, &found[*of], event));
                    }
                    let deviating = vec![segment];
                    let (estimates, before) = (Vec::new(), known.iter().map(|(_, contact)| *contact).collect());
                    found.push(ChainContactFound { alarm, raised_by: segment, deviating, estimates, before });
                }
            }
        }
        // What is read once the next contact has begun says nothing of this one alone.
        let ends: Vec<f64> = found.iter().skip(1).map(|next| next.alarm).chain([f64::INFINITY]).collect();
        for (contact, end) in found.iter_mut().zip(ends) {
            let before = after.iter().filter(|after| contact.alarm + **after < end);
            let estimates = before.filter_map(|&after| self.estimate(detector, contact, after));
            contact.estimates = estimates.collect();
        }
        found
    }

    /// Whether an alarm of a contact stands as another is raised.
    fn stands(&self, detector: ChainMethod, contact: &ChainContactFound, now: &ChainEvent) -> bool {
        self.events.iter().any(|event| {
            let of = event.detector == detector && contact.deviating.contains(&event.segment) && event != now;
            let raised = event.raised >= contact.alarm && event.raised <= now.raised;
            of && raised && event.cleared.is_none_or(|cleared| cleared > now.raised)
        })
    }

    /// The segments whose alarms tell of a contact by a time (s).
    fn deviating(&self, detector: ChainMethod, contact: &ChainContactFound, time: f64) -> Vec<usize> {
        let deviates = |segment: &usize| {
            self.events.iter().any(|event| {
                let raised = (contact.alarm..=time).contains(&event.raised);
                event.detector == detector && event.segment == *segment && raised
            })
        };
        contact.deviating.iter().copied().filter(deviates).collect()
    }

    /// What every segment showed up to a time (s).
    fn heard(&self, time: f64) -> Option<Heard<'_>> {
        if let Some(watch) = &self.whole {
            return Last::new(watch, self.rods(), time).map(Heard::Last);
        }
        let watched: Vec<&Watched> =
            self.segments.iter().map(|judged| judged.watched.as_ref()).collect::<Option<_>>()?;
        Each::new(&watched, self.rods(), time).map(Heard::Each)
    }

    /// The nominal rods: distal backbones run inside proximal ones.
    fn rods(&self) -> Vec<Rod> {
        let tubes: Vec<(f64, f64)> =
            self.settings.segments.iter().map(|settings| (settings.segment.ep_ip, settings.segment.es_is)).collect();
        let segments = self.settings.segments.iter().zip(&self.settings.torsions).zip(stiffnesses(&tubes));
        let rod = |((settings, torsion), bending_stiffness): ((&Settings, &Torsion), f64)| Rod {
            length: settings.segment.length,
            bending_stiffness,
            torsion: *torsion,
        };
        segments.map(rod).collect()
    }

    /// Whether what a segment alarms of had begun by an earlier alarm.
    fn began_before(&self, known: &[(usize, KnownContact)], segment: usize, alarm: f64, before: f64) -> bool {
        let known: Vec<KnownContact> = known.iter().map(|(_, contact)| *contact).collect();
        let began = || {
            let heard = self.heard(alarm)?;
            let between = [heard.earliest(segment, heard.last())?, heard.last()];
            heard
                .listen(&known, between[0], None)?
                .to(segment, between, 0.0)?
                .told(1, 1.0, f64::NEG_INFINITY)
                .map(|placed| placed.estimate.began)
        };
        began().map_or(alarm - before < SAME, |began| began <= before)
    }

    /// The time (s) by which nothing had begun of what a segment alarms of.
    fn clear(&self, segment: usize, alarm: f64) -> f64 {
        let clear = || {
            let heard = self.heard(alarm)?;
            heard.arrived(segment, heard.earliest(segment, heard.at(segment, alarm)?)?)
        };
        clear().unwrap_or(f64::NEG_INFINITY)
    }

    /// A contact as it is known at a later time (s); none where it is likelier that nothing touches.
    fn settled(&self, detector: ChainMethod, contact: &ChainContactFound, time: f64) -> Option<KnownContact> {
        let deviating = self.deviating(detector, contact, time);
        let estimate = self.marginal(contact, &deviating, [time - contact.alarm, time])?;
        if estimate.nothing > 0.5 {
            return None;
        }
        let began = self.heard(time)?.reading(estimate.began?);
        Some(KnownContact { segment: estimate.segment, at: estimate.place.mean, tilt: estimate.tilt?, began })
    }

    /// What is known of one of the contacts that a detector tells of, so long after its alarm (s); none where the run ends before, or nothing is.
    #[must_use]
    pub fn estimate(&self, detector: ChainMethod, contact: &ChainContactFound, after: f64) -> Option<ChainEstimate> {
        let time = contact.alarm + after;
        if self.end < time {
            return None;
        }
        let deviating = self.deviating(detector, contact, time);
        let places = matches!(detector, ChainMethod::Of(method) if method.places());
        let by_centrode = || self.by_centrode(contact, *deviating.last().filter(|_| places)?, [after, time]);
        self.marginal(contact, &deviating, [after, time]).or_else(by_centrode)
    }

    /// Every segment is asked for the probability of all readings with a contact on it, over that without.
    fn marginal(
        &self,
        contact: &ChainContactFound,
        deviating: &[usize],
        [after, time]: [f64; 2],
    ) -> Option<ChainEstimate> {
        let heard = self.heard(time)?;
        let latest = heard.at(contact.raised_by, contact.alarm)?;
        // As early as any segment that deviates by now leaves open.
        let earliest = deviating.iter().filter_map(|&segment| heard.earliest(segment, latest)).min();
        let between = [earliest.or_else(|| heard.earliest(contact.raised_by, latest))?, latest];
        let parts = self.settings.segments[0].placing.beginnings;
        // The most distal one that deviates is likely the one.
        let likely = deviating.last().copied().unwrap_or(contact.raised_by);
        let listening = heard.listen(&contact.before, between[0], None)?;
        let suspected = || {
            let Placed { estimate, tilt } = listening.to(likely, between, 0.0)?.told(1, 1.0, f64::NEG_INFINITY)?;
            let began = heard.reading(estimate.began);
            Some(KnownContact { segment: likely, at: estimate.place.mean, tilt, began })
        };
        // One tracker measures no bends that contacts could change.
        let suspected = if matches!(heard, Heard::Each(_)) { suspected() } else { None };
        let again = suspected.and_then(|suspected| heard.listen(&contact.before, between[0], Some(suspected)));
        let listening = again.unwrap_or(listening);
        let told = |asked: &Option<Asked>, doubt: f64, rival: f64| asked.as_ref()?.told(parts, doubt, rival);
        let ratio = |placed: &Option<Placed>| placed.as_ref().map_or(f64::NEG_INFINITY, |placed| placed.estimate.ratio);
        let evidence =
            |each: &[Option<Placed>]| each.iter().flatten().map(|of| of.estimate.evidence).fold(0.0, f64::max);
        let mut asked: Vec<_> = (0..heard.segments()).map(|segment| listening.to(segment, between, 0.0)).collect();
        let mut each: Vec<Option<Placed>> = vec![None; asked.len()];
        // Beside it others need no closer look.
        for segment in std::iter::once(likely).chain((0..asked.len()).filter(|segment| *segment != likely)) {
            each[segment] = told(&asked[segment], 1.0, evidence(&each));
        }
        let best = each.iter().map(ratio).fold(f64::NEG_INFINITY, f64::max);
        for (segment, placed) in each.iter_mut().enumerate() {
            // Once more where planes stand askew.
            if let Some(tilt) = placed.as_ref().map(|placed| placed.tilt).filter(|tilt| tilt.abs() > ASKEW)
                && ratio(placed) > best - UNLIKELY
            {
                asked[segment] = listening.to(segment, between, tilt);
                *placed = told(&asked[segment], 1.0, f64::NEG_INFINITY);
            }
        }
        let doubt = listening.doubt(between[0], evidence(&each));
        if doubt > 1.0 {
            each = asked.iter().map(|asked| told(asked, doubt, f64::NEG_INFINITY)).collect();
        }
        let ratios: Vec<f64> = each.iter().map(ratio).collect();
        let (probabilities, nothing) = shares(&ratios)?;
        let segment = (0..probabilities.len()).max_by(|&a, &b| probabilities[a].total_cmp(&probabilities[b]))?;
        let posterior: Vec<Vec<[f64; 2]>> = each
            .iter()
            .zip(&probabilities)
            .map(|(placed, share)| {
                let density = placed.iter().flat_map(|placed| &placed.estimate.posterior);
                density.map(|[place, density]| [*place, density * share]).collect()
            })
            .collect();
        let Placed { estimate: chosen, tilt } = each[segment].as_ref()?;
        let along = self.along(&posterior, segment, &chosen.place);
        let (place, began, kinds, tilt) = (chosen.place, Some(chosen.began), chosen.kinds.clone(), Some(*tilt));
        Some(ChainEstimate {
            after,
            time,
            segment,
            probabilities,
            nothing,
            place,
            along,
            began,
            kinds,
            tilt,
            posterior,
        })
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

    /// Eq. 24 on a segment: the most distal that deviates by then.
    fn by_centrode(
        &self,
        contact: &ChainContactFound,
        segment: usize,
        [after, time]: [f64; 2],
    ) -> Option<ChainEstimate> {
        let judged = self.segments.get(segment)?;
        let place = judged.estimate(&self.relative[segment], contact.alarm, after, Estimator::Eq24)?.location;
        let probabilities = (0..self.segments.len()).map(|k| f64::from(u8::from(k == segment))).collect();
        let along = self.along(&[], segment, &place);
        Some(ChainEstimate {
            after,
            time,
            segment,
            probabilities,
            nothing: 0.0,
            place,
            along,
            began: None,
            kinds: Vec::new(),
            tilt: None,
            posterior: Vec::new(),
        })
    }

    /// The detector by which contacts are told apart where nothing else is said: the first of these that judges.
    #[must_use]
    pub fn teller(&self) -> Option<ChainMethod> {
        let asked = [Method::Cusum, Method::Glr, Method::FcdConsistent, Method::FcdVelocity, Method::Fcd];
        let method = asked.into_iter().find(|method| self.settings.methods.contains(method)).map(ChainMethod::Of);
        let told = |method: &ChainMethod| {
            self.settings.tracked == Tracked::All || *method == ChainMethod::Of(Method::Cusum) && self.whole.is_some()
        };
        method.filter(told).or(self.settings.smd.map(|_| ChainMethod::Smd))
    }
}

/// A plane that stands more askew than this, rad, is asked for once more, on a segment whose probability is not smaller by more than this, as a
/// logarithm.
const ASKEW: f64 = 0.01;
const UNLIKELY: f64 = 12.0;
/// Without the calibration filter, alarms of segments above within this time (s) tell of the same contact.
const SAME: f64 = 0.5;

/// The probability of each segment, and of no contact, every one as likely beforehand, from the logarithms of the ratios for each.
fn shares(ratios: &[f64]) -> Option<(Vec<f64>, f64)> {
    if ratios.iter().all(|ratio| *ratio == f64::NEG_INFINITY) {
        return None;
    }
    let most = ratios.iter().copied().fold(0.0, f64::max);
    let weights: Vec<f64> = ratios.iter().map(|ratio| exp(ratio - most)).collect();
    let total: f64 = weights.iter().sum::<f64>() + exp(-most);
    Some((weights.into_iter().map(|weight| weight / total).collect(), exp(-most) / total))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_add_up_and_follow_the_ratios() {
        let (each, nothing) = shares(&[3.0, 2000.0, 1999.0]).expect("finite");
        assert!((each.iter().sum::<f64>() - 1.0).abs() < 1e-12 && nothing == 0.0);
        assert!((each[1] / each[2] - std::f64::consts::E).abs() < 1e-12 && each[0] == 0.0);
        let (each, nothing) = shares(&[-9.0, 0.0]).expect("finite");
        assert!(nothing > 0.49 && (each.iter().sum::<f64>() + nothing - 1.0).abs() < 1e-12);
        assert_eq!(shares(&[f64::NEG_INFINITY; 2]), None);
    }
}
