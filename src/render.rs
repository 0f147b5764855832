//! Draws a [`Scene`] with wgpu. It knows neither egui nor robots.
//!
//! A [`Renderer`] holds what is made once per device, and one set of pictures and buffers for each [`ViewId`].
//! In egui-wgpu's terms: call [`Renderer::prepare`] from the callback's `prepare`, on the encoder given there, and
//! [`Renderer::paint`] from its `paint`, where the viewport is already the view's rectangle.
//!
//! One frame: a shadow map seen from the key light; then, into a picture with four samples per pixel, the background,
//! opaque bodies, the floor, translucent bodies from far to near, lines, markers; that resolves to a texture, which
//! `paint` lays over the target. Colours are gamma-encoded with premultiplied alpha throughout, as egui's own.
//!
//! It keeps to what WebGL2 can do: no storage buffers, instances from vertex buffers, no first instance, four samples.
//! `web/webgl*.js` must know every format, factor and comparison that is used here.

mod batch;
mod buffer;
mod mesh;
mod overlay;
mod pipelines;
mod shaders;
mod snapshot;
mod target;
mod uniforms;
mod view;

use std::collections::HashMap;

use pipelines::Pipelines;
pub use shaders::SHADERS;
pub use snapshot::{Lost, Pixels, Snapshot};
use view::View;

use crate::scene::{Camera, Scene, Studio};

/// Names one view; each has its own pictures, so that two can be on the screen at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ViewId(pub u32);

/// One picture to be drawn.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// Whose picture it is.
    pub view: ViewId,
    /// Size in pixels. Zero is taken as one; more than the device can do is drawn smaller and stretched.
    pub size_px: [u32; 2],
    /// Pixels per point, for widths and sizes that the scene gives in points.
    pub pixels_per_point: f32,
    /// What to draw.
    pub scene: &'a Scene,
    /// A number that changes whenever the scene does. While it stays, the geometry on the GPU is used again.
    pub scene_version: u64,
    /// From where.
    pub camera: &'a Camera,
    /// In which light, before which background.
    pub studio: &'a Studio,
}

/// Draws scenes on one device.
pub struct Renderer {
    pipelines: Pipelines,
    views: HashMap<ViewId, View>,
}

impl Renderer {
    /// Makes everything that does not depend on a scene. `target_format` is that of the pass given to [`Self::paint`].
    pub fn new(device: &wgpu::Device, target_format: wgpu::TextureFormat) -> Self {
        Self { pipelines: Pipelines::new(device, target_format), views: HashMap::new() }
    }

    /// Draws a frame into its view's picture. Returns false when the picture already shows it and nothing was done.
    ///
    /// A picture counts from [`Self::paint`] on: whoever paints must submit the encoder given here. A frame that is
    /// given up before is drawn again.
    ///
    /// At most one frame of a view may be prepared between two submissions: what the next one does without is freed at once.
    pub fn prepare(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        frame: &Frame<'_>,
    ) -> bool {
        let Self { pipelines, views } = self;
        let view = views.entry(frame.view).or_insert_with(|| View::new(device, pipelines));
        view.draw(device, queue, encoder, pipelines, frame)
    }

    /// Draws a frame and asks for its pixels; the view of the frame must be no other's. None for a frame that cannot be drawn.
    pub fn snapshot(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, frame: &Frame<'_>) -> Option<Snapshot> {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("snapshot") });
        self.prepare(device, queue, &mut encoder, frame);
        let snapshot = self.views.get(&frame.view)?.snapshot(device, queue, encoder);
        // Its pictures are large, and the next one may be long in coming.
        self.forget(frame.view);
        snapshot
    }

    /// Lays a view's picture over the pass's viewport. Without a picture it does nothing.
    pub fn paint(&self, pass: &mut wgpu::RenderPass<'_>, view: ViewId) {
        if let Some(picture) = self.views.get(&view).and_then(View::to_paint) {
            pass.set_pipeline(&self.pipelines.blit);
            pass.set_bind_group(0, picture, &[]);
            pass.draw(0..3, 0..1);
        }
    }

    /// Frees what belongs to a view. Not between preparing a frame of it and submitting that.
    pub fn forget(&mut self, view: ViewId) {
        self.views.remove(&view);
    }
}
