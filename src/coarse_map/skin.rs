//! The weights of the faces of a level, where the full mesh has caps.

use crate::math::barycentric::interpolated;
use crate::mesh::coarsening::Level;
use crate::mesh::face_weights::{FaceWeight, FaceWeights};
use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{FaceId, SurfaceMesh};
use glam::DVec3;
use std::cell::RefCell;
use std::collections::BTreeMap;
use typed_index_collections::{TiSlice, TiVec};

/// A full mesh with caps, with the weights of its faces.
pub struct Skin<'a> {
    weights: &'a TiSlice<FaceId, FaceWeight>,
    index: SurfaceIndex<'a>,
    /// The weights on the levels that were asked for, by their numbers of vertices: every map of the mesh passes the same levels.
    known: RefCell<BTreeMap<usize, TiVec<FaceId, FaceWeight>>>,
}

/// Places in a coarse face at which the full mesh's weights are sampled: the middles of its quarters, in barycentric coordinates.
const SAMPLES: [[f64; 3]; 4] = {
    const SIXTH: f64 = 1.0 / 6.0;
    const THIRD: f64 = 1.0 / 3.0;
    [
        [THIRD, THIRD, THIRD],
        [4.0 * SIXTH, SIXTH, SIXTH],
        [SIXTH, 4.0 * SIXTH, SIXTH],
        [SIXTH, SIXTH, 4.0 * SIXTH],
    ]
};

impl<'a> Skin<'a> {
    /// A mesh with the weights of its faces.
    pub fn new(mesh: &'a SurfaceMesh, weights: &'a TiSlice<FaceId, FaceWeight>) -> Self {
        Self { weights, index: SurfaceIndex::new(mesh), known: RefCell::default() }
    }

    /// The weights of the full mesh's faces.
    pub fn weights(&self) -> FaceWeights<'a> {
        FaceWeights::new(Some(self.weights))
    }

    /// The weights of the faces of a level of the mesh: each the mean of the nearest full faces at four places.
    pub fn on_level(&self, level: &Level) -> TiVec<FaceId, FaceWeight> {
        if level.mesh.face_count() == self.weights.len() {
            return level.faces.iter().map(|&f| self.weights[f]).collect();
        }
        let count = level.mesh.vertex_count();
        self.known.borrow_mut().entry(count).or_insert_with(|| self.sampled(level)).clone()
    }

    /// The weights of the faces of a level, sampled on the full mesh.
    fn sampled(&self, level: &Level) -> TiVec<FaceId, FaceWeight> {
        let weight = |f: FaceId| {
            let [a, b, c] = level.mesh.corners(f);
            let normal: DVec3 = (b - a).cross(c - a);
            let at = |weights: [f64; 3]| {
                let place = interpolated([a, b, c], weights);
                self.weights[self.index.nearest_facing(place, normal, level.faces[f]).point.face]
            };
            let seen = SAMPLES.map(at);
            let mean = |of: fn(&FaceWeight) -> f64| 0.25 * seen.iter().map(of).sum::<f64>();
            FaceWeight { weight: mean(|w| w.weight), toll: mean(|w| w.toll) }
        };
        level.mesh.faces().map(weight).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;

    #[test]
    fn coarse_faces_count_by_what_lies_under_them() {
        let ball = icosphere(4);
        let is_cap = |f: FaceId| ball.corners(f).iter().all(|p| p.z > 0.7);
        let of_cap = FaceWeight { weight: 0.01, toll: 2.0 };
        let weights: TiVec<FaceId, FaceWeight> =
            ball.faces().map(|f| if is_cap(f) { of_cap } else { FaceWeight::SKIN }).collect();
        let skin = Skin::new(&ball, &weights);
        let level = Level::coarse(&ball, &[], 300, &mut Silent).unwrap();
        let coarse = skin.on_level(&level);
        let area = |f: FaceId| level.mesh.face_area(f);
        let share = |mesh: &SurfaceMesh, weights: &TiVec<FaceId, FaceWeight>| {
            mesh.faces().map(|f| (1.0 - weights[f].weight) * mesh.face_area(f)).sum::<f64>() / mesh.area()
        };
        assert!(level.mesh.face_count() < 700);
        let [whole, seen] = [share(&ball, &weights), share(&level.mesh, &coarse)];
        assert!((seen / whole - 1.0).abs() < 0.1, "{seen} {whole}");
        for f in level.mesh.faces().filter(|&f| area(f) > 0.0) {
            let heights = level.mesh.corners(f).map(|p| p.z);
            assert!(heights.iter().any(|z| *z > 0.6) || coarse[f] == FaceWeight::SKIN);
            assert!(heights.iter().any(|z| *z < 0.75) || coarse[f].weight < 0.02);
            // The same share of both.
            assert!(((1.0 - coarse[f].weight) / 0.99 - coarse[f].toll / 2.0).abs() < 1e-12);
        }
        let full = Level::coarse(&ball, &[], ball.vertex_count(), &mut Silent).unwrap();
        assert_eq!(skin.on_level(&full), weights);
    }
}
