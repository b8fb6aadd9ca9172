//! Source vertices located in the target's triangles on the cone surface.
//!
//! Every face lies in a plane of its own, so a point of the surface has other coordinates in each. The planes of source and target are
//! matched at a landmark, where the angle around the cone is known on both meshes, and from vertex to vertex by walking
//! straight along source edges through target triangles: crossing an edge applies its transition.

use crate::landmarks::LandmarkId;
use crate::math::barycentric;
use crate::math::predicates::orient2d;
use crate::math::rigid2::Rigid2;
use crate::math::scalar::max;
use crate::mesh::{FaceId, HalfedgeId, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, OrStop, Pulse};
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::{Anchor, Embedding, Parametrised};
use crate::surface_map::parametrisation::fan::{Fan, Wedge};
use glam::DVec2;
use typed_index_collections::TiVec;

/// The location of a source corner in a target triangle.
#[derive(Clone, Copy, Debug)]
pub struct Location {
    /// The source halfedge whose start is located; the motion is that of its face.
    pub corner: HalfedgeId,
    /// The target face that contains the point.
    pub face: FaceId,
    /// From the chart plane of the corner's source face to the chart plane of the target face.
    pub motion: Rigid2,
}

/// The locations of all source vertices in the target's triangles.
#[derive(Clone, Debug, Default)]
pub struct Locations {
    /// The location of each source vertex.
    pub by_vertex: TiVec<VertexId, Location>,
    /// Every source corner at a landmark: the target face is that into which the corner's halfedge points.
    pub at_landmarks: Vec<Location>,
}

/// Why not every vertex was located.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LocateError {
    /// A walk did not arrive.
    #[error("source vertex {vertex} was not found on the target: the walk did not arrive")]
    Lost {
        /// The source vertex of the refined mesh.
        vertex: usize,
    },
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl OrStop for LocateError {
    fn is_stop(&self) -> bool {
        matches!(self, Self::Cancelled(_))
    }
}

/// Vertices found between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 8192;

/// The landmark from which all others are found.
struct Seed<'a> {
    surface: &'a ConeSurface,
    landmark: LandmarkId,
}

/// Locates every source vertex on the target; see [`Locator::fill`].
///
/// # Errors
/// [`LocateError`].
pub fn locate(
    source: Parametrised<'_>,
    target: Parametrised<'_>,
    surface: &ConeSurface,
    monitor: &mut dyn Monitor,
) -> Result<Locations, LocateError> {
    let mut locations = Locations::default();
    Locator::default().fill([source, target], surface, &mut locations, monitor)?;
    Ok(locations)
}

/// Locates vertices; keeps its working memory from one call to the next.
#[derive(Clone, Debug, Default)]
pub struct Locator {
    /// For each source vertex that is a landmark the target's vertex of the same landmark; `None` for other vertices.
    apexes: TiVec<VertexId, Option<VertexId>>,
    /// Vertices in the order in which they are found; at landmarks with the range of their corners.
    queue: Vec<(VertexId, [u32; 2])>,
}

/// A landmark's images by different ways differ by rounding, which is far below this distance; the area of the cone surface is 1.
const AT_LANDMARK: f64 = 1e-9;

/// The location of a vertex that has not been found yet.
const NOWHERE: Location =
    Location { corner: HalfedgeId(u32::MAX), face: FaceId(u32::MAX), motion: Rigid2::IDENTITY };

impl Locator {
    /// Locates every source vertex on the target. Fills `locations`, whose memory is used again.
    ///
    /// Both sides must be certified parametrisations onto `surface`.
    ///
    /// # Errors
    /// [`LocateError`] where a walk does not arrive, which certified input rules out but for rounding; `locations` are then
    /// not complete.
    pub fn fill(
        &mut self,
        [source, target]: [Parametrised<'_>; 2],
        surface: &ConeSurface,
        locations: &mut Locations,
        monitor: &mut dyn Monitor,
    ) -> Result<(), LocateError> {
        self.apexes.clear();
        self.apexes.resize(source.mesh.vertex_count(), None);
        for (&v, &w) in source.landmark_vertices.iter().zip(target.landmark_vertices) {
            self.apexes[v] = Some(w);
        }
        let mut result = Err(LocateError::Lost { vertex: 0 });
        for landmark in surface.base.landmarks() {
            result = self.fill_from([source, target], Seed { surface, landmark }, locations, monitor);
            if matches!(result, Ok(()) | Err(LocateError::Cancelled(_))) {
                break;
            }
        }
        result
    }

    /// Locates everything from one landmark.
    ///
    /// The angle of an edge around a cone is known up to whole turns of its plane only. Where the turn of the first landmark
    /// is mistaken, the walk misses the others and the next turn is tried; the turns at all others follow.
    fn fill_from(
        &mut self,
        [source, target]: [Parametrised<'_>; 2],
        Seed { surface, landmark: seed }: Seed<'_>,
        locations: &mut Locations,
        monitor: &mut dyn Monitor,
    ) -> Result<(), LocateError> {
        let mesh = source.mesh;
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        let Locations { by_vertex, at_landmarks } = locations;
        by_vertex.clear();
        by_vertex.resize(mesh.vertex_count(), NOWHERE);
        at_landmarks.clear();
        self.queue.clear();
        let fan = Fan::new(surface, seed);
        let anchors = [source, target].map(|side| side.embedding.anchors[seed]);
        let wedges: Vec<Wedge> = fan.wedges(target, &anchors[1]).collect();
        let first = anchored(&fan, anchors, source, &wedges);
        let mut found = (source.landmark_vertices[seed], first);
        let mut next = 0;
        let mut corner = Corners::default();
        loop {
            pulse.beat()?;
            let (v, at) = found;
            let lost = LocateError::Lost { vertex: v.index() };
            let begin = at_landmarks.len() as u32;
            if let Some(apex) = self.apexes[v] {
                turn_around_cone([source, target], at, apex, at_landmarks).ok_or(lost)?;
            }
            by_vertex[v] = at;
            self.queue.push((v, [begin, at_landmarks.len() as u32]));
            let is_new = |v: VertexId| by_vertex[v].corner == NOWHERE.corner;
            let onwards = loop {
                if let Some(from) = corner.next(source, at_landmarks, is_new) {
                    break Some(from);
                }
                let Some(&(v, range)) = self.queue.get(next) else { break None };
                corner = Corners::new(by_vertex[v], range);
                next += 1;
            };
            let Some(from) = onwards else { break };
            let head = mesh.head(from.corner);
            let arrived = walk([source, target], from, self.apexes[head])
                .ok_or(LocateError::Lost { vertex: head.index() })?;
            found = (head, arrived);
        }
        let missing = by_vertex.iter().position(|at| at.corner == NOWHERE.corner);
        missing.map_or(Ok(()), |vertex| Err(LocateError::Lost { vertex }))
    }
}

/// Iterates over the corners of a vertex that has been found: around an ordinary vertex the motions follow from one another, at a landmark
/// all corners have been located.
#[derive(Default)]
struct Corners {
    /// For an ordinary vertex its first corner, and the next one.
    around: Option<[HalfedgeId; 2]>,
    /// The last corner whose motion was asked for.
    known: Option<Location>,
    at_landmark: std::ops::Range<u32>,
}

impl Corners {
    fn new(at: Location, [begin, end]: [u32; 2]) -> Self {
        let around = (begin == end).then_some([at.corner; 2]);
        Self { around, known: Some(at), at_landmark: begin..end }
    }

    /// The next corner whose edge leads to a vertex with `is_wanted`.
    fn next(
        &mut self,
        source: Parametrised<'_>,
        at_landmarks: &[Location],
        is_wanted: impl Fn(VertexId) -> bool,
    ) -> Option<Location> {
        let mesh = source.mesh;
        let of_landmark = |k: u32| at_landmarks.get(k as usize).copied();
        let wanted = |at: &Location| is_wanted(mesh.head(at.corner));
        if let Some(at) = self.at_landmark.by_ref().filter_map(of_landmark).find(wanted) {
            return Some(at);
        }
        while let Some([first, corner]) = self.around {
            let following = mesh.twin(corner.prev());
            self.around = (following != first).then_some([first, following]);
            if is_wanted(mesh.head(corner)) {
                return self.turn_to(source, corner);
            }
        }
        None
    }

    /// The location of a corner after the last one that was asked for.
    fn turn_to(&mut self, source: Parametrised<'_>, corner: HalfedgeId) -> Option<Location> {
        let known = self.known.as_mut()?;
        while known.corner != corner {
            let across = known.corner.prev();
            known.corner = source.mesh.twin(across);
            // The motion stored there is the inverse of the one needed, and is near in memory.
            if source.embedding.transitions[across] != Rigid2::IDENTITY {
                known.motion = known.motion.after(&source.embedding.transitions[known.corner]);
            }
        }
        Some(*known)
    }
}

/// The locations of all corners of a landmark, given one of them in any target face around the landmark's image `apex`.
///
/// `None` where that face is not at the apex, or the apex is not met after a turn.
fn turn_around_cone(
    [source, target]: [Parametrised<'_>; 2],
    at: Location,
    apex: VertexId,
    all: &mut Vec<Location>,
) -> Option<()> {
    let [mesh, below] = [source.mesh, target.mesh];
    let corner = |x: HalfedgeId| target.embedding.corners[x];
    let mut wedge = below.corner_at(at.face, apex)?;
    let image = at.motion.apply(source.embedding.corners[at.corner]);
    if image.distance(corner(wedge)) > AT_LANDMARK {
        return None;
    }
    let mut here = at;
    // Two turns around the apex, at most, and some faces on top: a walk that rounding keeps from arriving ends there.
    let mut hops = 0..2 * below.star(apex).count() + 100;
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

/// Walks along the edge of the location's corner to its end. Where that is a landmark, `apex` is the target's vertex of it, and the walk ends
/// in the first face that has it as a corner: beyond the landmark, rounding would choose the side on which the walk passes the cone.
fn walk([source, target]: [Parametrised<'_>; 2], from: Location, apex: Option<VertexId>) -> Option<Location> {
    let ends = [from.corner, from.corner.next()].map(|h| source.embedding.corners[h]);
    let mesh = target.mesh;
    let (mut face, mut motion) = (from.face, from.motion);
    let mut entered = None;
    let mut line = ends.map(|end| motion.apply(end));
    let is_at = |face: FaceId, apex: VertexId, end: DVec2| {
        mesh.corner_at(face, apex).is_some_and(|x| target.embedding.corners[x].distance(end) <= AT_LANDMARK)
    };
    // A straight line crosses no face twice but around cones: more steps than that are a walk that rounding keeps from arriving.
    for _ in 0..mesh.face_count() + 1000 {
        let arrived = Location { corner: from.corner.next(), face, motion };
        if apex.is_some_and(|apex| is_at(face, apex, line[1])) {
            return Some(arrived);
        }
        let Some(exit) = exit_edge(target.embedding, face, line, entered) else {
            return Some(arrived);
        };
        let transition = &target.embedding.transitions[exit];
        if *transition != Rigid2::IDENTITY {
            motion = transition.after(&motion);
            line = ends.map(|end| motion.apply(end));
        }
        let twin = mesh.twin(exit);
        face = twin.face();
        entered = Some(twin);
    }
    None
}

/// The edge through which the segment p q leaves a triangle; `None` when it ends inside.
pub(in crate::surface_map) fn exit_edge(
    embedding: &Embedding,
    face: FaceId,
    [p, q]: [DVec2; 2],
    entered: Option<HalfedgeId>,
) -> Option<HalfedgeId> {
    let mut nearest: Option<(f64, HalfedgeId)> = None;
    for k in 0..3 {
        let h = HalfedgeId::of(face, k);
        let (a, b) = (embedding.corners[h], embedding.corners[h.next()]);
        if Some(h) == entered || !clearly_outside(a, b, q) {
            continue;
        }
        let (right, left) = (orient2d(p, q, a), orient2d(p, q, b));
        if right <= 0.0 && left >= 0.0 {
            return Some(h);
        }
        // Rounding at a corner: the edge that is missed by least. Any other could lead around a cone.
        let miss = right.max(-left) / (b - a).length();
        if nearest.is_none_or(|(least, _)| miss < least) {
            nearest = Some((miss, h));
        }
    }
    nearest.map(|(_, h)| h)
}

/// Whether q lies to the right of a b by more than rounding: of coordinates of order 1 it is up to 1e-15. On edges shorter than
/// 1e-3 the bound is that of 1e-3, since the rounding does not shrink with them.
fn clearly_outside(a: DVec2, b: DVec2, q: DVec2) -> bool {
    let beyond = orient2d(a, b, q);
    beyond < 0.0 && beyond < -1e-14 * max((b - a).length(), 1e-3)
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
    let corners = target.embedding.triangle(at.face);
    SurfacePoint { face: at.face, barycentric: barycentric::clamped_in(corners, q) }
}
