//! The discrete Ricci flow, solved by Newton with conjugate gradients.

use super::metric::{ConeMetric, FlipQueue, FlowState};
use super::record::{FlowMoment, FlowRecord, Recorder};
use super::scheme::Scheme;
use super::target::{self, TargetError};
use crate::mesh::{FaceId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Step};
use crate::numerics::approximate_cholesky::ApproximateCholesky;
use crate::numerics::conjugate_gradients::{CgError, CgOptions, CgWorkspace};
use crate::numerics::graph::Graph;
use typed_index_collections::{TiSlice, TiVec};

/// Options of the flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowOptions {
    /// The discrete conformal structure.
    pub scheme: Scheme,
    /// Stops when max |target - curvature| is below this, in radians.
    pub tolerance: f64,
    /// Factor on the initial radii, in (0, 1): below 1 no two circles touch.
    pub radii_scale: f64,
    /// Newton steps at most.
    pub max_steps: usize,
}

impl Default for FlowOptions {
    fn default() -> Self {
        // homer takes 4 steps; on the fixed triangulation 100 are not enough either. Chosen by hand.
        Self { scheme: Scheme::default(), tolerance: 1e-8, radii_scale: 0.9, max_steps: 100 }
    }
}

/// Steps, iterations and residuals of a flow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlowReport {
    /// Accepted Newton steps.
    pub newton_steps: usize,
    /// Conjugate gradient iterations of all steps.
    pub cg_iterations: usize,
    /// Newton steps whose linear system was not solved to its tolerance.
    pub inexact_steps: usize,
    /// Edge flips, those of rejected trial steps included.
    pub edge_flips: usize,
    /// max |target - curvature| at the end, in radians.
    pub max_curvature_error: f64,
    /// max |target - curvature| before the first step and after each step, in radians.
    pub residuals: Vec<f64>,
    /// On a triangulation that is not flipped the faces that kept the last step short: a little further along it their lengths break the
    /// triangle inequality. None where no face did.
    pub degenerate_faces: Vec<FaceId>,
}

/// Why there is no cone metric.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlowError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// No metric has these curvatures.
    #[error(transparent)]
    Target(#[from] TargetError),
    /// The tolerance was not reached.
    #[error(
        "the flow did not converge: largest curvature error {:.3e} rad after {} steps ({} of them inexact), best {best:.3e} rad",
        report.max_curvature_error,
        report.newton_steps,
        report.inexact_steps
    )]
    NotConverged {
        /// The least of the report's residuals, in radians.
        best: f64,
        /// The report of the steps that were taken.
        report: Box<FlowReport>,
    },
}

/// Deforms a mesh's metric conformally to the target curvatures (angle defects in radians, sum 4 pi, each below 2 pi).
///
/// # Errors
/// [`FlowError::Target`] before anything is computed; [`FlowError::NotConverged`], which the fixed triangulation ends in
/// where triangles degenerate.
pub fn flow(
    mesh: &SurfaceMesh,
    target_curvature: &TiVec<VertexId, f64>,
    options: &FlowOptions,
    monitor: &mut dyn Monitor,
) -> Result<(ConeMetric, FlowReport), FlowError> {
    target::check(target_curvature)?;
    monitor.step(Step::default())?;
    let metric = ConeMetric::of_mesh(mesh, options.scheme, options.radii_scale);
    monitor.step(Step::default())?;
    Newton::new(metric, target_curvature, options).run(monitor)
}

/// Runs [`flow`] and records its steps, also where it does not converge.
///
/// # Errors
/// [`FlowError::Target`] before anything is computed; [`FlowError::Cancelled`].
pub fn recorded_flow(
    mesh: &SurfaceMesh,
    target_curvature: &TiVec<VertexId, f64>,
    options: &FlowOptions,
    monitor: &mut dyn Monitor,
) -> Result<FlowRecord, FlowError> {
    target::check(target_curvature)?;
    let metric = ConeMetric::of_mesh(mesh, options.scheme, options.radii_scale);
    let mut recorder = Recorder::new(metric.log_radii.clone());
    let mut newton = Newton::new(metric, target_curvature, options);
    newton.recorder = Some(&mut recorder);
    match newton.run(monitor) {
        Ok(_) => Ok(recorder.record(None)),
        Err(FlowError::NotConverged { report, .. }) => Ok(recorder.record(Some(report.degenerate_faces))),
        Err(error) => Err(error),
    }
}

/// Conjugate gradient iterations of one Newton step, at most: a bound on the time of a system that does not converge. Chosen by hand.
const LINEAR_ITERATIONS: usize = 1000;

/// Steps after which a flow that has not halved its least residual ends. Chosen by hand.
const STUCK_STEPS: usize = 10;

struct Newton<'a> {
    metric: ConeMetric,
    target: &'a TiVec<VertexId, f64>,
    options: &'a FlowOptions,
    state: FlowState,
    queue: FlipQueue,
    report: FlowReport,
    /// The record of the steps, where one is wanted.
    recorder: Option<&'a mut Recorder>,
}

impl<'a> Newton<'a> {
    fn new(metric: ConeMetric, target: &'a TiVec<VertexId, f64>, options: &'a FlowOptions) -> Self {
        Self {
            metric,
            target,
            options,
            state: FlowState::default(),
            queue: FlipQueue::default(),
            report: FlowReport::default(),
            recorder: None,
        }
    }

    /// Records the present state, where a record is wanted.
    fn tell(&mut self, residual: f64) {
        let FlowReport { newton_steps: step, cg_iterations, edge_flips, .. } = self.report;
        if let Some(recorder) = &mut self.recorder {
            let moment = FlowMoment { step, residual, cg_iterations, edge_flips, log_factors: TiVec::new() };
            recorder.take(moment, &self.metric.log_radii, TiSlice::from_ref(&self.state.curvature));
        }
    }

    fn run(mut self, monitor: &mut dyn Monitor) -> Result<(ConeMetric, FlowReport), FlowError> {
        let n = self.target.len();
        let (mut residual, mut step, mut start) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let (mut graph, mut cg) = (Graph::default(), CgWorkspace::default());
        self.update();
        let mut error = self.residual(&mut residual);
        self.report.residuals.push(error);
        self.tell(error);
        monitor.step(Step::default())?;
        while error >= self.options.tolerance
            && self.report.newton_steps < self.options.max_steps
            && !self.is_stuck()
        {
            monitor.step(Step { fraction: self.fraction(error), residual: Some(error) })?;
            self.metric.hessian(&self.state, &mut graph);
            monitor.step(Step { fraction: self.fraction(error), residual: Some(error) })?;
            let fraction = self.fraction(error);
            let within = &mut Portion::new(monitor, fraction, fraction);
            let preconditioner = ApproximateCholesky::watched(&graph, within)?;
            // Inexact Newton: a tolerance that falls with the curvature error (radians) keeps the quadratic convergence.
            let tolerance = (0.1 * error).clamp(1e-8, 0.1);
            let options = CgOptions { tolerance, max_iterations: LINEAR_ITERATIONS };
            within.step(Step::default())?;
            let mut stopped = Ok(());
            let may_go_on = || {
                stopped = within.step(Step { fraction, residual: Some(error) });
                stopped.is_ok()
            };
            let solved = cg.solve_while(&graph, &preconditioner, &residual, &mut step, &options, may_go_on);
            stopped?;
            let solved = match solved {
                Ok(solved) => solved,
                // No step at all: the line search would take it for a step that lowers the energy.
                Err(CgError::NotDefinite { report, .. }) if report.iterations == 0 => break,
                // The last iterate is a direction of descent of the energy, which is convex: the line search takes as much of it
                // as helps.
                Err(error) => {
                    self.report.inexact_steps += 1;
                    error.report()
                }
            };
            self.report.cg_iterations += solved.iterations;
            start.copy_from_slice(self.metric.log_radii.as_ref());
            if !self.line_search(&start, &step, &mut residual, monitor)? {
                break;
            }
            error = self.residual(&mut residual);
            self.report.newton_steps += 1;
            self.report.residuals.push(error);
            self.tell(error);
        }
        self.report.max_curvature_error = error;
        if error < self.options.tolerance {
            self.report.degenerate_faces.clear();
            return Ok((self.metric, self.report));
        }
        Err(FlowError::NotConverged { best: self.best(), report: Box::new(self.report) })
    }

    /// The least residual so far.
    fn best(&self) -> f64 {
        self.report.residuals.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Whether the last steps, which flip edges, have not halved the least residual: triangles thinner than about 1e-8 of their length are lost
    /// in rounding.
    fn is_stuck(&self) -> bool {
        let residuals = &self.report.residuals;
        let Some(first) = residuals.len().checked_sub(STUCK_STEPS).filter(|&first| first > 0) else {
            return false;
        };
        let least = |part: &[f64]| part.iter().copied().fold(f64::INFINITY, f64::min);
        self.options.scheme.flips() && least(&residuals[first..]) > 0.5 * least(&residuals[..first])
    }

    /// Progress on a logarithmic scale of the residual.
    fn fraction(&self, error: f64) -> f64 {
        let scale = |x: f64| crate::math::scalar::ln((x / self.options.tolerance).max(1.0));
        let whole = scale(self.report.residuals[0]);
        if whole > 0.0 { (1.0 - scale(error) / whole).clamp(0.0, 1.0) } else { 1.0 }
    }

    /// Restores weighted Delaunay and evaluates curvatures; `false` where a triangle is degenerate.
    fn update(&mut self) -> bool {
        if self.options.scheme.flips() {
            self.report.edge_flips += self.metric.restore_delaunay(&mut self.queue);
        }
        self.metric.curvature(&mut self.state)
    }

    /// target - curvature, and its largest absolute value.
    fn residual(&self, residual: &mut [f64]) -> f64 {
        let mut worst = 0.0_f64;
        for ((r, k), goal) in residual.iter_mut().zip(&self.state.curvature).zip(self.target.iter()) {
            *r = goal - k;
            worst = worst.max(r.abs());
        }
        worst
    }

    /// Moves along the step by the largest power of 1/2 at which the energy still falls, or nearly so. Returns `false` and stays where
    /// there is none.
    fn line_search(
        &mut self,
        start: &[f64],
        step: &[f64],
        residual: &mut [f64],
        monitor: &mut dyn Monitor,
    ) -> Result<bool, Cancelled> {
        let slope = |r: &[f64]| r.iter().zip(step).map(|(a, b)| a * b).sum::<f64>();
        let first = slope(residual);
        self.report.degenerate_faces.clear();
        let mut t = 1.0;
        // 2^-30 of a step is lost in rounding. The slope may turn a little, to -0.1 of the first: a minimum that was just passed.
        for _ in 0..30 {
            for ((u, s), d) in self.metric.log_radii.iter_mut().zip(start).zip(step) {
                *u = s + t * d;
            }
            monitor.step(Step { fraction: self.fraction(self.best()), residual: None })?;
            let valid = self.update();
            let error = self.residual(residual);
            if valid && error.is_finite() && slope(residual) >= -0.1 * first {
                return Ok(true);
            }
            if !valid && !self.options.scheme.flips() {
                self.report.degenerate_faces = self.metric.degenerate_faces();
            }
            t *= 0.5;
        }
        self.metric.log_radii.iter_mut().zip(start).for_each(|(u, s)| *u = *s);
        self.update();
        self.residual(residual);
        Ok(false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cone_metric::atlas::mesh_displacements;
    use crate::cone_metric::uniform_curvature;
    use crate::math::triangle::area_from_lengths;
    use crate::mesh::HalfedgeId;
    use crate::mesh::generators::{icosphere, midpoint_subdivision, tetrahedron};
    use crate::monitor::Silent;
    use crate::numerics::conjugate_gradients::LinearOperator;
    use glam::DVec3;
    use std::f64::consts::PI;

    /// Radii away from the start, so that the state is not special.
    fn moved(scheme: Scheme) -> ConeMetric {
        let mesh = icosphere(2);
        let mut metric = ConeMetric::of_mesh(&mesh, scheme, 0.9);
        for (k, u) in metric.log_radii.iter_mut().enumerate() {
            *u += 1.5 * crate::math::scalar::sin(1.7 * k as f64);
        }
        restore(&mut metric, scheme);
        metric
    }

    fn restore(metric: &mut ConeMetric, scheme: Scheme) {
        if scheme.flips() {
            metric.restore_delaunay(&mut FlipQueue::default());
        }
    }

    fn curvature(metric: &ConeMetric) -> Vec<f64> {
        let mut state = FlowState::default();
        assert!(metric.curvature(&mut state));
        state.curvature
    }

    #[test]
    fn gauss_bonnet_holds_at_every_state() {
        for scheme in Scheme::ALL.into_iter().filter(|&scheme| scheme != Scheme::FixedTriangulation) {
            let metric = moved(scheme);
            assert_eq!(metric.triangulation.flips().is_empty(), !scheme.flips());
            assert!(metric.triangulation.is_consistent());
            assert!((curvature(&metric).iter().sum::<f64>() - 4.0 * PI).abs() < 1e-10);
        }
    }

    #[test]
    fn a_recorded_flow_knows_its_curvature_before_and_after() {
        let mesh = icosphere(2);
        let mut target = TiVec::from(vec![0.0; mesh.vertex_count()]);
        (0..4).for_each(|k| target[VertexId(k)] = PI);
        let options = FlowOptions::default();
        let record = recorded_flow(&mesh, &target, &options, &mut Silent).unwrap();
        let metric = ConeMetric::of_mesh(&mesh, options.scheme, options.radii_scale);
        for (k, (recorded, own)) in record.curvature[0].iter().zip(curvature(&metric)).enumerate() {
            assert!((recorded - own).abs() < 1e-12, "{k}");
        }
        for (recorded, wanted) in record.curvature[1].iter().zip(&target) {
            assert!((recorded - wanted).abs() <= options.tolerance);
        }
        // Gauss-Bonnet, in units of a sphere's.
        let areas = mesh.vertex_areas();
        let [before, after] = record.curvature_by_area(&areas);
        for (moment, curvatures) in [(&record.moments[0], &before), (record.moments.last().unwrap(), &after)]
        {
            let share = |v: VertexId| areas[v] * crate::math::scalar::exp(2.0 * moment.log_factors[v]);
            let whole: f64 = mesh.vertices().map(share).sum();
            let mean = mesh.vertices().map(|v| curvatures[v] * share(v)).sum::<f64>() / whole;
            assert!((mean - 1.0).abs() < 1e-10, "{mean}");
        }
        assert!(before.iter().all(|k| (k - 1.0).abs() < 0.2) && after[VertexId(5)].abs() < 1e-6);
    }

    #[test]
    fn the_hessian_is_the_derivative_of_curvature() {
        for scheme in Scheme::ALL.into_iter().filter(|&scheme| scheme != Scheme::FixedTriangulation) {
            let metric = moved(scheme);
            let mut state = FlowState::default();
            metric.curvature(&mut state);
            let mut graph = Graph::default();
            metric.hessian(&state, &mut graph);
            let n = metric.log_radii.len();
            let mut exact = vec![0.0; n];
            let direction: Vec<f64> = (0..n).map(|k| crate::math::scalar::cos(0.9 * k as f64)).collect();
            graph.apply(&direction, &mut exact);
            let at = |h: f64| {
                let mut near = metric.clone();
                near.log_radii.iter_mut().zip(&direction).for_each(|(u, d)| *u += h * d);
                restore(&mut near, scheme);
                curvature(&near)
            };
            let (plus, minus) = (at(1e-6), at(-1e-6));
            for k in 0..n {
                let quotient = (plus[k] - minus[k]) / 2e-6;
                assert!((quotient - exact[k]).abs() < 1e-5, "{scheme:?} {k}: {quotient} {}", exact[k]);
            }
        }
    }

    #[test]
    fn the_residual_is_the_gradient_of_a_convex_energy() {
        // The line integral of target - K around a closed curve vanishes: a gradient.
        let metric = moved(Scheme::Inversive);
        let n = metric.log_radii.len();
        let direction =
            |a: f64| -> Vec<f64> { (0..n).map(|k| 0.05 * crate::math::scalar::sin(a * k as f64)).collect() };
        let (p, q) = (direction(1.3), direction(2.9));
        let at = |s: f64, t: f64| {
            let mut near = metric.clone();
            near.log_radii.iter_mut().enumerate().for_each(|(k, u)| *u += s * p[k] + t * q[k]);
            near.restore_delaunay(&mut FlipQueue::default());
            curvature(&near)
        };
        let dot = |k: &[f64], d: &[f64]| k.iter().zip(d).map(|(a, b)| a * b).sum::<f64>();
        let steps = 40;
        let mut integral = 0.0;
        for i in 0..steps {
            let m = (i as f64 + 0.5) / f64::from(steps);
            let h = 1.0 / f64::from(steps);
            integral += h
                * (dot(&at(m, 0.0), &p) + dot(&at(1.0, m), &q) - dot(&at(m, 1.0), &p) - dot(&at(0.0, m), &q));
        }
        assert!(integral.abs() < 1e-4, "{integral}");
    }

    /// The regular tetrahedron, each triangle split into 256 and blown up to the unit sphere. The first vertices are its own.
    fn blown_up_tetrahedron() -> SurfaceMesh {
        let fine = (0..4).fold(tetrahedron(), |mesh, _| midpoint_subdivision(&mesh));
        fine.with_positions(fine.positions().iter().map(|p| p.normalize()).collect())
    }

    /// The vertices on the arc between two of the tetrahedron's corners, both ends included.
    fn side(mesh: &SurfaceMesh, ends: [VertexId; 2]) -> Vec<VertexId> {
        let [p, q] = ends.map(|v| mesh.positions()[v]);
        let normal = p.cross(q).normalize();
        let mut along = vec![ends[0]];
        while along[along.len() - 1] != ends[1] {
            let here = along[along.len() - 1];
            let further = |v: &VertexId| {
                let place = mesh.positions()[*v];
                place.dot(normal).abs() < 1e-12 && place.dot(q) > mesh.positions()[here].dot(q)
            };
            along.push(mesh.star(here).map(|h| mesh.head(h)).find(further).expect("a vertex on the arc"));
        }
        along
    }

    /// Four vertices in tetrahedral position flow to the regular tetrahedron. A flat surface with four cones of angle pi is the
    /// boundary of a tetrahedron with congruent faces; it is regular where all six distances d of its cones agree, and then its
    /// area is sqrt(3) d^2. The arcs between the vertices are mirror lines of the surface, so they stay geodesics.
    #[test]
    fn the_unit_sphere_becomes_the_regular_tetrahedron() {
        let sphere = blown_up_tetrahedron();
        let landmarks: Vec<_> = (0..4).map(VertexId).collect();
        let target = uniform_curvature(sphere.vertex_count(), &landmarks);
        for scheme in Scheme::ALL {
            let options = FlowOptions { scheme, tolerance: 1e-11, ..FlowOptions::default() };
            let (metric, _) = flow(&sphere, &target, &options, &mut Silent).unwrap();
            for (v, k) in sphere.vertices().zip(curvature(&metric)) {
                let goal = if v.index() < 4 { PI } else { 0.0 };
                assert!((k - goal).abs() < 1e-10, "{scheme:?}: curvature {k} at {v:?}");
            }
            for &v in &landmarks {
                let apart = metric.log_radii[v] - metric.log_radii[landmarks[0]];
                assert!(apart.abs() < 1e-9, "{scheme:?}: radii {apart} apart");
            }
            let displacements = mesh_displacements(&metric);
            let length = |ends: [VertexId; 2]| {
                let step = |pair: &[VertexId]| {
                    let edge = sphere.star(pair[0]).find(|&h| sphere.head(h) == pair[1]).expect("an edge");
                    displacements[edge].length()
                };
                side(&sphere, ends).windows(2).map(step).sum::<f64>()
            };
            let lengths = metric.lengths();
            let corners = |f| [0, 1, 2].map(|k| lengths[HalfedgeId::of(f, k)]);
            let area: f64 = metric
                .triangulation
                .faces()
                .map(|f| {
                    let [a, b, c] = corners(f);
                    area_from_lengths(a, b, c)
                })
                .sum();
            let regular = (area / 3.0_f64.sqrt()).sqrt();
            for (a, b) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
                let found = length([landmarks[a], landmarks[b]]);
                assert!((found / regular - 1.0).abs() < 1e-9, "{scheme:?}: {a} to {b}: {found}, {regular}");
            }
        }
    }

    /// The record agrees with the flow: its residuals, and at the end its metric.
    #[test]
    fn the_record_is_the_flow() {
        let sphere = blown_up_tetrahedron();
        let landmarks: Vec<_> = (0..4).map(VertexId).collect();
        let target = uniform_curvature(sphere.vertex_count(), &landmarks);
        for scheme in [Scheme::Inversive, Scheme::VertexScaling] {
            let options = FlowOptions { scheme, ..FlowOptions::default() };
            let start = ConeMetric::of_mesh(&sphere, scheme, options.radii_scale);
            let (metric, report) = flow(&sphere, &target, &options, &mut Silent).unwrap();
            let record = recorded_flow(&sphere, &target, &options, &mut Silent).unwrap();
            assert!(record.converged);
            let residuals: Vec<f64> = record.moments.iter().map(|moment| moment.residual).collect();
            assert_eq!(residuals, report.residuals);
            let last = &record.moments[record.moments.len() - 1];
            assert_eq!((last.cg_iterations, last.edge_flips), (report.cg_iterations, report.edge_flips));
            for v in sphere.vertices() {
                assert_eq!(last.log_factors[v], metric.log_radii[v] - start.log_radii[v]);
                assert_eq!(record.moments[0].log_factors[v], 0.0);
            }
            // The corners are drawn out of the sphere: lengths grow there.
            let centred = record.centred(&sphere.vertex_areas());
            let last = &centred.moments[centred.moments.len() - 1].log_factors;
            assert!(landmarks.iter().all(|&v| last[v] > 0.1), "{scheme:?}");
        }
    }

    #[test]
    fn a_flow_that_does_not_converge_is_recorded_as_far_as_it_came() {
        let sphere = blown_up_tetrahedron();
        let landmarks: Vec<_> = (0..4).map(VertexId).collect();
        let target = uniform_curvature(sphere.vertex_count(), &landmarks);
        let options = FlowOptions { max_steps: 1, ..FlowOptions::default() };
        let record = recorded_flow(&sphere, &target, &options, &mut Silent).unwrap();
        assert!(!record.converged);
        assert_eq!(record.moments.iter().map(|moment| moment.step).collect::<Vec<_>>(), [0, 1]);
    }

    /// Three circles of any radii that touch, or overlap by at most a right angle, have centres that span a triangle (Thurston 1980, lemma
    /// 13.7.2).
    #[test]
    fn circles_that_touch_or_overlap_always_span_triangles() {
        for scheme in [Scheme::Tangential, Scheme::Thurston] {
            let mut metric = moved(scheme);
            for stretch in [1.0, 1.5, 1.5] {
                metric.log_radii.iter_mut().for_each(|u| *u *= stretch);
                assert_eq!(metric.degenerate_faces(), [], "{scheme:?} {stretch}");
            }
        }
        assert!(!moved(Scheme::FixedTriangulation).degenerate_faces().is_empty());
    }

    /// On a rod whose triangles are long the flow without flips stops at a triangle that has hardly any area left; the others go through.
    #[test]
    fn a_flow_without_flips_stops_at_triangles_that_lose_their_area() {
        let sphere = blown_up_tetrahedron();
        let rod = sphere
            .with_positions(sphere.positions().iter().map(|p| DVec3::new(8.0 * p.x, p.y, p.z)).collect());
        let landmarks: Vec<_> = (0..4).map(VertexId).collect();
        let target = uniform_curvature(rod.vertex_count(), &landmarks);
        for scheme in Scheme::ALL {
            let options = FlowOptions { scheme, ..FlowOptions::default() };
            let record = recorded_flow(&rod, &target, &options, &mut Silent).unwrap();
            assert_eq!(record.converged, scheme != Scheme::FixedTriangulation, "{scheme:?}");
            assert_eq!(record.degenerate_faces.is_empty(), record.converged, "{scheme:?}");
            let Err(FlowError::NotConverged { report, .. }) = flow(&rod, &target, &options, &mut Silent)
            else {
                continue;
            };
            assert_eq!(report.degenerate_faces, record.degenerate_faces);
            let mut stopped = ConeMetric::of_mesh(&rod, scheme, options.radii_scale);
            let last = &record.moments[record.moments.len() - 1].log_factors;
            stopped.log_radii.iter_mut().zip(last).for_each(|(u, factor)| *u += factor);
            for f in record.degenerate_faces {
                let lengths = f.halfedges().map(|h| stopped.length(h));
                let longest = lengths.iter().copied().fold(0.0, f64::max);
                let slack = (lengths.iter().sum::<f64>() - 2.0 * longest) / longest;
                assert!((0.0..1e-3).contains(&slack), "{f:?}: {slack}");
            }
        }
    }

    #[test]
    fn wrong_targets_are_refused_with_their_numbers() {
        let mesh = icosphere(1);
        let flat = typed_index_collections::ti_vec![0.0; mesh.vertex_count()];
        let error = flow(&mesh, &flat, &FlowOptions::default(), &mut Silent).unwrap_err();
        assert_eq!(error, FlowError::Target(TargetError::WrongSum { sum: 0.0 }));
        let mut spike = flat.clone();
        spike[VertexId(3)] = 7.0;
        let error = flow(&mesh, &spike, &FlowOptions::default(), &mut Silent).unwrap_err();
        assert_eq!(error, FlowError::Target(TargetError::TooLarge { vertex: 3, defect: 7.0 }));
    }
}
