//! Closed meshes with bad triangles, by seed: slivers, needles, flipped edges, noise, extreme scales.
#![allow(dead_code, reason = "every test binary uses another part")]

use conemap::math::random::SplitMix;
use conemap::math::scalar::pow;
use conemap::mesh::generators::{icosphere, octahedron};
use conemap::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use glam::DVec3;

/// The random numbers of the library, and some distributions made from them.
pub struct Random(SplitMix);

impl Random {
    /// The random numbers of a seed.
    pub fn new(seed: u64) -> Self {
        Self(SplitMix::new(seed))
    }

    /// A number, uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    /// A whole number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }

    /// A number between 1e-12 and 1/2, uniform in its logarithm.
    pub fn small(&mut self) -> f64 {
        0.5 * pow(10.0, -11.7 * self.unit())
    }
}

/// The directions of the limbs of [`limbed`].
pub const LIMBS: [DVec3; 3] = [DVec3::X, DVec3::new(-0.6, 0.8, 0.0), DVec3::new(0.0, -0.6, 0.8)];

/// The place of a point of the unit ball on a ball with three limbs.
pub fn limbed(p: DVec3) -> DVec3 {
    p * (1.0 + LIMBS.iter().map(|l| 2.0 * pow(l.dot(p).max(0.0), 8.0)).sum::<f64>())
}

/// A ball, an ellipsoid, or a ball with three limbs, by seed.
pub fn body(random: &mut Random) -> SurfaceMesh {
    let (shape, levels) = (random.below(3), 1 + random.below(3));
    let ball = icosphere(levels);
    let place = |p: &DVec3| match shape {
        0 => *p,
        1 => *p * DVec3::new(1.0, 3.0, 0.3),
        _ => limbed(*p),
    };
    ball.with_positions(ball.positions().iter().map(place).collect())
}

/// The octahedron with points put into its faces and onto its edges: the same surface, cut into slivers and needles.
pub fn cut_octahedron(random: &mut Random, points: usize) -> SurfaceMesh {
    let mut mesh = octahedron();
    for _ in 0..points {
        mesh = if random.unit() < 0.5 { split_face(&mesh, random) } else { split_edge(&mesh, random) };
    }
    mesh
}

/// A rougher surface with the same number of handles: some edges are flipped, points inserted near corners, vertices moved by noise, and
/// the whole is scaled.
pub fn roughened(mesh: &SurfaceMesh, random: &mut Random) -> SurfaceMesh {
    let mut mesh = mesh.clone();
    let changes = mesh.vertex_count();
    let (flips, noise) = (random.unit(), if random.unit() < 0.5 { 0.0 } else { random.small() });
    for _ in 0..changes {
        mesh = match random.unit() {
            x if x < 0.6 * flips => flipped(&mesh, random),
            x if x < 0.8 => split_face(&mesh, random),
            _ => split_edge(&mesh, random),
        };
    }
    let size = mesh.area().sqrt() * 0.1 * noise;
    let scale = [1.0, 1e-60, 1e60][random.below(3)];
    let moved = mesh.positions().iter().map(|p| {
        let by = DVec3::new(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5);
        scale * (*p + size * by)
    });
    let moved = moved.collect();
    mesh.with_positions(moved)
}

fn rebuilt(
    mesh: &SurfaceMesh,
    added: Option<DVec3>,
    change: impl Fn(usize, [VertexId; 3]) -> Vec<[VertexId; 3]>,
) -> Option<SurfaceMesh> {
    let positions = mesh.positions().iter().copied().chain(added).collect();
    let faces = mesh.triangles().iter().enumerate().flat_map(|(f, corners)| change(f, *corners)).collect();
    SurfaceMesh::from_triangles(positions, faces).ok()
}

/// Inserts a point into a random face, sometimes near a corner or a side.
pub fn split_face(mesh: &SurfaceMesh, random: &mut Random) -> SurfaceMesh {
    let face = FaceId::from(random.below(mesh.face_count()));
    let (s, t) = (random.small(), random.small());
    let first = random.below(3);
    let [a, b, c] = [0, 1, 2].map(|k| mesh.corners(face)[(first + k) % 3]);
    let point = a + s * (b - a) + t * (c - a);
    if [a, b, c].contains(&point) {
        return mesh.clone();
    }
    let v = VertexId::from(mesh.vertex_count());
    let change = |f: usize, [a, b, c]: [VertexId; 3]| {
        if f == face.index() { vec![[a, b, v], [b, c, v], [c, a, v]] } else { vec![[a, b, c]] }
    };
    rebuilt(mesh, Some(point), change).expect("a face may be split")
}

/// Inserts a point on a random edge, sometimes near its start.
pub fn split_edge(mesh: &SurfaceMesh, random: &mut Random) -> SurfaceMesh {
    let h = HalfedgeId::from(random.below(3 * mesh.face_count()));
    let [p, q] = [mesh.tail(h), mesh.head(h)].map(|v| mesh.positions()[v]);
    let point = p + random.small() * (q - p);
    if point == p || point == q {
        return mesh.clone();
    }
    let v = VertexId::from(mesh.vertex_count());
    let (ends, faces) = ([mesh.tail(h), mesh.head(h)], [h, mesh.twin(h)].map(|h| h.face().index()));
    let change = |f: usize, corners: [VertexId; 3]| {
        if !faces.contains(&f) {
            return vec![corners];
        }
        let with = |old: VertexId| corners.map(|w| if w == old { v } else { w });
        vec![with(ends[0]), with(ends[1])]
    };
    rebuilt(mesh, Some(point), change).expect("an edge may be split")
}

/// Flips a random edge to the other diagonal of its two faces, where that is not an edge already.
pub fn flipped(mesh: &SurfaceMesh, random: &mut Random) -> SurfaceMesh {
    let h = HalfedgeId::from(random.below(3 * mesh.face_count()));
    let t = mesh.twin(h);
    let [i, j, k, l] = [mesh.tail(h), mesh.head(h), mesh.tail(h.prev()), mesh.tail(t.prev())];
    let change = |f: usize, corners: [VertexId; 3]| match f {
        f if f == h.face().index() => vec![[l, k, i]],
        f if f == t.face().index() => vec![[k, l, j]],
        _ => vec![corners],
    };
    rebuilt(mesh, None, change).unwrap_or_else(|| mesh.clone())
}
