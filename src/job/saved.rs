//! A map that was saved, opened with its meshes: nothing is computed.

use super::look::{LookFiles, MapLook};
use super::taken::TakenMap;
use crate::landmarks::MeshSide;
use crate::map_file::{self, FileMesh, FileMeshError, MapFile, MapFileError};
use crate::mesh::MeshError;
use crate::mesh::mirror::TargetImage;

/// The contents of the files of a saved map.
#[derive(Clone, Copy, Debug)]
pub struct MapFiles<'a> {
    /// A map file.
    pub map: &'a [u8],
    /// The source that it was made with.
    pub source: &'a [u8],
    /// The target that it was made with.
    pub target: &'a [u8],
}

/// A saved map with both meshes.
#[derive(Clone, Debug)]
pub struct OpenMap {
    meshes: [FileMesh; 2],
    map: MapFile,
}

/// Why a saved map cannot be opened.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OpenMapError {
    /// The map file is at fault, or a mesh is another one.
    #[error(transparent)]
    Map(#[from] MapFileError),
    /// A mesh cannot be used.
    #[error("{error}")]
    Mesh {
        /// The mesh at fault.
        side: MeshSide,
        /// The reason.
        error: FileMeshError,
    },
    /// The target has no mirror image.
    #[error("the mirror image of the target: {0}")]
    Mirror(#[from] MeshError),
}

impl OpenMapError {
    /// The mesh at fault; `None` where it is the map file.
    pub fn side(&self) -> Option<MeshSide> {
        match self {
            Self::Map(MapFileError::OtherMesh { side, .. }) | Self::Mesh { side, .. } => Some(*side),
            Self::Mirror(_) => Some(MeshSide::Target),
            Self::Map(_) => None,
        }
    }

    /// A stable code for programs and for the page's sentences.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Map(error) => error.code(),
            Self::Mesh { error: FileMeshError::Read(_), .. } => "file",
            Self::Mesh { .. } | Self::Mirror(_) => "mesh",
        }
    }
}

impl OpenMap {
    /// Reads a map file with both meshes.
    ///
    /// # Errors
    /// [`OpenMapError`] with the file at fault.
    pub fn read(files: MapFiles<'_>) -> Result<Self, OpenMapError> {
        let image = map_file::target_image(files.map)?;
        let mesh = |side: MeshSide, bytes: &[u8]| {
            FileMesh::read(bytes).map_err(|error| OpenMapError::Mesh { side, error })
        };
        let source = mesh(MeshSide::Source, files.source)?;
        let mut target = mesh(MeshSide::Target, files.target)?;
        if image == TargetImage::Mirrored {
            target = target.into_mirrored()?;
        }
        let map = map_file::read(files.map, [&source, &target])?;
        Ok(Self { meshes: [source, target], map })
    }

    /// Both meshes.
    pub fn meshes(&self) -> [&FileMesh; 2] {
        self.meshes.each_ref()
    }

    /// The look that the map carries, by the contents of its mesh files and what comes with them.
    pub fn look(&self, files: [LookFiles<'_>; 2]) -> MapLook {
        MapLook::read(self.meshes.each_ref(), files)
    }

    /// The map with both meshes: its files and answers.
    pub fn taken(&self) -> TakenMap<'_> {
        TakenMap::new(self.meshes.each_ref(), &self.map)
    }
}
