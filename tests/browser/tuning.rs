//! The tuning study in the browser: beside the page in a worker, or between its frames, with the command's numbers.

use crate::harness::{Options, Page, Renderer};
use centrode_core::scenario::preset::PRESETS;
use serde_json::Value;
use std::process::Command;

/// Times every animation frame: when it came, and how long the page's own work in it took, ms.
const WATCH: &str = "globalThis.watched = []; \
    { const ask = requestAnimationFrame.bind(globalThis); \
      globalThis.requestAnimationFrame = (call) => ask((now) => { \
        const start = performance.now(); call(now); watched.push([start, performance.now() - start]); }); }";

/// The page with its frames watched from the start.
fn watched(query: &str) -> Page {
    let mut page = Page::visit(Renderer::WebGl, query, Options::default());
    page.before_scripts(WATCH);
    again(&mut page);
    page
}

/// Loads the page again and waits for its picture.
fn again(page: &mut Page) {
    let address = page.eval("location.href");
    page.go(address.as_str().expect("an address"));
    page.wait("the page", |page| page.data("ready").filter(|ready| ready == "true"));
}

fn tuning(page: &mut Page) -> Option<Value> {
    page.data("tuning").and_then(|text| serde_json::from_str(&text).ok()).map(plain)
}

/// With every number a float: JavaScript writes 1.0 as 1.
fn plain(value: Value) -> Value {
    match value {
        Value::Number(number) => number.as_f64().into(),
        Value::Array(list) => list.into_iter().map(plain).collect(),
        Value::Object(map) => map.into_iter().map(|(key, value)| (key, plain(value))).collect(),
        other => other,
    }
}

fn open(page: &mut Page) {
    page.click("Tab", "Tuning");
    page.wait("the study to begin", |page| tuning(page).filter(|tuning| tuning["done"].as_f64() > Some(0.0)));
}

/// What `centrode study` gives for the thresholds of the preset on which the page opens.
fn headless(repeats: &str, sets: &[&str]) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    command.args(["study", "--json", "--preset", PRESETS[0].name, "--repeats", repeats]);
    for set in sets {
        command.args(["--set", set]);
    }
    let output = command.output().expect("the command starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    plain(report["cells"][0]["own"].clone())
}

/// Median, 90 % and largest of the gaps between frames, and of the page's own work in them, ms, over some frames.
fn frames(page: &mut Page, count: usize) -> [[f64; 3]; 2] {
    page.eval("watched.length = 0");
    page.wait("frames", |page| page.eval("watched.length").as_u64().filter(|&seen| seen > count as u64));
    let watched: Vec<[f64; 2]> = serde_json::from_value(page.eval("watched")).expect("pairs");
    let statistics = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        [0.5, 0.9, 1.0].map(|share| values[((values.len() - 1) as f64 * share) as usize])
    };
    let gaps = watched.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
    [statistics(gaps), statistics(watched.iter().map(|[_, work]| *work).collect())]
}

#[test]
fn a_study_in_the_worker_has_the_commands_numbers() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    open(&mut page);
    let done = |page: &mut Page| tuning(page).filter(|tuning| tuning["done"] == tuning["of"]);
    let all = page.wait("the study to end", done);
    assert_eq!(all["helper"], true);
    assert_eq!(all["own"], headless("100", &[])["fcd"]);
    // Another setting of the tracker starts it again.
    page.type_number("Position noise", "0.1");
    let set = "tracker.position_noise=0.0001";
    let expected = headless("100", &[set]);
    page.wait("the study to begin again", |page| tuning(page).filter(|tuning| tuning["done"] != tuning["of"]));
    let all = page.wait("the second study to end", done);
    assert_eq!(all["own"], expected["fcd"]);
    // Another method needs no run.
    page.click("RadioButton", "Either");
    page.wait("the other method", |page| tuning(page).filter(|tuning| tuning["own"] == expected["or"]));
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn frames_keep_coming_while_the_worker_works() {
    let mut page = watched("?test");
    open(&mut page);
    page.click("RadioButton", "1000");
    page.wait("the large study", |page| tuning(page).filter(|tuning| tuning["of"].as_f64() > Some(10_000.0)));
    let [gaps, work] = frames(&mut page, 30);
    let during = tuning(&mut page).expect("a study");
    assert!(during["done"].as_f64() < during["of"].as_f64(), "it ended before it was measured: {during}");
    page.click("Button", "Stop");
    page.wait("the stop", |page| tuning(page).filter(|tuning| tuning["held"] == true));
    let [quiet_gaps, quiet_work] = frames(&mut page, 30);
    println!(
        "median, 90 % and largest, ms: gaps {gaps:.0?} (without a study {quiet_gaps:.0?}), work in a frame {work:.1?} (without {quiet_work:.1?})"
    );
    // The whole study holds a thread for more than half a minute: on the page's it would show as such a gap.
    assert!(gaps[2] < 2000.0, "{gaps:?}");
    assert!(work[1] < 2.0 * quiet_work[1] + 16.0, "{work:?} {quiet_work:?}");
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn without_a_worker_it_is_made_between_frames() {
    let mut page = watched("?test&worker=off");
    open(&mut page);
    let [gaps, work] = frames(&mut page, 12);
    println!("median, 90 % and largest, ms: gaps {gaps:.0?}, work in a frame {work:.1?}");
    assert!(gaps[2] < 2000.0, "{gaps:?}");
    // The cell that is set is made first.
    let begun =
        page.wait("its first cell", |page| tuning(page).filter(|tuning| tuning["done"].as_f64() >= Some(200.0)));
    assert_eq!(begun["helper"], false);
    assert_eq!(begun["own"], headless("100", &[])["fcd"]);
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn a_worker_that_cannot_load_is_done_without() {
    let mut page = Page::visit(Renderer::WebGl, "?test", Options::default());
    page.block("worker.js", 404);
    again(&mut page);
    open(&mut page);
    let without = page.wait("the study", |page| tuning(page).filter(|tuning| tuning["done"].as_f64() > Some(20.0)));
    assert_eq!(without["helper"], false);
}

#[test]
fn a_worker_that_answers_nonsense_is_done_without() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    open(&mut page);
    page.click("RadioButton", "1000");
    page.eval("centrode.study_answered(new Uint8Array([255, 255, 255, 255, 255, 255]))");
    let without = page.wait("the page's own study", |page| tuning(page).filter(|tuning| tuning["helper"] == false));
    page.wait("the study to go on", |page| tuning(page).filter(|now| now["done"].as_f64() > without["done"].as_f64()));
    page.wait("words about it", |page| {
        let mut said = page.widgets().into_iter().map(|widget| widget.label + &widget.value);
        said.find(|said| said.contains("The worker failed (its answer cannot be read"))
    });
    assert_eq!(page.problems(), Vec::<String>::new());
}
