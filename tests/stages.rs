//! The paper on the page, headless: every figure, Table II and the map, chosen, drawn, and used.

use centrode::app::stages::stage::Stage;
use centrode::app::{App, Host};
use centrode_core::scenario::{Place, Start};
use egui::accesskit::Role;
use egui::{Vec2, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

type Page = Harness<'static, Option<App>>;

const DESK: Vec2 = vec2(1440.0, 900.0);
const PHONE: Vec2 = vec2(390.0, 844.0);

fn page_of(size: Vec2, theme: egui::Theme) -> Page {
    let ui = |ui: &mut egui::Ui, app: &mut Option<App>| {
        let app = app
            .get_or_insert_with(|| App::new(ui.ctx(), None, Host { prefers_reduced_motion: true, ..Host::default() }));
        app.ui(ui);
    };
    let setup = centrode::app::theme::install;
    let builder = Harness::builder().with_size(size).with_step_dt(0.1).with_theme(theme).with_context_setup(setup);
    let mut page = builder.wgpu().build_ui_state(ui, None);
    page.get_by_label("Pause").click();
    page.run_steps(2);
    // The page follows the system until someone chooses.
    let clicks = if theme == egui::Theme::Light { 1 } else { 2 };
    for _ in 0..clicks {
        page.get_by_label_contains("Theme: ").click();
        page.run_steps(2);
    }
    page
}

fn app(page: &Page) -> &App {
    page.state().as_ref().expect("built")
}

/// Opens the menu of stages and picks one; then waits until its work is done.
fn show(page: &mut Page, name: &str) {
    page.get_by_role_and_label(Role::ComboBox, "Show").click();
    page.run_steps(2);
    page.get_by_role_and_label(Role::ListBoxOption, name).click();
    page.run_steps(2);
    finish(page);
}

fn finish(page: &mut Page) {
    for _ in 0..400 {
        page.step();
        if !app(page).is_working() {
            page.run_steps(2);
            return;
        }
    }
    panic!("the work never ends");
}

fn labels(page: &Page, part: &str) -> Vec<String> {
    page.query_all_by_label_contains(part)
        .filter_map(|node| node.accesskit_node().label().or_else(|| node.accesskit_node().value()))
        .collect()
}

#[test]
fn each_figure_brings_its_preset_and_is_drawn_with_its_caption() {
    let mut page = page_of(DESK, egui::Theme::Light);
    for stage in Stage::ALL {
        let Some(number) = stage.figure() else { continue };
        show(&mut page, stage.name());
        assert_eq!(app(&page).state().preset, number.preset());
        let figures = labels(&page, number.title());
        assert!(figures.iter().any(|label| label.to_lowercase().contains("simulated")), "{stage:?}: {figures:?}");
        assert!(!labels(&page, &format!("centrode figure {}", number.digit())).is_empty(), "{stage:?}");
        picture(&mut page, &format!("{}-desk-light", number.preset()));
    }
    page.get_by_role_and_label(Role::RadioButton, "Robot").click();
    page.run_steps(2);
    assert_eq!(app(&page).state().stage, Stage::Robot);
}

#[test]
fn everything_fits_in_every_size_and_theme() {
    for (size, form) in [(DESK, "desk"), (PHONE, "phone"), (vec2(844.0, 390.0), "low"), (vec2(1024.0, 768.0), "tablet")]
    {
        for (theme, look) in [(egui::Theme::Dark, "dark"), (egui::Theme::Light, "light")] {
            let mut page = page_of(size, theme);
            for stage in [Stage::Figure4, Stage::Figure8, Stage::Table2, Stage::Map] {
                show(&mut page, stage.name());
                picture(&mut page, &format!("{}-{form}-{look}", stage.name().replace(' ', "-").to_lowercase()));
            }
        }
    }
}

#[test]
fn a_preset_of_its_own_takes_a_figure_off_the_stage_and_leaves_the_map() {
    let mut page = page_of(DESK, egui::Theme::Dark);
    let choose = |page: &mut Page, name: &str| {
        page.get_by_role_and_label(Role::ComboBox, "Preset").click();
        page.run_steps(2);
        page.get_by_role_and_label(Role::ListBoxOption, name).click();
        page.run_steps(2);
    };
    show(&mut page, "Figure 8");
    choose(&mut page, "Paper");
    assert_eq!(app(&page).state().stage, Stage::Robot);
    show(&mut page, "Map");
    choose(&mut page, "Bench");
    assert_eq!(app(&page).state().stage, Stage::Map);
}

#[test]
fn table_ii_stands_beside_the_simulated_one() {
    let mut page = page_of(DESK, egui::Theme::Dark);
    show(&mut page, "Table II");
    let paper = labels(&page, "The paper's experiment, disk 2");
    assert!(
        paper.iter().any(|row| row.contains("5 / 5") && row.contains("6.281") && row.contains("16.0")),
        "{paper:?}"
    );
    let ours = labels(&page, "Simulated by Centrode, disk 2");
    assert!(ours.iter().any(|row| row.contains("20 / 20")), "{ours:?}");
}

#[test]
fn a_click_on_the_map_puts_the_contact_there() {
    let mut page = page_of(DESK, egui::Theme::Dark);
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
    assert!(!labels(&page, "Contact at 22.").is_empty() || !labels(&page, "Contact at 22,").is_empty());
    assert!(app(&page).run().detection().is_some(), "the live run follows");
}

#[test]
fn a_control_makes_the_work_again() {
    let mut page = page_of(DESK, egui::Theme::Dark);
    show(&mut page, "Figure 8");
    let before = labels(&page, "Fixed centrode deviation").concat();
    page.get_by_role_and_label(Role::Slider, "Filter length N").set_value_accesskit(250.0);
    page.run_steps(2);
    finish(&mut page);
    let after = labels(&page, "Fixed centrode deviation").concat();
    assert!(before.contains("N = 500") && after.contains("N = 250"), "{before}\n{after}");
}

#[test]
fn odd_scenarios_are_shown_or_refused_in_words() {
    let mut page = page_of(DESK, egui::Theme::Dark);
    page.get_by_role_and_label(Role::Button, "Motion").click();
    page.run_steps(2);
    for (label, value) in [("Contact disk", 0.0), ("θL at the end", 90.0), ("Filter length N", 1.0), ("Run ends", 1.0)]
    {
        show(&mut page, "Map");
        page.get_by_role_and_label(Role::Slider, label).set_value_accesskit(value);
        page.run_steps(2);
        finish(&mut page);
        show(&mut page, "Table II");
    }
    for stage in Stage::ALL.into_iter().filter(|stage| stage.figure().is_some()) {
        show(&mut page, stage.name());
        page.get_by_role_and_label(Role::Slider, "Contact disk").set_value_accesskit(0.0);
        page.get_by_role_and_label(Role::Slider, "θL at the end").set_value_accesskit(90.0);
        page.run_steps(2);
        finish(&mut page);
    }
}

/// Draws; writes the picture to the folder that CENTRODE_PICTURES names, if it names one.
fn picture(page: &mut Page, name: &str) {
    let image = page.render().expect("picture");
    let first = *image.get_pixel(1, 1);
    let drawn = image.pixels().filter(|pixel| **pixel != first).count();
    assert!(drawn > 10_000, "{name}: {drawn} pixels drawn");
    if let Some(folder) = std::env::var_os("CENTRODE_PICTURES") {
        image.save(std::path::Path::new(&folder).join(format!("{name}.png"))).expect("written");
    }
}
