//! The flat relaxation: minimises the symmetric Dirichlet energy of a parametrisation onto the cone surface.
//!
//! The unknowns are one point z per free vertex, in the plane of its first face; fixed rigid motions take it to the planes of its other
//! faces. Newton's method uses the projected Hessian of [`crate::surface_map::energy::symmetric_dirichlet`], conjugate gradients, a step
//! that keeps every triangle positive (Smith & Schaefer 2015) and an Armijo line search.

use super::rest_triangle::{Corner, FlatTriangle};
use crate::math::rigid2::Rigid2;
use crate::math::scalar::min;
use crate::monitor::{Cancelled, Monitor, Portion, Step};
use crate::numerics::block_csr::BlockCsr;
use crate::numerics::conjugate_gradients::{CgOptions, CgWorkspace};
use crate::surface_map::energy::density::Density;
use crate::surface_map::energy::symmetric_dirichlet::SymmetricDirichlet;
use glam::{DMat2, DVec2};

/// Options of a flat relaxation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatRelaxOptions {
    /// Stops when a step lowers the energy by less than this share.
    pub relative_decrease: f64,
    /// Newton steps at most.
    pub max_steps: usize,
    /// Relative residual of the linear solves.
    pub linear_tolerance: f64,
}

impl Default for FlatRelaxOptions {
    fn default() -> Self {
        // Only a start for the relaxation of the map: less than converged is enough.
        // Chosen by hand, not measured at half and double.
        Self { relative_decrease: 1e-4, max_steps: 100, linear_tolerance: 0.03 }
    }
}

/// The energies and the work of a flat relaxation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlatRelaxReport {
    /// Energy before the first and after each step; area-weighted mean, 1 for an isometry.
    pub energies: Vec<f64>,
    /// Conjugate gradient iterations of all steps.
    pub cg_iterations: usize,
    /// Steps whose linear system was not solved to its tolerance.
    pub inexact_steps: usize,
}

/// A Hessian with respect to a Jacobian, in blocks by the Jacobian's columns.
#[derive(Clone, Copy, Debug)]
pub(in crate::surface_map) struct FaceHessian {
    xx: DMat2,
    xy: DMat2,
    yy: DMat2,
}

impl FaceHessian {
    pub const ZERO: Self = Self { xx: DMat2::ZERO, xy: DMat2::ZERO, yy: DMat2::ZERO };

    /// Adds `weight` m (x) m.
    #[inline]
    pub fn add(&mut self, weight: f64, m: &DMat2) {
        let (x, y) = (m.x_axis * weight, m.y_axis * weight);
        self.xx += DMat2::from_cols(x * m.x_axis.x, x * m.x_axis.y);
        self.xy += DMat2::from_cols(x * m.y_axis.x, x * m.y_axis.y);
        self.yy += DMat2::from_cols(y * m.y_axis.x, y * m.y_axis.y);
    }

    /// The block that belongs to a hat gradient g on the left and column `k` on the right.
    #[inline]
    fn row(&self, g: DVec2, k: usize) -> DMat2 {
        match k {
            0 => self.xx * g.x + self.xy.transpose() * g.y,
            _ => self.xy * g.x + self.yy * g.y,
        }
    }
}

/// The derivatives from which Newton's direction is computed, of an energy that includes the flat one with a weight.
pub(in crate::surface_map) struct Derivatives<'a> {
    /// The gradient of the whole energy.
    pub slope: &'a [DVec2],
    /// Weight of the flat energy, whose Hessian is added.
    pub barrier: f64,
    /// The Hessian of the remaining energy with respect to each triangle's Jacobian.
    pub by_triangle: &'a [FaceHessian],
    /// Hessians of single vertices' energies, by unknown.
    pub by_unknown: &'a [(u32, DMat2)],
}

/// How the linear system of a Newton step is made definite, and how exactly it is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::surface_map) struct NewtonSystem {
    /// Share of the Hessian's diagonal that is added to it.
    pub damping: f64,
    /// Relative residual at which the solve ends.
    pub tolerance: f64,
}

/// Triangles, unknowns and the matrix of one relaxation.
pub struct FlatProblem {
    triangles: Vec<FlatTriangle>,
    /// Place in the matrix of block (corner i, corner j) at `9 t + 3 i + j`; unused where a corner is fixed.
    places: Vec<u32>,
    matrix: BlockCsr,
    solver: NewtonSolver,
    total_area: f64,
}

/// The solver of Newton's linear systems, with its working memory and counts.
#[derive(Default)]
struct NewtonSolver {
    workspace: CgWorkspace<DVec2>,
    inverse_diagonal: Vec<DMat2>,
    iterations: usize,
    inexact: usize,
}

/// Conjugate gradient iterations of one Newton step, at most: a bound on the time of a system that does not converge. Chosen by hand.
const LINEAR_ITERATIONS: usize = 500;

impl NewtonSolver {
    /// Writes Newton's step to `step`; `downhill` is minus the gradient.
    ///
    /// A system that is not solved to the tolerance is counted, and its last iterate is the step: as every iterate from 0 it is a
    /// descent direction, and every caller goes along it only as far as its energy falls.
    ///
    /// # Errors
    /// [`Cancelled`].
    fn step(
        &mut self,
        matrix: &BlockCsr,
        downhill: &[DVec2],
        step: &mut [DVec2],
        tolerance: f64,
        monitor: &mut dyn Monitor,
    ) -> Result<(), Cancelled> {
        let options = CgOptions { tolerance, max_iterations: LINEAR_ITERATIONS };
        let sweeps = matrix.gauss_seidel(&mut self.inverse_diagonal);
        let (mut stopped, mut work) = (Ok(()), 0);
        let may_go_on = || {
            work += downhill.len();
            if work >= ASKED_EVERY {
                work = 0;
                stopped = monitor.step(Step::default());
            }
            stopped.is_ok()
        };
        let solved = self.workspace.solve_while(matrix, &sweeps, downhill, step, &options, may_go_on);
        stopped?;
        let report = match solved {
            Ok(report) => report,
            Err(error) => {
                self.inexact += 1;
                error.report()
            }
        };
        self.iterations += report.iterations;
        Ok(())
    }
}

/// Unknowns that a linear solve goes over between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 1 << 15;

impl FlatProblem {
    /// A problem of `free` unknown vertices.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn new(
        triangles: Vec<FlatTriangle>,
        free: usize,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let free_corner = |t: &FlatTriangle, k: usize| match t.corners[k] {
            Corner::Free(v, _) => Some(v),
            Corner::Fixed(_) => None,
        };
        let pairs = triangles.iter().flat_map(move |t| {
            (0..9).filter_map(move |k| Some((free_corner(t, k / 3)?, free_corner(t, k % 3)?)))
        });
        monitor.step(Step::default())?;
        let matrix = BlockCsr::with_pattern(free, pairs);
        monitor.step(Step::default())?;
        let mut places = vec![u32::MAX; triangles.len() * 9];
        for (t, triangle) in triangles.iter().enumerate() {
            for k in 0..9 {
                if let (Some(i), Some(j)) = (free_corner(triangle, k / 3), free_corner(triangle, k % 3)) {
                    places[9 * t + k] = matrix.place(i, j);
                }
            }
        }
        let total_area = triangles.iter().map(|t| t.area).sum();
        Ok(Self { triangles, places, matrix, solver: NewtonSolver::default(), total_area })
    }

    /// Area-weighted mean energy; `None` where a triangle is not positive.
    pub fn energy(&self, z: &[DVec2]) -> Option<f64> {
        let mut sum = 0.0;
        for t in &self.triangles {
            let density = SymmetricDirichlet.density(&t.jacobian(&t.positions(z)));
            if density == f64::INFINITY {
                return None;
            }
            sum += t.area * density;
        }
        Some(sum / self.total_area)
    }

    /// Gradient of [`FlatProblem::energy`] with respect to z.
    pub fn gradient(&self, z: &[DVec2], gradient: &mut [DVec2]) {
        gradient.fill(DVec2::ZERO);
        for t in &self.triangles {
            let slope = SymmetricDirichlet.gradient(&t.jacobian(&t.positions(z)));
            for (corner, hat) in t.corners.iter().zip(&t.hats) {
                if let Corner::Free(v, motion) = corner {
                    let pull = slope * *hat * (t.area / self.total_area);
                    gradient[*v as usize] += unrotate(motion, pull);
                }
            }
        }
    }

    fn assemble(&mut self, z: &[DVec2]) {
        self.matrix.clear();
        self.add_hessian(z, 1.0);
        // Above rounding, so that the matrix is positive definite.
        self.matrix.regularise(1e-10);
    }

    /// Adds the projected Hessian of [`FlatProblem::energy`], scaled.
    fn add_hessian(&mut self, z: &[DVec2], scale: f64) {
        for t in 0..self.triangles.len() {
            let triangle = &self.triangles[t];
            let weight = scale * triangle.area / self.total_area;
            let mut hessian = FaceHessian::ZERO;
            for term in SymmetricDirichlet.hessian(&triangle.jacobian(&triangle.positions(z))) {
                hessian.add(weight * term.weight, &term.matrix());
            }
            self.add_face(t, &hessian);
        }
    }

    /// Adds a Hessian with respect to the Jacobian of triangle `t`.
    #[inline]
    fn add_face(&mut self, t: usize, hessian: &FaceHessian) {
        let triangle = &self.triangles[t];
        let turns = triangle.corners.map(|corner| match corner {
            Corner::Free(_, motion) => motion.turn(),
            Corner::Fixed(_) => DMat2::ZERO,
        });
        for i in 0..3 {
            let half = [0, 1].map(|row| hessian.row(triangle.hats[i], row));
            let unturn = turns[i].transpose();
            for j in i..3 {
                let place = self.places[9 * t + 3 * i + j];
                if place == u32::MAX {
                    continue;
                }
                let g = triangle.hats[j];
                let block = unturn * (half[0] * g.x + half[1] * g.y) * turns[j];
                self.matrix.add_at(place, block);
                if i != j {
                    self.matrix.add_at(self.places[9 * t + 3 * j + i], block.transpose());
                }
            }
        }
    }

    /// Newton's direction at z.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub(in crate::surface_map) fn direction(
        &mut self,
        z: &[DVec2],
        derivatives: &Derivatives<'_>,
        system: NewtonSystem,
        monitor: &mut dyn Monitor,
    ) -> Result<Vec<DVec2>, Cancelled> {
        self.matrix.clear();
        self.add_hessian(z, derivatives.barrier);
        for (t, hessian) in derivatives.by_triangle.iter().enumerate() {
            self.add_face(t, hessian);
        }
        for (unknown, hessian) in derivatives.by_unknown {
            self.matrix.add_at(self.matrix.place(*unknown, *unknown), *hessian);
        }
        self.matrix.regularise(system.damping);
        let downhill: Vec<DVec2> = derivatives.slope.iter().map(|g| -*g).collect();
        let mut step = vec![DVec2::ZERO; z.len()];
        self.solver.step(&self.matrix, &downhill, &mut step, system.tolerance, monitor)?;
        Ok(step)
    }

    /// Directions so far whose linear system was not solved to its tolerance.
    pub(in crate::surface_map) fn inexact_steps(&self) -> usize {
        self.solver.inexact
    }

    /// The triangles.
    pub(in crate::surface_map) fn triangles(&self) -> &[FlatTriangle] {
        &self.triangles
    }

    /// The Jacobians of all triangles.
    pub(in crate::surface_map) fn jacobians<'s>(
        &'s self,
        z: &'s [DVec2],
    ) -> impl Iterator<Item = DMat2> + 's {
        self.triangles.iter().map(|t| t.jacobian(&t.positions(z)))
    }

    /// Lowers the energy from a valid z (every triangle positive) until a step gains too little.
    ///
    /// # Errors
    /// [`Cancelled`]; z is valid then too.
    pub fn relax(
        &mut self,
        z: &mut [DVec2],
        options: &FlatRelaxOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<FlatRelaxReport, Cancelled> {
        let mut report = FlatRelaxReport::default();
        let Some(mut energy) = self.energy(z) else { return Ok(report) };
        report.energies.push(energy);
        let n = z.len();
        let (mut slope, mut step, mut trial) =
            (vec![DVec2::ZERO; n], vec![DVec2::ZERO; n], vec![DVec2::ZERO; n]);
        let begin = (self.solver.iterations, self.solver.inexact);
        for k in 0..options.max_steps {
            // The number of steps is not known in advance: progress is one half after eight steps.
            let fraction = k as f64 / (k as f64 + 8.0);
            monitor.step(Step { fraction, residual: Some(energy) })?;
            let within = &mut Portion::new(monitor, fraction, fraction);
            self.gradient(z, &mut slope);
            self.assemble(z);
            slope.iter_mut().for_each(|g| *g = -*g);
            self.solver.step(&self.matrix, &slope, &mut step, options.linear_tolerance, within)?;
            let descent: f64 = slope.iter().zip(&step).map(|(g, d)| g.dot(*d)).sum();
            within.step(Step::default())?;
            let Some(next) = self.line_search(z, &step, &mut trial, energy, descent) else { break };
            z.copy_from_slice(&trial);
            let gained = energy - next;
            energy = next;
            report.energies.push(energy);
            if gained < options.relative_decrease * energy {
                break;
            }
        }
        report.cg_iterations = self.solver.iterations - begin.0;
        report.inexact_steps = self.solver.inexact - begin.1;
        Ok(report)
    }

    /// The energy after an Armijo step from z, whose end is written to `trial`; `None` where no step lowers it. `descent` is the decrease
    /// that the gradient at z predicts for the whole step.
    fn line_search(
        &self,
        z: &[DVec2],
        step: &[DVec2],
        trial: &mut [DVec2],
        energy: f64,
        descent: f64,
    ) -> Option<f64> {
        // At most 0.9 of the way to the first triangle without area, then halvings until the energy falls by 1e-4 of what the
        // slope promises (Armijo). 2^-40 of a step gains nothing.
        let mut t = (0.9 * self.first_degenerate(z, step)).min(1.0);
        for _ in 0..40 {
            for i in 0..z.len() {
                trial[i] = z[i] + t * step[i];
            }
            if let Some(next) = self.energy(trial)
                && next <= energy - 1e-4 * t * descent
            {
                return Some(next);
            }
            t *= 0.5;
        }
        None
    }

    /// The smallest positive t at which a triangle of z + t step degenerates.
    pub(in crate::surface_map) fn first_degenerate(&self, z: &[DVec2], step: &[DVec2]) -> f64 {
        let root = |t: &FlatTriangle| {
            let (p, d) = (t.positions(z), t.displacements(step));
            let (e1, e2, d1, d2) = (p[1] - p[0], p[2] - p[0], d[1] - d[0], d[2] - d[0]);
            smallest_positive_root(d1.perp_dot(d2), e1.perp_dot(d2) + d1.perp_dot(e2), e1.perp_dot(e2))
        };
        self.triangles.iter().map(root).fold(f64::INFINITY, min)
    }
}

pub(in crate::surface_map) fn unrotate(motion: &Rigid2, d: DVec2) -> DVec2 {
    crate::math::rigid2::conj_mul(motion.rotation, d)
}

/// The smallest positive root of a t^2 + b t + c, where c > 0; infinite where there is none.
fn smallest_positive_root(a: f64, b: f64, c: f64) -> f64 {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return f64::INFINITY;
    }
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    let roots = [q / a, c / q];
    roots.into_iter().filter(|t| *t > 0.0).fold(f64::INFINITY, min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::Silent;
    use crate::numerics::conjugate_gradients::LinearOperator;
    use glam::DVec3;

    /// A fan of six triangles around a free centre and a ring of six free vertices inside a fixed hexagon.
    fn problem() -> (FlatProblem, Vec<DVec2>) {
        let ring = |r: f64, k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / 6.0;
            DVec2::new(r * crate::math::scalar::cos(angle), r * crate::math::scalar::sin(angle))
        };
        let turn = Rigid2 { rotation: DVec2::new(0.6, 0.8), translation: DVec2::new(0.4, -2.0) };
        let mut z = vec![DVec2::new(0.1, -0.05)];
        z.extend((0..6).map(|k| turn.inverse().apply(ring(1.0, k) + DVec2::new(0.03 * k as f64, 0.1))));
        let free = |k: usize| Corner::Free(1 + (k % 6) as u32, turn);
        let fixed = |k: usize| Corner::Fixed(ring(2.0, k % 6));
        let lift = |p: DVec2| DVec3::new(p.x, p.y, 0.2 * p.x * p.y);
        let mut triangles = Vec::new();
        for k in 0..6 {
            let (inner, next) = (ring(1.0, k), ring(1.0, k + 1));
            let (outer, outer_next) = (ring(2.0, k), ring(2.0, k + 1));
            let centre = Corner::Free(0, Rigid2::IDENTITY);
            let mut add =
                |c: [Corner; 3], p: [DVec2; 3]| triangles.push(FlatTriangle::with_rest(c, p.map(lift)));
            add([centre, free(k), free(k + 1)], [DVec2::ZERO, inner, next]);
            add([free(k), fixed(k), fixed(k + 1)], [inner, outer, outer_next]);
            add([free(k), fixed(k + 1), free(k + 1)], [inner, outer_next, next]);
        }
        (FlatProblem::new(triangles, 7, &mut Silent).unwrap(), z)
    }

    #[test]
    fn gradient_and_hessian_are_difference_quotients() {
        let (mut problem, z) = problem();
        let n = z.len();
        let mut slope = vec![DVec2::ZERO; n];
        problem.gradient(&z, &mut slope);
        for v in 0..n {
            for axis in [DVec2::X, DVec2::Y] {
                let moved = |h: f64| {
                    let mut y = z.clone();
                    y[v] += axis * h;
                    problem.energy(&y).unwrap()
                };
                let quotient = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                assert!((quotient - slope[v].dot(axis)).abs() < 1e-8, "{quotient} {}", slope[v].dot(axis));
            }
        }
        problem.assemble(&z);
        let direction: Vec<_> =
            (0..n).map(|i| DVec2::new(0.3 - 0.1 * i as f64, 0.2 * i as f64 - 0.5)).collect();
        let mut image = vec![DVec2::ZERO; n];
        problem.matrix.apply(&direction, &mut image);
        let model: f64 = image.iter().zip(&direction).map(|(a, b)| a.dot(*b)).sum();
        let at = |h: f64| {
            let y: Vec<_> = z.iter().zip(&direction).map(|(p, d)| *p + *d * h).collect();
            problem.energy(&y).unwrap()
        };
        let truth = (at(1e-4) - 2.0 * at(0.0) + at(-1e-4)) / 1e-8;
        // The projected Hessian is at least the true one, and near it where few terms are projected.
        assert!(model > truth - 1e-4 && model < 1.5 * truth, "{model} {truth}");
    }

    #[test]
    fn newton_ends_where_the_gradient_vanishes() {
        let (mut problem, mut z) = problem();
        let options = FlatRelaxOptions {
            relative_decrease: 1e-14,
            linear_tolerance: 1e-8,
            ..FlatRelaxOptions::default()
        };
        let report = problem.relax(&mut z, &options, &mut Silent).unwrap();
        assert!(report.energies.windows(2).all(|e| e[1] <= e[0]));
        let mut slope = vec![DVec2::ZERO; z.len()];
        problem.gradient(&z, &mut slope);
        assert!(slope.iter().all(|g| g.length() < 1e-6), "{slope:?}");
        assert!(report.energies.len() < 15, "{:?}", report.energies);
    }

    #[test]
    fn roots() {
        assert_eq!(smallest_positive_root(1.0, -3.0, 2.0), 1.0);
        assert_eq!(smallest_positive_root(0.0, -2.0, 1.0), 0.5);
        assert_eq!(smallest_positive_root(1.0, 1.0, 1.0), f64::INFINITY);
        assert_eq!(smallest_positive_root(0.0, 0.0, 1.0), f64::INFINITY);
    }
}
