//! A level of a mesh with its parametrisation: vertices are removed and restored one at a time, and the level is relaxed in between.
//!
//! Every face has a plane of its own, so that nothing depends on patches. Every star is checked: positive triangles and the right angle
//! sum (positive areas alone admit double covers).

use super::cone_surface::ConeSurface;
use super::embedding::{Anchor, Embedding};
use super::fan::Fan;
use super::problem::{FlatProblem, FlatRelaxOptions, FlatRelaxReport};
use super::rest_triangle::{Corner, FlatTriangle, RestTriangle};
use super::star::{Star, turn_at};
use super::unknowns::sights;
use crate::landmarks::LandmarkId;
use crate::math::barycentric::interpolated;
use crate::math::rigid2::Rigid2;
use crate::math::triangle::signed_double_area;
use crate::mesh::closest_point::closest_in_triangle;
use crate::mesh::coarsening::{self, Level};
use crate::mesh::collapsible::CollapsibleMesh;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::monitor::{Cancelled, Monitor};
use glam::{DVec2, DVec3};
use std::sync::Arc;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// A level of a mesh with its landmarks.
pub struct LandmarkedLevel<'a> {
    /// The connectivity of the level.
    pub mesh: CollapsibleMesh,
    /// Positions of all vertices of the full resolution.
    pub positions: &'a TiSlice<VertexId, DVec3>,
    /// The vertex of each landmark on this level.
    pub landmarks: &'a TiSlice<LandmarkId, VertexId>,
    /// The vertex of each landmark at full resolution: the same one, or one that was removed into it.
    pub heirs: &'a TiSlice<LandmarkId, VertexId>,
}

/// Where a vertex that returns is put.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placing {
    /// Where the energy of its star is low.
    LowEnergy,
    /// The same, but beside slivers where the coarser level maps its position, if that distorts none of them as much: energies weigh
    /// triangles by their areas, and hardly see slivers, which then hinder every step of the relaxation.
    SliversAsMapped,
}

/// A level of a mesh with its parametrisation.
#[derive(Clone)]
pub struct ParametrisedLevel<'a> {
    mesh: CollapsibleMesh,
    positions: &'a TiSlice<VertexId, DVec3>,
    surface: Arc<ConeSurface>,
    is_landmark: TiVec<VertexId, bool>,
    /// Whether each vertex becomes a landmark in place of its neighbour when it returns.
    is_heir: TiVec<VertexId, bool>,
    corners: TiVec<HalfedgeId, DVec2>,
    transitions: TiVec<HalfedgeId, Rigid2>,
    anchors: TiVec<LandmarkId, Anchor>,
    star: Star,
}

/// A level as a mesh of its own with its parametrisation.
pub struct Snapshot {
    /// The mesh.
    pub level: Level,
    /// Its parametrisation.
    pub embedding: Embedding,
}

impl<'a> ParametrisedLevel<'a> {
    /// A level with anchored landmarks. Its corners and transitions have no values yet: [`ParametrisedLevel::set`] gives them
    /// to each live halfedge.
    pub fn new(
        level: LandmarkedLevel<'a>,
        surface: Arc<ConeSurface>,
        anchors: TiVec<LandmarkId, Anchor>,
    ) -> Self {
        let LandmarkedLevel { mesh, positions, landmarks, heirs } = level;
        let slots = mesh.face_slots() * 3;
        let mut is_landmark = ti_vec![false; positions.len()];
        landmarks.iter().for_each(|&v| is_landmark[v] = true);
        let mut is_heir = ti_vec![false; positions.len()];
        heirs.iter().for_each(|&v| is_heir[v] = !is_landmark[v]);
        Self {
            mesh,
            positions,
            surface,
            is_landmark,
            is_heir,
            corners: ti_vec![DVec2::ZERO; slots],
            transitions: ti_vec![Rigid2::IDENTITY; slots],
            anchors,
            star: Star::default(),
        }
    }

    /// The same parametrisation on a level of a finer mesh whose faces correspond: `halfedge` gives the level's halfedge of
    /// each one of the embedding.
    pub fn on_level(
        level: LandmarkedLevel<'a>,
        surface: Arc<ConeSurface>,
        embedding: &Embedding,
        halfedge: impl Fn(HalfedgeId) -> HalfedgeId,
    ) -> Self {
        let anchor = |a: &Anchor| Anchor { corner: halfedge(a.corner), ..*a };
        let anchors = embedding.anchors.iter().map(anchor).collect();
        let mut level = Self::new(level, surface, anchors);
        for h in embedding.corners.keys() {
            level.corners[halfedge(h)] = embedding.corners[h];
            level.transitions[halfedge(h)] = embedding.transitions[h];
        }
        level
    }

    /// The connectivity of the present level.
    pub fn mesh(&self) -> &CollapsibleMesh {
        &self.mesh
    }

    /// Positions of all vertices of the full resolution.
    pub fn positions(&self) -> &'a TiSlice<VertexId, DVec3> {
        self.positions
    }

    /// The present vertex of each landmark.
    pub fn landmark_vertices(&self) -> TiVec<LandmarkId, VertexId> {
        self.anchors.iter().map(|anchor| self.mesh.tail(anchor.corner)).collect()
    }

    /// Number of vertices of the full resolution.
    pub fn full_vertices(&self) -> usize {
        self.positions.len()
    }

    /// Whether the level has all vertices of the full resolution.
    pub fn is_full(&self) -> bool {
        self.mesh.live_vertices() == self.full_vertices()
    }

    /// Sets the corner at the start of a face's halfedge, and the transition across that halfedge.
    pub fn set(&mut self, h: HalfedgeId, corner: DVec2, transition: Rigid2) {
        self.corners[h] = corner;
        self.transitions[h] = transition;
    }

    /// The present level as a mesh of its own with its parametrisation.
    pub fn snapshot(&self) -> Snapshot {
        let level = Level::of(&self.mesh, self.positions);
        let mut number: TiVec<FaceId, FaceId> = ti_vec![FaceId(u32::MAX); self.mesh.face_slots()];
        level.faces.iter_enumerated().for_each(|(small, &full)| number[full] = small);
        let full = |h: HalfedgeId| HalfedgeId::of(level.faces[h.face()], h.corner());
        let anchor =
            |a: &Anchor| Anchor { corner: HalfedgeId::of(number[a.corner.face()], a.corner.corner()), ..*a };
        let embedding = Embedding {
            corners: level.mesh.halfedges().map(|h| self.corners[full(h)]).collect(),
            transitions: Arc::new(level.mesh.halfedges().map(|h| self.transitions[full(h)]).collect()),
            anchors: Arc::new(self.anchors.iter().map(anchor).collect()),
        };
        Snapshot { level, embedding }
    }

    /// Takes the corners of a snapshot of this level that was relaxed elsewhere.
    pub fn adopt(&mut self, level: &Level, embedding: &Embedding) {
        for h in level.mesh.halfedges() {
            self.corners[HalfedgeId::of(level.faces[h.face()], h.corner())] = embedding.corners[h];
        }
        for (anchor, relaxed) in self.anchors.iter_mut().zip(embedding.anchors.iter()) {
            let corner = relaxed.corner;
            *anchor =
                Anchor { corner: HalfedgeId::of(level.faces[corner.face()], corner.corner()), ..*relaxed };
        }
    }

    /// Removes the start of `h` by collapsing `h` onto its end; `false`, with nothing changed, where a triangle would turn over.
    ///
    /// `h` must satisfy the link condition.
    pub fn remove(&mut self, h: HalfedgeId) -> bool {
        self.look_around(h);
        let count = self.star.halfedges.len();
        let end = self.star.ring[0];
        // The fan of the end over the ring, which leaves out the two faces beside h.
        let mut angle = 0.0;
        for k in 1..count - 1 {
            let (p, q) = (self.star.ring[k], self.star.ring[k + 1]);
            // The sine of the angle at the end: a triangle flatter than that may be turned over by rounding.
            if signed_double_area(end, p, q) <= 1e-12 * (p - end).length() * (q - end).length() {
                return false;
            }
            angle += turn_at(end, p, q);
        }
        let start = self.corners[h];
        let before = turn_at(end, self.star.ring[1], start) + turn_at(end, start, self.star.ring[count - 1]);
        // Another angle differs by a whole turn; the bound only has to be above rounding.
        if (angle - before).abs() > 1e-6 {
            return false;
        }
        for k in 1..count - 1 {
            self.corners[self.star.halfedges[k]] = self.star.motions[k].apply(end);
        }
        self.collapse(h);
        true
    }

    /// Collapses `h`: the planes on the far sides of the two faces are joined.
    fn collapse(&mut self, h: HalfedgeId) {
        let t = self.mesh.twin(h);
        self.move_anchors_off([h.face(), t.face()], h);
        for (near, far) in [(h.prev(), h.next()), (t.next(), t.prev())] {
            let (near, outer) = (self.mesh.twin(near), self.mesh.twin(far));
            let through = self.transitions[far].after(&self.transitions[near]);
            self.transitions[near] = through;
            self.transitions[outer] = through.inverse();
        }
        self.mesh.collapse(h);
    }

    /// Anchors on two faces that are about to vanish move on around their landmarks.
    fn move_anchors_off(&mut self, vanishing: [FaceId; 2], h: HalfedgeId) {
        let corners = [h.next(), h.prev(), self.mesh.twin(h).prev()];
        for v in corners.map(|c| self.mesh.tail(c)).into_iter().filter(|&v| self.is_landmark[v]) {
            let landmark = self.landmark_at(v);
            let Some(landmark) = landmark else { continue };
            let mut anchor = self.anchors[landmark];
            let mut angle = self.angle(landmark, &anchor);
            while vanishing.contains(&anchor.corner.face()) {
                angle += self.width(anchor.corner);
                let across = anchor.corner.prev();
                anchor.corner = self.mesh.twin(across);
                anchor.motion = self.transitions[across].after(&anchor.motion);
            }
            self.anchors[landmark] = Fan::new(&self.surface, landmark).recharted(&anchor, angle);
        }
    }

    fn normalise_anchors(&mut self) {
        for landmark in self.anchors.keys() {
            let anchor = self.anchors[landmark];
            let angle = self.angle(landmark, &anchor);
            self.anchors[landmark] = Fan::new(&self.surface, landmark).recharted(&anchor, angle);
        }
    }

    fn landmark_at(&self, v: VertexId) -> Option<LandmarkId> {
        self.anchors.position(|a| self.mesh.tail(a.corner) == v)
    }

    /// The angle of an anchor's halfedge around its cone.
    fn angle(&self, landmark: LandmarkId, anchor: &Anchor) -> f64 {
        let edge = self.corners[anchor.corner.next()] - self.corners[anchor.corner];
        Fan::new(&self.surface, landmark).angle(anchor, edge)
    }

    /// The angle of a face at the start of a halfedge.
    fn width(&self, h: HalfedgeId) -> f64 {
        turn_at(self.corners[h], self.corners[h.next()], self.corners[h.prev()])
    }

    /// Restores the vertex that was removed last, without a place yet.
    fn restore(&mut self) -> Option<Restored> {
        let collapse = self.mesh.restore()?;
        let h = collapse.halfedge;
        let t = self.mesh.twin(h);
        let end = self.mesh.head(h);
        let (first, last) = (self.mesh.twin(h.prev()), self.mesh.twin(t.next()));
        // The two faces come back in the planes of their neighbours in the star.
        for (face, near, far) in [(h, first, h.next()), (t, last, t.prev())] {
            let out = self.transitions[near];
            self.transitions[far] = out;
            let back = self.mesh.twin(far);
            self.transitions[back] = out.inverse();
            self.transitions[near] = Rigid2::IDENTITY;
            let inner = self.mesh.twin(near);
            self.transitions[inner] = Rigid2::IDENTITY;
            debug_assert_eq!(inner.face(), face.face());
        }
        self.corners[h.next()] = self.corners[first];
        self.corners[h.prev()] = self.corners[first.next()];
        // `last` runs from the right face's apex to the vertex, `last.next()` starts at the vertex, where the end was.
        self.corners[t] = self.corners[last.next()];
        self.corners[t.prev()] = self.corners[last];
        let mut motion = Rigid2::IDENTITY;
        let mut g = first;
        while g.face() != last.face() {
            motion = self.transitions[g.prev()].after(&motion);
            g = self.mesh.twin(g.prev());
        }
        self.transitions[h] = motion;
        self.transitions[t] = motion.inverse();
        let landmark = if self.is_landmark[end] { self.landmark_at(collapse.removed) } else { None };
        let moved = landmark.map(|landmark| (landmark, self.anchors[landmark]));
        if let Some(landmark) = landmark {
            self.anchor_again(landmark, h);
        }
        Some(Restored { vertex: collapse.removed, moved })
    }

    /// Removes again a vertex that was restored without a place.
    fn remove_again(&mut self, restored: Restored) {
        self.collapse(self.mesh.outgoing(restored.vertex));
        if let Some((landmark, anchor)) = restored.moved {
            self.anchors[landmark] = anchor;
        }
    }

    /// An anchor that was handed to the restored vertex goes back to its landmark, the end of `h`.
    fn anchor_again(&mut self, landmark: LandmarkId, h: HalfedgeId) {
        let mut anchor = self.anchors[landmark];
        let mut angle = self.angle(landmark, &anchor);
        let mut g = anchor.corner;
        // Clockwise around the restored vertex to the face on the left of h. The corners are still those of the landmark.
        while g != h {
            anchor.motion = self.transitions[g].after(&anchor.motion);
            g = self.mesh.twin(g).next();
            if g != h {
                angle -= self.width(g);
            }
        }
        anchor.corner = h.next();
        self.anchors[landmark] = Fan::new(&self.surface, landmark).recharted(&anchor, angle);
    }

    /// Restores the vertex that was removed last and puts it into the kernel of its star; `None` at full resolution.
    ///
    /// # Errors
    /// [`NoPlace`] where its star has no kernel; the vertex is removed again.
    pub fn refine(&mut self, placing: Placing) -> Option<Result<VertexId, NoPlace>> {
        let restored = self.restore()?;
        let v = restored.vertex;
        let h = self.mesh.outgoing(v);
        if self.is_heir[v] {
            return Some(self.hand_over(restored));
        }
        self.look_around(h);
        let low = self.place(v);
        let place = match placing {
            Placing::LowEnergy => low,
            Placing::SliversAsMapped => self.place_as_mapped(v, low).or(low),
        };
        let Some(place) = place else {
            self.remove_again(restored);
            return Some(Err(NoPlace));
        };
        for (g, motion) in self.star.halfedges.iter().zip(&self.star.motions) {
            self.corners[*g] = motion.apply(place);
        }
        Some(Ok(v))
    }

    /// Fills the star with the ring around the start of `h`, from `h` on.
    fn look_around(&mut self, h: HalfedgeId) {
        let star = &mut self.star;
        star.halfedges.clear();
        star.motions.clear();
        star.ring.clear();
        let (mut motion, mut g) = (Rigid2::IDENTITY, h);
        loop {
            star.halfedges.push(g);
            star.motions.push(motion);
            star.ring.push(motion.inverse().apply(self.corners[g.next()]));
            motion = self.transitions[g.prev()].after(&motion);
            g = self.mesh.twin(g.prev());
            if g == h {
                break;
            }
        }
    }

    /// A place of low energy for the vertex in the middle of the star, in the plane of its first face; `None` where the star has no
    /// kernel.
    fn place(&mut self, v: VertexId) -> Option<DVec2> {
        let Self { mesh, positions, star, .. } = self;
        star.triangles.clear();
        let count = star.halfedges.len();
        for (k, &h) in star.halfedges.iter().enumerate() {
            let ring = [star.ring[k], star.ring[(k + 1) % count]];
            let corners = [Corner::Free(0, Rigid2::IDENTITY), Corner::Fixed(ring[0]), Corner::Fixed(ring[1])];
            let rest = [v, mesh.head(h), mesh.tail(h.prev())].map(|w| positions[w]);
            star.triangles.push(FlatTriangle::with_rest(corners, rest));
        }
        let centre = star.kernel.centroid(&star.ring)?;
        let z = star.improved(centre);
        star.turns_once(z).then_some(z)
    }

    /// Where the coarser level maps the position of the vertex in the middle of the star; `None` where it has no sliver around it, or is
    /// placed with less distortion at `low`. The star is filled with its triangles.
    fn place_as_mapped(&self, v: VertexId, low: Option<DVec2>) -> Option<DVec2> {
        let Self { mesh, positions, star, .. } = self;
        if !star.halfedges.iter().any(|h| coarsening::is_sliver(mesh, h.face(), positions)) {
            return None;
        }
        let ring = |k: usize| positions[mesh.head(star.halfedges[k])];
        // On the coarser level the star's faces lay in a fan around the end of the collapse, the first of the ring.
        let on_fan = |k: usize| {
            let corners = [ring(0), ring(k), ring(k + 1)];
            let weights = closest_in_triangle(positions[v], corners);
            let apart = interpolated(corners, weights).distance_squared(positions[v]);
            let [a, b, c] = weights;
            (apart, star.ring[0] * a + star.ring[k] * b + star.ring[k + 1] * c)
        };
        let fan = (1..star.halfedges.len() - 1).map(on_fan);
        let (_, place) = fan.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let is_better = low.is_none_or(|low| star.worst(place) < star.worst(low));
        (is_better && star.turns_once(place)).then_some(place)
    }

    /// Lowers the energy of the present level.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn relax(
        &mut self,
        options: &FlatRelaxOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<FlatRelaxReport, Cancelled> {
        let Self { mesh, positions, .. } = self;
        let rest: Vec<RestTriangle> =
            mesh.faces().map(|f| RestTriangle::of(mesh.corners(f).map(|v| positions[v]))).collect();
        self.relax_to(&rest, options, monitor)
    }

    /// Lowers the energy towards other rest shapes, one per face of the present level in order.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn relax_to(
        &mut self,
        rest: &[RestTriangle],
        options: &FlatRelaxOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<FlatRelaxReport, Cancelled> {
        let free: Vec<VertexId> = self.mesh.vertices().filter(|&v| !self.is_landmark[v]).collect();
        let sights = sights(free.iter().map(|&v| self.mesh.star(v)), &self.corners, &self.transitions);
        let mut z: Vec<DVec2> = free.iter().map(|&v| self.corners[self.mesh.outgoing(v)]).collect();
        let triangle = |(f, rest): (FaceId, &RestTriangle)| {
            let corners = f.halfedges().map(|h| sights[h]);
            FlatTriangle { area: rest.weight, ..FlatTriangle::with_rest(corners, rest.corners) }
        };
        let triangles = self.mesh.faces().zip(rest).map(triangle).collect();
        let mut problem = FlatProblem::new(triangles, z.len(), monitor)?;
        let report = problem.relax(&mut z, options, monitor)?;
        for f in self.mesh.faces() {
            for h in f.halfedges() {
                self.corners[h] = sights[h].position(&z);
            }
        }
        self.normalise_anchors();
        Ok(report)
    }
}

mod heirs;

/// A vertex that was restored without a place.
struct Restored {
    vertex: VertexId,
    /// The landmark beside it whose anchor was moved, with the anchor as it was.
    moved: Option<(LandmarkId, Anchor)>,
}

/// The error where the star of a vertex has no kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoPlace;
