//! From the files of a job to checked meshes with their landmarks.

use super::checked_job::Job;
use super::error::JobError;
use super::matching::{FewLandmarks, MatchReport, match_meshes};
use super::memory::expected_memory;
use super::mesh_file::{MeshFaults, ReadMesh, read_mesh};
use super::truth::Truth;
use super::{held, settling};
use crate::io::landmark_file::{LandmarkFile, LandmarkPoint};
use crate::io::landmark_formats::Space;
use crate::landmark_exchange::{GivenFile, PairLandmarks, Remark, Surface, read_pairs};
use crate::landmark_matching::MatchOptions;
use crate::landmarks::{LEAST_LANDMARKS, MeshSide, place_points, points};
use crate::map_file::FileMesh;
use crate::mesh::check::CheckedMesh;
use crate::mesh::insertion::Insertion;
use crate::mesh::mirror::TargetImage;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint};
use crate::monitor::{Monitor, Portion, Rising, Stage, Step};
use typed_index_collections::TiVec;

/// The contents of the files of a job.
#[derive(Clone, Copy, Debug)]
pub struct JobFiles<'a> {
    /// A mesh of any known format.
    pub source: &'a [u8],
    /// A mesh of any known format.
    pub target: &'a [u8],
    /// A landmark file of any known format that holds the landmarks of both meshes, or the source's and the target's.
    pub landmarks: &'a [GivenFile<'a>],
}

/// How the files of a job are read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Which target is mapped onto.
    pub target_image: TargetImage,
    /// Says what becomes of meshes with faults.
    pub mesh_faults: MeshFaults,
    /// Says what becomes of fewer landmarks than a map needs.
    pub few_landmarks: FewLandmarks,
    /// The number of bytes that a map may take by [`expected_memory`]; `None` for as many as there are.
    pub most_memory: Option<u64>,
}

impl From<TargetImage> for ReadOptions {
    fn from(target_image: TargetImage) -> Self {
        Self { target_image, ..Self::default() }
    }
}

impl Job {
    /// Reads and checks the files, and places the landmarks.
    ///
    /// # Errors
    /// [`JobError`] with the file at fault.
    pub fn read(
        files: JobFiles<'_>,
        options: impl Into<ReadOptions>,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, JobError> {
        let monitor = &mut Rising::new(monitor);
        monitor.enter(Stage::Landmarks);
        let options = options.into();
        let read = read_meshes(&files, &options, monitor)?;
        let mut given = Given::read(&files, options.few_landmarks, &read)?;
        let [ReadMesh { mesh: source, report: of_source }, ReadMesh { mesh: mut target, report: of_target }] =
            read;
        let repairs = [of_source, of_target];
        let matches =
            options.few_landmarks == FewLandmarks::Matched && given.landmarks.pairs.len() < LEAST_LANDMARKS;
        if options.target_image == TargetImage::Mirrored {
            target = target.into_mirrored()?;
            given.pairs.iter_mut().for_each(|[_, point]| *point = point.mirrored());
        }
        let matching = if matches {
            Some(given.complete([&source, &target], options.target_image, monitor)?)
        } else {
            None
        };
        let Given { mut landmarks, pairs, remarks } = given;
        monitor.step(Step { fraction: 1.0, residual: None })?;
        let (on_source, on_target) = (
            points(source.checked(), MeshSide::Source, &pairs)?,
            points(target.checked(), MeshSide::Target, &pairs)?,
        );
        let mut ends: Vec<[SurfacePoint; 2]> =
            on_source.into_iter().zip(on_target).map(|(s, t)| [s, t]).collect();
        let settled = settling::settle_landmarks([&source, &target], &mut landmarks, &mut ends, monitor)?;
        let [on_source, on_target] = [0, 1].map(|k| ends.iter().map(|ends| ends[k]).collect::<Vec<_>>());
        let placed = place_points([source.mesh(), target.mesh()], [&on_source, &on_target])?;
        monitor.step(Step { fraction: 1.0, residual: None })?;
        held::tell(&mut landmarks, &placed, [&source, &target]);
        let is_same = source.mesh().triangles() == target.mesh().triangles();
        let truth = match landmarks.ground_truth {
            Some(_) if is_same => Truth::SameConnectivity,
            _ => Truth::Unknown,
        };
        let caps = [caps(source.checked(), &placed.source), caps(target.checked(), &placed.target)];
        Ok(Self {
            meshes: [source, target],
            repairs,
            placed,
            caps,
            landmarks,
            remarks,
            truth,
            matching,
            settled,
        })
    }
}

/// Both meshes, as long as a map of them has room.
fn read_meshes(
    files: &JobFiles<'_>,
    options: &ReadOptions,
    monitor: &mut dyn Monitor,
) -> Result<[ReadMesh; 2], JobError> {
    let mut read = |side, bytes, [from, to]: [f64; 2]| {
        read_mesh(bytes, options.mesh_faults, &mut Portion::new(monitor, from, to))
            .map_err(|error| JobError::of_mesh(side, error))
    };
    let source = read(MeshSide::Source, files.source, [0.0, 0.5])?;
    let target = read(MeshSide::Target, files.target, [0.5, 1.0])?;
    let meshes = [source.mesh.mesh(), target.mesh.mesh()];
    let expected = expected_memory(meshes);
    match options.most_memory.filter(|most| *most < expected) {
        Some(most) => Err(JobError::Memory { faces: meshes.map(SurfaceMesh::face_count), expected, most }),
        None => Ok([source, target]),
    }
}

/// Landmarks as they were given, and what the program adds to them.
struct Given {
    /// The landmarks in the numbers of the files.
    landmarks: LandmarkFile,
    /// Their points on the meshes as they are mapped.
    pairs: Vec<[LandmarkPoint; 2]>,
    remarks: Vec<Remark>,
}

impl Given {
    fn read(
        files: &JobFiles<'_>,
        few: FewLandmarks,
        [source, target]: &[ReadMesh; 2],
    ) -> Result<Self, JobError> {
        let surfaces = [(source, files.source), (target, files.target)]
            .map(|(read, bytes)| Surface { mesh: read.mesh.checked(), space: Space::of_mesh(bytes) });
        let (landmarks, remarks) = match (files.landmarks, few) {
            ([], FewLandmarks::Matched) => Default::default(),
            (files, _) => {
                let PairLandmarks { file, remarks, .. } = read_pairs(files, surfaces)?;
                (file, remarks)
            }
        };
        Ok(Self { pairs: landmarks.pairs.clone(), landmarks, remarks })
    }

    /// Adds the best landmarks that the program finds, and says what it found.
    fn complete(
        &mut self,
        [source, target]: [&FileMesh; 2],
        target_image: TargetImage,
        monitor: &mut dyn Monitor,
    ) -> Result<MatchReport, JobError> {
        let given = LandmarkFile { pairs: self.pairs.clone(), ..self.landmarks.clone() };
        let options = MatchOptions::default();
        let found = match_meshes([source.checked(), target.checked()], &given, &options, monitor)?;
        let Some(best) = found.landmarks(0) else {
            return Err(JobError::Unmatched { sentence: found.report.verdict.sentence });
        };
        self.pairs = best.pairs;
        let mut report = found.report;
        if target_image == TargetImage::Mirrored {
            report.mirror_target();
        }
        // The given pairs stay in the numbers of the files.
        let told = self.landmarks.pairs.len();
        self.landmarks.pairs.extend_from_slice(&report.candidates[0].pairs[told..]);
        self.landmarks.labels = best.labels;
        Ok(report)
    }
}

/// Which faces of a mesh with its landmarks are caps; `None` where there are none.
fn caps(mesh: &CheckedMesh, placed: &Insertion) -> Option<TiVec<FaceId, bool>> {
    mesh.has_caps().then(|| placed.face_origin.iter().map(|&f| mesh.is_cap(f)).collect())
}
