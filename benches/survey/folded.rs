//! Maps of bodies onto copies of themselves whose limbs are in other places and whose triangles are others: the true map is known.

use crate::arguments::Arguments;
use crate::case::{Case, Make, map_all};
use crate::clicked::Random;
use crate::common;
use crate::fit::folded;
use crate::repaired::energy_of_places;
use crate::table::{header, sum_up};
use conemap::mesh::SurfacePoint;
use conemap::monitor::Silent;
use conemap::remesh::{Options, carried, remesh};

/// The bodies: closed meshes of genus 0 with limbs.
const BODIES: [&str; 16] = [
    "shrec07/381",
    "shrec07/383",
    "shrec07/385",
    "shrec07/387",
    "shrec07/392",
    "shrec07/394",
    "shrec07/397",
    "shrec07/400",
    "sumner/horse",
    "sumner/camel",
    "sumner/cat",
    "sumner/lion",
    "single/homer",
    "single/cheburashka",
    "single/springer",
    "single/spot",
];

/// The largest angle of a fold, in radians.
const ANGLE: f64 = 1.2;

/// Maps each body onto a copy that is folded at random and remeshed to its number of faces, with 12 and with 6 landmarks, which are
/// farthest points and their true images. The energy of the true map stands in brackets. `--seeds N` maps N copies of each body,
/// `--landmarks N` takes that number of landmarks only, `--pairs FOLDER/NAME,...` chooses the bodies.
pub fn bodies(arguments: &Arguments) {
    header();
    let counts = if arguments.landmarks > 0 { vec![arguments.landmarks] } else { vec![12, 6] };
    let mut cases: Vec<Make<'_>> = Vec::new();
    for name in BODIES {
        if !arguments.pairs.is_empty() && !arguments.pairs.iter().any(|p| name.starts_with(p.as_str())) {
            continue;
        }
        for seed in arguments.seed..arguments.seed + arguments.seeds {
            for &count in &counts {
                cases.push(Box::new(move || case(arguments, name, seed, count)));
            }
        }
    }
    let outcomes = map_all(cases, arguments);
    for &count in &counts {
        let with_count = format!("{count} of");
        let own: Vec<_> = outcomes.iter().filter(|o| o.variant.starts_with(&with_count)).collect();
        sum_up(&format!("{count} landmarks"), &own);
        let errors = own.iter().filter_map(|o| o.reached.as_ref().ok()?.truth);
        let mut errors: Vec<f64> = errors.map(|[mean, _, _]| 100.0 * mean).collect();
        errors.sort_by(f64::total_cmp);
        let above = errors.iter().filter(|error| **error > 1.0).count();
        if let (Some(middle), Some(most)) = (errors.get(errors.len() / 2), errors.last()) {
            println!("distance to the truth: median {middle:.3} %, largest {most:.3} %, {above} above 1 %");
        }
    }
}

fn case(arguments: &Arguments, name: &str, seed: u64, count: usize) -> Case {
    let mesh = common::read_mesh(&arguments.data.join(format!("{name}.off")));
    let copy = folded(&mesh, ANGLE, &mut Random::new(seed));
    let faces = Options::to_faces(copy.face_count());
    let remeshed = remesh(&copy, &faces, &mut Silent).expect("a new mesh").mesh;
    let chosen = common::farthest_points(&mesh, count);
    let at = |on| chosen.iter().map(|&v| SurfacePoint::at_vertex(on, v)).collect::<Vec<_>>();
    let points = [at(&mesh), carried(&copy, &remeshed, &at(&copy))];
    let variant = format!("{count} of {seed} ({:.3})", energy_of_places([&mesh, &copy], |_| true).energy);
    let truth = Some(copy.positions().iter().copied().collect());
    Case { name: name.into(), variant, meshes: [mesh, remeshed], points, truth }
}
