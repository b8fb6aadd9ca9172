//! The whole way on maps that are known: a surface onto a turned, scaled and moved copy of itself.

use super::orientation::Orientation;
use super::untangling::untangle;
use super::*;
use crate::math::rigid3::small_turn;
use crate::mesh::cap_faces::CapFaces;
use crate::mesh::generators::{icosphere, midpoint_subdivision};
use crate::mesh::{FaceId, Place, SurfaceMesh, VertexId};
use crate::monitor::Silent;
use crate::surface_map::correspondence::{Correspondence, MappedPiece};
use glam::{DMat2, DVec3};
use typed_index_collections::TiVec;

/// Vertex i to vertex i.
fn identity(mesh: &SurfaceMesh) -> Correspondence {
    let piece = |f: FaceId| MappedPiece {
        faces: [f; 2],
        corners: 3 * f.index()..3 * f.index() + 3,
        map: DMat2::IDENTITY,
        is_certain: true,
    };
    Correspondence {
        vertices: mesh.vertices().map(|v| [Place::Vertex(v); 2]).collect(),
        pieces: mesh.faces().map(piece).collect(),
        corners: mesh.triangles().iter().flatten().map(|v| v.0).collect(),
    }
}

/// A body with a limb along z.
fn body() -> SurfaceMesh {
    let ball = icosphere(4);
    let stretched = |p: &DVec3| {
        let limb = (8.0 * (p.z - 0.9)).max(0.0);
        *p + DVec3::new(0.0, 0.3 * limb * limb, 2.0 * limb)
    };
    ball.with_positions(ball.positions().iter().map(stretched).collect())
}

/// The same turned by a right angle and a half, scaled and moved.
fn moved(p: DVec3) -> DVec3 {
    let turn = small_turn(DVec3::new(0.3, 1.9, -0.7));
    turn * p * 2.5 + DVec3::new(10.0, -4.0, 1.0)
}

fn of_body(is_gone: impl Fn(DVec3) -> bool) -> (SurfaceMesh, SurfaceMesh, TiVec<FaceId, bool>) {
    let base = body();
    let scan = base.with_positions(base.positions().iter().map(|p| moved(*p)).collect());
    let middle = |f: FaceId| base.corners(f).into_iter().sum::<DVec3>() / 3.0;
    let caps = base.faces().map(|f| is_gone(middle(f))).collect();
    (base, scan, caps)
}

#[test]
fn a_lost_limb_follows_in_the_size_and_direction_of_the_body() {
    // Of the scan the limb is a flat cap: its places tell nothing.
    let (base, mut scan, caps) = of_body(|p| p.z > 1.05);
    let is_inside = |v: VertexId| base.star(v).all(|h| caps[h.face()]);
    let flat = |(v, p): (VertexId, &DVec3)| if is_inside(v) { moved(DVec3::Z * 1.1) } else { *p };
    scan = scan.with_positions(scan.positions().iter_enumerated().map(flat).collect());
    let map = identity(&base);
    let input = WrapInput {
        base: &base,
        scan: &scan,
        map: &map,
        caps: CapFaces { source: None, target: Some(&caps) },
    };
    let laid = wrapped(&input, &mut Silent).unwrap();
    assert!(laid.flipped.is_empty() && laid.report.flipped_triangles == 0);
    assert!(laid.report.extended > 20 && laid.report.covered < 0.99, "{:?}", laid.report);
    let lost = laid.laid.iter().filter(|laid| **laid == Laid::Extended).count();
    assert_eq!((laid.report.extended, laid.report.on_scan), (lost, base.vertex_count() - lost));
    let size = scan.area().sqrt();
    for v in base.vertices() {
        let error = laid.positions[v].distance(moved(base.positions()[v])) / size;
        let allowed = if laid.laid[v] == Laid::OnScan { 2e-3 } else { 0.02 };
        assert!(error < allowed, "{v:?} {error}");
    }
    assert!(laid.report.distance.to_scan.p95 < 1e-3 && laid.report.distance.from_scan.p95 < 1e-3);
    let again = wrapped(&input, &mut Silent).unwrap();
    assert_eq!(laid.positions, again.positions);
}

#[test]
fn a_surface_on_its_own_copy_stays_there_whatever_its_caps() {
    let (base, scan, caps) = of_body(|p| p.x > 0.8);
    let map = identity(&base);
    // The hole is in the base: its cap is no skin, and counts in no measure.
    let input = WrapInput {
        base: &base,
        scan: &scan,
        map: &map,
        caps: CapFaces { source: Some(&caps), target: None },
    };
    let laid = wrapped(&input, &mut Silent).unwrap();
    assert_eq!((laid.report.extended, laid.flipped.len()), (0, 0));
    assert!((laid.report.covered - 1.0).abs() < 1e-12);
    let is_skin = |v: VertexId| base.star(v).any(|h| !caps[h.face()]);
    for v in base.vertices().filter(|&v| is_skin(v)) {
        assert!(laid.positions[v].distance(moved(base.positions()[v])) < 1e-6 * scan.area().sqrt());
    }
    assert!(laid.report.distance.to_scan.max < 1e-6);
}

#[test]
fn nothing_is_laid_where_no_image_is_skin() {
    let (base, scan, caps) = of_body(|_| true);
    let map = identity(&base);
    let input = WrapInput {
        base: &base,
        scan: &scan,
        map: &map,
        caps: CapFaces { source: None, target: Some(&caps) },
    };
    assert_eq!(wrapped(&input, &mut Silent).unwrap_err(), WrapError::NothingOnScan);
}

#[test]
fn flipped_faces_are_found_and_turned_back() {
    let base = midpoint_subdivision(&icosphere(2));
    let map = identity(&base);
    let input = WrapInput { base: &base, scan: &base, map: &map, caps: CapFaces::default() };
    let orientation = Orientation::new(&input);
    let mut positions: TiVec<VertexId, DVec3> = base.positions().iter().copied().collect();
    assert!(orientation.flipped(&base, &positions, |_| true).is_empty());
    // Over the far side of a face beside it.
    let v = VertexId(200);
    let h = base.outgoing(v).next();
    let across = base.positions()[base.tail(h)].midpoint(base.positions()[base.head(h)]);
    positions[v] = positions[v].lerp(across, 2.2);
    let flipped = orientation.flipped(&base, &positions, |_| true);
    assert!(!flipped.is_empty() && flipped.iter().all(|&f| base.triangles()[f].contains(&v)), "{flipped:?}");
    untangle(&base, &orientation, |_| true, &mut positions, &mut Silent).unwrap();
    assert!(orientation.flipped(&base, &positions, |_| true).is_empty());
}

#[test]
fn loose_parts_keep_their_shape_and_follow() {
    let (base, ..) = of_body(|_| false);
    let onto: TiVec<VertexId, DVec3> = base.positions().iter().map(|p| moved(*p)).collect();
    let mut loose = LooseParts::new(&base, &onto);
    let eye: Vec<DVec3> = icosphere(1).positions().iter().map(|p| *p * 0.1 + DVec3::X).collect();
    for part in [&eye[..], &eye[..1]] {
        let found = loose.moved(part);
        assert!(found.iter().zip(part).all(|(found, p)| found.distance(moved(*p)) < 1e-6));
    }
}
