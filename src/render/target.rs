//! The pictures a view is drawn into before it is laid on the screen.

/// Colour of every offscreen picture: gamma-encoded, as egui's own target.
pub(super) const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Depth of the multisampled picture.
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth24Plus;
/// Samples per pixel; WebGL2 and WebGPU both guarantee four.
pub(super) const SAMPLES: u32 = 4;

/// More pixels than this are drawn smaller and stretched: at 4 samples of 8 bytes, 9 million take 300 MB.
const MAX_PIXELS: f64 = 9.0e6;

/// The multisampled colour and depth, and the picture they resolve to.
pub(super) struct Target {
    pub size: [u32; 2],
    pub samples: wgpu::TextureView,
    pub depth: wgpu::TextureView,
    pub resolved: wgpu::TextureView,
    pub blit: wgpu::BindGroup,
}

impl Target {
    /// `size` must have gone through [`fitting`].
    pub(super) fn new(
        device: &wgpu::Device,
        blit_layout: &wgpu::BindGroupLayout,
        sampler: &wgpu::Sampler,
        size: [u32; 2],
    ) -> Self {
        let texture = |label, format, sample_count, usage| {
            device
                .create_texture(&wgpu::TextureDescriptor {
                    label: Some(label),
                    size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                    mip_level_count: 1,
                    sample_count,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage,
                    view_formats: &[],
                })
                .create_view(&wgpu::TextureViewDescriptor::default())
        };
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let samples = texture("scene samples", COLOR, SAMPLES, attachment);
        let depth = texture("scene depth", DEPTH, SAMPLES, attachment);
        let resolved = texture(
            "scene resolved",
            COLOR,
            1,
            attachment | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
        );
        let blit = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene blit"),
            layout: blit_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&resolved) },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(sampler) },
            ],
        });
        Self { size, samples, depth, resolved, blit }
    }
}

/// At once: else a browser frees it with its garbage, late, for it does not see how large a texture is.
impl Drop for Target {
    fn drop(&mut self) {
        for view in [&self.samples, &self.depth, &self.resolved] {
            view.texture().destroy();
        }
    }
}

/// The size to draw at, and its ratio to the size asked for: at least one pixel, at most what the device and memory allow,
/// both sides shrunk alike.
pub(super) fn fitting(asked: [u32; 2], max_side: u32) -> ([u32; 2], f32) {
    let [w, h] = asked.map(|v| f64::from(v.max(1)));
    let max_side = f64::from(max_side.max(1));
    let scale = (max_side / w.max(h)).min((MAX_PIXELS / (w * h)).sqrt()).min(1.0);
    let side = |v: f64| (v * scale).floor().clamp(1.0, max_side) as u32;
    ([side(w), side(h)], scale as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_kept_in_range() {
        assert_eq!(fitting([0, 0], 2048), ([1, 1], 1.0));
        assert_eq!(fitting([800, 600], 2048), ([800, 600], 1.0));
        let ([w, h], scale) = fitting([u32::MAX, u32::MAX], 2048);
        assert!(w == h && w <= 2048 && scale > 0.0);
        let ([w, h], _) = fitting([100_000, 1], 2048);
        assert_eq!([w, h], [2048, 1]);
        let ([w, h], _) = fitting([8192, 8192], 8192);
        assert!(f64::from(w) * f64::from(h) <= MAX_PIXELS);
    }
}
