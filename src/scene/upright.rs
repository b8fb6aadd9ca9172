//! A guess from the shape which way is up: the side on which it stands safely, and not on the opposite one.
//!
//! After Fu, Cohen-Or, Dror and Sheffer, "Upright orientation of man-made objects" (2008), the base on which a body stands is
//! the convex hull of its lowest points. Here only the six axes are candidates. Four feet span a wide base and a back a narrow
//! one, while left and right sides are alike. A guess is to be offered, not to be applied: a ball and a leaf have no upright.

use super::up_axis::UpAxis;
use crate::math::triangle::signed_double_area;
use crate::mesh::SurfaceMesh;
use glam::{DVec2, DVec3};

/// The part of the extent in which points count as lowest: as thick as feet. Chosen by hand.
const SLICE: f64 = 0.06;

/// The share of the body's box, seen from above, by which the base must be wider than the opposite end. Chosen by hand.
const CLEAR: f64 = 0.12;

/// The factor by which the difference must be larger than along another axis. Chosen by hand.
const CLEARER: f64 = 1.3;

/// The axis that seems to point up; `None` where the shape does not tell.
pub fn proposed_up(mesh: &SurfaceMesh) -> Option<UpAxis> {
    let centre = mesh.centre().unwrap_or_default();
    let wider = |axis: UpAxis| base(mesh, axis, centre) - base(mesh, axis.reversed(), centre);
    let mut axes: Vec<(UpAxis, f64)> = [UpAxis::X, UpAxis::Y, UpAxis::Z]
        .map(|axis| (axis, wider(axis)))
        .map(|(axis, by)| if by < 0.0 { (axis.reversed(), -by) } else { (axis, by) })
        .to_vec();
    axes.sort_by(|a, b| b.1.total_cmp(&a.1));
    (axes[0].1 > CLEAR && axes[0].1 > CLEARER * axes[1].1).then(|| axes[0].0)
}

/// The width of the base when this axis points up: the area of the hull of the lowest points as a share of the box around all points, both
/// seen from above; 0 where the centre is not above the base, so that the body would fall.
fn base(mesh: &SurfaceMesh, up: UpAxis, centre: DVec3) -> f64 {
    let up = up.direction().as_dvec3();
    let (across, along) = up.any_orthonormal_pair();
    let from_above = |p: DVec3| DVec2::new(p.dot(across), p.dot(along));
    let heights = || mesh.positions().iter().map(|p| p.dot(up));
    let low = heights().fold(f64::INFINITY, f64::min);
    let high = heights().fold(f64::NEG_INFINITY, f64::max);
    let limit = low + SLICE * (high - low);
    let lowest = mesh.positions().iter().filter(|p| p.dot(up) <= limit).map(|p| from_above(*p)).collect();
    let hull = convex_hull(lowest);
    let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let points = mesh.positions().iter().map(|p| from_above(*p));
    let (least, most) = points.fold(start, |(l, m), p| (l.min(p), m.max(p)));
    let size = (most - least).x * (most - least).y;
    let area = 0.5 * sides(&hull).map(|[a, b]| a.perp_dot(b)).sum::<f64>();
    let stands = sides(&hull).all(|[a, b]| signed_double_area(a, b, from_above(centre)) >= 0.0);
    if stands && size > 0.0 { area / size } else { 0.0 }
}

fn sides(ring: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> {
    (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]])
}

/// The corners of the convex hull, counter-clockwise (Andrew's monotone chain).
fn convex_hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let mut hull = half_hull(points.iter().copied());
    hull.extend(half_hull(points.iter().rev().copied()));
    hull
}

/// One chain of the hull without its last point.
fn half_hull(points: impl Iterator<Item = DVec2>) -> Vec<DVec2> {
    let mut chain: Vec<DVec2> = Vec::new();
    for p in points {
        while let [.., a, b] = chain[..]
            && (b - a).perp_dot(p - b) <= 0.0
        {
            chain.pop();
        }
        chain.push(p);
    }
    chain.pop();
    chain
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo;
    use crate::mesh::generators::icosphere;

    #[test]
    fn animals_of_the_demos_stand_on_their_feet_however_they_lie() {
        for id in ["horse-camel", "wolf-cow", "horse-cat"] {
            let built = demo::build(id).unwrap();
            for mesh in [built.source, built.target] {
                for up in UpAxis::ALL {
                    let turn = up.basis().as_dquat();
                    let turned = mesh.positions().iter().map(|p| turn * *p).collect();
                    assert_eq!(proposed_up(&mesh.with_positions(turned)), Some(up), "{id}");
                }
            }
        }
    }

    #[test]
    fn a_ball_has_no_upright() {
        assert_eq!(proposed_up(&icosphere(3)), None);
    }

    #[test]
    fn a_cone_stands_on_its_base() {
        let ball = icosphere(4);
        let cone = |p: &DVec3| DVec3::new(p.x * (1.0 - p.z), p.y * (1.0 - p.z), p.z.max(-0.7));
        let mesh = ball.with_positions(ball.positions().iter().map(cone).collect());
        assert_eq!(proposed_up(&mesh), Some(UpAxis::Z));
    }

    #[test]
    fn the_hull_of_a_square_with_points_inside_is_the_square() {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from_array);
        let mut points = corners.to_vec();
        points.extend([[0.5, 0.5], [0.5, 0.0], [0.2, 0.9], [1.0, 1.0]].map(DVec2::from_array));
        assert_eq!(convex_hull(points), corners);
    }
}
