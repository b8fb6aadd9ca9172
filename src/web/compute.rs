//! The pipeline in the worker.

use super::failure;
use super::files::checked;
use crate::export;
use crate::io::landmark_file;
use crate::landmarks::{PlacedLandmarks, place};
use crate::monitor::{Cancelled, Monitor, Stage, Step};
use crate::pipeline::{
    Base, ClassChoice, Cones, GroundTruth, MapInput, MapResult, Method, OwnConeOptions, PipelineError,
    PipelineOptions, findings, run,
};
use glam::{DVec2, DVec3};
use serde::Deserialize;
use std::collections::BTreeMap;
use wasm_bindgen::prelude::*;

/// Options as the page sends them.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Options {
    #[serde(default)]
    method: String,
    #[serde(default)]
    base: String,
    #[serde(default)]
    cones: String,
    #[serde(default)]
    map_class: String,
    /// Points of the program's own; none for as many as usual.
    #[serde(default)]
    own_cones: Option<usize>,
}

impl From<Options> for PipelineOptions {
    fn from(options: Options) -> Self {
        Self {
            method: if options.method == "thesis" { Method::Thesis } else { Method::Relaxed },
            base: if options.base == "qem" { Base::Qem } else { Base::Joint },
            cones: if options.cones == "uniform" { Cones::Uniform } else { Cones::BaseDomain },
            class: if options.map_class == "runner-up" { ClassChoice::RunnerUp } else { ClassChoice::Best },
            own_cones: match options.own_cones {
                Some(count) => OwnConeOptions { count, ..OwnConeOptions::default() },
                None => OwnConeOptions::default(),
            },
            ..Self::default()
        }
    }
}

#[wasm_bindgen(typescript_custom_section)]
const LISTENER: &str = r"
/** What a run tells and asks while it goes. Numbers that a step does not have are NaN. */
export interface RunListener {
  /** In the stage `relaxation`: a map is relaxed, or is on a finer level; energies do not compare with those before. */
  relaxes(): void;
  /** A stage begins or goes on, at most 30 times a second; `energy` is that of the map being relaxed, 4 for an isometry. */
  progress(stage: string, fraction: number, residual: number, energy: number): void;
  /** Landmark pairs that do not fit, before the map is made. */
  found(json: string): void;
  /** Whether to finish now with a whole map, only less relaxed; asked at most ten times a second. */
  wantsResult(): boolean;
}
";

#[wasm_bindgen]
extern "C" {
    /// What a run tells and asks while it goes.
    #[wasm_bindgen(typescript_type = "RunListener")]
    pub type RunListener;
    #[wasm_bindgen(method, catch)]
    fn progress(
        this: &RunListener,
        stage: &str,
        fraction: f64,
        residual: f64,
        energy: f64,
    ) -> Result<(), JsValue>;
    #[wasm_bindgen(method, catch)]
    fn relaxes(this: &RunListener) -> Result<(), JsValue>;
    #[wasm_bindgen(method, catch)]
    fn found(this: &RunListener, json: &str) -> Result<(), JsValue>;
    #[wasm_bindgen(method, catch, js_name = wantsResult)]
    fn wants_result(this: &RunListener) -> Result<bool, JsValue>;
}

/// The least time between two messages of one stage, in milliseconds: more often nobody can see.
const MESSAGE_INTERVAL: f64 = 33.0;

/// The least time between two questions, in milliseconds.
const QUESTION_INTERVAL: f64 = 100.0;

/// Tells the page how the run goes on and takes the time of each stage.
struct Messenger<'a> {
    listener: &'a RunListener,
    /// Of the map that is being relaxed.
    energy: f64,
    /// When the page was last asked, and whether it wants a result.
    asked: f64,
    wants_result: bool,
    stage: Option<(Stage, f64)>,
    /// When the page was last told.
    told: f64,
    seconds: BTreeMap<String, f64>,
}

impl Messenger<'_> {
    fn leave(&mut self) {
        if let Some((stage, begun)) = self.stage.take() {
            *self.seconds.entry(stage.to_string()).or_default() += (js_sys::Date::now() - begun) / 1000.0;
        }
    }

    fn tell(&mut self, stage: Stage, step: Step) {
        self.told = js_sys::Date::now();
        let residual = step.residual.unwrap_or(f64::NAN);
        // A page that does not listen is not a reason to stop.
        let _ = self.listener.progress(&stage.to_string(), step.fraction, residual, self.energy);
    }
}

impl Monitor for Messenger<'_> {
    fn enter(&mut self, stage: Stage) {
        self.leave();
        self.stage = Some((stage, js_sys::Date::now()));
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

    fn wants_result(&self) -> bool {
        self.wants_result
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        if !self.wants_result && js_sys::Date::now() - self.asked >= QUESTION_INTERVAL {
            self.wants_result = self.listener.wants_result().unwrap_or(false);
            self.asked = js_sys::Date::now();
        }
        if let Some((stage, _)) = self.stage
            && js_sys::Date::now() - self.told >= MESSAGE_INTERVAL
        {
            self.tell(stage, step);
        }
        Ok(())
    }
}

/// A finished map.
#[wasm_bindgen]
pub struct MapOutput {
    result: MapResult,
    csv: Vec<u8>,
}

/// Runs the pipeline; the listener hears how it goes on and may ask for the result.
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
) -> Result<MapOutput, JsValue> {
    let mut messenger = Messenger {
        listener,
        energy: f64::NAN,
        asked: 0.0,
        wants_result: false,
        stage: None,
        told: 0.0,
        seconds: BTreeMap::new(),
    };
    let begun = js_sys::Date::now();
    messenger.enter(Stage::Landmarks);
    let options: Options = serde_json::from_str(options).map_err(|e| failure("options", e))?;
    let (source, target) = (checked(source)?, checked(target)?);
    let file = landmark_file::read(landmarks.as_bytes()).map_err(|e| failure("landmarks", e))?;
    let numbers = [source.file_from_vertex(), target.file_from_vertex()];
    let same = source.mesh.triangles() == target.mesh.triangles() && file.ground_truth.is_some();
    let ground_truth = if same { GroundTruth::SameConnectivity } else { GroundTruth::Unknown };
    let placed = place([&source, &target], &file.pairs).map_err(|e| failure("landmarks", e))?;
    let PlacedLandmarks { source: inserted, target: on_target, landmarks } = &placed;
    let input = MapInput { source: &inserted.mesh, target: &on_target.mesh, landmarks, ground_truth };
    let number = |side: usize, v: usize| numbers[side].get(v).copied().unwrap_or(v);
    let doubts: Vec<_> = findings(input, &file.labels.unwrap_or_default(), &mut messenger)
        .map_err(|e| failure(PipelineError::from(e).code(), e))?
        .into_iter()
        .map(|finding| finding.renumbered(number))
        .collect();
    let json = serde_json::to_string(&doubts).unwrap_or_default();
    // A page that does not listen is not a reason to stop.
    let _ = listener.found(&json);
    let mut result = run(input, &options.into(), &mut messenger).map_err(|e| failure(e.code(), e))?;
    messenger.leave();
    let mut seconds = messenger.seconds;
    seconds.insert("total".into(), (js_sys::Date::now() - begun) / 1000.0);
    result.report.set_seconds(seconds);
    result.report.findings = doubts;
    let as_given = |p| target.with_file_corners(on_target.on_original(p));
    let on_source_file = |p| source.with_file_corners(inserted.on_original(p));
    result.report.distortion.replace_worst([&on_source_file, &as_given]);
    let images = source.by_file_vertex(&result.target_from_source.raw);
    let images: Vec<_> = images.into_iter().map(|image| image.flatten().map(as_given)).collect();
    Ok(MapOutput { csv: export::csv::vertex_images(&images), result })
}

fn flat3(points: &[DVec3]) -> Vec<f32> {
    points.iter().flat_map(|p| p.as_vec3().to_array()).collect()
}

#[wasm_bindgen]
impl MapOutput {
    /// Positions of the common subdivision on the source (0) or the target (1), three numbers a point.
    pub fn positions(&self, side: usize) -> Vec<f32> {
        let common = &self.result.common;
        flat3(if side == 0 { &common.source_positions } else { &common.target_positions })
    }

    /// Unit normals on the source (0) or the target (1).
    pub fn normals(&self, side: usize) -> Vec<f32> {
        let common = &self.result.common;
        flat3(if side == 0 { &common.source_normals } else { &common.target_normals })
    }

    /// Texture coordinates, two numbers a point.
    pub fn uvs(&self) -> Vec<f32> {
        self.result.common.uvs.iter().flat_map(|uv: &DVec2| [uv.x as f32, uv.y as f32]).collect()
    }

    /// Distortion around each point, 1 for none; empty for the thesis' method.
    pub fn distortion(&self) -> Vec<f32> {
        self.result.common_vertex_distortion().iter().map(|&d| d as f32).collect()
    }

    /// Triangles of the common subdivision.
    pub fn triangles(&self) -> Vec<u32> {
        self.result.common.triangles.iter().flatten().copied().collect()
    }

    /// Points of all patch lines on one side.
    #[wasm_bindgen(js_name = linePoints)]
    pub fn line_points(&self, side: usize) -> Vec<f32> {
        self.result.patch_lines[side.min(1)].iter().flat_map(|line| flat3(line)).collect()
    }

    /// Where each patch line starts among the points, and one past the end.
    #[wasm_bindgen(js_name = lineStarts)]
    pub fn line_starts(&self, side: usize) -> Vec<u32> {
        let mut starts = vec![0];
        let mut end = 0;
        for line in &self.result.patch_lines[side.min(1)] {
            end += line.len() as u32;
            starts.push(end);
        }
        starts
    }

    /// Curvature of each landmark's cone, in radians.
    pub fn cones(&self) -> Vec<f64> {
        self.result.cone_curvatures.clone()
    }

    /// The report as JSON.
    pub fn report(&self) -> String {
        serde_json::to_string_pretty(&self.result.report).unwrap_or_default()
    }

    /// The source with the target's texture.
    ///
    /// # Errors
    /// `{"code": "export", "message"}`.
    pub fn glb(&self) -> Result<Vec<u8>, JsValue> {
        export::glb::textured_source(&self.result.common, &self.result.common_vertex_distortion())
            .map_err(|e| failure("export", e))
    }

    /// The vertex images.
    pub fn csv(&self) -> Vec<u8> {
        self.csv.clone()
    }

    /// The base domain.
    #[wasm_bindgen(js_name = baseObj)]
    pub fn base_obj(&self) -> Vec<u8> {
        export::obj::mesh(&self.result.base.mesh)
    }
}
