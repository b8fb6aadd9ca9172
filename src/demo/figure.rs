//! A figure with two arms and two legs in two poses. It looks along +z; its left side is +x, up is +y.

use super::implicit::RoundCone;
use super::shape::{Shape, Skeleton};
use glam::{DVec2, DVec3};

/// The directions of the bones of one side. The lengths of the bones are the same in all poses.
#[derive(Clone, Copy)]
struct Limbs {
    upper_arm: DVec3,
    forearm: DVec3,
    thigh: DVec3,
    shin: DVec3,
}

// The lengths of the bones.
const UPPER_ARM: f64 = 0.50;
const FOREARM: f64 = 0.52;
const THIGH: f64 = 0.62;
const SHIN: f64 = 0.62;

pub(super) fn standing() -> Shape {
    let side = |s: f64| Limbs {
        upper_arm: DVec3::new(s * 0.75, -0.65, 0.0),
        forearm: DVec3::new(s * 0.55, -0.83, 0.12),
        thigh: DVec3::new(s * 0.2, -1.0, 0.05),
        shin: DVec3::new(s * 0.1, -1.0, -0.05),
    };
    build([side(1.0), side(-1.0)], DVec3::Y, 0.064)
}

pub(super) fn dancing() -> Shape {
    let left = Limbs {
        upper_arm: DVec3::new(0.85, 0.45, 0.1),
        forearm: DVec3::new(0.25, 0.95, 0.3),
        thigh: DVec3::new(0.7, -0.6, 0.45),
        shin: DVec3::new(0.35, -0.9, -0.35),
    };
    let right = Limbs {
        upper_arm: DVec3::new(-0.95, -0.05, 0.25),
        forearm: DVec3::new(-0.45, 0.2, 0.85),
        thigh: DVec3::new(-0.22, -1.0, -0.1),
        shin: DVec3::new(-0.05, -1.0, -0.15),
    };
    build([left, right], DVec3::new(0.12, 1.0, 0.06), 0.056)
}

fn build(limbs: [Limbs; 2], spine: DVec3, cell: f64) -> Shape {
    let spine = spine.normalize();
    let hips = DVec3::ZERO;
    let shoulders = hips + spine * 0.82;
    let head = shoulders + spine * 0.46 + DVec3::Z * 0.03;
    let cones = vec![
        RoundCone::new(hips, shoulders - spine * 0.12, [0.25, 0.27]),
        RoundCone::new(shoulders - spine * 0.1, head, [0.15, 0.12]),
        RoundCone::new(head, head + spine * 0.14, [0.20, 0.21]),
        RoundCone::new(head + DVec3::new(0.0, 0.03, 0.16), head + DVec3::new(0.0, 0.02, 0.25), [0.07, 0.05]),
    ];
    let points = vec![
        ("crown", head + spine * 0.35),
        ("nose", head + DVec3::new(0.0, 0.02, 0.30)),
        ("nape", shoulders.midpoint(head) - DVec3::Z * 0.14),
        ("chest", shoulders - spine * 0.18 + DVec3::Z * 0.27),
        ("upper back", shoulders - spine * 0.18 - DVec3::Z * 0.27),
        ("navel", hips + spine * 0.25 + DVec3::Z * 0.25),
        ("lower back", hips + spine * 0.2 - DVec3::Z * 0.25),
    ];
    let mut skeleton = Skeleton { cones, points };
    for (k, names) in [LEFT, RIGHT].into_iter().enumerate() {
        let side = if k == 0 { 1.0 } else { -1.0 };
        add_side(limbs[k], DVec2::new(side, 0.0), [hips, shoulders], &mut skeleton, names);
    }
    skeleton.fleshed(0.12, cell)
}

const LEFT: [&str; 6] = ["left hand", "left elbow", "left foot", "left knee", "left shoulder", "left hip"];
const RIGHT: [&str; 6] =
    ["right hand", "right elbow", "right foot", "right knee", "right shoulder", "right hip"];

fn add_side(
    limbs: Limbs,
    side: DVec2,
    [hips, shoulders]: [DVec3; 2],
    Skeleton { cones, points }: &mut Skeleton,
    names: [&'static str; 6],
) {
    let out = side.extend(0.0);
    let step = |from: DVec3, direction: DVec3, length: f64| from + direction.normalize() * length;
    let shoulder = shoulders + out * 0.27 - DVec3::Y * 0.1;
    let elbow = step(shoulder, limbs.upper_arm, UPPER_ARM);
    let hand = step(elbow, limbs.forearm, FOREARM);
    let hip = hips + out * 0.14 - DVec3::Y * 0.06;
    let knee = step(hip, limbs.thigh, THIGH);
    let ankle = step(knee, limbs.shin, SHIN);
    let toes = ankle + DVec3::new(out.x * 0.04, -0.03, 0.22);
    cones.extend([
        RoundCone::new(shoulder, elbow, [0.135, 0.10]),
        RoundCone::new(elbow, hand, [0.10, 0.085]),
        RoundCone::new(hand, step(hand, limbs.forearm, 0.1), [0.10, 0.08]),
        RoundCone::new(hip, knee, [0.19, 0.125]),
        RoundCone::new(knee, ankle, [0.125, 0.09]),
        RoundCone::new(ankle, toes, [0.095, 0.08]),
    ]);
    // The back of the elbow and the front of the knee, as the bones bend.
    let back = (limbs.upper_arm.normalize() - limbs.forearm.normalize() - DVec3::Z * 0.3).normalize();
    let front = (limbs.thigh.normalize() - limbs.shin.normalize() + DVec3::Z * 0.6).normalize();
    points.extend([
        (names[0], step(hand, limbs.forearm, 0.18)),
        (names[1], elbow + back * 0.1),
        (names[2], toes + DVec3::new(0.0, 0.0, 0.08)),
        (names[3], knee + front * 0.125),
        (names[4], shoulder + (out + DVec3::Y * 0.8).normalize() * 0.14),
        (names[5], hips + out * 0.29 + DVec3::Y * 0.02),
    ]);
}
