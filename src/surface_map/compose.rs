//! Composition: source vertices located in the target's triangles on the cone surface.
//!
//! Every face is developed in a plane of its own, so a point of the surface has many names. The names are matched at
//! the landmarks, where the angle around the cone is known on both sides, and carried from vertex to vertex by walking
//! straight along source edges through target triangles: crossing an edge applies its transition.

use super::cone_surface::ConeSurface;
pub use super::embedding::Parametrised;
use super::embedding::{Anchor, Embedding};
use super::fan::{Fan, Wedge};
use crate::math::rigid2::Rigid2;
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, HalfedgeId, SurfacePoint, VertexId};
use glam::DVec2;
use robust::{Coord, orient2d};
use std::collections::VecDeque;
use typed_index_collections::{TiVec, ti_vec};

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
    let mesh = source.mesh;
    let mut found: TiVec<VertexId, Option<Location>> = ti_vec![None; mesh.vertex_count()];
    let mut apexes: TiVec<VertexId, Option<VertexId>> = ti_vec![None; mesh.vertex_count()];
    for (&v, &w) in source.landmark_vertices.iter().zip(target.landmark_vertices) {
        apexes[v] = Some(w);
    }
    let fan = Fan::new(surface, seed);
    let anchors = [source, target].map(|side| side.embedding.anchors[seed]);
    let wedges: Vec<Wedge> = fan.wedges(target, &anchors[1]).collect();
    let v = source.landmark_vertices[seed];
    let first = anchored(&fan, anchors, source, &wedges);
    let mut at_landmarks = Vec::new();
    turn_around_cone(source, target, (first, target.landmark_vertices[seed]), &mut at_landmarks)
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
    let [mesh, below] = [source.mesh, target.mesh];
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
    let mesh = source.mesh;
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
    let mesh = target.mesh;
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
pub(super) fn exit_edge(
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

/// The location of a landmark as seen from the source's anchor: the target face into which the anchor's halfedge points.
fn anchored(fan: &Fan<'_>, anchors: [Anchor; 2], source: Parametrised<'_>, wedges: &[Wedge]) -> Location {
    let corner = anchors[0].corner;
    let corners = &source.embedding.corners;
    let angle = fan.angle(&anchors[0], corners[corner.next()] - corners[corner]);
    let past = |w: &Wedge| (angle - w.begin).rem_euclid(fan.total);
    let outside = |w: &Wedge| (past(w) - w.width).max(0.0);
    let onto = wedges.iter().min_by(|v, w| outside(v).total_cmp(&outside(w))).unwrap_or(&wedges[0]);
    // The same direction's angle on the target differs from that on the source by whole turns.
    let turns = ((onto.begin + past(onto) - angle) / fan.total).round() as i64;
    let motion = onto.motion.after(&fan.between(&anchors[0], &anchors[1], turns));
    Location { corner, face: onto.corner.face(), motion }
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
