//! The overlay: the common subdivision of source and target on the cone surface. It is the map.
//!
//! Every source triangle is met with the target triangles below it, developed into its plane: the pieces are convex
//! polygons on which the map is affine. Their areas sum to the areas of both surfaces, which is measured.

use super::compose::{Locations, Parametrised, barycentric_in};
use crate::math::rigid2::Rigid2;
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, HalfedgeId};
use glam::DVec2;

/// Pieces of the common subdivision.
#[derive(Clone, Debug, Default)]
pub struct Overlay {
    /// One convex polygon per pair of overlapping triangles.
    pub pieces: Vec<Piece>,
    /// Corners of all pieces.
    pub points: Vec<OverlayPoint>,
    /// Largest relative difference between a source triangle's area on the cone surface and the sum of its pieces.
    pub area_defect: f64,
}

/// A convex polygon inside one source triangle and one target triangle.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Face of the refined source.
    pub source_face: FaceId,
    /// Face of the refined target.
    pub target_face: FaceId,
    /// Its corners in [`Overlay::points`], counter-clockwise.
    pub points: std::ops::Range<usize>,
    /// Area on the cone surface.
    pub area: f64,
    /// From the chart plane of the source face to that of the target face.
    pub motion: Rigid2,
}

/// A corner of a piece: the same point of the cone surface on both meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverlayPoint {
    /// Barycentric coordinates in the source face.
    pub source: [f64; 3],
    /// Barycentric coordinates in the target face.
    pub target: [f64; 3],
}

/// Intersects every source triangle with the target triangles.
pub fn overlay(source: Parametrised<'_>, target: Parametrised<'_>, locations: &Locations) -> Overlay {
    let mut overlay = Overlay::default();
    let mut clipper = Clipper::default();
    for f in source.patched.mesh.faces() {
        let triangle = corners(source, f);
        let covered = clipper.cover(&mut overlay, target, f, (triangle, locations));
        let area = 0.5 * signed_double_area(triangle[0], triangle[1], triangle[2]);
        overlay.area_defect = overlay.area_defect.max((covered - area).abs() / area);
    }
    overlay
}

fn corners(side: Parametrised<'_>, f: FaceId) -> [DVec2; 3] {
    [0, 1, 2].map(|k| side.embedding.corners[HalfedgeId::of(f, k)])
}

#[derive(Default)]
struct Clipper {
    /// Target faces met, each with its place in the source face's plane: round a cone a face can be met twice.
    visited: Vec<(FaceId, Rigid2)>,
    stack: Vec<(FaceId, Rigid2)>,
    polygon: Vec<DVec2>,
    clipped: Vec<DVec2>,
}

impl Clipper {
    /// Adds the pieces of one source triangle, by flooding over the target triangles that it meets; returns their area.
    fn cover(
        &mut self,
        overlay: &mut Overlay,
        target: Parametrised<'_>,
        source_face: FaceId,
        (triangle, locations): ([DVec2; 3], &Locations),
    ) -> f64 {
        let seed = &locations.by_face[source_face];
        let whole = 0.5 * signed_double_area(triangle[0], triangle[1], triangle[2]);
        self.visited.clear();
        self.stack.clear();
        self.stack.push((seed.face, seed.motion));
        self.visited.push((seed.face, seed.motion));
        let mut covered = 0.0;
        while let Some((face, motion)) = self.stack.pop() {
            let below = corners(target, face);
            let back = motion.inverse();
            let developed = below.map(|p| back.apply(p));
            self.clip(&triangle, &developed);
            let area = polygon_area(&self.polygon);
            let below_area = 0.5 * signed_double_area(below[0], below[1], below[2]);
            if area > 1e-12 * whole.min(below_area) {
                covered += area;
                let begin = overlay.points.len();
                overlay.points.extend(self.polygon.iter().map(|&p| OverlayPoint {
                    source: barycentric_in(triangle, p),
                    target: barycentric_in(below, motion.apply(p)),
                }));
                let points = begin..overlay.points.len();
                overlay.pieces.push(Piece { source_face, target_face: face, points, area, motion });
            }
            for k in 0..3 {
                let h = HalfedgeId::of(face, k);
                let twin = target.patched.mesh.twin(h);
                if !meets(&triangle, [developed[k], developed[(k + 1) % 3]]) {
                    continue;
                }
                let next = (twin.face(), target.embedding.transitions[h].after(&motion));
                if !self.knows(&next) {
                    self.visited.push(next);
                    self.stack.push(next);
                }
            }
        }
        covered
    }

    /// Whether a place of a face was met, or the face already so often as a triangle can meet it round the sharpest cone.
    fn knows(&self, next: &(FaceId, Rigid2)) -> bool {
        const TURNS: usize = 8;
        let mut turns = 0;
        self.visited.iter().filter(|seen| seen.0 == next.0).any(|seen| {
            turns += 1;
            turns == TURNS || is_same(seen, next)
        })
    }

    /// The polygon of one triangle inside another.
    fn clip(&mut self, triangle: &[DVec2; 3], window: &[DVec2; 3]) {
        self.polygon.clear();
        self.polygon.extend_from_slice(triangle);
        for k in 0..3 {
            let (a, b) = (window[k], window[(k + 1) % 3]);
            let side = |p: DVec2| signed_double_area(a, b, p);
            self.clipped.clear();
            for i in 0..self.polygon.len() {
                let (p, q) = (self.polygon[i], self.polygon[(i + 1) % self.polygon.len()]);
                let (sp, sq) = (side(p), side(q));
                if sp >= 0.0 {
                    self.clipped.push(p);
                }
                if (sp > 0.0 && sq < 0.0) || (sp < 0.0 && sq > 0.0) {
                    self.clipped.push(p + (q - p) * (sp / (sp - sq)));
                }
            }
            std::mem::swap(&mut self.polygon, &mut self.clipped);
        }
    }
}

/// Whether two places of faces are the same up to rounding.
fn is_same(a: &(FaceId, Rigid2), b: &(FaceId, Rigid2)) -> bool {
    a.0 == b.0
        && a.1.rotation.distance_squared(b.1.rotation) < 1e-12
        && a.1.translation.distance_squared(b.1.translation) < 1e-12
}

/// Whether a segment runs inside a triangle or along its border, for more than a point: touching the corner at a cone
/// must not lead around the cone.
fn meets(triangle: &[DVec2; 3], [p, q]: [DVec2; 2]) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for k in 0..3 {
        let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
        let slack = 1e-14 * (b - a).length();
        let (sp, sq) = (signed_double_area(a, b, p) + slack, signed_double_area(a, b, q) + slack);
        if sp < 0.0 && sq < 0.0 {
            return false;
        }
        if sp < 0.0 {
            from = from.max(sp / (sp - sq));
        } else if sq < 0.0 {
            to = to.min(sp / (sp - sq));
        }
    }
    (to - from) * p.distance(q) > 1e-9 * triangle[0].distance(triangle[1])
}

fn polygon_area(polygon: &[DVec2]) -> f64 {
    let Some((&origin, rest)) = polygon.split_first() else { return 0.0 };
    0.5 * rest.windows(2).map(|w| (w[0] - origin).perp_dot(w[1] - origin)).sum::<f64>()
}
