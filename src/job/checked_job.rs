//! A job whose files have been read: what it knows, and its runs.

use super::look::{LookFiles, MapLook};
use super::matching::MatchReport;
use super::settling::SettledLandmark;
use super::taken;
use super::truth::{Truth, TruthError};
use crate::io::landmark_file::LandmarkFile;
use crate::landmark_exchange::{Remark, compare_names};
use crate::landmarks::{MeshSide, PlacedLandmarks};
use crate::map_file::FileMesh;
use crate::mesh::repair::RepairReport;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor};
use crate::pipeline::{
    self, CapFaces, FindingReport, FlatSurface, FlowRecord, MapInput, MapResult, PipelineError,
    PipelineOptions, Report, SimplificationStage, Warning, findings,
};
use glam::DVec3;
use serde::Serialize;
use typed_index_collections::TiVec;

/// The report of a map with that of the landmarks that the program found, stable as JSON.
#[derive(Clone, Debug, Serialize)]
pub struct JobReport<'a> {
    /// The numbers of the run.
    #[serde(flatten)]
    pub report: &'a Report,
    /// The report of the search for landmarks, where the program found some.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matching: Option<&'a MatchReport>,
    /// The points where soft landmarks settled.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub settled: &'a [SettledLandmark],
}

/// Checked meshes with their landmarks, ready for the pipeline.
#[derive(Clone, Debug)]
pub struct Job {
    pub(super) meshes: [FileMesh; 2],
    pub(super) repairs: [RepairReport; 2],
    pub(super) placed: PlacedLandmarks,
    /// Which faces of each mesh with its landmarks are caps, the source first; `None` where there are none.
    pub(super) caps: [Option<TiVec<FaceId, bool>>; 2],
    /// The landmarks as they were given, on the files' meshes; those near a corner or an edge at the place where they are held.
    pub(super) landmarks: LandmarkFile,
    pub(super) remarks: Vec<Remark>,
    pub(super) truth: Truth,
    /// The report on landmarks that the program found; `None` where enough were given.
    pub(super) matching: Option<MatchReport>,
    /// The points where soft landmarks settled.
    pub(super) settled: Vec<SettledLandmark>,
}

impl Job {
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

    /// The repairs of the source and of the target.
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

    /// Remarks on the landmarks as they were read.
    pub fn landmark_remarks(&self) -> &[Remark] {
        &self.remarks
    }

    /// Compares the names of the mesh files, source and target, with those that the landmark file names. Differences are listed in
    /// [`Self::landmark_remarks`] and the report's warnings.
    pub fn compare_names(&mut self, given: [&str; 2]) {
        self.remarks.extend(compare_names(&self.landmarks, given));
    }

    /// The report on landmarks that the program found; `None` where enough were given.
    pub fn matching(&self) -> Option<&MatchReport> {
        self.matching.as_ref()
    }

    /// The points where soft landmarks settled, by pair; empty where all landmarks are held.
    pub fn settled(&self) -> &[SettledLandmark] {
        &self.settled
    }

    /// The report of a result of this job, with that on landmarks that the program found.
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

    /// The vertex of each landmark on the mapped source and on the mapped target.
    pub fn landmark_vertices(&self) -> [&[VertexId]; 2] {
        [&self.placed.landmarks.source.raw, &self.placed.landmarks.target.raw]
    }

    /// The face of the checked mesh that contains each face of the mapped source and of the mapped target.
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

    /// The positions of the vertices of the mapped meshes, in the coordinates of the checked meshes, whose vertices come first; those of
    /// landmarks inside faces follow.
    pub fn positions(&self) -> [Vec<DVec3>; 2] {
        let placed = [&self.placed.source, &self.placed.target];
        [0, 1].map(|k| placed[k].mesh.positions().iter().map(|&p| self.meshes[k].as_given(p)).collect())
    }

    /// A face of one of the mapped meshes as its number in the triangulated file.
    pub fn file_face(&self, side: MeshSide, face: FaceId) -> FaceId {
        let placed = [&self.placed.source, &self.placed.target][side];
        self.meshes[side].checked().file_from_face(placed.face_origin[face])
    }

    /// Vertices of the checked source and of the checked target.
    pub fn vertex_counts(&self) -> [usize; 2] {
        self.meshes.each_ref().map(|mesh| mesh.mesh().vertex_count())
    }

    /// The warnings about repairs; none for a mesh that was good as given.
    fn repair_warnings(&self) -> Vec<Warning> {
        let mut warnings = Vec::new();
        for (side, repair) in MeshSide::BOTH.into_iter().zip(&self.repairs) {
            if repair.fault.is_some() {
                warnings.push(Warning::Repaired { side, changes: repair.sentence() });
            }
            if repair.cap_share > 0.0 {
                warnings.push(Warning::Capped { side, share: repair.cap_share });
            }
        }
        warnings
    }

    /// The warnings that the landmark file may not belong to the meshes.
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

    /// The number in its file of a vertex of one of the mapped meshes; one that was made for a landmark keeps its number.
    fn file_numbers(&self) -> impl Fn(MeshSide, usize) -> usize + use<> {
        let numbers = self.meshes.each_ref().map(|mesh| mesh.checked().file_from_vertex());
        move |side: MeshSide, v: usize| numbers[side].get(v).copied().unwrap_or(v)
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
    pub(super) fn on_target_file(&self, point: SurfacePoint) -> SurfacePoint {
        self.meshes[1].on_file(self.placed.target.on_original(point))
    }
}
