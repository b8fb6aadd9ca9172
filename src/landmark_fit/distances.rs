//! Comparison of the distances between landmarks on source and target, by the logarithms of their ratios.

use super::finding::Finding;
use crate::landmarks::{LandmarkId, Landmarks, MeshSide};
use crate::layout::LandmarkDistances;
use crate::math::scalar::{exp, ln, max, min};
use crate::mesh::VertexId;
use crate::monitor::{Cancelled, Monitor, Step};
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// Added to distances before ratios are taken, in units of the root of the area, so that near landmarks count little. Chosen by hand.
const SOFTENING: f64 = 0.08;
/// An exchange of two targets may raise the misfit (mean absolute log ratio) of either pair by no more than this. Left and
/// right partners keep theirs; the partner of a misplaced pair gets more.
const WORSE: f64 = 0.05;
/// An exchange that lowers the misfit to this share is taken even where other places fit better still: feet of two different
/// animals have such places.
const SWAP_SHARE: f64 = 0.6;
/// A pair is misplaced where another place lowers its misfit by `PLACE_GAIN` + `PLACE_GAIN_OF_FEW` / (number of landmarks), to
/// the share `PLACE_SHARE`, and is `PLACE_DISTANCE` away. With `PLACE_GAIN` alone 4 of 14
/// slightly bent sets of 8 landmarks had a false alarm, with both gains 0 of 34.
const PLACE_GAIN: f64 = 0.2;
/// See [`PLACE_GAIN`].
const PLACE_GAIN_OF_FEW: f64 = 1.0;
/// Largest share of its misfit that a misplaced pair has at the better place. Chosen by hand.
const PLACE_SHARE: f64 = 0.3;
/// Least distance of the better place, in units of the root of the area. Chosen by hand.
const PLACE_DISTANCE: f64 = 0.3;

/// An assignment of targets to pairs, with the logarithms of all distances.
pub(super) struct Fit<'a> {
    distances: &'a LandmarkDistances,
    /// For each pair the number of the pair whose target it has.
    pub(super) target_of: TiVec<LandmarkId, LandmarkId>,
    /// The target of each pair as given.
    targets: &'a TiSlice<LandmarkId, VertexId>,
    /// Whether each pair was found misplaced and is left out of the comparison.
    pub(super) left_out: TiVec<LandmarkId, bool>,
    /// Softened logarithms of the source's distances between landmarks.
    source: TiVec<LandmarkId, TiVec<LandmarkId, f64>>,
    /// Softened logarithms of the target's distances, by landmark and vertex.
    target: TiVec<LandmarkId, TiVec<VertexId, f64>>,
}

impl<'a> Fit<'a> {
    pub(super) fn new(landmarks: &'a Landmarks, distances: &'a LandmarkDistances) -> Self {
        let all = || landmarks.source.keys();
        let log = |d: f64| ln(d + SOFTENING);
        let between = |i, j| log(distances.between([i, j])[MeshSide::Source]);
        let source = all().map(|i| all().map(|j| between(i, j)).collect()).collect();
        let field = |j| distances.field(MeshSide::Target, j).iter();
        let target = all().map(|j| field(j).map(|&d| log(d)).collect()).collect();
        Self {
            distances,
            target_of: all().collect(),
            targets: &landmarks.target,
            left_out: ti_vec![false; landmarks.len()],
            source,
            target,
        }
    }

    /// The misfit of a pair whose target is at `place`: the mean absolute log ratio of its distances to the others but `without`; near pairs
    /// have larger weights.
    fn misfit(&self, pair: LandmarkId, place: VertexId, without: Option<LandmarkId>) -> f64 {
        let (mut sum, mut total) = (0.0, 0.0);
        let counts = |&j: &LandmarkId| j != pair && Some(j) != without && !self.left_out[j];
        for j in self.target_of.keys().filter(counts) {
            let (s, t) = (self.source[pair][j], self.target[self.target_of[j]][place]);
            // The lesser of both distances, as a weight.
            let weight = 1.0 / exp(s.min(t));
            sum += weight * (s - t).abs();
            total += weight;
        }
        sum / total
    }

    fn place(&self, pair: LandmarkId) -> VertexId {
        self.targets[self.target_of[pair]]
    }

    /// Mean misfit of two pairs as it is and with their targets exchanged; `None` where the exchange raises the misfit of either pair by
    /// more than [`WORSE`], or lowers it little and another place fits one of them much better.
    pub(super) fn exchanged(&self, pairs: [LandmarkId; 2]) -> Option<[f64; 2]> {
        let both = [pairs, [pairs[1], pairs[0]]];
        let [now, then] = self.misfits(pairs);
        let worse = max(then[0] - now[0], then[1] - now[1]);
        let settled = |k: usize| {
            let [i, j] = both[k];
            let places = self.target[i].keys();
            let best = places.map(|v| self.misfit(i, v, Some(j))).fold(f64::INFINITY, min);
            then[k] - best < PLACE_GAIN || best > PLACE_SHARE * then[k]
        };
        let means = means([now, then]);
        let helps = means[1] < SWAP_SHARE * means[0];
        (worse < WORSE && (helps || (settled(0) && settled(1)))).then_some(means)
    }

    /// Misfit of each of two pairs as it is, and with their targets exchanged.
    fn misfits(&self, [a, b]: [LandmarkId; 2]) -> [[f64; 2]; 2] {
        let both = [(a, b), (b, a)];
        let now = both.map(|(i, j)| self.misfit(i, self.place(i), Some(j)));
        let then = both.map(|(i, j)| self.misfit(i, self.place(j), Some(j)));
        [now, then]
    }

    /// Mean misfit of two pairs as it is and with their targets exchanged; `None` where the exchange raises it by more than [`WORSE`].
    pub(super) fn mean_misfits(&self, pairs: [LandmarkId; 2]) -> Option<[f64; 2]> {
        let [now, then] = means(self.misfits(pairs));
        (then - now < WORSE).then_some([now, then])
    }

    /// The pair of largest misfit for which a place far from its target fits much better.
    pub(super) fn worst_misplaced(&self, monitor: &mut dyn Monitor) -> Result<Option<Finding>, Cancelled> {
        let now = |pair: LandmarkId| self.misfit(pair, self.place(pair), None);
        let mut doubtful: Vec<(f64, LandmarkId)> = self
            .target_of
            .keys()
            .filter(|&pair| !self.left_out[pair])
            .map(|pair| (now(pair), pair))
            .filter(|(misfit, _)| *misfit > PLACE_GAIN)
            .collect();
        doubtful.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        for (misfit, pair) in doubtful {
            monitor.step(Step::default())?;
            if let Some(finding) = self.better_place(pair, misfit) {
                return Ok(Some(finding));
            }
        }
        Ok(None)
    }

    fn better_place(&self, pair: LandmarkId, now: f64) -> Option<Finding> {
        let placed = self.target[pair].keys().map(|v| (self.misfit(pair, v, None), v));
        let (then, place) = placed.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let away = |j: LandmarkId| self.distances.field(MeshSide::Target, self.target_of[j])[place];
        let others = self.target_of.keys().filter(|&j| j != pair);
        let near = others.min_by(|&i, &j| away(i).total_cmp(&away(j)))?;
        let distance = away(pair);
        // With few landmarks some place fits well by chance.
        let gain = PLACE_GAIN + PLACE_GAIN_OF_FEW / self.target_of.len() as f64;
        let clear = now - then > gain && then < PLACE_SHARE * now && distance > PLACE_DISTANCE;
        clear.then_some(Finding::Misplaced { pair, misfit: [now, then], distance, place, near })
    }
}

/// The means of two pairs' misfits, as it is and exchanged.
fn means(misfits: [[f64; 2]; 2]) -> [f64; 2] {
    misfits.map(|[a, b]| 0.5 * (a + b))
}
