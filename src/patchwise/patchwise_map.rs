//! The thesis' patchwise map over two flat cone metrics (thesis section 3.4), built for comparison.
//!
//! The patch of a base face is developed into the plane; its three landmarks span a straight flat triangle there. The faces
//! over that triangle are found by region growing from a landmark, whether or not they belong to the drawn patch. Equal
//! barycentric coordinates in the straight triangles of source and target give the map.
//!
//! Limits: equal cone angles do not make the two metrics isometric, so that straight triangles can come out inverted and then
//! neither tile the source nor the target. Vertices over none, or over one that is inverted on either side, have no image;
//! where straight triangles overlap, the first one is taken. The result is in general not bijective.

use super::bins::{Bins, weights};
use super::development::{DevelopedMesh, Placed};
use crate::cone_metric::ConeMetric;
use crate::layout::{BaseLayout, PatchedMesh};
use crate::math::predicates::orient2d;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use glam::DVec2;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// Barycentric coordinates down to minus this are inside a straight triangle.
const INSIDE: f64 = 1e-9;
/// The patchwise map.
#[derive(Clone, Debug)]
pub struct PatchwiseMap {
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
pub fn patchwise_map(
    layout: &BaseLayout,
    inputs: [&SurfaceMesh; 2],
    metrics: [&ConeMetric; 2],
    monitor: &mut dyn Monitor,
) -> Result<PatchwiseMap, Cancelled> {
    let mut source = DevelopedMesh::new(&layout.source, metrics[0]);
    let mut target = DevelopedMesh::new(&layout.target, metrics[1]);
    let flat = |developed: &mut DevelopedMesh<'_>, patch: FaceId| {
        let straight = developed.straighten(patch)?;
        Some(FlatPatch { corners: straight.corners, faces: developed.region(&straight) })
    };
    let taken = ti_vec![false; inputs[0].vertex_count()];
    mapped(layout, inputs, taken, |patch| [flat(&mut source, patch), flat(&mut target, patch)], monitor)
}

/// Maps the source's input vertices where every patch lies on the same straight triangle on both meshes: of each face of the refined meshes
/// `corners` has the places in the triangle of its patch. Vertices of faces that are inverted or have no area have no image, nor those over such faces
/// alone.
///
/// # Errors
/// [`Cancelled`].
pub fn straight_map(
    layout: &BaseLayout,
    inputs: [&SurfaceMesh; 2],
    triangles: &TiSlice<FaceId, [DVec2; 3]>,
    corners: [&TiSlice<HalfedgeId, DVec2>; 2],
    monitor: &mut dyn Monitor,
) -> Result<PatchwiseMap, Cancelled> {
    let by_patch = |side: &PatchedMesh, corners: &TiSlice<HalfedgeId, DVec2>| {
        let mut faces = ti_vec![Vec::new(); triangles.len()];
        for (face, &patch) in side.face_patch.iter_enumerated() {
            faces[patch].push(Placed { face, corners: face.halfedges().map(|h| corners[h]) });
        }
        faces
    };
    let mut source: TiVec<FaceId, Vec<Placed>> = by_patch(&layout.source, corners[0]);
    monitor.step(Step::default())?;
    let mut taken = ti_vec![false; inputs[0].vertex_count()];
    for placed in source.iter().flatten().filter(|placed| !is_positive(placed)) {
        for v in layout.source.mesh.triangles()[placed.face] {
            // Vertices that the layout added are left out.
            if let Some(taken) = taken.get_mut(v) {
                *taken = true;
            }
        }
    }
    monitor.step(Step::default())?;
    let mut target: TiVec<FaceId, Vec<Placed>> = by_patch(&layout.target, corners[1]);
    let flat = |faces: &mut TiVec<FaceId, Vec<Placed>>, patch: FaceId| {
        Some(FlatPatch { corners: triangles[patch], faces: std::mem::take(&mut faces[patch]) })
    };
    mapped(layout, inputs, taken, |patch| [flat(&mut source, patch), flat(&mut target, patch)], monitor)
}

fn is_positive(Placed { corners: [p, q, r], .. }: &Placed) -> bool {
    orient2d(*p, *q, *r) > 0.0
}

/// A patch in the plane.
struct FlatPatch {
    /// Its straight triangle, positively oriented.
    corners: [DVec2; 3],
    /// The faces over it.
    faces: Vec<Placed>,
}

/// Maps the source's input vertices by equal barycentric coordinates; `flat` has each patch on the source and on the target, where it is not
/// inverted. Vertices that are taken from the start have no image.
fn mapped(
    layout: &BaseLayout,
    inputs: [&SurfaceMesh; 2],
    mut taken: TiVec<VertexId, bool>,
    mut flat: impl FnMut(FaceId) -> [Option<FlatPatch>; 2],
    monitor: &mut dyn Monitor,
) -> Result<PatchwiseMap, Cancelled> {
    let refined = layout.target.refined();
    let vertices = inputs[0].vertex_count();
    let mut images: TiVec<VertexId, Option<SurfacePoint>> = ti_vec![None; vertices];
    for (&s, &t) in layout.source.landmark_vertices.iter().zip(&layout.target.landmark_vertices) {
        images[s] = Some(refined.on_input(inputs[1], SurfacePoint::at_vertex(&layout.target.mesh, t)));
        taken[s] = true;
    }
    let mut inverted_patches = [0; 2];
    for patch in layout.base.mesh.faces() {
        let fraction = patch.index() as f64 / layout.base.mesh.face_count() as f64;
        monitor.step(Step { fraction, residual: None })?;
        let [from, onto] = flat(patch);
        inverted_patches[0] += usize::from(from.is_none());
        inverted_patches[1] += usize::from(onto.is_none());
        let Some(from) = from else { continue };
        let inside = vertices_inside(&from.faces, &from.corners, &layout.source.mesh, &mut taken);
        let Some(onto) = onto else { continue };
        let faces = Bins::new(onto.faces, &onto.corners);
        for Inside { vertex, weights } in inside {
            let q = (0..3).map(|k| onto.corners[k] * weights[k]).sum();
            images[vertex] = faces.locate(q).map(|point| refined.on_input(inputs[1], point));
        }
    }
    let unmapped = images.iter().filter(|image| image.is_none()).count();
    let unmapped_share = unmapped as f64 / vertices as f64;
    Ok(PatchwiseMap { target_from_source: images, unmapped_share, inverted_patches })
}

/// A vertex over a straight triangle.
struct Inside {
    vertex: VertexId,
    /// Its barycentric coordinates in the triangle.
    weights: [f64; 3],
}

/// The vertices not yet taken over a straight triangle; takes them.
fn vertices_inside(
    region: &[Placed],
    triangle: &[DVec2; 3],
    mesh: &SurfaceMesh,
    taken: &mut TiVec<VertexId, bool>,
) -> Vec<Inside> {
    let mut inside = Vec::new();
    for placed in region {
        for (vertex, &p) in mesh.triangles()[placed.face].into_iter().zip(&placed.corners) {
            // Vertices that the layout added come after those of the input mesh.
            if vertex.index() >= taken.len() || taken[vertex] {
                continue;
            }
            let weights = weights(triangle, p);
            if weights.iter().all(|&w| w >= -INSIDE) {
                taken[vertex] = true;
                inside.push(Inside { vertex, weights });
            }
        }
    }
    inside
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

    fn map(meshes: [&SurfaceMesh; 2], landmarks: &Landmarks) -> PatchwiseMap {
        let layout = joint(meshes, landmarks, &LayoutOptions::default(), &mut Silent).unwrap();
        let metric = |side: &PatchedMesh| {
            let vertices = &side.landmark_vertices.raw;
            let goal = base_domain_curvature(side.mesh.vertex_count(), vertices, &layout.base);
            flow(&side.mesh, &goal, &FlowOptions::default(), &mut Silent).unwrap().0
        };
        let (source, target) = (metric(&layout.source), metric(&layout.target));
        patchwise_map(&layout, meshes, [&source, &target], &mut Silent).unwrap()
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
}
