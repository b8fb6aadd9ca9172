//! `conemap map`.

use crate::arguments::MapArguments;
use crate::clock::Clock;
use crate::input::{self, Failure};
use crate::interrupt;
use conemap::job::{Job, JobError, JobFile, JobFiles, OutputKind, ReadOptions, TargetImage};
use conemap::pipeline::{Choices, FindingReport, MapResult, Method, PipelineOptions, RepairKind};
use std::path::PathBuf;
use std::time::Duration;

/// Maps, writes what was asked for, and tells the certificate; an error where there is no certified map.
pub fn run(arguments: &MapArguments) -> Result<(), Failure> {
    let mut clock = Clock::start();
    let target_image = if arguments.mirror_target { TargetImage::Mirrored } else { TargetImage::AsGiven };
    let asked = Asked {
        meshes: [&arguments.source, &arguments.target],
        landmarks: std::iter::once(&arguments.landmarks).chain(&arguments.target_landmarks).collect(),
        options: ReadOptions { target_image, mesh_faults: arguments.faults.into() },
        choices: arguments.choices,
        time_limit: arguments.time_limit,
    };
    let job = asked.read(&mut clock)?;
    let mut result = asked.map(&job, &mut clock)?;
    result.report.set_seconds(clock.stop());
    tell(&result);
    if let Some(path) = &arguments.map {
        let map = job.map_file(&result, &arguments.choices);
        let map =
            map.ok_or("--map: this map has no pieces (the method `thesis`, or a map without an overlay)")?;
        let taken = job.taken(&map);
        if !taken.has_map_file() {
            return Err(
                "--map: a mesh was repaired, and a map file tells of meshes as their files have them: save the repaired mesh by \
                 `conemap check MESH --repair --out FILE`, and map that one"
                    .into(),
            );
        }
        input::write(path, &taken.output(OutputKind::Map)?)?;
    }
    if let Some(folder) = &arguments.out {
        for file in job.outputs(&result, &arguments.choices)? {
            input::write(&folder.join(file.name), &file.bytes)?;
        }
    }
    if let Some(path) = &arguments.report {
        input::write(path, &serde_json::to_vec_pretty(&result.report)?)?;
    }
    Ok(())
}

/// A map that is asked for.
pub struct Asked<'a> {
    /// Source and target.
    pub meshes: [&'a PathBuf; 2],
    /// One landmark file of both, or one of each.
    pub landmarks: Vec<&'a PathBuf>,
    /// How the files are read.
    pub options: ReadOptions,
    /// What is chosen of the run.
    pub choices: Choices,
    /// Time from the start after which the run is to finish.
    pub time_limit: Option<Duration>,
}

impl Asked<'_> {
    /// Reads the files; a fault is told with the file's name.
    pub fn read(&self, clock: &mut Clock) -> Result<Job, Failure> {
        let [source, target] = self.meshes;
        let bytes = [input::mesh_bytes(source)?, input::mesh_bytes(target)?];
        let landmark_files = input::NamedFiles::read(&self.landmarks)?;
        let files = JobFiles { source: &bytes[0], target: &bytes[1], landmarks: &landmark_files.given() };
        Job::read(files, self.options, clock).map_err(|error: JobError| {
            let file = match error.file() {
                Some(JobFile::Source) => Some(source),
                Some(JobFile::Target) => Some(target),
                Some(JobFile::Landmarks(number)) => self.landmarks.get(number).copied(),
                None => None,
            };
            file.map_or_else(|| error.to_string(), |path| format!("{}: {error}", path.display())).into()
        })
    }

    /// Makes the map; what there is to know about the landmarks is told, and is in the report.
    pub fn map(&self, job: &Job, clock: &mut Clock) -> Result<MapResult, Failure> {
        let options = PipelineOptions::from(self.choices);
        clock.suspend(|| job.landmark_remarks().iter().for_each(|remark| eprintln!("landmarks: {remark}")));
        clock.plan(options.stages(job.landmark_count()));
        let findings = job.findings(clock)?;
        clock.suspend(|| findings.iter().for_each(tell_finding));
        // The thesis' method has nothing to shorten.
        if options.method == Method::Relaxed {
            clock.ask_for_result(self.time_limit, interrupt::listen());
        }
        let mut result = job.run(&options, clock)?;
        result.report.findings = findings;
        Ok(result)
    }
}

fn tell_finding(finding: &FindingReport) {
    let repair = match finding.repair {
        RepairKind::MirrorTarget => " (--mirror-target)",
        RepairKind::Swap | RepairKind::Check | RepairKind::Mark => "",
    };
    eprintln!("landmarks: {}{repair}", finding.sentence);
}

/// Tells the certificate and the measures.
pub fn tell(result: &MapResult) {
    let report = &result.report;
    match &report.certificate {
        Some(c) => {
            eprintln!("certified bijective: {} of {} triangles flipped", c.flipped_triangles, c.triangles)
        }
        None => eprintln!(
            "not bijective by construction: {:.1} % of the vertices are unmapped",
            100.0 * report.unmapped_share
        ),
    }
    if let Some(coverage) = &report.coverage {
        eprintln!("coverage: {}", coverage.sentence());
    }
    let d = &report.distortion;
    eprintln!("energy {:.3} (4 is an isometry), mean distortion {:.3} (1 is an isometry)", d.energy, d.mean);
    report.warnings.iter().for_each(|w| eprintln!("warning: {w}"));
}
