//! Tests that the same input gives the same bytes, and measures how much a map changes when source and target are exchanged or the landmarks
//! come in another order.

use crate::arguments::Arguments;
use crate::job_files::files;
use crate::judged_job::{Files, Mapped, mapped};
use conemap::io::landmark_file::LandmarkFile;
use conemap::math::random::SplitMix;
use conemap::monitor::Silent;
use conemap::pipeline::Report;

/// Makes four maps of each pair: two of the same files, one with the meshes exchanged and one with the landmarks permuted. The process ends
/// with code 1 where the first two differ.
pub fn table(arguments: &Arguments) {
    println!(
        "{:22} {:>16} {:>9} {:>22} {:>22}",
        "pair", "files the same", "E", "exchanged: E, mean log", "permuted: E, mean log"
    );
    let mut differ = 0;
    for name in arguments.names() {
        let files = files(arguments, &name);
        let line = line(&files);
        differ += usize::from(line.is_err());
        println!("{name:22} {}", line.unwrap_or_else(|why| format!("DIFFERS: {why}")));
    }
    println!("{differ} pairs differ");
    if differ > 0 {
        std::process::exit(1);
    }
}

/// Makes the four maps of a pair and returns the line of the table.
///
/// # Errors
/// Names the file that differs between two maps of the same input.
fn line(files: &Files) -> Result<String, String> {
    let map = |files: &Files| mapped(files, &mut Silent).map_err(|outcome| format!("{outcome:?}"));
    let first = map(files)?;
    let same = same_files(&first, &map(files)?)?;
    let exchanged = map(&exchanged(files))?;
    let permuted = map(&permuted(files))?;
    let off = |other: &Mapped| {
        let [a, b] = [first.report(), other.report()];
        let relative = |of: fn(&Report) -> f64| (of(b) / of(a) - 1.0).abs();
        format!(
            "{:10.1e} {:11.1e}",
            relative(|report| report.distortion.energy),
            relative(|report| report.distortion.mean_log)
        )
    };
    let energy = first.report().distortion.energy;
    Ok(format!("{same:>16} {energy:9.4} {} {}", off(&exchanged), off(&permuted)))
}

/// Compares the files and reports of two maps byte for byte, and returns how many files there are.
fn same_files(first: &Mapped, again: &Mapped) -> Result<String, String> {
    let [one, other] = [first, again].map(|mapped| mapped.outputs().collect::<Vec<_>>());
    let differing = one.iter().zip(&other).find(|(a, b)| a != b).map(|(a, _)| a.name);
    if let Some(name) = differing {
        return Err(format!("{name} is another file the second time"));
    }
    if one.len() != other.len() || first.report() != again.report() {
        return Err("the reports or the numbers of files are others the second time".to_owned());
    }
    Ok(format!("{} and report", one.len()))
}

fn landmarks(files: &Files) -> LandmarkFile {
    serde_json::from_slice(&files.landmarks).expect("a landmark file")
}

fn with_landmarks([source, target]: [&Vec<u8>; 2], file: &LandmarkFile) -> Files {
    let landmarks = serde_json::to_vec(file).expect("landmarks have JSON");
    Files { source: source.clone(), target: target.clone(), landmarks }
}

fn exchanged(files: &Files) -> Files {
    let mut file = landmarks(files);
    file.pairs.iter_mut().for_each(|pair| pair.reverse());
    std::mem::swap(&mut file.source, &mut file.target);
    with_landmarks([&files.target, &files.source], &file)
}

fn permuted(files: &Files) -> Files {
    let mut file = landmarks(files);
    let mut random = SplitMix::new(7);
    let mut order: Vec<usize> = (0..file.pairs.len()).collect();
    for k in (1..order.len()).rev() {
        order.swap(k, (random.unit() * (k + 1) as f64) as usize);
    }
    file.pairs = order.iter().map(|&k| file.pairs[k]).collect();
    file.labels = file.labels.map(|labels| order.iter().map(|&k| labels[k].clone()).collect());
    with_landmarks([&files.source, &files.target], &file)
}
