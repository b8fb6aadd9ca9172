//! Circles around the vertices of a mesh, drawn on its faces.

use super::buffers::SurfaceVertex;
use glam::{DVec2, DVec3, Vec3};

/// Corners of a mesh's triangles, three each, that know the circles around all three: the texture coordinates are places in the plane
/// of the triangle, and the image holds three linear functions there, which with the square of the place are its powers with respect to the
/// circles: negative inside, 0 on the circle.
///
/// `vertices` are the mesh's, `places` theirs on the scale of colours, and `radii` those of their circles, in units of the root of the
/// mesh's area.
pub fn circled(
    vertices: &[SurfaceVertex],
    triangles: &[[u32; 3]],
    places: &[f32],
    radii: &[f32],
) -> Vec<SurfaceVertex> {
    let position = |v: u32| Vec3::from_array(vertices[v as usize].position).as_dvec3();
    let doubled = |t: &[u32; 3]| {
        let [a, b, c] = t.map(position);
        (b - a).cross(c - a).length()
    };
    let unit = (0.5 * triangles.iter().map(doubled).sum::<f64>()).sqrt();
    let corners = |t: &[u32; 3]| {
        let flat = flattened(t.map(position));
        let squares = t.map(|v| (unit * f64::from(radii[v as usize])).powi(2));
        [0, 1, 2].map(|k| {
            let linear = |j: usize| flat[j].length_squared() - squares[j] - 2.0 * flat[k].dot(flat[j]);
            let v = t[k] as usize;
            SurfaceVertex {
                uv: flat[k].as_vec2().to_array(),
                image: [0, 1, 2].map(|j| linear(j) as f32),
                scale_place: places[v],
                ..vertices[v]
            }
        })
    };
    triangles.iter().flat_map(corners).collect()
}

/// A triangle in its own plane, around its centre.
fn flattened(corners: [DVec3; 3]) -> [DVec2; 3] {
    let [a, b, c] = corners;
    let centre = (a + b + c) / 3.0;
    let along = (b - a).normalize_or(DVec3::X);
    let across = (b - a).cross(c - a).cross(along).normalize_or(along.any_orthonormal_vector());
    corners.map(|p| DVec2::new((p - centre).dot(along), (p - centre).dot(across)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::scene::Shading;
    use crate::scene::buffers::{Frame, Triangles, surface};

    #[test]
    fn powers_tell_the_distance_to_every_corner() {
        let ball = icosphere(2);
        let Triangles { vertices, .. } = surface(&ball, &Shading::of(&ball), &Frame::of(&ball));
        let triangles: Vec<[u32; 3]> = ball.triangles().iter().map(|t| t.map(|v| v.0)).collect();
        let radii: Vec<f32> = (0..vertices.len()).map(|v| 0.02 + 0.001 * (v % 7) as f32).collect();
        let places: Vec<f32> = (0..vertices.len()).map(|v| v as f32 / 200.0).collect();
        let corners = circled(&vertices, &triangles, &places, &radii);
        assert_eq!(corners.len(), 3 * triangles.len());
        // The unit is nearly that of the unit sphere.
        let unit = (4.0 * std::f64::consts::PI).sqrt();
        for (t, face) in triangles.iter().zip(corners.as_chunks::<3>().0) {
            for weights in [[0.2, 0.3, 0.5], [0.9, 0.05, 0.05], [0.0, 0.5, 0.5]] {
                let blend =
                    |value: &dyn Fn(usize) -> DVec3| (0..3).map(|k| value(k) * weights[k]).sum::<DVec3>();
                let place = blend(&|k| Vec3::from_array(face[k].position).as_dvec3());
                let flat = blend(&|k| DVec2::from(face[k].uv.map(f64::from)).extend(0.0));
                let linear = blend(&|k| Vec3::from_array(face[k].image).as_dvec3());
                for j in 0..3 {
                    let corner = Vec3::from_array(face[j].position).as_dvec3();
                    let power =
                        place.distance_squared(corner) - (unit * f64::from(radii[t[j] as usize])).powi(2);
                    assert!((flat.length_squared() + linear[j] - power).abs() < 2e-4, "{t:?} {j}");
                }
            }
            assert_eq!(face[1].scale_place, places[t[1] as usize]);
        }
    }

    #[test]
    fn a_triangle_without_area_has_numbers() {
        let corner = |x: f32| SurfaceVertex { position: [x, 0.0, 0.0], ..SurfaceVertex::default() };
        let vertices = [corner(0.0), corner(1.0), corner(1.0)];
        let corners = circled(&vertices, &[[0, 1, 2], [1, 2, 1]], &[0.5; 3], &[0.1; 3]);
        assert!(corners.iter().all(|c| c.uv.iter().chain(&c.image).all(|x| x.is_finite())));
    }
}
