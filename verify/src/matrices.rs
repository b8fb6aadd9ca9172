//! The check that the matrices of the pieces are invertible and agree with the map that takes corners to corners.

use crate::container::{Container, expect_count, of_section};
use crate::exact::{Weight, Weights};
use crate::refusal::Refusal;
use crate::tiling::Map;

/// The ratio of a piece's width to its length, in the weights of its faces, below which its matrix stands in the file.
const THIN: f64 = 1e-4;
/// The largest distance by which matrices may carry corners away, in units of their size.
const ROUNDING: f64 = 1e-6;

/// How the matrices of the pieces, which answer images of points, agree with the map that takes corners to corners.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Matrices {
    /// The number of pieces whose matrix is given, as their corners do not tell it.
    pub given: usize,
    /// The largest distance on the target between a point's image by a matrix and by the corners, in units of the root of the
    /// target's area. In f64.
    pub largest_distance: f64,
}

type Point = [f64; 2];
/// A matrix by columns: m11, m21, m12, m22.
type Matrix = [f64; 4];

fn applied(m: Matrix, [x, y]: Point) -> Point {
    [m[0] * x + m[2] * y, m[1] * x + m[3] * y]
}

fn difference(p: Point, q: Point) -> Point {
    [p[0] - q[0], p[1] - q[1]]
}

fn length([x, y]: Point) -> f64 {
    (x * x + y * y).sqrt()
}

/// Twice the area of a triangle.
fn double_area([p, q, r]: [Point; 3]) -> f64 {
    let ([a, b], [c, d]) = (difference(q, p), difference(r, p));
    a * d - b * c
}

/// Checks the matrices of all pieces.
pub fn check(container: &Container<'_>, map: &Map<'_>) -> Result<Matrices, Refusal> {
    let thin = container.integers("pieces.thin")?;
    if thin.windows(2).any(|pair| pair[0] >= pair[1])
        || thin.last().is_some_and(|p| *p as usize >= map.pieces.len())
    {
        return Err(of_section("pieces.thin", "it does not name pieces in growing order".to_owned()));
    }
    let entries = container.numbers("pieces.thin_matrices")?;
    expect_count("pieces.thin_matrices", entries.len(), 4 * thin.len())?;
    let mut given = thin.iter().zip(entries.as_chunks::<4>().0).peekable();
    let unit = (0..map.meshes[1].face_count() as u32).map(|f| map.meshes[1].area(f)).sum::<f64>().sqrt();
    let mut matrices = Matrices { given: thin.len(), largest_distance: 0.0 };
    let mut weights = [Vec::new(), Vec::new()];
    for piece in 0..map.pieces.len() {
        for side in [0, 1] {
            map.weights(side, piece, &mut weights[side])?;
        }
        let faces = [0, 1].map(|side| map.pieces.face(side, piece));
        let turns = [0, 1].map(|side| f64::from(map.turn(side, faces[side])));
        let rings = [0, 1].map(|side| ring(&weights[side]));
        let wrong = |problem: &str| Refusal::Matrix { piece, problem: problem.to_owned() };
        let matrix = match given.next_if(|(number, _)| **number as usize == piece) {
            Some((_, matrix)) => *matrix,
            None => of_corners(&rings, turns).ok_or_else(|| {
                wrong("is not given, though its corners are too near each other to tell it")
            })?,
        };
        let determinant = matrix[0] * matrix[3] - matrix[1] * matrix[2];
        if !(determinant.is_finite() && determinant * turns[0] * turns[1] > 0.0) {
            return Err(wrong("is not invertible, or turns the piece over"));
        }
        let error = worst(matrix, &rings);
        let size = 1.0 + length([matrix[0], matrix[1]]) + length([matrix[2], matrix[3]]);
        if length(error) > ROUNDING * size {
            return Err(wrong("does not carry its corners from the source to the target"));
        }
        matrices.largest_distance = matrices.largest_distance.max(in_space(map, faces[1], error) / unit);
    }
    Ok(matrices)
}

/// Weights 1 and 2 of the corners of a piece.
fn ring(weights: &[Weights]) -> Vec<Point> {
    weights.iter().map(|[_, x, y]| [x, y].map(|w: &Weight| w.value())).collect()
}

/// The matrix of the three corners with the largest triangle on the source; `None` where they are too near each other on one mesh.
fn of_corners([source, target]: &[Vec<Point>; 2], turns: [f64; 2]) -> Option<Matrix> {
    let n = source.len();
    let mut best: Option<(f64, [usize; 3])> = None;
    for i in 0..n {
        for j in i + 1..n {
            for k in j + 1..n {
                let area = turns[0] * double_area([i, j, k].map(|k| source[k]));
                if area > best.map_or(0.0, |(largest, _)| largest) {
                    best = Some((area, [i, j, k]));
                }
            }
        }
    }
    let (_, corners) = best?;
    let [from, onto] = [source, target].map(|ring| corners.map(|k| ring[k]));
    let is_thick = |triangle: [Point; 3], turn: f64| {
        let [p, q, r] = triangle;
        let longest = length(difference(q, p)).max(length(difference(r, q))).max(length(difference(p, r)));
        // The writer's weights may be rounded otherwise.
        turn * double_area(triangle) >= THIN * longest * (1.0 - 1e-9)
    };
    if !is_thick(from, turns[0]) || !is_thick(onto, turns[1]) {
        return None;
    }
    let ([a, b], [c, d]) = (difference(from[1], from[0]), difference(from[2], from[0]));
    let (u, v) = (difference(onto[1], onto[0]), difference(onto[2], onto[0]));
    let inverse = 1.0 / (a * d - b * c);
    let column = |x: f64, y: f64| [(u[0] * x + v[0] * y) * inverse, (u[1] * x + v[1] * y) * inverse];
    let ([m11, m21], [m12, m22]) = (column(d, -b), column(-c, a));
    Some([m11, m21, m12, m22])
}

/// The largest error with which a matrix carries one corner to another. By convexity no point of the piece is carried worse, from
/// whichever corner.
fn worst(matrix: Matrix, [source, target]: &[Vec<Point>; 2]) -> Point {
    let mut worst = [0.0; 2];
    for i in 0..source.len() {
        for j in i + 1..source.len() {
            let there = difference(target[j], target[i]);
            let error = difference(there, applied(matrix, difference(source[j], source[i])));
            // An error that is not a number counts as worst.
            if length(error).partial_cmp(&length(worst)) != Some(std::cmp::Ordering::Less) {
                worst = error;
            }
        }
    }
    worst
}

/// The length in space of a difference of weights in a face of the target.
fn in_space(map: &Map<'_>, face: u32, [x, y]: Point) -> f64 {
    let difference = map.meshes[1].position(face, [-x - y, x, y]);
    difference.iter().map(|x| x * x).sum::<f64>().sqrt()
}
