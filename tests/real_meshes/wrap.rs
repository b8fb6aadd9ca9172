//! A test of wrapping: a cat with quads and texture coordinates is laid onto a lion that lacks a tenth of its skin.

use crate::common::{read_pair, vertex_pairs};
use crate::punching::remove_around;
use crate::quads::obj_with_quads;
use conemap::export::obj;
use conemap::io::landmark_file;
use conemap::job::{Job, JobFiles, Normals, ReadOptions, WrappedFile};
use conemap::landmark_exchange::GivenFile;
use conemap::mesh::surface_index::SurfaceIndex;
use conemap::mesh::{FaceId, SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{Choices, PipelineOptions};
use conemap::wrap::Laid;
use std::path::Path;
use typed_index_collections::TiVec;

tests![a_base_lies_on_a_punched_scan];

fn a_base_lies_on_a_punched_scan(data: &Path) {
    let mut pair = read_pair(data, "cat-lion");
    let pairs = vertex_pairs(&pair.file);
    let mut is_gone: TiVec<FaceId, bool> = pair.target.faces().map(|_| false).collect();
    // The hole is in the middle of the back.
    remove_around(&pair.target, VertexId(pairs[12][1]), 0.1, &mut is_gone);
    let is_left = |v: u32| pair.target.star(VertexId(v)).any(|h| !is_gone[h.face()]);
    let left = pair.file.pairs.iter().zip(&pairs).filter(|(_, [_, v])| is_left(*v)).map(|(p, _)| *p);
    (pair.file.pairs, pair.file.labels) = (left.collect(), None);
    let base = obj_with_quads(&pair.source, |_| true);
    let skin = pair.target.triangles().iter_enumerated().filter(|(f, _)| !is_gone[*f]);
    let scan = obj::polygons(pair.target.positions().as_ref(), skin.map(|(_, t)| t.map(|v| v.0)));
    let landmarks = landmark_file::write(&pair.file);
    let landmarks = [GivenFile { name: "pairs.json", bytes: &landmarks }];
    let files = JobFiles { source: &base, target: &scan, landmarks: &landmarks };
    let job = Job::read(files, ReadOptions::default(), &mut Silent).unwrap();
    let result = job.run(&PipelineOptions::default(), &mut Silent).unwrap();
    let map = job.map_file(&result, &Choices::default()).unwrap();
    let wrapped = job.taken(&map).wrapped(&base, Normals::Kept, &mut Silent).unwrap();

    let others = |text: &[u8]| -> Vec<Vec<u8>> {
        let lines = text.split_inclusive(|b| *b == b'\n').filter(|line| !line.starts_with(b"v "));
        lines.map(<[u8]>::to_vec).collect()
    };
    assert_eq!(others(&wrapped.bytes), others(&base));
    let report = &wrapped.report;
    assert_eq!(report.surface.flipped_triangles, 0, "{:?}", report.flipped);
    for figures in [report.surface.distance.to_scan, report.surface.distance.from_scan] {
        assert!(figures.mean <= 0.002 && figures.p95 <= 0.006, "{figures:?}");
    }
    assert!(report.surface.extended > 100 && report.surface.covered > 0.8);
    assert_near([&pair.source, &pair.target], &is_gone, &wrapped);
}

/// Checks the distances by other means: from the middles of the laid faces to the whole lion, and from the lion's skin to the whole laid
/// cat.
fn assert_near([base, scan]: [&SurfaceMesh; 2], is_gone: &TiVec<FaceId, bool>, wrapped: &WrappedFile) {
    let laid = base.with_positions(wrapped.positions.iter().copied().collect());
    let [on_laid, on_scan] = [&laid, scan].map(SurfaceIndex::new);
    let size = scan.area().sqrt();
    let mean = |distances: Vec<f64>| distances.iter().sum::<f64>() / distances.len() as f64 / size;
    let is_covered =
        |f: &FaceId| base.triangles()[*f].iter().all(|v| wrapped.laid[v.index()] == Some(Laid::OnScan));
    let middle = |mesh: &SurfaceMesh, f: FaceId| mesh.corners(f).into_iter().sum::<glam::DVec3>() / 3.0;
    let there = base.faces().filter(is_covered).map(|f| on_scan.nearest(middle(&laid, f)).distance);
    let back = scan.faces().filter(|f| !is_gone[*f]).map(|f| on_laid.nearest(middle(scan, f)).distance);
    let [there, back] = [mean(there.collect()), mean(back.collect())];
    assert!(there < 0.002 && back < 0.002, "{there} {back}");
}
