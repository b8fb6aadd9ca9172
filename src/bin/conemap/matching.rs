//! `conemap match`.

use crate::arguments::MatchArguments;
use crate::clock::Clock;
use crate::input::{self, Failure};
use crate::outputs;
use crate::told::say;
use conemap::io::landmark_file::{self, LandmarkFile};
use conemap::io::landmark_formats::Space;
use conemap::job::{MatchReport, match_meshes};
use conemap::landmark_exchange::Surface;
use conemap::landmark_matching::MatchOptions;
use conemap::monitor::Stage;

/// Finds landmarks, writes the best ones and the report on all, and prints the verdict; an error where there are none.
pub fn run(arguments: &MatchArguments) -> Result<(), Failure> {
    let MatchArguments { source, target, landmarks, target_landmarks, out, report, .. } = arguments;
    let inputs = [source, target].into_iter().chain(landmarks).chain(target_landmarks);
    outputs::check(inputs, report.iter().chain([out]).cloned())?;
    let paths = [source, target];
    let bytes = [input::mesh_bytes(paths[0])?, input::mesh_bytes(paths[1])?];
    let checked = |k: usize| input::checked(paths[k], &bytes[k], arguments.faults);
    let meshes = [checked(0)?, checked(1)?];
    let given =
        given(arguments, [0, 1].map(|k| Surface { mesh: &meshes[k], space: Space::of_mesh(&bytes[k]) }))?;
    let mut clock = Clock::start_only(Stage::Matching);
    let found = match_meshes([&meshes[0], &meshes[1]], &given, &MatchOptions::default(), &mut clock)?;
    clock.stop();
    tell(&found.report);
    if let Some(path) = &arguments.report {
        outputs::write(path, &serde_json::to_vec_pretty(&found.report)?)?;
    }
    let best = found.landmarks(0).ok_or("no landmarks were found")?;
    let [source, target] = paths.map(|path| path.file_name().map(|name| name.to_string_lossy().into()));
    let file = LandmarkFile { source, target, ground_truth: given.ground_truth, ..best };
    outputs::write(&arguments.out, &landmark_file::write(&file))
}

/// The landmarks that are held.
fn given(arguments: &MatchArguments, surfaces: [Surface<'_>; 2]) -> Result<LandmarkFile, Failure> {
    let paths: Vec<_> = arguments.landmarks.iter().chain(&arguments.target_landmarks).collect();
    if paths.is_empty() {
        return Ok(LandmarkFile::default());
    }
    let landmarks = input::landmarks(&paths, [&arguments.source, &arguments.target], surfaces)?;
    landmarks.remarks.iter().for_each(|remark| say(format_args!("landmarks: {remark}")));
    Ok(landmarks.file)
}

/// Tells the verdict and the alternatives.
pub fn tell(report: &MatchReport) {
    say(format_args!("landmarks: {}", report.verdict.sentence));
    if let Some(best) = report.candidates.first() {
        say(format_args!("landmarks: {} pairs, score {:.3}", best.pairs.len(), best.score));
    }
    for (number, candidate) in report.candidates.iter().enumerate().skip(1).take(TOLD) {
        if let Some(difference) = &candidate.difference {
            say(format_args!(
                "landmarks: alternative {number}, score {:.3}: {}",
                candidate.score, difference.sentence
            ));
        }
    }
}

/// The number of alternatives that are printed; the report has all of them.
const TOLD: usize = 3;
