//! The map as a chart: one panel for each method, with the line that its setting draws, and the contact that is set.

use super::ContactMap;
use super::contour::contour;
use crate::chart::notation::number;
use crate::chart::ticks::Steps;
use crate::chart::{self, Axis, Chart, Panel, Role, Rung, Series, Style};
use crate::scenario::plan::PlannedContact;
use crate::scenario::{Plan, Scenario};
use crate::study::figure::words;

/// Errors are shown in colour up to this: load cells are not worse.
pub const MOST: f64 = 0.5;

/// A threshold that a map shows for every contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// [`ContactMap::deviation`]: the largest ξ2 that finds the contact.
    Centrode,
    /// [`ContactMap::epsilon`]: the largest ε_τ at which joint forces show it.
    Forces,
}

impl Kind {
    /// Both, in the order of their panels.
    pub const ALL: &[Self] = &[Self::Centrode, Self::Forces];

    /// What its panel shows, in a line.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Centrode => "Largest ξ_2 that finds the contact",
            Self::Forces => "Largest ε_τ at which joint forces show it",
        }
    }

    /// The symbol of its threshold.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Centrode => "ξ_2",
            Self::Forces => "ε_τ",
        }
    }

    /// Unit shown, and the number of units to one of SI.
    #[must_use]
    pub fn unit(self) -> (&'static str, f64) {
        match self {
            Self::Centrode => ("mm", words::MILLI),
            Self::Forces => ("%", 100.0),
        }
    }

    /// Its values, cell by cell, SI.
    #[must_use]
    pub fn values(self, map: &ContactMap) -> &[f64] {
        match self {
            Self::Centrode => &map.deviation,
            Self::Forces => &map.epsilon,
        }
    }

    /// The setting of a scenario, SI; none while switched off.
    #[must_use]
    pub fn setting(self, scenario: &Scenario) -> Option<f64> {
        match self {
            Self::Centrode => scenario.detection.xi2.value(),
            Self::Forces => Some(scenario.load_cells.epsilon_tau),
        }
    }
}

/// The chart of a map of the plan's motion; line and contact are the plan's own.
#[must_use]
pub fn chart(map: &ContactMap, plan: &Plan) -> Chart {
    let mut chart = without_contact(map, plan);
    chart.panels.iter_mut().for_each(|panel| panel.series.extend(target(plan)));
    chart
}

/// The contact of a plan, in both panels.
#[must_use]
pub fn target(plan: &Plan) -> Option<Series> {
    let at = |contact: &PlannedContact| vec![[contact.bend, contact.arc_length]];
    plan.contact().map(|contact| Series::new("", Role::Detection, Style::Targets, at(contact)))
}

/// The same chart without the contact, which does not change the map.
#[must_use]
pub fn without_contact(map: &ContactMap, plan: &Plan) -> Chart {
    let scenario = plan.scenario();
    let detection = &scenario.detection;
    let made = words::caption(&[
        "without noise".into(),
        words::robot(scenario),
        words::motion(scenario),
        format!("N = {}", scenario.filter.length),
        format!("armed from {} s", words::plain(detection.armed_from)),
        format!("||ω_s|| above {} rad/s", words::plain(detection.min_speed)),
    ]);
    let meaning = "A contact below the line is missed. Joint forces show a contact when Θ exceeds ε_c whatever error within \
                   ±ε_τ the cells share; beyond 50 % the colour stays.";
    Chart {
        title: "Which contacts are detectable".into(),
        panels: Kind::ALL.iter().map(|&kind| panel(map, plan, kind)).collect(),
        caption: format!("{made}\n{meaning}"),
    }
}

/// Step between evenly spaced middles.
fn step(middles: &[f64]) -> f64 {
    match middles {
        [first, .., last] => (last - first) / (middles.len() - 1) as f64,
        _ => 0.0,
    }
}

/// Outer edges of evenly spaced cells with these middles.
fn edges(middles: &[f64]) -> [f64; 2] {
    let half = 0.5 * step(middles);
    [middles.first().map_or(0.0, |first| first - half), middles.last().map_or(1.0, |last| last + half)]
}

fn panel(map: &ContactMap, plan: &Plan, kind: Kind) -> Panel {
    let scenario = plan.scenario();
    let (unit, scale) = kind.unit();
    let values = kind.values(map);
    let largest = values.iter().copied().filter(|value| value.is_finite()).fold(0.0, f64::max).max(1e-12);
    let top = if kind == Kind::Forces { largest.min(MOST) } else { largest };
    let level = kind.setting(scenario);
    let steps = [step(&map.bends), step(&map.arc_lengths)];
    let first = [map.bends.first(), map.arc_lengths.first()].map(|first| first.copied().unwrap_or(0.0));
    let place = |[column, row]: [f64; 2]| [first[0] + column * steps[0], first[1] + row * steps[1]];
    let pieces = level.map(|level| contour(values, map.bends.len(), level)).unwrap_or_default();
    let line: Vec<_> = pieces.into_iter().map(|piece| piece.map(place)).collect();
    let note = level.map_or_else(String::new, |level| {
        let said = format!("{} = {} {unit}", kind.symbol(), number(level * scale, 1));
        if line.is_empty() { format!("{said}: no line here") } else { format!("line: {said}") }
    });
    let (x, y) = (edges(&map.bends), edges(&map.arc_lengths));
    let angle = Axis { steps: Steps::Degrees, ..Axis::new("Bend at contact", "rad", "°", words::angle().scale) };
    let rung = |(k, &y): (usize, &f64)| Rung { name: format!("disk {}", k + 1), y };
    Panel {
        title: kind.title().into(),
        note,
        map: Some(chart::Map {
            unit,
            scale,
            columns: map.bends.len(),
            values: values.to_vec(),
            faint: Vec::new(),
            x,
            y,
            ends: [0.0, top],
            level,
            line,
        }),
        rungs: scenario.robot.disks.iter().enumerate().map(rung).collect(),
        ..Panel::new(
            Axis { range: Some(x), ..angle },
            Axis { range: Some(y), ..Axis::new("s_c", "m", "mm", words::MILLI) },
        )
    }
}
