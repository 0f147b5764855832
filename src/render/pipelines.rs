//! What is made once per device: shaders, layouts, pipelines, samplers.

use super::{
    mesh::Vertex,
    overlay::{Piece, Sign},
    shaders::{BACKDROP, BLIT, GROUND, LINE, MARKER, SHADOW, SOLID},
    target::{COLOR, DEPTH, SAMPLES},
    uniforms::Globals,
};

/// Depth of the shadow map.
pub(super) const SHADOW_DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

pub(super) struct Pipelines {
    pub backdrop: wgpu::RenderPipeline,
    pub shadow: wgpu::RenderPipeline,
    pub opaque: wgpu::RenderPipeline,
    pub translucent: wgpu::RenderPipeline,
    pub ground: wgpu::RenderPipeline,
    pub line: wgpu::RenderPipeline,
    pub line_hidden: wgpu::RenderPipeline,
    pub marker: wgpu::RenderPipeline,
    pub marker_hidden: wgpu::RenderPipeline,
    pub blit: wgpu::RenderPipeline,
    pub globals_layout: wgpu::BindGroupLayout,
    pub shadow_layout: wgpu::BindGroupLayout,
    pub blit_layout: wgpu::BindGroupLayout,
    pub shadow_sampler: wgpu::Sampler,
    pub blit_sampler: wgpu::Sampler,
}

/// How a pipeline of the scene pass differs from the others.
struct Kind<'a> {
    label: &'static str,
    source: &'static str,
    vertex: &'static str,
    fragment: &'static str,
    layout: &'a wgpu::PipelineLayout,
    buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    topology: wgpu::PrimitiveTopology,
    cull: bool,
    blend: bool,
    depth_write: bool,
    depth_compare: wgpu::CompareFunction,
}

impl Pipelines {
    pub(super) fn new(device: &wgpu::Device, target: wgpu::TextureFormat) -> Self {
        let globals_layout = globals_layout(device);
        let shadow_layout = shadow_layout(device);
        let blit_layout = blit_layout(device);
        let layout = |groups: &[Option<&wgpu::BindGroupLayout>]| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("scene"),
                bind_group_layouts: groups,
                immediate_size: 0,
            })
        };
        let plain = layout(&[Some(&globals_layout)]);
        let shadowed = layout(&[Some(&globals_layout), Some(&shadow_layout)]);
        let blitting = layout(&[Some(&blit_layout)]);

        let strip = wgpu::PrimitiveTopology::TriangleStrip;
        let list = wgpu::PrimitiveTopology::TriangleList;
        let (nearer, hidden) = (wgpu::CompareFunction::LessEqual, wgpu::CompareFunction::Greater);
        let solid = |label, blend| {
            scene_pipeline(
                device,
                &Kind {
                    label,
                    source: SOLID,
                    vertex: "vs_solid",
                    fragment: "fs_solid",
                    layout: &shadowed,
                    buffers: &[Some(Vertex::LAYOUT)],
                    topology: list,
                    cull: true,
                    blend,
                    depth_write: !blend,
                    depth_compare: nearer,
                },
            )
        };
        let overlay = |label, source, vertex, fragment, buffer, depth_compare| {
            scene_pipeline(
                device,
                &Kind {
                    label,
                    source,
                    vertex,
                    fragment,
                    layout: &plain,
                    buffers: &[Some(buffer)],
                    topology: strip,
                    cull: false,
                    blend: true,
                    depth_write: false,
                    depth_compare,
                },
            )
        };
        Self {
            backdrop: scene_pipeline(
                device,
                &Kind {
                    label: "backdrop",
                    source: BACKDROP,
                    vertex: "vs_backdrop",
                    fragment: "fs_backdrop",
                    layout: &plain,
                    buffers: &[],
                    topology: list,
                    cull: false,
                    blend: false,
                    depth_write: false,
                    depth_compare: wgpu::CompareFunction::Always,
                },
            ),
            ground: scene_pipeline(
                device,
                &Kind {
                    label: "ground",
                    source: GROUND,
                    vertex: "vs_ground",
                    fragment: "fs_ground",
                    layout: &shadowed,
                    buffers: &[],
                    topology: strip,
                    cull: false,
                    blend: true,
                    depth_write: false,
                    depth_compare: nearer,
                },
            ),
            shadow: shadow_pipeline(device, &plain),
            opaque: solid("opaque", false),
            translucent: solid("translucent", true),
            line: overlay("line", LINE, "vs_line", "fs_line", Piece::LAYOUT, nearer),
            line_hidden: overlay("hidden line", LINE, "vs_line", "fs_line_hidden", Piece::LAYOUT, hidden),
            marker: overlay("marker", MARKER, "vs_marker", "fs_marker", Sign::LAYOUT, nearer),
            marker_hidden: overlay("hidden marker", MARKER, "vs_marker", "fs_marker_hidden", Sign::LAYOUT, hidden),
            blit: blit_pipeline(device, &blitting, target),
            globals_layout,
            shadow_layout,
            blit_layout,
            shadow_sampler: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("shadow"),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                compare: Some(wgpu::CompareFunction::LessEqual),
                ..Default::default()
            }),
            blit_sampler: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("blit"),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
        }
    }
}

fn module(device: &wgpu::Device, label: &str, source: &'static str) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

fn scene_pipeline(device: &wgpu::Device, kind: &Kind<'_>) -> wgpu::RenderPipeline {
    let module = module(device, kind.label, kind.source);
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(kind.label),
        layout: Some(kind.layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(kind.vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: kind.buffers,
        },
        primitive: wgpu::PrimitiveState {
            topology: kind.topology,
            cull_mode: kind.cull.then_some(wgpu::Face::Back),
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(kind.depth_write),
            depth_compare: Some(kind.depth_compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState { count: SAMPLES, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(kind.fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: COLOR,
                blend: kind.blend.then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn shadow_pipeline(device: &wgpu::Device, layout: &wgpu::PipelineLayout) -> wgpu::RenderPipeline {
    let module = module(device, "shadow", SHADOW);
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("shadow"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vs_shadow"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                attributes: &wgpu::vertex_attr_array![0 => Float32x3],
                ..Vertex::LAYOUT
            })],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: SHADOW_DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState { constant: 2, slope_scale: 1.5, clamp: 0.0 },
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: None,
        multiview_mask: None,
        cache: None,
    })
}

fn blit_pipeline(
    device: &wgpu::Device,
    layout: &wgpu::PipelineLayout,
    target: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    let module = module(device, "blit", BLIT);
    let fragment = if target.is_srgb() { "fs_blit_srgb" } else { "fs_blit" };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("blit"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vs_blit"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: target,
                blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn globals_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("scene globals"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: wgpu::BufferSize::new(size_of::<Globals>() as u64),
            },
            count: None,
        }],
    })
}

fn shadow_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("shadow map"),
        entries: &[
            texture_entry(0, wgpu::TextureSampleType::Depth),
            sampler_entry(1, wgpu::SamplerBindingType::Comparison),
        ],
    })
}

fn blit_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("scene blit"),
        entries: &[
            texture_entry(0, wgpu::TextureSampleType::Float { filterable: true }),
            sampler_entry(1, wgpu::SamplerBindingType::Filtering),
        ],
    })
}

fn texture_entry(binding: u32, sample_type: wgpu::TextureSampleType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Texture {
            sample_type,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
        count: None,
    }
}

fn sampler_entry(binding: u32, ty: wgpu::SamplerBindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Sampler(ty),
        count: None,
    }
}
