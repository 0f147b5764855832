//! Writes pictures of the 3D view, light and dark, desk and phone, into a folder:
//! `cargo run --example scene_png --features gui-tests -- FOLDER [PRESET TIME]`.

#[path = "../tests/it/gpu.rs"]
#[allow(dead_code)]
mod gpu;

use centrode::experiment::{preset, simulate};
use centrode::render::Renderer;
use centrode::scene::palette::Palette;
use centrode::scene::view::{ViewOptions, home_camera, view};

/// Width and height in points.
const SIZES: [(&str, [u32; 2]); 2] = [("desk", [730, 500]), ("phone", [375, 320])];
const PIXELS_PER_POINT: f32 = 2.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let folder = std::path::PathBuf::from(args.first().map_or(".", String::as_str));
    std::fs::create_dir_all(&folder)?;
    let shots: Vec<(&str, f64)> = match &args[..] {
        [_, preset, time] => vec![(preset, time.parse()?)],
        _ => ["bench", "disk-3", "free"].into_iter().flat_map(|name| [5.5, 6.28, 7.5].map(|t| (name, t))).collect(),
    };

    let gpu = gpu::Gpu::new();
    let mut renderer = Renderer::new(&gpu.device, wgpu::TextureFormat::Rgba8Unorm);
    let mut version = 0;
    for (name, time) in shots {
        let run = simulate(&preset::find(name)?.scenario()?)?;
        let camera = home_camera(&run);
        for (theme, palette) in [("light", Palette::LIGHT), ("dark", Palette::DARK)] {
            let scene = view(&run, time, &ViewOptions { palette, pulse: 0.0 });
            version += 1;
            for (form, size) in SIZES {
                let size = size.map(|side| (side as f32 * PIXELS_PER_POINT) as u32);
                let picture = gpu::render(
                    &gpu,
                    &mut renderer,
                    (&scene, version),
                    &camera,
                    &palette.studio,
                    (size, PIXELS_PER_POINT),
                    wgpu::Color::TRANSPARENT,
                );
                let path = folder.join(format!("{name}-{time}-{theme}-{form}.png"));
                let bytes: Vec<u8> = picture.pixels.into_iter().flatten().collect();
                image::save_buffer(&path, &bytes, size[0], size[1], image::ColorType::Rgba8)?;
                println!("{}", path.display());
            }
        }
    }
    Ok(())
}
