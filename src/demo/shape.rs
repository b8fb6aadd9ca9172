//! A shape with named points on it.

use super::body::Body;
use super::implicit::{RoundCone, SmoothUnion};
use super::polygonise::polygonise;
use super::skin::{Cells, skin};
use crate::mesh::SurfaceMesh;
use glam::DVec3;

/// A shape with named points on it.
pub struct Shape {
    /// The mesh.
    pub mesh: SurfaceMesh,
    /// Names and places.
    pub points: Vec<(&'static str, DVec3)>,
}

/// Cones with named points on them.
pub(super) struct Skeleton {
    pub cones: Vec<RoundCone>,
    /// Names and places.
    pub points: Vec<(&'static str, DVec3)>,
}

impl Skeleton {
    /// The shape whose cones are blended over a distance, meshed in cells of the given size.
    pub fn fleshed(self, blend: f64, cell: f64) -> Shape {
        let union = SmoothUnion { cones: self.cones, blend };
        let mesh = polygonise(|p| union.value(p), union.bounds(), cell);
        Shape { mesh, points: self.points }
    }
}

/// A named point of a body's surface: where a ray from inside leaves it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    pub name: &'static str,
    inside: DVec3,
    direction: DVec3,
}

impl Mark {
    /// The point where the surface is seen from `inside` in a direction.
    pub fn new(name: &'static str, inside: DVec3, direction: DVec3) -> Self {
        Self { name, inside, direction: direction.normalize() }
    }

    /// The point where the ray leaves the body first.
    pub fn place(&self, body: &Body) -> DVec3 {
        let mut length = 0.0;
        for _ in 0..200 {
            let depth = -body.value(self.inside + self.direction * length);
            if depth < 1e-4 {
                break;
            }
            length += 0.5 * depth;
        }
        self.inside + self.direction * length
    }
}

/// A body with the marks that become its landmarks.
pub(super) struct MarkedBody {
    pub body: Body,
    pub marks: Vec<Mark>,
}

/// A body's skin with its marks.
pub(super) fn skinned(MarkedBody { body, marks }: &MarkedBody, cells: &Cells) -> Shape {
    let points = marks.iter().map(|mark| (mark.name, mark.place(body))).collect();
    Shape { mesh: skin(body, cells), points }
}
