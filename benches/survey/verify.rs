//! The map files of all pairs, judged by both certificates: the program's own and `conemap_verify`.

use crate::arguments::Arguments;
use crate::case::Limit;
use conemap::job::{Job, JobFiles, MapFiles, OpenMap, OutputKind, Proof, TargetImage, prove};
use conemap::landmark_exchange::GivenFile;
use conemap::pipeline::Choices;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

/// The verdicts of both certificates on a map.
struct Verdicts {
    certified: bool,
    /// Whether the reader of map files accepts the map's file.
    is_read: bool,
    proof: Proof,
    /// Seconds of wall time that the proof took.
    seconds: f64,
}

/// Makes the map of each pair, writes its map file, and has that proved.
pub fn both_certificates(arguments: &Arguments) {
    println!(
        "{:20} {:>8} {:>7} {:>8} {:>8} {:>9} {:>8} {:>9} {:>9} {:>7}",
        "pair", "pieces", "inside", "triangl.", "doubtful", "integers", "landm.", "given m.", "off by", "s"
    );
    let (mut agree, mut all, mut slowest) = (0, 0, 0.0_f64);
    for name in arguments.names() {
        all += 1;
        match judged(arguments, &name) {
            Ok(verdicts) => {
                let agreed = verdicts.certified && verdicts.is_read && verdicts.proof.is_exact();
                agree += usize::from(agreed);
                slowest = slowest.max(verdicts.seconds);
                println!("{name:20} {}{}", line(&verdicts), if agreed { "" } else { "  THEY DIFFER" });
            }
            Err(error) => println!("{name:20} FAILED: {error}"),
        }
    }
    println!("{agree} of {all} maps are certified, read and proved; the slowest proof took {slowest:.2} s");
}

fn line(Verdicts { proof, seconds, .. }: &Verdicts) -> String {
    format!(
        "{:8} {:7} {:8} {:8} {:9} {:>8} {:9} {:9.1e} {seconds:7.2}",
        proof.pieces,
        proof.pieces - proof.segments,
        proof.triangles,
        proof.doubtful.triangles,
        proof.signs.by_integers,
        format!("{}/{}", proof.landmarks.exact, proof.landmarks.pairs),
        proof.matrices.given,
        proof.matrices.largest_distance,
    )
}

fn judged(arguments: &Arguments, name: &str) -> Result<Verdicts, String> {
    let bytes = |path: PathBuf| std::fs::read(&path).map_err(|e| format!("{}: {e}", path.display()));
    let pair = bytes(arguments.data.join("pairs").join(format!("{name}.json")))?;
    let named: serde_json::Value = serde_json::from_slice(&pair).map_err(|e| e.to_string())?;
    let mesh = |side: &str| bytes(arguments.data.join(named[side].as_str().unwrap_or_default()));
    let (source, target) = (mesh("source")?, mesh("target")?);
    let landmarks = [GivenFile { name, bytes: &pair }];
    let files = JobFiles { source: &source, target: &target, landmarks: &landmarks };
    let mut limit = Limit::new(arguments.time_limit);
    let job = Job::read(files, TargetImage::AsGiven, &mut limit).map_err(|e| e.to_string())?;
    let result = job.run(&arguments.options, &mut limit).map_err(|e| e.to_string())?;
    let map = job.map_file(&result, &Choices::default()).ok_or("the map has no pieces")?;
    let map = job.taken(&map).output(OutputKind::Map).map_err(|e| e.to_string())?;
    let files = MapFiles { map: &map, source: &source, target: &target };
    let is_read = OpenMap::read(files).is_ok();
    let begun = Instant::now();
    let proof = prove(files, &mut |_| ControlFlow::Continue(())).map_err(|e| e.to_string())?;
    let seconds = begun.elapsed().as_secs_f64();
    let certified = result.report.certificate.as_ref().is_some_and(|c| c.bijective);
    Ok(Verdicts { certified, is_read, proof, seconds })
}
