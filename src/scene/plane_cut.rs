//! The cut of a surface by a plane, as a line to be drawn.

use super::buffers::{Frame, Triangles, ribbons};
use super::colours::linear;
use super::defects::{MarkedLineVertex, marked};
use crate::math::mirror_plane::MirrorPlane;
use crate::mesh::SurfaceMesh;
use glam::{DVec3, Vec3};

/// A grey that is seen on clay and on patterns, and is not taken for an edge of the map.
const GREY: u32 = 0x3d_4654;

/// The number of the fine stroke, after those of defects: the line steps aside for what is marked.
const FINE: f32 = 5.0;

/// The segments in which a plane cuts the faces.
pub fn cut(mesh: &SurfaceMesh, plane: MirrorPlane) -> Vec<[DVec3; 2]> {
    // A corner in the plane counts as above it, so that every face has none or two sides that cross.
    let crossing = |[p, q]: [DVec3; 2]| {
        let [above, below] = [plane.height(p), plane.height(q)];
        ((above >= 0.0) != (below >= 0.0)).then(|| p.lerp(q, above / (above - below)))
    };
    let segment = |[a, b, c]: [DVec3; 3]| {
        let mut found = [[a, b], [b, c], [c, a]].into_iter().filter_map(crossing);
        Some([found.next()?, found.next()?])
    };
    mesh.faces().filter_map(|face| segment(mesh.corners(face))).collect()
}

/// The line of a plane on a surface as fine ribbons.
pub fn drawn(mesh: &SurfaceMesh, frame: &Frame, plane: MirrorPlane) -> Triangles<MarkedLineVertex> {
    let strips: Vec<Vec<Vec3>> =
        cut(mesh, plane).iter().map(|ends| ends.map(|p| frame.place(p)).to_vec()).collect();
    marked(ribbons(&strips), linear(GREY), FINE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::{icosphere, torus};

    #[test]
    fn the_cut_of_a_ball_is_one_circle_and_of_a_ring_two() {
        let across = |n: DVec3| MirrorPlane::across(n, DVec3::ZERO).unwrap();
        for plane in [across(DVec3::X), across(DVec3::new(1.0, 2.0, -0.5))] {
            let segments = cut(&icosphere(4), plane);
            let length: f64 = segments.iter().map(|[p, q]| p.distance(*q)).sum();
            assert!((length / std::f64::consts::TAU - 1.0).abs() < 0.01, "{length}");
            for p in segments.as_flattened() {
                assert!(plane.height(*p).abs() < 1e-12 && (p.length() - 1.0).abs() < 0.01);
            }
        }
        // Every end but those of segments without length is the end of two.
        let ring = torus(24, 12);
        let segments = cut(&ring, across(DVec3::new(1.0, 0.3, 0.1)));
        let ends: Vec<DVec3> = segments.iter().filter(|[p, q]| p != q).flatten().copied().collect();
        for p in &ends {
            assert!(ends.iter().filter(|q| q.distance(*p) < 1e-9).count().is_multiple_of(2));
        }
        assert_eq!(drawn(&ring, &Frame::of(&ring), across(DVec3::X)).indices.len() % 6, 0);
    }

    #[test]
    fn a_plane_beside_a_surface_cuts_nothing() {
        let beside = MirrorPlane::across(DVec3::X, DVec3::splat(2.0)).unwrap();
        assert!(cut(&icosphere(2), beside).is_empty());
    }
}
