//! Landmarks where people click: inside faces, not only at vertices.

use crate::common;
use crate::points::with_points;
use conemap::mesh::VertexId;
use std::path::Path;

tests![cat_and_lion_have_as_good_a_map_from_points_in_faces];

fn cat_and_lion_have_as_good_a_map_from_points_in_faces(data: &Path) {
    let pair = common::read_pair(data, "cat-lion");
    let landmarks = common::landmarks(&pair);
    let vertices: [&[VertexId]; 2] = [&landmarks.source.raw, &landmarks.target.raw];
    let distortion = with_points([&pair.source, &pair.target], vertices, [0.6, 0.2, 0.2]);
    assert!(distortion.energy < 4.4 && distortion.max < 1e4, "{distortion:?}");
}
