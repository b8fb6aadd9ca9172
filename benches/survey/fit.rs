//! Landmarks that do not fit: how often correct pairs raise a false alarm, and which share of the faults put in on purpose is named.
//!
//! The correct pairs are those of the data folder as they are, with source and target exchanged, with few of their landmarks, with landmarks
//! clicked beside their vertices or moved by up to 3 % of the root of the area, and with targets bent by folds of space. The module
//! `fit_faults` puts in the faults.

use crate::arguments::Arguments;
use crate::clicked::{Random, moved};
use crate::common;
use crate::fit_faults as faults;
use conemap::landmark_fit::Finding;
use conemap::landmarks::Landmarks;
use conemap::mesh::coarsening::Level;
use conemap::mesh::insertion::insert;
use conemap::mesh::mirror::mirrored;
use conemap::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{FINDINGS_VERTICES, landmark_doubts};
use cpu_time::ThreadTime;
use glam::{DQuat, DVec3};
use std::collections::BTreeMap;

/// The numbers of landmarks that are tried, besides all of them.
pub const COUNTS: [usize; 6] = [4, 5, 6, 8, 12, 16];
/// The largest distance by which landmarks are moved, in units of the root of the area.
const MOVED: f64 = 0.03;
/// The number of folds that bend a mesh.
const FOLDS: usize = 4;
/// The largest angles of a fold that are tried, in radians.
const ANGLES: [f64; 3] = [0.6, 1.2, 1.8];
/// The width of the band in which a fold bends, in units of the root of the area.
const WIDTH: f64 = 0.06;

/// Two coarse meshes with corresponding vertices.
#[derive(Clone)]
pub struct Fit {
    pub name: String,
    pub meshes: [SurfaceMesh; 2],
    pub landmarks: Landmarks,
    /// The number of each landmark in the pair file.
    pub numbers: Vec<usize>,
}

impl Fit {
    fn coarse(name: &str, meshes: [&SurfaceMesh; 2], landmarks: &Landmarks) -> Self {
        let sides = [&landmarks.source, &landmarks.target];
        let levels = [0, 1].map(|s| {
            Level::coarse(meshes[s], &sides[s].raw, FINDINGS_VERTICES, &mut Silent).expect("nobody stops")
        });
        let [source, target] = [0, 1].map(|s| levels[s].numbers(sides[s]).collect());
        let meshes = levels.map(|level| level.mesh);
        let numbers = (0..landmarks.len()).collect();
        Self { name: name.into(), meshes, landmarks: Landmarks { source, target }, numbers }
    }

    pub fn findings(&self) -> Vec<Finding> {
        let meshes = [&self.meshes[0], &self.meshes[1]];
        landmark_doubts(meshes, &self.landmarks, &mut Silent).expect("nobody stops")
    }

    /// The same meshes with some of the landmarks, chosen at random and in random order.
    pub fn some(&self, count: usize, random: &mut Random) -> Self {
        let mut left: Vec<usize> = (0..self.numbers.len()).collect();
        let count = count.min(left.len());
        let chosen: Vec<usize> =
            (0..count).map(|_| left.swap_remove((random.share() * left.len() as f64) as usize)).collect();
        self.only(&chosen)
    }

    /// The same meshes with these landmarks alone, in this order.
    pub fn only(&self, chosen: &[usize]) -> Self {
        let of = |all: &[VertexId]| chosen.iter().map(|&k| all[k]).collect();
        let landmarks =
            Landmarks { source: of(&self.landmarks.source.raw), target: of(&self.landmarks.target.raw) };
        Self { landmarks, numbers: chosen.iter().map(|&k| self.numbers[k]).collect(), ..self.clone() }
    }

    fn turned(&self) -> Self {
        let [source, target] = self.meshes.clone();
        let landmarks =
            Landmarks { source: self.landmarks.target.clone(), target: self.landmarks.source.clone() };
        Self { meshes: [target, source], landmarks, ..self.clone() }
    }

    pub fn reflected(&self) -> Self {
        let [source, target] = &self.meshes;
        let image = mirrored(target).expect("a mirror image is a mesh");
        Self { meshes: [source.clone(), image], ..self.clone() }
    }
}

/// The counts of a table, by the title of a row and the number of landmarks: all cases, then the cases of each of the three columns.
#[derive(Default)]
pub struct Counts(BTreeMap<(String, usize), [usize; 4]>);

impl Counts {
    /// Adds a case, and counts it in those of the three columns that are true.
    pub fn add(&mut self, row: &str, landmarks: usize, columns: [bool; 3]) {
        let counts = self.0.entry((row.to_owned(), landmarks)).or_default();
        counts[0] += 1;
        columns.iter().zip(&mut counts[1..]).for_each(|(yes, count)| *count += usize::from(*yes));
    }

    pub fn print(&self, title: &str, columns: [&str; 3]) {
        println!("{title}");
        println!(
            "{:24} {:>9} {:>7} {:>12} {:>12} {:>12}",
            "", "landmarks", "cases", columns[0], columns[1], columns[2]
        );
        for ((row, landmarks), [cases, counts @ ..]) in &self.0 {
            let share = |count: usize| format!("{count} {:5.1}%", 100.0 * count as f64 / *cases as f64);
            let landmarks = if *landmarks == usize::MAX { "all".into() } else { landmarks.to_string() };
            let [a, b, c] = counts.map(share);
            println!("{row:24} {landmarks:>9} {cases:7} {a:>12} {b:>12} {c:>12}");
        }
    }
}

/// Prints the table of false alarms and the table of faults.
pub fn table(arguments: &Arguments) {
    let (mut alarms, mut named) = (Counts::default(), Counts::default());
    for name in arguments.names() {
        let pair = common::read_pair(&arguments.data, &name);
        let landmarks = common::landmarks(&pair);
        let meshes = [&pair.source, &pair.target];
        let plain = Fit::coarse(&name, meshes, &landmarks);
        let partners = faults::partners(&pair);
        for seed in 0..arguments.seeds {
            let mut random = Random::new(seed);
            correct("as they are", &plain, &mut random, &mut alarms);
            correct("exchanged", &plain.turned(), &mut random, &mut alarms);
            correct("clicked", &clicked(&name, meshes, &landmarks, &mut random), &mut random, &mut alarms);
            let jittered = jittered(meshes, &landmarks, &mut random);
            correct("moved by 3 %", &Fit::coarse(&name, meshes, &jittered), &mut random, &mut alarms);
            for angle in ANGLES {
                let bent = [meshes[0].clone(), folded(meshes[1], angle, &mut random)];
                let bent = Fit::coarse(&name, [&bent[0], &bent[1]], &landmarks);
                correct(&format!("bent by {angle} rad"), &bent, &mut random, &mut alarms);
                faults::mirror(&format!("mirrored, bent {angle}"), &bent, &mut random, &mut named);
            }
            faults::all(&plain, &partners, &mut random, &mut named);
        }
    }
    processor_time(arguments);
    alarms.print("false alarms on correct pairs", ["mirrored", "swapped", "misplaced"]);
    named.print("faults", ["named", "first, alone", "another pair"]);
}

/// Prints the processor time that the doubts take, and that of the coarse levels that they need.
fn processor_time(arguments: &Arguments) {
    let mut seconds = [0.0; 2];
    for name in arguments.names() {
        let pair = common::read_pair(&arguments.data, &name);
        let landmarks = common::landmarks(&pair);
        let begun = ThreadTime::now();
        let fit = Fit::coarse(&name, [&pair.source, &pair.target], &landmarks);
        seconds[0] += begun.elapsed().as_secs_f64();
        let begun = ThreadTime::now();
        fit.findings();
        seconds[1] += begun.elapsed().as_secs_f64();
    }
    let [levels, doubts] = seconds;
    println!("cpu: coarse levels {levels:.2} s, doubts {doubts:.2} s");
}

/// Counts the alarms on a correct pair, with all of its landmarks, with some, and with few ends of limbs.
fn correct(row: &str, fit: &Fit, random: &mut Random, alarms: &mut Counts) {
    alarm(row, usize::MAX, fit, alarms);
    for landmarks in COUNTS {
        alarm(row, landmarks, &fit.some(landmarks, random), alarms);
        alarm(&format!("{row}, ends"), landmarks, &faults::with_ends(fit, &[], landmarks).0, alarms);
    }
}

fn alarm(row: &str, landmarks: usize, fit: &Fit, alarms: &mut Counts) {
    let findings = fit.findings();
    let any = |is: fn(&Finding) -> bool| findings.iter().any(is);
    let kinds = [
        any(|f| matches!(f, Finding::Mirrored { .. })),
        any(|f| matches!(f, Finding::Swapped { .. })),
        any(|f| matches!(f, Finding::Misplaced { .. })),
    ];
    if !findings.is_empty() {
        println!("alarm: {} {row}, landmarks {:?}: {findings:?}", fit.name, fit.numbers);
    }
    alarms.add(row, landmarks, kinds);
}

fn clicked(name: &str, meshes: [&SurfaceMesh; 2], landmarks: &Landmarks, random: &mut Random) -> Fit {
    let sides = [&landmarks.source, &landmarks.target];
    let inserted = [0, 1].map(|s| {
        let points: Vec<_> = sides[s].iter().map(|&v| SurfacePoint::at_vertex(meshes[s], v)).collect();
        insert(meshes[s], &moved(meshes[s], &points, random)).expect("points can be inserted")
    });
    let [source, target] = [0, 1].map(|s: usize| inserted[s].vertices.clone());
    Fit::coarse(
        name,
        [&inserted[0].mesh, &inserted[1].mesh],
        &Landmarks { source: source.into(), target: target.into() },
    )
}

fn jittered(meshes: [&SurfaceMesh; 2], landmarks: &Landmarks, random: &mut Random) -> Landmarks {
    let mut sides = [landmarks.source.raw.clone(), landmarks.target.raw.clone()];
    for (mesh, side) in meshes.iter().zip(&mut sides) {
        for k in 0..side.len() {
            let around = around(mesh, side[k], MOVED * random.share());
            let place = around[(random.share() * around.len() as f64) as usize];
            if !side.contains(&place) {
                side[k] = place;
            }
        }
    }
    let [source, target] = sides;
    Landmarks { source: source.into(), target: target.into() }
}

/// The vertices that are connected with a vertex inside the ball around it, itself among them; the radius is in units of the root of the area.
pub fn around(mesh: &SurfaceMesh, v: VertexId, radius: f64) -> Vec<VertexId> {
    let radius = radius * mesh.area().sqrt();
    let near = |w: VertexId| mesh.positions()[w].distance(mesh.positions()[v]) <= radius;
    let mut found = vec![v];
    let mut next = 0;
    while next < found.len() {
        let ring: Vec<_> = mesh.star(found[next]).map(|h| mesh.head(h)).collect();
        for w in ring {
            if near(w) && !found.contains(&w) {
                found.push(w);
            }
        }
        next += 1;
    }
    found
}

/// Bends a mesh by random folds of space: each turns what lies beyond a random plane about a line in that plane, by at most `angle`
/// radians, with a smooth transition.
pub fn folded(mesh: &SurfaceMesh, angle: f64, random: &mut Random) -> SurfaceMesh {
    let width = WIDTH * mesh.area().sqrt();
    let mut places: Vec<DVec3> = mesh.positions().iter().copied().collect();
    for _ in 0..FOLDS {
        let normal = direction(random);
        let centre = places[(random.share() * places.len() as f64) as usize];
        let axis = normal.cross(direction(random)).normalize_or(normal.any_orthonormal_vector());
        let angle = angle * (2.0 * random.share() - 1.0);
        for place in &mut places {
            let from = *place - centre;
            let share = 0.5 + 0.5 * (0.5 * from.dot(normal) / width).tanh();
            *place = centre + DQuat::from_axis_angle(axis, angle * share) * from;
        }
    }
    mesh.with_positions(places.into_iter().collect())
}

fn direction(random: &mut Random) -> DVec3 {
    loop {
        let v = 2.0 * DVec3::new(random.share(), random.share(), random.share()) - DVec3::ONE;
        if v.length() < 1.0 && v.length() > 0.1 {
            return v.normalize();
        }
    }
}
