//! Logs in the page: dropped, read by the worker and without one, and judged as the command judges them.

use crate::harness::{Options, Page, Renderer};
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

fn path(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/logs").join(name);
    path.to_string_lossy().into_owned()
}

/// What `centrode analyze` says of a log.
fn analyzed(name: &str) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    let output = command.args(["analyze", &path(name), "--preset", "bench", "--json"]).output().expect("it starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// Drops a file on the page.
fn drop_file(page: &mut Page, name: &str, text: &str) {
    page.eval(&format!(
        "(() => {{ const data = new DataTransfer(); data.items.add(new File([{}], {})); \
         document.getElementById('canvas').dispatchEvent(new DragEvent('drop', \
         {{ dataTransfer: data, bubbles: true, cancelable: true }})); return 1; }})()",
        json!(text),
        json!(name)
    ));
}

fn says(page: &mut Page, part: &str) -> bool {
    page.widgets().into_iter().any(|widget| format!("{}{}", widget.label, widget.value).contains(part))
}

#[test]
fn a_dropped_log_gives_what_the_command_gives() {
    let text = std::fs::read_to_string(path("clean.csv")).expect("an example");
    let expected = analyzed("clean.csv");
    for query in ["?test#preset=bench&t=6.27", "?test&worker=off#preset=bench&t=6.27"] {
        let mut page = Page::open(Renderer::WebGl, query, Options::default());
        drop_file(&mut page, "clean.csv", &text);
        page.wait("the log", |page| (page.data("log").as_deref() == Some("clean.csv")).then_some(()));
        assert_eq!(page.number("detectionTime"), expected["detection"]["time"].as_f64(), "{query}");
        assert_eq!(page.number("location"), expected["detection"]["location"].as_f64(), "{query}");
        page.click("Button", "Report");
        page.wait("the report", |page| says(page, "the last one was held").then_some(()));
        // What cannot be read says where, and the log before stays.
        drop_file(&mut page, "broken.csv", &text.replacen("0.0227", "two", 1));
        page.wait("the refusal", |page| says(page, "line 2, column 3").then_some(()));
        assert_eq!(page.data("log").as_deref(), Some("clean.csv"));
        assert_eq!(page.problems(), Vec::<String>::new(), "{query}");
    }
}
