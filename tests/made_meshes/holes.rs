//! Tests of meshes with holes: a body and a bent copy, whose true map is known, punched and capped, compared with the closed pair.

use crate::common::farthest_points;
use crate::fixtures;
use conemap::landmarks::Landmarks;
use conemap::mesh::check::CheckedMesh;
use conemap::mesh::repair::{RepairOptions, repaired};
use conemap::mesh::soup::PolygonSoup;
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{CapFaces, GroundTruth, MapInput, MapResult, PipelineOptions, run};

/// A horse and the same horse bent sideways along its length (vertex i corresponds to vertex i), with the hole that one of them gets.
struct Poses {
    horse: SurfaceMesh,
    bent: SurfaceMesh,
    /// Whether each vertex is near the end of a leg, where the hole is made.
    is_gone: Vec<bool>,
    /// The vertices of the rest of the leg.
    beside: Vec<VertexId>,
    /// Vertices far from each other that the hole leaves.
    landmarks: Vec<VertexId>,
}

impl Poses {
    fn new() -> Self {
        let horse = conemap::demo::build("horse-cat").unwrap().source;
        let bent = fixtures::bent(&horse);
        let lowest = horse.positions().iter().copied().reduce(|p, q| if q.y < p.y { q } else { p }).unwrap();
        let is_gone: Vec<bool> = horse.positions().iter().map(|p| p.distance(lowest) < 0.4).collect();
        let landmarks = farthest_points(&horse, 24).into_iter().filter(|v| !is_gone[v.index()]).collect();
        let is_beside = |v: &VertexId| (0.4..0.9).contains(&horse.positions()[*v].distance(lowest));
        let beside = horse.vertices().filter(is_beside).collect();
        Self { horse, bent, is_gone, beside, landmarks }
    }

    /// Whether the hole takes a face, that is, all of its corners.
    fn is_removed(&self, corners: &[VertexId; 3]) -> bool {
        corners.iter().all(|v| self.is_gone[v.index()])
    }

    fn whole(mesh: &SurfaceMesh) -> CheckedMesh {
        capped(mesh, |_| true)
    }

    fn punched(&self, mesh: &SurfaceMesh) -> CheckedMesh {
        capped(mesh, |corners| !self.is_removed(corners))
    }

    fn map(&self, [source, target]: [&CheckedMesh; 2], options: &PipelineOptions) -> MapResult {
        let on = |mesh: &CheckedMesh| -> Vec<VertexId> {
            self.landmarks.iter().map(|v| mesh.vertex_from_file[v.index()].unwrap()).collect()
        };
        let landmarks = Landmarks { source: on(source).into(), target: on(target).into() };
        let input = MapInput {
            source: &source.mesh,
            target: &target.mesh,
            landmarks: &landmarks,
            ground_truth: GroundTruth::Unknown,
            caps: CapFaces { source: source.caps(), target: target.caps() },
        };
        run(input, options, &mut Silent).unwrap()
    }

    /// The mean distance of the images of the rest of the leg from their true places, in units of the root of the area.
    fn error(&self, result: &MapResult, target: &SurfaceMesh) -> f64 {
        let scale = 1.0 / self.bent.area().sqrt();
        let distance = |v: &VertexId| {
            let image = result.target_from_source[*v].unwrap().position(target);
            image.distance(self.bent.positions()[*v]) * scale
        };
        self.beside.iter().map(distance).sum::<f64>() / self.beside.len() as f64
    }
}

/// The mesh of the faces that are kept, with its holes capped.
fn capped(mesh: &SurfaceMesh, is_kept: impl Fn(&[VertexId; 3]) -> bool) -> CheckedMesh {
    let kept = mesh.triangles().iter().filter(|corners| is_kept(corners));
    let soup = PolygonSoup {
        positions: mesh.positions().iter().copied().collect(),
        polygons: kept.map(|corners| corners.map(|v| v.0).to_vec()).collect(),
        joined_with: Vec::new(),
    };
    repaired(&soup, &RepairOptions::default(), &mut Silent).unwrap().checked
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn a_hole_does_not_pull_the_skin_around_it() {
    let poses = Poses::new();
    let (horse, bent) = (Poses::whole(&poses.horse), Poses::whole(&poses.bent));
    let open = poses.punched(&poses.bent);
    let usual = PipelineOptions::default();
    let mut even = usual.clone();
    even.multilevel.cap_weight = 1.0;
    let closed = poses.map([&horse, &bent], &usual);
    let weighted = poses.map([&horse, &open], &usual);
    let pulled = poses.map([&horse, &open], &even);
    for result in [&closed, &weighted, &pulled] {
        assert!(result.report.certificate.as_ref().unwrap().bijective);
    }
    let errors = [
        poses.error(&weighted, &open.mesh),
        poses.error(&closed, &bent.mesh),
        poses.error(&pulled, &open.mesh),
    ];
    assert!(errors[0] < errors[1] + 0.003 && errors[0] < 0.5 * errors[2], "{errors:?}");

    // The skin without a partner is as much as the hole took from the other mesh.
    let removed = poses.horse.faces().filter(|&f| poses.is_removed(&poses.horse.triangles()[f]));
    let share = removed.map(|f| poses.horse.face_area(f)).sum::<f64>() / poses.horse.area();
    assert!((0.01..0.1).contains(&share), "{share}");
    let coverage = weighted.report.coverage.as_ref().unwrap();
    assert!((coverage.source - (1.0 - share)).abs() < 0.002, "{coverage:?} {share}");
    assert!(coverage.target > 0.998, "{coverage:?}");
    assert_eq!(closed.report.coverage, None);
    // The measures leave out skin that is mapped into the cap.
    let [own, whole] = [&weighted, &closed].map(|result| &result.report.distortion);
    assert!(own.energy >= 4.0 && own.energy < 1.01 * whole.energy, "{own:?}");
    let in_cap = weighted.triangle_distortion.iter().filter(|t| open.is_cap(t.target_face));
    let pressed: Vec<f64> = in_cap.map(|t| t.local.density).collect();
    assert!(pressed.iter().sum::<f64>() / pressed.len() as f64 > 5.0 * own.mean, "{own:?}");

    // Exchanged meshes give the inverse map, and so the same shares.
    let back = poses.map([&open, &horse], &usual).report;
    let exchanged = back.coverage.as_ref().unwrap();
    assert!((exchanged.source - coverage.target).abs() < 1e-9, "{exchanged:?} {coverage:?}");
    assert!((exchanged.target - coverage.source).abs() < 1e-9, "{exchanged:?} {coverage:?}");
    assert!((back.distortion.energy / own.energy - 1.0).abs() < 1e-9);
}
