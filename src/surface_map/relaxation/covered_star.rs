//! The star of one vertex with the triangles of the other side over it: the energy of the map there, as a function of the
//! vertex' place alone.
//!
//! While a vertex moves within its star, the star as a whole is overlapped by the same few triangles of the other mesh:
//! developed into the vertex' plane they share convex polygons with the star's triangles. Where a star bends round a cone, a triangle
//! that passes the cone on one side is developed onto the star's part on the other side as well, where it is not: there only those
//! parts of the triangles count that lie over the star.

use super::clipping::BoxedTriangle;
use super::dent_energy::DentEnergy;
use crate::math::golden::direction;
use crate::math::matrix2::{SymmetricEigen, symmetric_eigen};
use crate::math::rigid2::Rigid2;
use crate::math::scalar::{exp, ln, max, min};
use crate::math::triangle::{jacobian, signed_double_area};
use crate::mesh::face_weights::{FaceWeight, PieceWeight};
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::monitor::{Cancelled, Monitor, Pulse};
use crate::surface_map::overlay::Overlay;
use crate::surface_map::parametrisation::embedding::Parametrised;
use crate::surface_map::parametrisation::embedding::triangle;
use crate::surface_map::parametrisation::rest_triangle::{Corner, FlatTriangle};
use glam::{DMat2, DVec2};
use typed_index_collections::{TiVec, ti_vec};

/// A face of the other mesh that overlaps a face.
#[derive(Clone, Copy)]
pub struct Partner {
    pub face: FaceId,
    /// From the plane of the own face to the partner's.
    pub motion: Rigid2,
}

/// One of both parametrised meshes, with the faces of the other one that overlap each of its faces.
pub struct Sheet<'a> {
    pub side: Parametrised<'a>,
    pub is_landmark: TiVec<VertexId, bool>,
    pub corners: TiVec<HalfedgeId, DVec2>,
    pub partners: TiVec<FaceId, Vec<Partner>>,
}

/// A triangle of a star, in coordinates whose origin is the vertex.
pub struct Ray {
    pub halfedge: HalfedgeId,
    /// From the star's plane to the face's.
    pub motion: Rigid2,
    /// The other two corners, counter-clockwise.
    pub ring: [DVec2; 2],
    /// Gradients of the hat functions in the rest plane, that of the star's vertex first.
    pub hats: [DVec2; 3],
    /// The weight of the face in the energy.
    pub weight: FaceWeight,
}

/// A triangle of the other side over a star.
#[derive(Clone, Copy)]
pub struct Cover {
    pub face: FaceId,
    /// From the star's plane to the face's.
    pub motion: Rigid2,
    /// The whole triangle, or a part of it.
    pub triangle: BoxedTriangle,
    /// From the star's plane to the rest plane.
    pub onto_rest: DMat2,
    /// The weight of the face in the energy.
    pub weight: FaceWeight,
}

/// A vertex with the triangles around it and those over them, in a plane whose origin is the vertex.
pub struct CoveredStar {
    pub rays: Vec<Ray>,
    pub covers: Vec<Cover>,
    /// The place of the vertex in the plane of the first face.
    pub origin: DVec2,
    /// Whether the covers' overlaps with the star add up to its area; else its cost means nothing.
    pub is_covered: bool,
}

/// A better place for the vertex in the middle of a star.
pub struct Improved {
    /// Relative to the origin of the star.
    pub z: DVec2,
    /// Logarithm of the cost there.
    pub log_cost: f64,
}

/// Pieces between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 16384;

/// Both meshes with the overlapping faces of the other one, found from their overlay.
///
/// # Errors
/// [`Cancelled`].
pub fn sheets<'a>(
    sides: [Parametrised<'a>; 2],
    overlay: &Overlay,
    monitor: &mut dyn Monitor,
) -> Result<[Sheet<'a>; 2], Cancelled> {
    let mut sheets = sides.map(|side| {
        let partners = ti_vec![Vec::new(); side.mesh.face_count()];
        let (is_landmark, corners) = (side.landmark_flags(), side.embedding.corners.clone());
        Sheet { side, is_landmark, corners, partners }
    });
    let mut pulse = Pulse::new(monitor, ASKED_EVERY);
    for piece in &overlay.pieces {
        pulse.beat()?;
        let (s, t) = (piece.source_face, piece.target_face);
        sheets[0].partners[s].push(Partner { face: t, motion: piece.motion });
        sheets[1].partners[t].push(Partner { face: s, motion: piece.motion.inverse() });
    }
    Ok(sheets)
}

impl Sheet<'_> {
    /// The number of overlaps that one cost of a vertex' star takes, at most: each of its triangles with each triangle of the other mesh.
    pub fn overlaps(&self, v: VertexId) -> usize {
        let (mut faces, mut partners) = (0, 0);
        for h in self.side.mesh.star(v) {
            faces += 1;
            partners += self.partners[h.face()].len();
        }
        faces * partners
    }

    /// A face with its rest shape.
    fn rest(&self, f: FaceId) -> FlatTriangle {
        FlatTriangle::with_rest(self.triangle(f).map(Corner::Fixed), self.side.mesh.corners(f))
    }

    /// The corners of a face in its plane.
    pub fn triangle(&self, f: FaceId) -> [DVec2; 3] {
        triangle(&self.corners, f)
    }

    /// The Jacobian from a face's rest plane to its plane.
    pub fn jacobian(&self, f: FaceId) -> DMat2 {
        self.rest(f).jacobian_at(DVec2::ZERO)
    }
}

impl Cover {
    /// Whether this is the whole of a face with these corners in the star's plane.
    fn is(&self, face: FaceId, corners: [DVec2; 3]) -> bool {
        // Two ways to the same triangle differ by rounding, two different ways around a cone by far more.
        let size = corners[0].distance(corners[1]);
        self.face == face && self.triangle.corners[0].distance(corners[0]) < 1e-6 * size
    }
}

/// Directions, and distances each half as large as the one before, of the places that are looked at. Chosen by hand.
const LOOKS: [usize; 2] = [24, 16];

impl CoveredStar {
    /// The star of a free vertex.
    pub fn around(own: &Sheet<'_>, other: &Sheet<'_>, v: VertexId) -> Self {
        let mesh = own.side.mesh;
        let origin = own.corners[mesh.outgoing(v)];
        let mut star = Self { rays: Vec::new(), covers: Vec::new(), origin, is_covered: false };
        let mut motion = Rigid2::IDENTITY;
        for h in mesh.star(v) {
            let (f, back) = (h.face(), motion.inverse());
            let hats = own.rest(f).hats;
            let k = h.corner();
            star.rays.push(Ray {
                halfedge: h,
                motion,
                ring: [h.next(), h.prev()].map(|h| back.apply(own.corners[h]) - origin),
                hats: [hats[k], hats[(k + 1) % 3], hats[(k + 2) % 3]],
                weight: own.side.weights.of(f),
            });
            for partner in &own.partners[f] {
                star.cover(other, partner.face, partner.motion.after(&motion));
            }
            motion = own.side.embedding.transitions[h.prev()].after(&motion);
        }
        star.is_covered = star.covers_add_up();
        if !star.is_covered {
            star.cut_covers(own, other);
            star.is_covered = star.covers_add_up();
        }
        star
    }

    /// The corners of a triangle of the other side in the star's plane.
    fn developed(&self, other: &Sheet<'_>, face: FaceId, motion: Rigid2) -> [DVec2; 3] {
        let back = motion.inverse();
        other.triangle(face).map(|p| back.apply(p) - self.origin)
    }

    /// Adds a triangle of the other side, unless it is there.
    fn cover(&mut self, other: &Sheet<'_>, face: FaceId, motion: Rigid2) {
        let corners = self.developed(other, face, motion);
        if self.covers.iter().any(|cover| cover.is(face, corners)) {
            return;
        }
        let rest = other.jacobian(face).inverse();
        let onto_rest = rest * motion.turn();
        let weight = other.side.weights.of(face);
        self.covers.push(Cover { face, motion, triangle: BoxedTriangle::new(corners), onto_rest, weight });
    }

    /// Keeps of each cover the parts that lie over those triangles of the star that it overlaps on the surface.
    pub fn cut_covers(&mut self, own: &Sheet<'_>, other: &Sheet<'_>) {
        let mut parts = Vec::new();
        for ray in &self.rays {
            let triangle = BoxedTriangle::new([DVec2::ZERO, ray.ring[0], ray.ring[1]]);
            for partner in &own.partners[ray.halfedge.face()] {
                let corners = self.developed(other, partner.face, partner.motion.after(&ray.motion));
                if let Some(&whole) = self.covers.iter().find(|cover| cover.is(partner.face, corners)) {
                    let shared = triangle.shared_triangles(&whole.triangle);
                    parts.extend(shared.into_iter().map(|triangle| Cover { triangle, ..whole }));
                }
            }
        }
        self.covers = parts;
    }

    /// Whether the covers' overlaps with the star add up to its area.
    pub fn covers_add_up(&self) -> bool {
        let (mut area, mut covered) = (0.0, 0.0);
        for ray in &self.rays {
            let [p, q] = ray.ring;
            let own = BoxedTriangle::new([DVec2::ZERO, p, q]);
            area += 0.5 * p.perp_dot(q);
            covered += self.covers.iter().map(|cover| own.overlap(&cover.triangle)).sum::<f64>();
        }
        // Well above the rounding of clipped areas, far below a triangle that is missing.
        (covered - area).abs() < 1e-7 * area
    }

    /// The integral of the dents' energy over the star with its vertex at `z`; `None` where a triangle is not positive.
    pub fn cost(&self, z: DVec2, energy: &DentEnergy) -> Option<f64> {
        self.cost_below(f64::INFINITY, 0, z, energy).ok()
    }

    /// The same where it is less than `bound`, summed from the triangle with number `first` on.
    ///
    /// # Errors
    /// The number of the triangle at which the sum reaches the bound: the sum of a place beside it had better begin there.
    pub(super) fn cost_below(
        &self,
        bound: f64,
        first: usize,
        z: DVec2,
        energy: &DentEnergy,
    ) -> Result<f64, usize> {
        let is_turned = |ray: &Ray| signed_double_area(z, ray.ring[0], ray.ring[1]) <= 0.0;
        if self.rays.iter().any(is_turned) {
            return Err(first);
        }
        let mut cost = 0.0;
        for k in (first..self.rays.len()).chain(0..first) {
            let ray = &self.rays[k];
            let [p, q] = ray.ring;
            let jacobian = jacobian(&[z, p, q], &ray.hats);
            let scale = 1.0 / jacobian.determinant();
            let own = BoxedTriangle::new([z, p, q]);
            for cover in &self.covers {
                let area = own.overlap(&cover.triangle);
                if area > 0.0 {
                    let counted = PieceWeight::of([ray.weight, cover.weight]);
                    // No term is negative.
                    cost += area * scale * energy.density(&(cover.onto_rest * jacobian), counted);
                    if cost >= bound {
                        return Err(k);
                    }
                }
            }
        }
        Ok(cost)
    }

    /// A better place by one step of Newton's method; `least` is the logarithm of the cost at z.
    pub fn improved(&self, z: DVec2, least: f64, energy: &DentEnergy) -> Option<Improved> {
        let at = |z: DVec2| self.cost(z, energy).map(ln);
        let height = |ray: &Ray| {
            let [p, q] = ray.ring;
            signed_double_area(z, p, q) / p.distance(q)
        };
        let room = self.rays.iter().map(height).fold(f64::INFINITY, min);
        // The step of the difference quotients, a thousandth of the way to the nearest side: smaller ones round, larger ones are less exact.
        // A Newton step is at most ten times that way, and is shortened. Chosen by hand.
        let h = 1e-3 * room;
        let [e, w] = [at(z + DVec2::new(h, 0.0))?, at(z - DVec2::new(h, 0.0))?];
        let [n, s] = [at(z + DVec2::new(0.0, h))?, at(z - DVec2::new(0.0, h))?];
        let corner = at(z + DVec2::new(h, h))?;
        let slope = DVec2::new(e - w, n - s) / (2.0 * h);
        let [xx, yy] = [(e + w - 2.0 * least), (n + s - 2.0 * least)].map(|sum| sum / (h * h));
        let xy = (corner - e - n + least) / (h * h);
        let mut step = newton(slope, [xx, xy, yy], 10.0 * room)?;
        // Down to 0.3^5 of the step, about 1/400. Chosen by hand.
        let bound = exp(least);
        for _ in 0..6 {
            if let Ok(cost) = self.cost_below(bound, 0, z + step, energy) {
                return Some(Improved { z: z + step, log_cost: ln(cost) });
            }
            step *= 0.3;
        }
        None
    }

    /// The best of many places around `z`, out to the farthest corner of the star: where several pieces are equally bad the cost has
    /// a crease, along which Newton's method does not find down. `least` is the logarithm of the cost at z; each number of
    /// `looks` has directions of its own.
    pub fn best_seen(&self, z: DVec2, least: f64, looks: usize, energy: &DentEnergy) -> Option<Improved> {
        let reach = self.rays.iter().map(|ray| ray.ring[0].distance(z)).fold(0.0, max);
        let [directions, distances] = LOOKS;
        let mut best = Improved { z, log_cost: least };
        let (mut bound, mut first) = (exp(least), 0);
        for step in looks * directions..(looks + 1) * directions {
            let mut away = direction(step) * reach;
            for _ in 0..distances {
                away *= 0.5;
                match self.cost_below(bound, first, z + away, energy) {
                    Ok(cost) => {
                        best = Improved { z: z + away, log_cost: ln(cost) };
                        bound = cost;
                    }
                    Err(ray) => first = ray,
                }
            }
        }
        (best.log_cost < least).then_some(best)
    }
}

/// Newton's step with the Hessian's eigenvalues made positive, no longer than `longest`.
fn newton(slope: DVec2, [xx, xy, yy]: [f64; 3], longest: f64) -> Option<DVec2> {
    let SymmetricEigen { values, first } = symmetric_eigen([xx, xy, yy]);
    let least = slope.length() / longest;
    let [a, b] = values.map(|value| max(value.abs(), least));
    let step = -(first * (first.dot(slope) / a) + first.perp() * (first.perp().dot(slope) / b));
    step.is_finite().then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bowl_is_left_for_its_bottom_in_one_step() {
        let (bottom, [xx, xy, yy]) = (DVec2::new(0.3, -0.2), [2.0, 0.5, 1.0]);
        let slope = -DVec2::new(xx * bottom.x + xy * bottom.y, xy * bottom.x + yy * bottom.y);
        assert!(newton(slope, [xx, xy, yy], 10.0).unwrap().abs_diff_eq(bottom, 1e-14));
        // Where it bends down, the step goes down still.
        assert!(newton(slope, [-xx, xy, yy], 10.0).unwrap().dot(slope) < 0.0);
    }
}
