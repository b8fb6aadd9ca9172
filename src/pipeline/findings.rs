//! Doubts about landmark pairs, before a map is made: found on coarse levels, told as stable JSON.

use super::MapInput;
use crate::landmark_fit::{Finding, Repair, landmark_fit};
use crate::landmarks::Landmarks;
use crate::layout::LandmarkDistances;
use crate::mesh::VertexId;
use crate::mesh::coarsening::Level;
use serde::Serialize;

/// Vertices of the coarse levels, on which distances are measured.
const COARSE_VERTICES: usize = 1500;

/// What is in doubt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FindingKind {
    /// The whole set is mirrored.
    Mirrored,
    /// Two pairs have each other's target.
    Swapped,
    /// One pair is far from where the others want it.
    Misplaced,
}

/// What to do about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RepairKind {
    /// Mirror the target mesh, or exchange left and right in all pairs.
    MirrorTarget,
    /// Exchange the targets of the two pairs.
    Swap,
    /// Look at the pair.
    Check,
}

/// A doubt about landmark pairs. Numbers that a kind does not have are `null`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FindingReport {
    /// What is in doubt.
    pub kind: FindingKind,
    /// The pairs in doubt, 0-based: none (the whole set), two, or one.
    pub pairs: Vec<usize>,
    /// What to do about it.
    pub repair: RepairKind,
    /// One sentence for the user.
    pub sentence: String,
    /// Of mirrored sets: agreement of the orders around the landmarks, from -1 (all reversed) to 1.
    pub agreement: Option<f64>,
    /// Mean misfit of the pairs' distances (absolute log ratio), as it is and repaired.
    pub misfit: Option<[f64; 2]>,
    /// Of misplaced pairs: distance of the target to the best place, in units of the root of the target's area.
    pub distance: Option<f64>,
    /// Of misplaced pairs: the pair whose target is nearest to the best place, 0-based.
    pub near: Option<usize>,
}

impl FindingReport {
    fn new(finding: &Finding, labels: &[String]) -> Self {
        let (repair, pairs) = match finding.repair() {
            Repair::MirrorTarget => (RepairKind::MirrorTarget, Vec::new()),
            Repair::Swap { pairs } => (RepairKind::Swap, pairs.to_vec()),
            Repair::Check { pair } => (RepairKind::Check, vec![pair]),
        };
        let bare = Self {
            kind: FindingKind::Mirrored,
            pairs,
            repair,
            sentence: finding.sentence(labels),
            agreement: None,
            misfit: None,
            distance: None,
            near: None,
        };
        match *finding {
            Finding::Mirrored { agreement } => Self { agreement: Some(agreement), ..bare },
            Finding::Swapped { misfit, .. } => {
                Self { kind: FindingKind::Swapped, misfit: Some(misfit), ..bare }
            }
            Finding::Misplaced { misfit, distance, near, .. } => Self {
                kind: FindingKind::Misplaced,
                misfit: Some(misfit),
                distance: Some(distance),
                near: Some(near),
                ..bare
            },
        }
    }
}

/// Landmark pairs that do not fit; none when all do. `labels` are the pairs' names, where they have any.
///
/// A doubt is no error: the map can be made all the same, and the user knows the shapes.
pub fn findings(input: MapInput<'_>, labels: &[String]) -> Vec<FindingReport> {
    let Landmarks { source, target } = input.landmarks;
    let ((source, from), (target, onto)) = (coarse((input.source, source)), coarse((input.target, target)));
    let meshes = [&source.mesh, &target.mesh];
    let landmarks = Landmarks { source: from, target: onto };
    let distances = LandmarkDistances::new(meshes, &landmarks);
    let found = landmark_fit(meshes, &landmarks, &distances);
    found.iter().map(|finding| FindingReport::new(finding, labels)).collect()
}

fn coarse((mesh, landmarks): (&crate::mesh::SurfaceMesh, &[VertexId])) -> (Level, Vec<VertexId>) {
    let level = Level::coarse(mesh, landmarks, COARSE_VERTICES.max(2 * landmarks.len()));
    let numbers = level.numbers(landmarks).collect();
    (level, numbers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo;
    use crate::mesh::mirror::mirrored;
    use crate::pipeline::GroundTruth;

    #[test]
    fn a_demo_fits_its_mirror_image_and_two_exchanged_pairs_do_not() {
        let demo = demo::build("horse-cat").unwrap();
        let found = |target: &crate::mesh::SurfaceMesh, pairs: &[[u32; 2]]| {
            let landmarks = Landmarks::from_vertices(&demo.source, target, pairs).unwrap();
            let (source, ground_truth) = (&demo.source, GroundTruth::Unknown);
            findings(MapInput { source, target, landmarks: &landmarks, ground_truth }, &demo.labels)
        };
        assert_eq!(found(&demo.target, &demo.landmarks), []);

        let reflected = found(&mirrored(&demo.target).unwrap(), &demo.landmarks);
        assert!(reflected.iter().any(|f| f.repair == RepairKind::MirrorTarget && f.agreement < Some(-0.4)));

        let last = demo.landmarks.len() - 1;
        let mut pairs = demo.landmarks.clone();
        (pairs[0][1], pairs[last][1]) = (pairs[last][1], pairs[0][1]);
        let swapped = found(&demo.target, &pairs);
        let json = serde_json::to_value(&swapped).unwrap();
        assert_eq!(json[0]["kind"], "swapped", "{json}");
        assert_eq!((&json[0]["repair"], &json[0]["pairs"]), (&"swap".into(), &vec![0, last].into()));
        assert!(json[0]["sentence"].as_str().unwrap().contains(&demo.labels[0]), "{json}");
    }
}
