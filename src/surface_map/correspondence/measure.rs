//! Distortion of a map given by its pieces.

use super::pieces::{Correspondence, MappedPiece, share};
use crate::math::matrix2::squares;
use crate::math::quantile::Weighted;
use crate::math::scalar::{ln, max};
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use crate::surface_map::measures::distortion::{
    DENTED, Distortion, LocalDistortion, WORST, WorstPiece, in_plane,
};
use glam::{DMat2, DVec3};
use typed_index_collections::{TiVec, ti_vec};

/// Measures a map from its pieces alone, both meshes scaled to area 1. Places and averages are those of the meshes given.
///
/// The numbers are those of [`crate::surface_map::measures::distortion::distortion`] for the overlay of the same map, up to
/// rounding.
pub fn distortion(meshes: [&SurfaceMesh; 2], map: &Correspondence) -> Distortion {
    let frames = meshes.map(|mesh| {
        let scale = 1.0 / mesh.area().sqrt();
        mesh.faces().map(|f| in_plane(mesh.corners(f), scale)).collect::<TiVec<FaceId, DMat2>>()
    });
    let mut result = Distortion::default();
    let mut densities = Vec::with_capacity(map.pieces.len());
    let mut dented = [0.0; 2];
    let mut face_sums: TiVec<FaceId, [f64; 2]> = ti_vec![[0.0; 2]; meshes[0].face_count()];
    let mut ring = Vec::new();
    for piece in &map.pieces {
        let [from, onto] = [0, 1].map(|side| frames[side][piece.faces[side]]);
        let j = onto * piece.map * from.inverse();
        map.ring(meshes[0], 0, piece, &mut ring);
        let source_area = max(share(&ring), 0.0) * 0.5 * from.determinant();
        let local = LocalDistortion::of(&j);
        let (squares, target_area) = (squares(&j), source_area * local.area);
        let inverse_squares = squares / (local.area * local.area);
        let density = 0.25 * (squares + inverse_squares);
        result.by_piece.push(local);
        result.energy += squares * source_area + inverse_squares * target_area;
        result.source_area += source_area;
        result.target_area += target_area;
        result.mean_log += 0.5 * ln(density) * (source_area + target_area);
        if density > DENTED {
            dented[0] += source_area;
            dented[1] += target_area;
        }
        densities.push(Weighted { value: density, weight: source_area });
        face_sums[piece.faces[0]][0] += density * source_area;
        face_sums[piece.faces[0]][1] += source_area;
    }
    let worst = worst_pieces(meshes, map, &densities);
    result.summarise(densities);
    result.max = worst.first().map_or(1.0, |piece| piece.density);
    result.dented = max(dented[0] / result.source_area, dented[1] / result.target_area);
    result.worst = worst;
    result.by_vertex = vertex_averages(meshes[0], &face_sums);
    result
}

/// The certain pieces of largest density, given the density of each piece with its source area.
fn worst_pieces(meshes: [&SurfaceMesh; 2], map: &Correspondence, densities: &[Weighted]) -> Vec<WorstPiece> {
    let mut order: Vec<usize> = (0..densities.len()).filter(|&k| map.pieces[k].is_certain).collect();
    order.sort_by(|&a, &b| densities[b].value.total_cmp(&densities[a].value));
    let worst = order.into_iter().take(WORST);
    worst
        .map(|k| {
            let piece = &map.pieces[k];
            let Weighted { value: density, weight: area } = densities[k];
            let [source, target] = [0, 1].map(|side| middle(meshes[side], map, side, piece));
            WorstPiece { density, area, source, target }
        })
        .collect()
}

/// The mean of a piece's corners on one of both meshes.
fn middle(mesh: &SurfaceMesh, map: &Correspondence, side: usize, piece: &MappedPiece) -> SurfacePoint {
    let face = piece.faces[side];
    let corners = &map.corners[piece.corners.clone()];
    let weights = corners.iter().filter_map(|&v| map.vertices[v as usize][side].weights_in(mesh, face));
    let sum: DVec3 = weights.map(DVec3::from).sum();
    SurfacePoint { face, barycentric: (sum / corners.len() as f64).to_array() }
}

fn vertex_averages(mesh: &SurfaceMesh, faces: &TiVec<FaceId, [f64; 2]>) -> TiVec<VertexId, f64> {
    let mut sums = ti_vec![[0.0_f64; 2]; mesh.vertex_count()];
    for (f, corners) in mesh.triangles().iter_enumerated() {
        for &v in corners {
            let sum: &mut [f64; 2] = &mut sums[v];
            sum[0] += faces[f][0];
            sum[1] += faces[f][1];
        }
    }
    sums.into_iter().map(|[d, a]| d / a).collect()
}
