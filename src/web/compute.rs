//! The pipeline in the worker.

use super::page_job::read_job;
use super::{failure, mesh_side, output_file};
use crate::demo::true_map;
use crate::io::landmark_file;
use crate::job::{BasePicture, Job, JobError, LookFiles, OutputKind, planned_stages};
use crate::landmarks::MeshSide;
use crate::mesh::check::CheckedMesh;
use crate::monitor::{Cancelled, MapPreview, Monitor, PlannedStage, Progress, Stage, Step};
use crate::pipeline::{Choices, MapResult, PipelineOptions};
use crate::surface_map::measures::transfer::CommonMesh;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const LISTENER: &str = r"
/** What a run tells and asks while it goes. Numbers that a step does not have are NaN. */
export interface RunListener {
  /** In the stage `relaxation`: a map is relaxed, or is on a finer level; energies do not compare with those before. */
  relaxes(): void;
  /**
   * A stage begins or goes on, at most 30 times a second: its name and what the program does meanwhile in words, the share of
   * the whole run that is done (0 to 1, never falling), and the energy of the map being relaxed (4 for an isometry).
   */
  progress(stage: Stage, sentence: string, share: number, residual: number, energy: number): void;
  /**
   * The map as it is being made: by vertex of the checked source (those of landmarks inside faces may follow) its place on the target,
   * three numbers each; and the landmark pairs of this map that were found, as the files number their vertices, the source's and the
   * target's in turn.
   */
  preview(places: Float32Array, pairs: Uint32Array): void;
  /** Landmark pairs that do not fit, before the map is made. */
  found(json: string): void;
  /** Whether to finish now with a whole map, only less relaxed; asked at most ten times a second. */
  wantsResult(): boolean;
}
";

#[wasm_bindgen]
extern "C" {
    /// Milliseconds since the worker began. In contrast to the date it never goes back, and its steps are finer.
    #[wasm_bindgen(js_namespace = performance, js_name = now)]
    fn milliseconds() -> f64;

    /// The functions of the page that a run calls while it goes.
    #[wasm_bindgen(typescript_type = "RunListener")]
    pub type RunListener;
    #[wasm_bindgen(method, catch)]
    fn progress(
        this: &RunListener,
        stage: &str,
        sentence: &str,
        share: f64,
        residual: f64,
        energy: f64,
    ) -> Result<(), JsValue>;
    #[wasm_bindgen(method, catch)]
    fn relaxes(this: &RunListener) -> Result<(), JsValue>;
    #[wasm_bindgen(method, catch)]
    fn preview(
        this: &RunListener,
        places: js_sys::Float32Array,
        pairs: js_sys::Uint32Array,
    ) -> Result<(), JsValue>;
    #[wasm_bindgen(method, catch)]
    fn found(this: &RunListener, json: &str) -> Result<(), JsValue>;
    #[wasm_bindgen(method, catch, js_name = wantsResult)]
    fn wants_result(this: &RunListener) -> Result<bool, JsValue>;
}

/// The least time between two messages of one stage, in milliseconds. Each changes the page: without a graphics card the
/// browser's drawing took 8 s of processor time beside a search of 12 s with 33 ms, and 4 s with 500.
const MESSAGE_INTERVAL: f64 = 500.0;

/// The least time between two questions, in milliseconds.
const QUESTION_INTERVAL: f64 = 100.0;

/// Previews take no more than this share of the time that has passed, but for the first. Each counts as the quickest so far, since one that was
/// held up by other programs would keep the next ones back.
const PREVIEW_SHARE: f64 = 0.03;

/// Tells the page how the run goes on and takes the time of each stage.
pub(super) struct Messenger<'a> {
    listener: &'a RunListener,
    /// Energy of the map that is being relaxed.
    energy: f64,
    /// When the page was last asked, and whether it wants a result.
    asked: f64,
    wants_result: bool,
    stage: Option<(Stage, f64)>,
    /// The time of the last report to the page.
    told: f64,
    seconds: BTreeMap<String, f64>,
    progress: Progress,
    begun: f64,
    /// Time that previews took, in milliseconds, but for the first.
    previewing: f64,
    /// Time that the quickest preview took, in milliseconds; infinite before the first.
    quickest: f64,
    /// The files' numbers of the vertices of both meshes; a vertex that is not listed keeps its number.
    numbers: [Vec<usize>; 2],
}

impl<'a> Messenger<'a> {
    pub(super) fn new(listener: &'a RunListener) -> Self {
        Self {
            listener,
            energy: f64::NAN,
            asked: 0.0,
            wants_result: false,
            stage: None,
            told: 0.0,
            seconds: BTreeMap::new(),
            progress: Progress::new(Vec::new()),
            begun: milliseconds(),
            previewing: 0.0,
            quickest: f64::INFINITY,
            numbers: [Vec::new(), Vec::new()],
        }
    }

    /// From now on previews name the vertices of these meshes by their files' numbers.
    pub(super) fn name_vertices(&mut self, meshes: [&CheckedMesh; 2]) {
        self.numbers = meshes.map(CheckedMesh::file_from_vertex);
    }

    /// The stages that the run will pass.
    pub(super) fn plan(&mut self, stages: Vec<PlannedStage>) {
        self.progress = Progress::new(stages);
    }

    fn leave(&mut self) {
        if let Some((stage, begun)) = self.stage.take() {
            *self.seconds.entry(stage.to_string()).or_default() += (milliseconds() - begun) / 1000.0;
        }
    }

    fn tell(&mut self, stage: Stage, step: Step) {
        self.told = milliseconds();
        let residual = step.residual.unwrap_or(f64::NAN);
        // A page that does not listen is not a reason to stop.
        let share = self.progress.at(stage, step.fraction);
        let _ = self.listener.progress(&stage.to_string(), stage.sentence(), share, residual, self.energy);
    }
}

impl Monitor for Messenger<'_> {
    fn enter(&mut self, stage: Stage) {
        self.leave();
        self.stage = Some((stage, milliseconds()));
        self.energy = f64::NAN;
        self.tell(stage, Step::default());
    }

    fn relaxation_begins(&mut self) {
        if self.stage.is_some_and(|(stage, _)| stage == Stage::Relaxation) {
            // A page that does not listen is not a reason to stop.
            let _ = self.listener.relaxes();
        }
    }

    fn map_energy(&mut self, energy: f64) {
        self.energy = energy;
    }

    fn preview(&mut self, preview: &dyn MapPreview) {
        let now = milliseconds();
        if self.previewing > PREVIEW_SHARE * (now - self.begun) {
            return;
        }
        if let Some(places) = preview.images(MeshSide::Source) {
            let places = js_sys::Float32Array::from(&flat3(&places)[..]);
            let number = |side: usize, v: usize| *self.numbers[side].get(v).unwrap_or(&v) as u32;
            let pairs = preview.found_pairs().into_iter();
            let pairs: Vec<u32> = pairs.flat_map(|[s, t]| [number(0, s), number(1, t)]).collect();
            // A page that does not listen is not a reason to stop.
            let _ = self.listener.preview(places, js_sys::Uint32Array::from(&pairs[..]));
        }
        let is_first = self.quickest == f64::INFINITY;
        self.quickest = self.quickest.min(milliseconds() - now);
        if !is_first {
            self.previewing += self.quickest;
        }
    }

    fn wants_result(&self) -> bool {
        self.wants_result
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        if !self.wants_result && milliseconds() - self.asked >= QUESTION_INTERVAL {
            self.wants_result = self.listener.wants_result().unwrap_or(false);
            self.asked = milliseconds();
        }
        if let Some((stage, _)) = self.stage
            && milliseconds() - self.told >= MESSAGE_INTERVAL
        {
            self.tell(stage, step);
        }
        Ok(())
    }
}

/// The parts of a map that the views show.
pub(super) struct Shown {
    pub common: CommonMesh,
    /// Distortion at each point of `common`, 1 for none; empty for the thesis' method.
    pub distortion: Vec<f64>,
    /// Distance of each point of `common` from its true image, in units of the root of the target's area; empty where that is not
    /// known.
    pub truth: Vec<f64>,
    /// Patch lines on the source and on the target.
    pub patch_lines: [Vec<Vec<DVec3>>; 2],
    /// Curvature of each landmark's cone, in radians.
    pub cones: Vec<f64>,
    /// The base domain; `None` where the map does not tell how it lies on the meshes.
    pub base: Option<BasePicture>,
    /// The report as JSON.
    pub report: String,
}

impl Shown {
    /// The parts of the map of a run that the views show; the patch lines are moved out of `result`.
    pub(super) fn of_run(job: &Job, result: &mut MapResult, true_map: Option<fn(DVec3) -> DVec3>) -> Self {
        let mut common = result.common.clone();
        // Where a landmark lies inside a face the mapped mesh has more faces than the checked one.
        for faces in &mut common.faces {
            *faces = [0, 1].map(|k| job.checked_faces()[k][faces[k].index()]);
        }
        Self {
            distortion: result.common_vertex_distortion(),
            truth: true_map.map_or_else(Vec::new, |image| common.distances_to(image)),
            common,
            patch_lines: std::mem::take(&mut result.patch_lines),
            cones: result.cone_curvatures.clone(),
            base: Some(job.base_picture(result)),
            report: serde_json::to_string_pretty(&job.report(result)).unwrap_or_default(),
        }
    }
}

/// A finished map.
#[wasm_bindgen]
pub struct MapOutput {
    shown: Shown,
    /// The run, of which files are made; `None` for maps that were saved, whose files the saved map gives, and for those that are
    /// only looked at.
    run: Option<FinishedRun>,
}

struct FinishedRun {
    job: Job,
    result: MapResult,
    choices: Choices,
}

impl MapOutput {
    /// The output of a map that was saved, or that is compared with another one: it has what the views show, and makes no files.
    pub(super) fn for_views(shown: Shown) -> Self {
        Self { shown, run: None }
    }

    /// The parts of the map that the views show.
    pub(super) fn shown(&self) -> &Shown {
        &self.shown
    }

    fn run(&self) -> Result<&FinishedRun, JsValue> {
        self.run.as_ref().ok_or_else(|| failure("export", "the files of a saved map are asked of it"))
    }
}

/// Runs the pipeline; the listener receives progress and may ask for the result. Where the meshes are a demo's, its id tells the true map
/// where that is known.
///
/// # Errors
/// `{"code", "message"}` with the stage's code.
#[wasm_bindgen(js_name = runMap)]
pub fn run_map(
    source: &[u8],
    target: &[u8],
    landmarks: &str,
    options: &str,
    listener: &RunListener,
    demo: Option<String>,
) -> Result<MapOutput, JsValue> {
    let mut messenger = Messenger::new(listener);
    let begun = milliseconds();
    let choices: Choices = serde_json::from_str(options).map_err(|e| failure("options", e))?;
    let options = PipelineOptions::from(choices);
    let failed = |error: JobError| failure(error.code(), error);
    // The job reports landmarks that cannot be read.
    let given = landmark_file::read(landmarks.as_bytes()).unwrap_or_default();
    messenger.plan(planned_stages(&given, &options));
    let mut job = read_job([source, target], landmarks, &mut messenger)?;
    let true_map = demo.and_then(|id| true_map(&id));
    if let Some(image) = true_map {
        job.know_true_map(image);
    }
    let findings = job.findings(&mut messenger).map_err(|stop| failed(stop.into()))?;
    let json = serde_json::to_string(&findings).unwrap_or_default();
    // A page that does not listen is not a reason to stop.
    let _ = listener.found(&json);
    let mut result = job.run(&options, &mut messenger).map_err(|error| failed(error.into()))?;
    messenger.leave();
    let mut seconds = messenger.seconds;
    seconds.insert("total".into(), (milliseconds() - begun) / 1000.0);
    result.report.set_seconds(seconds);
    result.report.findings = findings;
    let shown = Shown::of_run(&job, &mut result, true_map);
    Ok(MapOutput { shown, run: Some(FinishedRun { job, result, choices }) })
}

/// The files that tell how both meshes look.
pub(super) fn look_files<'a>(
    meshes: [&'a [u8]; 2],
    companions: [&'a Option<Vec<u8>>; 2],
) -> [LookFiles<'a>; 2] {
    [0, 1].map(|k| LookFiles { mesh: meshes[k], companion: companions[k].as_deref() })
}

/// Coordinates of points in single precision, one after the other.
pub(super) fn flat3(points: &[DVec3]) -> Vec<f32> {
    points.iter().flat_map(|p| p.as_vec3().to_array()).collect()
}

#[wasm_bindgen]
impl MapOutput {
    /// Positions of the common subdivision on the source (0) or the target (1), three numbers a point.
    pub fn positions(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        let common = &self.shown.common;
        Ok(flat3([&common.source_positions, &common.target_positions][mesh_side(side)?]))
    }

    /// Unit normals on the source (0) or the target (1).
    pub fn normals(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        let common = &self.shown.common;
        Ok(flat3([&common.source_normals, &common.target_normals][mesh_side(side)?]))
    }

    /// Texture coordinates, two numbers a point.
    pub fn uvs(&self) -> Vec<f32> {
        self.shown.common.uvs.iter().flat_map(|uv: &DVec2| [uv.x as f32, uv.y as f32]).collect()
    }

    /// Distortion around each point, 1 for none; empty for the thesis' method.
    pub fn distortion(&self) -> Vec<f32> {
        self.shown.distortion.iter().map(|&d| d as f32).collect()
    }

    /// The distance to the true image around each point, in units of the root of the target's area; empty where that is not known.
    pub fn truth(&self) -> Vec<f32> {
        self.shown.truth.iter().map(|&d| d as f32).collect()
    }

    /// Triangles of the common subdivision.
    pub fn triangles(&self) -> Vec<u32> {
        self.shown.common.triangles.iter().flatten().copied().collect()
    }

    /// The face of the source (0) or the target (1) in which each triangle lies; empty for the thesis' method.
    pub fn faces(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        let side = mesh_side(side)?;
        Ok(self.shown.common.faces.iter().map(|faces| faces[side].0).collect())
    }

    /// Points of all patch lines on one side.
    #[wasm_bindgen(js_name = linePoints)]
    pub fn line_points(&self, side: usize) -> Result<Vec<f32>, JsValue> {
        Ok(self.shown.patch_lines[mesh_side(side)?].iter().flat_map(|line| flat3(line)).collect())
    }

    /// Where each patch line starts among the points, and one past the end.
    #[wasm_bindgen(js_name = lineStarts)]
    pub fn line_starts(&self, side: usize) -> Result<Vec<u32>, JsValue> {
        let mut starts = vec![0];
        let mut end = 0;
        for line in &self.shown.patch_lines[mesh_side(side)?] {
            end += line.len() as u32;
            starts.push(end);
        }
        Ok(starts)
    }

    /// Curvature of each landmark's cone, in radians.
    pub fn cones(&self) -> Vec<f64> {
        self.shown.cones.clone()
    }

    /// The report as JSON.
    pub fn report(&self) -> String {
        self.shown.report.clone()
    }

    /// The map file, from which a later worker makes every other file; `undefined` where the map has no pieces (the thesis' method,
    /// and a map without an overlay), and where a mesh was repaired.
    ///
    /// # Errors
    /// `{"code": "export", "message"}`.
    #[wasm_bindgen(js_name = mapFile)]
    pub fn map_file(&self) -> Result<Option<Vec<u8>>, JsValue> {
        let FinishedRun { job, result, choices } = self.run()?;
        let map = job.map_file(result, choices);
        let map = map.filter(|map| job.taken(map).has_map_file());
        map.map(|map| output_file::file(job.taken(&map), OutputKind::Map.file_name())).transpose()
    }

    /// The source in the look that the map carries, by the meshes' files of the run and what comes with them, or with a checkerboard.
    ///
    /// # Errors
    /// `{"code": "export", "message"}`.
    pub fn glb(
        &self,
        source: &[u8],
        target: &[u8],
        source_companion: Option<Vec<u8>>,
        target_companion: Option<Vec<u8>>,
    ) -> Result<Vec<u8>, JsValue> {
        let FinishedRun { job, result, choices } = self.run()?;
        let look = job.look(look_files([source, target], [&source_companion, &target_companion]));
        job.glb(result, choices, &look).map_err(|e| failure("export", e))
    }

    /// The vertex images.
    ///
    /// # Errors
    /// `{"code": "export", "message"}`.
    pub fn csv(&self) -> Result<Vec<u8>, JsValue> {
        let FinishedRun { job, result, .. } = self.run()?;
        Ok(job.vertex_images(result))
    }

    /// The base domain.
    ///
    /// # Errors
    /// `{"code": "export", "message"}`.
    #[wasm_bindgen(js_name = baseObj)]
    pub fn base_obj(&self) -> Result<Vec<u8>, JsValue> {
        let FinishedRun { job, result, .. } = self.run()?;
        Ok(job.base_domain(result))
    }
}
