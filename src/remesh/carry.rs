//! Points of a surface on another mesh of it.

use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint};

/// The points of `onto` nearest to points of `surface`, among those that face the same way: landmarks and known
/// correspondences of a surface on another mesh of it.
///
/// A point on a part that the other mesh has lost comes to the nearest part that is left.
pub fn carried(surface: &SurfaceMesh, onto: &SurfaceMesh, points: &[SurfacePoint]) -> Vec<SurfacePoint> {
    let (surface, onto) = (SurfaceIndex::new(surface), SurfaceIndex::new(onto));
    let mut near = FaceId(0);
    let mut carry = |point: &SurfacePoint| {
        let found = onto.nearest_facing(point.position(surface.mesh()), surface.normal(*point), near);
        // The next point is often beside this one.
        near = found.point.face;
        found.point
    };
    points.iter().map(&mut carry).collect()
}
