//! The handedness of groups of four landmarks in space, compared between both meshes.
//!
//! The orders of shortest paths are unreliable where paths over the front and over the back of a body are equally long; the
//! places in space are reliable there, but change with the pose. So groups are weighted by how nearly they are similar on both meshes.

use super::orders::{Votes, nearest};
use crate::landmarks::{LandmarkId, Landmarks};
use crate::layout::LandmarkDistances;
use crate::math::scalar::ln;
use crate::mesh::SurfaceMesh;
use glam::DVec3;
use typed_index_collections::{TiSlice, TiVec};

/// Standard deviation of the log ratios of a group's six distances at which the group has half the weight. Groups across a bent joint
/// have 0.3 and more, those of two animals' heads 0.1.
const RIGID: f64 = 0.2;
/// The pairs of corners of a group.
const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// Agreement of the signs of volumes on both meshes, from -1 (mirrored) to 1, over each landmark with triples of its nearest ones;
/// `target_of` gives the pair whose target each pair has.
pub(super) fn agreement(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    distances: &LandmarkDistances,
    target_of: &TiSlice<LandmarkId, LandmarkId>,
) -> f64 {
    let source: TiVec<LandmarkId, DVec3> =
        landmarks.source.iter().map(|&v| meshes[0].positions()[v]).collect();
    let target = target_of.iter().map(|&j| meshes[1].positions()[landmarks.target[j]]).collect();
    let places = [source, target];
    let mut votes = Votes::default();
    for i in target_of.keys() {
        let near = nearest(distances, target_of, i);
        for (k, &a) in near.iter().enumerate() {
            for (l, &b) in near[..k].iter().enumerate() {
                for &c in &near[..l] {
                    let groups = places.each_ref().map(|places| [i, a, b, c].map(|j| places[j]));
                    let likeness = likeness(&groups);
                    votes.add(groups.map(|group| likeness * volume(&group)));
                }
            }
        }
    }
    votes.agreement().unwrap_or(0.0)
}

/// Signed volume over the cube of the mean distance of the corners.
fn volume(group: &[DVec3; 4]) -> f64 {
    let [p, q, r, s] = *group;
    let mean = EDGES.iter().map(|&[i, j]| group[i].distance(group[j])).sum::<f64>() / 6.0;
    let volume = (q - p).cross(r - p).dot(s - p);
    if mean > 0.0 { volume / (mean * mean * mean) } else { 0.0 }
}

/// The similarity of two groups: 1 for similar ones, 1/2 where the log ratios of distances deviate by [`RIGID`].
fn likeness(groups: &[[DVec3; 4]; 2]) -> f64 {
    let ratios = EDGES.map(|[i, j]| {
        let [s, t] = groups.each_ref().map(|group| group[i].distance(group[j]));
        if s > 0.0 && t > 0.0 { ln(s / t) } else { f64::INFINITY }
    });
    let mean = ratios.iter().sum::<f64>() / 6.0;
    let spread = ratios.iter().map(|r| (r - mean) * (r - mean)).sum::<f64>() / (6.0 * RIGID * RIGID);
    if spread.is_finite() { 1.0 / (1.0 + spread * spread) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn similar_groups_count_fully_and_their_mirror_images_have_the_opposite_volume() {
        let group = [[0.0, 0.0, 0.0], [1.0, 0.2, 0.1], [0.3, 1.1, 0.0], [0.2, 0.4, 0.9]].map(DVec3::from);
        let larger = group.map(|p| 3.0 * p + DVec3::Y);
        let image = group.map(|p| DVec3::new(-p.x, p.y, p.z));
        assert!((likeness(&[group, larger]) - 1.0).abs() < 1e-12);
        assert!((volume(&group) - volume(&larger)).abs() < 1e-12);
        assert!((volume(&group) + volume(&image)).abs() < 1e-12 && volume(&group).abs() > 0.1);
        let mut bent = group;
        bent[3] = DVec3::new(0.5, 0.4, 0.1);
        assert!(likeness(&[group, bent]) < 0.5);
    }
}
