//! Writes pictures of the demo scene, light and dark, into a folder: `cargo run --example scene_png --features app -- FOLDER [WIDTH HEIGHT]`.

#[path = "../tests/it/gpu.rs"]
#[allow(dead_code)]
mod gpu;

use centrode::render::Renderer;
use centrode::scene::{Camera, demo, palette::Palette};
use glam::Vec2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1);
    let folder = std::path::PathBuf::from(args.next().unwrap_or_else(|| ".".to_owned()));
    let width = args.next().map_or(Ok(1200), |v| v.parse())?;
    let height = args.next().map_or(Ok(900), |v| v.parse())?;
    std::fs::create_dir_all(&folder)?;

    let gpu = gpu::Gpu::new();
    let mut renderer = Renderer::new(&gpu.device, wgpu::TextureFormat::Rgba8Unorm);
    let home = Camera::default();
    let mut side = home;
    side.orbit(Vec2::new(-170.0, 60.0));
    side.zoom(1.9);
    let mut version = 0;
    for (theme, palette) in [("light", Palette::LIGHT), ("dark", Palette::DARK)] {
        for (name, camera, degrees) in [("home", home, 75.0_f32), ("near", side, 75.0), ("straight", home, 0.001)] {
            version += 1;
            let scene = demo::scene(&palette, degrees.to_radians());
            let start = std::time::Instant::now();
            let picture = gpu::render(
                &gpu,
                &mut renderer,
                (&scene, version),
                &camera,
                &palette.studio,
                ([width, height], 1.0),
                wgpu::Color::TRANSPARENT,
            );
            let path = folder.join(format!("{theme}-{name}.png"));
            let bytes: Vec<u8> = picture.pixels.into_iter().flatten().collect();
            image::save_buffer(&path, &bytes, width, height, image::ColorType::Rgba8)?;
            println!("{} ({} ms)", path.display(), start.elapsed().as_millis());
        }
    }
    Ok(())
}
