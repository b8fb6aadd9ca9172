//! All doubts about a set of landmark pairs, in the order in which they are looked for.

use super::directions::Directions;
use super::distances::Fit;
use super::exchange::Exchange;
use super::finding::Finding;
use super::{chirality, orders};
use crate::landmarks::Landmarks;
use crate::layout::LandmarkDistances;
use crate::mesh::SurfaceMesh;
use crate::monitor::{Cancelled, Monitor, Portion, Step};

/// Fewer landmarks than these say too little about orders, or about places. Chosen by hand.
const LEAST_FOR_ORDERS: usize = 6;
const LEAST_FOR_PLACES: usize = 8;
/// The mean agreement, orders twice and places in space once, below which a set is mirrored.
///
/// Orders of correct sets of 8 and more landmarks agree by 0.3 to 0.95. Where one of both is wrong (orders on a body whose
/// front and back are equally long, places in bent poses), the other one keeps the mean above: none of 1190 correct sets, 510
/// of them bent, is below. Unbent mirror images are below in 96 %, all of them where all landmarks are used.
const MIRRORED: f64 = -0.4;

/// Checks whether landmark pairs can belong to a map of low distortion; no findings when all fit.
///
/// `distances` are those of the same meshes and landmarks, coarse ones (some 1000 vertices) for speed. More than
/// [`MOST_COMPARED`] landmarks are too many to compare each with each.
///
/// # Errors
/// [`Cancelled`].
pub fn landmark_fit(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    distances: &LandmarkDistances,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Finding>, Cancelled> {
    let directions = Directions::new(meshes, landmarks, distances);
    monitor.step(Step::default())?;
    let mut fit = Fit::new(landmarks, distances);
    let mirrored = |target_of: &[usize]| {
        let orders = orders::agreement(&directions, distances, target_of);
        let places = chirality::agreement(meshes, landmarks, distances, target_of);
        let mean = (2.0 * orders + places) / 3.0;
        (landmarks.len() >= LEAST_FOR_ORDERS && mean < MIRRORED).then_some(mean)
    };
    monitor.step(Step::default())?;
    let as_given = mirrored(&fit.target_of);
    monitor.step(Step::default())?;
    let ways = Exchange::new(distances, &directions, 1.0);
    let mut findings = exchanges(&mut fit, &ways, &mut Portion::new(monitor, 0.0, 0.4))?;
    // One exchange among few landmarks can reverse most orders: the set is mirrored where it is so without it, too.
    if let Some(agreement) = as_given.filter(|_| mirrored(&fit.target_of).is_some()) {
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
    Ok(findings)
}

/// Landmarks that are compared each with each, at most: every exchange of two is judged by all pairs of the others.
pub const MOST_COMPARED: usize = 100;

/// Exchanges that are told of, at most: a set with more is not a set with faults, but another one. Chosen by hand.
const MOST_EXCHANGES: usize = 12;

/// Exchanges targets as long as an exchange is clearly called for, and no result is wanted.
fn exchanges(
    fit: &mut Fit<'_>,
    exchange: &Exchange<'_>,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Finding>, Cancelled> {
    let mut findings = Vec::new();
    // More than half as many as pairs make no sense.
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
