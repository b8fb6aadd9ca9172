//! Tests of handles: connected sums of tori in random triangulations, by seed, and a ball with a small handle.

use crate::repair::{is_sound, numbers_are_the_files};
use conemap::job::{Job, JobError, JobFiles, MeshFaults, ReadOptions};
use conemap::landmark_exchange::GivenFile;
use conemap::landmarks::MeshSide;
use conemap::math::random::SplitMix;
use conemap::math::scalar::sin;
use conemap::mesh::generators::{icosphere, torus};
use conemap::mesh::repair::{Change, Handle, Handles, RepairOptions, RepairRefusal, RepairedMesh, repaired};
use conemap::mesh::soup::PolygonSoup;
use conemap::mesh::{FaceId, SurfaceMesh};
use conemap::monitor::{Cancelled, Monitor, Silent, Step};
use conemap::pipeline::{PipelineOptions, Warning};
use glam::DVec3;
use rustc_hash::FxHashSet;
use std::f64::consts::PI;

fn cut(soup: &PolygonSoup) -> Result<RepairedMesh, RepairRefusal> {
    repaired(soup, &RepairOptions { handles: Handles::Cut, ..RepairOptions::default() }, &mut Silent)
}

/// The handles that the refusal of a soup lists.
fn refused(soup: &PolygonSoup) -> Vec<Handle> {
    match repaired(soup, &RepairOptions::default(), &mut Silent) {
        Err(RepairRefusal::Handles(handles)) => handles,
        other => panic!("{other:?}"),
    }
}

/// The handles that were cut.
fn handles(mesh: &RepairedMesh) -> &[Handle] {
    let found = mesh.report.changes.iter().find_map(|change| match change {
        Change::CutHandles { handles, .. } => Some(&handles.first[..]),
        _ => None,
    });
    found.unwrap_or_default()
}

/// Random changes of a surface that keep its genus.
struct Shapes(SplitMix);

impl Shapes {
    fn below(&mut self, n: usize) -> usize {
        ((self.0.unit() * n as f64) as usize).min(n - 1)
    }

    /// A torus with vertices moved at random.
    fn torus(&mut self) -> PolygonSoup {
        let mut soup = PolygonSoup::from(&torus(4 + self.below(9), 4 + self.below(9)));
        let scale = 0.3 + 2.0 * self.0.unit();
        for p in &mut soup.positions {
            *p = scale * (*p + 0.1 * DVec3::from_array([0; 3].map(|_| self.0.unit() - 0.5)));
        }
        soup
    }

    /// The connected sum: removes a triangle of each surface and merges their corners.
    fn sum(&mut self, one: &PolygonSoup, other: &PolygonSoup) -> PolygonSoup {
        let (mut sum, mut other) = (one.clone(), other.clone());
        let [k, l] = [&sum, &other].map(|soup| soup.polygons.len()).map(|n| self.below(n));
        let (mine, its) = (sum.polygons.swap_remove(k), other.polygons.swap_remove(l));
        let first = sum.positions.len() as u32;
        let apart = 10.0 * DVec3::X * f64::from(first) / 100.0;
        sum.positions.extend(other.positions.iter().map(|p| *p + apart));
        let glued = |v: u32| match its.iter().position(|&w| w == v) {
            Some(k) => mine[[0, 2, 1][k]],
            None => v + first,
        };
        sum.polygons.extend(other.polygons.iter().map(|p| p.iter().map(|&v| glued(v)).collect::<Vec<_>>()));
        sum
    }

    /// Divides random faces at points inside them.
    fn divide(&mut self, soup: &mut PolygonSoup) {
        for _ in 0..self.below(40) {
            let f = self.below(soup.polygons.len());
            let [a, b, c] = soup.polygons[f][..] else { panic!() };
            let v = soup.positions.len() as u32;
            let middle = [a, b, c].iter().map(|&v| soup.positions[v as usize]).sum::<DVec3>() / 3.0;
            soup.positions.push(middle);
            soup.polygons[f] = vec![a, b, v];
            soup.polygons.extend([vec![b, c, v], vec![c, a, v]]);
        }
    }

    /// Numbers vertices and faces anew, and turns some of these.
    fn shuffle(&mut self, soup: &mut PolygonSoup) {
        let mut order: Vec<usize> = (0..soup.positions.len()).collect();
        for k in (1..order.len()).rev() {
            order.swap(k, self.below(k + 1));
        }
        let positions = order.iter().map(|&v| soup.positions[v]).collect();
        let mut number = vec![0_u32; order.len()];
        order.iter().zip(0..).for_each(|(&v, k)| number[v] = k);
        soup.positions = positions;
        soup.polygons.iter_mut().flatten().for_each(|v| *v = number[*v as usize]);
        for k in (1..soup.polygons.len()).rev() {
            let other = self.below(k + 1);
            soup.polygons.swap(k, other);
            if self.0.unit() < 0.2 {
                soup.polygons[k].reverse();
            }
        }
    }

    /// A surface of a genus.
    fn surface(&mut self, genus: usize) -> PolygonSoup {
        let mut sum = self.torus();
        for _ in 1..genus {
            let other = self.torus();
            sum = self.sum(&sum, &other);
        }
        self.divide(&mut sum);
        self.shuffle(&mut sum);
        sum
    }
}

/// The length of a loop over vertices of a soup; checks that its edges exist.
fn loop_length(soup: &PolygonSoup, vertices: &[usize]) -> f64 {
    let edges: FxHashSet<[u32; 2]> = soup
        .polygons
        .iter()
        .flat_map(|p| (0..3).flat_map(|k| [[p[k], p[(k + 1) % 3]], [p[(k + 1) % 3], p[k]]]))
        .collect();
    let step = |k: usize| {
        let [a, b] = [vertices[k], vertices[(k + 1) % vertices.len()]];
        assert!(edges.contains(&[a as u32, b as u32]), "{a}-{b} is no edge");
        soup.positions[a].distance(soup.positions[b])
    };
    (0..vertices.len()).map(step).sum()
}

#[test]
fn sums_of_tori_become_balls_and_nothing_else_changes() {
    for seed in 0..60 {
        let mut shapes = Shapes(SplitMix::new(seed));
        let genus = 1 + seed as usize % 5;
        let given = shapes.surface(genus);
        let told = refused(&given);
        let mesh = cut(&given).unwrap();
        is_sound(&mesh);
        numbers_are_the_files(&given, &mesh.checked);
        let found = handles(&mesh);
        assert_eq!((found.len(), found), (genus, &told[..]), "seed {seed}");

        let (surface, checked) = (&mesh.checked.mesh, &mesh.checked);
        let size = surface.area().sqrt();
        let along = loop_length(&given, &found[0].vertices);
        assert!((along - found[0].loop_length * size).abs() < 1e-9 * along, "seed {seed}");
        // All faces of the file stay, and the others are the walls that close both sides of each cut.
        let is_given = |f: &FaceId| checked.file_from_face(*f).index() < given.polygons.len();
        let (skin, walls): (Vec<_>, Vec<_>) = surface.faces().partition(is_given);
        assert_eq!(skin.len(), given.polygons.len());
        assert!(walls.iter().all(|&f| checked.is_cap(f)));
        assert_eq!(walls.len(), found.iter().map(|handle| handle.faces).sum::<usize>());
        assert!(found.iter().all(|handle| handle.faces % 2 == 0 && handle.vertices.len() == handle.edges));
        let area = |faces: &[FaceId]| faces.iter().map(|&f| surface.face_area(f)).sum::<f64>();
        let share = found.iter().map(|handle| handle.area_share).sum::<f64>();
        assert!((area(&walls) / surface.area() - share).abs() < 1e-9);
        assert!((mesh.report.cap_share - share).abs() < 1e-9, "{} {share}", mesh.report.cap_share);
        // Only the vertices on loops are doubled.
        let on_loops: FxHashSet<usize> = found.iter().flat_map(|h| h.vertices.iter().copied()).collect();
        let unused = 3 * (genus - 1);
        assert_eq!(checked.vertex_from_file.iter().flatten().count(), given.positions.len() - unused);
        let copies = checked.file_from_vertex().into_iter().enumerate();
        for (v, _) in copies.filter(|(_, number)| *number >= given.positions.len()) {
            let v = conemap::mesh::VertexId::from(v);
            let is_on_skin = surface.faces().any(|f| is_given(&f) && surface.triangles()[f].contains(&v));
            let place = surface.positions()[v];
            let is_on_loop = on_loops.iter().any(|&w| given.positions.get(w) == Some(&place));
            assert!(!is_on_skin || is_on_loop, "seed {seed}");
        }
        assert_eq!(cut(&given).unwrap().checked.mesh.triangles(), surface.triangles());
    }
}

#[test]
fn the_loop_around_the_tube_or_the_tunnel_is_the_shorter_one() {
    // With the radii 2 and 1 the circle of the tunnel is as long as that of the tube, and the one with fewer edges is shorter.
    for (around, tube) in [(12, 8), (8, 12)] {
        let given = PolygonSoup::from(&torus(around, tube));
        let mesh = cut(&given).unwrap();
        is_sound(&mesh);
        let [handle] = handles(&mesh) else { panic!("{:?}", mesh.report) };
        let length = handle.loop_length * mesh.checked.mesh.area().sqrt();
        assert_eq!(handle.edges, 8);
        assert!((length - 16.0 * sin(PI / 8.0)).abs() < 1e-12, "{length}");
        assert_eq!(mesh.report.fault.as_ref().map(|fault| fault.kind()), Some("genus"));
        let flat = DVec3::new(1.0, 1.0, 0.0);
        let is_tunnel =
            handle.vertices.iter().all(|&v| ((given.positions[v] * flat).length() - 1.0).abs() < 1e-12);
        assert_eq!(is_tunnel, around == 8);
        let told = mesh.report.sentence();
        assert!(told.starts_with("1 handle was cut and closed ("), "{told}");
    }
}

/// A ball with two faces near each other joined by a bent tube of one ring.
fn ball_with_a_speck_of_a_handle() -> (PolygonSoup, [usize; 6]) {
    let ball: SurfaceMesh = icosphere(4);
    let mut soup = PolygonSoup::from(&ball);
    let one = soup.polygons[0].clone();
    let is_near = |p: &Vec<u32>| {
        let away = soup.positions[p[0] as usize].distance(soup.positions[one[0] as usize]);
        (0.2..0.3).contains(&away)
    };
    let l = soup.polygons.iter().position(is_near).unwrap();
    let other = soup.polygons[l].clone();
    soup.polygons.retain(|p| *p != one && *p != other);
    for k in 0..3 {
        let [a, b] = [one[k], one[(k + 1) % 3]];
        let [c, d] = [other[(3 - k) % 3], other[(5 - k) % 3]];
        soup.polygons.extend([vec![a, b, d], vec![a, d, c]]);
    }
    let corners: Vec<usize> = one.iter().chain(&other).map(|&v| v as usize).collect();
    (soup, corners.try_into().unwrap())
}

#[test]
fn a_small_handle_is_told_with_its_place_and_cut_there() {
    let (given, corners) = ball_with_a_speck_of_a_handle();
    let [told] = &refused(&given)[..] else { panic!() };
    assert!(told.edges == 3 && told.vertices.iter().all(|v| corners.contains(v)), "{told:?}");
    assert!(told.loop_length < 0.1 && told.area_share < 1e-3, "{told:?}");
    let sentence = RepairRefusal::Handles(vec![told.clone()]).to_string();
    let place = format!("1 handle (at vertex {} a loop of 3 edges, ", told.vertices[0]);
    assert!(sentence.contains(&place) && sentence.contains("--cut-handles"), "{sentence}");
    let mesh = cut(&given).unwrap();
    is_sound(&mesh);
    assert_eq!(handles(&mesh)[0].vertices, told.vertices);
}

#[test]
fn a_ball_without_its_handle_is_mapped_and_the_report_says_so() {
    let (given, corners) = ball_with_a_speck_of_a_handle();
    let point = |p: &DVec3| format!("v {} {} {}\n", p.x, p.y, p.z);
    let face = |f: &Vec<u32>| format!("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
    let obj: String = given.positions.iter().map(point).chain(given.polygons.iter().map(face)).collect();
    let bent = |p: &DVec3| *p * DVec3::new(1.0, 1.2, 0.9);
    let ball = icosphere(4);
    let target =
        conemap::export::obj::mesh(&ball.with_positions(ball.positions().iter().map(bent).collect()));
    let vertices = (0..12).filter(|v| !corners.contains(v)).map(|v| format!("[{v}, {v}]"));
    let pairs = format!("{{\"pairs\": [{}]}}", vertices.collect::<Vec<_>>().join(", "));
    let landmarks = [GivenFile { name: "pairs.json", bytes: pairs.as_bytes() }];
    let files = JobFiles { source: obj.as_bytes(), target: &target, landmarks: &landmarks };
    let refused = Job::read(files, ReadOptions::default(), &mut Silent).unwrap_err();
    assert!(matches!(refused, JobError::Repair { side: MeshSide::Source, .. }), "{refused}");
    let stopped = Job::read(files, ReadOptions::default(), &mut Impatient).unwrap_err();
    assert_eq!(stopped.code(), "cancelled");
    let cut = RepairOptions { handles: Handles::Cut, ..RepairOptions::default() };
    let options = ReadOptions { mesh_faults: MeshFaults::Repaired(cut), ..ReadOptions::default() };
    let job = Job::read(files, options, &mut Silent).unwrap();
    let result = job.run(&PipelineOptions::default(), &mut Silent).unwrap();
    let certificate = result.report.certificate.as_ref().unwrap();
    assert!(certificate.bijective && certificate.flipped_triangles == 0);
    let repaired = |w: &Warning| matches!(w, Warning::Repaired { changes, .. } if changes.starts_with("1 handle was cut"));
    assert!(result.report.warnings.iter().any(repaired), "{:?}", result.report.warnings);
    assert!(result.report.distortion.mean < 1.5, "{:?}", result.report.distortion);
}

#[test]
fn open_surfaces_with_handles_are_capped_and_cut() {
    let mut given = PolygonSoup::from(&torus(16, 16));
    given.polygons.drain(40..60);
    let mesh = cut(&given).unwrap();
    is_sound(&mesh);
    numbers_are_the_files(&given, &mesh.checked);
    let kinds: Vec<_> = mesh.report.changes.iter().map(Change::kind).collect();
    assert_eq!(kinds[..2], ["capped_holes", "cut_handles"]);
    let surface = &mesh.checked.mesh;
    let caps = surface.faces().filter(|&f| mesh.checked.is_cap(f));
    let share = caps.map(|f| surface.face_area(f)).sum::<f64>() / surface.area();
    assert!((mesh.report.cap_share - share).abs() < 1e-9, "{} {share}", mesh.report.cap_share);
}

/// A monitor that stops at the first report.
struct Impatient;

impl Monitor for Impatient {
    fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
        Err(Cancelled)
    }
}

#[test]
fn many_handles_are_refused_and_a_search_can_be_stopped() {
    let mut shapes = Shapes(SplitMix::new(1));
    let small = PolygonSoup::from(&torus(4, 4));
    let mut sum = small.clone();
    for _ in 0..64 {
        sum = shapes.sum(&sum, &small);
    }
    let options = RepairOptions { handles: Handles::Cut, ..RepairOptions::default() };
    let refusal = repaired(&sum, &options, &mut Silent).unwrap_err();
    assert_eq!(refusal, RepairRefusal::TooManyHandles { genus: 65, most: 64 });
    let stopped = repaired(&small, &options, &mut Impatient).unwrap_err();
    assert_eq!(stopped, RepairRefusal::Stopped(Cancelled));
}
