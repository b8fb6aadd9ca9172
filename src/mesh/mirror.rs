//! Mirror images of surfaces: x -> -x, and every triangle turned, so that the outside stays outside.

use super::{MeshError, SurfaceMesh, SurfacePoint};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Which target is mapped onto.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TargetImage {
    /// The map goes onto the target as it is in its file.
    #[default]
    AsGiven,
    /// The map goes onto the target's mirror image, for landmarks whose left and right are exchanged; results are in the numbers of the
    /// target as given.
    Mirrored,
}

/// The mirror image of a mesh. Vertices and faces keep their numbers; the last two corners of each face are exchanged.
///
/// # Errors
/// [`MeshError`], which the connectivity of a mesh gives no cause for.
pub fn mirrored(mesh: &SurfaceMesh) -> Result<SurfaceMesh, MeshError> {
    let positions = mesh.positions().iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect();
    let faces = mesh.triangles().iter().map(|&[a, b, c]| [a, c, b]).collect();
    SurfaceMesh::from_triangles(positions, faces)
}

/// The same point on the mirror image; the function is its own inverse.
pub fn mirrored_point(point: SurfacePoint) -> SurfacePoint {
    SurfacePoint { barycentric: mirrored_weights(point.barycentric), ..point }
}

/// The weights of a face's corners in the mirror image; the function is its own inverse.
pub fn mirrored_weights([a, b, c]: [f64; 3]) -> [f64; 3] {
    [a, c, b]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::FaceId;
    use crate::mesh::generators::icosphere;

    #[test]
    fn twice_is_the_mesh_itself_and_points_go_along() {
        let mesh = icosphere(1);
        let image = mirrored(&mesh).unwrap();
        let back = mirrored(&image).unwrap();
        assert_eq!(back.positions(), mesh.positions());
        assert_eq!(back.triangles(), mesh.triangles());
        let point = SurfacePoint { face: FaceId(7), barycentric: [0.1, 0.2, 0.7] };
        let (p, q) = (point.position(&mesh), mirrored_point(point).position(&image));
        assert!(q.distance(DVec3::new(-p.x, p.y, p.z)) < 1e-15);
    }

    #[test]
    fn the_outside_stays_outside() {
        let image = mirrored(&icosphere(1)).unwrap();
        for f in image.faces() {
            let [p, q, r] = image.corners(f);
            assert!((q - p).cross(r - p).dot(p + q + r) > 0.0);
        }
    }
}
