//! The thesis' patchwise map over two flat cone metrics (thesis section 3.4), built for comparison.
//!
//! The patch of a base face is developed into the plane; its three landmarks span a straight flat triangle there. The faces
//! over that triangle are found by region growing from a landmark, whether or not they belong to the drawn patch. Equal
//! barycentric coordinates in the straight triangles of source and target give the map.
//!
//! Limits: equal cone angles do not make the two metrics isometric, so that straight triangles can come out inverted and then
//! neither tile the source nor the target. Vertices over none, or over one that is inverted on either side, have no image;
//! where straight triangles overlap, the first one is taken. The result is in general not bijective.

use crate::cone_metric::ConeMetric;
use crate::cone_metric::atlas::mesh_displacements;
use crate::layout::{BaseLayout, PatchedMesh};
use crate::math::rigid2::{complex_mul, conj_mul};
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use glam::DVec2;
use typed_index_collections::{TiVec, ti_vec};

/// Barycentric coordinates down to minus this are inside a straight triangle.
const INSIDE: f64 = 1e-9;
/// The same for a point among the developed faces, whose positions carry the curvature that the flow leaves.
const INSIDE_FACE: f64 = 1e-6;

/// The patchwise map.
#[derive(Clone, Debug)]
pub struct ThesisMap {
    /// Image of each vertex of the source's input mesh: a point of the target's input mesh, or none.
    pub target_from_source: TiVec<VertexId, Option<SurfacePoint>>,
    /// Share of the source's input vertices without an image, 0 to 1.
    pub unmapped_share: f64,
    /// Base faces whose straight triangle is not positively oriented, on the source and on the target.
    pub inverted_patches: [usize; 2],
}

/// Maps the source's input vertices patch by patch.
///
/// `inputs` are the meshes that the layout was drawn on; `metrics` are flat but for the landmarks and live on the layout's
/// refined meshes.
///
/// # Errors
/// [`Cancelled`].
pub fn thesis_map(
    layout: &BaseLayout,
    inputs: [&SurfaceMesh; 2],
    metrics: [&ConeMetric; 2],
    monitor: &mut dyn Monitor,
) -> Result<ThesisMap, Cancelled> {
    let mut source = Flat::new(&layout.source, metrics[0]);
    let mut target = Flat::new(&layout.target, metrics[1]);
    let refined = layout.target.refined();
    let vertices = inputs[0].vertex_count();
    let mut images: TiVec<VertexId, Option<SurfacePoint>> = ti_vec![None; vertices];
    let mut taken = ti_vec![false; vertices];
    for (&s, &t) in layout.source.landmark_vertices.iter().zip(&layout.target.landmark_vertices) {
        images[s] = Some(refined.on_input(inputs[1], SurfacePoint::at_vertex(&layout.target.mesh, t)));
        taken[s] = true;
    }
    let mut inverted_patches = [0; 2];
    for patch in layout.base.mesh.faces() {
        let fraction = patch.index() as f64 / layout.base.mesh.face_count() as f64;
        monitor.step(Step { fraction, residual: None })?;
        let [from, onto] = [source.straighten(patch), target.straighten(patch)];
        inverted_patches[0] += usize::from(from.is_none());
        inverted_patches[1] += usize::from(onto.is_none());
        let Some(from) = from else { continue };
        let inside = vertices_inside(&source.region(&from), &from.corners, &layout.source.mesh, &mut taken);
        let Some(onto) = onto else { continue };
        let faces = Bins::new(target.region(&onto), &onto.corners);
        for (v, weights) in inside {
            let q = (0..3).map(|k| onto.corners[k] * weights[k]).sum();
            images[v] = faces.locate(q).map(|point| refined.on_input(inputs[1], point));
        }
    }
    let unmapped = images.iter().filter(|image| image.is_none()).count();
    let unmapped_share = unmapped as f64 / vertices as f64;
    Ok(ThesisMap { target_from_source: images, unmapped_share, inverted_patches })
}

/// The vertices not yet taken over a straight triangle, with their barycentric coordinates in it; takes them.
fn vertices_inside(
    region: &[Placed],
    triangle: &[DVec2; 3],
    mesh: &SurfaceMesh,
    taken: &mut TiVec<VertexId, bool>,
) -> Vec<(VertexId, [f64; 3])> {
    let mut inside = Vec::new();
    for placed in region {
        for (v, &p) in mesh.triangles()[placed.face].into_iter().zip(&placed.corners) {
            // Vertices that the layout added come after those of the input mesh.
            if v.index() >= taken.len() || taken[v] {
                continue;
            }
            let weights = weights(triangle, p);
            if weights.iter().all(|&w| w >= -INSIDE) {
                taken[v] = true;
                inside.push((v, weights));
            }
        }
    }
    inside
}

/// Barycentric coordinates of p in a triangle that is not degenerate.
fn weights(&[a, b, c]: &[DVec2; 3], p: DVec2) -> [f64; 3] {
    let whole = signed_double_area(a, b, c);
    [signed_double_area(p, b, c), signed_double_area(p, c, a), signed_double_area(p, a, b)].map(|w| w / whole)
}

/// A face developed into the plane.
#[derive(Clone, Copy, Debug)]
struct Placed {
    face: FaceId,
    corners: [DVec2; 3],
}

/// A base face straight between its landmarks, positively oriented.
struct Straight {
    corners: [DVec2; 3],
    /// A developed face at corner 0 into which the triangle opens.
    seed: Placed,
}

/// A refined mesh with a flat cone metric.
struct Flat<'a> {
    patched: &'a PatchedMesh,
    /// Displacement along each halfedge in the frame of its face.
    along: TiVec<HalfedgeId, DVec2>,
    /// The development that placed each face last.
    placed_in: TiVec<FaceId, u32>,
    development: u32,
}

impl<'a> Flat<'a> {
    fn new(patched: &'a PatchedMesh, metric: &ConeMetric) -> Self {
        let placed_in = ti_vec![0; patched.mesh.face_count()];
        Self { patched, along: mesh_displacements(metric), placed_in, development: 0 }
    }

    /// A face with the start of one of its halfedges at the origin, in its own frame.
    fn at_origin(&self, h: HalfedgeId) -> Placed {
        let mut corners = [DVec2::ZERO; 3];
        corners[h.next().corner()] = self.along[h];
        corners[h.prev().corner()] = -self.along[h.prev()];
        Placed { face: h.face(), corners }
    }

    /// The neighbour across side `k` of a developed face.
    fn across(&self, from: &Placed, k: usize) -> Placed {
        let t = self.patched.mesh.twin(HalfedgeId::of(from.face, k));
        let (start, end) = (from.corners[(k + 1) % 3], from.corners[k]);
        let turn = conj_mul(self.along[t], end - start).normalize_or(DVec2::X);
        let mut corners = [start; 3];
        corners[t.next().corner()] = end;
        corners[t.prev().corner()] = end + complex_mul(turn, self.along[t.next()]);
        Placed { face: t.face(), corners }
    }

    /// Develops breadth first from a face over all neighbours that are wanted; every face at most once.
    fn develop(&mut self, seed: Placed, wanted: impl Fn(&Placed) -> bool) -> Vec<Placed> {
        self.development += 1;
        self.placed_in[seed.face] = self.development;
        let mut region = vec![seed];
        let mut done = 0;
        while let Some(&from) = region.get(done) {
            done += 1;
            for k in 0..3 {
                let neighbour = self.patched.mesh.twin(HalfedgeId::of(from.face, k)).face();
                if self.placed_in[neighbour] == self.development {
                    continue;
                }
                let next = self.across(&from, k);
                if wanted(&next) {
                    self.placed_in[neighbour] = self.development;
                    region.push(next);
                }
            }
        }
        region
    }

    /// Develops a patch, a disc without cones inside; `None` when the triangle of its landmarks is not positive.
    fn straighten(&mut self, patch: FaceId) -> Option<Straight> {
        let patched = self.patched;
        let mut begin = [HalfedgeId(0); 3];
        for (k, h) in begin.iter_mut().enumerate() {
            let path = &patched.paths[HalfedgeId::of(patch, k)];
            *h = patched.mesh.halfedge_between(path[0], path[1])?;
        }
        let first = self.at_origin(begin[0]);
        let mut corners = [DVec2::NAN; 3];
        for placed in self.develop(first, |placed| patched.face_patch[placed.face] == patch) {
            for k in (0..3).filter(|&k| begin[k].face() == placed.face) {
                corners[k] = placed.corners[begin[k].corner()];
            }
        }
        let [a, b, c] = corners;
        let inwards = (b - a).normalize_or_zero() + (c - a).normalize_or_zero();
        let positive = signed_double_area(a, b, c) > 0.0;
        positive.then(|| Straight { corners, seed: self.towards(begin[0], first, inwards) })
    }

    /// The face around the start of `h` into which a direction points, on the side of `h` where it is nearer.
    fn towards(&self, h: HalfedgeId, first: Placed, direction: DVec2) -> Placed {
        let counter_clockwise = self.along[h].perp_dot(direction) >= 0.0;
        let found = self.turn(h, first, direction, counter_clockwise);
        found.or_else(|| self.turn(h, first, direction, !counter_clockwise)).unwrap_or(first)
    }

    /// Turns once around the start of `h`.
    fn turn(
        &self,
        h: HalfedgeId,
        first: Placed,
        direction: DVec2,
        counter_clockwise: bool,
    ) -> Option<Placed> {
        let mesh = &self.patched.mesh;
        let (mut at, mut placed) = (h, first);
        loop {
            let side = |x: HalfedgeId| placed.corners[x.corner()] - placed.corners[at.corner()];
            let (right, left) = (side(at.next()), side(at.prev()));
            if right.perp_dot(left) > 0.0
                && right.perp_dot(direction) >= 0.0
                && direction.perp_dot(left) >= 0.0
            {
                return Some(placed);
            }
            if counter_clockwise {
                placed = self.across(&placed, at.prev().corner());
                at = mesh.twin(at.prev());
            } else {
                placed = self.across(&placed, at.corner());
                at = mesh.twin(at).next();
            }
            if at == h {
                return None;
            }
        }
    }

    /// The developed faces over a straight triangle.
    fn region(&mut self, straight: &Straight) -> Vec<Placed> {
        self.develop(straight.seed, |placed| overlap(&straight.corners, &placed.corners))
    }
}

/// Whether a positive triangle and another one have more than their borders in common.
///
/// Touching is not enough: around a landmark all faces touch the triangle, and growing over them would turn around the cone.
fn overlap(triangle: &[DVec2; 3], other: &[DVec2; 3]) -> bool {
    let sign = if signed_double_area(other[0], other[1], other[2]) < 0.0 { -1.0 } else { 1.0 };
    let size = |of: &[DVec2; 3]| {
        let [low, high] = bounds(of);
        (high - low).max_element()
    };
    // Faces near a cone can be smaller than the triangle by many orders: the tolerance is relative to both, beyond rounding.
    let (large, small) = (size(triangle), size(other));
    let grain = 1e-9 * large * small + 1e-15 * large * large;
    let apart = |of: &[DVec2; 3], from: &[DVec2; 3], sign: f64| {
        (0..3).any(|k| from.iter().all(|&p| sign * signed_double_area(of[k], of[(k + 1) % 3], p) <= grain))
    };
    !apart(triangle, other, 1.0) && !apart(other, triangle, sign)
}

/// Developed faces in square bins over a triangle.
struct Bins {
    faces: Vec<Placed>,
    low: DVec2,
    /// Bins per unit of length.
    density: DVec2,
    side: usize,
    bins: Vec<Vec<u32>>,
}

impl Bins {
    fn new(faces: Vec<Placed>, triangle: &[DVec2; 3]) -> Self {
        let [low, high] = bounds(triangle);
        let side = ((faces.len() as f64).sqrt() as usize).clamp(1, 512);
        let density = DVec2::splat(side as f64) / (high - low);
        let mut result = Self { faces, low, density, side, bins: vec![Vec::new(); side * side] };
        for number in 0..result.faces.len() {
            let [low, high] = bounds(&result.faces[number].corners);
            let ([x0, y0], [x1, y1]) = (result.bin(low), result.bin(high));
            for y in y0..=y1 {
                (x0..=x1).for_each(|x| result.bins[y * side + x].push(number as u32));
            }
        }
        result
    }

    fn bin(&self, p: DVec2) -> [usize; 2] {
        let scaled = (p - self.low) * self.density;
        scaled.to_array().map(|x| (x.max(0.0) as usize).min(self.side - 1))
    }

    /// The face, not inverted, that contains a point best.
    fn locate(&self, q: DVec2) -> Option<SurfacePoint> {
        let [x, y] = self.bin(q);
        let mut best: Option<(f64, SurfacePoint)> = None;
        for &number in &self.bins[y * self.side + x] {
            let Placed { face, corners } = self.faces[number as usize];
            if signed_double_area(corners[0], corners[1], corners[2]) <= 0.0 {
                continue;
            }
            let weights = weights(&corners, q);
            let least = weights.into_iter().fold(f64::INFINITY, f64::min);
            if least >= -INSIDE_FACE && best.is_none_or(|(other, _)| least > other) {
                let clamped = weights.map(|w| w.max(0.0));
                let sum: f64 = clamped.iter().sum();
                best = Some((least, SurfacePoint { face, barycentric: clamped.map(|w| w / sum) }));
            }
        }
        best.map(|(_, point)| point)
    }
}

fn bounds(&[a, b, c]: &[DVec2; 3]) -> [DVec2; 2] {
    [a.min(b).min(c), a.max(b).max(c)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cone_metric::{FlowOptions, base_domain_curvature, flow};
    use crate::landmarks::Landmarks;
    use crate::layout::{LayoutOptions, joint};
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;
    use glam::DVec3;

    fn octahedral(mesh: &SurfaceMesh) -> Vec<[u32; 2]> {
        let directions = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        let nearest = |d: DVec3| {
            mesh.vertices().max_by(|&a, &b| mesh.positions()[a].dot(d).total_cmp(&mesh.positions()[b].dot(d)))
        };
        directions.into_iter().filter_map(nearest).map(|v| [v.0, v.0]).collect()
    }

    fn map(meshes: [&SurfaceMesh; 2], landmarks: &Landmarks) -> ThesisMap {
        let layout = joint(meshes, landmarks, &LayoutOptions::default(), &mut Silent).unwrap();
        let metric = |side: &PatchedMesh| {
            let vertices = &side.landmark_vertices.raw;
            let goal = base_domain_curvature(side.mesh.vertex_count(), vertices, &layout.base);
            flow(&side.mesh, &goal, &FlowOptions::default(), &mut Silent).unwrap().0
        };
        let (source, target) = (metric(&layout.source), metric(&layout.target));
        thesis_map(&layout, meshes, [&source, &target], &mut Silent).unwrap()
    }

    #[test]
    fn a_sphere_is_mapped_onto_itself_by_the_identity() {
        let sphere = icosphere(3);
        let landmarks = Landmarks::from_vertices(&sphere, &sphere, &octahedral(&sphere)).unwrap();
        let result = map([&sphere, &sphere], &landmarks);
        assert_eq!(result.inverted_patches, [0, 0]);
        assert_eq!(result.unmapped_share, 0.0);
        for (v, image) in result.target_from_source.iter_enumerated() {
            let distance = image.unwrap().position(&sphere).distance(sphere.positions()[v]);
            assert!(distance < 1e-6, "{v:?} {distance}");
        }
    }

    #[test]
    fn landmarks_go_to_landmarks_and_a_similar_metric_covers_nearly_all() {
        let sphere = icosphere(3);
        let stretched = sphere.positions().iter().map(|p| DVec3::new(1.3 * p.x, p.y, 0.9 * p.z)).collect();
        let egg = sphere.with_positions(stretched);
        let landmarks = Landmarks::from_vertices(&sphere, &egg, &octahedral(&sphere)).unwrap();
        let result = map([&sphere, &egg], &landmarks);
        assert_eq!(result.inverted_patches, [0, 0]);
        assert!(result.unmapped_share < 0.01, "{}", result.unmapped_share);
        for &v in &landmarks.source {
            let image = result.target_from_source[v].unwrap().position(&egg);
            assert!(image.distance(egg.positions()[v]) < 1e-12);
        }
    }

    #[test]
    fn triangles_that_share_a_corner_or_a_side_do_not_overlap() {
        let triangle = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let beside = [DVec2::ZERO, DVec2::NEG_Y, DVec2::X];
        let corner = [DVec2::ZERO, DVec2::NEG_X, DVec2::NEG_Y];
        let turned = [DVec2::new(0.2, 0.2), DVec2::new(0.2, 2.0), DVec2::new(2.0, 0.2)];
        assert!(!overlap(&triangle, &beside) && !overlap(&triangle, &corner));
        assert!(overlap(&triangle, &turned) && overlap(&triangle, &triangle));
    }
}
