//! A mesh as it is given, and the proof that it is a sphere.

use sha2::{Digest, Sha256};

/// A mesh as its file has it: vertices in the file's order, triangles with their corners in the file's order.
#[derive(Clone, Copy, Debug)]
pub struct GivenMesh<'a> {
    /// The position of each vertex of the file.
    pub positions: &'a [[f64; 3]],
    /// For each vertex of the file the first one that it was joined with, at the same place; empty where none was.
    pub joined_with: &'a [u32],
    /// The file's polygons, triangulated; of joined vertices the first is named.
    pub triangles: &'a [[u32; 3]],
}

/// Why a mesh is no sphere. Vertices and faces are the file's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshProblem {
    /// The mesh has fewer than four faces.
    #[error("it has {0} faces; the least are 4")]
    Faces(usize),
    /// The mesh has more elements than can be numbered.
    #[error("it has too many faces")]
    TooLarge,
    /// A face names a vertex that does not exist, or one twice.
    #[error("face {0} has a vertex twice or one that does not exist")]
    Face(usize),
    /// An edge has not two faces.
    #[error("the edge between vertices {0} and {1} has not two faces")]
    Edge(u32, u32),
    /// The faces cannot be turned so that neighbours agree.
    #[error("it is one-sided near face {0}")]
    OneSided(usize),
    /// The mesh has several parts, or parts that touch at a vertex, or handles.
    #[error("V - E + F is {0} instead of 2, or it has several parts")]
    Euler(i64),
}

/// A mesh that is closed, connected, orientable and has V - E + F = 2, with what the map file says of it.
#[derive(Clone, Debug)]
pub struct Mesh<'a> {
    given: GivenMesh<'a>,
    /// Whether each face has to be turned, corners 1 and 2 exchanged, to face outwards.
    turned: Vec<bool>,
    /// Number of each vertex of the file among those that faces use; `None` for the others. Joined ones have one number.
    numbers: Vec<Option<u32>>,
    /// The first vertex of the file with each number.
    used: Vec<u32>,
}

impl<'a> Mesh<'a> {
    /// Checks a mesh.
    pub fn new(given: GivenMesh<'a>) -> Result<Self, MeshProblem> {
        let GivenMesh { positions, joined_with, triangles } = given;
        if triangles.len() < 4 {
            return Err(MeshProblem::Faces(triangles.len()));
        }
        if triangles.len() > u32::MAX as usize / 3 || positions.len() >= u32::MAX as usize {
            return Err(MeshProblem::TooLarge);
        }
        let is_face = |t: &[u32; 3]| {
            t[0] != t[1] && t[1] != t[2] && t[2] != t[0] && t.iter().all(|v| (*v as usize) < positions.len())
        };
        if let Some(face) = triangles.iter().position(|t| !is_face(t)) {
            return Err(MeshProblem::Face(face));
        }
        let across = across(triangles)?;
        let turned = turned(given, &across)?;
        let mut is_used = vec![false; positions.len()];
        triangles.iter().flatten().for_each(|&v| is_used[v as usize] = true);
        let mut numbers = vec![None; positions.len()];
        let mut used = Vec::new();
        for v in (0..positions.len()).filter(|&v| is_used[v]) {
            numbers[v] = Some(used.len() as u32);
            used.push(v as u32);
        }
        for (v, first) in joined_with.iter().enumerate().take(positions.len()) {
            numbers[v] = numbers.get(*first as usize).copied().flatten();
        }
        // Faces hang together across edges, so every vertex with several fans lowers this below 2.
        let euler = used.len() as i64 - triangles.len() as i64 * 3 / 2 + triangles.len() as i64;
        if euler != 2 {
            return Err(MeshProblem::Euler(euler));
        }
        Ok(Self { given, turned, numbers, used })
    }

    /// The number of triangles.
    pub fn face_count(&self) -> usize {
        self.given.triangles.len()
    }

    /// The number of vertices of the file.
    pub fn file_vertices(&self) -> usize {
        self.given.positions.len()
    }

    /// The corners of a face, as the file has them; of joined vertices the first.
    pub fn corners(&self, face: u32) -> Option<[u32; 3]> {
        self.given.triangles.get(face as usize).copied()
    }

    /// The vertex that a number of the file stands for: of joined ones the first; `None` for one that no face uses.
    pub fn vertex(&self, of_file: u32) -> Option<u32> {
        let number = self.numbers.get(of_file as usize).copied().flatten()?;
        self.used.get(number as usize).copied()
    }

    /// Whether a face runs clockwise as the file has it, seen from outside.
    pub fn is_turned(&self, face: u32) -> bool {
        self.turned.get(face as usize) == Some(&true)
    }

    /// The place in space of a vertex of the file; the origin for one that does not exist.
    pub fn vertex_position(&self, vertex: u32) -> [f64; 3] {
        self.given.positions.get(vertex as usize).copied().unwrap_or_default()
    }

    /// The place in space of a point of a face.
    pub fn position(&self, face: u32, weights: [f64; 3]) -> [f64; 3] {
        let corners = self.corners(face).unwrap_or_default();
        [0, 1, 2].map(|axis| {
            let part = |k: usize| self.given.positions[corners[k] as usize][axis] * weights[k];
            part(0) + part(1) + part(2)
        })
    }

    /// The area of a face.
    pub fn area(&self, face: u32) -> f64 {
        let [p, q, r] = self.corners(face).unwrap_or_default().map(|v| self.given.positions[v as usize]);
        let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        let (u, v) = (minus(q, p), minus(r, p));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        0.5 * normal.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    /// The SHA-256 by which a map file knows the mesh, in hexadecimal digits: counts of vertices, faces and the file's vertices
    /// (u64), coordinates (f64), outward triangles (u32), the number of each of the file's vertices (u32, 2^32 - 1 for none),
    /// and which triangles were turned (u8).
    pub fn hash(&self) -> String {
        let mut hash = Sha256::new();
        for count in [self.used.len(), self.face_count(), self.file_vertices()] {
            hash.update((count as u64).to_le_bytes());
        }
        for &v in &self.used {
            self.given.positions[v as usize].iter().for_each(|x| hash.update(x.to_le_bytes()));
        }
        let number = |v: u32| self.numbers[v as usize].unwrap_or(u32::MAX);
        for (&[a, b, c], &turned) in self.given.triangles.iter().zip(&self.turned) {
            let corners = if turned { [a, c, b] } else { [a, b, c] };
            corners.iter().for_each(|&v| hash.update(number(v).to_le_bytes()));
        }
        self.numbers.iter().for_each(|n| hash.update(n.unwrap_or(u32::MAX).to_le_bytes()));
        self.turned.iter().for_each(|&turned| hash.update([u8::from(turned)]));
        hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// The other side of the edge of each side 3 f + k, which goes from corner k of face f to the next.
fn across(triangles: &[[u32; 3]]) -> Result<Vec<u32>, MeshProblem> {
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * triangles.len());
    for (f, t) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            sides.push(([a.min(b), a.max(b)], (3 * f + k) as u32));
        }
    }
    sides.sort_unstable();
    let mut across = vec![0; sides.len()];
    for group in sides.chunk_by(|a, b| a.0 == b.0) {
        let &[(_, one), (_, other)] = group else {
            let [a, b] = group[0].0;
            return Err(MeshProblem::Edge(a, b));
        };
        across[one as usize] = other;
        across[other as usize] = one;
    }
    Ok(across)
}

/// Which faces have to be turned so that neighbours run their edge in opposite directions and the volume is not negative.
fn turned(given: GivenMesh<'_>, across: &[u32]) -> Result<Vec<bool>, MeshProblem> {
    let triangles = given.triangles;
    let mut turned: Vec<Option<bool>> = vec![None; triangles.len()];
    turned[0] = Some(false);
    let mut waiting = vec![0_usize];
    let mut reached = 1;
    while let Some(f) = waiting.pop() {
        for k in 0..3 {
            let other = across[3 * f + k] as usize;
            let runs_alike = triangles[f][k] == triangles[other / 3][other % 3];
            let wanted = turned[f].map(|own| own != runs_alike);
            match turned[other / 3] {
                None => {
                    turned[other / 3] = wanted;
                    reached += 1;
                    waiting.push(other / 3);
                }
                known if known != wanted => return Err(MeshProblem::OneSided(f)),
                _ => {}
            }
        }
    }
    if reached != triangles.len() {
        return Err(MeshProblem::Euler(4));
    }
    let mut turned: Vec<bool> = turned.into_iter().map(|x| x == Some(true)).collect();
    if volume(given, &turned) < 0.0 {
        turned.iter_mut().for_each(|x| *x = !*x);
    }
    Ok(turned)
}

/// Six times the volume. Its rounding decides only for surfaces without inside, and then the hash does.
fn volume(given: GivenMesh<'_>, turned: &[bool]) -> f64 {
    let GivenMesh { positions, triangles, .. } = given;
    let origin = positions[triangles[0][0] as usize];
    let term = |(&[a, b, c], &turned): (&[u32; 3], &bool)| {
        let [p, q, r] = [a, b, c].map(|v| {
            let p = positions[v as usize];
            [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]]
        });
        let (q, r) = if turned { (r, q) } else { (q, r) };
        p[0] * (q[1] * r[2] - q[2] * r[1])
            + p[1] * (q[2] * r[0] - q[0] * r[2])
            + p[2] * (q[0] * r[1] - q[1] * r[0])
    };
    triangles.iter().zip(turned).map(term).sum()
}
