//! The judgement of a soup, fault by fault.

use super::checked_mesh::CheckedMesh;
use super::edges::{EdgeTable, check_components};
use super::fault::{Elements, MeshFault};
use super::orientation::{orient, signed_volume};
use super::triangulated::{check_degenerate, triangulated};
use super::vertices::{check_fans, used_vertices};
use crate::mesh::soup::PolygonSoup;
use crate::mesh::{FaceId, FileFrame, SurfaceMesh, VertexId};
use typed_index_collections::TiVec;

/// The tetrahedron has the fewest faces of all closed surfaces without handles that lie in space.
const LEAST_FACES: usize = 4;

/// Judges a soup: polygons are triangulated, orientations made to agree and to face outwards, unused vertices left out.
///
/// # Errors
/// The first [`MeshFault`] in the order of the enum, with counts and file numbers.
pub fn closed_genus_zero(soup: &PolygonSoup) -> Result<CheckedMesh, MeshFault> {
    closed_genus_zero_asking(soup, &mut || Ok(()))
}

/// Judges a soup, and asks between the parts of the judgement whether to go on.
///
/// # Errors
/// As [`closed_genus_zero`], and what the question answers.
pub(crate) fn closed_genus_zero_asking<E: From<MeshFault>>(
    soup: &PolygonSoup,
    ask: &mut dyn FnMut() -> Result<(), E>,
) -> Result<CheckedMesh, E> {
    let frame = FileFrame::of(soup);
    let checked = judged(&frame.soup(soup), ask)?;
    Ok(CheckedMesh { frame, ..checked })
}

/// Judges a soup of usual coordinates.
fn judged<E: From<MeshFault>>(
    soup: &PolygonSoup,
    ask: &mut dyn FnMut() -> Result<(), E>,
) -> Result<CheckedMesh, E> {
    let (mut triangles, polygon_of) = triangulated(soup)?;
    check_degenerate(soup, &triangles, &polygon_of)?;
    ask()?;
    let edges = EdgeTable::new(&triangles)?;
    ask()?;
    edges.check_closed()?;
    let mut turned = orient(&mut triangles, &edges)?;
    let (vertex_from_file, positions) = used_vertices(soup, &triangles);
    ask()?;
    check_fans(&triangles, &edges, soup.positions.len())?;
    check_components(&edges)?;
    ask()?;
    let euler = positions.len() as i64 - edges.count() as i64 + triangles.len() as i64;
    if euler != 2 {
        return Err(MeshFault::Genus { genus: ((2 - euler) / 2) as usize }.into());
    }
    // Two triangles back to back, with all three edges in common.
    if triangles.len() < LEAST_FACES {
        return Err(MeshFault::TooFewFaces { faces: triangles.len() }.into());
    }
    if signed_volume(soup, &triangles) < 0.0 {
        triangles.iter_mut().for_each(|t| t.swap(1, 2));
        turned.iter_mut().for_each(|turned| *turned = !*turned);
    }
    let vertex = |v: u32| vertex_from_file[v as usize].unwrap_or(VertexId(0));
    let faces: TiVec<FaceId, _> = triangles.iter().map(|t| t.map(vertex)).collect();
    let mesh = SurfaceMesh::from_triangles(positions, faces);
    // Everything that could be refused was refused above with better words.
    let mesh = mesh.map_err(|_| MeshFault::PinchedVertices(Elements { count: 1, first: Vec::new() }))?;
    Ok(CheckedMesh { mesh, frame: FileFrame::default(), vertex_from_file, turned, repaired_faces: None })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::SurfacePoint;
    use crate::mesh::check::NoVertex;
    use crate::mesh::generators::{icosphere, torus};
    use glam::DVec3;

    #[test]
    fn a_sphere_passes_whatever_its_orientation() {
        let sphere = PolygonSoup::from(&icosphere(2));
        let mut mixed = sphere.clone();
        mixed.polygons.iter_mut().step_by(3).for_each(|p| p.reverse());
        let mut inside_out = sphere.clone();
        inside_out.polygons.iter_mut().for_each(|p| p.reverse());
        for (soup, turned) in [(&sphere, 0), (&mixed, 107), (&inside_out, 320)] {
            let checked = closed_genus_zero(soup).unwrap();
            assert_eq!(checked.turned_faces(), turned);
            let there = |point: SurfacePoint, polygon: &[u32]| {
                let corners = polygon.iter().zip(point.barycentric);
                corners.map(|(&v, w)| soup.positions[v as usize] * w).sum::<DVec3>()
            };
            for (face, polygon) in checked.mesh.faces().zip(&soup.polygons) {
                let point = SurfacePoint { face, barycentric: [0.2, 0.3, 0.5] };
                let in_file = checked.with_file_corners(point);
                assert!(there(in_file, polygon).distance(point.position(&checked.mesh)) < 1e-15);
                assert_eq!(checked.with_file_corners(in_file), point);
            }
            let [p, q, r] = checked.mesh.corners(FaceId(0));
            assert!((q - p).cross(r - p).dot(p) > 0.0);
        }
    }

    #[test]
    fn quads_are_cut_and_unused_vertices_left_out() {
        let positions = (0..8).map(|k| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64));
        let mut soup = PolygonSoup {
            positions: std::iter::once(DVec3::splat(9.0)).chain(positions).collect(),
            polygons: vec![
                vec![0, 2, 3, 1],
                vec![4, 5, 7, 6],
                vec![0, 1, 5, 4],
                vec![2, 6, 7, 3],
                vec![0, 4, 6, 2],
                vec![1, 3, 7, 5],
            ],
            ..PolygonSoup::default()
        };
        soup.polygons.iter_mut().flatten().for_each(|v| *v += 1);
        let checked = closed_genus_zero(&soup).unwrap();
        assert_eq!((checked.mesh.vertex_count(), checked.mesh.face_count()), (8, 12));
        assert!((checked.mesh.area() - 6.0).abs() < 1e-12);
        assert_eq!(checked.numbered_vertex(0), Err(NoVertex::Unused { number: 0 }));
        assert_eq!(checked.numbered_vertex(8), Ok(VertexId(7)));
        assert_eq!(checked.numbered_vertex(9), Err(NoVertex::Missing { number: 9, vertices: 9 }));
        let numbers = checked.file_from_vertex();
        assert_eq!((numbers[0], numbers[7]), (1, 8));
        let values: Vec<f64> = checked.mesh.positions().iter().map(|p| p.x).collect();
        let by_file = checked.by_file_vertex(&values);
        assert_eq!(by_file[0], None);
        assert!(by_file[1..].iter().zip(&soup.positions[1..]).all(|(x, p)| *x == Some(p.x)));
    }

    #[test]
    fn a_concave_polygon_is_cut_inside() {
        // A prism over an L.
        let l = [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)];
        let positions = [0.0, 1.0].iter().flat_map(|&z| l.map(|(x, y)| DVec3::new(x, y, z))).collect();
        let mut polygons = vec![vec![5, 4, 3, 2, 1, 0], vec![6, 7, 8, 9, 10, 11]];
        polygons.extend((0..6_u32).map(|k| vec![k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k]));
        let checked =
            closed_genus_zero(&PolygonSoup { positions, polygons, ..PolygonSoup::default() }).unwrap();
        assert!((checked.mesh.area() - (2.0 * 3.0 + 8.0)).abs() < 1e-12);
    }

    #[test]
    fn faults_are_named() {
        let sphere = PolygonSoup::from(&icosphere(1));
        let mut open = sphere.clone();
        open.polygons.pop();
        assert!(matches!(closed_genus_zero(&open), Err(MeshFault::OpenEdges(e)) if e.count == 3));
        let mut doubled = sphere.clone();
        doubled.polygons.push(doubled.polygons[0].clone());
        assert!(
            matches!(closed_genus_zero(&doubled), Err(MeshFault::NonManifoldEdges { edges, .. }) if edges.count == 3)
        );
        let mut needle = sphere.clone();
        needle.polygons[7][1] = needle.polygons[7][0];
        assert!(matches!(closed_genus_zero(&needle), Err(MeshFault::DegenerateFaces(e)) if e.first == [7]));
        assert_eq!(
            closed_genus_zero(&PolygonSoup::from(&torus(8, 8))).unwrap_err(),
            MeshFault::Genus { genus: 1 }
        );
        let mut two = sphere.clone();
        let shift = sphere.positions.len() as u32;
        two.positions.extend(sphere.positions.iter().map(|p| *p + DVec3::X * 5.0));
        two.polygons.extend(sphere.polygons.iter().map(|p| p.iter().map(|v| v + shift).collect::<Vec<_>>()));
        assert_eq!(closed_genus_zero(&two).unwrap_err(), MeshFault::Components { faces: vec![80, 80] });
        // Joined at one vertex.
        two.polygons[80..].iter_mut().flatten().filter(|v| **v == shift).for_each(|v| *v = 0);
        assert!(matches!(closed_genus_zero(&two), Err(MeshFault::PinchedVertices(e)) if e.first == [0]));
        assert_eq!(closed_genus_zero(&PolygonSoup::default()).unwrap_err(), MeshFault::Empty);
        let pillow = PolygonSoup {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
            polygons: vec![vec![0, 1, 2], vec![0, 2, 1]],
            ..PolygonSoup::default()
        };
        assert_eq!(closed_genus_zero(&pillow).unwrap_err(), MeshFault::TooFewFaces { faces: 2 });
    }
}
