//! The places at which the maps of two candidates differ, and the kind of their difference.

use super::candidate::Candidate;
use super::difference::{Difference, DifferenceKind};
use super::pair::MatchedPair;
use super::shape::Shape;
use crate::mesh::resampling::resampled;
use glam::DVec3;

/// Images farther apart than this, in units of the root of the target's area, are at different places; landmarks of SHREC07 are judged by
/// the same distance. Chosen by hand.
pub(super) const APART: f64 = 0.15;

/// The difference of a candidate from the best one.
pub(super) fn difference(shapes: [&Shape; 2], best: &Candidate, other: &Candidate) -> Difference {
    let parting = Parting::of(best, other);
    let old = &best.assignment.pairs;
    let new = &other.assignment.pairs;
    let changed: Vec<usize> = (0..new.len()).filter(|&k| !old.contains(&new[k])).collect();
    let partners = shapes[1].partners();
    // Counts of the source's ends that both candidates pair, by where they go.
    let (mut moved, mut to_partner, mut kept, mut kept_with_partner) = (0, 0, 0, 0);
    for &[s, t] in new {
        let Some(&[_, before]) = old.iter().find(|pair| pair[0] == s) else { continue };
        if before == t {
            kept += 1;
            kept_with_partner += usize::from(partners[t].is_some());
        } else {
            moved += 1;
            to_partner += usize::from(partners[before] == Some(t));
        }
    }
    let kind = if moved == 0 && (changed.is_empty() || new.len() < old.len()) {
        if new.len() < old.len() { DifferenceKind::Fewer } else { DifferenceKind::Places }
    } else if to_partner == moved && moved > 1 {
        if kept_with_partner == 0 { DifferenceKind::Mirrored } else { DifferenceKind::Sides }
    } else if moved > kept {
        DifferenceKind::Ends
    } else {
        DifferenceKind::Places
    };
    let mut pairs: Vec<MatchedPair> = changed.into_iter().map(|k| other.pairs[k]).collect();
    if other.assignment.between.is_some() && other.assignment.between != best.assignment.between {
        pairs.extend(other.pairs.last());
    }
    Difference { kind, pairs, share: parting.share }
}

/// The places at which two maps of the same meshes differ.
pub(super) struct Parting {
    /// Share of the source's area, 0 to 1, whose images are far apart.
    pub(super) share: f64,
    /// The places whose images are far apart, the farthest first.
    pub(super) places: Vec<PartedPlace>,
}

/// A place of the source with its different images under two maps, in space.
#[derive(Clone, Copy)]
pub(super) struct PartedPlace {
    /// The position of a coarse vertex of the source.
    pub(super) source: DVec3,
    /// Its images under the first and the second map.
    pub(super) images: [DVec3; 2],
}

impl PartedPlace {
    fn apart(&self) -> f64 {
        self.images[0].distance(self.images[1])
    }
}

impl Parting {
    /// Compares the images of the first map's coarse vertices.
    pub(super) fn of(first: &Candidate, second: &Candidate) -> Self {
        let [a, b] = [&first.picture, &second.picture];
        let root = a.target.area().sqrt();
        let areas = a.source.vertex_areas();
        let others = resampled(&b.images(), &b.source, &a.source, |_| None);
        let mut parting = Self { share: 0.0, places: Vec::new() };
        let mut total = 0.0;
        for v in a.source.vertices() {
            let source = a.source.positions()[v];
            let image = a.target_from_source[v].position(&a.target);
            let place = PartedPlace { source, images: [image, others[v]] };
            total += areas[v];
            if place.apart() / root > APART {
                parting.share += areas[v];
                parting.places.push(place);
            }
        }
        parting.share /= total;
        // A stable sort: equal ones stay in the order of the vertices.
        parting.places.sort_by(|a, b| b.apart().total_cmp(&a.apart()));
        parting
    }
}
