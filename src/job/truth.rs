//! The true map, as far as a job knows it.

use crate::io::vertex_table::{self, TableError};
use crate::map_file::FileMesh;
use crate::mesh::VertexId;
use crate::pipeline::GroundTruth;
use glam::DVec3;
use typed_index_collections::TiVec;

/// The true map, as far as it is known.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Truth {
    /// Nothing is known of it.
    #[default]
    Unknown,
    /// Vertex i of the source goes to vertex i of the target.
    SameConnectivity,
    /// The true images of the source's vertices, on the target as it is mapped; `None` where they are not known.
    Images(TiVec<VertexId, Option<DVec3>>),
}

impl Truth {
    /// Reads the true images of the source's vertices from a table: places in the target's file, in columns `x`, `y` and `z`.
    ///
    /// # Errors
    /// [`TruthError`].
    pub(super) fn of_table(table: &[u8], meshes: [&FileMesh; 2]) -> Result<Self, TruthError> {
        Ok(Self::Images(images(table, meshes)?))
    }

    /// The true map, from places in the source's file to places in the target's.
    pub(super) fn of_map(image: impl Fn(DVec3) -> DVec3, [source, target]: [&FileMesh; 2]) -> Self {
        let places = source.mesh().positions().iter();
        Self::Images(places.map(|&p| Some(of_target(target, image(source.in_file(p))))).collect())
    }

    /// The truth as the pipeline takes it.
    pub(super) fn known(&self) -> GroundTruth<'_> {
        match self {
            Self::Unknown => GroundTruth::Unknown,
            Self::SameConnectivity => GroundTruth::SameConnectivity,
            Self::Images(places) => GroundTruth::Images(places),
        }
    }
}

/// Why a table does not tell the true map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TruthError {
    /// The file is no table of the source's vertices.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A coordinate has no column.
    #[error(
        "there is no column \"{0}\": it should have the true images of the source's vertices in columns x, y and z"
    )]
    Column(&'static str),
    /// No vertex has an image.
    #[error("it has no true image of any vertex of the source")]
    Empty,
}

/// A place in the target's file as one of the target as it is mapped.
fn of_target(target: &FileMesh, place: DVec3) -> DVec3 {
    target.as_given(target.frame().on_mesh(place))
}

fn images(
    table: &[u8],
    [source, target]: [&FileMesh; 2],
) -> Result<TiVec<VertexId, Option<DVec3>>, TruthError> {
    let table = vertex_table::read(table, source.file_vertices())?;
    let column = |name: &'static str| {
        let found = table.columns.iter().find(|column| column.name == name);
        found.map(|column| &column.values[..]).ok_or(TruthError::Column(name))
    };
    let columns = [column("x")?, column("y")?, column("z")?];
    let image = |v: VertexId| {
        let number = source.vertex_number(v);
        let [x, y, z] = columns.map(|values| values.get(number).copied().flatten());
        Some(of_target(target, DVec3::new(x?, y?, z?)))
    };
    let images: TiVec<VertexId, _> = source.mesh().vertices().map(image).collect();
    if images.iter().all(Option::is_none) { Err(TruthError::Empty) } else { Ok(images) }
}
