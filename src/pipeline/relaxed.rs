//! The relaxed map: from landmarks to certified parametrisations of both meshes, and on to the result.

use super::flows::Flows;
use super::outcome::Outcome;
use super::parametrise::{Parametrisation, parametrise};
use super::previews::{InGivenMeshes, Roles};
use super::{Base, MapInput, MapResult, PipelineError, PipelineOptions, Warning};
use crate::base_domain::BaseDomain;
use crate::landmarks::Landmarks;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, OrStop, Stage, Step, if_time};
use crate::surface_map::overlay::location::{Locations, locate};
use crate::surface_map::overlay::{Overlay, OverlayError, overlay};
use crate::surface_map::{ConeSurface, Parametrised};
use std::cmp::Ordering;

/// Makes the map and its result.
pub(super) fn run(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<MapResult, PipelineError> {
    // The same work whichever mesh is called the source, so that exchanging them gives the inverse map.
    let exchanged = options.base == Base::Joint && order(input).is_gt();
    let map = if exchanged {
        let Landmarks { source, target } = input.landmarks.clone();
        let landmarks = Landmarks { source: target, target: source };
        let inverse = MapInput {
            source: input.target,
            target: input.source,
            landmarks: &landmarks,
            caps: input.caps.exchanged(),
            ..input
        };
        let meshes = [inverse.source, inverse.target];
        let mut monitor = InGivenMeshes::new(monitor, meshes, Roles::Exchanged);
        parametrise(inverse, options, &mut monitor)?.exchanged()
    } else {
        let meshes = [input.source, input.target];
        parametrise(input, options, &mut InGivenMeshes::new(monitor, meshes, Roles::AsGiven))?
    };
    composed(input, &map, options, monitor)
}

/// Composes both parametrisations and makes the result.
pub(super) fn composed(
    input: MapInput<'_>,
    map: &Parametrisation,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<MapResult, PipelineError> {
    monitor.enter(Stage::Composition);
    let [source, target] = map.sides();
    monitor.step(Step::default())?;
    let locations = locate(source, target, &map.surface, monitor)?;
    monitor.step(Step { fraction: 0.5, residual: None })?;
    let made = |monitor: &mut dyn Monitor| overlaid([source, target], &map.surface, &locations, monitor);
    let overlay = match if_time(monitor, made)? {
        Some(overlay) => overlay.map_err(|error| Warning::NoOverlay { reason: error.to_string() }),
        None => Err(Warning::NoTimeForOverlay),
    };
    monitor.step(Step { fraction: 1.0, residual: None })?;
    let base = in_input_coordinates(&map.layout.base, input);
    let (flows, missing) = Flows::beside_a_map(input, &base, options, monitor)?;
    monitor.enter(Stage::Transfer);
    monitor.step(Step::default())?;
    let outcome = Outcome { input, map, base: &base, flows: &flows, locations: &locations };
    Ok(outcome.result(overlay, missing, monitor)?)
}

/// Makes the overlay. Where a source edge is lost among target triangles as small as rounding, the target's edges are
/// traced through the source instead, whose triangles are not as small there.
///
/// # Errors
/// [`Cancelled`]; the overlay's own error is returned in `Ok`.
fn overlaid(
    [source, target]: [Parametrised<'_>; 2],
    surface: &ConeSurface,
    locations: &Locations,
    monitor: &mut dyn Monitor,
) -> Result<Result<Overlay, OverlayError>, Cancelled> {
    let lost = match overlay(source, target, locations, monitor) {
        Ok(overlay) => return Ok(Ok(overlay)),
        Err(error) => error.or_stop()?,
    };
    let locations = match locate(target, source, surface, monitor) {
        Ok(locations) => locations,
        Err(error) => return error.or_stop().map(|_| Err(lost)),
    };
    match overlay(target, source, &locations, monitor) {
        Ok(mut inverse) => {
            inverse.exchange_roles();
            Ok(Ok(inverse))
        }
        Err(error) => error.or_stop().map(|_| Err(lost)),
    }
}

/// The order of source and target by their data: sizes, coordinates, triangles, landmarks, caps. Where all are equal, the exchanged input
/// is the same.
fn order(input: MapInput<'_>) -> Ordering {
    let [a, b] = [input.source, input.target];
    let size = |mesh: &SurfaceMesh| (mesh.vertex_count(), mesh.face_count());
    let coordinates =
        |mesh: &SurfaceMesh| mesh.positions().iter().flat_map(|p| p.to_array()).collect::<Vec<_>>();
    let by_coordinates = || {
        let (a, b) = (coordinates(a), coordinates(b));
        let differs = a.iter().zip(&b).map(|(x, y)| x.total_cmp(y)).find(|order| order.is_ne());
        differs.unwrap_or(Ordering::Equal)
    };
    let MapInput { landmarks, caps, .. } = input;
    size(a)
        .cmp(&size(b))
        .then_with(by_coordinates)
        .then_with(|| a.triangles().raw.cmp(&b.triangles().raw))
        .then_with(|| landmarks.source.cmp(&landmarks.target))
        .then_with(|| caps.source.map(|caps| &caps.raw).cmp(&caps.target.map(|caps| &caps.raw)))
}

/// The base domain with its landmarks at the places of the target's input mesh.
fn in_input_coordinates(base: &BaseDomain, input: MapInput<'_>) -> BaseDomain {
    let place = |v: &VertexId| input.target.positions()[*v];
    BaseDomain { mesh: base.mesh.with_positions(input.landmarks.target.iter().map(place).collect()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo;
    use crate::monitor::Silent;

    #[test]
    fn a_map_stands_where_its_overlay_is_lost() {
        let demo = demo::build("sphere-tetrahedron").unwrap();
        let (source, target) = (&demo.source, &demo.target);
        let landmarks = Landmarks::from_vertices(source, target, &demo.landmarks).unwrap();
        let input = MapInput::new(source, target, &landmarks);
        let options = PipelineOptions::default();
        let whole = run(input, &options, &mut Silent).unwrap();

        let map = parametrise(input, &options, &mut Silent).unwrap();
        let [from, onto] = map.sides();
        let locations = locate(from, onto, &map.surface, &mut Silent).unwrap();
        let base = in_input_coordinates(&map.layout.base, input);
        let (flows, _) = Flows::beside_a_map(input, &base, &options, &mut Silent).unwrap();
        let outcome = Outcome { input, map: &map, base: &base, flows: &flows, locations: &locations };
        let lost = Warning::NoOverlay { reason: OverlayError::Lost { edge: [3, 4] }.to_string() };
        let bare = outcome.result(Err(lost), Vec::new(), &mut Silent).unwrap();

        let [Warning::NoOverlay { reason }] = &bare.report.warnings[..] else {
            panic!("{:?}", bare.report.warnings)
        };
        assert!(reason.contains("3-4"), "{reason}");
        assert!(bare.report.certificate.as_ref().unwrap().bijective);
        assert_eq!(bare.common.triangles.len(), source.face_count());
        assert!(bare.triangle_distortion.is_empty());
        // Measured at the vertices alone the map looks nearly as it is.
        let [energy, exact] = [&bare, &whole].map(|result| result.report.distortion.energy);
        assert!((energy / exact - 1.0).abs() < 0.1, "{energy} {exact}");
    }
}
