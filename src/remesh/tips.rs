//! Ends of what is thin on the scale of the new edges: smoothing would let them shrink, so their last vertices stay.

use crate::math::scalar::max;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Pulse};
use glam::DVec3;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// The radius of the surface around a vertex by which it is judged a tip, in new edges. Chosen by hand.
const REACH: f64 = 1.5;
/// The least length of the mean unit direction from a tip to the surface around it. It is the cosine of half the angle of a cone:
/// 0.74 at the corner of a cube, 0.45 on its edges, 0 in the plane.
const POINTED: f64 = 0.65;
/// So many vertices of a patch take about as long as a pass of the loops that share a pulse.
const VISITS: usize = 64;

/// The radius of the surface around a centre for which it is judged first, in new edges. Chosen by hand.
const SPREAD: f64 = 1.0 / 6.0;
/// The surface around a centre has no tips where the centre falls short of one by more than this: nine bodies of 10,000 to 97,000 faces,
/// remeshed to 500 and 5,000, lose none. Chosen by hand.
const MARGIN: f64 = 0.35;

/// The vertices at tips of a surface, as they are seen with edges of a length: those where all of the surface around lies on one
/// side, more than for any vertex near.
///
/// On a surface that is much finer than the new edges only those vertices are judged whose centre is nearly a tip: the surface around
/// the others is nearly the centre's, and on the bodies that were tried ([`MARGIN`]) they are no tips.
pub(super) fn tips(
    surface: &SurfaceMesh,
    length: f64,
    pulse: &mut Pulse<'_>,
) -> Result<Vec<VertexId>, Cancelled> {
    let areas = surface.vertex_areas();
    let mut patches = Patches::new(surface, REACH * length);
    let mut pointed: TiVec<VertexId, Option<f64>> = ti_vec![None; surface.vertex_count()];
    let mut judged = |v: VertexId, pulse: &mut Pulse<'_>| {
        let around = patches.around(v);
        pulse.beat_by(1 + around.len() / VISITS)?;
        Ok::<_, Cancelled>(pointedness(surface, &areas, v, &around))
    };
    let centres = centres(surface, SPREAD * length, pulse)?;
    for v in surface.vertices().filter(|&v| centres[v] == v) {
        pointed[v] = Some(judged(v, pulse)?);
    }
    for v in surface.vertices() {
        let is_near_tip = pointed[centres[v]].is_none_or(|centre| centre > POINTED - MARGIN);
        if pointed[v].is_none() && is_near_tip {
            pointed[v] = Some(judged(v, pulse)?);
        }
    }
    let pointed: TiVec<VertexId, f64> = pointed.into_iter().map(|known| known.unwrap_or(0.0)).collect();
    let mut patches = Patches::new(surface, REACH * length);
    let mut tips = Vec::new();
    for v in surface.vertices().filter(|&v| pointed[v] > POINTED) {
        let near = |w: VertexId| surface.positions()[w].distance(surface.positions()[v]) < REACH * length;
        // The first vertex is taken of equals.
        let more = |w: VertexId| pointed[w] > pointed[v] || (pointed[w] == pointed[v] && w < v);
        let around = patches.around(v);
        pulse.beat_by(1 + around.len() / VISITS)?;
        if !around.iter().any(|&w| near(w) && more(w)) {
            tips.push(v);
        }
    }
    Ok(tips)
}

/// The centre of each vertex: the first one within a distance of it along the surface, or a centre itself.
fn centres(
    surface: &SurfaceMesh,
    distance: f64,
    pulse: &mut Pulse<'_>,
) -> Result<TiVec<VertexId, VertexId>, Cancelled> {
    const NONE: VertexId = VertexId(u32::MAX);
    let mut patches = Patches::new(surface, distance);
    let mut centres = ti_vec![NONE; surface.vertex_count()];
    for v in surface.vertices() {
        if centres[v] != NONE {
            continue;
        }
        centres[v] = v;
        let around = patches.around(v);
        pulse.beat_by(1 + around.len() / VISITS)?;
        for w in around {
            let is_near = surface.positions()[w].distance(surface.positions()[v]) < distance;
            if is_near && centres[w] == NONE {
                centres[w] = v;
            }
        }
    }
    Ok(centres)
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
    use crate::monitor::Silent;

    fn found(surface: &SurfaceMesh, length: f64) -> Vec<VertexId> {
        tips(surface, length, &mut Pulse::new(&mut Silent, 1)).unwrap()
    }

    #[test]
    fn a_needle_has_two_tips_and_a_ball_none() {
        let ball = icosphere(4);
        assert!(found(&ball, 0.1).is_empty());
        let thin = ball.positions().iter().map(|p| *p * DVec3::new(0.05, 1.0, 0.05)).collect();
        let needle = ball.with_positions(thin);
        let found = found(&needle, 0.1);
        assert_eq!(found.len(), 2);
        assert!(found.iter().all(|&v| needle.positions()[v].y.abs() > 0.99));
    }

    #[test]
    fn corners_are_tips_where_they_are_sharp() {
        assert_eq!(found(&tetrahedron(), 0.3).len(), 4);
        assert_eq!(found(&octahedron(), 0.3).len(), 6);
    }

    /// A ball with spikes, some of them beside each other.
    fn spiky(level: usize) -> SurfaceMesh {
        let ball = icosphere(level);
        let ends = [DVec3::X, DVec3::Y, DVec3::new(1.0, 0.4, 0.0), DVec3::new(-1.0, 0.3, 0.5)];
        let spiked = |p: &DVec3| {
            let nearest = ends.iter().map(|end| p.distance(end.normalize())).fold(f64::INFINITY, f64::min);
            *p * (1.0 + max(0.0, 0.25 - nearest) * 4.0)
        };
        ball.with_positions(ball.positions().iter().map(spiked).collect())
    }

    #[test]
    fn the_tips_are_those_of_all_vertices_that_are_judged() {
        let mut count = 0;
        for surface in [spiky(4), spiky(5), icosphere(4)] {
            for length in [0.05, 0.1, 0.2, 0.4, 0.6] {
                let areas = surface.vertex_areas();
                let mut patches = Patches::new(&surface, REACH * length);
                let pointed: TiVec<VertexId, f64> = surface
                    .vertices()
                    .map(|v| pointedness(&surface, &areas, v, &patches.around(v)))
                    .collect();
                let mut patches = Patches::new(&surface, REACH * length);
                let is_tip = |v: &VertexId| {
                    let at = |w: VertexId| surface.positions()[w];
                    let beats = |&w: &VertexId| {
                        at(w).distance(at(*v)) < REACH * length
                            && (pointed[w] > pointed[*v] || (pointed[w] == pointed[*v] && w < *v))
                    };
                    pointed[*v] > POINTED && !patches.around(*v).iter().any(beats)
                };
                let expected: Vec<VertexId> = surface.vertices().filter(is_tip).collect();
                assert_eq!(found(&surface, length), expected, "{length}");
                count += expected.len();
            }
        }
        assert!(count > 20, "{count}");
    }
}
