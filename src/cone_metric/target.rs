//! Target curvatures: the angle defects that the flow brings about.

use crate::base_domain::BaseDomain;
use crate::mesh::VertexId;
use std::f64::consts::{PI, TAU};
use typed_index_collections::{TiVec, ti_vec};

/// Why no cone metric has the target curvatures.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TargetError {
    /// The sum is not 4 pi.
    #[error("the angle defects sum to {sum} instead of 4 pi = {}: a sphere has no such metric", 4.0 * PI)]
    WrongSum {
        /// The sum of all angle defects, in radians.
        sum: f64,
    },
    /// A defect of 2 pi or more leaves no angle.
    #[error("vertex {vertex} has the angle defect {defect}: it must be below 2 pi = {TAU}")]
    TooLarge {
        /// The vertex, 0-based.
        vertex: usize,
        /// Its angle defect, in radians.
        defect: f64,
    },
    /// A defect that is no number.
    #[error("vertex {vertex} has an angle defect that is not a number")]
    NotANumber {
        /// The vertex, 0-based.
        vertex: usize,
    },
    /// A vertex that is listed twice.
    #[error("vertex {vertex} is listed twice: give each cone once")]
    Repeated {
        /// The vertex, 0-based.
        vertex: usize,
    },
    /// A vertex that the mesh does not have.
    #[error("vertex {vertex} has a cone, but the mesh has {vertices} vertices")]
    MissingVertex {
        /// The vertex, 0-based.
        vertex: usize,
        /// Number of vertices.
        vertices: usize,
    },
}

/// Angle defects (radians) of the base domain at the landmarks, 0 elsewhere.
pub fn base_domain_curvature(
    vertices: usize,
    landmarks: &[VertexId],
    base: &BaseDomain,
) -> TiVec<VertexId, f64> {
    let mut curvature = ti_vec![0.0; vertices];
    for (&v, angle) in landmarks.iter().zip(base.cone_angles()) {
        curvature[v] = TAU - angle;
    }
    curvature
}

/// 4 pi shared evenly by the landmarks, 0 elsewhere.
pub fn uniform_curvature(vertices: usize, landmarks: &[VertexId]) -> TiVec<VertexId, f64> {
    let mut curvature = ti_vec![0.0; vertices];
    landmarks.iter().for_each(|&v| curvature[v] = 4.0 * PI / landmarks.len() as f64);
    curvature
}

/// The listed angle defects (radians, by 0-based vertex), 0 elsewhere.
///
/// # Errors
/// [`TargetError::MissingVertex`] or [`TargetError::Repeated`].
pub fn listed_curvature(vertices: usize, list: &[(usize, f64)]) -> Result<TiVec<VertexId, f64>, TargetError> {
    let mut curvature: TiVec<VertexId, f64> = ti_vec![0.0; vertices];
    let mut listed = vec![false; vertices];
    for &(vertex, defect) in list {
        let entry = curvature.raw.get_mut(vertex).ok_or(TargetError::MissingVertex { vertex, vertices })?;
        if std::mem::replace(&mut listed[vertex], true) {
            return Err(TargetError::Repeated { vertex });
        }
        *entry = defect;
    }
    Ok(curvature)
}

/// Checks that the angle defect of a vertex is a number and leaves an angle.
///
/// # Errors
/// [`TargetError::NotANumber`] or [`TargetError::TooLarge`], with the vertex as it is named here.
pub fn check_defect(vertex: usize, defect: f64) -> Result<(), TargetError> {
    if defect.is_nan() {
        Err(TargetError::NotANumber { vertex })
    } else if defect >= TAU {
        Err(TargetError::TooLarge { vertex, defect })
    } else {
        Ok(())
    }
}

/// Checks that all are numbers, that every cone has an angle left, and Gauss-Bonnet (to 1e-6).
///
/// # Errors
/// [`TargetError`].
pub fn check(curvature: &TiVec<VertexId, f64>) -> Result<(), TargetError> {
    curvature.iter_enumerated().try_for_each(|(v, defect)| check_defect(v.index(), *defect))?;
    let sum: f64 = curvature.iter().sum();
    if (sum - 4.0 * PI).abs() > 1e-6 { Err(TargetError::WrongSum { sum }) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_is_listed_once_and_its_defect_is_a_number() {
        let curvature = |list: &[(usize, f64)]| listed_curvature(5, list);
        let tetrahedron: Vec<(usize, f64)> = (0..4).map(|v| (v, PI)).collect();
        assert_eq!(curvature(&tetrahedron).map(|k| check(&k)), Ok(Ok(())));
        assert_eq!(curvature(&[(1, PI), (0, PI), (1, PI)]), Err(TargetError::Repeated { vertex: 1 }));
        assert_eq!(curvature(&[(5, PI)]), Err(TargetError::MissingVertex { vertex: 5, vertices: 5 }));
        let unclear = curvature(&[(0, 6.0), (1, f64::NAN)]).and_then(|k| check(&k));
        assert_eq!(unclear, Err(TargetError::NotANumber { vertex: 1 }));
    }
}
