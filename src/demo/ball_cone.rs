//! A ball and a rounded cone (thesis fig. 4.5). Each ring of landmarks cuts off the same share of the area of both.

use super::body::{Body, Part, Solid};
use super::rounded_cone::RoundedCone;
use super::shape::{Mark, MarkedBody, Shape, skinned};
use super::skin::Cells;
use crate::math::scalar::{cos, sin};
use crate::mesh::generators::icosphere;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// The base radius of the cone before it is rounded.
const RADIUS: f64 = 0.8;
/// The height of the cone before it is rounded.
const HEIGHT: f64 = 1.7;
/// Radius of its apex and its rim.
const ROUND: f64 = 0.1;
/// A place inside the cone: a landmark lies where a ray from here leaves the surface.
const INSIDE: DVec3 = DVec3::new(0.0, 0.35, 0.0);

/// The landmarks between the apex and the middle of the base: each ring's share of the way down the slant, and its names.
const RINGS: [(f64, [&str; 5]); 3] = [
    (0.40, ["upper side 1", "upper side 2", "upper side 3", "upper side 4", "upper side 5"]),
    (0.70, ["lower side 1", "lower side 2", "lower side 3", "lower side 4", "lower side 5"]),
    (1.00, ["rim 1", "rim 2", "rim 3", "rim 4", "rim 5"]),
];

/// A ball whose triangles come from repeated subdivision.
pub(super) fn ball() -> Shape {
    let mut points = vec![("apex", DVec3::Y)];
    for (k, (share, names)) in RINGS.into_iter().enumerate() {
        let height = 1.0 - 2.0 * area_share(share);
        let radius = (1.0 - height * height).sqrt();
        points.extend(names.into_iter().zip(ring(k, radius, height)));
    }
    points.push(("base", DVec3::NEG_Y));
    Shape { mesh: icosphere(5), points }
}

/// The cone, standing on its base.
pub(super) fn cone() -> Shape {
    let solid = Solid::Cone(RoundedCone::new(RADIUS, HEIGHT, ROUND));
    let body = Body::new(vec![Part::join(vec![solid], 0.01, EDGE)]);
    let mark = |(name, to): (&'static str, DVec3)| Mark::new(name, INSIDE, to - INSIDE);
    let mut places = vec![("apex", DVec3::Y * HEIGHT)];
    for (k, (share, names)) in RINGS.into_iter().enumerate() {
        places.extend(names.into_iter().zip(ring(k, RADIUS * share, HEIGHT * (1.0 - share))));
    }
    places.push(("base", DVec3::ZERO));
    skinned(&MarkedBody { body, marks: places.into_iter().map(mark).collect() }, &CELLS)
}

/// The length of the edges that is wanted on the cone.
const EDGE: f64 = 0.0266;
/// The cells in which the cone is meshed.
const CELLS: Cells = Cells { size: 0.032, offset: DVec3::splat(0.4), coarseness: 1.0 };

/// Five points around the y axis; every other ring is turned by half a step.
fn ring(number: usize, radius: f64, height: f64) -> [DVec3; 5] {
    [0.0, 1.0, 2.0, 3.0, 4.0].map(|k| {
        let angle = TAU * (k + 0.5 * (number % 2) as f64) / 5.0;
        DVec3::new(radius * cos(angle), height, radius * sin(angle))
    })
}

/// The share of the sharp cone's area from the apex to a share of the way down its slant.
fn area_share(way: f64) -> f64 {
    let slant = DVec2::new(RADIUS, HEIGHT).length();
    way * way * slant / (slant + RADIUS)
}
