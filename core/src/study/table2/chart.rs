//! Every estimate behind Table II against the true place, as a chart: a lane for each disk.

use super::{Disk, Outcome, Row, Table2, paper_rows};
use crate::chart::{Axis, Chart, Intervals, Panel, Role, Series, Style};
use crate::scenario::Scenario;
use crate::scenario::link::Page;
use crate::study::export::origin;
use crate::study::figure::words::{self, MILLI};

/// Where the estimates of each source stand in a lane, and their means, from its middle and in its heights.
const MARKS: [f64; 3] = [-0.26, 0.02, 0.30];
const MEANS: [f64; 3] = [-0.38, -0.10, 0.18];
/// How far the marks of a source spread over the lane.
const SPREAD: f64 = 0.16;
/// Half the height of the stroke at the true place.
const TRUTH: f64 = 0.44;

/// Where an estimate comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// The paper's row.
    Paper,
    /// An experiment with the scenario's kind of contact.
    Simulated,
    /// One with the other kind.
    Other,
}

impl Source {
    /// In the order in which they stand in a lane.
    pub const ALL: [Self; 3] = [Self::Paper, Self::Simulated, Self::Other];

    /// What it is called beside the others.
    #[must_use]
    pub fn name(self, table: &Table2) -> String {
        match self {
            Self::Paper => "paper".into(),
            Self::Simulated => format!("simulated, {}", table.kind.name()),
            Self::Other => format!("simulated, {}", table.other_kind.name()),
        }
    }
}

/// One estimate, where it stands in the chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The disk in contact, counted from 1 at the base.
    pub disk: u64,
    /// Where it comes from.
    pub source: Source,
    /// Which of those found on this disk it is, from 1.
    pub place: usize,
    /// Estimated arc length (m), and place in the lanes.
    pub at: [f64; 2],
}

/// The estimates of all contacts found: the paper's, then the simulated `rows` of the scenario's kind of contact and of the other.
#[must_use]
pub fn estimates(table: &Table2, [own, other]: [&[Row]; 2]) -> Vec<Estimate> {
    let paper = paper_rows();
    let found = |row: &&Row| row.outcome == Outcome::Found && row.location.is_finite();
    let mut all = Vec::new();
    for ((source, rows), middle) in Source::ALL.into_iter().zip([&paper[..], own, other]).zip(MARKS) {
        for (lane, truth) in table.simulated.iter().enumerate() {
            let here = rows.iter().filter(|row| row.disk == truth.disk).filter(found);
            all.extend(here.enumerate().map(|(k, row)| {
                // Equal ones would hide each other: they stand a little apart.
                let apart = ((k * 3) % 5) as f64 / 4.0 - 0.5;
                let y = lane as f64 + middle + SPREAD * apart;
                Estimate { disk: truth.disk, source, place: k + 1, at: [row.location, y] }
            }));
        }
    }
    all
}

/// The chart of some estimates of [`estimates`], with mean and scatter over each disk.
#[must_use]
pub fn chart(table: &Table2, estimates: &[Estimate]) -> Chart {
    let names = table.simulated.iter().map(|disk| format!("Disk {}", disk.disk));
    let x = Axis::new("Distance from the base", "m", "mm", MILLI);
    let mut panel =
        Panel { title: "Each estimate against the truth".into(), ..Panel::new(x, Axis::categories("", names, true)) };
    let mut truths: Vec<[f64; 2]> = Vec::new();
    for (lane, disk) in table.simulated.iter().enumerate() {
        let y = lane as f64;
        truths.extend([[disk.arc_length, y - TRUTH], [disk.arc_length, y + TRUTH], [f64::NAN; 2]]);
    }
    panel.series.push(Series::new("true place of the disk", Role::Contact, Style::Heavy, truths));
    for (source, style) in Source::ALL.into_iter().zip([Style::Diamonds, Style::Dots, Style::Triangles]) {
        let points = estimates.iter().filter(|estimate| estimate.source == source).map(|estimate| estimate.at);
        let series = Series::new(source.name(table), Role::Detection, style, points.collect());
        panel.series.push(Series { every: true, ..series });
    }
    let mean = |(lane, disk): (usize, &Disk), lift: f64| {
        let at = |location: f64| [location, lane as f64 + lift];
        let value = disk.location;
        [at(value.mean - value.deviation), at(value.mean), at(value.mean + value.deviation)]
    };
    let means = [&table.paper, &table.simulated, &table.other].into_iter().zip(MEANS);
    let ends = means.flat_map(|(disks, lift)| disks.iter().enumerate().map(move |disk| mean(disk, lift)));
    let name = "mean ± standard deviation".into();
    panel.intervals.push(Intervals { name, role: Role::Bound, ends: ends.collect() });
    Chart { title: "Estimated places of contact".into(), panels: vec![panel], caption: String::new() }
}

/// The same for a file, with what it was made with: `repeats` experiments of a scenario on each disk.
#[must_use]
pub fn with_words(table: &Table2, rows: [&[Row]; 2], (scenario, repeats): (&Scenario, usize)) -> Chart {
    let caption = format!("The paper's estimates are the rows of its Table II. {}", simulated(scenario, repeats));
    Chart { caption, ..chart(table, &estimates(table, rows)) }
}

/// What made the tables, in lines, the last of which is the link.
#[must_use]
pub fn made(scenario: &Scenario, repeats: usize) -> String {
    let link = origin(scenario, Page::of("table2"));
    format!("Table II: the rows that the paper prints.\n{}\n{link}", simulated(scenario, repeats))
}

fn simulated(scenario: &Scenario, repeats: usize) -> String {
    let made = [
        words::robot(scenario),
        words::motion(scenario),
        words::tracker(scenario),
        words::detection(scenario),
        words::seed(scenario, repeats),
    ];
    let made = made.join("; ");
    format!("Simulated by Centrode, with contact as in the presets disk-1, bench and disk-3: {made}.")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Job;
    use crate::study::table2::Table2Job;

    #[test]
    fn every_contact_found_is_a_mark_in_the_lane_of_its_disk() {
        let mut job = Table2Job::new(&Scenario::default(), 2).expect("possible");
        job.finish();
        let (table, rows) = (job.table(), [job.rows(), job.other_rows()]);
        let all = estimates(&table, rows);
        let found =
            table.paper.iter().chain(&table.simulated).chain(&table.other).map(|disk| disk.found).sum::<usize>();
        assert!(found > 15 && all.len() == found, "{} of {found}", all.len());
        assert!(all.iter().all(|estimate| (estimate.at[1] - (estimate.disk - 1) as f64).abs() < 0.5));
        let panel = &chart(&table, &all).panels[0];
        assert_eq!(panel.series[1..].iter().map(|series| series.points.len()).sum::<usize>(), found);
        let mean = panel.intervals[0].ends[1];
        assert_eq!(mean[1][0], table.paper[1].location.mean);
        assert_eq!(mean[2][0] - mean[1][0], mean[1][0] - mean[0][0]);
    }

    #[test]
    fn a_table_without_experiments_still_has_its_lanes_and_the_paper() {
        let job = Table2Job::new(&Scenario::default(), 2).expect("possible");
        let all = estimates(&job.table(), [&[]; 2]);
        assert_eq!(all.len(), 15);
        let panel = &chart(&job.table(), &all).panels[0];
        assert!(panel.series[2].points.is_empty() && panel.y.ticks.len() == 3);
    }
}
