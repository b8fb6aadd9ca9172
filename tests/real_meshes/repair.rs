//! Meshes as they come: what a repair makes of each file, and maps of those that have a partner.

use crate::data::{BAD, OPEN};
use conemap::io;
use conemap::job::{Job, JobFiles, MeshFaults, ReadOptions, TargetImage};
use conemap::mesh::repair::{Change, Parts, RepairOptions, repaired};
use conemap::monitor::Silent;
use conemap::pipeline::{PipelineOptions, Warning};
use std::path::Path;

tests![every_file_is_repaired_or_refused, a_slit_horse_maps_onto_its_other_pose, an_open_dog_maps_onto_the_cat];

fn read(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The kinds of the changes with their counts, or the kind of the refusal.
fn outcome(data: &Path, name: &str, parts: Parts) -> String {
    let soup = io::read_mesh(&read(&data.join(name))).unwrap();
    let options = RepairOptions { parts, ..RepairOptions::default() };
    match repaired(&soup, &options) {
        Ok(mesh) => {
            assert_eq!(mesh.checked.mesh.euler_characteristic(), 2, "{name}");
            let told = |change: &Change| format!("{} {}", change.kind(), change.count());
            let changes: Vec<String> = mesh.report.changes.iter().map(told).collect();
            let caps = 100.0 * mesh.report.cap_share;
            if caps > 0.0 { format!("{}; caps {caps:.2} %", changes.join(", ")) } else { changes.join(", ") }
        }
        Err(refusal) => format!("refused: {}", refusal.kind()),
    }
}

fn every_file_is_repaired_or_refused(data: &Path) {
    let table: Vec<[String; 3]> = BAD
        .iter()
        .chain(&OPEN)
        .map(|name| {
            let [usual, largest] = [Parts::LargestAndSpecks, Parts::LargestAlone].map(|parts| outcome(data, name, parts));
            [(*name).to_owned(), usual, largest]
        })
        .collect();
    panic!("{table:#?}");
}

/// Maps with a repaired mesh: certified, with a warning that tells the repair and the caps.
fn maps(data: &Path, source: &str, target: &str, pairs: &str) {
    let [source, target, landmarks] =
        [source, target, &format!("pairs/{pairs}.json")].map(|name| read(&data.join(name)));
    let files = JobFiles { source: &source, target: &target, landmarks: &landmarks };
    let strict = ReadOptions { mesh_faults: MeshFaults::Refused, ..ReadOptions::default() };
    assert!(Job::read(files, strict, &mut Silent).is_err());
    let job = Job::read(files, TargetImage::AsGiven, &mut Silent).unwrap();
    let result = job.run(&PipelineOptions::default(), &mut Silent).unwrap();
    let certificate = result.report.certificate.as_ref().unwrap();
    assert!(certificate.bijective && certificate.flipped_triangles == 0);
    let warnings = &result.report.warnings;
    assert!(warnings.iter().any(|w| matches!(w, Warning::Repaired { .. })), "{warnings:?}");
    assert!(warnings.iter().any(|w| matches!(w, Warning::Capped { share, .. } if *share < 0.02)), "{warnings:?}");
    assert!(result.report.distortion.mean < 3.0, "{:?}", result.report.distortion);
}

fn a_slit_horse_maps_onto_its_other_pose(data: &Path) {
    maps(data, "bad/horse-slit.off", "sumner/horse-pose05.off", "horse-horse05");
}

fn an_open_dog_maps_onto_the_cat(data: &Path) {
    maps(data, "tosca/cat0.off", "open/dog0-open.off", "cat-dog");
}
