//! The star of one vertex laid out in a plane, and a place of low energy for the vertex in it.

use super::kernel::Kernel;
use super::rest_triangle::FlatTriangle;
use crate::math::matrix2::outer;
use crate::math::rigid2::Rigid2;
use crate::math::scalar::max;
use crate::math::triangle::{signed_double_area, turn};
use crate::mesh::HalfedgeId;
use crate::surface_map::energy::density::Density;
use crate::surface_map::energy::symmetric_dirichlet::SymmetricDirichlet;
use glam::{DMat2, DVec2};
use std::f64::consts::TAU;

/// The star of a vertex, laid out in the plane of its first face.
#[derive(Clone, Default)]
pub struct Star {
    pub halfedges: Vec<HalfedgeId>,
    /// From the plane of the first face to that of each.
    pub motions: Vec<Rigid2>,
    /// Heads of the halfedges.
    pub ring: Vec<DVec2>,
    pub triangles: Vec<FlatTriangle>,
    pub kernel: Kernel,
}

impl Star {
    /// The place after three Newton steps from `start` on the star's symmetric Dirichlet energy.
    pub fn improved(&self, start: DVec2) -> DVec2 {
        let energy_at = |z: DVec2| {
            let energies =
                self.triangles.iter().map(|t| t.area * SymmetricDirichlet.density(&t.jacobian_at(z)));
            energies.fold(0.0, |sum, energy| sum + energy)
        };
        let (mut z, mut least) = (start, energy_at(start));
        if least == f64::INFINITY {
            return start;
        }
        // The level is relaxed as a whole later, so three steps with up to eleven halvings each are enough. Chosen by hand.
        for _ in 0..3 {
            let (slope, curvature) = self.derivatives(z);
            let mut step = -(curvature.inverse() * slope);
            for _ in 0..12 {
                let next = energy_at(z + step);
                if next < least {
                    z += step;
                    least = next;
                    break;
                }
                step *= 0.5;
            }
        }
        z
    }

    /// The largest energy density of the triangles with the vertex at z; infinite where one is not positive.
    pub fn worst(&self, z: DVec2) -> f64 {
        self.triangles.iter().map(|t| SymmetricDirichlet.density(&t.jacobian_at(z))).fold(0.0, max)
    }

    fn derivatives(&self, z: DVec2) -> (DVec2, DMat2) {
        let (mut slope, mut curvature) = (DVec2::ZERO, DMat2::ZERO);
        for t in &self.triangles {
            let j = t.jacobian_at(z);
            slope += SymmetricDirichlet.gradient(&j) * t.hats[0] * t.area;
            for term in SymmetricDirichlet.hessian(&j) {
                let pull = term.apply(t.hats[0]);
                curvature += outer(pull) * (term.weight * t.area);
            }
        }
        (slope, curvature)
    }

    /// Whether the triangles of the star are positive and turn around z once.
    pub fn turns_once(&self, z: DVec2) -> bool {
        let mut turn = 0.0;
        for k in 0..self.ring.len() {
            let (p, q) = (self.ring[k], self.ring[(k + 1) % self.ring.len()]);
            if signed_double_area(z, p, q) <= 0.0 {
                return false;
            }
            turn += turn_at(z, p, q);
        }
        // A star that turns otherwise is off by 2 pi; the bound only has to be above rounding.
        (turn - TAU).abs() < 1e-6
    }
}

/// The angle at `apex` from p to q, in radians, positive counter-clockwise.
pub fn turn_at(apex: DVec2, p: DVec2, q: DVec2) -> f64 {
    turn(p - apex, q - apex)
}
