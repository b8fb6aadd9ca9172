//! Bodies of limbs: round tubes along joints that are blended into each other, for a shape of a kind that no demo has.

use super::body::{Body, Part};
use super::skin::{Cells, FELT, skin};
use super::tube::{Node, tube};
use crate::math::scalar::min;
use crate::mesh::SurfaceMesh;
use glam::DVec3;

/// The distance over which a thin limb is blended with the others, at most, in units of its least radius.
const LEAST_BLEND: f64 = 0.8;
/// The length of the edges on a thin limb, at most, in units of its least radius.
const EDGE: f64 = 1.5;
/// The size of the cells in which a body is meshed, in units of the length of its edges.
const CELL: f64 = 0.6;

/// A joint of a limb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// Its place.
    pub place: DVec3,
    /// The radius of the limb there.
    pub radius: f64,
}

/// The closed skin of limbs, each a chain of at least two joints at different places; those that touch are blended over the distance `blend`.
/// Edges have about the length `edge`, and less on thin limbs. Limbs that meet twice, as in a ring, give a skin with a handle; what does not
/// touch the largest part is left out.
///
/// # Panics
/// Without a limb.
pub fn skin_of_limbs(limbs: &[Vec<Joint>], blend: f64, edge: f64) -> SurfaceMesh {
    assert!(!limbs.is_empty(), "a body has at least one limb");
    let cell = CELL * edge;
    let part = |limb: &Vec<Joint>| {
        let nodes: Vec<Node> = limb.iter().map(|joint| Node::round(joint.place, joint.radius)).collect();
        let least = limb.iter().map(|joint| joint.radius).fold(f64::INFINITY, min);
        Part::join(tube(&nodes), min(blend, LEAST_BLEND * least), min(edge, EDGE * least))
            .reaching(FELT * cell)
    };
    let body = Body::new(limbs.iter().map(part).collect());
    skin(&body, &Cells { size: cell, offset: DVec3::ZERO, coarseness: 1.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of joints of one radius.
    fn limb(places: &[[f64; 3]], radius: f64) -> Vec<Joint> {
        places.iter().map(|&place| Joint { place: place.into(), radius }).collect()
    }

    #[test]
    fn limbs_that_touch_have_one_skin_which_reaches_to_their_ends() {
        let limbs = [
            limb(&[[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]], 0.2),
            limb(&[[0.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.7, 0.3]], 0.06),
        ];
        let mesh = skin_of_limbs(&limbs, 0.05, 0.05);
        assert_eq!(mesh.euler_characteristic(), 2);
        let reach = |axis: DVec3| mesh.positions().iter().map(|p| p.dot(axis)).fold(f64::MIN, f64::max);
        for (axis, wanted) in [(DVec3::X, 0.7), (-DVec3::X, 0.7), (DVec3::Z, 0.36), (-DVec3::Y, 0.2)] {
            assert!((reach(axis) - wanted).abs() < 0.02, "{axis}: {}", reach(axis));
        }
        // A ring has a handle.
        let ring: Vec<[f64; 3]> = (0..=8)
            .map(|k| 0.25 * std::f64::consts::PI * f64::from(k))
            .map(|a| [crate::math::scalar::cos(a), crate::math::scalar::sin(a), 0.0])
            .collect();
        assert_eq!(skin_of_limbs(&[limb(&ring, 0.2)], 0.05, 0.08).euler_characteristic(), 0);
    }
}
