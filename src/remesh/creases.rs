//! Sharp edges of the given surface, as lines along which the vertices of the new mesh stay.
//!
//! A chain is a line of sharp edges between two corners, or a closed one. Corners are where more or fewer than two sharp edges
//! meet, or where the line bends sharply: they stay in the mesh. A chain shorter than a few of the new edges is no line but a
//! dent or a part of fur, and is left out.

use crate::math::scalar::{cos, max};
use crate::math::triangle::angle_between;
use crate::mesh::segment_index::{OnSegment, SegmentIndex};
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use glam::DVec3;
use rustc_hash::FxHashMap;
use typed_index_collections::{TiVec, ti_vec};

/// The length of the shortest line of sharp edges that is kept, in new edges. Shorter ones are left out again and again until none
/// is left; left out only once, even lines below five left short ones where they had met others.
const SHORTEST: f64 = 3.0;
/// The largest angle (45 degrees) by which a line turns at a vertex that is no corner. Chosen by hand.
const BEND: f64 = std::f64::consts::FRAC_PI_4;
/// The ratio of double area to longest side squared below which a triangle's normal means nothing. Chosen by hand.
const SLIVER: f64 = 0.02;

/// The kind of a vertex with regard to the sharp edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The vertex is on no sharp edge.
    Free,
    /// The vertex is inside the chain of that number.
    Along(u32),
    /// The vertex is the end of a chain.
    Corner,
}

/// The sharp edges of a mesh that changes, and their lines on the given surface.
pub(super) struct Creases {
    /// The chain of each sharp edge, by the edge's vertices, the lower one first.
    chains: FxHashMap<[VertexId; 2], u32>,
    kinds: TiVec<VertexId, Kind>,
    /// The given surface's sharp edges.
    segments: Vec<Segment>,
    index: SegmentIndex,
}

struct Segment {
    chain: u32,
    face: FaceId,
}

/// A point of a chain.
pub(super) struct ChainPoint {
    pub position: DVec3,
    /// A face of the given surface beside it.
    pub face: FaceId,
}

impl Creases {
    /// The sharp edges of a surface: where the normals of two faces differ by more than `angle`, in lines of at least some
    /// edges of the new `length`.
    pub fn find(surface: &SurfaceMesh, angle: f64, length: f64) -> Self {
        let sharp = surface.edges().filter(|&h| is_sharp(surface, h, angle)).collect();
        let Lines { sharp, chains, is_corner } = Lines::find(surface, sharp, SHORTEST * length);
        let ends = |h: HalfedgeId| [surface.tail(h), surface.head(h)];
        let places = sharp.iter().map(|&h| ends(h).map(|v| surface.positions()[v])).collect();
        let mut creases = Self {
            chains: FxHashMap::default(),
            kinds: ti_vec![Kind::Free; surface.vertex_count()],
            segments: Vec::with_capacity(sharp.len()),
            index: SegmentIndex::new(places),
        };
        for (&h, chain) in sharp.iter().zip(chains) {
            creases.chains.insert(sorted(ends(h)), chain);
            for v in ends(h) {
                creases.kinds[v] = if is_corner[v] { Kind::Corner } else { Kind::Along(chain) };
            }
            creases.segments.push(Segment { chain, face: h.face() });
        }
        creases
    }

    /// Holds vertices like corners.
    pub fn hold(&mut self, vertices: &[VertexId]) {
        vertices.iter().for_each(|&v| self.kinds[v] = Kind::Corner);
    }

    /// The kind of a vertex.
    pub fn kind(&self, v: VertexId) -> Kind {
        self.kinds[v]
    }

    /// The chain of the edge between two vertices, if it is sharp.
    pub fn chain(&self, ends: [VertexId; 2]) -> Option<u32> {
        self.chains.get(&sorted(ends)).copied()
    }

    /// The edge between two vertices was split by the next one.
    pub fn split(&mut self, ends: [VertexId; 2], middle: VertexId) {
        let chain = self.chains.remove(&sorted(ends));
        self.kinds.push(chain.map_or(Kind::Free, Kind::Along));
        if let Some(chain) = chain {
            ends.iter().for_each(|&end| {
                self.chains.insert(sorted([end, middle]), chain);
            });
        }
    }

    /// A vertex with these neighbours went into one of them.
    pub fn collapse(&mut self, removed: VertexId, kept: VertexId, neighbours: &[VertexId]) {
        for &w in neighbours {
            if let Some(chain) = self.chains.remove(&sorted([removed, w]))
                && w != kept
            {
                self.chains.insert(sorted([kept, w]), chain);
            }
        }
    }

    /// The nearest point of a chain.
    pub fn nearest(&self, p: DVec3, chain: u32) -> ChainPoint {
        let found = self.index.nearest_where(p, |k| self.segments[k].chain == chain);
        let on_chain =
            |OnSegment { segment, position }| ChainPoint { position, face: self.segments[segment].face };
        found.map_or(ChainPoint { position: p, face: FaceId(0) }, on_chain)
    }
}

fn sorted([a, b]: [VertexId; 2]) -> [VertexId; 2] {
    if a < b { [a, b] } else { [b, a] }
}

fn is_sharp(surface: &SurfaceMesh, h: HalfedgeId, angle: f64) -> bool {
    let normals = [h, surface.twin(h)].map(|h| {
        let [p, q, r] = surface.corners(h.face());
        let longest = max(max(p.distance_squared(q), q.distance_squared(r)), r.distance_squared(p));
        let normal = (q - p).cross(r - p);
        (normal, normal.length() > SLIVER * longest)
    });
    let [(a, a_is_round), (b, b_is_round)] = normals;
    a_is_round && b_is_round && angle_between(a, b) > angle
}

/// Chains, and what they are made of.
struct Lines {
    sharp: Vec<HalfedgeId>,
    /// The chain of each sharp edge.
    chains: Vec<u32>,
    is_corner: TiVec<VertexId, bool>,
}

impl Lines {
    /// The chains of at least some length. Where short ones go, others may join, or end where they met: so until none is short.
    fn find(surface: &SurfaceMesh, mut sharp: Vec<HalfedgeId>, least: f64) -> Self {
        loop {
            let graph = Graph::new(surface, &sharp);
            let is_corner = surface.vertices().map(|v| graph.is_corner(v)).collect();
            let chains = graph.chains(&is_corner);
            let mut lengths = vec![0.0; sharp.len()];
            for (&h, &chain) in sharp.iter().zip(&chains) {
                lengths[chain as usize] += surface.length(h);
            }
            let long = |chain: u32| lengths[chain as usize] >= least;
            if chains.iter().all(|&chain| long(chain)) {
                return Self { sharp, chains, is_corner };
            }
            sharp = sharp.iter().zip(&chains).filter(|(_, chain)| long(**chain)).map(|(&h, _)| h).collect();
        }
    }
}

/// Sharp edges by the vertices that they meet in.
struct Graph<'a> {
    surface: &'a SurfaceMesh,
    sharp: &'a [HalfedgeId],
    edges_at: TiVec<VertexId, Vec<usize>>,
}

impl<'a> Graph<'a> {
    fn new(surface: &'a SurfaceMesh, sharp: &'a [HalfedgeId]) -> Self {
        let mut edges_at = ti_vec![Vec::new(); surface.vertex_count()];
        for (edge, &h) in sharp.iter().enumerate() {
            edges_at[surface.tail(h)].push(edge);
            edges_at[surface.head(h)].push(edge);
        }
        Self { surface, sharp, edges_at }
    }

    /// Whether a line ends at a vertex.
    fn is_corner(&self, v: VertexId) -> bool {
        let [a, b] = self.edges_at[v][..] else { return !self.edges_at[v].is_empty() };
        let away = |edge: usize| {
            let [tail, head] = [self.surface.tail(self.sharp[edge]), self.surface.head(self.sharp[edge])];
            let other = if tail == v { head } else { tail };
            (self.surface.positions()[other] - self.surface.positions()[v]).normalize_or_zero()
        };
        away(a).dot(away(b)) > -cos(BEND)
    }

    /// The number of the chain of each sharp edge.
    fn chains(&self, is_corner: &TiVec<VertexId, bool>) -> Vec<u32> {
        let mut chains = vec![u32::MAX; self.sharp.len()];
        let mut count = 0;
        for first in 0..self.sharp.len() {
            if chains[first] != u32::MAX {
                continue;
            }
            let mut queue = vec![first];
            chains[first] = count;
            while let Some(edge) = queue.pop() {
                let h = self.sharp[edge];
                for v in [self.surface.tail(h), self.surface.head(h)].into_iter().filter(|&v| !is_corner[v]) {
                    for &next in &self.edges_at[v] {
                        if chains[next] == u32::MAX {
                            chains[next] = count;
                            queue.push(next);
                        }
                    }
                }
            }
            count += 1;
        }
        chains
    }
}
