//! `conemap landmarks`.

use crate::arguments::{FaultArguments, LandmarksArguments};
use crate::input::{self, Failure};
use crate::outputs;
use crate::told::{print, say};
use conemap::io::landmark_formats::{LandmarkFormat, Space};
use conemap::landmark_exchange::{PairLandmarks, Surface, write_pairs, write_side};
use conemap::landmarks::{MeshSide, check_side};
use conemap::mesh::check::CheckedMesh;
use serde_json::json;
use std::path::Path;

/// Reads landmark files onto their meshes, prints how far their points were off, and writes them in other formats.
pub fn run(arguments: &LandmarksArguments) -> Result<(), Failure> {
    let paths = [&arguments.source, &arguments.target];
    outputs::check(paths.into_iter().chain(&arguments.inputs), arguments.outputs.clone())?;
    let (source, target) = (mesh(paths[0], arguments.faults)?, mesh(paths[1], arguments.faults)?);
    let surfaces = [&source, &target].map(|(mesh, space)| Surface { mesh, space: *space });
    let mut landmarks = input::landmarks(&arguments.inputs, paths.map(|path| &**path), surfaces)?;
    for (surface, side) in surfaces.into_iter().zip(MeshSide::BOTH) {
        check_side(surface.mesh, side, &landmarks.file.pairs)?;
    }
    let [source_name, target_name] =
        paths.map(|path| path.file_name().map(|name| name.to_string_lossy().into()));
    landmarks.file.source = landmarks.file.source.or(source_name);
    landmarks.file.target = landmarks.file.target.or(target_name);
    write(arguments, &landmarks, surfaces)?;
    let text = if arguments.json { as_json(&landmarks)? } else { as_text(&landmarks) };
    print(text)
}

fn mesh(path: &Path, faults: FaultArguments) -> Result<(CheckedMesh, Space), Failure> {
    let bytes = input::mesh_bytes(path)?;
    Ok((input::checked(path, &bytes, faults)?, Space::of_mesh(&bytes)))
}

fn write(
    arguments: &LandmarksArguments,
    landmarks: &PairLandmarks,
    surfaces: [Surface<'_>; 2],
) -> Result<(), Failure> {
    let file = &landmarks.file;
    let format = |path: &Path| {
        let named = LandmarkFormat::of_name(&path.to_string_lossy());
        arguments.format.or(named).ok_or_else(|| format!("{}: choose a format with --format", path.display()))
    };
    let told = |path: &Path, error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let is_soft = file.radii.iter().flatten().any(|radius| *radius > 0.0);
    for path in arguments.outputs.iter().filter(|_| is_soft) {
        if format(path)? != LandmarkFormat::Conemap {
            say(format_args!(
                "warning: {}: this format has no radii, so that all landmarks are held there; that of Conemap (.json) has them",
                path.display()
            ));
        }
    }
    match &arguments.outputs[..] {
        [] => {}
        [path] => {
            let bytes = write_pairs(format(path)?, file, surfaces).map_err(|e| told(path, &e))?;
            outputs::write(path, &bytes)?;
        }
        paths => {
            for ((path, surface), side) in paths.iter().zip(surfaces).zip(MeshSide::BOTH) {
                let bytes = write_side(format(path)?, file, surface, side).map_err(|e| told(path, &e))?;
                outputs::write(path, &bytes)?;
            }
        }
    }
    Ok(())
}

/// One line per pair: its number, the distances of both points, and its label.
fn as_text(landmarks: &PairLandmarks) -> String {
    let labels = landmarks.file.labels.as_deref().unwrap_or_default();
    let line = |(pair, [source, target]): (usize, &[f64; 2])| {
        let label = labels.get(pair).map(String::as_str).unwrap_or_default();
        format!("{:>5}  {source:>12.4e}  {target:>12.4e}  {label}", pair + 1)
    };
    let mut lines = vec![format!("{:>5}  {:>12}  {:>12}  label", "pair", "source", "target")];
    lines.extend(landmarks.distances.iter().enumerate().map(line));
    lines.extend(landmarks.remarks.iter().map(|remark| format!("warning: {remark}")));
    lines.join("\n")
}

fn as_json(landmarks: &PairLandmarks) -> Result<String, Failure> {
    let labels = landmarks.file.labels.as_deref().unwrap_or_default();
    let pair =
        |(pair, distances): (usize, &[f64; 2])| json!({ "label": labels.get(pair), "distances": distances });
    let pairs: Vec<_> = landmarks.distances.iter().enumerate().map(pair).collect();
    let remarks = landmarks.remarks.iter();
    let remarks: Vec<_> = remarks.map(|r| json!({ "kind": r.kind(), "sentence": r.to_string() })).collect();
    let value = json!({ "formats": landmarks.formats, "pairs": pairs, "remarks": remarks });
    Ok(serde_json::to_string_pretty(&value)?)
}
