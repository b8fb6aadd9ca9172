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
/// [`TargetError::MissingVertex`].
pub fn listed_curvature(vertices: usize, list: &[(usize, f64)]) -> Result<TiVec<VertexId, f64>, TargetError> {
    let mut curvature: TiVec<VertexId, f64> = ti_vec![0.0; vertices];
    for &(vertex, defect) in list {
        let entry = curvature.raw.get_mut(vertex).ok_or(TargetError::MissingVertex { vertex, vertices })?;
        *entry = defect;
    }
    Ok(curvature)
}

/// Checks Gauss-Bonnet (to 1e-6) and that every cone has an angle left.
///
/// # Errors
/// [`TargetError`].
pub fn check(curvature: &TiVec<VertexId, f64>) -> Result<(), TargetError> {
    if let Some((v, &defect)) = curvature.iter_enumerated().find(|(_, k)| **k >= TAU || k.is_nan()) {
        return Err(TargetError::TooLarge { vertex: v.index(), defect });
    }
    let sum: f64 = curvature.iter().sum();
    if (sum - 4.0 * PI).abs() > 1e-6 { Err(TargetError::WrongSum { sum }) } else { Ok(()) }
}
