//! A mesh with a flat cone metric developed into the plane, patch by patch.

use crate::cone_metric::ConeMetric;
use crate::cone_metric::atlas::mesh_displacements;
use crate::layout::PatchedMesh;
use crate::math::rigid2::{complex_mul, conj_mul};
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, HalfedgeId};
use glam::DVec2;
use typed_index_collections::{TiVec, ti_vec};

/// A face developed into the plane.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    /// The face.
    pub face: FaceId,
    /// Its corners in the plane.
    pub corners: [DVec2; 3],
}

/// A base face straight between its landmarks, positively oriented.
pub struct StraightTriangle {
    /// Its corners in the plane.
    pub corners: [DVec2; 3],
    /// A developed face at corner 0 into which the triangle opens.
    seed: Placed,
}

/// A refined mesh with a flat cone metric.
pub struct DevelopedMesh<'a> {
    patched: &'a PatchedMesh,
    /// Displacement along each halfedge in the frame of its face.
    along: TiVec<HalfedgeId, DVec2>,
    /// The development that placed each face last.
    placed_in: TiVec<FaceId, u32>,
    development: u32,
}

impl<'a> DevelopedMesh<'a> {
    /// No face is developed yet.
    pub fn new(patched: &'a PatchedMesh, metric: &ConeMetric) -> Self {
        let placed_in = ti_vec![0; patched.mesh.face_count()];
        Self { patched, along: mesh_displacements(metric), placed_in, development: 0 }
    }

    /// A face with the start of one of its halfedges at the origin, in its own frame.
    fn at_origin(&self, h: HalfedgeId) -> Placed {
        let mut corners = [DVec2::ZERO; 3];
        corners[h.next().corner()] = self.along[h];
        corners[h.prev().corner()] = -self.along[h.prev()];
        Placed { face: h.face(), corners }
    }

    /// The neighbour across side `k` of a developed face.
    fn across(&self, from: &Placed, k: usize) -> Placed {
        let t = self.patched.mesh.twin(HalfedgeId::of(from.face, k));
        let (start, end) = (from.corners[(k + 1) % 3], from.corners[k]);
        let turn = conj_mul(self.along[t], end - start).normalize_or(DVec2::X);
        let mut corners = [start; 3];
        corners[t.next().corner()] = end;
        corners[t.prev().corner()] = end + complex_mul(turn, self.along[t.next()]);
        Placed { face: t.face(), corners }
    }

    /// Develops breadth first from a face over all neighbours that are wanted; every face at most once.
    fn develop(&mut self, seed: Placed, wanted: impl Fn(&Placed) -> bool) -> Vec<Placed> {
        self.development += 1;
        self.placed_in[seed.face] = self.development;
        let mut region = vec![seed];
        let mut done = 0;
        while let Some(&from) = region.get(done) {
            done += 1;
            for k in 0..3 {
                let neighbour = self.patched.mesh.twin(HalfedgeId::of(from.face, k)).face();
                if self.placed_in[neighbour] == self.development {
                    continue;
                }
                let next = self.across(&from, k);
                if wanted(&next) {
                    self.placed_in[neighbour] = self.development;
                    region.push(next);
                }
            }
        }
        region
    }

    /// Develops a patch, a disc without cones inside; `None` when the triangle of its landmarks is not positive.
    pub fn straighten(&mut self, patch: FaceId) -> Option<StraightTriangle> {
        let patched = self.patched;
        let mut begin = [HalfedgeId(0); 3];
        for (k, h) in begin.iter_mut().enumerate() {
            let path = &patched.paths[HalfedgeId::of(patch, k)];
            *h = patched.mesh.halfedge_between(path[0], path[1])?;
        }
        let first = self.at_origin(begin[0]);
        let mut corners = [DVec2::NAN; 3];
        for placed in self.develop(first, |placed| patched.face_patch[placed.face] == patch) {
            for k in (0..3).filter(|&k| begin[k].face() == placed.face) {
                corners[k] = placed.corners[begin[k].corner()];
            }
        }
        let [a, b, c] = corners;
        let inwards = (b - a).normalize_or_zero() + (c - a).normalize_or_zero();
        let positive = signed_double_area(a, b, c) > 0.0;
        positive.then(|| StraightTriangle { corners, seed: self.towards(begin[0], first, inwards) })
    }

    /// The face around the start of `h` into which a direction points, on the side of `h` where it is nearer.
    fn towards(&self, h: HalfedgeId, first: Placed, direction: DVec2) -> Placed {
        let counter_clockwise = self.along[h].perp_dot(direction) >= 0.0;
        let found = self.turn(h, first, direction, counter_clockwise);
        found.or_else(|| self.turn(h, first, direction, !counter_clockwise)).unwrap_or(first)
    }

    /// Turns once around the start of `h`.
    fn turn(
        &self,
        h: HalfedgeId,
        first: Placed,
        direction: DVec2,
        counter_clockwise: bool,
    ) -> Option<Placed> {
        let mesh = &self.patched.mesh;
        let (mut at, mut placed) = (h, first);
        loop {
            let side = |x: HalfedgeId| placed.corners[x.corner()] - placed.corners[at.corner()];
            let (right, left) = (side(at.next()), side(at.prev()));
            if right.perp_dot(left) > 0.0
                && right.perp_dot(direction) >= 0.0
                && direction.perp_dot(left) >= 0.0
            {
                return Some(placed);
            }
            if counter_clockwise {
                placed = self.across(&placed, at.prev().corner());
                at = mesh.twin(at.prev());
            } else {
                placed = self.across(&placed, at.corner());
                at = mesh.twin(at).next();
            }
            if at == h {
                return None;
            }
        }
    }

    /// The developed faces over a straight triangle.
    pub fn region(&mut self, straight: &StraightTriangle) -> Vec<Placed> {
        self.develop(straight.seed, |placed| overlap(&straight.corners, &placed.corners))
    }
}

/// Whether a positive triangle and another one have more than their borders in common.
///
/// Touching is not enough: around a landmark all faces touch the triangle, and growing over them would turn around the cone.
fn overlap(triangle: &[DVec2; 3], other: &[DVec2; 3]) -> bool {
    let sign = if signed_double_area(other[0], other[1], other[2]) < 0.0 { -1.0 } else { 1.0 };
    let size = |of: &[DVec2; 3]| {
        let [low, high] = bounds(of);
        (high - low).max_element()
    };
    // Faces near a cone can be smaller than the triangle by many orders: the tolerance is relative to both, beyond rounding.
    let (large, small) = (size(triangle), size(other));
    // 1e-15 is the rounding of coordinates of the larger one's size; 1e-9 was chosen by hand.
    let grain = 1e-9 * large * small + 1e-15 * large * large;
    let apart = |of: &[DVec2; 3], from: &[DVec2; 3], sign: f64| {
        (0..3).any(|k| from.iter().all(|&p| sign * signed_double_area(of[k], of[(k + 1) % 3], p) <= grain))
    };
    !apart(triangle, other, 1.0) && !apart(other, triangle, sign)
}

/// The lower left and the upper right corner of a triangle's bounding box.
pub fn bounds(&[a, b, c]: &[DVec2; 3]) -> [DVec2; 2] {
    [a.min(b).min(c), a.max(b).max(c)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_that_share_a_corner_or_a_side_do_not_overlap() {
        let triangle = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let beside = [DVec2::ZERO, DVec2::NEG_Y, DVec2::X];
        let corner = [DVec2::ZERO, DVec2::NEG_X, DVec2::NEG_Y];
        let turned = [DVec2::new(0.2, 0.2), DVec2::new(0.2, 2.0), DVec2::new(2.0, 0.2)];
        assert!(!overlap(&triangle, &beside) && !overlap(&triangle, &corner));
        assert!(overlap(&triangle, &turned) && overlap(&triangle, &triangle));
    }
}
