//! Meshes as they come: what a repair makes of each file, and maps of those that have a partner.

use crate::data::{BAD, OPEN};
use conemap::io;
use conemap::job::{Job, JobFiles, MeshFaults, ReadOptions, TargetImage};
use conemap::mesh::repair::{Change, Parts, RepairOptions, repaired};
use conemap::monitor::Silent;
use conemap::pipeline::{PipelineOptions, Warning};
use std::path::Path;

tests![
    every_file_is_repaired_or_refused,
    a_slit_horse_maps_onto_its_other_pose,
    an_open_dog_maps_onto_the_cat
];

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
    let [genus, parts, sheet] = ["refused: genus", "refused: parts", "refused: open_sheet"];
    // By default, and with the largest part alone where that is another outcome.
    let table = [
        ("bad/camel-nonmanifold.off", genus, None),
        ("bad/cow-pinched-vertex.off", "split_vertices 1", None),
        ("bad/genus1-rocker-arm.off", genus, None),
        ("bad/horse-slit.off", "capped_holes 2; caps 0.02 %", None),
        (
            "bad/open-teapot.off",
            parts,
            Some("joined_vertices 402, dropped_parts 3, capped_holes 1; caps 13.82 %"),
        ),
        (
            "bad/suzanne-parts.off",
            parts,
            Some("duplicate_faces 2, dropped_parts 2, capped_holes 2; caps 1.53 %"),
        ),
        ("open/alligator-open.off", sheet, None),
        ("open/bunny-open.off", "capped_holes 5, unused_vertices 1113; caps 1.82 %", None),
        ("open/demosthenes-open.off", "capped_holes 1; caps 3.03 %", None),
        ("open/dog0-open.off", "capped_holes 2; caps 0.09 %", None),
        ("open/falcon-open.off", "split_vertices 1, dropped_parts 1, capped_holes 1; caps 4.06 %", None),
        ("open/human-parts.off", "dropped_parts 2, capped_holes 1; caps 0.05 %", None),
        ("open/skull-genus2.off", genus, None),
    ];
    assert!(table.iter().map(|row| &row.0).eq(BAD.iter().chain(&OPEN)));
    for (name, usual, largest) in table {
        assert_eq!(outcome(data, name, Parts::LargestAndSpecks), usual, "{name}");
        assert_eq!(outcome(data, name, Parts::LargestAlone), largest.unwrap_or(usual), "{name}");
    }
}

/// Maps with a repaired mesh: certified, with a warning that tells the repair and the caps.
fn maps(data: &Path, source: &str, target: &str, pairs: &str) {
    let pairs = format!("pairs/{pairs}.json");
    let [source, target, landmarks] = [source, target, pairs.as_str()].map(|name| read(&data.join(name)));
    let files = JobFiles { source: &source, target: &target, landmarks: &landmarks };
    let strict = ReadOptions { mesh_faults: MeshFaults::Refused, ..ReadOptions::default() };
    assert!(Job::read(files, strict, &mut Silent).is_err());
    let job = Job::read(files, TargetImage::AsGiven, &mut Silent).unwrap();
    let result = job.run(&PipelineOptions::default(), &mut Silent).unwrap();
    let certificate = result.report.certificate.as_ref().unwrap();
    assert!(certificate.bijective && certificate.flipped_triangles == 0);
    let warnings = &result.report.warnings;
    assert!(warnings.iter().any(|w| matches!(w, Warning::Repaired { .. })), "{warnings:?}");
    assert!(
        warnings.iter().any(|w| matches!(w, Warning::Capped { share, .. } if *share < 0.02)),
        "{warnings:?}"
    );
    assert!(result.report.distortion.mean < 3.0, "{:?}", result.report.distortion);
}

fn a_slit_horse_maps_onto_its_other_pose(data: &Path) {
    maps(data, "bad/horse-slit.off", "sumner/horse-pose05.off", "horse-horse05");
}

fn an_open_dog_maps_onto_the_cat(data: &Path) {
    maps(data, "tosca/cat0.off", "open/dog0-open.off", "cat-dog");
}
