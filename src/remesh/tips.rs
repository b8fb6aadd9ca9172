//! Ends of what is thin on the scale of the new edges: smoothing would let them shrink, so their last vertices stay.

use crate::math::scalar::max;
use crate::mesh::{SurfaceMesh, VertexId};
use glam::DVec3;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// The radius of the surface around a vertex by which it is judged a tip, in new edges. Chosen by hand.
const REACH: f64 = 1.5;
/// The least length of the mean unit direction from a tip to the surface around it. It is the cosine of half the angle of a cone:
/// 0.74 at the corner of a cube, 0.45 on its edges, 0 in the plane.
const POINTED: f64 = 0.65;

/// The vertices at tips of a surface, as they are seen with edges of a length: those where all of the surface around lies on one
/// side, more than for any vertex near.
pub(super) fn tips(surface: &SurfaceMesh, length: f64) -> Vec<VertexId> {
    let areas = surface.vertex_areas();
    let mut patches = Patches::new(surface, REACH * length);
    let pointed: TiVec<VertexId, f64> =
        surface.vertices().map(|v| pointedness(surface, &areas, v, &patches.around(v))).collect();
    let mut patches = Patches::new(surface, REACH * length);
    let mut is_tip = |&v: &VertexId| {
        let near = |w: VertexId| surface.positions()[w].distance(surface.positions()[v]) < REACH * length;
        // The first vertex is taken of equals.
        let more = |w: VertexId| pointed[w] > pointed[v] || (pointed[w] == pointed[v] && w < v);
        let beats = |&w: &VertexId| near(w) && more(w);
        pointed[v] > POINTED && !patches.around(v).iter().any(beats)
    };
    surface.vertices().filter(&mut is_tip).collect()
}

/// Length of the mean direction from a vertex to others by area.
fn pointedness(
    surface: &SurfaceMesh,
    areas: &TiSlice<VertexId, f64>,
    v: VertexId,
    around: &[VertexId],
) -> f64 {
    let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
    for &w in around {
        sum += areas[w] * (surface.positions()[w] - surface.positions()[v]).normalize_or_zero();
        weight += areas[w];
    }
    sum.length() / max(weight, f64::MIN_POSITIVE)
}

/// Vertices connected to one, within a distance of it, and all its neighbours.
struct Patches<'a> {
    surface: &'a SurfaceMesh,
    reach: f64,
    /// The centre of the last patch that each vertex was asked for.
    seen: TiVec<VertexId, VertexId>,
}

impl<'a> Patches<'a> {
    /// Each vertex may be asked for once.
    fn new(surface: &'a SurfaceMesh, reach: f64) -> Self {
        Self { surface, reach, seen: ti_vec![VertexId(u32::MAX); surface.vertex_count()] }
    }

    /// The vertices, without the centre.
    fn around(&mut self, centre: VertexId) -> Vec<VertexId> {
        let at = |v: VertexId| self.surface.positions()[v];
        let mut patch = vec![centre];
        let mut next = 0;
        while next < patch.len() {
            let v = patch[next];
            next += 1;
            for w in self.surface.star(v).map(|h| self.surface.head(h)) {
                let near = v == centre || at(w).distance(at(centre)) < self.reach;
                if w != centre && near && self.seen[w] != centre {
                    self.seen[w] = centre;
                    patch.push(w);
                }
            }
        }
        patch.swap_remove(0);
        patch
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::{icosphere, octahedron, tetrahedron};

    #[test]
    fn a_needle_has_two_tips_and_a_ball_none() {
        let ball = icosphere(4);
        assert!(tips(&ball, 0.1).is_empty());
        let thin = ball.positions().iter().map(|p| *p * DVec3::new(0.05, 1.0, 0.05)).collect();
        let needle = ball.with_positions(thin);
        let found = tips(&needle, 0.1);
        assert_eq!(found.len(), 2);
        assert!(found.iter().all(|&v| needle.positions()[v].y.abs() > 0.99));
    }

    #[test]
    fn corners_are_tips_where_they_are_sharp() {
        assert_eq!(tips(&tetrahedron(), 0.3).len(), 4);
        assert_eq!(tips(&octahedron(), 0.3).len(), 6);
    }
}
