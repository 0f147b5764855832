//! Logs on the page, headless: opened, judged as the command judges them, told of, and put away.

use crate::stages::show;
use crate::support::{DESK, PHONE, Page, app, fits, page_of, slide, texts};
use centrode::app::App;
use centrode::app::link::Effect;
use centrode::app::log::file::File;
use centrode_core::detect::{Method, Settings};
use centrode_core::record::log::frame::Setting;
use centrode_core::record::log::{Commands, Log, Options, Setup, assemble};
use centrode_core::run::{Run, simulate};
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{Scenario, Threshold};
use egui::accesskit::Role;
use egui::{OutputCommand, Vec2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use std::fs;
use std::path::Path;
use std::process::Command;

fn handle(page: &mut Page) -> &mut App {
    page.state_mut().as_mut().expect("built")
}

fn click(page: &mut Page, label: &str) {
    crate::support::click(page, label);
    page.run_steps(6);
}

pub fn bytes(name: &str) -> Vec<u8> {
    fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/logs").join(name)).expect(name)
}

fn bench() -> Scenario {
    find("bench").and_then(|preset| preset.scenario()).expect("bench")
}

/// A page at the scenario that the example logs were recorded with.
fn page_at_bench(size: Vec2) -> Page {
    let mut page = page_of(size);
    handle(&mut page).go("preset=bench");
    page.run_steps(2);
    page
}

/// Steps until nothing is being read any more.
#[track_caller]
fn settle(page: &mut Page) {
    for _ in 0..1000 {
        page.step();
        if page.query_by_label("Stop reading").is_none() {
            // A dialog takes its place over some frames.
            return page.run_steps(6);
        }
    }
    panic!("it reads for ever");
}

#[track_caller]
pub fn drop_log(page: &mut Page, name: &str, bytes: Vec<u8>) {
    handle(page).opened(name, Ok(bytes));
    settle(page);
}

/// What the command makes of a log: it assembles and judges in the same way, see `centrode analyze`.
fn judged(name: &str, options: &Options, scenario: &Scenario, setup: &Setup) -> Run {
    let options = Options { frame_rate: Some(scenario.tracker.rate), ..options.clone() };
    let log = Log::read(name, bytes(name), &options).expect(name);
    let made = assemble(&log, scenario, setup).expect(name);
    Run::recorded(made.plan, made.recording).expect("entries")
}

#[test]
fn a_dropped_log_is_judged_as_the_command_judges_it() {
    let mut page = page_at_bench(DESK);
    drop_log(&mut page, "clean.csv", bytes("clean.csv"));
    assert_eq!((app(&page).log(), app(&page).notice()), (Some("clean.csv"), None));
    let (shown, expected) = (app(&page).run(), judged("clean.csv", &Options::default(), &bench(), &Setup::default()));
    assert!(shown.is_recorded() && !shown.events().is_empty());
    assert_eq!((shown.events(), shown.crossings()), (expected.events(), expected.crossings()));
    let detection = shown.detection().expect("a detection");
    assert_eq!(Some(detection), expected.detection());
    let report: serde_json::Value = serde_json::from_str(&app(&page).report()).expect("JSON");
    assert_eq!(
        (report["detection_time"].as_f64(), report["location"].as_f64(), report["log"].as_str()),
        (Some(detection.time), Some(detection.location), Some("clean.csv"))
    );
    // And so says the command itself.
    let log = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/logs/clean.csv");
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    command.arg("analyze").arg(log).args(["--preset", "bench", "--json"]);
    let said = command.output().expect("the command runs");
    let said: serde_json::Value = serde_json::from_slice(&said.stdout).expect("JSON");
    assert_eq!(
        (said["detection"]["time"].as_f64(), said["detection"]["location"].as_f64()),
        (Some(detection.time), Some(detection.location))
    );
    let raised: Vec<Option<f64>> = shown.events().iter().map(|event| Some(event.raised)).collect();
    let events = said["events"].as_array().expect("events");
    assert_eq!(events.iter().map(|event| event["raised"].as_f64()).collect::<Vec<_>>(), raised);
    assert_eq!(texts(&page, "Detected: 6.260 s").len(), 1, "{:?}", texts(&page, "Detected"));
    assert!(texts(&page, "Contact:").is_empty() && texts(&page, "Delay:").is_empty(), "nobody knows them");
    assert_eq!(texts(&page, "CSV · 600 rows").len(), 1);
}

#[test]
fn what_judges_judges_the_log_again_and_the_rest_leaves_it() {
    let mut page = page_at_bench(DESK);
    drop_log(&mut page, "clean.csv", bytes("clean.csv"));
    let entries = app(&page).run().recording.entries.clone();
    slide(&mut page, "ξ2 (centrode)", 4.0);
    slide(&mut page, "Filter length N", 300.0);
    let scenario = app(&page).state().scenario.clone();
    assert_eq!((scenario.detection.xi2, scenario.filter.length), (Threshold::On(0.004), 300));
    let expected = judged("clean.csv", &Options::default(), &scenario, &Setup::default());
    assert_eq!(app(&page).run().events(), expected.events());
    assert_eq!(app(&page).run().recording.entries, entries);
    let disabled = |label: &str| page.get_by_role_and_label(Role::Slider, label).accesskit_node().is_disabled();
    assert!(["Contact disk", "Position noise", "Seed"].map(disabled).iter().all(|is| *is));
    assert!(!["ξ2 (centrode)", "Filter length N", "Load cell error ε_τ"].map(disabled).iter().any(|is| *is));
    // The model, too, judges the same rows.
    handle(&mut page).go("preset=bench&robot.length=0.031");
    page.run_steps(2);
    let longer = app(&page).state().scenario.clone();
    let expected = judged("clean.csv", &Options::default(), &longer, &Setup::default());
    assert_eq!(app(&page).run().events(), expected.events());
    assert_eq!(app(&page).run().judged.settings, Settings { ..expected.judged.settings.clone() });
    click(&mut page, "Close log");
    let simulated = simulate(&app(&page).state().scenario).expect("a run");
    assert_eq!(app(&page).log(), None);
    assert_eq!(app(&page).run().fingerprint(), simulated.fingerprint());
}

#[test]
fn what_a_log_lacks_is_said_and_the_report_counts_what_was_done() {
    let mut page = page_at_bench(DESK);
    let text = String::from_utf8(bytes("clean.csv")).expect("text");
    let positions: String = text
        .lines()
        .map(|line| line.split(',').take(4).chain(line.split(',').skip(7).take(2)).collect::<Vec<_>>().join(",") + "\n")
        .collect();
    drop_log(&mut page, "positions.csv", positions.into_bytes());
    assert_eq!(app(&page).log(), Some("positions.csv"), "{:?}", app(&page).notice());
    assert!(app(&page).run().events().is_empty());
    assert!(!texts(&page, "no orientation: FCD needs it").is_empty());
    assert!(!texts(&page, "no load cells: JFD needs").is_empty());
    click(&mut page, "Report");
    let notice = app(&page).notice().expect("a report");
    for part in [
        "time [s], x [mm]",
        "1000 Hz: the scenario says so",
        "as recorded",
        "the last one was held",
        "A log does not say",
    ] {
        assert!(notice.details.contains(part), "{part} in {}", notice.details);
    }
    fits(&page, DESK, "report");
    click(&mut page, "Go on");
    for stage in ["Map", "Tuning", "Robot"] {
        show(&mut page, stage);
        page.run_steps(3);
    }
}

#[test]
fn a_log_that_does_not_fit_leaves_the_scenario_that_is_set() {
    let mut page = page_at_bench(DESK);
    drop_log(&mut page, "clean.csv", bytes("clean.csv"));
    let before = app(&page).run().events().to_vec();
    // So short a robot cannot bend as the log commands, or so fast a loop has too many instants.
    handle(&mut page).go("preset=bench&loop_rate=500000&motion.end=0.3&motion.start=0.1&motion.finish=0.2");
    page.run_steps(2);
    assert_eq!(app(&page).run().events(), before, "the log stays as it was judged last");
    assert!(!texts(&page, "instants of the loop").is_empty(), "why it is not judged anew is said");
    click(&mut page, "Close log");
    let simulated = simulate(&app(&page).state().scenario).expect("a run");
    assert_eq!(app(&page).run().fingerprint(), simulated.fingerprint());
}

#[test]
fn a_refused_log_says_where_and_the_one_before_stays() {
    let mut page = page_at_bench(DESK);
    drop_log(&mut page, "clean.csv", bytes("clean.csv"));
    let broken = String::from_utf8(bytes("clean.csv")).expect("text").replacen("0.0227", "two", 1);
    drop_log(&mut page, "broken.csv", broken.into_bytes());
    let why = |page: &Page| app(page).log_form().and_then(|form| form.why.clone()).expect("a refusal");
    assert!(why(&page).contains("line 2, column 3"), "{}", why(&page));
    assert_eq!(texts(&page, "broken.csv was not read").len(), 1);
    assert_eq!(app(&page).log(), Some("clean.csv"));
    click(&mut page, "Cancel");
    assert!(app(&page).log_form().is_none());
    handle(&mut page).log_chosen(File::there("large.csv", 600 << 20, b"time,x", 1));
    page.run_steps(6);
    let said = app(&page).notice().expect("a notice").details.clone();
    assert!(said.contains("600 MiB") && said.contains("512 MiB"), "{said}");
    click(&mut page, "Go on");
    // Two rows an hour apart are too many instants of a loop at 1 kHz.
    drop_log(&mut page, "long.csv", b"time,x,y,z,theta_l\n0,0,0,0,1\n3600,0,0,0,1\n".to_vec());
    assert!(why(&page).contains("3600001 instants") && why(&page).contains("1200000"), "{}", why(&page));
}

/// What “Copy command” copies.
fn copied_command(page: &mut Page) -> String {
    click(page, "Share");
    page.get_by_role_and_label(Role::MenuItem, "Copy command").click();
    let mut copied = String::new();
    for _ in 0..4 {
        page.step();
        let commands = page.output().platform_output.commands.iter();
        copied.extend(commands.filter_map(|command| match command {
            OutputCommand::CopyText(text) => Some(text.as_str()),
            _ => None,
        }));
    }
    copied
}

/// Picks an option of a choice.
fn choose(page: &mut Page, choice: &str, option: &str) {
    page.get_by_role_and_label(Role::ComboBox, choice).click();
    page.run_steps(6);
    page.get_by_label(option).click();
    page.run_steps(6);
}

#[test]
fn columns_that_are_not_known_are_filled_in() {
    for size in [DESK, PHONE] {
        let mut page = page_at_bench(size);
        let text = String::from_utf8(bytes("clean.csv")).expect("text");
        let unnamed = text.replacen("time [s],x [mm]", "Zeit,Weg", 1);
        drop_log(&mut page, "named.csv", unnamed.into_bytes());
        assert!(app(&page).log_form().is_some_and(|form| form.why.is_some()));
        // The first rows scroll to the side; what is filled in does not.
        for label in ["time", "x", "y", "z"] {
            let rect = page.get_by_role_and_label(Role::ComboBox, label).rect();
            assert!(rect.left() >= 0.0 && rect.right() <= size.x, "{label}: {rect:?}");
        }
        let rect = page.get_by_role_and_label(Role::Button, "Read log").rect();
        assert!(rect.right() <= size.x && rect.bottom() <= size.y, "{rect:?}");
        choose(&mut page, "time", "1: Zeit");
        choose(&mut page, "x", "2: Weg");
        choose(&mut page, "x unit", "mm");
        click(&mut page, "Read log");
        settle(&mut page);
        let form = app(&page).log_form().and_then(|form| form.why.clone());
        assert_eq!((app(&page).log(), form), (Some("named.csv"), None));
        let expected = judged("clean.csv", &Options::default(), &bench(), &Setup::default());
        assert_eq!(app(&page).run().events(), expected.events());
        assert_eq!(
            copied_command(&mut page),
            "centrode analyze named.csv --preset bench --map 'time [s]=Zeit' --map 'x [mm]=Weg'"
        );
    }
}

#[test]
fn a_tool_the_motion_and_a_fitted_frame_are_asked_for() {
    let mut page = page_at_bench(DESK);
    drop_log(&mut page, "ndi.csv", bytes("ndi.csv"));
    let why = app(&page).log_form().and_then(|form| form.why.clone()).expect("which tool?");
    assert!(why.contains("2 tools"), "{why}");
    page.get_by_role_and_label(Role::TextInput, "Tool").focus();
    page.run_steps(1);
    page.get_by_role_and_label(Role::TextInput, "Tool").type_text("TIP");
    page.run_steps(2);
    page.get_by_role_and_label(Role::RadioButton, "the scenario's motion").click();
    page.get_by_role_and_label(Role::CheckBox, "Fit the frame to the readings before alarms are armed").click();
    page.run_steps(2);
    click(&mut page, "Read log");
    settle(&mut page);
    let form = app(&page).log_form().and_then(|form| form.why.clone());
    assert_eq!((app(&page).log(), form), (Some("ndi.csv"), None));
    let options = Options { tool: Some("TIP".into()), ..Options::default() };
    let setup = Setup { commands: Some(Commands::Motion), frame: Setting::Fitted, ..Setup::default() };
    assert_eq!(app(&page).run().events(), judged("ndi.csv", &options, &bench(), &setup).events());
    assert_eq!(
        copied_command(&mut page),
        "centrode analyze ndi.csv --preset bench --tool TIP --commands motion --fit-frame"
    );
    click(&mut page, "Report");
    let details = app(&page).notice().expect("a report").details.clone();
    assert!(details.contains("remaining") && details.contains("from the scenario's motion"), "{details}");
}

#[test]
fn topics_can_be_chosen_again_and_a_closed_dialog_waits_for_nothing() {
    let mut page = page_at_bench(DESK);
    drop_log(&mut page, "ros.mcap", bytes("ros.mcap"));
    click(&mut page, "Columns");
    let topics = |page: &Page| page.query_all_by_label_contains("messages)").count();
    assert_eq!(topics(&page), 2, "a log that was read has them");
    page.get_by_label_contains("/joint_states (").click();
    page.run_steps(2);
    click(&mut page, "Read log");
    settle(&mut page);
    assert!(app(&page).log_form().is_none() && app(&page).run().judged.first(Method::Fcd).is_some());
    click(&mut page, "Columns");
    assert_eq!(topics(&page), 2);
    page.get_by_role_and_label(Role::RadioButton, "a second file …").click();
    page.run_steps(2);
    assert!(app(&page).log_form().is_some_and(|form| form.awaits));
    handle(&mut page).none_chosen();
    drop_log(&mut page, "clean.csv", bytes("clean.csv"));
    assert_eq!(app(&page).log(), Some("clean.csv"));
}

#[test]
fn commands_come_from_a_second_file() {
    let mut page = page_at_bench(DESK);
    drop_log(&mut page, "trajectory.tum", bytes("trajectory.tum"));
    click(&mut page, "Columns");
    drop(handle(&mut page).take_effects());
    page.get_by_role_and_label(Role::RadioButton, "a second file …").click();
    page.run_steps(2);
    assert!(handle(&mut page).take_effects().contains(&Effect::ChooseLog));
    drop_log(&mut page, "commands.csv", bytes("commands.csv"));
    click(&mut page, "Read log");
    settle(&mut page);
    let options = Options { frame_rate: Some(bench().tracker.rate), ..Options::default() };
    let mut log = Log::read("trajectory.tum", bytes("trajectory.tum"), &options).expect("a log");
    log.take_commands(Log::read("commands.csv", bytes("commands.csv"), &options).expect("commands"), "commands.csv")
        .expect("the same clock");
    let made =
        assemble(&log, &bench(), &Setup { commands: Some(Commands::Log), ..Setup::default() }).expect("a recording");
    let expected = Run::recorded(made.plan, made.recording).expect("entries");
    assert!(expected.judged.first(Method::Jfd).is_some());
    assert_eq!(app(&page).run().events(), expected.events());
    assert_eq!(copied_command(&mut page), "centrode analyze trajectory.tum --preset bench --commands commands.csv");
}

#[test]
fn the_address_stays_the_scenarios_and_the_command_judges_the_log() {
    let mut page = page_at_bench(DESK);
    drop_log(&mut page, "clean.csv", bytes("clean.csv"));
    drop(handle(&mut page).take_effects());
    slide(&mut page, "ξ2 (centrode)", 5.0);
    page.run_steps(2);
    let fragments: Vec<String> = handle(&mut page)
        .take_effects()
        .into_iter()
        .filter_map(|effect| match effect {
            Effect::Address { fragment, .. } => Some(fragment),
            _ => None,
        })
        .collect();
    let last = fragments.last().expect("an address");
    assert!(last.contains("detection.xi2=0.005") && !last.contains("clean"), "{fragments:?}");
    assert_eq!(copied_command(&mut page), "centrode analyze clean.csv --preset bench --set detection.xi2=0.005");
}

#[test]
fn logs_of_every_format_are_shown_and_fit_on_a_phone() {
    for size in [DESK, PHONE, vec2(844.0, 390.0)] {
        let mut page = page_at_bench(size);
        for name in ["clean.csv", "trajectory.tum", "ros.mcap"] {
            drop_log(&mut page, name, bytes(name));
            assert_eq!((app(&page).log(), app(&page).notice()), (Some(name), None));
            assert!(app(&page).run().judged.first(Method::Fcd).is_some(), "{name}");
            fits(&page, size, name);
            page.get_by_label("Play").click();
            page.run_steps(12);
            assert!(app(&page).state().time > app(&page).run().sample(0).time, "{name} is played");
            page.get_by_label("Pause").click();
            page.run_steps(2);
        }
    }
}
