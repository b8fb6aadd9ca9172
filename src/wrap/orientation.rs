//! Which faces of the result look the wrong way.
//!
//! The image of a face on the scan has an area vector: its area times its mean normal. The laid face should look as that does. A
//! face that has no image should look as its neighbours do.

use super::input::WrapInput;
use crate::mesh::{FaceId, SurfaceMesh, VertexId};
use crate::mesh_side::MeshSide;
use crate::surface_map::correspondence::share;
use glam::DVec3;
use typed_index_collections::{TiVec, ti_vec};

/// Which way each face of the base should look, as far as the scan tells.
pub(super) struct Orientation {
    /// Twice the area vector of each face's image; `None` where less than half of the face has an image on skin.
    image: TiVec<FaceId, Option<DVec3>>,
    /// The share of the base's skin whose image is skin.
    pub covered: f64,
}

impl Orientation {
    /// Sums the pieces of the map up.
    pub fn new(input: &WrapInput<'_>) -> Self {
        let WrapInput { base, scan, map, caps } = input;
        let mut vectors: TiVec<FaceId, DVec3> = ti_vec![DVec3::ZERO; base.face_count()];
        let mut shares: TiVec<FaceId, f64> = ti_vec![0.0; base.face_count()];
        let mut rings = [Vec::new(), Vec::new()];
        for piece in &map.pieces {
            if caps.are_skin(piece.faces) != [true; 2] {
                continue;
            }
            map.ring(base, MeshSide::Source, piece, &mut rings[0]);
            map.ring(scan, MeshSide::Target, piece, &mut rings[1]);
            let [here, there] = rings.each_ref().map(|ring| share(ring));
            let [p, q, r] = scan.corners(piece.faces[1]);
            vectors[piece.faces[0]] += (q - p).cross(r - p) * there;
            shares[piece.faces[0]] += here;
        }
        let (mut skin, mut covered) = (0.0, 0.0);
        for f in base.faces().filter(|&f| input.is_base_skin(f)) {
            skin += base.face_area(f);
            covered += base.face_area(f) * shares[f];
        }
        let image = vectors.iter().zip(&shares).map(|(vector, share)| (*share > 0.5).then_some(*vector));
        Self { image: image.collect(), covered: covered / skin }
    }

    /// Twice the area vector that a face should have: that of its image, or, for the direction alone, the sum of those around.
    pub fn wanted(
        &self,
        f: FaceId,
        base: &SurfaceMesh,
        positions: &TiVec<VertexId, DVec3>,
        is_asked: impl Fn(FaceId) -> bool,
    ) -> DVec3 {
        if let Some(image) = self.image[f] {
            return image;
        }
        let faces = base.triangles()[f].into_iter().flat_map(|v| base.star(v).map(|h| h.face()));
        let around = faces.filter(|&other| other != f && is_asked(other));
        let sum: DVec3 = around.map(|f| double_area_vector(base, positions, f)).sum();
        sum.normalize_or_zero() * double_area_vector(base, positions, f).length()
    }

    /// The faces of the result that look the wrong way, of those that are asked about.
    pub fn flipped(
        &self,
        base: &SurfaceMesh,
        positions: &TiVec<VertexId, DVec3>,
        is_asked: impl Fn(FaceId) -> bool,
    ) -> Vec<FaceId> {
        let looks_right = |&f: &FaceId| {
            let wanted = self.wanted(f, base, positions, &is_asked);
            double_area_vector(base, positions, f).dot(wanted) > 0.0
        };
        // A direction that is not finite does not look right.
        base.faces().filter(|&f| is_asked(f)).filter(|f| !looks_right(f)).collect()
    }
}

/// Twice the area of a face, times its normal.
fn double_area_vector(base: &SurfaceMesh, positions: &TiVec<VertexId, DVec3>, f: FaceId) -> DVec3 {
    let [p, q, r] = base.triangles()[f].map(|v| positions[v]);
    (q - p).cross(r - p)
}
