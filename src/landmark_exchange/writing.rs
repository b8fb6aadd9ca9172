//! Landmarks on meshes as files of any format.

use super::surface::Surface;
use crate::io::landmark_file::{self, LandmarkFile, LandmarkPoint};
use crate::io::landmark_formats::{self, LandmarkFormat, LandmarkWriteError, SurfaceMark, SurfaceMarks};
use crate::landmarks::{LandmarkError, MeshSide, points};

/// Why landmarks cannot be written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExchangeWriteError {
    /// A landmark is not on its mesh.
    #[error(transparent)]
    Landmarks(#[from] LandmarkError),
    /// The format holds other landmarks.
    #[error(transparent)]
    Format(#[from] LandmarkWriteError),
}

/// The landmarks of both meshes as one file; the lists are called as the landmark file calls its meshes.
///
/// # Errors
/// [`ExchangeWriteError`].
pub fn write_pairs(
    format: LandmarkFormat,
    file: &LandmarkFile,
    surfaces: [Surface<'_>; 2],
) -> Result<Vec<u8>, ExchangeWriteError> {
    let [source, target] = surfaces;
    let sides = [marks(file, source, MeshSide::Source)?, marks(file, target, MeshSide::Target)?];
    if format == LandmarkFormat::Conemap {
        return Ok(landmark_file::write(file));
    }
    Ok(landmark_formats::write(format, &sides)?)
}

/// The landmarks of one mesh as a file.
///
/// # Errors
/// [`ExchangeWriteError`].
pub fn write_side(
    format: LandmarkFormat,
    file: &LandmarkFile,
    surface: Surface<'_>,
    side: MeshSide,
) -> Result<Vec<u8>, ExchangeWriteError> {
    Ok(landmark_formats::write(format, &[marks(file, surface, side)?])?)
}

/// The landmarks of one side with their places in space and on faces.
fn marks(file: &LandmarkFile, surface: Surface<'_>, side: MeshSide) -> Result<SurfaceMarks, LandmarkError> {
    let on_mesh = points(surface.mesh, side, &file.pairs)?;
    let label =
        |pair: usize| file.labels.as_ref().and_then(|labels| labels.get(pair)).cloned().unwrap_or_default();
    let mark = |(pair, point): (usize, crate::mesh::SurfacePoint)| {
        let on_file = surface.mesh.with_file_corners(point);
        // Weights as they were given, without what rounding makes of them.
        let weights = match file.pairs[pair][side as usize] {
            LandmarkPoint::OnFace { barycentric, .. } => barycentric,
            LandmarkPoint::Vertex(_) => on_file.barycentric,
        };
        let position = point.position(&surface.mesh.mesh);
        SurfaceMark { label: label(pair), position, face: point.face.0, weights }
    };
    let name = match side {
        MeshSide::Source => &file.source,
        MeshSide::Target => &file.target,
    };
    Ok(SurfaceMarks {
        name: name.clone().unwrap_or_else(|| side.to_string()),
        space: surface.space,
        marks: on_mesh.into_iter().enumerate().map(mark).collect(),
    })
}
