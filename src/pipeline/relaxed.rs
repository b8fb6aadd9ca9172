//! The relaxed map: from a layout and both cone metrics to a certified result.

use super::report::{CertificateReport, DistortionReport, GroundTruthReport, LayoutSearchReport};
use super::{
    Base, GroundTruth, MapInput, MapResult, Metrics, PipelineError, PipelineOptions, Report,
    TriangleDistortion,
};
use crate::base_domain::{self, BaseDomain};
use crate::coarse_map::class_search::{Chosen, ClassSearchOptions, choose_class};
use crate::coarse_map::multilevel::{CoarseMap, solve_coarse, solve_fine};
use crate::coarse_map::own_cones::{self, Refined, Rounds, Start};
use crate::coarse_map::{LandmarkedMesh, MeshWithCoarse, coarse_landmarks};
use crate::landmarks::Landmarks;
use crate::layout::{self, BaseLayout, LayoutError, SearchReport};
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Monitor, Stage};
use crate::surface_map::certificate::base_lines::base_line;
use crate::surface_map::measures::distortion::{Distortion, distortion};
use crate::surface_map::measures::ground_truth::same_connectivity_error;
use crate::surface_map::measures::transfer::{Surface, common_mesh, vertex_images};
use crate::surface_map::overlay::location::{Locations, locate};
use crate::surface_map::overlay::{Overlay, overlay};
use crate::surface_map::{Certificate, ConeSurface, Embedding, MapError, Parametrised, certify};
use glam::DVec3;
use std::cmp::Ordering;
use std::sync::Arc;

/// The certified parametrisations of both sides.
struct Parametrisation {
    layout: BaseLayout,
    search: SearchReport,
    surface: Arc<ConeSurface>,
    sides: [LandmarkedMesh; 2],
    embeddings: [Embedding; 2],
    certificate: Certificate,
    stopped_early: bool,
}

impl Parametrisation {
    /// The same with source and target exchanged.
    fn exchanged(mut self) -> Self {
        let BaseLayout { source, target, .. } = &mut self.layout;
        std::mem::swap(source, target);
        self.sides.reverse();
        self.embeddings.reverse();
        self
    }

    fn sides(&self) -> [Parametrised<'_>; 2] {
        [0, 1].map(|k| self.sides[k].parametrised(&self.embeddings[k]))
    }
}

pub(super) fn run(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<MapResult, PipelineError> {
    // The same work whichever mesh is called the source, so that exchanging them gives the inverse map.
    let exchanged = options.base == Base::Joint && precedes(input.target, input.source);
    let map = if exchanged {
        let Landmarks { source, target } = input.landmarks.clone();
        let landmarks = Landmarks { source: target, target: source };
        let inverse = MapInput { source: input.target, target: input.source, landmarks: &landmarks, ..input };
        parametrise(inverse, (options, monitor))?.exchanged()
    } else {
        parametrise(input, (options, monitor))?
    };
    let base = in_input_coordinates(&map.layout.base, input);
    let metrics = Metrics::new(input, &base, options, monitor)?;
    monitor.enter(Stage::Composition);
    let [source, target] = map.sides();
    let locations = locate(source, target, &map.surface)?;
    let overlay = overlaid([source, target], &map.surface, &locations)?;
    monitor.enter(Stage::Transfer);
    let measured = distortion(source, target, &overlay);
    Ok(result(input, (&map, &base), &metrics, (&locations, &overlay, measured)))
}

/// The overlay. Where a source edge is lost among target triangles that rounding cannot tell apart, the target's edges are
/// traced through the source instead: what is tiny on one side is not on the other.
fn overlaid(
    [source, target]: [Parametrised<'_>; 2],
    surface: &ConeSurface,
    locations: &Locations,
) -> Result<Overlay, PipelineError> {
    overlay(source, target, locations).or_else(|lost| {
        let mut inverse = overlay(target, source, &locate(target, source, surface)?).map_err(|_| lost)?;
        inverse.exchange_roles();
        Ok(inverse)
    })
}

/// An order of meshes that does not depend on which is called the source.
fn precedes(a: &SurfaceMesh, b: &SurfaceMesh) -> bool {
    let coordinates =
        |mesh: &SurfaceMesh| mesh.positions().iter().flat_map(|p| p.to_array()).collect::<Vec<_>>();
    let by_coordinates = || {
        let (a, b) = (coordinates(a), coordinates(b));
        let differs = a.iter().zip(&b).map(|(x, y)| x.total_cmp(y)).find(|order| order.is_ne());
        differs.unwrap_or(Ordering::Equal)
    };
    let size = |mesh: &SurfaceMesh| (mesh.vertex_count(), mesh.face_count());
    size(a).cmp(&size(b)).then_with(by_coordinates).is_lt()
}

/// Vertices of the coarse level per landmark, at least: a base domain of n landmarks has 2 n - 4 triangles, and each needs some
/// vertices of its own.
const PER_LANDMARK: usize = 18;
/// The same where cones of the program's own are added: with 500 vertices in place of 640 for 12 landmarks and 20 own ones the
/// classes that were chosen on two poses of a horse left a limb turned (0.5 and 0.6 % from the truth in place of 0.2 and 0.3).
const PER_OWN_CONE: usize = 20;

/// Vertices of the coarse level on which the search for the class begins.
fn first_level(landmarks: usize, options: &PipelineOptions) -> usize {
    let own = &options.own_cones;
    let with_own = if landmarks <= own.most_landmarks && own.count > 0 { landmarks + own.count } else { 0 };
    options.multilevel.coarse_vertices.max(PER_LANDMARK * landmarks).max(PER_OWN_CONE * with_own)
}

/// How often coarse levels grow fourfold where no layout has a map, and how many layouts are tried then: so the user has the
/// answer that there is none within about the time of two maps.
const FINER_LEVELS: usize = 2;
const FINER_CANDIDATES: usize = 3;

/// Coarse map, fine map, certificate. Coarse levels grow until the layout's points can be taken out again.
fn parametrise(
    input: MapInput<'_>,
    (options, monitor): (&PipelineOptions, &mut dyn Monitor),
) -> Result<Parametrisation, PipelineError> {
    let Landmarks { source, target } = input.landmarks;
    let full = [LandmarkedMesh::new(input.source, source)?, LandmarkedMesh::new(input.target, target)?];
    let most = full.iter().map(|side| side.refined.mesh.vertex_count()).max().unwrap_or(0);
    let mut finer_levels = FINER_LEVELS;
    let mut options = options.clone();
    let mut vertices = first_level(input.landmarks.len(), &options);
    let (layout, search, (surface, embeddings, with_own)) = loop {
        monitor.enter(Stage::BaseDomain);
        let sides = [0, 1].map(|k| MeshWithCoarse::new(&full[k].refined.mesh, &full[k].landmarks, vertices));
        let options = &mut options;
        match coarse(input, &sides, (options, &mut *monitor)) {
            Err(PipelineError::Layout(LayoutError::NoMap { .. })) if vertices < most && finer_levels > 0 => {
                finer_levels -= 1;
                vertices *= 4;
                // Each costs four times as much, and where one layout fails most do.
                options.search.candidates = options.search.candidates.min(FINER_CANDIDATES);
            }
            Err(error) => return Err(error),
            Ok((layout, search, map)) => {
                let rounds = (Rounds::new(&options.own_cones), Rounds::new(&options.own_cones));
                let cells = (&rounds.0, &rounds.1);
                let inputs = [input.source, input.target];
                let start = Start { inputs, full: &full, map: &map, vertices };
                let own = own_cones::add(start, cells, &options.multilevel, &options.own_cones, monitor)?;
                monitor.enter(Stage::Relaxation);
                let own = own.map_or(Ok(None), |own| own.refined(&options.multilevel, monitor))?;
                let fine = match own {
                    Some(Refined { surface, embeddings, full }) => (surface, embeddings, Some(full)),
                    None => {
                        let surface = map.surface.clone();
                        (surface, solve_fine(map, &options.multilevel, monitor)?, None)
                    }
                };
                break (layout, search, fine);
            }
        }
    };
    let full = with_own.unwrap_or(full);
    let stopped_early = monitor.wants_result();
    monitor.enter(Stage::Certificate);
    let [source, target] = [0, 1].map(|k| certify(full[k].parametrised(&embeddings[k]), &surface));
    let certificate = source.and(&target);
    if !certificate.bijective {
        return Err(PipelineError::NotCertified(certificate));
    }
    Ok(Parametrisation { layout, search, surface, sides: full, embeddings, certificate, stopped_early })
}

/// The coarse map of least mean log density among the classes of layouts that are tried.
fn coarse<'a>(
    input: MapInput<'_>,
    sides: &'a [MeshWithCoarse<'a>; 2],
    (options, monitor): (&PipelineOptions, &mut dyn Monitor),
) -> Result<(BaseLayout, SearchReport, CoarseMap<'a>), PipelineError> {
    match options.base {
        Base::Joint => {
            let PipelineOptions { multilevel, search, class, .. } = options;
            let search_options = ClassSearchOptions { multilevel, search, choice: *class };
            let chosen = choose_class(sides, search_options, monitor)?;
            let Chosen { candidate, search, mut map } = chosen;
            map.finish(&options.multilevel, monitor)?;
            Ok((candidate.layout, search, map))
        }
        Base::Qem => {
            let landmarks = coarse_landmarks(sides);
            let meshes = [&sides[0].coarse.mesh, &sides[1].coarse.mesh];
            let base = base_domain::simplify(input.target, &input.landmarks.target, monitor)?;
            let layout = layout::from_base(meshes, &landmarks, &base, monitor)?;
            let map = solve_coarse(sides, &layout, &options.multilevel, monitor);
            let mut map = map.map_err(|error| match error {
                MapError::Cancelled(stop) => PipelineError::from(stop),
                _ => LayoutError::NoMap { layouts: 1, near: Vec::new() }.into(),
            })?;
            map.finish(&options.multilevel, monitor)?;
            Ok((layout, SearchReport::default(), map))
        }
    }
}

fn result(
    input: MapInput<'_>,
    (map, base): (&Parametrisation, &BaseDomain),
    metrics: &Metrics,
    (locations, overlay, measured): (&Locations, &Overlay, Distortion),
) -> MapResult {
    let sides = map.sides();
    let surfaces = [
        Surface { input: input.source, refined: &map.sides[0].refined },
        Surface { input: input.target, refined: &map.sides[1].refined },
    ];
    let vertices = input.source.vertex_count();
    let images = vertex_images(sides, surfaces[1], locations, vertices);
    let ground_truth = (input.ground_truth == GroundTruth::SameConnectivity).then(|| {
        let error =
            same_connectivity_error(input.target, images.iter().enumerate().map(|(v, p)| (v.into(), *p)));
        GroundTruthReport { mean: error.mean, p95: error.p95, max: error.max }
    });
    let mut distortion = DistortionReport::new(&measured, metrics);
    distortion.replace_worst([&|p| surfaces[0].refined.on_input(input.source, p), &|p| {
        surfaces[1].refined.on_input(input.target, p)
    }]);
    let report = Report {
        layout: Some(LayoutSearchReport {
            judged: map.search.judged.len(),
            rival: map.search.rival,
            twists: map.search.twists_made,
            mean_log: map.search.mean_log(),
            runner_up: map.search.runner_up(),
            path_stretch: map.layout.report.worst_stretch,
        }),
        own_landmarks: map.sides[0].landmarks.len() - input.landmarks.len(),
        certificate: Some(certificate_report(map)),
        distortion,
        ground_truth,
        stopped_early: map.stopped_early,
        warnings: warnings(map, &measured),
        ..Report::of_inputs(input, &map.layout.base, metrics)
    };
    let common = common_mesh(surfaces[0], surfaces[1], overlay, &metrics.target_atlas.corner_uvs);
    let local = |&piece: &u32| {
        let (number, piece) = (piece as usize, &overlay.pieces[piece as usize]);
        TriangleDistortion {
            source_face: map.sides[0].refined.face_origin[piece.source_face],
            target_face: map.sides[1].refined.face_origin[piece.target_face],
            local: measured.by_piece[number],
        }
    };
    MapResult {
        base: base.clone(),
        cone_curvatures: metrics.cones.clone(),
        triangle_distortion: common.pieces.iter().map(local).collect(),
        common,
        patch_lines: [patch_lines(map, 0, input.source), patch_lines(map, 1, input.target)],
        target_from_source: images.into_iter().map(Some).collect(),
        vertex_distortion: measured.by_vertex.into_iter().take(vertices).collect(),
        report,
    }
}

/// The base domain with its landmarks at the places of the target's input mesh.
fn in_input_coordinates(base: &BaseDomain, input: MapInput<'_>) -> BaseDomain {
    let place = |v: &VertexId| input.target.positions()[*v];
    BaseDomain { mesh: base.mesh.with_positions(input.landmarks.target.iter().map(place).collect()) }
}

fn certificate_report(map: &Parametrisation) -> CertificateReport {
    let certificate = &map.certificate;
    CertificateReport {
        bijective: certificate.bijective,
        triangles: map.sides.iter().map(|side| side.refined.mesh.face_count()).sum(),
        flipped_triangles: certificate.flipped_triangles,
        max_angle_sum_error: certificate.max_angle_sum_error,
        max_landmark_error: certificate.max_landmark_error,
    }
}

/// A rival's mean log density, relative to that of the class chosen, below which the user is told.
const AS_GOOD: f64 = 1.03;

fn warnings(map: &Parametrisation, measured: &Distortion) -> Vec<String> {
    let mut warnings = Vec::new();
    if map.stopped_early {
        warnings.push(format!(
            "Finished early on request, at energy {:.3} (4 is an isometry): the map is whole and certified, but a full run \
             would lower its distortion.",
            measured.energy
        ));
    }
    if let Some(rival) = map.search.rival.filter(|rival| *rival < AS_GOOD) {
        warnings.push(format!(
            "Another class of maps, which goes another way round some limb, is nearly as good: its mean log distortion is \
             {rival:.3} times that of this one. The option for the runner-up (--class runner-up) makes it; one more pair of \
             landmarks beside the limb decides.",
        ));
    }
    let layout = &map.layout;
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

/// The sides of the base faces on one of both meshes, in its input coordinates.
fn patch_lines(map: &Parametrisation, side: usize, input: &SurfaceMesh) -> Vec<Vec<DVec3>> {
    let base = &map.surface.base.mesh;
    let refined = &map.sides[side].refined;
    let line = |h| base_line(map.sides()[side], &map.surface, h).points;
    base.edges()
        .map(|h| line(h).iter().map(|&p| refined.on_input(input, p).position(input)).collect())
        .collect()
}
