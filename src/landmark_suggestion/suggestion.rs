//! Suggestions of further landmarks: ends of limbs first, then points far from all others.

use super::farthest::{Spread, farthest_points};
use super::symmetry::partners;
use super::tips::tips;
use crate::geodesic::{distances, shorten};
use crate::mesh::coarsening::Level;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion};

/// The reason for which a point is suggested.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// The end of a limb.
    Tip,
    /// Far from all landmarks and suggestions before it.
    Far,
}

/// A vertex suggested as a landmark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Suggestion {
    /// The vertex.
    pub vertex: VertexId,
    /// The reason.
    pub reason: Reason,
    /// For a tip, the number of the suggestion that is its partner under a symmetry, as the left foot is of the right one.
    pub partner: Option<usize>,
}

/// The number of suggestions where a user says nothing: the tips of a body with limbs, and a few places between.
pub const USUAL_COUNT: usize = 12;

/// Vertices of the level on which suggestions for larger meshes are computed: distances there are 0.3 to 0.6 % off in the mean.
const COARSE_VERTICES: usize = 4000;

/// Suggests at most `count` vertices for further landmarks, the best first: tips, the most remote
/// first, then farthest points. All are farther from each other and from `landmarks` than a tenth of the root of the area.
/// For a large mesh they are computed on a coarse level.
///
/// # Errors
/// [`Cancelled`].
pub fn suggest(
    mesh: &SurfaceMesh,
    landmarks: &[VertexId],
    count: usize,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Suggestion>, Cancelled> {
    if mesh.vertex_count() <= COARSE_VERTICES {
        return suggest_here(mesh, landmarks, count, monitor);
    }
    let level = Level::coarse(mesh, landmarks, COARSE_VERTICES, &mut Portion::new(monitor, 0.0, 0.0))?;
    let numbers: Vec<VertexId> = level.numbers(landmarks).collect();
    let found = suggest_here(&level.mesh, &numbers, count, monitor)?;
    Ok(found.into_iter().map(|s| Suggestion { vertex: level.vertices[s.vertex], ..s }).collect())
}

/// The suggestions for whose vertices `may` holds, with partners numbered among them.
pub fn kept(suggestions: &[Suggestion], may: impl Fn(VertexId) -> bool) -> Vec<Suggestion> {
    let mut next = 0;
    let numbers: Vec<Option<usize>> = suggestions
        .iter()
        .map(|s| {
            let number = may(s.vertex).then_some(next);
            next += usize::from(number.is_some());
            number
        })
        .collect();
    let left = suggestions.iter().zip(&numbers).filter(|(_, number)| number.is_some());
    left.map(|(s, _)| Suggestion { partner: s.partner.and_then(|k| numbers[k]), ..*s }).collect()
}

fn suggest_here(
    mesh: &SurfaceMesh,
    landmarks: &[VertexId],
    count: usize,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Suggestion>, Cancelled> {
    // Nearer points would mark one limb twice. Chosen by hand.
    let least = 0.1 * mesh.area().sqrt();
    let mut distance = distances(mesh, landmarks);
    let mut found = Vec::new();
    for vertex in tips(mesh, least, &mut Portion::new(monitor, 0.0, 0.7))? {
        if found.len() < count && distance[vertex] > least {
            found.push(Suggestion { vertex, reason: Reason::Tip, partner: None });
            shorten(mesh, &[vertex], &mut distance);
        }
    }
    let ends: Vec<VertexId> = found.iter().map(|s| s.vertex).collect();
    for (suggestion, partner) in
        found.iter_mut().zip(partners(mesh, &ends, &mut Portion::new(monitor, 0.7, 0.9))?)
    {
        suggestion.partner = partner;
    }
    let nothing_known = landmarks.is_empty() && found.is_empty();
    if nothing_known && count > 0 {
        // A ball: any point is as good as another.
        found.push(far(VertexId(0)));
        shorten(mesh, &[VertexId(0)], &mut distance);
    }
    let last = &mut Portion::new(monitor, 0.9, 1.0);
    let wanted = Spread { count: count - found.len(), least_distance: least };
    let rest = farthest_points(mesh, distance, wanted, |_| true, last)?;
    found.extend(rest.into_iter().map(far));
    Ok(found)
}

fn far(vertex: VertexId) -> Suggestion {
    Suggestion { vertex, reason: Reason::Far, partner: None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;

    #[test]
    fn suggestions_are_apart_from_each_other_and_from_the_landmarks() {
        let ball = icosphere(3);
        let least = 0.1 * ball.area().sqrt();
        for landmarks in [vec![], vec![VertexId(5), VertexId(300)]] {
            let found = suggest(&ball, &landmarks, 12, &mut Silent).unwrap();
            assert_eq!(found.len(), 12);
            let all: Vec<VertexId> =
                landmarks.iter().copied().chain(found.iter().map(|s| s.vertex)).collect();
            for (k, &v) in all.iter().enumerate() {
                let field = distances(&ball, &[v]);
                assert!(all.iter().skip(k.max(landmarks.len()) + 1).all(|&w| field[w] >= 0.97 * least));
            }
        }
        assert!(suggest(&ball, &[], 0, &mut Silent).unwrap().is_empty());
    }

    #[test]
    fn partners_are_numbered_among_the_suggestions_that_are_left() {
        let tip = |v: u32, partner| Suggestion { vertex: VertexId(v), reason: Reason::Tip, partner };
        let all = [tip(7, Some(3)), tip(8, Some(2)), tip(9, Some(1)), tip(10, Some(0)), far(VertexId(11))];
        assert_eq!(kept(&all, |_| true), all);
        let left = kept(&all, |v| v != VertexId(8));
        assert_eq!(left, [tip(7, Some(2)), tip(9, None), tip(10, Some(0)), far(VertexId(11))]);
    }

    #[test]
    fn feet_of_a_horse_have_their_partners_on_the_other_side() {
        let horse = crate::demo::build("horse-cat").unwrap().source;
        let fine = crate::mesh::generators::midpoint_subdivision(&horse);
        for mesh in [&horse, &fine] {
            let found = suggest(mesh, &[], 8, &mut Silent).unwrap();
            let place = |s: &Suggestion| mesh.positions()[s.vertex];
            let mut feet = 0;
            for (k, s) in found.iter().enumerate() {
                let Some(partner) = s.partner else { continue };
                assert_eq!(found[partner].partner, Some(k));
                let mirrored = place(&found[partner]) * glam::DVec3::new(1.0, 1.0, -1.0);
                assert!(place(s).distance(mirrored) < 0.15, "{} {}", place(s), mirrored);
                feet += usize::from(place(s).y < 0.1);
            }
            assert_eq!(feet, 4, "{found:?}");
        }
    }
}
