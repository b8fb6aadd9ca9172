//! Faces with the same three vertices become one, or none where they are the two sides of a wall without thickness.

use super::draft::{Draft, DraftFace, edges};
use crate::mesh::check::Elements;
use rustc_hash::{FxHashMap, FxHashSet};

/// The draft without double faces, and the numbers of the faces that went.
///
/// The draft without copies of faces. Of faces that are copies of each other the first stays. A face and its copy that looks the other way
/// both go where that leaves fewer open and crowded edges: a flap that is folded on itself, or the wall between two bodies. A sheet that is
/// all double stays once.
pub(super) fn without_duplicates(draft: Draft) -> (Draft, Elements<usize>) {
    let mut copies: FxHashMap<[u32; 3], Vec<usize>> = FxHashMap::default();
    for (f, face) in draft.faces.iter().enumerate() {
        let mut key = face.corners;
        key.sort_unstable();
        copies.entry(key).or_default().push(f);
    }
    let mut groups: Vec<Vec<usize>> = copies.into_values().filter(|faces| faces.len() > 1).collect();
    if groups.is_empty() {
        return (draft, Elements::none());
    }
    groups.sort_unstable();
    let walls = walls(&draft.faces, &groups);
    let mut goes = vec![false; draft.faces.len()];
    for group in &groups {
        let balance: i64 = group.iter().map(|&f| sign(&draft.faces[f])).sum();
        // The first of those that look as most do.
        let stays = group.iter().find(|&&f| balance == 0 || sign(&draft.faces[f]) == balance.signum());
        group.iter().for_each(|&f| goes[f] = walls.contains(&f) || Some(&f) != stays);
    }
    let dropped =
        draft.faces.iter().zip(&goes).filter(|(_, goes)| **goes).filter_map(|(face, _)| face.number());
    let dropped = dropped.collect();
    let faces: Vec<DraftFace> =
        draft.faces.iter().zip(&goes).filter(|(_, goes)| !**goes).map(|(face, _)| *face).collect();
    (draft.with_faces(faces), dropped)
}

/// 1 or -1, alike for faces with the same vertices that look the same way.
fn sign(face: &DraftFace) -> i64 {
    let [a, b, c] = face.corners;
    let rises = [a < b, b < c, c < a].iter().filter(|rise| **rise).count();
    if rises == 2 { 1 } else { -1 }
}

/// The faces of all walls: groups whose faces cancel each other, as far as most of their edges have an even number of other faces.
fn walls(faces: &[DraftFace], groups: &[Vec<usize>]) -> FxHashSet<usize> {
    let balance = |group: &&Vec<usize>| group.iter().map(|&f| sign(&faces[f])).sum::<i64>() == 0;
    let mut wall: FxHashSet<usize> = groups.iter().filter(balance).flatten().copied().collect();
    let edges = edges(faces);
    let mut partners: FxHashMap<usize, &Vec<usize>> = FxHashMap::default();
    for group in groups {
        partners.extend(group.iter().map(|&f| (f, group)));
    }
    // A face that stays is one of the others for its neighbours: again until nothing changes.
    loop {
        let mut odd: FxHashMap<usize, u32> = FxHashMap::default();
        let mut has_rest = FxHashSet::default();
        for edge in &edges {
            let faces = edge.halfedges.iter().map(|h| *h as usize / 3);
            let (inside, rest): (Vec<usize>, Vec<usize>) = faces.partition(|f| wall.contains(f));
            if rest.len() % 2 == 1 {
                inside.iter().for_each(|&f| *odd.entry(f).or_default() += 1);
            }
            if !rest.is_empty() {
                has_rest.extend(inside);
            }
        }
        odd.retain(|_, edges| *edges > 1);
        if odd.is_empty() {
            return attached(&edges, wall, &has_rest);
        }
        for f in odd.keys().flat_map(|f| partners.get(f).copied().into_iter().flatten()) {
            wall.remove(f);
        }
    }
}

/// The faces of walls that hang together with the rest of the surface.
fn attached(
    edges: &[super::draft::Edge],
    wall: FxHashSet<usize>,
    has_rest: &FxHashSet<usize>,
) -> FxHashSet<usize> {
    let mut order: Vec<usize> = wall.iter().copied().collect();
    order.sort_unstable();
    let place: FxHashMap<usize, usize> = order.iter().enumerate().map(|(k, &f)| (f, k)).collect();
    let mut sets = crate::math::disjoint_sets::DisjointSets::new(order.len());
    for edge in edges {
        let inside: Vec<usize> =
            edge.halfedges.iter().filter_map(|h| place.get(&(*h as usize / 3)).copied()).collect();
        for pair in inside.windows(2) {
            sets.join(pair[0], pair[1]);
        }
    }
    let roots: FxHashSet<usize> =
        order.iter().filter(|f| has_rest.contains(f)).map(|f| sets.root(place[f])).collect();
    order.into_iter().filter(|f| roots.contains(&sets.root(place[f]))).collect()
}
