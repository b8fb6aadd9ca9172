//! Checks of properties that hold for every map and for every step towards it, on any two meshes with landmarks.
#![allow(dead_code, reason = "every test binary uses another part")]

use crate::common::{self, Pair};
use conemap::base_domain;
use conemap::cone_metric::{FlowError, FlowOptions, Scheme, flow, uniform_curvature};
use conemap::landmarks::Landmarks;
use conemap::layout::{self, LayoutOptions};
use conemap::math::triangle::angle_from_lengths;
use conemap::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::{Cancelled, Monitor, Silent, Step};
use conemap::pipeline::{
    CapFaces, GroundTruth, MapInput, MapResult, Method, OwnConeOptions, PipelineError, PipelineOptions,
    Warning, run,
};
use conemap::surface_map::measures::distortion;
use conemap::surface_map::measures::queries::PointMap;
use conemap::surface_map::overlay::location;
use conemap::surface_map::parametrisation::initial::{self, InitialOptions};
use conemap::surface_map::parametrisation::problem::FlatRelaxOptions;
use conemap::surface_map::{ConeSurface, Parametrised, certify, overlay};
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Two meshes with landmarks.
#[derive(Clone)]
pub struct Case {
    pub name: String,
    pub source: SurfaceMesh,
    pub target: SurfaceMesh,
    pub landmarks: Landmarks,
    pub ground_truth: GroundTruth<'static>,
}

impl From<Pair> for Case {
    fn from(pair: Pair) -> Self {
        let landmarks = common::landmarks(&pair);
        let ground_truth = match pair.file.ground_truth {
            Some(_) => GroundTruth::SameConnectivity,
            None => GroundTruth::Unknown,
        };
        Self { name: pair.name, source: pair.source, target: pair.target, landmarks, ground_truth }
    }
}

impl Case {
    /// The same with these landmarks alone.
    pub fn only(&self, kept: &[usize]) -> Self {
        let of = |side: &[VertexId]| kept.iter().map(|&k| side[k]).collect();
        let Landmarks { source, target } = &self.landmarks;
        let landmarks = Landmarks { source: of(&source.raw), target: of(&target.raw) };
        Self { landmarks, ..self.clone() }
    }

    /// The case as input of the pipeline.
    pub fn input(&self) -> MapInput<'_> {
        MapInput {
            source: &self.source,
            target: &self.target,
            landmarks: &self.landmarks,
            ground_truth: self.ground_truth,
            caps: CapFaces::default(),
        }
    }

    /// The case with source and target exchanged.
    pub fn exchanged(&self) -> Self {
        let Self { name, source, target, landmarks, ground_truth } = self.clone();
        let landmarks = Landmarks { source: landmarks.target, target: landmarks.source };
        Self { name: format!("{name} backwards"), source: target, target: source, landmarks, ground_truth }
    }

    /// The certified map of the case, with the default options.
    pub fn map(&self) -> MapResult {
        run(self.input(), &PipelineOptions::default(), &mut Silent)
            .unwrap_or_else(|e| panic!("{}: {e}", self.name))
    }
}

/// The images of all vertices of the source.
pub fn images(result: &MapResult) -> Vec<SurfacePoint> {
    result.target_from_source.iter().map(|p| p.expect("the relaxed map leaves nothing out")).collect()
}

/// Checks that the flow to equal cones converges: the angles of the metric's triangles, computed from their lengths alone, add up to those
/// cones and satisfy Gauss-Bonnet.
pub fn flow_converges(name: &str, mesh: &SurfaceMesh, landmarks: &[VertexId]) {
    let target = uniform_curvature(mesh.vertex_count(), landmarks);
    for scheme in [Scheme::Inversive, Scheme::VertexScaling] {
        let options = FlowOptions { scheme, ..FlowOptions::default() };
        let (metric, report) =
            flow(mesh, &target, &options, &mut Silent).unwrap_or_else(|e| panic!("{name} {scheme:?}: {e}"));
        assert!(report.max_curvature_error <= options.tolerance, "{name} {scheme:?}: {report:?}");
        assert_eq!(report.residuals.len(), report.newton_steps + 1, "{name} {scheme:?}");
        assert!(metric.triangulation.is_consistent(), "{name} {scheme:?}");
        let lengths = metric.lengths();
        let mut curvature = vec![TAU; mesh.vertex_count()];
        for h in metric.triangulation.halfedges() {
            let angle = angle_from_lengths(lengths[h.next()], [lengths[h], lengths[h.prev()]]);
            curvature[metric.triangulation.tail(h).index()] -= angle;
        }
        let apart = |v: VertexId| (curvature[v.index()] - target[v]).abs();
        let worst = mesh.vertices().map(apart).fold(0.0, f64::max);
        assert!(worst < 2.0 * options.tolerance, "{name} {scheme:?}: a cone is {worst} rad off");
        let total: f64 = curvature.iter().sum();
        assert!((total - 4.0 * PI).abs() < 1e-9, "{name} {scheme:?}: total curvature {total}");
    }
}

/// Checks that the flow without flips breaks down, and that its error has the residual of each step.
pub fn fixed_triangulation_fails_and_says_so(mesh: &SurfaceMesh, landmarks: &[VertexId]) {
    let target = uniform_curvature(mesh.vertex_count(), landmarks);
    let options = FlowOptions { scheme: Scheme::FixedTriangulation, ..FlowOptions::default() };
    match flow(mesh, &target, &options, &mut Silent) {
        Err(FlowError::NotConverged { best, report }) => {
            assert!(best > 1e-3 && best.is_finite(), "{best}");
            assert_eq!(report.residuals.len(), report.newton_steps + 1);
            assert_eq!(report.edge_flips, 0);
            let least = report.residuals.iter().copied().fold(f64::INFINITY, f64::min);
            assert_eq!(best, least, "{:?}", report.residuals);
        }
        other => panic!("expected not converged, got {:?}", other.map(|(_, r)| r)),
    }
}

/// Draws the base domain on both meshes at once, and checks every invariant that the later stages rely on.
pub fn has_a_valid_layout(case: &Case) {
    let Case { name, landmarks, .. } = case;
    let options = LayoutOptions { attempts: 1, ..LayoutOptions::default() };
    let layout = layout::joint([&case.source, &case.target], landmarks, &options, &mut Silent)
        .unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(layout.base.mesh.vertex_count(), landmarks.len(), "{name}");
    assert_eq!(layout.base.mesh.face_count(), 2 * landmarks.len() - 4, "{name}");
    for side in [&layout.source, &layout.target] {
        side.validate(&layout.base).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!((side.mesh.area() - 1.0).abs() < 1e-9, "{name}");
    }
    let angles: f64 = layout.base.cone_angles().iter().sum();
    let defects = TAU * landmarks.len() as f64 - angles;
    assert!((defects - 2.0 * TAU).abs() < 1e-9, "Gauss-Bonnet of {name}: {defects}");
}

/// Checks that the target simplified to its landmarks is a triangulation of the sphere whose vertices are the landmarks, and that its
/// drawing on both meshes satisfies every invariant.
pub fn simplified_base_is_drawn(case: &Case) {
    let Case { name, landmarks, .. } = case;
    let base = base_domain::simplify(&case.target, &landmarks.target.raw, &mut Silent)
        .unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(base.mesh.vertex_count(), landmarks.len(), "{name}");
    assert_eq!(base.mesh.face_count(), 2 * landmarks.len() - 4, "{name}");
    for (corner, &landmark) in base.mesh.positions().iter().zip(&landmarks.target) {
        assert_eq!(*corner, case.target.positions()[landmark], "{name}: landmark {landmark:?}");
    }
    let layout = layout::from_base([&case.source, &case.target], landmarks, &base, &mut Silent)
        .unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(layout.base.mesh.triangles(), base.mesh.triangles(), "{name}");
    for side in [&layout.source, &layout.target] {
        side.validate(&layout.base).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

/// Checks that both parametrisations onto the cone surface are certified, before and after their relaxation, and that their composition
/// covers both surfaces once and takes points there and back.
pub fn parametrisations_are_certified(case: &Case) {
    let Case { name, landmarks, .. } = case;
    let options = LayoutOptions { attempts: 1, ..LayoutOptions::default() };
    let layout = layout::joint([&case.source, &case.target], landmarks, &options, &mut Silent).unwrap();
    let surface = Arc::new(ConeSurface::of_layout(&layout));
    let [source, target] = [&layout.source, &layout.target].map(|side| {
        let (start, _) = initial::embed(side, &surface, &InitialOptions::default(), &mut Silent)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let before = certify(side.parametrised(&start), &surface);
        assert!(before.bijective, "{name}: the start: {before:?}");
        let (end, report) =
            initial::relax(side.parametrised(&start), &surface, &FlatRelaxOptions::default(), &mut Silent)
                .unwrap();
        let after = certify(side.parametrised(&end), &surface);
        assert!(after.bijective && after.flipped_triangles == 0, "{name}: {after:?}");
        assert!(report.energies.is_sorted_by(|a, b| a >= b), "{name}: {:?}", report.energies);
        end
    });
    let source = layout.source.parametrised(&source);
    let target = layout.target.parametrised(&target);
    let locations =
        location::locate(source, target, &surface, &mut Silent).unwrap_or_else(|e| panic!("{name}: {e}"));
    let overlay =
        overlay::overlay(source, target, &locations, &mut Silent).unwrap_or_else(|e| panic!("{name}: {e}"));
    let measured = distortion::distortion([source, target], &overlay, &mut Silent).unwrap();
    // The pieces of the overlay cover both surfaces once, face by face.
    assert!(
        overlay.source_area_defect < 1e-9 && overlay.shifts == 0,
        "{name}: {}",
        overlay.source_area_defect
    );
    // On the real horse, which has slivers of 0.01 degrees, the defect is 4.5e-10.
    assert!(overlay.target_area_defect < 1e-8, "{name}: {}", overlay.target_area_defect);
    assert!((measured.source_area - 1.0).abs() < 1e-9, "{name}: {}", measured.source_area);
    assert!((measured.target_area - 1.0).abs() < 1e-9, "{name}: {}", measured.target_area);
    returns(name, [source, target], &overlay);
    assert!(measured.energy >= 4.0 && measured.mean >= 1.0, "{name}: {}", measured.energy);
}

/// Checks that 2000 points return from source to target to source, and 2000 from target to source to target; a generator with a fixed seed
/// chooses them.
fn returns(name: &str, [source, target]: [Parametrised<'_>; 2], overlay: &overlay::Overlay) {
    let map = PointMap::new(source, target, overlay);
    let [from, onto] = [source, target].map(|side| side.mesh);
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut point = |mesh: &SurfaceMesh| {
        let face = FaceId::from((random() * mesh.face_count() as f64) as usize);
        let (u, v) = (random(), random());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        SurfacePoint { face, barycentric: [1.0 - u - v, u, v] }
    };
    let mut worst = 0.0_f64;
    for _ in 0..2000 {
        let (p, q) = (point(from), point(onto));
        let back = map.source_from_target(map.target_from_source(p));
        worst = worst.max(back.position(from).distance(p.position(from)));
        let there = map.target_from_source(map.source_from_target(q));
        worst = worst.max(there.position(onto).distance(q.position(onto)));
    }
    assert!(worst < 1e-9, "{name}: {worst}");
}

/// Makes the map of a case and checks its certificate, its energy against the bound, the flat metrics, the images, and that landmarks go to
/// landmarks.
pub fn map_is_certified(case: &Case, largest_energy: f64) -> MapResult {
    let Case { name, landmarks, .. } = case;
    let result = case.map();
    let report = &result.report;
    let certificate = report.certificate.as_ref().expect("the relaxed map has a certificate");
    assert!(certificate.bijective && certificate.flipped_triangles == 0, "{name}: {certificate:?}");
    assert!(certificate.max_angle_sum_error < 1e-6, "{name}: {certificate:?}");
    let energy = report.distortion.energy;
    assert!((4.0..largest_energy).contains(&energy), "{name}: energy {energy}");
    assert_eq!(report.unmapped_share, 0.0);
    for flow in [&report.cone_metric.source, &report.cone_metric.target] {
        let error = flow.as_ref().map(|flow| flow.max_curvature_error);
        assert!(error.is_some_and(|e| e <= FlowOptions::default().tolerance), "{name}: {flow:?}");
    }
    let total: f64 = result.cone_curvatures.iter().sum();
    assert!((total - 4.0 * PI).abs() < 1e-8, "{name}: total curvature {total}");

    let images = images(&result);
    assert_eq!(images.len(), case.source.vertex_count());
    for image in &images {
        assert!(image.face.index() < case.target.face_count());
        assert!((image.barycentric.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{name}: {image:?}");
        assert!(image.barycentric.iter().all(|w| *w >= -1e-9), "{name}: {image:?}");
    }
    let scale = case.target.area().sqrt();
    for (&s, &t) in landmarks.source.iter().zip(&landmarks.target) {
        let miss = images[s.index()].position(&case.target).distance(case.target.positions()[t]);
        assert!(miss < 1e-9 * scale, "{name}: landmark {s:?} is missed by {miss}");
    }
    result
}

/// Checks that the map from target to source is the inverse of the map from source to target.
pub fn exchange_gives_the_inverse(case: &Case) {
    let name = &case.name;
    let (forth, inverse) = (case.map(), case.exchanged().map());
    let [first, second] = [&forth.report, &inverse.report];
    assert!(
        (first.distortion.energy - second.distortion.energy).abs() < 1e-9,
        "{name}: {first:?} {second:?}"
    );
    assert_eq!(first.layout, second.layout, "{name}");
    for (v, image) in case.source.vertices().zip(images(&forth)) {
        let image = image.position(&case.target);
        let miss = preimage(&inverse, case.source.positions()[v], &case.source).distance(image);
        assert!(miss < 1e-9 * case.target.area().sqrt(), "{name}: {v:?} is missed by {miss}");
    }
}

/// The place on the source that a map takes to the target's vertex at `place`.
fn preimage(map: &MapResult, place: DVec3, target: &SurfaceMesh) -> DVec3 {
    let common = &map.common;
    let nearest = common.target_positions.iter().zip(&common.source_positions);
    let found = nearest.min_by(|a, b| a.0.distance_squared(place).total_cmp(&b.0.distance_squared(place)));
    let (there, here) = found.expect("the overlay has points");
    assert!(there.distance(place) < 1e-9 * target.area().sqrt(), "the overlay has every vertex");
    *here
}

/// Checks that a mesh is mapped onto itself by the identity.
pub fn identity_is_found(name: &str, mesh: &SurfaceMesh, chosen: &[VertexId]) {
    let landmarks = Landmarks { source: chosen.to_vec().into(), target: chosen.to_vec().into() };
    let ground_truth = GroundTruth::SameConnectivity;
    let case =
        Case { name: name.into(), source: mesh.clone(), target: mesh.clone(), landmarks, ground_truth };
    let result = case.map();
    let distortion = &result.report.distortion;
    // Coincident edges are separated by small shifts, which change the measures by a millionth beside landmarks.
    assert!((distortion.energy - 4.0).abs() < 1e-5, "{name}: {distortion:?}");
    assert!((distortion.mean - 1.0).abs() < 1e-5, "{name}: {distortion:?}");
    let bound = 1e-6 * mesh.area().sqrt();
    for (v, image) in mesh.vertices().zip(images(&result)) {
        let miss = image.position(mesh).distance(mesh.positions()[v]);
        assert!(miss < bound, "{name}: vertex {v:?} is missed by {miss}");
    }
}

/// A monitor that stops the run at the n-th step, or never when there is no such step.
struct StopAt {
    steps: usize,
    limit: usize,
}

impl Monitor for StopAt {
    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        assert!((0.0..=1.0).contains(&step.fraction), "{step:?}");
        if self.steps == self.limit {
            return Err(Cancelled);
        }
        self.steps += 1;
        Ok(())
    }
}

/// Checks that a second run gives the same result to the last bit, and that a run stops at the step at which it is asked to.
pub fn run_repeats_and_stops(case: &Case) {
    let name = &case.name;
    let options = PipelineOptions::default();
    let mut counter = StopAt { steps: 0, limit: usize::MAX };
    let first = run(case.input(), &options, &mut counter).unwrap_or_else(|e| panic!("{name}: {e}"));
    let second = case.map();
    assert_eq!(first.target_from_source, second.target_from_source, "{name}");
    assert_eq!(first.report, second.report, "{name}");

    let total = counter.steps;
    assert!(total > 20, "{name}: only {total} steps");
    for limit in [0, 1, total / 2, total - 1] {
        let mut monitor = StopAt { steps: 0, limit };
        let outcome = run(case.input(), &options, &mut monitor);
        let stopped = matches!(outcome, Err(PipelineError::Cancelled(_)));
        assert!(stopped && monitor.steps == limit, "{name}: step {limit} of {total}: not stopped");
    }
}

/// Checks that the thesis' patchwise map reports what it leaves out.
pub fn patchwise_map_tells_what_is_missing(case: &Case) {
    let Case { name, source, target, landmarks, .. } = case;
    let options = PipelineOptions { method: Method::Thesis, ..PipelineOptions::default() };
    let result = run(case.input(), &options, &mut Silent).unwrap_or_else(|e| panic!("{name}: {e}"));
    let report = &result.report;
    assert!(report.certificate.is_none(), "{name}");
    assert!((0.0..0.3).contains(&report.unmapped_share), "{name}: {}", report.unmapped_share);
    let unmapped = result.target_from_source.iter().filter(|image| image.is_none()).count();
    assert_eq!(report.unmapped_share, unmapped as f64 / source.vertex_count() as f64, "{name}");
    let is_told = report.warnings.iter().any(|w| matches!(w, Warning::Unmapped { .. }));
    assert_eq!(is_told, unmapped > 0, "{name}: {:?}", report.warnings);
    assert!(report.distortion.mean >= 1.0 && report.distortion.mean.is_finite(), "{name}");
    let scale = target.area().sqrt();
    for (&s, &t) in landmarks.source.iter().zip(&landmarks.target) {
        let image = result.target_from_source[s].expect("landmarks have images");
        let miss = image.position(target).distance(target.positions()[t]);
        assert!(miss < 1e-9 * scale, "{name}: landmark {s:?} is missed by {miss}");
    }
    let common = &result.common;
    assert!(!common.triangles.is_empty() && common.triangles.len() <= source.face_count(), "{name}");
    assert!(common.uvs.iter().all(|uv| uv.is_finite()), "{name}");
}

/// The case with `count` of its landmarks, chosen as farthest points in space on the source, beginning with the landmark farthest from
/// their mean.
pub fn farthest_landmarks(case: &Case, count: usize) -> Case {
    let all = &case.landmarks;
    let places: Vec<DVec3> = all.source.iter().map(|&v| case.source.positions()[v]).collect();
    let mean = places.iter().sum::<DVec3>() / places.len() as f64;
    let mut nearest: Vec<f64> = places.iter().map(|p| p.distance(mean)).collect();
    let mut chosen: Vec<usize> = Vec::new();
    while chosen.len() < count {
        let far = (0..places.len()).max_by(|&a, &b| nearest[a].total_cmp(&nearest[b])).unwrap();
        for (distance, p) in nearest.iter_mut().zip(&places) {
            let here = p.distance(places[far]);
            *distance = if chosen.is_empty() { here } else { distance.min(here) };
        }
        chosen.push(far);
    }
    case.only(&chosen)
}

/// Makes the maps with and without the program's own cones, and checks that the base domain has the landmarks alone as vertices, and that
/// the map with cones meets the landmarks on the mesh that was given.
pub fn maps_with_and_without_own_cones(case: &Case) -> [MapResult; 2] {
    let Case { name, target, landmarks, .. } = case;
    let usual = OwnConeOptions::default();
    let [with, without] = [usual, OwnConeOptions { count: 0, ..usual }].map(|own_cones| {
        let options = PipelineOptions { own_cones, ..PipelineOptions::default() };
        let result = run(case.input(), &options, &mut Silent).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(result.report.certificate.as_ref().unwrap().bijective, "{name}");
        assert_eq!(result.base.mesh.vertex_count(), landmarks.len(), "{name}");
        result
    });
    assert_eq!(without.report.own_landmarks, 0, "{name}");
    assert!((1..=usual.most).contains(&with.report.own_landmarks), "{name}: {}", with.report.own_landmarks);
    for (&s, &t) in landmarks.source.iter().zip(&landmarks.target) {
        let image = with.target_from_source[s].unwrap();
        let miss = image.position(target).distance(target.positions()[t]);
        assert!(miss < 1e-9 * target.area().sqrt(), "{name}: landmark {s:?} is missed by {miss}");
    }
    [with, without]
}
