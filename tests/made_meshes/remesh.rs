//! Tests of remeshing: counts, shapes, distances, sharp edges, and points carried to the new mesh.

use crate::other_triangles::{cut_by_planes, drawn_out};
use crate::remeshing::remeshed;
use conemap::mesh::check::closed_genus_zero;
use conemap::mesh::generators::{icosphere, midpoint_subdivision, octahedron, torus};
use conemap::mesh::soup::PolygonSoup;
use conemap::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::{Cancelled, Monitor, Silent, Stage, Step};
use conemap::remesh::{EdgeLengths, Error, Noise, Options, Remeshed, carried, decimated, perturbed, remesh};
use glam::DVec3;

/// The cube of side 2 as 12 triangles.
fn cube() -> SurfaceMesh {
    let sign = |bit: u32, k: u32| if bit >> k & 1 == 1 { 1.0 } else { -1.0 };
    let soup = PolygonSoup {
        positions: (0..8).map(|b| DVec3::new(sign(b, 0), sign(b, 1), sign(b, 2))).collect(),
        polygons: [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
            .map(Vec::from)
            .into(),
        ..PolygonSoup::default()
    };
    closed_genus_zero(&soup).unwrap().mesh
}

/// A ball with a bump, given with very uneven triangles.
fn uneven() -> SurfaceMesh {
    let ball = icosphere(4);
    let pulled = |p: &DVec3| {
        // The vertices are projected from another point onto the sphere, which gives triangles of all sizes.
        let place = (*p + DVec3::new(0.1, 0.6, -0.2)).normalize();
        place * (1.0 + 0.05 / (0.15 + (place - DVec3::X).length_squared()))
    };
    ball.with_positions(ball.positions().iter().map(pulled).collect())
}

#[test]
fn round_surfaces_get_even_triangles_at_every_size() {
    let surfaces = [("ball", icosphere(4)), ("torus", torus(60, 30)), ("uneven", uneven())];
    for (name, surface) in &surfaces {
        for faces in [400, 1500, 2 * surface.face_count()] {
            let name = format!("{name} {faces}");
            let report = remeshed(&name, surface, &Options::to_faces(faces)).report;
            let edges = report.edge_length;
            assert!(edges.deviation < 0.15 * edges.mean, "{name}: {report:?}");
            assert!(report.mean_min_angle > 48.0 && report.min_angle > 20.0, "{name}: {report:?}");
            // The bound is the sagitta of a chord of the length of an edge, on a circle of radius 0.5.
            let sagitta = 0.25 * edges.mean * edges.mean + 0.02 * edges.mean;
            let distance = report.distance;
            assert!(distance.to_original.max(distance.from_original) < 3.0 * sagitta, "{name}: {report:?}");
        }
    }
}

#[test]
fn a_cube_keeps_its_edges_and_corners() {
    for faces in [150, 900, 5000] {
        let Remeshed { mesh, report } = remeshed("cube", &cube(), &Options::to_faces(faces));
        assert!((mesh.area() - 24.0).abs() < 1e-9, "{faces}: {}", mesh.area());
        assert!(report.distance.from_original < 1e-9 && report.distance.to_original < 1e-9, "{report:?}");
        assert!(report.min_angle > 15.0, "{faces}: {report:?}");
        let corners = cube().positions().iter().filter(|c| mesh.positions().contains(c)).count();
        assert_eq!(corners, 8);
    }
    // Without creases the sharp edges of the cube are not kept.
    let options = Options { crease_angle: std::f64::consts::PI, ..Options::to_faces(900) };
    assert!(remeshed("smooth cube", &cube(), &options).report.distance.from_original > 1e-3);
}

#[test]
fn a_thin_limb_keeps_its_end() {
    // The spike is ten edges long and a fifth of an edge thick.
    let ball = icosphere(5);
    let spiked = |p: &DVec3| {
        let along = ((p.y - 0.995) / 0.005).clamp(0.0, 1.0);
        *p * if p.y > 0.995 { DVec3::new(0.3, 1.0 + along, 0.3) } else { DVec3::ONE }
    };
    let spike = ball.with_positions(ball.positions().iter().map(spiked).collect());
    let Remeshed { mesh, report } = remeshed("spike", &spike, &Options::to_faces(2000));
    let highest = mesh.positions().iter().map(|p| p.y).fold(0.0, f64::max);
    assert!(highest > 1.99, "{highest}");
    assert!(report.distance.from_original < 1.5 * report.edge_length.mean, "{report:?}");
}

#[test]
fn the_same_mesh_comes_out_again() {
    let surface = uneven();
    let [first, second] = [0, 1].map(|_| remeshed("uneven", &surface, &Options::to_faces(1000)));
    assert_eq!(first.mesh.positions(), second.mesh.positions());
    assert_eq!(first.mesh.triangles(), second.mesh.triangles());
    assert_eq!(first.report, second.report);
}

#[test]
fn units_do_not_matter() {
    let surface = uneven();
    let larger = surface.with_positions(surface.positions().iter().map(|p| *p * 1024.0).collect());
    let [first, second] = [&surface, &larger].map(|s| remeshed("uneven", s, &Options::to_faces(1000)));
    assert_eq!(first.mesh.triangles(), second.mesh.triangles());
}

#[test]
fn too_few_faces_are_refused() {
    for faces in [0, 3] {
        let error = remesh(&icosphere(2), &Options::to_faces(faces), &mut Silent).unwrap_err();
        assert_eq!(error, Error::TooFewFaces { wanted: faces, reached: 4 });
    }
    // No torus has fewer than 14 triangles.
    let error = remesh(&torus(20, 10), &Options::to_faces(8), &mut Silent).unwrap_err();
    assert!(matches!(error, Error::TooFewFaces { wanted: 8, reached: 14.. }), "{error:?}");
}

#[test]
fn few_rounds_do_not_converge() {
    let options = Options { max_rounds: 0, ..Options::to_faces(5000) };
    let error = remesh(&icosphere(2), &options, &mut Silent).unwrap_err();
    assert_eq!(error, Error::NotConverged { wanted: 5000, reached: 320, rounds: 0 });
}

/// A monitor that stops after some steps.
struct Impatient {
    steps: usize,
    entered: Vec<Stage>,
    fractions: Vec<f64>,
}

impl Monitor for Impatient {
    fn enter(&mut self, stage: Stage) {
        self.entered.push(stage);
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        self.fractions.push(step.fraction);
        if self.fractions.len() == self.steps { Err(Cancelled) } else { Ok(()) }
    }
}

#[test]
fn progress_is_told_and_a_wish_to_stop_is_heard() {
    let run = |steps| {
        let mut monitor = Impatient { steps, entered: Vec::new(), fractions: Vec::new() };
        let outcome = remesh(&icosphere(2), &Options::to_faces(300), &mut monitor);
        assert_eq!(monitor.entered, [Stage::Remeshing]);
        (outcome, monitor.fractions)
    };
    let (outcome, fractions) = run(usize::MAX);
    assert!(outcome.is_ok());
    assert!(fractions.is_sorted() && fractions.iter().all(|f| (0.0..=1.0).contains(f)), "{fractions:?}");
    for steps in [1, 5, fractions.len()] {
        let (outcome, told) = run(steps);
        assert!(matches!(outcome, Err(Error::Cancelled(_))));
        assert_eq!(told.len(), steps);
    }
}

#[test]
fn points_carry_over() {
    let surface = uneven();
    let vertices: Vec<_> = surface.vertices().map(|v| SurfacePoint::at_vertex(&surface, v)).collect();
    let fine = midpoint_subdivision(&surface);
    for (point, image) in vertices.iter().zip(carried(&surface, &fine, &vertices)) {
        assert!(point.position(&surface).distance(image.position(&fine)) < 1e-12);
    }
    let Remeshed { mesh, report } = remeshed("uneven", &surface, &Options::to_faces(1500));
    for (point, image) in vertices.iter().zip(carried(&surface, &mesh, &vertices)) {
        assert!(image.barycentric.iter().all(|w| *w >= 0.0));
        let apart = point.position(&surface).distance(image.position(&mesh));
        assert!(apart <= report.distance.from_original + 1e-12, "{apart}");
    }
}

#[test]
fn variants_are_other_meshes_of_the_surface() {
    let ball = icosphere(3);
    let coarse = decimated(&ball, 400);
    assert_eq!(coarse.face_count(), 400);
    assert!(coarse.positions().iter().all(|p| ball.positions().contains(p)));
    let noise = Noise { tangential: 0.2, normal: 0.0, seed: 1 };
    let noisy = perturbed(&ball, noise);
    assert_eq!(noisy.positions(), perturbed(&ball, noise).positions());
    assert_ne!(noisy.positions(), perturbed(&ball, Noise { seed: 2, ..noise }).positions());
    assert_eq!(noisy.triangles(), ball.triangles());
    let mean = EdgeLengths::of(&ball).mean;
    for v in ball.vertices() {
        let step: DVec3 = noisy.positions()[v] - ball.positions()[v];
        // The steps lie in the tangent plane of the vertex.
        assert!(step.length() < 0.2 * 2.0_f64.sqrt() * 1.2 * mean);
        assert!(step.dot(ball.positions()[v]).abs() < 0.02 * mean);
    }
    let rough = perturbed(&ball, Noise { tangential: 0.0, normal: 0.1, seed: 1 });
    let radius = |v: VertexId| rough.positions()[v].length();
    assert!(ball.vertices().any(|v| (radius(v) - 1.0).abs() > 0.05 * mean));
    assert!(ball.vertices().all(|v| (radius(v) - 1.0).abs() < 0.12 * mean));
}

#[test]
fn planes_cut_the_same_surface_into_slivers() {
    let ball = icosphere(3);
    let cut = cut_by_planes(&ball, 0.17);
    assert_eq!(cut.euler_characteristic(), 2);
    assert!(cut.face_count() > 2 * ball.face_count(), "{}", cut.face_count());
    // Every part looks the same way as the triangle it was cut from: areas add up, and so do volumes.
    assert!((cut.area() - ball.area()).abs() < 1e-12);
    let volume = |mesh: &SurfaceMesh| {
        mesh.faces().map(|f| mesh.corners(f)).map(|[p, q, r]| p.dot(q.cross(r)) / 6.0).sum::<f64>()
    };
    assert!((volume(&cut) - volume(&ball)).abs() < 1e-12);
    let shortest = |mesh: &SurfaceMesh| mesh.edges().map(|h| mesh.length(h)).fold(f64::INFINITY, f64::min);
    assert!(shortest(&cut) < 0.01 * shortest(&ball), "{}", shortest(&cut));
    // No triangle crosses a plane any more.
    assert_eq!(cut_by_planes(&cut, 0.17).face_count(), cut.face_count());
}

#[test]
fn a_body_cut_into_slivers_is_coarsened_to_good_triangles() {
    let ball = icosphere(4);
    let long = ball.with_positions(ball.positions().iter().map(|p| *p * DVec3::new(1.0, 2.5, 0.8)).collect());
    let cut = cut_by_planes(&long, 2.0 * EdgeLengths::of(&long).mean);
    let share = |mesh: &SurfaceMesh| {
        let is_sliver = |[p, q, r]: [DVec3; 3]| {
            let longest = p.distance_squared(q).max(q.distance_squared(r)).max(r.distance_squared(p));
            (q - p).cross(r - p).length() < 0.05 * longest
        };
        mesh.faces().filter(|&f| is_sliver(mesh.corners(f))).count() as f64 / mesh.face_count() as f64
    };
    assert!(share(&cut) > 0.05, "{}", share(&cut));
    for faces in [4000, 1000, 400] {
        let coarse = decimated(&cut, faces);
        assert_eq!(coarse.face_count(), faces);
        assert!(share(&coarse) < 0.01, "{faces}: {}", share(&coarse));
    }
}

#[test]
fn triangles_are_drawn_out_along_the_longest_axis() {
    let ball = icosphere(4);
    let long = ball.with_positions(ball.positions().iter().map(|p| *p * DVec3::new(1.0, 2.0, 1.0)).collect());
    let mesh = drawn_out(&long, 2000, 5.0);
    assert!((mesh.face_count() as f64 / 2000.0 - 1.0).abs() < 0.05, "{}", mesh.face_count());
    let reach = |axis: usize| {
        mesh.edges()
            .map(|h| (mesh.positions()[mesh.head(h)] - mesh.positions()[mesh.tail(h)])[axis].abs())
            .sum::<f64>()
    };
    assert!(reach(1) > 2.5 * reach(0) && reach(1) > 2.5 * reach(2), "{} {} {}", reach(0), reach(1), reach(2));
}

#[cfg(not(target_arch = "wasm32"))]
mod properties {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

        /// For any body with noise on it, at any size, the checks of every result pass.
        #[test]
        fn every_result_is_a_mesh_of_the_surface(
            axes in [0.2_f64..2.0, 0.2_f64..2.0, 0.2_f64..2.0],
            noise in 0.0_f64..0.6,
            seed in any::<u64>(),
            faces in 200_usize..3000,
            which in 0_usize..3,
        ) {
            let body = [icosphere(3), torus(24, 12), midpoint_subdivision(&midpoint_subdivision(&octahedron()))];
            let scaled = body[which].positions().iter().map(|p| *p * DVec3::from(axes)).collect();
            let noise = Noise { tangential: noise, normal: 0.3 * noise, seed };
            let surface = perturbed(&body[which].with_positions(scaled), noise);
            remeshed(&format!("{axes:?} {noise:?} {faces} {which}"), &surface, &Options::to_faces(faces));
        }
    }
}
