//! The state in the address: opened, followed, gone back in, reloaded, and replayed by the command to the last bit.

use crate::harness::{Options, Page, Renderer};
use crate::saving::{LOOK, saved};
use centrode_core::run::simulate;
use centrode_core::scenario::link::Link;
use serde_json::{Value, json};
use std::process::Command;

/// The fragment of the page's address.
fn fragment(page: &mut Page) -> String {
    let address = page.eval("location.href");
    address.as_str().and_then(|address| address.split_once('#')).map_or(String::new(), |(_, link)| link.into())
}

#[track_caller]
fn wait_for_fragment(page: &mut Page, part: &str) -> String {
    page.wait(&format!("{part} in the address"), |page| Some(fragment(page)).filter(|link| link.contains(part)))
}

#[track_caller]
fn wait_for_disk(page: &mut Page, disk: f64) {
    page.wait(&format!("disk {disk}"), |page| {
        (page.widget("Slider", "Contact disk").number == Some(disk)).then_some(())
    });
}

/// What `centrode run --link` reports.
fn replayed(link: &str) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    let output = command.args(["run", "--json", "--link", link]).output().expect("the command starts");
    assert!(output.status.success(), "{link}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn the_address_follows_and_is_replayed_to_the_last_bit() {
    a_link_is_replayed_to_the_last_bit(&mut Page::open(Renderer::WebGl, "?test", Options::default()));
}

#[track_caller]
pub fn a_link_is_replayed_to_the_last_bit(page: &mut Page) {
    assert_eq!(fragment(page), "", "nothing is set yet");
    page.type_number("Contact disk", "3");
    page.type_number("Seed", "7");
    let link = wait_for_fragment(page, "seed=7");
    assert!(link.contains("contact.disk=3"), "{link}");
    let address = page.eval("location.href");
    let address = address.as_str().expect("an address");
    let report = replayed(address);
    assert_eq!(page.number("detectionTime"), report["detection"]["time"].as_f64());
    assert_eq!((&report["scenario"]["seed"], &report["scenario"]["contact"]["disk"]), (&json!(7), &json!(3)));
    let native = simulate(Link::read(address).0.scenario()).expect("a run").fingerprint();
    let linked = page.eval(&format!("centrode.link_fingerprint({})", json!(address)));
    assert_eq!(linked, format!("{native:016x}"));
    assert_eq!(page.eval("centrode.shown_fingerprint()"), linked, "what the page itself shows");
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn a_link_opens_and_a_reload_restores() {
    let mut page = Page::open(Renderer::WebGl, "?test#preset=bench&contact.disk=3&t=6.27&loop=off", Options::default());
    wait_for_disk(&mut page, 3.0);
    assert_eq!(page.number("time"), Some(6.27));
    page.type_number("Seed", "7");
    let link = wait_for_fragment(&mut page, "seed=7");
    let detected = page.number("detectionTime");
    page.reload();
    wait_for_disk(&mut page, 3.0);
    assert_eq!(fragment(&mut page), link);
    assert_eq!((page.number("time"), page.number("detectionTime")), (Some(6.27), detected));
    assert_eq!(page.widget("Slider", "Seed").number, Some(7.0));
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn back_and_forward_work() {
    let mut page = Page::open(Renderer::WebGl, "?test#preset=bench&t=6.27", Options::default());
    page.type_number("Contact disk", "3");
    wait_for_fragment(&mut page, "contact.disk=3");
    page.type_number("Contact disk", "1");
    wait_for_fragment(&mut page, "contact.disk=1");
    page.eval("history.back(); 1");
    wait_for_disk(&mut page, 3.0);
    page.eval("history.back(); 1");
    wait_for_disk(&mut page, 2.0);
    page.eval("history.forward(); 1");
    wait_for_disk(&mut page, 3.0);
    assert_eq!(fragment(&mut page), "preset=bench&contact.disk=3&t=6.27");
    // An address edited by hand.
    page.eval("location.hash = '#preset=bench&contact.disk=1'; 1");
    wait_for_disk(&mut page, 1.0);
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn a_broken_link_opens_its_dialog() {
    let mut page = Page::open(Renderer::WebGl, "?test#preset=bench&contact.disk=9&seed=7&t=1", Options::default());
    page.wait("the dialog", |page| page.widgets().into_iter().find(|widget| widget.label == "Go on"));
    let said =
        page.widgets().into_iter().any(|widget| format!("{}{}", widget.label, widget.value).contains("Contact disk 9"));
    assert!(said, "{:?}", page.widgets());
    page.click("Button", "Go on");
    page.wait("the page without it", |page| page.widgets().iter().all(|widget| widget.label != "Go on").then_some(()));
    wait_for_disk(&mut page, 2.0);
    assert_eq!(page.widget("Slider", "Seed").number, Some(7.0));
    assert_eq!(page.problems(), Vec::<String>::new());
}

/// Where the contact is on disk 2.
pub const BENCH: &str = "?test#preset=bench&t=6.27";

#[test]
fn a_dropped_scenario_is_opened_and_a_saved_one_is_handed_out() {
    files_are_opened_and_saved(&mut Page::open(Renderer::WebGl, BENCH, Options::default()));
}

#[track_caller]
pub fn files_are_opened_and_saved(page: &mut Page) {
    let drop = |text: &str| {
        format!(
            "(() => {{ const data = new DataTransfer(); data.items.add(new File([{}], 'mine.toml')); \
             document.getElementById('canvas').dispatchEvent(new DragEvent('drop', \
             {{ dataTransfer: data, bubbles: true, cancelable: true }})); return 1; }})()",
            json!(text)
        )
    };
    page.eval(&drop("[contact]\ndisk = 3\n"));
    wait_for_disk(page, 3.0);
    page.eval(&drop("[contact]\ndisk = 9\n"));
    page.wait("the dialog", |page| page.widgets().into_iter().find(|widget| widget.label == "Go on"));
    page.click("Button", "Go on");
    wait_for_disk(page, 3.0);
    // What is saved is looked at before it would become a download.
    page.eval(LOOK);
    let (name, text) = saved(page, "Share", "Save scenario");
    assert!(name.starts_with("centrode-") && name.ends_with(".toml"), "{name}");
    assert!(String::from_utf8_lossy(&text).contains("disk = 3"), "{text:?}");
    assert_eq!(page.problems(), Vec::<String>::new());
}
