//! Doubts about landmark pairs: those that distances and orders make clear, and exchanges that coarse maps decide where these do not.

use crate::coarse_map::{BriefOptions, brief_map};
use crate::landmark_fit::{Finding, LandmarkFit, landmark_fit};
use crate::landmarks::{LandmarkId, Landmarks};
use crate::layout::LandmarkDistances;
use crate::math::scalar::min;
use crate::mesh::SurfaceMesh;
use crate::mesh::mirror::mirrored;
use crate::monitor::{Cancelled, Monitor, Portion, unless_stopped};

/// An exchange of two targets that distances and orders favour, but not clearly, is taken where the mean log density of a brief map with it is
/// below this many times that of one without it: left and right feet among six and eight ends of limbs of four-legged animals have .34 to
/// .79 (29 of 30 cases), correct sets .98 and more but for one (.84).
const LESS: f64 = 0.8;

/// The same for an exchange that they hardly oppose. Chosen by hand.
const LESS_OPPOSED: f64 = 0.7;

/// Landmarks among which clear exchanges have to lower the mean log density as well, at most: in correct sets of 6 to 16 ends distances and orders
/// call for one more often than among all landmarks. Chosen by hand.
const FEW: usize = 16;

/// Vertices of the coarse levels of brief maps: those of the first size on which there is a map without an exchange. Chosen by hand.
const VERTICES: [usize; 2] = [500, 1500];

/// Rounds in which exchanges are found, at most. Chosen by hand.
const MOST_ROUNDS: u8 = 6;

/// The doubts about landmarks of two meshes, which should be coarse (some 1,500 vertices), as a user would mend them: each exchange is one of the
/// pairs as those before it leave them.
///
/// # Errors
/// [`Cancelled`].
pub fn landmark_doubts(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Finding>, Cancelled> {
    let mut mended = landmarks.clone();
    let mut doubts = Vec::new();
    for round in 0..MOST_ROUNDS {
        let share = |done: f64| (f64::from(round) + done) / f64::from(MOST_ROUNDS);
        let measuring = &mut Portion::new(monitor, share(0.0), share(0.2));
        let distances = LandmarkDistances::new(meshes, &mended, measuring)?;
        let comparing = &mut Portion::new(monitor, share(0.2), share(0.5));
        let fit = landmark_fit(meshes, &mended, &distances, comparing)?;
        let deciding = &mut Portion::new(monitor, share(0.5), share(1.0));
        let found = match judged(meshes, &mended, fit, deciding)? {
            Judged::Exchanges(found) => found,
            Judged::Last(findings) => {
                doubts.extend(findings);
                break;
            }
        };
        // What was exchanged before is not exchanged back.
        let is_known =
            |finding: &Finding| doubts.iter().any(|d| exchanged_pairs(d) == exchanged_pairs(finding));
        if found.iter().any(is_known) {
            break;
        }
        found.iter().for_each(|finding| exchange(&mut mended, finding));
        doubts.extend(found);
    }
    Ok(doubts)
}

/// What is found in one round.
enum Judged {
    /// Exchanges, at least one; after them there may be others.
    Exchanges(Vec<Finding>),
    /// Findings, or none, after which nothing more is looked for.
    Last(Vec<Finding>),
}

/// What distances and orders find, as far as maps do not say otherwise.
fn judged(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    LandmarkFit { findings, favoured }: LandmarkFit,
    monitor: &mut dyn Monitor,
) -> Result<Judged, Cancelled> {
    let is_few = landmarks.len() <= FEW;
    if monitor.wants_result() {
        return Ok(Judged::Last(findings));
    }
    if is_few && matches!(findings[..], [Finding::Mirrored { .. }, ..]) {
        // One exchange among two or three pairs of partners reverses most orders.
        let exchange = in_place_of_a_mirror(meshes, landmarks, &favoured, monitor)?;
        return Ok(exchange.map_or(Judged::Last(findings), |exchange| Judged::Exchanges(vec![exchange])));
    }
    // A misplaced target spoils the map with every exchange and without.
    if findings.iter().any(|finding| exchanged_pairs(finding).is_none()) {
        return Ok(Judged::Last(findings));
    }
    if !is_few && !findings.is_empty() {
        return Ok(Judged::Exchanges(findings));
    }
    Ok(match decided(meshes, landmarks, [&findings, &favoured], monitor)? {
        Decision::Exchange { exchange, .. } => Judged::Exchanges(vec![exchange]),
        Decision::AsGiven => Judged::Last(Vec::new()),
        Decision::NoMap => Judged::Last(findings),
    })
}

/// The pairs of an exchange.
fn exchanged_pairs(finding: &Finding) -> Option<[LandmarkId; 2]> {
    match finding {
        Finding::Swapped { pairs, .. } => Some(*pairs),
        _ => None,
    }
}

fn exchange(landmarks: &mut Landmarks, finding: &Finding) {
    if let Some([a, b]) = exchanged_pairs(finding) {
        landmarks.target.swap(a, b);
    }
}

/// What maps say about exchanges.
enum Decision {
    /// There is no map without an exchange on coarse levels: among few vertices thin limbs leave paths no room. Nothing can be compared.
    NoMap,
    /// No map is clearly better than that without an exchange.
    AsGiven,
    /// The map with this exchange is the best; its mean log density, on levels with so many vertices.
    Exchange { exchange: Finding, mean_log: f64, vertices: usize },
}

/// Compares the map as given with those with one exchange: a clear one, whose map has to be better, or a favoured one, whose map has to be better
/// by far.
fn decided(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    [clear, favoured]: [&[Finding]; 2],
    monitor: &mut dyn Monitor,
) -> Result<Decision, Cancelled> {
    let is_clear = |finding: &Finding| clear.iter().any(|c| exchanged_pairs(c) == exchanged_pairs(finding));
    let others =
        favoured.iter().filter(|finding| !is_clear(finding)).map(|finding| (finding, share(finding)));
    let tried: Vec<(&Finding, f64)> = clear.iter().map(|finding| (finding, 1.0)).chain(others).collect();
    if tried.is_empty() {
        return Ok(Decision::AsGiven);
    }
    let maps = (tried.len() + 1) as f64;
    for vertices in VERTICES {
        let mean_log = |landmarks: &Landmarks, k: usize, monitor: &mut dyn Monitor| {
            let part = &mut Portion::new(monitor, k as f64 / maps, (k + 1) as f64 / maps);
            mean_log(meshes, landmarks, vertices, part)
        };
        let Some(as_given) = mean_log(landmarks, 0, monitor)? else { continue };
        let mut best = (as_given, Decision::AsGiven);
        for (k, &(finding, share)) in tried.iter().enumerate() {
            let mut mended = landmarks.clone();
            exchange(&mut mended, finding);
            if let Some(mean_log) = mean_log(&mended, k + 1, monitor)?
                && mean_log < min(best.0, share * as_given)
            {
                best = (mean_log, Decision::Exchange { exchange: *finding, mean_log, vertices });
            }
        }
        return Ok(best.1);
    }
    Ok(Decision::NoMap)
}

/// The share of the mean log density to which an exchange that is not clear has to lower it.
fn share(exchange: &Finding) -> f64 {
    match exchange {
        Finding::Swapped { agreement, .. } if *agreement > 0.0 => LESS_OPPOSED,
        _ => LESS,
    }
}

/// The exchange of a set that is called mirrored which fits far better than the set as given does, on the target and on its mirror image.
fn in_place_of_a_mirror(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    favoured: &[Finding],
    monitor: &mut dyn Monitor,
) -> Result<Option<Finding>, Cancelled> {
    let deciding = &mut Portion::new(monitor, 0.0, 0.8);
    let decision = decided(meshes, landmarks, [&[], favoured], deciding)?;
    let Decision::Exchange { exchange, mean_log: with_it, vertices } = decision else { return Ok(None) };
    let Ok(image) = mirrored(meshes[1]) else { return Ok(None) };
    let reflecting = &mut Portion::new(monitor, 0.8, 1.0);
    let reflected = mean_log([meshes[0], &image], landmarks, vertices, reflecting)?;
    Ok(reflected.is_some_and(|reflected| with_it < LESS * reflected).then_some(exchange))
}

/// The mean log density of the brief map with these landmarks on levels with so many vertices; `None` where there is none.
fn mean_log(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    vertices: usize,
    monitor: &mut dyn Monitor,
) -> Result<Option<f64>, Cancelled> {
    let options = BriefOptions { vertices, ..BriefOptions::default() };
    let sides = [&landmarks.source.raw[..], &landmarks.target.raw];
    brief_map(meshes, sides, &options, monitor, |_, mut map, monitor| {
        Ok(unless_stopped(map.relax(&options.relaxation, monitor))?.map(|_| map.mean_log))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo;
    use crate::mesh::coarsening::Level;
    use crate::monitor::Silent;

    /// A wolf and a cow on coarse levels, with six ends of their limbs as landmarks.
    fn ends() -> ([SurfaceMesh; 2], Landmarks) {
        let demo = demo::build("wolf-cow").unwrap();
        let is_end = |label: &str| ["nose", "tail tip"].contains(&label) || label.ends_with("foot");
        let pairs =
            demo.landmarks.iter().zip(&demo.labels).filter(|(_, label)| is_end(label)).map(|(pair, _)| *pair);
        let landmarks =
            Landmarks::from_vertices(&demo.source, &demo.target, &pairs.collect::<Vec<_>>()).unwrap();
        let sides = [&landmarks.source.raw, &landmarks.target.raw];
        let meshes = [&demo.source, &demo.target];
        let levels = [0, 1].map(|k| Level::coarse(meshes[k], sides[k], 800, &mut Silent).unwrap());
        let [source, target] = [0, 1].map(|k: usize| levels[k].numbers(sides[k]).collect());
        (levels.map(|level| level.mesh), Landmarks { source, target })
    }

    #[test]
    fn maps_decide_what_distances_and_orders_of_few_ends_do_not() {
        let (meshes, landmarks) = ends();
        assert_eq!(landmarks.len(), 6);
        let meshes = meshes.each_ref();
        assert_eq!(landmark_doubts(meshes, &landmarks, &mut Silent).unwrap(), []);
        // Fore and hind feet: the left ones come first.
        for pairs in [[1, 3], [2, 4]].map(|pair| pair.map(LandmarkId)) {
            let mut wrong = landmarks.clone();
            wrong.target.swap(pairs[0], pairs[1]);
            let distances = LandmarkDistances::new(meshes, &wrong, &mut Silent).unwrap();
            let alone = landmark_fit(meshes, &wrong, &distances, &mut Silent).unwrap();
            assert_eq!(alone.findings, []);
            let doubts = landmark_doubts(meshes, &wrong, &mut Silent).unwrap();
            assert_eq!(doubts.iter().map(exchanged_pairs).collect::<Vec<_>>(), [Some(pairs)], "{doubts:?}");
        }
    }
}
