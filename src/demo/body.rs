//! Bodies as implicit surfaces: a function that is negative inside, made by joining, blending and cutting soft parts in their order.
//!
//! A part counts only in a box around it, beyond which it is too far away to be blended. So the function is evaluated at a place from the few
//! parts that matter there.

use super::rounded_cone::RoundedCone;
use crate::math::scalar::{max, min};
use glam::{DVec2, DVec3};

/// The distance by which a part counts beyond the reach of its blend, in units of the blend.
const SPARE: f64 = 0.1;
/// The distance beyond that, where no other is asked for.
const REACH: f64 = 0.02;
/// The size of the boxes that list the parts which matter in them, in units of the longest extent of the body.
const BOX: f64 = 1.0 / 48.0;
/// The function's value far outside.
const FAR: f64 = 1e3;

/// A straight piece with elliptic sections that change along it, with round ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Section {
    ends: [DVec3; 2],
    /// Half the width and half the height at both ends.
    sizes: [DVec2; 2],
    length: f64,
    inverse_length: f64,
    /// The distance by which its round ends reach beyond the ends of its axis.
    reach: f64,
    /// Unit vectors along it, along the width, and along the height.
    axes: [DVec3; 3],
}

impl Section {
    /// A section between two ends. `sizes` has half the width (along `across`) and half the height at each end; `across` is a unit vector
    /// perpendicular to the axis.
    pub fn new(ends: [DVec3; 2], sizes: [DVec2; 2], across: DVec3) -> Self {
        let along = ends[1] - ends[0];
        let length = along.length();
        let axis = along / length;
        let reach = max(sizes[0].element_sum(), sizes[1].element_sum()) * 0.5;
        let axes = [axis, across, across.cross(axis)];
        Self { ends, sizes, length, inverse_length: length.recip(), reach, axes }
    }

    /// About the distance from the section; `least` where the distance is certainly larger than that.
    fn value(&self, p: DVec3, least: f64) -> f64 {
        let from_start = p - self.ends[0];
        let [axis, across, up] = self.axes;
        let x = from_start.dot(axis);
        let t = (x * self.inverse_length).clamp(0.0, 1.0);
        let beyond = x - t * self.length;
        if beyond.abs() > self.reach + max(least, 0.0) {
            return least;
        }
        let size = self.sizes[0].lerp(self.sizes[1], t);
        let q = DVec3::new(beyond, from_start.dot(across), from_start.dot(up));
        of_ellipsoid(q, DVec3::new(0.5 * (size.x + size.y), size.x, size.y))
    }

    fn bounds(&self) -> [DVec3; 2] {
        let radius = |k: usize| DVec3::splat(self.sizes[k].max_element());
        let [a, b] = self.ends;
        [(a - radius(0)).min(b - radius(1)), (a + radius(0)).max(b + radius(1))]
    }
}

/// An ellipsoid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ellipsoid {
    pub centre: DVec3,
    /// Orthonormal directions of the axes.
    pub axes: [DVec3; 3],
    /// Half the axes' lengths.
    pub radii: DVec3,
}

impl Ellipsoid {
    fn value(&self, p: DVec3) -> f64 {
        let q = p - self.centre;
        of_ellipsoid(DVec3::from_array(self.axes.map(|axis| axis.dot(q))), self.radii)
    }

    fn bounds(&self) -> [DVec3; 2] {
        let [a, b, c] = self.axes;
        let [x, y, z] = (self.radii * self.radii).to_array();
        let reach = (a * a * x + b * b * y + c * c * z).to_array().map(f64::sqrt);
        [self.centre - DVec3::from_array(reach), self.centre + DVec3::from_array(reach)]
    }
}

/// About the distance of a place, in the ellipsoid's own frame, from its surface.
fn of_ellipsoid(q: DVec3, radii: DVec3) -> f64 {
    let scaled = q / radii;
    let (size, slope) = (scaled.length(), (scaled / radii).length());
    if slope < 1e-12 { -radii.min_element() } else { size * (size - 1.0) / slope }
}

/// A solid of which parts are put together.
#[derive(Clone, Copy, Debug)]
pub(super) enum Solid {
    Section(Section),
    Ellipsoid(Ellipsoid),
    Cone(RoundedCone),
    /// The half-space behind a plane, away from its normal. It has no bounds, so it can only be taken away.
    Beyond {
        point: DVec3,
        normal: DVec3,
    },
}

impl Solid {
    /// The value of the solid at a place; `least` where the value is certainly larger than that.
    fn value(&self, p: DVec3, least: f64) -> f64 {
        match self {
            Self::Section(section) => section.value(p, least),
            Self::Ellipsoid(ellipsoid) => ellipsoid.value(p),
            Self::Cone(cone) => cone.value(p),
            Self::Beyond { point, normal } => (p - *point).dot(*normal),
        }
    }

    fn bounds(&self) -> [DVec3; 2] {
        match self {
            Self::Section(section) => section.bounds(),
            Self::Ellipsoid(ellipsoid) => ellipsoid.bounds(),
            Self::Cone(cone) => cone.bounds(),
            Self::Beyond { .. } => [DVec3::NEG_INFINITY, DVec3::INFINITY],
        }
    }
}

/// The effect of a part on those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Operation {
    Join,
    Cut,
}

/// Solids side by side that count as one.
#[derive(Clone, Debug)]
pub(super) struct Part {
    solids: Vec<Solid>,
    /// The solids that are taken away from this part alone, each rounded over a distance.
    without: Vec<(Solid, f64)>,
    operation: Operation,
    /// The distance over which the part is blended with those before it.
    blend: f64,
    /// The length of the edges wanted on the part.
    edge: f64,
    /// The distance by which it counts beyond its blend.
    reach: f64,
}

impl Part {
    /// A part that is blended with those before it over a distance.
    pub fn join(solids: Vec<Solid>, blend: f64, edge: f64) -> Self {
        Self { solids, without: Vec::new(), operation: Operation::Join, blend, edge, reach: REACH }
    }

    /// A part that is taken away from those before it, rounded over a distance.
    pub fn cut(solids: Vec<Solid>, blend: f64, edge: f64) -> Self {
        Self { operation: Operation::Cut, ..Self::join(solids, blend, edge) }
    }

    /// The part that counts as far as a distance beyond its blend.
    pub fn reaching(self, reach: f64) -> Self {
        Self { reach, ..self }
    }

    /// The part without a solid, rounded over a distance.
    pub fn without(mut self, solid: Solid, round: f64) -> Self {
        self.without.push((solid, round));
        self
    }

    /// The distance by which the box of a solid is widened; beyond the widened box the solid does not count.
    fn margin(&self) -> f64 {
        (1.0 + SPARE) * self.blend + self.reach
    }

    /// The part's value at a place, from the least value of its solids and the solids that are taken away from it.
    fn trimmed(&self, value: f64, p: DVec3) -> f64 {
        self.without
            .iter()
            .fold(value, |value, (solid, round)| smooth_maximum(value, -solid.value(p, FAR), *round))
    }
}

/// A solid of a part with the box in which it counts.
#[derive(Clone, Copy, Debug)]
struct Boxed {
    part: u32,
    solid: Solid,
    low: DVec3,
    high: DVec3,
}

/// The body's value at a place, and the length of the edges wanted there.
#[derive(Clone, Copy, Debug)]
struct Felt {
    value: f64,
    edge: f64,
}

/// A body: its parts, and boxes that list the solids which matter in them.
pub(super) struct Body {
    parts: Vec<Part>,
    /// The solids in the order of their parts.
    solids: Vec<Boxed>,
    low: DVec3,
    high: DVec3,
    box_size: f64,
    count: [usize; 3],
    /// The solids of each box, in their order.
    near: Vec<Vec<u32>>,
}

impl Body {
    pub fn new(parts: Vec<Part>) -> Self {
        let boxed = |(k, part): (usize, &Part)| {
            let margin = DVec3::splat(part.margin());
            let of = move |solid: &Solid| {
                let [low, high] = solid.bounds();
                Boxed { part: k as u32, solid: *solid, low: low - margin, high: high + margin }
            };
            part.solids.iter().map(of).collect::<Vec<_>>()
        };
        let solids: Vec<Boxed> = parts.iter().enumerate().flat_map(boxed).collect();
        let [low, high] = solids.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[l, h], solid| {
            [l.min(solid.low), h.max(solid.high)]
        });
        let box_size = (high - low).max_element() * BOX;
        let count = ((high - low) / box_size).to_array().map(|n| n as usize + 1);
        let near = vec![Vec::new(); count.iter().product()];
        let mut body = Self { parts, solids, low, high, box_size, count, near };
        for k in 0..body.solids.len() {
            body.enter(k);
        }
        body
    }

    /// Enters a solid into the boxes that it touches.
    fn enter(&mut self, k: usize) {
        let Boxed { low, high, .. } = self.solids[k];
        let at = |p: DVec3, axis: usize| {
            let place = (p[axis] - self.low[axis]) / self.box_size;
            (max(place, 0.0) as usize).min(self.count[axis] - 1)
        };
        let [x, y, z] = [0, 1, 2].map(|axis| at(low, axis)..=at(high, axis));
        for i in x {
            for j in y.clone() {
                for l in z.clone() {
                    self.near[(l * self.count[1] + j) * self.count[0] + i].push(k as u32);
                }
            }
        }
    }

    /// Lowest and highest corner of a box around the surface.
    pub fn bounds(&self) -> [DVec3; 2] {
        [self.low, self.high]
    }

    /// About the distance from the surface where that is small; negative inside.
    pub fn value(&self, p: DVec3) -> f64 {
        self.felt(p).value
    }

    /// The direction in which the value grows.
    pub fn normal(&self, p: DVec3) -> DVec3 {
        let h = 1e-5;
        let slope = |axis: DVec3| self.value(p + axis * h) - self.value(p - axis * h);
        DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z)).normalize_or(DVec3::Y)
    }

    /// The length of the edges wanted near a place of the surface.
    pub fn edge(&self, p: DVec3) -> f64 {
        self.felt(p).edge
    }

    fn felt(&self, p: DVec3) -> Felt {
        let mut felt = Felt { value: FAR, edge: FAR };
        if p.cmplt(self.low).any() || p.cmpge(self.high).any() {
            return felt;
        }
        let [x, y, z] = ((p - self.low) / self.box_size).to_array().map(|n| n as usize);
        let index = (z.min(self.count[2] - 1) * self.count[1] + y.min(self.count[1] - 1)) * self.count[0];
        let mut part = u32::MAX;
        let mut least = FAR;
        for &k in &self.near[index + x.min(self.count[0] - 1)] {
            let boxed = &self.solids[k as usize];
            if p.cmplt(boxed.low).any() || p.cmpgt(boxed.high).any() {
                continue;
            }
            if boxed.part != part {
                felt = self.after(felt, part, least, p);
                (part, least) = (boxed.part, FAR);
            }
            least = min(least, boxed.solid.value(p, least));
        }
        self.after(felt, part, least, p)
    }

    /// The value and edge length after one more part, whose solids have the given least value there.
    fn after(&self, felt: Felt, part: u32, least: f64, p: DVec3) -> Felt {
        self.parts.get(part as usize).map_or(felt, |part| felt.after(part, part.trimmed(least, p)))
    }
}

impl Felt {
    fn after(self, part: &Part, value: f64) -> Self {
        match part.operation {
            Operation::Join => {
                let edge = if value < self.value { part.edge } else { self.edge };
                Self { value: smooth_minimum(self.value, value, part.blend), edge }
            }
            Operation::Cut => {
                let edge = if -value > self.value { part.edge } else { self.edge };
                Self { value: smooth_maximum(self.value, -value, part.blend), edge }
            }
        }
    }
}

/// The polynomial smooth minimum of width `k`.
fn smooth_minimum(a: f64, b: f64, k: f64) -> f64 {
    let h = max(k - (a - b).abs(), 0.0) / k;
    min(a, b) - h * h * k * 0.25
}

/// The polynomial smooth maximum of width `k`.
fn smooth_maximum(a: f64, b: f64, k: f64) -> f64 {
    -smooth_minimum(-a, -b, k)
}
