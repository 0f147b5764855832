//! What all shaders of one view share, as the GPU lays it out.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec2, Vec3, camera::rh};

use crate::scene::{Camera, Color, Ground, Studio};

/// The uniform block `Globals` of `common.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Globals {
    clip_from_scene: [[f32; 4]; 4],
    light_from_scene: [[f32; 4]; 4],
    eye: [f32; 4],
    viewport: [f32; 4],
    key: [f32; 4],
    fill: [f32; 4],
    rim: [f32; 4],
    sky: [f32; 4],
    floor: [f32; 4],
    backdrop_inner: [f32; 4],
    backdrop_outer: [f32; 4],
    ground: [f32; 4],
    grid: [f32; 4],
    grid_color: [f32; 4],
    glow: [f32; 4],
    shadow: [f32; 4],
    contacts: [[f32; 4]; 4],
}

// Two matrices, fourteen vectors and an array of four, all of 16-byte alignment: no padding on any backend.
const _: () = assert!(size_of::<Globals>() == 2 * 64 + 14 * 16 + 4 * 16);

/// Edge of the shadow map, in texels.
pub(super) const SHADOW_TEXELS: u32 = 1024;
/// Radius over which shadows on the floor are averaged, as a part of the floor's radius.
const GROUND_SOFTNESS: f32 = 0.027;
/// The same on bodies.
const BODY_SOFTNESS: f32 = 0.0035;
/// How far a ghost yields to a body in the same place, as a part of the floor's radius: where both shapes agree only the body is seen.
const YIELD: f32 = 0.013;

/// The ball that holds everything which casts a shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ball {
    pub center: Vec3,
    pub radius: f32,
}

/// What [`Globals::new`] needs.
pub(super) struct Inputs<'a> {
    pub camera: &'a Camera,
    pub studio: &'a Studio,
    pub ground: Option<&'a Ground>,
    /// In pixels.
    pub size: [u32; 2],
    pub pixels_per_point: f32,
    /// `None`: nothing casts a shadow.
    pub casters: Option<Ball>,
}

impl Globals {
    pub(super) fn new(inputs: &Inputs<'_>) -> Self {
        let Inputs { camera, studio, ground, size, pixels_per_point, casters } = *inputs;
        let size = Vec2::new(size[0] as f32, size[1] as f32);
        let key = studio.key_from.try_normalize().unwrap_or(Vec3::Z);
        let (right, up) = camera.axes();
        let back = camera.backward();
        let fill = (back * 0.7 - right * 0.9 + up * 0.25).normalize();

        // The floor tells how large the scene is; without one, what stands there does.
        let extent = ground.map(|ground| ground.radius).filter(|radius| *radius > 0.0 && radius.is_finite());
        let extent = extent.or(casters.map(|ball| 3.0 * ball.radius)).unwrap_or(1.0);
        let body_softness = BODY_SOFTNESS * extent;
        // A surface must not fall into its own shadow, over the width that is averaged.
        let stand_off = casters.map_or(0.0, |ball| 3.0 * ball.radius / SHADOW_TEXELS as f32 + 0.8 * body_softness);
        let (light, shadow) = match casters {
            Some(ball) => (
                light_from_scene(key, ball),
                [
                    2.0 * ball.radius / SHADOW_TEXELS as f32,
                    0.5 * GROUND_SOFTNESS * extent / ball.radius,
                    1.0,
                    0.5 * body_softness / ball.radius,
                ],
            ),
            None => (Mat4::IDENTITY, [0.0; 4]),
        };

        let mut globals = Self {
            clip_from_scene: camera.view_projection(size).to_cols_array_2d(),
            light_from_scene: light.to_cols_array_2d(),
            eye: camera.eye(size).extend(YIELD * extent).to_array(),
            viewport: [size.x, size.y, pixels_per_point, stand_off],
            key: key.extend(studio.key).to_array(),
            fill: fill.extend(studio.fill).to_array(),
            rim: back.extend(studio.rim).to_array(),
            sky: with_w(studio.sky.to_linear(), studio.shadow),
            floor: studio.floor.to_linear(),
            backdrop_inner: premultiplied(studio.inner),
            backdrop_outer: premultiplied(studio.outer),
            ..Self::zeroed()
        };
        globals.shadow = shadow;
        if let Some(ground) = ground {
            globals.ground = ground.center.extend(ground.radius).to_array();
            globals.grid = [ground.spacing.max(0.0), ground.major.max(1) as f32, ground.shadow, 0.0];
            globals.grid_color = ground.line.to_array();
            globals.glow = ground.glow.to_array();
            for (slot, spot) in globals.contacts.iter_mut().zip(&ground.contacts) {
                *slot = *spot;
            }
        }
        globals
    }
}

/// `light_clip_from_scene`: seen along the key light, so that the ball just fits.
fn light_from_scene(key: Vec3, ball: Ball) -> Mat4 {
    let Ball { center, radius } = ball;
    let up = if key.z.abs() > 0.99 { Vec3::X } else { Vec3::Z };
    let view = rh::view::look_at_mat4(center + key * (2.0 * radius), center, up);
    let projection = rh::proj::directx::orthographic(-radius, radius, -radius, radius, 0.5 * radius, 3.5 * radius);
    projection * view
}

fn premultiplied(color: Color) -> [f32; 4] {
    let [r, g, b, a] = color.to_array();
    [r * a, g * a, b * a, a]
}

fn with_w(v: [f32; 4], w: f32) -> [f32; 4] {
    [v[0], v[1], v[2], w]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_larger_robot_has_the_same_shadows() {
        let ground = |scale: f32| Ground {
            center: Vec3::ZERO,
            radius: 0.06 * scale,
            spacing: 0.005 * scale,
            major: 2,
            line: Color::CLEAR,
            glow: Color::CLEAR,
            shadow: 0.5,
            contacts: vec![],
        };
        let globals = |scale: f32| {
            Globals::new(&Inputs {
                camera: &Camera::looking_at(Vec3::ZERO, 0.09 * scale, 0.0, 0.3),
                studio: &Studio::DARK,
                ground: Some(&ground(scale)),
                size: [100, 100],
                pixels_per_point: 1.0,
                casters: Some(Ball { center: Vec3::ZERO, radius: 0.02 * scale }),
            })
        };
        let (small, large) = (globals(1.0), globals(100.0));
        for i in [1, 3] {
            assert!((large.shadow[i] / small.shadow[i] - 1.0).abs() < 1e-4, "softness {i}");
        }
        assert!((large.viewport[3] / small.viewport[3] - 100.0).abs() < 1e-2, "stand-off");
        assert!((large.eye[3] / small.eye[3] - 100.0).abs() < 1e-2, "yield");
    }
}
