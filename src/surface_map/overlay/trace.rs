//! The traces of the source's edges: straight lines through the target's triangles.
//!
//! A trace goes from the location of its tail to the location of its head. Between them each step takes one exact predicate: on
//! which side of the source edge lies the corner opposite the edge that was entered.

use super::corner_locations::{CornerLocation, CornerLocations};
use super::pieces::OverlayError;
use crate::math::predicates::orient2d;
use crate::math::rigid2::Rigid2;
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, HalfedgeId};
use crate::monitor::{Monitor, Pulse};
use crate::surface_map::parametrisation::embedding::Parametrised;
use glam::DVec2;
use typed_index_collections::TiVec;

/// A crossing of a source edge and a target edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    /// The source edge as a halfedge whose direction the trace follows: the smaller one.
    pub edge: HalfedgeId,
    /// The target halfedge of the face that the trace leaves here.
    pub exit: HalfedgeId,
    /// Its twin, in the face that the trace enters.
    pub entered: HalfedgeId,
    /// Number, in [`Traces::motions`], of the motion from the plane of the source face of `edge` to that of the face
    /// entered; [`AS_LOCATED`] as long as it is that of the location.
    pub motion: u32,
    /// The place on the source edge: 0 at its start, 1 at its end; never falls along a trace.
    pub along_source: f64,
    /// The place on the target halfedge `exit`: 0 at its start, 1 at its end.
    pub along_target: f64,
}

/// Edges traced between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 4096;

/// The motion of a trace that has not left the plane of its location.
const AS_LOCATED: u32 = u32::MAX;

/// The crossings of all source edges.
#[derive(Clone, Debug, Default)]
pub(super) struct Traces {
    /// The crossings, edge by edge, in the order of each trace.
    pub crossings: Vec<Crossing>,
    /// Motions other than those of the located corners.
    pub motions: Vec<Rigid2>,
    /// The range of `crossings` of each source edge, by its smaller halfedge; the other halfedge has the same range.
    pub ranges: TiVec<HalfedgeId, [u32; 2]>,
}

impl Traces {
    /// Traces all source edges.
    pub fn fill(
        &mut self,
        [source, target]: [Parametrised<'_>; 2],
        located: &CornerLocations,
        monitor: &mut dyn Monitor,
    ) -> Result<(), OverlayError> {
        let mesh = source.mesh;
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        self.crossings.clear();
        self.motions.clear();
        self.ranges.resize(mesh.face_count() * 3, [0; 2]);
        let tracer = Tracer { source, target, located, most: target.mesh.face_count() + 1000 };
        for h in mesh.edges() {
            pulse.beat()?;
            let begin = self.crossings.len() as u32;
            tracer.trace(h, Log { crossings: &mut self.crossings, motions: &mut self.motions })?;
            let range = [begin, self.crossings.len() as u32];
            self.ranges[h] = range;
            self.ranges[mesh.twin(h)] = range;
        }
        Ok(())
    }

    /// The motion from the plane of the source face of a crossing's edge to that of the target face entered there.
    pub fn motion<'a>(&'a self, located: &'a CornerLocations, crossing: &Crossing) -> &'a Rigid2 {
        self.motions.get(crossing.motion as usize).unwrap_or(&located.locations[crossing.edge].motion)
    }
}

/// Source and target with the locations of the source's corners and the traces of its edges.
#[derive(Clone, Copy)]
pub(super) struct Traced<'a> {
    pub source: Parametrised<'a>,
    pub target: Parametrised<'a>,
    pub located: &'a CornerLocations,
    pub traces: &'a Traces,
}

/// The data that the traces of all edges share.
struct Tracer<'a> {
    source: Parametrised<'a>,
    target: Parametrised<'a>,
    located: &'a CornerLocations,
    /// Crossings of one edge, at most: a straight line crosses no face twice but around cones.
    most: usize,
}

/// The lists to which a trace appends its crossings and motions.
struct Log<'l> {
    crossings: &'l mut Vec<Crossing>,
    motions: &'l mut Vec<Rigid2>,
}

/// A trace under way.
struct Walk {
    edge: HalfedgeId,
    ends: [DVec2; 2],
    location: CornerLocation,
    motion: u32,
    /// The ends in the plane of the target face.
    line: [DVec2; 2],
    along: f64,
}

/// A target halfedge that a line leaves through, and twice the areas that its start and end make with the line.
struct Exit {
    halfedge: HalfedgeId,
    right: f64,
    left: f64,
}

/// The passage of a trace from one face to the next.
struct Passage {
    /// The target halfedge that it leaves through.
    exit: HalfedgeId,
    /// The place on the source edge, 0 to 1 up to rounding.
    along_source: f64,
    /// The place on `exit`, 0 to 1 up to rounding.
    along_target: f64,
}

impl Walk {
    /// Passes from the present face to the next.
    #[inline]
    fn cross(&mut self, target: Parametrised<'_>, passage: Passage, log: &mut Log<'_>) {
        let Passage { exit, along_source, along_target } = passage;
        let transition = &target.embedding.transitions[exit];
        let entered = target.mesh.twin(exit);
        self.along = along_source.clamp(self.along, 1.0);
        if *transition != Rigid2::IDENTITY {
            self.location.motion = transition.after(&self.location.motion);
            self.line = [self.location.motion.apply(self.ends[0]), self.location.motion.apply(self.ends[1])];
            self.motion = log.motions.len() as u32;
            log.motions.push(self.location.motion);
        }
        self.location.face = entered.face();
        log.crossings.push(Crossing {
            edge: self.edge,
            exit,
            entered,
            motion: self.motion,
            along_source: self.along,
            along_target: along_target.clamp(0.0, 1.0),
        });
    }
}

impl Tracer<'_> {
    fn trace(&self, h: HalfedgeId, mut log: Log<'_>) -> Result<(), OverlayError> {
        let ends = [self.located.corners[h], self.located.corners[h.next()]];
        let location = self.located.locations[h];
        let line = [location.motion.apply(ends[0]), location.motion.apply(ends[1])];
        let mut walk = Walk { edge: h, ends, location, motion: AS_LOCATED, line, along: 0.0 };
        let end = self.end(h);
        let goal = end.motion.apply(ends[1]);
        let mut before = None;
        for _ in 0..self.most {
            if is_there(&walk.location, &end, walk.line[1].distance_squared(goal)) {
                return Ok(());
            }
            let exit = match before {
                Some(exit) => self.next_exit(&walk, exit),
                None => match self.first_exit(&walk) {
                    Some(exit) => exit,
                    None => break,
                },
            };
            let x = exit.halfedge;
            let (a, b) = (self.target.embedding.corners[x], self.target.embedding.corners[x.next()]);
            let [p, q] = walk.line;
            let to = signed_double_area(a, b, q);
            if to >= 0.0 {
                break;
            }
            let from = signed_double_area(a, b, p);
            let along_target = exit.right / (exit.right - exit.left);
            let passage = Passage { exit: x, along_source: from / (from - to), along_target };
            walk.cross(self.target, passage, &mut log);
            before = Some(exit);
        }
        self.step_over(walk, &end, log)
    }

    /// The location of the head, as seen from the face of the halfedge. At a landmark it lies in the wedge from which the edge
    /// comes.
    fn end(&self, h: HalfedgeId) -> CornerLocation {
        if self.located.at_landmark(h.next()) {
            let location = self.located.locations[self.source.mesh.twin(h)];
            CornerLocation {
                motion: location.motion.after(&self.source.embedding.transitions[h]),
                ..location
            }
        } else {
            self.located.locations[h.next()]
        }
    }

    /// The halfedge through which the line leaves a face that it entered through the twin of `before`: one predicate tells on which side
    /// of the line the opposite corner lies. Points on the line count as right of it.
    #[inline]
    fn next_exit(&self, walk: &Walk, before: Exit) -> Exit {
        let entered = self.target.mesh.twin(before.halfedge);
        let [p, q] = walk.line;
        let apex = orient2d(p, q, self.target.embedding.corners[entered.prev()]);
        if apex > 0.0 {
            Exit { halfedge: entered.next(), left: apex, ..before }
        } else {
            Exit { halfedge: entered.prev(), right: apex, ..before }
        }
    }

    /// The halfedge through which the line leaves the face in which it starts.
    fn first_exit(&self, walk: &Walk) -> Option<Exit> {
        let [p, q] = walk.line;
        let corner = |x: HalfedgeId| self.target.embedding.corners[x];
        if let Some(wedge) = self.located.wedges[walk.edge] {
            let halfedge = wedge.next();
            let [right, left] = [halfedge, wedge.prev()].map(|x| signed_double_area(p, q, corner(x)));
            return Some(Exit { halfedge, right, left });
        }
        let x = HalfedgeId::of(walk.location.face, 0);
        let [y, z] = [x.next(), x.prev()];
        let (at_x, at_y, at_z) =
            (orient2d(p, q, corner(x)), orient2d(p, q, corner(y)), orient2d(p, q, corner(z)));
        let leaves = |right: f64, left: f64| right <= 0.0 && left > 0.0;
        let exit = |halfedge: HalfedgeId, right: f64, left: f64| Some(Exit { halfedge, right, left });
        if leaves(at_x, at_y) {
            exit(x, at_x, at_y)
        } else if leaves(at_y, at_z) {
            exit(y, at_y, at_z)
        } else if leaves(at_z, at_x) {
            exit(z, at_z, at_x)
        } else {
            None
        }
    }

    /// Passes into the face of the head's location, through one edge or around one corner: the head lies, up to rounding, on the border of the
    /// present face.
    fn step_over(&self, mut walk: Walk, end: &CornerLocation, mut log: Log<'_>) -> Result<(), OverlayError> {
        let halfedges = |face: FaceId| (0..3).map(move |k| HalfedgeId::of(face, k));
        let mesh = &self.target.mesh;
        let goal = end.motion.apply(walk.ends[1]);
        let after = |location: &CornerLocation, x: HalfedgeId| CornerLocation {
            face: mesh.twin(x).face(),
            motion: self.target.embedding.transitions[x].after(&location.motion),
        };
        let arrives = |location: &CornerLocation| {
            is_there(location, end, location.motion.apply(walk.ends[1]).distance_squared(goal))
        };
        let once = halfedges(walk.location.face).find(|&x| arrives(&after(&walk.location, x)));
        let twice = || {
            let pairs = halfedges(walk.location.face).flat_map(|x| {
                let entered = mesh.twin(x);
                [[x, entered.next()], [x, entered.prev()]]
            });
            pairs.into_iter().find(|&[x, y]| arrives(&after(&after(&walk.location, x), y)))
        };
        let way = once.map(|x| [Some(x), None]).or_else(|| twice().map(|pair| pair.map(Some)));
        let ends = [walk.edge, walk.edge.next()].map(|h| self.source.mesh.tail(h).index());
        for x in way.ok_or(OverlayError::Lost { edge: ends })?.into_iter().flatten() {
            let [a, b] = [x, x.next()].map(|x| self.target.embedding.corners[x]);
            let along_target = (walk.line[1] - a).dot(b - a) / (b - a).length_squared();
            walk.cross(self.target, Passage { exit: x, along_source: 1.0, along_target }, &mut log);
        }
        Ok(())
    }
}

/// Whether a walk is in the face of its goal, on the same way around the cones: `distance` is the square of the distance
/// between the goal's two images in the face's plane. Different ways around a cone differ by its angle, equal ways by rounding; the bounds,
/// 1e-9 of the root of the area and 1e-6 rad, lie between.
fn is_there(here: &CornerLocation, end: &CornerLocation, distance: f64) -> bool {
    here.face == end.face
        && distance < 1e-18
        && here.motion.rotation.distance_squared(end.motion.rotation) < 1e-12
}
