//! Composition: source vertices located in the target's triangles on the cone surface.
//!
//! Every face is developed in the plane of its patch, so a point of the surface has many names. The names are matched at
//! the landmarks, where the angle around the cone is known on both sides, and carried from vertex to vertex by walking
//! straight along source edges through target triangles: crossing an edge applies its transition.

use super::cone_surface::ConeSurface;
use super::embedding::Embedding;
use crate::layout::PatchedMesh;
use crate::math::rigid2::Rigid2;
use crate::math::scalar::atan2;
use crate::math::triangle::{angle_at, angle_from_lengths, signed_double_area};
use crate::mesh::{FaceId, HalfedgeId, SurfacePoint, VertexId};
use glam::DVec2;
use robust::{Coord, orient2d};
use std::collections::VecDeque;
use typed_index_collections::{TiVec, ti_vec};

/// A patched mesh with its parametrisation onto the common cone surface.
#[derive(Clone, Copy, Debug)]
pub struct Parametrised<'a> {
    /// The refined mesh.
    pub patched: &'a PatchedMesh,
    /// Its certified parametrisation.
    pub embedding: &'a Embedding,
}

/// Where a source corner lies among the target's triangles.
#[derive(Clone, Copy, Debug)]
pub struct Location {
    /// The source halfedge whose start is located; the motion is that of its face.
    pub corner: HalfedgeId,
    /// The target face that contains the point.
    pub face: FaceId,
    /// From the chart plane of the corner's source face to the chart plane of the target face.
    pub motion: Rigid2,
}

/// All source vertices among the target's triangles.
#[derive(Clone, Debug)]
pub struct Locations {
    /// By source vertex.
    pub by_vertex: TiVec<VertexId, Location>,
    /// Every source corner at a landmark: the target face is that into which the corner's halfedge points.
    pub at_landmarks: Vec<Location>,
}

/// A walk that did not arrive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("source vertex {vertex} was not found on the target: the walk did not arrive")]
pub struct LocateError {
    /// The source vertex of the refined mesh.
    pub vertex: usize,
}

/// Locates every source vertex on the target.
///
/// Both sides must be certified parametrisations onto `surface`.
///
/// # Errors
/// [`LocateError`] where a walk does not arrive, which certified input rules out but for rounding.
pub fn locate(
    source: Parametrised<'_>,
    target: Parametrised<'_>,
    surface: &ConeSurface,
) -> Result<Locations, LocateError> {
    let mut result = Err(LocateError { vertex: 0 });
    for seed in surface.base.mesh.vertices() {
        result = locate_from(source, target, (surface, seed));
        if result.is_ok() {
            break;
        }
    }
    result
}

/// Locates everything from one landmark.
///
/// The angle of an edge around a cone is known up to whole turns of its plane only. Where the turn of the first landmark
/// is mistaken, the others are not met and the next one is tried; the turns at all others follow.
fn locate_from(
    source: Parametrised<'_>,
    target: Parametrised<'_>,
    (surface, seed): (&ConeSurface, VertexId),
) -> Result<Locations, LocateError> {
    let mesh = &source.patched.mesh;
    let mut found: TiVec<VertexId, Option<Location>> = ti_vec![None; mesh.vertex_count()];
    let mut apexes: TiVec<VertexId, Option<VertexId>> = ti_vec![None; mesh.vertex_count()];
    for (&v, &w) in source.patched.landmark_vertices.iter().zip(&target.patched.landmark_vertices) {
        apexes[v] = Some(w);
    }
    let fan = Fan::new(surface, seed);
    let wedges = fan.wedges(surface, target, target.patched.landmark_vertices[seed]);
    let v = source.patched.landmark_vertices[seed];
    let first = fan.anchor(surface, source, mesh.outgoing(v), &wedges);
    let mut at_landmarks = Vec::new();
    turn_around_cone(source, target, (first, target.patched.landmark_vertices[seed]), &mut at_landmarks)
        .ok_or(LocateError { vertex: v.index() })?;
    found[v] = Some(first);
    let mut queue: VecDeque<Location> = at_landmarks.iter().copied().collect();
    while let Some(location) = queue.pop_front() {
        let next = mesh.head(location.corner);
        if found[next].is_some() {
            continue;
        }
        let lost = LocateError { vertex: next.index() };
        let arrived = walk(source, target, location).ok_or(lost)?;
        if let Some(apex) = apexes[next] {
            let begin = at_landmarks.len();
            turn_around_cone(source, target, (arrived, apex), &mut at_landmarks).ok_or(lost)?;
            queue.extend(&at_landmarks[begin..]);
        } else {
            queue.extend(turn_around(source, arrived));
        }
        found[next] = Some(arrived);
    }
    let complete = |(v, l): (usize, Option<Location>)| l.ok_or(LocateError { vertex: v });
    let by_vertex = found.into_iter().enumerate().map(complete).collect::<Result<_, _>>()?;
    Ok(Locations { by_vertex, at_landmarks })
}

/// The locations of all corners of a landmark, given one of them in any target face around the landmark's image `apex`.
///
/// `None` where that face is not at the apex, or the apex is not met after a turn.
fn turn_around_cone(
    source: Parametrised<'_>,
    target: Parametrised<'_>,
    (at, apex): (Location, VertexId),
    all: &mut Vec<Location>,
) -> Option<()> {
    const MOST: usize = 1000;
    let [mesh, below] = [&source.patched.mesh, &target.patched.mesh];
    let corner = |x: HalfedgeId| target.embedding.corners[x];
    let mut wedge = (0..3).map(|k| HalfedgeId::of(at.face, k)).find(|&x| below.tail(x) == apex)?;
    let image = at.motion.apply(source.embedding.corners[at.corner]);
    if image.distance(corner(wedge)) > 1e-9 {
        return None;
    }
    let mut here = at;
    let mut hops = 0..MOST;
    let edge = |x: HalfedgeId| source.embedding.corners[x.next()] - source.embedding.corners[x];
    let mut cross = |here: &mut Location, across: HalfedgeId| {
        here.motion = target.embedding.transitions[across].after(&here.motion);
        here.face = below.twin(across).face();
        hops.next()
    };
    // The edge points less than half a turn away from where the walk came from: first clockwise, then, from edge to edge,
    // counter-clockwise.
    while (corner(wedge.next()) - corner(wedge)).perp_dot(here.motion.rotate(edge(here.corner))) < 0.0 {
        cross(&mut here, wedge)?;
        wedge = below.twin(wedge).next();
    }
    loop {
        while here.motion.rotate(edge(here.corner)).perp_dot(corner(wedge.prev()) - corner(wedge)) <= 0.0 {
            cross(&mut here, wedge.prev())?;
            wedge = below.twin(wedge.prev());
        }
        all.push(here);
        here.corner = mesh.twin(here.corner.prev());
        here.motion = here.motion.after(&source.embedding.transitions[here.corner]);
        if here.corner == at.corner {
            return Some(());
        }
    }
}

/// The same location as seen from every face around the vertex (not a cone: the motions agree all around).
fn turn_around(source: Parametrised<'_>, at: Location) -> impl Iterator<Item = Location> + '_ {
    let mesh = &source.patched.mesh;
    let mut next = Some(at);
    std::iter::from_fn(move || {
        let here = next?;
        let across = here.corner.prev();
        let corner = mesh.twin(across);
        let motion = here.motion.after(&source.embedding.transitions[corner]);
        next = (corner != at.corner).then_some(Location { corner, face: here.face, motion });
        Some(here)
    })
}

/// Walks along the edge of the location's corner to its end.
fn walk(source: Parametrised<'_>, target: Parametrised<'_>, from: Location) -> Option<Location> {
    let end = source.embedding.corners[from.corner.next()];
    let arrived = walk_to(source, target, from, end)?;
    Some(Location { corner: from.corner.next(), ..arrived })
}

/// Walks straight from the location to a point in the plane of its source face.
fn walk_to(
    source: Parametrised<'_>,
    target: Parametrised<'_>,
    from: Location,
    end: DVec2,
) -> Option<Location> {
    let start = source.embedding.corners[from.corner];
    let mesh = &target.patched.mesh;
    let (mut face, mut motion) = (from.face, from.motion);
    let mut entered = None;
    for _ in 0..mesh.face_count() + 1000 {
        let (p, q) = (motion.apply(start), motion.apply(end));
        let Some(exit) = exit_edge(target.embedding, face, [p, q], entered) else {
            return Some(Location { corner: from.corner, face, motion });
        };
        motion = target.embedding.transitions[exit].after(&motion);
        let twin = mesh.twin(exit);
        face = twin.face();
        entered = Some(twin);
    }
    None
}

/// The edge through which the segment p q leaves a triangle; `None` when it ends inside.
fn exit_edge(
    embedding: &Embedding,
    face: FaceId,
    [p, q]: [DVec2; 2],
    entered: Option<HalfedgeId>,
) -> Option<HalfedgeId> {
    let mut fallback = None;
    for k in 0..3 {
        let h = HalfedgeId::of(face, k);
        let (a, b) = (embedding.corners[h], embedding.corners[h.next()]);
        if Some(h) == entered || !clearly_outside(a, b, q) {
            continue;
        }
        if side(p, q, a) <= 0.0 && side(p, q, b) >= 0.0 {
            return Some(h);
        }
        fallback.get_or_insert(h);
    }
    fallback
}

/// Whether q lies to the right of a b by more than rounding.
fn clearly_outside(a: DVec2, b: DVec2, q: DVec2) -> bool {
    side(a, b, q) < -1e-14 * (b - a).length().max(1e-3) && side(a, b, q) < 0.0
}

/// Positive when r lies to the left of p q (robust).
fn side(p: DVec2, q: DVec2, r: DVec2) -> f64 {
    let [p, q, r] = [p, q, r].map(|c| Coord { x: c.x, y: c.y });
    orient2d(p, q, r)
}

/// The base faces around a landmark with the angle at which each begins.
struct Fan {
    /// Base halfedges that start at the landmark, counter-clockwise, with the angle of each from the first.
    halfedges: Vec<(HalfedgeId, f64)>,
    total: f64,
}

/// A target face at a landmark with the interval of angles that it covers.
struct Wedge {
    corner: HalfedgeId,
    begin: f64,
    width: f64,
    /// Place of its chart in the fan.
    place: usize,
}

impl Fan {
    fn new(surface: &ConeSurface, landmark: VertexId) -> Self {
        let mut total = 0.0;
        let mut halfedges = Vec::new();
        for h in surface.base.mesh.star(landmark) {
            halfedges.push((h, total));
            let lengths = [h, h.prev()].map(|x| surface.lengths[x]);
            total += angle_from_lengths(surface.lengths[h.next()], lengths);
        }
        Self { halfedges, total }
    }

    /// Place in the fan of the chart of a face at the landmark, and the angle of one of its edges there.
    fn angle(&self, surface: &ConeSurface, side: Parametrised<'_>, corner: HalfedgeId) -> (usize, f64) {
        let chart = side.embedding.face_chart[corner.face()];
        let place = self.halfedges.iter().position(|(h, _)| h.face() == chart).unwrap_or(0);
        let (base, begin) = self.halfedges[place];
        let corners = surface.charts[chart];
        let axis = corners[base.next().corner()] - corners[base.corner()];
        let edge = side.embedding.corners[corner.next()] - side.embedding.corners[corner];
        (place, begin + atan2(axis.perp_dot(edge), axis.dot(edge)))
    }

    fn wedges(&self, surface: &ConeSurface, target: Parametrised<'_>, v: VertexId) -> Vec<Wedge> {
        let wedge = |corner: HalfedgeId| {
            let corners = [corner, corner.next(), corner.prev()];
            let [p, q, r] = corners.map(|c| target.embedding.corners[c].extend(0.0));
            let (place, begin) = self.angle(surface, target, corner);
            Wedge { corner, begin, width: angle_at(p, q, r), place }
        };
        target.patched.mesh.star(v).map(wedge).collect()
    }

    /// The location of the landmark as seen from a source face: the target face into which its first edge points.
    fn anchor(
        &self,
        surface: &ConeSurface,
        source: Parametrised<'_>,
        corner: HalfedgeId,
        wedges: &[Wedge],
    ) -> Location {
        let (place, angle) = self.angle(surface, source, corner);
        let past = |w: &Wedge| (angle - w.begin).rem_euclid(self.total);
        let inside = wedges
            .iter()
            .min_by(|v, w| (past(v) - v.width).max(0.0).total_cmp(&(past(w) - w.width).max(0.0)));
        let wedge = inside.unwrap_or(&wedges[0]);
        // Turn from the source's chart to the target's by the difference of their true angles, whole turns included.
        let turn = wedge.begin + past(wedge) - angle;
        let turns = (turn / self.total).round() as i64;
        let motion = self.motion(surface, place, wedge.place as i64 - turns * self.halfedges.len() as i64);
        Location { corner, face: wedge.corner.face(), motion }
    }

    /// The motion from the chart at `place` to the chart at place `to`, counted on and on around the cone.
    fn motion(&self, surface: &ConeSurface, place: usize, to: i64) -> Rigid2 {
        let n = self.halfedges.len() as i64;
        let mut motion = Rigid2::IDENTITY;
        let mut at = place as i64;
        while at < to {
            // Counter-clockwise: out through the side that ends at the landmark.
            let h = self.halfedges[at.rem_euclid(n) as usize].0.prev();
            motion = surface.transitions[h].after(&motion);
            at += 1;
        }
        while at > to {
            let h = self.halfedges[at.rem_euclid(n) as usize].0;
            motion = surface.transitions[h].after(&motion);
            at -= 1;
        }
        motion
    }
}

/// The barycentric coordinates of the located corner in its target face, clamped to it.
pub fn barycentric(source: Parametrised<'_>, target: Parametrised<'_>, at: &Location) -> SurfacePoint {
    let q = at.motion.apply(source.embedding.corners[at.corner]);
    let corners = [0, 1, 2].map(|k| target.embedding.corners[HalfedgeId::of(at.face, k)]);
    SurfacePoint { face: at.face, barycentric: barycentric_in(corners, q) }
}

/// Barycentric coordinates of q in a triangle, clamped to it.
pub fn barycentric_in([a, b, c]: [DVec2; 3], q: DVec2) -> [f64; 3] {
    let weights = [signed_double_area(q, b, c), signed_double_area(q, c, a), signed_double_area(q, a, b)];
    let clamped = weights.map(|w| w.max(0.0));
    let sum: f64 = clamped.iter().sum();
    clamped.map(|w| w / sum)
}
