//! A coarse map with own cones, and what becomes of it on finer levels.

use super::OwnConeOptions;
use crate::coarse_map::multilevel::{CoarseMap, solve_fine};
use crate::coarse_map::{LandmarkedMesh, MultilevelOptions};
use crate::monitor::{Cancelled, Monitor, unless_stopped};
use crate::surface_map::{ConeSurface, Embedding, MapError, certify};
use std::sync::Arc;

/// Both meshes with own landmarks after the user's, and the coarse map of all.
#[derive(Clone)]
pub struct OwnCones<'a> {
    pub(super) full: &'a [LandmarkedMesh; 2],
    pub(super) map: CoarseMap<'a>,
}

impl OwnCones<'_> {
    /// Mean log density of the coarse map.
    pub fn mean_log(&self) -> f64 {
        self.map.mean_log
    }

    /// Shows the coarse map to whoever waits.
    pub fn show(&self, monitor: &mut dyn Monitor) {
        monitor.preview(&self.map);
    }

    /// The same on a finer level ([`on_finer_level`]); `None` where there is none, or where patches of both meshes do not fit each other there.
    ///
    /// # Errors
    /// Cancellation only.
    pub fn on_finer_level(
        self,
        own: &OwnConeOptions,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Self>, Cancelled> {
        let finer = self.finer(own.finer_vertices, options, monitor)?;
        Ok(finer.filter(|finer| finer.map.is_of_one_body()))
    }

    /// The same on a level with at least this many vertices; `None` where there are none between the coarse level and the full meshes, or
    /// where there is no map.
    pub(super) fn finer(
        self,
        vertices: usize,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Self>, Cancelled> {
        let Self { full, mut map } = self;
        let is_finer = unless_stopped(map.refine_to(vertices, options, monitor))?;
        Ok(is_finer.unwrap_or(false).then_some(Self { full, map }))
    }

    /// The map of the full meshes; `None` where it is not found or not certified.
    ///
    /// # Errors
    /// Cancellation only.
    pub fn refined(
        self,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Refined>, Cancelled> {
        let Self { full, map } = self;
        let surface = map.surface.clone();
        let Some(embeddings) = unless_stopped(solve_fine(map, options, monitor))? else { return Ok(None) };
        let certified = |k: usize| certify(full[k].parametrised(&embeddings[k]), &surface).bijective;
        let bijective = certified(0) && certified(1);
        Ok(bijective.then(|| Refined { surface, embeddings, full: full.clone() }))
    }
}

/// The map of the full meshes with own landmarks.
pub struct Refined {
    /// The cone surface.
    pub surface: Arc<ConeSurface>,
    /// Both parametrisations.
    pub embeddings: [Embedding; 2],
    /// Both meshes with own landmarks after the user's.
    pub full: [LandmarkedMesh; 2],
}

/// Goes on with a map between two poses to a finer level, on which patches of both meshes are registered and maps of different coarse levels can be
/// compared; `false` where there is no finer level, or where the patches tell that there are two bodies.
///
/// # Errors
/// [`MapError::NoStart`], [`MapError::Cancelled`].
pub fn on_finer_level(
    map: &mut CoarseMap<'_>,
    own: &OwnConeOptions,
    options: &MultilevelOptions,
    monitor: &mut dyn Monitor,
) -> Result<bool, MapError> {
    Ok(map.refine_to(own.finer_vertices, options, monitor)? && map.is_of_one_body())
}
