//! Checks of the findings about landmarks that do not fit each other, on coarse meshes.
#![allow(dead_code, reason = "every test binary uses another part")]

use crate::theorems;
use conemap::landmark_fit::{Finding, Repair};
use conemap::landmarks::{LandmarkId, Landmarks};
use conemap::layout::LandmarkDistances;
use conemap::mesh::coarsening::Level;
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::landmark_doubts;
use glam::DVec3;

/// Two coarse meshes with landmarks.
pub struct Case {
    pub name: String,
    pub source: SurfaceMesh,
    pub target: SurfaceMesh,
    pub landmarks: Landmarks,
}

impl Case {
    pub fn of(case: &theorems::Case) -> Self {
        let (source, from) = coarse(&case.source, &case.landmarks.source.raw);
        let (target, onto) = coarse(&case.target, &case.landmarks.target.raw);
        Self {
            name: case.name.clone(),
            source,
            target,
            landmarks: Landmarks { source: from.into(), target: onto.into() },
        }
    }

    pub fn findings(&self, landmarks: &Landmarks) -> Vec<Finding> {
        landmark_doubts([&self.source, &self.target], landmarks, &mut Silent).expect("nobody stops")
    }
}

fn coarse(mesh: &SurfaceMesh, held: &[VertexId]) -> (SurfaceMesh, Vec<VertexId>) {
    let level = Level::coarse(mesh, held, 800, &mut Silent).expect("nobody stops");
    let number =
        |v: &VertexId| level.vertices.iter().position(|w| w == v).expect("landmarks are kept").into();
    let numbers = held.iter().map(number).collect();
    (level.mesh, numbers)
}

/// The mirror image of a mesh, with its faces turned so that they look outwards again.
pub fn mirrored(mesh: &SurfaceMesh) -> SurfaceMesh {
    let positions = mesh.positions().iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect();
    let faces = mesh.triangles().iter().map(|&[a, b, c]| [a, c, b]).collect();
    SurfaceMesh::from_triangles(positions, faces).expect("the same connectivity")
}

/// The pairs of landmarks whose targets the findings propose to exchange.
pub fn swaps(findings: &[Finding]) -> Vec<[usize; 2]> {
    let swap = |finding: &Finding| match finding.repair() {
        Repair::Swap { pairs } => Some(pairs.map(LandmarkId::index)),
        _ => None,
    };
    findings.iter().filter_map(swap).collect()
}

/// Checks that landmarks that fit raise no alarm, and that those of the target's mirror image raise the alarm that the set is mirrored.
pub fn only_the_mirror_image_raises_an_alarm(case: Case) {
    let findings = case.findings(&case.landmarks);
    assert!(findings.is_empty(), "{}: {findings:?}", case.name);
    let reflected = Case { target: mirrored(&case.target), ..case };
    let findings = reflected.findings(&reflected.landmarks);
    assert!(findings.iter().any(|f| f.repair() == Repair::MirrorTarget), "{}", reflected.name);
    let agreement = findings.iter().find_map(|finding| match finding {
        Finding::Mirrored { agreement } => Some(*agreement),
        _ => None,
    });
    assert!(agreement.is_some_and(|a| a < -0.5), "{}: {agreement:?}", reflected.name);
}

/// Checks that of some exchanged targets that lie apart nine in ten are named, and no other pairs.
pub fn exchanged_targets_are_named(case: &Case) {
    let (name, n) = (&case.name, case.landmarks.len());
    let distances = LandmarkDistances::new([&case.source, &case.target], &case.landmarks, &mut Silent)
        .expect("nobody stops");
    let (mut found, mut tried) = (0, 0);
    for (a, b) in (0..n).flat_map(|a| (0..a).map(move |b| (a, b))) {
        if (a * 7 + b * 3) % 11 != 0 || distances.between([a, b].map(LandmarkId::from))[1] < 0.3 {
            continue;
        }
        let mut landmarks = case.landmarks.clone();
        landmarks.target.raw.swap(a, b);
        let swaps = swaps(&case.findings(&landmarks));
        assert!(swaps.iter().all(|pairs| *pairs == [b, a]), "{name}: {swaps:?} for {b} and {a}");
        tried += 1;
        found += usize::from(!swaps.is_empty());
    }
    assert!(tried >= 10 && found * 10 >= tried * 9, "{name}: {found} of {tried}");
}
