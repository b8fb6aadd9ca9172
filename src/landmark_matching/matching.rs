//! The matching of landmark pairs.
//!
//! Tips and their descriptors are computed on coarse levels of both bodies (`shape`). Assignments of tips are searched by
//! their distances and by the orders in which shortest paths lead to them (`search`). The best are judged by their coarse maps
//! (`judge`), then changed a little as long as that helps (`moves`). The verdict compares the best with those that differ from it.

use super::candidate::{Candidate, PictureOnMesh, score_of_measures};
use super::candidates::{cheapest, chosen};
use super::difference::Difference;
use super::heads::with_twins;
use super::input::MatchInput;
use super::judge::{Measures, judge};
use super::likeness::uncrossed;
use super::moves::{exchanged, moves};
use super::options::MatchOptions;
use super::parting::difference;
use super::rings::turned;
use super::search::{Assignment, Tables, assignments};
use super::shape::{Body, Shape};
use super::sharpening::sharpen;
use super::small_ends::{SmallEnds, are_fit, near_exchanges, with_exchange};
use super::verdict::{Found, Verdict, verdict};
use crate::landmarks::MeshSide;
use crate::math::scalar::min;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, OrStop, Portion};

/// Why no landmarks were matched.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MatchError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A given pair names a vertex that its mesh does not have.
    #[error("landmark pair {} (the first is 1) names vertex {vertex}, but its mesh has {vertices} vertices", pair + 1)]
    MissingVertex {
        /// The pair, 0-based.
        pair: usize,
        /// The vertex.
        vertex: usize,
        /// Vertices of the mesh.
        vertices: usize,
    },
    /// Two given pairs share a vertex.
    #[error("landmark pairs {} and {} (the first is 1) are at the same vertex", pairs[0] + 1, pairs[1] + 1)]
    Coincident {
        /// The pairs, 0-based.
        pairs: [usize; 2],
    },
}

impl OrStop for MatchError {
    fn is_stop(&self) -> bool {
        matches!(self, Self::Cancelled(_))
    }
}

/// The result of a matching.
#[derive(Clone, Debug)]
pub struct LandmarkMatch {
    /// The candidates, the best first; none where fewer than four pairs were found.
    pub candidates: Vec<Candidate>,
    /// The certainty of the best one.
    pub verdict: Verdict,
}

/// Progress, 0 to 1, once the tips of both bodies have been computed. Chosen by hand, for display only, like the next two.
const LOOKED: f64 = 0.15;
/// Progress once the candidates have been judged.
const JUDGED: f64 = 0.6;
/// Progress once small changes of the best candidate have been judged.
const IMPROVED: f64 = 0.85;
/// Progress once the best candidate has been turned about its ends.
const TURNED: f64 = 0.9;
/// Times that a search goes on from a better candidate: an octopus has four arms on either side. Chosen by hand.
const MOST_TIMES: usize = 4;
/// Progress once small ends have been looked at closer.
const LOOKED_CLOSER: f64 = 0.94;
/// Progress once the target's mirror image has been looked at.
const MIRRORED: f64 = 0.97;

/// Finds landmark pairs of two bodies beside the given ones, with alternatives and a verdict.
///
/// The given pairs are in every candidate. The map and the pairs of each candidate that is the best so far are offered as a preview. A
/// monitor that wants a result gets the best candidates so far. The options bound the time: each candidate costs a coarse map.
///
/// # Errors
/// [`MatchError`]: cancellation, or given pairs that name missing vertices or one vertex twice.
pub fn match_landmarks(
    input: MatchInput<'_>,
    options: &MatchOptions,
    monitor: &mut dyn Monitor,
) -> Result<LandmarkMatch, MatchError> {
    check(input)?;
    let given = MeshSide::BOTH.map(|side| input.given.iter().map(|pair| pair[side]).collect::<Vec<_>>());
    let half = 0.5 * LOOKED;
    let source = Body { mesh: input.source, given: &given[0], may_mark: input.may_mark.source };
    let source = Shape::new(source, options, &mut Portion::new(monitor, 0.0, half))?;
    let target = Body { mesh: input.target, given: &given[1], may_mark: input.may_mark.target };
    let target = Shape::new(target, options, &mut Portion::new(monitor, half, LOOKED))?;
    let shapes = [&source, &target];
    let tables = Tables::new(shapes, options);
    let mut search = Search { source: input.source, shapes, options, found: Vec::new(), judged: 0 };
    search.first_look(&tables, &mut Portion::new(monitor, LOOKED, JUDGED))?;
    search.improve(&tables, &mut Portion::new(monitor, JUDGED, IMPROVED))?;
    // Small tips, which the changes have found partners for, tell between like limbs.
    let half = 0.5 * (IMPROVED + TURNED);
    let turns = search.go_on(&tables, turned, &mut Portion::new(monitor, IMPROVED, half))?;
    if search.go_on(&tables, exchanged, &mut Portion::new(monitor, half, TURNED))? || turns {
        search.improve(&tables, &mut Portion::new(monitor, TURNED, TURNED))?;
    }
    search.look_closer(&tables, &mut Portion::new(monitor, TURNED, LOOKED_CLOSER))?;
    let mirrored = search.onto_mirror_image(&mut Portion::new(monitor, LOOKED_CLOSER, MIRRORED))?;
    let mut candidates = search.found;
    sharpen(input, &mut candidates, &mut Portion::new(monitor, MIRRORED, 1.0))?;
    if let Some((best, others)) = candidates.split_first_mut() {
        others.iter_mut().for_each(|other| other.difference = Some(difference(shapes, best, other)));
    }
    // One assignment may have been found twice, with its pairs in another order.
    candidates.retain(|candidate| candidate.difference.as_ref().is_none_or(Difference::is_any));
    let verdict = verdict(
        input,
        shapes,
        Found { candidates: &candidates, mirrored: mirrored.as_ref() },
        &options.limits,
    );
    Ok(LandmarkMatch { candidates, verdict })
}

fn check(input: MatchInput<'_>) -> Result<(), MatchError> {
    for (side, mesh) in MeshSide::BOTH.into_iter().zip(input.meshes()) {
        for (pair, ends) in input.given.iter().enumerate() {
            let (vertex, vertices) = (ends[side].index(), mesh.vertex_count());
            if vertex >= vertices {
                return Err(MatchError::MissingVertex { pair, vertex, vertices });
            }
            if let Some(first) = input.given[..pair].iter().position(|other| other[side] == ends[side]) {
                return Err(MatchError::Coincident { pairs: [first, pair] });
            }
        }
    }
    Ok(())
}

/// The candidate of an assignment; `None` where it has no map. Its map is relaxed to the end where it scores less than `bound`, without the fit
/// of patches, after a short relaxation.
fn candidate(
    shapes: [&Shape; 2],
    assignment: Assignment,
    bound: f64,
    options: &MatchOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<Candidate>, Cancelled> {
    let vertices = |pair: &[usize; 2]| MeshSide::BOTH.map(|side| shapes[side].marks[pair[side]].vertex);
    let pairs: Vec<[VertexId; 2]> = assignment.pairs.iter().map(vertices).chain(assignment.between).collect();
    let promises = |first: &Measures| score_of_measures(&assignment, first) < bound;
    let judged = judge(shapes, &pairs, options, promises, monitor)?;
    Ok(judged.map(|judged| Candidate::new(shapes, assignment, judged)))
}

/// A matching under way: the candidates that were judged, the best first.
struct Search<'a> {
    source: &'a SurfaceMesh,
    shapes: [&'a Shape; 2],
    options: &'a MatchOptions,
    found: Vec<Candidate>,
    judged: usize,
}

impl Search<'_> {
    /// Judges an assignment; returns whether it is the best so far.
    fn judge(&mut self, assignment: &Assignment, monitor: &mut dyn Monitor) -> Result<bool, Cancelled> {
        self.judged += 1;
        let bound = self.least_score() + self.options.promising;
        let candidate = candidate(self.shapes, assignment.clone(), bound, self.options, monitor)?;
        let Some(candidate) = candidate else { return Ok(false) };
        let place = self.found.partition_point(|other| other.score <= candidate.score);
        let is_best = place == 0;
        if is_best {
            monitor.preview(&PictureOnMesh { candidate: &candidate, source: self.source });
        }
        self.found.insert(place, candidate);
        Ok(is_best)
    }

    /// The least score so far without the fit of patches.
    fn least_score(&self) -> f64 {
        self.found.iter().map(Candidate::score_without_patches).fold(f64::INFINITY, min)
    }

    /// Judges the most promising assignments, and more where these are poor.
    fn first_look(&mut self, tables: &Tables<'_>, monitor: &mut dyn Monitor) -> Result<(), Cancelled> {
        let listed = chosen(tables, assignments(tables, self.options), self.options);
        let MatchOptions { candidates, symmetric, turns, one_missing, .. } = self.options;
        // Candidates of further reflections take the place of the last of these.
        let first = candidates + symmetric + turns + one_missing;
        for (k, assignment) in listed.iter().enumerate() {
            let enough = k >= first && self.least_score() < self.options.doubtful_score;
            if enough || (monitor.wants_result() && !self.found.is_empty()) {
                break;
            }
            let share = |k: usize| k as f64 / listed.len() as f64;
            self.judge(assignment, &mut Portion::new(monitor, share(k), share(k + 1)))?;
        }
        Ok(())
    }

    /// The best of the cheapest assignments onto the target's mirror image; `None` where none has a map.
    fn onto_mirror_image(&self, monitor: &mut dyn Monitor) -> Result<Option<Candidate>, Cancelled> {
        let [source, target] = self.shapes;
        let mut best: Option<Candidate> = None;
        let Some(image) = target.mirrored() else { return Ok(best) };
        let shapes = [source, &image];
        let most = self.options.mirrored;
        let listed = cheapest(assignments(&Tables::new(shapes, self.options), self.options), most);
        for (k, assignment) in listed.into_iter().enumerate() {
            if monitor.wants_result() {
                break;
            }
            let share = |k: usize| k as f64 / most as f64;
            let watched = &mut Portion::new(monitor, share(k), share(k + 1));
            // The map onto a body that is mirrored is better at once than the best onto the body itself.
            let found = candidate(shapes, assignment, self.least_score(), self.options, watched)?;
            best = best.into_iter().chain(found).min_by(|a, b| a.score.total_cmp(&b.score));
        }
        Ok(best)
    }

    /// Judges certain changes of the best, and goes on from each that is better, at most [`MOST_TIMES`] times; returns whether one was better.
    fn go_on(
        &mut self,
        tables: &Tables<'_>,
        changes: fn(&Tables<'_>, &Assignment) -> Vec<Assignment>,
        monitor: &mut dyn Monitor,
    ) -> Result<bool, Cancelled> {
        for k in 0..MOST_TIMES {
            let Some(best) = self.found.first().map(|best| best.assignment.clone()) else { break };
            let share = |k: usize| k as f64 / MOST_TIMES as f64;
            let watched = &mut Portion::new(monitor, share(k), share(k + 1));
            let mut better = false;
            for change in changes(tables, &best) {
                let is_known = self.found.iter().any(|known| known.assignment.pairs == change.pairs);
                if !is_known && !watched.wants_result() {
                    better |= self.judge(&change, watched)?;
                }
            }
            if !better {
                return Ok(k > 0);
            }
        }
        Ok(true)
    }

    /// Gives the best candidate the pairs of small ends that finer maps are for. Its score stays that of its coarse map, which is compared with
    /// those of other candidates.
    fn look_closer(&mut self, tables: &Tables<'_>, monitor: &mut dyn Monitor) -> Result<(), Cancelled> {
        let Some(best) = self.found.first() else { return Ok(()) };
        if self.options.small_ends == 0 {
            return Ok(());
        }
        let ends = SmallEnds::new(tables, &best.assignment, self.options);
        let exchanges = near_exchanges(&self.found, self.options);
        let most = ends.as_ref().map_or(1, SmallEnds::most_looks) + exchanges.len();
        let finer = MatchOptions { brief: self.options.closer.clone(), ..self.options.clone() };
        let mut looked = 0;
        let mut look = |assignment: &Assignment| {
            if monitor.wants_result() {
                return Ok(None);
            }
            let share = |k: usize| k as f64 / most as f64;
            let watched = &mut Portion::new(monitor, share(looked), share(looked + 1));
            looked += 1;
            candidate(self.shapes, assignment.clone(), f64::INFINITY, &finer, watched)
        };
        let mut closer = None;
        if let Some(ends) = &ends
            && let Some(plain) = look(&ends.plain)?
        {
            let mut with_one = Vec::with_capacity(ends.with_one.len());
            for one in &ends.with_one {
                with_one.extend(look(one)?);
            }
            let taken = ends.taken(tables, &plain, &with_one);
            let known = with_one.into_iter().find(|one| one.assignment.pairs == taken.pairs);
            let all = if known.is_some() { known } else { look(&taken)? };
            closer = all.filter(|all| are_fit(&plain, all));
        }
        if closer.is_none() && !exchanges.is_empty() {
            closer = look(&best.assignment)?;
        }
        let Some(mut closer) = closer else { return Ok(()) };
        let of_near =
            exchanges.into_iter().filter_map(|exchange| with_exchange(tables, &closer.assignment, exchange));
        let of_greater = ends.iter().flat_map(|ends| ends.exchanged(tables, &closer.assignment));
        for exchanged in of_near.chain(of_greater).collect::<Vec<_>>() {
            closer = look(&exchanged)?.filter(|other| other.score < closer.score).unwrap_or(closer);
        }
        let is_new = |pair: &[usize; 2]| !best.assignment.pairs.contains(pair);
        if closer.assignment.pairs.iter().any(is_new) {
            let Candidate { pairs, picture, assignment, .. } = closer;
            self.found[0] = Candidate { pairs, picture, assignment, ..best.clone() };
        }
        Ok(())
    }

    /// Judges small changes of the best, at most `options.changes`, and goes on from each that is better.
    fn improve(&mut self, tables: &Tables<'_>, monitor: &mut dyn Monitor) -> Result<(), Cancelled> {
        let most = self.options.changes;
        let mut tried: Vec<Assignment> = self.found.iter().map(|c| c.assignment.clone()).collect();
        let mut left = most;
        while let Some(best) = self.found.first().map(|best| best.assignment.clone()) {
            let mut better = false;
            let of_heads = uncrossed(tables, &best).into_iter().chain(with_twins(tables, &best));
            for change in of_heads.chain(moves(tables, &best)) {
                if left == 0 || better || monitor.wants_result() {
                    break;
                }
                if tried.iter().any(|known| known.pairs == change.pairs && known.between == change.between) {
                    continue;
                }
                let share = |left: usize| 1.0 - left as f64 / most as f64;
                better = self.judge(&change, &mut Portion::new(monitor, share(left), share(left - 1)))?;
                tried.push(change);
                left -= 1;
            }
            if !better {
                break;
            }
        }
        Ok(())
    }
}
