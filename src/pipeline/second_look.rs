//! The second look at two poses of one body with many landmarks.
//!
//! A limb or a head may be turned between its landmarks: the map is in the right class, but in a poor minimum. So the map is looked for again, on
//! levels with more vertices, where the descent begins with other drawings. Where both maps agree nothing is turned as a rule; where they do not,
//! cones of the program's own are tried as well. Maps are compared on a finer level, on which patches of both bodies are registered.

use super::attempt::{Attempt, Coarse, Solved, coarse, level_with_own};
use super::{MapInput, PipelineError, PipelineOptions};
use crate::coarse_map::multilevel::LevelImages;
use crate::coarse_map::own_cones::{self, OwnConeInput, Owners, Refined, Rounds, Start, share_elsewhere};
use crate::coarse_map::{LandmarkedMesh, coarse_levels};
use crate::layout::LayoutError;
use crate::monitor::{Monitor, Portion, Stage, unless_stopped};

/// With many landmarks another map between two poses of one body is taken where its mean log density on a finer level is below this many
/// times that of the first one. Own cones that turned a limb back brought it to .49 to .80; where nothing is turned they brought it to .91
/// and more, and the map no nearer to the truth.
const TURNED: f64 = 0.9;

/// Two coarse maps between poses, of levels with fewer and with more vertices, are the same where less than this share of the vertices has other
/// images. Of sixteen maps between poses of people those with a head or a limb to turn back had .015 to .16; twenty maps between poses of a child,
/// hands, horses and a cat, with nothing to turn back, had .002 at most.
const ELSEWHERE: f64 = 0.005;

/// Progress of the second look at two poses after the first map was judged, after the search on other levels, and after its map was
/// judged. Chosen by hand, for display only.
const LOOKED: [f64; 3] = [0.1, 0.3, 0.4];

/// The map between two poses of one body with many landmarks: the first one, or where that turns a limb between its landmarks, the one that turns
/// it back.
pub(super) fn poses(
    input: MapInput<'_>,
    full: &[LandmarkedMesh; 2],
    mut first: Coarse<'_>,
    attempt: Attempt,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<Solved, PipelineError> {
    if !monitor.wants_result() {
        monitor.enter(Stage::OwnCones);
        let PipelineOptions { multilevel, own_cones: own_options, .. } = options;
        let images = first.map.images();
        let judging = &mut Portion::new(monitor, 0.0, LOOKED[0]);
        if own_cones::on_finer_level(&mut first.map, own_options, multilevel, judging)? {
            let doubted = Doubted { images, mean_log: first.map.mean_log };
            if let Some(solved) = turned_back(input, full, doubted, attempt, options, monitor)? {
                return Ok(solved);
            }
        }
    }
    monitor.enter(Stage::Relaxation);
    first.solved(options, monitor)
}

/// The map between two poses that may turn a limb between its landmarks.
struct Doubted {
    /// The images of the coarse map; `None` where a vertex could not be located.
    images: Option<LevelImages>,
    /// Its mean log density on a finer level.
    mean_log: f64,
}

/// A map of coarse levels with more vertices that is clearly better on a finer level ([`TURNED`]); where it has other images than the first one
/// ([`ELSEWHERE`]), which then turns a limb or its rival does, also one with own cones. `None` where there is none.
fn turned_back(
    input: MapInput<'_>,
    full: &[LandmarkedMesh; 2],
    first: Doubted,
    attempt: Attempt,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<Solved>, PipelineError> {
    let PipelineOptions { multilevel, own_cones: own_options, .. } = options;
    // More cones need levels with more vertices, and their maps are compared with one on such levels.
    let vertices = attempt.vertices.max(level_with_own(input.landmarks.len(), options));
    let searching = &mut Portion::new(monitor, LOOKED[0], LOOKED[1]).unseen();
    let sides = coarse_levels(full, vertices, multilevel.rims, &mut Portion::new(searching, 0.0, 0.0))?;
    let found = match coarse(input, &sides, options, &attempt.search, searching) {
        Ok(found) => found,
        Err(PipelineError::Layout(LayoutError::NoMap { .. })) => return Ok(None),
        Err(error) => return Err(error),
    };
    if !found.map.is_of_poses() {
        return Ok(None);
    }
    let mut least = TURNED * first.mean_log;
    let mut finer = found.map.clone();
    let judging = &mut Portion::new(monitor, LOOKED[1], LOOKED[2]);
    // Where it is lost there, the first map stays.
    let is_of_one_body =
        unless_stopped(own_cones::on_finer_level(&mut finer, own_options, multilevel, judging))?;
    let is_better = is_of_one_body == Some(true) && finer.mean_log < least;
    if is_better {
        least = TURNED * finer.mean_log;
    }
    let both = first.images.zip(found.map.images());
    let agree = both.is_some_and(|(here, there)| share_elsewhere([&here, &there]) < ELSEWHERE);
    if !agree {
        let from = OwnConeInput {
            inputs: [input.source, input.target],
            full,
            map: &found.map,
            vertices,
            is_one_body: true,
            multilevel,
            own: own_options,
        };
        if let Some(refined) = with_own_cones(from, least, monitor)? {
            return Ok(Some(Solved::with_own(refined, found.layout, found.search)));
        }
    }
    if !is_better {
        return Ok(None);
    }
    monitor.enter(Stage::Relaxation);
    Coarse { map: finer, ..found }.solved(options, monitor).map(Some)
}

/// The map between two poses with own cones, where its mean log density on a finer level is below `least`.
fn with_own_cones(
    from: OwnConeInput<'_>,
    least: f64,
    monitor: &mut dyn Monitor,
) -> Result<Option<Refined>, PipelineError> {
    let OwnConeInput { multilevel, own, .. } = from;
    let Some(start) = Start::new(from) else { return Ok(None) };
    let (meshes, levels) = (Rounds::new(own), Rounds::new(own));
    let owners = Owners { meshes: &meshes, levels: &levels };
    let adding = &mut Portion::new(monitor, LOOKED[2], 1.0);
    if let Some(found) = own_cones::add(&start, owners, adding)?
        && let Some(found) = found.on_finer_level(own, multilevel, adding)?
        && found.mean_log() < least
    {
        monitor.enter(Stage::Relaxation);
        return Ok(found.refined(multilevel, monitor)?);
    }
    Ok(None)
}
