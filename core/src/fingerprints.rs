//! One hash for each thing that the program computes: the net that tells whether a change moved a number.
//!
//! Natively and in the page the hashes are those of `tests/data/fingerprints.json`. Words are left out, numbers are all in.

use crate::chart::Chart;
use crate::run::{Run, simulate};
use crate::scenario::overrides::whole;
use crate::scenario::preset::{CHAINS, PRESETS, find};
use crate::scenario::{ChainPlan, Scenario, ScenarioError};
use crate::study::Job;
use crate::study::chain::ChainRun;
use crate::study::figure::{FigureJob, Number};
use crate::study::map::MapJob;
use crate::study::table2::Table2Job;
use crate::study::tuning::watch::Rule;
use crate::study::tuning::{Spec, Study};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::error::Error;

/// The name of each thing and its hash, 16 hexadecimal digits.
pub type Fingerprints = BTreeMap<String, String>;

/// Contacts on several segments are placed so long after their alarms, s.
const PLACED: [f64; 1] = [0.25];

/// Runs every preset of one segment and of several, makes every figure, Table II (5 repeats), the map (20 × 20) and a study (50 repeats of
/// three filters), and hashes what comes of them.
///
/// # Errors
/// When a preset of the program is impossible, which a test would have shown.
pub fn fingerprints() -> Result<Fingerprints, Box<dyn Error>> {
    let mut all = Fingerprints::new();
    let mut add = |name: String, hash: u64| {
        all.insert(name, format!("{hash:016x}"));
    };
    for preset in PRESETS {
        let run = simulate(&preset.scenario()?)?;
        add(format!("run {}", preset.name), run.fingerprint());
        add(format!("verdict {}", preset.name), hash(&verdict(&run)));
        add(format!("events {}", preset.name), hash(&events(&run)));
    }
    for preset in CHAINS {
        let scenario = preset.chain(&[])?;
        let run = ChainRun::new(ChainPlan::new(&scenario)?);
        add(format!("chain {}", preset.name), hash(&json!(run.report(None, &PLACED))));
    }
    for number in Number::ALL {
        let mut job = FigureJob::new(number, &find(number.preset())?.scenario()?)?;
        job.finish();
        add(format!("figure {number}"), hash(&figure(&job.chart())));
    }
    let noisy = noisy()?;
    let mut job = Table2Job::new(&noisy, 5)?;
    job.finish();
    let table = job.table();
    let own = json!({ "paper": table.paper, "simulated": table.simulated });
    add("table2".into(), hash(&json!({ "table": own, "rows": job.rows() })));
    add("table2 other".into(), hash(&json!({ "table": table.other, "rows": job.other_rows() })));
    let mut job = MapJob::new(&noisy, 20, 20)?;
    job.finish();
    let map = job.map();
    let cells = json!([map.arc_lengths, map.bends, map.deviation, map.epsilon]);
    add("map".into(), hash(&cells));
    let cells = [200, 400, 600].into_iter().map(|length| Ok(vec![whole("filter.length", length)?]));
    let cells = cells.collect::<Result<_, ScenarioError>>()?;
    let mut study = Study::new(Spec { cells, ..Spec::of(noisy, 50) })?;
    study.finish();
    let points = |cell| Rule::ALL.iter().map(|&rule| (rule.name(), study.curve(cell, rule))).collect::<Vec<_>>();
    let curves: Vec<Value> = (0..study.cells().len()).map(|cell| json!(points(cell))).collect();
    add("study".into(), hash(&json!(curves)));
    Ok(all)
}

/// `bench`, with all noise that there is.
fn noisy() -> Result<Scenario, ScenarioError> {
    let mut draft = find("bench")?.draft()?;
    draft.set("load_cells.noise=0.3")?;
    draft.set("load_cells.errors=independent")?;
    draft.finish()
}

fn verdict(run: &Run) -> Value {
    json!([run.crossings(), run.detection(), run.contact_time()])
}

/// Events, each with the place of its contact, which JSON leaves out otherwise.
fn events(run: &Run) -> Value {
    let events: Vec<Value> = run.events().iter().map(|event| json!([event, event.detection])).collect();
    json!(events)
}

fn figure(chart: &Chart) -> Value {
    // A figure of the paper has one panel.
    let Some(panel) = chart.panels.first() else { return Value::Null };
    let series: Vec<Value> = panel.series.iter().map(|series| json!(series.points)).collect();
    let verticals: Vec<f64> = panel.verticals.iter().map(|vertical| vertical.x).collect();
    let spans: Vec<Value> = panel.spans.iter().map(|span| json!(span.ends)).collect();
    json!([panel.x.range, panel.y.range, series, verticals, spans])
}

/// FNV-1a over the JSON text, in which every number has the digits that give its bits back.
fn hash(value: &Value) -> u64 {
    let byte = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    value.to_string().as_bytes().iter().fold(0xcbf2_9ce4_8422_2325, byte)
}
