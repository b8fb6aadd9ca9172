//! Texture coordinates: the flat cone metric laid out in the plane (thesis fig. 4.1).
//!
//! The metric lives on a flipped triangulation. Every halfedge carries its displacement in its face's frame; undoing a flip
//! only adds vectors in the developed diamond, so the input mesh's own edges come back exactly, without any inequality
//! between lengths. The mesh is then cut along a tree of its edges that joins the landmarks and developed breadth first.

use super::metric::ConeMetric;
use crate::intrinsic::Move;
use crate::math::min_queue::shortest_paths;
use crate::math::rigid2::{complex_mul, conj_mul};
use crate::math::triangle::{lay_out, signed_double_area};
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use glam::DVec2;
use std::collections::VecDeque;
use typed_index_collections::{TiVec, ti_vec};

/// Texture coordinates of a mesh, continuous but for the cut.
#[derive(Clone, Debug)]
pub struct FlatAtlas {
    /// For each halfedge the coordinates of its start in its face; the whole has area about 1.
    pub corner_uvs: TiVec<HalfedgeId, DVec2>,
    /// Whether the edge is part of the cut; twins agree.
    pub cut: TiVec<HalfedgeId, bool>,
    /// Faces that come out negative: straight edges of the mesh cross there in the flat metric.
    pub inverted_faces: usize,
    /// L2 stretch over the positive faces (Sander et al. 2001); 1 for an isometry.
    pub l2_stretch: f64,
}

/// Lays the metric out over the mesh that it was made from, cut along a tree that joins the landmarks.
///
/// # Errors
/// [`Cancelled`].
pub fn flat_atlas(
    mesh: &SurfaceMesh,
    metric: &ConeMetric,
    landmarks: &[VertexId],
    monitor: &mut dyn Monitor,
) -> Result<FlatAtlas, Cancelled> {
    monitor.step(Step::default())?;
    let displacements = mesh_displacements(metric);
    monitor.step(Step::default())?;
    let cut = cut_tree(mesh, landmarks);
    monitor.step(Step::default())?;
    let mut corner_uvs = develop(mesh, &displacements, &cut, FaceId(0)).corners;
    monitor.step(Step::default())?;
    let double_area = |uvs: &TiVec<HalfedgeId, DVec2>, f: FaceId| {
        let [p, q, r] = f.halfedges().map(|h| uvs[h]);
        signed_double_area(p, q, r)
    };
    let total: f64 = 0.5 * mesh.faces().map(|f| double_area(&corner_uvs, f)).sum::<f64>();
    let scale = 1.0 / total.sqrt();
    corner_uvs.iter_mut().for_each(|uv| *uv *= scale);
    let inverted_faces = mesh.faces().filter(|&f| double_area(&corner_uvs, f) <= 0.0).count();
    let l2_stretch = l2_stretch(mesh, &corner_uvs);
    monitor.step(Step::default())?;
    Ok(FlatAtlas { corner_uvs, cut, inverted_faces, l2_stretch })
}

/// The displacement along each halfedge of the original triangulation, in the frame of its face.
pub(crate) fn mesh_displacements(metric: &ConeMetric) -> TiVec<HalfedgeId, DVec2> {
    let lengths = metric.lengths();
    let mut triangulation = metric.triangulation.clone();
    let mut along = ti_vec![DVec2::ZERO; lengths.len()];
    for f in triangulation.faces() {
        let h = f.halfedges();
        let corners = lay_out(h.map(|x| lengths[x]));
        (0..3).for_each(|k| along[h[k]] = corners[(k + 1) % 3] - corners[k]);
    }
    while let Some((h, moves)) = triangulation.unflip() {
        let t = triangulation.twin(h);
        // Turn the face of t into the frame of the face of h: there the shared edge is the opposite vector.
        let turn = conj_mul(along[t], -along[h]).normalize_or(DVec2::X);
        let old =
            moves.map(
                |Move { from, .. }| {
                    if from.face() == t.face() { complex_mul(turn, along[from]) } else { along[from] }
                },
            );
        moves.iter().zip(old).for_each(|(Move { to, .. }, d)| along[*to] = d);
        along[h] = -(along[h.next()] + along[h.prev()]);
        along[t] = -along[h];
    }
    along
}

/// Marks the union of shortest edge paths from the first landmark to the others.
fn cut_tree(mesh: &SurfaceMesh, landmarks: &[VertexId]) -> TiVec<HalfedgeId, bool> {
    let mut arrived_by: TiVec<VertexId, Option<HalfedgeId>> = ti_vec![None; mesh.vertex_count()];
    let mut cut = ti_vec![false; mesh.face_count() * 3];
    let Some(&root) = landmarks.first() else { return cut };
    let links = |v: u32| mesh.star(VertexId(v)).map(|h| (mesh.head(h).0, mesh.length(h), h));
    shortest_paths(mesh.vertex_count(), root.0, links, |v, h| arrived_by[VertexId(v)] = Some(h));
    for &landmark in landmarks {
        let mut v = landmark;
        while let Some(h) = arrived_by[v].filter(|&h| !cut[h]) {
            cut[h] = true;
            cut[mesh.twin(h)] = true;
            v = mesh.tail(h);
        }
    }
    cut
}

/// Faces placed in the plane next to each other.
pub(super) struct Development {
    /// For each halfedge the place of its start in its face.
    pub corners: TiVec<HalfedgeId, DVec2>,
    /// The faces in the order in which they were placed.
    pub order: Vec<FaceId>,
    /// The number, in that order, of the first face of each ring around the seed, and one past the end.
    pub rings: Vec<usize>,
    /// Whether a face was placed across the edge; twins agree.
    pub joined: TiVec<HalfedgeId, bool>,
}

/// Places the faces breadth first from a seed, across edges that are not cut.
pub(super) fn develop(
    mesh: &SurfaceMesh,
    along: &TiVec<HalfedgeId, DVec2>,
    cut: &TiVec<HalfedgeId, bool>,
    seed: FaceId,
) -> Development {
    let mut corners = ti_vec![DVec2::ZERO; along.len()];
    let mut joined = ti_vec![false; along.len()];
    let (mut order, mut rings) = (Vec::with_capacity(mesh.face_count()), vec![0]);
    let mut placed: TiVec<FaceId, bool> = ti_vec![false; mesh.face_count()];
    let mut queue = VecDeque::from([(HalfedgeId::of(seed, 0), DVec2::ZERO, DVec2::X, 0)]);
    placed[seed] = true;
    while let Some((h, start, turn, ring)) = queue.pop_front() {
        if ring == rings.len() {
            rings.push(order.len());
        }
        order.push(h.face());
        corners[h] = start;
        corners[h.next()] = start + complex_mul(turn, along[h]);
        corners[h.prev()] = corners[h.next()] + complex_mul(turn, along[h.next()]);
        for exit in [h, h.next(), h.prev()] {
            let t = mesh.twin(exit);
            if !cut[exit] && !std::mem::replace(&mut placed[t.face()], true) {
                (joined[exit], joined[t]) = (true, true);
                let back = -complex_mul(turn, along[exit]);
                let turn = conj_mul(along[t], back).normalize_or(DVec2::X);
                queue.push_back((t, corners[exit.next()], turn, ring + 1));
            }
        }
    }
    rings.push(order.len());
    Development { corners, order, rings, joined }
}

/// L2 stretch of texture coordinates over their positive faces (Sander et al. 2001, eq. 2); 1 for an isometry.
pub fn l2_stretch(mesh: &SurfaceMesh, uvs: &TiVec<HalfedgeId, DVec2>) -> f64 {
    let (mut stretch, mut area, mut uv_area) = (0.0, 0.0, 0.0);
    for f in mesh.faces() {
        let corners = mesh.corners(f);
        let [p, q, r] = f.halfedges().map(|h| uvs[h]);
        let double_uv = signed_double_area(p, q, r);
        if double_uv <= 0.0 {
            continue;
        }
        let partial = |w: [f64; 3]| (corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2]) / double_uv;
        let by_s = partial([q.y - r.y, r.y - p.y, p.y - q.y]);
        let by_t = partial([r.x - q.x, p.x - r.x, q.x - p.x]);
        let face_area = mesh.face_area(f);
        stretch += 0.5 * (by_s.length_squared() + by_t.length_squared()) * face_area;
        area += face_area;
        uv_area += 0.5 * double_uv;
    }
    (stretch / area * uv_area / area).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cone_metric::{FlowOptions, flow, uniform_curvature};
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;
    use std::f64::consts::PI;

    /// A squashed sphere, so that the flow has to flip edges.
    fn squashed() -> SurfaceMesh {
        let sphere = icosphere(3);
        let squash = |p: &glam::DVec3| glam::DVec3::new(p.x * 2.5, p.y, p.z * (0.3 + 0.2 * p.x));
        let positions = sphere.positions().iter().map(squash).collect();
        sphere.with_positions(positions)
    }

    #[test]
    fn edges_agree_across_the_mesh_and_angles_at_cones_are_the_targets() {
        let mesh = squashed();
        let landmarks: Vec<_> = [0, 40, 300, 500, 641].map(VertexId).to_vec();
        let target = uniform_curvature(mesh.vertex_count(), &landmarks);
        let (metric, _) = flow(&mesh, &target, &FlowOptions::default(), &mut Silent).unwrap();
        assert!(!metric.triangulation.flips().is_empty());
        let atlas = flat_atlas(&mesh, &metric, &landmarks, &mut Silent).unwrap();
        let edge = |h: HalfedgeId| atlas.corner_uvs[h.next()] - atlas.corner_uvs[h];
        for h in mesh.halfedges() {
            let t = mesh.twin(h);
            assert!((edge(h).length() - edge(t).length()).abs() < 1e-9);
            if !atlas.cut[h] {
                // The curvature left over by the flow shows around every vertex.
                assert!((atlas.corner_uvs[h] - atlas.corner_uvs[t.next()]).length() < 1e-6);
            }
        }
        // The signed corner angles sum to the cone angles, inverted faces included.
        for v in mesh.vertices() {
            let angle = |h: HalfedgeId| {
                let (from, to) = (edge(h), -edge(h.prev()));
                crate::math::triangle::turn(from, to)
            };
            let sum: f64 = mesh.star(v).map(angle).sum();
            assert!((sum - (2.0 * PI - target[v])).abs() < 1e-6, "{v:?} {sum}");
        }
    }

    #[test]
    fn an_isometry_has_stretch_one() {
        // The two sides of a flat square.
        let mesh = icosphere(0);
        let uvs: TiVec<HalfedgeId, DVec2> = mesh
            .faces()
            .flat_map(|f| {
                let [a, b, c] = mesh.corners(f);
                lay_out([a.distance(b), b.distance(c), c.distance(a)])
            })
            .collect();
        assert!((l2_stretch(&mesh, &uvs) - 1.0).abs() < 1e-12);
    }
}
