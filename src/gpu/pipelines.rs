//! The pipelines and their common uniform layout.

use crate::scene::colours::SCALE_COLOURS;
use crate::scene::defects::MarkedLineVertex;
use crate::scene::{LineVertex, MarkerInstance, PinInstance, SurfaceVertex};
use std::mem::size_of;

/// The format of the depth buffer.
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth24Plus;

/// Uniforms of a view, in the layout of `View` in `shaders.wgsl`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ViewUniform {
    pub clip_from_world: [[f32; 4]; 4],
    pub world_from_image: [[f32; 4]; 4],
    pub eye: [f32; 4],
    pub right: [f32; 4],
    pub up: [f32; 4],
    pub size_and_style: [f32; 4],
    pub ways: [f32; 4],
    pub surface: [f32; 4],
    pub line: [f32; 4],
    pub pattern_light: [f32; 4],
    pub pattern_dark: [f32; 4],
    pub rim: [f32; 4],
    pub wipe: [f32; 4],
    pub cells: [f32; 4],
    pub bends: [f32; 4],
    pub scale: [[f32; 4]; SCALE_COLOURS],
}

impl ViewUniform {
    /// The bytes of the uniform buffer.
    pub fn bytes(&self) -> Vec<u8> {
        let single = [
            &self.eye,
            &self.right,
            &self.up,
            &self.size_and_style,
            &self.ways,
            &self.surface,
            &self.line,
            &self.pattern_light,
            &self.pattern_dark,
            &self.rim,
            &self.wipe,
            &self.cells,
            &self.bends,
        ];
        let rows = self.clip_from_world.iter().chain(&self.world_from_image).chain(single).chain(&self.scale);
        rows.flatten().flat_map(|x| x.to_le_bytes()).collect()
    }
}

pub(super) struct Pipelines {
    pub surface: wgpu::RenderPipeline,
    /// Lines in front of the surface.
    pub line: wgpu::RenderPipeline,
    /// Lines behind it.
    pub hidden_line: wgpu::RenderPipeline,
    /// Lines with a colour and a stroke of their own, in front of the surface.
    pub mark: wgpu::RenderPipeline,
    /// Such lines behind it.
    pub hidden_mark: wgpu::RenderPipeline,
    /// Faces in one colour each, through which the surface is seen.
    pub tint: wgpu::RenderPipeline,
    pub ball: wgpu::RenderPipeline,
    pub pin: wgpu::RenderPipeline,
    pub view_layout: wgpu::BindGroupLayout,
    pub picture_layout: wgpu::BindGroupLayout,
}

/// In which order and with which depth test something is drawn.
#[derive(Clone, Copy)]
enum Layer {
    /// Hides what is behind it.
    Solid,
    /// Lies over the picture where nothing is in front of it.
    Over,
    /// Shows through where something is in front of it.
    Through,
    /// Lies over everything.
    Top,
}

impl Layer {
    fn depth(self) -> wgpu::DepthStencilState {
        let (writes, compare) = match self {
            Self::Solid => (true, wgpu::CompareFunction::LessEqual),
            Self::Over => (false, wgpu::CompareFunction::LessEqual),
            Self::Through => (false, wgpu::CompareFunction::Greater),
            Self::Top => (false, wgpu::CompareFunction::Always),
        };
        wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(writes),
            depth_compare: Some(compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }
    }

    fn blend(self) -> Option<wgpu::BlendState> {
        match self {
            Self::Solid => None,
            Self::Over | Self::Through | Self::Top => Some(wgpu::BlendState::ALPHA_BLENDING),
        }
    }
}

/// The parts from which the pipelines are made.
struct Workshop<'a> {
    device: &'a wgpu::Device,
    shader: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
    format: wgpu::TextureFormat,
    samples: u32,
}

impl Workshop<'_> {
    fn pipeline(
        &self,
        [vertex, fragment]: [&str; 2],
        layer: Layer,
        buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
    ) -> wgpu::RenderPipeline {
        let target =
            wgpu::ColorTargetState { blend: layer.blend(), ..wgpu::ColorTargetState::from(self.format) };
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(fragment),
            layout: Some(&self.layout),
            vertex: wgpu::VertexState {
                module: &self.shader,
                entry_point: Some(vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers,
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(layer.depth()),
            multisample: wgpu::MultisampleState { count: self.samples, ..wgpu::MultisampleState::default() },
            fragment: Some(wgpu::FragmentState {
                module: &self.shader,
                entry_point: Some(fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(target)],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

impl Pipelines {
    pub fn new(device: &wgpu::Device, format: wgpu::TextureFormat, samples: u32) -> Self {
        let [view_layout, picture_layout] = [view_layout(device), picture_layout(device)];
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&view_layout), Some(&picture_layout)],
            immediate_size: 0,
        });
        let shader = device.create_shader_module(wgpu::include_wgsl!("shaders.wgsl"));
        let workshop = Workshop { device, shader, layout, format, samples };
        let surface = wgpu::vertex_attr_array![
            0 => Float32x3, 1 => Float32x3, 2 => Float32x2, 3 => Float32, 4 => Float32x3, 5 => Float32x3, 6 => Float32,
            7 => Unorm8x4, 8 => Snorm16x4, 9 => Snorm16x4, 10 => Snorm16x4
        ];
        let surface = [Some(stepping(wgpu::VertexStepMode::Vertex, size_of::<SurfaceVertex>(), &surface))];
        let line = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32];
        let line = [Some(stepping(wgpu::VertexStepMode::Vertex, size_of::<LineVertex>(), &line))];
        let mark = wgpu::vertex_attr_array![
            0 => Float32x3, 1 => Float32x3, 2 => Float32, 3 => Float32x3, 4 => Float32, 5 => Float32
        ];
        let mark = [Some(stepping(wgpu::VertexStepMode::Vertex, size_of::<MarkedLineVertex>(), &mark))];
        let ball = wgpu::vertex_attr_array![0 => Float32x3];
        let marker = wgpu::vertex_attr_array![1 => Float32x3, 2 => Float32, 3 => Float32x3];
        let ball = [
            Some(stepping(wgpu::VertexStepMode::Vertex, 12, &ball)),
            Some(stepping(wgpu::VertexStepMode::Instance, size_of::<MarkerInstance>(), &marker)),
        ];
        let pin = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32, 3 => Float32, 4 => Float32];
        let pin = [Some(stepping(wgpu::VertexStepMode::Instance, size_of::<PinInstance>(), &pin))];
        Self {
            surface: workshop.pipeline(["surface_vertex", "surface_fragment"], Layer::Solid, &surface),
            tint: workshop.pipeline(["surface_vertex", "tint_fragment"], Layer::Over, &surface),
            line: workshop.pipeline(["line_vertex", "line_fragment"], Layer::Over, &line),
            hidden_line: workshop.pipeline(["line_vertex", "hidden_line_fragment"], Layer::Through, &line),
            mark: workshop.pipeline(["mark_vertex", "mark_fragment"], Layer::Over, &mark),
            hidden_mark: workshop.pipeline(["mark_vertex", "hidden_mark_fragment"], Layer::Through, &mark),
            ball: workshop.pipeline(["ball_vertex", "ball_fragment"], Layer::Solid, &ball),
            pin: workshop.pipeline(["pin_vertex", "pin_fragment"], Layer::Top, &pin),
            view_layout,
            picture_layout,
        }
    }
}

fn view_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
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
    })
}

fn picture_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty,
        count: None,
    };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("picture"),
        entries: &[
            entry(
                0,
                wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: true },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
            ),
            entry(1, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
        ],
    })
}

fn stepping(
    step_mode: wgpu::VertexStepMode,
    size: usize,
    attributes: &[wgpu::VertexAttribute],
) -> wgpu::VertexBufferLayout<'_> {
    wgpu::VertexBufferLayout { array_stride: size as u64, step_mode, attributes }
}
