//! Energies of single vertices as functions of their images' places. A further energy is a further file that implements [`VertexEnergy`],
//! tested by `testing`.

use glam::{DMat2, DVec2, DVec3};

/// The energy of a vertex as a function of its image's place.
pub trait VertexEnergy {
    /// The energy of a vertex whose image has these barycentric coordinates in a triangle with these corners in space; `hats` are
    /// the gradients of the coordinates in the plane in which the vertex moves.
    fn term(&self, corners: [DVec3; 3], barycentric: [f64; 3], hats: [DVec2; 3]) -> VertexTerm;
}

/// The energy of one vertex with its derivatives by the vertex' place in a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexTerm {
    /// Its value.
    pub energy: f64,
    /// Its gradient.
    pub gradient: DVec2,
    /// A positive semidefinite matrix no less than its Hessian.
    pub hessian: DMat2,
}

#[cfg(test)]
pub(super) mod testing {
    //! The same difference quotients for every energy of vertices.

    use super::*;
    use crate::math::golden;

    /// Asserts at several places of a triangle that the gradient is the energy's difference quotient, and that the Hessian
    /// dominates the gradient's, or agrees with it where `is_exact`.
    pub fn assert_derivatives(
        energy: &impl VertexEnergy,
        corners: [DVec3; 3],
        hats: [DVec2; 3],
        is_exact: bool,
    ) {
        for place in [[0.2, 0.3], [0.1, 0.1], [0.6, 0.3]].map(DVec2::from) {
            let at = |shift: DVec2| {
                let weights = hats.map(|hat| hat.dot(shift));
                let [x, y] = place.to_array();
                let start = [1.0 - x - y, x, y];
                energy.term(corners, [0, 1, 2].map(|k| start[k] + weights[k]), hats)
            };
            let VertexTerm { gradient, hessian, .. } = at(DVec2::ZERO);
            for k in 0..12 {
                let direction = golden::direction(k);
                let h = 1e-6;
                let [plus, minus] = [h, -h].map(|h| at(direction * h));
                let quotient = (plus.energy - minus.energy) / (2.0 * h);
                let slope = gradient.dot(direction);
                assert!((quotient - slope).abs() < 1e-7 * slope.abs().max(1.0), "{quotient} {slope}");
                let truth = (plus.gradient - minus.gradient).dot(direction) / (2.0 * h);
                let model = direction.dot(hessian * direction);
                let rounding = 1e-6 * truth.abs().max(1.0);
                assert!(model > truth - rounding, "{model} {truth}");
                assert!(!is_exact || (model - truth).abs() < 10.0 * rounding, "{model} {truth}");
            }
        }
    }
}
