//! The certificate of a parametrisation: its arrays handed to [`crate::certificate`].

use super::overlay::base_lines::start;
use super::parametrisation::cone_surface::ConeSurface;
use super::parametrisation::embedding::Parametrised;
use crate::certificate::{self, Certificate, Judged, Prescribed, Start};
use crate::mesh::HalfedgeId;
use typed_index_collections::{TiSlice, TiVec};

/// Checks that a parametrisation is a homeomorphism onto a cone surface, as [`crate::certificate`] describes.
pub fn certify(side: Parametrised<'_>, surface: &ConeSurface) -> Certificate {
    let base = &surface.base.mesh;
    let starts: TiVec<HalfedgeId, Start> = base.halfedges().map(|h| start(side, surface, h)).collect();
    certificate::certify(&judged(side, &starts), &Prescribed { base, lengths: &surface.lengths })
}

/// A parametrisation as plain arrays.
fn judged<'a>(side: Parametrised<'a>, starts: &'a TiSlice<HalfedgeId, Start>) -> Judged<'a> {
    Judged {
        mesh: side.mesh,
        corners: &side.embedding.corners,
        transitions: &side.embedding.transitions,
        landmark_vertices: &side.landmark_vertices.raw,
        starts,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmarks::{LandmarkId, Landmarks};
    use crate::layout::PatchedMesh;
    use crate::layout::{self, LayoutOptions};
    use crate::math::rigid2::Rigid2;
    use crate::mesh::FaceId;
    use crate::mesh::SurfaceMesh;
    use crate::mesh::VertexId;
    use crate::mesh::generators::{midpoint_subdivision, octahedron};
    use crate::monitor::Silent;
    use crate::surface_map::parametrisation::embedding::{Anchor, Embedding};
    use crate::surface_map::parametrisation::initial::{InitialOptions, embed};
    use std::f64::consts::TAU;
    use std::sync::Arc;
    use typed_index_collections::ti_vec;

    /// A sphere of 512 triangles mapped onto the octahedron's cone surface.
    fn example() -> (PatchedMesh, Arc<ConeSurface>, Embedding) {
        let fine = midpoint_subdivision(&midpoint_subdivision(&midpoint_subdivision(&octahedron())));
        let on_sphere = fine.positions().iter().map(|p| p.normalize()).collect();
        let mesh = fine.with_positions(on_sphere);
        let pairs: Vec<_> = (0..6).map(|k| [k, k]).collect();
        let landmarks = Landmarks::from_vertices(&mesh, &mesh, &pairs).unwrap();
        let layout =
            layout::joint([&mesh, &mesh], &landmarks, &LayoutOptions::default(), &mut Silent).unwrap();
        let surface = Arc::new(ConeSurface::of_layout(&layout));
        let (embedding, _) =
            embed(&layout.source, &surface, &InitialOptions::default(), &mut Silent).unwrap();
        (layout.source, surface, embedding)
    }

    /// A vertex of degree 6 without landmarks around it, all its faces in one chart.
    fn inner_vertex(patched: &PatchedMesh, embedding: &Embedding) -> VertexId {
        let mesh = &patched.mesh;
        let is_inner = |&v: &VertexId| {
            let star: Vec<_> = mesh.star(v).collect();
            let plain = |h: HalfedgeId| {
                let ends = [mesh.tail(h), mesh.head(h)];
                embedding.transitions[h] == Rigid2::IDENTITY
                    && !ends.iter().any(|v| patched.landmark_vertices.contains(v))
            };
            star.len() == 6 && star.into_iter().all(plain)
        };
        mesh.vertices().find(is_inner).unwrap()
    }

    #[test]
    fn a_valid_parametrisation_is_certified() {
        let (patched, surface, embedding) = example();
        let certificate = certify(patched.parametrised(&embedding), &surface);
        assert!(certificate.bijective, "{certificate:?}");
        assert!(certificate.max_angle_sum_error < 1e-9 && certificate.max_transition_error < 1e-9);
    }

    #[test]
    fn a_flipped_triangle_is_refused() {
        let (patched, surface, mut embedding) = example();
        let v = inner_vertex(&patched, &embedding);
        let h = patched.mesh.outgoing(v);
        // Beyond the edge across: the triangle between turns over, all copies of the vertex agree.
        let across = 0.5 * (embedding.corners[h.next()] + embedding.corners[h.prev()]);
        let moved = 1.5 * across - 0.5 * embedding.corners[h];
        patched.mesh.star(v).for_each(|h| embedding.corners[h] = moved);
        let certificate = certify(patched.parametrised(&embedding), &surface);
        assert!(!certificate.bijective && certificate.flipped_triangles > 0, "{certificate:?}");
        assert!(certificate.max_transition_error < 1e-9, "{certificate:?}");
    }

    #[test]
    fn a_vertex_one_ulp_across_an_edge_is_refused() {
        let (patched, surface, mut embedding) = example();
        let v = inner_vertex(&patched, &embedding);
        let h = patched.mesh.outgoing(v);
        let (begin, [a, b]) =
            (embedding.corners[h], [embedding.corners[h.next()], embedding.corners[h.prev()]]);
        let mut certificate_at = |place: glam::DVec2| {
            patched.mesh.star(v).for_each(|h| embedding.corners[h] = place);
            certify(patched.parametrised(&embedding), &surface)
        };
        // The vertex goes towards the edge across until no number lies between two places.
        let (mut good, mut bad) = (begin, 0.8 * (a + b) - 0.6 * begin);
        loop {
            let middle = 0.5 * (good + bad);
            if middle == good || middle == bad {
                break;
            }
            if certificate_at(middle).bijective { good = middle } else { bad = middle }
        }
        assert!(good.distance(bad) < 2.0 * f64::EPSILON);
        let before = certificate_at(good);
        assert!(before.bijective && good != begin, "{before}");
        // Its angle in the triangle that turns over is half a turn, and rounding may give it either sign.
        let after = certificate_at(bad);
        assert!(!after.bijective && after.max_transition_error < 1e-9, "{after}");
        assert!(after.flipped_triangles == 1 || after.max_angle_sum_error > 6.0, "{after}");
    }

    #[test]
    fn a_surface_of_another_size_is_refused() {
        let (patched, surface, embedding) = example();
        let side = patched.parametrised(&embedding);
        let base = &surface.base.mesh;
        // Longer lines by shorter directions end where they should.
        let verdict = |scale: f64| {
            let lengths: TiVec<HalfedgeId, f64> = surface.lengths.iter().map(|l| scale * l).collect();
            let scaled = |begin: Start| Start { direction: begin.direction / scale, ..begin };
            let starts: TiVec<HalfedgeId, Start> =
                base.halfedges().map(|h| scaled(start(side, &surface, h))).collect();
            certificate::certify(&judged(side, &starts), &Prescribed { base, lengths: &lengths })
        };
        assert!(verdict(1.0).bijective);
        let twice = verdict(2.0);
        assert!(!twice.bijective && twice.max_direction_error.is_nan(), "{twice:?}");
    }

    #[test]
    fn exchanged_landmarks_are_refused() {
        let (mut patched, surface, embedding) = example();
        patched.landmark_vertices.raw.swap(0, 3);
        let certificate = certify(patched.parametrised(&embedding), &surface);
        assert!(!certificate.bijective && certificate.max_transition_error < 1e-9, "{certificate:?}");
    }

    #[test]
    fn lines_that_start_elsewhere_are_refused() {
        let (patched, surface, embedding) = example();
        // The octahedron looks alike after a turn about an axis: all lines from that landmark arrive at landmarks, but at others.
        let landmark = VertexId(0);
        let fan: Vec<_> = surface.base.mesh.star(landmark).collect();
        let mut turned = embedding.clone();
        let anchor = turned.anchors[LandmarkId(0)];
        let next = surface.base.mesh.twin(fan[0].prev());
        let other = if anchor.chart == fan[0].face() { next.face() } else { fan[0].face() };
        let chart_corner = |f: FaceId| fan.iter().copied().find(|h| h.face() == f).unwrap();
        let [from, onto] = [other, anchor.chart].map(chart_corner);
        let side = |h: HalfedgeId| {
            let chart = surface.charts[h.face()];
            [chart[h.corner()], chart[h.next().corner()]]
        };
        let motion = anchor.motion.after(&Rigid2::between_segments(side(from), side(onto)));
        Arc::make_mut(&mut turned.anchors)[LandmarkId(0)] = Anchor { chart: other, motion, ..anchor };
        let certificate = certify(patched.parametrised(&turned), &surface);
        assert!(!certificate.bijective && certificate.flipped_triangles == 0, "{certificate:?}");
    }

    #[test]
    fn another_cone_surface_is_refused() {
        let (patched, surface, embedding) = example();
        let mut lengths = surface.lengths.clone();
        let h = HalfedgeId(0);
        for h in [h, surface.base.mesh.twin(h)] {
            lengths[h] *= 1.001;
        }
        let other = ConeSurface::from_lengths(surface.base.clone(), lengths);
        let certificate = certify(patched.parametrised(&embedding), &other);
        assert!(!certificate.bijective && certificate.flipped_triangles == 0, "{certificate:?}");
    }

    /// Two sheets, cut along the path of edges p, m, q and glued crosswise: branched over p and q.
    ///
    /// A vertex v of sheet s becomes 2 v + s, but p and q are shared, and on the right of the cut m changes its sheet.
    fn double_cover(mesh: &SurfaceMesh, m: VertexId) -> SurfaceMesh {
        let star: Vec<_> = mesh.star(m).collect();
        let [p, q] = [star[0], star[3]].map(|h| mesh.head(h));
        let mut left = Vec::new();
        let mut h = star[3];
        while mesh.head(h) != p {
            left.push(h.face());
            h = mesh.twin(h.prev());
        }
        let mut faces: TiVec<FaceId, [VertexId; 3]> = TiVec::new();
        for sheet in 0..2 {
            for (f, corners) in mesh.triangles().iter_enumerated() {
                let crosses = !left.contains(&f);
                faces.push(corners.map(|v| {
                    let sheet = match v {
                        v if v == p || v == q => 0,
                        v if v == m && crosses => 1 - sheet,
                        _ => sheet,
                    };
                    VertexId(2 * v.0 + sheet)
                }));
            }
        }
        // The unused second copies of p and q are left out.
        let mut numbers: TiVec<VertexId, Option<VertexId>> = ti_vec![None; 2 * mesh.vertex_count()];
        let mut positions = TiVec::new();
        for v in (0..2 * mesh.vertex_count()).map(VertexId::from) {
            let original = VertexId(v.0 / 2);
            if v.0 % 2 == 0 || (original != p && original != q) {
                numbers[v] = Some(positions.push_and_get_key(mesh.positions()[original]));
            }
        }
        let faces = faces.into_iter().map(|f| f.map(|v| numbers[v].unwrap())).collect();
        SurfaceMesh::from_triangles(positions, faces).unwrap()
    }

    #[test]
    fn a_double_cover_is_refused() {
        let (patched, surface, embedding) = example();
        let cover = double_cover(&patched.mesh, inner_vertex(&patched, &embedding));
        assert_eq!(cover.euler_characteristic(), 2, "the cover is a sphere again");
        let twice = |f: FaceId| FaceId::from(f.index() % patched.mesh.face_count());
        let first_sheet = |landmark: VertexId| {
            let h = patched.mesh.outgoing(landmark);
            cover.tail(h)
        };
        let cover_embedding = Embedding {
            corners: cover
                .halfedges()
                .map(|h| embedding.corners[HalfedgeId::of(twice(h.face()), h.corner())])
                .collect(),
            transitions: Arc::new(
                cover
                    .halfedges()
                    .map(|h| embedding.transitions[HalfedgeId::of(twice(h.face()), h.corner())])
                    .collect(),
            ),
            anchors: embedding.anchors.clone(),
        };
        let cover_patched = PatchedMesh {
            landmark_vertices: patched.landmark_vertices.iter().map(|&v| first_sheet(v)).collect(),
            mesh: cover,
            ..patched
        };
        let certificate = certify(cover_patched.parametrised(&cover_embedding), &surface);
        assert_eq!(certificate.flipped_triangles, 0, "every triangle is positive");
        assert!(certificate.max_transition_error < 1e-9);
        assert!((certificate.max_angle_sum_error - TAU).abs() < 1e-6, "{certificate:?}");
        assert!(!certificate.bijective);
    }
}
