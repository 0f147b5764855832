//! The live plots and the bending plane, headless: what a pointer or a keyboard does, and what they look like.

use centrode::app::charts::plane::plane;
use centrode::app::charts::plots::{PlotState, plots};
use centrode::app::command::Command;
use centrode::show::track::Trace;
use centrode_core::detect::Method;
use centrode_core::run::{Run, simulate};
use centrode_core::scenario::Threshold;
use centrode_core::scenario::{Scenario, preset};
use egui::{Key, Pos2, Rect, Vec2, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

/// Both views over one scenario, with commands applied as the app applies them.
struct Page {
    scenario: Scenario,
    run: Run,
    /// Counts the runs.
    version: u64,
    cursor: f64,
    state: PlotState,
    log: Vec<Command>,
}

impl Page {
    fn new(name: &str, cursor: f64) -> Self {
        let scenario = preset::find(name).and_then(preset::Preset::scenario).expect("preset");
        let run = simulate(&scenario).expect("run");
        // The page remembers what a threshold was before it was switched off.
        let thresholds = [(Method::Fcd, scenario.detection.xi2), (Method::Jfd, scenario.detection.xi1)];
        let mut state = PlotState::default();
        state.otherwise = thresholds.map(|(method, set)| (method, set.value().unwrap_or(0.0))).into();
        Self { scenario, run, version: 0, cursor, state, log: Vec::new() }
    }

    fn apply(&mut self, commands: Vec<Command>) {
        for command in commands {
            match command {
                Command::Seek(time) => self.cursor = time,
                Command::SetThreshold(method, threshold) => *self.scenario.detection.of_mut(method) = threshold,
                Command::SetArmedFrom(time) => self.scenario.detection.armed_from = time,
                #[allow(unreachable_patterns)]
                _ => {}
            }
            self.run = simulate(&self.scenario).expect("what the views ask for can be run");
            self.version += 1;
            self.log.push(command);
        }
    }

    fn show(&mut self, ui: &mut egui::Ui) {
        let mut out = Vec::new();
        let wide = ui.available_width() > 700.0;
        if wide {
            let width = 0.4 * ui.available_width();
            let height = ui.available_height();
            ui.horizontal(|ui| {
                ui.allocate_ui(vec2(width, height), |ui| {
                    plane(ui, &self.run, &Trace::new(&self.run), (self.cursor, false, None), &mut out)
                });
                ui.allocate_ui(vec2(ui.available_width(), height), |ui| {
                    plots(ui, (&self.run, self.version), self.cursor, &mut self.state, &mut out);
                });
            });
        } else {
            let width = ui.available_width();
            ui.allocate_ui(vec2(width, 380.0), |ui| {
                plane(ui, &self.run, &Trace::new(&self.run), (self.cursor, false, None), &mut out)
            });
            plots(ui, (&self.run, self.version), self.cursor, &mut self.state, &mut out);
        }
        self.apply(out);
    }
}

fn harness<'a>(page: Page, size: Vec2, theme: egui::Theme) -> Harness<'a, Page> {
    let mut harness = Harness::builder()
        .with_size(size)
        .with_theme(theme)
        .with_pixels_per_point(2.0)
        .wgpu()
        .with_context_setup(centrode::app::theme::install)
        .build_ui_state(|ui, page: &mut Page| page.show(ui), page);
    harness.run();
    harness
}

fn wide() -> Harness<'static, Page> {
    harness(Page::new("paper", 4.0), vec2(1200.0, 560.0), egui::Theme::Dark)
}

fn plot(harness: &Harness<'_, Page>, what: &str) -> Rect {
    harness.get_by_label(&format!("Plot of the {what} over time")).rect()
}

/// A point of a plot: time in s, and share of the height from the bottom.
fn point(plot: Rect, time: f64, share: f32) -> Pos2 {
    pos2(plot.left() + plot.width() * time as f32 / 10.0, plot.bottom() - plot.height() * share)
}

fn drag(harness: &mut Harness<'_, Page>, from: Pos2, to: Pos2) {
    harness.hover_at(from);
    harness.run();
    harness.drag_at(from);
    harness.run();
    for k in 1..=4 {
        harness.hover_at(from + (to - from) * (k as f32 / 4.0));
        harness.run();
    }
    harness.drop_at(to);
    harness.run();
}

#[test]
fn dragging_a_threshold_sets_it_live_and_keeps_the_scale() {
    let mut harness = wide();
    let plot = plot(&harness, "centrode deviation");
    // 7 mm on a plot that reaches 12 mm.
    let from = point(plot, 7.0, 7.0 / 12.0);
    drag(&mut harness, from, point(plot, 7.0, 5.0 / 12.0));
    let page = harness.state();
    let set: Vec<f64> = page
        .log
        .iter()
        .map(|command| match command {
            Command::SetThreshold(Method::Fcd, threshold) => threshold.value().expect("on"),
            other => panic!("{other:?}"),
        })
        .collect();
    assert!(set.len() >= 3, "live: {set:?}");
    assert!(set.windows(2).all(|pair| pair[1] < pair[0]), "{set:?}");
    let last = set.last().expect("set");
    assert!((last - 0.005).abs() < 0.0002, "{last}");
    assert!(page.run.detection().expect("detected").time < 6.279);
}

#[test]
fn dragging_the_force_threshold_sets_xi1() {
    let mut harness = wide();
    let plot = plot(&harness, "joint force deviation");
    let label = harness.get_by_label("ξ1 on plot").rect();
    let from = pos2(point(plot, 4.0, 0.0).x, label.center().y);
    drag(&mut harness, from, from - vec2(0.0, 20.0));
    let raised = harness
        .state()
        .log
        .iter()
        .all(|c| matches!(c, Command::SetThreshold(Method::Jfd, Threshold::On(x)) if *x > 0.03));
    assert!(raised && !harness.state().log.is_empty(), "{:?}", harness.state().log);
}

#[test]
fn a_threshold_can_be_typed() {
    let mut harness = wide();
    harness.get_by_label("ξ2 on plot").click();
    harness.run();
    harness.get_by_label("ξ2 on plot").type_text("3.5");
    harness.run();
    harness.key_press(Key::Enter);
    harness.run();
    match harness.state().log.last() {
        Some(Command::SetThreshold(Method::Fcd, Threshold::On(value))) => {
            assert!((value - 0.0035).abs() < 1e-12, "{value}")
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_threshold_can_be_switched_off_and_on_again() {
    let mut harness = wide();
    harness.get_by_label("ξ2 on plot, on or off").click();
    harness.run();
    assert!(
        matches!(harness.state().log[..], [Command::SetThreshold(Method::Fcd, Threshold::OFF)]),
        "{:?}",
        harness.state().log
    );
    assert!(harness.state().run.detection().is_none());
    harness.get_by_label("ξ2 on plot, on or off").click();
    harness.run();
    let last = harness.state().log.last();
    assert!(
        matches!(last, Some(Command::SetThreshold(Method::Fcd, Threshold::On(xi2))) if (xi2 - 0.007).abs() < 1e-12),
        "{last:?}"
    );
}

#[test]
fn clicking_and_dragging_elsewhere_seeks() {
    let mut harness = wide();
    let plot = plot(&harness, "centrode deviation");
    let at = point(plot, 7.5, 0.2);
    harness.hover_at(at);
    harness.drag_at(at);
    harness.drop_at(at);
    harness.run();
    assert!((harness.state().cursor - 7.5).abs() < 0.05, "{:?}", harness.state().log);
    drag(&mut harness, point(plot, 6.0, 0.2), point(plot, 8.5, 0.25));
    assert!((harness.state().cursor - 8.5).abs() < 0.05);
    assert!(harness.state().log.iter().all(|command| matches!(command, Command::Seek(_))));
}

#[test]
fn the_arming_edge_can_be_dragged() {
    let mut harness = wide();
    let plot = plot(&harness, "centrode deviation");
    drag(&mut harness, point(plot, 5.0, 0.3), point(plot, 4.0, 0.3));
    assert!((harness.state().scenario.detection.armed_from - 4.0).abs() < 0.05, "{:?}", harness.state().log);
    assert!(harness.state().log.iter().all(|command| matches!(command, Command::SetArmedFrom(_))));
}

#[test]
fn clicking_a_mark_of_the_plane_seeks_there() {
    let mut harness = wide();
    let view = harness.get_by_label_contains("Bending plane at").rect();
    let before = harness.state().cursor;
    // Sweeps the view: some marks are met, and each gives its own time.
    let mut times = Vec::new();
    for row in 0..24 {
        for column in 0..24 {
            let at = view.min + vec2(column as f32 + 0.5, row as f32 + 0.5) / 24.0 * view.size();
            harness.hover_at(at);
            harness.drag_at(at);
            harness.drop_at(at);
            harness.step();
            harness.step();
        }
    }
    times.extend(harness.state().log.iter().map(|command| match command {
        Command::Seek(time) => *time,
        other => panic!("{other:?}"),
    }));
    assert!(!times.is_empty() && harness.state().cursor != before);
    assert!(times.iter().all(|time| (3.0..=8.0).contains(time)), "{times:?}");
}

#[test]
fn both_views_say_what_they_show_in_every_size() {
    let (wide, narrow) = (vec2(1280.0, 600.0), vec2(390.0, 860.0));
    let cases = [
        ("bench", 6.9, wide, "7.39 mm"),
        ("bench", 6.9, narrow, "7.39 mm"),
        ("disk-1", 7.4, narrow, "3.61 mm"),
        ("letting-go", 5.2, wide, "7.39 mm"),
        ("static-resolution", 6.0, wide, "1.57 mm"),
        ("free", 2.0, wide, "304.93 mm"),
    ];
    for (name, cursor, size, deviation) in cases {
        let harness = harness(Page::new(name, cursor), size, egui::Theme::Dark);
        let said = format!("Bending plane at {cursor:.3} s; centrode deviation {deviation}");
        let mut rects = vec![harness.get_by_label(&said).rect()];
        rects.extend(["centrode deviation", "joint force deviation", "tangent angle"].map(|what| plot(&harness, what)));
        let screen = Rect::from_min_size(Pos2::ZERO, size);
        for (k, rect) in rects.iter().enumerate() {
            assert!(screen.contains_rect(*rect) && rect.width() > 150.0 && rect.height() > 60.0, "{name}: {rect:?}");
            assert!(rects[..k].iter().all(|other| !other.intersects(*rect)), "{name}: {rects:?}");
        }
    }
}

/// The row of plots under a 3D view, with the pointer in one of them: all three answer.
#[test]
fn the_plots_fit_in_a_low_row() {
    let mut harness = plots_alone("bench", vec2(1110.0, 236.0));
    let rects = ["centrode deviation", "joint force deviation", "tangent angle"].map(|what| plot(&harness, what));
    assert!(rects.windows(2).all(|pair| pair[0].right() < pair[1].left() && pair[0].top() == pair[1].top()));
    harness.hover_at(point(rects[1], 6.6, 0.1));
    harness.run();
}

/// A phone's tab is lower than three plots: they scroll.
#[test]
fn the_plots_scroll_where_there_is_little_room() {
    let harness = plots_alone("bench", vec2(374.0, 290.0));
    let rect = plot(&harness, "centrode deviation");
    assert!(rect.height() > 80.0 && rect.width() > 300.0, "{rect:?}");
}

/// The plane beside the 3D view of a small desk is low: its legend goes to the side.
#[test]
fn the_plane_fits_in_a_low_place() {
    let mut harness = Harness::builder()
        .with_size(vec2(291.0, 160.0))
        .with_theme(egui::Theme::Light)
        .with_pixels_per_point(2.0)
        .wgpu()
        .with_context_setup(centrode::app::theme::install)
        .build_ui_state(
            |ui, page: &mut Page| {
                plane(ui, &page.run, &Trace::new(&page.run), (page.cursor, false, None), &mut page.log)
            },
            Page::new("bench", 7.1),
        );
    harness.run();
    let rect = harness.get_by_label_contains("Bending plane at").rect();
    assert!(rect.height() > 80.0 && rect.width() > 100.0 && rect.right() < 200.0, "{rect:?}");
}

fn plots_alone(name: &str, size: Vec2) -> Harness<'static, Page> {
    let mut harness = Harness::builder()
        .with_size(size)
        .with_theme(egui::Theme::Dark)
        .with_pixels_per_point(2.0)
        .wgpu()
        .with_context_setup(centrode::app::theme::install)
        .build_ui_state(
            |ui, page: &mut Page| {
                let mut out = Vec::new();
                plots(ui, (&page.run, page.version), page.cursor, &mut page.state, &mut out);
                page.apply(out);
            },
            Page::new(name, 6.9),
        );
    harness.run();
    harness
}

/// Texts that are painted and begin with `part`: where, and what of the screen they may be painted on.
fn painted(page: &crate::support::Page, part: &str) -> Vec<(Rect, Rect)> {
    fn all(shape: &egui::Shape, part: &str, clip: Rect, found: &mut Vec<(Rect, Rect)>) {
        match shape {
            egui::Shape::Vec(shapes) => shapes.iter().for_each(|shape| all(shape, part, clip, found)),
            egui::Shape::Text(text) if text.galley.text().starts_with(part) => {
                found.push((text.visual_bounding_rect(), clip));
            }
            _ => {}
        }
    }
    let mut found = Vec::new();
    page.output().shapes.iter().for_each(|shape| all(&shape.shape, part, shape.clip_rect, &mut found));
    found
}

/// The smallest desk: its plots and its bending plane are low.
#[test]
fn labels_of_a_small_desk_are_apart_and_no_legend_is_cut() {
    let mut page = crate::support::page_of(vec2(1280.0, 720.0));
    crate::support::slide(&mut page, "Time", 7.0);
    for armed_from in [5.0, 5.6, 5.9, 6.1] {
        crate::support::slide(&mut page, "Armed from", armed_from);
        let (armed, detected) = (painted(&page, "armed from"), painted(&page, "detected "));
        let ([(armed, _)], [(detected, clip)]) = (&armed[..], &detected[..]) else {
            panic!("armed from {armed_from} s: {armed:?} {detected:?}")
        };
        assert!(!armed.intersects(*detected), "armed from {armed_from} s: {armed} {detected}");
        assert!(clip.contains_rect(*armed) && clip.contains_rect(*detected), "{armed} {detected} in {clip}");
    }
    for entry in ["cm model", "cc constrained", "cs sensor", "true shape", "if unconstrained", "beam", "estimate"] {
        let found = painted(&page, entry);
        let (text, clip) = found.iter().max_by(|a, b| a.0.left().total_cmp(&b.0.left())).expect("an entry");
        assert!(text.left() > 960.0 && clip.contains_rect(*text), "{entry}: {text} in {clip}");
    }
}
