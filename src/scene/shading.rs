//! The quantities from which the light on a surface is computed: normals and hollows at its vertices.

use super::hollows::hollows;
use crate::mesh::SurfaceMesh;
use crate::mesh::normals::vertex_normals;
use crate::mesh::packing::{PackedError, Packer, Unpacker};

/// Normals and hollows of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Shading {
    /// Unit normals by vertex.
    pub normals: Vec<[f32; 3]>,
    /// The degree to which each vertex lies in a hollow (positive) or on a ridge (negative), from -1 to 1.
    pub hollows: Vec<f32>,
}

impl Shading {
    /// The shading of a mesh.
    pub fn of(mesh: &SurfaceMesh) -> Self {
        let normals = vertex_normals(mesh);
        let hollows = hollows(mesh, &normals).into_iter().map(|hollow| hollow as f32).collect();
        Self { normals: normals.iter().map(|normal| normal.as_vec3().to_array()).collect(), hollows }
    }

    /// Adds all numbers of the shading to a packer.
    pub fn pack(&self, packer: &mut Packer) {
        let count = self.normals.len();
        packer.singles((0..3 * count).map(|k| self.normals[k / 3][k % 3]));
        packer.singles(self.hollows.iter().copied());
    }

    /// Takes back from an unpacker the shading of a mesh with this number of vertices, as [`Self::pack`] has added it.
    ///
    /// # Errors
    /// [`PackedError`] where it is the shading of a mesh with another number of vertices.
    pub fn unpack(unpacker: &mut Unpacker<'_>, vertices: usize) -> Result<Self, PackedError> {
        let (normals, hollows) = (unpacker.singles()?, unpacker.singles()?);
        let (normals, rest) = normals.as_chunks();
        if normals.len() != vertices || !rest.is_empty() || hollows.len() != vertices {
            return Err(PackedError::new("the shading is that of another mesh"));
        }
        Ok(Self { normals: normals.to_vec(), hollows })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    #[test]
    fn shading_comes_back_for_its_own_mesh_only() {
        let ball = icosphere(2);
        let shading = Shading::of(&ball);
        let mut packer = Packer::default();
        shading.pack(&mut packer);
        let bytes = packer.into_bytes();
        let unpack = |vertices| Shading::unpack(&mut Unpacker::new(&bytes), vertices);
        assert_eq!(unpack(ball.vertex_count()), Ok(shading));
        assert!(unpack(ball.vertex_count() - 1).is_err());
    }
}
