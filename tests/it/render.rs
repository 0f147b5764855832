//! The renderer, looked at by its pixels.

use centrode::render::{Frame, Renderer, ViewId};
use centrode::scene::{
    Block, Camera, Color, Finish, Ground, Line, Marker, Pose, Scene, Shape, Solid, Studio, palette::Palette,
};
use centrode::show::track::Trace;
use centrode::show::{ViewOptions, home_camera, view};
use centrode_core::run::simulate;
use centrode_core::scenario::preset;
use glam::{Quat, Vec2, Vec3};

use crate::gpu::{Gpu, Picture, render};

const SIZE: [u32; 2] = [240, 180];
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const RED: Color = Color::hex(0xD02020);
const BLUE: Color = Color::hex(0x2020D0);

/// One colour all over, so that pixels can be compared.
fn flat(background: Color) -> Studio {
    Studio { inner: background, outer: background, ..Studio::LIGHT }
}

/// From −y, level: x to the right, z up, 1 m wide and more.
fn level() -> Camera {
    Camera::looking_at(Vec3::ZERO, 4.0, -std::f32::consts::FRAC_PI_2, 0.0)
}

fn cube(at: Vec3, half: f32, color: Color) -> Block {
    Block {
        pose: Pose::new(at, Quat::IDENTITY),
        solid: Solid::Box { half: Vec3::splat(half) },
        bevel: 0.0,
        color,
        finish: Finish::Matte,
    }
}

fn shown(scene: &Scene, camera: &Camera, studio: &Studio) -> Picture {
    let gpu = Gpu::new();
    let mut renderer = Renderer::new(&gpu.device, FORMAT);
    render(&gpu, &mut renderer, (scene, 1), camera, studio, (SIZE, 1.0), wgpu::Color::BLACK)
}

/// The bench after the detection, and the view it opens in.
fn bench(palette: Palette) -> (Scene, Camera) {
    let scenario = preset::find("bench").and_then(preset::Preset::scenario).expect("preset");
    let run = simulate(&scenario).expect("run");
    (
        view(&run, &Trace::new(&run), 7.0, &ViewOptions { palette, pulse: 0.0, frozen: false, placed: None }),
        home_camera(&run),
    )
}

fn near(pixel: [u8; 4], color: Color, tolerance: i32) -> bool {
    let wanted = color.to_bytes();
    (0..3).all(|i| (i32::from(pixel[i]) - i32::from(wanted[i])).abs() <= tolerance)
}

fn at(picture: &Picture, camera: &Camera, point: Vec3) -> [u8; 4] {
    let size = Vec2::new(SIZE[0] as f32, SIZE[1] as f32);
    let pixel = camera.project(point, size).expect("in view");
    picture.at(pixel.x as u32, pixel.y as u32)
}

#[test]
fn a_run_shows_robot_background_and_every_signal() {
    let gpu = Gpu::new();
    let mut renderer = Renderer::new(&gpu.device, FORMAT);
    let size = [640, 480];
    for (version, palette) in [Palette::LIGHT, Palette::DARK].into_iter().enumerate() {
        let (scene, camera) = bench(palette);
        let picture = render(
            &gpu,
            &mut renderer,
            (&scene, version as u64),
            &camera,
            &palette.studio,
            (size, 1.0),
            wgpu::Color::GREEN,
        );
        for (x, y) in [(2, 2), (637, 2)] {
            assert!(near(picture.at(x, y), palette.studio.outer, 12));
        }
        assert!(picture.pixels.iter().all(|p| p[3] == 255), "an opaque view");
        for signal in [palette.model, palette.constrained, palette.sensor, palette.detection] {
            let count = picture.pixels.iter().filter(|p| near(**p, signal, 6)).count();
            assert!(count >= 12, "{signal:?}: {count} pixels");
        }
        // The base plate stands on the z axis.
        let view = Vec2::new(640.0, 480.0);
        let base = camera.project(Vec3::new(0.0015, -0.0015, 0.0004), view).unwrap();
        let pixel = picture.at(base.x as u32, base.y as u32);
        assert!(!near(pixel, palette.studio.inner, 20), "{pixel:?}");
    }
}

#[test]
fn the_nearer_box_hides_the_farther_in_either_order() {
    let front = cube(Vec3::new(0.0, -0.5, 0.0), 0.2, RED);
    let back = cube(Vec3::new(0.0, 0.5, 0.0), 0.5, BLUE);
    for blocks in [vec![front, back], vec![back, front]] {
        let scene = Scene { blocks, ..Default::default() };
        let camera = level();
        let picture = shown(&scene, &camera, &flat(Color::BLACK));
        let middle = at(&picture, &camera, Vec3::ZERO);
        assert!(middle[0] > 2 * middle[2], "{middle:?}");
        let beside = at(&picture, &camera, Vec3::new(0.4, 0.0, 0.0));
        assert!(beside[2] > 2 * beside[0], "{beside:?}");
    }
}

#[test]
fn edges_are_smooth() {
    let mut tilted = cube(Vec3::ZERO, 0.5, Color::WHITE);
    tilted.pose.rotation = Quat::from_rotation_y(0.3);
    let scene = Scene { blocks: vec![tilted], ..Default::default() };
    let picture = shown(&scene, &level(), &flat(Color::BLACK));
    let inside = picture.at(120, 90)[0];
    let between = picture.pixels.iter().filter(|p| p[0] > inside / 5 && p[0] < inside - inside / 5).count();
    assert!(inside > 100 && between > 40, "{inside} {between}");
}

#[test]
fn a_translucent_body_lets_through_what_is_behind() {
    let scene = Scene {
        blocks: vec![cube(Vec3::new(0.0, -0.5, 0.0), 0.4, RED.alpha(0.5)), cube(Vec3::new(0.0, 0.5, 0.0), 0.4, BLUE)],
        ..Default::default()
    };
    let picture = shown(&scene, &level(), &flat(Color::BLACK));
    let [r, _, b, a] = picture.at(120, 90);
    assert!(r > 40 && b > 40, "{r} {b}");
    assert_eq!(a, 255);
}

#[test]
fn each_marker_has_its_form() {
    let camera = level();
    // Points from the middle, as parts of the half size, and whether there is colour.
    type Probe = (f32, f32, bool);
    let forms: [(Shape, &[Probe]); 6] = [
        (Shape::Circle, &[(0.0, 0.0, true), (0.6, 0.6, true), (0.85, 0.85, false)]),
        (Shape::Triangle, &[(0.0, 0.0, true), (0.7, 0.6, false), (-0.7, 0.6, false), (0.6, -0.5, true)]),
        (Shape::Dot, &[(0.0, 0.0, true), (0.75, 0.0, false)]),
        (Shape::Cross, &[(0.0, 0.0, true), (0.8, 0.0, true), (0.0, -0.8, true), (0.6, 0.6, false)]),
        (Shape::Diamond, &[(0.0, 0.0, true), (0.8, 0.0, true), (0.75, 0.75, false)]),
        (Shape::Ring, &[(0.0, 0.0, false), (0.9, 0.0, true), (0.0, 0.9, true)]),
    ];
    for (shape, probes) in forms {
        let scene = Scene { markers: vec![Marker::new(Vec3::ZERO, shape, 60.0, RED)], ..Default::default() };
        let picture = shown(&scene, &camera, &flat(Color::WHITE));
        for &(x, y, colored) in probes {
            let pixel = picture.at((120.0 + 30.0 * x) as u32, (90.0 - 30.0 * y) as u32);
            let wanted = if colored { RED } else { Color::WHITE };
            assert!(near(pixel, wanted, 3), "{shape:?} at {x}, {y}: {pixel:?}");
        }
    }
}

#[test]
fn a_marker_has_an_edge_and_a_pulse() {
    let marker = Marker::new(Vec3::ZERO, Shape::Circle, 40.0, RED);
    let count = |marker: Marker, color: Color| {
        let scene = Scene { markers: vec![marker], ..Default::default() };
        let picture = shown(&scene, &level(), &flat(Color::WHITE));
        picture.pixels.iter().filter(|p| near(**p, color, 3)).count()
    };
    assert!(count(marker.outlined(BLUE, 3.0), BLUE) > 250);
    let colored = |pulse| 240 * 180 - count(marker.pulsing(pulse), Color::WHITE);
    assert!(colored(0.4) > colored(0.0) + 100);
    assert_eq!(colored(1.0), colored(0.0));
}

#[test]
fn what_is_behind_something_is_faint() {
    let mut scene = Scene {
        blocks: vec![cube(Vec3::ZERO, 0.4, Color::hex(0x808080))],
        markers: vec![Marker::new(Vec3::new(0.0, 0.8, 0.0), Shape::Circle, 30.0, RED)],
        ..Default::default()
    };
    let camera = level();
    let middle = |scene: &Scene| shown(scene, &camera, &flat(Color::WHITE)).at(120, 90);
    let faint = middle(&scene);
    assert!(faint[0] > faint[2] + 15 && !near(faint, RED, 40), "{faint:?}");
    scene.markers[0].through = 0.0;
    let gone = middle(&scene);
    assert!(gone[0].abs_diff(gone[2]) < 12, "{gone:?}");
    scene.markers[0].lift = 2.0;
    assert!(near(middle(&scene), RED, 3));
}

#[test]
fn a_line_has_its_width_its_dashes_and_survives_the_near_plane() {
    let camera = level();
    let path = vec![Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0)];
    let picture = |line| {
        let scene = Scene { lines: vec![line], ..Default::default() };
        shown(&scene, &camera, &flat(Color::WHITE))
    };
    let solid = picture(Line::new(path.clone(), 6.0, RED));
    let darkness: f32 =
        (0..SIZE[1]).map(|y| f32::from(255 - solid.at(120, y)[1]) / f32::from(255 - RED.to_bytes()[1])).sum();
    assert!((darkness - 6.0).abs() < 0.6, "{darkness}");

    let dashed = picture(Line::new(path, 6.0, RED).dashed(0.2, 0.5));
    let row: Vec<bool> = (30..210).map(|x| near(dashed.at(x, 90), RED, 3)).collect();
    let changes = row.windows(2).filter(|w| w[0] != w[1]).count();
    assert!(changes >= 12, "{changes}");

    // One end far behind the eye.
    let through = picture(Line::new(vec![Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.3, -40.0, 0.0)], 4.0, RED));
    let colored = through.pixels.iter().filter(|p| near(**p, RED, 3)).count();
    assert!(colored > 100 && colored < 3000, "{colored}");
}

#[test]
fn bodies_throw_a_shadow_on_the_floor() {
    let mut scene = Scene {
        blocks: vec![cube(Vec3::new(0.0, 0.0, 0.2), 0.2, RED)],
        ground: Some(Ground {
            center: Vec3::ZERO,
            radius: 4.0,
            spacing: 0.0,
            major: 1,
            line: Color::CLEAR,
            glow: Color::CLEAR,
            shadow: 0.8,
            contacts: vec![],
        }),
        ..Default::default()
    };
    let camera = Camera::looking_at(Vec3::ZERO, 4.0, -1.57, 1.4);
    // Light from the left at 45°: the shadow lies to the right.
    let studio = Studio { key_from: Vec3::new(-1.0, 0.0, 1.0), ..flat(Color::WHITE) };
    let (in_shadow, in_light) = (Vec3::new(0.4, 0.0, 0.0), Vec3::new(-0.4, 0.0, 0.0));
    let picture = shown(&scene, &camera, &studio);
    assert!(at(&picture, &camera, in_shadow)[1] < 120);
    assert!(at(&picture, &camera, in_light)[1] > 240);
    scene.blocks[0].finish = Finish::Ghost;
    let picture = shown(&scene, &camera, &studio);
    assert!(at(&picture, &camera, in_shadow)[1] > 240);
}

#[test]
fn a_clear_background_lets_through_what_is_under_the_view() {
    let gpu = Gpu::new();
    let mut renderer = Renderer::new(&gpu.device, FORMAT);
    let below = wgpu::Color { r: 0.2, g: 0.4, b: 0.6, a: 1.0 };
    let scene =
        Scene { markers: vec![Marker::new(Vec3::ZERO, Shape::Circle, 40.0, RED.alpha(0.5))], ..Default::default() };
    let picture = render(&gpu, &mut renderer, (&scene, 0), &level(), &flat(Color::CLEAR), (SIZE, 1.0), below);
    let under = Color::rgba(0.2, 0.4, 0.6, 1.0);
    assert!(near(picture.at(3, 3), under, 1));
    assert!(near(picture.at(120, 90), under.mix(RED, 0.5), 2));
}

#[test]
fn any_size_is_drawn_and_nothing_is_drawn_twice() {
    let gpu = Gpu::new();
    let Gpu { device, queue } = &gpu;
    let mut renderer = Renderer::new(device, FORMAT);
    let (scene, camera) = bench(Palette::LIGHT);
    let mut drawn = |size_px, scene_version, pixels_per_point| {
        let mut encoder = device.create_command_encoder(&Default::default());
        let frame = Frame {
            view: ViewId(7),
            size_px,
            pixels_per_point,
            scene: &scene,
            scene_version,
            camera: &camera,
            studio: &Studio::DARK,
        };
        let drew = renderer.prepare(device, queue, &mut encoder, &frame);
        lay(&renderer, device, &mut encoder, ViewId(7));
        queue.submit([encoder.finish()]);
        drew
    };
    assert!(drawn([0, 0], 0, f32::NAN));
    assert!(drawn([u32::MAX, 3], 0, 1.0));
    assert!(drawn([64, 64], 0, 1e9));
    assert!(drawn([64, 64], 0, 2.0));
    assert!(!drawn([64, 64], 0, 2.0));
    assert!(drawn([64, 64], 1, 2.0));
    renderer.forget(ViewId(7));
    device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
}

/// Paints a view onto a target that nobody looks at.
fn lay(renderer: &Renderer, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, view: ViewId) {
    let target = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: 8, height: 8, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let target = target.create_view(&Default::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        ..Default::default()
    });
    renderer.paint(&mut pass, view);
}

#[test]
fn a_frame_that_was_given_up_is_drawn_again() {
    let gpu = Gpu::new();
    let Gpu { device, queue } = &gpu;
    let mut renderer = Renderer::new(device, FORMAT);
    let (scene, camera) = bench(Palette::LIGHT);
    let mut drawn = |given_up: bool| {
        let mut encoder = device.create_command_encoder(&Default::default());
        let frame = Frame {
            view: ViewId(3),
            size_px: [64, 64],
            pixels_per_point: 1.0,
            scene: &scene,
            scene_version: 1,
            camera: &camera,
            studio: &Studio::DARK,
        };
        let drew = renderer.prepare(device, queue, &mut encoder, &frame);
        if !given_up {
            lay(&renderer, device, &mut encoder, ViewId(3));
            queue.submit([encoder.finish()]);
        }
        drew
    };
    assert!(drawn(true), "no surface could be had");
    assert!(drawn(false), "the picture was never drawn");
    assert!(!drawn(false));
    device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
}

#[test]
fn two_views_do_not_disturb_each_other() {
    let gpu = Gpu::new();
    let Gpu { device, queue } = &gpu;
    let mut renderer = Renderer::new(device, FORMAT);
    let one = Scene { blocks: vec![cube(Vec3::ZERO, 0.5, RED)], ..Default::default() };
    let other = Scene::default();
    let mut encoder = device.create_command_encoder(&Default::default());
    let frame = Frame {
        view: ViewId(1),
        size_px: [90, 40],
        pixels_per_point: 1.0,
        scene: &other,
        scene_version: 1,
        camera: &level(),
        studio: &flat(BLUE),
    };
    renderer.prepare(device, queue, &mut encoder, &frame);
    queue.submit([encoder.finish()]);
    let picture =
        render(&gpu, &mut renderer, (&one, 1), &level(), &flat(Color::WHITE), (SIZE, 1.0), wgpu::Color::BLACK);
    let [r, _, b, _] = picture.at(120, 90);
    assert!(r > 2 * b);
    assert!(near(picture.at(2, 2), Color::WHITE, 1));
}

#[test]
fn a_snapshot_is_the_picture_and_may_have_no_background() {
    let gpu = Gpu::new();
    let mut renderer = Renderer::new(&gpu.device, FORMAT);
    let palette = Palette::LIGHT;
    let (mut scene, camera) = bench(palette);
    // No multiple of the bytes to which rows are padded on their way back.
    let size = [330, 250];
    let mut taken = |scene: &Scene, studio: &Studio| {
        let frame = Frame {
            view: ViewId(1),
            size_px: size,
            pixels_per_point: 1.0,
            scene,
            scene_version: 0,
            camera: &camera,
            studio,
        };
        let snapshot = renderer.snapshot(&gpu.device, &gpu.queue, &frame).expect("a picture");
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("the GPU finishes");
        snapshot.take(&gpu.device).expect("it is there").expect("pixels")
    };
    let opaque = taken(&scene, &palette.studio);
    let ground = scene.ground.take();
    let clear =
        Studio { inner: palette.studio.inner.alpha(0.0), outer: palette.studio.outer.alpha(0.0), ..palette.studio };
    let cut = taken(&scene, &clear);
    scene.ground = ground;
    let shown = render(&gpu, &mut renderer, (&scene, 1), &camera, &palette.studio, (size, 1.0), wgpu::Color::GREEN);
    assert_eq!((opaque.size, opaque.rgba.len()), (size, shown.pixels.len() * 4));
    assert!(opaque.rgba.chunks_exact(4).zip(&shown.pixels).all(|(a, b)| a == b), "what the page shows");

    let pixel = |x: u32, y: u32| &cut.rgba[4 * (y * size[0] + x) as usize..][..4];
    for (x, y) in [(2, 2), (size[0] - 3, 2), (2, size[1] - 3)] {
        assert_eq!(pixel(x, y), [0; 4], "a corner");
    }
    let robot = cut.rgba.chunks_exact(4).filter(|pixel| pixel[3] == 255).count();
    assert!(robot > shown.pixels.len() / 50, "{robot} pixels of the robot");
}
