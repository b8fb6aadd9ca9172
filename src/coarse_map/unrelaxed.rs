//! The map before its own energy is lowered.
//!
//! Each mesh is relaxed over the cone surface by itself, without regard to the other. Two parametrisations of least distortion do not make
//! the map of least distortion; the difference shows the effect of the relaxation of the map.

use super::mesh_with_coarse::MeshWithCoarse;
use super::multilevel::parametrised_levels;
use super::options::MultilevelOptions;
use crate::layout::BaseLayout;
use crate::monitor::{Monitor, Portion};
use crate::surface_map::parametrisation::initial;
use crate::surface_map::{ConeSurface, Embedding, MapError};
use std::sync::Arc;

/// Both full meshes over the cone surface of a layout that was drawn on their coarse levels.
pub struct Unrelaxed {
    /// The cone surface.
    pub surface: Arc<ConeSurface>,
    /// Both parametrisations.
    pub embeddings: [Embedding; 2],
}

/// Parametrises both full meshes over the cone surface of a layout, each relaxed by itself.
///
/// # Errors
/// [`MapError::NoStart`], [`MapError::LayoutPoints`], [`MapError::Cancelled`].
pub fn solve_unrelaxed(
    meshes: &[MeshWithCoarse<'_>; 2],
    layout: &BaseLayout,
    options: &MultilevelOptions,
    monitor: &mut dyn Monitor,
) -> Result<Unrelaxed, MapError> {
    let surface = Arc::new(ConeSurface::of_layout(layout));
    let coarse = &mut Portion::new(monitor, 0.0, 0.1);
    let mut levels = parametrised_levels(meshes, layout, &surface, options, coarse)?;
    for (k, level) in levels.iter_mut().enumerate() {
        let from = 0.1 + 0.45 * k as f64;
        let whole = level.full_vertices();
        initial::refine(level, whole, &options.initial, &mut Portion::new(monitor, from, from + 0.3))?;
        level.relax(&options.relax, &mut Portion::new(monitor, from + 0.3, from + 0.45))?;
    }
    Ok(Unrelaxed { surface, embeddings: levels.map(|level| level.snapshot().embedding) })
}
