//! Renders scenes without a window, on whatever adapter the machine has.

use centrode::render::{Frame, Renderer, ViewId};
use centrode::scene::{Camera, Scene, Studio};

/// A device with no more than WebGL2's limits.
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
}

impl Gpu {
    /// Panics when there is no adapter: the test command installs one.
    pub fn new() -> Self {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            // WGPU_BACKEND chooses another.
            backends: wgpu::Backends::from_env().unwrap_or(wgpu::Backends::VULKAN | wgpu::Backends::GL),
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .expect("a Vulkan or OpenGL adapter (mesa-vulkan-drivers)");
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("test"),
            required_limits: wgpu::Limits::downlevel_webgl2_defaults(),
            ..Default::default()
        }))
        .expect("a device with WebGL2's limits");
        Self { device, queue }
    }
}

/// A finished picture: RGBA, gamma-encoded, premultiplied.
pub struct Picture {
    pub size: [u32; 2],
    pub pixels: Vec<[u8; 4]>,
}

impl Picture {
    pub fn at(&self, x: u32, y: u32) -> [u8; 4] {
        self.pixels[(y.min(self.size[1] - 1) * self.size[0] + x.min(self.size[0] - 1)) as usize]
    }
}

/// Draws a scene as the page would: prepare, then paint over `below`.
pub fn render(
    gpu: &Gpu,
    renderer: &mut Renderer,
    scene: (&Scene, u64),
    camera: &Camera,
    studio: &Studio,
    (size, pixels_per_point): ([u32; 2], f32),
    below: wgpu::Color,
) -> Picture {
    let Gpu { device, queue } = gpu;
    let [width, height] = size;
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("screen"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let row = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let readback = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: u64::from(row) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let view = ViewId(0);
    renderer.prepare(
        device,
        queue,
        &mut encoder,
        &Frame { view, size_px: size, pixels_per_point, scene: scene.0, scene_version: scene.1, camera, studio },
    );
    {
        let target = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(below), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        renderer.paint(&mut pass, view);
    }
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &readback,
            layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
        },
        texture.size(),
    );
    queue.submit([encoder.finish()]);
    readback.slice(..).map_async(wgpu::MapMode::Read, |r| r.expect("mapped"));
    device.poll(wgpu::PollType::wait_indefinitely()).expect("the GPU finishes");
    let bytes = readback.slice(..).get_mapped_range().expect("mapped");
    let pixels = bytes
        .chunks_exact(row as usize)
        .flat_map(|r| r[..4 * width as usize].chunks_exact(4))
        .map(|p| [p[0], p[1], p[2], p[3]])
        .collect();
    Picture { size, pixels }
}
