//! Pairs of meshes and landmarks that strain the numerics, by kind and seed: slivers, needles, pancakes, noise, hubs, meshes of very
//! different sizes; landmarks that are adjacent, dense, permuted, mirrored, on one limb, or beside edges.
//!
//! Every shape is a ball whose vertices were moved, so that directions from its middle tell which places correspond.
#![allow(dead_code, reason = "every test binary uses another part")]

use crate::rough_meshes::{LIMBS, Random, flipped, limbed, split_edge, split_face};
use conemap::io::landmark_file::LandmarkPoint;
use conemap::math::scalar::{cos, pow, sin};
use conemap::mesh::generators::icosphere;
use conemap::mesh::{SurfaceMesh, VertexId};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The kind of difficulty of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Points are inserted into faces beside a side, down to angles of 1e-6 degrees.
    Slivers,
    /// A ball is stretched up to 1:1000, or one of its vertices is pulled out as far.
    Needles,
    /// Bodies as flat as 1e-9 of their width.
    Pancakes,
    /// Vertices are moved by up to five edge lengths.
    Noise,
    /// A vertex with up to 1,000 neighbours.
    Hubs,
    /// Edges are flipped, points are inserted again and again, until rounding takes some for one point, and coordinates are of size 1e-60
    /// or 1e60.
    Rough,
    /// One mesh has up to 328,000 faces, and the other one as few as 20.
    Unequal,
    /// A vertex and its neighbours are landmarks.
    Adjacent,
    /// Every vertex, or every other one, is a landmark.
    Dense,
    /// The targets of some or of all pairs are exchanged.
    Permuted,
    /// Left and right are exchanged in all targets.
    Mirrored,
    /// All landmarks lie on one limb.
    OneLimb,
    /// Landmarks lie in faces, at 1e-6 to 1e-16 of the size of the face from an edge or a corner.
    BesideEdges,
    /// Both shapes and the landmarks are hard, each in a way of its own.
    Mixed,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 14] = [
        Self::Slivers,
        Self::Needles,
        Self::Pancakes,
        Self::Noise,
        Self::Hubs,
        Self::Rough,
        Self::Unequal,
        Self::Adjacent,
        Self::Dense,
        Self::Permuted,
        Self::Mirrored,
        Self::OneLimb,
        Self::BesideEdges,
        Self::Mixed,
    ];

    /// The name of the kind in tables and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Slivers => "slivers",
            Self::Needles => "needles",
            Self::Pancakes => "pancakes",
            Self::Noise => "noise",
            Self::Hubs => "hubs",
            Self::Rough => "rough",
            Self::Unequal => "unequal",
            Self::Adjacent => "adjacent",
            Self::Dense => "dense",
            Self::Permuted => "permuted",
            Self::Mirrored => "mirrored",
            Self::OneLimb => "one-limb",
            Self::BesideEdges => "beside-edges",
            Self::Mixed => "mixed",
        }
    }

    /// The kind with a name; `None` for unknown names.
    pub fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// The size of the meshes of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// The meshes have some hundred faces, and a map takes tenths of a second.
    Small,
    /// The meshes have up to 20,000 faces, and rarely 328,000.
    Any,
}

/// Two meshes with landmark pairs.
pub struct HostileCase {
    pub meshes: [SurfaceMesh; 2],
    pub pairs: Vec<[LandmarkPoint; 2]>,
}

/// The case of a kind and a seed; the same seed gives the same case.
pub fn case(kind: Kind, seed: u64, size: Size) -> HostileCase {
    let mut random = Random::new(seed.wrapping_mul(0x1_0000_01b3) ^ kind as u64);
    let random = &mut random;
    let bodies = bodies(kind, size, random);
    let pairs = match kind {
        Kind::Adjacent => adjacent(&bodies, random),
        Kind::Dense => dense(&bodies, random),
        Kind::Permuted => permuted(spread(&bodies, 6 + random.below(34), |d| d), random),
        Kind::Mirrored => spread(&bodies, 6 + random.below(20), |d| d * DVec3::new(-1.0, 1.0, 1.0)),
        Kind::OneLimb => on_one_limb(&bodies, random),
        Kind::BesideEdges => beside_edges(&bodies, random),
        Kind::Mixed => match random.below(4) {
            0 => permuted(spread(&bodies, 6 + random.below(14), |d| d), random),
            1 => on_one_limb(&bodies, random),
            2 => beside_edges(&bodies, random),
            _ => spread(&bodies, 4 + random.below(30), |d| d),
        },
        _ => spread(&bodies, 4 + random.below(16), |d| d),
    };
    HostileCase { meshes: bodies.map(|body| body.mesh), pairs }
}

/// A mesh whose vertices lie in known directions from its middle.
struct Body {
    mesh: SurfaceMesh,
    directions: Vec<DVec3>,
}

impl Body {
    /// The body of a triangulated ball.
    fn ball(mesh: SurfaceMesh) -> Self {
        let directions: Vec<DVec3> = mesh.positions().iter().map(|p| p.normalize()).collect();
        Self { mesh, directions }
    }

    /// The body with its vertices moved; the directions stay.
    fn moved(self, place: impl FnMut(&DVec3) -> DVec3) -> Self {
        let positions = self.mesh.positions().iter().map(place).collect();
        Self { mesh: self.mesh.with_positions(positions), directions: self.directions }
    }

    /// The body bent a little, at random.
    fn bent(self, random: &mut Random) -> Self {
        let [a, b, c] = [0; 3].map(|_| 0.3 * random.unit());
        self.moved(|p| DVec3::new((1.0 + a) * p.x, p.y + b * p.x * p.x / (1.0 + p.x.abs()), p.z * (1.0 + c)))
    }

    /// The vertex nearest to a direction, among those that are not taken.
    fn vertex_at(&self, direction: DVec3, taken: &[u32]) -> Option<u32> {
        let free = (0..self.directions.len() as u32).filter(|v| !taken.contains(v));
        let along = |v: &u32| self.directions[*v as usize].dot(direction);
        free.max_by(|a, b| along(a).total_cmp(&along(b)))
    }
}

fn bodies(kind: Kind, size: Size, random: &mut Random) -> [Body; 2] {
    let usual = 1 + random.below(if size == Size::Small { 2 } else { 4 });
    match kind {
        Kind::Unequal => {
            let levels = match (size, random.below(24)) {
                (Size::Small, _) => 3,
                (_, 0) => 7,
                (_, 1..=3) => 6,
                (_, n) => 3 + n % 3,
            };
            [Body::ball(icosphere(levels)).bent(random), Body::ball(icosphere(0)).bent(random)]
        }
        Kind::Adjacent => same_ball(usual.max(2), random),
        Kind::Dense => same_ball(usual.min(2), random),
        Kind::Permuted | Kind::Mirrored | Kind::OneLimb | Kind::BesideEdges => {
            let shape = |random: &mut Random| {
                let ball = Body::ball(icosphere(usual.max(2)));
                if random.unit() < 0.6 { ball.moved(|p| limbed(*p)) } else { ball }
            };
            [shape(random).bent(random), shape(random).bent(random)]
        }
        Kind::Mixed => [(); 2].map(|()| {
            let kinds = [Kind::Slivers, Kind::Needles, Kind::Pancakes, Kind::Noise, Kind::Hubs, Kind::Rough];
            hard(kinds[random.below(kinds.len())], usual, size, random)
        }),
        _ => {
            let hard_one = hard(kind, usual, size, random);
            let other = if random.unit() < 0.5 {
                hard(kind, usual, size, random)
            } else {
                Body::ball(icosphere(usual)).bent(random)
            };
            if random.unit() < 0.5 { [hard_one, other] } else { [other, hard_one] }
        }
    }
}

/// A ball and either the same ball or a bent copy with the same triangles.
fn same_ball(levels: usize, random: &mut Random) -> [Body; 2] {
    let ball = || Body::ball(icosphere(levels));
    [ball(), if random.unit() < 0.5 { ball() } else { ball().bent(random) }]
}

/// A shape that is hard by itself.
fn hard(kind: Kind, levels: usize, size: Size, random: &mut Random) -> Body {
    match kind {
        Kind::Slivers => slivers(levels, random),
        Kind::Needles => needle(levels, random),
        Kind::Pancakes => {
            let flat = pow(10.0, -9.0 * random.unit());
            Body::ball(icosphere(levels)).moved(|p| DVec3::new(p.x, p.y, flat * p.z))
        }
        Kind::Noise => {
            let reach = pow(10.0, 0.7 - 2.5 * random.unit()) / f64::from(1 << levels);
            Body::ball(icosphere(levels)).moved(|p| *p + reach * anywhere(random))
        }
        Kind::Hubs => hub(size, random),
        _ => rough(levels, random),
    }
}

/// A random point of the cube of side 2 around the origin.
fn anywhere(random: &mut Random) -> DVec3 {
    DVec3::from_array([0; 3].map(|_| 2.0 * random.unit() - 1.0))
}

/// A ball with a point inserted into some of its faces, so near to a side that angles are as small as 1e-6 degrees.
fn slivers(levels: usize, random: &mut Random) -> Body {
    let ball = icosphere(levels);
    let mut places: Vec<DVec3> = ball.positions().iter().copied().collect();
    let mut faces = Vec::new();
    let share = random.unit();
    for (face, &[a, b, c]) in ball.triangles().iter_enumerated() {
        if random.unit() >= share {
            faces.push([a, b, c]);
            continue;
        }
        let (along, height) = (0.2 + 0.6 * random.unit(), pow(10.0, -8.0 * random.unit()));
        let [p, q, r] = ball.corners(face);
        let v = VertexId::from(places.len());
        places.push(p + (1.0 - height) * along * (q - p) + height * (r - p));
        faces.extend([[a, b, v], [b, c, v], [c, a, v]]);
    }
    let mesh = SurfaceMesh::from_triangles(places.into(), faces.into()).expect("faces may be split");
    Body::ball(mesh).bent(random)
}

/// A ball that is stretched, or from which one vertex is pulled out.
fn needle(levels: usize, random: &mut Random) -> Body {
    let ball = Body::ball(icosphere(levels));
    let length = pow(10.0, 3.0 * random.unit());
    if random.unit() < 0.5 {
        return ball.moved(|p| DVec3::new(p.x, p.y, length * p.z));
    }
    let pulled = random.below(ball.directions.len());
    let end = ball.directions[pulled];
    ball.moved(|p| if *p == end { length * *p } else { *p })
}

/// A ball with flipped edges and inserted points, at any scale.
fn rough(levels: usize, random: &mut Random) -> Body {
    let mut mesh = icosphere(levels.min(3));
    for _ in 0..mesh.vertex_count().min(400) {
        mesh = match random.below(3) {
            0 => flipped(&mesh, random),
            1 => split_face(&mesh, random),
            _ => split_edge(&mesh, random),
        };
    }
    let (noise, scale) = (0.1 * random.small(), [1.0, 1e-60, 1e60][random.below(3)]);
    Body::ball(mesh).moved(|p| scale * (*p + noise * anywhere(random)))
}

/// A body of two vertices with up to 1,000 neighbours each, and one to three rings of vertices between them.
fn hub(size: Size, random: &mut Random) -> Body {
    let (around, rings) = match size {
        Size::Small => (400, 1),
        Size::Any => (200 + random.below(801), 1 + random.below(3)),
    };
    let mut places = vec![DVec3::Z, DVec3::NEG_Z];
    for ring in 0..rings {
        let from_pole = PI * (ring + 1) as f64 / (rings + 1) as f64;
        places.extend((0..around).map(|k| {
            let angle = TAU * (k as f64 + 0.5 * ring as f64) / around as f64;
            DVec3::new(sin(from_pole) * cos(angle), sin(from_pole) * sin(angle), cos(from_pole))
        }));
    }
    let at = |ring: usize, k: usize| VertexId::from(2 + ring * around + k % around);
    let mut faces = Vec::new();
    for k in 0..around {
        faces.push([VertexId(0), at(0, k), at(0, k + 1)]);
        faces.push([VertexId(1), at(rings - 1, k + 1), at(rings - 1, k)]);
        for ring in 1..rings {
            let [a, b, c, d] = [at(ring - 1, k), at(ring - 1, k + 1), at(ring, k), at(ring, k + 1)];
            faces.extend([[a, c, b], [b, c, d]]);
        }
    }
    let mesh = SurfaceMesh::from_triangles(places.into(), faces.into()).expect("rings between two hubs");
    Body::ball(mesh).bent(random)
}

/// Picks `count` vertices of the source far from each other, each with the vertex of the target to which `image` takes its direction.
fn spread(bodies: &[Body; 2], count: usize, image: impl Fn(DVec3) -> DVec3) -> Vec<[LandmarkPoint; 2]> {
    let [source, target] = bodies;
    let most = source.directions.len().min(target.directions.len());
    let mut nearest = vec![f64::INFINITY; source.directions.len()];
    let (mut next, mut chosen) = (0, Vec::new());
    while chosen.len() < count.clamp(4, most) {
        chosen.push(next);
        let last = source.directions[next];
        nearest.iter_mut().zip(&source.directions).for_each(|(d, p)| *d = d.min(p.distance(last)));
        next = (0..nearest.len()).max_by(|&a, &b| nearest[a].total_cmp(&nearest[b])).expect("vertices");
        // Several vertices may lie in one direction; then the search ends.
        if chosen.contains(&next) {
            break;
        }
    }
    let mut taken = Vec::new();
    for &v in &chosen {
        taken.extend(target.vertex_at(image(source.directions[v]), &taken));
    }
    let vertices = |(v, t): (&usize, &u32)| [LandmarkPoint::Vertex(*v as u32), LandmarkPoint::Vertex(*t)];
    chosen.iter().zip(&taken).map(vertices).collect()
}

/// The pairs with all of their targets in random order, or with those of a few exchanged.
fn permuted(mut pairs: Vec<[LandmarkPoint; 2]>, random: &mut Random) -> Vec<[LandmarkPoint; 2]> {
    let exchanges = if random.unit() < 0.5 { pairs.len() } else { 1 + random.below(2) };
    for k in 0..exchanges.min(pairs.len()) {
        let (a, b) = (pairs.len() - 1 - k, random.below(pairs.len() - k));
        let target = pairs[a][1];
        pairs[a][1] = pairs[b][1];
        pairs[b][1] = target;
    }
    pairs
}

/// Pairs of a vertex, its neighbours, sometimes their neighbours, and sometimes three vertices far away; both meshes have the same
/// triangles.
fn adjacent(bodies: &[Body; 2], random: &mut Random) -> Vec<[LandmarkPoint; 2]> {
    let mesh = &bodies[0].mesh;
    let mut vertices = vec![random.below(mesh.vertex_count()) as u32];
    for _ in 0..1 + random.below(2) {
        let near = mesh.triangles().iter().filter(|t| t.iter().any(|v| vertices.contains(&v.0)));
        let ring: Vec<u32> = near.flatten().map(|v| v.0).collect();
        vertices.extend(ring);
        vertices.sort_unstable();
        vertices.dedup();
    }
    if random.unit() < 0.5 {
        let far = [0; 3].map(|_| random.below(mesh.vertex_count()) as u32);
        vertices.extend(far);
        vertices.sort_unstable();
        vertices.dedup();
    }
    vertices.into_iter().map(|v| [LandmarkPoint::Vertex(v); 2]).collect()
}

/// Pairs of every vertex, or of every second or third one; both meshes have the same triangles.
fn dense(bodies: &[Body; 2], random: &mut Random) -> Vec<[LandmarkPoint; 2]> {
    let count = bodies[0].directions.len() as u32;
    (0..count).step_by(1 + random.below(3)).map(|v| [LandmarkPoint::Vertex(v); 2]).collect()
}

/// Pairs of vertices of one limb only.
fn on_one_limb(bodies: &[Body; 2], random: &mut Random) -> Vec<[LandmarkPoint; 2]> {
    let axis = LIMBS[random.below(LIMBS.len())];
    let mut taken: [Vec<u32>; 2] = Default::default();
    for _ in 0..4 + random.below(8) {
        let direction = (axis + 0.35 * anywhere(random)).normalize();
        let found = [0, 1].map(|side| bodies[side].vertex_at(direction, &taken[side]));
        let [Some(source), Some(target)] = found else { break };
        taken[0].push(source);
        taken[1].push(target);
    }
    taken[0]
        .iter()
        .zip(&taken[1])
        .map(|(&s, &t)| [LandmarkPoint::Vertex(s), LandmarkPoint::Vertex(t)])
        .collect()
}

/// The pairs of [`spread`], each point moved into a face beside its vertex: near a corner, near an edge, or near neither.
fn beside_edges(bodies: &[Body; 2], random: &mut Random) -> Vec<[LandmarkPoint; 2]> {
    let mut pairs = spread(bodies, 4 + random.below(12), |d| d);
    for pair in &mut pairs {
        for (side, point) in pair.iter_mut().enumerate() {
            *point = beside(&bodies[side].mesh, *point, random);
        }
    }
    pairs
}

fn beside(mesh: &SurfaceMesh, point: LandmarkPoint, random: &mut Random) -> LandmarkPoint {
    let LandmarkPoint::Vertex(v) = point else { return point };
    let Some(face) = mesh.triangles().iter().position(|t| t.contains(&VertexId(v))) else { return point };
    let corners = mesh.triangles().raw[face];
    let own = corners.iter().position(|w| w.0 == v).unwrap_or(0);
    let near = pow(10.0, -6.0 - 10.0 * random.unit());
    let along = 0.5 * random.unit();
    // The weights are by corner, beginning with the vertex itself.
    let weights = match random.below(3) {
        0 => [1.0 - 2.0 * near, near, near],
        1 => [1.0 - along - near, along, near],
        _ => [1.0 - along - 0.3, along, 0.3],
    };
    let mut barycentric = [0.0; 3];
    (0..3).for_each(|k| barycentric[(own + k) % 3] = weights[k]);
    LandmarkPoint::OnFace { face: face as u32, barycentric }
}
