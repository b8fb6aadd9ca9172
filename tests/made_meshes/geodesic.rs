//! Tests of geodesic distances on meshes with bad triangles, by bounds that hold for triangles of any shape.

use crate::distance_bounds::check_bounds;
use crate::exact_geodesics::exact_distances;
use crate::rough_meshes::{Random, body, cut_octahedron, roughened};
use conemap::geodesic::distances;
use conemap::mesh::VertexId;

#[test]
fn distances_on_rough_meshes_are_between_those_in_space_and_those_along_edges() {
    check_rough_bounds((0..200).step_by(5));
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn distances_on_many_rough_meshes_are_between_those_in_space_and_those_along_edges() {
    check_rough_bounds(0..200);
}

fn check_rough_bounds(numbers: impl Iterator<Item = u64>) {
    for number in numbers {
        let mut random = Random::new(number);
        let mesh = roughened(&body(&mut random), &mut random);
        for _ in 0..3 {
            let seed = VertexId::from(random.below(mesh.vertex_count()));
            check_bounds(&mesh, seed, &format!("rough mesh {number}"));
        }
    }
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn distances_on_rough_meshes_hardly_depend_on_the_direction() {
    for number in 0..200 {
        let mut random = Random::new(number);
        let mesh = roughened(&body(&mut random), &mut random);
        let [a, b] = [(), ()].map(|()| VertexId::from(random.below(mesh.vertex_count())));
        let (there, back) = (distances(&mesh, &[a])[b], distances(&mesh, &[b])[a]);
        assert!(there <= 1.8 * back && back <= 1.8 * there, "rough mesh {number}: {there} {back}");
    }
}

/// Slivers and needles do not change a surface: the corners of an octahedron keep their distances.
#[test]
fn slivers_and_needles_do_not_change_distances() {
    for number in 0..200 {
        let mesh = cut_octahedron(&mut Random::new(1000 + number), 60);
        for a in 0..6_u32 {
            let found = distances(&mesh, &[VertexId(a)]);
            for b in (0..6_u32).filter(|&b| b != a) {
                // Neighbours are an edge apart, opposite corners lie across two faces.
                let known = if a / 2 == b / 2 { 6.0_f64.sqrt() } else { 2.0_f64.sqrt() };
                let found = found[VertexId(b)];
                assert!((found - known).abs() < 1e-5 * known, "cut {number}: {a} to {b}: {found} {known}");
            }
        }
    }
}

#[test]
fn distances_on_bodies_are_nearly_exact() {
    let (mut sum, mut count) = (0.0, 0.0);
    for number in 0..40 {
        let mut random = Random::new(number);
        let mesh = body(&mut random);
        let seed = VertexId::from(random.below(mesh.vertex_count()));
        let (found, known) = (distances(&mesh, &[seed]), exact_distances(&mesh, seed));
        for v in mesh.vertices().filter(|&v| v != seed) {
            let ratio = found[v] / known[v.index()];
            assert!((0.9..1.15).contains(&ratio), "body {number}: vertex {v:?} {ratio}");
            sum += (ratio - 1.0).abs();
            count += 1.0;
        }
    }
    assert!(sum / count < 0.003, "mean error {}", sum / count);
}
