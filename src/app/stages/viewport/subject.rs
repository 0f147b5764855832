//! What the 3D view shows: a run of one segment, or of several.

use crate::app::charts::legend::{self, Entry, Form};
use crate::app::theme::Theme;
use crate::scene::palette::Palette;
use crate::scene::{Camera, Scene};
use crate::show::chain::{self, ChainOptions};
use crate::show::obstacle::only_touches;
use crate::show::track::Trace;
use crate::show::{ViewOptions, home_camera, view};
use centrode_core::detect::calibration::marginal::Estimate;
use centrode_core::detect::chain::ChainEstimate;
use centrode_core::run::Run;
use centrode_core::study::chain::ChainRun;

/// The ring around a fresh detection runs for this long, s of the run.
const PULSE: f64 = 0.9;

/// A run with what is known of it.
pub enum Subject<'a> {
    /// One segment.
    Single {
        /// Its run.
        run: &'a Run,
        /// The loci of it.
        trace: &'a Trace,
        /// Whether the shape by the paper's model is shown besides.
        frozen: bool,
        /// Where the calibration filter places the contact.
        placed: Option<&'a Estimate>,
    },
    /// Segments in series.
    Chain {
        /// Their run.
        run: &'a ChainRun,
        /// The segment that is chosen, from 0.
        chosen: usize,
        /// Where contacts are placed, one for each that was found.
        placed: Vec<&'a ChainEstimate>,
        /// When the last alarm was raised that the cursor has passed, s.
        alarm: Option<f64>,
    },
}

impl Subject<'_> {
    /// From where it is seen at first.
    pub(super) fn home(&self) -> Camera {
        match self {
            Self::Single { run, .. } => home_camera(run),
            Self::Chain { run, .. } => chain::home_camera(run),
        }
    }

    /// Which of the kept cameras is its own.
    pub(super) fn kind(&self) -> usize {
        match self {
            Self::Single { .. } => 0,
            Self::Chain { .. } => 1,
        }
    }

    /// What is set of it that its scene depends on, besides the run and the time: numbers that are others for other settings.
    pub(super) fn settings(&self) -> Vec<u64> {
        match self {
            Self::Single { frozen, placed, .. } => {
                let place = placed.map(|estimate| [estimate.place.mean, estimate.place.low, estimate.place.high]);
                std::iter::once(u64::from(*frozen)).chain(place.into_iter().flatten().map(f64::to_bits)).collect()
            }
            Self::Chain { chosen, placed, .. } => {
                let each = placed.iter().flat_map(|estimate| [estimate.time, estimate.along.mean].map(f64::to_bits));
                std::iter::once(*chosen as u64).chain(each).collect()
            }
        }
    }

    /// How far the ring around a detection has run at a time (s), 0..1.
    fn pulse(&self, time: f64) -> f32 {
        let alarm = match self {
            Self::Single { run, .. } => run.detection().map(|detection| detection.time),
            Self::Chain { alarm, .. } => *alarm,
        };
        let since = alarm.map_or(f64::INFINITY, |alarm| time - alarm);
        if (0.0..PULSE).contains(&since) { (since / PULSE) as f32 } else { 0.0 }
    }

    /// The scene at a time (s); `still` leaves out what moves for effect.
    pub(super) fn scene(&self, time: f64, palette: Palette, still: bool) -> Scene {
        let pulse = if still { 0.0 } else { self.pulse(time) };
        match self {
            Self::Single { run, trace, frozen, placed } => {
                view(run, trace, time, &ViewOptions { palette, pulse, frozen: *frozen, placed: *placed })
            }
            Self::Chain { run, chosen, placed, .. } => {
                chain::view(run, time, &ChainOptions { palette, pulse, chosen: *chosen, placed })
            }
        }
    }

    /// Whether a beam of it only touches, so that it can be held against a clamp; and whether it is.
    pub(super) fn compared(&self) -> Option<bool> {
        match self {
            Self::Single { run, frozen, .. } => only_touches(run).then_some(*frozen),
            Self::Chain { .. } => None,
        }
    }

    /// What the legend names: all that the run will show, so that it does not move during playback.
    pub(super) fn entries(&self, theme: &Theme, narrow: bool) -> Vec<Entry> {
        match self {
            Self::Single { run, frozen, .. } => single(run, *frozen, theme, narrow),
            Self::Chain { run, .. } => several(run, theme, narrow),
        }
    }
}

const fn entry(form: Form, color: egui::Color32, text: &'static str) -> Entry {
    Entry { form, color, text }
}

fn single(run: &Run, frozen: bool, theme: &Theme, narrow: bool) -> Vec<Entry> {
    let mut entries =
        vec![entry(Form::Triangle, theme.model, "c_m model"), entry(Form::Dot, theme.sensor, "c_s sensor")];
    if run.contact_time().is_some() {
        entries.insert(1, entry(Form::Circle, theme.constrained, "c_c constrained"));
    }
    if run.detection().is_some() {
        entries.push(entry(Form::Diamond, theme.detection, "estimate, Eq. 24"));
    }
    entries.extend(legend::placed(run, theme));
    entries.push(entry(Form::Axis, theme.dim, "screw axis"));
    if run.contact_time().is_some() {
        entries.push(entry(Form::Ghost, theme.model, "if unconstrained"));
        if only_touches(run) {
            entries.extend(frozen.then(|| entry(Form::Ghost, theme.constrained, "if clamped")));
            entries.push(entry(Form::Arrow, theme.force, "contact force"));
        }
    }
    if !narrow {
        entries.insert(0, entry(Form::Solid, theme.robot, "robot"));
        if run.plan.contact().is_some() {
            entries.insert(1, entry(Form::Beam, theme.obstacle, "beam"));
        }
    }
    entries
}

fn several(run: &ChainRun, theme: &Theme, narrow: bool) -> Vec<Entry> {
    let touches = !run.plan.path().happened().is_empty();
    let mut entries = Vec::new();
    // With a tracker on the last end disk alone, there are none unless they are compared.
    if !run.judged.segments.is_empty() || run.judged.tip_motions(0).is_some() {
        entries.push(entry(Form::Axis, theme.dim, "screw axis"));
    }
    if touches {
        entries.push(entry(Form::Ghost, theme.model, "if unconstrained"));
        entries.push(entry(Form::Arrow, theme.force, "contact force"));
    }
    if !run.judged.events.is_empty() {
        entries.push(entry(Form::Band, theme.constrained, "where the contact is"));
    }
    if !narrow {
        entries.insert(0, entry(Form::Solid, theme.robot, "robot"));
        if !run.plan.scenario().contacts.is_empty() {
            entries.insert(1, entry(Form::Beam, theme.obstacle, "beam"));
        }
    }
    entries
}
