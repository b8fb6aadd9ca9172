use super::*;
use crate::io::landmark_file::{LandmarkFile, LandmarkPoint};
use crate::io::landmark_formats::{Holds, LandmarkFormat, Space};
use crate::landmarks::{LandmarkError, MeshSide, place, points};
use crate::math::random::SplitMix;
use crate::mesh::check::{CheckedMesh, closed_genus_zero};
use crate::mesh::generators::icosphere;
use crate::mesh::repair::{RepairOptions, repaired};
use crate::mesh::soup::PolygonSoup;
use glam::DVec3;

/// A stretched ball whose file has a vertex that no face uses in front, and its faces inside out.
fn file(stretch: DVec3) -> PolygonSoup {
    let ball = icosphere(2);
    let places = ball.positions().iter().map(|p| *p * stretch);
    let positions = std::iter::once(DVec3::splat(9.0)).chain(places).collect();
    let polygons = ball.triangles().iter().map(|t| [t[0], t[2], t[1]].map(|v| v.0 + 1).to_vec()).collect();
    PolygonSoup { positions, polygons, ..PolygonSoup::default() }
}

fn body(stretch: DVec3) -> CheckedMesh {
    closed_genus_zero(&file(stretch)).unwrap()
}

/// Likewise with a face without area in front of the others, and a hole beside a vertex that is a landmark; repaired.
fn repaired_body(stretch: DVec3) -> CheckedMesh {
    let mut soup = file(stretch);
    soup.polygons.insert(0, vec![1, 1, 2]);
    let at_landmark = soup.polygons.iter().position(|face| face.contains(&43)).unwrap();
    soup.polygons.remove(at_landmark);
    let repaired = repaired(&soup, &RepairOptions::default(), &mut crate::monitor::Silent).unwrap();
    assert!(repaired.checked.has_caps());
    repaired.checked
}

const STRETCHES: [DVec3; 2] = [DVec3::new(3.0, 2.0, 1.0), DVec3::new(1e-3, 2e-3, 1.5e-3)];

fn bodies() -> [CheckedMesh; 2] {
    STRETCHES.map(body)
}

fn surface(mesh: &CheckedMesh) -> Surface<'_> {
    Surface { mesh, space: Space::Lps }
}

/// Vertices, and points inside of faces and on edges.
fn landmarks(meshes: [&CheckedMesh; 2], seed: u64) -> LandmarkFile {
    let mut random = SplitMix::new(seed);
    let mut point = |mesh: &CheckedMesh, pair: usize| {
        let (u, v) = (random.unit(), random.unit());
        let (u, v) = if u + v < 1.0 { (u, v) } else { (1.0 - u, 1.0 - v) };
        // Faces and vertices of their own, so that no two landmarks meet.
        let face = (17 * pair + 5) as u32 % mesh.mesh.face_count() as u32;
        match pair % 3 {
            0 => LandmarkPoint::Vertex(1 + 7 * pair as u32),
            1 => LandmarkPoint::OnFace { face, barycentric: [u, 1.0 - u, 0.0] },
            _ => LandmarkPoint::OnFace { face, barycentric: [u, v, 1.0 - u - v] },
        }
    };
    let pairs: Vec<_> = (0..15).map(|pair| meshes.map(|mesh| point(mesh, pair))).collect();
    let labels = (0..pairs.len()).map(|pair| format!("place {pair}, <{seed}> & \"more\"")).collect();
    LandmarkFile { pairs, labels: Some(labels), ..LandmarkFile::default() }
}

fn place_of(mesh: &CheckedMesh, side: MeshSide, pairs: &[[LandmarkPoint; 2]]) -> Vec<DVec3> {
    points(mesh, side, pairs).unwrap().iter().map(|p| p.position(&mesh.mesh)).collect()
}

/// Landmarks that were read are those that were written.
fn assert_same(
    read: &PairLandmarks,
    written: &LandmarkFile,
    meshes: [&CheckedMesh; 2],
    format: LandmarkFormat,
) {
    assert_eq!(read.file.pairs.len(), written.pairs.len(), "{format}");
    for (mesh, side) in meshes.into_iter().zip([MeshSide::Source, MeshSide::Target]) {
        let size = surface(mesh).size();
        let places = [&read.file.pairs, &written.pairs].map(|pairs| place_of(mesh, side, pairs));
        for (p, q) in places[0].iter().zip(&places[1]) {
            assert!(p.distance(*q) <= 1e-9 * size, "{format}: {p} {q}");
        }
    }
    let exact = matches!(format, LandmarkFormat::Conemap | LandmarkFormat::Wrap);
    for (pair, (read, written)) in read.file.pairs.iter().zip(&written.pairs).enumerate() {
        for (read, written) in read.iter().zip(written) {
            match (read, written) {
                (LandmarkPoint::Vertex(v), LandmarkPoint::Vertex(w)) => assert_eq!(v, w, "{format}, {pair}"),
                (
                    LandmarkPoint::OnFace { face, barycentric: a },
                    LandmarkPoint::OnFace { face: f, barycentric: b },
                ) => {
                    if exact {
                        assert_eq!((face, &a[..2]), (f, &b[..2]), "{format}, {pair}");
                        assert!((a[2] - b[2]).abs() < 1e-15);
                    }
                }
                _ => panic!("{format}, {pair}: {read:?} {written:?}"),
            }
        }
    }
    let limit = [0, 1].map(|k| 1e-9 * surface(meshes[k]).size());
    assert!(read.distances.iter().all(|d| d[0] <= limit[0] && d[1] <= limit[1]), "{format}");
    assert_eq!(read.remarks, [], "{format}");
}

#[test]
fn what_is_written_reads_back_to_the_same_points_in_every_format() {
    assert_reads_back(&bodies());
    assert_reads_back(&STRETCHES.map(repaired_body));
}

fn assert_reads_back(bodies: &[CheckedMesh; 2]) {
    let meshes = bodies.each_ref();
    for seed in 0..20 {
        let file = landmarks(meshes, seed);
        for (format, space) in
            LandmarkFormat::ALL.into_iter().zip([Space::Lps, Space::Ras].into_iter().cycle())
        {
            let surfaces = meshes.map(|mesh| Surface { mesh, space });
            if format.holds() != Holds::One {
                let bytes = write_pairs(format, &file, surfaces).unwrap();
                let given = [GivenFile { name: "both", bytes: &bytes }];
                let read = read_pairs(&given, surfaces).unwrap();
                assert_same(&read, &file, meshes, format);
            }
            if format.holds() != Holds::Both {
                let write = |side: MeshSide| write_side(format, &file, surfaces[side], side).unwrap();
                let bytes = [write(MeshSide::Source), write(MeshSide::Target)];
                let given = bytes.each_ref().map(|bytes| GivenFile { name: "side", bytes });
                let read = read_pairs(&given, surfaces).unwrap();
                assert_same(&read, &file, meshes, format);
                let side = read_side(given[1], surfaces[1], MeshSide::Target).unwrap();
                let ends: Vec<_> = read.file.pairs.iter().map(|pair| Some(pair[1])).collect();
                assert_eq!(side.marks.iter().map(|mark| mark.point).collect::<Vec<_>>(), ends);
            }
        }
    }
}

fn table(points: &[(&str, DVec3)]) -> String {
    let rows = points.iter().map(|(label, p)| format!("{label},{},{},{}\n", p.x, p.y, p.z));
    format!("name,x,y,z\n{}", rows.collect::<String>())
}

fn pairs(files: &[&str], meshes: [&CheckedMesh; 2]) -> Result<PairLandmarks, ExchangeError> {
    let given: Vec<_> =
        files.iter().map(|text| GivenFile { name: "a.csv", bytes: text.as_bytes() }).collect();
    read_pairs(&given, meshes.map(surface))
}

const AXES: [DVec3; 4] = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::Z];

/// The places of an ellipsoid on the axes, by name.
fn places(stretch: DVec3) -> Vec<(&'static str, DVec3)> {
    ["nose", "left", "tail", "top"].into_iter().zip(AXES.map(|axis| axis * stretch)).collect()
}

#[test]
fn equal_labels_pair_and_else_the_order_does() {
    let ball = body(DVec3::ONE);
    let meshes = [&ball, &ball];
    let source = places(DVec3::ONE);
    let mut target = source.clone();
    target.reverse();
    let paired = pairs(&[&table(&source), &table(&target)], meshes).unwrap();
    assert!(paired.file.pairs.iter().all(|[a, b]| a == b));
    assert_eq!(paired.file.labels.unwrap(), ["nose", "left", "tail", "top"]);
    assert_eq!(paired.remarks, []);

    target[0].0 = "crown";
    let paired = pairs(&[&table(&source), &table(&target)], meshes).unwrap();
    assert!(paired.file.pairs.iter().all(|[a, b]| a != b));
    assert_eq!(paired.remarks, [Remark::PairedByOrder]);

    target.pop();
    let error = pairs(&[&table(&source), &table(&target)], meshes).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the source has 4 landmarks and the target 3, and their labels differ (only the source has \"nose\", \"top\"; only the \
         target has \"crown\"): give each landmark the same label on both, or equally many in one order"
    );
    // Without labels on one side there is nothing that could differ.
    let bare: Vec<_> = source.iter().map(|(_, p)| ("", *p)).collect();
    let paired = pairs(&[&table(&source), &table(&bare)], meshes).unwrap();
    assert_eq!((paired.remarks.len(), paired.file.labels.unwrap().len()), (0, 4));
}

#[test]
fn a_landmark_that_was_not_placed_takes_its_partner_along() {
    let ball = body(DVec3::ONE);
    let text = table(&places(DVec3::ONE));
    let missing = text.replace("tail,-1,0,0", "tail,,,");
    assert_ne!(text, missing);
    let paired = pairs(&[&text, &missing], [&ball, &ball]).unwrap();
    assert_eq!(paired.file.labels.unwrap(), ["nose", "left", "top"]);
    assert!(paired.file.pairs.iter().all(|[a, b]| a == b));
    let said: Vec<_> = paired.remarks.iter().map(Remark::to_string).collect();
    assert_eq!(said, ["landmark 3 (\"tail\") of the target has no position in its file and is left out"]);
}

#[test]
fn points_off_the_surface_are_told_and_far_ones_refused() {
    let ball = body(DVec3::ONE);
    let size = surface(&ball).size();
    let text = |by: f64| {
        let mut places = places(DVec3::ONE);
        places[1].1 *= 1.0 + by * size;
        table(&places)
    };
    let plain = table(&places(DVec3::ONE));
    let near = pairs(&[&plain, &text(0.009)], [&ball, &ball]).unwrap();
    assert_eq!(near.remarks, []);
    // The ball's vertices on the axes are nearest.
    assert!((near.distances[1][1] - 0.009 * size).abs() < 1e-9 * size);
    let off = pairs(&[&plain, &text(0.1)], [&ball, &ball]).unwrap();
    assert!(off.file.pairs.iter().all(|[a, b]| a == b));
    assert_eq!(
        off.remarks[0].to_string(),
        format!(
            "landmark 2 (\"left\") of the target lies {} off the surface, 10.0 % of the mesh's size: it is put on the nearest point",
            remark::Short(0.1 * size)
        )
    );
    let far = pairs(&[&plain, &text(0.5)], [&ball, &ball]).unwrap_err();
    assert_eq!(far.file(), Some(1));
    assert!(far.to_string().starts_with("landmark 2 (\"left\") of the target lies 1.7"), "{far}");
    assert!(
        far.to_string().ends_with(
            "50 % of the mesh's size: units or coordinate systems may differ, or it is another mesh"
        )
    );
}

#[test]
fn what_would_bring_far_points_onto_the_surface_is_advised() {
    let stretch = DVec3::new(3.0, 2.0, 1.0);
    // Off the origin, so that a half turn is no symmetry of it.
    let moved = {
        let ball = body(stretch);
        let soup = PolygonSoup {
            positions: ball.mesh.positions().iter().map(|p| *p + DVec3::new(9.0, 4.0, 0.0)).collect(),
            polygons: ball.mesh.triangles().iter().map(|t| t.map(|v| v.0).to_vec()).collect(),
            ..PolygonSoup::default()
        };
        closed_genus_zero(&soup).unwrap()
    };
    let places: Vec<_> =
        places(stretch).into_iter().map(|(label, p)| (label, p + DVec3::new(9.0, 4.0, 0.0))).collect();
    let plain = table(&places);
    let given = |change: &dyn Fn(DVec3) -> DVec3| {
        table(&places.iter().map(|(label, p)| (*label, change(*p))).collect::<Vec<_>>())
    };
    let advice = |text: &str| match pairs(&[text, &plain], [&moved, &moved]) {
        Err(ExchangeError::FarOff { advice, file: 0, side: MeshSide::Source, .. }) => advice,
        other => panic!("{other:?}"),
    };
    assert_eq!(advice(&given(&|p| DVec3::new(-p.x, -p.y, p.z))), Some(Advice::HalfTurn));
    assert_eq!(advice(&given(&|p| 1000.0 * p)), Some(Advice::Scale(0.001)));
    assert_eq!(advice(&given(&|p| p / 25.4)), Some(Advice::Scale(25.4)));
    assert_eq!(advice(&given(&|p| p + DVec3::new(50.0, 1.0, 2.0))), None);

    // A declared system is one of the two; a mesh whose file names none is in LPS.
    let slicer = |space: &str, p: DVec3| {
        format!(
            "# Markups fiducial file version = 4.11\n# CoordinateSystem = {space}\n0,{},{},{},0,0,0,1,1,1,0,a,,\n",
            p.x, p.y, p.z
        )
    };
    let p = places[0].1;
    let turned = DVec3::new(-p.x, -p.y, p.z);
    let read = |text: &str, space| {
        let file = GivenFile { name: "a.fcsv", bytes: text.as_bytes() };
        read_side(file, Surface { mesh: &moved, space }, MeshSide::Source)
    };
    for (declared, mesh, place) in [
        ("LPS", Space::Lps, p),
        ("RAS", Space::Lps, turned),
        ("0", Space::Lps, turned),
        ("RAS", Space::Ras, p),
        ("LPS", Space::Ras, turned),
    ] {
        let side = read(&slicer(declared, place), mesh).unwrap();
        assert!(side.marks[0].distance < 1e-12, "{declared}");
    }
    let wrong = read(&slicer("RAS", p), Space::Lps).unwrap_err().to_string();
    assert!(wrong.ends_with("all landmarks would lie on it: exchange LPS and RAS in the file"), "{wrong}");
}

#[test]
fn files_that_do_not_go_together_are_told() {
    let ball = body(DVec3::ONE);
    let one = table(&places(DVec3::ONE));
    let both = "sx,sy,sz,tx,ty,tz\n1,0,0,1,0,0\n";
    let says = |files: &[&str]| {
        let error = pairs(files, [&ball, &ball]).unwrap_err();
        (error.file(), error.to_string())
    };
    assert_eq!(
        says(&[&one]).1,
        "this file holds the landmarks of one mesh: give a second file for the other mesh"
    );
    assert_eq!(
        says(&[&one, both]),
        (Some(1), "this file holds the landmarks of both meshes: give it alone".to_owned())
    );
    assert_eq!(says(&[]).1, "landmarks are in one file or in two, but 0 were given");
    assert_eq!(says(&[&one, "hello"]).0, Some(1));
    let wrap = "{\"nose\": [3, 0.5, 0.25], \"tail\": [9999, 0.5, 0.5]}";
    assert_eq!(
        says(&[wrap, &one]),
        (
            Some(0),
            "landmark 2 (\"tail\") of the source is on face 9999, but the mesh has 320 faces: the file belongs to another mesh"
                .to_owned()
        )
    );
    let twice = table(&[("a", DVec3::X), ("b", DVec3::X)]);
    assert!(says(&[&twice, &twice]).1.contains("have the same point of the source"));
}

#[test]
fn many_remarks_name_the_farthest_points() {
    let ball = body(DVec3::ONE);
    let size = surface(&ball).size();
    let rows: Vec<_> = ball
        .mesh
        .positions()
        .iter()
        .take(12)
        .enumerate()
        .map(|(k, p)| ("", *p * (1.0 + (0.02 + 0.01 * k as f64) * size)))
        .collect();
    let file = table(&rows);
    let side =
        read_side(GivenFile { name: "a.csv", bytes: file.as_bytes() }, surface(&ball), MeshSide::Source)
            .unwrap();
    let farthest = |remark: &Remark| match remark {
        Remark::OffSurface { index, .. } => Some(*index),
        _ => None,
    };
    assert_eq!(side.remarks.iter().filter_map(farthest).collect::<Vec<_>>(), [11, 10, 9, 8, 7]);
    assert_eq!(side.remarks[5].to_string(), "7 more landmarks of the source lie so far off the surface");
}

#[test]
fn a_point_nearest_to_a_cap_is_refused_as_one_in_a_cap() {
    let [a, b] = STRETCHES.map(repaired_body);
    let cap = a.mesh.faces().find(|f| a.is_cap(*f)).unwrap();
    let [p, q, r] = a.mesh.corners(cap);
    let rows = [("cap", (p + q + r) / 3.0)];
    let side =
        read_side(GivenFile { name: "a.csv", bytes: table(&rows).as_bytes() }, surface(&a), MeshSide::Source);
    let point = side.unwrap().marks[0].point.unwrap();
    let refused = place([&a, &b], &[[point, LandmarkPoint::Vertex(1)]]).unwrap_err();
    assert_eq!(refused, LandmarkError::InCap { side: MeshSide::Source, pair: 0 });
}
