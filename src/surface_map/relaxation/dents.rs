//! The worst places of a map are healed.
//!
//! An integral hardly sees a distortion of a thousand on a millionth of the surface, and a Newton step of the whole map is no
//! longer than such a place allows. So when a map is relaxed, the vertices of its worst pieces, of either mesh, move once
//! more, one at a time. While a vertex moves within its star, the star as a whole is overlapped by the same few triangles of
//! the other mesh: developed into the vertex' plane they share convex polygons with the star's triangles. What is lowered is
//! the energy of the map there and the density's sixth power, which is nearly its maximum and still smooth: by Newton's
//! method in two unknowns, from difference quotients of the logarithm. The worst come first; what does not move any more
//! rests until something moves beside it. Triangles stay positive, and all else stays as it is.

use crate::math::rigid2::Rigid2;
use crate::math::scalar::{ln, max, min};
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::surface_map::energy::map_energy::MapEnergy;
use crate::surface_map::measures::distortion::{self, LocalDistortion};
use crate::surface_map::overlay::{Overlay, Piece};
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::{Embedding, Parametrised};
use crate::surface_map::parametrisation::rest_triangle::{Corner, FlatTriangle, rest_jacobian};
use glam::{DMat2, DVec2};
use std::collections::{BTreeMap, BTreeSet};
use typed_index_collections::{TiVec, ti_vec};

/// How worst places are healed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DentOptions {
    /// The brink between two poses of one body: pieces with a density above it are dents.
    pub pose_brink: f64,
    /// The brink of other maps, where large distortion may be right.
    pub brink: f64,
    /// Sweeps over the vertices of all dents, at most.
    pub sweeps: usize,
    /// Further sweeps over those of the deepest, with a density above ten times the brink, at most.
    pub deep_sweeps: usize,
    /// The share of all vertices that may move in one sweep: those of the worst pieces.
    pub share: f64,
}

impl Default for DentOptions {
    fn default() -> Self {
        Self { pose_brink: 20.0, brink: 500.0, sweeps: 12, deep_sweeps: 40, share: 0.006 }
    }
}

/// A vertex that lowers the cost of its star by less than this share rests.
const REST: f64 = 5e-3;

/// So many vertices may move in a sweep over meshes of any size.
const LEAST: usize = 20;

/// From so many times the brink on dents are deep.
const DEEP: f64 = 10.0;

/// What is lowered: the energy of the map, and what dents cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DentEnergy {
    /// The energy of the map.
    pub energy: MapEnergy,
    /// Pieces with a density above this are dents.
    pub brink: f64,
}

impl DentEnergy {
    /// From so many times the brink on dents are dear: their cost grows with the sixth power of the density, and is 1 there on
    /// either surface.
    const DEAR: f64 = 2.5;

    /// The energy per unit of source area.
    #[inline]
    fn density(&self, j: &DMat2) -> f64 {
        let local = LocalDistortion::of(j);
        let excess = local.density / (Self::DEAR * self.brink);
        let cube = excess * excess * excess;
        self.energy.density(j) + (1.0 + local.area) * cube * cube
    }
}

/// A face of the other side that overlaps a face.
#[derive(Clone, Copy)]
struct Partner {
    face: FaceId,
    /// From the plane of the own face to the partner's.
    motion: Rigid2,
}

/// One side with what overlaps its faces.
struct Sheet<'a> {
    side: Parametrised<'a>,
    is_landmark: TiVec<VertexId, bool>,
    corners: TiVec<HalfedgeId, DVec2>,
    partners: TiVec<FaceId, Vec<Partner>>,
}

/// A triangle of a star, seen from the place of its vertex.
struct Ray {
    halfedge: HalfedgeId,
    /// From the star's plane to the face's.
    motion: Rigid2,
    ring: [DVec2; 2],
    /// Gradients of the hat functions in the rest plane, that of the star's vertex first.
    hats: [DVec2; 3],
}

/// A triangle of the other side over a star.
struct Cover {
    face: FaceId,
    /// From the star's plane to the face's.
    motion: Rigid2,
    triangle: Boxed,
    /// From the star's plane to the rest plane.
    onto_rest: DMat2,
}

/// A vertex with the triangles around it and those over them, in a plane whose origin is the vertex.
struct Star {
    rays: Vec<Ray>,
    covers: Vec<Cover>,
    /// Where the origin is in the plane of the first face.
    origin: DVec2,
}

/// Moves the vertices of the worst pieces; `overlay` is that of both sides. `None` where there is no dent, or nothing helps.
///
/// Triangles that were positive stay so, and what is lowered never grows.
pub fn heal(
    sides: [Parametrised<'_>; 2],
    (overlay, surface): (&Overlay, &ConeSurface),
    (options, energy): (&DentOptions, DentEnergy),
) -> Option<[Embedding; 2]> {
    let mut healer = Healer { sheets: sheets(sides, overlay), energy, at_rest: BTreeSet::new() };
    let mut faces = dented(sides, overlay, energy.brink);
    let vertices = sides.iter().map(|side| side.mesh.vertex_count()).sum::<usize>();
    let most = ((options.share * vertices as f64) as usize).max(LEAST);
    let mut moved = false;
    for sweep in 0..options.sweeps + options.deep_sweeps {
        let depth = if sweep < options.sweeps { 1.0 } else { DEEP };
        let (mut dented, worst) = healer.worst(&faces, (depth * energy.brink, most));
        if worst.is_empty() {
            break;
        }
        for vertex in worst {
            let Some(star) = healer.settled(vertex) else {
                healer.at_rest.insert(vertex);
                continue;
            };
            moved = true;
            healer.wake(vertex.0, &star);
            match vertex.0 {
                0 => dented.extend(star.rays.iter().map(|ray| ray.halfedge.face())),
                _ => dented.extend(star.covers.iter().map(|cover| cover.face)),
            }
        }
        faces = dented;
    }
    moved.then(|| {
        healer.sheets.map(|sheet| {
            let mut embedding = Embedding { corners: sheet.corners, ..sheet.side.embedding.clone() };
            embedding.normalise_anchors(surface);
            embedding
        })
    })
}

/// The source faces with dents.
fn dented(sides: [Parametrised<'_>; 2], overlay: &Overlay, brink: f64) -> BTreeSet<FaceId> {
    let [a, b] =
        sides.map(|side| side.mesh.faces().map(|f| rest_jacobian(side, f)).collect::<TiVec<FaceId, DMat2>>());
    let density = |piece: &Piece| {
        let turn = DMat2::from_cols(piece.motion.rotation, piece.motion.rotation.perp());
        LocalDistortion::of(&(b[piece.target_face].inverse() * turn * a[piece.source_face])).density
    };
    let pieces = overlay.pieces.iter().filter(|piece| density(piece) > brink);
    pieces.map(|piece| piece.source_face).collect()
}

fn sheets<'a>(sides: [Parametrised<'a>; 2], overlay: &Overlay) -> [Sheet<'a>; 2] {
    let mut sheets = sides.map(|side| {
        let mut is_landmark = ti_vec![false; side.mesh.vertex_count()];
        side.landmark_vertices.iter().for_each(|&v| is_landmark[v] = true);
        let partners = ti_vec![Vec::new(); side.mesh.face_count()];
        Sheet { side, is_landmark, corners: side.embedding.corners.clone(), partners }
    });
    for piece in &overlay.pieces {
        let (s, t) = (piece.source_face, piece.target_face);
        sheets[0].partners[s].push(Partner { face: t, motion: piece.motion });
        sheets[1].partners[t].push(Partner { face: s, motion: piece.motion.inverse() });
    }
    sheets
}

struct Healer<'a> {
    sheets: [Sheet<'a>; 2],
    energy: DentEnergy,
    /// Vertices that do not move any further while nothing moves around them.
    at_rest: BTreeSet<(usize, VertexId)>,
}

impl Healer<'_> {
    /// Which of some source faces have dents, and the vertices of their worst pieces that may move, with their sides: the worst
    /// first, at most `most`.
    fn worst(
        &self,
        faces: &BTreeSet<FaceId>,
        (brink, most): (f64, usize),
    ) -> (BTreeSet<FaceId>, Vec<(usize, VertexId)>) {
        let [source, target] = &self.sheets;
        let target_inverse = |t: FaceId| target.jacobian(t).inverse();
        let mut found: BTreeMap<(usize, VertexId), f64> = BTreeMap::new();
        let mut dented = BTreeSet::new();
        for &s in faces {
            let a = source.jacobian(s);
            for partner in &source.partners[s] {
                let turn = DMat2::from_cols(partner.motion.rotation, partner.motion.rotation.perp());
                let density = LocalDistortion::of(&(target_inverse(partner.face) * turn * a)).density;
                if density <= brink || !self.is_certain(s, partner) {
                    continue;
                }
                dented.insert(s);
                let on_source = source.side.mesh.triangles()[s].map(|v| (0, v));
                let on_target = target.side.mesh.triangles()[partner.face].map(|v| (1, v));
                for (k, v) in on_source.into_iter().chain(on_target) {
                    if !self.sheets[k].is_landmark[v] && !self.at_rest.contains(&(k, v)) {
                        let worst = found.entry((k, v)).or_default();
                        *worst = max(*worst, density);
                    }
                }
            }
        }
        let mut found: Vec<((usize, VertexId), f64)> = found.into_iter().collect();
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        found.truncate(most);
        (dented, found.into_iter().map(|(vertex, _)| vertex).collect())
    }

    /// What lies around a vertex that has moved may move again.
    fn wake(&mut self, k: usize, star: &Star) {
        let own = star.rays.iter().map(|ray| (k, ray.halfedge.face()));
        for (k, f) in own.chain(star.covers.iter().map(|cover| (1 - k, cover.face))) {
            for v in self.sheets[k].side.mesh.triangles()[f] {
                self.at_rest.remove(&(k, v));
            }
        }
    }

    /// Whether a source face and its partner share more than rounding can make.
    fn is_certain(&self, s: FaceId, partner: &Partner) -> bool {
        let [p, q] = [self.sheets[0].triangle(s), self.sheets[1].triangle(partner.face)];
        let seen = Boxed::new(p.map(|corner| partner.motion.apply(corner)));
        distortion::is_certain(seen.overlap(&Boxed::new(q)), [&p, &q])
    }

    /// Moves one vertex to lower the cost of its star; the star where it moved.
    fn settled(&mut self, (k, v): (usize, VertexId)) -> Option<Star> {
        let star = Star::around(&self.sheets[k], &self.sheets[1 - k], v);
        if !star.is_covered() {
            return None;
        }
        let start = ln(star.cost(DVec2::ZERO, &self.energy)?);
        let (mut z, mut least) = (DVec2::ZERO, start);
        for _ in 0..3 {
            let Some((next, cost)) = star.improved(z, least, &self.energy) else { break };
            let gained = least - cost;
            (z, least) = (next, cost);
            if gained < 0.01 {
                break;
            }
        }
        if least > start - REST {
            return None;
        }
        self.place(k, &star, z).then_some(star)
    }

    /// Moves the vertex in the middle of a star; `false`, unchanged, where rounding turns a triangle over.
    fn place(&mut self, k: usize, star: &Star, z: DVec2) -> bool {
        let corners = &mut self.sheets[k].corners;
        let before: Vec<DVec2> = star.rays.iter().map(|ray| corners[ray.halfedge]).collect();
        for ray in &star.rays {
            corners[ray.halfedge] = ray.motion.apply(star.origin + z);
        }
        let area = |h: HalfedgeId| signed_double_area(corners[h], corners[h.next()], corners[h.prev()]);
        if star.rays.iter().any(|ray| area(ray.halfedge) <= 0.0) {
            for (ray, corner) in star.rays.iter().zip(before) {
                corners[ray.halfedge] = corner;
            }
            return false;
        }
        self.pair_anew(k, star, z);
        true
    }

    /// Writes down what overlaps what now.
    fn pair_anew(&mut self, k: usize, star: &Star, z: DVec2) {
        let own: Vec<FaceId> = star.rays.iter().map(|ray| ray.halfedge.face()).collect();
        for cover in &star.covers {
            self.sheets[1 - k].partners[cover.face].retain(|partner| !own.contains(&partner.face));
        }
        for ray in &star.rays {
            let face = ray.halfedge.face();
            self.sheets[k].partners[face].clear();
            let own = Boxed::new([z, ray.ring[0], ray.ring[1]]);
            for cover in star.covers.iter().filter(|cover| own.overlap(&cover.triangle) > 0.0) {
                let motion = cover.motion.after(&ray.motion.inverse());
                self.sheets[k].partners[face].push(Partner { face: cover.face, motion });
                self.sheets[1 - k].partners[cover.face].push(Partner { face, motion: motion.inverse() });
            }
        }
    }
}

impl Sheet<'_> {
    /// The face with its rest shape.
    fn rest(&self, f: FaceId) -> FlatTriangle {
        FlatTriangle::with_rest(self.triangle(f).map(Corner::Fixed), self.side.mesh.corners(f))
    }

    /// The face in its plane.
    fn triangle(&self, f: FaceId) -> [DVec2; 3] {
        [0, 1, 2].map(|k| self.corners[HalfedgeId::of(f, k)])
    }

    /// From the face's rest plane to its plane.
    fn jacobian(&self, f: FaceId) -> DMat2 {
        self.rest(f).jacobian_at(DVec2::ZERO)
    }
}

impl Star {
    /// The star of a free vertex.
    fn around(own: &Sheet<'_>, other: &Sheet<'_>, v: VertexId) -> Self {
        let mesh = own.side.mesh;
        let origin = own.corners[mesh.outgoing(v)];
        let mut star = Self { rays: Vec::new(), covers: Vec::new(), origin };
        let mut motion = Rigid2::IDENTITY;
        for h in mesh.star(v) {
            let (f, back) = (h.face(), motion.inverse());
            let hats = own.rest(f).hats;
            let k = h.corner();
            star.rays.push(Ray {
                halfedge: h,
                motion,
                ring: [h.next(), h.prev()].map(|h| back.apply(own.corners[h]) - origin),
                hats: [hats[k], hats[(k + 1) % 3], hats[(k + 2) % 3]],
            });
            for partner in &own.partners[f] {
                star.cover(other, partner.face, partner.motion.after(&motion));
            }
            motion = own.side.embedding.transitions[h.prev()].after(&motion);
        }
        star
    }

    /// Adds a triangle of the other side, unless it is there.
    fn cover(&mut self, other: &Sheet<'_>, face: FaceId, motion: Rigid2) {
        let back = motion.inverse();
        let corners = [0, 1, 2].map(|k| back.apply(other.corners[HalfedgeId::of(face, k)]) - self.origin);
        let size = corners[0].distance(corners[1]);
        let is_same = |cover: &Cover| {
            cover.face == face && cover.triangle.corners[0].distance(corners[0]) < 1e-6 * size
        };
        if self.covers.iter().any(is_same) {
            return;
        }
        let rest = other.jacobian(face).inverse();
        let onto_rest = rest * DMat2::from_cols(motion.rotation, motion.rotation.perp());
        self.covers.push(Cover { face, motion, triangle: Boxed::new(corners), onto_rest });
    }

    /// Whether the covers' shares add up to the star.
    fn is_covered(&self) -> bool {
        let (mut area, mut covered) = (0.0, 0.0);
        for ray in &self.rays {
            let [p, q] = ray.ring;
            let own = Boxed::new([DVec2::ZERO, p, q]);
            area += 0.5 * p.perp_dot(q);
            covered += self.covers.iter().map(|cover| own.overlap(&cover.triangle)).sum::<f64>();
        }
        (covered - area).abs() < 1e-7 * area
    }

    /// What is lowered; `None` where a triangle is not positive.
    fn cost(&self, z: DVec2, energy: &DentEnergy) -> Option<f64> {
        let mut cost = 0.0;
        for ray in &self.rays {
            let [p, q] = ray.ring;
            if signed_double_area(z, p, q) <= 0.0 {
                return None;
            }
            let column = |c: fn(DVec2) -> f64| z * c(ray.hats[0]) + p * c(ray.hats[1]) + q * c(ray.hats[2]);
            let jacobian = DMat2::from_cols(column(|g| g.x), column(|g| g.y));
            let scale = 1.0 / jacobian.determinant();
            let own = Boxed::new([z, p, q]);
            for cover in &self.covers {
                let area = own.overlap(&cover.triangle);
                if area > 0.0 {
                    cost += area * scale * energy.density(&(cover.onto_rest * jacobian));
                }
            }
        }
        Some(cost)
    }

    /// A better place with its cost's logarithm, by one step of Newton's method.
    fn improved(&self, z: DVec2, least: f64, energy: &DentEnergy) -> Option<(DVec2, f64)> {
        let at = |z: DVec2| self.cost(z, energy).map(ln);
        let height = |ray: &Ray| {
            let [p, q] = ray.ring;
            signed_double_area(z, p, q) / p.distance(q)
        };
        let room = self.rays.iter().map(height).fold(f64::INFINITY, min);
        let h = 1e-3 * room;
        let [e, w] = [at(z + DVec2::new(h, 0.0))?, at(z - DVec2::new(h, 0.0))?];
        let [n, s] = [at(z + DVec2::new(0.0, h))?, at(z - DVec2::new(0.0, h))?];
        let corner = at(z + DVec2::new(h, h))?;
        let slope = DVec2::new(e - w, n - s) / (2.0 * h);
        let [xx, yy] = [(e + w - 2.0 * least), (n + s - 2.0 * least)].map(|sum| sum / (h * h));
        let xy = (corner - e - n + least) / (h * h);
        let mut step = newton(slope, [xx, xy, yy], 10.0 * room)?;
        for _ in 0..6 {
            if let Some(cost) = at(z + step)
                && cost < least
            {
                return Some((z + step, cost));
            }
            step *= 0.3;
        }
        None
    }
}

/// Newton's step with the Hessian's eigenvalues made positive, no longer than `longest`.
fn newton(slope: DVec2, [xx, xy, yy]: [f64; 3], longest: f64) -> Option<DVec2> {
    let (mean, difference) = (0.5 * (xx + yy), 0.5 * (xx - yy));
    let root = (difference * difference + xy * xy).sqrt();
    let first = DVec2::new(xy, mean + root - xx).normalize_or(DVec2::X);
    let least = slope.length() / longest;
    let [a, b] = [mean + root, mean - root].map(|eigenvalue| max(eigenvalue.abs(), least));
    let step = -(first * (first.dot(slope) / a) + first.perp() * (first.perp().dot(slope) / b));
    step.is_finite().then_some(step)
}

/// A counter-clockwise triangle with its bounding box.
struct Boxed {
    corners: [DVec2; 3],
    low: DVec2,
    high: DVec2,
}

/// Room for the corners of a triangle that was clipped three times, also where rounding makes it a little concave.
type Polygon = [DVec2; 12];

impl Boxed {
    fn new(corners: [DVec2; 3]) -> Self {
        let [p, q, r] = corners;
        Self { corners, low: p.min(q).min(r), high: p.max(q).max(r) }
    }

    /// The area that two triangles share: one is clipped by the other's sides (Sutherland & Hodgman 1974).
    fn overlap(&self, clip: &Self) -> f64 {
        if !(self.low.cmple(clip.high).all() && clip.low.cmple(self.high).all()) {
            return 0.0;
        }
        let mut polygon: Polygon = [DVec2::ZERO; 12];
        polygon[..3].copy_from_slice(&self.corners);
        let mut count = 3;
        for k in 0..3 {
            let from = clip.corners[k];
            let along = clip.corners[(k + 1) % 3] - from;
            count = clipped(&mut polygon, count, |p| along.perp_dot(p - from));
            if count < 3 {
                return 0.0;
            }
        }
        let fan = (1..count - 1).map(|i| signed_double_area(polygon[0], polygon[i], polygon[i + 1]));
        0.5 * max(fan.sum(), 0.0)
    }
}

/// Cuts off the part of a polygon where `side` is negative; the number of corners that are left.
fn clipped(polygon: &mut Polygon, count: usize, side: impl Fn(DVec2) -> f64) -> usize {
    let before = *polygon;
    let mut kept = 0;
    let mut here = side(before[0]);
    for i in 0..count {
        let (a, b) = (before[i], before[if i + 1 == count { 0 } else { i + 1 }]);
        let there = side(b);
        if here >= 0.0 {
            polygon[kept] = a;
            kept += 1;
        }
        if (here >= 0.0) != (there >= 0.0) {
            polygon[kept] = a + (b - a) * (here / (here - there));
            kept += 1;
        }
        here = there;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::Silent;
    use crate::surface_map::certify;
    use crate::surface_map::measures::distortion::{Distortion, distortion};
    use crate::surface_map::overlay::location::locate;
    use crate::surface_map::overlay::overlay;
    use crate::surface_map::relaxation::map_relaxation::tests::{example, sides};
    use crate::surface_map::relaxation::map_relaxation::{MapRelaxationOptions, relax};

    const ENERGY: DentEnergy = DentEnergy { energy: MapEnergy::SMOOTH, brink: 20.0 };

    fn overlaid(sides: [Parametrised<'_>; 2], surface: &ConeSurface) -> (Overlay, Distortion) {
        let overlay = overlay(sides[0], sides[1], &locate(sides[0], sides[1], surface).unwrap()).unwrap();
        let measured = distortion(sides[0], sides[1], &overlay);
        (overlay, measured)
    }

    /// Puts a free vertex next to the middle of a side of its star that it can see, at `distance` of the way; `false` where
    /// there is none.
    fn dent(side: Parametrised<'_>, embedding: &mut Embedding, v: VertexId, distance: f64) -> bool {
        let sheet = &sheets([side, side], &Overlay::default())[0];
        let star = Star::around(sheet, sheet, v);
        let middle = |ray: &Ray| (ray.ring[0] + ray.ring[1]) * 0.5 * (1.0 - distance);
        let places: Vec<DVec2> = star.rays.iter().map(middle).collect();
        let is_free =
            |z: DVec2| star.rays.iter().all(|ray| signed_double_area(z, ray.ring[0], ray.ring[1]) > 0.0);
        let Some(z) = places.into_iter().find(|z| is_free(*z)) else { return false };
        for ray in &star.rays {
            embedding.corners[ray.halfedge] = ray.motion.apply(star.origin + z);
        }
        true
    }

    fn free_vertices(side: Parametrised<'_>) -> impl Iterator<Item = VertexId> {
        let is_free = move |v: &VertexId| !side.landmark_vertices.iter().any(|l| l == v);
        side.mesh.vertices().filter(is_free)
    }

    #[test]
    fn a_dent_is_healed() {
        let (layout, surface, start) = example();
        let options = MapRelaxationOptions::default();
        let relaxed =
            relax(sides(&layout, &start), &surface, &options, &mut Silent).unwrap().into_embeddings();
        let (_, smooth) = overlaid(sides(&layout, &relaxed), &surface);
        let mut healed_dents = 0;
        for k in 0..2 {
            for v in free_vertices(sides(&layout, &relaxed)[k]).step_by(11) {
                let mut dented = relaxed.clone();
                if !dent(sides(&layout, &relaxed)[k], &mut dented[k], v, 1e-3) {
                    continue;
                }
                let (overlay, before) = overlaid(sides(&layout, &dented), &surface);
                assert!(before.max > 1e3, "{}", before.max);
                let around = (&overlay, &*surface);
                let healed =
                    heal(sides(&layout, &dented), around, (&DentOptions::default(), ENERGY)).unwrap();
                let (_, after) = overlaid(sides(&layout, &healed), &surface);
                assert!(after.max < 2.0 * smooth.max.max(ENERGY.brink), "{v:?}: {}", after.max);
                assert!(after.energy < before.energy);
                assert!(sides(&layout, &healed).into_iter().all(|side| certify(side, &surface).bijective));
                healed_dents += 1;
            }
        }
        assert!(healed_dents > 20, "{healed_dents}");
    }

    #[test]
    fn without_a_dent_nothing_moves() {
        let (layout, surface, start) = example();
        let (overlay, measured) = overlaid(sides(&layout, &start), &surface);
        let energy = DentEnergy { brink: 1.01 * measured.max, ..ENERGY };
        let around = (&overlay, &*surface);
        assert!(heal(sides(&layout, &start), around, (&DentOptions::default(), energy)).is_none());
    }

    #[test]
    fn every_star_is_covered_and_its_cost_is_the_integral() {
        let (layout, surface, start) = example();
        let sides = sides(&layout, &start);
        let (overlay, measured) = overlaid(sides, &surface);
        let sheets = sheets(sides, &overlay);
        let energy = DentEnergy { brink: f64::INFINITY, energy: MapEnergy::PLAIN };
        for v in free_vertices(sides[0]) {
            let star = Star::around(&sheets[0], &sheets[1], v);
            assert!(star.is_covered(), "{v:?}");
            let faces: Vec<FaceId> = star.rays.iter().map(|ray| ray.halfedge.face()).collect();
            let pieces = overlay.pieces.iter().zip(&measured.by_piece);
            let there = pieces.filter(|(piece, _)| faces.contains(&piece.source_face));
            let integral: f64 = there
                .map(|(piece, local)| {
                    let area = piece.area / sheets[0].jacobian(piece.source_face).determinant();
                    // E's density: |J|^2 + |J^-1|^2 det J.
                    area * 2.0 * local.angle * (1.0 + local.area)
                })
                .sum();
            let cost = star.cost(DVec2::ZERO, &energy).unwrap();
            assert!((cost - integral).abs() < 1e-6 * integral, "{v:?}: {cost} {integral}");
        }
    }

    #[test]
    fn a_bowl_is_left_for_its_bottom_in_one_step() {
        let (bottom, [xx, xy, yy]) = (DVec2::new(0.3, -0.2), [2.0, 0.5, 1.0]);
        let slope = -DVec2::new(xx * bottom.x + xy * bottom.y, xy * bottom.x + yy * bottom.y);
        assert!(newton(slope, [xx, xy, yy], 10.0).unwrap().abs_diff_eq(bottom, 1e-14));
        // Where it bends down, the step goes down still.
        assert!(newton(slope, [-xx, xy, yy], 10.0).unwrap().dot(slope) < 0.0);
    }

    #[test]
    fn shared_areas_of_known_triangles() {
        let at = |p: [f64; 2], size: f64| {
            let p = DVec2::from(p);
            Boxed::new([p, p + DVec2::new(size, 0.0), p + DVec2::new(0.0, size)])
        };
        let unit = at([0.0, 0.0], 1.0);
        assert_eq!(unit.overlap(&unit), 0.5);
        assert_eq!(unit.overlap(&at([0.25, 0.25], 0.25)), 0.03125);
        assert_eq!(unit.overlap(&at([0.5, 0.0], 1.0)), 0.125);
        assert_eq!(at([0.5, 0.0], 1.0).overlap(&unit), 0.125);
        assert_eq!(unit.overlap(&at([1.0, 1.0], 1.0)), 0.0);
    }

    #[test]
    fn the_ring_of_a_star_closes() {
        let (layout, _, start) = example();
        let side = sides(&layout, &start)[1];
        let sheet = &sheets([side, side], &Overlay::default())[0];
        for v in free_vertices(side) {
            let star = Star::around(sheet, sheet, v);
            for (k, ray) in star.rays.iter().enumerate() {
                let next = &star.rays[(k + 1) % star.rays.len()];
                assert!(ray.ring[1].distance(next.ring[0]) < 1e-9, "{v:?}");
            }
        }
    }
}
