//! What the untouched page says as it plays for the first time.

use crate::support::{DESK, Page, app, click};
use centrode::app::embed::Embed;
use centrode::app::{App, Host};
use egui::{Key, Rect, Shape, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
use egui_wgpu::RendererOptions;

/// A page as this host opens it, with its 3D view.
fn opened(host: impl Fn() -> Host + 'static) -> Page {
    let gpu = create_render_state(default_wgpu_setup(), RendererOptions::PREDICTABLE);
    let renderer = WgpuTestRenderer::from_render_state(gpu.clone());
    let ui = move |ui: &mut egui::Ui, app: &mut Option<App>| {
        app.get_or_insert_with(|| App::new(ui.ctx(), Some(&gpu), host())).ui(ui);
    };
    let builder =
        Harness::builder().with_size(DESK).renderer(renderer).with_step_dt(0.05).with_theme(egui::Theme::Dark);
    builder.with_context_setup(centrode::app::theme::install).build_ui_state(ui, None)
}

/// Lets it play until a time, s.
fn until(page: &mut Page, time: f64) {
    for _ in 0..400 {
        if app(page).state().time >= time {
            page.step();
            return;
        }
        page.step();
    }
    panic!("it does not play");
}

fn said(page: &Page) -> [bool; 3] {
    ["It bends.", "It touches", "found after"].map(|part| page.query_by_label_contains(part).is_some())
}

#[test]
fn it_bends_touches_and_is_found_once() {
    let mut page = opened(Host::default);
    assert!(app(&page).state().playing);
    assert_eq!(said(&page), [false; 3]);
    let found = app(&page).run().detection().expect("one").time;
    for (time, what) in [(4.5, [true, false, false]), (5.9, [false, true, false]), (found, [false, true, true])] {
        until(&mut page, time);
        assert_eq!(said(&page), what, "{time} s");
    }
    page.check_accessibility();
    until(&mut page, 9.9);
    page.run_steps(20);
    until(&mut page, 4.5);
    assert!(app(&page).state().time < 6.0, "the second time round");
    assert_eq!(said(&page), [false; 3]);
}

#[test]
fn they_step_aside_at_a_click_and_at_a_key() {
    for key in [false, true] {
        let mut page = opened(Host::default);
        until(&mut page, 6.0);
        assert_eq!(said(&page), [false, true, false]);
        if key {
            page.key_press(Key::A);
        } else {
            click(&mut page, "Theme: system");
        }
        page.run_steps(2);
        assert_eq!(said(&page), [false; 3]);
    }
}

#[test]
fn who_wants_less_motion_starts_it() {
    let mut page = opened(|| Host { prefers_reduced_motion: true, ..Host::default() });
    page.run_steps(3);
    assert!(!app(&page).state().playing);
    click(&mut page, "Play");
    until(&mut page, 5.9);
    assert_eq!(said(&page), [false, true, false]);
    click(&mut page, "Pause");
    assert_eq!(said(&page), [false; 3]);
}

#[test]
fn a_link_a_frame_and_the_tour_have_none() {
    let hosts: [fn() -> Host; 3] = [
        || Host { fragment: "preset=bench".into(), ..Host::default() },
        || Host { embed: Some(Embed::Robot), ..Host::default() },
        || Host { fragment: "tour=2".into(), ..Host::default() },
    ];
    for (k, host) in hosts.into_iter().enumerate() {
        let mut page = opened(host);
        if k == 2 {
            page.run_steps(3);
            click(&mut page, "Play");
        }
        until(&mut page, 6.0);
        assert_eq!(said(&page), [false; 3]);
    }
}

/// Where the words stand that are painted and hold a part.
fn places(page: &Page, part: &str) -> Vec<Rect> {
    fn all(shape: &Shape, part: &str, found: &mut Vec<Rect>) {
        match shape {
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| all(shape, part, found)),
            Shape::Text(text) if text.galley.text().contains(part) => found.push(text.visual_bounding_rect()),
            _ => {}
        }
    }
    let mut found = Vec::new();
    page.output().shapes.iter().for_each(|shape| all(&shape.shape, part, &mut found));
    found
}

#[test]
fn a_caption_covers_no_label() {
    let mut page = opened(Host::default);
    let view = page.get_by_label("3D view").rect();
    let found = app(&page).run().detection().expect("one").time;
    for k in 0..30 {
        until(&mut page, found + 0.1 * f64::from(k));
        let captions = ["It touches", "have parted"].map(|part| places(&page, part));
        assert!(captions.iter().all(|places| places.len() == 1), "{} s: {captions:?}", app(&page).state().time);
        let mut labels = places(&page, "estimate 1");
        labels.extend(places(&page, " mm"));
        labels.retain(|label| view.contains_rect(*label));
        let time = app(&page).state().time;
        assert!(labels.iter().any(|label| places(&page, "estimate 1").contains(label)), "{time} s: no estimate");
        for caption in captions.concat() {
            // With the ground that it is written on.
            let ground = caption.expand2(vec2(9.0, 6.0));
            assert!(labels.iter().all(|label| !label.intersects(ground)), "{time} s: {ground} over one of {labels:?}");
        }
    }
}
