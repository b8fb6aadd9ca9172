//! Why landmark files cannot be brought onto meshes.

use super::remark::{Named, Short};
use crate::io::landmark_file::LandmarkFileError;
use crate::io::landmark_formats::LandmarkReadError;
use crate::landmarks::MeshSide;
use std::fmt;

/// A change by which points that are far from a mesh would lie on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Advice {
    /// With x and y of opposite signs.
    HalfTurn,
    /// Multiplied by a number.
    Scale(f64),
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::HalfTurn => f.write_str(
                "with opposite x and y, as between LPS and RAS, all landmarks would lie on it: exchange LPS and RAS in the file",
            ),
            Self::Scale(factor) => {
                write!(f, "multiplied by {} all landmarks would lie on it: convert the units", Short(*factor))
            }
        }
    }
}

/// Why landmark files cannot be brought onto meshes. Landmarks are counted from 1 in words, from 0 in fields.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExchangeError {
    /// A file cannot be read.
    #[error("{error}")]
    Read {
        /// Its number among the files given, 0-based.
        file: usize,
        /// Why.
        error: LandmarkReadError,
    },
    /// One file for one mesh is not enough.
    #[error("this file holds the landmarks of one mesh: give a second file for the other mesh")]
    OneMeshOnly,
    /// One of two files holds both.
    #[error("this file holds the landmarks of both meshes: give it alone")]
    BothMeshes {
        /// Its number among the files given, 0-based.
        file: usize,
    },
    /// Neither one file nor two.
    #[error("landmarks are in one file or in two, but {count} were given")]
    FileCount {
        /// The number of points.
        count: usize,
    },
    /// A point of a face that the mesh does not have.
    #[error("{} of the {side} is on face {face}, but the mesh has {faces} faces: the file belongs to another mesh", Named::new(.index, .label))]
    MissingFace {
        /// The file's number among those given, 0-based.
        file: usize,
        /// The mesh.
        side: MeshSide,
        /// The landmark.
        index: usize,
        /// Its name.
        label: String,
        /// The number of the face.
        face: u32,
        /// Number of faces of the mesh.
        faces: usize,
    },
    /// A point in space far from the mesh.
    #[error(
        "{} of the {side} lies {} off the surface, {:.0} % of the mesh's size: units or coordinate systems may differ, or it is another mesh{}",
        Named::new(.index, .label),
        Short(*.distance),
        100.0 * .share,
        Advised(*.advice)
    )]
    FarOff {
        /// The file's number among those given, 0-based.
        file: usize,
        /// The mesh.
        side: MeshSide,
        /// The landmark that is farthest.
        index: usize,
        /// Its name.
        label: String,
        /// Its distance in the units of the mesh.
        distance: f64,
        /// The distance in units of the square root of the mesh's area.
        share: f64,
        /// The change by which all points would lie on the mesh, where one was found.
        advice: Option<Advice>,
    },
    /// Lists that cannot be paired.
    #[error(
        "the source has {} landmarks and the target {}, and their labels differ{}: give each landmark the same label on both, or equally many in one order",
        .counts[0], .counts[1], Unpaired(.unpaired)
    )]
    Unpaired {
        /// Number of landmarks of source and target.
        counts: [usize; 2],
        /// The first labels that only the source or only the target has.
        unpaired: [Vec<String>; 2],
    },
    /// The pairs are no landmark file.
    #[error(transparent)]
    Pairs(#[from] LandmarkFileError),
}

impl ExchangeError {
    /// The number of the file at fault among those given; `None` where it is no single one's fault.
    pub fn file(&self) -> Option<usize> {
        match self {
            Self::Read { file, .. }
            | Self::BothMeshes { file }
            | Self::MissingFace { file, .. }
            | Self::FarOff { file, .. } => Some(*file),
            Self::OneMeshOnly => Some(0),
            Self::FileCount { .. } | Self::Unpaired { .. } | Self::Pairs(_) => None,
        }
    }
}

struct Advised(Option<Advice>);

impl fmt::Display for Advised {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |advice| write!(f, "; {advice}"))
    }
}

struct Unpaired<'a>(&'a [Vec<String>; 2]);

impl fmt::Display for Unpaired<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sides = ["source", "target"];
        let told: Vec<_> = sides
            .iter()
            .zip(self.0)
            .filter(|(_, labels)| !labels.is_empty())
            .map(|(side, labels)| format!("only the {side} has \"{}\"", labels.join("\", \"")))
            .collect();
        if told.is_empty() { Ok(()) } else { write!(f, " ({})", told.join("; ")) }
    }
}
