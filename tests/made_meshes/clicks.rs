//! Landmarks where people click: inside faces and beside edges, not only at vertices.

use crate::other_triangles::cut_by_planes;
use crate::points::with_points;
use conemap::demo;
use conemap::mesh::VertexId;
use conemap::remesh::EdgeLengths;

#[test]
fn the_demo_has_as_good_a_map_from_points_in_faces() {
    let demo = demo::build("horse-cat").unwrap();
    let side = |k: usize| demo.landmarks.iter().map(|pair| VertexId(pair[k])).collect::<Vec<_>>();
    let vertices = [side(0), side(1)];
    let map =
        |weights| with_points([&demo.source, &demo.target], [&vertices[0], &vertices[1]], weights).energy;
    let at_vertices = map([1.0, 0.0, 0.0]);
    let (inside, on, beside) = (map([0.6, 0.2, 0.2]), map([0.5, 0.5, 0.0]), map([0.5, 0.5 - 1e-7, 1e-7]));
    for energy in [inside, on] {
        assert!((energy / at_vertices - 1.0).abs() < 0.05, "{energy} against {at_vertices}");
    }
    // Landmarks nearer to the edge than anybody can click give the same map as landmarks on the edge.
    assert!((on / beside - 1.0).abs() < 0.005, "{on} {beside}");
}

/// The map depends on the surfaces, not on their triangles, slivers among them.
#[test]
fn the_demo_has_as_good_a_map_onto_slivers() {
    let demo = demo::build("horse-cat").unwrap();
    let side = |k: usize| demo.landmarks.iter().map(|pair| VertexId(pair[k])).collect::<Vec<_>>();
    let vertices = [side(0), side(1)];
    // Vertices keep their numbers.
    let cut = cut_by_planes(&demo.target, 2.0 * EdgeLengths::of(&demo.target).mean);
    let [as_it_is, onto_slivers] = [&demo.target, &cut]
        .map(|target| with_points([&demo.source, target], [&vertices[0], &vertices[1]], [1.0, 0.0, 0.0]));
    assert!(onto_slivers.energy < 1.01 * as_it_is.energy, "{} {}", as_it_is.energy, onto_slivers.energy);
}

/// A landmark near an edge makes a needle, whose long side is straight while its image bends around the cone.
#[test]
fn landmarks_near_edges_make_no_dents() {
    let demo = demo::build("horse-turning").unwrap();
    let side = |k: usize| demo.landmarks.iter().map(|pair| VertexId(pair[k])).collect::<Vec<_>>();
    let vertices = [side(0), side(1)];
    let map = |weights| with_points([&demo.source, &demo.target], [&vertices[0], &vertices[1]], weights);
    let (on, near) = (map([0.5, 0.5, 0.0]), map([0.5, 0.4992, 0.0008]));
    println!("{on:?} {near:?}");
    assert!((near.energy / on.energy - 1.0).abs() < 0.005, "{} {}", on.energy, near.energy);
    assert!(near.max < 2.0 * on.max, "{} {}", on.max, near.max);
}
