//! The map with cones at ends of limbs that the matching finds, where few landmarks leave it poor.
//!
//! A few landmarks on one side of a body or on its trunk say little of its legs. A map that takes a leg to the wrong one is a minimum out of
//! which no further point leads, since its image is wrong as well. The matching judges whole assignments of ends by maps of their own.

use crate::coarse_map::own_cones::{self, OwnConeOptions, OwnCones, OwnPair, Owners, Start};
use crate::coarse_map::{LandmarkedMesh, MultilevelOptions};
use crate::landmark_matching::{MatchInput, MatchOptions, MatchedPair, MayMark, PairOrigin, match_landmarks};
use crate::landmarks::MeshSide;
use crate::mesh::{SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, unless_stopped};
use typed_index_collections::TiVec;

/// The mean log density of a coarse map with own cones from which on it is poor. With five or eight of the given landmarks of seven pairs of animals,
/// drawn at random, maps with a limb at a wrong one had .42 to .71, and others .23 to .48. Below .3 the matching gains as well, but takes its time on
/// most pairs of animals (see docs/experiments.md).
const POOR: f64 = 0.3;

/// Progress of [`better`] once the ends are found. Chosen by hand, for display only.
const FOUND: f64 = 0.6;

/// The map that begins with cones at ends that the matching finds beside the user's landmarks, where the one that was found is poor and this
/// one is better; else that one.
///
/// # Errors
/// Cancellation only.
pub(super) fn better<'a>(
    start: Start<'_>,
    owners: Owners<'a>,
    found: Option<OwnCones<'a>>,
    multilevel: &MultilevelOptions,
    own: &OwnConeOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<OwnCones<'a>>, Cancelled> {
    let reached = found.as_ref().map_or(start.map.mean_log, OwnCones::mean_log);
    if reached < POOR || monitor.wants_result() {
        return Ok(found);
    }
    let pairs = ends(start.full, &mut Portion::new(monitor, 0.0, FOUND).unseen())?;
    let beginning = &mut Portion::new(monitor, FOUND, 1.0).unseen();
    let led = own_cones::add_at(start, owners, &pairs, multilevel, own, beginning)?;
    let Some(led) = led.filter(|led| led.mean_log() < reached) else { return Ok(found) };
    led.show(monitor);
    Ok(Some(led))
}

/// The pairs of ends of the best candidate beside the user's landmarks; none where nothing is found.
fn ends(full: &[LandmarkedMesh; 2], monitor: &mut dyn Monitor) -> Result<Vec<OwnPair>, Cancelled> {
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
