//! Tests of repair on broken meshes made from good ones, by seed and by hand.

use crate::damage::{Damage, add, punch};
use conemap::io::landmark_file::LandmarkPoint;
use conemap::landmarks::{LandmarkError, MeshSide, check_side};
use conemap::math::random::SplitMix;
use conemap::math::scalar::{cos, sin};
use conemap::mesh::check::{CheckedMesh, MeshFault, closed_genus_zero};
use conemap::mesh::generators::{icosphere, octahedron, torus};
use conemap::mesh::repair::{
    Change, Handles, Parts, RepairOptions, RepairRefusal, RepairedMesh, gaps, repaired,
};
use conemap::mesh::soup::PolygonSoup;
use conemap::mesh::{FaceId, SurfaceMesh, SurfacePoint};
use conemap::monitor::Silent;
use glam::{DMat3, DVec3};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Repairs a soup, with handles cut.
fn repair_all(soup: &PolygonSoup) -> Result<RepairedMesh, RepairRefusal> {
    let options = RepairOptions { handles: Handles::Cut, ..RepairOptions::default() };
    repaired(soup, &options, &mut Silent)
}

fn repair(soup: &PolygonSoup) -> Result<RepairedMesh, RepairRefusal> {
    repaired(soup, &RepairOptions::default(), &mut Silent)
}

fn signed_volume(mesh: &SurfaceMesh) -> f64 {
    mesh.faces().map(|f| mesh.corners(f)).map(|[p, q, r]| p.dot(q.cross(r)) / 6.0).sum()
}

/// Checks that a repaired mesh is a closed surface of genus 0 that a second repair does not change.
pub fn is_sound(mesh: &RepairedMesh) {
    let surface = &mesh.checked.mesh;
    assert_eq!(surface.euler_characteristic(), 2);
    assert!(signed_volume(surface) >= 0.0);
    assert!(surface.positions().iter().all(|p| p.is_finite()));
    let again = repair(&PolygonSoup::from(surface)).unwrap();
    assert_eq!(again.report.fault, None);
    assert_eq!(again.report.changes, []);
    assert_eq!(again.checked.mesh.triangles(), surface.triangles());
    assert_eq!(again.checked.mesh.positions(), surface.positions());
}

fn kinds(mesh: &RepairedMesh) -> Vec<&'static str> {
    mesh.report.changes.iter().map(Change::kind).collect()
}

#[test]
fn of_a_thousand_broken_meshes_each_is_closed_or_refused() {
    let mut outcomes: BTreeMap<&'static str, usize> = BTreeMap::new();
    for seed in 0..1000 {
        let soup = Damage::new(seed).soup();
        let outcome = match repair(&soup) {
            Ok(mesh) => {
                is_sound(&mesh);
                assert_eq!(mesh.report.fault.is_none(), closed_genus_zero(&soup).is_ok(), "seed {seed}");
                numbers_are_the_files(&soup, &mesh.checked);
                // Repairs that are allowed but not needed are not made.
                let all = repaired(&soup, &RepairOptions::everything(), &mut Silent).unwrap();
                assert_eq!(
                    (all.checked.mesh.triangles(), &all.report),
                    (mesh.checked.mesh.triangles(), &mesh.report)
                );
                "repaired"
            }
            Err(refusal) => {
                if refusal.kind() == "genus" {
                    let mesh = repair_all(&soup).unwrap();
                    is_sound(&mesh);
                    numbers_are_the_files(&soup, &mesh.checked);
                }
                refusal.kind()
            }
        };
        *outcomes.entry(outcome).or_default() += 1;
    }
    // A sixth of the meshes are of genus 1.
    assert!(outcomes["repaired"] > 600, "{outcomes:?}");
    assert!(outcomes.contains_key("genus"), "{outcomes:?}");
}

/// Checks that each vertex with a number of the file has its place there, and each face its corners.
pub fn numbers_are_the_files(soup: &PolygonSoup, checked: &CheckedMesh) {
    let mesh = &checked.mesh;
    let close = |p: DVec3, q: DVec3| p.distance(q) < 1e-9;
    for (v, number) in mesh.vertices().zip(checked.file_from_vertex()) {
        if let Some(&place) = soup.positions.get(number) {
            assert!(close(mesh.positions()[v], place));
            assert_eq!(checked.vertex_from_file[number], Some(v));
        }
    }
    for face in mesh.faces() {
        let number = checked.file_from_face(face);
        assert_eq!(checked.face_from_file(number), Some(face));
        if number.index() >= checked.file_faces() {
            continue;
        }
        assert!(!checked.is_cap(face));
        let point = SurfacePoint { face, barycentric: [0.2, 0.3, 0.5] };
        let on_file = checked.on_file(point);
        let corners = soup.polygons[number.index()].iter().zip(on_file.barycentric);
        let there = corners.map(|(&v, w)| soup.positions[v as usize] * w).sum::<DVec3>();
        assert!(close(point.position(mesh), there));
    }
}

#[test]
fn a_good_mesh_stays_as_it_is() {
    let mut given = PolygonSoup::from(&icosphere(2));
    given.polygons[5].swap(1, 2);
    given.positions.push(DVec3::ZERO);
    let mesh = repair(&given).unwrap();
    assert_eq!(mesh.report.fault, None);
    assert_eq!(kinds(&mesh), ["turned_faces", "unused_vertices"]);
    let checked = closed_genus_zero(&given).unwrap();
    assert_eq!(mesh.checked.mesh.triangles(), checked.mesh.triangles());
    assert!(mesh.checked.repaired_faces.is_none());
}

#[test]
fn a_hole_of_a_ball_gets_a_round_cap_of_good_triangles() {
    let mut open = PolygonSoup::from(&icosphere(4));
    punch(&mut open, DVec3::Z, 0.12);
    punch(&mut open, DVec3::NEG_X, 0.5);
    let mesh = repair(&open).unwrap();
    is_sound(&mesh);
    numbers_are_the_files(&open, &mesh.checked);
    let Change::CappedHoles { holes, faces, area_share } = &mesh.report.changes[0] else {
        panic!("{:?}", mesh.report)
    };
    assert_eq!(holes.count, 2);
    assert!(holes.first[0].rim_length > 3.0 * holes.first[1].rim_length);
    assert!((area_share - mesh.report.cap_share).abs() < 1e-15 && (0.05..0.09).contains(area_share));
    let surface = &mesh.checked.mesh;
    let caps: Vec<FaceId> = surface.faces().filter(|&f| mesh.checked.is_cap(f)).collect();
    assert_eq!(caps.len(), *faces);
    // A landmark cannot lie in a cap.
    let face = mesh.checked.file_from_face(caps[0]).0;
    let point = LandmarkPoint::OnFace { face, barycentric: [0.2, 0.3, 0.5] };
    let wrong = check_side(&mesh.checked, MeshSide::Source, &[[point; 2]]).unwrap_err();
    assert_eq!(wrong, LandmarkError::InCap { side: MeshSide::Source, pair: 0 });
    let (first, count) = (open.positions.len(), surface.vertex_count());
    let numbers = mesh.checked.file_from_vertex();
    let added = surface.vertices().filter(|v| numbers[v.index()] >= first);
    let (small, large): (Vec<_>, Vec<_>) =
        added.map(|v| surface.positions()[v]).partition(|p| p.distance(DVec3::Z) < 0.3);
    assert!(!small.is_empty() && large.len() > 10 && small.len() + large.len() < count / 10);
    // The small cap continues the ball; the large one is stretched over its rim.
    assert!(small.iter().all(|p| (p.length() - 1.0).abs() < 4e-3), "{small:?}");
    assert!(large.iter().all(|p| p.length() < 1.0 + 1e-9 && p.x < -0.8), "{large:?}");
    let angle = |f: &FaceId| {
        let corners = surface.corners(*f);
        let at = |k: usize| {
            let [p, q, r] = [0, 1, 2].map(|step| corners[(k + step) % 3]);
            conemap::math::triangle::angle_at(p, q, r).to_degrees()
        };
        at(0).min(at(1)).min(at(2))
    };
    let mean = caps.iter().map(angle).sum::<f64>() / caps.len() as f64;
    assert!(mean > 30.0 && caps.iter().all(|f| angle(f) > 5.0), "{mean}");
}

/// A pointed hat whose rim has `rim` vertices.
fn hat(rim: u32) -> PolygonSoup {
    let around = |k: u32| TAU * f64::from(k) / f64::from(rim);
    let mut positions: Vec<DVec3> =
        (0..rim).map(|k| DVec3::new(cos(around(k)), sin(around(k)), 0.0)).collect();
    positions.push(3.0 * DVec3::Z);
    let polygons = (0..rim).map(|k| vec![k, (k + 1) % rim, rim]).collect();
    PolygonSoup { positions, polygons, joined_with: Vec::new() }
}

#[test]
fn a_rim_of_ten_thousand_edges_is_capped_in_proportion() {
    let hat = hat(10_000);
    let mesh = repair(&hat).unwrap();
    is_sound(&mesh);
    let surface = &mesh.checked.mesh;
    // The edges of a cap grow away from the rim, so that the number of vertices is in proportion to the rim.
    assert!((40_000..150_000).contains(&surface.face_count()), "{}", surface.face_count());
    let caps = surface.faces().filter(|&f| mesh.checked.is_cap(f));
    let area: f64 = caps.map(|f| surface.face_area(f)).sum();
    assert!((area - 0.5 * TAU).abs() < 1e-3, "{area}");
}

#[test]
fn loose_triangles_with_equal_corners_are_one_surface() {
    let ball = icosphere(2);
    let corners = ball.triangles().iter().flat_map(|t| t.map(|v| ball.positions()[v]));
    let mut loose = PolygonSoup { positions: corners.collect(), ..PolygonSoup::default() };
    loose.polygons = (0..ball.face_count() as u32).map(|t| vec![3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let mesh = repair(&loose).unwrap();
    is_sound(&mesh);
    assert_eq!(kinds(&mesh), ["joined_vertices"]);
    assert_eq!(mesh.checked.mesh.vertex_count(), ball.vertex_count());
    assert!(mesh.checked.vertex_from_file.iter().all(Option::is_some));
    assert!(mesh.checked.repaired_faces.is_none());

    // Vertices that are not quite equal are joined only when asked.
    let mut random = SplitMix::new(1);
    let shaken = |p: &DVec3| *p + 1e-6 * DVec3::from_array([0; 3].map(|_| random.unit()));
    loose.positions = loose.positions.iter().map(shaken).collect();
    assert!(matches!(repair(&loose), Err(RepairRefusal::Parts { count: 320, .. })));
    let found = gaps(&loose, &RepairOptions::default()).unwrap().unwrap();
    assert_eq!(found.vertices, 3 * 320);
    let options = RepairOptions { join_within: found.distance, ..RepairOptions::default() };
    assert_eq!(gaps(&loose, &options), Ok(None));
    let near = repaired(&loose, &options, &mut Silent).unwrap();
    is_sound(&near);
    assert_eq!(near.checked.mesh.vertex_count(), ball.vertex_count());
}

#[test]
fn a_corner_on_an_edge_cuts_the_neighbour_and_opens_nothing() {
    let mut given = PolygonSoup::from(&icosphere(1));
    let [a, b, c] = given.polygons[3][..] else { panic!() };
    let middle = given.positions.len() as u32;
    given.positions.push(0.5 * (given.positions[a as usize] + given.positions[b as usize]));
    given.polygons[3] = vec![a, middle, c];
    given.polygons.extend([vec![middle, b, c], vec![a, b, middle]]);
    let mesh = repair(&given).unwrap();
    is_sound(&mesh);
    assert_eq!(kinds(&mesh), ["degenerate_faces"]);
    let Change::DegenerateFaces { dropped, recut } = &mesh.report.changes[0] else { panic!() };
    assert_eq!((&dropped.first[..], recut.count), (&[81][..], 1));
    assert!((mesh.checked.mesh.area() - icosphere(1).area()).abs() < 1e-12);
    // The faces in place of the divided neighbour have new numbers, and its number is unused.
    let is_made = |f: &FaceId| mesh.checked.file_from_face(*f).index() >= 82;
    let made: Vec<FaceId> = mesh.checked.mesh.faces().filter(is_made).collect();
    assert!(made.len() == 2 && made.iter().all(|&f| !mesh.checked.is_cap(f)));
    let on = |face: usize| [[LandmarkPoint::OnFace { face: face as u32, barycentric: [0.2, 0.3, 0.5] }; 2]];
    let placed = |face: usize| check_side(&mesh.checked, MeshSide::Source, &on(face));
    assert!(matches!(placed(recut.first[0]), Err(LandmarkError::DroppedFace { .. })));
    assert_eq!(placed(83), Ok(()));
    assert!(matches!(placed(84), Err(LandmarkError::MissingFace { faces: 82, .. })));
}

/// A box whose six sides are fans with vertices of their own. Two of the sides divide their common edge into three and into five.
fn box_with_a_seam(turned: DMat3) -> PolygonSoup {
    let corner = |k: usize| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64);
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut soup = PolygonSoup::default();
    for side in sides {
        let middle = soup.positions.len() as u32;
        soup.positions.push(turned * (0.25 * side.map(corner).iter().sum::<DVec3>()));
        for (k, &from) in side.iter().enumerate() {
            let to = side[(k + 1) % 4];
            let pieces = match [from, to] {
                [3, 1] => 3,
                [1, 3] => 5,
                _ => 1,
            };
            let at = |step: usize| turned * corner(from).lerp(corner(to), step as f64 / pieces as f64);
            soup.positions.extend((0..pieces).map(at));
        }
        let around = soup.positions.len() as u32 - middle - 1;
        soup.polygons
            .extend((0..around).map(|k| vec![middle, middle + 1 + k, middle + 1 + (k + 1) % around]));
    }
    soup
}

#[test]
fn a_seam_with_other_vertices_on_its_sides_closes_without_a_cap() {
    for angle in [0.0, 0.7] {
        let turned = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), angle);
        let loose = box_with_a_seam(turned);
        let mesh = repair(&loose).unwrap();
        is_sound(&mesh);
        numbers_are_the_files(&loose, &mesh.checked);
        let area = mesh.checked.mesh.area();
        assert!(
            (area - 6.0).abs() < 1e-9 && (signed_volume(&mesh.checked.mesh) - 1.0).abs() < 1e-9,
            "{area}"
        );
        assert!(mesh.report.cap_share < 1e-9, "{:?}", mesh.report);
    }
}

#[test]
fn a_face_without_area_that_is_missing_leaves_no_hole() {
    // A vertex in the middle of an edge belongs to the faces on one side only, and the face without area that would close the gap is
    // missing.
    let mut given = PolygonSoup::from(&icosphere(1));
    let [a, b, c] = given.polygons[3][..] else { panic!() };
    let place = |v: u32| given.positions[v as usize];
    let (middle, top) = (given.positions.len() as u32, given.positions.len() as u32 + 1);
    let [on_edge, above] = [0.5 * (place(a) + place(b)), (place(a) + place(b) + place(c)) / 3.0];
    given.positions.extend([on_edge, above]);
    // The middle of the edge is a corner of the faces on this side, and the face beyond is whole.
    given.polygons[3] = vec![a, middle, top];
    given.polygons.extend([vec![middle, b, top], vec![b, c, top], vec![c, a, top]]);
    let mesh = repair(&given).unwrap();
    is_sound(&mesh);
    numbers_are_the_files(&given, &mesh.checked);
    assert!((mesh.checked.mesh.area() - icosphere(1).area()).abs() < 1e-12);
}

#[test]
fn walls_flaps_and_doubled_sheets_go() {
    // Two tetrahedra share a triangle that is given from both sides; this wall is removed.
    let positions = vec![DVec3::X, DVec3::Y, DVec3::ZERO, DVec3::Z, DVec3::new(0.3, 0.3, -1.0)];
    let above = [[0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 2, 1]];
    let below = [[1, 0, 4], [2, 1, 4], [0, 2, 4], [0, 1, 2]];
    let polygons: Vec<Vec<u32>> = above.iter().chain(&below).map(|t| t.to_vec()).collect();
    let bodies = PolygonSoup { positions, polygons, joined_with: Vec::new() };
    let mesh = repair(&bodies).unwrap();
    is_sound(&mesh);
    assert_eq!(kinds(&mesh), ["duplicate_faces"]);
    assert_eq!((mesh.checked.mesh.vertex_count(), mesh.checked.mesh.face_count()), (5, 6));

    // With one side of the wall only, the tetrahedra are separated, and neither is small enough to be a speck.
    let mut one_side = bodies.clone();
    one_side.polygons.pop();
    assert!(matches!(repair(&one_side), Err(RepairRefusal::Parts { count: 2, .. })));
    let largest = RepairOptions { parts: Parts::LargestAlone, ..RepairOptions::default() };
    let mesh = repaired(&one_side, &largest, &mut Silent).unwrap();
    is_sound(&mesh);
    assert_eq!(mesh.checked.mesh.face_count(), 6);

    // Of a sheet whose faces are all double one copy stays, which is an open sheet.
    let sheet = PolygonSoup {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE],
        polygons: vec![vec![0, 1, 2], vec![1, 3, 2], vec![2, 1, 0], vec![2, 3, 1]],
        joined_with: Vec::new(),
    };
    assert!(matches!(repair(&sheet), Err(RepairRefusal::OpenSheet { .. })));
}

#[test]
fn bodies_that_touch_come_apart() {
    // Two boxes share an edge, at which four faces meet.
    let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let positions: Vec<DVec3> = (0..8).map(corner).collect();
    let cube = PolygonSoup {
        positions,
        polygons: quads.iter().map(|q| q.to_vec()).collect(),
        joined_with: Vec::new(),
    };
    let mut boxes = cube.clone();
    add(&mut boxes, &cube, |p| p * DVec3::new(0.05, 0.05, 1.0) + DVec3::new(1.0, 1.0, 0.0));
    // The edge 3-7 of the first box is the edge 8-12 of the second.
    boxes.polygons.iter_mut().flatten().for_each(|v| {
        *v = match *v {
            8 => 3,
            12 => 7,
            v => v,
        }
    });
    let largest = RepairOptions { parts: Parts::LargestAlone, ..RepairOptions::default() };
    let mesh = repaired(&boxes, &largest, &mut Silent).unwrap();
    is_sound(&mesh);
    assert_eq!(kinds(&mesh), ["split_edges", "split_vertices", "dropped_parts", "unused_vertices"]);
    assert!((mesh.checked.mesh.area() - 6.0).abs() < 1e-12);

    // Two balls share a vertex; the small one is a speck.
    let mut balls = PolygonSoup::from(&icosphere(2));
    let touch = balls.positions[7];
    let first = balls.positions.len() as u32;
    add(&mut balls, &PolygonSoup::from(&octahedron()), |p| touch + 0.02 * (p - DVec3::X));
    balls.polygons.iter_mut().flatten().filter(|v| **v == first).for_each(|v| *v = 7);
    let mesh = repair(&balls).unwrap();
    is_sound(&mesh);
    assert_eq!(kinds(&mesh), ["split_vertices", "dropped_parts", "unused_vertices"]);
    assert!(matches!(&mesh.report.changes[0], Change::SplitVertices(v) if v.first == [7]));
    assert_eq!(mesh.checked.mesh.face_count(), 320);
    assert!(mesh.report.sentence().contains("1 loose part was dropped ("), "{}", mesh.report.sentence());
}

#[test]
fn what_cannot_be_repaired_is_told() {
    let refusal = |soup: &PolygonSoup| repair(soup).unwrap_err();
    assert_eq!(refusal(&PolygonSoup::from(&torus(8, 8))).kind(), "genus");
    let mut open_torus = PolygonSoup::from(&torus(12, 12));
    open_torus.polygons.truncate(280);
    assert_eq!(refusal(&open_torus).kind(), "genus");
    let mut two = PolygonSoup::from(&icosphere(2));
    let ball = two.clone();
    add(&mut two, &ball, |p| p + 3.0 * DVec3::X);
    assert_eq!(refusal(&two).kind(), "parts");
    let mut sheet = PolygonSoup::from(&octahedron());
    sheet.polygons.truncate(1);
    assert_eq!(refusal(&sheet).kind(), "open_sheet");
    let line =
        PolygonSoup { positions: vec![DVec3::ZERO; 3], polygons: vec![vec![0, 1, 2]], ..sheet.clone() };
    assert_eq!(refusal(&line), RepairRefusal::NothingLeft);
    assert_eq!(refusal(&PolygonSoup::default()), RepairRefusal::Fault(MeshFault::Empty));
    // A band with half a twist is one-sided.
    let band = PolygonSoup {
        positions: (0..10)
            .map(|k| {
                let (a, side) = (TAU * f64::from(k / 2) / 5.0, f64::from(k % 2) - 0.5);
                let out = 2.0 + side * cos(0.5 * a);
                DVec3::new(out * cos(a), out * sin(a), side * sin(0.5 * a))
            })
            .collect(),
        polygons: (0..5_u32)
            .flat_map(|k| {
                let [a, b] = [2 * k, 2 * k + 1];
                let [c, d] = if k < 4 { [a + 2, b + 2] } else { [1, 0] };
                [vec![a, c, b], vec![b, c, d]]
            })
            .collect(),
        joined_with: Vec::new(),
    };
    assert_eq!(refusal(&band).kind(), "not_orientable");
}
