//! Points spread evenly over the faces of a mesh.

use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint};

/// A point of a surface that stands for some of its area.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// The point.
    pub point: SurfacePoint,
    /// The area that the point stands for.
    pub area: f64,
}

/// About `count` points over the faces that are wanted: the centroids of the k^2 equal triangles that a face is cut into, `least`
/// being the least k and 16 the largest. Where there are as many faces as points, 1 is the least k.
pub(super) fn samples(
    mesh: &SurfaceMesh,
    is_wanted: impl Fn(FaceId) -> bool,
    count: usize,
    least: usize,
) -> Vec<Sample> {
    let wanted: Vec<FaceId> = mesh.faces().filter(|&f| is_wanted(f)).collect();
    let area: f64 = wanted.iter().map(|&f| mesh.face_area(f)).sum();
    let each = area / count as f64;
    let least = if wanted.len() < count { least } else { 1 };
    let mut samples = Vec::with_capacity(count);
    for face in wanted {
        let area = mesh.face_area(face);
        let k = ((area / each).sqrt().round() as usize).clamp(least, 16);
        let share = 1.0 / (3 * k) as f64;
        let mut push = |i: usize, j: usize| {
            let [x, y] = [i as f64 * share, j as f64 * share];
            let point = SurfacePoint { face, barycentric: [1.0 - x - y, x, y] };
            samples.push(Sample { point, area: area / (k * k) as f64 });
        };
        for i in 0..k {
            for j in 0..k - i {
                push(3 * i + 1, 3 * j + 1);
                if i + j + 1 < k {
                    push(3 * i + 2, 3 * j + 2);
                }
            }
        }
    }
    samples
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use glam::DVec3;

    #[test]
    fn samples_stand_for_the_whole_area_and_balance() {
        let ball = icosphere(2);
        for count in [1, 2000, 40_000] {
            let found = samples(&ball, |_| true, count, 1);
            let area: f64 = found.iter().map(|s| s.area).sum();
            assert!((area - ball.area()).abs() < 1e-9);
            let middle: DVec3 = found.iter().map(|s| s.point.position(&ball) * s.area).sum();
            assert!(middle.length() < 1e-9, "{middle}");
            assert!(found.iter().all(|s| s.point.barycentric.iter().all(|w| *w > 0.0)));
        }
        assert!(samples(&ball, |_| true, 40_000, 1).len() > 30_000);
        // Of fine meshes one point of each face is enough.
        let faces = ball.face_count();
        let counts = [faces - 1, faces, 2 * faces].map(|count| samples(&ball, |_| true, count, 2).len());
        assert_eq!(counts, [faces, faces, 4 * faces]);
    }
}
