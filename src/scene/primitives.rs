//! The things a scene can hold.

use glam::{Quat, Vec2, Vec3};

use super::Color;

/// Position and orientation of a body: `scene_from_body`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Origin of the body frame, in m.
    pub position: Vec3,
    /// Rotation from the body frame to the scene.
    pub rotation: Quat,
}

impl Pose {
    /// The scene's own frame.
    pub const IDENTITY: Self = Self { position: Vec3::ZERO, rotation: Quat::IDENTITY };

    /// A pose from its parts.
    pub const fn new(position: Vec3, rotation: Quat) -> Self {
        Self { position, rotation }
    }

    /// The scene position of a point given in the body frame.
    pub fn point(&self, in_body: Vec3) -> Vec3 {
        self.position + self.rotation * in_body
    }

    /// This pose followed by `inner`, which is given in this body's frame.
    #[must_use]
    pub fn then(&self, inner: &Self) -> Self {
        Self::new(self.point(inner.position), (self.rotation * inner.rotation).normalize())
    }
}

/// How a surface takes light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Finish {
    /// Soft and dull, like anodised or printed parts.
    #[default]
    Matte,
    /// Some gloss, like machined plastic.
    Satin,
    /// Polished metal that mirrors the studio.
    Metal,
    /// A shape that is assumed, not there: unlit, faint toward its middle, without shadow.
    Ghost,
}

/// How a tube ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cap {
    /// Open.
    None,
    /// A flat face.
    #[default]
    Flat,
    /// A half sphere.
    Round,
}

/// A tube around a polyline.
#[derive(Clone, Debug, PartialEq)]
pub struct Tube {
    /// Centreline, in m. Points that repeat or are not finite are skipped; fewer than two draw nothing.
    pub path: Vec<Vec3>,
    /// Radius, in m.
    pub radius: f32,
    /// Colour; alpha below 1 makes it translucent.
    pub color: Color,
    /// Surface.
    pub finish: Finish,
    /// Both ends.
    pub cap: Cap,
}

/// A round hole through a disk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// Centre in the disk's x–y plane, in m.
    pub center: Vec2,
    /// Radius, in m.
    pub radius: f32,
}

/// A raised bar at a disk's rim that shows how the disk is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Direction from the centre, as an angle from the disk's x toward its y, in rad.
    pub angle: f32,
    /// Colour; its alpha is used as it is.
    pub color: Color,
}

/// A round plate with holes; its axis is z of its frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Disk {
    /// `scene_from_disk`; the origin is the middle of the plate.
    pub pose: Pose,
    /// Radius, in m.
    pub radius: f32,
    /// Thickness along z, in m.
    pub thickness: f32,
    /// Holes. One that leaves the disk or meets an earlier one is left out.
    pub holes: Vec<Hole>,
    /// Orientation mark, if any.
    pub mark: Option<Mark>,
    /// Colour; alpha below 1 makes it translucent.
    pub color: Color,
    /// Surface.
    pub finish: Finish,
}

/// The form of a [`Block`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solid {
    /// A box with these half sizes along x, y, z, in m.
    Box {
        /// Half sizes, in m.
        half: Vec3,
    },
    /// A cylinder along z.
    Cylinder {
        /// Radius, in m.
        radius: f32,
        /// Half length, in m.
        half_length: f32,
    },
}

/// A box or a cylinder with rounded edges: an obstacle, a beam, a base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// `scene_from_block`; the origin is the middle.
    pub pose: Pose,
    /// Form and size.
    pub solid: Solid,
    /// Radius of the rounded edges, in m; clamped to what fits.
    pub bevel: f32,
    /// Colour; alpha below 1 makes it translucent.
    pub color: Color,
    /// Surface.
    pub finish: Finish,
}

/// Dashes along a [`Line`], measured along its length in the scene, so that they stay put while one orbits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dash {
    /// Length of one dash and one gap together, in m.
    pub period: f32,
    /// Part of the period that is drawn, 0..1.
    pub filled: f32,
}

/// A polyline of constant width on the screen.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Corners, in m. A closed line repeats its first point.
    pub path: Vec<Vec3>,
    /// Width, in points.
    pub width: f32,
    /// Colour.
    pub color: Color,
    /// Dashes; `None` is solid.
    pub dash: Option<Dash>,
    /// Opacity factor, 0..1, where something opaque stands before it. 0 hides it there.
    pub through: f32,
    /// How far toward the viewer it is moved before it is compared with what stands there, in m.
    pub lift: f32,
}

impl Line {
    /// A solid line that is hidden behind opaque things.
    pub fn new(path: Vec<Vec3>, width: f32, color: Color) -> Self {
        Self { path, width, color, dash: None, through: 0.0, lift: 0.0 }
    }

    /// Dashed: `period` in m, `filled` the drawn part of it.
    #[must_use]
    pub fn dashed(mut self, period: f32, filled: f32) -> Self {
        self.dash = Some(Dash { period, filled });
        self
    }

    /// Seen through opaque things with this opacity factor.
    #[must_use]
    pub fn through(mut self, opacity: f32) -> Self {
        self.through = opacity;
        self
    }

    /// Moved toward the viewer by `lift` m for the depth comparison.
    #[must_use]
    pub fn lifted(mut self, lift: f32) -> Self {
        self.lift = lift;
        self
    }
}

/// The form of a [`Marker`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Filled circle.
    Circle,
    /// Triangle that points up.
    Triangle,
    /// Small filled circle: about half the size of [`Shape::Circle`].
    Dot,
    /// Upright cross.
    Cross,
    /// Square on its corner.
    Diamond,
    /// Circle without filling; its stroke takes the fill colour.
    Ring,
}

/// A sign of constant size on the screen, at a place in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marker {
    /// Place, in m.
    pub position: Vec3,
    /// Form.
    pub shape: Shape,
    /// Width, in points.
    pub size: f32,
    /// Filling.
    pub fill: Color,
    /// Edge; [`Color::CLEAR`] for none.
    pub outline: Color,
    /// Width of the edge, in points; it lies outside the form.
    pub outline_width: f32,
    /// Opacity of the whole, 0..1.
    pub opacity: f32,
    /// A ring that runs outward once as this goes from 0 to 1; nothing is drawn of it at both ends.
    pub pulse: f32,
    /// Opacity factor, 0..1, where something opaque stands before it.
    pub through: f32,
    /// How far toward the viewer it is moved before it is compared with what stands there, in m.
    pub lift: f32,
}

impl Marker {
    /// A marker without edge, faintly seen through opaque things.
    pub const fn new(position: Vec3, shape: Shape, size: f32, fill: Color) -> Self {
        Self {
            position,
            shape,
            size,
            fill,
            outline: Color::CLEAR,
            outline_width: 0.0,
            opacity: 1.0,
            pulse: 0.0,
            through: 0.3,
            lift: 0.0,
        }
    }

    /// With an edge of `width` points around it.
    #[must_use]
    pub const fn outlined(mut self, color: Color, width: f32) -> Self {
        self.outline = color;
        self.outline_width = width;
        self
    }

    /// With the pulse ring at `pulse` of its way.
    #[must_use]
    pub const fn pulsing(mut self, pulse: f32) -> Self {
        self.pulse = pulse;
        self
    }

    /// Seen through opaque things with this opacity factor.
    #[must_use]
    pub const fn through(mut self, opacity: f32) -> Self {
        self.through = opacity;
        self
    }

    /// With this opacity.
    #[must_use]
    pub const fn faded(mut self, opacity: f32) -> Self {
        self.opacity = opacity;
        self
    }

    /// Moved toward the viewer by `lift` m for the depth comparison.
    #[must_use]
    pub const fn lifted(mut self, lift: f32) -> Self {
        self.lift = lift;
        self
    }
}

/// Text at a place in the scene. The renderer does not draw it: place it with [`super::Camera::project`].
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// What it names, in m.
    pub anchor: Vec3,
    /// Where the text stands from there, in points, x to the right and y down.
    pub offset: Vec2,
    /// The text.
    pub text: String,
    /// Its colour.
    pub color: Color,
}

/// The floor: a grid that fades out, and the receiver of shadows. It lies in a plane of constant z.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    /// Middle, in m.
    pub center: Vec3,
    /// Where it has faded out, in m. It tells the renderer the scene's size: shadows are soft in proportion to it.
    pub radius: f32,
    /// Distance of two grid lines, in m; 0 for no grid.
    pub spacing: f32,
    /// Every how many lines one is stronger.
    pub major: u32,
    /// Colour of a strong line; the others have 45 % of its alpha.
    pub line: Color,
    /// Light that lies on the floor around its middle; its alpha is the strength there.
    pub glow: Color,
    /// Darkness of cast shadows, 0..1.
    pub shadow: f32,
    /// Soft dark spots where bodies stand: middle (x, y), radius in m, darkness 0..1. The first four count.
    pub contacts: Vec<[f32; 4]>,
}

/// Everything in one picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Backbones, wires, rods.
    pub tubes: Vec<Tube>,
    /// Plates.
    pub disks: Vec<Disk>,
    /// Boxes and cylinders.
    pub blocks: Vec<Block>,
    /// Lines over all of them.
    pub lines: Vec<Line>,
    /// Signs over the lines, drawn in order.
    pub markers: Vec<Marker>,
    /// Texts, for whoever draws text.
    pub labels: Vec<Label>,
    /// The floor.
    pub ground: Option<Ground>,
}

impl Scene {
    /// Makes all lines and the edges of signs so many times thicker.
    pub fn thicken(&mut self, times: f32) {
        self.lines.iter_mut().for_each(|line| line.width *= times);
        self.markers.iter_mut().for_each(|marker| marker.outline_width *= times);
    }
}
