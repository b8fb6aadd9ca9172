//! Landmarks as the map holds them: a point that lies nearly on a corner or an edge of its face is held there.

use crate::io::landmark_file::{LandmarkFile, LandmarkPoint};
use crate::landmarks::{MeshSide, PlacedLandmarks};
use crate::map_file::FileMesh;
use crate::mesh::{FaceId, SurfacePoint};

/// The largest distance, in units of the root of the mesh's area, by which rounding alone may have moved a point.
const MOVED: f64 = 1e-12;

/// Tells the landmarks that were moved onto a corner or an edge where they are held, on the files' meshes, so that a map file and
/// its proof speak of the same points.
pub(super) fn tell(landmarks: &mut LandmarkFile, placed: &PlacedLandmarks, meshes: [&FileMesh; 2]) {
    for (side, placed) in MeshSide::BOTH.into_iter().zip([&placed.source, &placed.target]) {
        let file = meshes[side];
        let mesh = file.mesh();
        let size = mesh.area().sqrt();
        for (pair, &vertex) in landmarks.pairs.iter_mut().zip(&placed.vertices) {
            let LandmarkPoint::OnFace { face, barycentric } = pair[side] else { continue };
            let held = placed.on_original(SurfacePoint::at_vertex(&placed.mesh, vertex));
            let given = file.on_mesh(SurfacePoint::clamped(FaceId(face), barycentric));
            if given.position(mesh).distance(held.position(mesh)) > MOVED * size {
                let SurfacePoint { face, barycentric } = file.on_file(held);
                pair[side] = LandmarkPoint::OnFace { face: face.0, barycentric };
            }
        }
    }
}
