//! The thesis' map: from a layout to the images of the vertices, with warnings about missing ones.

use super::flows::{Flows, cone_metric};
use super::report::DistortionReport;
use super::{Base, MapInput, MapResult, PipelineError, PipelineOptions, Report, Warning};
use crate::base_domain::{self, BaseDomain};
use crate::layout::{self, BaseLayout, PatchedMesh};
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Monitor, Portion, Stage};
use crate::patchwise::{PatchwiseMap, patchwise_map};
use crate::surface_map::measures::distortion::image_distortion;
use crate::surface_map::measures::transfer::mapped_mesh;
use glam::DVec3;
use typed_index_collections::TiVec;

/// Makes the thesis' map and its result.
///
/// The flows run on the meshes as given, for the texture, and again on the refined ones, where the paths between landmarks are
/// chains of edges.
pub(super) fn run(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<MapResult, PipelineError> {
    monitor.enter(Stage::BaseDomain);
    let layout = draw(input, options, monitor)?;
    let refined = |side: &PatchedMesh, monitor: &mut dyn Monitor| {
        cone_metric(&side.mesh, &side.landmark_vertices.raw, &layout.base, options, monitor)
    };
    let flows = Flows::new(input, &layout.base, options, monitor)?;
    monitor.enter(Stage::PatchwiseMap);
    let (source, _) =
        refined(&layout.source, &mut Portion::new(monitor, 0.0, 0.4)).map_err(PipelineError::source_flow)?;
    let (target, _) =
        refined(&layout.target, &mut Portion::new(monitor, 0.4, 0.8)).map_err(PipelineError::target_flow)?;
    let last = &mut Portion::new(monitor, 0.8, 1.0);
    let map = patchwise_map(&layout, [input.source, input.target], [&source, &target], last)?;
    monitor.enter(Stage::Transfer);
    let warnings = warnings(&map);
    Ok(result(input, layout, &flows, map, warnings))
}

/// Draws the base domain on both meshes at full resolution.
pub(super) fn draw(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<BaseLayout, PipelineError> {
    let meshes = [input.source, input.target];
    Ok(match options.base {
        Base::Joint => {
            let whole = &mut Portion::new(monitor, 0.0, 1.0);
            layout::joint(meshes, input.landmarks, &options.layout, whole)?
        }
        Base::Qem => {
            let half = &mut Portion::new(monitor, 0.0, 0.5);
            let base = base_domain::simplify(input.target, &input.landmarks.target.raw, half)?;
            layout::from_base(meshes, input.landmarks, &base, &mut Portion::new(monitor, 0.5, 1.0))?
        }
    })
}

/// The result of a map that is known at the source's vertices alone.
pub(super) fn result(
    input: MapInput<'_>,
    layout: BaseLayout,
    flows: &Flows,
    map: PatchwiseMap,
    warnings: Vec<Warning>,
) -> MapResult {
    let images = &map.target_from_source;
    let mapped = images.iter_enumerated().filter_map(|(v, image)| Some((v, (*image)?)));
    let measured = image_distortion(input.source, input.target, images);
    let report = Report {
        certificate: None,
        unmapped_share: map.unmapped_share,
        distortion: DistortionReport::new(&measured, flows.l2_stretch()),
        ground_truth: input.distance_to_truth(mapped).map(Into::into),
        warnings,
        ..Report::of_inputs(input, &layout.base, flows)
    };
    MapResult {
        cone_curvatures: flows.cones.clone(),
        common: mapped_mesh(input.source, input.target, images, &flows.texture()),
        patch_lines: [(&layout.source, input.source), (&layout.target, input.target)]
            .map(|(side, input)| patch_lines(&layout.base, side, input)),
        vertex_distortion: TiVec::new(),
        triangle_distortion: Vec::new(),
        correspondence: None,
        flat_layout: None,
        texture: flows.l2_stretch().map(|_| flows.texture()),
        report,
        base: layout.base,
        target_from_source: map.target_from_source,
    }
}

/// The paths that the base domain was drawn along, one for each of its edges.
fn patch_lines(base: &BaseDomain, side: &PatchedMesh, input: &SurfaceMesh) -> Vec<Vec<DVec3>> {
    let place = |v: &VertexId| side.vertex_origin[*v].position(input);
    base.mesh.edges().map(|h| side.paths[h].iter().map(place).collect()).collect()
}

fn warnings(map: &PatchwiseMap) -> Vec<Warning> {
    let [source, target] = map.inverted_patches;
    let inverted = (source + target > 0).then_some(Warning::InvertedPatches { source, target });
    [Some(Warning::NoBijection), inverted, unmapped(map)].into_iter().flatten().collect()
}

/// The warning about vertices without an image, where there are any.
pub(super) fn unmapped(map: &PatchwiseMap) -> Option<Warning> {
    (map.unmapped_share > 0.0).then_some(Warning::Unmapped { share: map.unmapped_share })
}
