//! Draws surfaces, lines, balls and pins into the two views of one canvas.

use super::pipelines::{DEPTH, Pipelines, ViewUniform};
use crate::scene::buffers::{Triangles, unit_ball};
use crate::scene::colours::{factor_scale, rising_scale};
use crate::scene::defects::MarkedLineVertex;
use crate::scene::looks::{DressedSurface, Pixels, levels};
use crate::scene::morph::bend_weights;
use crate::scene::{LineVertex, MarkerInstance, PinInstance, Pose, SurfaceVertex};
use glam::Mat4;
use std::ops::Range;
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
    /// The indices on which each picture lies; none where the first picture lies on all.
    runs: Vec<(Option<u8>, Range<u32>)>,
}

/// The background, linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clear(pub [f64; 3]);

/// The quantity that the colours of a surface show.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Paint {
    /// Nothing.
    #[default]
    Plain,
    /// A texture of the flat metric.
    Texture(Texture),
    /// The place on the target.
    Places,
    /// A place on a scale for each vertex.
    Scale(Scale),
    /// A checkerboard in space, by the place on the target.
    Pattern,
    /// Faint and hatched: a mesh that is not accepted.
    Refused,
    /// A place on a scale from what shrinks to what grows: between the two texture coordinates of each vertex, this share of the way
    /// from the first to the second.
    Factors(f32),
    /// Circles around the vertices, on the scale from what shrinks to what grows.
    Circles,
    /// The look of a mesh's file.
    Look,
}

/// The kind of texture on the flat metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TextureKind {
    /// A checkerboard.
    Checkerboard,
    /// Circles, packed.
    Circles,
    /// Coloured ribbons.
    Ribbons,
    /// Colours of both coordinates, with a grid.
    Coordinates,
    /// A picture, again and again.
    Picture,
}

/// A texture, and how it lies on the flat metric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture {
    /// The kind of texture on the flat metric.
    pub kind: TextureKind,
    /// From texture coordinates to cells: the image of (1, 0), and where the origin lies.
    pub cells: [f32; 4],
}

/// A scale of colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// From little to much.
    Rising,
    /// From what shrinks to what grows.
    Diverging,
}

/// Colours of both views, linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Palette {
    /// The plain surface.
    pub surface: [f32; 3],
    /// The plain surface that is seen through the holes of another one.
    pub under: [f32; 3],
    /// The colour of lines.
    pub line: [f32; 3],
    /// The light and the dark cells of patterns.
    pub pattern: [[f32; 3]; 2],
    /// The border of pins.
    pub rim: [f32; 3],
}

/// One of the two views: where it lies on the canvas, and what is drawn in it.
pub struct ViewDraw<'a> {
    /// x, y, width, height in physical pixels from the top left.
    pub rectangle: [f32; 4],
    /// The pose of the camera.
    pub pose: Pose,
    /// The quantity that the surface's colours show.
    pub paint: Paint,
    /// The colours of the view.
    pub palette: Palette,
    /// Half the width of lines in physical pixels.
    pub line_half_width: f32,
    /// Share of the way that every vertex of the surface has gone to its image.
    pub morph: f32,
    /// The length for which 1 stands in the bends of that way; 0 where it is straight.
    pub bend_range: f32,
    /// From the images' coordinates to the view's.
    pub world_from_image: Mat4,
    /// Share of the view's width, from the left, in which the surface is plain and has no lines.
    pub wipe: f32,
    /// The surface.
    pub surface: Option<&'a Mesh>,
    /// A plain surface a little behind it, seen where the surface has holes.
    pub under: Option<&'a Mesh>,
    /// Faces painted in colours of their own, over the surface.
    pub painted: Option<&'a Mesh>,
    /// Faces that lie over the surface as a veil.
    pub tinted: Option<&'a Mesh>,
    /// Ribbons with colours of their own around them.
    pub traced: [Option<&'a Mesh>; 2],
    /// Ribbons in the colour of lines.
    pub lines: Option<&'a Mesh>,
    /// Ribbons with colours and strokes of their own.
    pub marks: Option<&'a Mesh>,
    /// Length of a dash with its gap, in scene units.
    pub dash: f32,
    /// Balls.
    pub balls: &'a [MarkerInstance],
    /// Pins over everything, the lowest first.
    pub pins: &'a [PinInstance],
    /// The pictures that are laid on the surface; white where there is none.
    pub pictures: &'a [Option<Picture>],
}

/// A picture on the GPU.
pub struct Picture(wgpu::BindGroup);

/// The share of the light from around that a deep hollow loses.
const HOLLOW_SHADE: f32 = 0.75;

/// Opacity of lines behind the surface.
const HIDDEN_LINE_OPACITY: f32 = 0.14;

/// Everything that belongs to one canvas.
pub struct Renderer {
    surface: wgpu::Surface<'static>,
    device: wgpu::Device,
    queue: wgpu::Queue,
    config: wgpu::SurfaceConfiguration,
    pipelines: Pipelines,
    uniforms: [ViewUniforms; 2],
    ball: Mesh,
    white: Picture,
    targets: Targets,
    samples: u32,
}

/// Uniform buffers of one view: for its surface, for the plain one behind, and for faces painted over it.
struct ViewUniforms {
    front: (wgpu::Buffer, wgpu::BindGroup),
    painted: (wgpu::Buffer, wgpu::BindGroup),
    under: (wgpu::Buffer, wgpu::BindGroup),
}

/// The shapes that are drawn many times in one frame of a view.
struct Instances {
    balls: Option<wgpu::Buffer>,
    pins: Option<wgpu::Buffer>,
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
        let uniforms =
            [0, 1].map(|_| ViewUniforms { front: uniform(), painted: uniform(), under: uniform() });
        let ball = ball(&device);
        let white = picture(
            &device,
            &queue,
            &pipelines,
            levels(Pixels { width: 1, height: 1, bytes: vec![u8::MAX; 4] }),
        );
        let targets = Targets::new(&device, &config, samples);
        Ok(Self { surface, device, queue, config, pipelines, uniforms, ball, white, targets, samples })
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
        let floats = |bytes: &mut Vec<u8>, v: &SurfaceVertex| {
            push(bytes, &v.position);
            push(bytes, &v.normal);
            push(bytes, &v.uv);
            push(bytes, &[v.scale_place]);
            push(bytes, &v.image);
            push(bytes, &v.image_normal);
            push(bytes, &[v.hollow]);
            bytes.extend_from_slice(&v.tint);
            bytes.extend(v.bends.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        };
        mesh(&self.device, &packed(vertices, floats), indices)
    }

    /// Uploads a surface in a look.
    pub fn dressed_mesh(&self, dressed: DressedSurface) -> Mesh {
        let DressedSurface { vertices, indices, runs } = dressed;
        Mesh { runs, ..self.surface_mesh(&vertices, &indices) }
    }

    /// Uploads a picture: 8-bit colours with opacity, row by row from the top. `None` where these are not so many pixels, or more than
    /// can be drawn.
    pub fn picture(&self, pixels: Pixels) -> Option<Picture> {
        let Pixels { width, height, .. } = pixels;
        let limit = self.device.limits().max_texture_dimension_2d;
        let fits = (1..=limit).contains(&width) && (1..=limit).contains(&height);
        let is_whole = fits && pixels.bytes.len() as u64 == 4 * u64::from(width) * u64::from(height);
        is_whole.then(|| picture(&self.device, &self.queue, &self.pipelines, levels(pixels)))
    }

    /// Uploads ribbons.
    pub fn line_mesh(&self, vertices: &[LineVertex], indices: &[u32]) -> Mesh {
        let floats = |bytes: &mut Vec<u8>, v: &LineVertex| {
            push(bytes, &v.position);
            push(bytes, &v.other);
            push(bytes, &[v.side]);
        };
        mesh(&self.device, &packed(vertices, floats), indices)
    }

    /// Uploads ribbons with colours and strokes of their own.
    pub fn marked_line_mesh(&self, vertices: &[MarkedLineVertex], indices: &[u32]) -> Mesh {
        let floats = |bytes: &mut Vec<u8>, v: &MarkedLineVertex| {
            push(bytes, &v.line.position);
            push(bytes, &v.line.other);
            push(bytes, &[v.line.side]);
            push(bytes, &v.colour);
            push(bytes, &[v.stroke, v.along]);
        };
        mesh(&self.device, &packed(vertices, floats), indices)
    }

    /// Draws one frame. Frames that the browser cannot take now are left out.
    pub fn draw(&self, Clear([r, g, b]): Clear, views: &[ViewDraw<'_>; 2]) {
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
            if view.painted.is_some() || view.tinted.is_some() {
                self.queue.write_buffer(&uniform.painted.0, 0, &self.painted_uniform(view).bytes());
            }
        }
        let instances = [0, 1].map(|k: usize| self.instances(&views[k]));
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
                self.draw_view(&mut pass, k, &views[k], &instances[k]);
            }
            // WebGL cuts off the resolving of the samples by the last scissor rectangle: both views must be in it.
            pass.set_scissor_rect(0, 0, self.config.width, self.config.height);
        }
        self.queue.submit([encoder.finish()]);
        self.queue.present(frame);
    }

    fn uniform(&self, view: &ViewDraw<'_>) -> ViewUniform {
        let [left, _, width, height] = view.rectangle;
        let ViewDraw { pose, palette, .. } = view;
        let style = match view.paint {
            Paint::Plain => 0.0,
            Paint::Texture(_) => 1.0,
            Paint::Places => 2.0,
            Paint::Scale(_) => 3.0,
            Paint::Pattern => 4.0,
            Paint::Refused => 5.0,
            Paint::Factors(_) => 7.0,
            Paint::Look => 8.0,
            Paint::Circles => 9.0,
        };
        let (share, scale) = match view.paint {
            Paint::Factors(share) => (share, factor_scale()),
            Paint::Scale(Scale::Diverging) | Paint::Circles => (0.0, factor_scale()),
            _ => (0.0, rising_scale()),
        };
        let (texture, cells) = match view.paint {
            Paint::Texture(Texture { kind, cells }) => (f32::from(kind as u8), cells),
            _ => (0.0, [0.0; 4]),
        };
        let [first, second, third] = bend_weights(view.morph);
        ViewUniform {
            clip_from_world: pose.view_projection(width / height.max(1.0)).to_cols_array_2d(),
            world_from_image: view.world_from_image.to_cols_array_2d(),
            eye: pose.eye().extend(1.0).to_array(),
            right: pose.right().extend(0.0).to_array(),
            up: pose.up().extend(0.0).to_array(),
            size_and_style: [width, height, style, view.line_half_width],
            ways: [view.morph, HOLLOW_SHADE, HIDDEN_LINE_OPACITY, texture],
            surface: with_alpha(palette.surface),
            line: with_alpha(palette.line),
            pattern_light: with_alpha(palette.pattern[0]),
            pattern_dark: with_alpha(palette.pattern[1]),
            rim: with_alpha(palette.rim),
            wipe: [left + view.wipe * width, view.dash, share, 0.0],
            cells,
            bends: [first, second, third, view.bend_range],
            scale: scale.map(with_alpha),
        }
    }

    /// The uniforms of the surface behind; a negative style says that it lies behind.
    fn under_uniform(&self, view: &ViewDraw<'_>) -> ViewUniform {
        let mut uniform = self.uniform(view);
        uniform.size_and_style[2] = -1.0;
        uniform.surface = with_alpha(view.palette.under);
        uniform
    }

    /// The uniforms of faces with colours of their own.
    fn painted_uniform(&self, view: &ViewDraw<'_>) -> ViewUniform {
        let mut uniform = self.uniform(view);
        uniform.size_and_style[2] = 6.0;
        uniform.ways[0] = 0.0;
        uniform.wipe[0] = 0.0;
        uniform
    }

    fn instances(&self, view: &ViewDraw<'_>) -> Instances {
        let balls = packed(view.balls, |bytes, m| {
            push(bytes, &m.centre);
            push(bytes, &[m.radius]);
            push(bytes, &m.colour);
        });
        let pins = packed(view.pins, |bytes, p| {
            push(bytes, &p.base);
            push(bytes, &p.colour);
            push(bytes, &[p.radius, p.stem, p.kind]);
        });
        let upload = |bytes: Vec<u8>| {
            (!bytes.is_empty()).then(|| buffer(&self.device, &bytes, wgpu::BufferUsages::VERTEX))
        };
        Instances { balls: upload(balls), pins: upload(pins) }
    }

    fn draw_view(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        k: usize,
        view: &ViewDraw<'_>,
        instances: &Instances,
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
        let ViewUniforms { front, painted, under } = &self.uniforms[k];
        let Pipelines { surface, tint, line, hidden_line, mark, hidden_mark, ball, pin, .. } =
            &self.pipelines;
        let draw = |pass: &mut wgpu::RenderPass<'_>, mesh: &Mesh, pipeline: &wgpu::RenderPipeline| {
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, mesh.vertices.slice(..));
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..mesh.index_count, 0, 0..1);
        };
        let picture =
            |number: usize| &view.pictures.get(number).and_then(Option::as_ref).unwrap_or(&self.white).0;
        pass.set_bind_group(1, picture(0), &[]);
        if let Some(mesh) = view.under {
            pass.set_bind_group(0, &under.1, &[]);
            draw(pass, mesh, surface);
        }
        pass.set_bind_group(0, &front.1, &[]);
        if let Some(mesh) = view.surface.filter(|mesh| mesh.runs.is_empty()) {
            draw(pass, mesh, surface);
        } else if let Some(mesh) = view.surface {
            pass.set_pipeline(surface);
            pass.set_vertex_buffer(0, mesh.vertices.slice(..));
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            for (number, run) in &mesh.runs {
                pass.set_bind_group(1, number.map_or(&self.white.0, |number| picture(number.into())), &[]);
                pass.draw_indexed(run.clone(), 0, 0..1);
            }
        }
        if let Some(mesh) = view.painted {
            pass.set_bind_group(0, &painted.1, &[]);
            draw(pass, mesh, surface);
            pass.set_bind_group(0, &front.1, &[]);
        }
        if let Some(mesh) = view.tinted {
            pass.set_bind_group(0, &painted.1, &[]);
            draw(pass, mesh, tint);
            pass.set_bind_group(0, &front.1, &[]);
        }
        if let Some(balls) = &instances.balls {
            pass.set_pipeline(ball);
            pass.set_vertex_buffer(0, self.ball.vertices.slice(..));
            pass.set_vertex_buffer(1, balls.slice(..));
            pass.set_index_buffer(self.ball.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..self.ball.index_count, 0, 0..view.balls.len() as u32);
        }
        if let Some(mesh) = view.lines {
            draw(pass, mesh, hidden_line);
            draw(pass, mesh, line);
        }
        for mesh in view.traced.into_iter().chain([view.marks]).flatten() {
            draw(pass, mesh, hidden_mark);
            draw(pass, mesh, mark);
        }
        if let Some(pins) = &instances.pins {
            pass.set_pipeline(pin);
            pass.set_vertex_buffer(0, pins.slice(..));
            pass.draw(0..6, 0..view.pins.len() as u32);
        }
    }
}

/// Appends numbers to a vertex buffer's bytes.
fn push(bytes: &mut Vec<u8>, numbers: &[f32]) {
    numbers.iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
}

/// The bytes of a vertex buffer.
fn packed<T>(items: &[T], write: impl Fn(&mut Vec<u8>, &T)) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(std::mem::size_of_val(items));
    items.iter().for_each(|item| write(&mut bytes, item));
    bytes
}

fn with_alpha([r, g, b]: [f32; 3]) -> [f32; 4] {
    [r, g, b, 1.0]
}

fn buffer(device: &wgpu::Device, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
}

fn mesh(device: &wgpu::Device, vertices: &[u8], indices: &[u32]) -> Mesh {
    let index_bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
    Mesh {
        vertices: buffer(device, vertices, wgpu::BufferUsages::VERTEX),
        indices: buffer(device, &index_bytes, wgpu::BufferUsages::INDEX),
        index_count: indices.len() as u32,
        runs: Vec::new(),
    }
}

fn ball(device: &wgpu::Device) -> Mesh {
    let Triangles { vertices, indices } = unit_ball();
    mesh(device, &packed(&vertices, |bytes, place| push(bytes, place)), &indices)
}

fn picture(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    pipelines: &Pipelines,
    levels: Vec<Pixels>,
) -> Picture {
    let size = |width, height| wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture"),
        size: size(levels[0].width, levels[0].height),
        mip_level_count: levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (mip_level, Pixels { width, height, bytes }) in (0..).zip(&levels) {
        let place = wgpu::TexelCopyTextureInfo { mip_level, ..texture.as_image_copy() };
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
        queue.write_texture(place, bytes, layout, size(*width, *height));
    }
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        address_mode_u: wgpu::AddressMode::Repeat,
        address_mode_v: wgpu::AddressMode::Repeat,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..wgpu::SamplerDescriptor::default()
    });
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    Picture(device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipelines.picture_layout,
        entries: &[
            entry(0, wgpu::BindingResource::TextureView(&view)),
            entry(1, wgpu::BindingResource::Sampler(&sampler)),
        ],
    }))
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
