//! The certificate: a parametrisation onto the cone surface is a homeomorphism.
//!
//! Every triangle positively oriented, the angle sum 2 pi at every ordinary vertex and the cone angle at every landmark,
//! and the corners' copies joined by the fixed transitions: then the map is a local homeomorphism between spheres, hence a
//! homeomorphism. Positive triangles alone prove nothing (double covers), nor does the total area. Computed from the
//! result alone, independently of the optimiser.

use super::cone_surface::ConeSurface;
use super::embedding::Embedding;
use crate::layout::PatchedMesh;
use crate::math::rigid2::Rigid2;
use crate::math::scalar::atan2;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use glam::DVec2;
use robust::{Coord, orient2d};
use std::f64::consts::TAU;
use typed_index_collections::{TiVec, ti_vec};

/// Largest angle sum error, in radians, and largest position error, in units of sqrt(area), of a homeomorphism.
///
/// A wrong angle sum is off by 2 pi at least, so the bound only has to be above rounding.
const TOLERANCE: f64 = 1e-6;

/// Whether a parametrisation is a homeomorphism, with the numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certificate {
    /// Whether it is.
    pub bijective: bool,
    /// Triangles that are not positively oriented (robust predicate).
    pub flipped_triangles: usize,
    /// Largest |angle sum - 2 pi| (minus the cone angle at landmarks), in radians.
    pub max_angle_sum_error: f64,
    /// Largest distance of a landmark from its chart corner.
    pub max_landmark_error: f64,
    /// Largest distance between an edge seen from one side, carried over by the transition, and from the other.
    pub max_transition_error: f64,
}

impl Certificate {
    /// Both parametrisations together.
    pub fn and(&self, other: &Self) -> Self {
        Self {
            bijective: self.bijective && other.bijective,
            flipped_triangles: self.flipped_triangles + other.flipped_triangles,
            max_angle_sum_error: self.max_angle_sum_error.max(other.max_angle_sum_error),
            max_landmark_error: self.max_landmark_error.max(other.max_landmark_error),
            max_transition_error: self.max_transition_error.max(other.max_transition_error),
        }
    }
}

/// Checks a parametrisation.
pub fn certify(patched: &PatchedMesh, surface: &ConeSurface, embedding: &Embedding) -> Certificate {
    let mesh = &patched.mesh;
    let flipped_triangles = mesh.faces().filter(|&f| !is_positive(corners(embedding, f))).count();
    let mut sums: TiVec<VertexId, f64> = ti_vec![0.0; mesh.vertex_count()];
    for h in mesh.halfedges() {
        let [p, q, r] = [h, h.next(), h.prev()].map(|c| embedding.corners[c]);
        sums[mesh.tail(h)] += atan2((q - p).perp_dot(r - p), (q - p).dot(r - p));
    }
    let mut full = ti_vec![TAU; mesh.vertex_count()];
    for (landmark, &v) in patched.landmark_vertices.iter_enumerated() {
        full[v] = surface.cone_angles[landmark];
    }
    let errors = sums.iter().zip(&full).map(|(sum, full)| (sum - full).abs());
    let max_angle_sum_error = errors.fold(0.0, nan_max);
    let max_landmark_error = landmark_error(patched, surface, embedding);
    let max_transition_error = transition_error(patched, surface, embedding);
    let worst = nan_max(nan_max(max_angle_sum_error, max_landmark_error), max_transition_error);
    let bijective = flipped_triangles == 0 && worst <= TOLERANCE;
    Certificate {
        bijective,
        flipped_triangles,
        max_angle_sum_error,
        max_landmark_error,
        max_transition_error,
    }
}

/// The larger one; NaN wins, so that it is never taken for a small error.
fn nan_max(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

fn corners(embedding: &Embedding, f: FaceId) -> [DVec2; 3] {
    [0, 1, 2].map(|k| embedding.corners[HalfedgeId::of(f, k)])
}

fn is_positive(corners: [DVec2; 3]) -> bool {
    let [p, q, r] = corners.map(|c| Coord { x: c.x, y: c.y });
    orient2d(p, q, r) > 0.0
}

fn landmark_error(patched: &PatchedMesh, surface: &ConeSurface, embedding: &Embedding) -> f64 {
    let mut worst = 0.0;
    for (landmark, &v) in patched.landmark_vertices.iter_enumerated() {
        for h in patched.mesh.star(v) {
            let chart = embedding.face_chart[h.face()];
            let corner = surface.base.mesh.triangles()[chart].iter().position(|&l| l == landmark);
            let distance =
                corner.map_or(f64::INFINITY, |k| embedding.corners[h].distance(surface.charts[chart][k]));
            worst = nan_max(worst, distance);
        }
    }
    worst
}

fn transition_error(patched: &PatchedMesh, surface: &ConeSurface, embedding: &Embedding) -> f64 {
    let mesh = &patched.mesh;
    let mut worst = 0.0;
    for h in mesh.edges() {
        let t = mesh.twin(h);
        let motion =
            transition_between(surface, embedding.face_chart[h.face()], embedding.face_chart[t.face()]);
        let Some(motion) = motion else { return f64::INFINITY };
        let ends = [(h, t.next()), (h.next(), t)];
        for (here, there) in ends {
            worst = nan_max(worst, motion.apply(embedding.corners[here]).distance(embedding.corners[there]));
        }
    }
    worst
}

fn transition_between(surface: &ConeSurface, here: FaceId, there: FaceId) -> Option<Rigid2> {
    if here == there {
        return Some(Rigid2::IDENTITY);
    }
    let sides = (0..3).map(|k| HalfedgeId::of(here, k));
    sides.into_iter().find(|&b| surface.base.mesh.twin(b).face() == there).map(|b| surface.transitions[b])
}
