//! Four-legged bodies made from one skeleton with different proportions. The nose points to +x, the left side to +z, up is +y.

use super::implicit::RoundCone;
use super::shape::{Shape, Skeleton};
use glam::{DVec2, DVec3};

/// The proportions of an animal. All lengths are in the demo's own unit, in which the body is about 2 long.
struct Build {
    /// Height of the body's axis above the ground.
    height: f64,
    /// Half the body's length.
    half_length: f64,
    /// Radii of the body at the chest and at the rump.
    body: [f64; 2],
    /// Sideways distance of the legs from the middle.
    stance: f64,
    /// Radii of a leg at its top, knee and foot.
    leg: [f64; 3],
    /// The neck, from the chest to the skull.
    neck: Taper,
    /// The head, from the skull to the nose.
    head: Taper,
    /// Length and radius of the ears.
    ear: [f64; 2],
    tail: Tail,
    /// Shift of the hind knees backwards.
    hock: f64,
    /// The distance over which the parts are blended.
    blend: f64,
    /// The size of the grid's cells in which the animal is meshed.
    cell: f64,
}

/// A part that tapers.
struct Taper {
    /// The place of its end relative to its beginning.
    reach: DVec2,
    /// Radii at both ends.
    radii: [f64; 2],
}

struct Tail {
    /// Its middle and its tip relative to the rump.
    points: [DVec2; 2],
    /// Radius in the middle.
    radius: f64,
}

pub(super) fn horse() -> Shape {
    build(&Build {
        height: 1.35,
        half_length: 0.72,
        body: [0.40, 0.38],
        stance: 0.22,
        leg: [0.19, 0.095, 0.085],
        neck: Taper { reach: DVec2::new(0.55, 0.72), radii: [0.27, 0.17] },
        head: Taper { reach: DVec2::new(0.46, -0.30), radii: [0.19, 0.11] },
        ear: [0.24, 0.055],
        tail: Tail { points: [DVec2::new(-0.32, -0.12), DVec2::new(-0.46, -0.72)], radius: 0.085 },
        hock: 0.12,
        blend: 0.16,
        cell: 0.066,
    })
}

pub(super) fn cat() -> Shape {
    build(&Build {
        height: 0.88,
        half_length: 0.78,
        body: [0.33, 0.35],
        stance: 0.20,
        leg: [0.17, 0.105, 0.10],
        neck: Taper { reach: DVec2::new(0.26, 0.30), radii: [0.25, 0.22] },
        head: Taper { reach: DVec2::new(0.22, -0.06), radii: [0.29, 0.17] },
        ear: [0.22, 0.08],
        tail: Tail { points: [DVec2::new(-0.50, 0.28), DVec2::new(-0.62, 0.98)], radius: 0.085 },
        hock: 0.16,
        blend: 0.13,
        cell: 0.062,
    })
}

fn build(b: &Build) -> Shape {
    let flat = |p: DVec2| p.extend(0.0);
    let (chest, rump) = (DVec3::new(b.half_length, b.height, 0.0), DVec3::new(-b.half_length, b.height, 0.0));
    let skull = chest + flat(b.neck.reach);
    let nose = skull + flat(b.head.reach);
    let tail = b.tail.points.map(|p| rump + flat(p));
    let root = rump + DVec3::new(-0.12, 0.12, 0.0);
    let cones = vec![
        RoundCone::new(chest, rump, b.body),
        RoundCone::new(chest + DVec3::new(0.05, 0.1, 0.0), skull, b.neck.radii),
        RoundCone::new(skull, nose, b.head.radii),
        RoundCone::new(root, tail[0], [b.tail.radius * 1.15, b.tail.radius]),
        RoundCone::new(tail[0], tail[1], [b.tail.radius, b.tail.radius * 0.8]),
    ];
    let points = vec![
        ("nose", nose + flat(b.head.reach.normalize()) * b.head.radii[1]),
        ("tail tip", tail[1] + (tail[1] - tail[0]).normalize() * b.tail.radius),
        ("withers", chest + DVec3::new(-0.15, b.body[0], 0.0)),
        ("croup", rump + DVec3::new(0.1, b.body[1], 0.0)),
        ("chest", chest + DVec3::new(b.body[0], -0.05, 0.0)),
        ("belly", DVec3::new(0.0, b.height - 0.5 * (b.body[0] + b.body[1]), 0.0)),
        ("throat", skull.midpoint(chest) + DVec3::new(0.22, -0.22, 0.0)),
    ];
    let mut skeleton = Skeleton { cones, points };
    for (side, names) in [(1.0, LEFT), (-1.0, RIGHT)] {
        add_limbs(b, side, skull, &mut skeleton, names);
    }
    skeleton.fleshed(b.blend, b.cell)
}

const LEFT: [&str; 6] =
    ["left ear", "left fore foot", "left hind foot", "left fore knee", "left hind knee", "left flank"];
const RIGHT: [&str; 6] =
    ["right ear", "right fore foot", "right hind foot", "right fore knee", "right hind knee", "right flank"];

fn add_limbs(
    b: &Build,
    side: f64,
    skull: DVec3,
    Skeleton { cones, points }: &mut Skeleton,
    names: [&'static str; 6],
) {
    let outwards = DVec3::Z * side;
    let ear = skull + DVec3::new(-0.02, b.head.radii[0] * 0.75, side * b.head.radii[0] * 0.62);
    let ear_tip = ear + DVec3::new(-0.05, b.ear[0], side * b.ear[0] * 0.3);
    cones.push(RoundCone::new(ear, ear_tip, [b.ear[1] * 1.3, b.ear[1] * 0.6]));
    points.push((names[0], ear_tip + DVec3::Y * b.ear[1] * 0.6));
    let mut feet = Vec::new();
    let mut knees = Vec::new();
    for (x, bend) in [(b.half_length - 0.04, 0.03), (-b.half_length + 0.02, -b.hock)] {
        let hip = DVec3::new(x, b.height - 0.08, side * b.stance);
        let knee = DVec3::new(x + bend, 0.5 * b.height - 0.05, side * (b.stance + 0.02));
        let foot = DVec3::new(x + 0.2 * bend, b.leg[2], side * (b.stance + 0.02));
        cones.push(RoundCone::new(hip, knee, [b.leg[0], b.leg[1]]));
        cones.push(RoundCone::new(knee, foot, [b.leg[1], b.leg[2]]));
        cones.push(RoundCone::new(foot, foot + DVec3::X * 0.06, [b.leg[2], b.leg[2]]));
        feet.push(foot + DVec3::new(0.03, -b.leg[2], 0.0));
        knees.push(knee + DVec3::X * b.leg[1]);
    }
    points.extend([(names[1], feet[0]), (names[2], feet[1]), (names[3], knees[0]), (names[4], knees[1])]);
    let middle = DVec3::new(0.0, b.height, 0.0);
    points.push((names[5], middle + outwards * 0.5 * (b.body[0] + b.body[1])));
}
