//! Findings before a map is made: doubts about landmark pairs, and limbs without one. They are computed on coarse levels and reported as
//! stable JSON.

use super::MapInput;
use super::landmark_doubts::landmark_doubts;
use crate::landmark_fit::{Finding, MOST_COMPARED, Repair};
use crate::landmark_suggestion::unmarked_limbs;
use crate::landmarks::{LandmarkId, Landmarks, MeshSide};
use crate::mesh::coarsening::Level;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Rising, Stage};
use serde::{Serialize, Serializer};

/// The number of vertices of the coarse levels on which distances between landmarks are measured. Chosen by hand.
pub const FINDINGS_VERTICES: usize = 1500;

/// The kind of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum FindingKind {
    /// The whole set is mirrored.
    Mirrored,
    /// Two pairs have each other's target.
    Swapped,
    /// One pair's target is far from the place that fits the other pairs.
    Misplaced,
    /// Limbs of one mesh have no landmark.
    UnmarkedLimbs,
}

/// The repair that is offered for a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum RepairKind {
    /// Mirror the target mesh, or exchange left and right in all pairs.
    MirrorTarget,
    /// Exchange the targets of the two pairs.
    Swap,
    /// Look at the pair.
    Check,
    /// Add pairs at the ends of the limbs.
    Mark,
}

/// A doubt about landmark pairs. Numbers that a kind does not have are `null`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct FindingReport {
    /// Its kind.
    pub kind: FindingKind,
    /// The pairs in doubt, 0-based: none (the whole set, or limbs), two, or one.
    pub pairs: Vec<usize>,
    /// The repair that is offered.
    pub repair: RepairKind,
    /// One sentence for the user.
    pub sentence: String,
    /// For mirrored sets, the agreement of the orders around the landmarks and of their places, from -1 (all reversed) to 1. For
    /// swapped pairs, the vote of the other landmarks, from -1 (the targets fit exchanged) to 1 (they fit as they are).
    pub agreement: Option<f64>,
    /// Mean misfit of the pairs' distances (absolute log ratio), as it is and repaired.
    pub misfit: Option<[f64; 2]>,
    /// For misplaced pairs, the distance of the target to the best place, in units of the root of the target's area.
    pub distance: Option<f64>,
    /// For misplaced pairs, the pair whose target is nearest to the best place, 0-based.
    pub near: Option<usize>,
    /// For limbs, the mesh, written as a number: 0 the source and 1 the target.
    #[serde(serialize_with = "as_number")]
    #[cfg_attr(all(feature = "web", target_arch = "wasm32"), tsify(type = "0 | 1 | null"))]
    pub side: Option<MeshSide>,
    /// For limbs, their ends as vertices of the mesh, the most remote first.
    pub vertices: Vec<usize>,
}

fn as_number<S: Serializer>(side: &Option<MeshSide>, serializer: S) -> Result<S::Ok, S::Error> {
    side.map(|side| side as usize).serialize(serializer)
}

impl FindingReport {
    fn new(finding: &Finding, labels: &[String]) -> Self {
        let (repair, pairs) = match finding.repair() {
            Repair::MirrorTarget => (RepairKind::MirrorTarget, Vec::new()),
            Repair::Swap { pairs } => (RepairKind::Swap, pairs.map(LandmarkId::index).to_vec()),
            Repair::Check { pair } => (RepairKind::Check, vec![pair.index()]),
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
            side: None,
            vertices: Vec::new(),
        };
        match *finding {
            Finding::Mirrored { agreement } => Self { agreement: Some(agreement), ..bare },
            Finding::Swapped { agreement, misfit, .. } => {
                Self { kind: FindingKind::Swapped, agreement: Some(agreement), misfit: Some(misfit), ..bare }
            }
            Finding::Misplaced { misfit, distance, near, .. } => Self {
                kind: FindingKind::Misplaced,
                misfit: Some(misfit),
                distance: Some(distance),
                near: Some(near.index()),
                ..bare
            },
        }
    }
}

/// The finding of limbs of one mesh without a landmark.
fn limbs(side: MeshSide, vertices: Vec<usize>) -> FindingReport {
    FindingReport {
        kind: FindingKind::UnmarkedLimbs,
        pairs: Vec::new(),
        repair: RepairKind::Mark,
        sentence: limbs_sentence(side, &vertices),
        agreement: None,
        misfit: None,
        distance: None,
        near: None,
        side: Some(side),
        vertices,
    }
}

fn limbs_sentence(side: MeshSide, vertices: &[usize]) -> String {
    match vertices {
        [end] => format!(
            "A limb of the {side} has no landmark: its end is vertex {end}. A pair there may lower the distortion."
        ),
        ends => {
            let ends: Vec<String> = ends.iter().map(usize::to_string).collect();
            format!(
                "{} limbs of the {side} have no landmark: their ends are the vertices {}. Pairs there may lower the \
                 distortion.",
                ends.len(),
                ends.join(", ")
            )
        }
    }
}

impl FindingReport {
    /// The same with other numbers for the vertices of each mesh, such as those of its file.
    #[must_use]
    pub fn renumbered(mut self, number: impl Fn(MeshSide, usize) -> usize) -> Self {
        if let Some(side) = self.side {
            self.vertices.iter_mut().for_each(|v| *v = number(side, *v));
            self.sentence = limbs_sentence(side, &self.vertices);
        }
        self
    }
}

/// Finds landmark pairs that do not fit and limbs without one; none when all is well. `labels` are the pairs' names, where they have any.
///
/// A finding is no error: the map can be made all the same, and the user knows the shapes. With more than
/// [`MOST_COMPARED`] pairs only limbs are searched.
///
/// # Errors
/// [`Cancelled`].
pub fn findings(
    input: MapInput<'_>,
    labels: &[String],
    monitor: &mut dyn Monitor,
) -> Result<Vec<FindingReport>, Cancelled> {
    let monitor = &mut Rising::new(monitor);
    monitor.enter(Stage::Findings);
    let Landmarks { source, target } = input.landmarks;
    let numbers =
        |level: &Level, ends: Vec<VertexId>| ends.iter().map(|&v| level.vertices[v].index()).collect();
    let coarsening = &mut Portion::new(monitor, 0.0, 0.0);
    let levels =
        [coarse(input.source, &source.raw, coarsening)?, coarse(input.target, &target.raw, coarsening)?];
    let landmarks = Landmarks {
        source: levels[0].numbers(source).collect(),
        target: levels[1].numbers(target).collect(),
    };
    let meshes = [&levels[0].mesh, &levels[1].mesh];
    let mut found = Vec::new();
    if landmarks.len() <= MOST_COMPARED && !monitor.wants_result() {
        found = landmark_doubts(meshes, &landmarks, &mut Portion::new(monitor, 0.0, 0.5))?;
    }
    let mut reports: Vec<_> = found.iter().map(|finding| FindingReport::new(finding, labels)).collect();
    if monitor.wants_result() {
        return Ok(reports);
    }
    let marks = [&landmarks.source.raw, &landmarks.target.raw];
    for (side, from) in MeshSide::BOTH.into_iter().zip([0.5, 0.75]) {
        let level = &levels[side];
        let quarter = &mut Portion::new(monitor, from, from + 0.25);
        let ends: Vec<usize> = numbers(level, unmarked_limbs(&level.mesh, marks[side], quarter)?);
        if !ends.is_empty() {
            reports.push(limbs(side, ends));
        }
    }
    Ok(reports)
}

/// The level of a mesh on which its distances are measured.
fn coarse(mesh: &SurfaceMesh, landmarks: &[VertexId], monitor: &mut dyn Monitor) -> Result<Level, Cancelled> {
    Level::coarse(mesh, landmarks, FINDINGS_VERTICES.max(2 * landmarks.len()), monitor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo;
    use crate::mesh::mirror::mirrored;
    use crate::monitor::Silent;

    #[test]
    fn limbs_without_a_landmark_are_named_with_the_numbers_of_the_file() {
        let demo = demo::build("horse-cat").unwrap();
        let is_tail = |k: &usize| demo.labels[*k].starts_with("tail");
        let kept = (0..demo.labels.len()).filter(|k| !is_tail(k)).map(|k| demo.landmarks[k]);
        let pairs: Vec<[u32; 2]> = kept.collect();
        let landmarks = Landmarks::from_vertices(&demo.source, &demo.target, &pairs).unwrap();
        let (source, target) = (&demo.source, &demo.target);
        let input = MapInput::new(source, target, &landmarks);
        let found = findings(input, &[], &mut Silent).unwrap();
        let sides: Vec<_> = found.iter().map(|f| f.side).collect();
        assert_eq!(sides, MeshSide::BOTH.map(Some), "{found:?}");
        assert_eq!(serde_json::to_value(&found).unwrap()[1]["side"], 1);
        let tail = (0..demo.labels.len()).find(is_tail).unwrap();
        for (finding, mesh) in found.iter().zip([source, target]) {
            let side = finding.side.unwrap();
            assert_eq!((finding.kind, finding.repair), (FindingKind::UnmarkedLimbs, RepairKind::Mark));
            let [end] = finding.vertices[..] else { panic!("{found:?}") };
            let place = |v: usize| mesh.positions()[VertexId::from(v)];
            assert!(place(end).distance(place(demo.landmarks[tail][side] as usize)) < 0.25, "{found:?}");
            let given = finding.clone().renumbered(|side, v| 10 * v + side as usize);
            assert!(given.sentence.contains(&format!("vertex {}.", 10 * end + side as usize)), "{given:?}");
        }
    }

    #[test]
    fn a_demo_fits_its_mirror_image_and_two_exchanged_pairs_do_not() {
        let demo = demo::build("horse-cat").unwrap();
        let found = |target: &crate::mesh::SurfaceMesh, pairs: &[[u32; 2]]| {
            let landmarks = Landmarks::from_vertices(&demo.source, target, pairs).unwrap();
            let input = MapInput::new(&demo.source, target, &landmarks);
            findings(input, &demo.labels, &mut Silent).unwrap()
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

    /// The horns of the cow have no landmark.
    #[test]
    fn landmarks_of_all_demos_fit() {
        for demo::DemoInfo { id, .. } in demo::list() {
            let demo = demo::build(id).unwrap();
            let landmarks = Landmarks::from_vertices(&demo.source, &demo.target, &demo.landmarks).unwrap();
            let input = MapInput::new(&demo.source, &demo.target, &landmarks);
            let found = findings(input, &demo.labels, &mut Silent).unwrap();
            assert!(found.iter().all(|f| f.kind == FindingKind::UnmarkedLimbs), "{id}: {found:?}");
        }
    }
}
