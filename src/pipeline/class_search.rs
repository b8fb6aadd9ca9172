//! The class of the map: layouts of different isotopy classes, each judged by the coarse map that it leads to.

use super::PipelineError;
use crate::layout::{self, Candidate, Candidates, LayoutError, SearchOptions, SearchReport};
use crate::monitor::Monitor;
use crate::surface_map::MapError;
use crate::surface_map::multilevel::{CoarseMap, MultilevelOptions, Side, coarse_landmarks, solve_coarse};

/// The class that was chosen with its coarse map, judged but not yet relaxed to the end.
pub struct Chosen<'a> {
    /// Its layout, drawn on the coarse levels.
    pub candidate: Candidate,
    /// What was judged.
    pub search: SearchReport,
    /// The coarse map.
    pub map: CoarseMap<'a>,
}

/// The class whose coarse map has the least mean log density, among layouts planned on both coarse levels.
///
/// # Errors
/// [`PipelineError::Layout`] where no layout has a map, [`PipelineError::Cancelled`].
pub fn choose_class<'a>(
    sides: &'a [Side<'a>; 2],
    (options, search_options): (&MultilevelOptions, &SearchOptions),
    monitor: &mut dyn Monitor,
) -> Result<Chosen<'a>, PipelineError> {
    let landmarks = coarse_landmarks(sides);
    let meshes = [&sides[0].coarse.mesh, &sides[1].coarse.mesh];
    let mut finalists: Vec<Finalist<'a>> = Vec::new();
    let mut count = 0;
    let mut judge = |candidate: &Candidate, monitor: &mut dyn Monitor| {
        let number = count;
        count += 1;
        match solve_coarse(sides, &candidate.layout, (options, monitor)) {
            Ok(map) => {
                let mean_log = map.mean_log;
                finalists.push(Finalist { number, candidate: candidate.clone(), map });
                finalists.sort_by(|a, b| a.map.mean_log.total_cmp(&b.map.mean_log));
                finalists.truncate(options.finalists);
                Ok(Some(mean_log))
            }
            Err(MapError::Cancelled(stop)) => Err(stop),
            Err(_) => Ok(None),
        }
    };
    let mut candidates = Candidates::new(meshes, &landmarks);
    let (_, mut search) = layout::search(&mut candidates, &mut judge, search_options, monitor)?;
    let Finalist { number, candidate, map } = winner(finalists, (options, &mut *monitor))?;
    search.best = number;
    search.judged[number].mean_log = Some(map.mean_log);
    Ok(Chosen { candidate, search, map })
}

/// One of the best maps of a search.
struct Finalist<'a> {
    /// Among the judged layouts.
    number: usize,
    candidate: Candidate,
    map: CoarseMap<'a>,
}

/// The best of maps that are too close to tell after a first look: each is relaxed further.
fn winner<'a>(
    mut finalists: Vec<Finalist<'a>>,
    (options, monitor): (&MultilevelOptions, &mut dyn Monitor),
) -> Result<Finalist<'a>, PipelineError> {
    let least = finalists.first().map_or(f64::INFINITY, |first| first.map.mean_log);
    finalists.retain(|other| other.map.mean_log <= options.close * least);
    if finalists.len() > 1 && !monitor.wants_result() {
        for finalist in &mut finalists {
            finalist.map.relax((&options.decide, &mut *monitor))?;
        }
    }
    let best = finalists.into_iter().min_by(|a, b| a.map.mean_log.total_cmp(&b.map.mean_log));
    best.ok_or(LayoutError::NoMap { layouts: 0 }.into())
}
