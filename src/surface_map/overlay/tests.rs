//! Theorems of the overlay on generated pairs.

use super::location::{Locations, Locator, locate};
use crate::landmarks::Landmarks;
use crate::landmarks::MeshSide;
use crate::layout::{self, BaseLayout, LayoutOptions};
use crate::math::random::SplitMix;
use crate::math::rigid2::Rigid2;
use crate::math::scalar::{cos, sin};
use crate::mesh::generators::{icosphere, midpoint_subdivision, octahedron};
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint};
use crate::monitor::Silent;
use crate::surface_map::measures::queries::PointMap;
use crate::surface_map::overlay::*;
use crate::surface_map::parametrisation::embedding::Anchor;
use crate::surface_map::parametrisation::initial::{self, InitialOptions};
use crate::surface_map::{ConeSurface, Embedding, Parametrised};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Arc;
use typed_index_collections::TiVec;

/// Two meshes on one cone surface.
struct Pair {
    layout: BaseLayout,
    surface: Arc<ConeSurface>,
    embeddings: [Embedding; 2],
}

impl Pair {
    /// The landmarks are the vertices of both meshes nearest to the six ends of the axes.
    fn new(source: &SurfaceMesh, target: &SurfaceMesh, unbent: &SurfaceMesh) -> Self {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
        let pairs: Vec<_> = axes.iter().map(|&p| [nearest(source, p), nearest(unbent, p)]).collect();
        let landmarks = Landmarks::from_vertices(source, target, &pairs).unwrap();
        let options = LayoutOptions::default();
        let layout = layout::joint([source, target], &landmarks, &options, &mut Silent).unwrap();
        let surface = Arc::new(ConeSurface::of_layout(&layout));
        let start = |side| initial::embed(side, &surface, &InitialOptions::default(), &mut Silent).unwrap().0;
        let embeddings = [start(&layout.source), start(&layout.target)];
        Self { layout, surface, embeddings }
    }

    /// A ball and a bent, stretched ball with other connectivity.
    fn bent(levels: [usize; 2], bend: f64) -> Self {
        let (source, ball) = (icosphere(levels[0]), icosphere(levels[1]));
        let bent = |p: &DVec3| {
            DVec3::new(1.6 * p.x, p.y + bend * p.x * p.x, p.z * (1.0 + 0.5 * bend * p.y)) + 0.1 * bend * p.z
        };
        let target = ball.with_positions(ball.positions().iter().map(bent).collect());
        Self::new(&source, &target, &ball)
    }

    fn sides(&self) -> [Parametrised<'_>; 2] {
        [
            self.layout.source.parametrised(&self.embeddings[0]),
            self.layout.target.parametrised(&self.embeddings[1]),
        ]
    }

    fn overlay(&self) -> Overlay {
        self.between(self.sides()).unwrap()
    }

    fn between(&self, [source, target]: [Parametrised<'_>; 2]) -> Result<Overlay, OverlayError> {
        overlay(source, target, &locate(source, target, &self.surface, &mut Silent).unwrap(), &mut Silent)
    }
}

fn nearest(mesh: &SurfaceMesh, p: DVec3) -> u32 {
    let distance = |v: &crate::mesh::VertexId| mesh.positions()[*v].distance(p);
    mesh.vertices().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap().0
}

/// A closed mesh of pieces, by its corners' numbers alone: every edge has one partner, and V - E + F = 2.
fn assert_is_a_sphere(overlay: &Overlay) {
    let mut sides = BTreeMap::new();
    let mut used = vec![false; overlay.vertex_count];
    for piece in &overlay.pieces {
        let ring = &overlay.points[piece.points.clone()];
        for k in 0..ring.len() {
            let (a, b) = (ring[k].vertex, ring[(k + 1) % ring.len()].vertex);
            *sides.entry((a, b, ring[k].edge_of == MeshSide::Source)).or_insert(0) += 1;
            used[a as usize] = true;
        }
    }
    assert!(sides.iter().all(|(&(a, b, side), &n)| n == 1 && sides.get(&(b, a, side)) == Some(&1)));
    assert!(used.iter().all(|u| *u), "every vertex occurs");
    assert_eq!(overlay.vertex_count + overlay.pieces.len(), sides.len() / 2 + 2);
}

fn assert_covers_both(overlay: &Overlay) {
    assert!(overlay.source_area_defect < 1e-9, "{}", overlay.source_area_defect);
    assert!(overlay.target_area_defect < 1e-9, "{}", overlay.target_area_defect);
    assert!(overlay.pieces.iter().all(|p| p.area >= 0.0));
    let total: f64 = overlay.pieces.iter().map(|p| p.area).sum();
    assert!((total - 1.0).abs() < 1e-9, "{total}");
}

/// Areas of the pieces that have one, by their faces.
fn areas(overlay: &Overlay, exchanged: bool) -> Vec<(FaceId, FaceId, f64)> {
    let key = |p: &Piece| {
        let (s, t) = (p.source_face, p.target_face);
        if exchanged { (t, s, p.area) } else { (s, t, p.area) }
    };
    let mut areas: Vec<_> = overlay.pieces.iter().map(key).filter(|p| p.2 > 1e-12).collect();
    areas.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
    areas
}

#[test]
fn pieces_are_a_sphere_and_cover_both_meshes() {
    for levels in [[2, 3], [3, 2], [1, 4]] {
        let overlay = Pair::bent(levels, 0.4).overlay();
        assert_is_a_sphere(&overlay);
        assert_covers_both(&overlay);
    }
}

fn measured([source, target]: [Parametrised<'_>; 2], surface: &ConeSurface) -> Measure {
    let mut measure = Measure::default();
    measure
        .fill([source, target], &locate(source, target, surface, &mut Silent).unwrap(), &mut Silent)
        .unwrap();
    measure
}

#[test]
fn measures_are_those_of_the_whole_overlay() {
    for levels in [[2, 3], [3, 2], [1, 4]] {
        let pair = Pair::bent(levels, 0.4);
        let (overlay, measure) = (pair.overlay(), measured(pair.sides(), &pair.surface));
        assert_eq!(overlay.pieces.len(), measure.pieces().len());
        for (a, b) in overlay.pieces.iter().zip(measure.pieces()) {
            assert_eq!((a.source_face, a.target_face), (b.source_face, b.target_face));
            assert!((a.area - b.area).abs() < 1e-14, "{} {}", a.area, b.area);
            assert!((a.motion.rotation - b.rotation).length() < 1e-13);
        }
    }
}

#[test]
fn segments_cover_every_edge_and_are_the_sides_of_the_pieces() {
    let pair = Pair::bent([2, 3], 0.4);
    let (overlay, measure) = (pair.overlay(), measured(pair.sides(), &pair.surface));
    for side in MeshSide::BOTH {
        let mesh = pair.sides()[side].mesh;
        let face = |piece: u32| {
            let piece = &measure.pieces()[piece as usize];
            [piece.source_face, piece.target_face][side]
        };
        let mut rings: Vec<usize> = vec![0; overlay.pieces.len()];
        let mut lengths: BTreeMap<HalfedgeId, f64> = BTreeMap::new();
        for segment in measure.segments(mesh, side) {
            let h = segment.halfedge;
            assert!(h < mesh.twin(h));
            assert_eq!([segment.left, segment.right].map(face), [h, mesh.twin(h)].map(HalfedgeId::face));
            let along = lengths.entry(h).or_insert(0.0);
            assert_eq!(segment.begin, *along, "each begins where the one before ends");
            assert!(segment.end >= segment.begin);
            *along = segment.end;
            [segment.left, segment.right].into_iter().for_each(|piece| rings[piece as usize] += 1);
        }
        assert_eq!(lengths.len(), mesh.edges().count());
        assert!(lengths.values().all(|&end| end == 1.0));
        for (piece, &sides) in overlay.pieces.iter().zip(&rings) {
            let ring = &overlay.points[piece.points.clone()];
            assert_eq!(ring.iter().filter(|p| p.edge_of == side).count(), sides);
        }
    }
}

#[test]
fn measures_can_be_seen_from_the_other_side() {
    let pair = Pair::bent([2, 3], 0.4);
    let here = measured(pair.sides(), &pair.surface);
    let mut there = here.clone();
    there.exchange_roles();
    for (a, b) in here.pieces().iter().zip(there.pieces()) {
        assert_eq!((a.source_face, a.target_face, a.area), (b.target_face, b.source_face, b.area));
        let identity = crate::math::rigid2::complex_mul(a.rotation, b.rotation);
        assert!((identity - DVec2::X).length() < 1e-14);
    }
    let [source, target] = pair.sides().map(|side| side.mesh);
    assert!(there.segments(source, MeshSide::Target).eq(here.segments(source, MeshSide::Source)));
    assert!(there.segments(target, MeshSide::Source).eq(here.segments(target, MeshSide::Target)));
}

#[test]
fn memory_used_again_leaves_no_trace() {
    let pairs = [Pair::bent([3, 2], 0.4), Pair::bent([1, 4], 0.1), Pair::bent([2, 3], 0.6)];
    let (mut locator, mut locations) = (Locator::default(), Locations::default());
    let (mut overlayer, mut again) = (Overlayer::default(), Overlay::default());
    let mut measure = Measure::default();
    for pair in &pairs {
        locator.fill(pair.sides(), &pair.surface, &mut locations, &mut Silent).unwrap();
        overlayer.fill(pair.sides(), &locations, &mut again, &mut Silent).unwrap();
        measure.fill(pair.sides(), &locations, &mut Silent).unwrap();
        assert_eq!(again.points, pair.overlay().points);
        assert_eq!(measure.pieces(), measured(pair.sides(), &pair.surface).pieces());
    }
}

#[test]
fn coordinates_agree_on_the_cone_surface() {
    let pair = Pair::bent([2, 3], 0.4);
    let overlay = pair.overlay();
    let place = |e: &Embedding, f: FaceId, w: &[f64; 3]| {
        let [a, b, c] = e.triangle(f);
        a * w[0] + b * w[1] + c * w[2]
    };
    for piece in &overlay.pieces {
        for point in &overlay.points[piece.points.clone()] {
            let on_source = place(&pair.embeddings[0], piece.source_face, &point.source);
            let on_target = place(&pair.embeddings[1], piece.target_face, &point.target);
            assert!((piece.motion.apply(on_source) - on_target).length() < 1e-12);
        }
    }
}

#[test]
fn exchanged_meshes_have_the_same_pieces() {
    let pair = Pair::bent([2, 3], 0.4);
    let [source, target] = pair.sides();
    let (there, back) = (pair.overlay(), pair.between([target, source]).unwrap());
    let (there, back) = (areas(&there, false), areas(&back, true));
    assert_eq!(there.len(), back.len());
    for (a, b) in there.iter().zip(&back) {
        assert!((a.0, a.1) == (b.0, b.1) && (a.2 - b.2).abs() < 1e-13, "{a:?} {b:?}");
    }
}

#[test]
fn a_mesh_on_itself_is_the_identity() {
    for mesh in [icosphere(2), midpoint_subdivision(&octahedron())] {
        let pair = Pair::new(&mesh, &mesh, &mesh);
        let [source, _] = pair.sides();
        let overlay = pair.between([source, source]).unwrap();
        assert_is_a_sphere(&overlay);
        assert_covers_both(&overlay);
        let own = overlay.pieces.iter().filter(|p| p.source_face == p.target_face);
        assert!((own.map(|p| p.area).sum::<f64>() - 1.0).abs() < 1e-8);
        let map = PointMap::new(source, source, &overlay);
        let refined = source.mesh;
        for face in refined.faces() {
            let point = SurfacePoint { face, barycentric: [0.2, 0.5, 0.3] };
            let image = map.target_from_source(point);
            assert!(image.position(refined).distance(point.position(refined)) < 1e-9);
        }
    }
}

#[test]
fn landmarks_alone_with_all_edges_shared() {
    let mesh = octahedron();
    let pair = Pair::new(&mesh, &mesh, &mesh);
    let overlay = pair.overlay();
    assert_is_a_sphere(&overlay);
    assert_covers_both(&overlay);
    assert_eq!(areas(&overlay, false).len(), 8);
}

#[test]
fn target_vertices_on_source_edges_that_cannot_move() {
    let (coarse, fine) = (octahedron(), midpoint_subdivision(&midpoint_subdivision(&octahedron())));
    let on_sphere = fine.positions().iter().map(|p| p.normalize()).collect();
    let fine = fine.with_positions(on_sphere);
    let overlay = Pair::new(&coarse, &fine, &fine).overlay();
    assert_is_a_sphere(&overlay);
    assert_covers_both(&overlay);
    let overlay = Pair::new(&fine, &coarse, &coarse).overlay();
    assert_is_a_sphere(&overlay);
    assert_covers_both(&overlay);
}

#[test]
fn a_parametrisation_that_is_not_one_is_refused() {
    let mut pair = Pair::bent([2, 3], 0.4);
    let mesh = &pair.layout.source.mesh;
    let is_free = |v: &crate::mesh::VertexId| !pair.layout.source.landmark_vertices.contains(v);
    let v = mesh.vertices().find(is_free).unwrap();
    let locations = {
        let [source, target] = pair.sides();
        locate(source, target, &pair.surface, &mut Silent).unwrap()
    };
    // Twice as far beyond the edge across as the vertex was on this side: its triangle turns over.
    let h = mesh.outgoing(v);
    let corners = &pair.embeddings[0].corners;
    let shift = (0.5 * (corners[h.next()] + corners[h.prev()]) - corners[h]) * 3.0;
    let mut here = h;
    let mut turned = shift;
    for _ in 0..mesh.star(v).count() {
        pair.embeddings[0].corners[here] += turned;
        turned = pair.embeddings[0].transitions[here.prev()].rotate(turned);
        here = mesh.twin(here.prev());
    }
    let [source, target] = pair.sides();
    assert!(overlay(source, target, &locations, &mut Silent).is_err());
    assert!(Measure::default().fill([source, target], &locations, &mut Silent).is_err());
}

#[test]
fn there_and_back_again() {
    let pair = Pair::bent([2, 3], 0.4);
    let [source, target] = pair.sides();
    let overlay = pair.overlay();
    let map = PointMap::new(source, target, &overlay);
    let meshes = [source, target].map(|side| side.mesh);
    for face in meshes[0].faces() {
        let point = SurfacePoint { face, barycentric: [0.1, 0.2, 0.7] };
        let back = map.source_from_target(map.target_from_source(point));
        assert!(back.position(meshes[0]).distance(point.position(meshes[0])) < 1e-9);
    }
    for face in meshes[1].faces() {
        let point = SurfacePoint { face, barycentric: [0.6, 0.3, 0.1] };
        let there = map.target_from_source(map.source_from_target(point));
        assert!(there.position(meshes[1]).distance(point.position(meshes[1])) < 1e-9);
    }
}

#[cfg(not(target_arch = "wasm32"))]
proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(12))]

    /// Whatever the target's shape and the source's fineness.
    #[test]
    fn any_bend_gives_a_sphere(bend in 0.0_f64..0.7, level in 1_usize..4) {
        let overlay = Pair::bent([level, 2], bend).overlay();
        assert_is_a_sphere(&overlay);
        assert_covers_both(&overlay);
    }
}

/// The same parametrisation with every face's plane turned and moved: other rounding.
fn in_other_planes(mesh: &SurfaceMesh, embedding: &Embedding, seed: u64) -> Embedding {
    let mut random = SplitMix::new(seed);
    let mut motion = || {
        let angle = TAU * random.unit();
        let rotation = DVec2::new(cos(angle), sin(angle));
        Rigid2 { rotation, translation: DVec2::new(random.unit(), random.unit()) }
    };
    let motions: TiVec<FaceId, Rigid2> = mesh.faces().map(|_| motion()).collect();
    let transition = |h: HalfedgeId| {
        let onto = motions[mesh.twin(h).face()];
        onto.after(&embedding.transitions[h]).after(&motions[h.face()].inverse())
    };
    let anchor = |a: &Anchor| Anchor { motion: motions[a.corner.face()].after(&a.motion), ..*a };
    Embedding {
        corners: mesh.halfedges().map(|h| motions[h.face()].apply(embedding.corners[h])).collect(),
        transitions: Arc::new(mesh.halfedges().map(transition).collect()),
        anchors: Arc::new(embedding.anchors.iter().map(anchor).collect()),
    }
}

#[test]
fn edges_between_landmarks_that_coincide_are_told_apart_alike_at_both_ends() {
    let octahedron = octahedron();
    let stretched = octahedron.positions().iter().map(|p| *p * DVec3::new(1.7, 1.1, 0.8)).collect();
    let pair = Pair::new(&octahedron, &octahedron.with_positions(stretched), &octahedron);
    let [source, target] = pair.sides();
    for seed in 1..60 {
        let embeddings = [
            in_other_planes(source.mesh, source.embedding, seed),
            in_other_planes(target.mesh, target.embedding, 1000 + seed),
        ];
        let sides = [
            Parametrised { embedding: &embeddings[0], ..source },
            Parametrised { embedding: &embeddings[1], ..target },
        ];
        let locations = locate(sides[0], sides[1], &pair.surface, &mut Silent).unwrap();
        let overlay = overlay(sides[0], sides[1], &locations, &mut Silent).unwrap();
        assert_is_a_sphere(&overlay);
        assert_covers_both(&overlay);
        assert_eq!(overlay.shifts, 0);
        let pieces = areas(&overlay, false);
        assert_eq!(pieces.len(), octahedron.face_count());
        let mut measure = Measure::default();
        measure.fill(sides, &locations, &mut Silent).unwrap();
        let large = measure.pieces().iter().filter(|piece| piece.area > 1e-12).count();
        assert_eq!(large, octahedron.face_count());
    }
}

/// Rounding puts the images of a landmark a little beside it. A walk that went on beyond the landmark would pass its cone on the wrong side.
#[test]
fn walks_to_a_landmark_end_on_the_side_from_which_they_come() {
    let mut pair = Pair::bent([2, 3], 0.3);
    let source = pair.layout.source.parametrised(&pair.embeddings[0]);
    let at_landmarks: Vec<HalfedgeId> =
        source.landmark_vertices.iter().flat_map(|&v| source.mesh.star(v)).collect();
    for h in at_landmarks {
        let corners = &mut pair.embeddings[0].corners;
        let middle = (corners[h] + corners[h.next()] + corners[h.prev()]) / 3.0;
        let outward = (corners[h] - middle).normalize();
        corners[h] += 1e-11 * outward;
    }
    assert_is_a_sphere(&pair.overlay());
}
