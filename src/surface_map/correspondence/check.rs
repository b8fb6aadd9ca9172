//! The check whether pieces, such as those read from a file, are a map between two meshes.
//!
//! The pieces must form a sphere (every edge of a piece occurs once more, in the opposite direction, in another piece; the pieces are
//! connected across edges; V - E + F = 2), lie in their faces, be positively oriented, cover every face of both meshes once, and have
//! matrices that map their corners onto each other. Then every point of either mesh has an image. Without the first condition, one sphere
//! of pieces could cover the source and shrink to a point of the target, and another the other way round.

use super::pieces::{Correspondence, share};
use crate::landmarks::MeshSide;
use crate::math::disjoint_sets::DisjointSets;
use crate::mesh::{FaceId, SurfaceMesh};
use glam::{DMat2, DVec2};
use typed_index_collections::{TiVec, ti_vec};

/// The share of a face that its pieces may miss or cover twice. Pieces share their corners, so that only the sum rounds. Chosen by hand.
const COVERAGE: f64 = 1e-9;
/// The share of a face by which a piece may be negative, and the error of a matrix in units of its size: rounding of corners in
/// faces that are tiny on the cone surface. Chosen by hand.
const ROUNDING: f64 = 1e-6;

/// Why pieces are no map between two meshes.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CorrespondenceFault {
    /// A corner does not lie in the face of its piece.
    #[error("corner {vertex} of piece {piece} does not lie in the piece's {side} face")]
    Elsewhere {
        /// The piece.
        piece: usize,
        /// The corner, a number of an overlay vertex.
        vertex: u32,
        /// The mesh.
        side: MeshSide,
    },
    /// A piece has fewer than two corners.
    #[error("piece {piece} has {corners} corners; it needs at least 2")]
    Corners {
        /// The piece.
        piece: usize,
        /// Number of its corners.
        corners: usize,
    },
    /// A vertex is a corner of no piece.
    #[error("overlay vertex {vertex} is a corner of no piece")]
    Unused {
        /// The vertex.
        vertex: usize,
    },
    /// An edge belongs to one piece only, or to more than two.
    #[error("the pieces do not fit together at the edge between overlay vertices {} and {}", edge[0], edge[1])]
    Edge {
        /// Its ends.
        edge: [u32; 2],
    },
    /// The pieces are not connected.
    #[error("the pieces do not hang together: {reached} of {pieces} are joined across their edges")]
    Parts {
        /// Pieces that are joined with the first one.
        reached: usize,
        /// All pieces.
        pieces: usize,
    },
    /// The pieces are not a sphere.
    #[error("the pieces have Euler characteristic {euler} instead of 2")]
    NotASphere {
        /// V - E + F.
        euler: i64,
    },
    /// A piece is negatively oriented.
    #[error("piece {piece} is turned over on the {side}: its share of its face is {share:.1e}")]
    Turned {
        /// The piece.
        piece: usize,
        /// The mesh.
        side: MeshSide,
        /// The signed share of the face that it covers.
        share: f64,
    },
    /// A face is not covered once.
    #[error("the pieces cover {share} of face {face} of the {side} instead of 1")]
    Coverage {
        /// The face, of the checked mesh.
        face: usize,
        /// The mesh.
        side: MeshSide,
        /// The share of the face that is covered.
        share: f64,
    },
    /// The matrix of a piece does not map its corners.
    #[error("the matrix of piece {piece} does not carry its corners from the source to the target")]
    Matrix {
        /// The piece.
        piece: usize,
    },
}

/// Checks that the pieces are a map between the meshes. All numbers of vertices, faces and corners in `map` must be in range.
///
/// # Errors
/// The first [`CorrespondenceFault`].
pub fn check(meshes: [&SurfaceMesh; 2], map: &Correspondence) -> Result<(), CorrespondenceFault> {
    check_sphere(map)?;
    let mut rings = [Vec::new(), Vec::new()];
    let mut covered: [TiVec<FaceId, f64>; 2] = meshes.map(|mesh| ti_vec![0.0; mesh.face_count()]);
    for (number, piece) in map.pieces.iter().enumerate() {
        for side in MeshSide::BOTH {
            let (mesh, face) = (meshes[side], piece.faces[side]);
            map.ring(mesh, side, piece, &mut rings[side]);
            if rings[side].len() != piece.corners.len() {
                let holds = |v: &&u32| map.vertices[**v as usize][side].weights_in(mesh, face).is_some();
                let vertex =
                    map.corners[piece.corners.clone()].iter().find(|v| !holds(v)).copied().unwrap_or(0);
                return Err(CorrespondenceFault::Elsewhere { piece: number, vertex, side });
            }
            let share = share(&rings[side]);
            if share < -ROUNDING {
                return Err(CorrespondenceFault::Turned { piece: number, side, share });
            }
            covered[side][face] += share;
        }
        if !carries(&piece.map, &rings) {
            return Err(CorrespondenceFault::Matrix { piece: number });
        }
    }
    for side in MeshSide::BOTH {
        let gap = covered[side].iter_enumerated().find(|(_, share)| (**share - 1.0).abs() > COVERAGE);
        if let Some((face, &share)) = gap {
            return Err(CorrespondenceFault::Coverage { face: face.index(), side, share });
        }
    }
    Ok(())
}

/// Checks that the pieces are a closed surface of genus 0.
fn check_sphere(map: &Correspondence) -> Result<(), CorrespondenceFault> {
    let mut is_used = vec![false; map.vertices.len()];
    for (number, piece) in map.pieces.iter().enumerate() {
        let ring = &map.corners[piece.corners.clone()];
        if ring.len() < 2 {
            return Err(CorrespondenceFault::Corners { piece: number, corners: ring.len() });
        }
        ring.iter().for_each(|&v| is_used[v as usize] = true);
    }
    if let Some(vertex) = is_used.iter().position(|used| !used) {
        return Err(CorrespondenceFault::Unused { vertex });
    }
    check_parts(map)?;
    // A connected surface has Euler characteristic 2 at most. A vertex at which several fans of pieces only touch makes V smaller than
    // that of the surface, so that at 2 there is none. A piece of two corners adds one edge and one piece.
    let edges = map.corners.len() as i64 / 2;
    let euler = map.vertices.len() as i64 - edges + map.pieces.len() as i64;
    if euler == 2 { Ok(()) } else { Err(CorrespondenceFault::NotASphere { euler }) }
}

/// Checks that every edge occurs once in each direction, and that all pieces are connected across edges. A piece of two corners lies
/// along an edge of two others, which count as neighbours.
fn check_parts(map: &Correspondence) -> Result<(), CorrespondenceFault> {
    let ring = |number: usize| &map.corners[map.pieces[number].corners.clone()];
    let wrong = |[a, b]: [u32; 2]| CorrespondenceFault::Edge { edge: [a.min(b), a.max(b)] };
    let mut runs: Vec<([u32; 2], usize)> = Vec::with_capacity(map.corners.len());
    for number in (0..map.pieces.len()).filter(|&number| ring(number).len() > 2) {
        let ends = ring(number).iter().zip(ring(number).iter().cycle().skip(1));
        runs.extend(ends.map(|(&a, &b)| ([a, b], number)));
    }
    runs.sort_unstable();
    if let Some(twice) = runs.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        return Err(wrong(twice[0].0));
    }
    let on_edge = |edge: [u32; 2]| {
        let found = runs.binary_search_by_key(&edge, |run| run.0);
        found.map(|k| runs[k].1).map_err(|_| wrong(edge))
    };
    let mut sets = DisjointSets::new(map.pieces.len());
    for &([a, b], number) in &runs {
        sets.join(number, on_edge([b, a])?);
    }
    for number in 0..map.pieces.len() {
        if let &[a, b] = ring(number) {
            sets.join(number, on_edge([a, b])?);
        }
    }
    let pieces = map.pieces.len();
    let reached = (0..pieces).filter(|&number| sets.root(number) == sets.root(0)).count();
    if reached == pieces { Ok(()) } else { Err(CorrespondenceFault::Parts { reached, pieces }) }
}

/// Whether a matrix has a positive determinant and maps the corners of a piece from one face to the other.
fn carries(matrix: &DMat2, [here, there]: &[Vec<DVec2>; 2]) -> bool {
    let determinant = matrix.determinant();
    if !(matrix.is_finite() && determinant > 0.0 && determinant.is_finite()) {
        return false;
    }
    let size = 1.0 + matrix.x_axis.length() + matrix.y_axis.length();
    let is_near = |k: usize| {
        let error = there[k] - there[0] - *matrix * (here[k] - here[0]);
        error.length() <= ROUNDING * size
    };
    (1..here.len()).all(is_near)
}
