//! `conemap map`.

use crate::arguments::MapArguments;
use crate::clock::Clock;
use crate::input::{self, Failure, MeshSets};
use crate::told::say;
use crate::{interrupt, matching, outputs};
use conemap::job::{
    FewLandmarks, Job, JobError, JobFile, JobFiles, OutputKind, ReadOptions, SettledLandmark, TargetImage,
    TruthError,
};
use conemap::monitor::{PlannedStage, Stage};
use conemap::pipeline::{Choices, FindingReport, MapResult, Method, PipelineOptions, RepairKind};
use std::path::PathBuf;
use std::time::Duration;

/// Maps, writes what was asked for, and tells the certificate; an error where there is no certified map.
pub fn run(arguments: &MapArguments) -> Result<(), Failure> {
    let options = PipelineOptions::from(arguments.choices);
    check_outputs(arguments, options.method)?;
    let asked = Asked::from(arguments);
    let mut clock = asked.clock();
    let made = made(arguments, &asked, &mut clock);
    let (job, mut result) = made.map_err(|error| clock.missed_deadline().map_or(error, Failure::from))?;
    result.report.set_seconds(clock.stop());
    tell(&result);
    // All are tried, so that one that fails costs only itself.
    let written = [
        write_map(arguments, &job, &result),
        write_folder(arguments, &job, &result),
        arguments
            .report
            .as_ref()
            .map_or(Ok(()), |path| outputs::write(path, &serde_json::to_vec_pretty(&job.report(&result))?)),
    ];
    written.into_iter().collect()
}

/// Finds before the run what cannot be written after it.
fn check_outputs(arguments: &MapArguments, method: Method) -> Result<(), Failure> {
    let MapArguments { source, target, target_landmarks, landmarks, truth, map, out, report, .. } = arguments;
    if map.is_some() && method != Method::Relaxed {
        return Err("--map: a map of the method `thesis` or `tutte` has no pieces, and so no map file".into());
    }
    let files = out.iter().flat_map(|folder| outputs::of_folder(folder));
    outputs::check(
        [source, target].into_iter().chain(landmarks).chain(target_landmarks).chain(truth),
        map.iter().chain(report).cloned().chain(files),
    )
}

/// Why there is no map file, and what to do.
const NO_MAP_FILE: &str = "a mesh was repaired, and a map file tells of meshes as their files have them: save the repaired mesh by \
                           `conemap check MESH --repair --out FILE`, and map that one";

fn write_map(arguments: &MapArguments, job: &Job, result: &MapResult) -> Result<(), Failure> {
    let Some(path) = &arguments.map else { return Ok(()) };
    let map = job.map_file(result, &arguments.choices);
    let map = map.ok_or(
        "--map: this map has no overlay, and so no pieces for a map file; the warnings in the report say why",
    )?;
    outputs::write(path, &job.taken(&map).output(OutputKind::Map)?)
}

fn write_folder(arguments: &MapArguments, job: &Job, result: &MapResult) -> Result<(), Failure> {
    let Some(folder) = &arguments.out else { return Ok(()) };
    let paths = [&arguments.source, &arguments.target];
    let meshes = [input::mesh_bytes(paths[0])?, input::mesh_bytes(paths[1])?];
    let sets = MeshSets::of(paths.map(PathBuf::as_path), meshes.each_ref().map(Vec::as_slice));
    let look = sets.look(|files| job.look(files));
    let files = job.outputs(result, &arguments.choices, &look);
    if !job.has_map_file() {
        say(format_args!(
            "warning: {}: without {}: {NO_MAP_FILE}",
            folder.display(),
            OutputKind::Map.file_name()
        ));
    }
    outputs::write_all(
        folder,
        files.map(|file| file.map(|file| (file.name, file.bytes)).map_err(Failure::from)),
    )
}

/// Reads the files and makes the map.
fn made(arguments: &MapArguments, asked: &Asked<'_>, clock: &mut Clock) -> Result<(Job, MapResult), Failure> {
    let mut job = asked.read(clock)?;
    if let Some(path) = &arguments.truth {
        let told = |error: TruthError| format!("{}: {error}", path.display());
        job.know_truth(&input::bytes(path)?).map_err(told)?;
    }
    if arguments.map.is_some() && !job.has_map_file() {
        return Err(format!("--map: {NO_MAP_FILE}").into());
    }
    let result = asked.map(&job, clock)?;
    Ok((job, result))
}

/// A map that is asked for.
pub struct Asked<'a> {
    /// Source and target.
    pub meshes: [&'a PathBuf; 2],
    /// One landmark file of both, or one of each; none where the program is to find the landmarks.
    pub landmarks: Vec<&'a PathBuf>,
    /// How the files are read.
    pub options: ReadOptions,
    /// The choices of the run.
    pub choices: Choices,
    /// Time from the start after which the run is to finish.
    pub time_limit: Option<Duration>,
    /// Time from the start after which the program is to have ended.
    pub deadline: Option<Duration>,
}

impl<'a> From<&'a MapArguments> for Asked<'a> {
    fn from(arguments: &'a MapArguments) -> Self {
        let target_image = if arguments.mirror_target { TargetImage::Mirrored } else { TargetImage::AsGiven };
        Self {
            meshes: [&arguments.source, &arguments.target],
            landmarks: arguments.landmarks.iter().chain(&arguments.target_landmarks).collect(),
            options: ReadOptions {
                target_image,
                mesh_faults: arguments.faults.into(),
                few_landmarks: FewLandmarks::Matched,
                most_memory: arguments.memory_limit.map(|mib| u64::from(mib) << 20),
            },
            choices: arguments.choices,
            time_limit: arguments.time_limit,
            deadline: arguments.deadline,
        }
    }
}

impl Asked<'_> {
    /// A clock that holds what was asked of the time, from the first byte on.
    pub fn clock(&self) -> Clock {
        let mut clock = Clock::start();
        // The other methods have nothing to shorten.
        if self.choices.method == Method::Relaxed {
            clock.ask_for_result(self.time_limit, interrupt::listen());
        }
        if let Some(time) = self.deadline {
            clock.end_within(time);
        }
        let planned = |stage| PlannedStage { stage, time: 1.0 };
        clock.plan(vec![planned(Stage::Matching), planned(Stage::Settling)]);
        clock
    }

    /// Reads the files; an error names the file. Prints landmarks that the program found.
    pub fn read(&self, clock: &mut Clock) -> Result<Job, Failure> {
        let [source, target] = self.meshes;
        let bytes = [input::mesh_bytes(source)?, input::mesh_bytes(target)?];
        let landmark_files = input::NamedFiles::read(&self.landmarks)?;
        let files = JobFiles { source: &bytes[0], target: &bytes[1], landmarks: &landmark_files.given() };
        let job = Job::read(files, self.options, clock).map_err(|error: JobError| {
            let file = match error.file() {
                Some(JobFile::Source) => Some(source),
                Some(JobFile::Target) => Some(target),
                Some(JobFile::Landmarks(number)) => self.landmarks.get(number).copied(),
                None => None,
            };
            file.map_or_else(|| error.to_string(), |path| format!("{}: {error}", path.display()))
        });
        let mut job = job?;
        clock.suspend(|| job.matching().into_iter().for_each(matching::tell));
        clock.suspend(|| job.settled().iter().for_each(tell_settled));
        let names = [source, target].map(|path| path.to_string_lossy());
        job.compare_names(names.each_ref().map(|name| &**name));
        Ok(job)
    }

    /// Makes the map; prints remarks on the landmarks, which are in the report as well.
    pub fn map(&self, job: &Job, clock: &mut Clock) -> Result<MapResult, Failure> {
        let options = PipelineOptions::from(self.choices);
        clock.suspend(|| {
            job.landmark_remarks().iter().for_each(|remark| say(format_args!("landmarks: {remark}")))
        });
        clock.plan(options.stages(job.landmark_count()));
        let findings = job.findings(clock)?;
        clock.suspend(|| findings.iter().for_each(tell_finding));
        let mut result = job.run(&options, clock)?;
        result.report.findings = findings;
        Ok(result)
    }
}

fn tell_settled(landmark: &SettledLandmark) {
    let (pair, moved) = (landmark.pair + 1, 100.0 * landmark.moved);
    say(format_args!(
        "landmarks: the soft pair {pair} settled {moved:.2} % of the target's size away from its point"
    ));
}

fn tell_finding(finding: &FindingReport) {
    let repair = match finding.repair {
        RepairKind::MirrorTarget => " (--mirror-target)",
        RepairKind::Swap | RepairKind::Check | RepairKind::Mark => "",
    };
    say(format_args!("landmarks: {}{repair}", finding.sentence));
}

/// Tells the certificate and the measures.
pub fn tell(result: &MapResult) {
    let report = &result.report;
    match &report.certificate {
        Some(c) => {
            let (flipped, all) = (c.flipped_triangles, c.triangles);
            say(format_args!("certified bijective: {flipped} of {all} triangles flipped"));
        }
        None => say(format_args!(
            "not certified: {:.1} % of the vertices are unmapped",
            100.0 * report.unmapped_share
        )),
    }
    if let Some(coverage) = &report.coverage {
        say(format_args!("coverage: {}", coverage.sentence()));
    }
    let d = &report.distortion;
    let (energy, mean) = (d.energy, d.mean);
    say(format_args!("energy {energy:.3} (4 is the least), mean distortion {mean:.3} (1 is an isometry)"));
    if let Some(truth) = &report.ground_truth {
        let [mean, most] = [truth.mean, truth.p95].map(|distance| 100.0 * distance);
        say(format_args!(
            "true images: mean {mean:.2} % of the root of the area away, 95 % within {most:.2} %"
        ));
    }
    report.warnings.iter().for_each(|w| say(format_args!("warning: {w}")));
}
