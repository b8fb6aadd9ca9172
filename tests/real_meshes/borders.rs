//! Tests of borders that correspond, on cat and lion and on horse and camel, both cut at the neck.

use crate::common::{landmarks, read_pair, vertex_pairs};
use crate::cutting::{Cuts, Kept, Open, Plane, rim_distances};
use conemap::landmarks::Landmarks;
use conemap::mesh::{FaceId, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{BorderCase, CapFaces, GroundTruth, MapInput, PipelineOptions, run};
use conemap::surface_map::correspondence;
use std::path::Path;
use typed_index_collections::TiVec;

tests![
    cat_and_lion_cut_at_the_neck_are_mapped_rim_to_rim;
    long: horse_and_camel_cut_at_the_neck_are_mapped_rim_to_rim
];

fn cat_and_lion_cut_at_the_neck_are_mapped_rim_to_rim(data: &Path) {
    rim_goes_to_rim(data, "cat-lion", [3236, 3272], 4263);
}

fn horse_and_camel_cut_at_the_neck_are_mapped_rim_to_rim(data: &Path) {
    rim_goes_to_rim(data, "horse-camel", [2890, 2882], 4239);
}

/// Checks that rims are mapped onto rims. `neck` are two vertices on opposite sides of the source's neck, `nose` is the landmark at its
/// nose.
fn rim_goes_to_rim(data: &Path, name: &str, neck: [u32; 2], nose: u32) {
    let pair = read_pair(data, name);
    let noses = vertex_pairs(&pair.file).into_iter().find(|ends| ends[0] == nose).unwrap().map(VertexId);
    let given = landmarks(&pair);
    let options = PipelineOptions::default();
    let closed = run(MapInput::new(&pair.source, &pair.target, &given), &options, &mut Silent).unwrap();
    let from = Cuts::new(&pair.source, &[(Plane::across(&pair.source, &neck, nose), noses[0])]);
    let image = |v: VertexId| closed.target_from_source[v].unwrap().position(&pair.target);
    let end = pair.target.positions()[noses[1]];
    let onto = Cuts::new(&pair.target, &[(Plane::nearest(&from.rim_under(image), end), noses[1])]);
    let (cuts, meshes) = ([&from, &onto], [&pair.source, &pair.target]);
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
    assert!(mean < 0.001 && largest < 0.01, "{mean} {largest}");

    // The distortion is as small as that of the closed pair on the same skin.
    let lost = [0, 1].map(|k| {
        let touches = |f: FaceId| cuts[k].touches(meshes[k], f);
        meshes[k].faces().map(touches).collect::<TiVec<FaceId, bool>>()
    });
    let caps = CapFaces { source: Some(&lost[0]), target: Some(&lost[1]) };
    let whole = correspondence::distortion(meshes, closed.correspondence.as_ref().unwrap(), caps);
    let energy = report.distortion.energy;
    assert!((energy / whole.energy - 1.0).abs() < 0.05, "{energy} {}", whole.energy);
}
