//! Handles are cut one after the other, and closed by walls.

use super::super::caps::{CutRims, add_wall};
use super::super::draft::{Draft, FaceOrigin, NONE};
use super::super::report::Handle;
use super::super::sheets::{copy_vertices, fans};
use super::crossings::{Crossings, Generator};
use super::graph::Graph;
use super::shortest::shortest_loop;
use crate::monitor::{Cancelled, Monitor, Portion};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// A surface whose handles were cut.
pub(in crate::mesh::repair) struct WithoutHandles {
    /// The surface.
    pub draft: Draft,
    /// The handles in the order in which they were cut; lengths and shares are those of the surface after.
    pub handles: Vec<Handle>,
    /// Number of faces of all walls.
    pub faces: usize,
    /// The share of the area after that these faces have.
    pub area_share: f64,
    /// The share of the area after that is caps, walls among them.
    pub cap_share: f64,
}

/// A handle that was cut.
struct Cut {
    /// The loop's vertices in the numbers of the file.
    vertices: Vec<usize>,
    /// The places of these vertices.
    places: Vec<DVec3>,
    /// The length of the loop.
    length: f64,
    /// Number of faces of both walls.
    faces: usize,
    /// The area of these faces.
    area: f64,
}

/// A closed, oriented, connected surface of a genus from 1 to [`super::crossings::MOST_HANDLES`] without its handles.
///
/// # Errors
/// [`Cancelled`].
pub(in crate::mesh::repair) fn without_handles(
    mut draft: Draft,
    genus: usize,
    monitor: &mut dyn Monitor,
) -> Result<WithoutHandles, Cancelled> {
    let mut cuts = Vec::with_capacity(genus);
    for k in 0..genus {
        let share = |k: usize| k as f64 / genus as f64;
        let mut portion = Portion::new(monitor, share(k), share(k + 1));
        let Some(graph) = Graph::new(&draft) else { break };
        let Some(shortest) = shortest_loop(&graph, &Crossings::new(&graph), &mut portion)? else { break };
        let (after, cut) = cut(draft, &graph, &from_least(shortest), &mut portion)?;
        draft = after;
        cuts.push(cut);
    }
    let area = draft.area();
    let handle = |cut: &Cut| Handle {
        edges: cut.vertices.len(),
        loop_length: cut.length / area.sqrt(),
        faces: cut.faces,
        area_share: cut.area / area,
        vertices: cut.vertices.clone(),
        places: cut.places.clone(),
    };
    let caps = draft.faces.iter().filter(|face| face.origin == FaceOrigin::Cap);
    Ok(WithoutHandles {
        handles: cuts.iter().map(handle).collect(),
        faces: cuts.iter().map(|cut| cut.faces).sum(),
        area_share: cuts.iter().map(|cut| cut.area).sum::<f64>() / area,
        cap_share: caps.map(|face| draft.face_area(face)).sum::<f64>() / area,
        draft,
    })
}

/// The same loop from its vertex of the least number on, towards the lesser one of its neighbours.
fn from_least(found: Generator) -> Generator {
    let Generator { length, mut vertices, mut edges } = found;
    let n = vertices.len();
    let least = (0..n).min_by_key(|&i| vertices[i]).unwrap_or(0);
    vertices.rotate_left(least);
    edges.rotate_left(least);
    if n > 2 && vertices[n - 1] < vertices[1] {
        vertices[1..].reverse();
        edges.reverse();
    }
    Generator { length, edges, vertices }
}

/// Cuts a surface along a simple loop, and closes both rims.
fn cut(
    mut draft: Draft,
    graph: &Graph,
    along: &Generator,
    monitor: &mut dyn Monitor,
) -> Result<(Draft, Cut), Cancelled> {
    let halfedges = halfedges(&draft, graph, along);
    let mut across = vec![NONE; 3 * draft.faces.len()];
    for &[a, b] in &graph.halfedges {
        (across[a as usize], across[b as usize]) = (b, a);
    }
    halfedges.iter().flatten().for_each(|&h| across[h] = NONE);
    let vertices = along.vertices.iter().map(|&v| draft.number(v)).collect();
    let places = along.vertices.iter().map(|&v| draft.positions[v as usize]).collect();
    copy_vertices(&mut draft, fans(&across));
    // For the halfedges that run against the loop the ends are taken, so that both rims follow the loop.
    let start = |h: usize| draft.faces[h / 3].corners[h % 3];
    let end = |h: usize| draft.faces[h / 3].corners[(h + 1) % 3];
    let rims = CutRims {
        along: halfedges.iter().map(|[along, _]| start(*along)).collect(),
        against: halfedges.iter().map(|[_, against]| end(*against)).collect(),
    };
    let before = draft.faces.len();
    add_wall(&mut draft, &rims, chords(graph, &along.vertices), monitor)?;
    let made = &draft.faces[before..];
    let area = made.iter().map(|face| draft.face_area(face)).sum();
    let cut = Cut { vertices, places, length: along.length, faces: made.len(), area };
    Ok((draft, cut))
}

/// For each edge of a loop the halfedge that runs along the loop, and the halfedge that runs against it.
fn halfedges(draft: &Draft, graph: &Graph, along: &Generator) -> Vec<[usize; 2]> {
    let directed = |(&edge, &v): (&u32, &u32)| {
        let [a, b] = graph.halfedges[edge as usize].map(|h| h as usize);
        let runs_along = draft.faces[a / 3].corners[a % 3] == v;
        if runs_along { [a, b] } else { [b, a] }
    };
    along.edges.iter().zip(&along.vertices).map(directed).collect()
}

/// Edges between vertices of a loop, by their places along it, the lesser first.
fn chords(graph: &Graph, vertices: &[u32]) -> FxHashSet<[u32; 2]> {
    let place: FxHashMap<u32, u32> = vertices.iter().zip(0..).map(|(&v, k)| (v, k)).collect();
    let mut found = FxHashSet::default();
    for (&v, k) in vertices.iter().zip(0_u32..) {
        let beside = graph.links(v).filter_map(|(w, _, _)| place.get(&w));
        found.extend(beside.map(|&l| [k.min(l), k.max(l)]));
    }
    found
}
