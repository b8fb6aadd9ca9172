//! Formulas on 2 x 2 matrices.

use glam::{DMat2, DVec2};

/// The cofactor matrix: the derivative of the determinant, det(m) m^-T.
#[inline]
pub fn cofactor(m: &DMat2) -> DMat2 {
    DMat2::from_cols(DVec2::new(m.y_axis.y, -m.y_axis.x), DVec2::new(-m.x_axis.y, m.x_axis.x))
}

/// The matrix v v^T.
#[inline]
pub fn outer(v: DVec2) -> DMat2 {
    DMat2::from_cols(v * v.x, v * v.y)
}

/// |m|^2, the sum of the squares of all entries.
#[inline]
pub fn squares(m: &DMat2) -> f64 {
    m.x_axis.length_squared() + m.y_axis.length_squared()
}

/// Least determinant of an [`invertible`] matrix in units of its squares: some hundred times the rounding of a determinant.
const LEAST_DETERMINANT: f64 = 1e-14;

/// A matrix, whose determinant is positive but may be lost in rounding, with a positive one: where it is below 1e-14 |m|^2 the matrix is
/// changed by 2e-14 of its size.
pub fn invertible(m: DMat2) -> DMat2 {
    // det(m + t cof(m)) = (1 + t^2) det(m) + t |m|^2.
    if m.determinant() < LEAST_DETERMINANT * squares(&m) {
        return m + cofactor(&m) * (2.0 * LEAST_DETERMINANT);
    }
    m
}

/// Eigenvalues and eigenvectors of a symmetric matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetricEigen {
    /// The eigenvalues, the larger one first.
    pub values: [f64; 2],
    /// A unit eigenvector of the first; that of the second is perpendicular to it.
    pub first: DVec2,
}

/// The eigenvalues and eigenvectors of the symmetric matrix (xx xy; xy yy).
#[inline]
pub fn symmetric_eigen([xx, xy, yy]: [f64; 3]) -> SymmetricEigen {
    let (mean, difference) = (0.5 * (xx + yy), 0.5 * (xx - yy));
    let root = (difference * difference + xy * xy).sqrt();
    let first = DVec2::new(xy, mean + root - xx).normalize_or(DVec2::X);
    SymmetricEigen { values: [mean + root, mean - root], first }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_determinant_that_rounding_lost_is_positive_again() {
        for (column, factor) in [(DVec2::new(660295.7, -660295.1), 0.962787), (DVec2::new(1e-9, 3e-9), 1e5)] {
            let lost = DMat2::from_cols(column, column * factor);
            let found = invertible(lost);
            assert!(lost.determinant() < LEAST_DETERMINANT * squares(&lost));
            assert!(found.determinant() > LEAST_DETERMINANT * squares(&found));
            assert!(squares(&(found - lost)).sqrt() < 1e-13 * squares(&lost).sqrt());
        }
        let usual = DMat2::from_cols_array(&[1.5, 0.3, -0.2, 0.8]);
        assert_eq!(invertible(usual), usual);
    }

    #[test]
    fn the_cofactor_matrix_is_the_derivative_of_the_determinant() {
        let m = DMat2::from_cols_array(&[1.5, 0.3, -0.2, 0.8]);
        let exact = cofactor(&m).to_cols_array();
        for k in 0..4 {
            let at = |h: f64| {
                let mut entries = m.to_cols_array();
                entries[k] += h;
                DMat2::from_cols_array(&entries).determinant()
            };
            assert!(((at(0.5) - at(-0.5)) - exact[k]).abs() < 1e-14);
        }
        assert!((m * cofactor(&m).transpose()).abs_diff_eq(DMat2::IDENTITY * m.determinant(), 1e-14));
    }

    #[test]
    fn eigenvectors_are_stretched_by_their_eigenvalues() {
        for [xx, xy, yy] in [[2.0, 0.5, 1.0], [-1.0, 3.0, 4.0], [1.0, -1e-3, 1.0]] {
            let m = DMat2::from_cols(DVec2::new(xx, xy), DVec2::new(xy, yy));
            let SymmetricEigen { values, first } = symmetric_eigen([xx, xy, yy]);
            assert!((m * first).abs_diff_eq(first * values[0], 1e-12));
            assert!((m * first.perp()).abs_diff_eq(first.perp() * values[1], 1e-12));
            assert!(values[0] >= values[1]);
        }
    }
}
