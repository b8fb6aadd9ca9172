//! The three pipelines and their common uniform layout.

use crate::scene::{LineVertex, MarkerInstance, SurfaceVertex};
use std::mem::size_of;

pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth24Plus;

/// Uniforms of a view, in the layout of `View` in `shaders.wgsl`.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub(super) struct ViewUniform {
    pub clip_from_world: [[f32; 4]; 4],
    pub eye: [f32; 4],
    pub size_and_style: [f32; 4],
    pub surface: [f32; 4],
    pub line: [f32; 4],
}

impl ViewUniform {
    /// The bytes of the uniform buffer.
    pub fn bytes(&self) -> Vec<u8> {
        let rows =
            self.clip_from_world.iter().chain([&self.eye, &self.size_and_style, &self.surface, &self.line]);
        rows.flatten().flat_map(|x| x.to_le_bytes()).collect()
    }
}

pub(super) struct Pipelines {
    pub surface: wgpu::RenderPipeline,
    pub line: wgpu::RenderPipeline,
    pub ball: wgpu::RenderPipeline,
    pub view_layout: wgpu::BindGroupLayout,
}

impl Pipelines {
    pub fn new(device: &wgpu::Device, format: wgpu::TextureFormat, samples: u32) -> Self {
        let shader = device.create_shader_module(wgpu::include_wgsl!("shaders.wgsl"));
        let view_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("view"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&view_layout)],
            immediate_size: 0,
        });
        let build = |entry: [&str; 2], buffers: &[Option<wgpu::VertexBufferLayout<'_>>]| {
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(entry[0]),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &shader,
                    entry_point: Some(entry[0]),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers,
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: Some(wgpu::DepthStencilState {
                    format: DEPTH,
                    depth_write_enabled: Some(true),
                    depth_compare: Some(wgpu::CompareFunction::LessEqual),
                    stencil: wgpu::StencilState::default(),
                    bias: wgpu::DepthBiasState::default(),
                }),
                multisample: wgpu::MultisampleState { count: samples, ..wgpu::MultisampleState::default() },
                fragment: Some(wgpu::FragmentState {
                    module: &shader,
                    entry_point: Some(entry[1]),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(format.into())],
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        let surface = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x2, 3 => Float32];
        let line = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32];
        let ball = wgpu::vertex_attr_array![0 => Float32x3];
        let marker = wgpu::vertex_attr_array![1 => Float32x3, 2 => Float32, 3 => Float32x3];
        Self {
            surface: build(
                ["surface_vertex", "surface_fragment"],
                &[Some(per_vertex(size_of::<SurfaceVertex>(), &surface))],
            ),
            line: build(
                ["line_vertex", "line_fragment"],
                &[Some(per_vertex(size_of::<LineVertex>(), &line))],
            ),
            ball: build(
                ["ball_vertex", "ball_fragment"],
                &[
                    Some(per_vertex(12, &ball)),
                    Some(wgpu::VertexBufferLayout {
                        array_stride: size_of::<MarkerInstance>() as u64,
                        step_mode: wgpu::VertexStepMode::Instance,
                        attributes: &marker,
                    }),
                ],
            ),
            view_layout,
        }
    }
}

fn per_vertex(size: usize, attributes: &[wgpu::VertexAttribute]) -> wgpu::VertexBufferLayout<'_> {
    wgpu::VertexBufferLayout {
        array_stride: size as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes,
    }
}
