//! Pictures of the page held against those in `tests/snapshots`. `cargo xtask renew pictures` replaces them.
//!
//! They are drawn by a software renderer (Mesa's lavapipe, which the test command installs), so that machines agree.

mod chain;

use crate::detectors::{LINK, go};
use crate::stages::show;
use crate::support::{DESK, PHONE, Page, build, choose_theme, click, finish, paused, slide};
use crate::tuning::tune;
use egui::Theme::{Dark, Light};
use egui::{Vec2, vec2};
use egui_kittest::kittest::Queryable;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
use egui_kittest::{Harness, SnapshotOptions, try_image_snapshot_options};
use egui_wgpu::RendererOptions;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};

/// How far a pixel may be off, as a squared distance of colours (YIQ, 255 to the full): four steps of grey.
const TOLERANCE: f32 = 18.0;
/// What remains of colours in the stored pictures: multiples of this.
const STEP: u8 = 4;
/// How many pixels may be further off than that: edges that another version of the renderer samples otherwise.
const STRAYS: usize = 40;

/// A page of a size and theme, paused at a time (s), with its 3D view.
fn page(size: Vec2, theme: egui::Theme, time: f64) -> Page {
    let gpu = create_render_state(default_wgpu_setup(), RendererOptions::PREDICTABLE);
    let renderer = WgpuTestRenderer::from_render_state(gpu.clone());
    let mut page = paused(build(Harness::builder().with_size(size).renderer(renderer), Some(gpu)));
    choose_theme(&mut page, theme);
    slide(&mut page, "Time", time);
    page
}

/// Compares the page with its picture.
fn compare(page: &mut Page, name: &str) {
    page.remove_cursor();
    page.run_steps(3);
    // Where the contact is, is found one estimate a frame.
    finish(page);
    let options = SnapshotOptions::new().threshold(TOLERANCE).max_failed_pixels(STRAYS);
    page.try_snapshot_options(name, &options).unwrap_or_else(|differs| panic!("{differs}"));
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        pack(&options.output_path.join(format!("{name}.png")));
    }
}

/// Compares a picture that is none of the page with the stored one.
fn compare_image(picture: &image::RgbaImage, name: &str) {
    let options = SnapshotOptions::new().threshold(TOLERANCE).max_failed_pixels(STRAYS);
    try_image_snapshot_options(picture, name, &options).unwrap_or_else(|differs| panic!("{differs}"));
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        pack(&options.output_path.join(format!("{name}.png")));
    }
}

/// Writes a picture anew with fewer colours, well within the tolerance, and a fraction of the bytes.
fn pack(path: &std::path::Path) {
    let mut picture = image::open(path).expect("a picture").to_rgb8();
    picture.iter_mut().for_each(|value| *value = value.saturating_add(STEP / 2) / STEP * STEP);
    let file = std::io::BufWriter::new(std::fs::File::create(path).expect("written"));
    let encoder = PngEncoder::new_with_quality(file, CompressionType::Best, FilterType::NoFilter);
    picture.write_with_encoder(encoder).expect("written");
}

#[test]
fn robot_before_detection() {
    compare(&mut page(DESK, Dark, 6.0), "robot-contact-desk-dark");
}

#[test]
fn robot_after_detection() {
    compare(&mut page(DESK, Light, 7.0), "robot-detected-desk-light");
}

#[test]
fn robot_on_a_small_desk() {
    compare(&mut page(vec2(1280.0, 720.0), Light, 7.0), "robot-detected-small-desk-light");
}

#[test]
fn against_a_plane() {
    let mut page = page(DESK, Dark, 7.0);
    click(&mut page, "Plane");
    compare(&mut page, "robot-plane-desk-dark");
}

#[test]
fn against_a_cylinder() {
    let mut page = page(DESK, Light, 7.0);
    assert!(page.query_by_label("Compare with a clamp").is_none(), "it is one");
    click(&mut page, "Cylinder");
    slide(&mut page, "Rounding", 6.0);
    click(&mut page, "Compare with a clamp");
    compare(&mut page, "robot-cylinder-desk-light");
}

/// The band where the calibration filter places a contact, at the alarm and once it is narrow.
#[test]
fn placed() {
    let detectors = "detection.detectors=fcd,jfd,cusum";
    for (size, theme, time, name) in
        [(DESK, Light, 6.35, "placed-desk-light"), (PHONE, Dark, 5.95, "placed-phone-dark")]
    {
        let mut page = page(size, theme, time);
        page.state_mut().as_mut().expect("built").go(&format!("preset=miscalibrated&{detectors}&t={time}"));
        page.run_steps(2);
        compare(&mut page, name);
    }
}

#[test]
fn phone() {
    let mut page = page(PHONE, Dark, 6.6);
    compare(&mut page, "robot-detected-phone-dark");
    click(&mut page, "Plots");
    compare(&mut page, "plots-phone-dark");
}

#[test]
fn controls_on_a_phone() {
    let mut page = page(PHONE, Light, 6.6);
    click(&mut page, "Controls");
    page.run_steps(3);
    compare(&mut page, "controls-phone-light");
}

#[test]
fn figures() {
    let mut page = page(DESK, Dark, 6.6);
    show(&mut page, "Figure 4");
    compare(&mut page, "figure-4-desk-dark");
    click(&mut page, "Theme: dark");
    show(&mut page, "Figure 8");
    compare(&mut page, "figure-8-desk-light");
}

#[test]
fn table_ii() {
    let mut page = page(DESK, Light, 6.6);
    show(&mut page, "Table II");
    compare(&mut page, "table-ii-desk-light");
}

#[test]
fn map() {
    let mut page = page(DESK, Dark, 6.6);
    show(&mut page, "Map");
    compare(&mut page, "map-desk-dark");
}

#[test]
fn tuning_on_a_desk() {
    let mut page = page(DESK, Light, 6.6);
    tune(&mut page);
    finish(&mut page);
    compare(&mut page, "tuning-desk-light");
}

#[test]
fn tuning_on_a_phone() {
    let mut page = page(PHONE, Dark, 6.6);
    tune(&mut page);
    finish(&mut page);
    compare(&mut page, "tuning-phone-dark");
}

#[test]
fn detectors() {
    let mut page = page(DESK, Light, 6.6);
    go(&mut page, LINK);
    finish(&mut page);
    compare(&mut page, "detectors-desk-light");
    for theme in ["light", "projector", "system"] {
        click(&mut page, &format!("Theme: {theme}"));
    }
    page.set_size(PHONE);
    compare(&mut page, "detectors-phone-dark");
}

#[test]
fn help() {
    let mut page = page(PHONE, Light, 6.6);
    click(&mut page, "Help");
    compare(&mut page, "help-phone-light");
}

#[test]
fn sharing_and_a_notice() {
    let mut page = page(DESK, Dark, 6.6);
    click(&mut page, "Share");
    compare(&mut page, "share-desk-dark");
    let mut page = self::page(PHONE, Light, 6.6);
    let link = "preset=bench&contact.disk=9&detection.xi2=-1&bogus=1&t=6.27";
    page.state_mut().as_mut().expect("built").go(link);
    page.run_steps(2);
    compare(&mut page, "notice-phone-light");
}

#[test]
fn saving_and_two_marks() {
    let mut page = page(DESK, Light, 5.6);
    page.key_press(egui::Key::A);
    page.run_steps(2);
    slide(&mut page, "Time", 6.6);
    page.key_press(egui::Key::B);
    page.run_steps(2);
    compare(&mut page, "marks-desk-light");
    click(&mut page, "Save plots");
    compare(&mut page, "save-desk-light");
    let mut page = self::page(PHONE, Dark, 6.6);
    show(&mut page, "Figure 4");
    click(&mut page, "Save figure 4");
    compare(&mut page, "save-phone-dark");
}

#[test]
fn the_tour() {
    for (size, theme, link, name) in [
        (DESK, Dark, "tour=1", "tour-1-desk-dark"),
        (DESK, Light, "tour=8", "tour-8-desk-light"),
        (PHONE, Light, "tour=5", "tour-5-phone-light"),
    ] {
        let mut page = page(size, theme, 6.0);
        page.state_mut().as_mut().expect("built").go(link);
        page.run_steps(3);
        compare(&mut page, name);
    }
}

#[test]
fn a_challenge_and_the_gallery() {
    let mut page = page(PHONE, Dark, 6.0);
    crate::lesson::learn(&mut page, "Challenges");
    click(&mut page, "Halve the delay");
    compare(&mut page, "challenge-phone-dark");
    click(&mut page, "Leave challenges");
    page.set_size(DESK);
    page.run_steps(3);
    click(&mut page, "Preset");
    compare(&mut page, "gallery-desk-dark");
}

#[test]
fn segments_in_series() {
    for (name, theme, size, time) in [
        ("chain-desk-dark", Dark, DESK, 7.6),
        ("chain-desk-light", Light, DESK, 7.6),
        ("chain-phone-dark", Dark, PHONE, 7.6),
    ] {
        let mut page = page(size, theme, time);
        page.state_mut().as_mut().expect("built").go(&format!("chain=two-contacts&t={time}"));
        finish(&mut page);
        compare(&mut page, name);
    }
}
