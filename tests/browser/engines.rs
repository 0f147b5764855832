//! What must hold in each engine, on whatever it draws with. A row of tests runs in one browser: it is the start that costs.
//!
//! `CENTRODE_CHECK=storm` makes those alone whose name has this in it. What came of each row goes to the folder `CENTRODE_ROWS`, of
//! which `cargo xtask test browser` makes a table.

use crate::harness::host::{Host, built, heard};
use crate::harness::{Engine, Options, Page, Renderer};
use crate::{core, failures, links, lost, start, storm, tuning};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// A check, what the page is opened with, and what is done then.
type Check = (&'static str, &'static str, fn(&mut Page));

/// The first opens a page that nobody has opened before.
const CHECKS: [Check; 9] = [
    ("pictures change as it plays", "?test", core::the_view_moves_with_playback),
    ("a slider moves the detection to the command's", "?test", core::dragging_the_contact_slider_moves_the_detection),
    ("the worker's study is the command's", "?test", tuning::a_study_has_the_commands_numbers),
    ("a link is replayed to the same bits", "?test", links::a_link_is_replayed_to_the_last_bit),
    ("files are opened and saved", links::BENCH, links::files_are_opened_and_saved),
    ("a storm of input is weathered", "?test", storm::a_storm_of_input),
    ("lost graphics come back", lost::STATE, lost::lost_graphics_come_back),
    ("a panic keeps what is set", lost::STATE, failures::a_panic_keeps_what_is_set),
    ("everything computed has the stored bits", "?test", core::the_stored_fingerprints_are_computed),
];

/// A browser of an engine: Chromium where none is named.
fn browser(engine: Option<Engine>, renderer: Renderer) -> Page {
    match engine {
        Some(engine) => Page::driven(engine, renderer),
        None => Page::blank(renderer, Options::default()),
    }
}

/// Opens the page in a running browser and waits until it is ready.
#[track_caller]
fn open(page: &mut Page, host: &Host, query: &str) {
    // Another fragment alone would load nothing.
    page.browse("about:blank");
    page.go(&format!("{}{query}", host.address));
    page.wait("the page to be ready", |page| match page.shown().as_str() {
        "running" => (page.data("ready").as_deref() == Some("true")).then_some(()),
        "loading" => None,
        other => panic!("the page shows {other:?}: {}", page.text(&format!("#{other}"))),
    });
}

/// It starts on the renderer that is meant, and asks for each part once.
#[track_caller]
fn starts(page: &mut Page, host: &Host, renderer: Renderer) {
    open(page, host, "?test");
    start::draws_and_moves(page, if renderer == Renderer::WebGpu { "webgpu" } else { "webgl" });
    for part in ["index.html", "centrode_bg.wasm", "/centrode.js", "loader.js"] {
        assert_eq!(host.asked(part), 1, "{part}");
    }
}

/// Makes a row: all of its checks, whatever becomes of those before.
#[track_caller]
fn row(engine: Option<Engine>, renderer: Renderer) {
    let start = Instant::now();
    let host = Host::of(heard(built()));
    let mut page = browser(engine, renderer);
    let mut failed = Vec::new();
    let mut check = |name: &'static str, made: &mut dyn FnMut(&mut Page)| {
        let start = Instant::now();
        let passed = catch_unwind(AssertUnwindSafe(|| made(&mut page))).is_ok();
        let (word, seconds) = (if passed { "ok" } else { "FAILED" }, start.elapsed().as_secs());
        println!("{} {renderer:?}: {name}: {word}, {seconds} s", name_of(engine));
        if !passed {
            failed.push(name);
        }
    };
    if renderer == Renderer::Neither {
        check("it says what to do without a GPU", &mut |page| {
            page.go(&format!("{}?test", host.address));
            failures::it_says_what_to_do_without_a_gpu(page);
        });
    } else {
        check("the page starts", &mut |page| starts(page, &host, renderer));
        let wanted = std::env::var("CENTRODE_CHECK").unwrap_or_default();
        for (name, query, made) in CHECKS.into_iter().filter(|(name, ..)| name.contains(&wanted)) {
            check(name, &mut |page| {
                open(page, &host, query);
                made(page);
            });
        }
    }
    let result = if failed.is_empty() { "ok".to_owned() } else { format!("FAILED: {}", failed.join("; ")) };
    note(engine, renderer, &format!("{result}\t{:.0} s", start.elapsed().as_secs_f64()));
    assert!(failed.is_empty(), "{failed:?}");
}

fn name_of(engine: Option<Engine>) -> String {
    engine.map_or("Chromium".to_owned(), |engine| format!("{engine:?}"))
}

/// Keeps what came of a row.
fn note(engine: Option<Engine>, renderer: Renderer, result: &str) {
    let Some(folder) = std::env::var_os("CENTRODE_ROWS") else { return };
    let file = std::path::PathBuf::from(folder).join(format!("{} {renderer:?}", name_of(engine)));
    std::fs::write(file, result).expect("the row is kept");
}

#[test]
fn chromium_on_webgl() {
    row(None, Renderer::WebGl);
}

#[test]
fn chromium_on_webgpu() {
    row(None, Renderer::WebGpu);
}

#[test]
fn chromium_on_neither() {
    row(None, Renderer::Neither);
}

#[test]
fn firefox_on_webgl() {
    row(Some(Engine::Firefox), Renderer::WebGl);
}

#[test]
fn firefox_on_webgpu() {
    row(Some(Engine::Firefox), Renderer::WebGpu);
}

#[test]
fn firefox_on_neither() {
    row(Some(Engine::Firefox), Renderer::Neither);
}

#[test]
fn webkit_on_webgl() {
    row(Some(Engine::WebKit), Renderer::WebGl);
}

#[test]
fn webkit_on_neither() {
    row(Some(Engine::WebKit), Renderer::Neither);
}
