//! Tests of the picture of the base domain of a map: it is a closed surface, its patches cover both meshes, and patch lines border each
//! patch.

use super::job::{Files, run};
use conemap::job::BasePicture;
use conemap::mesh::SurfaceMesh;
use conemap::monitor::Silent;
use conemap::pipeline::{Choices, Method, PipelineOptions};
use glam::DVec3;
use std::f64::consts::PI;

fn area(points: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
    let doubled = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| points[v as usize]);
        (b - a).cross(c - a).length()
    };
    0.5 * triangles.iter().map(doubled).sum::<f64>()
}

fn area_of_mesh(mesh: &SurfaceMesh) -> f64 {
    let triangles: Vec<_> = mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect();
    area(&mesh.positions().raw, &triangles)
}

/// Checks Euler's and Descartes' theorems, and that each patch line joins the cones at the ends of its edge on both meshes.
fn expect_closed(picture: &BasePicture, lines: &[Vec<Vec<DVec3>>; 2]) {
    let cones = picture.shapes[0].cones.len();
    assert_eq!(picture.triangles.len(), 2 * cones - 4);
    assert!(lines.iter().all(|lines| lines.len() == 3 * cones - 6));
    for (shape, lines) in picture.shapes.iter().zip(lines) {
        assert!((shape.curvatures.iter().sum::<f64>() - 4.0 * PI).abs() < 1e-9);
        for (triangle, sides) in picture.triangles.iter().zip(&picture.sides) {
            for k in 0..3 {
                let ends = [triangle[k], triangle[(k + 1) % 3]].map(|v| shape.cones[v as usize]);
                let line = &lines[sides[k] as usize];
                let [first, last] = [line[0], line[line.len() - 1]];
                let apart = |a: DVec3, b: DVec3| a.distance(first) + b.distance(last);
                assert!(apart(ends[0], ends[1]).min(apart(ends[1], ends[0])) < 1e-9);
            }
        }
    }
}

#[test]
fn patches_are_all_of_both_meshes_and_a_saved_map_has_the_same() {
    let (id, landmarks) = ("sphere-tetrahedron", 5);
    let files = Files::of_demo(id, landmarks);
    // With few landmarks the program adds cones of its own.
    let (job, result) = run(&files, &PipelineOptions::default(), &mut Silent);
    let picture = job.base_picture(&result);
    expect_closed(&picture, &result.patch_lines);
    assert_eq!(picture.shapes[0].cones.len(), landmarks + result.report.own_landmarks);
    assert!(result.report.own_landmarks > 0);
    let demo = conemap::demo::build(id).unwrap();
    for (shape, mesh) in picture.shapes.iter().zip([&demo.source, &demo.target]) {
        let triangles = &shape.patches.triangles;
        assert!((area(&shape.points, triangles) / area_of_mesh(mesh) - 1.0).abs() < 1e-9);
        assert_eq!(shape.patches.starts.len(), picture.triangles.len() + 1);
        assert!(shape.patches.starts.windows(2).all(|w| area(&shape.points, &triangles[w[0]..w[1]]) > 0.0));
    }

    let map = job.map_file(&result, &Choices::default()).unwrap();
    let saved = job.taken(&map).base_picture().unwrap();
    assert_eq!((&saved.triangles, &saved.sides), (&picture.triangles, &picture.sides));
    for (one, other) in saved.shapes.iter().zip(&picture.shapes) {
        let moved = one.cones.iter().zip(&other.cones).map(|(p, q)| p.distance(*q));
        assert!(moved.fold(0.0, f64::max) < 1e-12);
        assert!(
            (area(&one.points, &one.patches.triangles) / area(&other.points, &other.patches.triangles) - 1.0)
                .abs()
                < 1e-9
        );
    }
}

#[test]
fn the_thesis_method_has_its_base_domain_without_patches() {
    let files = Files::of_demo("sphere-tetrahedron", 6);
    let options = PipelineOptions { method: Method::Thesis, ..PipelineOptions::default() };
    let (job, result) = run(&files, &options, &mut Silent);
    let picture = job.base_picture(&result);
    expect_closed(&picture, &result.patch_lines);
    assert!(picture.shapes.iter().all(|shape| shape.patches.triangles.is_empty()));
}
