//! Links on the command line: `--link` is the scenario of `--preset` and `--set`, and `centrode link` prints it.

use crate::cli::{centrode, json, scratch};
use centrode_core::run::simulate;
use centrode_core::scenario::Scenario;
use centrode_core::scenario::link::Link;
use centrode_core::scenario::link::page::{CHALLENGES, THEMES, TOUR_STEPS, VIEWS};
use centrode_core::scenario::preset::PRESETS;

fn line(args: &[&str]) -> String {
    let output = centrode(args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    assert_eq!(text.lines().count(), 1, "{text}");
    text.trim_end().to_owned()
}

const PAGE: &str = "https://example.org/centrode/?renderer=webgl#old";

#[test]
fn a_linked_run_is_the_run_of_preset_and_overrides() {
    let sets = ["--set", "contact.disk=3", "--set", "detection.xi2=0.005", "--set", "seed=7"];
    let named: Vec<&str> = ["--preset", "disk-1"].into_iter().chain(sets).collect();
    let args = |first: &[&'static str], rest: &[&'static str]| [first, rest].concat();
    let link = line(&[&["link"][..], &named, &["--view", "map", "--t", "6.27", PAGE]].concat());
    assert_eq!(
        link,
        "https://example.org/centrode/?renderer=webgl#preset=disk-1&seed=7&contact.disk=3&detection.xi2=0.005&view=map&t=6.27"
    );
    let by_name = json(&[&args(&["run", "--json"], &[])[..], &named].concat());
    assert_eq!(json(&["run", "--json", "--link", &link]), by_name);
    // Overrides come after the link.
    let later = json(&["run", "--json", "--link", &link, "--set", "contact.disk=1"]);
    assert_eq!((&later["scenario"]["contact"]["disk"], &later["scenario"]["seed"]), (&1.into(), &7.into()));
    let scenario: Scenario = serde_json::from_value(by_name["scenario"].clone()).expect("a scenario");
    let fingerprint = |scenario: &Scenario| simulate(scenario).expect("a run").fingerprint();
    assert_eq!(fingerprint(Link::read(&link).0.scenario()), fingerprint(&scenario));
}

#[test]
fn every_preset_has_a_link_that_runs_it() {
    for preset in PRESETS {
        let link = line(&["link", "--preset", preset.name, PAGE]);
        assert!(link.ends_with(&format!("#preset={}", preset.name)), "{link}");
        let linked = json(&["run", "--json", "--link", &link]);
        assert_eq!(linked, json(&["run", "--json", "--preset", preset.name]), "{}", preset.name);
    }
}

#[test]
fn a_file_has_a_link_and_a_link_can_be_changed() {
    let path = scratch("linked.toml");
    std::fs::write(&path, PRESETS[3].toml).expect("written");
    let file = path.to_str().expect("path");
    let expected = format!("https://example.org/centrode/?renderer=webgl#preset={}", PRESETS[3].name);
    assert_eq!(line(&["link", file, PAGE]), expected);
    assert_eq!(line(&["link", "--scenario", file, PAGE]), expected);
    let changed = line(&["link", "--scenario", file, "--set", "filter.length=300", PAGE]);
    std::fs::remove_file(&path).expect("removed");
    assert_eq!(changed, format!("{expected}&filter.length=300"));
    let again = line(&["link", "--link", &format!("{changed}&repeats=7&view=tuning"), "--set", "seed=4", PAGE]);
    assert_eq!(again, format!("{expected}&seed=4&filter.length=300&view=tuning&repeats=7"));
}

#[test]
fn a_link_opens_a_lesson_and_a_theme() {
    let link = |args: &[&str]| line(&[&["link", "--preset", "bench"][..], args, &[PAGE]].concat());
    let fragment = |link: &str| link.split_once('#').expect("a fragment").1.to_owned();
    let toured = link(&["--tour", "4", "--theme", "projector"]);
    assert_eq!(fragment(&toured), "preset=bench&tour=4&theme=projector");
    let (read, broken) = Link::read(&toured);
    assert_eq!((read.page.tour, read.page.theme, broken.len()), (Some(4), Some("projector"), 0));
    let last = TOUR_STEPS.to_string();
    assert_eq!(fragment(&link(&["--tour", &last])), format!("preset=bench&tour={last}"));
    for challenge in CHALLENGES {
        assert_eq!(fragment(&link(&["--challenge", challenge])), format!("preset=bench&challenge={challenge}"));
    }
    for theme in THEMES {
        assert_eq!(fragment(&link(&["--theme", theme])), format!("preset=bench&theme={theme}"));
    }
    // A lesson takes the place of that which a link had.
    let again = line(&["link", "--link", &toured, "--challenge", "clamp", PAGE]);
    assert_eq!(fragment(&again), "preset=bench&challenge=clamp&theme=projector");
    assert_eq!(
        fragment(&line(&["link", "--link", &again, "--tour", "2", PAGE])),
        "preset=bench&tour=2&theme=projector"
    );
}

#[test]
fn several_segments_have_links_that_run() {
    let sets = ["--set", "segment[3].motion.theta_end=0.9"];
    let made = line(&[&["link", "--preset", "two-contacts"][..], &sets, &[PAGE]].concat());
    assert!(made.ends_with("view=chain&chain=two-contacts&chain.segment.3.motion.theta_end=0.9"), "{made}");
    let ours = json(&["run", "--json", "--link", &made]);
    assert_eq!(ours, json(&[&["run", "--json", "--preset", "two-contacts"][..], &sets].concat()));
    let refused = centrode(&["link", "--preset", "two-contacts", "--set", "segment[9].length=1", PAGE]);
    assert!(String::from_utf8_lossy(&refused.stderr).contains("segment[9].length"), "{refused:?}");
}

/// The help names every word that a flag takes.
#[test]
fn the_help_names_views_challenges_and_themes() {
    let help = String::from_utf8(centrode(&["link", "--help"]).stdout).expect("UTF-8");
    let words: Vec<&str> = help.split(|c: char| !(c.is_alphanumeric() || c == '-')).collect();
    for word in VIEWS.iter().chain(CHALLENGES).chain(THEMES) {
        assert!(words.contains(word), "{word} is not in\n{help}");
    }
}

#[test]
fn studies_maps_tables_and_figures_take_links() {
    let link = "#preset=bench&seed=3&contact.disk=3&view=tuning&rule=or&false_alarms=0.2&repeats=4";
    let ours = json(&["study", "--json", "--link", link]);
    let named = ["--preset", "bench", "--set", "seed=3", "--set", "contact.disk=3"];
    let page = ["--repeats", "4", "--method", "or", "--false-alarms", "0.2"];
    assert_eq!(ours, json(&[&["study", "--json"][..], &named, &page].concat()));
    assert_eq!(json(&["study", "--json", "--link", link, "--repeats", "5"])["repeats"], 5);
    for command in [&["map", "--json", "--rows", "4", "--columns", "4"][..], &["table2", "--json", "--repeats", "2"]] {
        let linked = json(&[command, &["--link", link]].concat());
        assert_eq!(linked, json(&[command, &named].concat()), "{command:?}");
    }
    let figure = |source: &[&str]| {
        let path = scratch("linked.csv");
        line(&[&["figure", "3", "--out", path.to_str().expect("path")][..], source].concat());
        let text = std::fs::read_to_string(&path).expect("a file");
        std::fs::remove_file(&path).expect("removed");
        text
    };
    assert_eq!(figure(&["--link", link]), figure(&named));
}

#[test]
fn a_broken_link_is_refused_and_its_keys_are_named() {
    for (args, parts) in [
        (
            &["run", "--link", "#preset=bench&contact.disk=9&bogus=1"][..],
            &["--link: ", "bogus=1: unknown key", "contact.disk=9", "1 to 3"][..],
        ),
        (&["run", "--link", "https://example.org/#preset=none"], &["preset=none", "bench, paper"]),
        (&["run", "--link", "v=2"], &["v=2", "newer page"]),
        (&["run", "--link", "seed=%"], &["percent-encoding"]),
        (&["study", "--link", "repeats=none"], &["repeats=none", "whole number"]),
        (&["map", "--link", "contact.disk=1&contact.disk=2"], &["contact.disk=2", "more than once"]),
        (&["run", "--link", "seed=1", "--preset", "bench"], &["--preset"]),
        (&["run", "file.toml", "--link", "seed=1"], &["--link"]),
        (&["run", "--link", "seed=1", "--set", "contact.disk=7"], &["--link with --set", "contact.disk"]),
        (&["link", "--preset", "bench", "example.org"], &["example.org", "address of a page"]),
        (&["link", "--preset", "bench"], &["<ADDRESS>"]),
        (&["link", "--preset", "none", PAGE], &["none", "bench, paper"]),
        (&["link", "--view", "plots", PAGE], &["--view", "plots", "robot"]),
        (&["link", "--t", "10.5", PAGE], &["t = 10.5", "motion.end = 10 s"]),
        (&["link", "--t", "-1", PAGE], &["--t", "-1", "0 s"]),
        (&["link", "--tour", "14", PAGE], &["--tour", "14", "1 to 13"]),
        (&["link", "--tour", "-1", PAGE], &["--tour", "-1", "1 to 13"]),
        (&["link", "--tour", "next", PAGE], &["--tour", "next", "whole number"]),
        (&["link", "--challenge", "disk-2", PAGE], &["--challenge", "disk-2", "disk-1", "best"]),
        (&["link", "--tour", "4", "--challenge", "clamp", PAGE], &["--tour", "--challenge"]),
        (&["link", "--theme", "sepia", PAGE], &["--theme", "sepia", "dark", "projector"]),
        (&["link", "--scenario", "no-such.toml", PAGE], &["no-such.toml"]),
        (&["link", "--scenario", "a.toml", "--preset", "bench", PAGE], &["--preset"]),
    ] {
        let output = centrode(args);
        let message = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(2), "{args:?}: {message}");
        assert_eq!(message.lines().count(), 1, "{args:?}: {message}");
        assert!(output.stdout.is_empty(), "{args:?}");
        for part in parts {
            assert!(message.contains(part), "{args:?}: {message:?} lacks {part:?}");
        }
    }
}
