//! The certified parametrisations of both meshes: class search, own cones, refinement, certificate.

use super::attempt::{
    Attempt, Coarse, FINER_LEVELS, Scale, Solved, coarse, first_level, has_own_cones, has_own_cones_of_poses,
};
use super::borders::{BordersReport, CountedCaps, counted_caps};
use super::{MapInput, PipelineError, PipelineOptions, Relaxation, found_ends, second_look};
use crate::coarse_map::class_search::ClassChoice;
use crate::coarse_map::own_cones::{self, OwnConeInput, OwnConeOptions, Owners, Rounds, Start};
use crate::coarse_map::unrelaxed::{Unrelaxed, solve_unrelaxed};
use crate::coarse_map::{LandmarkedMesh, coarse_levels};
use crate::landmarks::Landmarks;
use crate::layout::{BaseLayout, LayoutError, MOST_DISTANCES, SearchReport};
use crate::monitor::{Monitor, Portion, Stage, Step};
use crate::surface_map::MapError;
use crate::surface_map::{Certificate, ConeSurface, Embedding, Parametrised, certify};
use std::sync::Arc;

/// The certified parametrisations of both sides.
pub(super) struct Parametrisation {
    pub(super) layout: BaseLayout,
    pub(super) search: SearchReport,
    pub(super) surface: Arc<ConeSurface>,
    pub(super) sides: [LandmarkedMesh; 2],
    pub(super) embeddings: [Embedding; 2],
    pub(super) certificate: Certificate,
    pub(super) stopped_early: bool,
    /// The report of the rims of holes; `None` where not both meshes have any.
    pub(super) borders: Option<BordersReport>,
}

impl Parametrisation {
    /// The same with source and target exchanged.
    pub(super) fn exchanged(mut self) -> Self {
        let BaseLayout { source, target, .. } = &mut self.layout;
        std::mem::swap(source, target);
        self.sides.reverse();
        self.embeddings.reverse();
        self.borders = self.borders.map(BordersReport::exchanged);
        self
    }

    pub(super) fn sides(&self) -> [Parametrised<'_>; 2] {
        [0, 1].map(|k| self.sides[k].parametrised(&self.embeddings[k]))
    }
}

/// Makes and certifies both parametrisations: coarse map, fine map, certificate. Coarse levels grow where no layout has a map.
pub(super) fn parametrise(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<Parametrisation, PipelineError> {
    monitor.enter(Stage::ClassSearch);
    let Landmarks { source, target } = input.landmarks;
    let CountedCaps { weights: [on_source, on_target], report: borders } =
        counted_caps(input, options, monitor)?;
    monitor.step(Step::default())?;
    let source = LandmarkedMesh::new(input.source, &source.raw)?.with_weights(on_source);
    monitor.step(Step::default())?;
    let target = LandmarkedMesh::new(input.target, &target.raw)?.with_weights(on_target);
    let mut full = [source, target];
    let most = full.iter().map(|mesh| mesh.refined.mesh.vertex_count()).max().unwrap_or(0);
    let vertices = first_level(input.landmarks.len(), options);
    let mut attempt = Attempt { vertices, search: options.search, scale: Scale::ByArea };
    let mut finer_levels = FINER_LEVELS;
    let solved = loop {
        match solve(input, &full, attempt, options, monitor) {
            Err(PipelineError::Layout(LayoutError::NoMap { .. }))
                if attempt.vertices < most
                    && finer_levels > 0
                    && input.landmarks.len() * attempt.finer().vertices <= MOST_DISTANCES =>
            {
                finer_levels -= 1;
                attempt = attempt.finer();
            }
            // A cone that cannot pass from its stand-in to its landmark stays at the landmark.
            Err(PipelineError::Map(MapError::NoStart { .. }))
                if full.iter().any(LandmarkedMesh::has_stand_ins) =>
            {
                full = full.map(LandmarkedMesh::without_stand_ins);
            }
            outcome => break outcome?,
        }
    };
    let Solved { layout, search, surface, embeddings, meshes } = solved;
    let full = meshes.unwrap_or(full);
    let stopped_early = monitor.wants_result();
    let certificate = certified([0, 1].map(|k| full[k].parametrised(&embeddings[k])), &surface, monitor)?;
    let sides = full;
    Ok(Parametrisation { layout, search, surface, sides, embeddings, certificate, stopped_early, borders })
}

/// The certificate of both parametrisations.
///
/// # Errors
/// [`PipelineError::NotCertified`] where they are no homeomorphisms, or cancellation.
pub(super) fn certified(
    sides: [Parametrised<'_>; 2],
    surface: &ConeSurface,
    monitor: &mut dyn Monitor,
) -> Result<Certificate, PipelineError> {
    monitor.enter(Stage::Certificate);
    let [source, target] = sides;
    monitor.step(Step::default())?;
    let source = certify(source, surface);
    monitor.step(Step { fraction: 0.5, residual: None })?;
    let certificate = source.and(&certify(target, surface));
    if certificate.bijective { Ok(certificate) } else { Err(PipelineError::NotCertified(certificate)) }
}

/// Progress of the search for the class before ends of limbs are looked at. Chosen by hand, for display only.
const SEARCHED: f64 = 0.8;

/// Solves an attempt, from its coarse levels to the full meshes.
fn solve(
    input: MapInput<'_>,
    full: &[LandmarkedMesh; 2],
    attempt: Attempt,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<Solved, PipelineError> {
    let Attempt { vertices, search, scale } = attempt;
    let coarsening = &mut Portion::new(monitor, 0.0, 0.0);
    let sides = coarse_levels(full, vertices, options.multilevel.rims, coarsening)?;
    // Cones at ends of limbs are part of the search where there are too many landmarks for a stage of own cones.
    let has_own = has_own_cones(input.landmarks.len(), options);
    let searched = if has_own { 1.0 } else { SEARCHED };
    let searching = &mut Portion::new(monitor, 0.0, searched);
    let Coarse { layout, mut search, map } = coarse(input, &sides, options, &search, searching)?;
    if scale == Scale::ByArea
        && !monitor.wants_result()
        && let Some(factor) = map.better_scale()
    {
        // Begun anew: the class was judged, and poses of one body were recognised, at the wrong scale.
        let scaled = [full[0].clone(), full[1].scaled(factor)];
        let solved = solve(input, &scaled, Attempt { scale: Scale::BySkin, ..attempt }, options, monitor)?;
        return Ok(Solved { meshes: Some(solved.meshes.unwrap_or(scaled)), ..solved });
    }
    if options.relaxation == Relaxation::None {
        monitor.enter(Stage::Relaxation);
        let Unrelaxed { surface, embeddings } =
            solve_unrelaxed(&sides, &layout, &options.multilevel, monitor)?;
        return Ok(Solved { layout, search, surface, embeddings, meshes: None });
    }
    if !has_own && has_own_cones_of_poses(input.landmarks.len(), options) && map.is_of_poses() {
        let first = Coarse { layout, search, map };
        return second_look::poses(input, full, first, attempt, options, monitor);
    }
    if has_own {
        monitor.enter(Stage::OwnCones);
    }
    // A search with ends of limbs would go back to the best class.
    let ends = if options.class == ClassChoice::Best { options.own_cones.ends } else { 0 };
    let own = &OwnConeOptions { ends, ..options.own_cones };
    let start = Start::new(OwnConeInput {
        inputs: [input.source, input.target],
        full,
        map: &map,
        vertices,
        is_one_body: false,
        multilevel: &options.multilevel,
        own,
    });
    let meshes = [Rounds::new(own), Rounds::new(own)];
    let levels = [Rounds::new(own), Rounds::new(own)];
    let owners = [0, 1].map(|k| Owners { meshes: &meshes[k], levels: &levels[k] });
    let own = match &start {
        Some(start) if has_own => found_ends::with_own_cones(start, owners, monitor)?,
        Some(start) => own_cones::add(start, owners[0], &mut Portion::new(monitor, SEARCHED, 1.0))?,
        None => None,
    };
    monitor.enter(Stage::Relaxation);
    if let Some(own) = own {
        let worse = map.mean_log / own.mean_log();
        if let Some(refined) = own.refined(&options.multilevel, monitor)? {
            if !has_own {
                // The runner-up has no cones at ends of limbs.
                search.rival = search.rival.map(|rival| worse * rival);
            }
            return Ok(Solved::with_own(refined, layout, search));
        }
    }
    Coarse { layout, search, map }.solved(options, monitor)
}
