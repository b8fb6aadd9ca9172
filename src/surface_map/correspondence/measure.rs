//! Distortion of a map given by its pieces.

use super::pieces::{Correspondence, MappedPiece, share};
use crate::landmarks::MeshSide;
use crate::math::scalar::max;
use crate::mesh::cap_faces::CapFaces;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint};
use crate::surface_map::measures::coverage::SkinAreas;
use crate::surface_map::measures::distortion::{Distortion, Tally, in_plane};
use glam::{DMat2, DVec3};
use std::convert::Infallible;
use typed_index_collections::TiVec;

/// Measures a map from its pieces alone, over the pieces whose faces are skin on both meshes. Faces and vertices in the result are those of
/// the given meshes.
///
/// The numbers are those of [`crate::surface_map::measures::distortion::skin_distortion`] for the overlay of the same map, up to
/// rounding.
pub fn distortion(meshes: [&SurfaceMesh; 2], map: &Correspondence, caps: CapFaces<'_>) -> Distortion {
    let frames = meshes.map(|mesh| {
        let scale = 1.0 / mesh.area().sqrt();
        mesh.faces().map(|f| in_plane(mesh.corners(f), scale)).collect::<TiVec<FaceId, DMat2>>()
    });
    let mut ring = Vec::new();
    let mut local = |piece: &MappedPiece| {
        let [from, onto] = MeshSide::BOTH.map(|side| frames[side][piece.faces[side]]);
        let j = onto * piece.map * from.inverse();
        map.ring(meshes[0], MeshSide::Source, piece, &mut ring);
        let source_area = max(share(&ring), 0.0) * 0.5 * from.determinant();
        (j, [source_area, source_area * j.determinant()])
    };
    let skin = caps
        .any()
        .then(|| SkinAreas::of(map.pieces.iter().map(|piece| (caps.are_skin(piece.faces), local(piece).1))));
    let mut tally = Tally::new(meshes[0], map.pieces.len(), skin);
    for piece in &map.pieces {
        let (j, areas) = local(piece);
        match caps.are_skin(piece.faces) {
            [true, true] => tally.add(piece.faces[0], &j, areas),
            _ => tally.leave_out(&j),
        }
    }
    let middles = |k: usize| MeshSide::BOTH.map(|side| middle(meshes[side], map, side, &map.pieces[k]));
    let worst = tally.worst(|k| map.pieces[k].is_certain, middles);
    let Ok(distortion) = tally.finish(meshes[0], worst, || Ok::<_, Infallible>(()));
    distortion
}

/// The mean of a piece's corners on one of both meshes.
fn middle(mesh: &SurfaceMesh, map: &Correspondence, side: MeshSide, piece: &MappedPiece) -> SurfacePoint {
    let face = piece.faces[side];
    let corners = &map.corners[piece.corners.clone()];
    let weights = corners.iter().filter_map(|&v| map.vertices[v as usize][side].weights_in(mesh, face));
    let sum: DVec3 = weights.map(DVec3::from).sum();
    SurfacePoint { face, barycentric: (sum / corners.len() as f64).to_array() }
}
