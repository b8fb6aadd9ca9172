//! The repair of dents: the places where a map is distorted most.
//!
//! A distortion of a thousand on a millionth of the surface hardly changes the integral, yet it limits the length of a Newton
//! step of the whole map. So when a map is relaxed, the vertices of its worst pieces, of either mesh, move once
//! more, one at a time. While a vertex moves within its star, the star as a whole is overlapped by the same few triangles of
//! the other mesh: developed into the vertex' plane they share convex polygons with the star's triangles. Each move
//! lowers the map's energy there and the sixth power of its density, a smooth stand-in for the maximum, by Newton's method
//! in two unknowns, with difference quotients of the logarithm; together they may hardly raise E. The worst vertices come first; one that gains
//! little rests until a vertex beside it moves. Deep dents are looked at once more: where Newton's method gains little, the best of many
//! places is taken. Triangles stay positive, and all other vertices keep their places.

use super::clipping::BoxedTriangle;
use super::covered_star::{CoveredStar, Partner, Sheet, sheets};
use super::dent_energy::DentEnergy;
use crate::landmarks::MeshSide;
use crate::math::scalar::{ln, max};
use crate::math::triangle::signed_double_area;
use crate::mesh::face_weights::is_skin_on_both;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::monitor::{Cancelled, Monitor, Pulse, Step};
use crate::surface_map::measures::distortion::{self, LocalDistortion};
use crate::surface_map::overlay::{Overlay, Piece};
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::{Embedding, Parametrised};
use crate::surface_map::parametrisation::rest_triangle::rest_jacobian;
use glam::{DMat2, DVec2};
use std::collections::{BTreeMap, BTreeSet};
use typed_index_collections::TiVec;

/// Options of the repair of dents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DentOptions {
    /// The density above which a piece is a dent, between two poses of one body.
    pub pose_brink: f64,
    /// The same for other maps, where large distortion may be right.
    pub brink: f64,
    /// Sweeps over the vertices of all dents, at most.
    pub sweeps: usize,
    /// Further sweeps over those of the deepest, with a density above ten times the brink, at most.
    pub deep_sweeps: usize,
    /// The share of all vertices, 0 to 1, that may move in one sweep: those of the worst pieces.
    pub share: f64,
    /// Overlaps of triangles that one vertex may take in a sweep: one with hundreds of neighbours, over thousands of triangles of the other
    /// mesh, is not moved, since it would take minutes.
    pub overlaps: usize,
}

impl Default for DentOptions {
    fn default() -> Self {
        // The brinks: a density of 20 is seen in a texture; other maps may have to distort a limb that the other body lacks.
        // With 12 sweeps over 0.006 of the vertices twice to three times as much of the skin of three pairs of poses kept a density above 20,
        // and E was 0.1 to 0.3 % higher, in the same time within what repetitions differ by. Those 12 took 2 to 6 % of a map's time.
        Self { pose_brink: 20.0, brink: 500.0, sweeps: 30, deep_sweeps: 40, share: 0.02, overlaps: 4_000_000 }
    }
}

/// Overlaps of triangles between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 100_000;

/// Costs of a star that one vertex takes, at most: by Newton's method, and when it is looked round.
const COSTS: [usize; 2] = [40, 400];

/// A vertex that lowers the cost of its star by less than this share rests. Chosen by hand.
const REST: f64 = 5e-3;

/// What all moves that raise E may raise it by together; 4 is an isometry. On maps between poses they raise it by .009 at most. Where a piece
/// is too thin to be seen, the steep cost of its density would spread the dent over all around it: on prisms of slivers E rose from 4 to 9.
const MOST_RAISE: f64 = 0.02;

/// Number of vertices that may move in one sweep even on the smallest meshes. Chosen by hand.
const LEAST: usize = 20;

/// Density above which a dent is deep, in units of the brink. Chosen by hand.
const DEEP: f64 = 10.0;

/// Moves the vertices of the worst pieces; `overlay` is that of both sides. `None` where there is no dent, or nothing helps.
///
/// Positive triangles stay positive, and E grows by .02 at most. Once the monitor wants a result, no second sweep begins.
///
/// # Errors
/// [`Cancelled`].
pub fn heal(
    sides: [Parametrised<'_>; 2],
    surface: &ConeSurface,
    overlay: &Overlay,
    options: &DentOptions,
    energy: DentEnergy,
    monitor: &mut dyn Monitor,
) -> Result<Option<[Embedding; 2]>, Cancelled> {
    monitor.step(Step::default())?;
    let mut healer = Healer {
        sheets: sheets(sides, overlay, monitor)?,
        energy,
        at_rest: BTreeSet::new(),
        has_moved: false,
        raised: 0.0,
    };
    monitor.step(Step::default())?;
    let mut faces = dented(sides, overlay, energy.brink);
    monitor.step(Step::default())?;
    let vertices = sides.iter().map(|side| side.mesh.vertex_count()).sum::<usize>();
    let most = ((options.share * vertices as f64) as usize).max(LEAST);
    let mut swept = false;
    'phases: for (depth, sweeps, looks) in [(1.0, options.sweeps, false), (DEEP, options.deep_sweeps, true)] {
        // What Newton's method does not move may be moved by looking round.
        healer.at_rest.clear();
        for sweep in 0..sweeps {
            if swept && monitor.wants_result() {
                break 'phases;
            }
            let dents = healer.dents(&faces, depth * energy.brink, most);
            if dents.vertices.is_empty() {
                break;
            }
            faces = healer.sweep(dents, looks.then_some(sweep), options.overlaps, monitor)?;
            swept = true;
        }
    }
    Ok(healer.has_moved.then(|| {
        healer.sheets.map(|sheet| {
            let mut embedding = Embedding { corners: sheet.corners, ..sheet.side.embedding.clone() };
            embedding.normalise_anchors(surface);
            embedding
        })
    }))
}

/// The source faces with dents. Pieces that lie in a cap are none: skin that the other mesh lacks is pressed together there.
fn dented(sides: [Parametrised<'_>; 2], overlay: &Overlay, brink: f64) -> BTreeSet<FaceId> {
    let [a, b] =
        sides.map(|side| side.mesh.faces().map(|f| rest_jacobian(side, f)).collect::<TiVec<FaceId, DMat2>>());
    let density = |piece: &Piece| {
        let turn = piece.motion.turn();
        LocalDistortion::of(&(b[piece.target_face].inverse() * turn * a[piece.source_face])).density
    };
    let weights = sides.map(|side| side.weights);
    let is_skin = |piece: &&Piece| is_skin_on_both(weights, [piece.source_face, piece.target_face]);
    let pieces = overlay.pieces.iter().filter(is_skin).filter(|piece| density(piece) > brink);
    pieces.map(|piece| piece.source_face).collect()
}

/// A vertex of one of both meshes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct SheetVertex {
    side: MeshSide,
    vertex: VertexId,
}

/// Dents, with the vertices that may be moved to heal them.
struct Dents {
    /// The source faces with dents.
    faces: BTreeSet<FaceId>,
    /// Vertices of the worst pieces, the worst first.
    vertices: Vec<SheetVertex>,
}

/// The repair of dents under way.
struct Healer<'a> {
    sheets: [Sheet<'a>; 2],
    energy: DentEnergy,
    /// Vertices that do not move any further while nothing moves around them.
    at_rest: BTreeSet<SheetVertex>,
    /// Whether a vertex has moved.
    has_moved: bool,
    /// The sum of what single moves have raised E.
    raised: f64,
}

impl Healer<'_> {
    /// The dents among some source faces, with at most `most` vertices.
    fn dents(&self, faces: &BTreeSet<FaceId>, brink: f64, most: usize) -> Dents {
        let [source, target] = &self.sheets;
        let target_inverse = |t: FaceId| target.jacobian(t).inverse();
        let mut found: BTreeMap<SheetVertex, f64> = BTreeMap::new();
        let mut dented = BTreeSet::new();
        let weights = [source.side.weights, target.side.weights];
        for &s in faces {
            let a = source.jacobian(s);
            for partner in &source.partners[s] {
                let turn = partner.motion.turn();
                let density = LocalDistortion::of(&(target_inverse(partner.face) * turn * a)).density;
                let is_skin = is_skin_on_both(weights, [s, partner.face]);
                if density <= brink || !is_skin || !self.is_certain(s, partner) {
                    continue;
                }
                dented.insert(s);
                let faces = [s, partner.face];
                let corners = |side: MeshSide| {
                    let corners = self.sheets[side].side.mesh.triangles()[faces[side]];
                    corners.map(|vertex| SheetVertex { side, vertex })
                };
                for v in MeshSide::BOTH.map(corners).into_iter().flatten() {
                    if !self.sheets[v.side].is_landmark[v.vertex] && !self.at_rest.contains(&v) {
                        let worst = found.entry(v).or_default();
                        *worst = max(*worst, density);
                    }
                }
            }
        }
        let mut found: Vec<(SheetVertex, f64)> = found.into_iter().collect();
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        found.truncate(most);
        Dents { faces: dented, vertices: found.into_iter().map(|(vertex, _)| vertex).collect() }
    }

    /// Moves the vertices of dents; returns the source faces that may have dents then.
    fn sweep(
        &mut self,
        dents: Dents,
        looks: Option<usize>,
        most: usize,
        monitor: &mut dyn Monitor,
    ) -> Result<BTreeSet<FaceId>, Cancelled> {
        let Dents { mut faces, vertices } = dents;
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        for vertex in vertices {
            let each = self.sheets[vertex.side].overlaps(vertex.vertex);
            let [newton, looking] = COSTS.map(|costs| costs * each);
            if newton > most {
                pulse.beat()?;
                self.at_rest.insert(vertex);
                continue;
            }
            let looks = looks.filter(|_| newton + looking <= most);
            pulse.beat_by(if looks.is_some() { newton + looking } else { newton })?;
            let Some(star) = self.settled(vertex, looks) else {
                self.at_rest.insert(vertex);
                continue;
            };
            self.has_moved = true;
            self.wake(vertex.side, &star);
            match vertex.side {
                MeshSide::Source => faces.extend(star.rays.iter().map(|ray| ray.halfedge.face())),
                MeshSide::Target => faces.extend(star.covers.iter().map(|cover| cover.face)),
            }
        }
        Ok(faces)
    }

    /// Lets the vertices around one that has moved move again.
    fn wake(&mut self, side: MeshSide, star: &CoveredStar) {
        let own = star.rays.iter().map(|ray| (side, ray.halfedge.face()));
        for (side, f) in own.chain(star.covers.iter().map(|cover| (side.other(), cover.face))) {
            for vertex in self.sheets[side].side.mesh.triangles()[f] {
                self.at_rest.remove(&SheetVertex { side, vertex });
            }
        }
    }

    /// Whether the overlap of a source face and its partner is larger than rounding.
    fn is_certain(&self, s: FaceId, partner: &Partner) -> bool {
        let [p, q] = [self.sheets[0].triangle(s), self.sheets[1].triangle(partner.face)];
        let seen = BoxedTriangle::new(p.map(|corner| partner.motion.apply(corner)));
        distortion::is_certain(seen.overlap(&BoxedTriangle::new(q)), [&p, &q])
    }

    /// Moves one vertex to lower the cost of its star; returns the star if it moved. With `looks` it is moved by more than Newton's
    /// method alone ([`CoveredStar::best_seen`]).
    fn settled(
        &mut self,
        SheetVertex { side, vertex }: SheetVertex,
        looks: Option<usize>,
    ) -> Option<CoveredStar> {
        let star = CoveredStar::around(&self.sheets[side], &self.sheets[side.other()], vertex);
        if !star.is_covered {
            return None;
        }
        let start = ln(star.cost(DVec2::ZERO, &self.energy)?);
        let (mut z, mut least) = (DVec2::ZERO, start);
        // Three steps, or fewer where one gains less than 1 %: the vertex comes up again in the next sweep. Chosen by hand.
        for _ in 0..3 {
            let Some(better) = star.improved(z, least, &self.energy) else { break };
            let gained = least - better.log_cost;
            (z, least) = (better.z, better.log_cost);
            if gained < 0.01 {
                break;
            }
        }
        if least > start - REST
            && let Some(better) = looks.and_then(|looks| star.best_seen(z, least, looks, &self.energy))
        {
            (z, least) = (better.z, better.log_cost);
        }
        if least > start - REST {
            return None;
        }
        let plain = |z: DVec2| star.cost(z, &DentEnergy::NONE);
        let raised = self.raised + max(plain(z)? - plain(DVec2::ZERO)?, 0.0);
        if raised > MOST_RAISE || !self.place(side, &star, z) {
            return None;
        }
        self.raised = raised;
        Some(star)
    }

    /// Moves the vertex in the middle of a star; `false`, unchanged, where rounding turns a triangle over.
    fn place(&mut self, side: MeshSide, star: &CoveredStar, z: DVec2) -> bool {
        let corners = &mut self.sheets[side].corners;
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
        self.pair_anew(side, star, z);
        true
    }

    /// Finds the faces of the other mesh that overlap each face of the star, after its vertex has moved.
    fn pair_anew(&mut self, side: MeshSide, star: &CoveredStar, z: DVec2) {
        let own: Vec<FaceId> = star.rays.iter().map(|ray| ray.halfedge.face()).collect();
        for cover in &star.covers {
            self.sheets[side.other()].partners[cover.face].retain(|partner| !own.contains(&partner.face));
        }
        for ray in &star.rays {
            let face = ray.halfedge.face();
            self.sheets[side].partners[face].clear();
            let own = BoxedTriangle::new([z, ray.ring[0], ray.ring[1]]);
            for cover in star.covers.iter().filter(|cover| own.overlap(&cover.triangle) > 0.0) {
                let motion = cover.motion.after(&ray.motion.inverse());
                let is_same = |other: &Partner| other.face == cover.face && other.motion == motion;
                // Of one face there may be several parts.
                if self.sheets[side].partners[face].iter().any(is_same) {
                    continue;
                }
                self.sheets[side].partners[face].push(Partner { face: cover.face, motion });
                self.sheets[side.other()].partners[cover.face]
                    .push(Partner { face, motion: motion.inverse() });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::Silent;
    use crate::surface_map::certify;
    use crate::surface_map::energy::map_energy::MapEnergy;
    use crate::surface_map::measures::distortion::{Distortion, distortion};
    use crate::surface_map::overlay::location::locate;
    use crate::surface_map::overlay::overlay;
    use crate::surface_map::relaxation::covered_star::Ray;
    use crate::surface_map::relaxation::map_relaxation::tests::{example, sides};
    use crate::surface_map::relaxation::map_relaxation::{MapRelaxationOptions, relax};

    const ENERGY: DentEnergy = DentEnergy { energy: MapEnergy::SMOOTH, brink: 20.0 };

    fn overlaid(sides: [Parametrised<'_>; 2], surface: &ConeSurface) -> (Overlay, Distortion) {
        let locations = locate(sides[0], sides[1], surface, &mut Silent).unwrap();
        let overlay = overlay(sides[0], sides[1], &locations, &mut Silent).unwrap();
        let measured = distortion(sides, &overlay, &mut Silent).unwrap();
        (overlay, measured)
    }

    fn covered<'a>(sides: [Parametrised<'a>; 2], surface: &ConeSurface) -> [Sheet<'a>; 2] {
        let (overlay, _) = overlaid(sides, surface);
        sheets(sides, &overlay, &mut Silent).unwrap()
    }

    /// Puts a free vertex next to the middle of a side of its star that it can see, at `distance` of the way; `false` where
    /// there is none.
    fn dent(side: Parametrised<'_>, embedding: &mut Embedding, v: VertexId, distance: f64) -> bool {
        let sheet = &sheets([side, side], &Overlay::default(), &mut Silent).unwrap()[0];
        let star = CoveredStar::around(sheet, sheet, v);
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
                let healed = heal(
                    sides(&layout, &dented),
                    &surface,
                    &overlay,
                    &DentOptions::default(),
                    ENERGY,
                    &mut Silent,
                )
                .unwrap()
                .unwrap();
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
    fn a_vertex_that_would_take_too_long_stays() {
        let (layout, surface, start) = example();
        let (overlay, measured) = overlaid(sides(&layout, &start), &surface);
        let energy = DentEnergy { brink: 0.5 * measured.max, ..ENERGY };
        let healed = |overlaps: usize| {
            let options = DentOptions { overlaps, ..DentOptions::default() };
            heal(sides(&layout, &start), &surface, &overlay, &options, energy, &mut Silent).unwrap()
        };
        assert!(healed(DentOptions::default().overlaps).is_some());
        // A star has three triangles at least, each with a partner.
        assert!(healed(9 * COSTS[0] - 1).is_none());
    }

    #[test]
    fn without_a_dent_nothing_moves() {
        let (layout, surface, start) = example();
        let (overlay, measured) = overlaid(sides(&layout, &start), &surface);
        let energy = DentEnergy { brink: 1.01 * measured.max, ..ENERGY };
        let healed =
            heal(sides(&layout, &start), &surface, &overlay, &DentOptions::default(), energy, &mut Silent);
        assert!(healed.unwrap().is_none());
    }

    #[test]
    fn every_star_is_covered_and_its_cost_is_the_integral() {
        let (layout, surface, start) = example();
        let sides = sides(&layout, &start);
        let (overlay, measured) = overlaid(sides, &surface);
        let sheets = sheets(sides, &overlay, &mut Silent).unwrap();
        let energy = DentEnergy::NONE;
        for v in free_vertices(sides[0]) {
            let star = CoveredStar::around(&sheets[0], &sheets[1], v);
            assert!(star.is_covered, "{v:?}");
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
            // In parts, which are more, the covers are the same, wherever the vertex is.
            let mut cut = CoveredStar::around(&sheets[0], &sheets[1], v);
            cut.cut_covers(&sheets[0], &sheets[1]);
            assert!(cut.covers_add_up() && cut.covers.len() >= star.covers.len(), "{v:?}");
            let places = [DVec2::ZERO, 0.1 * star.rays[0].ring[0], 0.3 * star.rays[1].ring[1]];
            for [whole, parts] in places.map(|z| [&star, &cut].map(|star| star.cost(z, &energy))) {
                assert_eq!(whole.is_some(), parts.is_some());
                let differ =
                    whole.zip(parts).is_some_and(|(whole, parts)| (whole - parts).abs() > 1e-9 * whole);
                assert!(!differ, "{v:?}: {whole:?} {parts:?}");
            }
        }
    }

    #[test]
    fn what_is_seen_is_better_and_within_the_star() {
        let (layout, surface, start) = example();
        let sides = sides(&layout, &start);
        let sheets = covered(sides, &surface);
        let mut found = 0;
        for v in free_vertices(sides[1]).step_by(5) {
            let star = CoveredStar::around(&sheets[1], &sheets[0], v);
            let here = ln(star.cost(DVec2::ZERO, &ENERGY).unwrap());
            for looks in 0..3 {
                let Some(seen) = star.best_seen(DVec2::ZERO, here, looks, &ENERGY) else { continue };
                assert!(seen.log_cost < here, "{v:?}");
                let there = ln(star.cost(seen.z, &ENERGY).unwrap());
                assert!((there - seen.log_cost).abs() < 1e-12, "{v:?}");
                found += 1;
            }
        }
        assert!(found > 10, "{found}");
    }

    #[test]
    fn a_cost_is_known_below_its_bound_alone() {
        let (layout, surface, start) = example();
        let sides = sides(&layout, &start);
        let sheets = covered(sides, &surface);
        for v in free_vertices(sides[0]).step_by(7) {
            let star = CoveredStar::around(&sheets[0], &sheets[1], v);
            let cost = star.cost(DVec2::ZERO, &ENERGY).unwrap();
            for first in 0..star.rays.len() {
                let below = |share: f64| star.cost_below(share * cost, first, DVec2::ZERO, &ENERGY);
                assert!((below(1.001).unwrap() - cost).abs() < 1e-12 * cost, "{v:?}");
                assert!(below(0.999).is_err(), "{v:?}");
            }
        }
    }

    #[test]
    fn the_ring_of_a_star_closes() {
        let (layout, _, start) = example();
        let side = sides(&layout, &start)[1];
        let sheet = &sheets([side, side], &Overlay::default(), &mut Silent).unwrap()[0];
        for v in free_vertices(side) {
            let star = CoveredStar::around(sheet, sheet, v);
            for (k, ray) in star.rays.iter().enumerate() {
                let next = &star.rays[(k + 1) % star.rays.len()];
                assert!(ray.ring[1].distance(next.ring[0]) < 1e-9, "{v:?}");
            }
        }
    }
}
