use super::*;
use crate::math::scalar::{cos, sin};
use crate::mesh::VertexId;
use crate::mesh::generators::{icosphere, torus};
use crate::mesh::repair::{Change, Handle, Handles, Parts, RepairOptions, RepairRefusal, repaired};
use crate::mesh::soup::PolygonSoup;
use crate::monitor::Silent;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

fn found(soup: &PolygonSoup) -> Defects {
    defects(soup, &RepairOptions::default(), &mut Silent).unwrap()
}

fn kinds(found: &Defects) -> Vec<DefectKind> {
    found.groups.iter().map(|group| group.kind).collect()
}

/// The one defect of a kind.
fn only(found: &Defects, kind: DefectKind) -> &Defect {
    let group = found.of(kind).unwrap_or_else(|| panic!("no {kind:?} in {:?}", kinds(found)));
    assert_eq!((group.count, group.defects.len()), (1, 1), "{kind:?}");
    &group.defects[0]
}

/// The faces around a vertex.
fn star(soup: &PolygonSoup, v: u32) -> Vec<u32> {
    (0..soup.polygons.len() as u32).filter(|&f| soup.polygons[f as usize].contains(&v)).collect()
}

fn punched() -> PolygonSoup {
    let mut soup = PolygonSoup::from(&icosphere(2));
    soup.polygons.retain(|polygon| !polygon.contains(&40));
    soup
}

fn beside(one: &PolygonSoup, other: &PolygonSoup, by: DVec3) -> PolygonSoup {
    let first = one.positions.len() as u32;
    let mut both = one.clone();
    both.positions.extend(other.positions.iter().map(|p| *p + by));
    both.polygons.extend(other.polygons.iter().map(|p| p.iter().map(|v| v + first).collect::<Vec<_>>()));
    both
}

#[test]
fn a_good_mesh_has_none_even_where_no_vertices_are_shared() {
    let sphere = PolygonSoup::from(&icosphere(2));
    assert_eq!(kinds(&found(&sphere)), []);
    let corners: Vec<u32> = sphere.polygons.iter().flatten().copied().collect();
    let apart = PolygonSoup {
        positions: corners.iter().map(|&v| sphere.positions[v as usize]).collect(),
        polygons: (0..corners.len() as u32 / 3).map(|f| vec![3 * f, 3 * f + 1, 3 * f + 2]).collect(),
        ..PolygonSoup::default()
    };
    assert_eq!(kinds(&found(&apart)), []);
}

#[test]
fn a_hole_is_a_closed_rim_that_is_seen_from_outside() {
    let whole = icosphere(2);
    let found = found(&punched());
    assert_eq!(kinds(&found), [DefectKind::OpenRim]);
    let rim = only(&found, DefectKind::OpenRim);
    let [line] = &rim.lines[..] else { panic!("{rim:?}") };
    assert_eq!((line.len(), line.first()), (7, line.last()));
    let label = found.label(DefectKind::OpenRim, rim);
    assert_eq!(label, format!("6 edges from vertex {} on", line[0]));
    let outlook = found.outlook(rim, &found.normals()).unwrap();
    let hole = whole.positions()[VertexId(40)];
    assert!(outlook.place.distance(hole) < 0.1 && outlook.normal.dot(hole) > 0.99, "{outlook:?}");
    // Likewise where the file has all faces inside out.
    let mut inside_out = punched();
    inside_out.polygons.iter_mut().for_each(|polygon| polygon.reverse());
    let turned = self::found(&inside_out);
    assert_eq!(kinds(&turned), [DefectKind::OpenRim]);
    let rim = only(&turned, DefectKind::OpenRim);
    assert!(turned.outlook(rim, &turned.normals()).unwrap().normal.dot(hole) > 0.99);
    assert!(line.iter().all(|&v| found.positions[v as usize].distance(outlook.place) <= outlook.radius));
}

#[test]
fn the_cap_of_a_hole_is_told_with_its_rim() {
    let soup = punched();
    let repaired = repaired(&soup, &RepairOptions::default(), &mut Silent).unwrap();
    let found = found(&soup).with_caps(&repaired.checked);
    let cap = only(&found, DefectKind::Cap);
    assert_eq!(cap.faces.len(), repaired.checked.mesh.face_count() - soup.polygons.len());
    let sorted = |line: &[u32]| {
        let mut line = line.to_vec();
        line.sort_unstable();
        line.dedup();
        line
    };
    assert_eq!(sorted(&cap.lines[0]), sorted(&only(&found, DefectKind::OpenRim).lines[0]));
    let farthest = cap.faces.iter().flat_map(|&f| found.triangles[f as usize]);
    assert!(farthest.into_iter().all(|v| found.positions[v as usize].length() > 0.9));
}

#[test]
fn a_torus_has_the_loop_that_would_be_cut() {
    let found = found(&PolygonSoup::from(&torus(16, 7)));
    assert_eq!(kinds(&found), [DefectKind::HandleLoop]);
    let handle = only(&found, DefectKind::HandleLoop);
    let [line] = &handle.lines[..] else { panic!("{handle:?}") };
    assert_eq!((line.len(), line.first()), (8, line.last()));
    assert_eq!(found.label(DefectKind::HandleLoop, handle), format!("7 edges from vertex {} on", line[0]));
    // Seen from outside, not from within the tube.
    let outlook = found.outlook(handle, &found.normals()).unwrap();
    assert!(outlook.normal.dot(outlook.place) > 2.5, "{outlook:?}");
}

#[test]
fn the_smaller_of_two_spheres_is_the_loose_part() {
    let (large, small) = (PolygonSoup::from(&icosphere(2)), PolygonSoup::from(&icosphere(1)));
    let found = found(&beside(&small, &large, DVec3::X * 5.0));
    assert_eq!(kinds(&found), [DefectKind::LoosePart]);
    let part = only(&found, DefectKind::LoosePart);
    assert_eq!(part.faces, (0..80).collect::<Vec<u32>>());
    assert_eq!(found.label(DefectKind::LoosePart, part), "80 faces from face 0 on");
}

#[test]
fn a_vertex_where_two_spheres_touch_is_pinched() {
    let (large, small) = (PolygonSoup::from(&icosphere(2)), PolygonSoup::from(&icosphere(1)));
    let mut both = beside(&large, &small, DVec3::X * 5.0);
    let first = large.positions.len() as u32;
    both.polygons.iter_mut().flatten().filter(|v| **v == first).for_each(|v| *v = 3);
    let found = found(&both);
    assert_eq!(kinds(&found), [DefectKind::LoosePart, DefectKind::PinchedVertex]);
    let pinched = only(&found, DefectKind::PinchedVertex);
    assert_eq!(pinched.lines, [[3]]);
    assert_eq!(found.label(DefectKind::PinchedVertex, pinched), "vertex 3");
}

#[test]
fn a_patch_that_looks_inwards_is_told_with_its_border() {
    let mut soup = PolygonSoup::from(&icosphere(2));
    let patch = star(&soup, 40);
    patch.iter().for_each(|&f| soup.polygons[f as usize].reverse());
    let found = found(&soup);
    assert_eq!(kinds(&found), [DefectKind::TurnedPatch]);
    let turned = only(&found, DefectKind::TurnedPatch);
    assert_eq!(turned.faces, patch);
    let [border] = &turned.lines[..] else { panic!("{turned:?}") };
    assert_eq!((border.len(), border.first()), (7, border.last()));
    // The triangles agree.
    let outwards = |t: &[u32; 3]| {
        let [p, q, r] = t.map(|v| found.positions[v as usize]);
        (q - p).cross(r - p).dot(p) > 0.0
    };
    assert!(found.triangles.iter().all(outwards));
}

#[test]
fn a_fin_a_needle_and_a_copy_are_told_apart() {
    let mut soup = PolygonSoup::from(&icosphere(1));
    let [a, b] = [soup.polygons[5][0], soup.polygons[5][1]];
    let copy = soup.polygons[9].clone();
    soup.positions.push(DVec3::splat(2.0));
    let fin = soup.positions.len() as u32 - 1;
    soup.polygons.extend([vec![a, b, fin], vec![a, b, a], copy]);
    let found = found(&soup);
    assert_eq!(
        kinds(&found),
        [
            DefectKind::OpenRim,
            DefectKind::CrowdedEdges,
            DefectKind::LoosePart,
            DefectKind::FaceWithoutArea,
            DefectKind::DoubleFace
        ]
    );
    let line = &only(&found, DefectKind::CrowdedEdges).lines[0];
    assert!(line[..] == [a, b] || line[..] == [b, a], "{line:?}");
    assert_eq!(only(&found, DefectKind::OpenRim).lines[0].len(), 3);
    assert_eq!(only(&found, DefectKind::LoosePart).faces, [80]);
    assert_eq!(only(&found, DefectKind::FaceWithoutArea).faces, [81]);
    assert_eq!(only(&found, DefectKind::DoubleFace).faces, [82]);
}

#[test]
fn a_band_with_half_a_turn_has_a_seam_and_no_turned_patch() {
    let n = 12_u32;
    let edge = |k: u32| [2 * (k % n), 2 * (k % n) + 1];
    let place = |v: u32| {
        let (k, rung) = (f64::from(v / 2), f64::from(v % 2) - 0.5);
        let (way, twist) = (k * TAU / 12.0, k * PI / 12.0);
        let out = 2.0 + rung * cos(twist);
        DVec3::new(out * cos(way), out * sin(way), rung * sin(twist))
    };
    let mut polygons = Vec::new();
    for k in 0..n {
        let [a, b] = edge(k);
        let [c, d] = if k + 1 == n { [1, 0] } else { edge(k + 1) };
        polygons.extend([vec![a, b, d], vec![a, d, c]]);
    }
    let positions = (0..2 * n).map(place).collect();
    let found = found(&PolygonSoup { positions, polygons, ..PolygonSoup::default() });
    assert_eq!(kinds(&found), [DefectKind::OpenRim, DefectKind::OneSidedSeam]);
    assert_eq!(only(&found, DefectKind::OneSidedSeam).lines[0].len(), 2);
}

#[test]
fn of_very_many_defects_the_first_are_given_and_all_are_counted() {
    let count = 3 * MOST_DEFECTS;
    let corner = |k: usize| DVec3::new((k / 3) as f64, (k % 3) as f64 * 0.4, ((k % 3) as f64 - 1.0).powi(2));
    let soup = PolygonSoup {
        positions: (0..3 * count).map(corner).collect(),
        polygons: (0..count as u32).map(|f| vec![3 * f, 3 * f + 1, 3 * f + 2]).collect(),
        ..PolygonSoup::default()
    };
    let found = found(&soup);
    let [rims, parts] = [DefectKind::OpenRim, DefectKind::LoosePart].map(|kind| found.of(kind).unwrap());
    assert_eq!((rims.count, rims.defects.len()), (count, MOST_DEFECTS));
    assert_eq!((parts.count, parts.defects.len()), (count - 1, MOST_DEFECTS));
    assert_eq!(rims.to_string(), format!("{count} open rims"));
    // A line that is longer than all that is drawn leaves nothing for the next.
    let line = |points: usize| Defect { lines: vec![vec![0; points]], faces: Vec::new() };
    let long = DefectGroup::new(DefectKind::OpenRim, vec![line(MOST_POINTS + 10), line(5)]).unwrap();
    let drawn: Vec<usize> = long.defects.iter().map(|defect| defect.lines[0].len()).collect();
    assert_eq!((drawn, long.count), (vec![MOST_POINTS, 0], 2));
}

/// A soup with every kind of defect at other places and of another size; all numbers stay exact.
fn placed(soup: &PolygonSoup, factor: f64, shift: DVec3) -> PolygonSoup {
    let grid = 1048576.0;
    let at = |p: &DVec3| (*p * grid).round() / grid * factor + shift;
    PolygonSoup { positions: soup.positions.iter().map(at).collect(), ..soup.clone() }
}

#[test]
fn the_same_is_found_of_meshes_of_any_size_and_far_from_the_origin() {
    let mut soup =
        beside(&PolygonSoup::from(&torus(16, 7)), &PolygonSoup::from(&icosphere(1)), DVec3::X * 9.0);
    soup.polygons[20].reverse();
    let [a, b] = [soup.polygons[5][0], soup.polygons[5][1]];
    soup.polygons.extend([vec![a, b, a], soup.polygons[9].clone()]);
    let usual = placed(&soup, 1.0, DVec3::ZERO);
    let expected = found(&usual);
    assert!(
        expected.of(DefectKind::HandleLoop).is_some() && expected.groups.len() == 5,
        "{:?}",
        kinds(&expected)
    );
    let uncut = RepairOptions { parts: Parts::LargestAlone, ..RepairOptions::default() };
    let cut = RepairOptions { handles: Handles::Cut, ..uncut };
    for (factor, shift) in [
        (1.0, DVec3::new(1e8, -3e7, 0.0)),
        (power_of_two(200), DVec3::ZERO),
        (power_of_two(-200), DVec3::ZERO),
        (power_of_two(320), DVec3::ZERO),
    ] {
        let soup = placed(&soup, factor, shift);
        let found = found(&soup);
        assert_eq!((&found.groups, &found.triangles), (&expected.groups, &expected.triangles));
        let in_file: Vec<DVec3> = found.positions.iter().map(|p| found.frame.in_file(*p)).collect();
        assert_eq!(in_file, soup.positions);
        for group in &found.groups {
            let [here, there] =
                [&found, &expected].map(|of| of.outlook(&group.defects[0], &of.normals()).unwrap());
            assert!(here.normal.distance(there.normal) < 1e-6, "{:?}: {here:?} {there:?}", group.kind);
        }
        // Places of handles are the file's, in a refusal and in a report.
        let places_of =
            |handle: &Handle| -> Vec<DVec3> { handle.vertices.iter().map(|&v| soup.positions[v]).collect() };
        let Err(RepairRefusal::Handles(handles)) = repaired(&soup, &uncut, &mut Silent) else { panic!() };
        assert!(handles.iter().all(|handle| handle.places == places_of(handle)), "{handles:?}");
        let report = repaired(&soup, &cut, &mut Silent).unwrap().report;
        let told = report.changes.iter().find_map(|change| match change {
            Change::CutHandles { handles, .. } => Some(&handles.first),
            _ => None,
        });
        assert!(told.unwrap().iter().all(|handle| handle.places == places_of(handle)), "{told:?}");
    }
}

fn power_of_two(exponent: i32) -> f64 {
    2.0_f64.powi(exponent)
}

#[test]
fn triangles_that_stop_a_flow_are_marked_in_their_middle() {
    let corner = |k: usize| DVec3::new(k as f64, (k * k) as f64, 1.0);
    let triangles: Vec<[DVec3; 3]> = (0..5).map(|k| [corner(k), corner(k + 1), corner(k + 2)]).collect();
    let found = Defects::of_stopped_flow(&triangles);
    assert_eq!(kinds(&found), [DefectKind::StopsFlow]);
    let group = &found.groups[0];
    assert_eq!(group.to_string(), "5 triangles that stop the flow");
    let normals = found.normals();
    for (defect, corners) in group.defects.iter().zip(&triangles) {
        let middle = corners.iter().sum::<DVec3>() / 3.0;
        assert_eq!(found.positions[defect.lines[0][0] as usize], middle);
        assert_eq!(found.triangles[defect.faces[0] as usize].map(|v| found.positions[v as usize]), *corners);
        let outlook = found.outlook(defect, &normals).unwrap();
        assert!(outlook.place.distance(middle) < 1e-12);
        assert!(outlook.normal.dot((corners[1] - corners[0]).cross(corners[2] - corners[0])) > 0.0);
    }
    assert_eq!(Defects::of_stopped_flow(&[]).groups, []);
}
