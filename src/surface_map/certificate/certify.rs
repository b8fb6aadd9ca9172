//! The certificate: a parametrisation onto the cone surface is a homeomorphism.
//!
//! Every triangle positively oriented, the angle sum 2 pi at every ordinary vertex and the cone angle at every landmark,
//! the corners' copies joined by rigid transitions, and every side of the base faces followed from landmark to landmark: then
//! the parametrised mesh is the cone surface, and the map a homeomorphism. Positive triangles alone prove nothing (double covers), nor does the total area. Computed from the
//! result alone, independently of the optimiser.

use super::base_lines::base_line;
use crate::math::predicates::orient2d;
use crate::math::scalar::atan2;
use crate::mesh::{HalfedgeId, VertexId};
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::Parametrised;
use glam::DVec2;
use std::f64::consts::TAU;
use typed_index_collections::{TiVec, ti_vec};

/// Largest angle sum error, in radians, and largest position error, in units of sqrt(area), of a homeomorphism.
///
/// A wrong angle sum is off by 2 pi at least, so the bound only has to be above rounding.
const TOLERANCE: f64 = 1e-6;

/// Whether a parametrisation is a homeomorphism, with the numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certificate {
    /// Whether it is.
    pub bijective: bool,
    /// Triangles that are not positively oriented (robust predicate).
    pub flipped_triangles: usize,
    /// Largest |angle sum - 2 pi| (minus the cone angle at landmarks), in radians.
    pub max_angle_sum_error: f64,
    /// Largest distance of a landmark from the end of a straight base side that leads to it; NaN where a triangle or an angle
    /// is wrong, so that nothing can be followed.
    pub max_landmark_error: f64,
    /// Largest distance between an edge seen from one side, carried over by the transition, and from the other.
    pub max_transition_error: f64,
}

impl Certificate {
    /// Both parametrisations together.
    pub fn and(&self, other: &Self) -> Self {
        Self {
            bijective: self.bijective && other.bijective,
            flipped_triangles: self.flipped_triangles + other.flipped_triangles,
            max_angle_sum_error: self.max_angle_sum_error.max(other.max_angle_sum_error),
            max_landmark_error: self.max_landmark_error.max(other.max_landmark_error),
            max_transition_error: self.max_transition_error.max(other.max_transition_error),
        }
    }
}

/// Checks a parametrisation.
pub fn certify(side: Parametrised<'_>, surface: &ConeSurface) -> Certificate {
    let Parametrised { mesh, landmark_vertices, embedding } = side;
    let flipped_triangles = mesh.faces().filter(|&f| !is_positive(embedding.triangle(f))).count();
    let mut sums: TiVec<VertexId, f64> = ti_vec![0.0; mesh.vertex_count()];
    for h in mesh.halfedges() {
        let [p, q, r] = [h, h.next(), h.prev()].map(|c| embedding.corners[c]);
        sums[mesh.tail(h)] += atan2((q - p).perp_dot(r - p), (q - p).dot(r - p));
    }
    let mut full = ti_vec![TAU; mesh.vertex_count()];
    for (landmark, &v) in landmark_vertices.iter_enumerated() {
        full[v] = surface.cone_angles[landmark];
    }
    let errors = sums.iter().zip(&full).map(|(sum, full)| (sum - full).abs());
    let max_angle_sum_error = errors.fold(0.0, nan_max);
    let max_transition_error = transition_error(side);
    let sound = flipped_triangles == 0 && nan_max(max_angle_sum_error, max_transition_error) <= TOLERANCE;
    // Lines can be followed only on a sound surface.
    let max_landmark_error = if sound { landmark_error(side, surface) } else { f64::NAN };
    let bijective = sound && max_landmark_error <= TOLERANCE;
    Certificate {
        bijective,
        flipped_triangles,
        max_angle_sum_error,
        max_landmark_error,
        max_transition_error,
    }
}

/// The larger one; NaN wins, so that it is never taken for a small error.
fn nan_max(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

fn is_positive([p, q, r]: [DVec2; 3]) -> bool {
    orient2d(p, q, r) > 0.0
}

/// How far the sides of the base faces, followed from their landmarks, end from their other landmarks.
fn landmark_error(side: Parametrised<'_>, surface: &ConeSurface) -> f64 {
    surface.base.mesh.halfedges().map(|h| base_line(side, surface, h).end_error).fold(0.0, nan_max)
}

/// How far an edge seen from one side, carried over by its transition, is from the same edge seen from the other.
fn transition_error(side: Parametrised<'_>) -> f64 {
    let Parametrised { mesh, embedding, .. } = side;
    let error = |h: HalfedgeId| {
        let t = mesh.twin(h);
        let motion = &embedding.transitions[h];
        let ends = [(h, t.next()), (h.next(), t)];
        let gap = ends.map(|(a, b)| motion.apply(embedding.corners[a]).distance(embedding.corners[b]));
        nan_max(nan_max(gap[0], gap[1]), (motion.rotation.length() - 1.0).abs())
    };
    mesh.halfedges().map(error).fold(0.0, nan_max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmarks::Landmarks;
    use crate::layout::PatchedMesh;
    use crate::layout::{self, LayoutOptions};
    use crate::math::rigid2::Rigid2;
    use crate::mesh::FaceId;
    use crate::mesh::SurfaceMesh;
    use crate::mesh::generators::{midpoint_subdivision, octahedron};
    use crate::monitor::Silent;
    use crate::surface_map::parametrisation::embedding::Embedding;
    use crate::surface_map::parametrisation::initial::{InitialOptions, embed};
    use std::sync::Arc;

    /// A sphere of 512 triangles mapped onto the octahedron's cone surface.
    fn example() -> (PatchedMesh, Arc<ConeSurface>, Embedding) {
        let fine = midpoint_subdivision(&midpoint_subdivision(&midpoint_subdivision(&octahedron())));
        let on_sphere = fine.positions().iter().map(|p| p.normalize()).collect();
        let mesh = fine.with_positions(on_sphere);
        let pairs: Vec<_> = (0..6).map(|k| [k, k]).collect();
        let landmarks = Landmarks::from_vertices(&mesh, &mesh, &pairs).unwrap();
        let layout =
            layout::joint([&mesh, &mesh], &landmarks, &LayoutOptions::default(), &mut Silent).unwrap();
        let surface = Arc::new(ConeSurface::of_layout(&layout).unwrap());
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
