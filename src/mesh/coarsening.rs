//! Coarsening by half-edge collapses in the order of quadric errors (Garland & Heckbert 1997), and the levels between.

use super::collapsible::{CollapsibleMesh, ShapeLimits};
use super::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::math::min_queue::{MinQueue, Queued};
use crate::math::quadric::Quadric;
use crate::monitor::{Cancelled, Monitor, Step};
use glam::DVec3;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// The limits of shape: normals turn by less than 78 degrees, and no new triangle has a double area below 1/20 of its longest edge
/// squared. Chosen by hand.
const SHAPE: ShapeLimits = ShapeLimits { normal_cosine: 0.2, double_area: 0.05 };

/// Collapses vertices into neighbours until `goal` are left or none may go; `may` says whether the start of a halfedge may
/// go into its end. Returns how many vertices are left.
///
/// Shapes are kept first; where that leaves too many vertices, only the link condition is.
///
/// # Errors
/// [`Cancelled`].
pub fn coarsen(
    mesh: &mut CollapsibleMesh,
    positions: &TiSlice<VertexId, DVec3>,
    goal: usize,
    may: impl Fn(&CollapsibleMesh, HalfedgeId) -> bool,
    monitor: &mut dyn Monitor,
) -> Result<usize, Cancelled> {
    coarsen_by(Strictness::Shape, mesh, positions, goal, may, monitor)
}

/// As [`coarsen`], with a choice of what is asked of shapes in the first rounds.
fn coarsen_by(
    strictness: Strictness,
    mesh: &mut CollapsibleMesh,
    positions: &TiSlice<VertexId, DVec3>,
    goal: usize,
    may: impl Fn(&CollapsibleMesh, HalfedgeId) -> bool,
    monitor: &mut dyn Monitor,
) -> Result<usize, Cancelled> {
    monitor.step(Step::default())?;
    let first = mesh.live_vertices();
    let quadrics = quadrics(mesh, positions);
    monitor.step(Step::default())?;
    let mut coarsening = Coarsening {
        mesh,
        positions,
        may,
        quadrics,
        version: ti_vec![0; positions.len()],
        queue: MinQueue::default(),
        strictness,
        collapses: Vec::new(),
    };
    // A collapse that one round refuses may be possible after others: three rounds keep the shapes of triangles, then three do not.
    // Chosen by hand.
    for round in 0..6 {
        if coarsening.mesh.live_vertices() <= goal {
            break;
        }
        coarsening.strictness = if round < 3 { strictness } else { Strictness::LinkOnly };
        coarsening.round(goal, first, monitor)?;
    }
    Ok(mesh.live_vertices())
}

/// The number of vertices whose collapses are compared between two questions to the monitor: some milliseconds, also beside
/// vertices of a thousand neighbours. Where collapses were counted instead, 256 of them, each next to such a vertex, took 276 ms.
const ASKED_EVERY: usize = 1024;

/// The number of neighbours that a held vertex keeps: around a sharp cone the angle must be shared among enough triangles. Chosen
/// by hand.
const HELD_DEGREE: usize = 8;

/// Share of slivers above which a mesh counts as one of slivers: up to .8 % of the triangles of the meshes that were tried as they came, 8 %
/// and more where planes cut them. Chosen by hand between both.
const SLIVERS: f64 = 0.02;

/// Whether a triangle is beyond the limits of shape.
pub fn is_sliver(mesh: &CollapsibleMesh, f: FaceId, positions: &TiSlice<VertexId, DVec3>) -> bool {
    mesh.shape(f, positions) < SHAPE.double_area
}

/// Whether many triangles are beyond the limits of shape, as in sections of solids.
pub fn has_slivers(mesh: &CollapsibleMesh, positions: &TiSlice<VertexId, DVec3>) -> bool {
    let slivers = mesh.faces().filter(|&f| is_sliver(mesh, f, positions)).count();
    slivers as f64 > SLIVERS * mesh.faces().count() as f64
}

/// Vertices that stay when a mesh is coarsened.
#[derive(Clone, Copy)]
pub struct Held<'a> {
    /// The vertices that keep their degree as well, or a degree of 8 where they have more.
    pub cones: &'a TiSlice<VertexId, bool>,
    /// The vertices that only stay.
    pub others: &'a TiSlice<VertexId, bool>,
}

/// Coarsens to about `goal` vertices; the held ones stay. In a mesh of slivers collapses that make none worse are allowed; else the vertices
/// between slivers would stay to the end.
///
/// # Errors
/// [`Cancelled`].
pub fn coarsen_around(
    mesh: &mut CollapsibleMesh,
    positions: &TiSlice<VertexId, DVec3>,
    goal: usize,
    held: Held<'_>,
    monitor: &mut dyn Monitor,
) -> Result<(), Cancelled> {
    let may = |mesh: &CollapsibleMesh, h: HalfedgeId| {
        let (v, into) = (mesh.tail(h), mesh.head(h));
        let robs = |w: VertexId| {
            held.cones[w]
                && (w == into || mesh.star(w).any(|g| mesh.head(g) == into))
                && mesh.star(w).count() <= HELD_DEGREE
        };
        !held.cones[v] && !held.others[v] && !mesh.star(v).any(|g| robs(mesh.head(g)))
    };
    let strictness = if has_slivers(mesh, positions) { Strictness::NoWorse } else { Strictness::Shape };
    coarsen_by(strictness, mesh, positions, goal, may, monitor)?;
    Ok(())
}

fn quadrics(mesh: &CollapsibleMesh, positions: &TiSlice<VertexId, DVec3>) -> TiVec<VertexId, Quadric> {
    let mut quadrics = ti_vec![Quadric::ZERO; positions.len()];
    for f in mesh.faces() {
        let corners = mesh.corners(f);
        let plane = Quadric::of_triangle(corners.map(|v| positions[v]));
        corners.iter().for_each(|&v| quadrics[v].add(&plane));
    }
    quadrics
}

struct Coarsening<'a, M> {
    mesh: &'a mut CollapsibleMesh,
    positions: &'a TiSlice<VertexId, DVec3>,
    may: M,
    quadrics: TiVec<VertexId, Quadric>,
    version: TiVec<VertexId, u32>,
    queue: CollapseQueue,
    strictness: Strictness,
    /// The collapses of one vertex with their costs, kept for its memory.
    collapses: Vec<(f64, HalfedgeId)>,
}

impl<M: Fn(&CollapsibleMesh, HalfedgeId) -> bool> Coarsening<'_, M> {
    /// One pass over all collapses, from `first` vertices down to `goal`.
    fn round(&mut self, goal: usize, first: usize, monitor: &mut dyn Monitor) -> Result<(), Cancelled> {
        self.queue.clear();
        let vertices: Vec<_> = self.mesh.vertices().collect();
        for (k, v) in vertices.into_iter().enumerate() {
            if k.is_multiple_of(ASKED_EVERY) {
                monitor.step(Step::default())?;
            }
            self.push_best(v);
        }
        let mut touched = Vec::new();
        let mut compared = 0_usize;
        while let Some(Queued { key: (vertex, version), value: halfedge, .. }) = self.queue.pop() {
            compared += 1;
            if compared >= ASKED_EVERY {
                compared = 0;
                let gone = first - self.mesh.live_vertices();
                let fraction = gone as f64 / (first.saturating_sub(goal)).max(1) as f64;
                monitor.step(Step { fraction, residual: None })?;
            }
            if !self.mesh.is_alive(vertex) || self.version[vertex] != version {
                continue;
            }
            let kept = self.mesh.head(halfedge);
            let absorbed = self.quadrics[vertex];
            self.quadrics[kept].add(&absorbed);
            self.mesh.collapse(halfedge);
            if self.mesh.live_vertices() <= goal {
                return Ok(());
            }
            touched.clear();
            touched.push(kept);
            touched.extend(self.mesh.star(kept).map(|h| self.mesh.head(h)));
            compared += touched.len();
            for &v in &touched {
                self.version[v] += 1;
                self.push_best(v);
            }
        }
        Ok(())
    }

    /// Queues the cheapest collapse of a vertex that is allowed. A cost is known sooner than whether a collapse is allowed, and the cheapest
    /// mostly is.
    fn push_best(&mut self, v: VertexId) {
        let mut collapses = std::mem::take(&mut self.collapses);
        collapses.clear();
        collapses.extend(self.mesh.star(v).map(|h| (self.cost(h), h)));
        // A stable sort: of equal costs the first in the star comes first.
        collapses.sort_by(|a, b| a.0.total_cmp(&b.0));
        if let Some(&(cost, halfedge)) = collapses.iter().find(|(_, h)| self.allowed(*h)) {
            self.queue.push(cost, (v, self.version[v]), halfedge);
        }
        self.collapses = collapses;
    }

    fn cost(&self, h: HalfedgeId) -> f64 {
        let quadric = &self.quadrics[self.mesh.tail(h)];
        let (a, b) = (self.positions[self.mesh.tail(h)], self.positions[self.mesh.head(h)]);
        // The second part prefers short edges where the surface is flat and the quadric says nothing. Chosen by hand.
        quadric.at(b) + 0.01 * quadric.area * a.distance_squared(b)
    }

    fn allowed(&self, h: HalfedgeId) -> bool {
        (self.may)(self.mesh, h)
            && self.mesh.link_condition(h)
            && match self.strictness {
                Strictness::Shape => self.mesh.keeps_shape(h, self.positions, &SHAPE),
                Strictness::NoWorse => self.makes_no_worse(h),
                Strictness::LinkOnly => true,
            }
    }

    /// Whether the moved triangles stay within the limits of shape, or are better than the worst around the vertex that would vanish.
    fn makes_no_worse(&self, h: HalfedgeId) -> bool {
        if self.mesh.keeps_shape(h, self.positions, &SHAPE) {
            return true;
        }
        let worst = self.mesh.worst_shape(self.mesh.tail(h), self.positions);
        worst < SHAPE.double_area
            && self.mesh.keeps_shape(h, self.positions, &ShapeLimits { double_area: worst, ..SHAPE })
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Strictness {
    /// The limits of shape.
    Shape,
    /// These, or none worse than the worst that was there.
    NoWorse,
    /// The link condition alone.
    LinkOnly,
}

/// Collapses that wait for their turn, the least quadric error first: the vertex that would vanish with its version when the
/// error was taken (another one means that it is out of date), and the halfedge from it to the vertex it would go into.
pub(crate) type CollapseQueue = MinQueue<(VertexId, u32), HalfedgeId>;

/// One level of a collapsible mesh as a mesh of its own.
#[derive(Clone, Debug)]
pub struct Level {
    /// The level's mesh, numbered without gaps in the order of the full mesh; corners of a face keep their places.
    pub mesh: SurfaceMesh,
    /// The full mesh's vertex of each vertex.
    pub vertices: TiVec<VertexId, VertexId>,
    /// The full mesh's face number of each face.
    pub faces: TiVec<FaceId, FaceId>,
}

impl Level {
    /// A mesh coarsened to about `goal` vertices, those in `held` among them.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn coarse(
        mesh: &SurfaceMesh,
        held: &[VertexId],
        goal: usize,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let mut level = CollapsibleMesh::new(mesh);
        let mut is_held = ti_vec![false; mesh.vertex_count()];
        held.iter().for_each(|&v| is_held[v] = true);
        let others: TiVec<VertexId, bool> = ti_vec![false; mesh.vertex_count()];
        let held = Held { cones: &is_held, others: &others };
        coarsen_around(&mut level, mesh.positions(), goal, held, monitor)?;
        Ok(Self::of(&level, mesh.positions()))
    }

    /// The level's numbers of vertices of the full mesh, which must be in the level.
    pub fn numbers<'a>(
        &'a self,
        full: impl IntoIterator<Item = &'a VertexId>,
    ) -> impl Iterator<Item = VertexId> {
        full.into_iter().map(|v| self.vertices.binary_search(v).unwrap_or(VertexId(u32::MAX)))
    }

    /// The present level of a collapsible mesh.
    pub fn of(mesh: &CollapsibleMesh, positions: &TiSlice<VertexId, DVec3>) -> Self {
        let vertices: TiVec<VertexId, VertexId> = mesh.vertices().collect();
        let mut numbers: TiVec<VertexId, VertexId> = ti_vec![VertexId(u32::MAX); positions.len()];
        vertices.iter_enumerated().for_each(|(number, &v)| numbers[v] = number);
        let faces: TiVec<FaceId, FaceId> = mesh.faces().collect();
        let triangles = faces.iter().map(|&f| mesh.corners(f).map(|v| numbers[v])).collect();
        let places = vertices.iter().map(|&v| positions[v]).collect();
        let mut number_of_face: TiVec<FaceId, FaceId> = ti_vec![FaceId(u32::MAX); mesh.face_slots()];
        faces.iter_enumerated().for_each(|(number, &f)| number_of_face[f] = number);
        let halfedge = |h: HalfedgeId| HalfedgeId::of(number_of_face[h.face()], h.corner());
        let twins = faces.iter().flat_map(|&f| f.halfedges().map(|h| halfedge(mesh.twin(h)))).collect();
        Self { mesh: SurfaceMesh::from_parts(places, triangles, twins), vertices, faces }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;

    #[test]
    fn a_level_is_a_sphere_that_keeps_the_held_vertices_and_its_numbers() {
        let sphere = icosphere(4);
        let held: Vec<_> = [3, 500, 1000, 2000].map(VertexId).to_vec();
        let level = Level::coarse(&sphere, &held, 200, &mut Silent).unwrap();
        let rebuilt =
            SurfaceMesh::from_triangles(level.mesh.positions().to_owned(), level.mesh.triangles().to_owned());
        let rebuilt = rebuilt.unwrap();
        assert_eq!((level.mesh.vertex_count(), level.mesh.euler_characteristic()), (200, 2));
        assert!(held.iter().all(|v| level.vertices.contains(v)));
        for h in level.mesh.halfedges() {
            assert_eq!(level.mesh.twin(h), rebuilt.twin(h));
            assert_eq!(level.mesh.tail(level.mesh.outgoing(level.mesh.tail(h))), level.mesh.tail(h));
        }
        // Coarse, but still nearly the unit sphere.
        assert!(level.mesh.area() > 0.95 * sphere.area());
    }

    #[test]
    fn the_goal_may_be_the_held_vertices_alone() {
        let sphere = icosphere(3);
        let held = [0, 5, 100, 400, 600].map(VertexId);
        let mut mesh = CollapsibleMesh::new(&sphere);
        let may = |mesh: &CollapsibleMesh, h: HalfedgeId| !held.contains(&mesh.tail(h));
        let left = coarsen(&mut mesh, sphere.positions(), 5, may, &mut Silent).unwrap();
        assert_eq!(left, 5);
    }

    #[test]
    fn held_vertices_keep_their_degree() {
        let sphere = icosphere(4);
        let held: Vec<_> = [3, 500, 1000, 2000].map(VertexId).to_vec();
        let level = Level::coarse(&sphere, &held, 60, &mut Silent).unwrap();
        for (v, w) in held.iter().zip(level.numbers(&held)) {
            assert!(level.mesh.star(w).count() >= sphere.star(*v).count());
        }
    }
}
