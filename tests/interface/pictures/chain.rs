//! Pictures of runs of several segments, without the page around them.

use super::compare_image;
use centrode::render::{Frame, Renderer, ViewId};
use centrode::scene::palette::{Palette, Shade};
use centrode::show::chain::{ChainOptions, home_camera, view};
use centrode_core::detect::chain::ChainEstimate;
use centrode_core::scenario::{ChainPlan, preset};
use centrode_core::study::chain::ChainRun;
use egui_kittest::wgpu::{create_render_state, default_wgpu_setup};
use egui_wgpu::RendererOptions;
use image::RgbaImage;

fn run(name: &str) -> ChainRun {
    let scenario = preset::find_chain(name).and_then(|preset| preset.chain(&[]).ok()).expect("preset");
    ChainRun::new(ChainPlan::new(&scenario).expect("stable"))
}

/// A run at a time (s) as the page opens it, `size` points at two pixels each.
fn picture(run: &ChainRun, time: f64, (shade, chosen): (Shade, usize), size: [u32; 2]) -> RgbaImage {
    let found = run.judged.teller().map_or_else(Vec::new, |teller| run.judged.contacts(teller, &[0.0, 0.1, 0.25, 0.5]));
    let known = |estimates: &'_ [ChainEstimate]| estimates.iter().rposition(|estimate| estimate.time <= time);
    let placed: Vec<&ChainEstimate> =
        found.iter().filter_map(|found| Some(&found.estimates[known(&found.estimates)?])).collect();
    let palette = Palette::of(shade);
    let mut scene = view(run, time, &ChainOptions { palette, pulse: 0.0, chosen, placed: &placed });
    scene.thicken(palette.weight);
    let gpu = create_render_state(default_wgpu_setup(), RendererOptions::PREDICTABLE);
    let mut renderer = Renderer::new(&gpu.device, gpu.target_format);
    let frame = Frame {
        view: ViewId(0),
        size_px: size.map(|side| 2 * side),
        pixels_per_point: 2.0,
        scene: &scene,
        scene_version: 0,
        camera: &home_camera(run),
        studio: &palette.studio,
    };
    let snapshot = renderer.snapshot(&gpu.device, &gpu.queue, &frame).expect("a picture");
    let pixels = std::iter::repeat_with(|| snapshot.take(&gpu.device)).flatten().next();
    let pixels = pixels.expect("endless").expect("the device is there");
    RgbaImage::from_raw(pixels.size[0], pixels.size[1], pixels.rgba).expect("whole")
}

#[test]
fn two_contacts() {
    let run = run("two-contacts");
    for (shade, name) in [(Shade::Dark, "chain-two-contacts-dark"), (Shade::Light, "chain-two-contacts-light")] {
        compare_image(&picture(&run, 7.4, (shade, 2), [640, 500]), name);
    }
}

#[test]
fn oblique() {
    let run = run("oblique");
    for (shade, name) in [(Shade::Dark, "chain-oblique-dark"), (Shade::Light, "chain-oblique-light")] {
        compare_image(&picture(&run, 7.2, (shade, 0), [640, 500]), name);
    }
}
