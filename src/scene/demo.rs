//! A scene with one of everything, made up: for tests, examples and as a model of how to fill a [`Scene`].

use glam::{Quat, Vec2, Vec3};

use super::{
    Block, Cap, Color, Disk, Finish, Ground, Hole, Label, Line, Mark, Marker, Pose, Scene, Shape, Solid, Tube, arc,
    palette::Palette,
};

const LENGTH: f32 = 0.030;
const PITCH: f32 = 0.003;
const RADIUS: f32 = 0.0042;
const SPACERS: [f32; 3] = [0.0075, 0.015, 0.0225];
const CONTACT: f32 = 0.015;
/// Height of the floor.
const FLOOR: f32 = -0.0026;

/// A segment of 30 mm that has met a beam at its middle disk and bends on by `bend` rad in all.
pub fn scene(palette: &Palette, bend: f32) -> Scene {
    let mut scene = Scene::default();
    let bend_at_contact = 0.42 * bend;
    let below = move |s: f32| arc::circular(LENGTH, bend_at_contact, 0.0, s);
    let at_contact = below(CONTACT);
    let rest = bend - bend_at_contact * CONTACT / LENGTH;
    let shape = move |s: f32| {
        if s <= CONTACT { below(s) } else { at_contact.then(&arc::circular(LENGTH - CONTACT, rest, 0.0, s - CONTACT)) }
    };
    let free = move |s: f32| arc::circular(LENGTH, bend, 0.0, s);

    scene.ground = Some(Ground {
        center: Vec3::new(0.004, 0.0, FLOOR),
        radius: 0.062,
        spacing: 0.005,
        major: 2,
        line: palette.grid,
        glow: palette.glow,
        shadow: palette.ground_shadow,
        contacts: vec![[0.0, 0.0, 0.0078, 0.45]],
    });

    robot(&mut scene, palette, shape);
    ghost(&mut scene, palette, free);
    beam(&mut scene, palette, at_contact);
    loci(&mut scene, palette, bend);
    let center = Vec3::new(0.014, 0.0, 0.012);
    scene.lines.push(
        Line::new(vec![center - Vec3::Y * 0.02, center + Vec3::Y * 0.02], 2.0, palette.sensor)
            .dashed(0.0022, 0.62)
            .through(0.25),
    );
    scene.markers.push(
        Marker::new(at_contact.position, Shape::Diamond, 13.0, palette.detection)
            .outlined(palette.halo, 1.5)
            .pulsing(0.55)
            .lifted(0.006),
    );
    scene.labels.push(Label {
        anchor: at_contact.position,
        offset: Vec2::new(-14.0, -14.0),
        text: "contact".to_owned(),
        color: palette.detection,
    });
    scene
}

fn holes(radius: f32) -> Vec<Hole> {
    let on_pitch = (0..3).map(|i| arc::pitch_point(PITCH, i, 3));
    std::iter::once(Vec2::ZERO).chain(on_pitch).map(|center| Hole { center, radius }).collect()
}

fn robot(scene: &mut Scene, palette: &Palette, shape: impl Fn(f32) -> Pose) {
    let frames = arc::frames(Pose::IDENTITY, LENGTH, 48, &shape);
    let frames = arc::extended(&frames, 0.0, 0.0011);
    let tube = |path, radius, color| Tube { path, radius, color, finish: Finish::Metal, cap: Cap::Flat };
    scene.tubes.push(tube(arc::offset(&frames, Vec2::ZERO), 0.00044, palette.steel_primary));
    for i in 0..3 {
        let path = arc::offset(&frames, arc::pitch_point(PITCH, i, 3));
        scene.tubes.push(tube(path, 0.00032, palette.steel));
    }
    let mark = Some(Mark { angle: 0.0, color: palette.mark });
    let disk = |s, radius, thickness, alpha| Disk {
        pose: shape(s),
        radius,
        thickness,
        holes: holes(0.0006),
        mark,
        color: palette.disk.alpha(alpha),
        finish: Finish::Satin,
    };
    for s in SPACERS {
        scene.disks.push(disk(s, RADIUS, 0.0007, 0.72));
    }
    scene.disks.push(disk(LENGTH, RADIUS, 0.0012, 0.9));
    let mut base = disk(0.0, 0.0052, 0.0016, 1.0);
    base.pose.position.z -= 0.0004;
    scene.disks.push(base);
    scene.blocks.push(Block {
        pose: Pose::new(Vec3::new(0.0, 0.0, -0.0019), Quat::IDENTITY),
        solid: Solid::Cylinder { radius: 0.0066, half_length: 0.0007 },
        bevel: 0.0003,
        color: palette.disk.mix(Color::BLACK, 0.35),
        finish: Finish::Matte,
    });
}

fn ghost(scene: &mut Scene, palette: &Palette, shape: impl Fn(f32) -> Pose) {
    let frames = arc::frames(Pose::IDENTITY, LENGTH, 48, &shape);
    for i in 0..3 {
        scene.tubes.push(Tube {
            path: arc::offset(&frames, arc::pitch_point(PITCH, i, 3)),
            radius: 0.00032,
            color: palette.model.alpha(0.45),
            finish: Finish::Ghost,
            cap: Cap::None,
        });
    }
    let line = |path, width| Line::new(path, width, palette.model.alpha(0.85)).through(0.2);
    scene.lines.push(line(arc::offset(&frames, Vec2::ZERO), 1.75).dashed(0.0016, 0.6));
    for s in SPACERS.into_iter().chain([LENGTH]) {
        scene.lines.push(line(arc::circle(shape(s), RADIUS, 64), 1.25));
    }
}

/// The beam comes from behind, where a post carries it, and ends a little in front of the robot.
fn beam(scene: &mut Scene, palette: &Palette, at: Pose) {
    let half = Vec3::new(0.0013, 0.0125, 0.0013);
    let middle = at.point(Vec3::new(RADIUS + half.x, 0.007, 0.0));
    let block = |position, rotation, half| Block {
        pose: Pose::new(position, rotation),
        solid: Solid::Box { half },
        bevel: 0.0003,
        color: palette.stone,
        finish: Finish::Matte,
    };
    scene.blocks.push(block(middle, at.rotation, half));
    let post = Vec2::new(middle.x, 0.0174);
    let half_height = 0.5 * (middle.z + 0.0021 - FLOOR);
    scene.blocks.push(block(post.extend(FLOOR + half_height), Quat::IDENTITY, Vec3::new(0.0016, 0.0016, half_height)));
    if let Some(ground) = &mut scene.ground {
        ground.contacts.push([post.x, post.y, 0.0028, 0.4]);
    }
}

fn loci(scene: &mut Scene, palette: &Palette, bend: f32) {
    let curves = [
        (Shape::Triangle, palette.model, 0.0),
        (Shape::Circle, palette.constrained, 0.0055),
        (Shape::Dot, palette.sensor, 0.0062),
    ];
    for (shape, color, shift) in curves {
        let path: Vec<_> = (1..=14)
            .map(|i| {
                let phi = bend * (0.25 + 0.75 * i as f32 / 14.0);
                let radius = 0.5 * LENGTH / (0.5 * phi).tan();
                Vec3::new(0.4 * radius, 0.0, 0.0125) + Vec3::new(0.25, 0.0, 1.0) * shift
            })
            .collect();
        scene.lines.push(Line::new(path.clone(), 1.0, color.alpha(0.6)).through(0.2));
        scene.markers.extend(path.into_iter().map(|p| Marker::new(p, shape, 9.0, color).outlined(palette.halo, 1.25)));
    }
}
