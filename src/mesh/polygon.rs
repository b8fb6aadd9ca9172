//! Polygons into triangles.
//!
//! A polygon of few corners loses its best-shaped ear again and again. That takes the cube of the corners, so that one of many
//! becomes the constrained Delaunay triangulation of its outline on its mean plane; an outline that is no simple polygon there
//! becomes a fan. Every way gives n - 2 triangles with the polygon's own edges as their border, whatever its shape, so that
//! neighbours meet edge to edge.

use crate::math::random::SplitMix;
use glam::DVec3;
use spade::handles::{DirectedEdgeHandle, FixedVertexHandle};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

type Triangle = [u32; 3];

/// The largest number of corners of a polygon that is cut ear by ear.
const MOST_EARS: usize = 16;

/// Cuts a polygon with at least three corners, numbers into `positions`, into triangles of its orientation.
pub(super) fn triangulate(positions: &[DVec3], polygon: &[u32], triangles: &mut Vec<Triangle>) {
    if polygon.len() <= MOST_EARS {
        return cut_ears(positions, polygon, triangles);
    }
    triangles.extend(delaunay(&Outline::new(positions, polygon)).unwrap_or_else(|| fan(polygon)));
}

/// Twice the area of a polygon as a vector along its normal; `at` gives its corners from some origin.
fn area_vector(corners: usize, at: impl Fn(usize) -> DVec3) -> DVec3 {
    (0..corners).map(|k| at(k).cross(at((k + 1) % corners))).sum()
}

/// Repeatedly the best-shaped ear on the polygon's mean plane.
fn cut_ears(positions: &[DVec3], polygon: &[u32], triangles: &mut Vec<Triangle>) {
    let at = |v: u32| positions[v as usize];
    let mut ring: Vec<u32> = polygon.to_vec();
    let mean = ring.iter().map(|&v| at(v)).sum::<DVec3>() / ring.len() as f64;
    let normal = area_vector(ring.len(), |k| at(ring[k]) - mean);
    while ring.len() > 3 {
        let n = ring.len();
        let quality = |k: usize| {
            let [a, b, c] = [ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]];
            let [p, q, r] = [a, b, c].map(at);
            let cross = (q - p).cross(r - p);
            let longest = p.distance_squared(q).max(q.distance_squared(r)).max(r.distance_squared(p));
            let inside = |v: u32| {
                let x = at(v);
                let left = |u: DVec3, w: DVec3| (w - u).cross(x - u).dot(normal) >= 0.0;
                v != a && v != b && v != c && left(p, q) && left(q, r) && left(r, p)
            };
            if cross.dot(normal) <= 0.0 || ring.iter().any(|&v| inside(v)) {
                0.0
            } else {
                cross.length() / longest
            }
        };
        let qualities: Vec<f64> = (0..n).map(quality).collect();
        let best = (0..n).max_by(|&i, &j| qualities[i].total_cmp(&qualities[j])).unwrap_or(0);
        triangles.push([ring[(best + n - 1) % n], ring[best], ring[(best + 1) % n]]);
        ring.remove(best);
    }
    triangles.push([ring[0], ring[1], ring[2]]);
}

/// Corners of a polygon, each vertex once, on the polygon's mean plane: coordinates from -2 to 2, the polygon counter-clockwise.
struct Outline {
    corners: Vec<Corner>,
    /// The numbers of the corners, in the polygon's order.
    ring: Vec<usize>,
}

/// A corner on the plane.
#[derive(Clone, Copy)]
struct Corner {
    vertex: u32,
    place: Point2<f64>,
}

impl HasPosition for Corner {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.place
    }
}

impl Outline {
    fn new(positions: &[DVec3], polygon: &[u32]) -> Self {
        let at = |v: u32| positions[v as usize];
        let origin = at(polygon[0]);
        let size = polygon.iter().map(|&v| (at(v) - origin).abs().max_element()).fold(0.0, f64::max);
        let scaled = |v: u32| (at(v) - origin) / if size > 0.0 { size } else { 1.0 };
        let mean = polygon.iter().map(|&v| scaled(v)).sum::<DVec3>() / polygon.len() as f64;
        let normal = area_vector(polygon.len(), |k| scaled(polygon[k]) - mean).normalize_or(DVec3::Z);
        let x = normal.any_orthonormal_vector();
        let y = normal.cross(x);
        let place = |v: u32| {
            let p = scaled(v) - mean;
            // Tiny coordinates are beyond the exact predicates.
            let [x, y] = [p.dot(x), p.dot(y)].map(|c| if c.abs() < 1e-30 { 0.0 } else { c });
            Corner { vertex: v, place: Point2::new(x, y) }
        };
        let mut vertices = polygon.to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        let ring = polygon.iter().filter_map(|v| vertices.binary_search(v).ok()).collect();
        Self { corners: vertices.into_iter().map(place).collect(), ring }
    }

    /// The sides, from corner to corner.
    fn sides(&self) -> impl Iterator<Item = [usize; 2]> {
        self.ring.iter().zip(self.ring.iter().cycle().skip(1)).map(|(&a, &b)| [a, b])
    }
}

/// The triangles inside an outline; `None` where it is no simple polygon. One with holes may go to each of them and back on the
/// same line.
fn delaunay(outline: &Outline) -> Option<Vec<Triangle>> {
    let mut sides: Vec<[usize; 2]> = outline.sides().collect();
    sides.sort_unstable();
    if sides.windows(2).any(|pair| pair[0] == pair[1]) || sides.iter().any(|[a, b]| a == b) {
        return None;
    }
    let mut plane = ConstrainedDelaunayTriangulation::<Corner>::bulk_load(outline.corners.clone()).ok()?;
    if plane.num_vertices() != outline.corners.len() {
        return None;
    }
    let mut handles = vec![FixedVertexHandle::from_index(0); outline.corners.len()];
    for vertex in plane.vertices() {
        let corner =
            outline.corners.binary_search_by_key(&vertex.data().vertex, |corner| corner.vertex).ok()?;
        handles[corner] = vertex.fix();
    }
    // In a random order, which takes little time on the mean whatever the outline (Shewchuk & Brown 2015).
    for k in shuffled(sides.len()) {
        let [from, to] = sides[k].map(|corner| handles[corner]);
        if plane.try_add_constraint(from, to).len() != 1 {
            return None;
        }
    }
    inside(&plane, &sides, &handles).filter(|triangles| triangles.len() == outline.ring.len() - 2)
}

/// The triangles that can be reached from the left of the sides without crossing one; `None` where they go on for ever.
fn inside(
    plane: &ConstrainedDelaunayTriangulation<Corner>,
    sides: &[[usize; 2]],
    handles: &[FixedVertexHandle],
) -> Option<Vec<Triangle>> {
    let mut corner_of = vec![0; handles.len()];
    handles.iter().enumerate().for_each(|(corner, handle)| corner_of[handle.index()] = corner);
    let is_side = |edge: &DirectedEdgeHandle<'_, _, _, _, _>| {
        let ends = [edge.from(), edge.to()].map(|vertex| corner_of[vertex.fix().index()]);
        edge.is_constraint_edge() && sides.binary_search(&ends).is_ok()
    };
    let mut is_inside = vec![false; plane.num_all_faces()];
    let mut waiting: Vec<_> = plane.directed_edges().filter(is_side).map(|edge| edge.face()).collect();
    let mut triangles = Vec::new();
    while let Some(face) = waiting.pop() {
        let face = face.as_inner()?;
        if std::mem::replace(&mut is_inside[face.index()], true) {
            continue;
        }
        triangles.push(face.vertices().map(|corner| corner.data().vertex));
        let free = face.adjacent_edges().into_iter().filter(|edge| !edge.is_constraint_edge());
        waiting.extend(free.map(|edge| edge.rev().face()));
    }
    Some(triangles)
}

/// The numbers below `n` in an order that looks random and is always the same.
fn shuffled(n: usize) -> Vec<usize> {
    let mut numbers: Vec<usize> = (0..n).collect();
    let mut random = SplitMix::new(n as u64);
    for k in (1..n).rev() {
        numbers.swap(k, (random.unit() * (k + 1) as f64) as usize);
    }
    numbers
}

/// Triangles around the first corner.
fn fan(polygon: &[u32]) -> Vec<Triangle> {
    polygon[1..].windows(2).map(|pair| [polygon[0], pair[0], pair[1]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the area of triangles of points in the plane, all of them positive; and their edges that are met once.
    fn area_and_border(points: &[DVec3], triangles: &[Triangle]) -> (f64, Vec<[u32; 2]>) {
        let mut area = 0.0;
        let mut edges = std::collections::BTreeSet::new();
        for t in triangles {
            let [p, q, r] = t.map(|v| points[v as usize]);
            let twice = (q - p).cross(r - p).z;
            assert!(twice > 0.0, "{t:?}");
            area += twice;
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                if !edges.remove(&[b, a]) {
                    assert!(edges.insert([a, b]), "{a}-{b} twice");
                }
            }
        }
        (area, edges.into_iter().collect())
    }

    fn triangles(points: &[DVec3], polygon: &[u32]) -> Vec<Triangle> {
        let mut triangles = Vec::new();
        triangulate(points, polygon, &mut triangles);
        triangles
    }

    /// A star with spikes in and out, 0.2 and 1 from the middle.
    fn star(n: u32) -> Vec<DVec3> {
        let angle = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(n);
        let radius = |k: u32| if k.is_multiple_of(2) { 1.0 } else { 0.2 };
        (0..n)
            .map(|k| {
                let (sin, cos) = (crate::math::scalar::sin(angle(k)), crate::math::scalar::cos(angle(k)));
                DVec3::new(radius(k) * cos, radius(k) * sin, 0.0)
            })
            .collect()
    }

    #[test]
    fn a_large_polygon_is_filled_inside() {
        for n in [18, 400, 5000] {
            let points = star(n);
            let polygon: Vec<u32> = (0..n).collect();
            let triangles = triangles(&points, &polygon);
            assert_eq!(triangles.len() as u32, n - 2);
            let (area, border) = area_and_border(&points, &triangles);
            let outline = area_vector(points.len(), |k| points[k]).z;
            assert!((area / outline - 1.0).abs() < 1e-9, "{area} {outline}");
            assert_eq!(border.len() as u32, n);
            assert!(border.iter().all(|[a, b]| (a + 1) % n == *b));
        }
    }

    #[test]
    fn corners_on_straight_sides_stay() {
        // A square with nine more corners on each side.
        let side = |from: DVec3, to: DVec3| (0..10).map(move |k| from.lerp(to, f64::from(k) / 10.0));
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
        let points: Vec<DVec3> = (0..4).flat_map(|k| side(corners[k], corners[(k + 1) % 4])).collect();
        let triangles = triangles(&points, &(0..40).collect::<Vec<_>>());
        let (area, border) = area_and_border(&points, &triangles);
        assert!((area - 2.0).abs() < 1e-12);
        assert_eq!((triangles.len(), border.len()), (38, 40));
    }

    #[test]
    fn a_hole_may_be_reached_by_a_line_there_and_back() {
        let ring = |radius: f64| star(20).into_iter().map(move |p| p.normalize() * radius);
        let points: Vec<DVec3> = ring(2.0).chain(ring(1.0)).collect();
        // Around, over to the hole, around it the other way, and back.
        let polygon: Vec<u32> =
            (0..=20).map(|k| k % 20).chain((20..=40).rev().map(|k| 20 + k % 20)).collect();
        let triangles = triangles(&points, &polygon);
        assert_eq!(triangles.len(), polygon.len() - 2);
        let (area, border) = area_and_border(&points, &triangles);
        let disc = area_vector(20, |k| points[k]).z;
        assert!((area / (0.75 * disc) - 1.0).abs() < 1e-12);
        assert_eq!(border.len(), 40);
    }

    #[test]
    fn what_is_no_simple_polygon_is_still_a_disc() {
        let straight: Vec<DVec3> = (0..30).map(|k| DVec3::X * f64::from(k)).collect();
        let crossed: Vec<DVec3> = (0..31).map(|k| star(31)[(k * 7 % 31) as usize]).collect();
        let one_place = vec![DVec3::ONE; 25];
        let two_vertices: Vec<u32> = (0..40).map(|k| k % 2).collect();
        for (points, polygon) in [
            (&straight, (0..30).collect::<Vec<u32>>()),
            (&crossed, (0..31).collect()),
            (&one_place, (0..25).collect()),
            (&straight, two_vertices),
        ] {
            let triangles = triangles(points, &polygon);
            assert_eq!(triangles.len(), polygon.len() - 2);
            assert!(triangles.iter().flatten().all(|v| polygon.contains(v)));
        }
    }
}
