//! A page to try things on, and the hands to use it.

use centrode::app::{App, Host};
use egui::accesskit::Role;
use egui::{Rect, Vec2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use egui_kittest::{Harness, HarnessBuilder, Node};
use egui_wgpu::RenderState;

pub type Page = Harness<'static, Option<App>>;

pub const DESK: Vec2 = vec2(1440.0, 900.0);
pub const PHONE: Vec2 = vec2(390.0, 844.0);
pub const LOW: Vec2 = vec2(844.0, 390.0);
pub const TABLET: Vec2 = vec2(1024.0, 768.0);

/// A page as a person finds it, with a 3D view where there is a GPU.
pub fn build(builder: HarnessBuilder<Option<App>>, gpu: Option<RenderState>) -> Page {
    let ui = move |ui: &mut egui::Ui, app: &mut Option<App>| {
        let host = || Host { prefers_reduced_motion: true, ..Host::default() };
        app.get_or_insert_with(|| App::new(ui.ctx(), gpu.as_ref(), host())).ui(ui);
    };
    let setup = centrode::app::theme::install;
    builder.with_step_dt(0.1).with_theme(egui::Theme::Dark).with_context_setup(setup).build_ui_state(ui, None)
}

/// A page of a size without a 3D view, paused.
pub fn page_of(size: Vec2) -> Page {
    paused(build(Harness::builder().with_size(size), None))
}

pub fn paused(mut page: Page) -> Page {
    // Who wants less motion starts it, which ends nothing that is said at the first playback; stopping it does.
    if page.query_by_label("Play").is_some() {
        click(&mut page, "Play");
    }
    click(&mut page, "Pause");
    page
}

/// Chooses a theme: the page follows the system until someone does.
pub fn choose_theme(page: &mut Page, theme: egui::Theme) {
    for _ in 0..if theme == egui::Theme::Light { 2 } else { 1 } {
        page.get_by_label_contains("Theme: ").click();
        page.run_steps(2);
    }
}

pub fn app(page: &Page) -> &App {
    page.state().as_ref().expect("built")
}

pub fn slider<'a>(page: &'a Page, label: &'a str) -> Node<'a> {
    page.get_by_role_and_label(Role::Slider, label)
}

pub fn slide(page: &mut Page, label: &str, value: f64) {
    slider(page, label).set_value_accesskit(value);
    page.run_steps(2);
}

pub fn click(page: &mut Page, label: &str) {
    page.get_by_label(label).click();
    page.run_steps(2);
}

/// Waits until the work for what is on the stage is done.
pub fn finish(page: &mut Page) {
    for _ in 0..4000 {
        page.step();
        if !app(page).is_working() {
            page.run_steps(2);
            return;
        }
    }
    panic!("the work never ends");
}

/// Every text on the page that contains `part`.
pub fn texts(page: &Page, part: &str) -> Vec<String> {
    page.query_all_by_label_contains(part)
        .filter_map(|node| node.accesskit_node().label().or_else(|| node.accesskit_node().value()))
        .collect()
}

/// Panics unless everything lies within the page's width, and pictures are large enough to read and apart.
pub fn fits(page: &Page, size: Vec2, what: &str) {
    let screen = Rect::from_min_size(egui::Pos2::ZERO, size).expand(0.5);
    let mut pictures: Vec<Rect> = Vec::new();
    for node in page.root().children_recursive() {
        let role = node.accesskit_node().role();
        let placed = matches!(
            role,
            Role::Button
                | Role::CheckBox
                | Role::ComboBox
                | Role::Figure
                | Role::Label
                | Role::RadioButton
                | Role::Slider
        );
        if !placed {
            continue;
        }
        let rect = node.rect();
        // What is further down is scrolled to.
        assert!(rect.left() >= screen.left() && rect.right() <= screen.right(), "{what} at {size}: {node:?}");
        if role == Role::Figure {
            assert!(rect.width() > 100.0 && rect.height() > 60.0, "{what} at {size}: too small, {rect:?}: {node:?}");
            let covered = pictures.iter().any(|other| other.shrink(0.5).intersects(rect));
            assert!(!covered, "{what} at {size}: covered: {node:?}");
            pictures.push(rect);
        }
    }
}
