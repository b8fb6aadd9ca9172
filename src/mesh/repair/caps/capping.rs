//! Every hole of a draft gets its cap.

use super::super::draft::{Draft, DraftFace, Edge, FaceOrigin, NONE, edges};
use super::super::refusal::RepairRefusal;
use super::super::report::Hole;
use super::fairing::{Fairness, fair};
use super::filling::{Rim, filled};
use super::loops::loops;
use super::patch::Patch;
use super::refinement::refine;
use crate::monitor::{Cancelled, Monitor};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// The holes that were capped.
pub(in crate::mesh::repair) struct Capped {
    /// The holes, the longest first.
    pub holes: Vec<Hole>,
    /// Number of faces of all caps.
    pub faces: usize,
    /// The share of the area after that these faces have.
    pub area_share: f64,
}

/// The length of a rim, in units of the square root of the area, below which its hole is small: the cap goes on as the surface
/// around. Chosen by hand.
const SMALL: f64 = 0.6;

/// The draft with a cap over each hole; nothing is said where there is none.
///
/// # Errors
/// [`RepairRefusal::Fault`] where rims touch, or [`RepairRefusal::Stopped`].
pub(in crate::mesh::repair) fn capped(
    mut draft: Draft,
    monitor: &mut dyn Monitor,
) -> Result<(Draft, Option<Capped>), RepairRefusal> {
    let edges = edges(&draft.faces);
    let loops = loops(&draft.faces, &edges)?;
    if loops.is_empty() {
        return Ok((draft, None));
    }
    let skin = draft.area();
    let surroundings = Surroundings::new(&draft, &edges, &loops);
    let mut caps = Vec::with_capacity(loops.len());
    for rim in &loops {
        let patch = surroundings.cap(&draft, rim, skin.sqrt(), monitor)?;
        let length = perimeter(&draft, rim);
        caps.push(Cap { rim, length, area: patch.area(), faces: patch.triangles.len() });
        add(&mut draft, rim, &patch.points[patch.rim..], patch.triangles.iter().copied());
    }
    let area = skin + caps.iter().map(|cap| cap.area).sum::<f64>();
    caps.sort_by(|a, b| b.length.total_cmp(&a.length));
    let hole = |cap: &Cap<'_>| Hole {
        edges: cap.rim.len(),
        rim_length: cap.length / area.sqrt(),
        area_share: cap.area / area,
        vertices: cap.rim.iter().take(10).map(|&v| draft.number(v)).collect(),
    };
    let holes = caps.iter().map(hole).collect();
    let faces = caps.iter().map(|cap| cap.faces).sum();
    Ok((draft, Some(Capped { holes, faces, area_share: 1.0 - skin / area })))
}

/// A cap that was made.
struct Cap<'a> {
    /// The vertices of its rim.
    rim: &'a [u32],
    /// The length of the rim.
    length: f64,
    /// The area of the cap.
    area: f64,
    /// Number of faces of the cap.
    faces: usize,
}

fn perimeter(draft: &Draft, rim: &[u32]) -> f64 {
    let at = |k: usize| draft.positions[rim[k % rim.len()] as usize];
    (0..rim.len()).map(|k| at(k).distance(at(k + 1))).sum()
}

/// Takes a cap over: its vertices inside the rim, and its triangles, whose vertices are those of the rim and then these.
pub(super) fn add(
    draft: &mut Draft,
    rim: &[u32],
    inside: &[DVec3],
    triangles: impl IntoIterator<Item = [u32; 3]>,
) {
    let first = draft.positions.len();
    draft.positions.extend(inside);
    draft.numbers.resize(draft.positions.len(), None);
    let vertex = |v: u32| rim.get(v as usize).copied().unwrap_or((first + v as usize - rim.len()) as u32);
    for triangle in triangles {
        let corners = triangle.map(vertex);
        let file_corners = corners.map(|v| draft.numbers[v as usize].unwrap_or(NONE));
        draft.faces.push(DraftFace { corners, file_corners, origin: FaceOrigin::Cap });
    }
}

/// The mean length of both edges of a rim at each of its vertices.
pub(super) fn rim_lengths(places: &[DVec3]) -> Vec<f64> {
    let n = places.len();
    let length = |k: usize| places[k].distance(places[(k + 1) % n]);
    (0..n).map(|k| 0.5 * (length((k + n - 1) % n) + length(k))).collect()
}

/// The surface at the rims.
struct Surroundings {
    /// Vertices beside each vertex of a rim, rising.
    neighbours: FxHashMap<u32, Vec<u32>>,
    /// Normal of the face beyond each edge of a rim, by the edge as the cap runs along it.
    beyond: FxHashMap<[u32; 2], DVec3>,
}

impl Surroundings {
    fn new(draft: &Draft, edges: &[Edge], loops: &[Vec<u32>]) -> Self {
        let mut neighbours: FxHashMap<u32, Vec<u32>> =
            loops.iter().flatten().map(|&v| (v, Vec::new())).collect();
        for edge in edges {
            let [a, b] = edge.ends;
            for (v, w) in [(a, b), (b, a)] {
                if let Some(beside) = neighbours.get_mut(&v) {
                    beside.push(w);
                }
            }
        }
        neighbours.values_mut().for_each(|beside| beside.sort_unstable());
        let open =
            edges.iter().filter(|edge| edge.halfedges.len() == 1).map(|edge| edge.halfedges[0] as usize);
        let beyond = open.map(|h| {
            let face = &draft.faces[h / 3];
            let [a, b] = face.edge(h % 3);
            let [p, q, r] = draft.places(face);
            ([b, a], (q - p).cross(r - p).normalize_or_zero())
        });
        Self { beyond: beyond.collect(), neighbours }
    }

    fn beside(&self, v: u32) -> &[u32] {
        self.neighbours.get(&v).map_or(&[], Vec::as_slice)
    }

    /// The cap over one rim; `size` is the square root of the area.
    ///
    /// # Errors
    /// [`Cancelled`].
    fn cap(
        &self,
        draft: &Draft,
        rim: &[u32],
        size: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<Patch, Cancelled> {
        let n = rim.len();
        let at = |v: u32| draft.positions[v as usize];
        let places: Vec<DVec3> = rim.iter().map(|&v| at(v)).collect();
        let number: FxHashMap<u32, u32> = rim.iter().zip(0..).map(|(&v, k)| (v, k)).collect();
        let mut taken = FxHashSet::default();
        for (&v, k) in rim.iter().zip(0_u32..) {
            let inside = self.beside(v).iter().filter_map(|w| number.get(w));
            taken.extend(inside.map(|&l| [k.min(l), k.max(l)]));
        }
        let along = |k: usize| [rim[k], rim[(k + 1) % n]];
        let beyond: Vec<DVec3> =
            (0..n).map(|k| self.beyond.get(&along(k)).copied().unwrap_or(DVec3::ZERO)).collect();
        let filling = filled(&Rim { places: &places, beyond: &beyond, taken: &taken });
        let points = places.iter().copied().chain(filling.middle).collect();
        let mut patch = Patch::new(points, n, filling.triangles, taken);
        refine(&mut patch, &rim_lengths(&places), monitor)?;
        let around = |k: usize| {
            let on_rim = [rim[(k + n - 1) % n], rim[(k + 1) % n]];
            self.beside(rim[k]).iter().filter(|w| !on_rim.contains(w)).map(|&w| at(w)).collect()
        };
        let around: Vec<Vec<DVec3>> = (0..n).map(around).collect();
        let is_small = perimeter(draft, rim) < SMALL * size;
        let fairness = if is_small { Fairness::Plate } else { Fairness::Membrane };
        fair(&mut patch, &around, fairness, monitor)?;
        Ok(patch)
    }
}
