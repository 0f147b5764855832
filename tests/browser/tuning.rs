//! The tuning study in the browser: beside the page in a worker, or between its frames, with the command's numbers.

use crate::harness::{Options, Page, Renderer};
use centrode_core::scenario::preset::PRESETS;
use serde_json::Value;
use std::process::Command;

/// Counts animation frames.
const WATCH: &str = "globalThis.frames_seen = 0; \
    { const ask = requestAnimationFrame.bind(globalThis); \
      globalThis.requestAnimationFrame = (call) => ask((now) => { call(now); frames_seen += 1; }); }";

/// The page with its frames counted from the start.
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

/// What the page says of the study on its stage.
pub fn tuning(page: &mut Page) -> Option<Value> {
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

/// Frames that the page shows while its study brings so many answers, each with more runs than the one before. The page says
/// in a frame what it has: a study that held its thread would be seen complete, or not at all.
fn frames_during(page: &mut Page, answers: usize) -> u64 {
    let frames = |page: &mut Page| page.eval("frames_seen").as_u64().expect("a count");
    let done = |page: &mut Page| tuning(page).and_then(|tuning| tuning["done"].as_f64());
    let first = frames(page);
    let mut before = done(page);
    for _ in 0..answers {
        before = Some(page.wait("more runs", |page| done(page).filter(|done| Some(*done) > before)));
    }
    frames(page) - first
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
    assert!(frames_during(&mut page, 5) >= 5);
    let during = tuning(&mut page).expect("a study");
    assert_eq!(during["helper"], true);
    assert!(during["done"].as_f64() < during["of"].as_f64(), "it ended before it was looked at: {during}");
    page.click("Button", "Stop");
    page.wait("the stop", |page| tuning(page).filter(|tuning| tuning["held"] == true));
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn without_a_worker_it_is_made_between_frames() {
    let mut page = watched("?test&worker=off");
    open(&mut page);
    assert!(frames_during(&mut page, 5) >= 5);
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
