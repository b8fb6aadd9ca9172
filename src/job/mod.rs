//! One job: two mesh files and their landmark files in, a map out, told in the files' own numbers.
//!
//! The pipeline knows checked meshes and landmarks that are vertices. A user has files: with vertices that no face uses, faces
//! that were turned, landmarks inside faces. A job goes from the ones to the others and back; the command line, the page and
//! other bindings go through it. What is taken away is made of a map file's content, whether it was just computed or read
//! ([`TakenMap`]).

mod base_picture;
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
mod saved;
mod settling;
mod taken;
mod truth;
mod wrapping;

pub use crate::io::moved::Normals;
pub use crate::mesh::mirror::TargetImage;
pub use base_picture::{BasePicture, BaseShape};
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
pub use outputs::OutputFile;
pub use proof::{ProofError, prove};
pub use proof_report::{
    DoubtfulReport, FaceCounts, LandmarkFigures, MatrixFigures, ProofFigures, ProofReport, SignCounts,
};
pub use saved::{MapFiles, OpenMap, OpenMapError};
pub use settling::{SettledLandmark, planned_stages};
pub use taken::{OutputKind, TakenMap};
pub use truth::TruthError;
pub use wrapping::{QuadAngles, WrapFileError, WrappedFile, WrappedFileReport};

use crate::io::landmark_file::LandmarkFile;
use crate::io::landmark_formats::Space;
use crate::landmark_exchange::{GivenFile, PairLandmarks, Remark, Surface, compare_names, read_pairs};
use crate::landmark_matching::MatchOptions;
use crate::landmarks::{LEAST_LANDMARKS, MeshSide, PlacedLandmarks, place_points, points};
use crate::map_file::FileMesh;
use crate::mesh::check::CheckedMesh;
use crate::mesh::insertion::Insertion;
use crate::mesh::repair::RepairReport;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Rising, Stage, Step};
use crate::pipeline::{
    self, CapFaces, FindingReport, FlatSurface, FlowRecord, Lead, MapInput, MapResult, PipelineError,
    PipelineOptions, Report, SimplificationStage, Warning, findings,
};
use glam::DVec3;
use serde::Serialize;
use truth::Truth;
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

/// The report of a map with that of the landmarks that the program found, stable as JSON.
#[derive(Clone, Debug, Serialize)]
pub struct JobReport<'a> {
    /// The numbers of the run.
    #[serde(flatten)]
    pub report: &'a Report,
    /// Of landmarks that the program found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matching: Option<&'a MatchReport>,
    /// Where soft landmarks settled.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub settled: &'a [SettledLandmark],
}

/// How the files of a job are read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Which target is mapped onto.
    pub target_image: TargetImage,
    /// What becomes of meshes with faults.
    pub mesh_faults: MeshFaults,
    /// What becomes of fewer landmarks than a map needs.
    pub few_landmarks: FewLandmarks,
    /// Bytes that a map may take by [`expected_memory`]; `None` for as many as there are.
    pub most_memory: Option<u64>,
}

impl From<TargetImage> for ReadOptions {
    fn from(target_image: TargetImage) -> Self {
        Self { target_image, ..Self::default() }
    }
}

/// Checked meshes with their landmarks, ready for the pipeline.
#[derive(Clone, Debug)]
pub struct Job {
    meshes: [FileMesh; 2],
    repairs: [RepairReport; 2],
    placed: PlacedLandmarks,
    /// By mesh, source first: which faces of the mesh with its landmarks are caps; `None` where there are none.
    caps: [Option<TiVec<FaceId, bool>>; 2],
    /// As given, on the files' meshes; those beside a corner or an edge as they are held.
    landmarks: LandmarkFile,
    remarks: Vec<Remark>,
    truth: Truth,
    /// What is told of landmarks that the program found; `None` where enough were given.
    matching: Option<MatchReport>,
    /// Where soft landmarks settled.
    settled: Vec<SettledLandmark>,
}

/// A mesh on its way to its landmarks, drawn on both meshes.
#[derive(Clone, Debug, PartialEq)]
pub struct CarriedSimplification {
    /// From the whole mesh down to its landmarks.
    pub stages: Vec<SimplificationStage>,
    /// Where its vertices are on the source and on the target.
    pub positions: [Vec<DVec3>; 2],
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
        let ReadOptions { target_image, mesh_faults, few_landmarks, most_memory } = options.into();
        let mut read = |side, bytes, [from, to]: [f64; 2]| {
            read_mesh(bytes, mesh_faults, &mut Portion::new(monitor, from, to))
                .map_err(|error| JobError::of_mesh(side, error))
        };
        let source = read(MeshSide::Source, files.source, [0.0, 0.5])?;
        let target = read(MeshSide::Target, files.target, [0.5, 1.0])?;
        let meshes = [source.mesh.mesh(), target.mesh.mesh()];
        let expected = expected_memory(meshes);
        if let Some(most) = most_memory.filter(|most| *most < expected) {
            return Err(JobError::Memory { faces: meshes.map(SurfaceMesh::face_count), expected, most });
        }
        let repairs = [source.report, target.report];
        let (source, mut target) = (source.mesh, target.mesh);
        let surfaces = [(&source, files.source), (&target, files.target)]
            .map(|(mesh, bytes)| Surface { mesh: mesh.checked(), space: Space::of_mesh(bytes) });
        let (mut landmarks, remarks) = match (files.landmarks, few_landmarks) {
            ([], FewLandmarks::Matched) => Default::default(),
            (files, _) => {
                let PairLandmarks { file, remarks, .. } = read_pairs(files, surfaces)?;
                (file, remarks)
            }
        };
        let matches = few_landmarks == FewLandmarks::Matched && landmarks.pairs.len() < LEAST_LANDMARKS;
        let mut pairs = landmarks.pairs.clone();
        if target_image == TargetImage::Mirrored {
            target = target.into_mirrored()?;
            pairs.iter_mut().for_each(|[_, point]| *point = point.mirrored());
        }
        let matching = if matches {
            let given = LandmarkFile { pairs, ..landmarks.clone() };
            let options = MatchOptions::default();
            let found = match_meshes([source.checked(), target.checked()], &given, &options, monitor)?;
            let Some(best) = found.landmarks(0) else {
                return Err(JobError::Unmatched { sentence: found.report.verdict.sentence });
            };
            pairs = best.pairs;
            let mut report = found.report;
            if target_image == TargetImage::Mirrored {
                report.mirror_target();
            }
            // What was given stays as it is told of the file.
            landmarks.pairs.extend_from_slice(&report.candidates[0].pairs[landmarks.pairs.len()..]);
            landmarks.labels = best.labels;
            Some(report)
        } else {
            None
        };
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

    /// Takes the true images of the source's vertices, so that reports tell how far a map is from them: a table by the source file's
    /// vertices with the columns `x`, `y` and `z`, places in the target's file, as `vertex-images.csv` has them. Lines may be missing.
    ///
    /// # Errors
    /// [`TruthError`]; then nothing is known of the true map.
    pub fn know_truth(&mut self, table: &[u8]) -> Result<(), TruthError> {
        self.truth = Truth::Unknown;
        self.truth = Truth::of_table(table, self.meshes.each_ref())?;
        Ok(())
    }

    /// Takes the true map, from places in the source's file to places in the target's, likewise.
    pub fn know_true_map(&mut self, image: impl Fn(DVec3) -> DVec3) {
        self.truth = Truth::of_map(image, self.meshes.each_ref());
    }

    /// What was repaired of the source and of the target.
    pub fn repairs(&self) -> &[RepairReport; 2] {
        &self.repairs
    }

    /// Whether its maps have a map file: not those of repaired meshes, whose numbers are not those of their files.
    pub fn has_map_file(&self) -> bool {
        taken::have_map_file(self.meshes.each_ref())
    }

    /// The look that its maps carry, by the contents of its mesh files and what comes with them.
    pub fn look(&self, files: [LookFiles<'_>; 2]) -> MapLook {
        MapLook::read(self.meshes.each_ref(), files)
    }

    /// Number of landmark pairs.
    pub fn landmark_count(&self) -> usize {
        self.placed.landmarks.len()
    }

    /// What there is to know about the landmarks as they were read.
    pub fn landmark_remarks(&self) -> &[Remark] {
        &self.remarks
    }

    /// Compares the names of the mesh files, source and target, with those that the landmark file names. What differs is told
    /// among [`Self::landmark_remarks`] and the report's warnings.
    pub fn compare_names(&mut self, given: [&str; 2]) {
        self.remarks.extend(compare_names(&self.landmarks, given));
    }

    /// What is told of landmarks that the program found; `None` where enough were given.
    pub fn matching(&self) -> Option<&MatchReport> {
        self.matching.as_ref()
    }

    /// Where soft landmarks settled, by pair; none where all are held.
    pub fn settled(&self) -> &[SettledLandmark] {
        &self.settled
    }

    /// The report of a result of this job, with what is told of landmarks that the program found.
    pub fn report<'a>(&'a self, result: &'a MapResult) -> JobReport<'a> {
        JobReport { report: &result.report, matching: self.matching.as_ref(), settled: &self.settled }
    }

    /// Landmark pairs that do not fit and limbs without one, with the numbers of the files.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn findings(&self, monitor: &mut dyn Monitor) -> Result<Vec<FindingReport>, Cancelled> {
        let number = self.file_numbers();
        let labels = self.landmarks.labels.as_deref().unwrap_or_default();
        let found = findings(self.input(), labels, monitor)?;
        Ok(found.into_iter().map(|finding| finding.renumbered(&number)).collect())
    }

    /// Makes the map. The places in its report are those of the files; its other fields refer to the meshes with their
    /// landmarks, and [`Job::outputs`] tells them of the files.
    ///
    /// # Errors
    /// As [`pipeline::run`].
    pub fn run(
        &self,
        options: &PipelineOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<MapResult, PipelineError> {
        let mut result = pipeline::run(self.input(), options, monitor)?;
        let on_files: [&dyn Fn(SurfacePoint) -> SurfacePoint; 2] =
            [&|p| self.on_source_file(p), &|p| self.on_target_file(p)];
        result.report.distortion.replace_worst(on_files);
        let borders = result.report.borders.take();
        result.report.borders = borders.map(|borders| borders.renumbered(self.file_numbers()));
        let warnings = std::mem::take(&mut result.report.warnings);
        result.report.warnings =
            self.repair_warnings().into_iter().chain(self.landmark_warnings()).chain(warnings).collect();
        Ok(result)
    }

    /// The flows of both meshes from step to step, with these curvatures of the landmarks' cones, in radians: those of a result of this job.
    /// The first vertices are those of the checked meshes.
    ///
    /// # Errors
    /// As [`pipeline::recorded_flows`].
    pub fn recorded_flows(
        &self,
        cones: &[f64],
        options: &PipelineOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<[FlowRecord; 2], PipelineError> {
        pipeline::recorded_flows(self.input(), cones, options, monitor)
    }

    /// Both mapped meshes with flat metrics of these curvatures of the landmarks' cones, in radians: those of a result of this job.
    ///
    /// # Errors
    /// As [`pipeline::flat_surfaces`].
    pub fn flat_surfaces(
        &self,
        cones: &[f64],
        options: &PipelineOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<[FlatSurface; 2], PipelineError> {
        pipeline::flat_surfaces(self.input(), cones, options, monitor)
    }

    /// The mapped source and the mapped target: the checked meshes with their landmarks as vertices.
    pub fn mapped_meshes(&self) -> [&SurfaceMesh; 2] {
        [&self.placed.source.mesh, &self.placed.target.mesh]
    }

    /// By landmark its vertex on the mapped source and on the mapped target.
    pub fn landmark_vertices(&self) -> [&[VertexId]; 2] {
        [&self.placed.landmarks.source, &self.placed.landmarks.target]
    }

    /// By face of the mapped source and of the mapped target the face of the checked mesh that contains it.
    pub fn checked_faces(&self) -> [&[FaceId]; 2] {
        [&self.placed.source.face_origin.raw, &self.placed.target.face_origin.raw]
    }

    /// Both meshes on their way to their landmarks, in stages.
    ///
    /// # Errors
    /// As [`pipeline::simplifications`].
    pub fn simplifications(
        &self,
        monitor: &mut dyn Monitor,
    ) -> Result<[Vec<SimplificationStage>; 2], PipelineError> {
        pipeline::simplifications(self.input(), monitor)
    }

    /// One of the mapped meshes, 0 for the source, on its way to its landmarks, and on the other one, where the map has its vertices.
    /// Coordinates are those of the checked meshes.
    ///
    /// # Errors
    /// As [`pipeline::carried_simplification`].
    pub fn carried_simplification(
        &self,
        from: usize,
        map: &TakenMap<'_>,
        lead: Lead,
        monitor: &mut dyn Monitor,
    ) -> Result<CarriedSimplification, PipelineError> {
        let [own, other] = [from, 1 - from];
        let mesh = self.mapped_meshes()[own];
        let landmarks = self.landmark_vertices();
        let positions = self.positions();
        let places = map.vertex_places(own);
        let mut carried: TiVec<VertexId, DVec3> = positions[own].iter().copied().collect();
        for (place, found) in carried.iter_mut().zip(&places) {
            *place = found.unwrap_or(*place);
        }
        // Landmarks inside faces are no vertices of the checked mesh; all of them are exact.
        for (&v, &image) in landmarks[own].iter().zip(landmarks[other]) {
            carried[v] = positions[other][image.index()];
        }
        let shape = mesh.with_positions(carried.clone());
        let stages = pipeline::carried_simplification([mesh, &shape], landmarks[own], lead, monitor)?;
        let mut shapes = [positions[own].clone(), carried.raw];
        shapes.rotate_left(own);
        Ok(CarriedSimplification { stages, positions: shapes })
    }

    /// Where the vertices of the mapped meshes are, in the coordinates of the checked ones, whose vertices are the first: those of landmarks
    /// inside faces follow.
    pub fn positions(&self) -> [Vec<DVec3>; 2] {
        let placed = [&self.placed.source, &self.placed.target];
        [0, 1].map(|k| placed[k].mesh.positions().iter().map(|&p| self.meshes[k].as_given(p)).collect())
    }

    /// A face of the mapped source (0) or the mapped target (1) as its number in the triangulated file.
    pub fn file_face(&self, side: usize, face: FaceId) -> FaceId {
        let placed = if side == 0 { &self.placed.source } else { &self.placed.target };
        self.meshes[side].checked().file_from_face(placed.face_origin[face])
    }

    /// Vertices of the checked source and of the checked target.
    pub fn vertex_counts(&self) -> [usize; 2] {
        self.meshes.each_ref().map(|mesh| mesh.mesh().vertex_count())
    }

    /// What the user should know of the repairs; nothing of a mesh that was good as given.
    fn repair_warnings(&self) -> Vec<Warning> {
        let mut warnings = Vec::new();
        for (side, repair) in [MeshSide::Source, MeshSide::Target].into_iter().zip(&self.repairs) {
            if repair.fault.is_some() {
                warnings.push(Warning::Repaired { side, changes: repair.sentence() });
            }
            if repair.cap_share > 0.0 {
                warnings.push(Warning::Capped { side, share: repair.cap_share });
            }
        }
        warnings
    }

    /// What makes it doubtful that the landmark file belongs to the meshes.
    fn landmark_warnings(&self) -> impl Iterator<Item = Warning> {
        let is_doubtful = |remark: &&Remark| {
            matches!(
                remark,
                Remark::LabelCount { .. }
                    | Remark::OtherMesh { .. }
                    | Remark::ExchangedMeshes
                    | Remark::PairedByOrder
            )
        };
        self.remarks
            .iter()
            .filter(is_doubtful)
            .map(|remark| Warning::LandmarkFile { remark: remark.to_string() })
    }

    /// The number in its file of a vertex of the source (side 0) or of the target as they are mapped; one that was made for a landmark
    /// keeps its number.
    fn file_numbers(&self) -> impl Fn(usize, usize) -> usize + use<> {
        let numbers = self.meshes.each_ref().map(|mesh| mesh.checked().file_from_vertex());
        move |side, v| numbers[side].get(v).copied().unwrap_or(v)
    }

    fn input(&self) -> MapInput<'_> {
        let PlacedLandmarks { source, target, landmarks } = &self.placed;
        let ground_truth = self.truth.known();
        let [source_caps, target_caps] = &self.caps;
        let caps = CapFaces { source: source_caps.as_deref(), target: target_caps.as_deref() };
        MapInput { source: &source.mesh, target: &target.mesh, landmarks, ground_truth, caps }
    }

    /// A point of the mapped source as one of the source's file.
    fn on_source_file(&self, point: SurfacePoint) -> SurfacePoint {
        self.meshes[0].on_file(self.placed.source.on_original(point))
    }

    /// A point of the mapped target as one of the target's file, also where it was mirrored.
    fn on_target_file(&self, point: SurfacePoint) -> SurfacePoint {
        self.meshes[1].on_file(self.placed.target.on_original(point))
    }
}

/// Which faces of a mesh with its landmarks are caps; `None` where there are none.
fn caps(mesh: &CheckedMesh, placed: &Insertion) -> Option<TiVec<FaceId, bool>> {
    mesh.has_caps().then(|| placed.face_origin.iter().map(|&f| mesh.is_cap(f)).collect())
}
