//! A run of several segments over time as one chart: what each segment shows, the forces behind it, and how far the robot is from buckling.

use super::ChainRun;
use super::course::{Shown, end};
use crate::chart::{Axis, Chart, Panel, Role, Series, Style};
use crate::scenario::chain::Stands;
use crate::study::figure::words::{caption, millimetres, plain};

/// How curves of one panel differ besides their names.
const STYLES: [Style; 3] = [Style::Line, Style::LongDashed, Style::DashDotted];

/// The chart of a run: a panel for each segment with what tells of contacts there, one of the true forces, and, where they press
/// hard enough to tell, one of the stability margin.
#[must_use]
pub fn over_time(run: &ChainRun) -> Chart {
    let mut panels = Vec::new();
    if let Some(shown) = Shown::all(run).first() {
        let ends = shown.range(run);
        panels.extend(shown.segments(run).map(|segment| {
            let panel = shown.panel(run, segment, ends);
            Panel { title: format!("Segment {}: {}", segment + 1, panel.title), ..panel }
        }));
    }
    panels.extend(forces(run));
    panels.extend(margin(run));
    Chart { title: "What each segment shows of contacts".into(), panels, caption: made(run) }
}

/// An empty panel over the time of the run.
fn timed(run: &ChainRun, title: &str, y: Axis) -> Panel {
    let x = Axis { range: Some([0.0, end(run)]), ..Axis::new("Time", "s", "s", 1.0) };
    Panel { title: title.into(), verticals: super::course::given_way(run).collect(), ..Panel::new(x, y) }
}

/// The true forces of all contacts; none where there are none.
fn forces(run: &ChainRun) -> Option<Panel> {
    let truth = run.recording.truth.as_ref()?;
    let contacts = 0..run.plan.scenario().contacts.len();
    let largest = truth.iter().flat_map(|truth| &truth.forces).copied().fold(0.0, f64::max);
    let mut panel =
        timed(run, "True contact force", Axis { range: Some([0.0, 1.1 * largest]), ..Axis::new("F", "N", "N", 1.0) });
    panel.series.extend(contacts.map(|contact| {
        let points = run.recording.times.iter().zip(truth).map(|(time, truth)| [*time, truth.forces[contact]]);
        let style = STYLES[contact % STYLES.len()];
        Series::new(format!("contact {}", contact + 1), Role::Force, style, points.collect())
    }));
    (largest > 0.0).then_some(panel)
}

/// The stability margin, where it is worth showing.
fn margin(run: &ChainRun) -> Option<Panel> {
    let shown = Shown::all(run).contains(&Shown::Margin);
    let value = |(sample, time): (usize, &f64)| [*time, Shown::Margin.value(run, 0, sample)];
    let points = run.recording.times.iter().enumerate().map(value).collect();
    let y = Axis { range: Some([0.0, 1.05]), ..Axis::new("Stability margin", "1", "1", 1.0) };
    let mut panel = timed(run, "Stability margin, 0 where the robot buckles", y);
    panel.series.push(Series::new("margin", Role::Robot, Style::Line, points));
    shown.then_some(panel)
}

/// What the run was made with.
fn made(run: &ChainRun) -> String {
    let scenario = run.plan.scenario();
    let lengths: Vec<String> =
        scenario.segments.iter().map(|segment| millimetres(segment.alone.scenario().robot.length)).collect();
    let mut parts = vec![format!("segments of {}", lengths.join(", "))];
    for (place, contact) in scenario.contacts.iter().enumerate() {
        let since = match contact.stands {
            Stands::Always { .. } => "from the start".into(),
            Stands::From { time, .. } => format!("from {} s", plain(time)),
            Stands::Clamped { time } => format!("a clamp from {} s", plain(time)),
        };
        let at = millimetres(contact.at);
        parts.push(format!("contact {} on segment {}, {at} from its base, {since}", place + 1, contact.segment + 1));
    }
    let tracker = &scenario.common().tracker;
    let angle = plain(libm::rint(tracker.orientation_noise.to_degrees() * 1e4) / 1e4);
    parts.push(format!("tracker noise {}, {angle}°", millimetres(tracker.position_noise)));
    parts.push(format!("seed {}", scenario.common().seed));
    caption(&parts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::ChainPlan;
    use crate::scenario::preset::find_chain;

    fn chart(name: &str) -> Chart {
        let scenario = find_chain(name).expect("a preset").chain(&[]).expect("possible");
        over_time(&ChainRun::new(ChainPlan::new(&scenario).expect("a shape")))
    }

    fn titles(chart: &Chart) -> Vec<&str> {
        chart.panels.iter().map(|panel| panel.title.split(':').next().unwrap_or_default()).collect()
    }

    #[test]
    fn every_segment_has_a_panel_over_one_time() {
        let chart = chart("two-contacts");
        assert_eq!(titles(&chart), ["Segment 1", "Segment 2", "Segment 3", "True contact force"]);
        assert!(chart.panels.iter().all(|panel| panel.x == chart.panels[0].x));
        let forces = &chart.panels[3].series;
        assert!(forces.len() == 2 && forces.iter().all(|force| force.points.iter().any(|point| point[1] > 0.5)));
        assert!(chart.caption.contains("contact 2 on segment 3, 15 mm from its base, from 6.8 s"), "{}", chart.caption);
    }

    #[test]
    fn what_buckles_shows_its_margin() {
        let chart = chart("buckling");
        let last = chart.panels.last().expect("panels");
        assert!(last.title.starts_with("Stability margin"));
        let points = &last.series[0].points;
        assert!(points.first().is_some_and(|point| point[1] == 1.0));
        assert!(points.last().is_some_and(|point| point[1] < 0.2), "{:?}", points.last());
        assert!(last.verticals.iter().any(|line| line.name == "buckles"));
    }
}
