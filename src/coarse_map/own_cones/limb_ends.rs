//! Ends of limbs without a landmark, on both bodies: a tail, a horn, an ear.
//!
//! A limb without a landmark has nothing that leads it to its partner: a map may end beside it and squeeze it into a dent. Its end is a point
//! that both bodies have, and its distances to the landmarks tell which one.

use super::own_points::OwnPair;
use crate::coarse_map::LandmarkedMesh;
use crate::coarse_map::multilevel::LevelImages;
use crate::geodesic::ManyDistances;
use crate::landmark_suggestion::tips;
use crate::landmarks::MeshSide;
use crate::math::scalar::{ln, min};
use crate::mesh::{SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion};

/// Least distance of an end from all landmarks, and from other ends; the area is 1. That of the ears of animals from their eyes is 0.1 and
/// more; with 0.06 the same ends are paired on 28 pairs of animals.
const APART: f64 = 0.08;

/// Ends are paired where the log ratios of their distances to the landmarks have a root mean square below this: on 28 pairs of animals those
/// of ends that are each the best for the other are 0.04 to 0.43, then 0.60 to 1.05. A wrong pair raises the mean log density and is refused.
const FITS: f64 = 0.5;

/// Added to distances before their ratio is taken, so that less than a coarse edge at a near landmark says little; the area is 1. Chosen by
/// hand.
const SOFTENING: f64 = 0.02;

/// An end of a limb of a level.
struct End {
    vertex: VertexId,
    /// Distances to all landmarks; the area is 1.
    to_landmarks: Vec<f64>,
}

impl End {
    /// The distance to the nearest landmark.
    fn apart(&self) -> f64 {
        self.to_landmarks.iter().copied().fold(f64::INFINITY, min)
    }

    /// Root mean square of the log ratios of the distances to the landmarks.
    fn misfit(&self, other: &Self) -> f64 {
        let both = self.to_landmarks.iter().zip(&other.to_landmarks);
        let square = |(a, b): (&f64, &f64)| {
            let log_ratio = ln((a + SOFTENING) / (b + SOFTENING));
            log_ratio * log_ratio
        };
        (both.map(square).sum::<f64>() / self.to_landmarks.len() as f64).sqrt()
    }
}

/// Ends of limbs without a landmark on the coarse levels of both meshes.
pub(super) struct LimbEnds([Vec<End>; 2]);

impl LimbEnds {
    /// The most remote ends, at most `most` on each mesh.
    pub(super) fn find(
        full: &[LandmarkedMesh; 2],
        present: &LevelImages,
        most: usize,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let source = ends(MeshSide::Source, full, present, most, monitor)?;
        Ok(Self([source, ends(MeshSide::Target, full, present, most, monitor)?]))
    }

    /// The ends that fit each other best: those farthest from all landmarks first.
    pub(super) fn pairs(&self, full: &[LandmarkedMesh; 2], present: &LevelImages) -> Vec<OwnPair> {
        let Self([source, target]) = self;
        let best = |of: &End, others: &[End]| {
            let misfits = others.iter().map(|other| of.misfit(other)).enumerate();
            misfits.min_by(|a, b| a.1.total_cmp(&b.1))
        };
        let partner = |s: usize| {
            let (t, misfit) = best(&source[s], target)?;
            let (back, _) = best(&target[t], source)?;
            (back == s && misfit < FITS).then(|| (min(source[s].apart(), target[t].apart()), s, t))
        };
        let mut found: Vec<(f64, usize, usize)> = (0..source.len()).filter_map(partner).collect();
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let on_mesh = |side: MeshSide, end: &End| present.levels[side].vertices[end.vertex];
        let pair = |&(_, s, t): &(f64, usize, usize)| OwnPair {
            source: on_mesh(MeshSide::Source, &source[s]),
            target: SurfacePoint::at_vertex(
                &full[MeshSide::Target].refined.mesh,
                on_mesh(MeshSide::Target, &target[t]),
            ),
        };
        found.iter().map(pair).collect()
    }

    /// The number of ends that are farther than `distance` from all landmarks: that of the mesh with fewer. The area is 1.
    pub(super) fn unmarked(&self, distance: f64) -> usize {
        let remote = |ends: &Vec<End>| ends.iter().filter(|end| end.apart() > distance).count();
        let [source, target] = self.0.each_ref().map(remote);
        source.min(target)
    }
}

/// The ends of limbs of a level that are skin and lie apart from all landmarks, at most `most`: the most remote.
fn ends(
    side: MeshSide,
    full: &[LandmarkedMesh; 2],
    present: &LevelImages,
    most: usize,
    monitor: &mut dyn Monitor,
) -> Result<Vec<End>, Cancelled> {
    let level = &present.levels[side];
    let weights = &present.weights()[side];
    let root = level.mesh.area().sqrt();
    let landmarks = present.landmarks_of(side, &full[side]);
    let distances = ManyDistances::on(&level.mesh);
    let mut found = Vec::new();
    for vertex in tips(&level.mesh, APART * root, &mut Portion::new(monitor, 0.0, 0.0))? {
        if found.len() == most {
            break;
        }
        let field = distances.to(vertex);
        let end = End { vertex, to_landmarks: landmarks.iter().map(|&l| field[l] / root).collect() };
        if end.apart() > APART && weights.is_on_skin(&level.mesh, vertex) {
            found.push(end);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo;
    use crate::mesh::SurfaceMesh;
    use crate::mesh::coarsening::Level;
    use crate::monitor::Silent;
    use glam::DVec3;
    use typed_index_collections::TiVec;

    /// Both meshes with these landmarks, and their coarse levels.
    fn with_levels(
        meshes: [&SurfaceMesh; 2],
        landmarks: [&[VertexId]; 2],
    ) -> ([LandmarkedMesh; 2], LevelImages) {
        let full = [0, 1].map(|k| LandmarkedMesh::new(meshes[k], landmarks[k]).unwrap());
        let level = |k: usize| {
            let full: &LandmarkedMesh = &full[k];
            Level::coarse(&full.refined.mesh, &full.landmarks.raw, 600, &mut Silent).unwrap()
        };
        let landmarks = full.each_ref().map(|full| full.landmarks.raw.as_slice());
        let present = LevelImages::of_skin([level(0), level(1)], TiVec::new()).with_landmarks(landmarks);
        (full, present)
    }

    /// The places of the pairs that are found with these landmarks, on both meshes scaled to area 1.
    fn found(meshes: [&SurfaceMesh; 2], landmarks: [&[VertexId]; 2]) -> Vec<[DVec3; 2]> {
        let (full, present) = with_levels(meshes, landmarks);
        let pairs = LimbEnds::find(&full, &present, 12, &mut Silent).unwrap().pairs(&full, &present);
        let [source, target] = full.each_ref().map(|full| &full.refined.mesh);
        pairs.iter().map(|pair| [source.positions()[pair.source], pair.target.position(target)]).collect()
    }

    #[test]
    fn ends_whose_landmarks_were_taken_away_are_partners_again() {
        let demo = demo::build("horse-cat").unwrap();
        let meshes = [&demo.source, &demo.target];
        let all = [0, 1].map(|k| demo.landmarks.iter().map(|pair| VertexId(pair[k])).collect::<Vec<_>>());
        assert!(found(meshes, all.each_ref().map(Vec::as_slice)).is_empty());
        for gone in ["tail tip", "left hind foot", "right fore foot"] {
            let k = demo.labels.iter().position(|label| label == gone).unwrap();
            let mut kept = all.clone();
            kept.iter_mut().for_each(|kept| {
                kept.remove(k);
            });
            let pairs = found(meshes, kept.each_ref().map(Vec::as_slice));
            assert_eq!(pairs.len(), 1, "{gone}: {pairs:?}");
            for side in 0..2 {
                let place = meshes[side].positions()[all[side][k]] / meshes[side].area().sqrt();
                let off = pairs[0][side].distance(place);
                assert!(off < 0.06, "{gone} is {off} away on mesh {side}");
            }
        }
    }

    #[test]
    fn an_end_that_has_a_landmark_on_one_body_only_is_left() {
        let demo = demo::build("horse-cat").unwrap();
        let tail = demo.labels.iter().position(|label| label == "tail tip").unwrap();
        let side = |k: usize| demo.landmarks.iter().map(move |pair| VertexId(pair[k]));
        let without: Vec<VertexId> =
            side(0).enumerate().filter(|(k, _)| *k != tail).map(|(_, v)| v).collect();
        // The target's landmark at the belly is missing in place of that at its tail.
        let belly = demo.labels.iter().position(|label| label == "belly").unwrap();
        let with: Vec<VertexId> = side(1).enumerate().filter(|(k, _)| *k != belly).map(|(_, v)| v).collect();
        assert!(found([&demo.source, &demo.target], [&without, &with]).is_empty());
    }

    #[test]
    fn ends_far_from_all_landmarks_are_counted_on_the_mesh_with_fewer() {
        let demo = demo::build("horse-cat").unwrap();
        let meshes = [&demo.source, &demo.target];
        let only = |names: &[&str], side: usize| {
            let kept = |name: &&str| demo.labels.iter().position(|label| label == name).unwrap();
            names.iter().map(|name| VertexId(demo.landmarks[kept(name)][side])).collect::<Vec<_>>()
        };
        let trunk = ["nose", "withers", "croup", "chest", "belly", "left flank"];
        let feet = ["left fore foot", "left hind foot", "right fore foot", "right hind foot"];
        let all = [&trunk[..], &feet[..]].concat();
        let count = |names: [&[&str]; 2], distance| {
            let [source, target] = [0, 1].map(|side| only(names[side], side));
            let (full, present) = with_levels(meshes, [&source, &target]);
            LimbEnds::find(&full, &present, 12, &mut Silent).unwrap().unmarked(distance)
        };
        let far = 0.3;
        assert!(count([&trunk, &trunk], far) >= 4);
        assert!(count([&all, &all], far) < 2);
        assert_eq!(count([&trunk, &all], far), count([&all, &trunk], far));
        assert!(count([&trunk, &all], far) < 2);
        assert_eq!(count([&trunk, &trunk], 3.0), 0);
    }
}
