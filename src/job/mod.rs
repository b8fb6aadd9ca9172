//! One job: two mesh files and their landmark files in, a map out, in the files' own numbers.
//!
//! The pipeline knows checked meshes and landmarks that are vertices. A user has files: with vertices that no face uses, faces
//! that were turned, landmarks inside faces. A job goes from the ones to the others and back; the command line, the page and
//! other bindings go through it. What is taken away is made of a map file's content, whether it was just computed or read
//! ([`TakenMap`]).

mod base_picture;
mod carried;
mod checked_job;
mod error;
mod held;
mod look;
mod matching;
mod memory;
mod mesh_file;
mod morph;
mod outputs;
mod proof;
mod proof_report;
mod reading;
mod saved;
mod settling;
mod shapes;
mod taken;
mod truth;
mod wrapping;

pub use crate::io::moved::Normals;
pub use crate::mesh::mirror::TargetImage;
pub use base_picture::{BasePicture, BaseShape};
pub use carried::CarriedSimplification;
pub use checked_job::{Job, JobReport};
pub use conemap_verify::Proof;
pub use error::{JobError, JobFile};
pub use look::{LookFiles, MapLook};
pub use matching::{
    CandidateReport, DifferenceReport, FewLandmarks, MatchReport, Matched, QuestionReport, VerdictReport,
    match_meshes,
};
pub use memory::{LEAST_MEMORY, MEMORY_PER_FACE, expected_memory};
pub use mesh_file::{MeshFaults, MeshFileError, ReadMesh, read_mesh};
pub use morph::{DrawnPoints, DrawnWay, MORPH_FILE, MorphError};
pub use outputs::{OutputFile, OutputFiles};
pub use proof::{ProofError, prove};
pub use proof_report::{
    DoubtfulReport, FaceCounts, LandmarkFigures, MatrixFigures, ProofFigures, ProofReport, SignCounts,
};
pub use reading::{JobFiles, ReadOptions};
pub use saved::{MapFiles, OpenMap, OpenMapError};
pub use settling::{SettledLandmark, planned_stages};
pub use shapes::ShapeOutput;
pub use taken::{OutputKind, TakenMap};
pub use truth::TruthError;
pub use wrapping::{QuadAngles, WrapFileError, WrappedFile, WrappedFileReport};
