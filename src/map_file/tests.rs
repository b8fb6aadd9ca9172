//! The format without a run: the identity of a small sphere, whole and damaged.

use super::container::{Container, Sections};
use super::header::{SectionEntry, SectionType};
use super::*;
use crate::base_domain::BaseDomain;
use crate::export::obj;
use crate::io::landmark_file::LandmarkFile;
use crate::math::random::SplitMix;
use crate::mesh::generators::icosphere;
use crate::mesh::{FaceId, HalfedgeId, Place, SurfaceMesh, SurfacePoint, VertexId};
use crate::surface_map::correspondence::{Correspondence, TextureDrawing};
use crate::surface_map::correspondence::{MappedPiece, PointLocator, TextureVertex};
use crate::surface_map::flat_layout::FlatDrawing;
use crate::surface_map::flat_layout::FlatLayout;
use glam::{DMat2, DVec2};

/// A file of a mesh, its faces as they are or all turned inside out.
fn file(mesh: &SurfaceMesh, corners: [usize; 3]) -> FileMesh {
    FileMesh::read(&file_bytes(mesh, corners)).unwrap()
}

fn file_bytes(mesh: &SurfaceMesh, corners: [usize; 3]) -> Vec<u8> {
    let turned = mesh.triangles().iter().map(|t| corners.map(|k| t[k].0).to_vec()).collect::<Vec<_>>();
    let positions: Vec<_> = mesh.positions().iter().copied().collect();
    crate::export::obj::polygons(&positions, &turned)
}

const AS_IT_IS: [usize; 3] = [0, 1, 2];
const INSIDE_OUT: [usize; 3] = [0, 2, 1];

/// The identity: the pieces are the faces, but for one face that is cut in two from a corner to an edge. That cuts its neighbour, too.
fn identity(mesh: &SurfaceMesh) -> MapFile {
    let halfedge = HalfedgeId::of(FaceId(3), 1);
    let middle = Place::on_edge(mesh, halfedge, 0.3);
    let mut vertices: Vec<[Place; 2]> = mesh.vertices().map(|v| [Place::Vertex(v); 2]).collect();
    vertices.push([middle; 2]);
    let new = vertices.len() as u32 - 1;
    let mut map = Correspondence { vertices, ..Correspondence::default() };
    let mut push = |face: FaceId, ring: &[u32]| {
        let begin = map.corners.len();
        map.corners.extend(ring);
        let corners = begin..map.corners.len();
        map.pieces.push(MappedPiece {
            faces: [face; 2],
            corners,
            map: DMat2::IDENTITY,
            is_certain: face.0 != 5,
        });
    };
    for (f, corners) in mesh.triangles().iter_enumerated() {
        let cut = [halfedge, mesh.twin(halfedge)].into_iter().find(|h| h.face() == f);
        match cut {
            Some(h) => {
                let [tail, head, apex] = [h, h.next(), h.prev()].map(|x| mesh.tail(x).0);
                push(f, &[tail, new, apex]);
                push(f, &[new, head, apex]);
            }
            None => push(f, &corners.map(|v| v.0)),
        }
    }
    let uv = |v: usize| DVec2::new(v as f64 * 0.01, 1.0 / (1.0 + v as f64));
    let texture = TextureDrawing {
        vertices: mesh
            .vertices()
            .map(|v| TextureVertex { place: Place::Vertex(v), uv: uv(v.index()) })
            .collect(),
        triangles: mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect(),
        faces: mesh.faces().collect(),
    };
    let base = icosphere(0);
    let layout = FlatLayout {
        lengths: base.halfedges().map(|h| base.length(h)).collect(),
        base: BaseDomain {
            mesh: base.with_positions(base.positions().iter().map(|_| glam::DVec3::ZERO).collect()),
        },
        drawings: [FlatDrawing::default(), FlatDrawing::default()],
    };
    let landmarks = LandmarkFile {
        pairs: (0..4).map(|v| [crate::io::landmark_file::LandmarkPoint::Vertex(v); 2]).collect(),
        ..LandmarkFile::default()
    };
    MapFile {
        correspondence: map,
        texture: Some(texture),
        layout: Some(layout),
        base: BaseDomain { mesh: base },
        cones: vec![0.5; 4],
        landmarks,
        options: serde_json::json!({ "method": "relaxed" }),
        summary: Summary { energy: 4.0, ..Summary::default() },
        report: serde_json::json!({ "faces": { "source": 80 } }),
    }
}

/// A small map with its meshes, the source's file inside out.
fn small() -> (MapFile, [FileMesh; 2]) {
    let mesh = icosphere(1);
    let meshes = [file(&mesh, INSIDE_OUT), file(&mesh, AS_IT_IS)];
    let map = identity(meshes[1].mesh());
    // Turned back, the source's faces begin at the same corner.
    assert_eq!(meshes[0].mesh().triangles(), meshes[1].mesh().triangles());
    (map, meshes)
}

#[test]
fn what_was_written_is_read() {
    let (map, meshes) = small();
    let meshes = meshes.each_ref();
    let bytes = write(&map, meshes);
    assert_eq!(bytes, write(&map, meshes));
    let back = read(&bytes, meshes).unwrap();
    assert_eq!(back.correspondence.pieces.len(), map.correspondence.pieces.len());
    assert_eq!(back.correspondence.corners, map.correspondence.corners);
    for (a, b) in back.correspondence.pieces.iter().zip(&map.correspondence.pieces) {
        assert_eq!((a.faces, &a.corners, a.is_certain), (b.faces, &b.corners, b.is_certain));
        assert!(a.map.abs_diff_eq(b.map, 1e-12));
    }
    for (a, b) in back.correspondence.vertices.iter().zip(&map.correspondence.vertices) {
        for (k, mesh) in meshes.iter().enumerate() {
            let [p, q] = [a, b].map(|places| places[k].position(mesh.mesh()));
            assert!(p.distance(q) < 1e-15);
        }
    }
    assert_eq!(back.texture, map.texture);
    assert_eq!(back.layout.unwrap().lengths, map.layout.unwrap().lengths);
    assert_eq!((back.cones, back.landmarks), (map.cones, map.landmarks));
    assert_eq!((back.options, back.summary, back.report), (map.options, map.summary, map.report));
    // A face of the source's file has its corners the other way round.
    let elements: Vec<usize> =
        (0..3).map(|k| meshes[0].vertex_number(meshes[0].mesh().triangles()[FaceId(0)][k])).collect();
    assert_eq!(elements.len(), 3);
    let point = SurfacePoint { face: FaceId(3), barycentric: [0.2, 0.3, 0.5] };
    assert_eq!(meshes[0].on_file(point).barycentric, [0.2, 0.5, 0.3]);
}

#[test]
fn points_of_the_identity_stay() {
    let (map, meshes) = small();
    let mesh = meshes[1].mesh();
    let locator = PointLocator::new([mesh, mesh], &map.correspondence);
    let mut random = SplitMix::new(1);
    for face in mesh.faces() {
        let (a, b) = (random.unit(), random.unit());
        for weights in [[a, 1.0, b], [0.0, a, b], [1.0, 0.0, 0.0], [0.0, 0.7, 0.3]] {
            let point = SurfacePoint::clamped(face, weights);
            for image in [locator.image(point), locator.preimage(point)] {
                assert!(image.position(mesh).distance(point.position(mesh)) < 1e-14, "{point:?} {image:?}");
            }
        }
    }
}

#[test]
fn the_meshes_that_a_file_wants_are_told_by_its_header() {
    let (mut map, meshes) = small();
    map.landmarks.source = Some("animals/cat.off".to_owned());
    let bytes = write(&map, meshes.each_ref());
    assert!(is_one(&bytes) && is_one(&bytes[..8]) && !is_one(&bytes[..7]) && !is_one(b"OFF"));
    let [source, target] = wanted_meshes(&bytes).unwrap();
    assert_eq!((source.name.as_deref(), target.name), (Some("animals/cat.off"), None));
    // The inside-out file is another mesh than the one that needed no turn.
    let hashes = meshes.each_ref().map(|mesh| Hash::of_checked(mesh.checked()).to_string());
    assert_eq!([source.checked_hash, target.checked_hash], hashes);
    assert_ne!(hashes[0], hashes[1]);
    assert!(matches!(wanted_meshes(&bytes[..100]), Err(MapFileError::CutOff { .. })));
}

#[test]
fn another_mesh_is_named() {
    let (map, meshes) = small();
    let bytes = write(&map, meshes.each_ref());
    let other = FileMesh::read(&obj::mesh(&icosphere(2))).unwrap();
    for (given, side) in [([&other, &meshes[1]], "source"), ([&meshes[0], &other], "target")] {
        let error = read(&bytes, given).unwrap_err();
        assert!(matches!(error, MapFileError::OtherMesh { .. }));
        assert!(error.to_string().starts_with(&format!("this is not the {side} that the map")), "{error}");
    }
    // Another order of the corners is another numbering.
    assert!(read(&bytes, [&meshes[1], &meshes[1]]).is_err());
    // The same mesh with a comment is the same mesh.
    let mut text = b"# a comment\n".to_vec();
    text.extend(obj::mesh(meshes[1].mesh()));
    let commented = FileMesh::read(&text).unwrap();
    assert_ne!(commented.hash(), meshes[1].hash());
    assert!(read(&bytes, [&meshes[0], &commented]).is_ok());
}

/// A file with its header changed as text.
fn with_header(bytes: &[u8], change: impl Fn(String) -> String) -> Vec<u8> {
    let length = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
    let text = change(String::from_utf8(bytes[16..16 + length].to_vec()).unwrap());
    let mut text = text.trim_end().as_bytes().to_vec();
    text.resize(text.len().next_multiple_of(8), b' ');
    [&bytes[..12], &(text.len() as u32).to_le_bytes(), &text, &bytes[16 + length..]].concat()
}

/// A file with one of its sections of integers changed.
fn with_integers(bytes: &[u8], name: &str, change: impl Fn(&mut Vec<u32>)) -> Vec<u8> {
    let container = Container::open(bytes).unwrap();
    let mut sections = Sections::default();
    for SectionEntry { name: other, kind, .. } in &container.header.sections {
        match kind {
            SectionType::U8 => sections.bytes(other, &container.bytes(other).unwrap()),
            SectionType::U32 => {
                let mut values = container.integers(other).unwrap();
                if other == name {
                    change(&mut values);
                }
                sections.integers(other, &values);
            }
            SectionType::F64 => sections.numbers(other, &container.numbers(other).unwrap()),
            SectionType::Other => panic!("the writer knows its types"),
        }
    }
    sections.into_file(container.header.clone())
}

#[test]
fn newer_files_are_read_as_far_as_that_is_sound() {
    let (map, meshes) = small();
    let bytes = write(&map, meshes.each_ref());
    let says = |bytes: &[u8]| read(bytes, meshes.each_ref()).unwrap_err().to_string();
    let mut newer = bytes.clone();
    newer[10] = 7;
    assert!(read(&newer, meshes.each_ref()).is_ok(), "a minor version is read");
    newer[8] = 2;
    assert!(
        says(&newer).starts_with("the map file has version 2, but this program reads version 1"),
        "{}",
        says(&newer)
    );
    let unknown = with_header(&bytes, |text| {
        let extra = r#""repairs":{"source":[]},"sections":[{"name":"caps","type":"i16","count":9,"packing":"zstd","offset":0,"bytes":3},"#;
        text.replacen("\"sections\":[", extra, 1)
    });
    assert!(read(&unknown, meshes.each_ref()).is_ok(), "{:?}", read(&unknown, meshes.each_ref()).err());
    let needed =
        with_header(&bytes, |text| text.replacen("\"requires\":[]", "\"requires\":[\"handles\"]", 1));
    assert!(says(&needed).contains("needs \"handles\""), "{}", says(&needed));
}

#[test]
fn faults_name_section_and_element() {
    let (map, meshes) = small();
    let says =
        |map: &MapFile| read(&write(map, meshes.each_ref()), meshes.each_ref()).unwrap_err().to_string();
    let changed = |change: fn(&mut MapFile)| {
        let mut map = map.clone();
        change(&mut map);
        says(&map)
    };
    let bytes = write(&map, meshes.each_ref());
    let with = |name: &str, change: fn(&mut Vec<u32>)| {
        read(&with_integers(&bytes, name, change), meshes.each_ref()).unwrap_err().to_string()
    };
    let corner = with("pieces.corners", |corners| corners[7] = 9999);
    assert_eq!(corner, "the map file, section \"pieces.corners\", element 7: 9999 is not below 43");
    let turned = changed(|m| m.correspondence.corners.swap(0, 1));
    assert!(turned.contains("do not fit together at the edge") || turned.contains("turned over"), "{turned}");
    let face = with("pieces.target_faces", |faces| faces[2] = 80);
    assert_eq!(face, "the map file, section \"pieces.target_faces\", element 2: 80 is not below 80");
    let elsewhere = with("pieces.target_faces", |faces| faces[2] = 70);
    assert!(elsewhere.contains("of piece 2 does not lie in the piece's target face"), "{elsewhere}");
    let weights = changed(|m| {
        m.correspondence.vertices[42][0] =
            Place::Face(SurfacePoint { face: FaceId(1), barycentric: [0.5, 0.6, 0.5] })
    });
    assert!(weights.contains("section \"vertices.source.parameters\", element 42: its weights"), "{weights}");
    let length = changed(|m| m.layout.as_mut().unwrap().lengths[HalfedgeId(4)] = -1.0);
    assert!(length.contains("section \"layout.lengths\""), "{length}");
    let number = changed(|m| m.cones[1] = f64::NAN);
    assert!(number.contains("section \"cones\", element 1"), "{number}");
    let uv = changed(|m| m.texture.as_mut().unwrap().vertices[2].uv.x = 1e7);
    assert!(uv.contains("section \"texture.uvs\", element 4"), "{uv}");
    let empty = read(b"", meshes.each_ref()).unwrap_err();
    assert_eq!(empty, MapFileError::NotAMapFile);
}

/// A piece of other corners in a face of both meshes, its matrix given.
fn push_piece(map: &mut MapFile, face: FaceId, ring: &[u32]) {
    let begin = map.correspondence.corners.len();
    map.correspondence.corners.extend(ring);
    let corners = begin..map.correspondence.corners.len();
    let piece = MappedPiece { faces: [face; 2], corners, map: DMat2::IDENTITY, is_certain: true };
    map.correspondence.pieces.push(piece);
}

/// Without the piece's corners there is no piece: those behind it move up.
fn remove_piece(map: &mut MapFile, number: usize) {
    let removed = map.correspondence.pieces.remove(number);
    map.correspondence.corners.drain(removed.corners.clone());
    for piece in &mut map.correspondence.pieces[number..] {
        let shorter = |end: usize| end - removed.corners.len();
        piece.corners = shorter(piece.corners.start)..shorter(piece.corners.end);
    }
}

/// Triangles, one of them with a vertex inside it that is to lie at one of its corners.
fn with_vertex_in(triangles: &mut Vec<[u32; 3]>, number: usize, new: u32) {
    let [a, b, c] = triangles[number];
    triangles[number] = [new, b, c];
    triangles.extend([[a, b, new], [a, new, c]]);
}

/// Two maps in one: the whole source goes to one vertex of the target, and one vertex of the source to the whole target. Both are
/// spheres and touch at two vertices, so that V - E + F = 2; every face is covered once, and no matrix is off by more than rounding.
/// Beyond the first vertex they touch at one beside it, or the whole side between both is shared.
fn collapsed(map: &mut MapFile, share_side: bool) {
    let mesh = icosphere(1);
    let count = mesh.vertex_count() as u32;
    let first = mesh.triangles().iter().position(|t| t[0] == VertexId(0)).unwrap();
    let own: Vec<[u32; 3]> = mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect();
    let faces: Vec<usize> = (0..own.len()).chain([first; 4]).collect();
    let mut pieces: Vec<([u32; 3], [usize; 2], f64)> = Vec::new();
    let mut vertices: Vec<[Place; 2]> =
        mesh.vertices().map(|v| [Place::Vertex(v), Place::Vertex(VertexId(0))]).collect();
    let (corner, apart) = ([Place::Vertex(VertexId(0)); 2], count + 1);
    vertices.extend([corner, corner]);
    let mut onto_vertex = own.clone();
    with_vertex_in(&mut onto_vertex, first, count);
    pieces.extend(onto_vertex.iter().zip(&faces).map(|(t, &f)| (*t, [f, first], 1e-7)));
    // The second sphere shares the first vertex and the one that was added to the first sphere.
    let mut from_vertex = own;
    let added = if share_side { [count, apart] } else { [apart, count] };
    with_vertex_in(&mut from_vertex, first, added[0]);
    with_vertex_in(&mut from_vertex, first, added[1]);
    let second = vertices.len() as u32;
    vertices.extend(mesh.vertices().skip(1).map(|v| [Place::Vertex(VertexId(0)), Place::Vertex(v)]));
    let number = |v: u32| if v == 0 || v >= count { v } else { second + v - 1 };
    pieces.extend(from_vertex.iter().zip(&faces).map(|(t, &f)| (t.map(number), [first, f], 1e7)));
    map.correspondence = Correspondence { vertices, ..Correspondence::default() };
    for (ring, faces, scale) in pieces {
        push_piece(map, FaceId(0), &ring);
        let piece = map.correspondence.pieces.last_mut().unwrap();
        (piece.faces, piece.map) = (faces.map(|f| FaceId(f as u32)), DMat2::IDENTITY * scale);
    }
}

/// Each attack is refused by this reader and by the independent proof; the kinds are those of the proof.
#[test]
fn attacked_maps_are_refused_by_both_certificates() {
    let (map, meshes) = small();
    let mesh = icosphere(1);
    let bytes = [file_bytes(&mesh, INSIDE_OUT), file_bytes(&mesh, AS_IT_IS)];
    let prove = |map: &[u8]| {
        let files = crate::job::MapFiles { map, source: &bytes[0], target: &bytes[1] };
        crate::job::prove(files, &mut |_| std::ops::ControlFlow::Continue(()))
    };
    let proof = prove(&write(&map, meshes.each_ref())).unwrap();
    assert!(proof.is_exact() && proof.pieces == 82 && proof.landmarks.exact == 4, "{proof:?}");
    type Attack = fn(&mut MapFile);
    let attacks: [(&str, &str, Attack); 10] = [
        ("spheres that touch at vertices", "parts", |m| collapsed(m, false)),
        ("spheres that touch along a side", "overlap", |m| collapsed(m, true)),
        ("a missing cell", "gap", |m| remove_piece(m, 7)),
        ("a cell that is there twice", "overlap", |m| {
            let piece = m.correspondence.pieces[7].clone();
            let ring = m.correspondence.corners[piece.corners].to_vec();
            push_piece(m, piece.faces[0], &ring);
        }),
        ("a flipped cell", "overlap", |m| m.correspondence.corners[..3].reverse()),
        ("a swapped pair of cells", "elsewhere", |m| {
            let [a, b] = [9, 60].map(|k| m.correspondence.pieces[k].faces);
            (m.correspondence.pieces[9].faces, m.correspondence.pieces[60].faces) = (b, a);
        }),
        ("the map twice", "parts", |m| {
            let (vertices, pieces) = (m.correspondence.vertices.clone(), m.correspondence.pieces.clone());
            let corners = m.correspondence.corners.clone();
            let second = vertices.len() as u32;
            m.correspondence.vertices.extend(vertices);
            for piece in pieces {
                let ring: Vec<u32> = corners[piece.corners].iter().map(|v| v + second).collect();
                push_piece(m, piece.faces[0], &ring);
            }
        }),
        ("a place beyond its edge", "beside-edge", |m| {
            if let Place::Edge { along, .. } = &mut m.correspondence.vertices[42][0] {
                *along = -0.25;
            }
        }),
        ("a landmark that does not exist", "landmark", |m| {
            m.landmarks.pairs[2][1] = crate::io::landmark_file::LandmarkPoint::Vertex(42);
        }),
        ("a matrix that is none", "matrix", |m| {
            let face = m.correspondence.pieces[0].faces[0];
            let side = m.correspondence.corners[..2].to_vec();
            push_piece(m, face, &side);
            m.correspondence.pieces.iter_mut().skip(82).for_each(|piece| piece.map = DMat2::ZERO);
        }),
    ];
    for (name, kind, attack) in attacks {
        let mut attacked = map.clone();
        attack(&mut attacked);
        let bytes = write(&attacked, meshes.each_ref());
        let found = prove(&bytes).expect_err(name);
        assert_eq!(found.kind(), kind, "{name}: {found}");
        assert!(read(&bytes, meshes.each_ref()).is_err(), "{name}");
    }
    let bytes = write(&map, meshes.each_ref());
    let exchanged = with_integers(&bytes, "vertices.target.elements", |vertices| vertices.swap(3, 30));
    assert_eq!(prove(&exchanged).unwrap_err().kind(), "elsewhere");
    assert!(read(&exchanged, meshes.each_ref()).is_err());
    // A landmark that is elsewhere is no fault of the pieces: the proof alone looks whether they meet.
    let mut moved = map.clone();
    moved.landmarks.pairs[2][1] = crate::io::landmark_file::LandmarkPoint::Vertex(20);
    let bytes = write(&moved, meshes.each_ref());
    assert_eq!(prove(&bytes).unwrap_err().kind(), "landmark");
}

#[test]
fn textures_that_cannot_be_compared_with_the_pieces_are_refused() {
    let mut map = small().0.correspondence;
    let piece = map.pieces[0].clone();
    let triangles = vec![piece.faces[1]; 1 << 20];
    assert!(read::check_crowds(&triangles, &map, 80).is_ok());
    map.pieces.resize(400, piece);
    let error = read::check_crowds(&triangles, &map, 80).unwrap_err().to_string();
    assert!(
        error.contains("section \"texture.faces\"") && error.contains("the limit is 268435456"),
        "{error}"
    );
}

/// Whatever happens to a file, it is refused with a sentence or gives a map that passes the check; it never panics, and never
/// takes memory that its size does not warrant.
#[test]
fn damaged_files_are_refused_or_are_maps() {
    let (map, meshes) = small();
    let bytes = write(&map, meshes.each_ref());
    for length in 0..bytes.len() {
        let error = read(&bytes[..length], meshes.each_ref()).err();
        // Only padding after the last section may be missing.
        assert!(error.is_some_and(|e| !e.to_string().is_empty()) || length + 8 > bytes.len(), "{length}");
    }
    let mut random = SplitMix::new(20);
    let mut still_maps = 0;
    for _ in 0..3000 {
        let mut damaged = bytes.clone();
        for _ in 0..1 + (random.unit() * 3.0) as usize {
            let place = (random.unit() * bytes.len() as f64) as usize;
            damaged[place] ^= 1 << (random.unit() * 8.0) as u32;
        }
        match read(&damaged, meshes.each_ref()) {
            Ok(back) => {
                still_maps += 1;
                let surfaces = [meshes[0].mesh(), meshes[1].mesh()];
                crate::surface_map::correspondence::check(surfaces, &back.correspondence).unwrap();
                let point = SurfacePoint { face: FaceId(3), barycentric: [0.2, 0.3, 0.5] };
                let image = PointLocator::new(surfaces, &back.correspondence).image(point);
                assert!(image.barycentric.iter().all(|w| (0.0..=1.0).contains(w)));
            }
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
    // Texture coordinates, cones and words may change without harm.
    assert!(still_maps > 0 && still_maps < 2900, "{still_maps}");
}

#[test]
fn a_section_that_claims_more_than_it_holds_is_refused_before_it_is_unpacked() {
    let (map, meshes) = small();
    let bytes = write(&map, meshes.each_ref());
    let marker = "\"name\":\"pieces.corners\",\"type\":\"u32\",\"count\":";
    for count in ["200000000", "18446744073709551615", "400000"] {
        let lying = with_header(&bytes, |text| {
            let at = text.find(marker).unwrap() + marker.len();
            let end = at + text[at..].find(',').unwrap();
            format!("{}{count}{}", &text[..at], &text[end..])
        });
        let error = read(&lying, meshes.each_ref()).unwrap_err();
        assert!(
            matches!(
                error,
                MapFileError::TooLarge { .. } | MapFileError::Section { problem: SectionProblem::Packed, .. }
            ),
            "{error}"
        );
    }
}
