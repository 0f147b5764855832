//! The tuning view, headless: what it says, what a drag does, and how it looks.

use centrode::app::stages::stage::Stage;
use centrode::app::{App, Host};
use centrode_core::scenario::Threshold;
use centrode_core::study::tuning::watch::Method;
use egui::accesskit::Role;
use egui::{Event, TouchDeviceId, TouchId, TouchPhase, Vec2, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

type Page = Harness<'static, Option<App>>;

const DESK: Vec2 = vec2(1440.0, 900.0);
const PHONE: Vec2 = vec2(390.0, 844.0);

fn page_of(size: Vec2, theme: egui::Theme) -> Page {
    let ui = |ui: &mut egui::Ui, app: &mut Option<App>| {
        let host = || Host { prefers_reduced_motion: true, ..Host::default() };
        app.get_or_insert_with(|| App::new(ui.ctx(), None, host())).ui(ui);
    };
    let setup = centrode::app::theme::install;
    let builder = Harness::builder().with_size(size).with_step_dt(0.1).with_theme(theme).with_context_setup(setup);
    let mut page = builder.wgpu().build_ui_state(ui, None);
    page.get_by_label("Pause").click();
    page.run_steps(2);
    // The page follows the system until someone chooses.
    for _ in 0..if theme == egui::Theme::Light { 1 } else { 2 } {
        page.get_by_label_contains("Theme: ").click();
        page.run_steps(2);
    }
    page.get_by_role_and_label(Role::Tab, "Tuning").click();
    page.run_steps(2);
    assert_eq!(app(&page).state().stage, Stage::Tuning);
    page
}

fn app(page: &Page) -> &App {
    page.state().as_ref().expect("built")
}

fn finish(page: &mut Page) {
    for _ in 0..4000 {
        page.step();
        if !app(page).is_working() {
            page.run_steps(2);
            return;
        }
    }
    panic!("the study never ends");
}

fn said(page: &Page, part: &str) -> String {
    let texts = page
        .query_all_by_label_contains(part)
        .filter_map(|node| node.accesskit_node().label().or_else(|| node.accesskit_node().value()));
    texts.collect::<Vec<_>>().join(" | ")
}

/// A picture for people to look at, where the environment names a directory.
fn picture(page: &mut Page, name: &str) {
    let image = page.render().expect("a picture");
    if let Ok(directory) = std::env::var("CENTRODE_PICTURES") {
        image.save(format!("{directory}/{name}.png")).expect("saved");
    }
}

fn xi2(page: &Page) -> Option<f64> {
    app(page).state().scenario.detection.xi2.value()
}

#[test]
fn it_says_what_the_thresholds_achieve_and_which_to_take() {
    let mut page = page_of(DESK, egui::Theme::Light);
    assert_eq!(app(&page).state().stage, Stage::Tuning);
    finish(&mut page);
    let now = said(&page, "free runs");
    assert!(now.contains("of 100 free runs") && now.contains("Contact on disk 2 is found"), "{now}");
    assert!(!said(&page, "Soonest with at most 5").is_empty());
    assert!(said(&page, "centrode study").contains("--preset bench --repeats 100 --sweep filter.length=50,100"));
    page.get_by_role_and_label(Role::Button, "Take it").click();
    page.run_steps(2);
    finish(&mut page);
    let scenario = &app(&page).state().scenario;
    assert_ne!((scenario.filter.length, scenario.detection.xi2), (500, Threshold::On(0.007)));
    assert!(said(&page, "centrode study").contains("study my.toml"));
    // What was advised is set now, and the live run uses it.
    let threshold = scenario.detection.xi2.value().expect("on") * 1e3;
    let now = said(&page, "Now, ");
    assert!(
        now.contains(&format!("= {threshold:.1}\u{a0}mm, N = {}", scenario.filter.length)),
        "{now} for {threshold}"
    );
    assert_eq!(app(&page).run().plan.scenario(), scenario);
}

#[test]
fn a_drag_on_each_picture_moves_the_threshold() {
    let mut page = page_of(DESK, egui::Theme::Dark);
    finish(&mut page);
    let figures = [
        "Contacts found against false alarms",
        "Delay against false alarms",
        "Delay by place of contact",
        "Median delay by filter length and threshold",
    ];
    for (k, figure) in figures.into_iter().enumerate() {
        let rect = page.get_by_role_and_label(Role::Figure, figure).rect();
        let before = xi2(&page);
        let (from, to) = (rect.lerp_inside(vec2(0.7, 0.3)), rect.lerp_inside(vec2(0.25 + 0.1 * k as f32, 0.8)));
        page.drag_at(from);
        page.run_steps(1);
        page.hover_at(to);
        page.run_steps(1);
        page.drop_at(to);
        page.run_steps(2);
        assert_ne!(xi2(&page), before, "{figure}");
        finish(&mut page);
    }
}

#[test]
fn a_finger_drags_the_dot_and_scrolls_from_anywhere_else() {
    let mut page = page_of(PHONE, egui::Theme::Dark);
    finish(&mut page);
    let finger = |page: &mut Page, at: egui::Pos2, phase: TouchPhase| {
        page.event(Event::Touch { device_id: TouchDeviceId(0), id: TouchId(0), phase, pos: at, force: None });
        page.event(Event::PointerMoved(at));
        if phase != TouchPhase::Move {
            let (button, pressed) = (egui::PointerButton::Primary, phase == TouchPhase::Start);
            page.event(Event::PointerButton { pos: at, button, pressed, modifiers: egui::Modifiers::NONE });
        }
        page.step();
    };
    let chart = |page: &Page| page.get_by_role_and_label(Role::Figure, "Delay against false alarms").rect();
    let (before, place) = (xi2(&page), chart(&page));
    let start = place.lerp_inside(vec2(0.8, 0.9));
    finger(&mut page, start, TouchPhase::Start);
    (1..=8).for_each(|k| finger(&mut page, start - vec2(0.0, 10.0 * k as f32), TouchPhase::Move));
    finger(&mut page, start - vec2(0.0, 80.0), TouchPhase::End);
    page.run_steps(3);
    assert_eq!(xi2(&page), before);
    assert!(chart(&page).top() < place.top() - 30.0, "it did not scroll: {:?} from {place:?}", chart(&page));
    // The dot of 7 mm: about 16 % of the runs alarm, and the delay is about 0.47 s.
    let place = chart(&page);
    let dot = place.lerp_inside(vec2(0.04 / 1.08 + 0.262 / 1.08, 1.0 - 0.469 / 1.04));
    finger(&mut page, dot, TouchPhase::Start);
    (1..=8).for_each(|k| finger(&mut page, dot + vec2(12.0 * k as f32, 0.0), TouchPhase::Move));
    finger(&mut page, dot + vec2(96.0, 0.0), TouchPhase::End);
    page.run_steps(3);
    assert!(xi2(&page) < before, "{:?} from {before:?}", xi2(&page));
}

#[test]
fn methods_wishes_and_runs_can_be_chosen_and_the_study_stopped() {
    let mut page = page_of(DESK, egui::Theme::Dark);
    page.run_steps(3);
    page.get_by_role_and_label(Role::Button, "Stop").click();
    page.run_steps(3);
    let held = app(&page).report();
    page.run_steps(5);
    assert_eq!(app(&page).report(), held);
    page.get_by_role_and_label(Role::Button, "Go on").click();
    finish(&mut page);
    let length = app(&page).state().scenario.filter.length;
    page.get_by_role_and_label(Role::RadioButton, "Forces").click();
    page.run_steps(2);
    page.get_by_role_and_label(Role::Button, "Take it").click();
    page.run_steps(2);
    let scenario = app(&page).state().scenario.clone();
    assert_eq!(scenario.filter.length, length, "joint forces are not filtered");
    assert_ne!(scenario.detection.xi1, Threshold::On(0.03));
    for (option, part) in [("Forces", "mN·m"), ("Both", "free runs"), ("Either", "free runs"), ("1 %", "At least 381")]
    {
        page.get_by_role_and_label(Role::RadioButton, option).click();
        page.run_steps(2);
        assert!(!said(&page, part).is_empty(), "{option}: {part}");
    }
    assert_eq!(app(&page).state().tuning.method, Method::Or);
}

#[test]
fn it_fits_in_every_size_and_theme_and_with_nothing_to_find() {
    for (size, form) in [(DESK, "desk"), (PHONE, "phone"), (vec2(844.0, 390.0), "low"), (vec2(1024.0, 768.0), "tablet")]
    {
        for (theme, look) in [(egui::Theme::Dark, "dark"), (egui::Theme::Light, "light")] {
            let mut page = page_of(size, theme);
            if size == DESK || size == PHONE {
                page.run_steps(6);
                picture(&mut page, &format!("tuning-begun-{form}-{look}"));
                finish(&mut page);
            } else {
                page.run_steps(130);
            }
            picture(&mut page, &format!("tuning-{form}-{look}"));
            if size == PHONE {
                page.hover_at(pos2(200.0, 400.0));
                page.event(egui::Event::MouseWheel {
                    unit: egui::MouseWheelUnit::Point,
                    delta: vec2(0.0, -600.0),
                    source: egui::MouseWheelSource::Unknown,
                    phase: egui::TouchPhase::Move,
                    modifiers: egui::Modifiers::NONE,
                });
                page.run_steps(8);
                picture(&mut page, &format!("tuning-scrolled-{form}-{look}"));
            }
        }
    }
}
