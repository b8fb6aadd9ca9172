//! Landmarks on meshes as files of any format.

use super::surface::Surface;
use crate::io::landmark_file::{self, LandmarkFile, LandmarkPoint};
use crate::io::landmark_formats::{self, LandmarkFormat, LandmarkWriteError, SurfaceMark, SurfaceMarks};
use crate::landmarks::{LandmarkError, MeshSide, points};
use crate::mesh::check::CheckedMesh;
use crate::mesh::{FaceId, SurfacePoint};

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

/// The same point of a face that the file has, where it is a vertex of a face that a repair made: other programs know the file.
fn in_file(checked: &CheckedMesh, point: SurfacePoint) -> SurfacePoint {
    let is_made = |face: FaceId| checked.file_from_face(face).index() >= checked.file_faces();
    let Some(corner) = point.barycentric.iter().position(|w| *w == 1.0).filter(|_| is_made(point.face))
    else {
        return point;
    };
    let v = checked.mesh.triangles()[point.face][corner];
    let of_file = checked.mesh.star(v).find(|h| !is_made(h.face()));
    of_file.map_or(point, |h| SurfacePoint::on_halfedge(h, 0.0))
}

/// The landmarks of one side with their places in space and on faces.
fn marks(file: &LandmarkFile, surface: Surface<'_>, side: MeshSide) -> Result<SurfaceMarks, LandmarkError> {
    let on_mesh = points(surface.mesh, side, &file.pairs)?;
    let label =
        |pair: usize| file.labels.as_ref().and_then(|labels| labels.get(pair)).cloned().unwrap_or_default();
    let mark = |(pair, point): (usize, SurfacePoint)| {
        let on_file = surface.mesh.on_file(in_file(surface.mesh, point));
        // Weights as they were given, without what rounding makes of them.
        let weights = match file.pairs[pair][side] {
            LandmarkPoint::OnFace { barycentric, .. } => barycentric,
            LandmarkPoint::Vertex(_) => on_file.barycentric,
        };
        let position = surface.mesh.frame.in_file(point.position(&surface.mesh.mesh));
        SurfaceMark { label: label(pair), position, face: on_file.face.0, weights }
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
