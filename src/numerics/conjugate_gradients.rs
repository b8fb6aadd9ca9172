//! Preconditioned conjugate gradients for symmetric positive (semi)definite systems (Hestenes & Stiefel 1952).
//!
//! One solver for every kind of unknown: a system is a [`LinearOperator`] with a [`Preconditioner`] on slices of numbers or of
//! points. A solve from x = 0 allocates nothing when its [`CgWorkspace`] has been used before. A solve that
//! does not converge is an error; x then holds the last iterate, and the caller decides whether to use it.

use glam::{DVec2, DVec3};
use std::ops::{Add, AddAssign, Mul, SubAssign};

/// An entry of the vectors of a system: a number, or a point of the plane or of space.
pub trait Entry: Copy + AddAssign + SubAssign + Add<Output = Self> + Mul<f64, Output = Self> {
    /// Zero.
    const ZERO: Self;

    /// The inner product of two entries.
    fn dot(self, other: Self) -> f64;
}

impl Entry for f64 {
    const ZERO: Self = 0.0;

    #[inline]
    fn dot(self, other: Self) -> f64 {
        self * other
    }
}

impl Entry for DVec2 {
    const ZERO: Self = Self::ZERO;

    #[inline]
    fn dot(self, other: Self) -> f64 {
        self.dot(other)
    }
}

impl Entry for DVec3 {
    const ZERO: Self = Self::ZERO;

    #[inline]
    fn dot(self, other: Self) -> f64 {
        self.dot(other)
    }
}

/// The inner product of two vectors.
#[inline]
pub fn dot<T: Entry>(a: &[T], b: &[T]) -> f64 {
    a.iter().zip(b).map(|(p, q)| p.dot(*q)).sum()
}

/// A symmetric linear map A, positive definite but for a kernel that it knows.
pub trait LinearOperator<T> {
    /// y = A x.
    fn apply(&self, x: &[T], y: &mut [T]);

    /// Projects x onto the orthogonal complement of the kernel of A; does nothing where A is definite.
    #[inline]
    fn leave_kernel(&self, _x: &mut [T]) {}
}

/// A symmetric positive definite approximation of the inverse of an operator.
pub trait Preconditioner<T> {
    /// y = M^-1 x, where M is like A.
    fn precondition(&self, x: &[T], y: &mut [T]);
}

/// The stopping criteria of a solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CgOptions {
    /// Largest |b - A x| of a solution, in units of |b|.
    pub tolerance: f64,
    /// Iterations at most.
    pub max_iterations: usize,
}

/// Iterations and residual of a solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CgReport {
    /// Iterations made.
    pub iterations: usize,
    /// |b - A x| / |b|, as the iteration carries it along.
    pub relative_residual: f64,
}

/// Why a solve failed. x is the last iterate: of all vectors of its Krylov space it has the least error in the norm of A, and
/// where it is not 0 it satisfies b^T x > 0.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CgError {
    /// The iterations were not enough.
    #[error(
        "conjugate gradients did not converge: relative residual {:.3e} after {} iterations, wanted {tolerance:.3e}",
        report.relative_residual,
        report.iterations
    )]
    NotConverged {
        /// The wanted relative residual.
        tolerance: f64,
        /// Iterations and residual of the last iterate.
        report: CgReport,
    },
    /// A direction d has d^T A d that is not positive, by rounding or because A is not definite.
    #[error(
        "conjugate gradients met a curvature of {curvature:.3e} after {} iterations, at relative residual {:.3e}",
        report.iterations,
        report.relative_residual
    )]
    NotDefinite {
        /// d^T A d, or not a number.
        curvature: f64,
        /// Iterations and residual of the last iterate.
        report: CgReport,
    },
}

impl CgError {
    /// Iterations and residual of the last iterate.
    pub fn report(&self) -> CgReport {
        match self {
            Self::NotConverged { report, .. } | Self::NotDefinite { report, .. } => *report,
        }
    }
}

/// Working memory of [`CgWorkspace::solve`], kept from one solve to the next.
#[derive(Clone, Debug)]
pub struct CgWorkspace<T> {
    residual: Vec<T>,
    direction: Vec<T>,
    image: Vec<T>,
    preconditioned: Vec<T>,
}

impl<T> Default for CgWorkspace<T> {
    fn default() -> Self {
        Self { residual: Vec::new(), direction: Vec::new(), image: Vec::new(), preconditioned: Vec::new() }
    }
}

impl<T: Entry> CgWorkspace<T> {
    /// Solves A x = b from x = 0. b is first projected onto the complement of the kernel of A, where x lies, too.
    ///
    /// # Errors
    /// [`CgError`]; x is the last iterate then.
    pub fn solve(
        &mut self,
        operator: &impl LinearOperator<T>,
        preconditioner: &impl Preconditioner<T>,
        b: &[T],
        x: &mut [T],
        options: &CgOptions,
    ) -> Result<CgReport, CgError> {
        self.solve_while(operator, preconditioner, b, x, options, || true)
    }

    /// Like [`Self::solve`], but ends where `may_go_on`, asked before each iteration, returns `false`.
    ///
    /// # Errors
    /// [`CgError`]; [`CgError::NotConverged`] also where `may_go_on` ended the solve.
    pub fn solve_while(
        &mut self,
        operator: &impl LinearOperator<T>,
        preconditioner: &impl Preconditioner<T>,
        b: &[T],
        x: &mut [T],
        options: &CgOptions,
        mut may_go_on: impl FnMut() -> bool,
    ) -> Result<CgReport, CgError> {
        let n = b.len();
        let Self { residual, direction, image, preconditioned } = self;
        for memory in [&mut *residual, &mut *direction, &mut *image, &mut *preconditioned] {
            memory.resize(n, T::ZERO);
        }
        x.fill(T::ZERO);
        residual.copy_from_slice(b);
        operator.leave_kernel(residual);
        let whole = dot(residual, residual);
        let goal = options.tolerance * options.tolerance * whole;
        let report = |iterations: usize, square: f64| CgReport {
            iterations,
            relative_residual: if whole == 0.0 { 0.0 } else { (square / whole).sqrt() },
        };
        if whole == 0.0 {
            return Ok(report(0, 0.0));
        }
        let mut square = whole;
        preconditioner.precondition(residual, preconditioned);
        operator.leave_kernel(preconditioned);
        direction.copy_from_slice(preconditioned);
        let mut rho = dot(residual, preconditioned);
        let mut iterations = options.max_iterations;
        for iteration in 0..options.max_iterations {
            if !may_go_on() {
                iterations = iteration;
                break;
            }
            operator.apply(direction, image);
            let curvature = dot(direction, image);
            if curvature.is_nan() || curvature <= 0.0 {
                operator.leave_kernel(x);
                return Err(CgError::NotDefinite { curvature, report: report(iteration, square) });
            }
            let step = rho / curvature;
            for i in 0..n {
                x[i] += direction[i] * step;
                residual[i] -= image[i] * step;
            }
            square = dot(residual, residual);
            if square <= goal {
                operator.leave_kernel(x);
                return Ok(report(iteration + 1, square));
            }
            operator.leave_kernel(residual);
            preconditioner.precondition(residual, preconditioned);
            operator.leave_kernel(preconditioned);
            let next = dot(residual, preconditioned);
            let ratio = next / rho;
            rho = next;
            for i in 0..n {
                direction[i] = preconditioned[i] + direction[i] * ratio;
            }
        }
        operator.leave_kernel(x);
        let report = report(iterations, square);
        Err(CgError::NotConverged { tolerance: options.tolerance, report })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A diagonal matrix.
    struct Diagonal(Vec<f64>);

    impl LinearOperator<f64> for Diagonal {
        fn apply(&self, x: &[f64], y: &mut [f64]) {
            (0..x.len()).for_each(|i| y[i] = self.0[i] * x[i]);
        }
    }

    /// M = 1.
    struct Identity;

    impl Preconditioner<f64> for Identity {
        fn precondition(&self, x: &[f64], y: &mut [f64]) {
            y.copy_from_slice(x);
        }
    }

    fn solve(diagonal: &[f64], max_iterations: usize) -> (Result<CgReport, CgError>, Vec<f64>) {
        let mut x = vec![7.0; diagonal.len()];
        let b = vec![1.0; diagonal.len()];
        let options = CgOptions { tolerance: 1e-12, max_iterations };
        let mut workspace = CgWorkspace::default();
        let result = workspace.solve(&Diagonal(diagonal.to_vec()), &Identity, &b, &mut x, &options);
        (result, x)
    }

    #[test]
    fn as_many_iterations_as_eigenvalues_are_enough() {
        let (result, x) = solve(&[1.0, 2.0, 4.0, 2.0, 1.0], 10);
        assert_eq!(result.unwrap().iterations, 3);
        assert!(x.iter().zip([1.0, 0.5, 0.25, 0.5, 1.0]).all(|(p, q)| (p - q).abs() < 1e-12), "{x:?}");
    }

    #[test]
    fn too_few_iterations_are_told_with_their_numbers_and_the_iterate_goes_downhill() {
        let (result, x) = solve(&[1.0, 3.0, 9.0, 27.0], 2);
        let Err(CgError::NotConverged { tolerance, report }) = result else { panic!("{result:?}") };
        assert_eq!((tolerance, report.iterations), (1e-12, 2));
        assert!(report.relative_residual > 0.1 && report.relative_residual < 1.0, "{report:?}");
        assert!(x.iter().sum::<f64>() > 0.0);
    }

    #[test]
    fn an_indefinite_matrix_is_told_with_its_curvature() {
        let (result, x) = solve(&[1.0, -3.0], 10);
        let Err(CgError::NotDefinite { curvature, report }) = result else { panic!("{result:?}") };
        assert_eq!((curvature, report.iterations, report.relative_residual), (-2.0, 0, 1.0));
        assert_eq!(x, [0.0; 2]);
    }

    #[test]
    fn nothing_has_the_solution_nothing() {
        let mut x = [1.0];
        let options = CgOptions { tolerance: 1e-3, max_iterations: 0 };
        let mut workspace = CgWorkspace::default();
        let report = workspace.solve(&Diagonal(vec![1.0]), &Identity, &[0.0], &mut x, &options).unwrap();
        assert_eq!((report, x), (CgReport { iterations: 0, relative_residual: 0.0 }, [0.0]));
    }
}
