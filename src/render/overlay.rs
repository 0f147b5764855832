//! Lines and markers as instances of a strip of four corners.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use crate::scene::{Line, Marker, Shape};

/// A piece of a line as `line.wgsl` takes it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Piece {
    before: [f32; 3],
    /// w: length along the line, in m.
    a: [f32; 4],
    b: [f32; 4],
    after: [f32; 3],
    color: [u8; 4],
    /// Width in points, dash period, drawn part of it, opacity factor when hidden.
    style: [f32; 4],
    lift: f32,
}

const _: () = assert!(size_of::<Piece>() == 80);

impl Piece {
    pub(super) const LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: size_of::<Self>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &wgpu::vertex_attr_array![
            0 => Float32x3, 1 => Float32x4, 2 => Float32x4, 3 => Float32x3, 4 => Unorm8x4, 5 => Float32x4, 6 => Float32
        ],
    };
}

/// A marker as `marker.wgsl` takes it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Sign {
    /// w: width in points.
    place: [f32; 4],
    fill: [u8; 4],
    outline: [u8; 4],
    /// Width of the edge in points, opacity, pulse, opacity factor when hidden.
    style: [f32; 4],
    lift: f32,
    shape: u32,
}

const _: () = assert!(size_of::<Sign>() == 48);

impl Sign {
    pub(super) const LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
        array_stride: size_of::<Self>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &wgpu::vertex_attr_array![
            0 => Float32x4, 1 => Unorm8x4, 2 => Unorm8x4, 3 => Float32x4, 4 => Float32, 5 => Uint32
        ],
    };
}

/// Adds the pieces of a line. A point that is not finite parts it in two.
pub(super) fn line(pieces: &mut Vec<Piece>, line: &Line) {
    for run in line.path.split(|p| !p.is_finite()) {
        let closed = run.len() > 3 && run.first() == run.last();
        let (period, filled) = match line.dash {
            Some(dash) if dash.period > 0.0 => (dash.period, dash.filled.clamp(0.0, 1.0)),
            _ => (0.0, 0.0),
        };
        let mut along = 0.0;
        for i in 0..run.len().saturating_sub(1) {
            let (a, b) = (run[i], run[i + 1]);
            // At an end the neighbour is the end itself, which the shader reads as: none.
            let before = match i {
                0 if closed => run[run.len() - 2],
                _ => run[i.saturating_sub(1)],
            };
            let after = match run.get(i + 2) {
                Some(&next) => next,
                None if closed => run[1],
                None => b,
            };
            let next = along + a.distance(b);
            pieces.push(Piece {
                before: before.to_array(),
                a: a.extend(along).to_array(),
                b: b.extend(next).to_array(),
                after: after.to_array(),
                color: line.color.to_bytes(),
                style: [line.width, period, filled, line.through.clamp(0.0, 1.0)],
                lift: line.lift,
            });
            along = next;
        }
    }
}

/// Adds a marker.
pub(super) fn marker(signs: &mut Vec<Sign>, marker: &Marker) {
    let Vec3 { x, y, z } = marker.position;
    if !marker.position.is_finite() || marker.size.is_nan() || marker.size <= 0.0 {
        return;
    }
    signs.push(Sign {
        place: [x, y, z, marker.size],
        fill: marker.fill.to_bytes(),
        outline: marker.outline.to_bytes(),
        style: [
            marker.outline_width.max(0.0),
            marker.opacity.clamp(0.0, 1.0),
            marker.pulse,
            marker.through.clamp(0.0, 1.0),
        ],
        lift: marker.lift,
        // The numbers are those of `form` in `marker.wgsl`.
        shape: match marker.shape {
            Shape::Circle => 0,
            Shape::Triangle => 1,
            Shape::Dot => 2,
            Shape::Cross => 3,
            Shape::Diamond => 4,
            Shape::Ring => 5,
        },
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Color;

    fn pieces(path: Vec<Vec3>) -> Vec<Piece> {
        let mut out = Vec::new();
        line(&mut out, &Line::new(path, 1.0, Color::WHITE));
        out
    }

    #[test]
    fn a_closed_line_joins_its_ends() {
        let out = pieces(vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ZERO]);
        assert_eq!(out.len(), 3);
        assert_eq!(out[0].before, Vec3::Y.to_array());
        assert_eq!(out[2].after, Vec3::X.to_array());
    }

    #[test]
    fn an_open_line_has_no_neighbours_at_its_ends() {
        let out = pieces(vec![Vec3::ZERO, Vec3::X, Vec3::Y]);
        assert_eq!(out[0].before, out[0].a[..3]);
        assert_eq!(out[1].after, out[1].b[..3]);
        assert_eq!(out[1].a[3], 1.0);
    }

    #[test]
    fn a_gap_parts_a_line() {
        let gap = Vec3::new(f32::NAN, 0.0, 0.0);
        assert_eq!(pieces(vec![Vec3::ZERO, Vec3::X, gap, Vec3::Y, Vec3::Z]).len(), 2);
        assert!(pieces(vec![]).is_empty() && pieces(vec![Vec3::X]).is_empty());
    }
}
