//! What belongs to one view: its pictures, its uniforms, its geometry.

use super::{
    Frame,
    batch::Batch,
    buffer::Reused,
    pipelines::{Pipelines, SHADOW_DEPTH},
    snapshot::Snapshot,
    target::{Target, fitting},
    uniforms::{Globals, Inputs, SHADOW_TEXELS},
};
use crate::scene::{Camera, Studio};
use std::sync::atomic::{AtomicBool, Ordering};

pub(super) struct View {
    target: Option<Target>,
    globals: wgpu::Buffer,
    globals_group: wgpu::BindGroup,
    shadow_map: wgpu::TextureView,
    shadow_group: wgpu::BindGroup,
    batch: Batch,
    vertices: Reused,
    indices: Reused,
    pieces: Reused,
    signs: Reused,
    uploaded: Option<u64>,
    drawn: Option<Drawn>,
    /// Whether `drawn` was laid on a target. A frame can end between the two (no surface to be had), and what its
    /// encoder held is lost; only `paint` knows, which has no more than a shared reference.
    painted: AtomicBool,
}

/// What a finished picture depends on.
#[derive(Clone, Copy, PartialEq)]
struct Drawn {
    version: u64,
    camera: Camera,
    studio: Studio,
    size: [u32; 2],
    pixels_per_point: f32,
}

impl View {
    pub(super) fn new(device: &wgpu::Device, pipelines: &Pipelines) -> Self {
        let globals = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("scene globals"),
            size: size_of::<Globals>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let globals_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene globals"),
            layout: &pipelines.globals_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: globals.as_entire_binding() }],
        });
        let shadow_map = device
            .create_texture(&wgpu::TextureDescriptor {
                label: Some("shadow map"),
                size: wgpu::Extent3d { width: SHADOW_TEXELS, height: SHADOW_TEXELS, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: SHADOW_DEPTH,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            })
            .create_view(&wgpu::TextureViewDescriptor::default());
        let shadow_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shadow map"),
            layout: &pipelines.shadow_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&shadow_map) },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: wgpu::BindingResource::Sampler(&pipelines.shadow_sampler),
                },
            ],
        });
        Self {
            target: None,
            globals,
            globals_group,
            shadow_map,
            shadow_group,
            batch: Batch::default(),
            vertices: Reused::new("scene vertices", wgpu::BufferUsages::VERTEX),
            indices: Reused::new("scene indices", wgpu::BufferUsages::INDEX),
            pieces: Reused::new("scene lines", wgpu::BufferUsages::VERTEX),
            signs: Reused::new("scene markers", wgpu::BufferUsages::VERTEX),
            uploaded: None,
            drawn: None,
            painted: AtomicBool::new(false),
        }
    }

    /// Asks for the pixels of the picture that an encoder is about to draw.
    pub(super) fn snapshot(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: wgpu::CommandEncoder,
    ) -> Option<Snapshot> {
        self.target.as_ref().map(|target| Snapshot::new(device, queue, encoder, target))
    }

    /// The picture, if there is one, to be laid on a target now.
    pub(super) fn to_paint(&self) -> Option<&wgpu::BindGroup> {
        self.painted.store(true, Ordering::Relaxed);
        self.target.as_ref().map(|t| &t.blit)
    }

    /// Draws the frame, unless the picture at hand shows just that. Returns whether it drew.
    pub(super) fn draw(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        pipelines: &Pipelines,
        frame: &Frame<'_>,
    ) -> bool {
        let limit = device.limits().max_texture_dimension_2d;
        let (size, scale) = fitting(frame.size_px, limit);
        let pixels_per_point =
            if frame.pixels_per_point > 0.0 { (frame.pixels_per_point * scale).min(16.0) } else { 1.0 };
        let wanted = Drawn {
            version: frame.scene_version,
            camera: *frame.camera,
            studio: *frame.studio,
            size,
            pixels_per_point,
        };
        if self.drawn == Some(wanted) && *self.painted.get_mut() {
            return false;
        }
        self.drawn = Some(wanted);
        *self.painted.get_mut() = false;

        if self.uploaded != Some(frame.scene_version) {
            self.upload(device, queue, frame);
        }
        let globals = Globals::new(&Inputs {
            camera: frame.camera,
            studio: frame.studio,
            ground: frame.scene.ground.as_ref(),
            size,
            pixels_per_point,
            casters: self.batch.casters,
        });
        queue.write_buffer(&self.globals, 0, bytemuck::bytes_of(&globals));
        let view_size = glam::Vec2::new(size[0] as f32, size[1] as f32);
        self.batch.sort(frame.camera.eye(view_size));

        if self.batch.casters.is_some() {
            self.draw_shadow(encoder, pipelines);
        }
        if self.target.as_ref().is_none_or(|t| t.size != size) {
            // The old one goes first: both at once may be more than there is.
            self.target = None;
            self.target = Some(Target::new(device, &pipelines.blit_layout, &pipelines.blit_sampler, size));
        }
        if let Some(target) = &self.target {
            self.draw_scene(encoder, pipelines, target, frame.scene.ground.is_some());
        }
        true
    }

    fn upload(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, frame: &Frame<'_>) {
        let batch = &mut self.batch;
        batch.fill(frame.scene);
        let mesh = &batch.mesh;
        self.vertices.write(device, queue, bytemuck::cast_slice(&mesh.vertices));
        self.indices.write(device, queue, bytemuck::cast_slice(&mesh.indices));
        self.pieces.write(device, queue, bytemuck::cast_slice(&batch.pieces));
        self.signs.write(device, queue, bytemuck::cast_slice(&batch.signs));
        self.uploaded = Some(frame.scene_version);
    }

    fn draw_shadow(&self, encoder: &mut wgpu::CommandEncoder, pipelines: &Pipelines) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow map"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.shadow_map,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        if let (Some(vertices), Some(indices)) = (self.vertices.slice(), self.indices.slice()) {
            pass.set_pipeline(&pipelines.shadow);
            pass.set_bind_group(0, &self.globals_group, &[]);
            pass.set_vertex_buffer(0, vertices);
            pass.set_index_buffer(indices, wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..self.batch.casting, 0, 0..1);
        }
    }

    fn draw_scene(&self, encoder: &mut wgpu::CommandEncoder, pipelines: &Pipelines, target: &Target, ground: bool) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target.samples,
                depth_slice: None,
                resolve_target: Some(&target.resolved),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Discard,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &target.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, &self.globals_group, &[]);
        pass.set_pipeline(&pipelines.backdrop);
        pass.draw(0..3, 0..1);

        pass.set_bind_group(1, &self.shadow_group, &[]);
        let bodies = match (self.vertices.slice(), self.indices.slice()) {
            (Some(vertices), Some(indices)) => {
                pass.set_vertex_buffer(0, vertices);
                pass.set_index_buffer(indices, wgpu::IndexFormat::Uint32);
                true
            }
            _ => false,
        };
        if bodies && self.batch.opaque > 0 {
            pass.set_pipeline(&pipelines.opaque);
            pass.draw_indexed(0..self.batch.opaque, 0, 0..1);
        }
        if ground {
            pass.set_pipeline(&pipelines.ground);
            pass.draw(0..4, 0..1);
        }
        if bodies && !self.batch.parts.is_empty() {
            pass.set_pipeline(&pipelines.translucent);
            for part in &self.batch.parts {
                pass.draw_indexed(part.indices.clone(), 0, 0..1);
            }
        }
        let overlays = [
            (&self.pieces, self.batch.pieces.len(), [&pipelines.line_hidden, &pipelines.line]),
            (&self.signs, self.batch.signs.len(), [&pipelines.marker_hidden, &pipelines.marker]),
        ];
        for (buffer, count, passes) in overlays {
            if let Some(instances) = buffer.slice() {
                pass.set_vertex_buffer(0, instances);
                for pipeline in passes {
                    pass.set_pipeline(pipeline);
                    pass.draw(0..4, 0..count as u32);
                }
            }
        }
    }
}

/// At once, as `Target`.
impl Drop for View {
    fn drop(&mut self) {
        self.globals.destroy();
        self.shadow_map.texture().destroy();
    }
}
