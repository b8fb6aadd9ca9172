//! Maps of surfaces that are cut into other triangles.

use crate::arguments::Arguments;
use crate::case::{Case, Make, map_all};
use crate::other_triangles::{cut_by_planes, drawn_out};
use crate::table::{compare, header};
use conemap::mesh::SurfaceMesh;
use conemap::mesh::generators::midpoint_subdivision;
use conemap::monitor::Silent;
use conemap::remesh::{EdgeLengths, Noise, Options, carried, decimated, perturbed, remesh};

/// Maps each pair with its target remeshed in several ways, its landmarks carried to the nearest points, which lie inside faces; compares
/// with the map of the pair as it is.
pub fn targets(arguments: &Arguments) {
    header();
    let mut cases: Vec<Make<'_>> = Vec::new();
    for name in arguments.names() {
        for (variant, remade) in WAYS {
            if !arguments.variants.is_empty() && !arguments.variants.iter().any(|v| v == variant) {
                continue;
            }
            let name = name.clone();
            cases.push(Box::new(move || {
                let mut case = Case::of_pair(arguments, &name);
                case.variant = variant.into();
                if let Some(target) = remade(&case.meshes[1]) {
                    case.points[1] = carried(&case.meshes[1], &target, &case.points[1]);
                    case.meshes[1] = target;
                }
                case
            }));
        }
    }
    compare(&map_all(cases, arguments), "as it is");
}

/// Maps pairs with a known truth, with the target as it is (the source's connectivity) and remeshed to its own number of faces, and with
/// 33, 12 and 6 landmarks.
pub fn truth(arguments: &Arguments) {
    header();
    let counts = if arguments.landmarks > 0 { vec![arguments.landmarks] } else { vec![33, 12, 6] };
    let mut cases: Vec<Make<'_>> = Vec::new();
    for name in arguments.names() {
        for &count in &counts {
            for (variant, remade) in [WAYS[0], WAYS[2]] {
                let name = name.clone();
                cases.push(Box::new(move || {
                    let thinned = Arguments { landmarks: count, ..arguments.clone() };
                    let mut case = Case::of_pair(&thinned, &name);
                    case.variant = format!("{variant}, {count}");
                    if let Some(target) = remade(&case.meshes[1]) {
                        case.points[1] = carried(&case.meshes[1], &target, &case.points[1]);
                        case.meshes[1] = target;
                    }
                    case
                }));
            }
        }
    }
    let outcomes = map_all(cases, arguments);
    crate::table::sum_up("truth", &outcomes.iter().collect::<Vec<_>>());
}

/// Cuts a surface into other triangles; `None` where it stays as it is.
type Remade = fn(&SurfaceMesh) -> Option<SurfaceMesh>;

/// The ways in which a target is remeshed, by name.
const WAYS: [(&str, Remade); 10] = [
    ("as it is", |_| None),
    ("half", |mesh| Some(isotropic(mesh, 0.5))),
    ("isotropic", |mesh| Some(isotropic(mesh, 1.0))),
    ("double", |mesh| Some(isotropic(mesh, 2.0))),
    ("3000 faces", |mesh| Some(decimated(mesh, 3000))),
    ("1000 faces", |mesh| Some(decimated(mesh, 1000))),
    ("drawn out", |mesh| Some(drawn_out(mesh, mesh.face_count(), 5.0))),
    ("cut by planes", |mesh| Some(cut_by_planes(mesh, 2.0 * EdgeLengths::of(mesh).mean))),
    ("subdivided", |mesh| Some(midpoint_subdivision(mesh))),
    ("noise", |mesh| Some(perturbed(mesh, Noise { tangential: 0.1, normal: 0.1, seed: 1 }))),
];

fn isotropic(mesh: &SurfaceMesh, share: f64) -> SurfaceMesh {
    let faces = (share * mesh.face_count() as f64) as usize;
    remesh(mesh, &Options::to_faces(faces), &mut Silent).expect("a new mesh").mesh
}
