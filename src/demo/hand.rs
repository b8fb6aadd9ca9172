//! A hand from its bones, open or grasping.

use super::body::{Body, Part};
use super::shape::{Mark, MarkedBody};
use super::tube::{Node, tube};
use crate::math::scalar::{cos, sin};
use glam::DVec3;

/// The place, the directions and the size of a hand. `scale` is about the distance from the wrist to the tip of the middle finger.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wrist {
    pub place: DVec3,
    /// Unit vector towards the fingers.
    pub along: DVec3,
    /// Unit vector out of the palm.
    pub palm: DVec3,
    /// Unit vector towards the thumb.
    pub thumb: DVec3,
    pub scale: f64,
}

impl Wrist {
    /// A wrist with these directions, which are made orthonormal; `thumb` points to the thumb's side, nearly perpendicular to the other two.
    pub fn new(place: DVec3, along: DVec3, thumb: DVec3, palm: DVec3, scale: f64) -> Self {
        let along = along.normalize();
        let thumb = (thumb - along * thumb.dot(along)).normalize();
        let across = along.cross(thumb);
        let palm = if across.dot(palm) < 0.0 { -across } else { across };
        Self { place, along, palm, thumb, scale }
    }

    /// The place with coordinates towards the thumb, along the hand, and out of the palm.
    fn at(&self, x: f64, y: f64, z: f64) -> DVec3 {
        self.place + (self.thumb * x + self.along * y + self.palm * z) * self.scale
    }

    fn node(&self, centre: [f64; 3], height: f64, width: f64) -> Node {
        let [x, y, z] = centre;
        Node {
            centre: self.at(x, y, z),
            height: height * self.scale,
            width: width * self.scale,
            across: self.thumb,
        }
    }
}

/// The pose of the fingers. Angles are in radians.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grip {
    /// The angle by which each finger from the index on is spread, towards the thumb.
    pub spread: [f64; 4],
    /// The angle of each joint of each finger, towards the palm.
    pub curl: [[f64; 3]; 4],
    /// The places of the thumb's joints and tip, by coordinates towards the thumb's side, along the hand, and out of the palm.
    pub thumb: [[f64; 3]; 4],
    /// The factor by which the fingers' radii are multiplied.
    pub fullness: f64,
}

/// An open hand with all fingers spread.
pub(super) const OPEN: Grip = Grip {
    spread: [0.20, 0.05, -0.11, -0.30],
    curl: [[0.06, 0.10, 0.08], [0.03, 0.10, 0.08], [0.05, 0.12, 0.10], [0.08, 0.15, 0.10]],
    thumb: [[0.12, 0.13, 0.02], [0.27, 0.27, 0.05], [0.385, 0.405, 0.06], [0.46, 0.515, 0.055]],
    fullness: 1.0,
};

/// A hand that grasps a ball.
pub(super) const GRASP: Grip = Grip {
    spread: [0.16, 0.04, -0.09, -0.24],
    curl: [[0.45, 0.60, 0.40], [0.60, 0.70, 0.45], [0.68, 0.75, 0.45], [0.70, 0.75, 0.45]],
    thumb: [[0.11, 0.13, 0.05], [0.22, 0.27, 0.17], [0.25, 0.38, 0.30], [0.24, 0.49, 0.385]],
    fullness: 1.0,
};

/// Fingers side by side, as a figure's small hands have them: there is no room between them that a mesh could show.
pub(super) const TOGETHER: Grip = Grip {
    spread: [-0.06, -0.02, 0.03, 0.10],
    curl: [[0.20, 0.25, 0.15]; 4],
    thumb: [[0.12, 0.13, 0.03], [0.25, 0.27, 0.09], [0.37, 0.38, 0.12], [0.45, 0.49, 0.13]],
    fullness: 1.2,
};

/// The places where the fingers begin, from the index finger on: coordinates towards the thumb and along the hand.
const KNUCKLES: [[f64; 2]; 4] = [[0.170, 0.50], [0.058, 0.525], [-0.057, 0.51], [-0.165, 0.46]];
/// The lengths of the three bones of each finger.
const PHALANGES: [[f64; 3]; 4] =
    [[0.235, 0.145, 0.085], [0.265, 0.165, 0.09], [0.245, 0.15, 0.09], [0.185, 0.11, 0.08]];
/// The radii of each finger at its knuckle, at its two other joints, and at its tip.
const RADII: [[f64; 4]; 4] = [
    [0.060, 0.052, 0.047, 0.038],
    [0.062, 0.053, 0.048, 0.039],
    [0.059, 0.051, 0.046, 0.037],
    [0.052, 0.044, 0.040, 0.033],
];

/// The places of a finger's joints, its tip last, and the direction in which its back faces at the tip.
fn finger(wrist: &Wrist, grip: &Grip, k: usize) -> ([DVec3; 4], DVec3) {
    let [x, y] = KNUCKLES[k];
    let straight = wrist.along * cos(grip.spread[k]) + wrist.thumb * sin(grip.spread[k]);
    let (mut bend, mut place, mut back) = (0.0, wrist.at(x, y, 0.0), -wrist.palm);
    let mut joints = [place; 4];
    for i in 0..3 {
        bend += grip.curl[k][i];
        let direction = straight * cos(bend) + wrist.palm * sin(bend);
        back = straight * sin(bend) - wrist.palm * cos(bend);
        place += direction * (PHALANGES[k][i] * wrist.scale);
        joints[i + 1] = place;
    }
    (joints, back)
}

/// The parts of a hand, meshed with edges of the given length.
pub(super) fn parts(wrist: &Wrist, grip: &Grip, edge: f64) -> Vec<Part> {
    let scale = wrist.scale;
    let palm = tube(&[
        wrist.node([0.0, -0.02, 0.0], 0.085, 0.125),
        wrist.node([0.01, 0.12, 0.0], 0.082, 0.160),
        wrist.node([0.005, 0.30, 0.0], 0.076, 0.205),
        wrist.node([0.0, 0.45, 0.0], 0.062, 0.205),
    ]);
    let mut parts = vec![Part::join(palm, 0.06 * scale, 1.25 * edge)];
    // The balls of the thumb and of the little finger.
    let ball = |from: [f64; 3], to: [f64; 3], size: f64| {
        Part::join(
            tube(&[wrist.node(from, size, size), wrist.node(to, 0.75 * size, 0.75 * size)]),
            0.06 * scale,
            1.2 * edge,
        )
    };
    parts.push(ball([-0.10, 0.10, 0.035], [-0.14, 0.34, 0.035], 0.07));
    for k in 0..4 {
        let (joints, _) = finger(wrist, grip, k);
        let radii = RADII[k].map(|r| r * scale * grip.fullness);
        let root = joints[0] - (joints[1] - joints[0]) * 0.25;
        let mut nodes = vec![Node { across: wrist.thumb, ..Node::round(root, radii[0]) }];
        for i in 0..3 {
            // Joints are thicker than the bones between them.
            let middle = joints[i].midpoint(joints[i + 1]);
            nodes.push(Node { across: wrist.thumb, ..Node::round(joints[i], radii[i]) });
            nodes.push(Node {
                across: wrist.thumb,
                ..Node::round(middle, 0.5 * (radii[i] + radii[i + 1]) * 0.93)
            });
        }
        nodes.push(Node { across: wrist.thumb, ..Node::round(joints[3], radii[3]) });
        parts.push(Part::join(tube(&nodes), 0.026 * scale, edge));
        // The knuckle, seen on the back of the hand.
        let knuckle = joints[0] - wrist.palm * (0.022 * scale);
        parts.push(Part::join(
            tube(&[
                Node::round(knuckle, 0.9 * radii[0]),
                Node::round(knuckle + wrist.along * (0.03 * scale), 0.85 * radii[0]),
            ]),
            0.03 * scale,
            edge,
        ));
    }
    let thumb = grip.thumb.map(|[x, y, z]| wrist.at(x, y, z));
    let nodes: Vec<Node> =
        thumb.into_iter().zip([0.095, 0.072, 0.062, 0.046]).map(|(p, r)| Node::round(p, r * scale)).collect();
    parts.push(Part::join(tube(&nodes), 0.05 * scale, edge));
    parts
}

/// The nails of a hand's fingers.
fn nails(wrist: &Wrist, grip: &Grip, edge: f64) -> Vec<Part> {
    let thumb = grip.thumb.map(|[x, y, z]| wrist.at(x, y, z));
    let out = (thumb[3] - thumb[2]).cross(wrist.palm).normalize();
    let out = out * out.dot(wrist.thumb).signum();
    let back = (out - 0.5 * wrist.palm).normalize();
    let size = |radius: f64| radius * wrist.scale;
    let mut nails = vec![nail([thumb[2], thumb[3]], back, wrist.along.cross(out), size(0.040), edge)];
    for k in 0..4 {
        let (joints, back) = finger(wrist, grip, k);
        nails.push(nail([joints[2], joints[3]], back, wrist.thumb, size(0.8 * RADII[k][3]), edge));
    }
    nails
}

/// A nail on the back of the last bone of a finger.
fn nail([joint, tip]: [DVec3; 2], back: DVec3, across: DVec3, radius: f64, edge: f64) -> Part {
    let along = (tip - joint).normalize();
    let at = |t: f64| tip + along * (t * radius) + back * (0.92 * radius);
    let node =
        |t: f64, share: f64| Node { centre: at(t), height: 0.30 * radius, width: share * radius, across };
    Part::join(tube(&[node(-0.55, 0.70), node(0.1, 0.74), node(0.65, 0.62)]), 0.10 * radius, 0.75 * edge)
}

const NAMES: [[&str; 3]; 4] = [
    ["index knuckle", "index joint", "index tip"],
    ["middle knuckle", "middle joint", "middle tip"],
    ["ring knuckle", "ring joint", "ring tip"],
    ["little knuckle", "little joint", "little tip"],
];

/// A left hand with its forearm; the palm looks to -z.
pub(super) fn hand(grip: &Grip) -> MarkedBody {
    let wrist = Wrist::new(DVec3::ZERO, DVec3::Y, -DVec3::X, -DVec3::Z, 1.0);
    let forearm = tube(&[
        wrist.node([0.0, -0.55, 0.0], 0.130, 0.165),
        wrist.node([0.0, -0.32, 0.0], 0.115, 0.145),
        wrist.node([0.0, -0.10, 0.0], 0.088, 0.118),
        wrist.node([0.0, 0.05, 0.0], 0.080, 0.125),
    ]);
    let mut all = vec![Part::join(forearm, 0.05, 0.020)];
    all.extend(parts(&wrist, grip, 0.0125));
    all.extend(nails(&wrist, grip, 0.0125));
    let mut marks = Vec::new();
    for k in 0..4 {
        let (joints, back) = finger(&wrist, grip, k);
        marks.push(Mark::new(NAMES[k][0], joints[0], -wrist.palm));
        let lower = (joints[1] - joints[0]).normalize();
        marks.push(Mark::new(NAMES[k][1], joints[1], back - lower * 0.4));
        marks.push(Mark::new(NAMES[k][2], joints[2], joints[3] - joints[2]));
    }
    let thumb = grip.thumb.map(|[x, y, z]| wrist.at(x, y, z));
    marks.push(Mark::new("thumb tip", thumb[2], thumb[3] - thumb[2]));
    marks.push(Mark::new("thumb joint", thumb[1], wrist.thumb - wrist.palm * 0.3));
    for (name, place, direction) in [
        ("palm", [0.0, 0.28, 0.0], wrist.palm),
        ("back of the hand", [0.0, 0.28, 0.0], -wrist.palm),
        ("edge of the hand", [-0.05, 0.22, 0.0], -wrist.thumb),
        ("wrist, inside", [0.0, -0.08, 0.0], wrist.palm),
        ("wrist, outside", [0.0, -0.08, 0.0], -wrist.palm),
        ("wrist, thumb side", [0.0, -0.08, 0.0], wrist.thumb),
        ("wrist, little side", [0.0, -0.08, 0.0], -wrist.thumb),
        ("forearm", [0.0, -0.55, 0.0], -wrist.along),
    ] {
        let [x, y, z] = place;
        marks.push(Mark::new(name, wrist.at(x, y, z), direction));
    }
    MarkedBody { body: Body::new(all), marks }
}

/// The marks at the tips of the thumb and the middle finger, for the hand of a figure.
pub(super) fn tips(wrist: &Wrist, grip: &Grip, names: [&'static str; 2]) -> [Mark; 2] {
    let thumb = grip.thumb.map(|[x, y, z]| wrist.at(x, y, z));
    let (joints, _) = finger(wrist, grip, 1);
    [
        Mark::new(names[0], thumb[2], thumb[3] - thumb[2]),
        Mark::new(names[1], joints[2], joints[3] - joints[2]),
    ]
}
