//! Further pairs far from all others, whose targets are found by their distances to the others.
//!
//! A map needs four pairs, and around a body whose tips lie in a plane it may wind either way: a further pair settles both. Its
//! source is the point farthest from the others; the target has two places with nearly the same distances, one on either side of the body.

use super::shape::Shape;
use crate::landmarks::MeshSide;
use crate::math::scalar::ln;
use crate::mesh::VertexId;

/// Added to distances before ratios are taken, in units of the root of the area, so that near pairs count little. Chosen by hand.
const SOFTENING: f64 = 0.05;
/// Two places of the target nearer to each other than this count as one; the area is 1. Chosen by hand.
const SAME: f64 = 0.3;
/// Places of the target that are tried: one on either side of a body. Chosen by hand.
const PLACES: usize = 2;
/// Least number of pairs by which a further one is placed: with fewer, a whole line of places has the same distances.
pub(super) const LEAST_TO_PLACE: usize = 3;

/// The further pairs, each of vertices of both levels, one of which may be added to some pairs of marks; none where these are too few.
pub(super) fn between(shapes: [&Shape; 2], pairs: &[[usize; 2]]) -> Vec<[VertexId; 2]> {
    if pairs.len() < LEAST_TO_PLACE {
        return Vec::new();
    }
    let [source, target] = shapes;
    let distance = |side: MeshSide, pair: &[usize; 2], v: VertexId| shapes[side].marks[pair[side]].field[v];
    let nearest = |side: MeshSide, v: VertexId| {
        pairs.iter().map(|pair| distance(side, pair, v)).fold(f64::INFINITY, f64::min)
    };
    let far = source.level.mesh.vertices().filter(|&v| source.may(v));
    let remote = |v: &VertexId| nearest(MeshSide::Source, *v);
    let Some(from) = far.max_by(|a, b| remote(a).total_cmp(&remote(b))) else { return Vec::new() };
    let misfit = |v: VertexId| {
        let ratio = |pair: &[usize; 2]| {
            let [s, t] = [distance(MeshSide::Source, pair, from), distance(MeshSide::Target, pair, v)];
            ln((s + SOFTENING) / (t + SOFTENING)).abs()
        };
        pairs.iter().map(ratio).sum::<f64>() / pairs.len() as f64
    };
    let may = |v: &VertexId| target.may(*v) && nearest(MeshSide::Target, *v) > 0.0;
    let mut order: Vec<(f64, VertexId)> =
        target.level.mesh.vertices().filter(may).map(|v| (misfit(v), v)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut places: Vec<VertexId> = Vec::new();
    for (_, v) in order {
        let place = target.level.mesh.positions()[v];
        if places.len() < PLACES
            && places.iter().all(|&w| target.level.mesh.positions()[w].distance(place) > SAME)
        {
            places.push(v);
        }
    }
    places.into_iter().map(|v| [from, v]).collect()
}
