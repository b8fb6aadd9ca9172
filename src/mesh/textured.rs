//! A surface with texture coordinates.

use glam::{DVec2, DVec3};

/// Triangles with a position and a texture coordinate per vertex; a surface vertex on a seam occurs once per side.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TexturedMesh {
    /// Positions in space.
    pub positions: Vec<DVec3>,
    /// Texture coordinates, one per position.
    pub uvs: Vec<DVec2>,
    /// Counter-clockwise triples of position numbers.
    pub triangles: Vec<[u32; 3]>,
}
