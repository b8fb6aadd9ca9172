//! The rigid registration of a patch of one surface to another surface.
//!
//! The points of the patch slide over the other surface: only their distances from its tangent planes count (Chen & Medioni
//! 1991), with robust weights. The growth of the misfit when the patch is shifted, with the best rotation for each shift, tells in which
//! directions relief holds the patch. A patch may also bend a little, by a quadric over its own tangent plane.

use crate::math::rigid3::{Rigid3, nearest_rotation, outer, small_turn};
use crate::math::scalar::{max, min};
use crate::mesh::neighbours::Neighbours;
use crate::mesh::normals::vertex_normals;
use crate::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use glam::{DMat3, DVec3};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use typed_index_collections::TiVec;

/// A surface with its unit normals and shape operators.
pub struct OrientedSurface<'a> {
    mesh: &'a SurfaceMesh,
    neighbours: Neighbours,
    /// Unit normals.
    pub normals: TiVec<VertexId, DVec3>,
    paraboloids: TiVec<VertexId, Paraboloid>,
}

/// What the surface is like around a vertex.
struct Paraboloid {
    position: DVec3,
    /// The unit normal.
    normal: DVec3,
    /// In 1 per unit of length: the normal changes by minus this matrix times a step in the tangent plane.
    shape_operator: DMat3,
}

impl Paraboloid {
    /// The foot of a point on it.
    fn foot(&self, p: DVec3) -> Foot {
        let normal = self.normal;
        let away = p - self.position;
        let along = away - normal * away.dot(normal);
        let turn = self.shape_operator * along;
        // Where the normal turns by much within a step, it is an edge and no paraboloid.
        if turn.length_squared() > LARGEST_TURN * LARGEST_TURN {
            return Foot { distance: -away.dot(normal), normal };
        }
        // The height of the paraboloid above the tangent plane is half the second fundamental form; its gradient gives the normal.
        let distance = 0.5 * along.dot(turn) - away.dot(normal);
        Foot { distance, normal: (normal - turn).normalize_or(normal) }
    }
}

impl<'a> OrientedSurface<'a> {
    /// A mesh with smooth normals.
    pub fn new(mesh: &'a SurfaceMesh) -> Self {
        let normals = vertex_normals(mesh);
        let neighbours = Neighbours::new(mesh);
        let paraboloid = |v: VertexId| Paraboloid {
            position: mesh.positions()[v],
            normal: normals[v],
            shape_operator: shape_operator(mesh, &normals, v),
        };
        let paraboloids = mesh.vertices().map(paraboloid).collect();
        Self { mesh, neighbours, normals, paraboloids }
    }

    /// The foot of a point on the surface near a vertex, where the surface is approximated by a paraboloid, so that the triangulation
    /// matters little.
    fn foot(&self, near: VertexId, p: DVec3) -> Foot {
        self.paraboloids[near].foot(p)
    }

    /// How exactly the mesh tells where the surface is: the median distance of a vertex from the paraboloid of its neighbour. Coarse, uneven
    /// and noisy meshes have more of it. The mesh is not empty.
    pub fn roughness(&self) -> f64 {
        let miss =
            |h: HalfedgeId| self.foot(self.mesh.tail(h), self.mesh.positions()[self.mesh.head(h)]).distance;
        let mut misses: Vec<f64> = self.mesh.halfedges().map(|h| miss(h).abs()).collect();
        let middle = misses.len() / 2;
        *misses.select_nth_unstable_by(middle, f64::total_cmp).1
    }

    /// A vertex that is nearer to p than all its neighbours, reached from `from` by going to the nearest neighbour again and again.
    pub fn nearest(&self, from: VertexId, p: DVec3) -> Nearest {
        let distance = |v: VertexId| self.mesh.positions()[v].distance_squared(p);
        let (mut best, mut least) = (from, distance(from));
        loop {
            let v = best;
            let mut next = f64::INFINITY;
            for &w in self.neighbours.of(v) {
                let d = distance(w);
                next = min(next, d);
                if d < least {
                    (best, least) = (w, d);
                }
            }
            if best == v {
                return Nearest { vertex: v, margin: 0.5 * (next.sqrt() - least.sqrt()) };
            }
        }
    }
}

/// The foot of the perpendicular from a point near the surface.
#[derive(Clone, Copy, Debug)]
struct Foot {
    /// The signed distance from the point to the foot along the normal.
    distance: f64,
    /// The unit normal at the foot.
    normal: DVec3,
}

/// Largest turn of the normal, in radians, from a vertex to a point near it for which the surface is a paraboloid; beyond, the tangent
/// plane is taken. Chosen by hand.
const LARGEST_TURN: f64 = 0.5;

/// The shape operator at a vertex: the least-squares fit of minus the changes of the normals towards all neighbours.
fn shape_operator(mesh: &SurfaceMesh, normals: &TiVec<VertexId, DVec3>, v: VertexId) -> DMat3 {
    let normal = normals[v];
    let first = normal.any_orthonormal_vector();
    let second = normal.cross(first);
    // Normal equations of the unknowns a, b, c of the symmetric matrix (a b; b c).
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for w in mesh.star(v).map(|h| mesh.head(h)) {
        let step = mesh.positions()[w] - mesh.positions()[v];
        let change = normal - normals[w];
        let (x, y) = (step.dot(first), step.dot(second));
        // Far neighbours say less about this place.
        let weight = 1.0 / max(x * x + y * y, 1e-30);
        for (row, value) in
            [(Vector3::new(x, y, 0.0), change.dot(first)), (Vector3::new(0.0, x, y), change.dot(second))]
        {
            matrix.syger(weight, &row, &row, 1.0);
            right.axpy(weight * value, &row, 1.0);
        }
    }
    let Some(factor) = matrix.cholesky() else { return DMat3::ZERO };
    let found = factor.solve(&right);
    let mixed = outer(first, second) + outer(second, first);
    outer(first, first) * found.x + mixed * found.y + outer(second, second) * found.z
}

/// A point of a patch, in units of the root of the area.
#[derive(Clone, Copy, Debug)]
pub struct PatchPoint {
    /// Its place.
    pub position: DVec3,
    /// The unit normal at its place.
    pub normal: DVec3,
    /// Its weight; only ratios matter.
    pub weight: f64,
    /// Its image by the present map.
    pub image: DVec3,
    /// The vertex of the other surface nearest to its image.
    pub near: Nearest,
}

/// A vertex that is nearer to a point than all its neighbours.
#[derive(Clone, Copy, Debug)]
pub struct Nearest {
    /// The vertex.
    pub vertex: VertexId,
    /// The distance by which the point may move without coming nearer to a neighbour.
    margin: f64,
}

/// The registration of a patch; lengths in units of the root of the area.
#[derive(Clone, Copy, Debug)]
pub struct PatchFit {
    /// The place of its first point after the registration.
    pub centre: DVec3,
    /// Mean square of the distances from the tangent planes.
    pub misfit: f64,
    /// The matrix H: when the patch is shifted by d, the mean square of the distances grows by d^T H d.
    pub hold: DMat3,
}

/// Options of the registration of a patch; lengths in units of the root of the area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitOptions {
    /// Gauss-Newton steps, at most.
    pub max_steps: usize,
    /// Weight of the squared distance of the patch's centre from its image by the map, relative to the mean square of the
    /// distances from the tangent planes.
    pub damping: f64,
    /// Least knee of the robust weights 1 / (1 + (distance / knee)^2)^2; the knee is 1.5 times the median distance where that
    /// is larger.
    pub noise: f64,
    /// How stiff a patch is that may bend beside its motion: the weight of the squares of its three bends (second derivatives of its height
    /// over its own tangent plane), relative to the mean square of the distances. `None` for rigid patches.
    pub stiffness: Option<f64>,
}

/// The normal equations of one step: their matrix and their right side. The last six unknowns are a turn and a shift about the centre, those
/// before are bends.
struct NormalEquations<const N: usize> {
    matrix: SMatrix<f64, N, N>,
    right: SVector<f64, N>,
    misfit: f64,
}

/// A patch as it is moved.
struct Moved {
    motion: Rigid3,
    bending: Bending,
}

impl Moved {
    fn apply(&self, p: DVec3) -> DVec3 {
        self.motion.apply(self.bending.apply(p))
    }
}

/// How a patch bends: by a quadric over its tangent plane at the centre.
struct Bending {
    centre: DVec3,
    /// Two directions in the tangent plane and the normal.
    frame: [DVec3; 3],
    /// The second derivatives of the height along both directions: first, mixed, second.
    bends: [f64; 3],
}

impl Bending {
    /// No bends.
    fn none(centre: &PatchPoint) -> Self {
        let first = centre.normal.any_orthonormal_vector();
        let frame = [first, centre.normal.cross(first), centre.normal];
        Self { centre: centre.position, frame, bends: [0.0; 3] }
    }

    /// The height of a point for each bend of 1.
    fn heights(&self, p: DVec3) -> [f64; 3] {
        let [x, y] = [0, 1].map(|k| self.frame[k].dot(p - self.centre));
        [0.5 * x * x, x * y, 0.5 * y * y]
    }

    fn apply(&self, p: DVec3) -> DVec3 {
        if self.bends == [0.0; 3] {
            return p;
        }
        let heights = self.heights(p);
        let height: f64 = (0..3).map(|k| self.bends[k] * heights[k]).sum();
        p + self.frame[2] * height
    }
}

/// Added to the diagonal of the normal equations for the turns, where the weights sum to 1: without it they are singular for a flat patch,
/// which any turn about its normal leaves in its plane.
const LEAST_RESISTANCE: f64 = 1e-9;

/// Fits of patches; keeps its working memory from one to the next.
#[derive(Default)]
pub struct Fitter {
    /// Where the nearest vertex of each point was looked for last, and that vertex.
    seen: Vec<(DVec3, Nearest)>,
    distances: Vec<f64>,
    sizes: Vec<f64>,
    normals: Vec<DVec3>,
    arms: Vec<DVec3>,
}

impl Fitter {
    /// Registers a patch to the other surface, starting from the images of its points; the first point is its centre. `None` where
    /// there is no fit.
    pub fn fit(
        &mut self,
        points: &[PatchPoint],
        onto: &OrientedSurface<'_>,
        options: &FitOptions,
    ) -> Option<PatchFit> {
        match options.stiffness {
            None => self.fit_unknowns::<6>(points, onto, options),
            Some(_) => self.fit_unknowns::<9>(points, onto, options),
        }
    }

    /// The same with so many unknowns: 6 for a rigid patch, 9 for one that may bend.
    fn fit_unknowns<const N: usize>(
        &mut self,
        points: &[PatchPoint],
        onto: &OrientedSurface<'_>,
        options: &FitOptions,
    ) -> Option<PatchFit> {
        let centre = *points.first()?;
        let total: f64 = points.iter().map(|p| p.weight).sum();
        let mut moved = Moved { motion: start(points, total, onto)?, bending: Bending::none(&centre) };
        let [turns, shifts] = [N - 6, N - 3];
        let stiffness = options.stiffness.unwrap_or(0.0);
        self.seen.clear();
        self.seen.extend(points.iter().map(|p| (p.image, p.near)));
        let mut fit = None;
        for _ in 0..options.max_steps {
            // The centre stays where it is in a bend.
            let at = moved.apply(centre.position);
            let sums = self.sums::<N>(points, total, &moved, onto, options.noise);
            let NormalEquations { mut matrix, mut right, misfit } = sums;
            for k in 0..3 {
                matrix[(k + turns, k + turns)] += LEAST_RESISTANCE;
                matrix[(k + shifts, k + shifts)] += options.damping;
                right[k + shifts] += options.damping * (centre.image - at)[k];
            }
            for k in 0..turns {
                matrix[(k, k)] += stiffness;
                right[k] -= stiffness * moved.bending.bends[k];
            }
            let factor = matrix.cholesky()?;
            let step = factor.solve(&right);
            let [turn, shift] = [turns, shifts].map(|k| DVec3::new(step[k], step[k + 1], step[k + 2]));
            // The normal equations hold for small turns; one of more than a radian in one step is no fit.
            if !shift.is_finite() || turn.length_squared().is_nan() || turn.length_squared() > 1.0 {
                return None;
            }
            // With the best turn and bends for each shift, the matrix of the shifts is the Schur complement L L^T, L the factor's block of the
            // shifts.
            let block = factor.l_dirty().fixed_view::<3, 3>(shifts, shifts).lower_triangle();
            let hold =
                DMat3::from(block * block.transpose()) - DMat3::from_diagonal(DVec3::splat(options.damping));
            (0..turns).for_each(|k| moved.bending.bends[k] += step[k]);
            let rotation = small_turn(turn) * moved.motion.rotation;
            moved.motion = Rigid3::with_point(rotation, centre.position, at + shift);
            fit = Some(PatchFit { centre: at + shift, misfit, hold });
            // A tenth of the noise, in radians and in units of the root of the area.
            if turn.length() + shift.length() < 3e-5 {
                break;
            }
        }
        fit
    }

    /// The normal equations of a patch that has been moved; the weights of its points sum to `total`.
    fn sums<const N: usize>(
        &mut self,
        points: &[PatchPoint],
        total: f64,
        moved: &Moved,
        onto: &OrientedSurface<'_>,
        noise: f64,
    ) -> NormalEquations<N> {
        let rotation = moved.motion.rotation;
        let centre = moved.apply(points[0].position);
        self.distances.clear();
        self.normals.clear();
        self.arms.clear();
        for (p, (place, near)) in points.iter().zip(&mut self.seen) {
            let y = moved.apply(p.position);
            // A patch begins near its image, and hardly moves after the first step.
            if y.distance_squared(*place) >= near.margin * near.margin {
                (*place, *near) = (y, onto.nearest(near.vertex, y));
            }
            let Foot { distance, normal } = onto.foot(near.vertex, y);
            self.distances.push(distance);
            // A point counts only where both normals are within 60 degrees. Chosen by hand.
            let agrees = (rotation * p.normal).dot(normal) > 0.5;
            self.normals.push(if agrees { normal } else { DVec3::ZERO });
            self.arms.push(y - centre);
        }
        self.sizes.clear();
        self.sizes.extend(self.distances.iter().map(|d| d.abs()));
        let middle = self.sizes.len() / 2;
        // The robust scale is the median distance. Chosen by hand.
        let (_, median, _) = self.sizes.select_nth_unstable_by(middle, f64::total_cmp);
        let knee = max(1.5 * *median, noise);
        let up = rotation * moved.bending.frame[2];
        let (mut matrix, mut right, mut misfit) = ([[0.0; N]; N], [0.0; N], 0.0);
        for (k, p) in points.iter().enumerate() {
            let (distance, n) = (self.distances[k], self.normals[k]);
            let share = p.weight / total;
            let square = (distance / knee) * (distance / knee);
            let weight = share / ((1.0 + square) * (1.0 + square));
            let lever = self.arms[k].cross(n);
            let mut row = [0.0; N];
            row[N - 6..N - 3].copy_from_slice(&lever.to_array());
            row[N - 3..].copy_from_slice(&n.to_array());
            if N > 6 {
                let heights = moved.bending.heights(p.position);
                (0..N - 6).for_each(|bend| row[bend] = heights[bend] * up.dot(n));
            }
            // Columns from the diagonal down: the factor reads no other half.
            for i in 0..N {
                let weighted = weight * row[i];
                for j in i..N {
                    matrix[i][j] += weighted * row[j];
                }
                right[i] += weighted * distance;
            }
            // The misfit of a point is at most that at three knees. Chosen by hand.
            misfit += share * square.min(9.0) * knee * knee;
        }
        NormalEquations { matrix: SMatrix::from(matrix), right: SVector::from(right), misfit }
    }
}

/// The rigid motion that brings the points nearest to their images by weighted least squares.
fn start(points: &[PatchPoint], total: f64, onto: &OrientedSurface<'_>) -> Option<Rigid3> {
    let centre = points[0];
    let (mut mean, mut image) = (DVec3::ZERO, DVec3::ZERO);
    for p in points {
        mean += p.position * (p.weight / total);
        image += p.image * (p.weight / total);
    }
    let moment: DMat3 = points
        .iter()
        .map(|p| outer((p.image - image) * (p.weight / total), p.position - mean))
        .fold(DMat3::ZERO, |sum, m| sum + m);
    let distance = |p: &PatchPoint| p.position.distance_squared(centre.position);
    let far = points.iter().max_by(|p, q| distance(p).total_cmp(&distance(q)))?;
    let frame = |normal: DVec3, d: DVec3| {
        let along = d.reject_from_normalized(normal).normalize_or(normal.any_orthonormal_vector());
        DMat3::from_cols(along, normal.cross(along), normal)
    };
    let onto_normal = onto.normals[centre.near.vertex];
    let guess = frame(onto_normal, far.image - centre.image)
        * frame(centre.normal, far.position - centre.position).transpose();
    Some(Rigid3::with_point(nearest_rotation(&moment, guess), mean, image))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::scalar::{cos, sin};
    use crate::mesh::generators::icosphere;

    const OPTIONS: FitOptions = FitOptions { max_steps: 20, damping: 1e-6, noise: 1e-4, stiffness: None };

    /// A ball with hills.
    fn hilly() -> SurfaceMesh {
        let ball = icosphere(5);
        let hill = |p: &DVec3| *p * (1.0 + 0.03 * sin(7.0 * p.x) * cos(6.0 * p.y) + 0.02 * sin(8.0 * p.z));
        ball.with_positions(ball.positions().iter().map(hill).collect())
    }

    /// A disc around a vertex; its images have slid by `slid` over the surface.
    fn patch(surface: &OrientedSurface<'_>, slid: DVec3) -> Vec<PatchPoint> {
        let positions = surface.mesh.positions();
        let centre = surface.nearest(VertexId(0), DVec3::new(0.6, 0.5, 0.6)).vertex;
        let inside = surface.mesh.vertices().filter(|&v| positions[v].distance(positions[centre]) < 0.3);
        let point = |v: VertexId| {
            let image = positions[v] + slid;
            let near = surface.nearest(v, image);
            PatchPoint { position: positions[v], normal: surface.normals[v], weight: 1.0, image, near }
        };
        std::iter::once(centre).chain(inside.filter(|&v| v != centre)).map(point).collect()
    }

    #[test]
    fn hills_bring_a_patch_back_to_where_it_belongs() {
        let mesh = hilly();
        let surface = OrientedSurface::new(&mesh);
        let points = patch(&surface, DVec3::new(0.02, -0.03, 0.01));
        let fit = Fitter::default().fit(&points, &surface, &OPTIONS).unwrap();
        assert!(fit.centre.distance(points[0].position) < 2e-3, "{fit:?}");
        assert!(fit.misfit < 1e-6, "{fit:?}");
    }

    #[test]
    fn a_patch_that_may_bend_fits_a_body_that_is_bent() {
        let mesh = hilly();
        // The other body is rolled up round an axis.
        let roll = |p: &DVec3| {
            let (radius, angle) = (2.0 + p.z, 0.5 * p.x);
            DVec3::new(radius * sin(angle), p.y, radius * cos(angle) - 2.0)
        };
        let bent = mesh.with_positions(mesh.positions().iter().map(roll).collect());
        let [surface, onto] = [&mesh, &bent].map(OrientedSurface::new);
        let mut points = patch(&surface, DVec3::ZERO);
        for p in &mut points {
            p.image = roll(&p.position);
            p.near = onto.nearest(VertexId(0), p.image);
        }
        let fit = |stiffness: Option<f64>| {
            Fitter::default().fit(&points, &onto, &FitOptions { stiffness, ..OPTIONS }).unwrap()
        };
        let [rigid, stiff, soft] = [None, Some(1e6), Some(1e-9)].map(fit);
        assert!(soft.misfit < 0.2 * rigid.misfit, "{soft:?} {rigid:?}");
        assert!((stiff.misfit / rigid.misfit - 1.0).abs() < 1e-6, "{stiff:?} {rigid:?}");
        assert!(stiff.centre.distance(rigid.centre) < 1e-6, "{stiff:?} {rigid:?}");
    }

    #[test]
    fn on_a_ball_a_paraboloid_is_nearer_than_a_tangent_plane() {
        let ball = icosphere(3);
        let surface = OrientedSurface::new(&ball);
        // Largest errors of distance and normal, by paraboloid and by plane.
        let (mut bent, mut flat) = ([0.0_f64; 2], [0.0_f64; 2]);
        for f in ball.faces() {
            let [p, q, r] = ball.corners(f);
            let outwards = (p + q * 0.7 + r * 0.8).normalize();
            let near = surface.nearest(ball.triangles()[f][0], outwards * 1.003).vertex;
            let Foot { distance, normal } = surface.foot(near, outwards * 1.003);
            let plane = (ball.positions()[near] - outwards * 1.003).dot(surface.normals[near]);
            let errors = |distance: f64, normal: DVec3| [(distance + 0.003).abs(), normal.distance(outwards)];
            for (worst, found) in
                [(&mut bent, errors(distance, normal)), (&mut flat, errors(plane, surface.normals[near]))]
            {
                (0..2).for_each(|k| worst[k] = worst[k].max(found[k]));
            }
        }
        assert!(bent[0] < 0.35 * flat[0] && bent[1] < 0.35 * flat[1], "{bent:?} {flat:?}");
    }

    #[test]
    fn coarse_and_noisy_meshes_are_rough() {
        let fine = icosphere(5);
        let shaken = |amount: f64| {
            let shake = |(v, p): (VertexId, &DVec3)| *p * (1.0 + amount * sin(57.0 * v.index() as f64));
            fine.with_positions(fine.positions().iter_enumerated().map(shake).collect())
        };
        let rough = |mesh: &SurfaceMesh| OrientedSurface::new(mesh).roughness();
        // A ball has paraboloids up to the third order of an edge's length.
        assert!(rough(&icosphere(3)) > 3.0 * rough(&fine), "{} {}", rough(&icosphere(3)), rough(&fine));
        assert!(rough(&fine) < 1e-4, "{}", rough(&fine));
        for amount in [2e-3, 4e-3] {
            let found = rough(&shaken(amount));
            assert!((0.3..1.0).contains(&(found / amount)), "{found} of {amount}");
        }
    }

    #[test]
    fn a_plain_ball_holds_no_patch() {
        let ball = icosphere(5);
        let surface = OrientedSurface::new(&ball);
        let points = patch(&surface, DVec3::ZERO);
        let held = |mesh: &SurfaceMesh| {
            let surface = OrientedSurface::new(mesh);
            let fit = Fitter::default().fit(&patch(&surface, DVec3::ZERO), &surface, &OPTIONS).unwrap();
            let normal = surface.normals[surface.nearest(VertexId(0), fit.centre).vertex];
            let along = normal.any_orthonormal_vector();
            along.dot(fit.hold * along)
        };
        assert!(held(&ball) < 0.02 * held(&hilly()), "{} {}", held(&ball), held(&hilly()));
        assert!(Fitter::default().fit(&points[..0], &surface, &OPTIONS).is_none());
    }
}
