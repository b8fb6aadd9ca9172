//! Triangles of a parametrisation with their rest shapes, and the Jacobians between both.

use super::embedding::Parametrised;
use crate::math::rigid2::Rigid2;
use crate::math::scalar::max;
use crate::math::triangle;
use crate::mesh::FaceId;
use glam::{DMat2, DVec2, DVec3};

/// The rest shape of a face, with its weight.
#[derive(Clone, Copy, Debug)]
pub struct RestTriangle {
    /// Corners in space.
    pub corners: [DVec3; 3],
    /// Its weight in the energy, an area: that of the triangle or more.
    pub weight: f64,
}

impl RestTriangle {
    /// The rest triangle with its area as weight; at least 1e-30, so that no weight is 0.
    pub fn of(corners: [DVec3; 3]) -> Self {
        Self { corners, weight: triangle::area(corners[0], corners[1], corners[2]).max(1e-30) }
    }
}

/// The corner of a triangle: a free vertex seen through a rigid motion, or a fixed point.
#[derive(Clone, Copy, Debug)]
pub enum Corner {
    /// The image of free vertex `.0` under motion `.1`.
    Free(u32, Rigid2),
    /// A fixed point: that of a cone.
    Fixed(DVec2),
}

impl Corner {
    /// The place of the corner when the free vertices are at `z`.
    #[inline]
    pub fn position(&self, z: &[DVec2]) -> DVec2 {
        match self {
            Self::Free(v, motion) => motion.apply(z[*v as usize]),
            Self::Fixed(p) => *p,
        }
    }
}

/// One triangle with its rest shape.
#[derive(Clone, Copy, Debug)]
pub struct FlatTriangle {
    /// Corners, counter-clockwise, in the plane of the triangle's chart.
    pub corners: [Corner; 3],
    /// Rest area.
    pub area: f64,
    /// Gradients of the corners' hat functions in the rest plane.
    pub hats: [DVec2; 3],
}

impl FlatTriangle {
    /// The triangle with rest positions in space.
    ///
    /// A rest triangle thinner than 1e-10 of its longest edge is widened, so that its energy stays finite.
    pub fn with_rest(corners: [Corner; 3], rest: [DVec3; 3]) -> Self {
        let lengths = [0, 1, 2].map(|k| rest[k].distance(rest[(k + 1) % 3]));
        let mut flat = triangle::lay_out(lengths);
        // The square of 1e-150 is still above the least double.
        let longest = max(max(max(lengths[0], lengths[1]), lengths[2]), 1e-150);
        if lengths[0] < 1e-10 * longest {
            flat = [DVec2::ZERO, DVec2::new(1e-10 * longest, 0.0), DVec2::new(0.0, longest)];
        } else if flat[2].y < 1e-10 * longest {
            flat[2].y = 1e-10 * longest;
        }
        let area = 0.5 * triangle::signed_double_area(flat[0], flat[1], flat[2]);
        Self { corners, area, hats: triangle::hat_gradients(flat) }
    }

    /// The Jacobian when corner 0 is at `z` and the other corners are fixed.
    pub fn jacobian_at(&self, z: DVec2) -> DMat2 {
        self.jacobian(&self.positions(&[z]))
    }

    /// The corners when the free vertices are at `z`.
    #[inline]
    pub(super) fn positions(&self, z: &[DVec2]) -> [DVec2; 3] {
        self.corners.map(|corner| corner.position(z))
    }

    /// The displacements of the corners when the free vertices move by `dz`.
    #[inline]
    pub(super) fn displacements(&self, dz: &[DVec2]) -> [DVec2; 3] {
        self.corners.map(|corner| match corner {
            Corner::Free(v, motion) => motion.rotate(dz[v as usize]),
            Corner::Fixed(_) => DVec2::ZERO,
        })
    }

    /// The Jacobian from the rest plane to the chart.
    #[inline]
    pub(super) fn jacobian(&self, p: &[DVec2; 3]) -> DMat2 {
        triangle::jacobian(p, &self.hats)
    }
}

/// The Jacobian of a parametrisation on one face, from the plane of its rest triangle to its chart.
pub fn rest_jacobian(side: Parametrised<'_>, f: FaceId) -> DMat2 {
    let corners = side.embedding.triangle(f);
    FlatTriangle::with_rest(corners.map(Corner::Fixed), side.mesh.corners(f)).jacobian(&corners)
}
