//! The views of the page, headless: every figure, Table II and the map, chosen, drawn, and used.

use crate::support::{DESK, LOW, PHONE, Page, TABLET, app, finish, fits, page_of, texts};
use centrode::app::stages::comparer::Comparer;
use centrode::app::stages::stage::{Section, Stage};
use centrode::app::stages::studies::Studies;
use centrode::app::stages::tuner::Tuner;
use centrode::app::stages::{Inputs, StageState, stage};
use centrode::app::state::Tuning;
use centrode_core::run::simulate;
use centrode_core::scenario::{Place, Scenario, Start};
use egui::accesskit::Role;
use egui::{Key, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

/// High enough that no group of controls is scrolled out of sight.
const TALL: egui::Vec2 = vec2(1440.0, 1900.0);

/// Picks a stage: its view in the bar, and what of the paper it is; then waits until its work is done.
pub fn show(page: &mut Page, name: &str) {
    let stage = Stage::ALL.into_iter().find(|stage| stage.name() == name).expect("a stage");
    page.get_by_role_and_label(Role::Tab, stage.section().name()).click();
    page.run_steps(2);
    if matches!(stage.section(), Section::Paper) || stage == Stage::Detectors {
        page.get_by_role_and_label(Role::RadioButton, name).click();
        page.run_steps(2);
    }
    assert_eq!(app(page).state().stage, stage);
    finish(page);
}

/// Picks a preset from the menu.
fn choose(page: &mut Page, name: &str) {
    page.get_by_role_and_label(Role::ComboBox, "Preset").click();
    page.run_steps(2);
    page.get_by_role_and_label(Role::ListBoxOption, name).click();
    page.run_steps(2);
}

fn slide(page: &mut Page, label: &str, value: f64) {
    page.get_by_role_and_label(Role::Slider, label).set_value_accesskit(value);
    page.run_steps(2);
    finish(page);
}

#[test]
fn each_figure_is_drawn_from_its_own_preset_and_leaves_what_is_set() {
    let mut page = page_of(DESK);
    slide(&mut page, "Filter length N", 321.0);
    let set = app(&page).state().scenario.clone();
    for stage in Stage::PAPER {
        show(&mut page, stage.name());
        let Some(number) = stage.figure() else { continue };
        let figures = texts(&page, number.title());
        assert!(figures.iter().any(|label| label.to_lowercase().contains("simulated")), "{stage:?}: {figures:?}");
        assert!(!figures.concat().contains("N = 321"), "{stage:?} follows a scenario that is not its own");
        assert!(!texts(&page, &format!("preset Figure {}, not with what is set", number.digit())).is_empty());
        let command = texts(&page, &format!("centrode figure {}", number.digit())).concat();
        assert!(!command.contains("my.toml"), "{command}");
        assert_eq!((&app(&page).state().scenario, app(&page).state().preset.as_str()), (&set, "bench"));
    }
    page.get_by_role_and_label(Role::Tab, "Robot").click();
    page.run_steps(2);
    assert_eq!((app(&page).state().stage, &app(&page).state().scenario), (Stage::Robot, &set));
}

#[test]
fn a_figures_scenario_is_taken_over_by_one_click_and_then_follows_the_controls() {
    let mut page = page_of(DESK);
    show(&mut page, "Figure 8");
    page.get_by_role_and_label(Role::Button, "Use this scenario").click();
    page.run_steps(2);
    finish(&mut page);
    let state = app(&page).state();
    assert_eq!((state.stage, state.preset.as_str()), (Stage::Figure8, "figure-8"));
    assert!(page.query_by_role_and_label(Role::Button, "Use this scenario").is_none());
    let before = texts(&page, "Fixed centrode deviation").concat();
    slide(&mut page, "Filter length N", 250.0);
    let after = texts(&page, "Fixed centrode deviation").concat();
    assert!(before.contains("N = 500") && after.contains("N = 250"), "{before}\n{after}");
    assert!(!texts(&page, "preset Figure 8, changed").is_empty());
    assert!(texts(&page, "centrode figure 8").concat().contains("my.toml"));
}

#[test]
fn every_view_is_in_sight_on_every_screen_and_the_paper_opens_where_it_was_left() {
    for size in [DESK, PHONE, vec2(320.0, 568.0), vec2(844.0, 390.0), vec2(568.0, 320.0), vec2(712.0, 900.0)] {
        let mut page = page_of(size);
        let screen = egui::Rect::from_min_size(pos2(0.0, 0.0), size);
        for section in Section::ALL {
            let rect = page.get_by_role_and_label(Role::Tab, section.name()).rect();
            assert!(screen.contains_rect(rect) && rect.width() > 40.0, "{size}: {section:?} at {rect}");
        }
        show(&mut page, "Figure 7");
        show(&mut page, "Map");
        page.get_by_role_and_label(Role::Tab, "Paper").click();
        page.run_steps(2);
        assert_eq!(app(&page).state().stage, Stage::Figure7);
    }
}

#[test]
fn everything_fits_in_every_size() {
    let mut page = page_of(DESK);
    for stage in Stage::ALL.into_iter().filter(|stage| stage.section() != Section::Tuning) {
        show(&mut page, stage.name());
        for size in [PHONE, LOW, TABLET, vec2(1280.0, 720.0), DESK] {
            page.set_size(size);
            page.run_steps(3);
            fits(&page, size, stage.name());
        }
    }
}

#[test]
fn a_preset_of_its_own_takes_a_figure_off_the_stage_and_leaves_the_map() {
    let mut page = page_of(DESK);
    show(&mut page, "Figure 8");
    choose(&mut page, "Paper");
    assert_eq!(app(&page).state().stage, Stage::Robot);
    show(&mut page, "Map");
    choose(&mut page, "Bench");
    assert_eq!(app(&page).state().stage, Stage::Map);
}

#[test]
fn table_ii_keeps_its_noise_where_the_page_has_none() {
    let mut page = page_of(DESK);
    choose(&mut page, "Figure 4");
    assert_eq!(app(&page).state().scenario.tracker.position_noise, 0.0, "a preset without noise");
    show(&mut page, "Table II");
    let ours = texts(&page, "Simulated: a beam that clamps, disk").concat();
    assert!(ours.contains("20 / 20") && !ours.contains("± 0.000"), "{ours}");
    assert!(!texts(&page, "preset Bench, not with what is set").is_empty());
}

#[test]
fn table_ii_stands_beside_the_simulated_one() {
    let mut page = page_of(DESK);
    show(&mut page, "Table II");
    let paper = texts(&page, "The paper's experiment, disk 2");
    assert!(
        paper.iter().any(|row| row.contains("5 / 5") && row.contains("6.281") && row.contains("16.0")),
        "{paper:?}"
    );
    for kind in ["a beam that clamps", "a flat beam that touches"] {
        let ours = texts(&page, &format!("Simulated: {kind}, disk 2"));
        assert!(ours.iter().any(|row| row.contains("20 / 20")), "{ours:?}");
    }
    let estimates = page.get_by_label_contains("Estimated places of contact");
    let (rect, said) = (estimates.rect(), estimates.accesskit_node().label().unwrap_or_default());
    // 15 rows of the paper, and the runs that found the contact.
    let found = |row: &String| row.split("Found ").nth(1)?.split(' ').next()?.parse::<usize>().ok();
    let drawn = |row: &&String| !row.contains("CUSUM");
    let marks = 15 + texts(&page, "Simulated: ").iter().filter(drawn).filter_map(found).sum::<usize>();
    assert!(said.contains(&format!("{marks} marks")) && marks > 60, "{said}");
    assert!(said.contains("disk 2 at 15.0 mm: paper "), "{said}");
    assert!(rect.height() > 100.0 && rect.bottom() < 640.0, "{rect}");
}

#[test]
fn table_ii_has_a_part_of_its_own_for_the_calibration_filter() {
    let mut page = page_of(DESK);
    for (link, shown) in [("preset=bench&detection.cusum=off&view=table2", false), ("preset=bench&view=table2", true)] {
        page.state_mut().as_mut().expect("built").go(link);
        page.run_steps(2);
        finish(&mut page);
        assert_eq!(!texts(&page, "noticed by CUSUM").is_empty(), shown, "{link}");
    }
    let rows = texts(&page, "Simulated: noticed by CUSUM, placed half a second later, disk 2");
    assert!(rows.iter().any(|row| row.contains("20 / 20") && row.contains("Estimate 15.")), "{rows:?}");
    let held = texts(&page, "95 % intervals that hold the true place").concat();
    assert!(held.contains("disk 1: ") && held.contains(" of 20"), "{held}");
    fits(&page, DESK, "Table II with CUSUM");
}

#[test]
fn a_click_on_the_map_puts_the_contact_there() {
    let mut page = page_of(DESK);
    show(&mut page, "Map");
    let map = page.get_by_label_contains("Map of the largest ξ2").rect();
    let at = pos2(map.left() + 0.5 * map.width(), map.top() + 0.25 * map.height());
    page.drag_at(at);
    page.run_steps(1);
    page.drop_at(at);
    page.run_steps(3);
    let contact = app(&page).state().scenario.contact;
    let (Place::ArcLength(place), Start::Bend(bend)) = (contact.place, contact.start) else { panic!("{contact:?}") };
    assert!((place - 0.0225).abs() < 2e-4 && (bend - std::f64::consts::FRAC_PI_4).abs() < 0.01, "{place} {bend}");
    assert!(!app(&page).is_working(), "the map does not depend on the contact");
    assert!(!texts(&page, "Contact at 22.").is_empty() || !texts(&page, "Contact at 22,").is_empty());
    assert!(app(&page).run().detection().is_some(), "the live run follows");
}

#[test]
fn odd_scenarios_are_shown_or_refused_in_words() {
    let mut page = page_of(TALL);
    page.get_by_role_and_label(Role::Button, "Motion").click();
    page.run_steps(2);
    for (label, value) in [("Contact disk", 0.0), ("θL at the end", 90.0), ("Filter length N", 1.0), ("Run ends", 1.0)]
    {
        show(&mut page, "Map");
        slide(&mut page, label, value);
        show(&mut page, "Table II");
    }
    for stage in Stage::PAPER {
        show(&mut page, stage.name());
        page.get_by_role_and_label(Role::Button, "Use this scenario").click();
        page.run_steps(2);
        slide(&mut page, "Contact disk", 0.0);
        slide(&mut page, "θL at the end", 90.0);
        let said = [stage.summary(), "Simulated: a beam", "cannot be shown"].map(|part| texts(&page, part));
        assert!(said.iter().any(|labels| !labels.is_empty()), "{stage:?} shows nothing and says nothing");
    }
}

/// What is said in the place of a stage that this scenario, which no control sets, makes impossible.
fn refused(shown: Stage, scenario: Scenario) -> String {
    let run = simulate(&Scenario::default()).expect("a run");
    let (mut studies, mut tuner, mut state) = (Studies::default(), Tuner::new(None), StageState::default());
    let mut comparer = Comparer::new(None);
    let (tuning, comparing) = (shown == Stage::Tuning, shown == Stage::Detectors);
    let page = Harness::builder().with_size(DESK).build_ui(move |ui| {
        centrode::app::theme::install(ui.ctx());
        tuner.update(tuning.then_some(&scenario), 5, false);
        comparer.update(comparing.then_some(&scenario), &Tuning::default(), false);
        studies.update(shown, &scenario);
        let (base, tuner) = (("paper", &scenario), &tuner);
        let (log, source, comparer, tuning) = (false, None, &comparer, Tuning::default());
        let inputs = Inputs { stage: shown, plan: &run.plan, log, base, source, tuner, comparer, tuning };
        stage(ui, ui.max_rect(), &inputs, &mut studies, &mut state, &mut Vec::new());
    });
    let said = |node: egui_kittest::Node<'_>| node.accesskit_node().label().or_else(|| node.accesskit_node().value());
    page.query_all_by_label_contains("cannot be shown").filter_map(said).collect()
}

#[test]
fn what_cannot_be_shown_is_refused_in_the_units_of_the_page() {
    let with = |change: fn(&mut Scenario)| {
        let mut scenario = Scenario::default();
        change(&mut scenario);
        scenario
    };
    let disks = with(|scenario| (scenario.contact.place, scenario.robot.disks) = (Place::disk(1), vec![0.01, 0.02]));
    let said = "Table II cannot be shown: robot.disks = [10 mm, 20 mm] is not allowed: at least three disks";
    let refusal = refused(Stage::Table2, disks);
    assert!(refusal.starts_with(said), "{refusal}");
    let short = with(|scenario| scenario.robot.length = 0.02);
    let bent = with(|scenario| scenario.contact.start = Start::Bend(7.0));
    for shown in Stage::ALL.into_iter().filter(|stage| !stage.is_run()) {
        let said = format!("{} cannot be shown: robot.disks[2] = 22.5 mm is not allowed: ", shown.name());
        let refusal = refused(shown, short.clone());
        assert!(refusal.starts_with(&said) && refusal.contains("robot.length = 20 mm"), "{refusal}");
        let said = format!("{} cannot be shown: Contact bend 401.07°: ", shown.name());
        let refusal = refused(shown, bent.clone());
        let own = matches!(shown, Stage::Table2 | Stage::Map);
        assert!(own || refusal.starts_with(&said), "{refusal}");
    }
}

#[test]
fn keys_do_nothing_behind_the_help() {
    let mut page = page_of(DESK);
    page.get_by_role_and_label(Role::Slider, "Time").set_value_accesskit(5.0);
    page.run_steps(2);
    page.get_by_role_and_label(Role::Button, "Help").click();
    page.run_steps(2);
    for key in [Key::Space, Key::ArrowRight, Key::Home, Key::End] {
        page.key_press(key);
        page.run_steps(2);
        let state = app(&page).state();
        assert_eq!((state.help, state.playing, state.time), (true, false, 5.0), "{key:?}");
    }
    page.key_press(Key::Escape);
    page.run_steps(2);
    page.key_press(Key::ArrowRight);
    page.run_steps(2);
    assert_eq!((app(&page).state().help, app(&page).state().time), (false, 5.01));
}

#[test]
fn the_clock_shows_the_cursor_of_the_views() {
    let mut page = page_of(TALL);
    page.get_by_role_and_label(Role::Button, "Motion").click();
    page.run_steps(2);
    slide(&mut page, "Time", 9.5);
    slide(&mut page, "Run ends", 8.0);
    let clock = page.get_by_role_and_label(Role::Slider, "Time");
    let node = clock.accesskit_node();
    assert_eq!((node.numeric_value(), node.value().as_deref()), (Some(8.0), Some("8.000 s")));
    assert!(app(&page).report().contains("\"time\":8.0"));
}
