//! Four-legged bodies made from their skeletons in profile. The nose points to +x, up is +y, the left side is +z.
//!
//! A species gives sections of its torso, neck, head, legs and tail at rest; a pose turns the joints in the plane of the
//! profile. Sections on a bone move with the bone.

use super::body::{Body, Ellipsoid, Part, Solid};
use super::eye::eye;
use super::shape::{Mark, MarkedBody};
use super::tube::{Node, tube};
use crate::math::rigid2::Rigid2;
use crate::math::scalar::{cos, min, sin};
use glam::{DVec2, DVec3};

/// A section at rest: x, y, z of its middle, half its height in the profile, and half its width.
pub(super) type Profile = [f64; 5];

/// A leg at rest, from the torso to the foot, of the left side.
pub(super) struct Leg {
    pub sections: &'static [Profile],
    /// The sections around which the pose turns what is below: shoulder or hip, elbow or knee, wrist or hock, fetlock.
    pub joints: [usize; 4],
    pub foot: Foot,
}

/// The foot at the end of a leg.
#[derive(Clone, Copy)]
pub(super) enum Foot {
    /// A hoof by its sections; it is flat below.
    Hoof(&'static [Profile]),
    /// A paw with four toes by its middle and half its sizes; it is flat below.
    Paw(DVec3, DVec3),
}

/// A species at rest.
pub(super) struct Build {
    /// The torso's sections from the chest to the rump.
    pub torso: &'static [Profile],
    /// The neck's sections from the torso to the poll.
    pub neck: &'static [Profile],
    /// The head's sections from the poll to the nose.
    pub head: &'static [Profile],
    pub fore: Leg,
    pub hind: Leg,
    /// The tail's sections from the torso to the tip.
    pub tail: &'static [Profile],
    /// The distance over which torso, neck and legs are blended.
    pub blend: f64,
    /// The lengths of edges on the torso and on the head.
    pub edges: [f64; 2],
}

/// The turns of the joints, in radians. A positive angle turns what is below or in front of a joint upwards.
#[derive(Clone, Copy, Default)]
pub(super) struct Pose {
    /// The turn of the whole body around the hips.
    pub pitch: f64,
    /// The turn of the whole neck, and of the head at its end.
    pub neck: f64,
    pub head: f64,
    /// The turns of the joints of the fore legs, left and right.
    pub fore: [[f64; 4]; 2],
    /// The turns of the joints of the hind legs, left and right.
    pub hind: [[f64; 4]; 2],
    pub tail: f64,
}

/// The rigid motion that takes a bone from rest to its pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement(Rigid2);

impl Placement {
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.0.apply(p.truncate()).extend(p.z)
    }

    pub fn direction(&self, d: DVec3) -> DVec3 {
        self.0.rotate(d.truncate()).extend(d.z)
    }

    fn turned(&self, around: DVec2, angle: f64) -> Self {
        let rotation = DVec2::new(cos(angle), sin(angle));
        let turn = Rigid2 { rotation, translation: around - rotation.rotate(around) };
        Self(self.0.after(&turn))
    }

    fn node(&self, [x, y, z, height, width]: Profile) -> Node {
        Node { centre: self.point(DVec3::new(x, y, z)), height, width, across: DVec3::Z }
    }

    pub fn tube(&self, sections: &[Profile]) -> Vec<Solid> {
        tube(&sections.iter().map(|s| self.node(*s)).collect::<Vec<_>>())
    }

    /// An ellipsoid with its long axis in the profile, turned upwards by an angle.
    pub fn ellipsoid(&self, centre: DVec3, radii: DVec3, angle: f64) -> Solid {
        let axis = DVec3::new(cos(angle), sin(angle), 0.0);
        let axes = [axis, DVec3::Z.cross(axis), DVec3::Z].map(|a| self.direction(a));
        Solid::Ellipsoid(Ellipsoid { centre: self.point(centre), axes, radii })
    }

    pub fn ball(&self, centre: DVec3, radius: f64) -> Solid {
        self.ellipsoid(centre, DVec3::splat(radius), 0.0)
    }
}

/// An ear at rest, of the left side.
pub(super) struct Ear {
    pub base: DVec3,
    pub tip: DVec3,
    /// The direction in which the hollow side faces.
    pub facing: DVec3,
    /// Half the width and half the thickness.
    pub size: [f64; 2],
    pub outline: Outline,
}

/// The outline of an ear: its widths from the base to the tip.
#[derive(Clone, Copy)]
pub(super) enum Outline {
    Leaf,
    Triangle,
    Round,
}

impl Outline {
    fn widths(self) -> [f64; 6] {
        match self {
            Self::Leaf => [0.55, 0.9, 1.0, 0.85, 0.55, 0.2],
            Self::Triangle => [1.0, 0.95, 0.8, 0.6, 0.38, 0.14],
            Self::Round => [0.7, 0.95, 1.05, 1.0, 0.8, 0.45],
        }
    }
}

/// A body while its parts and marks are added.
pub(super) struct Sculpture {
    pub parts: Vec<Part>,
    pub marks: Vec<Mark>,
    /// The placement of torso and head in the pose.
    pub torso: Placement,
    pub head: Placement,
    /// The sections of the neck as they lie in the pose.
    neck: Vec<Node>,
    edges: [f64; 2],
}

/// The signs of z on the left and on the right side.
const SIDES: [f64; 2] = [1.0, -1.0];

impl Sculpture {
    /// Torso, neck, head, legs and tail of a species in a pose.
    pub fn new(build: &Build, pose: &Pose) -> Self {
        let hips = build.hind.sections[0];
        let rest = Placement(Rigid2::IDENTITY);
        let torso = rest.turned(DVec2::new(hips[0], hips[1]), pose.pitch);
        let mut sculpture = Self {
            parts: Vec::new(),
            marks: Vec::new(),
            torso,
            head: torso,
            neck: Vec::new(),
            edges: build.edges,
        };
        sculpture.parts.push(Part::join(torso.tube(build.torso), build.blend, build.edges[0]));
        sculpture.neck_and_head(build, pose);
        for (k, side) in SIDES.into_iter().enumerate() {
            sculpture.leg(build, &build.fore, [side, 0.0], pose.fore[k]);
            sculpture.leg(build, &build.hind, [side, 1.0], pose.hind[k]);
        }
        sculpture.tail(build, pose);
        sculpture.torso_marks(build, pose);
        sculpture
    }

    fn neck_and_head(&mut self, build: &Build, pose: &Pose) {
        let count = build.neck.len();
        let mut placement = self.torso;
        let mut nodes = Vec::new();
        for (k, section) in build.neck.iter().enumerate() {
            nodes.push(placement.node(*section));
            if k + 1 < count {
                placement =
                    placement.turned(DVec2::new(section[0], section[1]), pose.neck / (count - 1) as f64);
            }
        }
        self.parts.push(Part::join(tube(&nodes), build.blend, 0.5 * (build.edges[0] + build.edges[1])));
        let poll = build.neck[count - 1];
        self.head = placement.turned(DVec2::new(poll[0], poll[1]), pose.head);
        self.parts.push(Part::join(self.head.tube(build.head), 0.6 * build.blend, build.edges[1]));
        let [.., before, last] = build.head else { return };
        let [from, to] = [before, last].map(|s| DVec3::new(s[0], s[1], s[2]));
        self.mark("nose", self.head, to, to - from);
        let throat = nodes[count - 2];
        let along = (nodes[count - 1].centre - nodes[count - 3].centre).normalize();
        self.marks.push(Mark::new("throat", throat.centre, along.cross(DVec3::Z)));
        self.neck = nodes;
    }

    fn leg(&mut self, build: &Build, leg: &Leg, [side, hind]: [f64; 2], angles: [f64; 4]) {
        let mirrored = |s: &Profile| [s[0], s[1], side * s[2], s[3], s[4]];
        let mut placement = self.torso;
        let (mut nodes, mut joint) = (Vec::new(), 0);
        let names = LEGS[(2.0 * hind) as usize + usize::from(side < 0.0)];
        let mut marks = Vec::new();
        for (k, section) in leg.sections.iter().map(mirrored).enumerate() {
            nodes.push(placement.node(section));
            if joint < 4 && leg.joints[joint] == k {
                placement = placement.turned(DVec2::new(section[0], section[1]), angles[joint]);
                // Elbow and stifle lie at the torso, which is left sideways; knees look forward and hocks back.
                let out = match joint {
                    1 => DVec3::Z * side,
                    _ => DVec3::X * (1.0 - 2.0 * hind),
                };
                let place = DVec3::new(section[0], section[1], section[2]);
                match joint {
                    0 => marks.push((names[0], self.torso, place, DVec3::Z * side)),
                    3 => {}
                    _ => marks.push((names[joint], placement, place, out)),
                }
                joint += 1;
            }
        }
        let edge = 0.5 * (build.edges[0] + build.edges[1]);
        self.parts.push(Part::join(tube(&nodes), build.blend, edge));
        for (name, placement, place, out) in marks {
            self.mark(name, placement, place, out);
        }
        self.foot(leg.foot, placement, side, names[3]);
    }

    fn foot(&mut self, foot: Foot, placement: Placement, side: f64, name: &'static str) {
        let edge = self.edges[1];
        let ground =
            Solid::Beyond { point: placement.point(DVec3::ZERO), normal: placement.direction(DVec3::Y) };
        match foot {
            Foot::Hoof(sections) => {
                let sections: Vec<_> =
                    sections.iter().map(|s| [s[0], s[1], side * s[2], s[3], s[4]]).collect();
                self.parts.push(Part::join(placement.tube(&sections), 0.012, edge).without(ground, 0.02));
                let [x, y, z, height, _] = sections[sections.len() - 1];
                self.mark(name, placement, DVec3::new(x, y.max(0.03), z), DVec3::new(height, 0.0, 0.0));
            }
            Foot::Paw(middle, size) => {
                let middle = DVec3::new(middle.x, middle.y, side * middle.z);
                let palm = placement.ellipsoid(middle, size, 0.0);
                self.parts.push(Part::join(vec![palm], 0.05, edge).without(ground, 0.02));
                for (k, across) in [-0.72, -0.26, 0.26, 0.72].into_iter().enumerate() {
                    let forward = if k == 0 || k == 3 { 0.5 } else { 0.72 };
                    let at = middle + DVec3::new(size.x * forward, -0.12 * size.y, size.z * across);
                    let toe = placement.ellipsoid(
                        at,
                        DVec3::new(0.46 * size.x, 0.74 * size.y, 0.31 * size.z),
                        -0.15,
                    );
                    self.parts.push(Part::join(vec![toe], 0.01, edge).without(ground, 0.015));
                }
                self.mark(name, placement, middle, DVec3::X);
            }
        }
    }

    fn tail(&mut self, build: &Build, pose: &Pose) {
        let mut placement = self.torso;
        let mut nodes = Vec::new();
        for (k, section) in build.tail.iter().enumerate() {
            nodes.push(placement.node(*section));
            if k < 3 {
                placement = placement.turned(DVec2::new(section[0], section[1]), -pose.tail / 3.0);
            }
        }
        let (last, before) = (nodes[nodes.len() - 1], nodes[nodes.len() - 2]);
        self.marks.push(Mark::new("tail tip", last.centre, last.centre - before.centre));
        self.marks.push(Mark::new(
            "tail root",
            nodes[0].centre,
            self.torso.direction(DVec3::new(-0.5, 1.0, 0.0)),
        ));
        self.parts.push(Part::join(tube(&nodes), 0.3 * build.blend, self.edges[1]));
    }

    fn torso_marks(&mut self, build: &Build, pose: &Pose) {
        let at = |k: usize| DVec3::new(build.torso[k][0], build.torso[k][1], 0.0);
        let last = build.torso.len() - 1;
        let middle = last / 2;
        // A neck that is lowered lies before the chest, which is below it.
        let below_neck = 0.5 * min(pose.neck, 0.0);
        let chest = DVec3::new(cos(below_neck), sin(below_neck), 0.0);
        for (name, place, direction) in [
            ("chest", at(0), chest),
            ("withers", at(1).lerp(at(2), 0.4), DVec3::Y),
            ("back", at(middle), DVec3::Y),
            ("croup", at(last - 1), DVec3::Y),
            ("belly", at(middle), -DVec3::Y),
            ("left flank", at(middle), DVec3::Z),
            ("right flank", at(middle), -DVec3::Z),
        ] {
            self.mark(name, self.torso, place, direction);
        }
    }

    /// Marks the point where a ray from a place inside leaves the surface. Place and direction are given as at rest.
    pub fn mark(&mut self, name: &'static str, placement: Placement, inside: DVec3, direction: DVec3) {
        self.marks.push(Mark::new(name, placement.point(inside), placement.direction(direction)));
    }

    /// Adds a part on the left side of the head and its mirror image on the right.
    pub fn on_both_sides(&mut self, make: impl Fn(&Placement, f64) -> Part) {
        let head = self.head;
        self.parts.extend(SIDES.map(|side| make(&head, side)));
    }

    /// Adds thin hollow ears.
    pub fn ears(&mut self, ear: &Ear) {
        let head = self.head;
        for (side, name) in SIDES.into_iter().zip(["left ear", "right ear"]) {
            let [base, tip, facing] =
                [ear.base, ear.tip, ear.facing].map(|v| DVec3::new(v.x, v.y, side * v.z));
            let along = tip - base;
            let axis = along.normalize();
            let facing = (facing - axis * facing.dot(axis)).normalize();
            let broad = facing.cross(axis);
            let [width, thick] = ear.size;
            let node = |k: usize, share: f64| Node {
                centre: head.point(base + along * (k as f64 / 5.0)),
                height: thick * [1.2, 1.0, 0.9, 0.85, 0.8, 0.6][k],
                width: width * share,
                across: head.direction(broad),
            };
            let nodes: Vec<_> =
                ear.outline.widths().into_iter().enumerate().map(|(k, w)| node(k, w)).collect();
            let hollow = Solid::Ellipsoid(Ellipsoid {
                centre: head.point(base + along * 0.44 + facing * thick * 1.45),
                axes: [axis, broad, facing].map(|d| head.direction(d)),
                radii: DVec3::new(0.36 * along.length(), 0.62 * width, 1.1 * thick),
            });
            self.parts.push(Part::join(tube(&nodes), 0.035, 0.8 * self.edges[1]).without(hollow, 0.012));
            self.mark(name, head, base + along * 0.9, along);
        }
    }

    /// Adds eyes of a radius, sockets with balls in them, on the skin beside a place of the head.
    pub fn eyes(&mut self, centre: DVec3, radius: f64) {
        let (head, body) = (self.head, Body::new(self.parts.clone()));
        for (side, name) in SIDES.into_iter().zip(["left eye", "right eye"]) {
            let inside = DVec3::new(centre.x, centre.y, 0.5 * side * centre.z);
            let mark = Mark::new(name, head.point(inside), head.direction(DVec3::new(0.15, 0.05, side)));
            self.parts.extend(eye(&body, mark.place(&body), radius));
            self.marks.push(mark);
        }
    }

    /// Cuts nostrils: ellipsoids turned upwards by an angle.
    pub fn nostrils(&mut self, centre: DVec3, radii: DVec3, angle: f64) {
        let edge = 0.65 * self.edges[1];
        let of = |head: &Placement, side: f64| {
            head.ellipsoid(DVec3::new(centre.x, centre.y, side * centre.z), radii, angle)
        };
        self.on_both_sides(|head, side| Part::cut(vec![of(head, side)], 0.015, edge));
    }

    /// Adds a thin mane along the back of the neck, of the given height above it.
    pub fn crest(&mut self, height: f64) {
        let nodes: Vec<Node> = self
            .neck
            .iter()
            .zip(self.neck.windows(2).chain(self.neck.windows(2).last()))
            .map(|(node, ends)| {
                let along = (ends[1].centre - ends[0].centre).normalize();
                let up = DVec3::Z.cross(along);
                Node {
                    centre: node.centre + up * (node.height + 0.15 * height),
                    height: 1.3 * height,
                    width: 0.75 * height,
                    across: DVec3::Z,
                }
            })
            .collect();
        self.parts.push(Part::join(tube(&nodes), 0.02, self.edges[1]));
    }

    /// The body.
    pub fn finished(self) -> MarkedBody {
        MarkedBody { body: Body::new(self.parts), marks: self.marks }
    }
}

/// Names of marks on a leg: fore left, fore right, hind left, hind right.
const LEGS: [[&str; 4]; 4] = [
    ["left shoulder", "left elbow", "left fore knee", "left fore foot"],
    ["right shoulder", "right elbow", "right fore knee", "right fore foot"],
    ["left hip", "left stifle", "left hock", "left hind foot"],
    ["right hip", "right stifle", "right hock", "right hind foot"],
];
