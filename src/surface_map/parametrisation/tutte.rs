//! Each patch mapped onto its straight triangle by Tutte's embedding (Tutte 1963; Floater 1997), as in the methods that map patch by patch
//! (Lee et al. 1998; Praun, Sweldens & Schröder 2001; Kraevoy & Sheffer 2004).
//!
//! The paths around a patch go onto the sides of its chart by arc length, and every vertex inside is the mean of its neighbours with
//! positive weights: cotangents within bounds. A path has the same places in both of its patches, so the whole is
//! continuous; its derivative jumps there. No edge inside a patch joins two vertices of its border, so no triangle is flipped, in
//! exact arithmetic. In f64 the image of a limb inside a patch shrinks by a factor with each of its widths, until its triangles are as
//! small as rounding: the certificate counts those that are flipped.

use super::cone_surface::ConeSurface;
use super::embedding::{Anchor, Embedding, Parametrised};
use super::unknowns::Unknowns;
use crate::layout::PatchedMesh;
use crate::math::rigid2::Rigid2;
use crate::math::scalar::{max, min};
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Pulse, Step};
use crate::numerics::approximate_cholesky::ApproximateCholesky;
use crate::numerics::conjugate_gradients::{CgOptions, CgWorkspace, LinearOperator};
use crate::numerics::graph::Graph;
use glam::DVec2;
use std::sync::Arc;
use typed_index_collections::{TiVec, ti_vec};

/// Lower bound of the cotangent weights, which are of order 1: they must be positive, and a wider range makes the system harder to solve.
/// Chosen by hand.
const LEAST_WEIGHT: f64 = 0.02;
/// Upper bound of the weights. Chosen by hand.
const MOST_WEIGHT: f64 = 50.0;

/// A solve ends at this relative residual; the next one solves for the residual that is left.
const SOLVE: CgOptions = CgOptions { tolerance: 1e-8, max_iterations: 1000 };

/// Solves of a system, each for the residual of the one before: at 1e-8 each, three leave nothing but rounding.
const SOLVES: usize = 3;

/// Faces or vertices between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 8192;

/// The parametrisation of a patched mesh over the cone surface of its layout, patch by patch.
///
/// # Errors
/// [`Cancelled`].
pub fn embed_patches(
    patched: &PatchedMesh,
    surface: &ConeSurface,
    monitor: &mut dyn Monitor,
) -> Result<Embedding, Cancelled> {
    let mut patches = Patches::new(patched, surface, monitor)?;
    let whole = patched.mesh.face_count() as f64;
    let mut done = 0.0;
    for patch in surface.base.mesh.faces() {
        let from = done;
        done += patches.faces[patch].len() as f64 / whole;
        patches.embed(patch, &mut Portion::new(monitor, from, done))?;
    }
    Ok(Embedding {
        corners: patches.corners,
        transitions: Arc::new(transitions(patched, surface)),
        anchors: Arc::new(
            surface
                .base
                .landmarks()
                .map(|l| {
                    let corner = patched.mesh.outgoing(patched.landmark_vertices[l]);
                    Anchor { corner, chart: patched.face_patch[corner.face()], motion: Rigid2::IDENTITY }
                })
                .collect(),
        ),
    })
}

/// The transitions of faces that lie in the chart of their patch: identities inside a patch, those of the charts across a path.
fn transitions(patched: &PatchedMesh, surface: &ConeSurface) -> TiVec<HalfedgeId, Rigid2> {
    let mut transitions = ti_vec![Rigid2::IDENTITY; 3 * patched.mesh.face_count()];
    for (side, path) in patched.paths.iter_enumerated() {
        for edge in path.windows(2) {
            if let Some(h) = patched.mesh.halfedge_between(edge[0], edge[1]) {
                transitions[h] = surface.transitions[side];
            }
        }
    }
    transitions
}

/// The weight of an edge: half the cotangents of the angles opposite, within bounds.
fn weight(mesh: &SurfaceMesh, edge: HalfedgeId) -> f64 {
    let weight = 0.5 * (mesh.cotangent(edge) + mesh.cotangent(mesh.twin(edge)));
    // Beside a face without area it may be NaN, which becomes the least weight.
    min(max(weight, LEAST_WEIGHT), MOST_WEIGHT)
}

/// Marks a vertex on a path, whose place is known, instead of the number of an unknown.
const KNOWN: u32 = u32::MAX;

/// The patches of a mesh on their charts.
struct Patches<'a> {
    patched: &'a PatchedMesh,
    surface: &'a ConeSurface,
    /// The faces of each patch.
    faces: TiVec<FaceId, Vec<FaceId>>,
    /// The number of each vertex among the vertices inside its patch, or [`KNOWN`].
    number: TiVec<VertexId, u32>,
    /// The place of each vertex of the paths around the present patch in the patch's chart.
    places: TiVec<VertexId, DVec2>,
    corners: TiVec<HalfedgeId, DVec2>,
    workspace: CgWorkspace<f64>,
}

impl<'a> Patches<'a> {
    fn new(
        patched: &'a PatchedMesh,
        surface: &'a ConeSurface,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let mesh = &patched.mesh;
        let mut number = ti_vec![0; mesh.vertex_count()];
        patched.paths.iter().flatten().for_each(|&v| number[v] = KNOWN);
        let mut inside = ti_vec![0; surface.base.mesh.face_count()];
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        for v in mesh.vertices().filter(|&v| number[v] != KNOWN).collect::<Vec<_>>() {
            pulse.beat()?;
            let count: &mut u32 = &mut inside[patched.face_patch[mesh.outgoing(v).face()]];
            number[v] = *count;
            *count += 1;
        }
        let mut faces = ti_vec![Vec::new(); surface.base.mesh.face_count()];
        patched.face_patch.iter_enumerated().for_each(|(f, &patch)| faces[patch].push(f));
        Ok(Self {
            patched,
            surface,
            faces,
            number,
            places: ti_vec![DVec2::ZERO; mesh.vertex_count()],
            corners: ti_vec![DVec2::ZERO; 3 * mesh.face_count()],
            workspace: CgWorkspace::default(),
        })
    }

    /// Finds the places of all vertices of a patch.
    fn embed(&mut self, patch: FaceId, monitor: &mut dyn Monitor) -> Result<(), Cancelled> {
        monitor.step(Step::default())?;
        for side in patch.halfedges() {
            self.place_path(side);
        }
        let [p, q, r] = self.surface.charts[patch];
        let centre = (p + q + r) / 3.0;
        let System { laplacian, b: [x, y] } = self.system(patch, centre, monitor)?;
        let factor = ApproximateCholesky::watched(&laplacian, monitor)?;
        let x = self.solved(&laplacian, &factor, &x, &mut Portion::new(monitor, 0.0, 0.5))?;
        let y = self.solved(&laplacian, &factor, &y, &mut Portion::new(monitor, 0.5, 1.0))?;
        let known = laplacian.vertices - 1;
        for h in self.faces[patch].iter().flat_map(|f| f.halfedges()) {
            let v = self.patched.mesh.tail(h);
            self.corners[h] = match self.number[v] {
                KNOWN => self.places[v],
                k => centre + DVec2::new(x[k as usize] - x[known], y[k as usize] - y[known]),
            };
        }
        Ok(())
    }

    /// Places the vertices of a path by arc length on its side of the chart.
    fn place_path(&mut self, side: HalfedgeId) {
        let chart = self.surface.charts[side.face()];
        let [start, end] = [chart[side.corner()], chart[side.next().corner()]];
        let (path, positions) = (&self.patched.paths[side], self.patched.mesh.positions());
        let lengths = || path.windows(2).map(|edge| positions[edge[0]].distance(positions[edge[1]]));
        let whole: f64 = lengths().sum();
        let mut passed = 0.0;
        for (&v, length) in path.iter().zip(lengths()) {
            self.places[v] = start.lerp(end, passed / whole);
            passed += length;
        }
    }

    /// The linear system of the vertices inside a patch; their places are relative to `centre`.
    fn system(&self, patch: FaceId, centre: DVec2, monitor: &mut dyn Monitor) -> Result<System, Cancelled> {
        let mesh = &self.patched.mesh;
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        let mut edges = Vec::new();
        let mut known = Vec::new();
        let mut unknowns = 0;
        for &f in &self.faces[patch] {
            pulse.beat()?;
            for h in f.halfedges() {
                let [i, j] = [mesh.tail(h), mesh.head(h)].map(|v| self.number[v]);
                if i == KNOWN {
                    continue;
                }
                unknowns = unknowns.max(i + 1);
                if j == KNOWN {
                    known.push((i, weight(mesh, h), self.places[mesh.head(h)] - centre));
                } else if i < j {
                    edges.push((i, j, weight(mesh, h)));
                }
            }
        }
        let mut b = [vec![0.0; unknowns as usize + 1], vec![0.0; unknowns as usize + 1]];
        for (i, weight, place) in known {
            edges.push((i, unknowns, weight));
            for (b, coordinate) in b.iter_mut().zip(place.to_array()) {
                b[i as usize] += weight * coordinate;
                b[unknowns as usize] -= weight * coordinate;
            }
        }
        Ok(System { laplacian: Graph { vertices: unknowns as usize + 1, edges }, b })
    }

    /// Solves a system of a Laplacian as exactly as rounding allows.
    fn solved(
        &mut self,
        laplacian: &Graph,
        factor: &ApproximateCholesky,
        b: &[f64],
        monitor: &mut dyn Monitor,
    ) -> Result<Vec<f64>, Cancelled> {
        let n = b.len();
        let (mut x, mut step, mut image, mut left) = (vec![0.0; n], vec![0.0; n], vec![0.0; n], b.to_vec());
        for _ in 0..SOLVES {
            let mut stopped = Ok(());
            let may_go_on = || {
                stopped = monitor.step(Step::default());
                stopped.is_ok()
            };
            // Where it does not converge, the last iterate is still nearer: the certificate judges the whole.
            let _ = self.workspace.solve_while(laplacian, factor, &left, &mut step, &SOLVE, may_go_on);
            stopped?;
            x.iter_mut().zip(&step).for_each(|(x, step)| *x += step);
            laplacian.apply(&x, &mut image);
            (0..n).for_each(|i| left[i] = b[i] - image[i]);
        }
        Ok(x)
    }
}

/// L x = b for both coordinates. The last vertex stands for all that are known, at the point that places are relative to.
struct System {
    laplacian: Graph,
    b: [Vec<f64>; 2],
}

/// The same parametrisation with every vertex but the landmarks moved by 1e-9 of its shortest edge, and sixfold with each further attempt.
///
/// The paths of both meshes lie on the same lines of the cone surface, where rounding alone would decide the overlay. The callers take
/// another attempt for each mesh, so that two equal meshes do not coincide either.
pub fn nudged(side: Parametrised<'_>, attempt: usize) -> Embedding {
    let unknowns = Unknowns::new(side);
    let mut nudged = side.embedding.clone();
    unknowns.place(&unknowns.nudged(side.embedding, attempt), &mut nudged.corners);
    nudged
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo;
    use crate::landmarks::Landmarks;
    use crate::layout::{self, BaseLayout, LayoutOptions};
    use crate::math::predicates::orient2d;
    use crate::monitor::Silent;
    use crate::surface_map::certify;

    fn horse_and_cat() -> (BaseLayout, ConeSurface) {
        let demo = demo::build("horse-cat").unwrap();
        let meshes = [&demo.source, &demo.target];
        let landmarks = Landmarks::from_vertices(meshes[0], meshes[1], &demo.landmarks).unwrap();
        let layout = layout::joint(meshes, &landmarks, &LayoutOptions::default(), &mut Silent).unwrap();
        let surface = ConeSurface::of_layout(&layout);
        (layout, surface)
    }

    /// Stops at the n-th question.
    struct StopAt(usize);

    impl Monitor for StopAt {
        fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
            self.0 = self.0.checked_sub(1).ok_or(Cancelled)?;
            Ok(())
        }
    }

    #[test]
    fn no_triangle_is_flipped_and_paths_lie_on_the_sides_by_arc_length() {
        let (layout, surface) = horse_and_cat();
        for side in [&layout.source, &layout.target] {
            let embedding = embed_patches(side, &surface, &mut Silent).unwrap();
            for f in side.mesh.faces() {
                let [p, q, r] = embedding.triangle(f);
                assert!(orient2d(p, q, r) > 0.0, "face {f:?}");
            }
            for (h, path) in side.paths.iter_enumerated() {
                let chart = surface.charts[h.face()];
                let [start, end] = [chart[h.corner()], chart[h.next().corner()]];
                let whole: f64 = path.windows(2).map(|edge| length(side, edge)).sum();
                let mut passed = 0.0;
                for edge in path.windows(2) {
                    let corner = side.mesh.halfedge_between(edge[0], edge[1]).unwrap();
                    let ends = [corner, corner.next()].map(|c| embedding.corners[c]);
                    let places = [passed, passed + length(side, edge)].map(|at| start.lerp(end, at / whole));
                    assert!((0..2).all(|k| ends[k].distance(places[k]) < 1e-14), "{ends:?} {places:?}");
                    passed += length(side, edge);
                }
            }
        }
    }

    fn length(side: &PatchedMesh, edge: &[VertexId]) -> f64 {
        side.mesh.positions()[edge[0]].distance(side.mesh.positions()[edge[1]])
    }

    #[test]
    fn every_vertex_inside_a_patch_is_the_mean_of_its_neighbours() {
        let (layout, surface) = horse_and_cat();
        let (side, mesh) = (&layout.source, &layout.source.mesh);
        let corners = embed_patches(side, &surface, &mut Silent).unwrap().corners;
        let on_path: Vec<VertexId> = side.paths.iter().flatten().copied().collect();
        for v in mesh.vertices().filter(|v| !on_path.contains(v)) {
            let (sum, weights) = mesh.star(v).fold((DVec2::ZERO, 0.0), |(sum, weights), h| {
                (sum + weight(mesh, h) * corners[h.next()], weights + weight(mesh, h))
            });
            let off = (sum / weights).distance(corners[mesh.outgoing(v)]);
            assert!(off < 1e-14, "{v:?}: {off:e}");
        }
    }

    #[test]
    fn the_whole_is_a_homeomorphism_that_the_certificate_knows_when_nothing_lies_on_a_line() {
        let (layout, surface) = horse_and_cat();
        let exact = embed_patches(&layout.source, &surface, &mut Silent).unwrap();
        let moved = nudged(layout.source.parametrised(&exact), 1);
        let farthest = exact.corners.iter().zip(&moved.corners).map(|(p, q)| p.distance(*q));
        assert!(farthest.fold(0.0, f64::max) < 1e-9);
        let certificate = certify(layout.source.parametrised(&moved), &surface);
        assert!(certificate.bijective, "{certificate:?}");
    }

    #[test]
    fn it_stops_when_it_is_asked_to_and_repeats_to_the_last_bit() {
        let (layout, surface) = horse_and_cat();
        let mut counter = StopAt(usize::MAX);
        let first = embed_patches(&layout.source, &surface, &mut counter).unwrap();
        let again = embed_patches(&layout.source, &surface, &mut Silent).unwrap();
        assert_eq!(first.corners, again.corners);
        let asked = usize::MAX - counter.0;
        assert!(asked > 30 * surface.charts.len(), "{asked}");
        for limit in [0, 1, asked / 2, asked - 1] {
            assert!(embed_patches(&layout.source, &surface, &mut StopAt(limit)).is_err(), "{limit}");
        }
    }
}
