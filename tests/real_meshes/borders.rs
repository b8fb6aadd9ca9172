//! Cat and lion, both cut at the neck.

use crate::common::{landmarks, read_pair, vertex_pairs};
use crate::cutting::{Cuts, Kept, Open, Plane, rim_distances};
use conemap::landmarks::Landmarks;
use conemap::mesh::{FaceId, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{BorderCase, CapFaces, GroundTruth, MapInput, PipelineOptions, run};
use conemap::surface_map::correspondence;
use std::path::Path;
use typed_index_collections::TiVec;

tests![cat_and_lion_cut_at_the_neck_are_mapped_rim_to_rim];

/// Neck, throat and nose of the cat, and the nose of the lion.
const NECK: [u32; 2] = [3236, 3272];
const NOSES: [u32; 2] = [4263, 1811];

fn cat_and_lion_cut_at_the_neck_are_mapped_rim_to_rim(data: &Path) {
    let pair = read_pair(data, "cat-lion");
    let given = landmarks(&pair);
    let options = PipelineOptions::default();
    let closed = run(MapInput::new(&pair.source, &pair.target, &given), &options, &mut Silent).unwrap();
    let cat = Cuts::new(&pair.source, &[(Plane::across(&pair.source, &NECK, NOSES[0]), VertexId(NOSES[0]))]);
    let image = |v: VertexId| closed.target_from_source[v].unwrap().position(&pair.target);
    let nose = pair.target.positions()[VertexId(NOSES[1])];
    let lion = Cuts::new(&pair.target, &[(Plane::nearest(&cat.rim_under(image), nose), VertexId(NOSES[1]))]);
    let (cuts, meshes) = ([&cat, &lion], [&pair.source, &pair.target]);
    let sides = [0, 1].map(|k| Open::new(cuts[k].cut(meshes[k], Kept::Body, 1)));
    let is_left = |ends: &[u32; 2]| (0..2).all(|k| !cuts[k].is_beyond(VertexId(ends[k])));
    let left: Vec<[u32; 2]> = vertex_pairs(&pair.file).into_iter().filter(is_left).collect();
    let on = |k: usize| left.iter().map(|ends| sides[k].vertex(ends[k])).collect();
    let input = MapInput {
        source: &sides[0].checked.mesh,
        target: &sides[1].checked.mesh,
        landmarks: &Landmarks { source: on(0), target: on(1) },
        ground_truth: GroundTruth::Unknown,
        caps: CapFaces { source: sides[0].checked.caps(), target: sides[1].checked.caps() },
    };
    let result = run(input, &options, &mut Silent).unwrap();
    let report = &result.report;
    assert!(report.certificate.as_ref().unwrap().bijective);
    assert_eq!(report.borders.as_ref().unwrap().case, BorderCase::Corresponding);
    let [mean, largest] = rim_distances(&sides, &result);
    assert!(mean < 0.01 && largest < 0.03, "{mean} {largest}");

    // As little distorted as the closed pair on the same skin.
    let lost = [0, 1].map(|k| {
        let touches = |f: FaceId| cuts[k].touches(meshes[k], f);
        meshes[k].faces().map(touches).collect::<TiVec<FaceId, bool>>()
    });
    let caps = CapFaces { source: Some(&lost[0]), target: Some(&lost[1]) };
    let whole = correspondence::distortion(meshes, closed.correspondence.as_ref().unwrap(), caps);
    let energy = report.distortion.energy;
    assert!((energy / whole.energy - 1.0).abs() < 0.05, "{energy} {}", whole.energy);
}
