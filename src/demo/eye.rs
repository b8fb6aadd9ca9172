//! Eyes on a body's skin.

use super::body::{Body, Ellipsoid, Part, Solid};
use glam::DVec3;

/// The socket and the ball of an eye at a place of the skin.
pub(super) fn eye(body: &Body, place: DVec3, radius: f64) -> [Part; 2] {
    let out = body.normal(place);
    let ball = |depth: f64, share: f64| {
        let centre = place + out * (depth * radius);
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        Solid::Ellipsoid(Ellipsoid { centre, axes, radii: DVec3::splat(share * radius) })
    };
    let edge = 0.42 * radius;
    // The ball begins behind the bottom of the socket: it is never loose in it.
    let socket = Part::cut(vec![ball(0.55, 1.35)], 0.5 * radius, edge);
    [socket, Part::join(vec![ball(-0.42, 1.0)], 0.06 * radius, edge)]
}
