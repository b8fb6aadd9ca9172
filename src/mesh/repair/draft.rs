//! A surface while it is repaired: triangles that know where in the file they come from.

use crate::math::triangle;
use crate::mesh::check::Triangle;
use glam::DVec3;

/// A surface while it is repaired. Nothing is known of its connectivity.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    /// The file's vertices in their order, then those that the repair added.
    pub positions: Vec<DVec3>,
    /// The number in the file of each vertex, the original's for a copy; `None` for vertices that the repair added.
    pub numbers: Vec<Option<u32>>,
    /// The faces: the file's that are left in their order, then those that the repair made.
    pub faces: Vec<DraftFace>,
}

/// A triangle while its surface is repaired.
#[derive(Clone, Copy, Debug)]
pub(super) struct DraftFace {
    /// Its vertices.
    pub corners: Triangle,
    /// The file's vertices at its corners, before any were joined; [`NONE`] at those that the repair added.
    pub file_corners: Triangle,
    /// The origin of the face.
    pub origin: FaceOrigin,
}

/// The origin of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FaceOrigin {
    /// The face is one of the triangulated file.
    File {
        /// The face's number there.
        number: u32,
        /// Whether the face's last two corners were exchanged.
        turned: bool,
    },
    /// A face of the file was cut where the corner of a face without area lay on its edge.
    Recut,
    /// The face is part of a cap, which closes a hole.
    Cap,
}

impl DraftFace {
    /// The ends of its edge k, from corner k on.
    pub fn edge(&self, k: usize) -> [u32; 2] {
        [self.corners[k], self.corners[(k + 1) % 3]]
    }

    /// The same face seen from its other side.
    pub fn turned(self) -> Self {
        let ([a, b, c], [i, j, k]) = (self.corners, self.file_corners);
        let origin = match self.origin {
            FaceOrigin::File { number, turned } => FaceOrigin::File { number, turned: !turned },
            made => made,
        };
        Self { corners: [a, c, b], file_corners: [i, k, j], origin }
    }

    /// Its number in the triangulated file, where it has one.
    pub fn number(&self) -> Option<usize> {
        match self.origin {
            FaceOrigin::File { number, .. } => Some(number as usize),
            FaceOrigin::Recut | FaceOrigin::Cap => None,
        }
    }
}

impl Draft {
    /// Positions of a face's corners.
    pub fn places(&self, face: &DraftFace) -> [DVec3; 3] {
        face.corners.map(|v| self.positions[v as usize])
    }

    /// Area of a face.
    pub fn face_area(&self, face: &DraftFace) -> f64 {
        let [p, q, r] = self.places(face);
        triangle::area(p, q, r)
    }

    /// Area of all faces.
    pub fn area(&self) -> f64 {
        self.faces.iter().map(|face| self.face_area(face)).sum()
    }

    /// The number of a vertex in the file; of one that has none, the number of the vertex itself.
    pub fn number(&self, v: u32) -> usize {
        self.numbers[v as usize].unwrap_or(v) as usize
    }

    /// Takes the faces over with those of the file first.
    pub fn with_faces(self, faces: impl IntoIterator<Item = DraftFace>) -> Self {
        let (file, made): (Vec<_>, Vec<_>) = faces.into_iter().partition(|face| face.number().is_some());
        Self { faces: file.into_iter().chain(made).collect(), ..self }
    }
}

/// An edge with the halfedges of faces that lie along it.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    /// Its vertices, the lesser number first.
    pub ends: [u32; 2],
    /// Halfedges 3 f + k of faces, rising.
    pub halfedges: Vec<u32>,
}

/// All edges of some faces, in the order of their ends.
pub(super) fn edges(faces: &[DraftFace]) -> Vec<Edge> {
    let mut halfedges: Vec<([u32; 2], u32)> = Vec::with_capacity(faces.len() * 3);
    for (f, face) in faces.iter().enumerate() {
        for k in 0..3 {
            let [a, b] = face.edge(k);
            halfedges.push(([a.min(b), a.max(b)], (3 * f + k) as u32));
        }
    }
    halfedges.sort_unstable();
    let same_ends = |a: &([u32; 2], u32), b: &([u32; 2], u32)| a.0 == b.0;
    let edge = |group: &[([u32; 2], u32)]| Edge {
        ends: group[0].0,
        halfedges: group.iter().map(|(_, h)| *h).collect(),
    };
    halfedges.chunk_by(same_ends).map(edge).collect()
}

/// The number that stands for no halfedge.
pub(super) const NONE: u32 = u32::MAX;

/// The halfedge across each halfedge where exactly two faces meet; [`NONE`] at other edges.
pub(super) fn across(faces: &[DraftFace], edges: &[Edge]) -> Vec<u32> {
    let mut across = vec![NONE; faces.len() * 3];
    for edge in edges {
        if let [a, b] = edge.halfedges[..] {
            across[a as usize] = b;
            across[b as usize] = a;
        }
    }
    across
}

/// The part that each face belongs to, connected by `across`: parts are numbered in the order of their first faces.
pub(super) fn parts(faces: usize, across: &[u32]) -> Vec<usize> {
    let mut part = vec![usize::MAX; faces];
    let mut stack = Vec::new();
    let mut count = 0;
    for start in 0..faces {
        if part[start] != usize::MAX {
            continue;
        }
        part[start] = count;
        stack.push(start);
        while let Some(f) = stack.pop() {
            for h in &across[3 * f..3 * f + 3] {
                let next = *h as usize / 3;
                if *h != NONE && part[next] == usize::MAX {
                    part[next] = count;
                    stack.push(next);
                }
            }
        }
        count += 1;
    }
    part
}
