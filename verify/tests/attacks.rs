//! Attacks: map files that are changed in one way each, and refused for that reason.
#![allow(clippy::expect_used, clippy::unwrap_used, clippy::panic, reason = "a test fails by a panic")]

mod support;

use conemap_verify::{Refusal, Side};
use serde_json::json;
use support::{BEAN_BALL, BEAN_BALL_MIRRORED, Example, judged, meshes};

fn example() -> Example {
    Example::new(BEAN_BALL)
}

#[test]
fn real_maps_are_proved() {
    for (bytes, mirrored, landmarks) in [(BEAN_BALL, false, [7, 6]), (BEAN_BALL_MIRRORED, true, [6, 6])] {
        let proof = judged(bytes, &meshes()).expect("a map");
        assert!(proof.is_exact() && proof.is_mirrored == mirrored, "{proof:?}");
        assert_eq!([proof.landmarks.pairs, proof.landmarks.exact], landmarks);
        assert!(
            proof.landmarks.largest_distance < 1e-15 && proof.matrices.largest_distance < 1e-10,
            "{proof:?}"
        );
        assert_eq!(proof.faces, [320, 224]);
        assert!(proof.sentence().starts_with("Proved: the map is one-to-one"));
        // A map that is taken apart and put together again is the same map.
        assert_eq!(Example::new(bytes).judged(), Ok(proof));
    }
}

#[test]
fn a_flipped_piece_is_refused() {
    let refusal = example().refused(|e| {
        let mut pieces = e.pieces();
        pieces[40].0.reverse();
        e.set_pieces(&pieces);
    });
    assert!(matches!(refusal, Refusal::Overlap { .. }), "{refusal}");
}

#[test]
fn a_vertex_moved_over_its_neighbours_is_refused() {
    let mut e = example();
    let vertex = e.first_of("target", 2);
    let at = e.parameters("target", vertex);
    let weights = e.numbers("vertices.target.parameters")[at.clone()].to_vec();
    let most = (0..3).max_by(|&a, &b| weights[a].total_cmp(&weights[b])).expect("three");
    let refusal = e.refused(|e| {
        // The corner is moved to the far end of its face.
        let moved = [0, 1, 2].map(|k| if k == (most + 1) % 3 { 0.98 } else { 0.01 });
        e.numbers("vertices.target.parameters")[at].copy_from_slice(&moved);
    });
    assert!(matches!(refusal, Refusal::Turned { side: Side::Target, .. }), "{refusal}");
}

/// The identity of an octahedron, except in one face, which has two vertices p and q inside; on the target q lies elsewhere.
fn octahedron(q_on_target: [f64; 3]) -> Example {
    let mut e = example();
    let positions = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let opposite = positions.map(|p: [f64; 3]| p.map(|x| -x));
    let triangles = [[0, 1, 2], [1, 0, 5], [2, 1, 3], [0, 2, 4], [3, 1, 5], [4, 2, 3], [5, 0, 4], [3, 5, 4]];
    let mesh = support::Mesh { positions: [positions, opposite].concat(), triangles: triangles.to_vec() };
    e.meshes = [mesh.clone(), mesh];
    let (p, q) = (6, 7);
    let inside = [[0, 1, q], [0, q, p], [1, 2, q], [2, p, q], [2, 0, p]].map(|t| (t.to_vec(), [0, 0]));
    let others = (1..8_u32).map(|f| (triangles[f as usize].to_vec(), [f, f]));
    e.set_pieces(&inside.into_iter().chain(others).collect::<Vec<_>>());
    for (side, q) in [("source", [0.2, 0.6, 0.2]), ("target", q_on_target)] {
        *e.bytes_of(&format!("vertices.{side}.kinds")) = vec![0, 0, 0, 0, 0, 0, 2, 2];
        *e.integers(&format!("vertices.{side}.elements")) = vec![0, 1, 2, 3, 4, 5, 0, 0];
        *e.numbers(&format!("vertices.{side}.parameters")) = [[0.6, 0.2, 0.2], q].concat();
    }
    // The piece of the first vertex, q and p, where q is beside the line through the others by 1e-8.
    *e.integers("pieces.thin") = vec![1];
    let lean = 2.5e-8;
    *e.numbers("pieces.thin_matrices") = vec![0.5 + lean, 0.5, 0.5 - lean, 0.5];
    e.header["landmarks"]["pairs"] = json!([[0, 0], [1, 1], [2, 2], [3, 3]]);
    for side in ["source", "target"] {
        let Err(Refusal::OtherMesh { found, .. }) = e.judged() else { panic!("the bean's hash") };
        e.header[side]["checked_sha256"] = json!(found);
    }
    e
}

/// q crosses the line between the first vertex and p where its last two weights agree.
#[test]
fn a_vertex_moved_by_one_ulp_across_an_edge_is_not_proved() {
    let at = |weight: f64| octahedron([0.2, weight, 0.4]).judged().expect("within rounding");
    let before = at(0.4_f64.next_up());
    assert!(before.is_exact() && before.signs.by_integers > 0, "{before:?}");
    for (weight, turned) in [(0.4, 0.0), (0.4_f64.next_down(), 1e-17)] {
        let proof = at(weight);
        assert!(!proof.is_exact() && proof.doubtful.triangles == 1, "{proof:?}");
        assert_eq!(proof.doubtful.first_piece, Some(1));
        assert!((turned / 2.0..1e-16).contains(&proof.doubtful.turned_share), "{proof:?}");
        assert!(
            proof.sentence().starts_with("Not proved everywhere: 1 of 12 triangles"),
            "{}",
            proof.sentence()
        );
    }
    // Where q lies farther beyond the line, rounding no longer explains it.
    let refusal = octahedron([0.2, 0.39, 0.41]).judged().expect_err("turned over");
    assert!(matches!(refusal, Refusal::Turned { piece: 1, side: Side::Target, .. }), "{refusal}");
}

#[test]
fn a_map_that_is_there_twice_is_refused() {
    let refusal = example().refused(|e| {
        let pieces = e.pieces();
        let vertices = double_vertices(e, |_| true);
        let second = pieces.iter().map(|(ring, faces)| (ring.iter().map(|v| v + vertices).collect(), *faces));
        let both: Vec<_> = pieces.iter().cloned().chain(second).collect();
        e.set_pieces(&both);
    });
    assert!(matches!(refusal, Refusal::Parts { .. }), "{refusal}");
}

/// Copies the places of the wanted overlay vertices behind the last vertex, and returns the number of vertices before.
fn double_vertices(e: &mut Example, is_wanted: impl Fn(usize) -> bool) -> u32 {
    let vertices = e.bytes_of("vertices.source.kinds").len();
    for side in ["source", "target"] {
        for v in (0..vertices).filter(|&v| is_wanted(v)) {
            let at = e.parameters(side, v);
            let kind = e.bytes_of(&format!("vertices.{side}.kinds"))[v];
            let element = e.integers(&format!("vertices.{side}.elements"))[v];
            e.bytes_of(&format!("vertices.{side}.kinds")).push(kind);
            e.integers(&format!("vertices.{side}.elements")).push(element);
            e.numbers(&format!("vertices.{side}.parameters")).extend_from_within(at);
        }
    }
    vertices as u32
}

/// Two sheets, cut along two sides that meet at m and glued crosswise: branched over their other ends. It is a sphere, and all its
/// pieces are positive.
#[test]
fn a_double_cover_is_refused() {
    let refusal = example().refused(|e| {
        let pieces = e.pieces();
        // The pieces around a vertex, each with the neighbour that its side from the vertex leads to.
        let m = pieces[100].0[0];
        let mut fan: Vec<(usize, u32)> = Vec::new();
        let mut piece = 100;
        loop {
            let ring = &pieces[piece].0;
            let k = ring.iter().position(|&v| v == m).expect("around m");
            fan.push((piece, ring[(k + 1) % ring.len()]));
            let before = ring[(k + ring.len() - 1) % ring.len()];
            let runs =
                |ring: &[u32]| (0..ring.len()).any(|k| ring[k] == m && ring[(k + 1) % ring.len()] == before);
            piece = pieces.iter().position(|(ring, _)| runs(ring)).expect("a closed surface");
            if piece == 100 {
                break;
            }
        }
        let half = fan.len() / 2;
        let ends = [fan[0].1, fan[half].1];
        let left: Vec<usize> = fan[..half].iter().map(|(piece, _)| *piece).collect();
        let is_shared = |v: usize| ends.contains(&(v as u32));
        let vertices = double_vertices(e, |v| !is_shared(v));
        let copies: Vec<u32> = (0..vertices).filter(|v| !ends.contains(v)).collect();
        let on_sheet = |v: u32, sheet: usize| match copies.binary_search(&v) {
            Ok(k) if sheet == 1 => vertices + k as u32,
            _ => v,
        };
        let mut both = Vec::new();
        for sheet in 0..2 {
            for (k, (ring, faces)) in pieces.iter().enumerate() {
                let sheet_of = |v: u32| if v == m && left.contains(&k) { 1 - sheet } else { sheet };
                both.push((ring.iter().map(|&v| on_sheet(v, sheet_of(v))).collect(), *faces));
            }
        }
        e.set_pieces(&both);
    });
    assert!(matches!(refusal, Refusal::Covered { times: 2, side: Side::Source, .. }), "{refusal}");
}

#[test]
fn a_swapped_pair_of_pieces_is_refused() {
    let mut e = example();
    let pieces = e.pieces();
    let other = (1..pieces.len())
        .find(|&k| pieces[k].0.len() == pieces[0].0.len() && (0..2).all(|s| pieces[k].1[s] != pieces[0].1[s]))
        .expect("another piece of that size");
    let refusal = e.refused(|e| {
        let mut swapped = pieces.clone();
        let (a, b) = (swapped[0].1, swapped[other].1);
        (swapped[0].1, swapped[other].1) = (b, a);
        e.set_pieces(&swapped);
    });
    assert!(matches!(refusal, Refusal::Elsewhere { piece: 0, side: Side::Source, .. }), "{refusal}");
    // Only their faces on the target are exchanged.
    let refusal = e.refused(|e| e.integers("pieces.target_faces").swap(0, other));
    assert!(matches!(refusal, Refusal::Elsewhere { piece: 0, side: Side::Target, .. }), "{refusal}");
}

#[test]
fn missing_and_doubled_cells_are_refused() {
    let refusal = example().refused(|e| {
        let mut pieces = e.pieces();
        pieces.remove(77);
        e.set_pieces(&pieces);
    });
    assert!(matches!(refusal, Refusal::Gap { .. }), "{refusal}");
    let refusal = example().refused(|e| {
        let mut pieces = e.pieces();
        pieces.push(pieces[77].clone());
        e.set_pieces(&pieces);
    });
    assert!(matches!(refusal, Refusal::Overlap { pieces: [77, _], .. }), "{refusal}");
    let refusal = example().refused(|e| {
        double_vertices(e, |v| v == 5);
    });
    assert!(matches!(refusal, Refusal::Unused { .. }), "{refusal}");
}

#[test]
fn places_beside_their_elements_are_refused() {
    let mut e = example();
    let on_edge = e.first_of("source", 1);
    let at = e.parameters("source", on_edge).start;
    for along in [1.0_f64.next_up(), -5e-324, -0.5, 1e300] {
        let refusal = e.refused(|e| e.numbers("vertices.source.parameters")[at] = along);
        assert!(matches!(refusal, Refusal::BesideEdge { side: Side::Source, .. }), "{refusal}");
    }
    let refusal = e.refused(|e| e.numbers("vertices.source.parameters")[at] = f64::NAN);
    assert!(matches!(refusal, Refusal::Section { .. }), "{refusal}");
    let in_face = e.first_of("target", 2);
    let at = e.parameters("target", in_face);
    for weights in [[0.5, 0.5, 0.1], [-0.1, 0.6, 0.5], [0.3, 0.3, 0.4 - 2e-9], [1e300, -1e300, 1.0]] {
        let refusal =
            e.refused(|e| e.numbers("vertices.target.parameters")[at.clone()].copy_from_slice(&weights));
        assert!(matches!(refusal, Refusal::Weights { side: Side::Target, .. }), "{refusal}");
    }
    for (name, element) in [("source", u32::MAX), ("target", 9999)] {
        let refusal = e.refused(|e| e.integers(&format!("vertices.{name}.elements"))[on_edge] = element);
        assert!(matches!(refusal, Refusal::NoPlace { .. }), "{refusal}");
    }
    let refusal = e.refused(|e| e.bytes_of("vertices.source.kinds")[on_edge] = 3);
    assert!(matches!(refusal, Refusal::NoPlace { .. }), "{refusal}");
    // The bean's first vertex has no face.
    let vertex = e.first_of("source", 0);
    let refusal = e.refused(|e| e.integers("vertices.source.elements")[vertex] = 0);
    assert!(matches!(refusal, Refusal::NoPlace { .. }), "{refusal}");
}

#[test]
fn a_piece_that_names_another_face_is_refused() {
    let mut e = example();
    let face = e.integers("pieces.source_faces")[30];
    for other in [(face + 100) % 320, 320, u32::MAX] {
        let refusal = e.refused(|e| e.integers("pieces.source_faces")[30] = other);
        assert!(matches!(refusal, Refusal::Elsewhere { piece: 30, side: Side::Source, .. }), "{refusal}");
    }
}

#[test]
fn wrong_matrices_are_refused() {
    let e = Example::new(BEAN_BALL_MIRRORED);
    type Change = fn(&mut Vec<f64>);
    let changes: [(Change, &str); 4] = [
        (|m| m[..4].iter_mut().for_each(|x| *x = 0.0), "not invertible"),
        (|m| m.swap(0, 1), "matrix"),
        (|m| m[0] += 0.01, "matrix"),
        (|m| m[..4].iter_mut().for_each(|x| *x *= 1.5), "does not carry"),
    ];
    for (change, words) in changes {
        let refusal = e.refused(|e| change(e.numbers("pieces.thin_matrices")));
        assert!(
            matches!(refusal, Refusal::Matrix { .. }) && refusal.to_string().contains(words),
            "{refusal}"
        );
    }
    let refusal = e.refused(|e| {
        e.integers("pieces.thin").remove(0);
        e.numbers("pieces.thin_matrices").drain(..4);
    });
    assert!(
        matches!(refusal, Refusal::Matrix { .. }) && refusal.to_string().contains("not given"),
        "{refusal}"
    );
    let refusal = e.refused(|e| e.integers("pieces.thin").swap(0, 1));
    assert!(matches!(refusal, Refusal::Section { .. }), "{refusal}");
}

#[test]
fn other_meshes_are_refused() {
    let refusal = example().refused(|e| e.meshes.reverse());
    assert!(matches!(refusal, Refusal::OtherMesh { side: Side::Source, .. }), "{refusal}");
    let refusal = example().refused(|e| {
        let x = &mut e.meshes[1].positions[17][0];
        *x = x.next_up();
    });
    assert!(matches!(refusal, Refusal::OtherMesh { side: Side::Target, .. }), "{refusal}");
    let refusal = example().refused(|e| e.meshes[0].triangles[3].swap(1, 2));
    assert!(matches!(refusal, Refusal::OtherMesh { side: Side::Source, .. }), "{refusal}");
    let refusal = example().refused(|e| e.header["target"]["checked_sha256"] = json!("0".repeat(64)));
    assert!(matches!(refusal, Refusal::OtherMesh { side: Side::Target, .. }), "{refusal}");
    // The mirror image of the right mesh is the wrong mesh for a map to the mesh itself.
    let refusal = example().refused(|e| e.header["target_image"] = json!("mirrored"));
    assert!(matches!(refusal, Refusal::Turned { side: Side::Target, .. }), "{refusal}");
}

#[test]
fn meshes_that_are_no_spheres_are_refused() {
    let problem = |change: fn(&mut Vec<[u32; 3]>)| {
        let refusal = example().refused(|e| change(&mut e.meshes[0].triangles));
        assert!(matches!(refusal, Refusal::Mesh { side: Side::Source, .. }), "{refusal}");
        refusal.to_string()
    };
    assert!(problem(|t| t.truncate(319)).contains("has not two faces"));
    assert!(problem(|t| t.push(t[0])).contains("has not two faces"));
    assert!(problem(|t| t[5][1] = t[5][0]).contains("face 5"));
    assert!(problem(|t| t[5][1] = 100_000).contains("face 5"));
    assert!(problem(|t| t.clear()).contains("0 faces"));
    // A second sphere of other vertices; one vertex for two far ones; a torus of 3 x 3 squares.
    assert!(
        problem(|t| {
            *t = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]].to_vec();
            t.extend([[4, 5, 6], [4, 6, 7], [4, 7, 5], [5, 7, 6]]);
        })
        .contains("several parts")
    );
    assert!(
        problem(|t| {
            *t = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]].to_vec();
            t.extend([[0, 5, 6], [0, 6, 7], [0, 7, 5], [5, 7, 6]]);
        })
        .contains("several parts")
    );
    assert!(
        problem(|t| {
            let at = |i: u32, j: u32| 3 * (i % 3) + j % 3;
            let squares = (0..9).map(|k| (k / 3, k % 3));
            *t = squares
                .flat_map(|(i, j)| {
                    let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    [[a, b, c], [a, c, d]]
                })
                .collect();
        })
        .contains("V - E + F is 0")
    );
}

#[test]
fn moved_landmarks_are_refused() {
    let changes: [fn(&mut serde_json::Value); 6] = [
        |pairs| pairs[2][1] = json!(61),
        |pairs| pairs[2][0] = json!(18),
        |pairs| pairs[6][1]["barycentric"] = json!([0.25, 0.25, 0.5]),
        |pairs| pairs[6][0]["barycentric"] = json!([0.3000001, 0.3, 0.3999999]),
        |pairs| pairs[6][0]["face"] = json!(320),
        |pairs| pairs[0][0] = json!(0),
    ];
    for (k, change) in changes.into_iter().enumerate() {
        let refusal = example().refused(|e| change(&mut e.header["landmarks"]["pairs"]));
        let wanted = [2, 2, 6, 6, 6, 0][k];
        assert!(matches!(refusal, Refusal::Landmark { pair, .. } if pair == wanted), "{k}: {refusal}");
    }
}

#[test]
fn points_of_faces_at_their_corners_are_vertices() {
    let mut e = example();
    let usual = e.judged().expect("a map");
    let meshes = support::meshes();
    for pair in 0..6 {
        for (side, mesh) in meshes.iter().enumerate() {
            let vertex = e.header["landmarks"]["pairs"][pair][side].as_u64().expect("a vertex") as u32;
            let face = mesh.triangles.iter().position(|t| t.contains(&vertex)).expect("a face");
            let weights = mesh.triangles[face].map(|v| if v == vertex { 1.0 } else { 0.0 });
            e.header["landmarks"]["pairs"][pair][side] = json!({ "face": face, "barycentric": weights });
        }
    }
    assert_eq!(e.judged(), Ok(usual));
}

/// Where an edge of each mesh coincide, a piece has two corners: it is left out where it lies along a side, and only there.
#[test]
fn pieces_without_inside_are_left_out() {
    let mut e = Example::new(BEAN_BALL_MIRRORED);
    let pieces = e.pieces();
    // A thin piece: its matrix is given, and carries each of its sides.
    let thin = e.integers("pieces.thin")[0] as usize;
    let matrix = e.numbers("pieces.thin_matrices")[..4].to_vec();
    let (ring, faces) = pieces[thin].clone();
    let with = |corners: [u32; 2]| {
        let mut e = e.clone();
        let number = pieces.len() as u32;
        e.set_pieces(&[&pieces[..], &[(corners.to_vec(), faces)]].concat());
        e.integers("pieces.thin").push(number);
        e.numbers("pieces.thin_matrices").extend(&matrix);
        e.judged()
    };
    let proof = with([ring[0], ring[1]]).expect("a map");
    assert!(proof.is_exact() && proof.segments == 1, "{proof:?}");
    let far = pieces[thin + 900].0[0];
    let refusal = with([ring[0], far]).expect_err("no side");
    assert!(matches!(refusal, Refusal::Gap { .. }), "{refusal}");
    let refusal = with([ring[0], ring[0]]).expect_err("a point");
    assert!(matches!(refusal, Refusal::Corners { .. }), "{refusal}");
}

#[test]
fn files_that_are_none_are_refused() {
    let bytes = example().bytes();
    let says = |bytes: &[u8]| judged(bytes, &meshes()).expect_err("no map").to_string();
    assert!(says(b"").contains("cut off"));
    assert!(says(&[b"CONEMAQ\0", &bytes[8..]].concat()).contains("does not begin"));
    let mut other = bytes.clone();
    other[8] = 2;
    assert!(says(&other).contains("version 2"));
    let refusal = example().refused(|e| e.header["requires"] = json!(["handles"]));
    assert!(refusal.to_string().contains("needs \"handles\""), "{refusal}");
    for k in 0..example().sections.len() {
        if example().sections[k].0 == "pieces.uncertain" {
            continue;
        }
        let name = example().sections[k].0.clone();
        let refusal = example().refused(|e| drop(e.sections.remove(k)));
        assert_eq!(refusal.to_string(), format!("section \"{name}\" of the map file: it is missing"));
        let refusal = example().refused(|e| e.sections.push(e.sections[k].clone()));
        assert_eq!(refusal.to_string(), format!("section \"{name}\" of the map file: it is there twice"));
    }
    let cases = [
        // No memory is taken for what such a file cannot hold.
        ("\"count\":2649", "\"count\":4294967296", "the map file cannot be read: its"),
        ("\"count\":2649", "\"count\":2650", "section \"vertices.source.kinds\""),
        ("\"offset\":0", "\"offset\":18446744073709551615", "section \"vertices.source.kinds\""),
    ];
    for (from, to, words) in cases {
        let begin = 16 + u32::from_le_bytes(bytes[12..16].try_into().expect("4 bytes")) as usize;
        let text = String::from_utf8(bytes[16..begin].to_vec()).expect("JSON");
        assert!(text.contains(from), "{text}");
        let text = text.replacen(from, to, 1).into_bytes();
        let refusal =
            says(&[&bytes[..12], &(text.len() as u32).to_le_bytes(), &text, &bytes[begin..]].concat());
        assert!(refusal.starts_with(words), "{refusal}");
    }
}

#[test]
fn a_check_can_be_stopped() {
    use std::ops::ControlFlow;
    let meshes = meshes();
    let given = [meshes[0].given(), meshes[1].given()];
    let mut shares = Vec::new();
    let whole = conemap_verify::verify(BEAN_BALL, given, &mut |share| {
        shares.push(share);
        ControlFlow::Continue(())
    });
    assert!(
        whole.is_ok() && shares.is_sorted() && shares.last().is_some_and(|share| *share <= 1.0),
        "{shares:?}"
    );
    for stop in 0..shares.len() {
        let mut asked = 0;
        let outcome = conemap_verify::verify(BEAN_BALL, given, &mut |_| {
            asked += 1;
            if asked > stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert_eq!(outcome, Err(Refusal::Stopped));
    }
}
