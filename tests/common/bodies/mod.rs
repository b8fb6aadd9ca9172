//! Bodies of many kinds, made by the program: birds, insects, hands, chairs. A kind is a list of limbs; a body of it has limbs of other lengths
//! and thicknesses, bent at their joints, so that two bodies of one kind correspond at the ends of their limbs, but are no poses of one body.
#![allow(dead_code, reason = "every test binary uses another part")]

use conemap::demo::{Joint, skin_of_limbs};
use conemap::math::random::SplitMix;
use conemap::math::scalar::{cos, exp, ln};
use conemap::mesh::{SurfaceMesh, VertexId};
use glam::{DQuat, DVec3};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// The standard deviation of the logarithm of a limb's length.
const LENGTHS: f64 = 0.13;
/// The same for its thickness.
const THICKNESSES: f64 = 0.08;
/// The same for the extents of the trunk.
const EXTENTS: f64 = 0.065;
/// The share of a bend where a limb begins, since large ones press it against the trunk.
const AT_ROOT: f64 = 0.6;
/// The distance over which limbs are blended.
const BLEND: f64 = 0.03;
/// Bodies that are drawn until one has no handle and no limb crosses another: bent ones may.
const ATTEMPTS: u64 = 20;

/// The share of the smaller radius by which the end of a limb enters another limb that it crosses.
const CROSSING: f64 = 0.5;

/// A kind of body.
#[derive(Deserialize)]
struct Kind {
    /// The standard deviation of the angle of a joint, in radians.
    bend: f64,
    limbs: Vec<Limb>,
}

/// A limb of a kind.
#[derive(Deserialize)]
struct Limb {
    name: String,
    /// Whether there is one on each side; the joints are those of the left one, whose x are positive.
    #[serde(default)]
    sides: bool,
    /// Whether it is a part of the trunk, which keeps its shape but for its extents.
    #[serde(default)]
    still: bool,
    /// The limb on whose last joint it sits; the trunk otherwise.
    on: Option<String>,
    /// Whether its end is a landmark; where this is not said, the ends of all limbs are but those of the trunk.
    end: Option<bool>,
    /// Places and radii.
    joints: Vec<[f64; 4]>,
}

impl Limb {
    fn has_end(&self) -> bool {
        self.end.unwrap_or(!self.still)
    }
}

/// A body and the ends of its limbs.
pub struct MadeBody {
    pub mesh: SurfaceMesh,
    /// The names of the ends, such as "left wing" and "tail", and their vertices.
    pub ends: Vec<(String, VertexId)>,
}

impl MadeBody {
    /// The ends that both bodies have: their names, and their vertices on this body and the other.
    pub fn common_ends(&self, other: &Self) -> (Vec<String>, Vec<[u32; 2]>) {
        let partner = |(name, v): &(String, VertexId)| {
            let (_, w) = other.ends.iter().find(|(own, _)| own == name)?;
            Some((name.clone(), [v.0, w.0]))
        };
        self.ends.iter().filter_map(partner).unzip()
    }
}

fn kinds() -> BTreeMap<String, Kind> {
    serde_json::from_str(include_str!("kinds.json")).expect("the file of kinds is one")
}

/// The names of all kinds, sorted.
pub fn names() -> Vec<String> {
    kinds().into_keys().collect()
}

/// A body of a kind, with edges of about this length: the pattern itself, which is symmetric, for `build` 0, and another one for each other
/// number.
pub fn body(name: &str, build: u64, edge: f64) -> MadeBody {
    let kind = &kinds()[name];
    let drawn = |attempt: u64| {
        let shares = if build == 0 { Shares::of_pattern() } else { Shares::new(ATTEMPTS * build + attempt) };
        posed(kind, shares)
    };
    (0..ATTEMPTS)
        .map(drawn)
        .filter(|limbs| ends_are_free(limbs))
        .map(|limbs| body_of(&limbs, edge))
        .find(|body| body.mesh.euler_characteristic() == 2)
        .unwrap_or_else(|| panic!("{name} {build}: in every body limbs touch"))
}

/// Whether the ends of limbs that are landmarks stand free: the outer halves of two limbs that cross are one limb to anybody who looks.
fn ends_are_free(limbs: &[(Option<String>, Vec<Joint>)]) -> bool {
    let outer: Vec<[Joint; 2]> = limbs.iter().filter_map(outer_half).collect();
    let enters = |end: &Joint, [a, b]: &[Joint; 2]| {
        let along = b.place - a.place;
        let share = ((end.place - a.place).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let (place, radius) = (a.place + share * along, a.radius + share * (b.radius - a.radius));
        end.place.distance(place) < end.radius + radius - CROSSING * end.radius.min(radius)
    };
    (0..outer.len())
        .all(|k| outer.iter().enumerate().all(|(l, other)| l == k || !enters(&outer[k][1], other)))
}

/// The outer half of a limb's last part; `None` where its end is no landmark.
fn outer_half((name, joints): &(Option<String>, Vec<Joint>)) -> Option<[Joint; 2]> {
    let [.., before, last] = joints[..] else { return None };
    let middle =
        Joint { place: 0.5 * (before.place + last.place), radius: 0.5 * (before.radius + last.radius) };
    name.is_some().then_some([middle, last])
}

/// A body of limbs, with the names of those whose ends are landmarks.
fn body_of(limbs: &[(Option<String>, Vec<Joint>)], edge: f64) -> MadeBody {
    let chains: Vec<Vec<Joint>> = limbs.iter().map(|(_, joints)| joints.clone()).collect();
    let mesh = skin_of_limbs(&chains, BLEND, edge);
    let nearest = |place: DVec3| {
        let off = |v: &VertexId| mesh.positions()[*v].distance_squared(place);
        mesh.vertices().min_by(|a, b| off(a).total_cmp(&off(b))).expect("a mesh has vertices")
    };
    let end = |(name, joints): &(Option<String>, Vec<Joint>)| {
        let [.., before, last] = joints[..] else { return None };
        let out = (last.place - before.place).normalize_or(DVec3::Y);
        Some((name.clone()?, nearest(last.place + last.radius * out)))
    };
    let ends = limbs.iter().filter_map(end).collect();
    MadeBody { mesh, ends }
}

/// Random numbers of a body, all 0 for a pattern.
struct Shares {
    random: SplitMix,
    size: f64,
}

impl Shares {
    fn of_pattern() -> Self {
        Self { random: SplitMix::new(0), size: 0.0 }
    }

    fn new(seed: u64) -> Self {
        Self { random: SplitMix::new(seed), size: 1.0 }
    }

    /// A number of the normal distribution with mean 0 and deviation 1 (Box and Muller).
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * ln(1.0 - self.random.unit())).sqrt();
        self.size * radius * cos(TAU * self.random.unit())
    }

    fn normals(&mut self) -> DVec3 {
        DVec3::new(self.normal(), self.normal(), self.normal())
    }

    /// A turn about a random axis by an angle of this deviation.
    fn turn(&mut self, deviation: f64) -> DQuat {
        let axis = self.normals().normalize_or(DVec3::X);
        DQuat::from_axis_angle(axis, deviation * self.normal())
    }
}

/// The way in which a limb's last joint was moved.
struct Frame {
    from: DVec3,
    to: DVec3,
    turn: DQuat,
}

/// The limbs of a body of a kind, with the names of those whose ends are landmarks.
fn posed(kind: &Kind, mut shares: Shares) -> Vec<(Option<String>, Vec<Joint>)> {
    let extents = (EXTENTS * shares.normals()).to_array().map(exp);
    let extents = DVec3::from_array(extents);
    let mut frames: BTreeMap<&str, Frame> = BTreeMap::new();
    let mut limbs = Vec::new();
    for limb in &kind.limbs {
        let size = [LENGTHS, THICKNESSES].map(|deviation| exp(deviation * shares.normal()));
        for side in if limb.sides { &[1.0, -1.0][..] } else { &[1.0] } {
            let joints: Vec<Joint> = limb
                .joints
                .iter()
                .map(|&[x, y, z, radius]| Joint { place: DVec3::new(side * x, y, z), radius })
                .collect();
            let name = match (limb.sides, *side > 0.0) {
                (false, _) => limb.name.clone(),
                (true, true) => format!("left {}", limb.name),
                (true, false) => format!("right {}", limb.name),
            };
            let posed = if limb.still {
                joints.iter().map(|joint| Joint { place: extents * joint.place, ..*joint }).collect()
            } else {
                let base = limb.on.as_ref().map(|on| &frames[on.as_str()]);
                let root = |p: DVec3| base.map_or(extents * p, |base| base.to + base.turn * (p - base.from));
                let (posed, turn) = bent(
                    &joints,
                    root(joints[0].place),
                    base.map(|base| base.turn),
                    (size, kind.bend),
                    &mut shares,
                );
                let last = |joints: &[Joint]| joints[joints.len() - 1].place;
                frames.insert(&limb.name, Frame { from: last(&joints), to: last(&posed), turn });
                posed
            };
            limbs.push((limb.has_end().then_some(name), posed));
        }
    }
    limbs
}

/// A limb that begins at a place, with its length and its radii multiplied, bent at its joints, and its last turn.
fn bent(
    joints: &[Joint],
    root: DVec3,
    turn: Option<DQuat>,
    ([length, thickness], bend): ([f64; 2], f64),
    shares: &mut Shares,
) -> (Vec<Joint>, DQuat) {
    let mut turn = turn.unwrap_or(DQuat::IDENTITY);
    let mut place = root;
    let mut posed = vec![Joint { place, radius: thickness * joints[0].radius }];
    for (k, ends) in joints.windows(2).enumerate() {
        turn *= shares.turn(if k == 0 { AT_ROOT * bend } else { bend });
        place += length * (turn * (ends[1].place - ends[0].place));
        posed.push(Joint { place, radius: thickness * ends[1].radius });
    }
    (posed, turn)
}
