//! The checks, and the verdict.

use super::crossings;
use super::directions::{ANGLE_TOLERANCE, Around};
use super::judged::{Judged, Prescribed};
use super::tracer::{Goal, Line, trace};
use crate::math::disjoint_sets::DisjointSets;
use crate::math::predicates::orient2d;
use crate::math::triangle::turn;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use std::f64::consts::TAU;
use std::fmt;
use typed_index_collections::{TiVec, ti_vec};

/// Largest error that is put down to rounding: of an angle sum, in radians, and of a position, in units of sqrt(area). Chosen by hand:
/// a wrong angle sum is off by 2 pi or more.
const TOLERANCE: f64 = 1e-6;

/// Whether a parametrisation is a homeomorphism onto the prescribed cone surface, with the numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certificate {
    /// Whether the parametrisation is a homeomorphism.
    pub bijective: bool,
    /// Triangles that are not positively oriented.
    pub flipped_triangles: usize,
    /// Largest |angle sum - 2 pi| (minus the cone angle at landmarks), in radians.
    pub max_angle_sum_error: f64,
    /// Largest distance, in units of sqrt(area), between an edge's ends seen from one side, carried over by the transition, and from the
    /// other.
    pub max_transition_error: f64,
    /// Largest distance, in units of sqrt(area), of a landmark from the end of a straight base edge that leads to it; infinite where one
    /// misses it, NaN where a triangle or an angle is wrong, so that no line can be followed.
    pub max_landmark_error: f64,
    /// Largest error of an angle between base edges, at their starts or between an arrival and the twin's start, in radians; NaN
    /// as for `max_landmark_error`.
    pub max_direction_error: f64,
    /// Number of crossings of base edges, counted in each triangle.
    pub crossings: usize,
}

impl Certificate {
    /// The certificate of two parametrisations together: counts are added, of errors the larger is taken.
    pub fn and(&self, other: &Self) -> Self {
        Self {
            bijective: self.bijective && other.bijective,
            flipped_triangles: self.flipped_triangles + other.flipped_triangles,
            max_angle_sum_error: nan_max(self.max_angle_sum_error, other.max_angle_sum_error),
            max_transition_error: nan_max(self.max_transition_error, other.max_transition_error),
            max_landmark_error: nan_max(self.max_landmark_error, other.max_landmark_error),
            max_direction_error: nan_max(self.max_direction_error, other.max_direction_error),
            crossings: self.crossings + other.crossings,
        }
    }
}

impl Certificate {
    /// A sentence for each fault, with its numbers.
    fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let mut say = |is_so: bool, fault: String| faults.extend(is_so.then_some(fault));
        // An error that is not a number counts as too large.
        let is_beyond = |error: f64, bound: f64| error.is_nan() || error > bound;
        say(
            self.flipped_triangles > 0,
            format!("{} triangles are flipped or have no area", self.flipped_triangles),
        );
        let [angles, edges] = [self.max_angle_sum_error, self.max_transition_error];
        say(is_beyond(angles, TOLERANCE), format!("the angles around a vertex are off by {angles:.1e} rad"));
        say(is_beyond(edges, TOLERANCE), format!("an edge has two places, {edges:.1e} apart"));
        let [landmarks, directions] = [self.max_landmark_error, self.max_direction_error];
        // Without a flat surface nothing was followed.
        say(landmarks == f64::INFINITY, "a base edge misses its landmark".to_owned());
        say(
            landmarks.is_finite() && landmarks > TOLERANCE,
            format!("a base edge ends {landmarks:.1e} beside its landmark"),
        );
        let is_no_direction = directions.is_nan() && !landmarks.is_nan();
        say(
            is_no_direction || directions > ANGLE_TOLERANCE,
            format!("base edges meet at angles that are off by {directions:.1e} rad"),
        );
        say(self.crossings > 0, format!("base edges cross {} times", self.crossings));
        if faults.is_empty() && !self.bijective {
            faults.push("a mesh is no sphere, or landmarks share a vertex".to_owned());
        }
        faults
    }
}

impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let faults = self.faults();
        f.write_str(if faults.is_empty() { "bijective" } else { "" })?;
        f.write_str(&faults.join(", "))
    }
}

/// Checks a parametrised mesh against its prescribed cone surface.
pub fn certify(judged: &Judged<'_>, prescribed: &Prescribed<'_>) -> Certificate {
    let flipped_triangles = judged.mesh.faces().filter(|&f| !is_positive(judged, f)).count();
    let max_angle_sum_error = angle_sum_error(judged, prescribed);
    let max_transition_error = transition_error(judged);
    let is_flat = flipped_triangles == 0 && nan_max(max_angle_sum_error, max_transition_error) <= TOLERANCE;
    let measured = Certificate {
        flipped_triangles,
        max_angle_sum_error,
        max_transition_error,
        max_landmark_error: f64::NAN,
        max_direction_error: f64::NAN,
        ..Certificate::default()
    };
    // Lines can be followed only on a flat surface.
    if is_flat { with_lines(measured, judged, prescribed) } else { measured }
}

/// Completes the certificate of a flat surface: follows the base edges.
fn with_lines(flat: Certificate, judged: &Judged<'_>, prescribed: &Prescribed<'_>) -> Certificate {
    let base = prescribed.base;
    let around: TiVec<VertexId, Around> =
        base.vertices().map(|l| Around::new(judged, judged.landmark_vertices[l.index()])).collect();
    let start_angle = |h: HalfedgeId| around[base.tail(h)].angle(judged, &judged.starts[h]);
    let between = |h: HalfedgeId| {
        let next = base.twin(h.prev());
        let turned = start_angle(next) - start_angle(h);
        around[base.tail(h)].difference(turned, prescribed.angle(h))
    };
    let mut max_direction_error = base.halfedges().map(between).fold(0.0, nan_max);
    let mut max_landmark_error: f64 = 0.0;
    let mut lines: Vec<Line> = Vec::new();
    for h in base.edges() {
        let vertex = judged.landmark_vertices[base.head(h).index()];
        let goal = Goal { vertex, length: prescribed.lengths[h], tolerance: TOLERANCE };
        let line = trace(judged, &judged.starts[h], &goal);
        match &line.end {
            Some(end) => {
                let around = &around[base.head(h)];
                let arrival = around.angle(judged, &end.back);
                let turned = around.difference(arrival, start_angle(base.twin(h)));
                max_direction_error = nan_max(max_direction_error, turned);
                max_landmark_error = nan_max(max_landmark_error, end.error);
            }
            None => max_landmark_error = f64::INFINITY,
        }
        lines.push(line);
    }
    let crossings = crossings::count(judged, &lines);
    let bijective = [judged.mesh, base].into_iter().all(is_sphere)
        && are_distinct(judged.landmark_vertices)
        && max_landmark_error <= TOLERANCE
        && max_direction_error <= ANGLE_TOLERANCE
        && crossings == 0;
    Certificate { bijective, max_landmark_error, max_direction_error, crossings, ..flat }
}

/// The larger one; NaN wins, so that it is never taken for a small error.
fn nan_max(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// Whether a closed mesh is one sphere: in one part, with the Euler characteristic 2, which a ball beside a torus has, too.
fn is_sphere(mesh: &SurfaceMesh) -> bool {
    let mut parts = DisjointSets::new(mesh.vertex_count());
    let joins = mesh.edges().filter(|&h| parts.join(mesh.tail(h).index(), mesh.head(h).index())).count();
    joins + 1 == mesh.vertex_count() && mesh.euler_characteristic() == 2
}

fn are_distinct(vertices: &[VertexId]) -> bool {
    let mut sorted = vertices.to_vec();
    sorted.sort_unstable();
    sorted.windows(2).all(|pair| pair[0] != pair[1])
}

fn is_positive(judged: &Judged<'_>, f: FaceId) -> bool {
    let [p, q, r] = [0, 1, 2].map(|k| judged.corners[HalfedgeId::of(f, k)]);
    orient2d(p, q, r) > 0.0
}

/// The largest difference, in radians, of the sum of the angles around a vertex from 2 pi, or from the prescribed cone angle at a landmark.
fn angle_sum_error(judged: &Judged<'_>, prescribed: &Prescribed<'_>) -> f64 {
    let mesh = judged.mesh;
    let mut sums: TiVec<VertexId, f64> = ti_vec![0.0; mesh.vertex_count()];
    for h in mesh.halfedges() {
        let [p, q, r] = [h, h.next(), h.prev()].map(|c| judged.corners[c]);
        sums[mesh.tail(h)] += turn(q - p, r - p);
    }
    let mut full = ti_vec![TAU; mesh.vertex_count()];
    for landmark in prescribed.base.vertices() {
        let angles = prescribed.base.star(landmark).map(|h| prescribed.angle(h));
        full[judged.landmark_vertices[landmark.index()]] = angles.sum();
    }
    sums.iter().zip(&full).map(|(sum, full)| (sum - full).abs()).fold(0.0, nan_max)
}

/// The largest distance of an edge's end seen from one side, carried over by its transition, from the same end seen from the other side.
fn transition_error(judged: &Judged<'_>) -> f64 {
    let error = |h: HalfedgeId| {
        let t = judged.mesh.twin(h);
        let motion = &judged.transitions[h];
        let ends = [(h, t.next()), (h.next(), t)];
        let gap = ends.map(|(a, b)| motion.apply(judged.corners[a]).distance(judged.corners[b]));
        nan_max(nan_max(gap[0], gap[1]), (motion.rotation.length() - 1.0).abs())
    };
    judged.mesh.halfedges().map(error).fold(0.0, nan_max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::{octahedron, torus};

    #[test]
    fn a_ball_beside_a_torus_is_no_sphere() {
        let (ball, torus) = (octahedron(), torus(5, 4));
        let shift = ball.vertex_count();
        let shifted = torus.triangles().iter().map(|f| f.map(|v| VertexId::from(v.index() + shift)));
        let both = SurfaceMesh::from_triangles(
            ball.positions().iter().chain(torus.positions()).copied().collect(),
            ball.triangles().iter().copied().chain(shifted).collect(),
        );
        let both = both.unwrap();
        assert_eq!(both.euler_characteristic(), 2);
        assert!(is_sphere(&ball) && !is_sphere(&torus) && !is_sphere(&both));
    }

    #[test]
    fn landmarks_on_one_vertex_are_not_distinct() {
        assert!(are_distinct(&[3, 0, 7].map(VertexId)));
        assert!(!are_distinct(&[3, 0, 7, 3].map(VertexId)));
    }

    #[test]
    fn only_what_is_wrong_is_said() {
        let good = Certificate { bijective: true, ..Certificate::default() };
        assert_eq!(good.to_string(), "bijective");
        let not_followed = Certificate {
            flipped_triangles: 3,
            max_transition_error: 2e-3,
            max_landmark_error: f64::NAN,
            max_direction_error: f64::NAN,
            ..Certificate::default()
        };
        let said = not_followed.to_string();
        assert_eq!(said, "3 triangles are flipped or have no area, an edge has two places, 2.0e-3 apart");
        let missed =
            Certificate { max_landmark_error: f64::INFINITY, crossings: 2, ..Certificate::default() };
        assert_eq!(missed.to_string(), "a base edge misses its landmark, base edges cross 2 times");
        let unmeasured = Certificate { max_angle_sum_error: f64::NAN, ..Certificate::default() };
        assert!(unmeasured.to_string().contains("angles around a vertex"));
        let astray = Certificate { max_direction_error: f64::NAN, ..Certificate::default() };
        assert_eq!(astray.to_string(), "base edges meet at angles that are off by NaN rad");
        assert_eq!(Certificate::default().to_string(), "a mesh is no sphere, or landmarks share a vertex");
    }
}
