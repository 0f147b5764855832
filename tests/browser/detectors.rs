//! Detectors side by side in the browser: made in the worker, with the bytes that the command writes.

use crate::harness::{Options, Page, Renderer};
use crate::saving::{LOOK, saved};
use crate::tuning::tuning;
use std::process::Command;

/// Many cheap runs: a loop as fast as the tracker, and one kind of contact. So few show 30 % of false alarms.
const LINK: &str = "preset=bench&loop_rate=100&filter.length=50&estimation.plants=clamp&view=detectors\
    &compare=fcd,fcd-velocity,cusum&false_alarms=0.3&repeats=12";

/// What `centrode study` writes of the same.
fn written() -> String {
    let path = std::env::temp_dir().join(format!("centrode-browser-{}-detectors.csv", std::process::id()));
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    command.args(["study", "--preset", "bench", "--repeats", "12", "--rate", "0.3"]);
    command.args(["--detectors", "fcd,fcd-velocity,cusum", "--csv"]).arg(&path);
    for set in ["loop_rate=100", "filter.length=50", "estimation.plants=[\"clamp\"]"] {
        command.args(["--set", set]);
    }
    let output = command.output().expect("the command starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = std::fs::read_to_string(&path).expect("written");
    std::fs::remove_file(&path).expect("removed");
    text
}

/// The threshold that the table advises for a detector.
fn advised(table: &str, detector: &str) -> String {
    let row = table.lines().find_map(|line| line.strip_prefix(&format!("advised,{detector},"))).expect("an advice");
    row.split(',').next().expect("a threshold").to_owned()
}

#[test]
fn detectors_compared_in_the_worker_have_the_commands_bytes_and_advice_sets_its_key() {
    // High enough that the lines of all detectors are in sight.
    let options = Options { size: [1280, 1600], ..Options::default() };
    let mut page = Page::open(Renderer::WebGl, &format!("?test#{LINK}"), options);
    page.eval(LOOK);
    let done = page.wait("the comparison", |page| tuning(page).filter(|study| study["done"] == study["of"]));
    assert_eq!((&done["helper"], &done["repeats"]), (&true.into(), &12.0.into()), "{done}");
    let (name, table) = saved(&mut page, "Save detectors", "CSV");
    let expected = written();
    assert_eq!((name.as_str(), String::from_utf8_lossy(&table).as_ref()), ("detectors-bench.csv", expected.as_str()));

    page.click("Button", "Take the threshold of Velocity");
    let set = format!("detection.velocity={}", advised(&expected, "fcd-velocity"));
    page.wait(&set, |page| page.eval("location.hash").as_str().filter(|link| link.contains(&set)).map(|_| ()));
    // What changes no run is made at once of those that are there.
    let after = tuning(&mut page).expect("a comparison");
    assert_eq!((&after["done"], &after["bound"]), (&done["of"], &done["bound"]));
    assert_eq!(page.problems(), Vec::<String>::new());
}
