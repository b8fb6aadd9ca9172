//! The pieces of a map and the check that they are glued to a sphere.

use crate::container::{Container, expect_count, of_section};
use crate::refusal::Refusal;
use std::ops::Range;

/// The largest number of corners of a piece: two triangles share a polygon of six.
const MOST_CORNERS: usize = 16;

/// The pieces as the file has them.
pub struct Pieces {
    /// The overlay vertices of all pieces, piece by piece.
    corners: Vec<u32>,
    ranges: Vec<Range<usize>>,
    /// The face of each piece on each mesh, the source's first.
    faces: [Vec<u32>; 2],
}

impl Pieces {
    /// Reads the pieces; their corners and faces need not exist.
    pub fn read(container: &Container<'_>) -> Result<Self, Refusal> {
        let sizes = container.integers("pieces.sizes")?;
        let corners = container.integers("pieces.corners")?;
        let mut ranges = Vec::with_capacity(sizes.len());
        let mut begin = 0_usize;
        for (piece, &size) in sizes.iter().enumerate() {
            let size = size as usize;
            if !(2..=MOST_CORNERS).contains(&size) {
                let problem = format!("{size} corners; they are 2 to {MOST_CORNERS}");
                return Err(Refusal::Corners { piece, problem });
            }
            ranges.push(begin..begin + size);
            begin += size;
        }
        expect_count("pieces.corners", corners.len(), begin)?;
        if ranges.is_empty() {
            return Err(of_section("pieces.sizes", "there are no pieces".to_owned()));
        }
        let faces = [container.integers("pieces.source_faces")?, container.integers("pieces.target_faces")?];
        for (name, faces) in ["pieces.source_faces", "pieces.target_faces"].into_iter().zip(&faces) {
            expect_count(name, faces.len(), ranges.len())?;
        }
        Ok(Self { corners, ranges, faces })
    }

    /// The number of pieces.
    pub fn len(&self) -> usize {
        self.ranges.len()
    }

    /// The corners of a piece.
    pub fn ring(&self, piece: usize) -> &[u32] {
        &self.corners[self.ranges[piece].clone()]
    }

    /// The face of a piece on the source (0) or on the target (1).
    pub fn face(&self, side: usize, piece: usize) -> u32 {
        self.faces[side][piece]
    }

    /// Whether a piece has no inside: two corners, where an edge of each mesh coincide.
    pub fn is_segment(&self, piece: usize) -> bool {
        self.ranges[piece].len() == 2
    }
}

/// A side of a piece in the direction in which it runs.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Run {
    ends: [u32; 2],
    piece: u32,
}

/// Checks that the pieces are a sphere with these many vertices.
pub fn check_sphere(pieces: &Pieces, vertices: usize) -> Result<(), Refusal> {
    check_corners(pieces, vertices)?;
    let runs = runs(pieces);
    let partners = partners(&runs)?;
    check_balance(pieces, &runs)?;
    let solid: Vec<usize> = (0..pieces.len()).filter(|&p| !pieces.is_segment(p)).collect();
    check_connected(pieces, &runs, &partners, &solid)?;
    let mut is_used = vec![false; vertices];
    runs.iter().for_each(|run| is_used[run.ends[0] as usize] = true);
    if let Some(vertex) = is_used.iter().position(|used| !used) {
        return Err(Refusal::Unused { vertex });
    }
    // The surface of the pieces, glued along sides, has at most V - E + F = 2, as it is connected. Vertices with several fans of
    // pieces make V smaller than that surface's, so that 2 proves that there are none.
    let euler = vertices as i64 - runs.len() as i64 / 2 + solid.len() as i64;
    if euler == 2 { Ok(()) } else { Err(Refusal::NotASphere { euler }) }
}

fn check_corners(pieces: &Pieces, vertices: usize) -> Result<(), Refusal> {
    for piece in 0..pieces.len() {
        let ring = pieces.ring(piece);
        if let Some(v) = ring.iter().find(|v| **v as usize >= vertices) {
            let problem = format!("the corner {v}, but there are {vertices} overlay vertices");
            return Err(Refusal::Corners { piece, problem });
        }
        let is_twice = |k: usize| ring[..k].contains(&ring[k]);
        if let Some(k) = (0..ring.len()).find(|&k| is_twice(k)) {
            return Err(Refusal::Corners { piece, problem: format!("the corner {} twice", ring[k]) });
        }
    }
    Ok(())
}

/// The sides of all pieces that have an inside, sorted.
fn runs(pieces: &Pieces) -> Vec<Run> {
    let mut runs = Vec::with_capacity(pieces.corners.len());
    for piece in (0..pieces.len()).filter(|&p| !pieces.is_segment(p)) {
        let ring = pieces.ring(piece);
        for k in 0..ring.len() {
            runs.push(Run { ends: [ring[k], ring[(k + 1) % ring.len()]], piece: piece as u32 });
        }
    }
    runs.sort_unstable();
    runs
}

/// For each side, where the one lies that runs the other way.
fn partners(runs: &[Run]) -> Result<Vec<usize>, Refusal> {
    if let Some(pair) = runs.windows(2).find(|pair| pair[0].ends == pair[1].ends) {
        return Err(Refusal::Overlap { pieces: [pair[0].piece, pair[1].piece], ends: pair[0].ends });
    }
    let partner = |run: &Run| {
        let [a, b] = run.ends;
        let found = runs.binary_search_by(|other| other.ends.cmp(&[b, a]));
        found.map_err(|_| Refusal::Gap { piece: run.piece, ends: run.ends })
    };
    runs.iter().map(partner).collect()
}

/// Whether pieces without inside lie along sides that there are: leaving them out glues their neighbours.
fn check_balance(pieces: &Pieces, runs: &[Run]) -> Result<(), Refusal> {
    for piece in (0..pieces.len()).filter(|&p| pieces.is_segment(p)) {
        let &[a, b] = pieces.ring(piece) else { continue };
        if runs.binary_search_by(|run| run.ends.cmp(&[a, b])).is_err() {
            return Err(Refusal::Gap { piece: piece as u32, ends: [a, b] });
        }
    }
    Ok(())
}

fn check_connected(
    pieces: &Pieces,
    runs: &[Run],
    partners: &[usize],
    solid: &[usize],
) -> Result<(), Refusal> {
    let mut neighbours: Vec<[u32; 2]> =
        partners.iter().zip(runs).map(|(&other, run)| [run.piece, runs[other].piece]).collect();
    neighbours.sort_unstable();
    let mut is_reached = vec![false; pieces.len()];
    let mut waiting = Vec::new();
    if let Some(&first) = solid.first() {
        is_reached[first] = true;
        waiting.push(first as u32);
    }
    let mut reached = waiting.len();
    while let Some(piece) = waiting.pop() {
        let begin = neighbours.partition_point(|pair| pair[0] < piece);
        for [_, other] in neighbours[begin..].iter().take_while(|pair| pair[0] == piece) {
            if !std::mem::replace(&mut is_reached[*other as usize], true) {
                reached += 1;
                waiting.push(*other);
            }
        }
    }
    // A file without any piece that has an inside reaches none of them, and is no sphere.
    if reached == solid.len() { Ok(()) } else { Err(Refusal::Parts { reached, pieces: solid.len() }) }
}
