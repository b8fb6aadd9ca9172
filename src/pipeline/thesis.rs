//! The thesis' map: from a layout to the images of the vertices, with what is missing told.

use super::report::{DistortionReport, GroundTruthReport};
use super::{
    GroundTruth, MapInput, MapResult, Metrics, PipelineError, PipelineOptions, Report, cone_metric, draw,
};
use crate::layout::{BaseLayout, PatchedMesh};
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Monitor, Stage};
use crate::patchwise::{PatchwiseMap, patchwise_map};
use crate::surface_map::measures::distortion::image_distortion;
use crate::surface_map::measures::ground_truth::same_connectivity_error;
use crate::surface_map::measures::transfer::mapped_mesh;
use glam::DVec3;
use typed_index_collections::TiVec;

/// The flows run again on the refined meshes, where the paths between landmarks are chains of edges.
pub(super) fn run(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<MapResult, PipelineError> {
    monitor.enter(Stage::BaseDomain);
    let layout = draw(input, options, monitor)?;
    let metrics = Metrics::new(input, &layout.base, options, monitor)?;
    let refined = |side: &PatchedMesh, monitor: &mut dyn Monitor| {
        cone_metric((&side.mesh, &side.landmark_vertices.raw), &layout.base, options, monitor)
    };
    monitor.enter(Stage::SourceConeMetric);
    let source = refined(&layout.source, monitor).map_err(PipelineError::source_flow)?;
    monitor.enter(Stage::TargetConeMetric);
    let target = refined(&layout.target, monitor).map_err(PipelineError::target_flow)?;
    monitor.enter(Stage::Composition);
    let map = patchwise_map(&layout, [input.source, input.target], [&source.0, &target.0], monitor)?;
    monitor.enter(Stage::Transfer);
    Ok(result(input, layout, &metrics, map))
}

fn result(input: MapInput<'_>, layout: BaseLayout, metrics: &Metrics, map: PatchwiseMap) -> MapResult {
    let images = &map.target_from_source;
    let mapped = || images.iter_enumerated().filter_map(|(v, image)| Some((v, (*image)?)));
    let ground_truth = (input.ground_truth == GroundTruth::SameConnectivity).then(|| {
        let error = same_connectivity_error(input.target, mapped());
        GroundTruthReport { mean: error.mean, p95: error.p95, max: error.max }
    });
    let measured = image_distortion(input.source, input.target, images);
    let report = Report {
        certificate: None,
        unmapped_share: map.unmapped_share,
        distortion: DistortionReport::new(&measured, metrics),
        ground_truth,
        warnings: warnings(&map),
        ..Report::of_inputs(input, &layout.base, metrics)
    };
    MapResult {
        cone_curvatures: metrics.cones.clone(),
        common: mapped_mesh(input.source, input.target, images, &metrics.target_atlas.corner_uvs),
        patch_lines: [patch_lines(&layout.source, input.source), patch_lines(&layout.target, input.target)],
        vertex_distortion: TiVec::new(),
        triangle_distortion: Vec::new(),
        report,
        base: layout.base,
        target_from_source: map.target_from_source,
    }
}

/// The paths that the base domain was drawn along.
fn patch_lines(side: &PatchedMesh, input: &SurfaceMesh) -> Vec<Vec<DVec3>> {
    let place = |v: &VertexId| side.vertex_origin[*v].position(input);
    // Every path occurs in both directions; one is enough.
    let once = side.paths.iter().filter(|p| p[0] < p[p.len() - 1]);
    once.map(|path| path.iter().map(place).collect()).collect()
}

fn warnings(map: &PatchwiseMap) -> Vec<String> {
    let mut warnings = vec!["This method does not guarantee a bijection; the relaxed map does.".to_owned()];
    let [source, target] = map.inverted_patches;
    if source + target > 0 {
        warnings.push(format!(
            "Triangles of the base domain that come out inverted in the flat metrics: {source} on the source, {target} on \
             the target."
        ));
    }
    if map.unmapped_share > 0.0 {
        warnings.push(format!(
            "{:.2} % of the source's vertices have no image: no straight triangle with a counterpart lies over them.",
            100.0 * map.unmapped_share
        ));
    }
    warnings
}
