//! Images and preimages of points under a correspondence.
//!
//! A point is looked up among the pieces of its face by exact orientation tests on the weights as they are stored; corners are
//! shared by neighbouring pieces, so that a point lies between pieces only by rounding on a face's border, where the nearest piece
//! is taken. Both directions use the same pieces and matrices, so that one is the inverse of the other up to rounding.

use super::by_face::PiecesByFace;
use super::pieces::{Correspondence, MappedPiece, share};
use crate::landmarks::MeshSide;
use crate::math::predicates::orient2d;
use crate::mesh::{SurfaceMesh, SurfacePoint};
use glam::DVec2;

/// The map as a function of points.
#[derive(Clone, Debug)]
pub struct PointLocator<'a> {
    meshes: [&'a SurfaceMesh; 2],
    map: &'a Correspondence,
    pieces: [PiecesByFace; 2],
}

impl<'a> PointLocator<'a> {
    /// The map between source and target; it must have passed [`super::check`] with them.
    pub fn new(meshes: [&'a SurfaceMesh; 2], map: &'a Correspondence) -> Self {
        let pieces = MeshSide::BOTH.map(|side| PiecesByFace::new(map, side, meshes[side].face_count()));
        Self { meshes, map, pieces }
    }

    /// The target point that belongs to a source point.
    ///
    /// # Panics
    /// When the face does not exist.
    pub fn image(&self, point: SurfacePoint) -> SurfacePoint {
        self.carried(MeshSide::Source, point)
    }

    /// The source point that belongs to a target point.
    ///
    /// # Panics
    /// When the face does not exist.
    pub fn preimage(&self, point: SurfacePoint) -> SurfacePoint {
        self.carried(MeshSide::Target, point)
    }

    /// The number of the piece that holds a point of one mesh.
    ///
    /// # Panics
    /// When the face does not exist.
    pub fn piece(&self, side: MeshSide, point: SurfacePoint) -> usize {
        let q = DVec2::new(point.barycentric[1], point.barycentric[2]);
        let here = self.pieces[side].of(point.face);
        let mut nearest = (f64::INFINITY, here[0]);
        let mut ring = Vec::new();
        for &k in here {
            self.map.ring(self.meshes[side], side, &self.map.pieces[k as usize], &mut ring);
            let outside = distance_outside(&ring, q);
            if outside < nearest.0 {
                nearest = (outside, k);
            }
            if outside == 0.0 {
                break;
            }
        }
        nearest.1 as usize
    }

    /// The point of the other mesh that belongs to a point of one.
    ///
    /// # Panics
    /// When the face does not exist.
    pub fn carried(&self, side: MeshSide, point: SurfacePoint) -> SurfacePoint {
        let q = DVec2::new(point.barycentric[1], point.barycentric[2]);
        let piece = &self.map.pieces[self.piece(side, point)];
        let matrix = piece.map_from(side);
        let [here, there] = self.nearest_corner(side, piece, q);
        let image = there + matrix * (q - here);
        SurfacePoint::clamped(piece.faces[side.other()], [1.0 - image.x - image.y, image.x, image.y])
    }

    /// The piece's corner nearest to q on one mesh, and the same corner on the other mesh. Extending the affine map from it rounds least,
    /// and a corner is mapped exactly onto its image.
    fn nearest_corner(&self, side: MeshSide, piece: &MappedPiece, q: DVec2) -> [DVec2; 2] {
        let mut rings = [Vec::new(), Vec::new()];
        for side in MeshSide::BOTH {
            self.map.ring(self.meshes[side], side, piece, &mut rings[side]);
        }
        let [here, there] = [&rings[side], &rings[side.other()]];
        let nearest = (0..here.len().min(there.len()))
            .min_by(|&i, &j| here[i].distance_squared(q).total_cmp(&here[j].distance_squared(q)));
        nearest.map_or([DVec2::ZERO; 2], |k| [here[k], there[k]])
    }
}

/// 0 for points inside a counter-clockwise convex polygon or on its border, by the exact predicate; for others the largest distance
/// beyond the line of a side. Infinite for polygons without area.
fn distance_outside(ring: &[DVec2], q: DVec2) -> f64 {
    if share(ring) <= 0.0 {
        return f64::INFINITY;
    }
    let mut farthest: f64 = 0.0;
    for k in 0..ring.len() {
        let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
        let length = a.distance(b);
        if length == 0.0 {
            continue;
        }
        let turn = orient2d(a, b, q);
        if turn < 0.0 {
            farthest = farthest.max((-turn / length).max(f64::MIN_POSITIVE));
        }
    }
    farthest
}
