//! Curves of one mesh on the other: polylines whose segments lie in faces, cut where they pass from piece to piece of the overlay.
//!
//! Within a piece the map is affine, so that a straight segment stays straight there. The curve that comes out lies on the image exactly: a
//! cut on a side of a piece is computed from that side's ends, so that it lies on an edge of the other mesh where the side does.

use super::mapped_files::MappedFiles;
use crate::export::curves::{CarriedCurve, CarriedPoint};
use crate::export::vertex_image::Direction;
use crate::io::curve_file::Curve;
use crate::io::landmark_file::LandmarkPoint;
use crate::landmarks::MeshSide;
use crate::map_file::FileMesh;
use crate::mesh::{FaceId, Place, SurfaceMesh, SurfacePoint};
use crate::monitor::{Cancelled, Monitor, Step};
use crate::surface_map::correspondence::{Correspondence, MappedPiece, PiecesByFace};
use glam::DVec2;

/// Why a curve cannot be brought over.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A point of a curve is at fault.
    #[error("curve {} (\"{name}\"), point {}: {problem}", curve + 1, point + 1)]
    Point {
        /// The number of the curve, from 0.
        curve: usize,
        /// The curve's name.
        name: String,
        /// The number of the point, from 0.
        point: usize,
        /// The problem and its remedy.
        problem: String,
    },
}

/// Weights below this count as 0 in given points, since files have rounded digits.
const ZERO_WEIGHT: f64 = 1e-9;

/// A point this near to a side or corner of a piece, in weights of its face, lies on it.
const ON_SIDE: f64 = 1e-11;

/// Parameters along a segment that differ by less are one.
const SAME: f64 = 1e-12;

/// Curves of one file's mesh on the other one's, both in the files' numbers.
///
/// # Errors
/// [`CurveError`] with the first point at fault.
pub fn of_files(
    mapped: MappedFiles<'_>,
    direction: Direction,
    curves: &[Curve],
    monitor: &mut dyn Monitor,
) -> Result<Vec<CarriedCurve>, CurveError> {
    let files = mapped.files;
    let carrier = CurveCarrier::new(mapped.meshes(), mapped.map, direction);
    let [giver, receiver] = [direction.side(), direction.side().other()].map(|side| files[side]);
    let told = |place: &Place| {
        let point = place.surface_point(receiver.mesh());
        CarriedPoint {
            point: receiver.on_file(point),
            position: receiver.in_file(place.position(receiver.mesh())),
        }
    };
    let carried = |(number, curve): (usize, &Curve)| -> Result<CarriedCurve, CurveError> {
        monitor.step(Step { fraction: number as f64 / curves.len() as f64, residual: None })?;
        let fault =
            |(point, problem)| CurveError::Point { curve: number, name: curve.name.clone(), point, problem };
        let place =
            |(k, p): (usize, &LandmarkPoint)| place_of(giver, *p).map_err(|problem| fault((k, problem)));
        let places = curve.points.iter().enumerate().map(place).collect::<Result<Vec<_>, _>>()?;
        let found =
            carrier.carried(Polyline { places: &places, is_closed: curve.is_closed }).map_err(|k| {
                fault((
                k,
                "it lies in no face with the point before it: add the points where the curve crosses edges"
                    .to_owned(),
            ))
            })?;
        Ok(CarriedCurve {
            name: curve.name.clone(),
            is_closed: curve.is_closed,
            points: found.iter().map(told).collect(),
        })
    };
    curves.iter().enumerate().map(carried).collect()
}

/// The place of a point of a file.
fn place_of(file: &FileMesh, point: LandmarkPoint) -> Result<Place, String> {
    match point {
        LandmarkPoint::Vertex(number) => {
            let vertex = file.checked().numbered_vertex(number as usize);
            vertex.map(Place::Vertex).map_err(|none| none.to_string())
        }
        LandmarkPoint::OnFace { face, barycentric } => {
            let faces = file.mesh().face_count();
            if face as usize >= faces {
                return Err(format!("there is no face {face}: the mesh has {faces} faces"));
            }
            if !point.is_sound() {
                return Err(format!("the weights {barycentric:?} are negative or do not sum to 1"));
            }
            let kept = barycentric.map(|w| if w < ZERO_WEIGHT { 0.0 } else { w });
            Ok(Place::of(file.mesh(), file.on_mesh(SurfacePoint::clamped(FaceId(face), kept))))
        }
    }
}

/// A map seen from the mesh that curves are given on.
pub struct CurveCarrier<'a> {
    meshes: [&'a SurfaceMesh; 2],
    map: &'a Correspondence,
    giver: MeshSide,
    pieces: PiecesByFace,
}

/// A part of a straight segment within one piece: where it begins and ends, 0 to 1.
struct Stretch<'a> {
    begin: f64,
    end: f64,
    piece: &'a MappedPiece,
}

/// A curve by its corners on a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Polyline<'a> {
    /// The corners in their order; any two following ones lie in one face.
    pub places: &'a [Place],
    /// Whether the last corner is joined with the first.
    pub is_closed: bool,
}

impl<'a> CurveCarrier<'a> {
    /// The carrier of a map that has passed [`crate::surface_map::correspondence::check`] with the meshes.
    pub fn new(meshes: [&'a SurfaceMesh; 2], map: &'a Correspondence, direction: Direction) -> Self {
        let giver = direction.side();
        let pieces = PiecesByFace::new(map, giver, meshes[giver].face_count());
        Self { meshes, map, giver, pieces }
    }

    /// The image of a polyline, as a polyline of which any two following points lie in one face. A closed one begins and ends at the same
    /// point, which is listed once.
    ///
    /// # Errors
    /// The number of the first point that lies in no face with the point before it.
    pub fn carried(&self, curve: Polyline<'_>) -> Result<Vec<Place>, usize> {
        let Polyline { places: curve, is_closed } = curve;
        let mut image = Vec::new();
        if let [only] = curve {
            let face = only.surface_point(self.meshes[self.giver]).face;
            self.add_segment(face, [*only, *only], &mut image);
        }
        let ends = if is_closed && curve.len() > 1 { curve.len() } else { curve.len().saturating_sub(1) };
        for k in 0..ends {
            let next = (k + 1) % curve.len();
            let segment = [curve[k], curve[next]];
            let face = self.common_face(segment).ok_or(next)?;
            self.add_segment(face, segment, &mut image);
        }
        if is_closed && image.len() > 1 && self.are_one(&image[0], &image[image.len() - 1]) {
            image.pop();
        }
        Ok(image)
    }

    /// The first face that holds both places.
    fn common_face(&self, [a, b]: [Place; 2]) -> Option<FaceId> {
        let mesh = self.meshes[self.giver];
        let holds_b = |face: &FaceId| b.weights_in(mesh, *face).is_some();
        match a {
            Place::Vertex(v) => mesh.star(v).map(|h| h.face()).find(holds_b),
            Place::Edge { halfedge, .. } => {
                [halfedge, mesh.twin(halfedge)].map(|h| h.face()).into_iter().find(holds_b)
            }
            Place::Face(point) => Some(point.face).filter(holds_b),
        }
    }

    /// Adds the image of a straight segment in a face.
    fn add_segment(&self, face: FaceId, segment: [Place; 2], image: &mut Vec<Place>) {
        let mesh = self.meshes[self.giver];
        let weights = segment.map(|place| place.weights_in(mesh, face).unwrap_or([1.0, 0.0, 0.0]));
        let [p, q] = weights.map(|w| DVec2::new(w[1], w[2]));
        let mut ring = Vec::new();
        let mut stretches = Vec::new();
        for &number in self.pieces.of(face) {
            let piece = &self.map.pieces[number as usize];
            self.map.ring(mesh, self.giver, piece, &mut ring);
            if let Some([begin, end]) = clipped(&ring, p, q) {
                stretches.push(Stretch { begin, end, piece });
            }
        }
        for Stretch { begin, end, piece } in cover(stretches) {
            for t in [begin, end] {
                let place = self.image(piece, p + (q - p) * t);
                if image.last().is_none_or(|last| !self.are_one(last, &place)) {
                    image.push(place);
                }
            }
        }
    }

    /// Whether two places are one, but for rounding.
    fn are_one(&self, a: &Place, b: &Place) -> bool {
        let mesh = self.meshes[self.giver.other()];
        if a.key() == b.key() {
            return true;
        }
        let face = a.surface_point(mesh).face;
        let [Some(u), Some(v)] = [a, b].map(|place| place.weights_in(mesh, face)) else { return false };
        (0..3).all(|k| (u[k] - v[k]).abs() < 10.0 * ON_SIDE)
    }

    /// The image of a point of a piece, given by weights 1 and 2 in its face.
    fn image(&self, piece: &MappedPiece, q: DVec2) -> Place {
        let mut rings = [Vec::new(), Vec::new()];
        for side in MeshSide::BOTH {
            self.map.ring(self.meshes[side], side, piece, &mut rings[side]);
        }
        let here = &rings[self.giver];
        let corners = &self.map.corners[piece.corners.clone()];
        let near = |k: &usize| here[*k].distance(q) <= ON_SIDE;
        if let Some(k) = (0..here.len()).find(near) {
            return self.map.vertices[corners[k] as usize][self.giver.other()];
        }
        let (onto, face) = (self.meshes[self.giver.other()], piece.faces[self.giver.other()]);
        for k in 0..here.len() {
            let next = (k + 1) % here.len();
            let (a, along) = (here[k], here[next] - here[k]);
            let share = (q - a).dot(along) / along.length_squared();
            if share > 0.0 && share < 1.0 && (a + along * share).distance(q) <= ON_SIDE {
                let ends = [k, next].map(|c| {
                    self.map.vertices[corners[c] as usize][self.giver.other()].weights_in(onto, face)
                });
                if let [Some(u), Some(v)] = ends {
                    // Where both are 0 the sum is exactly 0: the point stays on the edge.
                    let barycentric = [0, 1, 2].map(|c| u[c] * (1.0 - share) + v[c] * share);
                    return Place::of(onto, SurfacePoint { face, barycentric });
                }
            }
        }
        let matrix = piece.map_from(self.giver);
        let nearest = (0..here.len()).min_by(|&i, &j| here[i].distance(q).total_cmp(&here[j].distance(q)));
        let image = nearest.map_or(DVec2::ZERO, |k| rings[self.giver.other()][k] + matrix * (q - here[k]));
        Place::of(onto, SurfacePoint::clamped(face, [1.0 - image.x - image.y, image.x, image.y]))
    }
}

/// The part of a straight segment p q within a counter-clockwise convex polygon; `None` where it is outside or the polygon has no area.
fn clipped(ring: &[DVec2], p: DVec2, q: DVec2) -> Option<[f64; 2]> {
    let (mut begin, mut end) = (0.0_f64, 1.0_f64);
    let mut is_thick = false;
    for k in 0..ring.len() {
        let (a, along) = (ring[k], ring[(k + 1) % ring.len()] - ring[k]);
        let length = along.length();
        if length == 0.0 {
            continue;
        }
        // Distances to the left of the side, on which the polygon lies.
        let left = |x: DVec2| along.perp_dot(x - a) / length;
        is_thick |= ring.iter().any(|c| left(*c) > ON_SIDE);
        let [from, to] = [left(p), left(q)];
        if from < -ON_SIDE && to < -ON_SIDE {
            return None;
        }
        if from < -ON_SIDE {
            begin = begin.max(from / (from - to));
        } else if to < -ON_SIDE {
            end = end.min(from.max(0.0) / (from.max(0.0) - to));
        }
    }
    (is_thick && begin <= end).then_some([begin, end])
}

/// The stretches that follow each other from 0 to 1, of those that begin at a place the one that goes farthest. Where rounding left
/// a gap the next one begins after it.
fn cover(mut stretches: Vec<Stretch<'_>>) -> Vec<Stretch<'_>> {
    stretches.sort_by(|a, b| a.begin.total_cmp(&b.begin).then(b.end.total_cmp(&a.end)));
    let mut chosen: Vec<Stretch<'_>> = Vec::new();
    let mut best: Option<Stretch<'_>> = None;
    let mut reached = 0.0;
    for stretch in stretches {
        if best.as_ref().is_some_and(|best| stretch.begin > reached + SAME && best.end > reached) {
            reached = best.as_ref().map_or(reached, |best| best.end);
            chosen.extend(best.take());
        }
        let is_farther = best.as_ref().is_none_or(|best| stretch.end > best.end);
        if is_farther && (stretch.end > reached + SAME || chosen.is_empty()) {
            best = Some(Stretch { begin: stretch.begin.max(reached), ..stretch });
        }
    }
    chosen.extend(best);
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::vertex_image::Direction::{SourceToTarget, TargetToSource};
    use crate::mesh::VertexId;
    use crate::transfer::tests::{Mapped, ball_on_egg};

    fn carrier(mapped: &Mapped, direction: Direction) -> CurveCarrier<'_> {
        CurveCarrier::new(mapped.meshes(), &mapped.map, direction)
    }

    fn open(places: &[Place]) -> Polyline<'_> {
        Polyline { places, is_closed: false }
    }

    fn closed(places: &[Place]) -> Polyline<'_> {
        Polyline { places, is_closed: true }
    }

    /// A walk along edges that goes on as straight as they let it.
    fn walk(mesh: &SurfaceMesh, from: VertexId, steps: usize) -> Vec<Place> {
        let mut h = mesh.outgoing(from);
        let mut places = vec![Place::Vertex(from)];
        for _ in 0..steps {
            let v = mesh.head(h);
            places.push(Place::Vertex(v));
            let count = mesh.star(v).count();
            h = mesh.star(v).nth(count / 2).unwrap();
        }
        places
    }

    /// A walk through faces: from the middle of an edge to that of the next, now left and now right.
    fn zigzag(mesh: &SurfaceMesh, steps: usize) -> Vec<Place> {
        let mut h = FaceId(5).halfedges()[0];
        let mut places = Vec::new();
        for k in 0..steps {
            places.push(Place::on_edge(mesh, h, if k % 3 == 0 { 0.5 } else { 0.3 }));
            let inside = SurfacePoint { face: h.face(), barycentric: [0.2, 0.3, 0.5] };
            places.push(Place::Face(inside));
            h = mesh.twin(if k % 2 == 0 { h.next() } else { h.prev() });
        }
        places
    }

    fn length(mesh: &SurfaceMesh, curve: &[Place]) -> f64 {
        curve.windows(2).map(|pair| pair[0].position(mesh).distance(pair[1].position(mesh))).sum()
    }

    /// The distance of a point to a polyline.
    fn distance(mesh: &SurfaceMesh, curve: &[Place], p: glam::DVec3) -> f64 {
        let to_segment = |pair: &[Place]| {
            let [a, b] = [pair[0], pair[1]].map(|place| place.position(mesh));
            let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            p.distance(if t.is_nan() { a } else { a + (b - a) * t })
        };
        curve.windows(2).map(to_segment).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn curves_come_back_as_they_were() {
        let mapped = ball_on_egg();
        for (there, back) in [(SourceToTarget, TargetToSource), (TargetToSource, SourceToTarget)] {
            let [here, other] = [mapped.meshes()[there.side()], mapped.meshes()[back.side()]];
            for curve in [walk(here, VertexId(3), 12), zigzag(here, 20)] {
                let image = carrier(mapped, there).carried(open(&curve)).unwrap();
                // Every segment of the image lies in a face, or it could not be brought back.
                let again = carrier(mapped, back).carried(open(&image)).unwrap();
                assert!(image.len() > curve.len() && again.len() >= image.len());
                for place in &again {
                    assert!(distance(here, &curve, place.position(here)) < 1e-9);
                }
                for place in &curve {
                    assert!(distance(here, &again, place.position(here)) < 1e-9);
                }
                let lengths = [length(here, &again), length(here, &curve)];
                assert!((lengths[0] / lengths[1] - 1.0).abs() < 1e-8, "{lengths:?}");
                assert!(length(other, &image) > 0.5 * lengths[1]);
            }
        }
    }

    #[test]
    fn ends_go_to_the_images_of_the_ends() {
        let mapped = ball_on_egg();
        let curve = walk(&mapped.source, VertexId(11), 9);
        let image = carrier(mapped, SourceToTarget).carried(open(&curve)).unwrap();
        let images = mapped.map.vertex_images(mapped.meshes(), MeshSide::Source);
        for (place, found) in [(curve[0], image[0]), (curve[9], image[image.len() - 1])] {
            let Place::Vertex(v) = place else { panic!("{place:?}") };
            let wanted = images[v].unwrap().position(&mapped.target);
            assert!(found.position(&mapped.target).distance(wanted) < 1e-12);
        }
        let single = carrier(mapped, SourceToTarget).carried(open(&curve[..1])).unwrap();
        assert_eq!(single, image[..1]);
        assert!(carrier(mapped, SourceToTarget).carried(closed(&[])).unwrap().is_empty());
    }

    #[test]
    fn a_closed_curve_closes() {
        let mapped = ball_on_egg();
        let mesh = &mapped.source;
        let ring: Vec<Place> = mesh.star(VertexId(40)).map(|h| Place::Vertex(mesh.head(h))).collect();
        let ring: Vec<Place> = ring.into_iter().rev().collect();
        let image = carrier(mapped, SourceToTarget).carried(closed(&ring)).unwrap();
        let unclosed = carrier(mapped, SourceToTarget).carried(open(&ring)).unwrap();
        assert!(image.len() > unclosed.len());
        assert_ne!(image[0], image[image.len() - 1]);
        let again = carrier(mapped, TargetToSource).carried(closed(&image)).unwrap();
        assert!(ring.iter().all(|p| distance(
            mesh,
            &[again.clone(), vec![again[0]]].concat(),
            p.position(mesh)
        ) < 1e-9));
    }

    #[test]
    fn a_jump_is_told_by_its_point() {
        let mapped = ball_on_egg();
        let mut curve = walk(&mapped.source, VertexId(11), 4);
        curve.remove(2);
        assert_eq!(carrier(mapped, SourceToTarget).carried(open(&curve)), Err(2));
    }

    #[test]
    fn segments_are_clipped() {
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        let part = |p: [f64; 2], q: [f64; 2]| clipped(&square, p.into(), q.into());
        assert_eq!(part([-1.0, 0.5], [3.0, 0.5]), Some([0.25, 0.5]));
        assert_eq!(part([0.2, 0.2], [0.8, 0.4]), Some([0.0, 1.0]));
        assert_eq!(part([-1.0, 2.0], [2.0, 2.0]), None);
        assert_eq!(part([0.0, 0.0], [1.0, 0.0]), Some([0.0, 1.0]), "along a side");
        assert_eq!(clipped(&[DVec2::ZERO, DVec2::X], DVec2::ZERO, DVec2::X), None, "no area");
    }
}
