//! Tests that meshes of a size far from 1, or far from the origin, have the same map as elsewhere, and that their output files have the
//! size and place of the given ones.

use crate::job::{Files, run};
use conemap::export;
use conemap::io::read_mesh;
use conemap::job::{Job, OutputKind};
use conemap::mesh::check::closed_genus_zero;
use conemap::mesh::soup::PolygonSoup;
use conemap::monitor::Silent;
use conemap::pipeline::{Choices, MapResult, PipelineOptions};
use glam::DVec3;

/// The file of a mesh that is scaled and moved.
fn moved(file: &[u8], factor: f64, shift: DVec3) -> Vec<u8> {
    let soup = read_mesh(file).unwrap();
    let positions: Vec<DVec3> = soup.positions.iter().map(|p| *p * factor + shift).collect();
    export::obj::polygons(&positions, &soup.polygons)
}

fn output(job: &Job, result: &MapResult, kind: OutputKind) -> Vec<u8> {
    let map = job.map_file(result, &Choices::default()).unwrap();
    job.taken(&map).output(kind).unwrap()
}

/// The lowest and the highest coordinates.
fn bounds(soup: &PolygonSoup) -> [DVec3; 2] {
    let start = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    soup.positions.iter().fold(start, |[low, high], p| [low.min(*p), high.max(*p)])
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn a_map_does_not_depend_on_size_and_place() {
    let files = Files::of_demo("horse-cat", usize::MAX);
    let options: PipelineOptions = Choices { own_cones: Some(0), ..Choices::default() }.into();
    let near = DVec3::new(1e8, -1e8, 2e8);
    let (_, usual) = run(&files, &options, &mut Silent);
    // Scaling by powers of two changes no digit, so that nothing but the size could change the map. A shift changes the last digits, and
    // with them the choice of the relaxation between nearly equal ways, by 0.2 % of the energy.
    let sizes = [2.0_f64.powi(-300), 2.0_f64.powi(300)];
    let cases = [(sizes, [DVec3::ZERO; 2], 1e-12, 1e-6), ([1.0, 1.0], [near, -near], 1e-2, 1e-4)];
    for (factors, shifts, change, tolerance) in cases {
        let source = moved(&files.source, factors[0], shifts[0]);
        let target = moved(&files.target, factors[1], shifts[1]);
        let far = Files { source, target, landmarks: files.landmarks.clone() };
        let (job, result) = run(&far, &options, &mut Silent);
        assert!(result.report.certificate.as_ref().unwrap().bijective);
        let [there, here] = [&result, &usual].map(|result| result.report.distortion.energy);
        assert!((there / here - 1.0).abs() < change, "{there} {here}");

        // The source in the GLB lies where its file has it, and the source in the target's shape where the target lies.
        let glb = read_mesh(&output(&job, &result, OutputKind::Glb)).unwrap();
        let shape = read_mesh(&output(&job, &result, OutputKind::SourceShapeObj)).unwrap();
        for (written, file, factor) in [(&glb, &far.source, factors[0]), (&shape, &far.target, factors[1])] {
            let [written, given] = [bounds(written), bounds(&read_mesh(file).unwrap())];
            for (a, b) in written.into_iter().zip(given) {
                let size = factor * 3.0;
                assert!((a - b).abs().max_element() < 0.05 * size, "{a} {b}");
            }
        }
        let size = |soup: &PolygonSoup| bounds(soup).into_iter().reduce(|low, high| high - low).unwrap();
        let [there, here] = [size(&glb), size(&read_mesh(&far.source).unwrap())];
        assert!((there / here - 1.0).abs().max_element() < tolerance, "{there} {here}");
    }
}

#[test]
fn the_files_coordinates_come_back_from_a_repair() {
    let soup = read_mesh(&Files::of_demo("sphere-tetrahedron", 4).source).unwrap();
    for (factor, shift) in [(1e-90, DVec3::ZERO), (1e80, DVec3::ZERO), (1.0, DVec3::splat(1e9))] {
        let positions = soup.positions.iter().map(|p| *p * factor + shift).collect();
        let far = PolygonSoup { positions, ..soup.clone() };
        let checked = closed_genus_zero(&far).unwrap();
        assert!(!checked.frame.is_the_files());
        let mesh = checked.mesh_in_file();
        for (number, vertex) in checked.vertex_from_file.iter().enumerate() {
            let vertex = vertex.unwrap();
            assert_eq!(mesh.positions()[vertex], far.positions[number]);
            assert!(checked.mesh.positions()[vertex].abs().max_element() < 1100.0);
        }
    }
}
