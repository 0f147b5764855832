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
    a_study_has_the_commands_numbers(&mut Page::open(Renderer::WebGl, "?test", Options::default()));
}

#[track_caller]
pub fn a_study_has_the_commands_numbers(page: &mut Page) {
    open(page);
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

/// Waits until the study has come further, and says whether a worker makes it.
#[track_caller]
fn goes_on(page: &mut Page) -> bool {
    let before = tuning(page).expect("a study");
    let now = page
        .wait("the study to go on", |page| tuning(page).filter(|now| now["done"].as_f64() > before["done"].as_f64()));
    now["helper"] == true
}

#[test]
fn a_worker_that_answers_nonsense_is_replaced_once_and_then_done_without() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    open(&mut page);
    page.click("RadioButton", "1000");
    let nonsense = "centrode.study_answered(new Uint8Array([255, 255, 255, 255, 255, 255]))";
    page.eval(nonsense);
    page.frames();
    assert!(goes_on(&mut page), "another takes its place");
    page.eval(nonsense);
    page.wait("the page's own study", |page| tuning(page).filter(|tuning| tuning["helper"] == false));
    assert!(!goes_on(&mut page));
    page.wait("words about it", |page| {
        let mut said = page.widgets().into_iter().map(|widget| widget.label + &widget.value);
        said.find(|said| said.contains("The worker failed (its answer cannot be read"))
    });
    assert_eq!(page.problems(), Vec::<String>::new());
}

/// Workers that make studies: the first `COUNT` of them do as `ILL` says with a request, and the page looks more often whether they are silent.
const ILL: &str = "{ const [Real, tick] = [Worker, setInterval]; let [ill, quick] = [COUNT, false]; \
    globalThis.setInterval = (call, time, ...rest) => tick(call, quick && time === 5000 ? 100 : time, ...rest); \
    globalThis.Worker = function (address, options) { \
      const made = new Real(address, options); \
      if (!/[/]worker[.]js$/.test(address)) return made; \
      quick = ill > 0; \
      if (!quick) return made; \
      ill -= 1; \
      const post = made.postMessage.bind(made); \
      made.postMessage = (message, ...rest) => 'request' in message && message.request ? (ILL) : post(message, ...rest); \
      return made; }; }";

/// The page with a study, whose first `count` workers are ill.
#[track_caller]
fn with_ill_workers(count: usize, ill: &str) -> Page {
    let mut page = Page::visit(Renderer::WebGl, "?test", Options::default());
    page.before_scripts(&ILL.replace("COUNT", &count.to_string()).replace("ILL", ill));
    again(&mut page);
    open(&mut page);
    page
}

#[test]
fn a_worker_that_hangs_or_dies_is_replaced_once_and_then_done_without() {
    for ill in ["0", "made.onerror(new ErrorEvent('error', { message: 'it died' }))"] {
        for (count, helped) in [(1, true), (2, false)] {
            let mut page = with_ill_workers(count, ill);
            assert_eq!(goes_on(&mut page), helped, "{count} workers that do {ill:?}");
            assert_eq!(page.problems(), Vec::<String>::new());
        }
    }
}
