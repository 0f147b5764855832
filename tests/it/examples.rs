//! The example programs of `centrode-core` say what they are there to show.

#![allow(dead_code, reason = "each example has a main of its own")]

#[path = "../../core/examples/judge.rs"]
mod judge;
#[path = "../../core/examples/simulate.rs"]
mod simulate;
#[path = "../../core/examples/study.rs"]
mod study;

/// The number that stands before a word, in the line that begins so.
fn number(text: &str, begins: &str, word: &str) -> f64 {
    let line = text.lines().find(|line| line.starts_with(begins)).expect(begins);
    let (before, _) = line[begins.len()..].split_once(word).expect(word);
    before.rsplit(' ').next().and_then(|number| number.parse().ok()).expect(line)
}

#[test]
fn an_experiment_is_simulated_and_judged() {
    let said = simulate::report().expect("possible");
    let contact = number(&said, "contact at ", " s");
    for detector in ["fcd", "cusum"] {
        let raised = number(&said, &format!("{detector} raised at "), " s");
        assert!((contact..contact + 1.0).contains(&raised), "{said}");
    }
    let place = number(&said, "0.50 s after cusum: ", " mm");
    assert!((place - 15.0).abs() < 1.0, "disk 2 is at 15 mm: {said}");
}

#[test]
fn a_log_is_judged() {
    let bytes = include_bytes!("../../assets/logs/clean.csv").to_vec();
    let said = judge::report("clean.csv", bytes).expect("a log");
    assert!(said.contains("commands: as recorded") && said.contains("fcd raised at "), "{said}");
    let place = number(&said, "Eq. 24 places the contact at ", " mm");
    assert!((place - 15.0).abs() < 3.0, "{said}");
    let refusal = judge::report("empty.csv", b"time\n1\n".to_vec()).expect_err("no log").to_string();
    assert!(!refusal.is_empty());
}

#[test]
fn a_threshold_is_tuned() {
    let said = study::report(80).expect("possible");
    assert!(said.contains("filter.length=500, ξ2 = 7.0 mm: ") && said.contains(" of 80 false alarms"), "{said}");
    assert!(said.contains("take ξ2 = ") && said.contains("with N = 800"), "{said}");
    assert!(study::report(5).expect("possible").contains("73 repeats could show 5 %"));
}
