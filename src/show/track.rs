//! Which centrodes of a run are shown, and where: the 3D view and the flat one draw the same marks.

use centrode_core::model::{Constrained, Rate, Vec3};
use centrode_core::plant::Plant;
use centrode_core::run::{Run, Sample};

/// Steps of the motion from which a locus is taken.
const STEPS: usize = 80;
/// Least distance of two marks of a locus, in lengths of the segment.
const SPACING: f64 = 0.055;
/// The same for the sensor's dots.
const GRAIN: f64 = 0.013;
/// The sensor's dots are looked for this often, s.
const TICK: f64 = 0.015;
/// A centrode farther from the base than this many lengths is off the picture.
const FAR: f64 = 1.6;
/// The sensor's is also off when it is this many lengths away from the model's.
const STRAY: f64 = 1.0;

/// A centrode at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// s.
    pub time: f64,
    /// Latest time at which it was there again, s.
    pub latest: f64,
    /// In {B}, m.
    pub at: Vec3,
}

impl Spot {
    fn new(time: f64, at: Vec3) -> Self {
        Self { time, latest: time, at }
    }
}

fn visible(run: &Run, centrode: Vec3) -> Option<Vec3> {
    (centrode.norm() < FAR * run.plan.segment().length).then_some(centrode)
}

/// The model's centrode c_m (m) in a sample, within the picture.
#[must_use]
pub fn model(run: &Run, sample: &Sample) -> Option<Vec3> {
    visible(run, sample.judgement.model_centrode)
}

/// The constrained model's centrode c_c (m) at a time (s), while the beam holds.
#[must_use]
pub fn constrained(run: &Run, time: f64) -> Option<Vec3> {
    let (configuration, _) = Plant::new(&run.plan).command(time);
    let contact = run.plan.contact().filter(|contact| contact.holds_at(configuration.bend()))?;
    let held = Constrained::new(run.plan.segment().length, contact.arc_length, contact.bend, configuration);
    visible(run, held.centrode(Rate::BENDING)?)
}

/// The sensor's centrode c_s (m) in a sample, where it moves fast enough to be judged and within the picture.
#[must_use]
pub fn sensed(run: &Run, sample: &Sample) -> Option<Vec3> {
    let judgement = &sample.judgement;
    let far = judgement.deviation > STRAY * run.plan.segment().length;
    let judged = judgement.speed > run.plan.scenario().detection.min_speed;
    visible(run, judgement.sensor_centrode).filter(|_| judged && !far)
}

/// Whether the detection is armed at a time (s).
#[must_use]
pub fn armed(run: &Run, time: f64) -> bool {
    time >= run.plan.scenario().detection.armed_from
}

/// The samples between which θL takes equal steps over the whole motion, `steps` of them, in order: marks stand
/// evenly, however slow the motion's ends are.
#[must_use]
pub fn even(run: &Run, steps: usize) -> Vec<&Sample> {
    let motion = &run.plan.scenario().motion;
    let step = (motion.theta_end - motion.theta_start) / steps as f64;
    let mut next = 0.0;
    let mut chosen = Vec::with_capacity(steps + 1);
    for sample in run.samples.iter().filter(|sample| sample.time >= motion.start) {
        let done = if step == 0.0 { 0.0 } else { (sample.theta_l - motion.theta_start) / step + 1e-9 };
        if done >= next {
            chosen.push(sample);
            next = done.floor() + 1.0;
        }
    }
    chosen
}

/// The path of c_m over the motion.
#[must_use]
pub fn model_path(run: &Run) -> Vec<Spot> {
    even(run, STEPS).into_iter().filter_map(|s| Some(Spot::new(s.time, model(run, s)?))).collect()
}

/// The path of c_c over the motion, while the beam holds.
#[must_use]
pub fn constrained_path(run: &Run) -> Vec<Spot> {
    even(run, STEPS).into_iter().filter_map(|s| Some(Spot::new(s.time, constrained(run, s.time)?))).collect()
}

/// The marks of a path: a locus that hardly moves is not a blot.
#[must_use]
pub fn marks(run: &Run, path: &[Spot]) -> Vec<Spot> {
    spaced(path, SPACING * run.plan.segment().length)
}

/// The dots of c_s, armed and judged, up to a time (s): one for each small place.
#[must_use]
pub fn dots(run: &Run, until: f64) -> Vec<Spot> {
    let least = GRAIN * run.plan.segment().length;
    let step = 1.max((TICK * run.plan.scenario().loop_rate) as usize);
    let mut dots: Vec<Spot> = Vec::new();
    let past = run.samples.iter().step_by(step).take_while(|sample| sample.time <= until);
    for sample in past.filter(|sample| armed(run, sample.time)) {
        let Some(at) = sensed(run, sample) else { continue };
        match dots.iter_mut().find(|dot| (dot.at - at).norm() < least) {
            Some(dot) => dot.latest = sample.time,
            None => dots.push(Spot::new(sample.time, at)),
        }
    }
    dots
}

/// The spots that are at least `least` m from the one kept before.
fn spaced(path: &[Spot], least: f64) -> Vec<Spot> {
    let mut kept: Vec<Spot> = Vec::new();
    for spot in path {
        if kept.last().is_none_or(|last| (last.at - spot.at).norm() >= least) {
            kept.push(*spot);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::run::simulate;
    use centrode_core::scenario::preset;

    fn run(name: &str) -> Run {
        simulate(&preset::find(name).and_then(preset::Preset::scenario).expect("preset")).expect("run")
    }

    #[test]
    fn marks_keep_their_distance() {
        let path: Vec<Spot> = (0..100).map(|i| Spot::new(0.0, Vec3::x() * 0.1 * f64::from(i))).collect();
        let kept = spaced(&path, 1.0);
        assert!((9..=11).contains(&kept.len()) && kept[0] == path[0]);
        assert!(kept.windows(2).all(|w| (w[0].at - w[1].at).norm() >= 1.0));
    }

    #[test]
    fn samples_stand_evenly_along_the_bend() {
        let run = run("paper");
        let samples = even(&run, 30);
        assert!((30..=31).contains(&samples.len()), "{}", samples.len());
        let steps: Vec<f64> = samples.windows(2).map(|pair| pair[0].theta_l - pair[1].theta_l).collect();
        let step = std::f64::consts::FRAC_PI_2 / 30.0;
        assert!(steps[1..].iter().all(|s| (s - step).abs() < 0.1 * step), "{steps:?}");
    }

    #[test]
    fn constrained_marks_exist_only_while_contact_holds() {
        let path = constrained_path(&run("paper"));
        assert!(!path.is_empty() && path.iter().all(|spot| spot.time >= 5.8));
        assert!(constrained_path(&run("free")).is_empty());
    }

    #[test]
    fn dots_are_armed_and_not_of_the_future() {
        let run = run("bench");
        let armed_from = run.plan.scenario().detection.armed_from;
        assert!(dots(&run, armed_from - 0.01).is_empty());
        let dots = dots(&run, 6.0);
        assert!(!dots.is_empty() && dots.iter().all(|dot| dot.time >= armed_from && dot.latest <= 6.0));
    }
}
