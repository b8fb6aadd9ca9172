//! Tests of repair on broken meshes as files have them: with several faults at once, in quads and in loose triangles, in any order, size
//! and place.

use crate::damage::Damage;
use crate::repair::is_sound;
use crate::rough_meshes::{Random, body, cut_octahedron};
use conemap::export::obj;
use conemap::io;
use conemap::mesh::check::{CheckedMesh, closed_genus_zero};
use conemap::mesh::generators::{icosphere, torus};
use conemap::mesh::repair::{DefectKind, RepairOptions, RepairRefusal, RepairedMesh, defects, repaired};
use conemap::mesh::soup::PolygonSoup;
use conemap::monitor::Silent;
use glam::DVec3;
use std::collections::BTreeMap;

/// The random choices by which a broken mesh becomes a file.
struct Dressing {
    random: Damage,
}

impl Dressing {
    /// The file of a mesh with one to six faults; `largest` is the largest number of subdivisions of a ball.
    fn file(seed: u64, largest: usize) -> Vec<u8> {
        let mut random = Random::new(seed);
        let mut damage = Damage::new(seed);
        let mesh = match random.below(6) {
            0 => body(&mut random),
            1 => cut_octahedron(&mut random, 30),
            2 => torus(12 + random.below(12), 6 + random.below(10)),
            _ => icosphere(1 + random.below(largest)),
        };
        let mut broken = PolygonSoup::from(&mesh);
        let faults = 1 + damage.below(6);
        damage.break_it(&mut broken, faults);
        Self { random: damage }.dressed(broken)
    }

    fn dressed(mut self, mut soup: PolygonSoup) -> Vec<u8> {
        if self.random.chance(0.5) {
            self.shuffle(&mut soup);
        }
        let place = self.place();
        soup.positions.iter_mut().for_each(|p| *p = place(*p));
        match self.random.below(4) {
            0 => stl(&soup),
            1 => off(&soup),
            2 => obj::polygons(&soup.positions, self.in_quads(&soup.polygons)),
            _ => obj::polygons(&soup.positions, &soup.polygons),
        }
    }

    /// Puts vertices, polygons and their corners in another order.
    fn shuffle(&mut self, soup: &mut PolygonSoup) {
        let order = self.order(soup.positions.len());
        let place = |v: &u32| order[*v as usize] as u32;
        let mut positions = soup.positions.clone();
        soup.positions.iter().zip(&order).for_each(|(p, &at)| positions[at] = *p);
        let order = self.order(soup.polygons.len());
        let mut polygons = soup.polygons.clone();
        for (polygon, at) in soup.polygons.iter().zip(order) {
            polygons[at] = polygon.iter().map(place).collect();
            polygons[at].rotate_left(self.random.below(polygon.len()));
        }
        (soup.positions, soup.polygons) = (positions, polygons);
    }

    fn order(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        (1..n).rev().for_each(|k| order.swap(k, self.random.below(k + 1)));
        order
    }

    /// A random map of places: it scales, sometimes mirrors, and sometimes moves far away.
    fn place(&mut self) -> impl Fn(DVec3) -> DVec3 + use<> {
        let size = [1.0, 1e-6, 1e6, 0.37][self.random.below(4)];
        let mirror = if self.random.chance(0.3) { -1.0 } else { 1.0 };
        let by =
            if self.random.chance(0.3) { 700.0 * size * DVec3::new(1.0, -0.3, 4.0) } else { DVec3::ZERO };
        move |p| size * DVec3::new(mirror * p.x, p.y, p.z) + by
    }

    /// Merges some triangles with a neighbour that follows them in the list, whatever quad that gives.
    fn in_quads(&mut self, triangles: &[Vec<u32>]) -> Vec<Vec<u32>> {
        let mut polygons: Vec<Vec<u32>> = Vec::new();
        for triangle in triangles {
            let quad = polygons.last().and_then(|last| quad(last, triangle));
            match quad.filter(|_| self.random.chance(0.7)) {
                Some(quad) => *polygons.last_mut().unwrap() = quad,
                None => polygons.push(triangle.clone()),
            }
        }
        polygons
    }
}

/// The quad of two triangles that have a common side in opposite directions; `None` for others.
fn quad(one: &[u32], other: &[u32]) -> Option<Vec<u32>> {
    let ([a, b, c], [_, _, _]) = (<[u32; 3]>::try_from(one).ok()?, <[u32; 3]>::try_from(other).ok()?);
    let far = |p: u32, q: u32| (0..3).find(|&k| [other[k], other[(k + 1) % 3]] == [q, p]);
    let sides = [[a, b, c], [b, c, a], [c, a, b]];
    sides.iter().find_map(|&[p, q, r]| Some(vec![p, other[(far(p, q)? + 2) % 3], q, r]))
}

fn off(soup: &PolygonSoup) -> Vec<u8> {
    let mut text = format!("OFF\n{} {} 0\n", soup.positions.len(), soup.polygons.len());
    soup.positions.iter().for_each(|p| text += &format!("{} {} {}\n", p.x, p.y, p.z));
    for polygon in &soup.polygons {
        let corners: Vec<String> = polygon.iter().map(u32::to_string).collect();
        text += &format!("{} {}\n", polygon.len(), corners.join(" "));
    }
    text.into_bytes()
}

/// A binary STL file, with coordinates of 32 bits.
fn stl(soup: &PolygonSoup) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((soup.polygons.len() as u32).to_le_bytes());
    for polygon in &soup.polygons {
        bytes.extend([0; 12]);
        let corners = polygon.iter().flat_map(|&v| soup.positions[v as usize].to_array());
        bytes.extend(corners.flat_map(|x| (x as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn repair(soup: &PolygonSoup, options: &RepairOptions) -> Result<RepairedMesh, RepairRefusal> {
    repaired(soup, options, &mut Silent)
}

/// Checks that a repaired mesh is sound, that its numbers and places are those of the file, and that it is read back from a file of its own
/// as a good mesh.
fn is_good(soup: &PolygonSoup, mesh: &RepairedMesh) {
    is_sound(mesh);
    vertices_are_the_files(soup, &mesh.checked);
    faces_are_the_files(soup, &mesh.checked);
    assert!((0.0..0.46).contains(&mesh.report.cap_share));
    let file = obj::mesh(&mesh.checked.mesh_in_file());
    let again = closed_genus_zero(&io::read_mesh(&file).unwrap()).unwrap();
    assert_eq!(again.mesh.triangles(), mesh.checked.mesh.triangles());
}

/// Checks that vertices with a number of the file are at its place there, bit for bit.
fn vertices_are_the_files(soup: &PolygonSoup, checked: &CheckedMesh) {
    for (v, number) in checked.mesh.vertices().zip(checked.file_from_vertex()) {
        if let Some(&place) = soup.positions.get(number) {
            let there = checked.frame.in_file(checked.mesh.positions()[v]);
            assert!(there.distance(place) <= 1e-12 * place.length(), "{there} {place}");
            assert_eq!(checked.vertex_from_file[number], Some(v));
        }
    }
}

/// Checks that faces with a number of the file have corners of that polygon only.
fn faces_are_the_files(soup: &PolygonSoup, checked: &CheckedMesh) {
    let polygons = soup.polygons.iter().flat_map(|p| std::iter::repeat_n(p, p.len().saturating_sub(2)));
    let of_triangle: Vec<&Vec<u32>> = polygons.collect();
    assert_eq!(of_triangle.len(), checked.file_faces());
    for face in checked.mesh.faces() {
        let number = checked.file_from_face(face);
        assert_eq!(checked.face_from_file(number), Some(face));
        if let Some(polygon) = of_triangle.get(number.index()) {
            assert!(!checked.is_cap(face));
            // Vertices at the same place within rounding may have been joined.
            let size = checked.mesh.area().sqrt();
            let near = |p: DVec3| {
                let away = |v: &u32| checked.frame.on_mesh(soup.positions[*v as usize]).distance(p);
                polygon.iter().any(|v| away(v) < 1e-9 * size)
            };
            assert!(checked.mesh.corners(face).into_iter().all(near));
        }
    }
}

/// The seeds by the outcome of their files: the kind of the refusal, or the way of the repair.
type Outcomes = BTreeMap<&'static str, Vec<u64>>;

fn outcomes(seeds: std::ops::Range<u64>, largest: usize) -> Outcomes {
    let mut outcomes = Outcomes::new();
    for seed in seeds {
        let soup = io::read_mesh(&Dressing::file(seed, largest)).unwrap();
        if soup.polygons.is_empty() {
            continue;
        }
        let found = defects(&soup, &RepairOptions::default(), &mut Silent).unwrap();
        let usual = repair(&soup, &RepairOptions::default());
        let all = repair(&soup, &RepairOptions::everything());
        let outcome = match (&usual, &all) {
            (Ok(mesh), Ok(with_all)) => {
                is_good(&soup, mesh);
                assert_eq!(mesh.checked.mesh.triangles(), with_all.checked.mesh.triangles(), "seed {seed}");
                assert_eq!(mesh.report, with_all.report, "seed {seed}");
                let is_given = mesh.report.fault.is_none();
                assert_eq!(is_given, closed_genus_zero(&soup).is_ok(), "seed {seed}");
                // A mesh whose only fault is turned faces is taken as good, and the faces are turned back.
                let kinds: Vec<DefectKind> = found.groups.iter().map(|group| group.kind).collect();
                assert!(
                    !is_given || [&[][..], &[DefectKind::TurnedPatch]].contains(&&kinds[..]),
                    "seed {seed}: {kinds:?}"
                );
                "repaired"
            }
            (Err(_), Ok(mesh)) => {
                is_good(&soup, mesh);
                "repaired when asked"
            }
            (Err(_), Err(refusal)) => refusal.kind(),
            (Ok(_), Err(refusal)) => panic!("seed {seed}: {refusal}"),
        };
        if usual.is_err() {
            assert!(!found.groups.is_empty(), "seed {seed}: refused, and nothing is shown");
        }
        outcomes.entry(outcome).or_default().push(seed);
    }
    outcomes
}

fn are_closed_or_refused_for_a_reason(outcomes: &Outcomes) {
    let count = |kind: &str| outcomes.get(kind).map_or(0, Vec::len);
    let reasons = ["open_sheet", "not_orientable", "too_many_handles", "nothing_left", "degenerate_faces"];
    // These files have faces without area that cannot be dropped without opening a hole.
    assert!(count("degenerate_faces") <= 2, "{outcomes:?}");
    let closed = count("repaired") + count("repaired when asked");
    let refused: usize = reasons.map(count).iter().sum();
    let others = outcomes.iter().filter(|(kind, _)| !reasons.contains(kind) && !kind.starts_with("repaired"));
    let others: Vec<_> = others.collect();
    assert!(others.is_empty() && refused * 10 < closed, "{refused} of {closed} refused; {others:?}");
    assert!(count("repaired") > closed / 3, "{}", count("repaired"));
}

#[test]
fn a_file_with_several_faults_is_closed_or_refused() {
    are_closed_or_refused_for_a_reason(&outcomes(0..200, 2));
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn a_thousand_files_with_several_faults_are_closed_or_refused() {
    are_closed_or_refused_for_a_reason(&outcomes(200..1200, 4));
}

#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn a_thousand_other_files_with_several_faults_are_closed_or_refused() {
    are_closed_or_refused_for_a_reason(&outcomes(10_000..11_000, 4));
}

#[test]
fn what_is_repaired_does_not_depend_on_the_size() {
    for seed in 0..100 {
        let soup = Damage::new(seed).soup();
        let outcome = |soup: &PolygonSoup| match repair(soup, &RepairOptions::everything()) {
            Ok(mesh) => (mesh.checked.mesh.triangles().raw.to_vec(), mesh.report.sentence()),
            Err(refusal) => (Vec::new(), refusal.to_string()),
        };
        let usual = outcome(&soup);
        for scale in [-40, -20, 20, 40].map(|k| 2.0_f64.powi(k)) {
            let mut other = soup.clone();
            other.positions.iter_mut().for_each(|p| *p *= scale);
            assert_eq!(outcome(&other), usual, "seed {seed}, {scale}");
        }
    }
}
