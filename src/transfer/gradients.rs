//! Deformation gradients of a mesh's triangles between its own shape and another one.
//!
//! On a triangle's plane the gradient follows from its sides. Across it Sumner & Popovic (2004) take the normal to the new normal, scaled
//! with the root of the area; that is right for rotations and scalings. An affine map takes normals elsewhere, so where the whole shape is
//! an affine image of the mesh, the normal goes as in that map.

use crate::mesh::{FaceId, SurfaceMesh, VertexId};
use glam::{DMat3, DVec3};
use typed_index_collections::{TiSlice, TiVec};

/// The distance of a shape from an affine image of the mesh at which it counts half as one: the mean of its points' distances, in
/// units of their mean distance from its middle. Chosen by hand.
const AFFINE: f64 = 1e-3;

/// The 3 by 3 gradient of every face from the mesh to a shape with its connectivity.
pub fn gradients(mesh: &SurfaceMesh, shape: &TiSlice<VertexId, DVec3>) -> TiVec<FaceId, DMat3> {
    let (affine, share) = nearest_affine(mesh, shape);
    let gradient = |f: FaceId| {
        let corners = mesh.triangles()[f];
        let [here, there] = [mesh.positions(), shape].map(|points| corners.map(|v| points[v]));
        let (across, onto) = (normal(here), normal(there));
        let onto = onto + (affine * across - onto) * share;
        let frame = |[p, q, r]: [DVec3; 3], across: DVec3| DMat3::from_cols(q - p, r - p, across);
        let gradient = frame(there, onto) * frame(here, across).inverse();
        // A face without area tells nothing.
        if gradient.is_finite() { gradient } else { affine }
    };
    mesh.faces().map(gradient).collect()
}

/// The normal of a triangle, as long as the root of twice its area.
fn normal([p, q, r]: [DVec3; 3]) -> DVec3 {
    let cross = (q - p).cross(r - p);
    cross.normalize_or_zero() * cross.length().sqrt()
}

/// The linear part of the affine map that takes a mesh nearest to a shape, by area, and how far the shape counts as its image:
/// 1 where it is, 0 where it is another one.
fn nearest_affine(mesh: &SurfaceMesh, shape: &TiSlice<VertexId, DVec3>) -> (DMat3, f64) {
    let areas = mesh.vertex_areas();
    let [here, there] = [mesh.positions(), shape].map(|points| centre(&areas, points));
    let (mut spread, mut both) = (DMat3::ZERO, DMat3::ZERO);
    for (v, &area) in areas.iter_enumerated() {
        let [p, q] = [mesh.positions()[v] - here, shape[v] - there];
        spread += DMat3::from_cols(p * p.x, p * p.y, p * p.z) * area;
        both += DMat3::from_cols(q * p.x, q * p.y, q * p.z) * area;
    }
    let affine = both * spread.inverse();
    if !affine.is_finite() {
        return (DMat3::IDENTITY, 0.0);
    }
    let (mut off, mut size) = (0.0, 0.0);
    for (v, &area) in areas.iter_enumerated() {
        let [p, q] = [mesh.positions()[v] - here, shape[v] - there];
        off += area * (affine * p).distance_squared(q);
        size += area * q.length_squared();
    }
    let share = size / (size + off / (AFFINE * AFFINE));
    (affine, if share.is_finite() { share } else { 0.0 })
}

/// The mean of points over the area.
pub fn centre(areas: &TiSlice<VertexId, f64>, points: &TiSlice<VertexId, DVec3>) -> DVec3 {
    let sum: DVec3 = areas.iter().zip(points).map(|(area, p)| *p * *area).sum();
    sum / areas.iter().sum::<f64>()
}
