//! Parts of a base that the map does not know: eyes and teeth that are surfaces of their own, vertices without a face.
//!
//! Each part keeps its shape: it is turned, scaled and moved as the base's surface is near it.

use crate::math::rigid3::{Rigid3, agreement, best_rotation, outer};
use crate::math::scalar::max;
use crate::mesh::{SurfaceMesh, VertexId};
use glam::{DMat3, DVec3};
use typed_index_collections::TiVec;

/// The largest number of parts that are moved one by one; more move as the base as a whole does. Chosen by hand.
const MOST_PARTS: usize = 256;

/// The motion by which loose parts follow a laid base.
pub struct LooseParts<'a> {
    base: &'a SurfaceMesh,
    onto: &'a TiVec<VertexId, DVec3>,
    areas: TiVec<VertexId, f64>,
    whole: Similarity,
    /// Number of parts so far.
    parts: usize,
}

/// The similarity p -> s R p + t.
#[derive(Clone, Copy)]
struct Similarity {
    scale: f64,
    motion: Rigid3,
}

impl Similarity {
    fn apply(&self, p: DVec3) -> DVec3 {
        self.motion.apply(p * self.scale)
    }
}

impl<'a> LooseParts<'a> {
    /// The base with the new places of its vertices.
    pub fn new(base: &'a SurfaceMesh, onto: &'a TiVec<VertexId, DVec3>) -> Self {
        let areas = base.vertex_areas();
        let starts = [
            DVec3::ONE,
            DVec3::new(1.0, -1.0, -1.0),
            DVec3::new(-1.0, 1.0, -1.0),
            DVec3::new(-1.0, -1.0, 1.0),
        ];
        let starts = starts.map(DMat3::from_diagonal);
        let whole = fitted(base, onto, |v| areas[v], &starts);
        Self { base, onto, areas, whole, parts: 0 }
    }

    /// The places of a part's points.
    pub fn moved(&mut self, part: &[DVec3]) -> Vec<DVec3> {
        self.parts += 1;
        let similarity = if self.parts > MOST_PARTS { self.whole } else { self.near(part) };
        part.iter().map(|p| similarity.apply(*p)).collect()
    }

    /// The similarity by which the surface near a part moves; vertices within the size of the part count most.
    fn near(&self, part: &[DVec3]) -> Similarity {
        let middle = part.iter().sum::<DVec3>() / part.len().max(1) as f64;
        let size = part.iter().map(|p| p.distance(middle)).fold(0.0, max);
        let nearest = self.base.positions().iter().map(|p| p.distance(middle)).fold(f64::INFINITY, f64::min);
        let reach = max(max(size, nearest), 1e-3 * self.base.area().sqrt());
        let weight = |v: VertexId| {
            let far = 1.0 + self.base.positions()[v].distance_squared(middle) / (reach * reach);
            self.areas[v] / (far * far * far)
        };
        fitted(self.base, self.onto, weight, &[self.whole.motion.rotation])
    }
}

/// The similarity that takes the base's vertices nearest to their new places, from the best of some rotations on.
fn fitted(
    base: &SurfaceMesh,
    onto: &TiVec<VertexId, DVec3>,
    weight: impl Fn(VertexId) -> f64,
    starts: &[DMat3],
) -> Similarity {
    let at = base.positions();
    let (mut sum, mut from, mut to) = (0.0, DVec3::ZERO, DVec3::ZERO);
    for v in base.vertices() {
        let w = weight(v);
        (sum, from, to) = (sum + w, from + at[v] * w, to + onto[v] * w);
    }
    let (from, to) = (from / sum, to / sum);
    let (mut matrix, mut square) = (DMat3::ZERO, 0.0);
    for v in base.vertices() {
        let w = weight(v);
        matrix += outer((onto[v] - to) * w, at[v] - from);
        square += w * at[v].distance_squared(from);
    }
    let best = best_rotation(&matrix, starts.iter().copied());
    let scale = max(agreement(&best, &matrix), 0.0) / max(square, f64::MIN_POSITIVE);
    Similarity { scale, motion: Rigid3::with_point(best, from * scale, to) }
}
