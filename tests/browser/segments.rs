//! Segments in series in the browser: a worker places their contacts, with the digits that the command prints.

use crate::harness::{Options, Page, Renderer};
use crate::saving::{LOOK, saved};
use std::process::Command;

/// What workers are asked for.
const HEARD: &str = "globalThis.asked = []; \
    { const post = Worker.prototype.postMessage; \
      Worker.prototype.postMessage = function (message, ...rest) { \
        if (message?.request) asked.push(Object.keys(JSON.parse(message.request).work)[0]); \
        return post.call(this, message, ...rest); }; }";

#[test]
fn contacts_are_placed_by_the_worker_as_the_command_places_them() {
    let query = "?test#view=chain&chain=two-contacts&t=8";
    let mut page = Page::visit_after(HEARD, Renderer::WebGl, query, Options::default());
    page.wait("the page to run", |page| (page.shown() == "running").then_some(()));
    page.wait("both contacts and all that is known of them", |page| {
        let says = |what: &str, all: &[String]| all.iter().any(|said| said.contains(what));
        // What is only read is its own value.
        let all: Vec<String> = page.widgets().into_iter().map(|widget| widget.label + &widget.value).collect();
        (says("Contact 2: alarm", &all) && !says("Placing contacts", &all)).then_some(())
    });
    assert_eq!(page.eval("asked"), serde_json::json!(["Contacts"]));
    page.eval(LOOK);
    let (name, report) = saved(&mut page, "Save plots", "JSON");
    assert!(name.ends_with(".json"), "{name}");
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    let output = command.args(["run", "--preset", "two-contacts", "--after", "0.1,0.5,1", "--json"]).output();
    let output = output.expect("the command starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(String::from_utf8_lossy(&report), String::from_utf8_lossy(&output.stdout));
    assert_eq!(page.problems(), Vec::<String>::new());
}
