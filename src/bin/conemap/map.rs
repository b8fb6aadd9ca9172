//! `conemap map`.

use crate::arguments::MapArguments;
use crate::clock::Clock;
use crate::input::{self, Failure};
use crate::interrupt;
use crate::matching;
use conemap::job::{FewLandmarks, Job, JobError, JobFile, JobFiles, OutputKind, ReadOptions, TargetImage};
use conemap::monitor::{PlannedStage, Stage};
use conemap::pipeline::{FindingReport, MapResult, Method, PipelineOptions, RepairKind};
use std::path::PathBuf;

/// Maps, writes what was asked for, and tells the certificate; an error where there is no certified map.
pub fn run(arguments: &MapArguments) -> Result<(), Failure> {
    let mut clock = Clock::start();
    clock.plan(vec![PlannedStage { stage: Stage::Matching, time: 1.0 }]);
    let job = read(arguments, &mut clock)?;
    clock.suspend(|| job.matching().into_iter().for_each(matching::tell));
    let options = PipelineOptions::from(arguments.choices);
    clock.suspend(|| job.landmark_remarks().iter().for_each(|remark| eprintln!("landmarks: {remark}")));
    clock.plan(options.stages(job.landmark_count()));
    let findings = job.findings(&mut clock)?;
    clock.suspend(|| findings.iter().for_each(tell_finding));
    // The thesis' method has nothing to shorten.
    if options.method == Method::Relaxed {
        clock.ask_for_result(arguments.time_limit, interrupt::listen());
    }
    let mut result = job.run(&options, &mut clock)?;
    result.report.set_seconds(clock.stop());
    result.report.findings = findings;
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
        input::write(path, &serde_json::to_vec_pretty(&job.report(&result))?)?;
    }
    Ok(())
}

/// Reads the files; a fault is told with the file's name.
fn read(arguments: &MapArguments, clock: &mut Clock) -> Result<Job, Failure> {
    let [source, target] = [&arguments.source, &arguments.target];
    let landmarks: Vec<&PathBuf> = arguments.landmarks.iter().chain(&arguments.target_landmarks).collect();
    let bytes = [input::mesh_bytes(source)?, input::mesh_bytes(target)?];
    let landmark_files = input::NamedFiles::read(&landmarks)?;
    let files = JobFiles { source: &bytes[0], target: &bytes[1], landmarks: &landmark_files.given() };
    let target_image = if arguments.mirror_target { TargetImage::Mirrored } else { TargetImage::AsGiven };
    let options = ReadOptions {
        target_image,
        mesh_faults: arguments.faults.into(),
        few_landmarks: FewLandmarks::Matched,
    };
    Job::read(files, options, clock).map_err(|error: JobError| {
        let file = match error.file() {
            Some(JobFile::Source) => Some(source),
            Some(JobFile::Target) => Some(target),
            Some(JobFile::Landmarks(number)) => landmarks.get(number).copied(),
            None => None,
        };
        file.map_or_else(|| error.to_string(), |path| format!("{}: {error}", path.display())).into()
    })
}

fn tell_finding(finding: &FindingReport) {
    let repair = match finding.repair {
        RepairKind::MirrorTarget => " (--mirror-target)",
        RepairKind::Swap | RepairKind::Check | RepairKind::Mark => "",
    };
    eprintln!("landmarks: {}{repair}", finding.sentence);
}

fn tell(result: &MapResult) {
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
