//! Landmarks that were clicked beside their places and are declared soft.

use crate::arguments::Arguments;
use crate::case::{Case, Make, map_all};
use crate::clicked::Random;
use crate::table::{compare, header};
use conemap::mesh::closest_point::closest_point;
use conemap::mesh::{SurfaceMesh, SurfacePoint};
use conemap::monitor::Silent;
use conemap::soft_landmarks::{SettlingInput, SettlingOptions, settle};
use glam::DVec3;

/// The distance by which each click misses, in units of the root of the target's area.
const MISS: f64 = 0.015;
/// The radius within which soft landmarks may move, in the same unit.
const RADIUS: f64 = 0.02;

/// Maps pairs with a known truth after all landmarks on the target were moved by `MISS` in random directions: once held there, and once
/// soft. The right landmarks are declared soft, too. Compares with the map of the right landmarks.
pub fn table(arguments: &Arguments) {
    header();
    let mut cases: Vec<Make<'_>> = Vec::new();
    for name in arguments.names() {
        let right = name.clone();
        cases.push(Box::new(move || Case { variant: "right".into(), ..Case::of_pair(arguments, &right) }));
        for seed in 0..arguments.seeds {
            let held = name.clone();
            cases.push(Box::new(move || missed(arguments, &held, seed)));
            let soft = name.clone();
            cases.push(Box::new(move || settled(missed(arguments, &soft, seed))));
            let untouched = name.clone();
            cases.push(Box::new(move || {
                let mut case = settled(Case::of_pair(arguments, &untouched));
                case.variant = "right, soft".into();
                case
            }));
        }
    }
    compare(&map_all(cases, arguments), "right");
}

/// A pair whose landmarks on the target are clicked beside their places.
fn missed(arguments: &Arguments, name: &str, seed: u64) -> Case {
    let mut case = Case::of_pair(arguments, name);
    let mut random = Random::new(seed);
    let mesh = &case.meshes[1];
    case.points[1] = case.points[1].iter().map(|point| beside(mesh, point, &mut random)).collect();
    case.variant = format!("missed {seed}");
    case
}

/// The point of the surface nearest to one beside a point, in a random direction of its tangent plane.
fn beside(mesh: &SurfaceMesh, point: &SurfacePoint, random: &mut Random) -> SurfacePoint {
    let [a, b, c] = mesh.corners(point.face);
    let normal = (b - a).cross(c - a).normalize();
    let mut next = || random.share() - 0.5;
    let way = DVec3::new(next(), next(), next()).reject_from_normalized(normal).normalize();
    closest_point(mesh, point.position(mesh) + way * (MISS * mesh.area().sqrt()), normal)
}

/// Declares all landmarks of a case soft, lets them settle, and prints how far they are from their true places before and after.
fn settled(mut case: Case) -> Case {
    let meshes = [&case.meshes[0], &case.meshes[1]];
    let points: Vec<[SurfacePoint; 2]> =
        case.points[0].iter().zip(&case.points[1]).map(|(s, t)| [*s, *t]).collect();
    let radii = vec![RADIUS; points.len()];
    let input = SettlingInput { meshes, points: &points, radii: &radii, may_hold: &|_| true };
    let settled = settle(input, &SettlingOptions::default(), &mut Silent).expect("nobody cancels");
    let told = case.truth.as_ref().map(|truth| {
        let off = |k: usize, place: &SurfacePoint| {
            let [s, _] = points[k];
            place.position(meshes[1]).distance(truth[s.heaviest_corner(meshes[0]).index()])
                / meshes[1].area().sqrt()
        };
        let mean = |places: &mut dyn Iterator<Item = f64>| places.sum::<f64>() / points.len() as f64;
        let before = mean(&mut points.iter().enumerate().map(|(k, ends)| off(k, &ends[1])));
        let after = mean(&mut settled.places.iter().enumerate().map(|(k, place)| off(k, place)));
        format!("landmarks off by {:.2} % before, {:.2} % after", 100.0 * before, 100.0 * after)
    });
    println!("{:20} {} in {} rounds", case.name, told.unwrap_or_default(), settled.rounds);
    case.points[1] = settled.places;
    case.variant = case.variant.replace("missed", "soft");
    case
}
