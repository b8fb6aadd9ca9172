//! The map patch by patch over straight triangles, as it was made before maps were relaxed as a whole.
//!
//! The layout is that of the thesis' method. Equal barycentric coordinates of corresponding triangles belong together: with both meshes
//! over one cone surface this is one map after the inverse of the other, certified and composed as the relaxed map is.

use super::parametrise::{Parametrisation, certified};
use super::relaxed::composed;
use super::thesis::draw;
use super::{MapInput, MapResult, PipelineError, PipelineOptions};
use crate::coarse_map::LandmarkedMesh;
use crate::layout::{BaseLayout, PatchedMesh, SearchReport};
use crate::monitor::{Cancelled, Monitor, Portion, Stage, Step};
use crate::surface_map::parametrisation::tutte::{embed_patches, nudged};
use crate::surface_map::{ConeSurface, Embedding};
use std::sync::Arc;

/// Draws the base domain, maps each patch onto its triangle, and tells of the map.
pub(super) fn run(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<MapResult, PipelineError> {
    monitor.enter(Stage::BaseDomain);
    let layout = draw(input, options, &mut Portion::new(monitor, 0.0, 0.9))?;
    let map = parametrised(layout, monitor)?;
    composed(input, &map, options, monitor)
}

/// Both parametrisations, certified; an error where a limb without a landmark is so long that its end shrinks below rounding.
fn parametrised(layout: BaseLayout, monitor: &mut dyn Monitor) -> Result<Parametrisation, PipelineError> {
    let surface = Arc::new(ConeSurface::of_layout(&layout)?);
    let mut embedded = |side: &PatchedMesh, attempt: usize, from: f64| {
        let exact = embed_patches(side, &surface, &mut Portion::new(monitor, from, from + 0.05))?;
        monitor.step(Step { fraction: from + 0.05, residual: None })?;
        Ok::<Embedding, Cancelled>(nudged(side.parametrised(&exact), attempt))
    };
    let embeddings = [embedded(&layout.source, 1, 0.9)?, embedded(&layout.target, 2, 0.95)?];
    let mut landmarked = |side: &PatchedMesh| {
        monitor.step(Step { fraction: 1.0, residual: None })?;
        Ok::<LandmarkedMesh, Cancelled>(LandmarkedMesh::patched(side))
    };
    let sides = [landmarked(&layout.source)?, landmarked(&layout.target)?];
    let certificate = certified([0, 1].map(|k| sides[k].parametrised(&embeddings[k])), &surface, monitor)?;
    Ok(Parametrisation {
        layout,
        search: SearchReport::default(),
        surface,
        sides,
        embeddings,
        certificate,
        stopped_early: false,
        borders: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmarks::Landmarks;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;
    use crate::pipeline::Report;

    #[test]
    fn a_sphere_is_mapped_onto_itself_by_the_identity() {
        let sphere = icosphere(3);
        let pairs: Vec<_> = (0..12).map(|k| [k, k]).collect();
        let landmarks = Landmarks::from_vertices(&sphere, &sphere, &pairs).unwrap();
        let input = MapInput::new(&sphere, &sphere, &landmarks);
        let result = run(input, &PipelineOptions::default(), &mut Silent).unwrap();
        for (v, image) in result.target_from_source.iter_enumerated() {
            let off = image.unwrap().position(&sphere).distance(sphere.positions()[v]);
            assert!(off < 1e-8, "{v:?}: {off:e}");
        }
        let Report { distortion, warnings, unmapped_share, .. } = result.report;
        assert!((distortion.energy - 4.0).abs() < 1e-6 && warnings.is_empty(), "{distortion:?} {warnings:?}");
        assert_eq!(unmapped_share, 0.0);
    }
}
