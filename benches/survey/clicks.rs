//! Landmarks as users click them: inside faces, beside edges and on edges.

use crate::arguments::Arguments;
use crate::case::{Case, Make, map_all};
use crate::clicked::{Random, corner, moved};
use crate::table::{compare, header};
use conemap::mesh::SurfacePoint;
use conemap::mesh::insertion::insert;

/// Maps each pair with every landmark moved to a random point of a random face beside its vertex, on both meshes independently, and compares
/// with the map of the landmarks at their vertices.
pub fn random(arguments: &Arguments) {
    header();
    let mut cases: Vec<Make<'_>> = Vec::new();
    for name in arguments.names() {
        let vertices = name.clone();
        cases.push(Box::new(move || Case {
            variant: "vertices".into(),
            ..Case::of_pair(arguments, &vertices)
        }));
        for seed in 0..arguments.seeds {
            let name = name.clone();
            cases.push(Box::new(move || {
                let mut case = Case::of_pair(arguments, &name);
                let mut random = Random::new(seed);
                for k in 0..2 {
                    case.points[k] = moved(&case.meshes[k], &case.points[k], &mut random);
                }
                case.variant = format!("clicks {seed}");
                case
            }));
        }
    }
    compare(&map_all(cases, arguments), "vertices");
}

/// Maps each pair with its landmarks inside faces, given as such or as vertices of a refined mesh, and at other places beside the same
/// vertices; compares with the landmarks inside faces.
pub fn same_points(arguments: &Arguments) {
    header();
    let mut cases: Vec<Make<'_>> = Vec::new();
    for name in arguments.names() {
        for (variant, place) in PLACES {
            let name = name.clone();
            cases.push(Box::new(move || {
                let mut case = Case::of_pair(arguments, &name);
                for k in 0..2 {
                    let vertices: Vec<SurfacePoint> = case.points[k].clone();
                    case.points[k] = vertices.iter().map(|p| at(p, place)).collect();
                    if variant == "as vertices" {
                        let inserted =
                            insert(&case.meshes[k], &case.points[k]).expect("points can be inserted");
                        let at = |v: &conemap::mesh::VertexId| SurfacePoint::at_vertex(&inserted.mesh, *v);
                        case.points[k] = inserted.vertices.iter().map(at).collect();
                        case.meshes[k] = inserted.mesh;
                    }
                }
                case.truth = None;
                case.variant = variant.into();
                case
            }));
        }
    }
    compare(&map_all(cases, arguments), "in faces");
}

/// Where the landmarks are put in each variant: the barycentric weights of the landmark's own corner and of the two other corners of its face.
const PLACES: [(&str, [f64; 3]); 6] = [
    ("in faces", [0.6, 0.2, 0.2]),
    ("as vertices", [0.6, 0.2, 0.2]),
    ("on edges", [0.5, 0.5, 0.0]),
    ("beside edges", [0.499_999_5, 0.499_999_5, 1e-6]),
    ("beside 1e-9", [0.5, 0.5 - 2e-9, 2e-9]),
    ("beside corner", [1.0 - 2e-6, 1e-6, 1e-6]),
];

fn at(vertex: &SurfacePoint, [own, next, last]: [f64; 3]) -> SurfacePoint {
    let k = corner(vertex);
    let mut barycentric = [0.0; 3];
    (barycentric[k], barycentric[(k + 1) % 3], barycentric[(k + 2) % 3]) = (own, next, last);
    SurfacePoint { face: vertex.face, barycentric }
}
