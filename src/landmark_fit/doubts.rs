//! The search for all doubts about a set of landmark pairs: exchanged pairs, mirrored sets, misplaced pairs.

use super::directions::Directions;
use super::distances::Fit;
use super::exchange::Exchange;
use super::finding::Finding;
use super::{chirality, orders};
use crate::landmarks::{LandmarkId, Landmarks};
use crate::layout::LandmarkDistances;
use crate::mesh::SurfaceMesh;
use crate::monitor::{Cancelled, Monitor, Portion, Step};
use std::ops::RangeInclusive;
use typed_index_collections::TiSlice;

/// Least number of landmarks with which a set may be called mirrored. Chosen by hand.
const LEAST_FOR_ORDERS: usize = 6;
/// Least number of landmarks with which a pair may be called misplaced. Chosen by hand.
const LEAST_FOR_PLACES: usize = 8;
/// A set is mirrored where the mean agreement, with weight 2 for orders and 1 for places in space, is below this.
///
/// Orders of correct sets of 8 and more landmarks agree by 0.3 to 0.95. Where one of both is wrong (orders on a body whose
/// front and back are equally long, places in bent poses), the other one keeps the mean above: none of 1190 correct sets, 510
/// of them bent, is below. Of unbent mirror images 96 % are below, and all where all landmarks are used. But six ends of the limbs of a
/// scanned person who bends a leg were: so places in space must not say the contrary, as they do for 6 of 340 mirror images that are bent
/// strongly, and for none of the others.
const MIRRORED: f64 = -0.4;

/// What the comparison of distances, orders and volumes says about landmark pairs.
#[derive(Clone, Debug, Default)]
pub struct LandmarkFit {
    /// The doubts that are clear; none when all pairs fit.
    pub findings: Vec<Finding>,
    /// Exchanges of two targets, each a [`Finding::Swapped`], that are favoured or hardly opposed, the most favoured first: those of the findings and
    /// others. Among few landmarks most swapped pairs are found here alone, and some of the findings are wrong: maps with and without an
    /// exchange tell. Of a set that is called mirrored, these are the exchanges
    /// without a mirror. None of sets with fewer than four or more than forty pairs.
    pub favoured: Vec<Finding>,
}

/// Numbers of landmarks among which exchanges are favoured that are not clear: of larger sets nearly all exchanges are clear.
const UNCLEAR: RangeInclusive<usize> = 4..=40;

/// Checks whether landmark pairs can belong to a map of low distortion.
///
/// `distances` are those of the same meshes and landmarks; the meshes should be coarse (some 1000 vertices) for speed. The time grows
/// steeply with the landmarks, so the caller should not pass more than [`MOST_COMPARED`].
///
/// # Errors
/// [`Cancelled`].
pub fn landmark_fit(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    distances: &LandmarkDistances,
    monitor: &mut dyn Monitor,
) -> Result<LandmarkFit, Cancelled> {
    let directions = Directions::new(meshes, landmarks, distances);
    monitor.step(Step::default())?;
    let mut fit = Fit::new(landmarks, distances);
    let mirrored = |target_of: &TiSlice<LandmarkId, LandmarkId>| {
        let orders = orders::agreement(&directions, distances, target_of);
        let places = chirality::agreement(meshes, landmarks, distances, target_of);
        let mean = (2.0 * orders + places) / 3.0;
        (landmarks.len() >= LEAST_FOR_ORDERS && mean < MIRRORED && places < 0.0).then_some(mean)
    };
    monitor.step(Step::default())?;
    let as_given = mirrored(&fit.target_of);
    monitor.step(Step::default())?;
    let ways = Exchange::new(distances, &directions, 1.0);
    let favoured = if UNCLEAR.contains(&landmarks.len()) {
        ways.favoured(&fit, &mut Portion::new(monitor, 0.0, 0.0))?
    } else {
        Vec::new()
    };
    let mut findings = exchanges(&mut fit, &ways, &mut Portion::new(monitor, 0.0, 0.4))?;
    // One exchange among few landmarks can reverse most orders: the set is mirrored only where it is so after exchanges, too.
    let mirrored = as_given.filter(|_| mirrored(&fit.target_of).is_some());
    if let Some(agreement) = mirrored {
        fit = Fit::new(landmarks, distances);
        findings = vec![Finding::Mirrored { agreement }];
        let ways = Exchange::new(distances, &directions, -1.0);
        findings.extend(exchanges(&mut fit, &ways, &mut Portion::new(monitor, 0.4, 0.8))?);
    }
    if landmarks.len() >= LEAST_FOR_PLACES {
        let monitor = &mut Portion::new(monitor, 0.8, 1.0);
        while let Some(finding) = fit.worst_misplaced(monitor)? {
            let share = fit.left_out.iter().filter(|out| **out).count() as f64 / landmarks.len() as f64;
            monitor.step(Step { fraction: share, residual: None })?;
            let Finding::Misplaced { pair, .. } = finding else { break };
            fit.left_out[pair] = true;
            findings.push(finding);
        }
    }
    Ok(LandmarkFit { findings, favoured })
}

/// Landmarks that are compared with each other, at most: every exchange of two is judged by all pairs of the others. Chosen by hand.
pub const MOST_COMPARED: usize = 100;

/// Exchanges that are reported, at most: a set with more is not the intended one with mistakes, but another one. Chosen by hand.
const MOST_EXCHANGES: usize = 12;

/// Exchanges targets in `fit` as long as an exchange is clearly better and the monitor does not want a result; returns the exchanges.
fn exchanges(
    fit: &mut Fit<'_>,
    exchange: &Exchange<'_>,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Finding>, Cancelled> {
    let mut findings = Vec::new();
    // An exchange takes two pairs.
    let most = MOST_EXCHANGES.min(fit.target_of.len() / 2);
    for k in 0..most {
        if monitor.wants_result() {
            break;
        }
        let part = &mut Portion::new(monitor, k as f64 / most as f64, (k + 1) as f64 / most as f64);
        let Some(finding) = exchange.best(fit, part)? else { break };
        let Finding::Swapped { pairs: [a, b], .. } = finding else { break };
        fit.target_of.swap(a, b);
        findings.push(finding);
    }
    Ok(findings)
}
