//! Tests of wrapping: bases with quads, texture coordinates, colours, loose parts and a hole are laid onto scans with a lost leg and in
//! another scale.

use crate::job::{Files, run};
use crate::quads::obj_with_quads;
use conemap::demo;
use conemap::export::obj;
use conemap::io::read_mesh;
use conemap::job::{Normals, WrapFileError, WrappedFile};
use conemap::mesh::generators::icosphere;
use conemap::mesh::{FaceId, SurfaceMesh};
use conemap::monitor::{Cancelled, Monitor, Silent, Stage, Step};
use conemap::pipeline::{Choices, PipelineOptions};
use glam::DVec3;
use std::fmt::Write;

/// Whether the middle of a face is not within a radius of the lowest vertex, the end of a leg.
fn without_leg(mesh: &SurfaceMesh, radius: f64) -> impl Fn(FaceId) -> bool + '_ {
    let lowest = mesh.positions().iter().copied().reduce(|p, q| if q.y < p.y { q } else { p }).unwrap();
    move |f| mesh.corners(f).into_iter().sum::<DVec3>().distance(3.0 * lowest) > 3.0 * radius
}

/// The file with an eye beside the base, and a vertex without a face.
fn with_loose_parts(mut text: String, vertices: usize, middle: DVec3) -> String {
    let eye = icosphere(1);
    for p in eye.positions() {
        let p = middle + *p * 0.05;
        writeln!(text, "v {} {} {}", p.x, p.y, p.z).unwrap();
    }
    writeln!(text, "v 0 0 0\ng eye").unwrap();
    for t in eye.triangles() {
        let [a, b, c] = t.map(|v| v.index() + vertices + 1);
        writeln!(text, "f {a} {b} {c}").unwrap();
    }
    text
}

/// The lines of a file other than those of vertices, each with its line end.
fn other_lines(text: &[u8]) -> Vec<&[u8]> {
    text.split_inclusive(|b| *b == b'\n').filter(|line| !line.starts_with(b"v ")).collect()
}

/// A monitor that keeps whether the stage of wrapping was reported, and its fractions.
#[derive(Default)]
struct Watch {
    is_wrapping: bool,
    fractions: Vec<f64>,
}

impl Monitor for Watch {
    fn enter(&mut self, stage: Stage) {
        self.is_wrapping = stage == Stage::Wrapping;
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        self.fractions.push(step.fraction);
        Ok(())
    }
}

#[test]
fn a_base_keeps_its_lines_and_lies_on_the_scan() {
    let demo = demo::build("horse-cat").unwrap();
    let (base, scan) = (&demo.source, &demo.target);
    let mut files = Files::of_demo("horse-cat", usize::MAX);
    // The base has a hole at its back, and the scan has lost a foot; a landmark lies at each.
    let top = base.positions().iter().copied().reduce(|p, q| if q.y > p.y { q } else { p }).unwrap();
    let has_face = |f: FaceId| base.corners(f)[0].distance(top) > 0.15;
    let text = String::from_utf8(obj_with_quads(base, has_face)).unwrap();
    files.source = with_loose_parts(text, base.vertex_count(), top).into_bytes();
    let own = |p: &DVec3| DVec3::new(40.0 * p.x + 7.0, 40.0 * p.y, 40.0 * p.z - 100.0);
    let places: Vec<DVec3> = scan.positions().iter().map(own).collect();
    let is_left = without_leg(scan, 0.25);
    let left = scan.triangles().iter_enumerated().filter(|(f, _)| is_left(*f));
    files.target = obj::polygons(&places, left.map(|(_, corners)| corners.map(|v| v.0)));
    let kept: Vec<_> = demo
        .landmarks
        .iter()
        .filter(|[v, w]| {
            let [v, w] = [*v, *w].map(conemap::mesh::VertexId);
            base.star(v).any(|h| has_face(h.face())) && scan.star(w).any(|h| is_left(h.face()))
        })
        .copied()
        .collect();
    files.set_landmarks(&kept);

    let (job, result) = run(&files, &PipelineOptions::default(), &mut Silent);
    assert!(result.report.certificate.as_ref().is_some_and(|c| c.bijective));
    let map = job.map_file(&result, &Choices::default()).unwrap();
    let taken = job.taken(&map);
    let mut watch = Watch::default();
    let wrapped = taken.wrapped(&files.source, Normals::Kept, &mut watch).unwrap();
    assert!(watch.is_wrapping && watch.fractions.is_sorted() && watch.fractions.iter().all(|f| *f <= 1.0));

    assert_eq!(other_lines(&wrapped.bytes), other_lines(&files.source));
    assert!(String::from_utf8_lossy(&wrapped.bytes).contains("  0.5 0.25 0.3\n"), "colours stay");
    let written = read_mesh(&wrapped.bytes).unwrap();
    assert_eq!(written.positions, wrapped.positions);
    assert_lies_on_scan(&wrapped, base.vertex_count());
    let eye = &wrapped.positions[base.vertex_count()..base.vertex_count() + 42];
    let middle = eye.iter().sum::<DVec3>() / 42.0;
    let radius = eye[0].distance(middle);
    assert!(eye.iter().all(|p| (p.distance(middle) / radius - 1.0).abs() < 1e-9), "the eye is a ball");
    assert!((0.5..6.0).contains(&radius), "in the scan's size: {radius}");

    let again = taken.wrapped(&files.source, Normals::Kept, &mut Silent).unwrap();
    assert_eq!(again.bytes, wrapped.bytes);
    let other = taken.wrapped(&files.target, Normals::Kept, &mut Silent).unwrap_err();
    assert_eq!(other, WrapFileError::OtherFile);
}

fn assert_lies_on_scan(wrapped: &WrappedFile, vertices: usize) {
    let report = &wrapped.report;
    let surface = &report.surface;
    assert_eq!((surface.flipped_triangles, report.flipped.len()), (0, 0));
    for figures in [surface.distance.to_scan, surface.distance.from_scan] {
        assert!(figures.mean < 0.003 && figures.p95 < 0.01 && figures.max < 0.2, "{report:?}");
    }
    // The lost foot is extended as a foot, about as far below the body as the others.
    assert!(surface.extended > 5 && surface.covered > 0.9 && surface.covered < 0.999, "{surface:?}");
    // The vertices are counted by the numbers of the file, several of which may be one vertex of the surface.
    assert!(report.extended_vertices.len() >= surface.extended, "{surface:?}");
    assert_eq!(report.loose_vertices, wrapped.laid.iter().filter(|laid| laid.is_none()).count());
    assert!(report.loose_vertices >= 43 && wrapped.laid[vertices..].iter().all(Option::is_none));
    let lowest = |of: &mut dyn Iterator<Item = usize>| {
        of.map(|v| wrapped.positions[v].y).fold(f64::INFINITY, f64::min)
    };
    let feet = [
        lowest(&mut report.extended_vertices.iter().copied()),
        lowest(&mut (0..vertices).filter(|v| wrapped.laid[*v] == Some(conemap::wrap::Laid::OnScan))),
    ];
    assert!((feet[0] - feet[1]).abs() < 12.0, "{feet:?}");
    let quads = report.quads.unwrap();
    assert!(quads.count > 500 && quads.largest_before <= 150.0 && quads.largest < 360.0, "{quads:?}");
    assert!(report.has_old_normals);
}
