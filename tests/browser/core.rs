//! The page computes what the headless command computes, to the last bit, and shows it.

use crate::harness::{Area, Options, Page, Renderer};
use centrode_core::run::simulate;
use centrode_core::scenario::preset::PRESETS;
use std::process::Command;

/// Detection time (s) that `centrode run` gives for the preset on which the page opens, with overrides.
fn headless(sets: &[&str]) -> Option<f64> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    command.args(["run", "--json", "--preset", PRESETS[0].name]);
    for set in sets {
        command.args(["--set", set]);
    }
    let output = command.output().expect("the command starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    report["detection"]["time"].as_f64()
}

#[test]
fn every_preset_has_the_same_bits_as_natively() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    for preset in PRESETS {
        let native = simulate(&preset.scenario().expect(preset.name)).expect("valid").fingerprint();
        let script = format!("centrode.fingerprint({})", serde_json::json!(preset.toml));
        assert_eq!(page.eval(&script), format!("{native:016x}"), "{}", preset.name);
    }
    let refused = page.eval("centrode.fingerprint('[contact]\\ndisk = 9')");
    assert!(refused.as_str().is_some_and(|message| message.contains("contact.disk = 9")), "{refused}");
    // Every sample of such a run does not fit into memory.
    let refused = page.eval("centrode.fingerprint('[motion]\\nend = 90000')");
    assert!(refused.as_str().is_some_and(|message| message.contains("motion.end = 90000")), "{refused}");
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn everything_computed_has_the_stored_fingerprint() {
    the_stored_fingerprints_are_computed(&mut Page::open(Renderer::WebGl, "?test", Options::default()));
}

#[track_caller]
pub fn the_stored_fingerprints_are_computed(page: &mut Page) {
    let ours = page.eval("centrode.fingerprints()");
    let ours: serde_json::Value = serde_json::from_str(ours.as_str().expect("text")).expect("JSON");
    let stored: serde_json::Value =
        serde_json::from_str(include_str!("../data/fingerprints.json")).expect("stored fingerprints");
    assert_eq!(ours, stored);
}

#[test]
fn controls_give_what_the_headless_command_gives() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    assert_eq!(page.number("detectionTime"), headless(&[]), "as it opens");
    // A step sets an override and leaves the one before it.
    for (label, text, set) in [
        ("Contact disk", "3", "contact.disk=3"),
        ("Contact disk", "0", "contact.disk=0"),
        ("Contact disk", "2", "contact.disk=2"),
        ("Filter length N", "250", "filter.length=250"),
    ] {
        let wanted = headless(&[set]);
        page.type_number(label, text);
        page.wait(&format!("{set} to give {wanted:?}"), |page| (page.number("detectionTime") == wanted).then_some(()));
    }
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[track_caller]
pub fn dragging_the_contact_slider_moves_the_detection(page: &mut Page) {
    for (to, disk) in [(0.98, 3), (0.02, 0), (0.667, 2)] {
        page.drag("Slider", "Contact disk", 0.4, to);
        let wanted = headless(&[&format!("contact.disk={disk}")]);
        page.wait(&format!("disk {disk}"), |page| (page.number("detectionTime") == wanted).then_some(()));
    }
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn dragging_the_contact_slider_moves_the_detection_on_webgl() {
    dragging_the_contact_slider_moves_the_detection(&mut Page::open(Renderer::WebGl, "?test", Options::default()));
}

#[test]
fn dragging_the_contact_slider_moves_the_detection_on_webgpu() {
    dragging_the_contact_slider_moves_the_detection(&mut Page::open(Renderer::WebGpu, "?test", Options::default()));
}

/// Where the 3D view is in a picture of the window.
fn view(page: &mut Page) -> Area {
    let [x, y, w, h] = page.widget("Canvas", "3D view").bounds.expect("bounds");
    let window = page.picture();
    let (width, height) = (window.width as f64, window.height as f64);
    Area(x / width, y / height, (x + w) / width, (y + h) / height)
}

#[track_caller]
pub fn the_view_moves_with_playback(page: &mut Page) {
    let view = view(page);
    // While it plays, nothing but the robot and its signs moves in there.
    page.wait("the motion to begin", |page| page.number("time").filter(|&time| time < 4.5));
    let before = page.picture();
    assert!(before.colours(view) > 100, "a blank 3D view");
    page.wait("the robot to be bent", |page| page.number("time").filter(|time| (6.0..8.0).contains(time)));
    let moved = page.picture().changed(&before, view);
    assert!(moved > 2000, "only {moved} pixels of the 3D view changed during playback");
    // From the start to the end: the whole robot stands elsewhere.
    page.click("Button", "Pause");
    page.click("Button", "To start");
    page.wait("the start", |page| (page.number("time") == Some(0.0)).then_some(()));
    page.frames();
    let straight = page.picture();
    page.key("End");
    page.wait("the end", |page| page.number("time").filter(|&time| time > 9.0));
    page.frames();
    let moved = page.picture().changed(&straight, view);
    assert!(moved > 4000, "only {moved} pixels of the 3D view differ between start and end");
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn the_3d_view_moves_on_webgl() {
    the_view_moves_with_playback(&mut Page::open(Renderer::WebGl, "?test", Options::default()));
}

#[test]
fn the_3d_view_moves_on_webgpu() {
    the_view_moves_with_playback(&mut Page::open(Renderer::WebGpu, "?test", Options::default()));
}

/// A measurement, printed with `--nocapture`; that both compute the same is what it asserts.
#[test]
fn a_run_in_wasm_takes_this_long() {
    const RUNS: u32 = 40;
    let toml = PRESETS[0].toml;
    let scenario = PRESETS[0].scenario().expect("valid");
    let ours = || simulate(std::hint::black_box(&scenario)).expect("valid").fingerprint();
    let start = std::time::Instant::now();
    let natively = (0..RUNS).fold(None, |_, _| Some(ours())).map(|hash| format!("{hash:016x}"));
    let native = start.elapsed().as_secs_f64() * 1e3 / f64::from(RUNS);
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    let script = format!(
        "(() => {{ const toml = {}; centrode.fingerprint(toml); const start = performance.now(); \
         let hash; for (let i = 0; i < {RUNS}; i++) hash = centrode.fingerprint(toml); \
         return [(performance.now() - start) / {RUNS}, hash]; }})()",
        serde_json::json!(toml)
    );
    let told = page.eval(&script);
    let wasm = told[0].as_f64().expect("a time");
    assert_eq!(told[1].as_str(), natively.as_deref());
    println!("a run with its fingerprint: {wasm:.2} ms in wasm, {native:.2} ms in this build natively");
}
