//! The patches of a map on one mesh: which one a place lies in, and what is drawn of one that is lit up.

use super::buffers::{SurfaceVertex, Triangles, ribbons};
use super::colours::linear;
use super::defects::{MarkedLineVertex, marked};
use glam::{DVec3, Vec3};
use parry3d_f64::query::PointQueryWithLocation;
use parry3d_f64::shape::TriMesh;
use std::ops::Range;

/// The colour of what is lit up: neither cones nor patterns nor scales have it.
const LIT: u32 = 0xc2_189b;

/// The patches of a map on one mesh, in its coordinates.
pub struct Patches {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// Where the triangles of each patch start, and one past the end.
    starts: Vec<usize>,
    /// Patch lines: the edges of the base domain.
    lines: Vec<Vec<DVec3>>,
    /// A hierarchy over the triangles, made when it is first needed.
    shape: Option<TriMesh>,
}

impl Patches {
    /// Takes triangles of points, where each patch starts among them with one past the end, and patch lines. `None` where the numbers do
    /// not fit each other.
    pub fn new(
        points: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
        starts: Vec<usize>,
        lines: Vec<Vec<DVec3>>,
    ) -> Option<Self> {
        let fits = starts.is_sorted()
            && starts.first() == Some(&0)
            && starts.last() == Some(&triangles.len())
            && triangles.iter().flatten().all(|&v| (v as usize) < points.len());
        fits.then_some(Self { points, triangles, starts, lines, shape: None })
    }

    /// The number of the patch nearest to a point; `None` where there is no patch.
    pub fn nearest(&mut self, point: DVec3) -> Option<usize> {
        if self.shape.is_none() {
            let points = self.points.iter().map(|p| p.to_array().into()).collect();
            self.shape = TriMesh::new(points, self.triangles.clone()).ok();
        }
        let (_, (triangle, _)) =
            self.shape.as_ref()?.project_local_point_and_get_location(point.to_array().into(), false);
        Some(self.starts.partition_point(|&start| start <= triangle as usize).saturating_sub(1))
    }

    /// The surface of a patch in the colour of what is lit up, its points placed by `place`; empty where there is none of that number.
    pub fn lit_surface(&self, patch: usize, place: impl Fn(DVec3) -> Vec3) -> Triangles<SurfaceVertex> {
        let range: Range<usize> = match self.starts.get(patch..patch + 2) {
            Some(&[begin, end]) => begin..end,
            _ => return Triangles::default(),
        };
        let corners = self.triangles[range].iter().flat_map(|triangle| {
            let [p, q, r] = triangle.map(|v| place(self.points[v as usize]));
            let normal = (q - p).cross(r - p).normalize_or(Vec3::Z).to_array();
            [p, q, r].map(|position| SurfaceVertex {
                position: position.to_array(),
                normal,
                image: linear(LIT),
                ..SurfaceVertex::default()
            })
        });
        let vertices: Vec<SurfaceVertex> = corners.collect();
        let indices = (0..vertices.len() as u32).collect();
        Triangles { vertices, indices }
    }

    /// Patch lines as ribbons in that colour, placed likewise. Numbers of lines that are not there are passed over.
    pub fn lit_lines(&self, numbers: &[usize], place: impl Fn(DVec3) -> Vec3) -> Triangles<MarkedLineVertex> {
        let lines = numbers.iter().filter_map(|&k| self.lines.get(k));
        let strips: Vec<Vec<Vec3>> = lines.map(|line| line.iter().map(|&p| place(p)).collect()).collect();
        marked(ribbons(&strips), linear(LIT), 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    /// The ball, its upper and its lower half each a patch.
    fn halves() -> Patches {
        let ball = icosphere(3);
        let points = ball.positions().raw.to_vec();
        let triangles: Vec<[u32; 3]> = ball.triangles().iter().map(|t| t.map(|v| v.0)).collect();
        let height = |t: &[u32; 3]| t.iter().map(|&v| points[v as usize].z).sum::<f64>();
        let (upper, lower): (Vec<_>, Vec<_>) = triangles.iter().partition(|t| height(t) > 0.0);
        let starts = vec![0, upper.len(), triangles.len()];
        let line = vec![DVec3::X, DVec3::Y, -DVec3::X];
        Patches::new(points, [upper, lower].concat(), starts, vec![line]).unwrap()
    }

    #[test]
    fn a_place_is_in_the_patch_that_holds_it() {
        let mut patches = halves();
        for k in 0..40 {
            let way = DVec3::new(f64::from(k % 7) - 3.1, f64::from(k % 11) - 5.2, f64::from(k % 5) - 2.3);
            assert_eq!(patches.nearest(way.normalize()), Some(usize::from(way.z < 0.0)), "{way}");
        }
    }

    #[test]
    fn a_lit_patch_covers_its_half_and_no_more() {
        let patches = halves();
        let area = |Triangles { vertices, indices }: Triangles<SurfaceVertex>| -> f32 {
            let at = |k: u32| Vec3::from_array(vertices[k as usize].position);
            indices.chunks(3).map(|t| 0.5 * (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).length()).sum()
        };
        let [upper, lower] = [0, 1].map(|k| area(patches.lit_surface(k, |p| p.as_vec3())));
        // The ball of 1280 triangles has a little less area than 4 pi.
        assert!((upper + lower - 12.57).abs() < 0.15, "{upper} {lower}");
        assert!((upper - lower).abs() < 0.7);
        assert!(patches.lit_surface(2, |p| p.as_vec3()).vertices.is_empty());
        let line = patches.lit_lines(&[0, 7], |p| p.as_vec3());
        assert_eq!(line.vertices.len(), 8);
    }

    #[test]
    fn numbers_that_do_not_fit_are_refused() {
        let new = |starts: Vec<usize>, corner| {
            Patches::new(vec![DVec3::ZERO; 3], vec![[0, 1, corner]], starts, Vec::new())
        };
        assert!(new(vec![0, 1], 2).is_some());
        assert!(new(vec![0, 1], 3).is_none());
        assert!(new(vec![0, 2], 2).is_none());
        assert!(new(vec![1, 0, 1], 2).is_none());
        assert!(new(Vec::new(), 2).is_none());
    }
}
