//! The orbit camera.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{Mat4, Vec2, Vec3, Vec4, camera::rh};

/// A camera that looks at a point and turns around it; z is up.
///
/// Pixels have x to the right, y down, origin at the top left of the view, in whatever unit `size` is given in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The point it looks at, in m.
    pub target: Vec3,
    /// Direction from target to eye in the x–y plane, from +x toward +y, in rad.
    pub yaw: f32,
    /// Height of the eye over the x–y plane through the target, in rad.
    pub pitch: f32,
    /// From target to eye, in m.
    pub distance: f32,
    /// Vertical field of view, in rad.
    pub fov: f32,
    home: Home,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Home {
    target: Vec3,
    yaw: f32,
    pitch: f32,
    distance: f32,
}

/// A half line in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts, in m.
    pub origin: Vec3,
    /// Where it goes; a unit vector.
    pub direction: Vec3,
}

/// Distance at which a segment of 30 mm and its floor fill the view, in m.
const HOME: f32 = 0.086;
/// Pitch stops short of the pole, where yaw would have no meaning.
const MAX_PITCH: f32 = FRAC_PI_2 - 0.02;
/// Just under the floor: enough to see a disk from below.
const MIN_PITCH: f32 = -0.5;
/// Zoom range as factors of the home distance.
const ZOOM: (f32, f32) = (0.12, 6.0);
/// How far the target may be moved from home, as a factor of the home distance.
const PAN: f32 = 1.5;

impl Default for Camera {
    /// For a segment of 30 mm that bends toward +x.
    fn default() -> Self {
        Self::looking_at(Vec3::new(0.0075, 0.0, 0.0125), HOME, -1.22, 0.30)
    }
}

impl Camera {
    /// A camera whose home is this view.
    pub fn looking_at(target: Vec3, distance: f32, yaw: f32, pitch: f32) -> Self {
        let home = Home {
            target,
            yaw,
            pitch: pitch.clamp(MIN_PITCH, MAX_PITCH),
            distance: if distance.is_finite() { distance.clamp(1e-4, 1e4) } else { 1.0 },
        };
        Self { target, yaw, pitch: home.pitch, distance: home.distance, fov: 0.52, home }
    }

    /// Back to the home view.
    pub fn reset(&mut self) {
        let Home { target, yaw, pitch, distance } = self.home;
        (self.target, self.yaw, self.pitch, self.distance) = (target, yaw, pitch, distance);
    }

    /// Turns by a drag of `drag` points: half a turn for about 600 points.
    pub fn orbit(&mut self, drag: Vec2) {
        if !drag.is_finite() {
            return;
        }
        let rate = PI / 600.0;
        self.yaw = wrap(self.yaw - drag.x * rate);
        self.pitch = (self.pitch + drag.y * rate).clamp(MIN_PITCH, MAX_PITCH);
    }

    /// Moves so that what is at the target's depth follows a drag of `drag` in a view of `size`.
    pub fn pan(&mut self, drag: Vec2, size: Vec2) {
        if !drag.is_finite() || size.y < 1.0 {
            return;
        }
        let distance = self.distance * Self::portrait(size);
        let per_pixel = 2.0 * distance * (0.5 * self.fov).tan() / size.y;
        let (right, up) = self.axes();
        let target = self.target + (up * drag.y - right * drag.x) * per_pixel;
        let reach = PAN * self.home.distance;
        self.target = self.home.target + (target - self.home.target).clamp_length_max(reach);
    }

    /// Comes nearer by `factor` (above 1) or goes back (below 1).
    pub fn zoom(&mut self, factor: f32) {
        if factor.is_finite() && factor > 0.0 {
            self.distance = (self.distance / factor).clamp(ZOOM.0 * self.home.distance, ZOOM.1 * self.home.distance);
        }
    }

    /// Zooms so that what is under `pixel`, at the target's depth, stays there.
    pub fn zoom_at(&mut self, factor: f32, pixel: Vec2, size: Vec2) {
        let before = self.distance;
        self.zoom(factor);
        let from_middle = pixel - 0.5 * size;
        self.pan(from_middle * (1.0 - before / self.distance), size);
    }

    /// A camera in this direction that shows all `points` as large as they fit; this is its home.
    ///
    /// `low` and `high` bound the points' place in the picture, from (−1, −1) at the bottom left to (1, 1) at the top
    /// right, in a view that is `aspect` times as wide as high. A wider view has room to the sides; one narrower than
    /// high is seen from farther away.
    pub fn framing(points: &[Vec3], yaw: f32, pitch: f32, aspect: f32, [low, high]: [Vec2; 2]) -> Self {
        let finite = || points.iter().copied().filter(|p| p.is_finite());
        let (least, most) = finite().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(a, b), p| (a.min(p), b.max(p)));
        if !least.is_finite() {
            return Self::looking_at(Vec3::ZERO, HOME, yaw, pitch);
        }
        let mut camera = Self::looking_at(0.5 * (least + most), 2.0 * least.distance(most), yaw, pitch);
        let (size, (right, up)) = (Vec2::new(aspect, 1.0), camera.axes());
        // Perspective couples place and distance, weakly: a few rounds settle it.
        for _ in 0..8 {
            let seen = finite().filter_map(|p| camera.project(p, size)).map(|p| {
                let at = p.truncate() / size;
                Vec2::new(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y)
            });
            let (from, to) = seen.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(a, b), p| (a.min(p), b.max(p)));
            if !from.is_finite() {
                break;
            }
            let fill = ((to - from) / (high - low)).max_element();
            let half = camera.distance * (0.5 * camera.fov).tan();
            let shift = (0.5 * (from + to) - 0.5 * fill * (low + high)) * half;
            let target = camera.target + right * (shift.x * aspect) + up * shift.y;
            camera = Self::looking_at(target, camera.distance * fill, yaw, pitch);
        }
        camera
    }

    /// The factor by which the eye stands farther away in a narrow view, so that as much is seen to the sides
    /// as in one a little wider than high. (The field of view is vertical.)
    fn portrait(size: Vec2) -> f32 {
        (1.15 / aspect(size)).max(1.0)
    }

    /// Where the camera stands when it draws a view of `size`, in m.
    pub fn eye(&self, size: Vec2) -> Vec3 {
        self.target + self.backward() * (self.distance * Self::portrait(size))
    }

    /// From target to eye, a unit vector.
    pub fn backward(&self) -> Vec3 {
        let (sin_yaw, cos_yaw) = self.yaw.sin_cos();
        let (sin_pitch, cos_pitch) = self.pitch.sin_cos();
        Vec3::new(cos_pitch * cos_yaw, cos_pitch * sin_yaw, sin_pitch)
    }

    /// Right and up of the picture, unit vectors in the scene.
    pub fn axes(&self) -> (Vec3, Vec3) {
        let right = Vec3::new(-self.yaw.sin(), self.yaw.cos(), 0.0);
        (right, self.backward().cross(right))
    }

    /// `view_from_scene`: right-handed, looking along −z.
    pub fn view(&self, size: Vec2) -> Mat4 {
        rh::view::look_at_mat4(self.eye(size), self.target, Vec3::Z)
    }

    /// `clip_from_scene` for a view of `size`, with depth 0 (near) to 1 (far).
    pub fn view_projection(&self, size: Vec2) -> Mat4 {
        let distance = self.distance * Self::portrait(size);
        let far = 12.0 * self.home.distance + distance;
        let projection = rh::proj::directx::perspective(self.fov.clamp(0.05, 2.5), aspect(size), 0.04 * distance, far);
        projection * self.view(size)
    }

    /// The pixel of a point, and its depth 0..1 as z. `None` behind the eye.
    pub fn project(&self, point: Vec3, size: Vec2) -> Option<Vec3> {
        let clip: Vec4 = self.view_projection(size) * point.extend(1.0);
        if clip.w <= 0.0 || !clip.is_finite() {
            return None;
        }
        let ndc = clip.truncate() / clip.w;
        Some(Vec3::new((0.5 + 0.5 * ndc.x) * size.x, (0.5 - 0.5 * ndc.y) * size.y, ndc.z))
    }

    /// The ray from the eye through a pixel.
    pub fn ray(&self, pixel: Vec2, size: Vec2) -> Ray {
        let size = size.max(Vec2::ONE);
        let ndc = Vec2::new(2.0 * pixel.x / size.x - 1.0, 1.0 - 2.0 * pixel.y / size.y);
        let tan = (0.5 * self.fov.clamp(0.05, 2.5)).tan();
        let (right, up) = self.axes();
        Ray {
            origin: self.eye(size),
            direction: (right * (ndc.x * tan * aspect(size)) + up * (ndc.y * tan) - self.backward()).normalize(),
        }
    }
}

fn aspect(size: Vec2) -> f32 {
    let ratio = size.x / size.y;
    if ratio.is_finite() { ratio.clamp(0.01, 100.0) } else { 1.0 }
}

fn wrap(angle: f32) -> f32 {
    (angle + PI).rem_euclid(TAU) - PI
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Vec2 = Vec2::new(800.0, 600.0);

    #[test]
    fn the_target_is_in_the_middle() {
        let camera = Camera::default();
        let pixel = camera.project(camera.target, SIZE).unwrap();
        assert!((pixel.truncate() - 0.5 * SIZE).length() < 1e-2, "{pixel}");
        assert!(pixel.z > 0.0 && pixel.z < 1.0);
    }

    #[test]
    fn up_is_up_and_plus_x_is_right() {
        let camera = Camera::default();
        let at = |p: Vec3| camera.project(p, SIZE).unwrap();
        assert!(at(Vec3::Z * 0.03).y < at(Vec3::ZERO).y);
        assert!(at(Vec3::X * 0.01).x > at(Vec3::ZERO).x);
    }

    #[test]
    fn ray_undoes_project() {
        let mut camera = Camera::default();
        camera.orbit(Vec2::new(137.0, -60.0));
        for size in [SIZE, Vec2::new(390.0, 844.0)] {
            for point in [Vec3::ZERO, Vec3::new(0.01, -0.02, 0.03)] {
                let pixel = camera.project(point, size).unwrap().truncate();
                let ray = camera.ray(pixel, size);
                let along = (point - ray.origin).dot(ray.direction);
                assert!((ray.origin + ray.direction * along - point).length() < 1e-6);
            }
        }
    }

    #[test]
    fn nearer_has_smaller_depth_and_behind_has_none() {
        let camera = Camera::default();
        let near = camera.target + camera.backward() * 0.01;
        let far = camera.target - camera.backward() * 0.01;
        assert!(camera.project(near, SIZE).unwrap().z < camera.project(far, SIZE).unwrap().z);
        let behind = camera.eye(SIZE) + camera.backward();
        assert!(camera.project(behind, SIZE).is_none());
    }

    #[test]
    fn limits_hold() {
        let mut camera = Camera::default();
        camera.orbit(Vec2::new(1e6, 1e6));
        assert!(camera.pitch <= MAX_PITCH && camera.yaw.abs() <= PI);
        camera.orbit(Vec2::new(0.0, -1e6));
        assert!(camera.pitch >= MIN_PITCH);
        camera.zoom(1e9);
        assert!(camera.distance >= 0.1 * HOME);
        camera.zoom(1e-9);
        assert!(camera.distance <= 7.0 * HOME);
        camera.zoom(f32::NAN);
        camera.orbit(Vec2::NAN);
        camera.pan(Vec2::new(1e9, 1e9), SIZE);
        assert!((camera.target - Camera::default().target).length() < 0.2);
        assert!(camera.view_projection(Vec2::ZERO).is_finite());
        assert!(camera.view_projection(Vec2::new(1e9, 1.0)).is_finite());
        camera.reset();
        assert_eq!(camera, Camera::default());
    }

    #[test]
    fn pan_follows_the_pointer() {
        let mut camera = Camera::default();
        let point = camera.target;
        camera.pan(Vec2::new(40.0, -25.0), SIZE);
        let pixel = camera.project(point, SIZE).unwrap().truncate();
        assert!((pixel - (0.5 * SIZE + Vec2::new(40.0, -25.0))).length() < 0.05);
    }

    #[test]
    fn zoom_keeps_what_is_under_the_pointer() {
        let mut camera = Camera::default();
        let (right, up) = camera.axes();
        let point = camera.target + right * 0.01 + up * 0.005;
        let pixel = camera.project(point, SIZE).unwrap().truncate();
        camera.zoom_at(1.5, pixel, SIZE);
        assert!((camera.project(point, SIZE).unwrap().truncate() - pixel).length() < 0.05);
    }

    #[test]
    fn framing_fills_the_room_it_is_given() {
        let points = [Vec3::ZERO, Vec3::new(0.02, 0.004, 0.01), Vec3::new(-0.003, 0.0, 0.03), Vec3::NAN];
        let room = [Vec2::new(-0.9, -0.7), Vec2::new(0.9, 0.9)];
        for scale in [1.0, 40.0] {
            let points = points.map(|p| p * scale);
            let mut camera = Camera::framing(&points, -1.2, 0.3, 1.2, room);
            let size = Vec2::new(1200.0, 1000.0);
            let seen: Vec<Vec2> = points
                .iter()
                .filter_map(|&p| camera.project(p, size))
                .map(|p| Vec2::new(p.x / 600.0 - 1.0, 1.0 - p.y / 500.0))
                .collect();
            assert!(seen.iter().all(|p| p.cmpge(room[0] - 5e-3).all() && p.cmple(room[1] + 5e-3).all()), "{seen:?}");
            let high = seen.iter().map(|p| p.y).fold(f32::MIN, f32::max);
            assert!((high - 0.9).abs() < 5e-3, "{high}");
            let home = camera;
            camera.orbit(Vec2::splat(50.0));
            camera.reset();
            assert_eq!(camera, home);
        }
        assert!(Camera::framing(&[], 0.0, 0.0, 1.0, room).eye(Vec2::ONE).is_finite());
    }
}
