//! Tips moved to the ends of limbs on finer levels.
//!
//! On a coarse level a tip is one of few vertices, up to a triangle's width away from the end of its limb. On a finer level it is moved to
//! the vertex near it that is farthest from the other pairs of its candidate, by the sum of the distances: the same rule on both bodies, so
//! that partners correspond.

use super::candidate::Candidate;
use super::input::MatchInput;
use super::pair::PairOrigin;
use crate::geodesic::ManyDistances;
use crate::landmarks::MeshSide;
use crate::mesh::coarsening::Level;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Step};
use typed_index_collections::{TiSlice, TiVec};

/// Vertices of the level on which tips are moved, at most: its edges are about 1 % of the root of the area. Chosen by hand.
const VERTICES: usize = 6000;
/// Largest move of a tip, in units of the root of the area: two edges of the coarse level. Chosen by hand.
const FARTHEST: f64 = 0.05;

/// Moves the tips of all candidates.
pub(super) fn sharpen(
    input: MatchInput<'_>,
    candidates: &mut [Candidate],
    monitor: &mut dyn Monitor,
) -> Result<(), Cancelled> {
    let may_mark = [input.may_mark.source, input.may_mark.target];
    for (side, from) in MeshSide::BOTH.into_iter().zip([0.0, 0.5]) {
        let at = |candidate: &Candidate, k: usize| {
            let pair = candidate.pairs[k];
            [pair.source, pair.target][side]
        };
        let mut ends: Vec<VertexId> = candidates
            .iter()
            .flat_map(|candidate| (0..candidate.pairs.len()).map(move |k| at(candidate, k)))
            .collect();
        ends.sort_unstable();
        ends.dedup();
        let half = &mut Portion::new(monitor, from, from + 0.5);
        let fine = Fine::new(input.meshes()[side], &ends, may_mark[side], half)?;
        for candidate in candidates.iter_mut() {
            let before: Vec<VertexId> = (0..candidate.pairs.len()).map(|k| at(candidate, k)).collect();
            let mut after = before.clone();
            for k in 0..before.len() {
                if candidate.pairs[k].origin == PairOrigin::Tips {
                    after[k] = fine.end(&before, k, &after);
                }
            }
            for (pair, v) in candidate.pairs.iter_mut().zip(after) {
                *[&mut pair.source, &mut pair.target][side] = v;
            }
        }
    }
    Ok(())
}

/// A finer level with the distances from all ends.
struct Fine<'a> {
    level: Level,
    ends: &'a [VertexId],
    fields: Vec<TiVec<VertexId, f64>>,
    may_mark: Option<&'a TiSlice<VertexId, bool>>,
    farthest: f64,
}

impl<'a> Fine<'a> {
    fn new(
        mesh: &SurfaceMesh,
        ends: &'a [VertexId],
        may_mark: Option<&'a TiSlice<VertexId, bool>>,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let level =
            Level::coarse(mesh, ends, VERTICES.max(2 * ends.len()), &mut Portion::new(monitor, 0.0, 0.0))?;
        let distances = ManyDistances::on(&level.mesh);
        let mut fields = Vec::with_capacity(ends.len());
        for v in level.numbers(ends) {
            monitor.step(Step { fraction: fields.len() as f64 / ends.len() as f64, residual: None })?;
            fields.push(distances.to(v));
        }
        let farthest = FARTHEST * level.mesh.area().sqrt();
        Ok(Self { level, ends, fields, may_mark, farthest })
    }

    fn field(&self, end: VertexId) -> Option<&TiVec<VertexId, f64>> {
        self.ends.binary_search(&end).ok().map(|k| &self.fields[k])
    }

    /// The vertex near end `k` that is farthest from the other ends, of those that may be landmarks and are not `taken`.
    fn end(&self, ends: &[VertexId], k: usize, taken: &[VertexId]) -> VertexId {
        let Some(own) = self.field(ends[k]) else { return ends[k] };
        let others: Vec<_> = ends.iter().filter(|v| **v != ends[k]).filter_map(|v| self.field(*v)).collect();
        let full = |v: VertexId| self.level.vertices[v];
        let may = |v: VertexId| {
            own[v] < self.farthest
                && self.may_mark.is_none_or(|may| may[full(v)])
                && (full(v) == ends[k] || !taken.contains(&full(v)))
        };
        let sum = |v: VertexId| others.iter().map(|field| field[v]).sum::<f64>();
        let near = self.level.mesh.vertices().filter(|&v| may(v));
        near.max_by(|a, b| sum(*a).total_cmp(&sum(*b))).map_or(ends[k], full)
    }
}

#[cfg(test)]
mod tests {
    use super::super::pair::MatchedPair;
    use super::*;
    use crate::mesh::SurfacePoint;
    use crate::mesh::generators::icosphere;

    /// Keeps the fractions.
    struct Fractions(Vec<f64>);

    impl Monitor for Fractions {
        fn step(&mut self, step: Step) -> Result<(), Cancelled> {
            self.0.push(step.fraction);
            Ok(())
        }
    }

    #[test]
    fn progress_goes_on_over_both_meshes() {
        let mesh = icosphere(2);
        let pair =
            |v: u32| MatchedPair { source: VertexId(v), target: VertexId(v), origin: PairOrigin::Tips };
        let images = mesh.vertices().map(|v| SurfacePoint::at_vertex(&mesh, v)).collect();
        let mut candidates =
            [Candidate { pairs: (0..6).map(pair).collect(), ..Candidate::of_images(&mesh, images) }];
        let mut told = Fractions(Vec::new());
        sharpen(MatchInput::new(&mesh, &mesh), &mut candidates, &mut told).unwrap();
        assert!(told.0.is_sorted() && told.0[0] < 0.1, "{:?}", told.0);
        let first_half = told.0.iter().filter(|fraction| **fraction < 0.5).count();
        assert_eq!(2 * first_half, told.0.len(), "{:?}", told.0);
    }
}
