//! The check that the map takes landmarks to their partners.

use crate::header::LandmarkPoint;
use crate::places::Place;
use crate::refusal::Refusal;
use crate::tiling::Map;
use std::ops::ControlFlow;

/// The largest distance at which a landmark inside a face is met, in units of the root of the mesh's area.
const NEAR: f64 = 1e-9;
/// The largest number of overlay vertices that are compared with landmarks; a face of a real map has some hundred.
const MOST_COMPARED: usize = 1 << 26;
/// The largest number of landmark pairs, as in landmark files.
const MOST_PAIRS: usize = 10_000;

/// How well the landmark pairs meet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Landmarks {
    /// The number of pairs.
    pub pairs: usize,
    /// The number of pairs of vertices of both meshes that meet exactly; a point of a face on one of its corners is a vertex.
    pub exact: usize,
    /// The largest distance of the others: from the nearest overlay vertex to the landmark on the source, or from that vertex's
    /// place to the partner on the target; in units of the root of the mesh's area. In f64.
    pub largest_distance: f64,
}

/// Checks all pairs.
pub fn check(
    pairs: &[[LandmarkPoint; 2]],
    map: &Map<'_>,
    ask: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Landmarks, Refusal> {
    if pairs.len() > MOST_PAIRS {
        let problem = format!("is one of {}; the limit is {MOST_PAIRS}", pairs.len());
        return Err(Refusal::Landmark { pair: MOST_PAIRS, problem });
    }
    let mut found = Landmarks { pairs: pairs.len(), ..Landmarks::default() };
    let index = Index::new(map);
    let mut compared = 0_usize;
    for (pair, points) in pairs.iter().enumerate() {
        if ask(pair as f64 / pairs.len() as f64).is_break() {
            return Err(Refusal::Stopped);
        }
        let wrong = |problem: &str| Refusal::Landmark { pair, problem: problem.to_owned() };
        let missing = || wrong("names a point that its mesh has not");
        let mut places = [Place::Vertex(0); 2];
        for side in [0, 1] {
            places[side] = place(map, side, points[side]).ok_or_else(missing)?;
        }
        let candidates = index.around(map, places[0]);
        compared = compared.saturating_add(candidates.len());
        if compared > MOST_COMPARED {
            return Err(wrong("lies among more overlay vertices than can be compared"));
        }
        let near = candidates.iter().copied().min_by(|&a, &b| {
            let distance = |v: u32| index.distance(map, 0, map.places[0][v as usize], places[0]);
            distance(a).total_cmp(&distance(b))
        });
        let vertex = near.ok_or_else(|| wrong("lies on the source where no overlay vertex is"))? as usize;
        let ends = [0, 1].map(|side| (map.places[side][vertex], places[side]));
        if ends.iter().all(|(there, wanted)| matches!(wanted, Place::Vertex(_)) && there == wanted) {
            found.exact += 1;
            continue;
        }
        let distance = [0, 1].map(|side| index.distance(map, side, ends[side].0, ends[side].1));
        let distance = distance[0].max(distance[1]);
        // A distance that is not a number is not near.
        if !distance.lt(&NEAR) {
            return Err(wrong(&format!("is missed by {distance:.1e} of the size of the mesh")));
        }
        found.largest_distance = found.largest_distance.max(distance);
    }
    Ok(found)
}

/// A landmark as a place; a point of a face that lies on a corner is that vertex. `None` where its mesh has no such point.
fn place(map: &Map<'_>, side: usize, point: LandmarkPoint) -> Option<Place> {
    let mesh = map.meshes[side];
    match point {
        LandmarkPoint::Vertex(v) => mesh.vertex(v).map(Place::Vertex),
        LandmarkPoint::OnFace { face, barycentric } => {
            let corners = mesh.corners(face)?;
            // Landmark files may have few digits.
            let weights = barycentric.map(|w| w.max(0.0));
            let sum: f64 = weights.iter().sum();
            let is_sound =
                (sum - 1.0).abs() < 1e-3 && weights.iter().zip(barycentric).all(|(w, b)| w - b <= 1e-6);
            if !is_sound {
                return None;
            }
            let others = |k: usize| weights[(k + 1) % 3] + weights[(k + 2) % 3];
            match (0..3).find(|&k| others(k) == 0.0) {
                Some(k) => mesh.vertex(corners[k]).map(Place::Vertex),
                None => Some(Place::Face(face, weights.map(|w| w / sum))),
            }
        }
    }
}

/// Overlay vertices by where they lie on the source, and the sizes of both meshes.
struct Index {
    /// Pairs of a vertex of the source and an overlay vertex there, sorted.
    at_vertices: Vec<[u32; 2]>,
    /// Pairs of a face of the source and a piece in it, sorted.
    in_faces: Vec<[u32; 2]>,
    units: [f64; 2],
}

impl Index {
    fn new(map: &Map<'_>) -> Self {
        let at_vertex = |(k, place): (usize, &Place)| match place {
            Place::Vertex(v) => Some([*v, k as u32]),
            _ => None,
        };
        let mut at_vertices: Vec<_> = map.places[0].iter().enumerate().filter_map(at_vertex).collect();
        at_vertices.sort_unstable();
        let mut in_faces: Vec<_> = (0..map.pieces.len()).map(|p| [map.pieces.face(0, p), p as u32]).collect();
        in_faces.sort_unstable();
        let unit = |side: usize| {
            let mesh = map.meshes[side];
            (0..mesh.face_count() as u32).map(|f| mesh.area(f)).sum::<f64>().sqrt()
        };
        Self { at_vertices, in_faces, units: [unit(0), unit(1)] }
    }

    /// Overlay vertices at a place of the source: at a vertex, or on a face.
    fn around(&self, map: &Map<'_>, place: Place) -> Vec<u32> {
        let with = |pairs: &[[u32; 2]], key: u32| -> Vec<u32> {
            let begin = pairs.partition_point(|pair| pair[0] < key);
            pairs[begin..].iter().take_while(|pair| pair[0] == key).map(|pair| pair[1]).collect()
        };
        match place {
            Place::Vertex(v) => with(&self.at_vertices, v),
            Place::Face(face, _) => {
                let pieces = with(&self.in_faces, face);
                pieces.iter().flat_map(|&p| map.pieces.ring(p as usize).iter().copied()).collect()
            }
            Place::Edge(..) => Vec::new(),
        }
    }

    /// The distance in space between two places of a mesh, in units of the root of its area.
    fn distance(&self, map: &Map<'_>, side: usize, a: Place, b: Place) -> f64 {
        let [p, q] = [a, b].map(|place| in_space(map, side, place));
        [0, 1, 2].map(|k| (p[k] - q[k]).powi(2)).iter().sum::<f64>().sqrt() / self.units[side]
    }
}

fn in_space(map: &Map<'_>, side: usize, place: Place) -> [f64; 3] {
    let mesh = map.meshes[side];
    match place {
        Place::Vertex(v) => mesh.vertex_position(v),
        Place::Edge(ends, weights) => {
            let [p, q] = ends.map(|v| mesh.vertex_position(v));
            [0, 1, 2].map(|k| p[k] * weights[0].value() + q[k] * weights[1].value())
        }
        Place::Face(face, weights) => mesh.position(face, weights),
    }
}
