//! Crossings of straight lines on a mesh.
//!
//! A line is known by the edges that it crosses and the places on them, the same for both triangles of an edge. In a triangle it
//! is a chord between two points of the boundary; two chords cross where their ends alternate along it.

use super::judged::Judged;
use super::tracer::Line;
use crate::mesh::{FaceId, HalfedgeId};
use typed_index_collections::TiVec;

/// A point of a triangle's boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ChordEnd {
    /// A corner at which a line begins or ends.
    Corner(usize),
    /// A point of the edge after a corner; the share of the edge before it.
    Edge(usize, f64),
}

impl ChordEnd {
    /// Its place along the boundary: corner k at k, the edge after it from k to k + 1.
    fn place(self) -> f64 {
        match self {
            Self::Corner(corner) => corner as f64,
            Self::Edge(edge, share) => (edge as f64 + share) % 3.0,
        }
    }
}

/// A line's part in a triangle.
type Chord = [ChordEnd; 2];

/// The number of pairs of chords that cross. Lines that begin or end at one corner share it and do not cross there.
pub(super) fn count(judged: &Judged<'_>, lines: &[Line]) -> usize {
    let mut chords: TiVec<FaceId, Vec<Chord>> = judged.mesh.faces().map(|_| Vec::new()).collect();
    let corner = |h: HalfedgeId| ChordEnd::Corner(h.corner());
    let edge = |h: HalfedgeId, share: f64| ChordEnd::Edge(h.corner(), share);
    for line in lines {
        let Some(end) = line.end else { continue };
        let (mut face, mut from) = (line.begin.face(), corner(line.begin));
        for &(exit, share) in &line.crossings {
            chords[face].push([from, edge(exit, share)]);
            let entered = judged.mesh.twin(exit);
            (face, from) = (entered.face(), edge(entered, 1.0 - share));
        }
        chords[face].push([from, corner(end.back.corner)]);
    }
    let crossing = |chords: &Vec<Chord>| {
        let pairs = (0..chords.len()).flat_map(|i| (0..i).map(move |j| [i, j]));
        pairs.filter(|&[i, j]| cross(chords[i], chords[j])).count()
    };
    chords.iter().map(crossing).sum()
}

/// Whether two chords meet elsewhere than at a common end of their lines.
fn cross(a: Chord, b: Chord) -> bool {
    let both = || a.into_iter().flat_map(|x| b.into_iter().map(move |y| (x, y)));
    let is_corner = |end: ChordEnd| matches!(end, ChordEnd::Corner(_));
    let mut meet = both().filter(|(x, y)| x.place() == y.place()).peekable();
    if meet.peek().is_some() {
        // Lines that meet at a point of an edge count as crossing, as do lines that pass a landmark.
        return meet.any(|(x, y)| !(is_corner(x) && is_corner(y)));
    }
    let [low, high] = [a[0].place().min(a[1].place()), a[0].place().max(a[1].place())];
    let inside = |end: ChordEnd| low < end.place() && end.place() < high;
    inside(b[0]) != inside(b[1])
}

#[cfg(test)]
mod tests {
    use super::ChordEnd::{Corner, Edge};
    use super::cross;

    #[test]
    fn chords_cross_where_their_ends_alternate() {
        let across = [Edge(0, 0.5), Edge(1, 0.5)];
        assert!(cross(across, [Edge(1, 0.2), Edge(2, 0.5)]));
        assert!(cross([across[1], across[0]], [Edge(2, 0.5), Edge(1, 0.2)]));
        assert!(!cross(across, [Edge(0, 0.2), Edge(2, 0.5)]));
        assert!(!cross(across, [Edge(0, 0.7), Edge(1, 0.2)]));
        // From a corner to the opposite edge, over a chord and beside it.
        assert!(cross([Corner(0), Edge(1, 0.5)], [Edge(0, 0.5), Edge(2, 0.5)]));
        assert!(!cross([Corner(0), Edge(1, 0.5)], [Edge(0, 0.5), Edge(1, 0.2)]));
    }

    #[test]
    fn lines_share_only_the_corners_at_which_they_end() {
        let line = [Corner(0), Edge(1, 0.5)];
        assert!(!cross(line, [Corner(0), Edge(1, 0.2)]));
        assert!(cross([Edge(0, 0.5), Edge(1, 0.5)], [Edge(0, 0.5), Edge(2, 0.5)]));
        // Another line passes the corner.
        assert!(cross(line, [Edge(0, 0.0), Edge(1, 0.7)]) && cross(line, [Edge(2, 1.0), Edge(1, 0.7)]));
    }

    #[test]
    fn a_line_along_an_edge_crosses_nothing_beside_it() {
        assert!(!cross([Corner(0), Corner(1)], [Edge(1, 0.5), Edge(2, 0.5)]));
        assert!(!cross([Corner(0), Edge(1, 0.0)], [Edge(1, 0.5), Edge(2, 0.5)]));
    }
}
