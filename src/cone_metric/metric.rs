//! The state of the flow: an intrinsic triangulation with inversive distances and radii.

use super::scheme::Scheme;
use crate::intrinsic::{IntrinsicTriangulation, Move};
use crate::math::decorated::{
    flipped_inversive_distance, half_edge_weight, inversive_distance, squared_length, tilt,
};
use crate::math::scalar::{atan2, exp, ln, max, min};
use crate::math::triangle::area_from_lengths;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::numerics::graph::Graph;
use std::f64::consts::TAU;
use typed_index_collections::{TiVec, ti_vec};

/// Flips by halfedge, at most, in one restoration of the Delaunay property: a whole step of the flow needs fewer than one.
const MOST_FLIPS: usize = 100;

/// A discrete metric conformal to a mesh.
#[derive(Clone, Debug)]
pub struct ConeMetric {
    /// The weighted Delaunay triangulation, with the flips from the mesh's own.
    pub triangulation: IntrinsicTriangulation,
    /// Logarithm of the radius at each vertex.
    pub log_radii: TiVec<VertexId, f64>,
    /// Inversive distance of each halfedge; twins agree. They never change but by flips, and never come from lengths
    /// again: flips stay exact in the fixed hyperbolic structure.
    pub etas: TiVec<HalfedgeId, f64>,
    /// 1 for circles, 0 for vertex scaling.
    pub eps: f64,
}

impl ConeMetric {
    /// The mesh's own metric.
    pub(super) fn of_mesh(mesh: &SurfaceMesh, scheme: Scheme, radii_scale: f64) -> Self {
        let (eps, gammas) = match scheme {
            Scheme::VertexScaling => (0.0, ti_vec![1.0; mesh.vertex_count()]),
            Scheme::Inversive => (1.0, initial_radii(mesh, radii_scale)),
            Scheme::FixedTriangulation => (1.0, initial_radii(mesh, 1.0)),
            Scheme::Tangential | Scheme::Thurston => (1.0, mean_radii(mesh)),
        };
        let eta = |h| {
            let eta = inversive_distance(eps, [gammas[mesh.tail(h)], gammas[mesh.head(h)]], mesh.length(h));
            match scheme {
                Scheme::Tangential => 1.0,
                Scheme::Thurston => eta.clamp(0.0, 1.0),
                Scheme::Inversive | Scheme::VertexScaling | Scheme::FixedTriangulation => eta,
            }
        };
        Self {
            triangulation: IntrinsicTriangulation::of_mesh(mesh),
            log_radii: gammas.iter().map(|&g| ln(g)).collect(),
            etas: mesh.halfedges().map(eta).collect(),
            eps,
        }
    }

    /// Length of an edge; NaN where its square would be negative, which weighted Delaunay triangulations rule out.
    pub fn length(&self, h: HalfedgeId) -> f64 {
        let ends = [self.triangulation.tail(h), self.triangulation.tail(h.next())];
        squared_length(self.eps, ends.map(|v| exp(self.log_radii[v])), self.etas[h]).sqrt()
    }

    /// Lengths of all halfedges.
    pub fn lengths(&self) -> TiVec<HalfedgeId, f64> {
        self.triangulation.halfedges().map(|h| self.length(h)).collect()
    }

    /// Flips until every edge is weighted Delaunay; returns the number of flips.
    ///
    /// Flips lower an energy, so they end; where rounding makes them repeat, a bound ends them. The result is a triangulation all
    /// the same, and the flow judges it by its curvatures.
    pub(super) fn restore_delaunay(&mut self, queue: &mut FlipQueue) -> usize {
        let inverse: TiVec<VertexId, f64> = self.log_radii.iter().map(|&u| exp(-u)).collect();
        queue.fill(&self.triangulation);
        let mut flips = 0;
        let most = MOST_FLIPS * self.etas.len();
        while let Some(h) = queue.pop().filter(|_| flips < most) {
            if self.is_delaunay(h, &inverse) || !self.triangulation.is_flippable(h) {
                continue;
            }
            self.flip(h);
            flips += 1;
            let t = self.triangulation.twin(h);
            [h.next(), h.prev(), t.next(), t.prev()].into_iter().for_each(|x| queue.push(x));
        }
        flips
    }

    fn flip(&mut self, h: HalfedgeId) {
        let t = self.triangulation.twin(h);
        let k = [self.etas[h.prev()], self.etas[h.next()]];
        let l = [self.etas[t.next()], self.etas[t.prev()]];
        let eta = flipped_inversive_distance(self.eps, self.etas[h], k, l);
        let moves = self.triangulation.flip(h);
        let old = moves.map(|Move { from, .. }| self.etas[from]);
        moves.iter().zip(old).for_each(|(Move { to, .. }, eta)| self.etas[*to] = eta);
        self.etas[h] = eta;
        self.etas[t] = eta;
    }

    fn is_delaunay(&self, h: HalfedgeId, inverse: &TiVec<VertexId, f64>) -> bool {
        let t = self.triangulation.twin(h);
        let sum = self.tilt_at(h, inverse) + self.tilt_at(t, inverse);
        let ends = inverse[self.triangulation.tail(h)] + inverse[self.triangulation.tail(t)];
        // NaN counts as Delaunay: a flip could not mend it.
        // The tolerance is above rounding, so that the diagonals of a cocircular diamond are not flipped for one another endlessly.
        sum.is_nan() || sum >= -1e-11 * ends
    }

    fn tilt_at(&self, h: HalfedgeId, inverse: &TiVec<VertexId, f64>) -> f64 {
        let corners = [h, h.next(), h.prev()].map(|c| inverse[self.triangulation.tail(c)]);
        tilt(self.eps, self.etas[h], [self.etas[h.prev()], self.etas[h.next()]], corners)
    }

    /// Angle defects, and the weighted Laplacian that is their derivative with respect to the logarithmic radii.
    ///
    /// Returns whether every triangle satisfies the triangle inequality; where one does not, its angles are those of the
    /// degenerate triangle.
    pub(super) fn curvature(&self, state: &mut FlowState) -> bool {
        let n = self.triangulation.vertex_count();
        state.curvature.resize(n, 0.0);
        state.curvature.fill(TAU);
        state.gammas.clear();
        state.gammas.extend(self.log_radii.iter().map(|&u| exp(u)));
        state.weights.resize(self.etas.len(), 0.0);
        let mut valid = true;
        for f in self.triangulation.faces() {
            valid &= self.add_face(f, state);
        }
        valid
    }

    fn add_face(&self, f: FaceId, state: &mut FlowState) -> bool {
        let h = f.halfedges();
        let v = h.map(|x| self.triangulation.tail(x).index());
        let g = v.map(|i| state.gammas[i]);
        let l = [0, 1, 2]
            .map(|k| squared_length(self.eps, [g[k], g[(k + 1) % 3]], self.etas[h[k]]).max(0.0).sqrt());
        let area = area_from_lengths(l[0], l[1], l[2]);
        for k in 0..3 {
            let (ij, jk, ki) = (l[k], l[(k + 1) % 3], l[(k + 2) % 3]);
            let dot = 0.5 * ((ki - jk) * (ki + jk) + ij * ij);
            state.curvature[v[k]] -= atan2(2.0 * area, dot);
            let norm = ij * ki;
            let direction = (dot / norm, 2.0 * area / norm);
            let gammas = [g[k], g[(k + 1) % 3], g[(k + 2) % 3]];
            state.weights[h[k].index()] = half_edge_weight(self.eps, [ij, jk, ki], gammas, direction);
        }
        area > 0.0
    }

    /// The faces whose lengths do not satisfy the triangle inequality.
    pub(super) fn degenerate_faces(&self) -> Vec<FaceId> {
        let is_degenerate = |f: &FaceId| {
            let [a, b, c] = f.halfedges().map(|h| self.length(h));
            let area = area_from_lengths(a, b, c);
            // A length that does not exist is NaN, as is the area.
            area.is_nan() || area <= 0.0
        };
        self.triangulation.faces().filter(is_degenerate).collect()
    }

    /// The graph whose Laplacian is the Hessian at the state's weights.
    pub(super) fn hessian(&self, state: &FlowState, graph: &mut Graph) {
        graph.vertices = self.triangulation.vertex_count();
        graph.edges.clear();
        for h in self.triangulation.halfedges() {
            let t = self.triangulation.twin(h);
            let (i, j) = (self.triangulation.tail(h), self.triangulation.tail(t));
            if h < t && i != j {
                let weight = state.weights[h.index()] + state.weights[t.index()];
                // Never below 0 on a weighted Delaunay triangulation but for rounding.
                // 1e-12 keeps the graph connected; weights are cotangents, of order 1.
                graph.edges.push((i.0, j.0, if weight.is_finite() { weight.max(1e-12) } else { 1e-12 }));
            }
        }
    }
}

/// Memory of the flow that is used again in every step.
#[derive(Clone, Debug, Default)]
pub(super) struct FlowState {
    /// Angle defect of each vertex.
    pub curvature: Vec<f64>,
    gammas: Vec<f64>,
    weights: Vec<f64>,
}

/// Edges to be checked, each at most once in the queue.
#[derive(Clone, Debug, Default)]
pub(super) struct FlipQueue {
    stack: Vec<HalfedgeId>,
    queued: Vec<bool>,
}

impl FlipQueue {
    fn fill(&mut self, triangulation: &IntrinsicTriangulation) {
        self.stack.clear();
        self.queued.resize(triangulation.halfedges().len(), false);
        self.queued.fill(false);
        triangulation.halfedges().filter(|&h| h < triangulation.twin(h)).for_each(|h| self.push(h));
    }

    /// A twin may be queued too: that costs a check, not a wrong flip.
    fn push(&mut self, h: HalfedgeId) {
        if !std::mem::replace(&mut self.queued[h.index()], true) {
            self.stack.push(h);
        }
    }

    fn pop(&mut self) -> Option<HalfedgeId> {
        let h = self.stack.pop()?;
        self.queued[h.index()] = false;
        Some(h)
    }
}

/// The thesis' initial radii (eq. 3.11): min over the faces ijk at i of (l_ij + l_ki - l_jk) / 2, times `scale`.
///
/// Circles of one edge then do not intersect. At an obtuse corner of a sliver the minimum is nearly 0, and inversive distances with such
/// circles are lost in rounding. So radii are kept above .05 of the vertex's shortest edge, or half of what the scale leaves free on it if
/// that is less: circles still do not intersect, since that of the other end takes `scale` of the edge at most. With a scale of 1, above 1e-7.
fn initial_radii(mesh: &SurfaceMesh, scale: f64) -> TiVec<VertexId, f64> {
    let mut radii: TiVec<VertexId, f64> = ti_vec![f64::INFINITY; mesh.vertex_count()];
    let mut shortest: TiVec<VertexId, f64> = ti_vec![f64::INFINITY; mesh.vertex_count()];
    for h in mesh.halfedges() {
        let v = mesh.tail(h);
        let [ij, jk, ki] = [h, h.next(), h.prev()].map(|x| mesh.length(x));
        radii[v] = radii[v].min(0.5 * (ij + (ki - jk)));
        shortest[v] = shortest[v].min(ij);
    }
    let least = max(min(0.5 * (1.0 - scale), 0.05), 1e-7);
    radii.iter().zip(&shortest).map(|(r, s)| max(scale * r, least * s)).collect()
}

/// Radii of circles that nearly touch: mean over the faces ijk at i of (l_ij + l_ki - l_jk) / 2, which is where the incircle touches
/// both edges at i (Jin et al. 2008). Above 1e-7 of the vertex's shortest edge.
fn mean_radii(mesh: &SurfaceMesh) -> TiVec<VertexId, f64> {
    let mut sums: TiVec<VertexId, (f64, f64)> = ti_vec![(0.0, 0.0); mesh.vertex_count()];
    let mut shortest: TiVec<VertexId, f64> = ti_vec![f64::INFINITY; mesh.vertex_count()];
    for h in mesh.halfedges() {
        let v = mesh.tail(h);
        let [ij, jk, ki] = [h, h.next(), h.prev()].map(|x| mesh.length(x));
        let (sum, count) = &mut sums[v];
        *sum += 0.5 * (ij + (ki - jk));
        *count += 1.0;
        shortest[v] = shortest[v].min(ij);
    }
    sums.iter().zip(&shortest).map(|((sum, count), s)| (sum / count).max(1e-7 * s)).collect()
}
