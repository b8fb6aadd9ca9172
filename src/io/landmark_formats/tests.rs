use super::*;
use crate::io::landmark_file::LandmarkPoint;
use glam::DVec3;
use proptest::prelude::*;

const SLICER: &str = r#"{
  "@schema": "https://example.org/markups-schema-v1.0.3.json#",
  "markups": [{
    "type": "Fiducial", "name": "skull", "coordinateSystem": "RAS", "locked": false,
    "controlPoints": [
      {"id": "1", "label": "tip", "position": [1.5, -2.0, 3e1], "positionStatus": "defined", "visibility": true},
      {"id": "2", "label": "lost", "position": [0.0, 0.0, 0.0], "positionStatus": "undefined"},
      {"id": "3", "label": "ear", "position": [4, 5, 6]}
    ],
    "measurements": [], "display": {"visibility": false}
  }, {"type": "ROI", "controlPoints": [{"position": [0, 0, 0]}]}]
}"#;
const FCSV: &str = "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\nvtkMRMLMarkupsFiducialNode_0,1.5,-2,30,0,0,0,1,1,1,0,\"tip, upper\",,vtkMRMLModelNode4\nvtkMRMLMarkupsFiducialNode_1,4,5,6,0,0,0,1,1,1,0,ear,,\n";
const WRAP: &str = "[ [42, 0.25, 0.5],\n  [1337, 0.0, 1.0] ]";
const MESHLAB: &str = "<!DOCTYPE PickedPoints>\n<PickedPoints>\n <DocumentData>\n  <DateTime date=\"2017-07-23\" time=\"20:19:09\"/>\n  <DataFileName name=\"skull.ply\"/>\n </DocumentData>\n <point name=\"tip &amp; ear\" x=\"1.5\" active=\"1\" y=\"-2\" z=\"30\"/>\n <point name=\"off\" x=\"0\" active=\"0\" y=\"0\" z=\"0\"/>\n <point name=\"ear\" x=\"4\" y=\"5\" z=\"6\"/>\n</PickedPoints>\n";
const IDAV: &str = "Version 1.0\n3\nS000 1.5 -2 30 \nleft ear 4 5 6\nS002 9999 9999 9999\n";
const TPS: &str = "LM3=2\n1.5 -2 30\n4 5 6\nCURVES=1\nPOINTS=2\n7 7 7\n8 8 8\nIMAGE=a.ply\nID=cat\nSCALE=2\n\nLM3=2\n1 2 3\nNA NA NA\nID=lion\n";
const NTS: &str = "\"made by hand\n1 2L 6 1 9999 Dim=3\ncat lion\n1.5 -2 30\n4 5 6\n1 2 3 9999\n9999 9999\n";
const NTS_POINTS: &str = "1 2L 3 0 DIM=3\ntip ear\n1.5 -2 30 4 5 6\n";
const CSV: &str = "Name,X,Y,Z\n\"tip, upper\",1.5,-2,30\near,4,5,6\nlost,,,\n";
const CSV_PAIRS: &str = "name;sx;sy;sz;tx;ty;tz\ntip;1.5;-2;30;1;2;3\near;4;5;6;7;8;9\n";
const OWN: &str = "{\"pairs\": [[1, 2], [{\"face\": 3, \"barycentric\": [0.5, 0.25, 0.25]}, 4]], \"labels\": [\"tip\", \"ear\"]}";

const SAMPLES: [(&str, &str, LandmarkFormat); 11] = [
    ("a.mrk.json", SLICER, LandmarkFormat::SlicerJson),
    ("a.fcsv", FCSV, LandmarkFormat::Fcsv),
    ("a.json", WRAP, LandmarkFormat::Wrap),
    ("a.pp", MESHLAB, LandmarkFormat::MeshLab),
    ("a.pts", IDAV, LandmarkFormat::Idav),
    ("a.tps", TPS, LandmarkFormat::Tps),
    ("a.nts", NTS, LandmarkFormat::Nts),
    ("a.dta", NTS_POINTS, LandmarkFormat::Nts),
    ("a.csv", CSV, LandmarkFormat::Csv),
    ("b.csv", CSV_PAIRS, LandmarkFormat::Csv),
    ("b.json", OWN, LandmarkFormat::Conemap),
];

fn side(name: &str, text: &str) -> MarkList {
    match read(name, text.as_bytes()).unwrap() {
        (_, Content::Side(list)) => list,
        (_, other) => panic!("{name}: {other:?}"),
    }
}

fn sides(name: &str, text: &str) -> [MarkList; 2] {
    match read(name, text.as_bytes()).unwrap() {
        (_, Content::Sides(sides)) => sides,
        (_, other) => panic!("{name}: {other:?}"),
    }
}

fn says(name: &str, text: &str) -> String {
    read(name, text.as_bytes()).unwrap_err().to_string()
}

fn mark(label: &str, p: [f64; 3]) -> Mark {
    Mark { label: label.to_owned(), spot: Some(Spot::InSpace(DVec3::from_array(p))) }
}

fn lost(label: &str) -> Mark {
    Mark { label: label.to_owned(), spot: None }
}

const TIP: [f64; 3] = [1.5, -2.0, 30.0];
const EAR: [f64; 3] = [4.0, 5.0, 6.0];

#[test]
fn every_sample_is_of_its_format_whatever_its_name() {
    for (name, text, format) in SAMPLES {
        assert_eq!(read(name, text.as_bytes()).unwrap().0, format, "{name}");
        let foreign = if name.ends_with("json") { "renamed.pts" } else { "renamed.json" };
        assert_eq!(detect(foreign, text.as_bytes()), Some(format), "{name}");
        assert_eq!(detect(name, format!("\u{feff}{text}").as_bytes()), Some(format), "{name}");
        let windows = text.replace('\n', "\r\n");
        assert_eq!(read(name, windows.as_bytes()), read(name, text.as_bytes()), "{name}");
    }
}

#[test]
fn slicer_files_name_their_system_and_what_was_not_placed() {
    let list = side("a.mrk.json", SLICER);
    assert_eq!((list.name.as_str(), list.space), ("skull", Some(Space::Ras)));
    assert_eq!(list.marks, [mark("tip", TIP), lost("lost"), mark("ear", EAR)]);
    let list = side("a.fcsv", FCSV);
    assert_eq!(list.space, Some(Space::Lps));
    assert_eq!(list.marks, [mark("tip, upper", TIP), mark("ear", EAR)]);
    for (word, space) in [("0", Space::Ras), ("RAS", Space::Ras), ("1", Space::Lps), ("lps", Space::Lps)] {
        let text = FCSV.replace("= LPS", &format!("= {word}"));
        assert_eq!(side("a.fcsv", &text).space, Some(space));
    }
    assert_eq!(
        says("a.fcsv", &FCSV.replace("= LPS", "= IJK")),
        "Slicer fiducial file, line 2: the coordinate system \"IJK\" should be LPS or RAS"
    );
    let columns = "# CoordinateSystem = RAS\n# columns = label,z,y,x\ntip,30,-2,1.5\n";
    assert_eq!(side("a.fcsv", columns).marks, [mark("tip", TIP)]);
    let table = "label,r,a,s,defined,selected\ntip,1.5,-2,30,1,1\n";
    let list = side("a.csv", table);
    assert_eq!((list.space, &list.marks[..]), (Some(Space::Ras), &[mark("tip", TIP)][..]));
}

#[test]
fn wrap_points_are_on_triangles_or_in_space() {
    let on = |label: &str, face, barycentric| Mark {
        label: label.to_owned(),
        spot: Some(Spot::OnMesh(LandmarkPoint::OnFace { face, barycentric })),
    };
    assert_eq!(side("a.json", WRAP).marks, [on("", 42, [0.25, 0.5, 0.25]), on("", 1337, [0.0, 1.0, 0.0])]);
    let named = "{\"tip\": [42, 0.25, 0.5], \"ear\": [7, 1, 0], \"Chin\": [8, 0, 0]}";
    let expected =
        [on("tip", 42, [0.25, 0.5, 0.25]), on("ear", 7, [1.0, 0.0, 0.0]), on("Chin", 8, [0.0, 0.0, 1.0])];
    assert_eq!(side("a.json", named).marks, expected);
    let in_space = "{\"tip\": [1.5, -2, 30], \"ear\": [4, 5, 6]}";
    assert_eq!(side("a.json", in_space).marks, [mark("tip", TIP), mark("ear", EAR)]);
    assert_eq!(
        says("a.json", "[[42, 0.25, 0.5], [1, 0.75, 0.5]]"),
        "Wrap point file, header: point 2: the weights u = 0.75 and v = 0.5 lie outside of the triangle"
    );
    assert!(
        says("a.json", "[[42, 0.25,\n 0.5], [1,\n \"x\", 0]]")
            .starts_with("Wrap point file, line 3: invalid type")
    );
    assert!(says("a.json", "[[9999999999, 0.5, 0.5]]").contains("there is no triangle 9999999999"));
}

#[test]
fn meshlab_points_that_are_not_active_were_not_placed() {
    let list = side("a.pp", MESHLAB);
    assert_eq!(list.name, "skull.ply");
    assert_eq!(list.marks, [mark("tip & ear", TIP), lost("off"), mark("ear", EAR)]);
    assert_eq!(
        says("a.pp", &MESHLAB.replace("\"-2\"", "\"two\"")),
        "MeshLab point file, line 7: \"two\" should be a coordinate"
    );
    assert!(says("a.pp", &MESHLAB.replace("</PickedPoints>", "")).contains("cut off"));
    assert!(says("a.pp", &MESHLAB.replace("&amp;", "&bomb;")).contains("line 7: it is no sound XML"));
}

#[test]
fn morphometric_files_hold_one_specimen_or_two() {
    assert_eq!(side("a.pts", IDAV).marks, [mark("S000", TIP), mark("left ear", EAR), lost("S002")]);
    let [cat, lion] = sides("a.tps", TPS);
    assert_eq!((cat.name.as_str(), lion.name.as_str()), ("cat", "lion"));
    assert_eq!(cat.marks, [mark("", [3.0, -4.0, 60.0]), mark("", [8.0, 10.0, 12.0])]);
    assert_eq!(lion.marks, [mark("", [1.0, 2.0, 3.0]), lost("")]);
    let [cat, lion] = sides("a.nts", NTS);
    assert_eq!((cat.name.as_str(), lion.name.as_str()), ("cat", "lion"));
    assert_eq!(cat.marks, [mark("", TIP), mark("", EAR)]);
    assert_eq!(lion.marks, [mark("", [1.0, 2.0, 3.0]), lost("")]);
    assert_eq!(side("a.nts", NTS_POINTS).marks, [mark("tip", TIP), mark("ear", EAR)]);
    let begins = "1 2B 3 0 DIM=3\ntip 1.5 -2 30\near 4 5 6\n";
    assert_eq!(side("a.nts", begins).marks, [mark("tip", TIP), mark("ear", EAR)]);
    let three = format!("{TPS}LM3=1\n0 0 0\nID=dog\n");
    assert_eq!(
        says("a.tps", &three),
        "TPS file: it holds the landmarks of 3 meshes (cat, lion, dog): keep one, or two with the source's first"
    );
    assert_eq!(
        says("a.tps", "LM=2\n1 2\n3 4\n"),
        "TPS file, line 1: its points have two coordinates (LM=): three are needed (LM3=)"
    );
    assert!(says("a.nts", &NTS.replace("Dim=3", "Dim=2")).contains("three coordinates (DIM=3)"));
}

#[test]
fn tables_hold_one_mesh_or_both() {
    assert_eq!(side("a.csv", CSV).marks, [mark("tip, upper", TIP), mark("ear", EAR), lost("lost")]);
    let [source, target] = sides("b.csv", CSV_PAIRS);
    assert_eq!(source.marks, [mark("tip", TIP), mark("ear", EAR)]);
    assert_eq!(target.marks, [mark("tip", [1.0, 2.0, 3.0]), mark("ear", [7.0, 8.0, 9.0])]);
    assert_eq!(says("a.csv", &CSV.replace("5,6", "5,inf")), "CSV file, line 3: inf is no usable coordinate");
    assert_eq!(says("a.csv", &CSV.replace("5,6", "5,nan")), "CSV file, line 3: NaN is no usable coordinate");
    assert_eq!(
        says("a.csv", &CSV.replace(",4,5,6", ",4,5")),
        "CSV file, line 3: a coordinate is missing: the file may be cut off"
    );
}

#[test]
fn numbers_that_announce_more_than_there_is_are_refused_before_memory_is_taken() {
    assert_eq!(
        says("a.pts", "Version 1.0\n4000000000\n"),
        "IDAV point file, line 2: there are 4000000000 points or more; the limit is 100000"
    );
    assert!(says("a.pts", "Version 1.0\n90000\nS0 1 2 3\n").contains("more than the file can hold"));
    assert!(says("a.tps", "LM3=99999\n1 2 3\n").contains("more than the file can hold"));
    assert!(says("a.nts", "1 90000 3 0 DIM=3\n").contains("more than the file can hold"));
    assert!(says("a.nts", "1 18446744073709551615 3 0 DIM=3\n").contains("the limit is 100000"));
    assert!(
        says("a.csv", &format!("x,y,z\n{}", "1,2,3\n".repeat(MAX_POINTS + 1)))
            .contains("the limit is 100000")
    );
    assert!(
        says("a.json", &format!("[{}[1,0,1]]", "[1,0,1],".repeat(MAX_POINTS)))
            .contains("more than 100000 points")
    );
    let long = vec![b' '; MAX_BYTES + 1];
    assert!(matches!(read("a.csv", &long), Err(LandmarkReadError::TooLarge { .. })));
}

#[test]
fn what_is_no_landmark_file_is_told() {
    assert!(
        says("a.txt", "hello").starts_with("this is no landmark file that can be read: use Conemap JSON, ")
    );
    assert!(says("a.json", "{\"x\": 1}").starts_with("the landmark file, line 1: missing field `pairs`"));
    assert_eq!(says("a.csv", "x,y,z\n"), "CSV file: it holds no landmarks");
    assert!(says("a.fcsv", "# CoordinateSystem = LPS\n").contains("holds no landmarks"));
}

#[test]
fn formats_refuse_more_meshes_than_they_hold() {
    let marks =
        vec![SurfaceMark { label: "tip".into(), position: DVec3::X, face: 0, weights: [1.0, 0.0, 0.0] }];
    let one = SurfaceMarks { name: "cat".into(), space: Space::Lps, marks };
    let both = [one.clone(), one.clone()];
    for format in LandmarkFormat::ALL {
        let outcomes = [write(format, &both[..1]).is_ok(), write(format, &both).is_ok()];
        let expected = match format.holds() {
            Holds::One => [true, false],
            Holds::OneOrBoth => [true, true],
            // Pairs are written by their own module.
            Holds::Both => [false, false],
        };
        assert_eq!(outcomes, expected, "{format}");
        assert!(write(format, &[]).is_err());
    }
}

#[test]
fn a_mesh_file_names_its_system_in_its_first_lines() {
    assert_eq!(Space::of_mesh(b"# SPACE=RAS\nv 0 0 0\n"), Space::Ras);
    assert_eq!(Space::of_mesh(b"ply\nformat ascii 1.0\ncomment SPACE=LPS\n"), Space::Lps);
    assert_eq!(Space::of_mesh(b""), Space::Lps);
    let p = DVec3::new(1.0, 2.0, 3.0);
    assert_eq!(Space::Ras.to(Space::Lps, p), DVec3::new(-1.0, -2.0, 3.0));
    assert_eq!(Space::Ras.to(Space::Ras, p), p);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn damaged_files_never_panic(
        sample in 0_usize..SAMPLES.len(),
        cut in 0.0_f64..1.0,
        flips in proptest::collection::vec((0.0_f64..1.0, 0_u8..=255), 0..4),
    ) {
        let (name, text, _) = SAMPLES[sample];
        let mut bytes = text.as_bytes().to_vec();
        bytes.truncate((bytes.len() as f64 * cut.sqrt()) as usize);
        for (at, byte) in flips {
            let place = (bytes.len() as f64 * at) as usize;
            if let Some(b) = bytes.get_mut(place) {
                *b = byte;
            }
        }
        if let Ok((_, content)) = read(name, &bytes) {
            let lists: &[MarkList] = match &content {
                Content::Side(list) => std::slice::from_ref(list),
                Content::Sides(lists) => lists,
                Content::Pairs(_) => &[],
            };
            for mark in lists.iter().flat_map(|list| &list.marks) {
                if let Some(Spot::InSpace(p)) = mark.spot {
                    prop_assert!(p.abs().max_element() < 1e100);
                }
            }
        }
    }

    /// At least two points: a matrix with one point a row has the points of one specimen.
    #[test]
    fn what_is_written_reads_back_to_the_last_bit(
        format in 0_usize..LandmarkFormat::ALL.len(),
        rows in proptest::collection::vec(("[ -~]{0,12}", [-1e6_f64..1e6, -1.0..1.0, -1e-9..1e-9], 0_u32..1000, 0.0_f64..1.0, 0.0_f64..1.0), 2..20),
        both in proptest::bool::ANY,
    ) {
        let format = LandmarkFormat::ALL[format];
        let marks: Vec<_> = rows.into_iter().map(|(label, position, face, a, b)| {
            let (u, v) = (a * (1.0 - b), a * b);
            SurfaceMark { label, position: DVec3::from_array(position), face, weights: [u, v, 1.0 - u - v] }
        }).collect();
        let named = |name: &str| SurfaceMarks { name: name.to_owned(), space: Space::Ras, marks: marks.clone() };
        let sides = if both { vec![named("cat.obj"), named("lion.obj")] } else { vec![named("cat.obj")] };
        let Ok(bytes) = write(format, &sides) else { return Ok(()) };
        let (found, content) = read(&format!("written.{}", format.ending()), &bytes).unwrap();
        prop_assert_eq!(found, format);
        let lists = match content {
            Content::Side(list) => vec![list],
            Content::Sides(lists) => lists.to_vec(),
            Content::Pairs(_) => vec![],
        };
        prop_assert_eq!(lists.len(), sides.len());
        for list in lists {
            prop_assert_eq!(list.marks.len(), marks.len());
            for (read, written) in list.marks.iter().zip(&marks) {
                match read.spot {
                    Some(Spot::InSpace(p)) => prop_assert_eq!(p, written.position),
                    Some(Spot::OnMesh(point)) => {
                        let LandmarkPoint::OnFace { face, barycentric } = point else { panic!("{point:?}") };
                        prop_assert_eq!((face, barycentric), (written.face, written.weights));
                    }
                    None => panic!("not placed"),
                }
                if matches!(format, LandmarkFormat::SlicerJson) {
                    prop_assert_eq!(&read.label, &written.label);
                }
                if matches!(format, LandmarkFormat::Fcsv | LandmarkFormat::MeshLab | LandmarkFormat::Csv) {
                    prop_assert_eq!(read.label.trim(), written.label.trim());
                }
            }
        }
    }
}
