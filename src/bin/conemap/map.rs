//! `conemap map`.

use crate::arguments::{BaseArgument, ClassArgument, ConesArgument, MapArguments, MethodArgument};
use crate::clock::Clock;
use crate::input::{self, Failure};
use crate::{interrupt, outputs};
use conemap::landmarks::{PlacedLandmarks, place};
use conemap::mesh::SurfacePoint;
use conemap::mesh::check::CheckedMesh;
use conemap::mesh::mirror::mirrored;
use conemap::monitor::{Monitor, Stage};
use conemap::pipeline::{
    Base, ClassChoice, Cones, FindingReport, GroundTruth, MapInput, MapResult, Method, OwnConeOptions,
    PipelineOptions, RepairKind, findings, run as run_pipeline,
};

/// Maps, writes what was asked for, and tells the certificate; an error where there is no certified map.
pub fn run(arguments: &MapArguments) -> Result<(), Failure> {
    let mut clock = Clock::start();
    clock.enter(Stage::Landmarks);
    let source = input::mesh(&arguments.source)?;
    let mut target = input::mesh(&arguments.target)?;
    let mut file = input::landmarks(&arguments.landmarks)?;
    if arguments.mirror_target {
        target.mesh = mirrored(&target.mesh)?;
        file.pairs.iter_mut().for_each(|[_, point]| *point = point.mirrored());
    }
    let placed = place([&source, &target], &file.pairs)
        .map_err(|e| format!("{}: {e}", arguments.landmarks.display()))?;
    let ground_truth = match file.ground_truth {
        Some(_) if same_connectivity(&source, &target) => GroundTruth::SameConnectivity,
        _ => GroundTruth::Unknown,
    };
    let checked = [&source, &target];
    let numbers = checked.map(CheckedMesh::file_from_vertex);
    let PlacedLandmarks { source, target, landmarks } = &placed;
    let map_input = MapInput { source: &source.mesh, target: &target.mesh, landmarks, ground_truth };
    let number = |side: usize, v: usize| numbers[side].get(v).copied().unwrap_or(v);
    let found: Vec<_> = findings(map_input, &file.labels.unwrap_or_default(), &mut clock)?
        .into_iter()
        .map(|finding| finding.renumbered(number))
        .collect();
    clock.clear();
    found.iter().for_each(tell_finding);
    // The thesis' method has nothing to shorten.
    if matches!(arguments.method, MethodArgument::Relaxed) {
        clock.ask_for_result(arguments.time_limit, interrupt::listen());
    }
    let mut result = run_pipeline(map_input, &options(arguments), &mut clock)?;
    result.report.set_seconds(clock.stop());
    result.report.findings = found;
    tell(&result);
    let inputs = outputs::Inputs { insertions: [source, target], checked, arguments };
    let in_files: [&dyn Fn(SurfacePoint) -> SurfacePoint; 2] =
        [&|p| inputs.on_source_file(p), &|p| inputs.on_target_file(p)];
    result.report.distortion.replace_worst(in_files);
    if let Some(folder) = &arguments.out {
        outputs::write(folder, &result, &inputs)?;
    }
    if let Some(path) = &arguments.report {
        input::write(path, &serde_json::to_vec_pretty(&result.report)?)?;
    }
    Ok(())
}

fn same_connectivity(source: &CheckedMesh, target: &CheckedMesh) -> bool {
    source.mesh.triangles() == target.mesh.triangles()
}

fn options(arguments: &MapArguments) -> PipelineOptions {
    PipelineOptions {
        method: match arguments.method {
            MethodArgument::Relaxed => Method::Relaxed,
            MethodArgument::Thesis => Method::Thesis,
        },
        base: match arguments.base {
            BaseArgument::Joint => Base::Joint,
            BaseArgument::Qem => Base::Qem,
        },
        cones: match arguments.cones {
            ConesArgument::BaseDomain => Cones::BaseDomain,
            ConesArgument::Uniform => Cones::Uniform,
        },
        class: match arguments.class {
            ClassArgument::Best => ClassChoice::Best,
            ClassArgument::RunnerUp => ClassChoice::RunnerUp,
        },
        own_cones: OwnConeOptions {
            count: arguments.own_cones.unwrap_or(OwnConeOptions::default().count),
            ..OwnConeOptions::default()
        },
        ..PipelineOptions::default()
    }
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
    let d = &report.distortion;
    eprintln!("energy {:.3} (4 is an isometry), mean distortion {:.3} (1 is an isometry)", d.energy, d.mean);
    report.warnings.iter().for_each(|w| eprintln!("warning: {w}"));
}
