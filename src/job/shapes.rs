//! Each mesh of a finished map in the shape of the other, with how near it comes to it.

use super::outputs::OutputFile;
use super::saved::OpenMap;
use super::taken::OutputKind;
use crate::export::vertex_image::Direction;
use crate::map_file::FileMesh;
use crate::monitor::Monitor;
use crate::transfer::TransferError;
use crate::transfer::shape::{ShapeReport, shape_report};
use serde_json::{Map, json};

/// The file of the figures.
const FIGURES: &str = "shape.json";

/// A mesh in the shape of the other.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeOutput {
    /// From this mesh to the other.
    direction: Direction,
    /// The mesh, as OBJ.
    pub file: OutputFile,
    /// The measures of how near the shape comes to the other mesh.
    pub report: ShapeReport,
}

impl ShapeOutput {
    /// The file of the shape from a mesh to the other.
    fn kind(direction: Direction) -> OutputKind {
        match direction {
            Direction::SourceToTarget => OutputKind::SourceShapeObj,
            Direction::TargetToSource => OutputKind::TargetShapeObj,
        }
    }

    /// The names of all files: both shapes, and their figures.
    pub fn file_names() -> [&'static str; 3] {
        let [source, target] = Direction::BOTH.map(|direction| Self::kind(direction).file_name());
        [source, target, FIGURES]
    }

    /// The figures in a sentence without a full stop.
    pub fn sentence(&self) -> String {
        let [mesh, shape] = self.direction.names();
        format!("{mesh} in the {shape}'s shape: {}", self.report.sentence())
    }

    /// The figures of shapes as JSON.
    ///
    /// # Errors
    /// [`TransferError::Unwritten`] where they cannot be written as JSON.
    pub fn figures(shapes: &[Self]) -> Result<OutputFile, TransferError> {
        let figure = |shape: &Self| {
            let [mesh, onto] = shape.direction.names();
            (format!("{mesh}_in_{onto}_shape"), json!(shape.report))
        };
        let figures: Map<_, _> = shapes.iter().map(figure).collect();
        let bytes =
            serde_json::to_vec_pretty(&figures).map_err(|e| TransferError::Unwritten(e.to_string()))?;
        Ok(OutputFile { name: FIGURES, bytes })
    }
}

impl OpenMap {
    /// One mesh in the shape of the other.
    ///
    /// # Errors
    /// [`TransferError::Cancelled`], [`TransferError::Unwritten`].
    pub fn shape(
        &self,
        direction: Direction,
        monitor: &mut dyn Monitor,
    ) -> Result<ShapeOutput, TransferError> {
        let meshes = self.meshes().map(FileMesh::mesh);
        let report = shape_report(meshes, &self.taken().map().correspondence, direction, monitor)?;
        let kind = ShapeOutput::kind(direction);
        let bytes = self.taken().output(kind).map_err(|e| TransferError::Unwritten(e.to_string()))?;
        Ok(ShapeOutput { direction, file: OutputFile { name: kind.file_name(), bytes }, report })
    }
}
