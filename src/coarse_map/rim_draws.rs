//! Constraints that draw corresponding rims to each other, each vertex to the line of the other rim.
//!
//! The toll on skin over a cap pulls at a rim with the same force at any distance. So a rim that begins far from its partner stays
//! where the stretched or compressed skin behind it pulls as hard. The force of these constraints grows with the distance: a vertex is
//! drawn square to the other rim, and is free to move along it.

use crate::mesh::face_weights::FaceWeights;
use crate::mesh::rims::{Rim, rims};
use crate::mesh::segment_index::{OnSegment, SegmentIndex};
use crate::mesh::{SurfaceMesh, VertexId};
use crate::registration::rigid_patches::MappedLevel;
use crate::surface_map::energy::point_constraint::PointConstraint;
use glam::DVec3;
use std::collections::BTreeMap;

/// Options by which corresponding rims are drawn to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RimDrawOptions {
    /// Relaxations with these constraints on each finer level; the rims are compared anew before each.
    pub rounds: usize,
    /// Energy of a rim per unit of its length and of its squared distance from the other rim; areas are 1.
    pub strength: f64,
}

/// The rim of a cap whose toll is above 0: it corresponds to a rim of the other mesh.
pub(super) struct BorderLine {
    /// An index of its edges.
    index: SegmentIndex,
    /// For each edge the unit vector in the plane of the skin beside it that is perpendicular to the edge.
    across: Vec<DVec3>,
    /// The length of rim that each vertex stands for.
    lengths: BTreeMap<VertexId, f64>,
}

/// The rims of a mesh that correspond to rims of the other mesh.
pub(super) fn border_lines(mesh: &SurfaceMesh, weights: FaceWeights<'_>) -> Vec<BorderLine> {
    let rims = rims(mesh, |f| weights.of(f).toll > 0.0);
    rims.iter().map(|rim| BorderLine::new(mesh, weights, rim)).collect()
}

/// Constraints that draw the rims of a level's mesh, each to the rim of the other mesh that is nearest to it on average. Both areas
/// are 1.
pub(super) fn draws(
    own: &[BorderLine],
    other: &[BorderLine],
    seen: &MappedLevel<'_>,
    strength: f64,
) -> Vec<(VertexId, PointConstraint)> {
    own.iter().flat_map(|line| line.drawn(other, seen, strength)).collect()
}

impl BorderLine {
    fn new(mesh: &SurfaceMesh, weights: FaceWeights<'_>, rim: &Rim) -> Self {
        let (mut segments, mut across, mut lengths) = (Vec::new(), Vec::new(), BTreeMap::new());
        for h in rim.cap.iter().flat_map(|f| f.halfedges()) {
            let skin = mesh.twin(h).face();
            if weights.of(skin).toll > 0.0 {
                continue;
            }
            let vertices = [mesh.tail(h), mesh.head(h)];
            let ends = vertices.map(|v| mesh.positions()[v]);
            let [a, b, c] = mesh.corners(skin);
            across.push((b - a).cross(c - a).cross(ends[1] - ends[0]).normalize_or_zero());
            segments.push(ends);
            for v in vertices {
                *lengths.entry(v).or_default() += 0.5 * mesh.length(h);
            }
        }
        Self { index: SegmentIndex::new(segments), across, lengths }
    }

    /// The nearest point of the rim.
    fn foot(&self, p: DVec3) -> Option<OnSegment> {
        self.index.nearest_where(p, |_| true)
    }

    fn drawn(
        &self,
        others: &[Self],
        seen: &MappedLevel<'_>,
        strength: f64,
    ) -> Vec<(VertexId, PointConstraint)> {
        let in_level = |(&v, &length): (&VertexId, &f64)| {
            let own = seen.vertices.binary_search(&v).ok()?;
            Some(Placed { vertex: v, image: seen.images[own], length })
        };
        let placed: Vec<Placed> = self.lengths.iter().filter_map(in_level).collect();
        let apart = |line: &Self| -> f64 {
            let far =
                |p: &Placed| line.foot(p.image).map_or(f64::INFINITY, |foot| foot.position.distance(p.image));
            placed.iter().map(|p| p.length * far(p)).sum()
        };
        let distances = others.iter().map(|line| (line, apart(line)));
        let Some((partner, _)) = distances.min_by(|a, b| a.1.total_cmp(&b.1)) else { return Vec::new() };
        // The vertices of a coarse level stand for the whole rim.
        let share = self.lengths.values().sum::<f64>() / placed.iter().map(|p| p.length).sum::<f64>();
        let constraint = |p: &Placed| {
            let OnSegment { segment, position: place } = partner.foot(p.image)?;
            let row = partner.across[segment] * (strength * share * p.length).sqrt();
            Some((p.vertex, PointConstraint { place, rows: [row, DVec3::ZERO], knee: f64::INFINITY }))
        };
        placed.iter().filter_map(constraint).collect()
    }
}

/// A vertex of a rim that is in the present level.
struct Placed {
    /// Its number in the full mesh.
    vertex: VertexId,
    image: DVec3,
    /// The length of the rim that it stands for.
    length: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::FaceId;
    use crate::mesh::face_weights::FaceWeight;
    use crate::mesh::generators::{midpoint_subdivision, octahedron};
    use typed_index_collections::{TiVec, ti_vec};

    /// A finely divided octahedron with corners on the axes; lines of edges lie at the heights that are eighths.
    fn body() -> SurfaceMesh {
        (0..3).fold(octahedron(), |mesh, _| midpoint_subdivision(&mesh))
    }

    /// Caps where the height is beyond these.
    fn weights(mesh: &SurfaceMesh, [below, above]: [f64; 2], toll: f64) -> TiVec<FaceId, FaceWeight> {
        let height = |f: FaceId| mesh.corners(f).iter().map(|p| p.z).sum::<f64>() / 3.0;
        let is_cap = |f: FaceId| height(f) < below || height(f) > above;
        mesh.faces()
            .map(|f| if is_cap(f) { FaceWeight { weight: 0.01, toll } } else { FaceWeight::SKIN })
            .collect()
    }

    fn constraints(
        mesh: &SurfaceMesh,
        lines: &[BorderLine],
        image: impl Fn(DVec3) -> DVec3,
    ) -> Vec<(VertexId, PointConstraint)> {
        let vertices: TiVec<VertexId, VertexId> = mesh.vertices().collect();
        let images = mesh.positions().iter().map(|p| image(*p)).collect();
        let (near, is_on_skin) = (vertices.clone(), ti_vec![true; vertices.len()]);
        let seen = MappedLevel { mesh, vertices: &vertices, images, near, is_on_skin };
        draws(lines, lines, &seen, 100.0)
    }

    fn energy((_, constraint): &(VertexId, PointConstraint), image: DVec3) -> f64 {
        constraint.rows[0].dot(image - constraint.place).powi(2)
    }

    #[test]
    fn a_rim_pays_for_the_square_of_its_distance_across_and_nothing_along() {
        let mesh = body();
        let weights = weights(&mesh, [-9.0, 0.0], 1.0);
        let lines = border_lines(&mesh, FaceWeights::new(Some(&weights)));
        assert_eq!(lines.len(), 1);
        let length: f64 = lines[0].lengths.values().sum();
        assert!((length - 4.0 * 2.0_f64.sqrt()).abs() < 1e-12, "{length}");
        // Away from the corners, down the lower faces, and along the sides.
        let is_inner = |p: DVec3| p.x.abs() > 1e-9 && p.y.abs() > 1e-9;
        let side = |p: DVec3| DVec3::new(p.x.signum(), p.y.signum(), 0.0);
        let down = |p: DVec3| (side(p) * -0.5 - DVec3::Z).normalize() * 0.03;
        let along = |p: DVec3| DVec3::Z.cross(side(p)).normalize() * 0.03;
        let moved = |by: &dyn Fn(DVec3) -> DVec3| -> f64 {
            let image = |p: DVec3| if is_inner(p) { p + by(p) } else { p };
            let found = constraints(&mesh, &lines, image);
            found.iter().map(|c| energy(c, image(mesh.positions()[c.0]))).sum()
        };
        let inner: f64 =
            lines[0].lengths.iter().filter(|(v, _)| is_inner(mesh.positions()[**v])).map(|(_, l)| l).sum();
        let [across, slid] = [moved(&down), moved(&along)];
        assert!((across - 100.0 * inner * 0.03 * 0.03).abs() < 1e-9, "{across}");
        assert!(slid < 1e-20, "{slid}");
    }

    #[test]
    fn each_rim_is_drawn_to_the_one_that_it_is_nearest_to_as_a_whole() {
        let mesh = body();
        let weights = weights(&mesh, [-0.75, 0.75], 1.0);
        let lines = border_lines(&mesh, FaceWeights::new(Some(&weights)));
        assert_eq!(lines.len(), 2);
        // One vertex of each lies at the other rim.
        let astray = |p: DVec3| p.x > 0.2 && p.y.abs() < 1e-9;
        let image = |p: DVec3| if astray(p) { DVec3::new(p.x, p.y, -p.z) } else { p * 0.9 };
        let found = constraints(&mesh, &lines, image);
        assert_eq!(found.len(), lines.iter().map(|line| line.lengths.len()).sum::<usize>());
        for (v, constraint) in found {
            let own = mesh.positions()[v];
            assert!((constraint.place.z - own.z).abs() < 1e-12, "{own} {}", constraint.place);
        }
    }

    #[test]
    fn a_rim_under_which_data_is_missing_draws_nothing() {
        let mesh = body();
        let weights = weights(&mesh, [-0.5, 0.5], 0.0);
        assert!(border_lines(&mesh, FaceWeights::new(Some(&weights))).is_empty());
        assert!(border_lines(&mesh, FaceWeights::EVEN).is_empty());
        assert!(constraints(&mesh, &[], |p| p).is_empty());
    }
}
