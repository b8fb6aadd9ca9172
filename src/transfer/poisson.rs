//! Positions whose gradients are nearest to wanted ones, by area: a Poisson system with the cotangent Laplacian.

use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use crate::numerics::approximate_cholesky::ApproximateCholesky;
use crate::numerics::conjugate_gradients::{CgError, CgOptions, CgWorkspace};
use crate::numerics::graph::Graph;
use glam::{DMat3, DVec3};
use typed_index_collections::{TiSlice, TiVec};

/// Positions by vertex of a mesh.
pub type Shape = TiVec<VertexId, DVec3>;

/// Why a deformation could not be found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DeformationError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The system could not be solved.
    #[error("the deformation: {0}")]
    Solve(#[from] CgError),
}

/// The accuracy of the displacements, in units of the right-hand side.
const SOLVE: CgOptions = CgOptions { tolerance: 1e-11, max_iterations: 4000 };

/// The size beside its terms below which a right-hand side is only rounding.
const ROUNDING: f64 = 1e-13;

/// The least weight of the preconditioner, as a share of their mean: cotangents may be negative.
const LEAST_WEIGHT: f64 = 1e-3;

/// The largest cotangent of a face. A face with larger ones, which is thinner than any that tells a gradient, counts less: in the
/// system and on its right-hand side alike, so that what fits all faces still solves it.
const LARGEST_COTANGENT: f64 = 1e6;

/// The system of a mesh with its factor, for any number of gradients.
pub struct Poisson<'a> {
    mesh: &'a SurfaceMesh,
    laplacian: Graph,
    factor: ApproximateCholesky,
    workspace: CgWorkspace<f64>,
}

impl<'a> Poisson<'a> {
    /// Factors the system of a mesh.
    pub fn new(mesh: &'a SurfaceMesh) -> Self {
        let laplacian = cotangent_laplacian(mesh);
        let factor = ApproximateCholesky::new(&preconditioning(&laplacian));
        Self { mesh, laplacian, factor, workspace: CgWorkspace::default() }
    }

    /// The displacements whose gradients are nearest to these; their mean may be any. `usual` is a gradient that tells what size of
    /// them is
    /// only rounding.
    ///
    /// # Errors
    /// [`DeformationError`].
    pub fn displacements(
        &mut self,
        gradients: &TiSlice<FaceId, DMat3>,
        usual: DMat3,
        monitor: &mut dyn Monitor,
    ) -> Result<Shape, DeformationError> {
        let n = self.mesh.vertex_count();
        let mut sides = [vec![0.0; n], vec![0.0; n], vec![0.0; n]];
        let mut terms = 0.0;
        for f in self.mesh.faces() {
            let weight = face_weight(self.mesh, f);
            for (v, hat) in self.mesh.triangles()[f].into_iter().zip(weighted_hats(self.mesh, f)) {
                let term = gradients[f] * hat * weight;
                (0..3).for_each(|k| sides[k][v.index()] += term[k]);
                terms += (usual * hat).length_squared();
            }
        }
        let mut found = [Vec::new(), Vec::new(), Vec::new()];
        for k in 0..3 {
            monitor.step(Step { fraction: k as f64 / 3.0, residual: None })?;
            found[k].resize(n, 0.0);
            let size: f64 = sides[k].iter().map(|x| x * x).sum();
            if size > ROUNDING * ROUNDING * terms {
                self.workspace.solve(&self.laplacian, &self.factor, &sides[k], &mut found[k], &SOLVE)?;
            }
        }
        let [x, y, z] = &found;
        Ok((0..n).map(|v| DVec3::new(x[v], y[v], z[v])).collect())
    }
}

/// The gradients of a face's hat functions times its area.
pub(super) fn weighted_hats(mesh: &SurfaceMesh, f: FaceId) -> [DVec3; 3] {
    let [p, q, r] = mesh.corners(f);
    let normal = (q - p).cross(r - p).normalize_or_zero();
    [r - q, p - r, q - p].map(|side| 0.5 * normal.cross(side))
}

/// The weight of a face: 1, except for the thinnest.
fn face_weight(mesh: &SurfaceMesh, f: FaceId) -> f64 {
    let largest = f.halfedges().map(|h| mesh.cotangent(h).abs()).into_iter().fold(0.0, f64::max);
    if largest > LARGEST_COTANGENT { LARGEST_COTANGENT / largest } else { 1.0 }
}

/// The Laplacian of a surface: half the cotangents opposite each edge.
fn cotangent_laplacian(mesh: &SurfaceMesh) -> Graph {
    let half = |h: HalfedgeId| {
        let weighted = 0.5 * mesh.cotangent(h) * face_weight(mesh, h.face());
        if weighted.is_finite() { weighted } else { 0.0 }
    };
    let edge = |h| (mesh.tail(h).0, mesh.head(h).0, half(h) + half(mesh.twin(h)));
    Graph { vertices: mesh.vertex_count(), edges: mesh.edges().map(edge).collect() }
}

/// A graph with positive weights that is like a Laplacian.
fn preconditioning(laplacian: &Graph) -> Graph {
    let edges = &laplacian.edges;
    let mean = edges.iter().map(|edge| edge.2.abs()).sum::<f64>() / edges.len() as f64;
    let positive = |&(i, j, weight): &(u32, u32, f64)| (i, j, weight.max(LEAST_WEIGHT * mean));
    Graph { vertices: laplacian.vertices, edges: edges.iter().map(positive).collect() }
}
