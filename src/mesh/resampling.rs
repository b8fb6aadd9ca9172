//! Values at the vertices of one mesh of a body, at the vertices of another mesh of it.
//!
//! Each vertex is projected onto the mesh that has the values, and its value is interpolated from those at the corners of the face there.
//! Only places that face the same way count, so that where limbs are close none has the values of another.

use super::normals::vertex_normals;
use super::surface_index::SurfaceIndex;
use super::{FaceId, SurfaceMesh, VertexId};
use crate::math::barycentric::interpolated;
use glam::DVec3;
use typed_index_collections::{TiSlice, TiVec};

/// The values at the vertices of `onto`, by one search each, from those at the vertices of `from`; both meshes lie in the same place.
/// Where `known` gives the vertex of `from` that a vertex of `onto` is, its value is taken as it is.
pub fn resampled(
    values: &TiSlice<VertexId, DVec3>,
    from: &SurfaceMesh,
    onto: &SurfaceMesh,
    known: impl Fn(VertexId) -> Option<VertexId>,
) -> TiVec<VertexId, DVec3> {
    let (index, normals) = (SurfaceIndex::new(from), vertex_normals(onto));
    let mut near = FaceId(0);
    let value = |v: VertexId| {
        if let Some(known) = known(v) {
            return values[known];
        }
        let point = index.nearest_facing(onto.positions()[v], normals[v], near).point;
        near = point.face;
        interpolated(from.triangles()[near].map(|corner| values[corner]), point.barycentric)
    };
    onto.vertices().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    /// A ball pressed to a sheet, moved along its thickness.
    fn sheet(levels: usize, moved: f64) -> SurfaceMesh {
        let ball = icosphere(levels);
        let flat = |p: &DVec3| DVec3::new(p.x, p.y, 0.001 * p.z + moved);
        ball.with_positions(ball.positions().iter().map(flat).collect())
    }

    /// The side of a sheet on which each vertex lies, as a direction.
    fn sides(levels: usize) -> TiVec<VertexId, DVec3> {
        icosphere(levels).positions().iter().map(|p| DVec3::Z * p.z.signum()).collect()
    }

    #[test]
    fn a_side_has_its_own_values_where_the_other_is_nearer() {
        // The fine sheet lies beyond one side of the coarse one, which so is the nearer for all its vertices.
        for moved in [-0.01, 0.01] {
            let (coarse, fine) = (sheet(2, 0.0), sheet(4, moved));
            let found = resampled(&sides(2), &coarse, &fine, |_| None);
            let (mut compared, ball) = (0, icosphere(4));
            for v in ball.vertices().filter(|v| ball.positions()[*v].z.abs() > 0.4) {
                assert!(found[v].distance(sides(4)[v]) < 1e-12, "{v:?} {}", found[v]);
                compared += 1;
            }
            assert!(compared > 1000, "{compared}");
        }
    }

    #[test]
    fn at_known_vertices_values_stay() {
        let (ball, values) = (icosphere(2), sides(2));
        let elsewhere = |v: VertexId| VertexId::from(161 - v.index());
        let found = resampled(&values, &ball, &ball, |v| Some(elsewhere(v)));
        assert!(ball.vertices().all(|v| found[v] == values[elsewhere(v)]));
        // They are found likewise.
        let found = resampled(ball.positions(), &ball, &ball, |_| None);
        assert!(ball.vertices().all(|v| found[v].distance(ball.positions()[v]) < 1e-12));
    }
}
