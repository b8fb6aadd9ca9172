//! The check that the pieces' triangles are turned the right way on both meshes and cover every face once.

use crate::complex::Pieces;
use crate::exact::{Tally, Weight, Weights, determinant};
use crate::mesh::Mesh;
use crate::places::Place;
use crate::refusal::{Refusal, Side};
use std::ops::ControlFlow;

/// A triangle that is turned over by less than this share of its face may be so by rounding; then the map is not proved, but not
/// refused as wrong either. It is what the format allows.
pub const WITHIN_ROUNDING: f64 = 1e-6;

/// The number of pieces that are judged before the caller is asked whether to go on.
const ASK_EVERY: usize = 4096;

/// Both meshes with the places of the overlay's vertices on them, and the pieces between.
pub struct Map<'a> {
    pub meshes: [&'a Mesh<'a>; 2],
    pub places: [Vec<Place>; 2],
    pub pieces: Pieces,
    /// Whether the map goes to the mirror image of the target.
    pub is_mirrored: bool,
}

impl Map<'_> {
    /// The weights of a piece's corners in its face of one mesh.
    pub fn weights(&self, side: usize, piece: usize, weights: &mut Vec<Weights>) -> Result<(), Refusal> {
        weights.clear();
        let (mesh, face) = (self.meshes[side], self.pieces.face(side, piece));
        for &vertex in self.pieces.ring(piece) {
            let there = self.places[side][vertex as usize].weights_in(mesh, face);
            let elsewhere = Refusal::Elsewhere { piece, vertex, side: Side::BOTH[side], face };
            weights.push(there.ok_or(elsewhere)?);
        }
        Ok(())
    }

    /// 1 where corners that are counter-clockwise on the map's surfaces are so in the file's order of the face's corners; else -1.
    pub fn turn(&self, side: usize, face: u32) -> i8 {
        let is_turned = self.meshes[side].is_turned(face) != (side == 1 && self.is_mirrored);
        if is_turned { -1 } else { 1 }
    }
}

/// Triangles that have no positive area on both meshes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Doubtful {
    /// The number of these triangles.
    pub triangles: usize,
    /// The first piece with one of them.
    pub first_piece: Option<usize>,
    /// The share of the source's area that they have.
    pub source_share: f64,
    /// The share of the target's area that they have.
    pub target_share: f64,
    /// The largest share of a face that one of them covers the wrong way round.
    pub turned_share: f64,
}

/// The pieces cut into triangles.
pub struct Cut {
    /// The corner that all triangles of a piece share, by its number in the piece.
    apexes: Vec<u8>,
    pub triangles: usize,
    pub doubtful: Doubtful,
}

/// Corners of a triangle of a piece, as numbers in it.
fn triangles(apex: usize, corners: usize) -> impl Iterator<Item = [usize; 3]> {
    (1..corners - 1).map(move |k| [apex, (apex + k) % corners, (apex + k + 1) % corners])
}

/// Cuts each piece into triangles around one of its corners, by choice such that all are positive on both meshes.
pub fn cut(
    map: &Map<'_>,
    tally: &mut Tally,
    ask: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Cut, Refusal> {
    let total =
        [0, 1].map(|side| (0..map.meshes[side].face_count() as u32).map(|f| map.meshes[side].area(f)).sum());
    let mut cut = Cut { apexes: vec![0; map.pieces.len()], triangles: 0, doubtful: Doubtful::default() };
    let mut weights = [Vec::new(), Vec::new()];
    for piece in 0..map.pieces.len() {
        if piece.is_multiple_of(ASK_EVERY) && ask(piece as f64 / map.pieces.len() as f64).is_break() {
            return Err(Refusal::Stopped);
        }
        for side in [0, 1] {
            map.weights(side, piece, &mut weights[side])?;
        }
        if map.pieces.is_segment(piece) {
            continue;
        }
        let turns = [0, 1].map(|side| map.turn(side, map.pieces.face(side, piece)));
        let (apex, bad) = best_apex(&weights, turns, tally);
        cut.apexes[piece] = apex as u8;
        cut.triangles += weights[0].len() - 2;
        for corners in bad {
            doubt(
                map,
                &mut cut.doubtful,
                piece,
                [0, 1].map(|side| corners.map(|k| &weights[side][k])),
                total,
            )?;
        }
    }
    Ok(cut)
}

/// The first corner around which all triangles are positive on both meshes; where there is none, a corner with the fewest triangles that
/// are not positive, and those triangles.
fn best_apex(weights: &[Vec<Weights>; 2], turns: [i8; 2], tally: &mut Tally) -> (usize, Vec<[usize; 3]>) {
    let corners = weights[0].len();
    let mut best: Option<(usize, Vec<[usize; 3]>)> = None;
    // All corners of a triangle give the same one.
    let apexes = if corners == 3 { 1 } else { corners };
    for apex in 0..apexes {
        let mut is_positive = |t: &[usize; 3]| {
            (0..2).all(|side| tally.orientation(t.map(|k| &weights[side][k])) == turns[side])
        };
        let bad: Vec<_> = triangles(apex, corners).filter(|t| !is_positive(t)).collect();
        if bad.is_empty() {
            return (apex, bad);
        }
        if best.as_ref().is_none_or(|(_, fewest)| bad.len() < fewest.len()) {
            best = Some((apex, bad));
        }
    }
    best.unwrap_or_default()
}

/// Notes a triangle without positive area, or refuses one that rounding does not explain.
fn doubt(
    map: &Map<'_>,
    doubtful: &mut Doubtful,
    piece: usize,
    corners: [[&Weights; 3]; 2],
    total: [f64; 2],
) -> Result<(), Refusal> {
    let mut shares = [0.0; 2];
    for side in [0, 1] {
        let face = map.pieces.face(side, piece);
        let share = determinant(corners[side]) * f64::from(map.turn(side, face));
        if share < -WITHIN_ROUNDING {
            return Err(Refusal::Turned { piece, side: Side::BOTH[side], share: -share });
        }
        doubtful.turned_share = doubtful.turned_share.max(-share);
        shares[side] = share.abs() * map.meshes[side].area(face) / total[side];
    }
    doubtful.triangles += 1;
    doubtful.first_piece.get_or_insert(piece);
    doubtful.source_share += shares[0];
    doubtful.target_share += shares[1];
    Ok(())
}

/// Checks that one point of every face of one mesh lies in exactly one triangle, those that are turned over counted negative.
pub fn check_cover(
    map: &Map<'_>,
    cut: &Cut,
    side: usize,
    tally: &mut Tally,
    ask: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(), Refusal> {
    let faces = map.meshes[side].face_count();
    let mut order: Vec<u32> = (0..map.pieces.len() as u32).collect();
    order.retain(|&piece| !map.pieces.is_segment(piece as usize));
    order.sort_unstable_by_key(|&piece| (map.pieces.face(side, piece as usize), piece));
    let mut here = Vec::new();
    let (mut weights, mut rest) = (Vec::new(), &order[..]);
    for face in 0..faces {
        if face.is_multiple_of(ASK_EVERY) && ask(face as f64 / faces as f64).is_break() {
            return Err(Refusal::Stopped);
        }
        here.clear();
        let count = rest.partition_point(|&piece| map.pieces.face(side, piece as usize) as usize <= face);
        let (own, onwards) = rest.split_at(count);
        rest = onwards;
        for &piece in own {
            map.weights(side, piece as usize, &mut weights)?;
            let apex = usize::from(cut.apexes[piece as usize]);
            here.extend(triangles(apex, weights.len()).map(|t| t.map(|k| weights[k])));
        }
        let times =
            times_covered(&here, tally).ok_or(Refusal::Uncountable { face, side: Side::BOTH[side] })?;
        let times = times * i64::from(map.turn(side, face as u32));
        if times != 1 {
            return Err(Refusal::Covered { face, side: Side::BOTH[side], times });
        }
    }
    Ok(())
}

/// Where in the largest triangle the cover is counted, by weights of its corners; the next one where a point lies on a side.
const TRIALS: [[f64; 3]; 6] =
    [[1.0, 1.0, 1.0], [2.0, 1.0, 1.0], [1.0, 2.0, 1.0], [1.0, 1.0, 2.0], [5.0, 2.0, 3.0], [3.0, 7.0, 4.0]];

/// How often triangles of one face cover a point of the largest of them, clockwise ones counted negative; `None` where every
/// point that was tried lies on a side.
fn times_covered(triangles: &[[Weights; 3]], tally: &mut Tally) -> Option<i64> {
    let size = |t: &[Weights; 3]| determinant([&t[0], &t[1], &t[2]]).abs();
    let Some(largest) = triangles.iter().max_by(|a, b| size(a).total_cmp(&size(b))) else { return Some(0) };
    TRIALS.into_iter().find_map(|trial| {
        let point = between(largest, trial);
        triangles.iter().map(|t| sheets_at(t, &point, tally)).sum()
    })
}

/// A point of a triangle, rounded.
fn between(triangle: &[Weights; 3], [a, b, c]: [f64; 3]) -> Weights {
    let [p, q, r] = triangle;
    let sum = a + b + c;
    [0, 1, 2].map(|k| Weight::new((p[k].value() * a + q[k].value() * b + r[k].value() * c) / sum))
}

/// 1 where a counter-clockwise triangle holds a point, -1 where a clockwise one does, 0 where the point is outside; `None` on a
/// side, or on the line of a triangle without area.
fn sheets_at([a, b, c]: &[Weights; 3], point: &Weights, tally: &mut Tally) -> Option<i64> {
    let mut signs = [0; 3];
    for (sign, rows) in signs.iter_mut().zip([[point, b, c], [a, point, c], [a, b, point]]) {
        *sign = tally.orientation(rows);
    }
    match (signs.contains(&1), signs.contains(&-1), signs.contains(&0)) {
        (true, true, _) => Some(0),
        (true, false, false) => Some(1),
        (false, true, false) => Some(-1),
        _ => None,
    }
}
