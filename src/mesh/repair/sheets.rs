//! Edges with more than two faces and vertices with more than one fan come apart (cutting and stitching, Gueziec, Taubin, Lazarus &
//! Horn 2001, "Cutting and stitching: converting sets of polygons to manifold surfaces").
//!
//! Faces are paired at every edge. The corners that hang together across paired halfedges are one vertex, the others copies of it.

use super::blades::{Blade, flattest, wedges};
use super::draft::{Draft, DraftFace, Edge, FaceOrigin, NONE, across, edges};
use crate::math::disjoint_sets::DisjointSets;
use crate::math::scalar::atan2;
use crate::mesh::check::Elements;
use rustc_hash::FxHashMap;

/// The edges and vertices that came apart, and those that stayed one, in the numbers of the file.
pub(super) struct Sheets {
    /// The edges that had more than two faces.
    pub edges: Elements<[usize; 2]>,
    /// The vertices of the file that are several now.
    pub split: Elements<usize>,
    /// The vertices of the file that are one with another one.
    pub joined: Elements<usize>,
}

/// The draft with at most two faces at each edge and one fan at each vertex, as far as vertices can be copied for it. Neighbours
/// across edges with two faces must agree.
pub(super) fn apart(mut draft: Draft) -> (Draft, Sheets) {
    let edges = edges(&draft.faces);
    let mut across = across(&draft.faces, &edges);
    let crowded: Vec<&Edge> = edges.iter().filter(|edge| edge.halfedges.len() > 2).collect();
    for edge in &crowded {
        for [a, b] in stitches(&draft, edge) {
            across[a as usize] = b;
            across[b as usize] = a;
        }
    }
    let crowded = crowded.iter().map(|edge| edge.ends.map(|v| draft.number(v))).collect();
    let split = copy_vertices(&mut draft, fans(&across));
    let mut joined: Vec<usize> = Vec::new();
    for face in &draft.faces {
        let others = (0..3).filter(|&k| draft.number(face.corners[k]) != face.file_corners[k] as usize);
        joined.extend(others.map(|k| face.file_corners[k] as usize));
    }
    joined.sort_unstable();
    joined.dedup();
    let draft = apart_along_edges(draft, &across);
    (draft, Sheets { edges: crowded, split, joined: joined.into_iter().collect() })
}

/// The draft with a vertex of its own in the middle of each edge that has the ends of another one: a sheet that touches itself along
/// an edge, whose vertices stay one since they hang together around its ends. `across` are the halfedges that belong together.
fn apart_along_edges(mut draft: Draft, across: &[u32]) -> Draft {
    let mut middles: FxHashMap<u32, u32> = FxHashMap::default();
    for edge in edges(&draft.faces) {
        let is_first = |h: &&u32| across[**h as usize] == NONE || across[**h as usize] > **h;
        // One of them stays as it is.
        for &h in edge.halfedges.iter().filter(is_first).skip(1) {
            let middle = draft.positions.len() as u32;
            let [p, q] = edge.ends.map(|v| draft.positions[v as usize]);
            draft.positions.push(0.5 * (p + q));
            draft.numbers.push(None);
            let both = [h, across[h as usize]];
            middles.extend(both.into_iter().filter(|h| *h != NONE).map(|h| (h, middle)));
        }
    }
    if middles.is_empty() {
        return draft;
    }
    let faces = std::mem::take(&mut draft.faces);
    let mut made = Vec::with_capacity(faces.len() + middles.len());
    for (face, f) in faces.into_iter().zip(0..) {
        let middle = |k: u32| middles.get(&(3 * f + k)).copied();
        cut_at(face, [middle(0), middle(1), middle(2)], &mut made);
    }
    draft.with_faces(made)
}

/// Cuts a face at vertices on its sides, each to the corner across.
fn cut_at(face: DraftFace, middles: [Option<u32>; 3], pieces: &mut Vec<DraftFace>) {
    let Some((k, middle)) = (0..3).find_map(|k| Some((k, middles[k]?))) else {
        pieces.push(face);
        return;
    };
    let [after, last] = [(k + 1) % 3, (k + 2) % 3];
    let half = |corner: usize| {
        let mut half = DraftFace { origin: FaceOrigin::Recut, ..face };
        (half.corners[corner], half.file_corners[corner]) = (middle, NONE);
        half
    };
    let on = |edge: usize| {
        let mut on = [None; 3];
        on[edge] = middles[edge];
        on
    };
    cut_at(half(after), on(last), pieces);
    cut_at(half(k), on(after), pieces);
}

/// The pairs of halfedges of one crowded edge that are stitched: those with the body's inside between them, where as many run one
/// way as the other; else those that go on flattest.
fn stitches(draft: &Draft, edge: &Edge) -> Vec<[u32; 2]> {
    let blades = blades(draft, edge);
    let forward = blades.iter().filter(|blade| blade.is_forward).count();
    if 2 * forward == blades.len() { wedges(&blades) } else { flattest(&blades) }
}

/// The halfedges by angle.
fn blades(draft: &Draft, edge: &Edge) -> Vec<Blade> {
    let [p, q] = edge.ends.map(|v| draft.positions[v as usize]);
    let axis = (q - p).normalize_or_zero();
    let leaves = |h: u32| {
        let face = &draft.faces[h as usize / 3];
        let away = draft.positions[face.corners[(h as usize + 2) % 3] as usize] - p;
        away - axis * axis.dot(away)
    };
    // A crowded edge has halfedges.
    let x = leaves(edge.halfedges[0]).normalize_or_zero();
    let y = axis.cross(x);
    let blade = |&h: &u32| {
        let away = leaves(h);
        let is_forward = draft.faces[h as usize / 3].edge(h as usize % 3)[0] == edge.ends[0];
        Blade { halfedge: h, angle: atan2(away.dot(y), away.dot(x)), is_forward }
    };
    let mut blades: Vec<Blade> = edge.halfedges.iter().map(blade).collect();
    blades.sort_by(|a, b| a.angle.total_cmp(&b.angle).then(a.halfedge.cmp(&b.halfedge)));
    blades
}

/// Corners 3 f + k that hang together around their vertices.
pub(super) fn fans(across: &[u32]) -> DisjointSets {
    let mut fans = DisjointSets::new(across.len());
    let end = |h: usize| if h % 3 == 2 { h - 2 } else { h + 1 };
    for (h, &other) in across.iter().enumerate() {
        if other != NONE {
            fans.join(h, end(other as usize));
            fans.join(end(h), other as usize);
        }
    }
    fans
}

/// Gives each fan a vertex of its own, and tells the vertices of the file that are several now.
pub(super) fn copy_vertices(draft: &mut Draft, mut fans: DisjointSets) -> Elements<usize> {
    let corners = draft.faces.len() * 3;
    let roots: Vec<usize> = (0..corners).map(|c| fans.root(c)).collect();
    let mut least = vec![NONE; corners];
    for (c, &root) in roots.iter().enumerate() {
        least[root] = least[root].min(draft.faces[c / 3].file_corners[c % 3]);
    }
    // A vertex stays with the first fan that has it from the file, else with the first one.
    let mut keeper = vec![usize::MAX; draft.positions.len()];
    for own in [true, false] {
        for (c, &root) in roots.iter().enumerate() {
            let v = draft.faces[c / 3].corners[c % 3];
            if keeper[v as usize] == usize::MAX && (!own || least[root] == v) {
                keeper[v as usize] = root;
            }
        }
    }
    let mut copy = vec![NONE; corners];
    let mut split = Vec::new();
    for (c, &root) in roots.iter().enumerate() {
        let v = draft.faces[c / 3].corners[c % 3];
        if keeper[v as usize] == root {
            continue;
        }
        if copy[root] == NONE {
            copy[root] = draft.positions.len() as u32;
            draft.positions.push(draft.positions[v as usize]);
            draft.numbers.push((least[root] != NONE).then_some(least[root]));
            split.extend((least[root] == v).then_some(v as usize));
        }
        draft.faces[c / 3].corners[c % 3] = copy[root];
    }
    split.sort_unstable();
    split.dedup();
    split.into_iter().collect()
}
