//! wgpu on WebGL2: one device, one canvas, two views.

mod pipelines;
mod renderer;

pub use renderer::{
    Clear, GpuError, Mesh, Paint, Palette, Picture, Renderer, Scale, Texture, TextureKind, ViewDraw,
};
