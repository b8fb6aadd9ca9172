//! Faults that are put into landmark pairs on purpose: mirrored sets, targets exchanged between left and right partners or between any two
//! pairs, and targets moved away.

use crate::clicked::Random;
use crate::common::Pair;
use crate::ends::{ends, partners_among};
use crate::fit::{COUNTS, Counts, Fit};
use crate::shrec07;
use conemap::landmark_fit::{Finding, Repair};
use conemap::landmarks::{LandmarkId, MeshSide};
use conemap::layout::LandmarkDistances;
use conemap::mesh::VertexId;
use conemap::monitor::Silent;

/// The distance between two landmarks, in units of the root of the area, below which the table calls them near.
const NEAR: f64 = 0.3;
/// The distances by which targets are moved away, in units of the root of the area.
const AWAY: [f64; 4] = [0.1, 0.2, 0.3, 0.5];
/// The number of random faults of each kind for each pair of meshes and each number of landmarks.
const REPETITIONS: usize = 2;

/// The left and right partners of a pair file: the known ones of SHREC07, or else those that the landmarks' names tell.
pub fn partners(pair: &Pair) -> Vec<[usize; 2]> {
    if shrec07::is_of(&pair.name) {
        return shrec07::PARTNERS.to_vec();
    }
    let labels = pair.file.labels.as_deref().unwrap_or_default();
    let partner = |(left, label): (usize, &String)| {
        let mirrored = format!("right{}", label.strip_prefix("left")?);
        // A point on the outside of a paw is named "left side" on a left paw and "right side" on a right one.
        let other = mirrored.replace("left side", "right side");
        let right = labels.iter().position(|l| *l == mirrored || *l == other)?;
        Some([left, right])
    };
    labels.iter().enumerate().filter_map(partner).collect()
}

/// Puts in and counts all faults but those of bent meshes.
pub fn all(fit: &Fit, partners: &[[usize; 2]], random: &mut Random, named: &mut Counts) {
    mirror("mirrored", fit, random, named);
    single("left and right", usize::MAX, fit, partners, named);
    for landmarks in COUNTS {
        let (ends, partners) = with_ends(fit, partners, landmarks);
        single("left and right, ends", landmarks, &ends, &partners, named);
    }
    several(fit, partners, random, named);
    for landmarks in COUNTS.into_iter().chain([usize::MAX]) {
        for _ in 0..REPETITIONS {
            let some = fit.some(landmarks, random);
            exchanged(landmarks, &some, random, named);
            AWAY.iter().for_each(|&away| misplaced((landmarks, away), &some, random, named));
        }
    }
}

/// Mirrors the target and counts how often the set is named as mirrored, how often that is the only finding, and how often there are others.
pub fn mirror(row: &str, fit: &Fit, random: &mut Random, named: &mut Counts) {
    for landmarks in COUNTS.into_iter().chain([usize::MAX]) {
        let findings = fit.some(landmarks, random).reflected().findings();
        let is = |f: &Finding| matches!(f, Finding::Mirrored { .. });
        let others = findings.iter().any(|f| !is(f));
        let told = findings.iter().any(is);
        named.add(row, landmarks, [told, told && !others, others]);
    }
}

/// Exchanges the targets of each pair of partners in turn.
fn single(row: &str, landmarks: usize, fit: &Fit, partners: &[[usize; 2]], named: &mut Counts) {
    for &[a, b] in partners {
        let mut wrong = fit.clone();
        wrong.landmarks.target.raw.swap(a, b);
        count((row, landmarks), &wrong, [a.min(b), a.max(b)], named);
    }
}

/// The same meshes with few of the landmarks, mostly ends of limbs, and the partners among them.
pub fn with_ends(fit: &Fit, partners: &[[usize; 2]], count: usize) -> (Fit, Vec<[usize; 2]>) {
    let chosen = ends(&fit.meshes[0], &fit.landmarks.source.raw, count);
    (fit.only(&chosen), partners_among(&chosen, partners))
}

/// Exchanges the targets of two and of three pairs of partners at once: these count as named where a swap that is found is one of them.
fn several(fit: &Fit, partners: &[[usize; 2]], random: &mut Random, named: &mut Counts) {
    for count in [2, 3] {
        if partners.len() < count {
            continue;
        }
        let mut left = partners.to_vec();
        let chosen: Vec<[usize; 2]> =
            (0..count).map(|_| left.swap_remove((random.share() * left.len() as f64) as usize)).collect();
        let mut wrong = fit.clone();
        chosen.iter().for_each(|&[a, b]| wrong.landmarks.target.raw.swap(a, b));
        let findings = wrong.findings();
        let swaps = swaps(&findings);
        let is = |[a, b]: &[usize; 2]| chosen.contains(&[*a, *b]) || chosen.contains(&[*b, *a]);
        let (right, wrong) = (swaps.iter().filter(|s| is(s)).count(), swaps.iter().any(|s| !is(s)));
        let row = format!("{count} left and right");
        named.add(&row, usize::MAX, [right > 0, right == count && findings.len() == count, wrong]);
    }
}

/// Exchanges the targets of two random pairs.
fn exchanged(landmarks: usize, fit: &Fit, random: &mut Random, named: &mut Counts) {
    let n = fit.numbers.len();
    let a = (random.share() * n as f64) as usize;
    let b = (a + 1 + (random.share() * (n - 1) as f64) as usize) % n;
    let distances = LandmarkDistances::new([&fit.meshes[0], &fit.meshes[1]], &fit.landmarks, &mut Silent)
        .expect("nobody stops");
    let row = if distances.between([a, b].map(LandmarkId::from))[0] < NEAR {
        "any two, near"
    } else {
        "any two, far"
    };
    let mut wrong = fit.clone();
    wrong.landmarks.target.raw.swap(a, b);
    count((row, landmarks), &wrong, [a.min(b), a.max(b)], named);
}

/// Moves the target of one random pair to another vertex at about the given distance along the surface.
fn misplaced((landmarks, away): (usize, f64), fit: &Fit, random: &mut Random, named: &mut Counts) {
    let pair = LandmarkId::from((random.share() * fit.numbers.len() as f64) as usize);
    let distances = LandmarkDistances::new([&fit.meshes[0], &fit.meshes[1]], &fit.landmarks, &mut Silent)
        .expect("nobody stops");
    let field = distances.field(MeshSide::Target, pair);
    let is = |v: &VertexId| (field[*v] - away).abs() < 0.03 && !fit.landmarks.target.contains(v);
    let places: Vec<VertexId> = fit.meshes[1].vertices().filter(is).collect();
    if places.is_empty() {
        return;
    }
    let mut wrong = fit.clone();
    wrong.landmarks.target[pair] = places[(random.share() * places.len() as f64) as usize];
    let findings = wrong.findings();
    let told = findings.iter().any(|f| f.repair() == Repair::Check { pair });
    let others = findings.iter().any(|f| f.repair() != Repair::Check { pair });
    if !swaps(&findings).is_empty() {
        println!("not exchanged: {} pair {}, by {away}: {findings:?}", fit.name, fit.numbers[pair.index()]);
    }
    named.add(&format!("misplaced by {away}"), landmarks, [told, told && !others, others]);
}

fn count((row, landmarks): (&str, usize), wrong: &Fit, pairs: [usize; 2], named: &mut Counts) {
    let findings = wrong.findings();
    let swaps = swaps(&findings);
    let first =
        findings.first().is_some_and(|f| f.repair() == Repair::Swap { pairs: pairs.map(LandmarkId::from) });
    if !first {
        let numbers = pairs.map(|k| wrong.numbers[k]);
        println!("not named: {} {row}, pairs {numbers:?}: {findings:?}", wrong.name);
    }
    named.add(
        row,
        landmarks,
        [swaps.contains(&pairs), first && findings.len() == 1, swaps.iter().any(|s| *s != pairs)],
    );
}

fn swaps(findings: &[Finding]) -> Vec<[usize; 2]> {
    let swap = |finding: &Finding| match finding.repair() {
        Repair::Swap { pairs } => Some(pairs.map(LandmarkId::index)),
        _ => None,
    };
    findings.iter().filter_map(swap).collect()
}
