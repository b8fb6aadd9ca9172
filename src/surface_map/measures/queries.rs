//! Point queries on the finished map, in both directions, through the pieces of the overlay.
//!
//! A point is looked up among the pieces of its face and mapped by the piece's motion over the cone surface into the piece's face of
//! the other mesh. Both directions use the same pieces, so that one is the inverse of the other up to rounding.

use crate::landmarks::MeshSide;
use crate::math::barycentric;
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, SurfacePoint};
use crate::surface_map::overlay::{Overlay, OverlayPoint, Piece};
use crate::surface_map::parametrisation::embedding::{Embedding, Parametrised};
use glam::DVec2;
use typed_index_collections::{TiVec, ti_vec};

/// The map as a function of points, with the pieces sorted by source face and by target face.
#[derive(Clone, Debug)]
pub struct PointMap<'a> {
    embeddings: [&'a Embedding; 2],
    overlay: &'a Overlay,
    pieces: [PiecesByFace; 2],
}

/// The numbers of the pieces in each face.
#[derive(Clone, Debug)]
struct PiecesByFace {
    /// First entry of each face in `pieces`, and the end.
    begins: TiVec<FaceId, u32>,
    pieces: Vec<u32>,
}

impl PiecesByFace {
    fn new(overlay: &Overlay, faces: usize, face_of: impl Fn(&Piece) -> FaceId) -> Self {
        let mut begins: TiVec<FaceId, u32> = ti_vec![0; faces + 1];
        for piece in &overlay.pieces {
            begins[FaceId::from(face_of(piece).index() + 1)] += 1;
        }
        let mut sum = 0;
        for count in begins.iter_mut() {
            sum += *count;
            *count = sum;
        }
        let mut ends = begins.clone();
        let mut pieces = vec![0; overlay.pieces.len()];
        for (k, piece) in overlay.pieces.iter().enumerate() {
            let end = &mut ends[face_of(piece)];
            pieces[*end as usize] = k as u32;
            *end += 1;
        }
        Self { begins, pieces }
    }

    fn of(&self, face: FaceId) -> &[u32] {
        let end = self.begins[FaceId::from(face.index() + 1)];
        &self.pieces[self.begins[face] as usize..end as usize]
    }
}

impl<'a> PointMap<'a> {
    /// The map of an overlay; source and target are those that it was made of.
    pub fn new(source: Parametrised<'a>, target: Parametrised<'a>, overlay: &'a Overlay) -> Self {
        let embeddings = [source.embedding, target.embedding];
        let [from, onto] = embeddings.map(|e| e.corners.len() / 3);
        let pieces = [
            PiecesByFace::new(overlay, from, |piece| piece.source_face),
            PiecesByFace::new(overlay, onto, |piece| piece.target_face),
        ];
        Self { embeddings, overlay, pieces }
    }

    /// The target point that belongs to a source point; both on the meshes that were overlaid.
    ///
    /// # Panics
    /// When the face does not exist.
    pub fn target_from_source(&self, point: SurfacePoint) -> SurfacePoint {
        let piece = self.piece(MeshSide::Source, point, |corner| &corner.source);
        let image = piece.motion.apply(at(self.embeddings[0], point));
        let corners = self.embeddings[1].triangle(piece.target_face);
        SurfacePoint { face: piece.target_face, barycentric: barycentric::clamped_in(corners, image) }
    }

    /// The source point that belongs to a target point; both on the meshes that were overlaid.
    ///
    /// # Panics
    /// When the face does not exist.
    pub fn source_from_target(&self, point: SurfacePoint) -> SurfacePoint {
        let piece = self.piece(MeshSide::Target, point, |corner| &corner.target);
        let image = piece.motion.inverse().apply(at(self.embeddings[1], point));
        let corners = self.embeddings[0].triangle(piece.source_face);
        SurfacePoint { face: piece.source_face, barycentric: barycentric::clamped_in(corners, image) }
    }

    /// The piece of the point's face that contains it: the one from whose border it is farthest inside.
    fn piece(
        &self,
        side: MeshSide,
        point: SurfacePoint,
        coordinates: impl Fn(&OverlayPoint) -> &[f64; 3],
    ) -> &'a Piece {
        let here = self.pieces[side].of(point.face);
        let piece = |k: u32| &self.overlay.pieces[k as usize];
        let place = |corner: &OverlayPoint| {
            let [_, x, y] = *coordinates(corner);
            DVec2::new(x, y)
        };
        let q = DVec2::new(point.barycentric[1], point.barycentric[2]);
        let mut best = (f64::NEG_INFINITY, piece(here[0]));
        for candidate in here.iter().map(|&k| piece(k)) {
            let inside = depth(&self.overlay.points[candidate.points.clone()], q, place);
            if inside > best.0 {
                best = (inside, candidate);
            }
            if inside > 0.0 {
                break;
            }
        }
        best.1
    }
}

/// Least distance of q from the sides of a counter-clockwise polygon; negative outside and for polygons without area.
fn depth(ring: &[OverlayPoint], q: DVec2, place: impl Fn(&OverlayPoint) -> DVec2) -> f64 {
    let mut least = f64::INFINITY;
    let mut area = 0.0;
    let origin = place(&ring[0]);
    for k in 0..ring.len() {
        let (a, b) = (place(&ring[k]), place(&ring[(k + 1) % ring.len()]));
        let length = a.distance(b);
        area += signed_double_area(origin, a, b);
        if length > 0.0 {
            least = least.min(signed_double_area(a, b, q) / length);
        }
    }
    if area > 0.0 { least } else { f64::NEG_INFINITY }
}

fn at(embedding: &Embedding, point: SurfacePoint) -> DVec2 {
    barycentric::interpolated(embedding.triangle(point.face), point.barycentric)
}
