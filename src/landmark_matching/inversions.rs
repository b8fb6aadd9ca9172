//! Images of a body under inversions, on which one side of it is larger than the other.
//!
//! Where two shortest paths are nearly equal, as those over chest and back of a man, a small change of the lengths exchanges them. The images
//! have such changes: on one the way over the back is shorter, on another that over the chest.

use crate::math::rigid3::outer;
use crate::mesh::SurfaceMesh;
use glam::{DMat3, DVec3};
use nalgebra::Matrix3;

/// The distance of the centres of inversion from the middle of the body, in units of the root of the area: lengths change by a sixth over
/// the depth of a chest (0.25). Chosen by hand.
const DISTANCE: f64 = 3.0;

/// The images of a body of area 1 under inversions at six centres, two on each principal axis.
pub(super) fn inversions(mesh: &SurfaceMesh) -> Vec<SurfaceMesh> {
    let positions = mesh.positions();
    let middle = positions.iter().sum::<DVec3>() / positions.len() as f64;
    let spread = positions.iter().fold(DMat3::ZERO, |sum, &p| sum + outer(p - middle, p - middle));
    let axes: Matrix3<f64> = Matrix3::from(spread).symmetric_eigen().eigenvectors;
    let axes = axes.column_iter().map(|axis| DVec3::new(axis[0], axis[1], axis[2]));
    let size = positions.iter().map(|p| p.distance(middle)).fold(0.0, f64::max);
    // A centre inside the body would tear it.
    let distance = DISTANCE.max(2.0 * size);
    let centres = axes.flat_map(|axis| [1.0, -1.0].map(|side| middle + side * distance * axis));
    let image = |centre: DVec3| {
        let at = |p: DVec3| (p - centre) * (distance * distance / p.distance_squared(centre));
        mesh.with_positions(positions.iter().map(|&p| at(p)).collect())
    };
    centres.map(image).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    #[test]
    fn each_side_is_the_larger_one_on_some_image() {
        let ball = icosphere(3);
        let areas = ball.vertex_areas();
        let images: Vec<_> = inversions(&ball).iter().map(SurfaceMesh::vertex_areas).collect();
        assert_eq!(images.len(), 6);
        for v in ball.vertices() {
            let growth = images.iter().map(|image| image[v] / areas[v]);
            let (least, most) = growth.fold((f64::INFINITY, 0.0_f64), |(a, b), g| (a.min(g), b.max(g)));
            assert!(least < 0.75 && most > 1.35, "{least} {most}");
        }
    }
}
