//! Writes pictures of the 3D view as the page shows it, light and dark, desk and phone, into a folder:
//! `cargo run --example scene_png --features gui-tests -- FOLDER [PRESET TIME [KEY=VALUE …]]`.

#![allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "it writes a picture")]

use centrode::app::stages::viewport::subject::Subject;
use centrode::app::stages::viewport::{ViewState, viewport};
use centrode::app::{layout, theme};
use centrode::show::track::Trace;
use centrode_core::run::simulate;
use centrode_core::scenario::preset;
use egui_kittest::Harness;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};

/// Width and height in points.
const SIZES: [(&str, egui::Vec2); 2] = [("desk", egui::vec2(730.0, 500.0)), ("phone", egui::vec2(375.0, 320.0))];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let folder = std::path::PathBuf::from(args.first().map_or(".", String::as_str));
    std::fs::create_dir_all(&folder)?;
    let shots: Vec<(&str, f64)> = match &args[..] {
        [_, preset, time, ..] => vec![(preset, time.parse()?)],
        [_, preset] => return Err(format!("{preset}: at which time? Give it in s after the preset").into()),
        _ => ["bench", "disk-3", "free"].into_iter().flat_map(|name| [5.5, 6.3, 7.5].map(|t| (name, t))).collect(),
    };
    for (name, time) in shots {
        let mut draft = preset::find(name)?.draft()?;
        for change in args.iter().skip(3) {
            draft.set(change)?;
        }
        let run = simulate(&draft.finish()?)?;
        for (look, choice) in [("light", egui::Theme::Light), ("dark", egui::Theme::Dark)] {
            for (form, size) in SIZES {
                let gpu = create_render_state(default_wgpu_setup(), egui_wgpu::RendererOptions::PREDICTABLE);
                let mut state = ViewState::new(Some(&gpu), true);
                let mut page = Harness::builder()
                    .with_size(size + egui::vec2(16.0, 16.0))
                    .with_pixels_per_point(2.0)
                    .renderer(WgpuTestRenderer::from_render_state(gpu))
                    .build_ui(|ui| {
                        ui.ctx().set_theme(choice);
                        theme::install(ui.ctx());
                        let page = ui.ctx().content_rect();
                        ui.painter().rect_filled(page, 0.0, theme::Theme::of(ui).surface);
                        let mut view = ui.new_child(egui::UiBuilder::new().max_rect(page.shrink(8.0)));
                        let trace = &Trace::new(&run);
                        let subject = Subject::Single { run: &run, trace, frozen: false, placed: None };
                        viewport(&mut view, &subject, (0, time), &mut state, &mut Vec::new());
                        layout::round(&view, page.shrink(8.0));
                    });
                page.run_ok();
                let path = folder.join(format!("{name}-{time}-{look}-{form}.png"));
                page.render()?.save(&path)?;
                println!("{}", path.display());
            }
        }
    }
    Ok(())
}
