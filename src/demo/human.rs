//! A figure with face, hands and feet in two poses. It looks along +z; its left side is +x, up is +y.

use super::body::{Body, Ellipsoid, Part, Solid};
use super::eye::eye;
use super::hand::{self, TOGETHER, Wrist};
use super::shape::{Mark, MarkedBody};
use super::tube::{Node, tube};
use glam::DVec3;

/// Directions of the bones of one side.
#[derive(Clone, Copy)]
struct Limbs {
    upper_arm: DVec3,
    forearm: DVec3,
    hand: DVec3,
    /// The direction out of the palm.
    palm: DVec3,
    thigh: DVec3,
    shin: DVec3,
    /// The direction to the toes.
    foot: DVec3,
}

// The lengths of the bones, in the unit in which the figure is 1.8 high.
const UPPER_ARM: f64 = 0.29;
const FOREARM: f64 = 0.25;
const HAND: f64 = 0.185;
const THIGH: f64 = 0.43;
const SHIN: f64 = 0.42;
/// The lengths of edges on the body, and on the face, hands and feet.
const EDGES: [f64; 2] = [0.0190, 0.0085];

const fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// Standing with the arms a little away.
pub(super) fn standing() -> MarkedBody {
    let side = |s: f64| Limbs {
        upper_arm: at(s * 0.50, -0.86, 0.0),
        forearm: at(s * 0.34, -0.92, 0.18),
        hand: at(s * 0.28, -0.95, 0.15),
        palm: at(-s, -0.2, -0.25),
        thigh: at(s * 0.10, -1.0, 0.03),
        shin: at(s * 0.05, -1.0, -0.05),
        foot: at(s * 0.22, 0.0, 1.0),
    };
    figure([side(1.0), side(-1.0)])
}

/// Running.
pub(super) fn running() -> MarkedBody {
    let left = Limbs {
        upper_arm: at(0.55, -0.66, -0.58),
        forearm: at(0.22, -0.30, 0.90),
        hand: at(0.08, -0.10, 0.98),
        palm: at(-1.0, 0.0, 0.0),
        thigh: at(0.08, -0.52, 0.85),
        shin: at(0.02, -0.92, -0.38),
        foot: at(0.08, 0.12, 1.0),
    };
    let right = Limbs {
        upper_arm: at(-0.48, -0.72, 0.50),
        forearm: at(0.12, 0.48, 0.86),
        hand: at(0.20, 0.72, 0.66),
        palm: at(1.0, 0.0, 0.1),
        thigh: at(-0.06, -0.93, -0.36),
        shin: at(-0.02, -0.60, -0.80),
        foot: at(-0.05, -0.85, 0.52),
    };
    figure([left, right])
}

fn ellipsoid(centre: DVec3, radii: DVec3) -> Solid {
    Solid::Ellipsoid(Ellipsoid { centre, axes: [DVec3::X, DVec3::Y, DVec3::Z], radii })
}

fn blob(centre: DVec3, radii: DVec3, blend: f64, edge: f64) -> Part {
    Part::join(vec![ellipsoid(centre, radii)], blend, edge)
}

fn figure(limbs: [Limbs; 2]) -> MarkedBody {
    let mut parts = trunk();
    let mut marks = trunk_marks();
    for (limbs, side) in limbs.into_iter().zip([1.0, -1.0]) {
        add_leg(&limbs, side, &mut parts, &mut marks);
        add_arm(&limbs, side, &mut parts, &mut marks);
    }
    parts.extend(head());
    let body = Body::new(parts.clone());
    for side in [1.0, -1.0] {
        let place = Mark::new("", at(side * 0.031, 1.696, 0.04), DVec3::Z).place(&body);
        parts.extend(eye(&body, place, 0.0135));
    }
    MarkedBody { body: Body::new(parts), marks }
}

fn trunk() -> Vec<Part> {
    let edge = EDGES[0];
    let node = |[y, z, depth, width]: [f64; 4]| Node {
        centre: at(0.0, y, z),
        height: depth,
        width,
        across: DVec3::X,
    };
    let trunk = [
        [0.875, -0.005, 0.080, 0.120],
        [0.95, -0.005, 0.100, 0.160],
        [1.05, 0.000, 0.092, 0.145],
        [1.14, 0.005, 0.084, 0.126],
        [1.27, 0.005, 0.100, 0.148],
        [1.37, 0.000, 0.104, 0.165],
        [1.45, -0.012, 0.076, 0.150],
        [1.50, -0.020, 0.050, 0.085],
    ];
    let neck = [[1.46, -0.022, 0.060, 0.066], [1.54, -0.016, 0.052, 0.053], [1.63, -0.004, 0.052, 0.050]];
    let mut parts = vec![
        Part::join(tube(&trunk.map(node)), 0.05, edge),
        Part::join(tube(&neck.map(node)), 0.04, 0.8 * edge),
    ];
    for side in [1.0, -1.0] {
        parts.push(blob(at(side * 0.072, 0.915, -0.062), at(0.078, 0.085, 0.062), 0.03, edge));
        parts.push(blob(at(side * 0.075, 1.375, 0.066), at(0.085, 0.060, 0.036), 0.05, edge));
        // Shoulder blades, and the muscles from the neck to the shoulders.
        parts.push(blob(at(side * 0.085, 1.36, -0.075), at(0.060, 0.080, 0.034), 0.04, edge));
        let trapezius = [
            Node::round(at(side * 0.035, 1.545, -0.025), 0.030),
            Node::round(at(side * 0.155, 1.465, -0.015), 0.034),
        ];
        parts.push(Part::join(tube(&trapezius), 0.05, edge));
    }
    parts
}

fn head() -> Vec<Part> {
    let edge = EDGES[1];
    let mut parts = vec![
        blob(at(0.0, 1.725, -0.005), at(0.076, 0.092, 0.096), 0.03, 1.3 * edge),
        blob(at(0.0, 1.675, 0.030), at(0.058, 0.085, 0.066), 0.03, edge),
        blob(at(0.0, 1.612, 0.068), at(0.028, 0.024, 0.026), 0.035, edge),
        Part::join(
            tube(&[Node::round(at(0.0, 1.712, 0.092), 0.009), Node::round(at(0.0, 1.672, 0.110), 0.0135)]),
            0.014,
            0.8 * edge,
        ),
    ];
    for side in [1.0, -1.0] {
        let jaw = [
            Node::round(at(side * 0.050, 1.655, 0.005), 0.022),
            Node::round(at(side * 0.018, 1.608, 0.062), 0.018),
        ];
        parts.push(Part::join(tube(&jaw), 0.03, edge));
        parts.push(blob(at(side * 0.030, 1.715, 0.079), at(0.032, 0.010, 0.014), 0.024, 0.8 * edge));
        parts.push(blob(at(side * 0.043, 1.668, 0.058), at(0.024, 0.024, 0.022), 0.04, edge));
        parts.push(blob(at(side * 0.0135, 1.668, 0.100), at(0.0085, 0.0085, 0.011), 0.008, 0.7 * edge));
        let ear = Ellipsoid {
            centre: at(side * 0.080, 1.692, -0.006),
            axes: [
                at(side * 0.88, 0.0, -0.474_973_683_481_516_7),
                DVec3::Y,
                at(0.474_973_683_481_516_7, 0.0, side * 0.88),
            ],
            radii: at(0.013, 0.036, 0.023),
        };
        let hollow =
            Ellipsoid { centre: at(side * 0.099, 1.694, 0.003), radii: at(0.012, 0.022, 0.012), ..ear };
        let ear = Part::join(vec![Solid::Ellipsoid(ear)], 0.008, 0.7 * edge);
        parts.push(ear.without(Solid::Ellipsoid(hollow), 0.005));
    }
    parts.push(blob(at(0.0, 1.6425, 0.0885), at(0.021, 0.0075, 0.0125), 0.005, 0.6 * edge));
    parts.push(blob(at(0.0, 1.6300, 0.0860), at(0.017, 0.0075, 0.0125), 0.005, 0.6 * edge));
    parts
}

fn trunk_marks() -> Vec<Mark> {
    [
        ("crown", at(0.0, 1.72, 0.0), DVec3::Y),
        ("nose", at(0.0, 1.672, 0.05), DVec3::Z),
        ("chin", at(0.0, 1.615, 0.04), at(0.0, -0.4, 1.0)),
        ("left ear", at(0.05, 1.692, -0.006), DVec3::X),
        ("right ear", at(-0.05, 1.692, -0.006), -DVec3::X),
        ("nape", at(0.0, 1.56, 0.0), -DVec3::Z),
        ("chest", at(0.0, 1.37, 0.0), DVec3::Z),
        ("upper back", at(0.0, 1.37, 0.0), -DVec3::Z),
        ("navel", at(0.0, 1.08, 0.0), DVec3::Z),
        ("lower back", at(0.0, 1.10, 0.0), -DVec3::Z),
        ("crotch", at(0.0, 0.90, 0.0), at(0.0, -1.0, 0.1)),
        ("left side", at(0.0, 1.14, 0.0), DVec3::X),
        ("right side", at(0.0, 1.14, 0.0), -DVec3::X),
    ]
    .map(|(name, inside, direction)| Mark::new(name, inside, direction))
    .to_vec()
}

fn add_leg(limbs: &Limbs, side: f64, parts: &mut Vec<Part>, marks: &mut Vec<Mark>) {
    let [edge, fine] = EDGES;
    let hip = at(side * 0.092, 0.925, 0.0);
    let (thigh, shin) = (limbs.thigh.normalize(), limbs.shin.normalize());
    let knee = hip + thigh * THIGH;
    let ankle = knee + shin * SHIN;
    let front = (thigh - shin + DVec3::Z * 0.15).normalize();
    let front_of = |bone: DVec3| (front - bone * front.dot(bone)).normalize();
    let on_thigh =
        |t: f64, forward: f64, r: f64| Node::round(hip + thigh * (t * THIGH) + front_of(thigh) * forward, r);
    let on_shin =
        |t: f64, forward: f64, r: f64| Node::round(knee + shin * (t * SHIN) + front_of(shin) * forward, r);
    let leg = [
        on_thigh(-0.05, 0.0, 0.088),
        on_thigh(0.20, 0.006, 0.087),
        on_thigh(0.50, 0.010, 0.076),
        on_thigh(0.80, 0.004, 0.059),
        on_thigh(1.0, 0.004, 0.053),
        on_shin(0.14, -0.004, 0.051),
        on_shin(0.32, -0.016, 0.054),
        on_shin(0.52, -0.012, 0.047),
        on_shin(0.78, -0.002, 0.034),
        on_shin(0.96, 0.0, 0.032),
        on_shin(1.04, 0.0, 0.033),
    ];
    parts.push(Part::join(tube(&leg), 0.035, edge));
    parts.push(Part::join(vec![ellipsoid(knee + front * 0.030, DVec3::splat(0.030))], 0.03, edge));
    let toes = limbs.foot.normalize();
    let across = shin.cross(toes).normalize();
    let down = toes.cross(across) * toes.cross(across).dot(shin).signum();
    let place = |forward: f64, below: f64, out: f64| ankle + toes * forward + down * below + across * out;
    let node = |forward: f64, below: f64, height: f64, width: f64| Node {
        centre: place(forward, below, 0.0),
        height,
        width,
        across,
    };
    let foot = [
        node(-0.040, 0.048, 0.026, 0.027),
        node(-0.010, 0.040, 0.036, 0.033),
        node(0.045, 0.036, 0.036, 0.035),
        node(0.100, 0.050, 0.026, 0.042),
        node(0.150, 0.060, 0.017, 0.043),
    ];
    parts.push(Part::join(tube(&foot), 0.03, 1.3 * fine));
    // The big toe is on the inner side.
    let inner = -side * across.dot(DVec3::X).signum();
    for (k, out) in [0.033, 0.013, -0.003, -0.018, -0.032].into_iter().enumerate() {
        let size = [0.0145, 0.0105, 0.010, 0.0095, 0.009][k];
        let end = 0.192 - 0.0105 * k as f64 + if k == 0 { -0.004 } else { 0.004 };
        let toe = [0.145, end - size].map(|forward| Node::round(place(forward, 0.064, inner * out), size));
        parts.push(Part::join(tube(&toe), 0.006, fine));
    }
    let names = if side > 0.0 {
        ["left hip", "left knee", "left calf", "left heel", "left toes"]
    } else {
        ["right hip", "right knee", "right calf", "right heel", "right toes"]
    };
    marks.push(Mark::new(names[0], at(side * 0.05, 0.95, 0.0), DVec3::X * side));
    marks.push(Mark::new(names[1], knee, front));
    marks.push(Mark::new(names[3], place(-0.02, 0.045, 0.0), down * 0.3 - toes));
    marks.push(Mark::new(names[4], place(0.12, 0.062, inner * 0.033), toes));
}

fn add_arm(limbs: &Limbs, side: f64, parts: &mut Vec<Part>, marks: &mut Vec<Mark>) {
    let [edge, fine] = EDGES;
    let shoulder = at(side * 0.182, 1.425, -0.012);
    let (upper, lower) = (limbs.upper_arm.normalize(), limbs.forearm.normalize());
    let elbow = shoulder + upper * UPPER_ARM;
    let end = elbow + lower * FOREARM;
    let palm = limbs.palm;
    let along = limbs.hand.normalize();
    // The palm of a left hand that points down looks right when its thumb is in front.
    let thumb = palm.cross(along) * side;
    let wrist = Wrist::new(end + along * 0.008, along, thumb, palm, HAND);
    let on_upper = |t: f64, r: f64| Node::round(shoulder + upper * (t * UPPER_ARM), r);
    let on_lower = |t: f64, height: f64, width: f64| Node {
        centre: elbow + lower * (t * FOREARM),
        height,
        width,
        across: wrist.thumb,
    };
    let arm = [
        on_upper(-0.08, 0.056),
        on_upper(0.18, 0.056),
        on_upper(0.45, 0.046),
        on_upper(0.72, 0.043),
        on_upper(0.98, 0.036),
        on_lower(0.14, 0.038, 0.040),
        on_lower(0.30, 0.037, 0.040),
        on_lower(0.62, 0.029, 0.032),
        on_lower(0.90, 0.021, 0.026),
        on_lower(1.03, 0.0175, 0.0245),
    ];
    parts.push(Part::join(tube(&arm), 0.03, 0.9 * edge));
    parts.extend(hand::parts(&wrist, &TOGETHER, fine));
    let names = if side > 0.0 {
        ["left shoulder", "left elbow", "left thumb", "left middle finger"]
    } else {
        ["right shoulder", "right elbow", "right thumb", "right middle finger"]
    };
    let back = upper - lower - DVec3::Z * 0.2;
    marks.push(Mark::new(names[0], shoulder, at(side, 0.7, 0.0)));
    marks.push(Mark::new(names[1], elbow, back));
    marks.extend(hand::tips(&wrist, &TOGETHER, [names[2], names[3]]));
}
