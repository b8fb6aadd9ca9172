//! The contents of landmark files.

use crate::io::landmark_file::{LandmarkFile, LandmarkPoint};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A coordinate system of medical images. From one to the other x and y change their signs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub enum Space {
    /// The axes go to the patient's left, back and head: the system of mesh files that name none.
    #[default]
    Lps,
    /// The axes go to the patient's right, front and head.
    Ras,
}

impl Space {
    /// The system that a mesh file names in its first lines, as 3D Slicer writes it (`SPACE=RAS`).
    pub fn of_mesh(bytes: &[u8]) -> Self {
        // Far enough for comments before the first vertex; the header of a binary STL has 80 bytes.
        let head = &bytes[..bytes.len().min(2048)];
        if head.windows(9).any(|word| word == b"SPACE=RAS") { Self::Ras } else { Self::Lps }
    }

    /// A point of this system in another.
    pub fn to(self, other: Self, p: DVec3) -> DVec3 {
        if self == other { p } else { half_turned(p) }
    }

    /// The name of the system.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lps => "LPS",
            Self::Ras => "RAS",
        }
    }
}

/// A point turned by 180 degrees about the z axis: LPS to RAS and back.
pub fn half_turned(p: DVec3) -> DVec3 {
    DVec3::new(-p.x, -p.y, p.z)
}

/// The place of a landmark as its file gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spot {
    /// A point on the surface, with the numbers of the mesh's file.
    OnMesh(LandmarkPoint),
    /// A point in space, in the coordinates of the file.
    InSpace(DVec3),
}

/// A landmark of one mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Its name, empty for none.
    pub label: String,
    /// The place of the landmark; `None` where the file says that it was not placed.
    pub spot: Option<Spot>,
}

/// The landmarks of one mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MarkList {
    /// The name of the list or its specimen in the file, empty for none.
    pub name: String,
    /// The coordinate system, where the file names one.
    pub space: Option<Space>,
    /// The landmarks in the file's order.
    pub marks: Vec<Mark>,
}

/// The contents of a landmark file.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// The landmarks of one mesh.
    Side(MarkList),
    /// The landmarks of source and target.
    Sides([MarkList; 2]),
    /// Pairs with the numbers of the meshes' files: the program's own format.
    Pairs(LandmarkFile),
}

/// A landmark on a surface, ready to be written in any format.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceMark {
    /// Its name, empty for none.
    pub label: String,
    /// The place of the landmark in space.
    pub position: DVec3,
    /// A face that holds it, 0-based.
    pub face: u32,
    /// Weights of the face's corners, in the order of the mesh's file.
    pub weights: [f64; 3],
}

/// The landmarks of one mesh, ready to be written in any format.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceMarks {
    /// The name for the list: that of the mesh.
    pub name: String,
    /// The coordinate system of the positions.
    pub space: Space,
    /// The landmarks.
    pub marks: Vec<SurfaceMark>,
}
