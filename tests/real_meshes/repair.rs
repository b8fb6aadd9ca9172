//! Tests of repair on real files: the outcome for each file, and maps of those that have a partner.

use crate::data::{BAD, OPEN};
use conemap::io;
use conemap::job::{Job, JobFiles, MeshFaults, ReadOptions, TargetImage};
use conemap::landmark_exchange::GivenFile;
use conemap::mesh::repair::{Change, RepairOptions, RepairRefusal, repaired};
use conemap::monitor::Silent;
use conemap::pipeline::{PipelineOptions, Warning};
use std::path::Path;

tests![
    every_file_is_repaired_or_refused,
    noise_and_true_handles_are_told_apart_by_their_loops;
    long:
    a_slit_horse_maps_onto_its_other_pose,
    an_open_dog_maps_onto_the_cat,
];

fn read(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The kinds of the changes with their counts and the share of the caps in percent, or the kind of the refusal.
fn outcome(data: &Path, name: &str, options: &RepairOptions) -> (String, f64) {
    let soup = io::read_mesh(&read(&data.join(name))).unwrap();
    match repaired(&soup, options, &mut Silent) {
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
    let camel = "duplicate_faces 28, split_edges 2, split_vertices 5, capped_holes 2, cut_handles 3";
    // The columns are the file, the outcome by default, the outcome with every repair allowed where it differs, and the percent of the area
    // that are caps.
    let table = [
        ("bad/camel-nonmanifold.off", genus, Some(camel), 0.0017),
        ("bad/cow-pinched-vertex.off", "split_vertices 1", None, 0.0),
        ("bad/genus1-rocker-arm.off", genus, Some("cut_handles 1"), 2.79),
        ("bad/horse-slit.off", "capped_holes 2", None, 0.0178),
        ("bad/open-teapot.off", parts, Some("joined_vertices 402, dropped_parts 3, capped_holes 1"), 13.8),
        ("bad/suzanne-parts.off", parts, Some("duplicate_faces 2, dropped_parts 2, capped_holes 2"), 1.53),
        ("open/alligator-open.off", sheet, None, 0.0),
        ("open/bunny-open.off", "capped_holes 5, unused_vertices 1113", None, 1.83),
        ("open/demosthenes-open.off", "capped_holes 1", None, 3.03),
        ("open/dog0-open.off", "capped_holes 2", None, 0.09),
        ("open/falcon-open.off", "split_vertices 1, dropped_parts 1, capped_holes 1", None, 4.06),
        ("open/human-parts.off", "dropped_parts 2, capped_holes 1", None, 0.05),
        ("open/skull-genus2.off", genus, Some("cut_handles 2"), 0.217),
    ];
    assert!(table.iter().map(|row| &row.0).eq(BAD.iter().chain(&OPEN)));
    for (name, usual, all, caps) in table {
        let (changes, _) = outcome(data, name, &RepairOptions::default());
        assert_eq!(changes, usual, "{name}");
        let (changes, share) = outcome(data, name, &RepairOptions::everything());
        assert_eq!(changes, all.unwrap_or(usual), "{name}");
        assert!((share - caps).abs() <= 0.1 * caps, "{name}: {share}");
    }
}

/// The table has the handles that a refusal lists: the numbers of edges of their loops, and the loops' lengths in percent of the square
/// root of the area.
fn noise_and_true_handles_are_told_apart_by_their_loops(data: &Path) {
    let table: [(&str, &[(usize, f64)]); 3] = [
        ("bad/camel-nonmanifold.off", &[(4, 0.40), (4, 0.41), (7, 1.06)]),
        ("bad/genus1-rocker-arm.off", &[(54, 62.7)]),
        ("open/skull-genus2.off", &[(6, 9.3), (7, 9.9)]),
    ];
    for (name, expected) in table {
        let soup = io::read_mesh(&read(&data.join(name))).unwrap();
        let refusal = repaired(&soup, &RepairOptions::default(), &mut Silent).unwrap_err();
        let RepairRefusal::Handles(handles) = refusal else { panic!("{name}: {refusal}") };
        assert_eq!(handles.len(), expected.len(), "{name}");
        for (handle, &(edges, percent)) in handles.iter().zip(expected) {
            assert_eq!((handle.edges, handle.vertices.len()), (edges, edges), "{name}");
            let length = 100.0 * handle.loop_length;
            assert!((length - percent).abs() < 0.01 * percent + 0.005, "{name}: {length}");
        }
    }
}

/// Makes a map with a repaired mesh, and checks that it is certified and has warnings about the repair and the caps.
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
