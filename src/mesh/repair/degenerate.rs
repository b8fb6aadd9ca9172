//! Faces without area go, and the surface around them closes.

use super::draft::{Draft, DraftFace, Edge, FaceOrigin, NONE, edges};
use crate::math::disjoint_sets::DisjointSets;
use crate::mesh::check::{Elements, Triangle, is_degenerate};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// The faces of the file that this step changed, by their numbers.
#[derive(Clone, Debug)]
pub(super) struct Degenerate {
    /// The faces that were dropped.
    pub dropped: Elements<usize>,
    /// The faces that were cut in two, where the corner of a face without area lay on their edge.
    pub recut: Elements<usize>,
}

impl Degenerate {
    /// The faces that two steps changed.
    pub fn and(self, other: Self) -> Self {
        Self { dropped: self.dropped.and(other.dropped), recut: self.recut.and(other.recut) }
    }
}

/// The elements that may be added to a surface where a face without area is dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Additions {
    /// Nothing may be added: a face that cannot be dropped without it leaves a hole.
    Nothing,
    /// Vertices may be added over caps: these stay, as fins that are next to nothing.
    Vertices,
}

/// The largest number of rounds: each one is for faces that lie beside one changed before. Chosen by hand.
const ROUNDS: usize = 20;

/// The ratio of an edge's length to the longest of its face below which both of its ends are at one place but for rounding.
const SAME_PLACE: f64 = 1e-12;

/// The draft without faces that name a vertex twice or have no area.
///
/// A needle goes by making the ends of its short edge one vertex. A face with a corner on its longest edge goes with that edge: the
/// neighbour there is cut in two at the corner, so that nothing opens. Where that is impossible the face is dropped, or, if it is a cap, drawn
/// out to a fin.
pub(super) fn without_degenerate(mut draft: Draft, additions: Additions) -> (Draft, Degenerate) {
    let (mut dropped, mut recut) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        if !draft.faces.iter().any(|face| is_degenerate(&draft.positions, &face.corners)) {
            break;
        }
        let mut waits = false;
        draft = match additions {
            Additions::Nothing => needles_joined(draft),
            Additions::Vertices => closed_needles_joined(draft, &mut waits),
        };
        let has_three = |face: &DraftFace| {
            let [a, b, c] = face.corners;
            a != b && b != c && c != a
        };
        draft = without(draft, has_three, &mut dropped);
        let cuts = Cuts::find(&draft);
        if cuts.is_empty() && !waits {
            break;
        }
        draft = cuts.made(draft, &mut dropped, &mut recut);
    }
    if additions == Additions::Vertices {
        draft = with_fins(draft);
    }
    let positions = draft.positions.clone();
    draft = without(draft, |face| !is_degenerate(&positions, &face.corners), &mut dropped);
    dropped.sort_unstable();
    recut.sort_unstable();
    let report = Degenerate { dropped: dropped.into_iter().collect(), recut: recut.into_iter().collect() };
    (draft, report)
}

fn without(draft: Draft, stays: impl Fn(&DraftFace) -> bool, dropped: &mut Vec<usize>) -> Draft {
    let (kept, gone): (Vec<DraftFace>, Vec<DraftFace>) =
        draft.faces.iter().copied().partition(|face| stays(face));
    dropped.extend(gone.iter().filter_map(DraftFace::number));
    draft.with_faces(kept)
}

/// The lengths squared of a triangle's sides, side k from corner k on.
fn squares(positions: &[DVec3], corners: &Triangle) -> [f64; 3] {
    let [p, q, r] = corners.map(|v| positions[v as usize]);
    [p.distance_squared(q), q.distance_squared(r), r.distance_squared(p)]
}

fn longest_side(positions: &[DVec3], corners: &Triangle) -> usize {
    let squares = squares(positions, corners);
    (0..3).max_by(|&i, &j| squares[i].total_cmp(&squares[j])).unwrap_or(0)
}

/// The height of a fin over its length: enough for its triangles to have an area.
const FIN: f64 = 1e-4;

/// Caps without area become fins: the corner on the longest side gets a vertex above it, whose edges nothing else has.
fn with_fins(mut draft: Draft) -> Draft {
    let mut faces = Vec::with_capacity(draft.faces.len());
    for face in &draft.faces {
        if face.origin != FaceOrigin::Cap || !is_degenerate(&draft.positions, &face.corners) {
            faces.push(*face);
            continue;
        }
        let k = longest_side(&draft.positions, &face.corners);
        let [from, to, foot] = [0, 1, 2].map(|step| draft.positions[face.corners[(k + step) % 3] as usize]);
        let up = (to - from).any_orthogonal_vector().normalize_or_zero();
        let vertex = draft.positions.len() as u32;
        draft.positions.push(foot + FIN * from.distance(to) * up);
        draft.numbers.push(None);
        faces.extend([0, 1, 2].map(|k| {
            let mut third = *face;
            (third.corners[k], third.file_corners[k]) = (vertex, NONE);
            third
        }));
    }
    draft.with_faces(faces)
}

fn needles_joined(mut draft: Draft) -> Draft {
    let mut sets = DisjointSets::new(draft.positions.len());
    let mut any = false;
    for face in draft.faces.iter().filter(|face| is_degenerate(&draft.positions, &face.corners)) {
        let squares = squares(&draft.positions, &face.corners);
        let longest = squares.into_iter().fold(0.0, f64::max);
        for k in (0..3).filter(|&k| squares[k] <= SAME_PLACE * SAME_PLACE * longest) {
            let [a, b] = face.edge(k);
            any |= sets.join(a as usize, b as usize);
        }
    }
    if any {
        join(&mut draft, &mut sets);
    }
    draft
}

/// Makes one vertex of each set: that of the least number.
fn join(draft: &mut Draft, sets: &mut DisjointSets) {
    let mut least: FxHashMap<usize, u32> = FxHashMap::default();
    let stands: Vec<u32> =
        (0..draft.positions.len()).map(|v| *least.entry(sets.root(v)).or_insert(v as u32)).collect();
    for v in draft.faces.iter_mut().flat_map(|face| &mut face.corners) {
        *v = stands[*v as usize];
    }
}

/// The same on a surface where every edge has two faces, and keeps them: an edge goes only where its ends have no other neighbours in
/// common than the corners across it. Where they have, as the copies of a vertex at which two sheets touch, the edge of a cap gets a
/// vertex above its middle. `waits` tells whether there are more, beside what changed now.
fn closed_needles_joined(mut draft: Draft, waits: &mut bool) -> Draft {
    let edges = edges(&draft.faces);
    let mut beside: FxHashMap<u32, FxHashSet<u32>> = FxHashMap::default();
    for [a, b] in edges.iter().map(|edge| edge.ends) {
        beside.entry(a).or_default().insert(b);
        beside.entry(b).or_default().insert(a);
    }
    let mut sets = DisjointSets::new(draft.positions.len());
    let mut raised = FxHashMap::default();
    let mut touched: FxHashSet<u32> = FxHashSet::default();
    for (f, face) in draft.faces.iter().enumerate() {
        let Some(k) = short_side(&draft, face) else { continue };
        let [a, b] = face.edge(k);
        let Some(g) = neighbour(&draft, &edges, f, k) else { continue };
        let others = [opposite(face, [a, b]), opposite(&draft.faces[g], [a, b])];
        let around = |v: u32| beside[&v].iter().copied().chain([v]);
        if around(a).chain(around(b)).any(|v| touched.contains(&v)) {
            *waits = true;
            continue;
        }
        let is_common = |v: &&u32| beside[&b].contains(v) && !others.contains(v);
        let is_free = others[0] != others[1] && !beside[&a].iter().any(|v| is_common(&v));
        if is_free {
            sets.join(a as usize, b as usize);
        } else if [f, g].iter().any(|&f| draft.faces[f].origin == FaceOrigin::Cap) {
            raised.insert([a.min(b), a.max(b)], [f, g]);
        } else {
            continue;
        }
        touched.extend(around(a).chain(around(b)).collect::<Vec<_>>());
    }
    join(&mut draft, &mut sets);
    with_raised_edges(draft, raised)
}

/// The side of a face without area whose ends are at one place.
fn short_side(draft: &Draft, face: &DraftFace) -> Option<usize> {
    let squares = squares(&draft.positions, &face.corners);
    let longest = squares.into_iter().fold(0.0, f64::max);
    let is_short = |k: &usize| squares[*k] <= SAME_PLACE * SAME_PLACE * longest;
    (0..3).find(is_short).filter(|_| is_degenerate(&draft.positions, &face.corners))
}

/// Edges, each with its two faces, get a vertex above their middle.
fn with_raised_edges(mut draft: Draft, raised: FxHashMap<[u32; 2], [usize; 2]>) -> Draft {
    let mut raised: Vec<([u32; 2], [usize; 2])> = raised.into_iter().collect();
    raised.sort_unstable();
    let mut cut: FxHashMap<usize, [DraftFace; 2]> = FxHashMap::default();
    for (edge, faces) in raised {
        let at = |v: u32| draft.positions[v as usize];
        let middle = 0.5 * (at(edge[0]) + at(edge[1]));
        let [c, d] = faces.map(|f| at(opposite(&draft.faces[f], edge)) - middle);
        let across = c.cross(d).normalize_or(c.any_orthogonal_vector().normalize_or_zero());
        let height = FIN * c.length().min(d.length());
        let corner = Corner { vertex: draft.positions.len() as u32, in_file: NONE };
        draft.positions.push(middle + height * across);
        draft.numbers.push(None);
        cut.extend(faces.map(|f| (f, halves(&draft.faces[f], edge, &corner))));
    }
    if cut.is_empty() {
        return draft;
    }
    let whole = std::mem::take(&mut draft.faces);
    let made = |(f, face): (usize, DraftFace)| cut.get(&f).map_or(vec![face], |halves| halves.to_vec());
    draft.with_faces(whole.into_iter().enumerate().flat_map(made).collect::<Vec<_>>())
}

/// The changes that one round makes to faces without area.
struct Cuts {
    /// The faces that are dropped.
    gone: Vec<usize>,
    /// The faces beside them at their longest edges, and what comes in the place of each.
    cut: FxHashMap<usize, [DraftFace; 2]>,
}

impl Cuts {
    fn find(draft: &Draft) -> Self {
        let mut found = Self { gone: Vec::new(), cut: FxHashMap::default() };
        let edges = edges(&draft.faces);
        let mut known: FxHashSet<[u32; 2]> = edges.iter().map(|edge| edge.ends).collect();
        let mut touched = FxHashSet::default();
        for (f, face) in draft.faces.iter().enumerate() {
            if !is_degenerate(&draft.positions, &face.corners) || touched.contains(&f) {
                continue;
            }
            let longest = longest_side(&draft.positions, &face.corners);
            let Some(beside) = neighbour(draft, &edges, f, longest) else {
                found.gone.push(f);
                touched.insert(f);
                continue;
            };
            if touched.contains(&beside) {
                continue;
            }
            let on_edge = (longest + 2) % 3;
            let corner = Corner { vertex: face.corners[on_edge], in_file: face.file_corners[on_edge] };
            let cut = across(draft, beside, face.edge(longest), &corner, &mut known);
            if let Some(cut) = cut {
                touched.extend([f, beside]);
                found.gone.push(f);
                found.cut.insert(beside, cut);
            }
        }
        found
    }

    fn is_empty(&self) -> bool {
        self.gone.is_empty()
    }

    fn made(self, draft: Draft, dropped: &mut Vec<usize>, recut: &mut Vec<usize>) -> Draft {
        let mut faces = Vec::with_capacity(draft.faces.len() + self.cut.len());
        let gone: FxHashSet<usize> = self.gone.into_iter().collect();
        for (f, face) in draft.faces.iter().enumerate() {
            if gone.contains(&f) {
                dropped.extend(face.number());
            } else if let Some(cut) = self.cut.get(&f) {
                recut.extend(face.number());
                faces.extend(cut);
            } else {
                faces.push(*face);
            }
        }
        draft.with_faces(faces)
    }
}

/// The one other face at an edge of a face; `None` where there is none or more than one.
fn neighbour(draft: &Draft, edges: &[Edge], f: usize, k: usize) -> Option<usize> {
    let [a, b] = draft.faces[f].edge(k);
    let ends = [a.min(b), a.max(b)];
    let edge = &edges[edges.binary_search_by_key(&ends, |edge| edge.ends).ok()?];
    match edge.halfedges[..] {
        [s, t] => {
            let other = if s as usize / 3 == f { t } else { s };
            Some(other as usize / 3)
        }
        _ => None,
    }
}

fn opposite(face: &DraftFace, [a, b]: [u32; 2]) -> u32 {
    face.corners.into_iter().find(|v| *v != a && *v != b).unwrap_or(a)
}

/// A corner that a face gets.
struct Corner {
    vertex: u32,
    /// The vertex of the file there.
    in_file: u32,
}

/// A face cut in two from a corner on one of its edges to its own corner across; `None` where that edge is there, or where faces without
/// area would come of faces that have some. Two neighbours without area become two shorter ones.
fn across(
    draft: &Draft,
    f: usize,
    edge: [u32; 2],
    corner: &Corner,
    known: &mut FxHashSet<[u32; 2]>,
) -> Option<[DraftFace; 2]> {
    let face = &draft.faces[f];
    let [c, across] = [corner.vertex, opposite(face, edge)];
    let halves = halves(face, edge, corner);
    let is_flat = |face: &DraftFace| is_degenerate(&draft.positions, &face.corners);
    let is_sound = is_flat(face) || !halves.iter().any(is_flat);
    (c != across && is_sound && known.insert([c.min(across), c.max(across)])).then_some(halves)
}

/// The origin of what a face is cut into.
fn made_of(face: &DraftFace) -> FaceOrigin {
    if face.origin == FaceOrigin::Cap { FaceOrigin::Cap } else { FaceOrigin::Recut }
}

/// A face cut in two from a corner on an edge to the opposite corner.
fn halves(face: &DraftFace, [a, b]: [u32; 2], corner: &Corner) -> [DraftFace; 2] {
    let half = |replaced: u32| {
        let mut half = DraftFace { origin: made_of(face), ..*face };
        for k in (0..3).filter(|&k| face.corners[k] == replaced) {
            (half.corners[k], half.file_corners[k]) = (corner.vertex, corner.in_file);
        }
        half
    };
    [half(a), half(b)]
}
