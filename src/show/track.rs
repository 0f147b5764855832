//! Which centrodes of a run are shown, and where: the 3D view and the flat one draw the same marks.

use centrode_core::detect::{Method, Standing};
use centrode_core::model::{Rate, Vec3};
use centrode_core::plant::Shape;
use centrode_core::record::Truth;
use centrode_core::run::{Run, Sample};

/// Steps of the motion from which a locus is taken.
const STEPS: usize = 80;
/// Least distance of two marks of a locus, in lengths of the segment.
const SPACING: f64 = 0.055;
/// The same for the sensor's dots.
const GRAIN: f64 = 0.013;
/// The sensor's dots are looked for this often, s.
const TICK: f64 = 0.015;
/// And at most at so many instants of a log.
const DOTS: usize = 8192;
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

/// The constrained model's centrode c_c (m) by the truth at an instant, while a contact holds.
#[must_use]
pub fn constrained(run: &Run, truth: Option<&Truth>) -> Option<Vec3> {
    match &truth?.shape {
        Shape::Free(_) => None,
        Shape::Touched(touched) => visible(run, touched.centrode(Rate::BENDING)?),
        Shape::Held(held) => visible(run, held.centrode(Rate::BENDING)?),
    }
}

/// The sensor's centrode c_s (m) in a sample, where it moves fast enough to be judged and within the picture.
#[must_use]
pub fn sensed(run: &Run, sample: &Sample) -> Option<Vec3> {
    let judgement = &sample.judgement;
    let far = judgement.deviation > STRAY * run.plan.segment().length;
    visible(run, judgement.sensor_centrode).filter(|_| !far && standing(run, sample) != Standing::Silent)
}

/// How the centrode's deviation stands in a sample.
#[must_use]
pub fn standing(run: &Run, sample: &Sample) -> Standing {
    Method::Fcd.statistic(&sample.judgement, sample.time, &run.judged.settings.thresholds).standing
}

/// Places of the samples between which θL takes equal steps over the whole motion, `steps` of them, in order: marks stand evenly,
/// however slow the motion's ends are.
#[must_use]
pub fn even(run: &Run, steps: usize) -> Vec<usize> {
    if run.is_recorded() {
        return moved(run, steps);
    }
    let motion = &run.plan.scenario().motion;
    let step = (motion.theta_end - motion.theta_start) / steps as f64;
    let mut next = 0.0;
    let mut chosen = Vec::with_capacity(steps + 1);
    for (k, sample) in run.samples().enumerate().filter(|(_, sample)| sample.time >= motion.start) {
        let done = if step == 0.0 { 0.0 } else { (sample.theta_l - motion.theta_start) / step + 1e-9 };
        if done >= next {
            chosen.push(k);
            next = done.floor() + 1.0;
        }
    }
    chosen
}

/// Of a log, which may move as it likes: places where θL has gone on by a share of all that it spans.
fn moved(run: &Run, steps: usize) -> Vec<usize> {
    let looked = || looked(run.len(), LOOKED).map(|k| (k, run.sample(k).theta_l)).filter(|(_, at)| at.is_finite());
    let (least, most) = looked().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), (_, at)| (a.min(at), b.max(at)));
    let step = (most - least) / steps as f64;
    let mut chosen: Vec<usize> = Vec::new();
    let mut last = f64::INFINITY;
    for (k, at) in looked() {
        if (at - last).abs() >= step && (step > 0.0 || chosen.is_empty()) {
            chosen.push(k);
            last = at;
        }
    }
    // A motion that goes to and fro does not fill the picture.
    let most = MOST_TURNS * steps;
    let kept = looked_at(&chosen, most);
    if kept.is_empty() { vec![0] } else { kept }
}

/// Places of a log at which its motion is looked at, at most.
const LOOKED: usize = 4096;
/// Marks of a log, in those of one motion, at most.
const MOST_TURNS: usize = 4;

/// At most `most` places of so many, evenly.
pub fn looked(count: usize, most: usize) -> impl Iterator<Item = usize> {
    (0..count).step_by(count.div_ceil(most.max(1)).max(1))
}

fn looked_at(places: &[usize], most: usize) -> Vec<usize> {
    looked(places.len(), most).filter_map(|k| places.get(k).copied()).collect()
}

/// A locus over the whole motion.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Locus {
    /// Its path, in order of time.
    pub path: Vec<Spot>,
    /// Marks along it, at a distance from each other: a locus that hardly moves is not a blot.
    pub marks: Vec<Spot>,
}

impl Locus {
    fn new(run: &Run, path: Vec<Spot>) -> Self {
        Self { marks: spaced(&path, SPACING * run.plan.segment().length), path }
    }
}

/// A small place that the sensor's centrode has visited, armed and judged.
#[derive(Debug, Clone, PartialEq)]
struct Dot {
    /// In {B}, m.
    at: Vec3,
    /// When, s, rising.
    visits: Vec<f64>,
}

/// The loci of a run, made once for all its pictures.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trace {
    /// c_m.
    pub model: Locus,
    /// c_c, while a contact holds.
    pub constrained: Locus,
    dots: Vec<Dot>,
}

impl Trace {
    /// Of a run.
    #[must_use]
    pub fn new(run: &Run) -> Self {
        let steps = even(run, STEPS);
        let spots = |at: &dyn Fn(usize, &Sample) -> Option<Vec3>| {
            let spot = |&k: &usize| {
                let sample = run.sample(k);
                Some(Spot::new(sample.time, at(k, &sample)?))
            };
            Locus::new(run, steps.iter().filter_map(spot).collect())
        };
        Self {
            model: spots(&|_, sample| model(run, sample)),
            constrained: spots(&|k, _| constrained(run, run.truth(k))),
            dots: dots(run),
        }
    }

    /// The dots of c_s, armed and judged, up to a time (s): one for each small place.
    pub fn dots(&self, until: f64) -> impl Iterator<Item = Spot> {
        let visited = self.dots.iter().take_while(move |dot| dot.visits[0] <= until);
        visited.map(move |Dot { at, visits }| {
            let latest = visits[visits.partition_point(|&time| time <= until) - 1];
            Spot { time: visits[0], latest, at: *at }
        })
    }
}

fn dots(run: &Run) -> Vec<Dot> {
    let least = GRAIN * run.plan.segment().length;
    let mut step = 1.max((TICK * run.plan.scenario().loop_rate) as usize);
    if run.is_recorded() {
        step = step.max(run.len() / DOTS);
    }
    let mut dots: Vec<Dot> = Vec::new();
    for sample in (0..run.len()).step_by(step).map(|k| run.sample(k)) {
        if standing(run, &sample) != Standing::Counts {
            continue;
        }
        let Some(at) = sensed(run, &sample) else { continue };
        match dots.iter_mut().find(|dot| (dot.at - at).norm() < least) {
            Some(dot) => dot.visits.push(sample.time),
            None => dots.push(Dot { at, visits: vec![sample.time] }),
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
        let samples: Vec<Sample> = even(&run, 30).into_iter().map(|k| run.sample(k)).collect();
        assert!((30..=31).contains(&samples.len()), "{}", samples.len());
        let steps: Vec<f64> = samples.windows(2).map(|pair| pair[0].theta_l - pair[1].theta_l).collect();
        let step = std::f64::consts::FRAC_PI_2 / 30.0;
        assert!(steps[1..].iter().all(|s| (s - step).abs() < 0.1 * step), "{steps:?}");
    }

    #[test]
    fn constrained_marks_exist_only_while_contact_holds() {
        let path = Trace::new(&run("paper")).constrained.path;
        assert!(!path.is_empty() && path.iter().all(|spot| spot.time >= 5.8));
        assert!(Trace::new(&run("free")).constrained.path.is_empty());
    }

    #[test]
    fn dots_are_armed_and_not_of_the_future() {
        let run = run("bench");
        let armed_from = run.plan.scenario().detection.armed_from;
        let trace = Trace::new(&run);
        assert_eq!(trace.dots(armed_from - 0.01).count(), 0);
        let dots: Vec<Spot> = trace.dots(6.0).collect();
        assert!(!dots.is_empty() && dots.iter().all(|dot| dot.time >= armed_from && dot.latest <= 6.0));
        let later = trace.dots(8.0).filter(|dot| dot.time <= 6.0).count();
        assert_eq!(later, dots.len(), "a dot does not go away");
    }
}
