//! The flat cone surface M: the base domain's triangles made flat.

use crate::base_domain::BaseDomain;
use crate::landmarks::LandmarkId;
use crate::layout::{BaseLayout, PatchedMesh};
use crate::math::rigid2::Rigid2;
use crate::math::scalar::pow;
use crate::math::triangle;
use crate::mesh::{FaceId, HalfedgeId};
use glam::DVec2;
use typed_index_collections::TiVec;

/// A flat surface with cones at the landmarks only, one flat triangle (chart) per base face.
#[derive(Clone, Debug)]
pub struct ConeSurface {
    /// The base domain, for its connectivity.
    pub base: BaseDomain,
    /// Length of each base halfedge; twins agree.
    pub lengths: TiVec<HalfedgeId, f64>,
    /// Chart of each base face: its corners in the plane, counter-clockwise.
    pub charts: TiVec<FaceId, [DVec2; 3]>,
    /// For each base halfedge h the rigid motion from the chart of its face to the chart of its twin's face; it takes the
    /// side h of the first onto the side `twin(h)` of the second.
    pub transitions: TiVec<HalfedgeId, Rigid2>,
    /// Angle around each cone, in radians.
    pub cone_angles: TiVec<LandmarkId, f64>,
}

impl ConeSurface {
    /// The flat cone surface with the given edge lengths, one per base halfedge (twins equal), scaled to area 1.
    ///
    /// Every base face must satisfy the triangle inequality strictly.
    pub fn from_lengths(base: BaseDomain, mut lengths: TiVec<HalfedgeId, f64>) -> Self {
        let mesh = &base.mesh;
        let sides = |lengths: &TiVec<HalfedgeId, f64>, f: FaceId| f.halfedges().map(|h| lengths[h]);
        let area_of = |f| {
            let [a, b, c] = sides(&lengths, f);
            triangle::area_from_lengths(a, b, c)
        };
        let scale = 1.0 / mesh.faces().map(area_of).sum::<f64>().sqrt();
        lengths.iter_mut().for_each(|l| *l *= scale);
        let charts: TiVec<FaceId, _> = mesh.faces().map(|f| triangle::lay_out(sides(&lengths, f))).collect();
        let side = |h: HalfedgeId| {
            let chart = &charts[h.face()];
            [chart[h.corner()], chart[h.next().corner()]]
        };
        let transition = |h: HalfedgeId| {
            let [start, end] = side(mesh.twin(h));
            Rigid2::between_segments(side(h), [end, start])
        };
        let transitions = mesh.halfedges().map(transition).collect();
        let angle = |h: HalfedgeId| {
            let around = [lengths[h], lengths[h.prev()]];
            triangle::angle_from_lengths(lengths[h.next()], around)
        };
        let cone_angles = mesh.vertices().map(|v| mesh.star(v).map(angle).sum()).collect();
        Self { base, lengths, charts, transitions, cone_angles }
    }
}

impl ConeSurface {
    /// The cone surface of a layout: lengths are the means of the landmarks' chord lengths on source and target, or powers of them
    /// where three landmarks are in line on both meshes.
    pub fn of_layout(layout: &BaseLayout) -> Self {
        let mesh = &layout.base.mesh;
        let chord = |side: &PatchedMesh, h: HalfedgeId| {
            let [p, q] = [layout.base.tail(h), layout.base.head(h)]
                .map(|l| side.mesh.positions()[side.landmark_vertices[l]]);
            p.distance(q)
        };
        let mean = |h| 0.5 * (chord(&layout.source, h) + chord(&layout.target, h));
        let mut lengths: TiVec<HalfedgeId, f64> = mesh.halfedges().map(mean).collect();
        let is_flat = |f: FaceId| {
            let [a, b, c] = f.halfedges().map(|h| lengths[h]);
            let longest = a.max(b).max(c);
            triangle::area_from_lengths(a, b, c) < FLAT * longest * longest
        };
        if mesh.faces().any(is_flat) {
            lengths.iter_mut().for_each(|length| *length = pow(*length, BENT));
        }
        Self::from_lengths(layout.base.clone(), lengths)
    }
}

/// Area of a triangle, in units of its longest side squared, below which its corners are in line up to the digits of files.
const FLAT: f64 = 1e-7;

/// The exponent of the lengths where a triangle is flat. With an exponent below 1 every triangle inequality is strict, and those in
/// line with equal steps bend by 30 degrees. Chosen by hand.
const BENT: f64 = 0.95;
