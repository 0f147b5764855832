//! A run of several segments over time as panels, one for each segment and what is judged of it; and where along the backbone its
//! contacts are.

use super::ChainRun;
use crate::chart::ticks::Steps;
use crate::chart::{Axis, Band, Panel, Role, Series, Span, Style, Vertical};
use crate::detect::chain::{ChainEstimate, ChainMethod};
use crate::detect::{Method, Standing};
use crate::model::chain::path::What;
use crate::scenario::chain::Tracked;
use crate::study::course::{Measure, angles, measure, range, unarmed};
use crate::study::figure::words::MILLI;
use std::f64::consts::PI;
use std::ops::Range;

/// What a panel shows of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// What a detector judges; of the screw motion deviation the distance of the axes.
    Judged(ChainMethod),
    /// The angle between the screw axes.
    Turned,
    /// θL as commanded.
    Bend,
    /// δ as commanded.
    Direction,
    /// The stability margin of all segments together: 0 where the robot buckles.
    Margin,
}

/// Below this a stability margin is worth showing.
const NEAR: f64 = 0.5;

impl Shown {
    /// Everything that a run has to show, in the order in which it is offered.
    #[must_use]
    pub fn all(run: &ChainRun) -> Vec<Self> {
        let settings = &run.judged.settings;
        let mut all: Vec<Self> = settings.detectors().map(Self::Judged).collect();
        all.extend(settings.smd.map(|_| Self::Turned));
        // What tells of contacts first.
        let teller = run.judged.teller().map(Self::Judged);
        all.sort_by_key(|shown| Some(*shown) != teller);
        all.push(Self::Bend);
        let turns = |told: &Vec<crate::record::chain::Told>| told.iter().any(|told| told.rates[1] != 0.0);
        if run.recording.told.iter().any(turns) {
            all.push(Self::Direction);
        }
        if run.recording.truth.iter().flatten().any(|truth| truth.margin < NEAR) {
            all.push(Self::Margin);
        }
        all
    }

    /// Whether it is of each segment, and not of all of them together.
    #[must_use]
    pub fn is_of_each(self) -> bool {
        self != Self::Margin
    }

    /// The segments of which it is shown: the last alone of what is judged where that alone carries a tracker.
    #[must_use]
    pub fn segments(self, run: &ChainRun) -> Range<usize> {
        let count = run.recording.segments();
        match self.detector() {
            Some(_) if run.judged.settings.tracked == Tracked::Tip => count - 1..count,
            _ if self.is_of_each() => 0..count,
            _ => 0..1,
        }
    }

    /// How its values are called and shown.
    #[must_use]
    pub fn measure(self) -> Measure {
        let angle = |detector, symbol, name, threshold, role| Measure {
            detector,
            symbol,
            name,
            threshold,
            scale: 180.0 / PI,
            si_unit: "rad",
            unit: "°",
            decimals: 1,
            role,
        };
        match self {
            Self::Judged(ChainMethod::Of(method)) => measure(method),
            Self::Judged(ChainMethod::Smd) => Measure {
                detector: "Screw motion",
                symbol: "‖f_m − f_s‖",
                name: "Screw axis distance",
                threshold: "ξ_d",
                ..measure(Method::FcdConsistent)
            },
            Self::Turned => angle("Screw motion", "α", "Screw axis angle", "ξ_α", Role::Sensor),
            Self::Bend => angle("", "θ_L", "Tangent angle", "", Role::Robot),
            Self::Direction => angle("", "δ", "Bending direction", "", Role::Robot),
            Self::Margin => Measure {
                scale: 1.0,
                si_unit: "1",
                unit: "",
                decimals: 2,
                ..angle("", "margin", "Stability margin", "", Role::Robot)
            },
        }
    }

    /// What it is held against on a segment, SI; none where nothing is, or it is switched off.
    #[must_use]
    pub fn threshold(self, run: &ChainRun, segment: usize) -> Option<f64> {
        let settings = &run.judged.settings;
        if !self.segments(run).contains(&segment) {
            return None;
        }
        match self {
            Self::Judged(ChainMethod::Of(method)) => settings.segments.get(segment)?.thresholds.of(method).value(),
            Self::Judged(ChainMethod::Smd) => settings.smd.map(|smd| smd.distance),
            Self::Turned => settings.smd.map(|smd| smd.angle),
            Self::Bend | Self::Direction | Self::Margin => None,
        }
    }

    /// Its value on a segment at a sample, SI; NaN where it has none.
    #[must_use]
    pub fn value(self, run: &ChainRun, segment: usize, sample: usize) -> f64 {
        let told = run.recording.told[segment].get(sample).map(|told| told.configuration);
        match self {
            Self::Bend => told.map_or(f64::NAN, |told| told.theta_l()),
            Self::Direction => told.map_or(f64::NAN, |told| told.delta()),
            Self::Judged(method) => run.judged.judgement(segment, sample).map_or(f64::NAN, |judgement| match method {
                ChainMethod::Of(method) => method.value(&judgement),
                ChainMethod::Smd => Method::FcdConsistent.value(&judgement),
            }),
            Self::Turned => run.judged.judgement(segment, sample).map_or(f64::NAN, |judgement| judgement.turned),
            Self::Margin => {
                let truth = run.recording.truth.as_ref().and_then(|truth| truth.get(sample));
                truth.map_or(f64::NAN, |truth| truth.margin)
            }
        }
    }

    /// The detector whose events it shows.
    fn detector(self) -> Option<ChainMethod> {
        match self {
            Self::Judged(method) => Some(method),
            Self::Turned => Some(ChainMethod::Smd),
            Self::Bend | Self::Direction | Self::Margin => None,
        }
    }

    /// Whether a value counts at a sample.
    fn counts(self, run: &ChainRun, segment: usize, sample: usize) -> bool {
        let method = match self {
            Self::Judged(ChainMethod::Of(method)) => method,
            Self::Judged(ChainMethod::Smd) | Self::Turned => Method::FcdConsistent,
            Self::Bend | Self::Direction | Self::Margin => return true,
        };
        let (Some(settings), Some(judgement)) =
            (run.judged.settings.segments.get(segment), run.judged.judgement(segment, sample))
        else {
            return false;
        };
        let (time, thresholds) = (run.recording.times[sample], &settings.thresholds);
        let value = self.value(run, segment, sample);
        let waits = self.detector() == Some(ChainMethod::Smd) && time < thresholds.armed_from;
        method.standing(value, judgement.speed, time, thresholds) != Standing::Silent && !waits
    }

    /// The values between which its panels reach, SI: the same on all segments.
    #[must_use]
    pub fn range(self, run: &ChainRun) -> [f64; 2] {
        if self == Self::Margin {
            return [0.0, 1.05];
        }
        let segments = 0..run.recording.segments();
        let samples = || 0..run.recording.times.len();
        let all = segments.flat_map(|segment| samples().map(move |sample| (segment, sample)));
        if matches!(self, Self::Bend | Self::Direction) {
            let values =
                all.map(|(segment, sample)| self.value(run, segment, sample)).filter(|value| value.is_finite());
            let ends = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
            return if ends[0].is_finite() { ends } else { [0.0, 1.0] };
        }
        let counted = all.filter(|(segment, sample)| self.counts(run, *segment, *sample));
        let scale = self.measure().scale;
        let mut values: Vec<f64> = counted.map(|(segment, sample)| scale * self.value(run, segment, sample)).collect();
        let threshold = (0..run.recording.segments()).filter_map(|segment| self.threshold(run, segment));
        [0.0, range::top(scale * threshold.fold(0.0, f64::max), &mut values) / scale]
    }

    /// What a segment (from 0) shows over time between two values (SI): events, threshold, and below the data when a contact on it holds.
    #[must_use]
    pub fn panel(self, run: &ChainRun, segment: usize, ends: [f64; 2]) -> Panel {
        let Measure { symbol, name, si_unit, unit, scale, role, .. } = self.measure();
        let last = end(run);
        let x = Axis { range: Some([0.0, last]), ..Axis::new("Time", "s", "s", 1.0) };
        let angle = matches!(self, Self::Bend | Self::Direction);
        let y = if angle {
            Axis { name: symbol, ..angles(ends) }
        } else {
            Axis { range: Some(ends), steps: Steps::Decimal, ..Axis::new(symbol, si_unit, unit, scale) }
        };
        let mut panel = Panel { title: name.into(), off_scale: !angle && self.is_of_each(), ..Panel::new(x, y) };
        panel.verticals.extend(given_way(run));
        let ends = held(run, segment);
        panel.spans.extend(ends.into_iter().map(|ends| Span { name: "contact", role: Role::Contact, low: true, ends }));
        if let Some(settings) = run.judged.settings.segments.get(segment) {
            let waits = match self.detector() {
                Some(ChainMethod::Of(method)) => settings.thresholds.waits(method),
                Some(ChainMethod::Smd) => true,
                None => false,
            };
            panel.spans.extend(waits.then(|| unarmed([0.0, last], settings.thresholds.armed_from)));
        }
        if let Some(threshold) = self.threshold(run, segment) {
            let line = vec![[0.0, threshold], [last, threshold]];
            panel.series.push(Series::new("threshold", Role::Bound, Style::Dashed, line));
        }
        for faint in [true, false] {
            let point = |sample: usize| {
                let value = if self.counts(run, segment, sample) == faint {
                    f64::NAN
                } else {
                    self.value(run, segment, sample)
                };
                [run.recording.times[sample], value]
            };
            let points = (0..run.recording.times.len()).map(point).collect();
            let name = if faint { "" } else { symbol };
            panel.series.push(Series { faint, ..Series::new(name, role, Style::Line, points) });
        }
        panel.series.extend(self.events(run, segment));
        panel
    }

    /// Events of its detector on a segment: a diamond where one is raised, a circle where it is cleared.
    fn events(self, run: &ChainRun, segment: usize) -> Vec<Series> {
        let (Some(detector), Some(threshold)) = (self.detector(), self.threshold(run, segment)) else {
            return Vec::new();
        };
        let own = || run.judged.events.iter().filter(|event| event.segment == segment && event.detector == detector);
        let raised = own().map(|event| [event.raised, threshold]).collect();
        let cleared = own().filter_map(|event| Some([event.cleared?, threshold])).collect();
        vec![
            Series::new("cleared", self.measure().role, Style::Circles, cleared),
            Series::new("raised", Role::Detection, Style::Diamonds, raised),
        ]
    }
}

/// Time of the last sample, s.
#[must_use]
pub fn end(run: &ChainRun) -> f64 {
    run.recording.times.last().copied().unwrap_or(0.0)
}

/// Where the chain gives way.
pub(super) fn given_way(run: &ChainRun) -> impl Iterator<Item = Vertical> {
    run.plan.path().happened().iter().filter_map(|event| {
        let name = match event.what {
            What::Buckled => "buckles",
            What::Lost => "shape lost",
            What::Met(_) | What::Opened(_) => return None,
        };
        Some(Vertical { name, x: event.time, role: Role::Contact })
    })
}

/// Truth: times during which something presses on a segment, s.
#[must_use]
pub fn held(run: &ChainRun, segment: usize) -> Vec<[f64; 2]> {
    let contacts = &run.plan.scenario().contacts;
    let mut spans: Vec<[f64; 2]> = Vec::new();
    for (place, _) in contacts.iter().enumerate().filter(|(_, contact)| contact.segment == segment) {
        let mut since = None;
        for event in run.plan.path().happened() {
            match event.what {
                What::Met(met) if met == place => since = since.or(Some(event.time)),
                What::Opened(opened) if opened == place => {
                    spans.extend(since.take().map(|since| [since, event.time]));
                }
                _ => {}
            }
        }
        spans.extend(since.map(|since| [since, end(run)]));
    }
    spans
}

/// Where along the whole backbone contacts are, by their estimates, each with its number from 0: densities over the arc length from the base
/// of the chain. Where contacts press in truth at a time (s) is a line.
#[must_use]
pub fn along(run: &ChainRun, placed: &[(usize, &ChainEstimate)], time: f64) -> Panel {
    let bases = bases(run);
    let total = bases.last().copied().unwrap_or(0.0);
    let x = Axis { range: Some([0.0, total]), ..Axis::new("Arc length from the base", "m", "mm", MILLI) };
    let mut panel =
        Panel { title: "Where along the backbone".into(), ..Panel::new(x, Axis::new("density", "1/m", "1/mm", 1e-3)) };
    let mut highest = 0.0_f64;
    for (number, (found, estimate)) in placed.iter().enumerate() {
        let mut points: Vec<[f64; 2]> = Vec::new();
        for (segment, density) in estimate.posterior.iter().enumerate() {
            points.extend(density.iter().map(|[at, density]| [bases[segment] + at, *density]));
            points.push([bases[segment + 1], f64::NAN]);
        }
        highest = points.iter().map(|point| point[1]).filter(|value| value.is_finite()).fold(highest, f64::max);
        let edges = points.iter().map(|&[at, density]| [[at, 0.0], [at, density]]).collect();
        panel.bands.push(Band { role: Role::Likelihood, faint: true, edges });
        let style = [Style::Line, Style::LongDashed, Style::DashDotted][number % 3];
        panel.series.push(Series::new(format!("contact {}", found + 1), Role::Likelihood, style, points));
    }
    panel.y.range = Some([0.0, if highest > 0.0 { 1.08 * highest } else { 1.0 / total.max(1e-3) }]);
    let disks = bases[1..bases.len().max(2) - 1].iter();
    panel.verticals.extend(disks.map(|&x| Vertical { name: "end disk", x, role: Role::Aside }));
    let pressed = run.plan.path().at(time, &run.plan.bends(time)).active;
    for place in pressed {
        let contact = &run.plan.scenario().contacts[place];
        let x = bases[contact.segment] + contact.at;
        panel.verticals.push(Vertical { name: "true contact", x, role: Role::Contact });
    }
    panel
}

/// Arc lengths of the segments' bases from that of the chain, and of the last end disk, m.
#[must_use]
pub fn bases(run: &ChainRun) -> Vec<f64> {
    let mut bases = vec![0.0];
    for segment in &run.plan.scenario().segments {
        bases.push(bases[bases.len() - 1] + segment.alone.scenario().robot.length);
    }
    bases
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::ChainPlan;
    use crate::scenario::preset::{CHAINS, find_chain};

    fn run(name: &str) -> ChainRun {
        let scenario = find_chain(name).expect("a preset").chain(&[]).expect("possible");
        ChainRun::new(ChainPlan::new(&scenario).expect("a shape"))
    }

    #[test]
    fn every_panel_of_every_preset_is_between_its_ends_and_has_its_events() {
        for preset in CHAINS {
            let run = run(preset.name);
            for shown in Shown::all(&run) {
                let ends = shown.range(&run);
                assert!(ends[0] < ends[1] || shown == Shown::Bend, "{}: {shown:?} {ends:?}", preset.name);
                for segment in 0..run.recording.segments() {
                    let panel = shown.panel(&run, segment, ends);
                    let drawn = panel.series.iter().filter(|series| series.role == Role::Detection);
                    let marks: usize = drawn.map(|series| series.points.len()).sum();
                    let own = run
                        .judged
                        .events
                        .iter()
                        .filter(|event| event.segment == segment && Some(event.detector) == shown.detector());
                    assert_eq!(marks, own.count(), "{}: {shown:?} on {segment}", preset.name);
                }
            }
        }
    }

    #[test]
    fn a_contact_that_comes_off_has_two_spans() {
        let run = run("reopened");
        let spans: Vec<usize> = (0..3).map(|segment| held(&run, segment).len()).collect();
        assert!(spans.iter().any(|&spans| spans > 0), "{spans:?}");
        let opened = run.plan.path().happened().iter().any(|event| matches!(event.what, What::Opened(_)));
        assert!(opened && (0..3).flat_map(|segment| held(&run, segment)).any(|[_, to]| to < end(&run)));
    }

    #[test]
    fn densities_along_the_backbone_add_up_to_what_touches() {
        let run = run("two-contacts");
        let found = run.judged.contacts(run.judged.teller().expect("it judges"), &[0.5]);
        let estimate = &found[0].estimates[0];
        let panel = along(&run, &[(0, estimate)], 6.0);
        let points = &panel.series[0].points;
        let area: f64 = points
            .windows(2)
            .map(|two| 0.5 * (two[0][1] + two[1][1]) * (two[1][0] - two[0][0]))
            .filter(|area| area.is_finite())
            .sum();
        assert!((area + estimate.nothing - 1.0).abs() < 0.02, "{area}");
        assert_eq!(panel.verticals.iter().filter(|line| line.name == "true contact").count(), 1);
        assert_eq!(panel.verticals.iter().filter(|line| line.name == "end disk").count(), 2);
    }
}
