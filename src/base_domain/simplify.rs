//! Quadric error simplification down to exactly the protected vertices.

use super::domain::BaseDomain;
use super::stages::{SimplificationStage, Stages};
use crate::math::min_queue::Queued;
use crate::math::quadric::Quadric;
use crate::mesh::coarsening::CollapseQueue;
use crate::mesh::collapsible::{CollapsibleMesh, ShapeLimits};
use crate::mesh::{HalfedgeId, MeshError, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use typed_index_collections::{TiVec, ti_vec};

/// Why there is no base domain.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimplifyError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// Fewer than four landmarks make no closed triangulation.
    #[error("{count} landmarks are too few for a base domain: pick at least 4")]
    TooFew {
        /// Number of landmarks.
        count: usize,
    },
    /// The result is not a closed triangulation.
    #[error("the simplified mesh is not a closed triangulation: {0}")]
    NotManifold(#[from] MeshError),
}

/// Vertices between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 4096;

/// Limits of the first round: no collapse turns a normal by more than 80 degrees or leaves a triangle whose doubled area is below 1/100
/// of its longest edge squared. Chosen by hand: looser than between levels, since only the landmarks are left in the end.
const STRICT: ShapeLimits = ShapeLimits { normal_cosine: 0.17, double_area: 0.01 };

/// Collapses a mesh to its landmarks (Garland & Heckbert 1997; thesis section 3.2).
///
/// A vertex disappears into a neighbour, so landmarks stay where they are. When the link condition blocks every collapse of a
/// vertex, edges around it are flipped until it has three neighbours and can go: the result always has exactly the landmarks.
/// Vertex k of the result is landmark k.
///
/// # Errors
/// [`SimplifyError`].
pub fn simplify(
    mesh: &SurfaceMesh,
    landmarks: &[VertexId],
    monitor: &mut dyn Monitor,
) -> Result<BaseDomain, SimplifyError> {
    let mut simplification = Simplification::new(mesh, landmarks)?;
    simplification.run(monitor)?;
    simplification.base(landmarks)
}

/// The collapses of [`simplify`] from the whole mesh to its landmarks, in stages.
///
/// # Errors
/// [`SimplifyError`].
pub fn simplification_stages(
    mesh: &SurfaceMesh,
    landmarks: &[VertexId],
    monitor: &mut dyn Monitor,
) -> Result<Vec<SimplificationStage>, SimplifyError> {
    staged(Simplification::new(mesh, landmarks)?, monitor)
}

/// Collapses of a mesh with two sets of vertex positions (shapes), in stages: each collapse has the least quadric error summed over
/// both shapes, and keeps the limits of both.
///
/// `mesh` and `shape` have the same triangles. Their areas should be similar, or one outweighs the other.
///
/// # Errors
/// [`SimplifyError`].
pub fn joint_simplification_stages(
    [mesh, shape]: [&SurfaceMesh; 2],
    landmarks: &[VertexId],
    monitor: &mut dyn Monitor,
) -> Result<Vec<SimplificationStage>, SimplifyError> {
    staged(Simplification::new(mesh, landmarks)?.with_shape(shape), monitor)
}

fn staged(
    mut simplification: Simplification<'_>,
    monitor: &mut dyn Monitor,
) -> Result<Vec<SimplificationStage>, SimplifyError> {
    simplification.stages = Some(Stages::new(&simplification.mesh));
    simplification.run(monitor)?;
    let Simplification { stages, mesh, .. } = simplification;
    Ok(stages.map(|stages| stages.ended(&mesh)).unwrap_or_default())
}

/// A collapse that waits for its turn.
type Collapse = Queued<(VertexId, u32), HalfedgeId>;

/// A shape of the mesh with its quadrics.
struct Shape<'a> {
    mesh: &'a SurfaceMesh,
    quadrics: TiVec<VertexId, Quadric>,
}

/// The quadric of each vertex: the sum over its triangles.
fn quadrics_of(mesh: &SurfaceMesh) -> TiVec<VertexId, Quadric> {
    let mut quadrics = ti_vec![Quadric::ZERO; mesh.vertex_count()];
    for f in mesh.faces() {
        let plane = Quadric::of_triangle(mesh.corners(f));
        mesh.triangles()[f].iter().for_each(|&v| quadrics[v].add(&plane));
    }
    quadrics
}

struct Simplification<'a> {
    input: &'a SurfaceMesh,
    mesh: CollapsibleMesh,
    protected: TiVec<VertexId, bool>,
    quadrics: TiVec<VertexId, Quadric>,
    /// A second shape of the mesh, whose quadric error counts as much.
    other: Option<Shape<'a>>,
    /// The record of the stages, where the caller asks for one.
    stages: Option<Stages>,
}

impl<'a> Simplification<'a> {
    fn new(input: &'a SurfaceMesh, landmarks: &[VertexId]) -> Result<Self, SimplifyError> {
        if landmarks.len() < 4 {
            return Err(SimplifyError::TooFew { count: landmarks.len() });
        }
        let mut protected = ti_vec![false; input.vertex_count()];
        landmarks.iter().for_each(|&v| protected[v] = true);
        let (mesh, quadrics) = (CollapsibleMesh::new(input), quadrics_of(input));
        Ok(Self { input, mesh, protected, quadrics, other: None, stages: None })
    }

    fn with_shape(mut self, mesh: &'a SurfaceMesh) -> Self {
        self.other = Some(Shape { mesh, quadrics: quadrics_of(mesh) });
        self
    }

    fn run(&mut self, monitor: &mut dyn Monitor) -> Result<(), Cancelled> {
        self.round(Some(&STRICT), monitor)?;
        self.round(None, monitor)?;
        self.remove_blocked();
        Ok(())
    }

    fn collapse(&mut self, halfedge: HalfedgeId) {
        let [gone, onto] = [self.mesh.tail(halfedge), self.mesh.head(halfedge)];
        self.mesh.collapse(halfedge);
        if let Some(stages) = &mut self.stages {
            stages.collapsed(&self.mesh, gone, onto);
        }
    }

    fn round(&mut self, limits: Option<&ShapeLimits>, monitor: &mut dyn Monitor) -> Result<(), Cancelled> {
        let mut queue = CollapseQueue::default();
        let mut version: TiVec<VertexId, u32> = ti_vec![0; self.input.vertex_count()];
        let vertices: Vec<_> = self.mesh.vertices().collect();
        vertices.into_iter().for_each(|v| queue.extend(self.best(v, limits, version[v])));
        let (begin, mut touched) = (self.mesh.live_vertices(), Vec::new());
        while let Some(Queued { key: (vertex, of_version), value: halfedge, .. }) = queue.pop() {
            if !self.mesh.is_alive(vertex) || version[vertex] != of_version {
                continue;
            }
            if self.mesh.live_vertices().is_multiple_of(ASKED_EVERY) {
                let fraction = 1.0 - self.mesh.live_vertices() as f64 / begin as f64;
                monitor.step(Step { fraction, residual: None })?;
            }
            let kept = self.mesh.head(halfedge);
            let absorbed = self.quadrics[vertex];
            self.quadrics[kept].add(&absorbed);
            if let Some(Shape { quadrics, .. }) = &mut self.other {
                let absorbed = quadrics[vertex];
                quadrics[kept].add(&absorbed);
            }
            self.collapse(halfedge);
            touched.clear();
            touched.push(kept);
            touched.extend(self.mesh.star(kept).map(|h| self.mesh.head(h)));
            for &v in &touched {
                version[v] += 1;
                queue.extend(self.best(v, limits, version[v]));
            }
        }
        Ok(())
    }

    /// The cheapest allowed collapse of a vertex.
    fn best(&self, v: VertexId, limits: Option<&ShapeLimits>, version: u32) -> Option<Collapse> {
        if self.protected[v] {
            return None;
        }
        let mut best: Option<Collapse> = None;
        for halfedge in self.mesh.star(v) {
            let cost = self.cost(v, self.mesh.head(halfedge));
            let better = best.as_ref().is_none_or(|b| cost < b.cost);
            if better
                && self.mesh.link_condition(halfedge)
                && limits.is_none_or(|l| self.keeps_shape(halfedge, l))
            {
                best = Some(Queued { cost, key: (v, version), value: halfedge });
            }
        }
        best
    }

    /// The quadric error of moving a vertex to the place of another one, summed over the shapes.
    fn cost(&self, v: VertexId, onto: VertexId) -> f64 {
        let own = self.quadrics[v].at(self.input.positions()[onto]);
        let Some(Shape { mesh, quadrics }) = &self.other else { return own };
        own + quadrics[v].at(mesh.positions()[onto])
    }

    fn keeps_shape(&self, halfedge: HalfedgeId, limits: &ShapeLimits) -> bool {
        let keeps = |mesh: &SurfaceMesh| self.mesh.keeps_shape(halfedge, mesh.positions(), limits);
        keeps(self.input) && self.other.as_ref().is_none_or(|shape| keeps(shape.mesh))
    }

    /// Flips edges around each vertex left over until it has three neighbours, then collapses it.
    fn remove_blocked(&mut self) {
        let left: Vec<_> = self.mesh.vertices().filter(|&v| !self.protected[v]).collect();
        for v in left {
            // At degree 4 and more some edge of a vertex of a simple triangulation can always be flipped away from it: if all
            // opposite diagonals existed, two of them would cross.
            while self.mesh.star(v).count() > 3 {
                let spokes: Vec<_> = self.mesh.star(v).collect();
                if !spokes.into_iter().any(|h| self.mesh.flip(h)) {
                    break;
                }
            }
            let collapse = self.mesh.star(v).find(|&h| self.mesh.link_condition(h));
            if let Some(h) = collapse {
                self.collapse(h);
            }
        }
    }

    fn base(&self, landmarks: &[VertexId]) -> Result<BaseDomain, SimplifyError> {
        let mut number = ti_vec![VertexId(u32::MAX); self.input.vertex_count()];
        landmarks.iter().enumerate().for_each(|(k, &v)| number[v] = VertexId::from(k));
        let positions = landmarks.iter().map(|&v| self.input.positions()[v]).collect();
        let faces = self.mesh.faces().map(|f| self.mesh.corners(f).map(|v| number[v])).collect();
        Ok(BaseDomain { mesh: SurfaceMesh::from_triangles(positions, faces)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::{icosphere, octahedron};
    use crate::monitor::Silent;
    use std::f64::consts::PI;

    #[test]
    fn a_sphere_goes_down_to_any_set_of_landmarks() {
        let sphere = icosphere(3);
        for count in [4, 5, 6, 12, 33, 128] {
            let landmarks: Vec<_> = (0..count).map(|k| VertexId(k * 97 % 642)).collect();
            let base = simplify(&sphere, &landmarks, &mut Silent).unwrap();
            assert_eq!(base.mesh.vertex_count(), count as usize);
            assert_eq!(base.mesh.face_count(), 2 * count as usize - 4);
            assert_eq!(base.mesh.euler_characteristic(), 2);
            let defects: f64 = base.cone_angles().iter().map(|angle| 2.0 * PI - angle).sum();
            assert!((defects - 4.0 * PI).abs() < 1e-10, "Gauss-Bonnet");
        }
    }

    #[test]
    fn the_stages_are_closed_spheres_from_the_mesh_to_its_base_domain() {
        let sphere = icosphere(3);
        let landmarks: Vec<_> = (0..12).map(|k| VertexId(k * 97 % 642)).collect();
        let base = simplify(&sphere, &landmarks, &mut Silent).unwrap();
        let stages = simplification_stages(&sphere, &landmarks, &mut Silent).unwrap();
        assert_eq!(stages[0].triangles, sphere.triangles().raw);
        for stage in &stages {
            assert_eq!(stage.triangles.len(), 2 * stage.vertices - 4, "Euler's formula");
            let mut corners: Vec<_> = stage.triangles.iter().flatten().collect();
            corners.sort_unstable();
            corners.dedup();
            assert_eq!(corners.len(), stage.vertices);
            assert!(landmarks.iter().all(|v| corners.contains(&v)));
        }
        let counts: Vec<usize> = stages.iter().map(|stage| stage.vertices).collect();
        assert!(counts.windows(2).all(|w| w[1] < w[0] && 8 * w[1] + 8 >= 7 * w[0]), "{counts:?}");
        let last = &stages[stages.len() - 1];
        let number = |v: &VertexId| landmarks.iter().position(|l| l == v).map(VertexId::from).unwrap();
        let named: Vec<[VertexId; 3]> = last.triangles.iter().map(|t| t.each_ref().map(number)).collect();
        assert_eq!(named, base.mesh.triangles().raw);
    }

    #[test]
    fn every_vertex_goes_once_and_its_history_ends_at_a_landmark() {
        let sphere = icosphere(3);
        let landmarks: Vec<_> = (0..12).map(|k| VertexId(k * 97 % 642)).collect();
        let stages = simplification_stages(&sphere, &landmarks, &mut Silent).unwrap();
        let mut onto = ti_vec![None; sphere.vertex_count()];
        for stage in &stages {
            for &[gone, kept] in &stage.collapses {
                assert_eq!((onto[gone], onto[kept]), (None, None), "both are there until then");
                onto[gone] = Some(kept);
            }
            let left = onto.iter().filter(|kept| kept.is_none()).count();
            assert_eq!(left, stage.vertices, "the collapses lead to the stage");
            assert!(stage.triangles.iter().flatten().all(|&v| onto[v].is_none()));
        }
        for mut v in sphere.vertices() {
            while let Some(kept) = onto[v] {
                v = kept;
            }
            assert!(landmarks.contains(&v));
        }
    }

    #[test]
    fn two_shapes_are_spared_both() {
        let sphere = icosphere(3);
        let landmarks: Vec<_> = (0..12).map(|k| VertexId(k * 97 % 642)).collect();
        // A shape of the mesh's own changes nothing; another one does.
        let alone = simplification_stages(&sphere, &landmarks, &mut Silent).unwrap();
        assert_eq!(joint_simplification_stages([&sphere, &sphere], &landmarks, &mut Silent).unwrap(), alone);
        let bent = |p: &glam::DVec3| glam::DVec3::new(p.x, 0.4 * p.y, 1.5 * p.z + p.x * p.x);
        let bent = sphere.with_positions(sphere.positions().iter().map(bent).collect());
        let joint = joint_simplification_stages([&sphere, &bent], &landmarks, &mut Silent).unwrap();
        assert_ne!(joint, alone);
        let reversed = joint_simplification_stages([&bent, &sphere], &landmarks, &mut Silent).unwrap();
        let last = |stages: &[SimplificationStage]| stages[stages.len() - 1].vertices;
        assert_eq!([last(&joint), last(&reversed)], [12, 12]);
        for stage in &joint {
            assert_eq!(stage.triangles.len(), 2 * stage.vertices - 4, "Euler's formula");
        }
    }

    #[test]
    fn the_octahedron_comes_out_of_its_subdivision() {
        let fine = crate::mesh::generators::midpoint_subdivision(&octahedron());
        let corners: Vec<_> = (0..6).map(VertexId).collect();
        let base = simplify(&fine, &corners, &mut Silent).unwrap();
        for angle in base.cone_angles() {
            assert!((angle - 4.0 * PI / 3.0).abs() < 1e-12, "{angle}");
        }
    }
}
