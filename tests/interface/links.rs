//! Links, files and what is copied, headless: the page in an address, and what it says of one that is broken.

use crate::stages::show;
use crate::support::{DESK, PHONE, Page, app, build, click, fits, page_of, paused, slide, texts};
use centrode::app::link::Effect;
use centrode::app::stages::stage::Stage;
use centrode::app::theme::ThemeChoice;
use centrode::app::{App, Host};
use centrode_core::scenario::link::page::VIEWS;
use centrode_core::scenario::link::{Link, Page as Shown};
use centrode_core::scenario::{Scenario, Threshold};
use egui::accesskit::Role;
use egui::{Event, Key, OutputCommand, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

const ADDRESS: &str = "https://example.org/centrode/";

/// A page at an address with this fragment.
fn page_at(size: Vec2, fragment: &'static str) -> Page {
    let ui = move |ui: &mut egui::Ui, app: &mut Option<App>| {
        let host = || Host { address: ADDRESS.into(), fragment: fragment.into(), ..Host::default() };
        app.get_or_insert_with(|| App::new(ui.ctx(), None, host())).ui(ui);
    };
    let builder = Harness::builder().with_size(size).with_step_dt(0.1).with_theme(egui::Theme::Dark);
    builder.with_context_setup(centrode::app::theme::install).build_ui_state(ui, None)
}

fn handle(page: &mut Page) -> &mut App {
    page.state_mut().as_mut().expect("built")
}

/// What the address was told since this was last asked, and whether each was a step.
fn told(page: &mut Page) -> Vec<(String, bool)> {
    let effects = handle(page).take_effects().into_iter();
    let addresses = effects.map(|effect| match effect {
        Effect::Address { fragment, step } => (fragment, step),
        other => panic!("{other:?}"),
    });
    addresses.collect()
}

fn pick(page: &mut Page, item: &str) {
    click(page, "Share");
    page.get_by_role_and_label(Role::MenuItem, item).click();
    page.step();
}

/// What the last frame copied.
fn copied(page: &Page) -> String {
    let commands = page.output().platform_output.commands.iter();
    let mut texts = commands.filter_map(|command| match command {
        OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    texts.next().unwrap_or_default()
}

/// Picks an item that copies, and gives what it copied.
fn copy(page: &mut Page, role: Role, item: &str) -> String {
    page.get_by_role_and_label(role, item).click();
    for _ in 0..4 {
        page.step();
        let text = copied(page);
        if !text.is_empty() {
            return text;
        }
    }
    panic!("{item} copies nothing");
}

#[test]
fn every_stage_has_a_name_in_links_and_the_defaults_agree() {
    assert_eq!(Stage::ALL.map(Stage::key), VIEWS);
    let page = page_at(DESK, "preset=bench");
    let (state, shown) = (app(&page).state(), Shown::default());
    assert_eq!((state.stage.key(), state.speed, state.looping), (shown.view, shown.speed, shown.looping));
    let tuning = state.tuning;
    assert_eq!((tuning.rule.name(), tuning.wish), (shown.rule, shown.false_alarms));
    assert_eq!(tuning.repeats as u64, shown.repeats);
    assert!(app(&page).notice().is_none() && state.playing);
}

#[test]
fn a_link_is_what_the_page_opens_on() {
    let link = "preset=disk-3&seed=7&detection.xi2=off&view=tuning&t=6.27&speed=0.5&loop=off&rule=or&false_alarms=0.1&repeats=400";
    let mut page = page_at(DESK, link);
    let state = app(&page).state().clone();
    assert_eq!((state.preset.as_str(), state.stage, state.time, state.playing), ("disk-3", Stage::Tuning, 6.27, false));
    assert_eq!((state.scenario.seed, state.scenario.detection.xi2), (7, Threshold::OFF));
    assert_eq!((state.speed, state.looping, state.tuning.repeats, state.tuning.wish), (0.5, false, 400, 0.1));
    page.run_steps(2);
    assert_eq!(app(&page).run().plan.scenario(), &state.scenario);
    assert_eq!(told(&mut page), [], "an address that says it already");
    let mut page = page_at(DESK, "preset=figure-8&view=figure-8");
    page.run_steps(2);
    assert_eq!((app(&page).state().stage, app(&page).state().paper), (Stage::Figure8, Stage::Figure8));
    assert!(app(&page).state().playing);
}

#[test]
fn the_address_follows_and_knows_steps_from_what_passes() {
    let mut page = paused(page_at(DESK, ""));
    let paused = told(&mut page);
    assert!(matches!(&paused[..], [(text, false)] if text.starts_with("preset=bench&t=")), "{paused:?}");
    slide(&mut page, "Time", 6.0);
    assert_eq!(told(&mut page), [("preset=bench&t=6".into(), false)]);
    slide(&mut page, "Contact disk", 3.0);
    assert_eq!(told(&mut page), [("preset=bench&contact.disk=3&t=6".into(), true)]);
    // The same slider again, by the keyboard: still the same step.
    slide(&mut page, "Contact disk", 1.0);
    assert_eq!(told(&mut page), [("preset=bench&contact.disk=1&t=6".into(), false)]);
    slide(&mut page, "Seed", 7.0);
    assert_eq!(told(&mut page), [("preset=bench&seed=7&contact.disk=1&t=6".into(), true)]);
    slide(&mut page, "Speed", 2.0);
    assert_eq!(told(&mut page), [("preset=bench&seed=7&contact.disk=1&t=6&speed=2".into(), false)]);
    show(&mut page, "Map");
    assert_eq!(told(&mut page), [("preset=bench&seed=7&contact.disk=1&view=map&t=6&speed=2".into(), true)]);
    click(&mut page, "Play");
    page.run_steps(5);
    assert_eq!(told(&mut page), [("preset=bench&seed=7&contact.disk=1&view=map&speed=2".into(), false)]);
}

#[test]
fn a_drag_is_one_step_when_it_is_released() {
    let mut page = paused(page_at(DESK, ""));
    told(&mut page);
    for _ in 0..2 {
        let rect = page.get_by_role_and_label(Role::Slider, "Filter length N").rect();
        page.drag_at(rect.left_center() + vec2(8.0, 0.0));
        page.run_steps(2);
        page.hover_at(rect.center());
        page.run_steps(2);
        assert_eq!(told(&mut page), [], "while the pointer is down");
        page.drop_at(rect.center() + vec2(4.0, 0.0));
        page.run_steps(2);
        let steps = told(&mut page);
        assert!(steps.iter().any(|(text, step)| *step && text.contains("filter.length=")), "{steps:?}");
        slide(&mut page, "Filter length N", 500.0);
        told(&mut page);
    }
}

#[test]
fn back_and_forward_restore() {
    let mut page = paused(page_at(DESK, ""));
    slide(&mut page, "Contact disk", 3.0);
    let there = told(&mut page).pop().expect("a step").0;
    show(&mut page, "Map");
    page.get_by_role_and_label(Role::ComboBox, "Preset").click();
    page.run_steps(2);
    page.get_by_role_and_label(Role::ListBoxOption, "Free").click();
    page.run_steps(2);
    assert_eq!(app(&page).state().preset, "free");
    told(&mut page);
    handle(&mut page).go(&there);
    page.run_steps(2);
    let (link, broken) = Link::read(&there);
    assert!(broken.is_empty());
    let state = app(&page).state();
    assert_eq!((&state.scenario, state.stage, state.preset.as_str()), (link.scenario(), Stage::Robot, "bench"));
    assert_eq!(app(&page).run().plan.scenario(), link.scenario());
    assert_eq!(told(&mut page), [], "going somewhere is no step from there");
}

#[test]
fn a_broken_link_is_told_in_the_page_s_words() {
    for size in [DESK, PHONE] {
        let mut page = page_at(
            size,
            "preset=bench&contact.disk=9&filter.length=0.5&bogus=1&detection.xi2=-1&motion.end=300&seed=7&t=6.27",
        );
        page.run_steps(2);
        let state = app(&page).state().clone();
        assert_eq!((state.scenario.seed, state.time, state.scenario.motion.end), (7, 6.27, 10.0), "the rest is taken");
        assert!(page.query_by_label("This link could not be read whole").is_some());
        for said in [
            "contact.disk=9",
            "Contact disk 9: a disk from 1 to 3, the robot's spacer disks, or 0 for no contact.",
            "Used instead: Contact disk 2.",
            "bogus=1",
            "Unknown key bogus; known keys: preset, loop_rate, seed",
            "filter.length=0.5",
            "ξ2 (centrode) −1000.0",
            "Run ends 300.00 s: at most 200000 samples",
            "Used instead: Run ends 10\u{a0}s.",
        ] {
            assert!(!texts(&page, said).is_empty(), "{said:?} at {size}: {:?}", app(&page).notice());
        }
        fits(&page, size, "the notice");
        let details = copy(&mut page, Role::Button, "Copy details");
        assert!(details.contains("contact.disk = 9 is not allowed") && details.contains("preset=bench&contact.disk=9"));
        click(&mut page, "Go on");
        assert!(app(&page).notice().is_none() && page.query_by_label("Go on").is_none());
        assert_eq!(app(&page).state(), &state);
    }
    let mut page = page_at(DESK, "v=2");
    page.run_steps(2);
    assert!(!texts(&page, "The link was written by a newer page").is_empty());
    page.key_press(Key::Escape);
    page.run_steps(2);
    assert!(app(&page).notice().is_none());
}

#[test]
fn keys_belong_to_the_notice_while_it_is_open() {
    let mut page = page_at(DESK, "bogus=1&t=2");
    page.run_steps(2);
    page.key_press(Key::Space);
    page.run_steps(2);
    assert!(!app(&page).state().playing && app(&page).notice().is_some());
}

#[test]
fn link_and_command_are_copied() {
    let mut page = paused(page_at(DESK, ""));
    slide(&mut page, "Time", 6.27);
    slide(&mut page, "Contact disk", 3.0);
    click(&mut page, "Share");
    let link = copy(&mut page, Role::MenuItem, "Copy link");
    assert_eq!(link, format!("{ADDRESS}#preset=bench&contact.disk=3&t=6.27"));
    page.run_steps(2);
    assert!(page.query_by_label("Link copied").is_some());
    page.run_steps(40);
    assert!(page.query_by_label("Link copied").is_none(), "said in passing");
    click(&mut page, "Share");
    let command = copy(&mut page, Role::MenuItem, "Copy command");
    assert_eq!(command, "centrode run --preset bench --set contact.disk=3");
    // A figure is made with a scenario of its own.
    show(&mut page, "Figure 8");
    click(&mut page, "Share");
    let command = copy(&mut page, Role::MenuItem, "Copy command");
    assert_eq!(command, "centrode figure 8 --preset figure-8 --out figure-8.svg");
    // While it plays, a copied link stands where the person saw it.
    click(&mut page, "Play");
    page.run_steps(3);
    click(&mut page, "Share");
    assert!(copy(&mut page, Role::MenuItem, "Copy link").contains("&t="));
}

#[test]
fn a_scenario_is_saved_and_opened_again() {
    let mut page = page_of(DESK);
    slide(&mut page, "Contact disk", 3.0);
    slide(&mut page, "Seed", 7.0);
    let set = app(&page).state().scenario.clone();
    handle(&mut page).take_effects();
    pick(&mut page, "Save scenario");
    page.step();
    let saved = handle(&mut page).take_effects();
    let [Effect::Save { name, kind, bytes }] = &saved[..] else { panic!("{saved:?}") };
    let text = std::str::from_utf8(bytes).expect("text");
    assert_eq!((name.as_str(), *kind), ("centrode-bench.toml", "application/toml"));
    assert_eq!(Scenario::from_toml(text), Ok(set.clone()));
    pick(&mut page, "Open scenario");
    page.step();
    assert_eq!(handle(&mut page).take_effects(), [Effect::Choose]);
    let mut other = page_of(DESK);
    handle(&mut other).opened(name, Ok(bytes.clone()));
    other.run_steps(2);
    assert_eq!((&app(&other).state().scenario, app(&other).state().preset.as_str()), (&set, "bench"));
    assert!(other.query_by_label("centrode-bench.toml opened").is_some());
    let steps = told(&mut other);
    assert!(steps.iter().any(|(text, step)| *step && text.contains("contact.disk=3")), "{steps:?}");
    // A preset's own file is that preset, and a figure makes room for it.
    show(&mut other, "Figure 8");
    let free = centrode_core::scenario::preset::find("free").expect("a preset");
    handle(&mut other).opened("free.toml", Ok(free.toml.into()));
    other.run_steps(2);
    assert_eq!((app(&other).state().preset.as_str(), app(&other).state().stage), ("free", Stage::Robot));
}

#[test]
fn a_file_that_cannot_be_opened_changes_nothing() {
    for (bytes, said) in [
        (Ok(b"[contact]\ndisk = 9\n".to_vec()), "Contact disk 9: a disk from 1 to 3"),
        (Ok(b"seed = [".to_vec()), "Line 1: "),
        (Ok(b"\xff\xfe".to_vec()), "byte 0 is not UTF-8"),
        (Ok(b"[motion]\nend = 300\n".to_vec()), "Run ends 300.00 s: at most 200000 samples"),
        (Ok(vec![b' '; (1 << 20) + 1]), "larger than 1 MiB"),
        (Err("It could not be read: gone".to_owned()), "could not be read: gone"),
    ] {
        let mut page = page_of(DESK);
        slide(&mut page, "Seed", 7.0);
        let before = app(&page).state().clone();
        handle(&mut page).take_effects();
        handle(&mut page).opened("mine.toml", bytes);
        page.run_steps(2);
        assert!(page.query_by_label("mine.toml was not opened").is_some());
        assert!(!texts(&page, said).is_empty(), "{said}: {:?}", app(&page).notice());
        assert!(!texts(&page, "Nothing was changed.").is_empty());
        click(&mut page, "Go on");
        assert_eq!(app(&page).state(), &before);
        assert_eq!(told(&mut page), []);
    }
}

#[test]
fn a_scenario_too_long_for_a_link_is_said_to_need_a_file() {
    let mut page = page_of(DESK);
    let disks: Vec<String> = (1..1500).map(|i| format!("{}", f64::from(i) * 0.03 / 1501.0)).collect();
    let text = format!("[contact]\ndisk = 0\n[robot]\ndisks = [{}]\n", disks.join(", "));
    handle(&mut page).opened("many.toml", Ok(text.into_bytes()));
    page.run_steps(6);
    let notice = app(&page).notice().expect("the address is another one's");
    assert!(notice.title.contains("address does not hold"), "{notice:?}");
    click(&mut page, "Go on");
    slide(&mut page, "Seed", 5.0);
    assert_eq!(app(&page).notice(), None, "once is enough");
    page.run_steps(6);
    pick(&mut page, "Copy link");
    page.run_steps(2);
    assert!(!texts(&page, "save the scenario as a file instead").is_empty(), "{:?}", app(&page).notice());
}

#[test]
fn a_typed_value_is_a_step() {
    let mut page = paused(build(Harness::builder().with_size(DESK), None));
    told(&mut page);
    page.get_by_role_and_label(Role::TextInput, "Seed value").click();
    page.run_steps(2);
    page.event(Event::Text("55".into()));
    page.run_steps(2);
    page.key_press(Key::Enter);
    page.run_steps(2);
    let steps = told(&mut page);
    assert!(matches!(&steps[..], [(text, true)] if text.contains("&seed=55&t=")), "{steps:?}");
}

#[test]
fn the_end_is_in_the_link_however_many_decimals_it_has() {
    let mut page = page_of(DESK);
    handle(&mut page).go("preset=bench&motion.end=9.00005");
    page.run_steps(2);
    page.key_press(Key::End);
    page.run_steps(3);
    let fragments = told(&mut page);
    let (last, _) = fragments.last().expect("an address");
    let (link, broken) = Link::read(last);
    assert!(broken.is_empty() && link.page.time.is_some_and(|time| time > 8.99), "{last}: {broken:?}");
}

#[test]
fn a_theme_comes_by_a_link_and_goes_out_by_it_once_somebody_has_chosen_one() {
    let mut page = page_at(DESK, "preset=disk-3&t=6&theme=light");
    page.run_steps(2);
    assert_eq!(page.ctx.theme(), egui::Theme::Light);
    assert_eq!(told(&mut page), [], "the address says it already");
    page.get_by_label_contains("Theme: ").click();
    page.run_steps(2);
    assert_eq!(told(&mut page), [("preset=disk-3&t=6&theme=projector".to_owned(), false)], "nothing to go back to");
    pick(&mut page, "Copy link");
    assert_eq!(copied(&page), format!("{ADDRESS}#preset=disk-3&t=6&theme=projector"));
    // A link that names none leaves it to who looks.
    handle(&mut page).go("preset=disk-3&t=6");
    page.run_steps(2);
    assert_eq!(app(&page).state().theme, ThemeChoice::Projector);
    handle(&mut page).go("preset=disk-3&t=6&theme=system");
    page.run_steps(2);
    assert_eq!((app(&page).state().theme, page.ctx.theme()), (ThemeChoice::System, egui::Theme::Dark));
    let mut page = page_at(DESK, "preset=disk-3&t=6");
    page.run_steps(2);
    pick(&mut page, "Copy link");
    assert!(copied(&page).ends_with("#preset=disk-3&t=6"), "{}", copied(&page));
    let page = page_at(DESK, "theme=pink");
    let notice = app(&page).notice().expect("a notice");
    assert!(notice.details.contains("theme") && notice.details.contains("projector"), "{notice:?}");
}
