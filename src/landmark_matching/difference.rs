//! How one candidate differs from another: where their maps part, and what a user would call it.

use super::candidate::{Candidate, MatchedPair};
use super::shape::Shape;
use crate::landmarks::MeshSide;
use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{SurfacePoint, VertexId};
use glam::DVec3;

/// What a user would call the difference of two candidates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DifferenceKind {
    /// Every limb that has a partner on the other side of its body goes to that side.
    Mirrored,
    /// Some limbs do so, others stay.
    Sides,
    /// Most ends go elsewhere, not only to the other side: as with head and tail exchanged.
    Ends,
    /// Some ends go elsewhere.
    Places,
    /// The pairs are the same but for some that only one of both has.
    Fewer,
}

/// How a candidate differs from the best.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// What a user would call it.
    pub kind: DifferenceKind,
    /// The pairs of this candidate that the best does not have.
    pub pairs: Vec<MatchedPair>,
    /// Share of the source's area whose images are farther than 0.15 of the root of the target's area from those of the best.
    pub share: f64,
}

impl Difference {
    /// One sentence for the user. `number` tells how the user's file numbers a vertex of a mesh.
    pub fn sentence(&self, number: impl Fn(MeshSide, VertexId) -> usize) -> String {
        let pairs: Vec<String> = self
            .pairs
            .iter()
            .take(NAMED)
            .map(|pair| {
                let [s, t] = [number(MeshSide::Source, pair.source), number(MeshSide::Target, pair.target)];
                format!("{s} to {t}")
            })
            .collect();
        let more = if self.pairs.len() > NAMED { ", ..." } else { "" };
        let list = format!("{}{more}", pairs.join(", "));
        match self.kind {
            DifferenceKind::Mirrored => {
                format!("Left and right are exchanged: of the source's vertices it takes {list}.")
            }
            DifferenceKind::Sides => {
                format!("Some limbs go to the other side of the body: of the source's vertices it takes {list}.")
            }
            DifferenceKind::Ends => {
                format!("Most ends go elsewhere, as with head and tail exchanged: of the source's vertices it takes {list}.")
            }
            DifferenceKind::Places if self.pairs.is_empty() => {
                "The same pairs, but the map goes another way round the body.".to_owned()
            }
            DifferenceKind::Places => format!("Other ends correspond: of the source's vertices it takes {list}."),
            DifferenceKind::Fewer => "Some ends are left without a partner.".to_owned(),
        }
    }
}

/// Pairs that a sentence names, at most.
const NAMED: usize = 4;

/// Images farther apart than this, in units of the root of the target's area, are at different places: that many landmarks of SHREC07
/// are told apart by it, too.
pub(super) const APART: f64 = 0.15;

/// How a candidate differs from the best one.
pub(super) fn difference(shapes: [&Shape; 2], best: &Candidate, other: &Candidate) -> Difference {
    let parting = Parting::of(best, other);
    let old = &best.assignment.pairs;
    let new = &other.assignment.pairs;
    let changed: Vec<usize> = (0..new.len()).filter(|&k| !old.contains(&new[k])).collect();
    let partners = shapes[1].partners();
    // What becomes of the ends that both have.
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

/// Where two maps of the same meshes part.
pub(super) struct Parting {
    /// Share of the source's area whose images are far apart.
    pub(super) share: f64,
    /// The source's coarse vertex whose images are farthest apart.
    pub(super) vertex: VertexId,
    /// Its images in space.
    pub(super) images: [DVec3; 2],
}

impl Parting {
    /// Compares the images of the first map's coarse vertices.
    pub(super) fn of(first: &Candidate, second: &Candidate) -> Self {
        let [a, b] = [&first.picture, &second.picture];
        let root = a.target.area().sqrt();
        let areas = a.source.vertex_areas();
        let index = SurfaceIndex::new(&b.source);
        let mut parting = Self { share: 0.0, vertex: VertexId(0), images: [DVec3::ZERO; 2] };
        let (mut farthest, mut total) = (-1.0, 0.0);
        for v in a.source.vertices() {
            let image = a.target_from_source[v].position(&a.target);
            let SurfacePoint { face, barycentric } = index.nearest(a.source.positions()[v]).point;
            let corners = b.source.triangles()[face];
            let other: DVec3 = (0..3)
                .map(|k| barycentric[k] * b.target_from_source[corners[k]].position(&b.target))
                .sum();
            let apart = image.distance(other) / root;
            total += areas[v];
            if apart > APART {
                parting.share += areas[v];
            }
            if apart > farthest {
                farthest = apart;
                parting = Self { vertex: v, images: [image, other], ..parting };
            }
        }
        parting.share /= total;
        parting
    }
}
