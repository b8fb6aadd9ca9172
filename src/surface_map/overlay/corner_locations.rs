//! The locations of all source corners: the target face that holds the corner's vertex, and the motion to it from the corner's source face.

use super::location::{Location, Locations};
use super::pieces::OverlayError;
use crate::math::rigid2::Rigid2;
use crate::math::{golden, predicates::orient2d};
use crate::mesh::{FaceId, HalfedgeId};
use crate::surface_map::parametrisation::embedding::Parametrised;
use glam::DVec2;
use typed_index_collections::TiVec;

/// Size of the first shift of a source vertex that ends coincidences, in units of its shortest edge on the cone surface. Chosen
/// by hand.
const SHIFT: f64 = 1e-10;
/// Growth of the shift from attempt to attempt: beside the shortest edges the first is lost in rounding. The last of six attempts
/// shifts by 1e-4 of the shortest edge.
const SHIFT_GROWTH: f64 = 30.0;
/// Faces that a point is passed on to, at most, until it lies in one by the exact predicate: those around a vertex. Chosen by
/// hand.
const HOPS: usize = 64;

/// Source and target edges from one landmark to another whose ends differ by less than this share of their length are one line:
/// two straight lines between the same cones go around another cone, or differ by far more; rounding makes 1e-12.
const COINCIDENT: f64 = 1e-6;

/// The target face that holds a source corner, with the motion to its plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct CornerLocation {
    /// The target face. At a landmark: the face into which the source halfedge points.
    pub face: FaceId,
    /// From the plane of the halfedge's source face to that of the target face.
    pub motion: Rigid2,
}

/// Positions of the source's corners, and where they lie on the target.
#[derive(Clone, Debug, Default)]
pub(super) struct CornerLocations {
    /// Corner positions, in the plane of each face, shifted where coincidences had to be ended.
    pub corners: TiVec<HalfedgeId, DVec2>,
    /// The location of the start of each source halfedge.
    pub locations: TiVec<HalfedgeId, CornerLocation>,
    /// For source halfedges that start at a landmark, the target halfedge that begins the wedge into which they point.
    pub wedges: TiVec<HalfedgeId, Option<HalfedgeId>>,
}

impl CornerLocations {
    /// Locates the corners; `attempt` 0 leaves the source where it is, every other one shifts its free vertices in another direction.
    pub fn fill(
        &mut self,
        source: Parametrised<'_>,
        target: Parametrised<'_>,
        locations: &Locations,
        attempt: usize,
    ) -> Result<(), OverlayError> {
        let mesh = source.mesh;
        self.corners.clear();
        self.corners.extend(source.embedding.corners.iter().copied());
        self.wedges.clear();
        self.wedges.resize(mesh.face_count() * 3, None);
        self.locations
            .resize(mesh.face_count() * 3, CornerLocation { face: FaceId(0), motion: Rigid2::IDENTITY });
        for location in &locations.at_landmarks {
            self.wedges[location.corner] = Some(location.corner);
        }
        if attempt > 0 {
            self.shift(source, attempt);
        }
        for location in &locations.at_landmarks {
            self.locate_at_landmark(source, target, location)?;
        }
        self.part_coincident(source, target);
        for (v, location) in locations.by_vertex.iter_enumerated() {
            if self.wedges[mesh.outgoing(v)].is_none() {
                self.locate(source, target, location);
            }
        }
        Ok(())
    }

    /// Whether a source halfedge starts at a landmark.
    pub fn at_landmark(&self, h: HalfedgeId) -> bool {
        self.wedges[h].is_some()
    }

    fn shift(&mut self, source: Parametrised<'_>, attempt: usize) {
        let size = (1..attempt).fold(SHIFT, |size, _| size * SHIFT_GROWTH);
        let mesh = source.mesh;
        for v in mesh.vertices().filter(|&v| self.wedges[mesh.outgoing(v)].is_none()) {
            let first = mesh.outgoing(v);
            let unshifted = &source.embedding.corners;
            let length = |h: HalfedgeId| unshifted[h].distance(unshifted[h.next()]);
            let shortest = mesh.star(v).map(length).fold(f64::INFINITY, f64::min);
            // Other directions for each attempt.
            let mut shift = golden::direction((v.index() + 1) * attempt) * (size * shortest);
            let mut h = first;
            loop {
                self.corners[h] += shift;
                let across = h.prev();
                shift = source.embedding.transitions[across].rotate(shift);
                h = mesh.twin(across);
                if h == first {
                    break;
                }
            }
        }
    }

    /// Locates source edges between two landmarks that coincide with a target edge on its left, at both ends.
    ///
    /// Both edges are the same straight line on the cone surface, and neither end may be moved. Rounding would put the source
    /// edge on the left at one end and on the right at the other, or send its trace around the landmark. So it is taken to lie on
    /// the left by an infinitesimal amount, as in simulation of simplicity (Edelsbrunner & Muecke 1990).
    fn part_coincident(&mut self, source: Parametrised<'_>, target: Parametrised<'_>) {
        for &v in source.landmark_vertices {
            for h in source.mesh.star(v) {
                let twin = source.mesh.twin(h);
                if h < twin
                    && self.at_landmark(twin)
                    && let Some(x) = self.coincident(target, h)
                    && self.coincident(target, twin) == Some(target.mesh.twin(x))
                {
                    self.locate_beside(target, h, x, x);
                    self.locate_beside(target, twin, target.mesh.twin(x), x.next());
                }
            }
        }
    }

    /// The target halfedge on which a source halfedge from landmark to landmark lies: a side of the wedge that it points into.
    fn coincident(&self, target: Parametrised<'_>, h: HalfedgeId) -> Option<HalfedgeId> {
        let wedge = self.wedges[h]?;
        let location = &self.locations[h];
        let [from, to] = [h, h.next()].map(|k| location.motion.apply(self.corners[k]));
        let near = COINCIDENT * to.distance(from);
        let is_head = |x: HalfedgeId| target.embedding.corners[x].distance(to) < near;
        if is_head(wedge.next()) {
            Some(wedge)
        } else {
            is_head(wedge.prev()).then(|| target.mesh.twin(wedge.prev()))
        }
    }

    /// Locates a source halfedge, which coincides with the target halfedge `x`, in the wedge on the left or on the right of it.
    fn locate_beside(&mut self, target: Parametrised<'_>, h: HalfedgeId, x: HalfedgeId, wedge: HalfedgeId) {
        let Some(present) = self.wedges[h].filter(|present| *present != wedge) else { return };
        // From the left of x to its right, or back.
        let across = if present == x { x } else { target.mesh.twin(x) };
        let location = &mut self.locations[h];
        location.motion = target.embedding.transitions[across].after(&location.motion);
        location.face = wedge.face();
        self.wedges[h] = Some(wedge);
    }

    /// Locates all corners of an ordinary vertex.
    fn locate(&mut self, source: Parametrised<'_>, target: Parametrised<'_>, at: &Location) {
        let mesh = source.mesh;
        let mut location = CornerLocation { face: at.face, motion: at.motion };
        let point = self.corners[at.corner];
        for _ in 0..HOPS {
            let Some(h) = outside_of(target, location.face, location.motion.apply(point)) else { break };
            location.motion = target.embedding.transitions[h].after(&location.motion);
            location.face = target.mesh.twin(h).face();
        }
        let mut h = at.corner;
        loop {
            self.locations[h] = location;
            let next = mesh.twin(h.prev());
            // The motion stored there is the inverse of the one needed, and is near in memory.
            if source.embedding.transitions[h.prev()] != Rigid2::IDENTITY {
                location.motion = location.motion.after(&source.embedding.transitions[next]);
            }
            h = next;
            if h == at.corner {
                break;
            }
        }
    }

    /// Locates one corner of a landmark: in the target face into which its halfedge points.
    fn locate_at_landmark(
        &mut self,
        source: Parametrised<'_>,
        target: Parametrised<'_>,
        at: &Location,
    ) -> Result<(), OverlayError> {
        let mesh = target.mesh;
        let v = source.mesh.tail(at.corner);
        let lost = OverlayError::Landmark { vertex: v.index() };
        let landmark = source.landmark_vertices.position(|&other| other == v).ok_or(lost)?;
        let apex = target.landmark_vertices[landmark];
        let mut location = CornerLocation { face: at.face, motion: at.motion };
        let mut wedge = mesh.corner_at(at.face, apex).ok_or(lost)?;
        let along = self.corners[at.corner.next()] - self.corners[at.corner];
        let corner = |x: HalfedgeId| target.embedding.corners[x];
        let mut hops = 0..HOPS;
        let mut cross = |location: &mut CornerLocation, across: HalfedgeId| {
            location.motion = target.embedding.transitions[across].after(&location.motion);
            location.face = mesh.twin(across).face();
            hops.next().ok_or(lost)
        };
        // Clockwise, then counter-clockwise: asked of each border once, so that rounding cannot send it to and fro.
        while (corner(wedge.next()) - corner(wedge)).perp_dot(location.motion.rotate(along)) < 0.0 {
            cross(&mut location, wedge)?;
            wedge = mesh.twin(wedge).next();
        }
        while location.motion.rotate(along).perp_dot(corner(wedge.prev()) - corner(wedge)) <= 0.0 {
            cross(&mut location, wedge.prev())?;
            wedge = mesh.twin(wedge.prev());
        }
        self.locations[at.corner] = location;
        self.wedges[at.corner] = Some(wedge);
        Ok(())
    }
}

/// An edge of a target face that has the point on its right, by the exact predicate.
fn outside_of(target: Parametrised<'_>, face: FaceId, point: DVec2) -> Option<HalfedgeId> {
    let corners = &target.embedding.corners;
    (0..3).map(|k| HalfedgeId::of(face, k)).find(|&h| orient2d(corners[h], corners[h.next()], point) < 0.0)
}
