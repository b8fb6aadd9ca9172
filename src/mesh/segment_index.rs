//! Nearest points of line segments in space, many of them, by a bounding volume hierarchy.

use super::surface_index::bounding_box;
use crate::math::segment::nearest_share;
use glam::DVec3;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::PointQuery;

/// Segments that can be asked for their nearest points.
pub(crate) struct SegmentIndex {
    segments: Vec<[DVec3; 2]>,
    hierarchy: Bvh,
}

/// A point of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OnSegment {
    /// The number of the segment.
    pub segment: usize,
    /// The point's position in space.
    pub position: DVec3,
}

impl SegmentIndex {
    /// Builds the hierarchy over segments that are given by their ends.
    pub fn new(segments: Vec<[DVec3; 2]>) -> Self {
        let boxes: Vec<_> = segments.iter().map(|ends| bounding_box(ends)).collect();
        let hierarchy = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        Self { segments, hierarchy }
    }

    /// The nearest point of the segments whose numbers are allowed; `None` where there is none.
    pub fn nearest_where(&self, p: DVec3, allowed: impl Fn(usize) -> bool) -> Option<OnSegment> {
        let place = p.to_array().into();
        let found = self.hierarchy.find_best(
            f64::MAX,
            |node, _| node.aabb().distance_to_local_point(place, true),
            |k, _| {
                let segment = k as usize;
                let ends = self.segments.get(segment).filter(|_| allowed(segment))?;
                let position = ends[0].lerp(ends[1], nearest_share(p, *ends));
                Some((position.distance(p), OnSegment { segment, position }))
            },
        );
        found.map(|(_, (_, nearest))| nearest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    #[test]
    fn no_point_of_a_segment_that_is_allowed_is_nearer() {
        let mut random = SplitMix::new(7);
        let mut point = || DVec3::from_array([0, 1, 2].map(|_| 2.0 * random.unit() - 1.0));
        let mut segments: Vec<[DVec3; 2]> = (0..200).map(|_| [point(), point()]).collect();
        segments.push([DVec3::ONE; 2]);
        let index = SegmentIndex::new(segments.clone());
        for _ in 0..100 {
            let p = point();
            let found = index.nearest_where(p, |segment| segment % 3 == 0).unwrap();
            assert_eq!(found.segment % 3, 0);
            let [a, b] = segments[found.segment];
            let length = a.distance(found.position) + found.position.distance(b);
            assert!((length - a.distance(b)).abs() < 1e-12);
            for [a, b] in segments.iter().step_by(3) {
                for k in 0..=20 {
                    assert!(
                        found.position.distance(p) <= a.lerp(*b, f64::from(k) / 20.0).distance(p) + 1e-12
                    );
                }
            }
        }
        assert_eq!(index.nearest_where(DVec3::ZERO, |_| false), None);
        assert_eq!(SegmentIndex::new(Vec::new()).nearest_where(DVec3::ZERO, |_| true), None);
    }
}
