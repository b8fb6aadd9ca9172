//! The result of a certified map: images, common mesh, measures, report.
//!
//! The map is certified before any of this begins, so a failure here costs only the part that failed and becomes a warning.

use super::flows::Flows;
use super::parametrise::Parametrisation;
use super::report::{CertificateReport, CoverageReport, DistortionReport, LayoutSearchReport};
use super::{MapInput, MapResult, Report, TriangleDistortion, Warning};
use crate::base_domain::BaseDomain;
use crate::landmarks::MeshSide;
use crate::mesh::cap_faces::CapFaces;
use crate::mesh::{FaceFrame, FaceId, RefinedMesh, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Step, if_time};
use crate::surface_map::correspondence::Correspondence;
use crate::surface_map::flat_layout::FlatLayout;
use crate::surface_map::measures::distortion::{Distortion, image_distortion, skin_distortion};
use crate::surface_map::measures::transfer::{CommonMesh, Surface, common_mesh, mapped_mesh, vertex_images};
use crate::surface_map::overlay::Overlay;
use crate::surface_map::overlay::base_lines::base_line;
use crate::surface_map::overlay::location::Locations;
use glam::DVec3;
use typed_index_collections::{TiSlice, TiVec};

/// A certified map with its flows and locations, from which the result is made.
pub(super) struct Outcome<'a> {
    pub(super) input: MapInput<'a>,
    pub(super) map: &'a Parametrisation,
    /// The base domain in the target's input coordinates.
    pub(super) base: &'a BaseDomain,
    pub(super) flows: &'a Flows,
    pub(super) locations: &'a Locations,
}

/// The map as one triangulation of both surfaces, with its measures.
struct Shown {
    common: CommonMesh,
    measured: Distortion,
    triangle_distortion: Vec<TriangleDistortion>,
    correspondence: Option<Correspondence>,
    flat_layout: Option<FlatLayout>,
}

impl Outcome<'_> {
    /// Makes the result; `missing` are the warnings of parts that failed before, and that of an overlay that is missing comes after them.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub(super) fn result(
        &self,
        overlay: Result<Overlay, Warning>,
        mut missing: Vec<Warning>,
        monitor: &mut dyn Monitor,
    ) -> Result<MapResult, Cancelled> {
        let Self { input, map, .. } = *self;
        let vertices = input.source.vertex_count();
        let has_caps = input.caps.any();
        let images = vertex_images(map.sides(), self.surfaces()[1], self.locations, vertices);
        monitor.step(Step::default())?;
        // Where there are caps, errors are those of skin on skin.
        let is_skin = |&(v, p): &(VertexId, SurfacePoint)| {
            let faces = || input.source.star(v).map(|h| [h.face(), p.face]);
            !has_caps || faces().any(|faces| input.caps.are_skin(faces) == [true, true])
        };
        let mapped = images.iter_enumerated().map(|(v, p)| (v, *p));
        let true_error = input.distance_to_truth(mapped.filter(is_skin));
        monitor.step(Step::default())?;
        let images: TiVec<VertexId, Option<SurfacePoint>> = images.into_iter().map(Some).collect();
        let shown = match overlay {
            Ok(overlay) => {
                let shown =
                    if_time(monitor, |monitor| self.shown_on(&overlay, monitor))?.unwrap_or_else(|| {
                        missing.push(Warning::NoTimeForOverlay);
                        self.shown_at_vertices(&images)
                    });
                monitor.step(Step { fraction: 0.95, residual: None })?;
                shown
            }
            Err(warning) => {
                missing.push(warning);
                self.shown_at_vertices(&images)
            }
        };
        monitor.step(Step { fraction: 1.0, residual: None })?;
        let warnings = warnings(map, &shown.measured);
        let report = Report {
            ground_truth: true_error.map(Into::into),
            warnings: missing.into_iter().chain(warnings).collect(),
            ..self.report(&shown.measured)
        };
        monitor.step(Step::default())?;
        let source_lines = patch_lines(map, MeshSide::Source, input.source);
        monitor.step(Step::default())?;
        let target_lines = patch_lines(map, MeshSide::Target, input.target);
        monitor.step(Step::default())?;
        Ok(MapResult {
            base: self.base.clone(),
            cone_curvatures: self.flows.cones.clone(),
            triangle_distortion: shown.triangle_distortion,
            correspondence: shown.correspondence,
            flat_layout: shown.flat_layout,
            texture: self.flows.l2_stretch().map(|_| self.flows.texture()),
            common: shown.common,
            patch_lines: [source_lines, target_lines],
            target_from_source: images,
            vertex_distortion: shown.measured.by_vertex.into_iter().take(vertices).collect(),
            report,
        })
    }

    fn surfaces(&self) -> [Surface<'_>; 2] {
        let [source, target] = &self.map.sides;
        [
            Surface { input: self.input.source, refined: &source.refined },
            Surface { input: self.input.target, refined: &target.refined },
        ]
    }

    /// The map on the pieces of its overlay, where it is affine: exact.
    fn shown_on(&self, overlay: &Overlay, monitor: &mut dyn Monitor) -> Result<Shown, Cancelled> {
        let told = |fraction: f64| Step { fraction, residual: None };
        monitor.step(told(0.1))?;
        let sides = self.map.sides();
        let [source, target] = self.surfaces();
        let caps = [(self.input.caps.source, source), (self.input.caps.target, target)]
            .map(|(is_cap, side)| is_cap.map(|is_cap| refined_caps(is_cap, side.refined)));
        let caps = CapFaces { source: caps[0].as_deref(), target: caps[1].as_deref() };
        let measured = skin_distortion(sides, overlay, caps, monitor)?;
        monitor.step(told(0.3))?;
        let frames: [&dyn Fn(FaceId) -> FaceFrame; 2] =
            [&|f| source.refined.frame(source.input, f), &|f| target.refined.frame(target.input, f)];
        let carriers = [source.carrier(frames[0]), target.carrier(frames[1])];
        let mut correspondence = Correspondence::of_overlay(sides, overlay, monitor)?;
        monitor.step(told(0.4))?;
        // Each replaces the value from which it was made: freeing that takes so long that the monitor is asked afterwards.
        correspondence = correspondence.carried(carriers, monitor)?;
        monitor.step(told(0.5))?;
        let mut flat_layout = FlatLayout::new(sides, &self.map.surface, monitor)?;
        monitor.step(told(0.6))?;
        if let Some(layout) = &mut flat_layout {
            *layout = layout.carried(carriers, monitor)?;
        }
        monitor.step(told(0.7))?;
        let common = common_mesh([source, target], overlay, &self.flows.texture(), monitor)?;
        monitor.step(told(0.9))?;
        let local = |&piece: &u32| {
            let (number, piece) = (piece as usize, &overlay.pieces[piece as usize]);
            TriangleDistortion {
                source_face: source.refined.face_origin[piece.source_face],
                target_face: target.refined.face_origin[piece.target_face],
                local: measured.by_piece[number],
            }
        };
        Ok(Shown {
            triangle_distortion: common.pieces.iter().map(local).collect(),
            common,
            measured,
            correspondence: Some(correspondence),
            flat_layout,
        })
    }

    /// The map without an overlay: on the source's triangles, as if it were affine there.
    fn shown_at_vertices(&self, images: &TiVec<VertexId, Option<SurfacePoint>>) -> Shown {
        let MapInput { source, target, .. } = self.input;
        Shown {
            common: mapped_mesh(source, target, images, &self.flows.texture()),
            measured: image_distortion(source, target, images),
            triangle_distortion: Vec::new(),
            correspondence: None,
            flat_layout: None,
        }
    }

    fn report(&self, measured: &Distortion) -> Report {
        let Self { input, map, .. } = *self;
        let mut distortion = DistortionReport::new(measured, self.flows.l2_stretch());
        let [source, target] = self.surfaces();
        distortion.replace_worst([&|p| source.refined.on_input(input.source, p), &|p| {
            target.refined.on_input(input.target, p)
        }]);
        Report {
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
            coverage: measured.coverage.as_ref().map(CoverageReport::from),
            borders: map.borders.clone(),
            stopped_early: map.stopped_early,
            ..Report::of_inputs(input, &map.layout.base, self.flows)
        }
    }
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

/// The user is warned of a rival class whose mean log density is below this, relative to that of the class chosen.
/// Classes 2 % apart came in the wrong order on a coarse level.
const AS_GOOD: f64 = 1.03;
/// The user is warned of a path that is longer than this, relative to the shortest one. Chosen by hand.
const LONG_PATH: f64 = 1.3;
/// The user is warned of a 95 % quantile of the density above this; 1 for an isometry. Chosen by hand.
const DISTORTED: f64 = 5.0;

fn warnings(map: &Parametrisation, measured: &Distortion) -> Vec<Warning> {
    let early = map.stopped_early.then_some(Warning::FinishedEarly { energy: measured.energy });
    let rival = map.search.rival.filter(|ratio| *ratio < AS_GOOD).map(|ratio| Warning::RivalClass { ratio });
    let stretch = map.layout.report.worst_stretch;
    let long = (stretch > LONG_PATH).then_some(Warning::LongPath { stretch });
    let distorted = (measured.p95 > DISTORTED).then_some(Warning::Distorted { p95: measured.p95 });
    let borders = map.borders.as_ref().and_then(Warning::of_borders);
    [borders, early, rival, long, distorted].into_iter().flatten().collect()
}

/// Whether each face of a refined mesh is part of a cap.
fn refined_caps(is_cap: &TiSlice<FaceId, bool>, refined: &RefinedMesh) -> TiVec<FaceId, bool> {
    refined.face_origin.iter().map(|&f| is_cap[f]).collect()
}

/// The edges of the base faces on one of both meshes, in its input coordinates.
fn patch_lines(map: &Parametrisation, side: MeshSide, input: &SurfaceMesh) -> Vec<Vec<DVec3>> {
    let base = &map.surface.base.mesh;
    let refined = &map.sides[side].refined;
    let line = |h| base_line(map.sides()[side], &map.surface, h).points;
    base.edges()
        .map(|h| line(h).iter().map(|&p| refined.on_input(input, p).position(input)).collect())
        .collect()
}
