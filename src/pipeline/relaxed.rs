//! The relaxed map: from a layout and both cone metrics to a certified result.

use super::report::{CertificateReport, DistortionReport, GroundTruthReport};
use super::{GroundTruth, MapInput, MapResult, Metrics, PipelineError, PipelineOptions, Report, draw};
use crate::layout::{BaseLayout, PatchedMesh};
use crate::mesh::VertexId;
use crate::monitor::{Monitor, Stage};
use crate::surface_map::compose::{Locations, Parametrised, locate};
use crate::surface_map::composed;
use crate::surface_map::distortion::{Distortion, distortion};
use crate::surface_map::ground_truth::same_connectivity_error;
use crate::surface_map::overlay::{Overlay, overlay};
use crate::surface_map::transfer::{Surface, common_mesh, vertex_images};
use crate::surface_map::{Certificate, ConeSurface, Embedding, MapError, certify, initial};
use glam::DVec3;

/// Layouts that are tried when a parametrisation finds no start.
const LAYOUTS: usize = 4;

/// The certified parametrisations of both sides.
struct Parametrisation {
    layout: BaseLayout,
    surface: ConeSurface,
    source: Embedding,
    target: Embedding,
    certificate: Certificate,
}

impl Parametrisation {
    fn sides(&self) -> [Parametrised<'_>; 2] {
        [
            Parametrised { patched: &self.layout.source, embedding: &self.source },
            Parametrised { patched: &self.layout.target, embedding: &self.target },
        ]
    }
}

pub(super) fn run(
    input: MapInput<'_>,
    options: &PipelineOptions,
    (layout, metrics): (BaseLayout, &Metrics),
    monitor: &mut dyn Monitor,
) -> Result<MapResult, PipelineError> {
    let map = parametrise(input, options, layout, monitor)?;
    monitor.enter(Stage::Composition);
    let [source, target] = map.sides();
    let locations = locate(source, target, &map.surface)?;
    let overlay = overlay(source, target, &locations)?;
    monitor.enter(Stage::Transfer);
    let measured = distortion(source, target, &overlay);
    Ok(result(input, &map, metrics, (&locations, &overlay, measured)))
}

/// Tries the best layouts in turn until both sides have a start.
fn parametrise(
    input: MapInput<'_>,
    options: &PipelineOptions,
    first: BaseLayout,
    monitor: &mut dyn Monitor,
) -> Result<Parametrisation, PipelineError> {
    let mut layout = first;
    for rank in 1.. {
        match parametrise_layout(layout, options, monitor) {
            Err(PipelineError::Map(MapError::NoStart { .. })) if rank < LAYOUTS => {}
            done => return done,
        }
        monitor.enter(Stage::BaseDomain);
        layout = draw(input, options, rank, monitor)?;
    }
    unreachable!("the loop ends at the last layout")
}

fn parametrise_layout(
    layout: BaseLayout,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<Parametrisation, PipelineError> {
    let surface = ConeSurface::of_layout(&layout)?;
    monitor.enter(Stage::InitialMap);
    let (source, _) = initial::embed(&layout.source, &surface, &options.initial, monitor)?;
    let (target, _) = initial::embed(&layout.target, &surface, &options.initial, monitor)?;
    monitor.enter(Stage::Relaxation);
    let (source, _) = initial::relax(&layout.source, &surface, &source, &options.relax, monitor)?;
    let (target, _) = initial::relax(&layout.target, &surface, &target, &options.relax, monitor)?;
    let ([source, target], _) =
        composed::relax(&layout, &surface, [source, target], &options.composed, monitor)?;
    monitor.enter(Stage::Certificate);
    let certificate =
        certify(&layout.source, &surface, &source).and(&certify(&layout.target, &surface, &target));
    if !certificate.bijective {
        return Err(PipelineError::NotCertified(certificate));
    }
    Ok(Parametrisation { layout, surface, source, target, certificate })
}

fn result(
    input: MapInput<'_>,
    map: &Parametrisation,
    metrics: &Metrics,
    (locations, overlay, measured): (&Locations, &Overlay, Distortion),
) -> MapResult {
    let sides = map.sides();
    let surfaces = [
        Surface { input: input.source, patched: &map.layout.source },
        Surface { input: input.target, patched: &map.layout.target },
    ];
    let vertices = input.source.vertex_count();
    let images = vertex_images(sides, surfaces[1], locations, vertices);
    let ground_truth = (input.ground_truth == GroundTruth::SameConnectivity).then(|| {
        let error =
            same_connectivity_error(input.target, images.iter().enumerate().map(|(v, p)| (v.into(), *p)));
        GroundTruthReport { mean: error.mean, p95: error.p95, max: error.max }
    });
    let report = Report {
        certificate: Some(certificate_report(&map.certificate)),
        distortion: DistortionReport {
            energy: measured.energy,
            mean: measured.mean,
            median: measured.median,
            p95: measured.p95,
            max: measured.max,
            l2_stretch: metrics.target_atlas.l2_stretch,
        },
        ground_truth,
        warnings: warnings(&map.layout, &measured),
        ..Report::of_inputs(input, &map.layout.base, metrics)
    };
    MapResult {
        base: map.layout.base.clone(),
        cone_curvatures: metrics.cones.clone(),
        common: common_mesh(surfaces[0], surfaces[1], overlay, &metrics.target_atlas.corner_uvs),
        patch_lines: [patch_lines(surfaces[0]), patch_lines(surfaces[1])],
        target_from_source: images.into_iter().map(Some).collect(),
        vertex_distortion: measured.by_vertex.into_iter().take(vertices).collect(),
        report,
    }
}

fn certificate_report(certificate: &Certificate) -> CertificateReport {
    CertificateReport {
        bijective: certificate.bijective,
        flipped_triangles: certificate.flipped_triangles,
        max_angle_sum_error: certificate.max_angle_sum_error,
        max_landmark_error: certificate.max_landmark_error,
    }
}

fn warnings(layout: &BaseLayout, measured: &Distortion) -> Vec<String> {
    let mut warnings = Vec::new();
    if layout.report.worst_stretch > 1.3 {
        warnings.push(format!(
            "A path between two landmarks is {:.1} times its shortest length: the map may wind around a limb. Landmarks \
             nearby, or a look at pairs that could be swapped, may help.",
            layout.report.worst_stretch
        ));
    }
    if measured.p95 > 5.0 {
        warnings.push(format!(
            "5 % of the surface is distorted by more than {:.1} (1 is none): landmarks on unmarked limbs may help.",
            measured.p95
        ));
    }
    warnings
}

pub(super) fn patch_lines(surface: Surface<'_>) -> Vec<Vec<DVec3>> {
    let PatchedMesh { paths, vertex_origin, .. } = surface.patched;
    let place = |v: &VertexId| vertex_origin[*v].position(surface.input);
    // Every path occurs in both directions; one is enough.
    let once = paths.iter().filter(|p| p[0] < p[p.len() - 1]);
    once.map(|path| path.iter().map(place).collect()).collect()
}
