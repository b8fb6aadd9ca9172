//! Files of one mesh brought to the other: bytes in, bytes out, and a fault with the file that has it.

use super::attributes::{AttributeOptions, attributes};
use super::curves;
use super::deformation::{DeformationTransfer, Shape};
use super::fault::TransferError;
use super::formats::{CurveFormat, ValueFormat};
use super::frames;
use super::mapped_files::MappedFiles;
use super::texture::{BakeOptions, FaceUvs, GivenTexture, baked, face_uvs};
use super::values::Carrying;
use crate::export;
use crate::export::vertex_image::Direction;
use crate::io::{curve_file, picture, texture_coordinates, vertex_table};
use crate::landmarks::MeshSide;
use crate::map_file::FileMesh;
use crate::monitor::{Cancelled, Monitor};

/// A finished map that files are brought over by, in one direction.
#[derive(Clone, Copy, Debug)]
pub struct FileTransfer<'a> {
    mapped: MappedFiles<'a>,
    direction: Direction,
}

/// The options of bringing values over.
#[derive(Clone, Debug)]
pub struct ValueOptions {
    /// The method to compute a value at a vertex from those of the other mesh.
    pub carrying: Carrying,
    /// Names of columns that are labels.
    pub labels: Vec<String>,
    /// Names of columns that are weights.
    pub weights: Vec<String>,
    /// The format in which the values are written.
    pub format: ValueFormat,
}

/// The size of a picture that is baked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Raster {
    /// Number of texels in a row and in a column.
    pub size: usize,
    /// Number of texels by which colours are carried on beyond the charts.
    pub border: usize,
}

impl Raster {
    /// The most texels in a row and in a column that a user may ask for.
    pub const LARGEST_SIZE: u16 = 8192;
    /// Texels in a row and in a column where a user says nothing.
    pub const USUAL_SIZE: u16 = 1024;
    /// Texels beyond the charts where a user says nothing.
    pub const USUAL_BORDER: u8 = 8;
}

/// The mesh that gives where a user says nothing.
pub const USUAL_GIVER: MeshSide = MeshSide::Target;

impl From<MeshSide> for Direction {
    /// From this mesh to the other.
    fn from(giver: MeshSide) -> Self {
        match giver {
            MeshSide::Source => Self::SourceToTarget,
            MeshSide::Target => Self::TargetToSource,
        }
    }
}

/// Values that were brought over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CarriedValues {
    /// The contents of their file.
    pub bytes: Vec<u8>,
    /// Vertex properties that are lists, and were left out.
    pub left_out: Vec<String>,
}

/// The file whose values, curves or texture are brought over, which is given alone.
const ONLY: usize = 0;

impl<'a> FileTransfer<'a> {
    /// The transfer by a map between the meshes of two files.
    pub fn new(mapped: MappedFiles<'a>, direction: Direction) -> Self {
        Self { mapped, direction }
    }

    /// The mesh that gives.
    pub fn giver(&self) -> &'a FileMesh {
        self.mapped.files[self.direction.side()]
    }

    /// The mesh that receives.
    pub fn receiver(&self) -> &'a FileMesh {
        self.mapped.files[self.direction.side().other()]
    }

    /// Values of the giving mesh's vertices, a table or a PLY file, at those of the receiving one.
    ///
    /// # Errors
    /// [`TransferError`].
    pub fn values(
        &self,
        bytes: &[u8],
        options: &ValueOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<CarriedValues, TransferError> {
        let table = vertex_table::read(bytes, self.giver().file_vertices());
        let table = table.map_err(|e| TransferError::given(ONLY, e))?;
        let ValueOptions { carrying, labels, weights, format } = options;
        let options = AttributeOptions {
            direction: self.direction,
            carrying: *carrying,
            labels: labels.clone(),
            weights: weights.clone(),
        };
        let carried = attributes(self.mapped, &table, &options, monitor);
        let carried = carried.map_err(|e| TransferError::given(ONLY, e))?;
        let bytes = match format {
            ValueFormat::Csv => export::vertex_table::csv(&carried),
            ValueFormat::Ply => {
                let receiver = self.receiver();
                let positions = frames::of_file(receiver, receiver.mesh().positions());
                export::ply::polygons_with(&positions, receiver.polygons(), &carried.columns)
            }
        };
        Ok(CarriedValues { bytes, left_out: table.left_out })
    }

    /// Curves on the giving mesh, on the receiving one.
    ///
    /// # Errors
    /// [`TransferError`].
    pub fn curves(
        &self,
        bytes: &[u8],
        format: CurveFormat,
        monitor: &mut dyn Monitor,
    ) -> Result<Vec<u8>, TransferError> {
        let given = curve_file::read(bytes, self.giver().file_vertices());
        let given = given.map_err(|e| TransferError::given(ONLY, e))?;
        let carried = curves::of_files(self.mapped, self.direction, &given, monitor);
        let carried = carried.map_err(|e| TransferError::given(ONLY, e))?;
        Ok(match format {
            CurveFormat::Json => export::curves::json(self.direction, &carried),
            CurveFormat::Csv => export::curves::csv(self.direction, &carried),
            CurveFormat::Obj => export::curves::obj(&carried),
        })
    }

    /// The giving mesh's texture, a PNG file, as one over the receiving mesh's own texture coordinates, which both mesh files must
    /// have; `meshes` are their contents, source first.
    ///
    /// # Errors
    /// [`TransferError`].
    pub fn texture(
        &self,
        bytes: &[u8],
        meshes: [&[u8]; 2],
        raster: Raster,
        monitor: &mut dyn Monitor,
    ) -> Result<Vec<u8>, TransferError> {
        let picture = picture::read(bytes).map_err(|e| TransferError::given(ONLY, e))?;
        let [source, target] = self.mapped.files;
        let uvs =
            [charts(source, meshes[0], MeshSide::Source)?, charts(target, meshes[1], MeshSide::Target)?];
        let given = GivenTexture { uvs: uvs.each_ref(), picture: &picture };
        let options = BakeOptions { direction: self.direction, size: raster.size, border: raster.border };
        let receiver = self.direction.side().other();
        let baked = baked(self.mapped, given, options, monitor);
        let baked = baked.map_err(|e| TransferError::chart(receiver, e))?;
        export::picture::png(&baked).map_err(|e| TransferError::Unwritten(e.to_string()))
    }

    /// The shape of the giving mesh in a frame, the given file of this number.
    ///
    /// # Errors
    /// [`TransferError`] where it is none.
    pub fn frame(&self, number: usize, bytes: &[u8]) -> Result<Shape, TransferError> {
        frames::read(self.giver(), bytes).map_err(|e| TransferError::given(number, e))
    }

    /// The transfer of the motion of the giving mesh's frames to the receiving mesh.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn motion(&self, monitor: &mut dyn Monitor) -> Result<Motion<'a>, Cancelled> {
        let meshes = self.mapped.meshes();
        let transfer = DeformationTransfer::new(meshes, self.mapped.map, self.direction, monitor)?;
        Ok(Motion { receiver: self.receiver(), transfer })
    }
}

/// A mesh that moves as the other one does.
pub struct Motion<'a> {
    receiver: &'a FileMesh,
    transfer: DeformationTransfer<'a>,
}

impl Motion<'_> {
    /// The receiving mesh moved as the giving one is in a frame, the given file of this number, as OBJ.
    ///
    /// # Errors
    /// [`TransferError`].
    pub fn moved(
        &mut self,
        number: usize,
        frame: &Shape,
        monitor: &mut dyn Monitor,
    ) -> Result<Vec<u8>, TransferError> {
        let moved = self.transfer.moved(frame, monitor).map_err(|e| TransferError::given(number, e))?;
        let positions = frames::of_file(self.receiver, &moved);
        Ok(export::obj::polygons(&positions, self.receiver.polygons()))
    }
}

/// The texture coordinates of a mesh file.
fn charts(mesh: &FileMesh, bytes: &[u8], side: MeshSide) -> Result<FaceUvs, TransferError> {
    let corners = texture_coordinates::read(bytes).map_err(|e| TransferError::chart(side, e))?;
    face_uvs(mesh, &corners).map_err(|e| TransferError::chart(side, e))
}

/// The usual name of a frame's file, by its number.
pub fn frame_name(number: usize) -> String {
    format!("frame-{number:03}.obj")
}
