//! Runs a whole job, from files to files, and asks `conemap_verify` for its verdict on the map.
#![allow(dead_code, reason = "every test binary uses another part")]

use crate::hostile_geometry::HostileCase;
use conemap::export::off;
use conemap::io::landmark_file::LandmarkFile;
use conemap::job::{
    Job, JobError, JobFiles, MapFiles, MapLook, OpenMap, OutputFile, OutputKind, ReadOptions, prove,
};
use conemap::landmark_exchange::GivenFile;
use conemap::monitor::Monitor;
use conemap::pipeline::{Choices, MapResult, PipelineOptions, Report};
use std::ops::ControlFlow;

/// The files of a job: both meshes as OFF, the landmarks as JSON.
pub struct Files {
    pub source: Vec<u8>,
    pub target: Vec<u8>,
    pub landmarks: Vec<u8>,
}

impl From<HostileCase> for Files {
    fn from(case: HostileCase) -> Self {
        let [source, target] = case.meshes.each_ref().map(off::mesh);
        let file = LandmarkFile { pairs: case.pairs, ..LandmarkFile::default() };
        Self { source, target, landmarks: serde_json::to_vec(&file).expect("landmarks have JSON") }
    }
}

/// The outcome of a job.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// A certified map that `conemap_verify` proves.
    Proved,
    /// A certified map that `conemap_verify` proves except for this number of triangles, which have no area within rounding.
    ProvedWithinRounding { triangles: usize },
    /// A certified map of meshes that were repaired, or without an overlay: it has no map file to be proved.
    Certified { without_file: &'static str },
    /// An error, by the names of its nested variants and its sentence.
    Refused { name: String, sentence: String },
    /// The job was stopped by its monitor.
    Stopped,
    /// A fault of the program, in a sentence.
    Wrong(String),
}

/// A job with its map.
pub struct Mapped {
    job: Job,
    result: MapResult,
    look: MapLook,
}

/// Reads the files, looks for findings and makes the map.
///
/// # Errors
/// The outcome where there is no map.
pub fn mapped(files: &Files, monitor: &mut dyn Monitor) -> Result<Mapped, Outcome> {
    let landmarks = [GivenFile { name: "landmarks.json", bytes: &files.landmarks }];
    let job = JobFiles { source: &files.source, target: &files.target, landmarks: &landmarks };
    let job = Job::read(job, ReadOptions::default(), monitor).map_err(|error| Outcome::of_job(&error))?;
    job.findings(monitor).map_err(|_| Outcome::Stopped)?;
    let result = job.run(&PipelineOptions::default(), monitor);
    let result = result.map_err(|error| Outcome::of_job(&JobError::Pipeline(error)))?;
    Ok(Mapped { job, result, look: MapLook::default() })
}

impl Mapped {
    /// Writes all files of the map, and has `conemap_verify` prove it.
    pub fn judged(&self, files: &Files) -> Outcome {
        let Self { job, result, look } = self;
        if !result.report.certificate.as_ref().is_some_and(|certificate| certificate.bijective) {
            return Outcome::Wrong("a map without its certificate".into());
        }
        let failed = job.outputs(result, &Choices::default(), look).find_map(Result::err);
        if let Some(error) = failed {
            return Outcome::refused(&error);
        }
        let Some(map) = job.map_file(result, &Choices::default()) else {
            return Outcome::Certified { without_file: "no overlay" };
        };
        if !job.has_map_file() {
            return Outcome::Certified { without_file: "repaired" };
        }
        let map = match job.taken(&map).output(OutputKind::Map) {
            Ok(map) => map,
            Err(error) => return Outcome::Wrong(format!("the map file: {error}")),
        };
        let files = MapFiles { map: &map, source: &files.source, target: &files.target };
        if let Err(error) = OpenMap::read(files) {
            return Outcome::Wrong(format!("its map file is not opened: {error}"));
        }
        match prove(files, &mut |_| ControlFlow::Continue(())) {
            Ok(proof) if proof.is_exact() => Outcome::Proved,
            Ok(proof) => Outcome::ProvedWithinRounding { triangles: proof.doubtful.triangles },
            Err(error) => Outcome::Wrong(format!("conemap_verify rejects it: {error}")),
        }
    }

    /// All files of the map, one after another.
    pub fn outputs(&self) -> impl Iterator<Item = OutputFile> {
        let files = self.job.outputs(&self.result, &Choices::default(), &self.look);
        files.map(|file| file.expect("the map has files"))
    }

    /// The report of the map.
    pub fn report(&self) -> &Report {
        &self.result.report
    }
}

impl Outcome {
    fn of_job(error: &JobError) -> Self {
        if error.code() == "cancelled" { Self::Stopped } else { Self::refused(error) }
    }

    fn refused<E: std::error::Error>(error: &E) -> Self {
        Self::Refused { name: variants(&format!("{error:?}")), sentence: error.to_string() }
    }
}

/// The names of nested variants in the text that `Debug` prints: "Layout NoMap" for "Layout(NoMap { layouts: 3 })".
fn variants(debug: &str) -> String {
    let mut names = Vec::new();
    let mut rest = debug;
    loop {
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        if !rest.starts_with(|c: char| c.is_ascii_uppercase()) {
            break;
        }
        names.push(&rest[..end]);
        let Some(inner) = rest[end..].strip_prefix('(') else { break };
        rest = inner;
    }
    names.join(" ")
}
