//! Other meshes of nearly the same surface, on which a good map does not depend: with fewer triangles, with moved vertices.

use crate::math::random::SplitMix;
use crate::mesh::coarsening::Level;
use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::Silent;
use glam::DVec3;

/// A mesh coarsened to about `faces` triangles by quadric errors (Garland & Heckbert 1997); its vertices are vertices of the given
/// one. More are left where the connectivity allows no fewer.
pub fn decimated(mesh: &SurfaceMesh, faces: usize) -> SurfaceMesh {
    let vertices = (faces / 2) as i64 + mesh.euler_characteristic();
    // Nobody stops it.
    let level = Level::coarse(mesh, &[], vertices.max(4) as usize, &mut Silent);
    level.map_or_else(|_| mesh.clone(), |level| level.mesh)
}

/// Random moves of the vertices, as shares of the mean length of the edges at the vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// The largest move in either of two directions of the tangent plane.
    pub tangential: f64,
    /// The largest move along the normal.
    pub normal: f64,
    /// The seed: the same one gives the same moves.
    pub seed: u64,
}

/// The mesh with every vertex moved at random. Large shares turn triangles over.
pub fn perturbed(mesh: &SurfaceMesh, noise: Noise) -> SurfaceMesh {
    let index = SurfaceIndex::new(mesh);
    let mut random = SplitMix::new(noise.seed);
    let mut even = || 2.0 * random.unit() - 1.0;
    let mut moved = |v: VertexId| {
        let normal = index.normal(SurfacePoint::at_vertex(mesh, v));
        let (tangent, across) =
            if normal == DVec3::ZERO { (DVec3::ZERO, DVec3::ZERO) } else { normal.any_orthonormal_pair() };
        let (length, count) =
            mesh.star(v).fold((0.0, 0.0), |(sum, count), h| (sum + mesh.length(h), count + 1.0));
        let step = noise.tangential * (even() * tangent + even() * across) + noise.normal * even() * normal;
        mesh.positions()[v] + length / count * step
    };
    mesh.with_positions(mesh.vertices().map(&mut moved).collect())
}
