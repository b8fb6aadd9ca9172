//! Meshes as they come: what a repair makes of each file, and maps of those that have a partner.

use crate::data::{BAD, OPEN};
use conemap::io;
use conemap::job::{Job, JobFiles, MeshFaults, ReadOptions, TargetImage};
use conemap::landmark_exchange::GivenFile;
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

/// The kinds of the changes with their counts and the share of the caps in percent, or the kind of the refusal.
fn outcome(data: &Path, name: &str, parts: Parts) -> (String, f64) {
    let soup = io::read_mesh(&read(&data.join(name))).unwrap();
    let options = RepairOptions { parts, ..RepairOptions::default() };
    match repaired(&soup, &options, &mut Silent) {
        Ok(mesh) => {
            assert_eq!(mesh.checked.mesh.euler_characteristic(), 2, "{name}");
            let told = |change: &Change| format!("{} {}", change.kind(), change.count());
            let changes: Vec<String> = mesh.report.changes.iter().map(told).collect();
            (changes.join(", "), 100.0 * mesh.report.cap_share)
        }
        Err(refusal) => (format!("refused: {}", refusal.kind()), 0.0),
    }
}

fn every_file_is_repaired_or_refused(data: &Path) {
    let [genus, parts, sheet] = ["refused: genus", "refused: parts", "refused: open_sheet"];
    let largest = Some;
    // By default, with the largest part alone where that is another outcome, and percent of the area that are caps.
    let table = [
        ("bad/camel-nonmanifold.off", genus, None, 0.0),
        ("bad/cow-pinched-vertex.off", "split_vertices 1", None, 0.0),
        ("bad/genus1-rocker-arm.off", genus, None, 0.0),
        ("bad/horse-slit.off", "capped_holes 2", None, 0.0178),
        ("bad/open-teapot.off", parts, largest("joined_vertices 402, dropped_parts 3, capped_holes 1"), 13.8),
        ("bad/suzanne-parts.off", parts, largest("duplicate_faces 2, dropped_parts 2, capped_holes 2"), 1.53),
        ("open/alligator-open.off", sheet, None, 0.0),
        ("open/bunny-open.off", "capped_holes 5, unused_vertices 1113", None, 1.83),
        ("open/demosthenes-open.off", "capped_holes 1", None, 3.03),
        ("open/dog0-open.off", "capped_holes 2", None, 0.09),
        ("open/falcon-open.off", "split_vertices 1, dropped_parts 1, capped_holes 1", None, 4.06),
        ("open/human-parts.off", "dropped_parts 2, capped_holes 1", None, 0.05),
        ("open/skull-genus2.off", genus, None, 0.0),
    ];
    assert!(table.iter().map(|row| &row.0).eq(BAD.iter().chain(&OPEN)));
    for (name, usual, largest, caps) in table {
        let (changes, _) = outcome(data, name, Parts::LargestAndSpecks);
        assert_eq!(changes, usual, "{name}");
        let (changes, share) = outcome(data, name, Parts::LargestAlone);
        assert_eq!(changes, largest.unwrap_or(usual), "{name}");
        assert!((share - caps).abs() <= 0.1 * caps, "{name}: {share}");
    }
}

/// Maps with a repaired mesh: certified, with a warning that tells the repair and the caps.
fn maps(data: &Path, source: &str, target: &str, pairs: &str) {
    let pairs = format!("pairs/{pairs}.json");
    let [source, target, landmarks] = [source, target, pairs.as_str()].map(|name| read(&data.join(name)));
    let landmarks = [GivenFile { name: &pairs, bytes: &landmarks }];
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
