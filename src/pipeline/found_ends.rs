//! The map whose cones of the program's own begin at ends of limbs that the matching finds, where landmarks leave limbs unmarked.
//!
//! A few landmarks on one side of a body or on its trunk say little of its legs. A map that takes a leg to the wrong one, or turns it, is a
//! minimum out of which no further point leads, since its image is wrong as well. The matching judges whole assignments of ends by maps of their
//! own.

use crate::coarse_map::LandmarkedMesh;
use crate::coarse_map::own_cones::{self, OwnCones, OwnPair, Owners, Start};
use crate::landmark_matching::{MatchInput, MatchOptions, MatchedPair, MayMark, PairOrigin, match_landmarks};
use crate::landmarks::MeshSide;
use crate::mesh::{SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, unless_stopped};
use typed_index_collections::TiVec;

/// Limbs are unmarked where at least this many of their ends, on both meshes, are farther than [`REMOTE`] from all landmarks.
const UNMARKED: usize = 2;

/// The distance from all landmarks, where the area is 1. With five and eight landmarks drawn at random, 20 maps looked at, the end that is second
/// farthest from them is at .44 and more; with twelve, as far from each other as can be, at .30 at most on 21 pairs, and with these matched ends make
/// maps neither better nor worse, but take up to 1.4 times as long (see docs/experiments.md).
const REMOTE: f64 = 0.4;

/// The mean log density of a coarse map with own cones from which on it is poor. With images under the first map those of animals with a limb at a
/// wrong one had .42 to .71, others .23 to .48.
const POOR: f64 = 0.3;

/// Progress of the rounds that begin with matched ends once these are found. Chosen by hand, for display only.
const FOUND: f64 = 0.4;

/// Progress after the first of two ways to begin, where both are needed. Chosen by hand, for display only.
const BEGUN: f64 = 0.7;

/// The map with own cones: where the landmarks leave limbs unmarked, its rounds begin with ends that the matching finds beside these; else with
/// images under the map of the landmarks. Where that map is poor ([`POOR`]) both are tried, and the map with the lower mean log density is
/// kept. `None` where none is better than the start.
///
/// # Errors
/// Cancellation only.
pub(super) fn with_own_cones<'a>(
    start: &Start<'_>,
    owners: [Owners<'a>; 2],
    monitor: &mut dyn Monitor,
) -> Result<Option<OwnCones<'a>>, Cancelled> {
    let [first, second] = owners;
    if are_limbs_unmarked(start, monitor)? {
        let led = led(start, first, &mut Portion::new(monitor, 0.0, BEGUN))?;
        if led.as_ref().is_some_and(|led| led.mean_log() < POOR || monitor.wants_result()) {
            return Ok(led);
        }
        let adding = Portion::new(monitor, BEGUN, 1.0);
        let adding = &mut if led.is_some() { adding.unseen() } else { adding };
        let added = own_cones::add(start, second, adding)?;
        return Ok(better(led, added, monitor));
    }
    let added = own_cones::add(start, first, &mut Portion::new(monitor, 0.0, BEGUN))?;
    let reached = added.as_ref().map_or(start.mean_log(), OwnCones::mean_log);
    if reached < POOR || !start.looks_for_ends() || monitor.wants_result() {
        return Ok(added);
    }
    let led = led(start, second, &mut Portion::new(monitor, BEGUN, 1.0).unseen())?;
    Ok(better(added, led, monitor))
}

/// Of two maps the other one, where there is no first one or the other has a lower mean log density; it is shown then.
fn better<'a>(
    first: Option<OwnCones<'a>>,
    other: Option<OwnCones<'a>>,
    monitor: &mut dyn Monitor,
) -> Option<OwnCones<'a>> {
    let least = first.as_ref().map_or(f64::INFINITY, OwnCones::mean_log);
    let Some(other) = other.filter(|other| other.mean_log() < least) else { return first };
    other.show(monitor);
    Some(other)
}

/// Whether the landmarks leave limbs unmarked.
fn are_limbs_unmarked(start: &Start<'_>, monitor: &mut dyn Monitor) -> Result<bool, Cancelled> {
    let looking = &mut Portion::new(monitor, 0.0, 0.0);
    Ok(!looking.wants_result() && start.unmarked_ends(REMOTE, looking)? >= UNMARKED)
}

/// The map whose rounds begin with matched ends, where that is better than the start.
fn led<'a>(
    start: &Start<'_>,
    owners: Owners<'a>,
    monitor: &mut dyn Monitor,
) -> Result<Option<OwnCones<'a>>, Cancelled> {
    let pairs = matched(start.full(), &mut Portion::new(monitor, 0.0, FOUND).unseen())?;
    let beginning = &mut Portion::new(monitor, FOUND, 1.0);
    let led = own_cones::add_at(start, owners, &pairs, beginning)?;
    Ok(led.filter(|led| led.mean_log() < start.mean_log()))
}

/// The pairs of ends of the best candidate beside the user's landmarks; none where nothing is found.
fn matched(full: &[LandmarkedMesh; 2], monitor: &mut dyn Monitor) -> Result<Vec<OwnPair>, Cancelled> {
    let [source, target] = full;
    let given: Vec<[VertexId; 2]> =
        source.landmarks.iter().zip(&target.landmarks).map(|(&s, &t)| [s, t]).collect();
    let may = full.each_ref().map(may_mark);
    let may_mark = MayMark { source: Some(&may[0]), target: Some(&may[1]) };
    let meshes = full.each_ref().map(|side| &side.refined.mesh);
    let input = MatchInput { source: meshes[0], target: meshes[1], given: &given, may_mark };
    let Some(found) = unless_stopped(match_landmarks(input, &few_candidates(), monitor))? else {
        return Ok(Vec::new());
    };
    let Some(best) = found.candidates.first() else { return Ok(Vec::new()) };
    let own = best.pairs.iter().filter(|pair| pair.origin != PairOrigin::Given);
    let pair = |pair: &MatchedPair| OwnPair {
        source: pair.source,
        target: SurfacePoint::at_vertex(meshes[MeshSide::Target], pair.target),
    };
    Ok(own.map(pair).collect())
}

/// The options where the user's landmarks steer the matching. They say which side is which, so that mirror images are not looked at; ears and
/// horns lead no limb. On eight pairs of animals with five and eight drawn landmarks, 33 maps, fewer candidates than usual gave the same ends
/// on 32, in half the time (see docs/experiments.md).
fn few_candidates() -> MatchOptions {
    MatchOptions {
        candidates: 3,
        symmetric: 2,
        turns: 0,
        second_symmetric: 0,
        one_missing: 0,
        more_candidates: 0,
        changes: 2,
        mirrored: 0,
        small_ends: 0,
        ..MatchOptions::default()
    }
}

/// Whether each vertex is skin, and no landmark.
fn may_mark(side: &LandmarkedMesh) -> TiVec<VertexId, bool> {
    let mesh = &side.refined.mesh;
    let weights = side.weights();
    let mut may: TiVec<VertexId, bool> = mesh.vertices().map(|v| weights.is_on_skin(mesh, v)).collect();
    side.landmarks.iter().for_each(|&v| may[v] = false);
    may
}
