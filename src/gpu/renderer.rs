//! Draws surfaces, lines and balls into the two views of one canvas.

use super::pipelines::{DEPTH, Pipelines, ViewUniform};
use crate::scene::buffers::unit_ball;
use crate::scene::{Camera, LineVertex, MarkerInstance, SurfaceVertex};
use wgpu::util::{BufferInitDescriptor, DeviceExt};

/// Why nothing can be drawn.
#[derive(Clone, Debug, thiserror::Error)]
pub enum GpuError {
    /// The browser gives no WebGL2.
    #[error(
        "this browser gives no WebGL 2, which the views need: turn on hardware acceleration or use another browser ({0})"
    )]
    Unavailable(String),
}

/// Vertices and indices on the GPU.
pub struct Mesh {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    index_count: u32,
}

/// The background, linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clear(pub [f64; 3]);

/// One of the two views: where on the canvas, and what is in it.
pub struct ViewDraw<'a> {
    /// x, y, width, height in physical pixels from the top left.
    pub rectangle: [f32; 4],
    /// The camera.
    pub camera: &'a Camera,
    /// 0 shaded, 1 checkerboard, 2 colours, 3 distortion.
    pub style: f32,
    /// Colour of the plain surface, linear RGB.
    pub surface_colour: [f32; 3],
    /// Colour of lines, linear RGB.
    pub line_colour: [f32; 3],
    /// Half the width of lines in physical pixels.
    pub line_half_width: f32,
    /// The surface.
    pub surface: Option<&'a Mesh>,
    /// A plain surface a little behind it, seen where the surface has holes.
    pub under: Option<&'a Mesh>,
    /// Colour of the plain surface behind, linear RGB.
    pub under_colour: [f32; 3],
    /// Ribbons.
    pub lines: Option<&'a Mesh>,
    /// Balls.
    pub balls: &'a [MarkerInstance],
}

/// Everything that belongs to one canvas.
pub struct Renderer {
    surface: wgpu::Surface<'static>,
    device: wgpu::Device,
    queue: wgpu::Queue,
    config: wgpu::SurfaceConfiguration,
    pipelines: Pipelines,
    uniforms: [ViewUniforms; 2],
    ball: Mesh,
    targets: Targets,
    samples: u32,
}

/// Uniform buffers of one view: for its surface, and for the plain one behind.
struct ViewUniforms {
    front: (wgpu::Buffer, wgpu::BindGroup),
    under: (wgpu::Buffer, wgpu::BindGroup),
}

/// Depth and multisampled colour at the canvas's size.
struct Targets {
    depth: wgpu::TextureView,
    colour: Option<wgpu::TextureView>,
}

impl Renderer {
    /// Asks the browser for WebGL2 on a canvas; `samples` is 1 or 4.
    ///
    /// # Errors
    /// [`GpuError::Unavailable`].
    pub async fn new(canvas: web_sys::HtmlCanvasElement, samples: u32) -> Result<Self, GpuError> {
        let unavailable = |e: &dyn std::fmt::Display| GpuError::Unavailable(e.to_string());
        let (width, height) = (canvas.width().max(1), canvas.height().max(1));
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends: wgpu::Backends::GL,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        let surface =
            instance.create_surface(wgpu::SurfaceTarget::Canvas(canvas)).map_err(|e| unavailable(&e))?;
        let adapter = instance
            .request_adapter(&wgpu::RequestAdapterOptions {
                compatible_surface: Some(&surface),
                ..wgpu::RequestAdapterOptions::default()
            })
            .await
            .map_err(|e| unavailable(&e))?;
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                required_limits: wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits()),
                ..wgpu::DeviceDescriptor::default()
            })
            .await
            .map_err(|e| unavailable(&e))?;
        let mut config = surface
            .get_default_config(&adapter, width, height)
            .ok_or_else(|| unavailable(&"the canvas cannot be drawn to"))?;
        let formats = surface.get_capabilities(&adapter).formats;
        config.format = formats.iter().copied().find(wgpu::TextureFormat::is_srgb).unwrap_or(config.format);
        surface.configure(&device, &config);
        let pipelines = Pipelines::new(&device, config.format, samples);
        let uniform = || view_uniform(&device, &pipelines);
        let uniforms = [0, 1].map(|_| ViewUniforms { front: uniform(), under: uniform() });
        let ball = ball(&device);
        let targets = Targets::new(&device, &config, samples);
        Ok(Self { surface, device, queue, config, pipelines, uniforms, ball, targets, samples })
    }

    /// Follows the canvas's size in physical pixels.
    pub fn resize(&mut self, width: u32, height: u32) {
        let limit = self.device.limits().max_texture_dimension_2d;
        self.config.width = width.clamp(1, limit);
        self.config.height = height.clamp(1, limit);
        self.surface.configure(&self.device, &self.config);
        self.targets = Targets::new(&self.device, &self.config, self.samples);
    }

    /// Uploads a surface.
    pub fn surface_mesh(&self, vertices: &[SurfaceVertex], indices: &[u32]) -> Mesh {
        let floats = |v: &SurfaceVertex| {
            v.position.into_iter().chain(v.normal).chain(v.uv).chain([v.distortion]).collect::<Vec<_>>()
        };
        mesh(&self.device, &vertices.iter().flat_map(floats).collect::<Vec<f32>>(), indices)
    }

    /// Uploads ribbons.
    pub fn line_mesh(&self, vertices: &[LineVertex], indices: &[u32]) -> Mesh {
        let floats =
            |v: &LineVertex| v.position.into_iter().chain(v.other).chain([v.side]).collect::<Vec<_>>();
        mesh(&self.device, &vertices.iter().flat_map(floats).collect::<Vec<f32>>(), indices)
    }

    /// Draws one frame. Frames that the browser cannot take now are left out.
    pub fn draw(&mut self, Clear([r, g, b]): Clear, views: &[ViewDraw<'_>; 2]) {
        let frame = match self.surface.get_current_texture() {
            wgpu::CurrentSurfaceTexture::Success(frame) | wgpu::CurrentSurfaceTexture::Suboptimal(frame) => {
                frame
            }
            wgpu::CurrentSurfaceTexture::Outdated | wgpu::CurrentSurfaceTexture::Lost => {
                self.surface.configure(&self.device, &self.config);
                return;
            }
            _ => return,
        };
        let canvas = frame.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for (uniform, view) in self.uniforms.iter().zip(views) {
            self.queue.write_buffer(&uniform.front.0, 0, &self.uniform(view).bytes());
            if view.under.is_some() {
                self.queue.write_buffer(&uniform.under.0, 0, &self.under_uniform(view).bytes());
            }
        }
        let instances = [0, 1].map(|k: usize| self.instances(views[k].balls));
        {
            let (target, resolve_target) = match &self.targets.colour {
                Some(samples) => (samples, Some(&canvas)),
                None => (&canvas, None),
            };
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: None,
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: target,
                    depth_slice: None,
                    resolve_target,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 1.0 }),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &self.targets.depth,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(1.0),
                        store: wgpu::StoreOp::Discard,
                    }),
                    stencil_ops: None,
                }),
                timestamp_writes: None,
                occlusion_query_set: None,
                multiview_mask: None,
            });
            for k in 0..2 {
                self.draw_view(&mut pass, k, &views[k], instances[k].as_ref());
            }
            // WebGL cuts off the resolving of the samples by the last scissor rectangle: both views must be in it.
            pass.set_scissor_rect(0, 0, self.config.width, self.config.height);
        }
        self.queue.submit([encoder.finish()]);
        self.queue.present(frame);
    }

    fn uniform(&self, view: &ViewDraw<'_>) -> ViewUniform {
        let [_, _, width, height] = view.rectangle;
        let camera = view.camera;
        ViewUniform {
            clip_from_world: camera.view_projection(width / height.max(1.0)).to_cols_array_2d(),
            eye: camera.eye().extend(1.0).to_array(),
            size_and_style: [width, height, view.style, view.line_half_width],
            surface: with_alpha(view.surface_colour),
            line: with_alpha(view.line_colour),
        }
    }

    /// A negative style says that the surface lies behind.
    fn under_uniform(&self, view: &ViewDraw<'_>) -> ViewUniform {
        let mut uniform = self.uniform(view);
        uniform.size_and_style[2] = -1.0;
        uniform.surface = with_alpha(view.under_colour);
        uniform
    }

    fn instances(&self, balls: &[MarkerInstance]) -> Option<wgpu::Buffer> {
        let floats =
            |m: &MarkerInstance| m.centre.into_iter().chain([m.radius]).chain(m.colour).collect::<Vec<_>>();
        let bytes: Vec<u8> = balls.iter().flat_map(floats).flat_map(f32::to_le_bytes).collect();
        (!bytes.is_empty()).then(|| buffer(&self.device, &bytes, wgpu::BufferUsages::VERTEX))
    }

    fn draw_view(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        k: usize,
        view: &ViewDraw<'_>,
        instances: Option<&wgpu::Buffer>,
    ) {
        let (full_width, full_height) = (self.config.width as f32, self.config.height as f32);
        let [x, y, width, height] = view.rectangle;
        let (x, y) = (x.clamp(0.0, full_width), y.clamp(0.0, full_height));
        let (width, height) = (width.min(full_width - x), height.min(full_height - y));
        if width < 1.0 || height < 1.0 {
            return;
        }
        pass.set_viewport(x, y, width, height, 0.0, 1.0);
        pass.set_scissor_rect(x as u32, y as u32, width as u32, height as u32);
        let ViewUniforms { front, under } = &self.uniforms[k];
        let meshes = [
            (view.under, &self.pipelines.surface, under),
            (view.surface, &self.pipelines.surface, front),
            (view.lines, &self.pipelines.line, front),
        ];
        pass.set_bind_group(0, &front.1, &[]);
        for (mesh, pipeline, uniform) in meshes.into_iter().filter_map(|(m, p, u)| m.map(|m| (m, p, u))) {
            pass.set_bind_group(0, &uniform.1, &[]);
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, mesh.vertices.slice(..));
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..mesh.index_count, 0, 0..1);
        }
        if let Some(instances) = instances {
            pass.set_pipeline(&self.pipelines.ball);
            pass.set_vertex_buffer(0, self.ball.vertices.slice(..));
            pass.set_vertex_buffer(1, instances.slice(..));
            pass.set_index_buffer(self.ball.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..self.ball.index_count, 0, 0..view.balls.len() as u32);
        }
    }
}

fn with_alpha([r, g, b]: [f32; 3]) -> [f32; 4] {
    [r, g, b, 1.0]
}

fn buffer(device: &wgpu::Device, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
}

fn mesh(device: &wgpu::Device, vertices: &[f32], indices: &[u32]) -> Mesh {
    let vertex_bytes: Vec<u8> = vertices.iter().flat_map(|x| x.to_le_bytes()).collect();
    let index_bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
    Mesh {
        vertices: buffer(device, &vertex_bytes, wgpu::BufferUsages::VERTEX),
        indices: buffer(device, &index_bytes, wgpu::BufferUsages::INDEX),
        index_count: indices.len() as u32,
    }
}

fn ball(device: &wgpu::Device) -> Mesh {
    let (positions, indices) = unit_ball();
    mesh(device, &positions, &indices)
}

fn view_uniform(device: &wgpu::Device, pipelines: &Pipelines) -> (wgpu::Buffer, wgpu::BindGroup) {
    let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
    let uniform = buffer(device, &ViewUniform::default().bytes(), usage);
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipelines.view_layout,
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
    });
    (uniform, group)
}

impl Targets {
    fn new(device: &wgpu::Device, config: &wgpu::SurfaceConfiguration, samples: u32) -> Self {
        let texture = |format| {
            device
                .create_texture(&wgpu::TextureDescriptor {
                    label: None,
                    size: wgpu::Extent3d {
                        width: config.width,
                        height: config.height,
                        depth_or_array_layers: 1,
                    },
                    mip_level_count: 1,
                    sample_count: samples,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
                    view_formats: &[],
                })
                .create_view(&wgpu::TextureViewDescriptor::default())
        };
        Self { depth: texture(DEPTH), colour: (samples > 1).then(|| texture(config.format)) }
    }
}
