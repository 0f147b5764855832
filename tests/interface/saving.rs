//! What is saved from each card: the menu by keyboard and by pointer, and the same bytes as the command writes.

use crate::stages::show;
use crate::support::{DESK, PHONE, Page, app, click, finish, page_of, slide};
use centrode::app::link::Effect;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use std::path::PathBuf;
use std::process::Command;

/// Picks an entry of a card's menu, and gives what the surroundings are asked for.
pub fn saved(page: &mut Page, menu: &str, entry: &str) -> Effect {
    page.state_mut().as_mut().expect("built").take_effects();
    page.get_by_role_and_label(Role::Button, menu).click();
    page.run_steps(2);
    page.get_by_role_and_label(Role::MenuItem, entry).click();
    page.run_steps(2);
    the_file(page)
}

fn the_file(page: &mut Page) -> Effect {
    let effects = page.state_mut().as_mut().expect("built").take_effects();
    let mut files = effects.into_iter().filter(|effect| !matches!(effect, Effect::Address { .. }));
    let file = files.next().expect("a file");
    assert_eq!(files.next(), None, "one file");
    file
}

/// Name, kind and content of a saved file.
pub fn file(effect: Effect) -> (String, &'static str, String) {
    match effect {
        Effect::Save { name, kind, bytes } => (name, kind, String::from_utf8(bytes).expect("text")),
        other => panic!("{other:?}"),
    }
}

fn command(args: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_centrode")).args(args).output().expect("the command starts");
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// What the command writes to the file behind its last flag.
pub fn written(args: &[&str], extension: &str) -> String {
    let name =
        format!("centrode-saving-{}-{}.{extension}", std::process::id(), args.join("-").replace(['/', '='], "-"));
    let path: PathBuf = std::env::temp_dir().join(name);
    command(&[args, &[path.to_str().expect("a path")]].concat());
    let text = std::fs::read_to_string(&path).expect("written");
    std::fs::remove_file(&path).expect("removed");
    text
}

#[test]
fn a_figure_has_the_command_s_bytes() {
    let mut page = page_of(DESK);
    show(&mut page, "Figure 4");
    finish(&mut page);
    let (name, kind, svg) = file(saved(&mut page, "Save figure 4", "SVG"));
    assert_eq!((name.as_str(), kind), ("figure-4.svg", "image/svg+xml"));
    assert!(svg.contains("Centrode #preset=figure-4&amp;view=figure-4"), "{svg}");
    assert_eq!(svg, written(&["figure", "4", "--out"], "svg"));
    let picture = saved(&mut page, "Save figure 4", "PNG (2×)");
    assert_eq!(picture, Effect::Picture { name: "figure-4.png".into(), svg, scale: 2 });
    let (name, kind, numbers) = file(saved(&mut page, "Save figure 4", "CSV"));
    assert_eq!((name.as_str(), kind), ("figure-4.csv", "text/csv"));
    assert_eq!(numbers, written(&["figure", "4", "--out"], "csv"));
}

#[test]
fn the_run_has_the_command_s_bytes() {
    let mut page = page_of(DESK);
    slide(&mut page, "Contact disk", 3.0);
    let set = ["--preset", "bench", "--set", "contact.disk=3"];
    let args = |flag: &'static str| [&["run"][..], &set, &[flag]].concat();
    let (name, kind, numbers) = file(saved(&mut page, "Save plots", "CSV"));
    assert_eq!((name.as_str(), kind), ("run-bench.csv", "text/csv"));
    assert!(numbers == written(&args("--csv"), "csv"), "other numbers");
    let (name, kind, report) = file(saved(&mut page, "Save plots", "JSON"));
    assert_eq!((name.as_str(), kind), ("run-bench.json", "application/json"));
    assert_eq!(report, command(&args("--json")));
    let (name, _, svg) = file(saved(&mut page, "Save plots", "SVG"));
    assert_eq!(name, "run-bench.svg");
    assert_eq!(svg, written(&args("--figure"), "svg"));
    for word in ["Centrode deviation", "Joint force deviation", "Tangent angle", "raised", "contact.disk=3"] {
        assert!(svg.contains(word), "it lacks {word:?}");
    }
}

#[test]
fn map_and_table_have_the_command_s_bytes() {
    let mut page = page_of(DESK);
    show(&mut page, "Map");
    finish(&mut page);
    let args = |flag: &'static str| ["map", "--preset", "bench", "--columns", "120", "--rows", "90", flag];
    let (name, _, svg) = file(saved(&mut page, "Save map", "SVG"));
    assert_eq!(name, "map-bench.svg");
    assert!(svg == written(&args("--out"), "svg"), "another drawing");
    assert!(svg.contains("Centrode #preset=bench&amp;view=map"));
    let (name, _, numbers) = file(saved(&mut page, "Save map", "CSV"));
    assert_eq!(name, "map-bench.csv");
    assert!(numbers == written(&args("--out"), "csv"), "other numbers");

    show(&mut page, "Table II");
    finish(&mut page);
    for (entry, flag, extension) in [("CSV", "--csv", "csv"), ("LaTeX", "--latex", "tex"), ("SVG", "--svg", "svg")] {
        let (name, _, text) = file(saved(&mut page, "Save Table II", entry));
        assert_eq!(name, format!("table2-bench.{extension}"));
        assert_eq!(text, written(&["table2", "--repeats", "20", flag], extension));
    }
}

#[test]
fn a_log_has_the_command_s_bytes() {
    let mut page = page_of(DESK);
    let file_of = |name: &str| format!("{}/assets/logs/{name}", env!("CARGO_MANIFEST_DIR"));
    slide(&mut page, "ξ2 (centrode)", 6.0);
    let log = std::fs::read(file_of("clean.csv")).expect("a log");
    page.state_mut().as_mut().expect("built").opened("clean.csv", Ok(log));
    page.run_steps(12);
    assert_eq!(app(&page).log(), Some("clean.csv"));
    let path = file_of("clean.csv");
    let args = |flag: &'static str| {
        ["analyze", &path, "--preset", "bench", "--set", "detection.xi2=0.006", flag].map(str::to_owned)
    };
    for (entry, flag, extension) in [("SVG", "--figure", "svg"), ("CSV", "--csv", "csv")] {
        let (name, _, text) = file(saved(&mut page, "Save plots", entry));
        assert_eq!(name, format!("log-clean.{extension}"));
        let args = args(flag);
        assert!(text == written(&args.each_ref().map(String::as_str), extension), "another {extension}");
    }
    let (name, _, text) = file(saved(&mut page, "Save plots", "JSON"));
    assert_eq!((name.as_str(), text), ("log-clean.json", command(&args("--json").each_ref().map(String::as_str))));
}

#[test]
fn the_map_beside_a_log_is_the_scenario_s() {
    let mut page = page_of(DESK);
    let log = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/logs/clean.csv")).expect("a log");
    // At a rate of its own, and with a contact, which no log knows.
    slide(&mut page, "Contact disk", 3.0);
    page.state_mut().as_mut().expect("built").opened("clean.csv", Ok(log));
    page.run_steps(12);
    assert_eq!(app(&page).log(), Some("clean.csv"));
    show(&mut page, "Map");
    finish(&mut page);
    let (name, _, svg) = file(saved(&mut page, "Save map", "SVG"));
    assert_eq!(name, "map-bench.svg");
    let args = ["map", "--preset", "bench", "--set", "contact.disk=3", "--columns", "120", "--rows", "90", "--out"];
    assert!(svg == written(&args, "svg"), "another drawing");
}

#[test]
fn the_tuning_view_is_saved_with_its_four_pictures() {
    let mut page = page_of(DESK);
    show(&mut page, "Tuning");
    finish(&mut page);
    let (name, _, svg) = file(saved(&mut page, "Save tuning", "SVG"));
    assert_eq!(name, "tuning-bench.svg");
    let titles = ["Contacts found against", "Delay against", "Delay by place", "Median delay by filter length"];
    for word in titles.into_iter().chain(["100 repeats", "Centrode #preset=bench&amp;view=tuning"]) {
        assert!(svg.contains(word), "it lacks {word:?}");
    }
    assert!(!svg.contains("NaN"));
    let (_, _, numbers) = file(saved(&mut page, "Save tuning", "CSV"));
    assert_eq!(numbers.lines().filter(|line| line.starts_with("kind,")).count(), 4);
    assert!(numbers.lines().any(|line| line.starts_with("cell,,,500,")), "a column for each filter length");
}

#[test]
fn what_is_not_computed_yet_is_not_saved() {
    let mut page = page_of(DESK);
    page.get_by_role_and_label(Role::Tab, "Map").click();
    page.run_steps(2);
    page.get_by_role_and_label(Role::Button, "Save map").click();
    page.step();
    page.step();
    page.get_by_role_and_label(Role::MenuItem, "SVG").click();
    page.step();
    page.step();
    assert!(app(&page).is_working(), "the map takes more frames than these");
    let notice = app(&page).notice().map(|notice| notice.title.clone());
    assert_eq!(notice.as_deref(), Some("map-bench.svg was not saved"));
}

#[test]
fn keys_open_the_menu_and_pick_from_it() {
    let mut page = page_of(DESK);
    show(&mut page, "Figure 3");
    finish(&mut page);
    page.key_press(Key::S);
    page.run_steps(3);
    assert!(page.get_by_role_and_label(Role::MenuItem, "SVG").is_focused(), "keys go on from the first entry");
    page.key_press(Key::Tab);
    page.run_steps(2);
    page.key_press(Key::Tab);
    page.run_steps(2);
    page.key_press(Key::Enter);
    page.run_steps(2);
    assert_eq!(file(the_file(&mut page)).0, "figure-3.csv");
    assert!(page.query_by_role_and_label(Role::MenuItem, "SVG").is_none(), "it is closed");
    page.key_press_modifiers(Modifiers::SHIFT, Key::S);
    page.run_steps(3);
    assert!(page.query_by_role_and_label(Role::MenuItem, "JSON").is_some());
    page.key_press(Key::Escape);
    page.run_steps(3);
    assert!(page.query_by_role_and_label(Role::MenuItem, "JSON").is_none());
    assert!(app(&page).notice().is_none() && app(&page).state().stage.figure().is_some());
}

#[test]
fn on_a_phone_the_same_key_shows_the_plots() {
    let mut page = page_of(PHONE);
    page.key_press_modifiers(Modifiers::SHIFT, Key::S);
    page.run_steps(4);
    assert!(page.query_by_role_and_label(Role::MenuItem, "JSON").is_some());
    page.key_press(Key::Escape);
    page.run_steps(2);
    click(&mut page, "Save plots");
    page.get_by_role_and_label(Role::MenuItem, "CSV").click();
    page.run_steps(2);
    assert_eq!(file(the_file(&mut page)).0, "run-bench.csv");
}

/// What the last frames copied.
fn copied(page: &Page) -> Option<String> {
    page.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    })
}

#[test]
fn two_marked_times_are_compared_copied_and_saved() {
    let mut page = page_of(DESK);
    for (key, time) in [(Key::A, 5.5), (Key::B, 6.5)] {
        slide(&mut page, "Time", time);
        page.key_press(key);
        page.run_steps(2);
    }
    assert_eq!(app(&page).state().marks, [Some(5.5), Some(6.5)]);
    // Letting go is a frame of its own, which copies nothing.
    page.key_down(Key::C);
    page.step();
    let text = copied(&page).expect("copied");
    page.key_up(Key::C);
    page.step();
    assert!(text.starts_with("\tA\tB\tB − A\nt (s)\t5.500\t6.500\t1.000\n‖cm − cs‖ (mm)\t"), "{text}");
    let (name, _, numbers) = file(saved(&mut page, "Save plots", "CSV, A to B"));
    assert_eq!(name, "run-a-to-b-bench.csv");
    let rows: Vec<&str> = numbers.lines().collect();
    assert!(rows[1].starts_with("5.5,") && rows.last().is_some_and(|row| row.starts_with("6.5,")));
    assert_eq!(rows.len(), 1 + 1001);
    page.key_press(Key::Delete);
    page.run_steps(2);
    assert_eq!(app(&page).state().marks, [None; 2]);
    page.get_by_role_and_label(Role::Button, "Save plots").click();
    page.run_steps(2);
    assert!(page.query_by_label("CSV, A to B").is_none() && page.query_by_label("Copy A and B").is_none());
}

#[test]
fn shift_and_drag_on_a_plot_marks_both_times_and_a_click_removes_them() {
    let mut page = page_of(DESK);
    let time = app(&page).state().time;
    let plot = page.get_by_label("Plot of the tangent angle over time").rect();
    let shift = |page: &mut Page, down: bool| {
        page.event(egui::Event::ModifiersChanged(if down { Modifiers::SHIFT } else { Modifiers::NONE }));
    };
    let press = |page: &mut Page, x: f32, pressed: bool| {
        let pos = egui::pos2(plot.left() + x * plot.width(), plot.center().y);
        page.event(egui::Event::PointerMoved(pos));
        page.event(egui::Event::PointerButton {
            pos,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: Modifiers::SHIFT,
        });
        page.run_steps(2);
    };
    shift(&mut page, true);
    press(&mut page, 0.25, true);
    press(&mut page, 0.75, false);
    let [Some(a), Some(b)] = app(&page).state().marks else { panic!("{:?}", app(&page).state().marks) };
    assert!((a - 2.5).abs() < 0.05 && (b - 7.5).abs() < 0.05, "{a} {b}");
    assert_eq!(app(&page).state().time, time, "it does not scrub");
    press(&mut page, 0.5, true);
    press(&mut page, 0.5, false);
    assert_eq!(app(&page).state().marks, [None; 2]);
}
