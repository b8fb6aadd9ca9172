//! Shapes between a mesh and another shape of it, in which limbs turn instead of shrinking.
//!
//! On a straight way from place to place a limb that turns by half a turn goes through itself. So it is the deformation gradients of the
//! faces that are followed (Alexa, Cohen-Or & Levin 2000): each is a rotation and a stretch, J = R S; at the time t the face is
//! turned by t times the turn of R and stretched by (1 - t) I + t S. The turns agree from face to face, beyond half a turn too
//! (`face_turns`), and the shape whose gradients are nearest to those of the faces, by area, solves a Poisson system (Xu, Zhang, Wang &
//! Bao 2005). Solved is what it is off the straight way: exactly nothing at both ends. Nothing is said about where the
//! middle is: it goes straight. Winkler, Drieseberg, Alexa & Hormann (2010) mix edge lengths and dihedral angles instead, which needs no
//! rotations but a search of many steps for every moment.
//!
//! A point inside a face lies off the mean of the corners' images. This rest is turned back with the face and grows with t.

use super::face_turns::face_turns;
use super::gradients::{centre, gradients};
use super::poisson::{DeformationError, Poisson, Shape};
use crate::math::bends::KEYS;
use crate::math::rigid3::turned_by;
use crate::mesh::closest_point::closest_in_triangle;
use crate::mesh::{FaceId, SurfaceMesh, VertexId};
use crate::monitor::{Monitor, Portion};
use glam::{DMat3, DVec3};
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// A mesh and another shape of it, and the shapes between.
pub struct Morph<'a> {
    mesh: &'a SurfaceMesh,
    end: &'a TiSlice<VertexId, DVec3>,
    gradients: TiVec<FaceId, DMat3>,
    /// The turn of each face: its direction is the axis, its length the angle in radians.
    turns: TiVec<FaceId, DVec3>,
    poisson: Poisson<'a>,
    areas: TiVec<VertexId, f64>,
}

impl<'a> Morph<'a> {
    /// The way from a mesh to a shape with its connectivity. What both differ by as a whole is part of the way: a shape that stands
    /// elsewhere, or is turned, is better laid on the mesh before ([`crate::math::rigid3::laid_on`]).
    pub fn new(mesh: &'a SurfaceMesh, end: &'a TiSlice<VertexId, DVec3>) -> Self {
        let gradients = gradients(mesh, end);
        let turns = face_turns(mesh, &gradients);
        Self { mesh, end, gradients, turns, poisson: Poisson::new(mesh), areas: mesh.vertex_areas() }
    }

    /// The offsets of the vertices from their straight ways at a time, 0 at the mesh and 1 at the other shape.
    ///
    /// # Errors
    /// [`DeformationError`].
    pub fn bends(&mut self, time: f64, monitor: &mut dyn Monitor) -> Result<Shape, DeformationError> {
        let straight = |gradient: &DMat3| DMat3::IDENTITY * (1.0 - time) + *gradient * time;
        let bent = |(gradient, turn): (&DMat3, &DVec3)| {
            // R^T J is S where the gradient has a rotation; with any other R too this is I at the begin and J at the end.
            let stretch = straight(&(turned_by(-*turn) * *gradient));
            turned_by(*turn * time) * stretch - straight(gradient)
        };
        let wanted: TiVec<FaceId, DMat3> = self.gradients.iter().zip(&self.turns).map(bent).collect();
        let mut bends = self.poisson.displacements(&wanted, DMat3::IDENTITY, monitor)?;
        let middle = centre(&self.areas, &bends);
        bends.iter_mut().for_each(|bend| *bend -= middle);
        Ok(bends)
    }

    /// The shape at a time: the mesh's own at 0, the other one at 1.
    ///
    /// # Errors
    /// [`DeformationError`].
    pub fn shape(&mut self, time: f64, monitor: &mut dyn Monitor) -> Result<Shape, DeformationError> {
        let bends = self.bends(time, monitor)?;
        let ends = self.mesh.positions().iter().zip(self.end);
        Ok(ends.zip(&bends).map(|((p, q), bend)| p.lerp(*q, time) + *bend).collect())
    }

    /// The turns of the vertices over the whole way, whose directions are axes and whose lengths are angles in radians: means of
    /// those of the faces around them, by area.
    pub fn vertex_turns(&self) -> Shape {
        let mut turns: Shape = ti_vec![DVec3::ZERO; self.mesh.vertex_count()];
        for f in self.mesh.faces() {
            let third = self.turns[f] * (self.mesh.face_area(f) / 3.0);
            self.mesh.triangles()[f].into_iter().for_each(|v| turns[v] += third);
        }
        for (turn, area) in turns.iter_mut().zip(&self.areas) {
            *turn = if *area > 0.0 { *turn / *area } else { DVec3::ZERO };
        }
        turns
    }
}

/// Points of a mesh with their places on the other shape.
#[derive(Clone, Copy, Debug)]
pub struct MorphPoints<'a> {
    /// The places of the points on the mesh.
    pub positions: &'a [DVec3],
    /// The places of the points on the other shape.
    pub images: &'a [DVec3],
    /// Triangles of points.
    pub triangles: &'a [[u32; 3]],
    /// The face of the mesh that each triangle lies in.
    pub faces: &'a [FaceId],
}

/// The way of points from a mesh to another shape: a straight line, with offsets from it that [`crate::math::bends`] mixes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Way {
    /// The distance of each point from the straight line at each of the [`KEYS`], as a vector.
    pub bends: Vec<[DVec3; KEYS.len()]>,
    /// The turn of each point's surroundings over the whole way: its direction is the axis, its length the angle in radians.
    pub turns: Vec<DVec3>,
}

/// A point of a face.
#[derive(Clone, Copy)]
struct FacePoint {
    corners: [VertexId; 3],
    weights: [f64; 3],
}

impl FacePoint {
    fn of(self, values: &TiSlice<VertexId, DVec3>) -> DVec3 {
        (0..3).map(|k| values[self.corners[k]] * self.weights[k]).sum()
    }
}

/// The way of points on a mesh whose vertices go to `end`.
///
/// A point of no triangle, or of one whose face the mesh does not have, goes straight.
///
/// # Errors
/// [`DeformationError`].
pub fn way(
    mesh: &SurfaceMesh,
    end: &TiSlice<VertexId, DVec3>,
    points: MorphPoints<'_>,
    monitor: &mut dyn Monitor,
) -> Result<Way, DeformationError> {
    let mut morph = Morph::new(mesh, end);
    let vertex_turns = morph.vertex_turns();
    let places = face_points(mesh, points);
    let turns: Vec<DVec3> =
        places.iter().map(|place| place.map_or(DVec3::ZERO, |place| place.of(&vertex_turns))).collect();
    let mut bends = vec![[DVec3::ZERO; KEYS.len()]; points.positions.len()];
    let share = 1.0 / KEYS.len() as f64;
    for (k, &time) in KEYS.iter().enumerate() {
        let mut part = Portion::new(monitor, k as f64 * share, (k + 1) as f64 * share);
        let vertex_bends = morph.bends(time, &mut part)?;
        for (number, place) in places.iter().enumerate() {
            let Some(place) = place else { continue };
            let rest = points.images[number] - place.of(end);
            let turned = turned_by(turns[number] * (time - 1.0)) * rest;
            bends[number][k] = place.of(&vertex_bends) + (turned - rest) * time;
        }
    }
    Ok(Way { bends, turns })
}

/// Each point as one of the face of some triangle that it is a corner of.
fn face_points(mesh: &SurfaceMesh, points: MorphPoints<'_>) -> Vec<Option<FacePoint>> {
    let mut places: Vec<Option<FacePoint>> = vec![None; points.positions.len()];
    for (triangle, &face) in points.triangles.iter().zip(points.faces) {
        if face.index() >= mesh.face_count() {
            continue;
        }
        for &v in triangle {
            let number = v as usize;
            if let (Some(slot @ None), Some(p)) = (places.get_mut(number), points.positions.get(number)) {
                let weights = closest_in_triangle(*p, mesh.corners(face));
                *slot = Some(FacePoint { corners: mesh.triangles()[face], weights });
            }
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::scalar::{cos, sin};
    use crate::mesh::generators::{icosphere, octahedron};
    use crate::monitor::{Cancelled, Silent, Step};
    use crate::transfer::tests::ball;
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    /// The largest share by which an edge's length differs from the mean of both ends' lengths.
    fn worst_edge(mesh: &SurfaceMesh, end: &Shape, shape: &Shape) -> f64 {
        let off = |h| {
            let ends = [mesh.tail(h), mesh.head(h)];
            let length = |points: &TiSlice<VertexId, DVec3>| points[ends[0]].distance(points[ends[1]]);
            let mean = 0.5 * (length(mesh.positions()) + length(end));
            (length(shape) / mean - 1.0).abs()
        };
        mesh.edges().map(off).fold(0.0, f64::max)
    }

    fn straight(mesh: &SurfaceMesh, end: &Shape, time: f64) -> Shape {
        mesh.positions().iter().zip(end).map(|(p, q)| p.lerp(*q, time)).collect()
    }

    /// A bar along x from 0 to 10 with round ends.
    fn bar() -> SurfaceMesh {
        let ball = ball();
        let round = |p: &DVec3| {
            // By height on the ball, so that rings are as far from each other in the middle as along it.
            let along = 5.0 * (1.0 + p.x);
            let radius = 0.5 * (p.y * p.y + p.z * p.z).sqrt().max(1e-12).sqrt().sqrt();
            let around = DVec3::new(0.0, p.y, p.z).normalize_or_zero() * radius;
            DVec3::new(along, around.y, around.z)
        };
        ball.with_positions(ball.positions().iter().map(round).collect())
    }

    /// The bar bent around z by an angle at its far end, the near end where it was.
    fn bent(bar: &SurfaceMesh, angle: f64) -> Shape {
        let radius = 10.0 / angle;
        let place = |p: &DVec3| {
            let at = angle * p.x / 10.0;
            DVec3::new((radius - p.y) * sin(at), radius - (radius - p.y) * cos(at), p.z)
        };
        bar.positions().iter().map(place).collect()
    }

    #[test]
    fn a_turned_copy_is_turned_on_the_way() {
        let mesh = icosphere(3);
        for angle in [0.3, 2.0, 3.1] {
            let turn = DVec3::new(1.0, -2.0, 0.5).normalize() * angle;
            let end: Shape = mesh.positions().iter().map(|p| turned_by(turn) * *p + DVec3::X).collect();
            let mut morph = Morph::new(&mesh, &end);
            for time in [0.25, 0.5, 0.9] {
                let shape = morph.shape(time, &mut Silent).unwrap();
                assert!(worst_edge(&mesh, &end, &shape) < 1e-9, "{angle} {time}");
                let there = |p: &DVec3| turned_by(turn * time) * *p + DVec3::X * time;
                let off = mesh.positions().iter().zip(&shape).map(|(p, q)| q.distance(there(p)));
                assert!(off.fold(0.0, f64::max) < 1e-8, "{angle} {time}");
            }
        }
    }

    #[test]
    fn both_ends_are_met() {
        let bar = bar();
        let end = bent(&bar, 2.0);
        let mut morph = Morph::new(&bar, &end);
        for (time, there) in [(0.0, bar.positions()), (1.0, &*end)] {
            let shape = morph.shape(time, &mut Silent).unwrap();
            let off = shape.iter().zip(there).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
            assert!(off < 1e-9, "{time}: {off:e}");
        }
    }

    #[test]
    fn a_bar_bends_where_straight_lines_shrink_it() {
        let bar = bar();
        for (angle, least) in [(FRAC_PI_2, 0.25), (PI, 0.9), (1.5 * PI, 0.9)] {
            let end = bent(&bar, angle);
            let shape = Morph::new(&bar, &end).shape(0.5, &mut Silent).unwrap();
            let (on_lines, bends) =
                (worst_edge(&bar, &end, &straight(&bar, &end, 0.5)), worst_edge(&bar, &end, &shape));
            assert!(on_lines > least && bends < 0.05, "{angle}: {on_lines} on straight lines, {bends} bent");
        }
    }

    #[test]
    fn every_point_ends_at_its_image_and_follows_its_face() {
        let bar = bar();
        let end = bent(&bar, PI);
        // Each face's middle, on the far side a little outside of the face's image.
        let corners = |points: &TiSlice<VertexId, DVec3>, f: FaceId| bar.triangles()[f].map(|v| points[v]);
        let middle = |points: &TiSlice<VertexId, DVec3>, f| corners(points, f).iter().sum::<DVec3>() / 3.0;
        let outside = |f| {
            let [p, q, r] = corners(&end, f);
            (q - p).cross(r - p).normalize() * 0.01
        };
        let positions: Vec<DVec3> = bar.faces().map(|f| middle(bar.positions(), f)).collect();
        let images: Vec<DVec3> = bar.faces().map(|f| middle(&end, f) + outside(f)).collect();
        let triangles: Vec<[u32; 3]> = (0..positions.len() as u32).map(|k| [k; 3]).collect();
        let faces: Vec<FaceId> = bar.faces().collect();
        let points =
            MorphPoints { positions: &positions, images: &images, triangles: &triangles, faces: &faces };
        let way = way(&bar, &end, points, &mut Silent).unwrap();
        let mut morph = Morph::new(&bar, &end);
        for (k, time) in KEYS.into_iter().enumerate() {
            let shape = morph.shape(time, &mut Silent).unwrap();
            for f in bar.faces() {
                let number = f.index();
                let place = positions[number].lerp(images[number], time) + way.bends[number][k];
                let rest = place - middle(&shape, f);
                let [p, q, r] = corners(&shape, f);
                let normal = (q - p).cross(r - p).normalize();
                assert!(rest.distance(normal * (0.01 * time)) < 0.003 * time, "{f:?} at {time}: {rest}");
            }
        }
        let turn = way.turns.iter().fold(0.0_f64, |most, turn| most.max(turn.z));
        assert!((turn - PI).abs() < 0.1, "{turn}");
    }

    #[test]
    fn degenerate_triangles_leave_numbers() {
        // Two corners of one face, and the shape of another one, are a point.
        let mesh = octahedron();
        let mut positions = mesh.positions().to_owned();
        let [a, b, c] = mesh.triangles()[FaceId(0)];
        positions[b] = positions[a];
        let thin = mesh.with_positions(positions);
        let mut end: Shape = mesh.positions().iter().map(|p| turned_by(DVec3::Z) * *p).collect();
        end[c] = end[b];
        for (mesh, end) in [(&thin, end.clone()), (&mesh, end), (&thin, ti_vec![DVec3::ZERO; 6])] {
            let shape = Morph::new(mesh, &end).shape(0.5, &mut Silent).unwrap();
            assert!(shape.iter().all(|p| p.is_finite() && p.length() < 10.0), "{shape:?}");
        }
    }

    #[test]
    fn two_runs_agree_bit_for_bit() {
        let bar = bar();
        let end = bent(&bar, TAU);
        let shape = || Morph::new(&bar, &end).shape(0.3, &mut Silent).unwrap();
        assert_eq!(shape(), shape());
    }

    #[test]
    fn it_stops_on_request() {
        struct Stop;
        impl Monitor for Stop {
            fn step(&mut self, _: Step) -> Result<(), Cancelled> {
                Err(Cancelled)
            }
        }
        let mesh = octahedron();
        let stopped = Morph::new(&mesh, mesh.positions()).bends(0.5, &mut Stop);
        assert_eq!(stopped, Err(DeformationError::Cancelled(Cancelled)));
    }
}
