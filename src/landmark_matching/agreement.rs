//! The cyclic orders in which shortest paths lead from one mark (a given landmark or a tip) to the others.
//!
//! The shortest paths from a root form a tree on a sphere, so its leaves have a cyclic order. A map of low distortion that keeps
//! the orientation nearly keeps it, a mirrored one reverses it: so the orders tell left from right.

use crate::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// The place of a mark in the order around a root.
pub(super) type Rank = u32;

/// The places of `marks` in the order in which a walk around the tree of shortest paths from `root` reaches them.
pub(super) fn ranks(
    mesh: &SurfaceMesh,
    root: VertexId,
    field: &TiSlice<VertexId, f64>,
    marks: &[VertexId],
) -> Vec<Rank> {
    let mut reached: TiVec<VertexId, Rank> = ti_vec![Rank::MAX; mesh.vertex_count()];
    // Only paths to marks count.
    let mut homeward: TiVec<VertexId, Option<HalfedgeId>> = ti_vec![None; mesh.vertex_count()];
    for &mark in marks {
        let mut v = mark;
        while v != root && homeward[v].is_none() {
            let Some(h) = towards_root(mesh, field, v) else { break };
            homeward[v] = Some(h);
            v = mesh.head(h);
        }
    }
    let mut next: Rank = 0;
    let mut stack: Vec<(VertexId, Option<HalfedgeId>)> = vec![(root, None)];
    while let Some((v, from)) = stack.pop() {
        reached[v] = next;
        next += 1;
        // Counter-clockwise from the edge by which the path came; the stack reverses the order, on both meshes alike.
        let star: Vec<HalfedgeId> = mesh.star(v).collect();
        let begin = from.and_then(|h| star.iter().position(|&g| g == h)).unwrap_or(0);
        for k in 0..star.len() {
            let h = star[(begin + k) % star.len()];
            let child = mesh.head(h);
            if homeward[child] == Some(mesh.twin(h)) {
                stack.push((child, Some(mesh.twin(h))));
            }
        }
    }
    marks.iter().map(|&mark| reached[mark]).collect()
}

/// The halfedge from a vertex to the neighbour through which the way to the root is shortest, among the neighbours that are nearer to the
/// root; `None` where no neighbour is.
fn towards_root(mesh: &SurfaceMesh, field: &TiSlice<VertexId, f64>, v: VertexId) -> Option<HalfedgeId> {
    let nearer = mesh.star(v).filter(|&h| field[mesh.head(h)] < field[v]);
    let way = |h: HalfedgeId| field[mesh.head(h)] + mesh.length(h);
    nearer.min_by(|a, b| way(*a).total_cmp(&way(*b)))
}

/// Whether three different places come in counter-clockwise order.
pub(super) fn turns_left([a, b, c]: [Rank; 3]) -> bool {
    (a < b) == ((b < c) == (a < c))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geodesic::distances;
    use crate::math::scalar::{cos, sin};
    use crate::mesh::generators::icosphere;
    use crate::mesh::mirror::mirrored;
    use glam::DVec3;

    #[test]
    fn turns_do_not_depend_on_where_one_begins() {
        for triple in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
            assert!(turns_left(triple), "{triple:?}");
            assert!(!turns_left([triple[1], triple[0], triple[2]]), "{triple:?}");
        }
    }

    #[test]
    fn the_mirror_image_of_a_ball_has_all_orders_reversed() {
        let ball = icosphere(3);
        let at = |p: DVec3| {
            let distance = |v: &VertexId| ball.positions()[*v].distance(p);
            ball.vertices().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
        };
        let marks: Vec<VertexId> = (0..5)
            .map(|k| at(DVec3::new(cos(1.3 * f64::from(k)), sin(1.3 * f64::from(k)), 0.3).normalize()))
            .collect();
        let root = at(DVec3::Z);
        let image = mirrored(&ball).unwrap();
        let [one, other] = [&ball, &image].map(|mesh| ranks(mesh, root, &distances(mesh, &[root]), &marks));
        for (a, b, c) in [(0, 1, 2), (0, 1, 3), (1, 2, 4), (2, 3, 4)] {
            assert!(turns_left([one[a], one[b], one[c]]) != turns_left([other[a], other[b], other[c]]));
        }
        assert!(!one.contains(&Rank::MAX), "{one:?}");
    }
}
