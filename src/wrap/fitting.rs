//! Faces fitted to the scan between their vertices.
//!
//! With vertices on the scan, faces cut the corners between. Each pass takes points spread over the base's faces to the nearest
//! points of the scan, and points of the scan to the nearest of the base, and moves the vertices so that the distances from the
//! scan's tangent planes are least in the mean square (Chen & Medioni 1991): along the surface nothing pulls. Two small terms keep
//! the correspondence: how far a vertex has moved from its image, and how differently neighbours have moved.

use super::input::WrapInput;
use super::samples::samples;
use crate::math::rigid3::outer;
use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use crate::numerics::conjugate_gradients::{CgOptions, CgWorkspace, LinearOperator, Preconditioner};
use crate::surface_map::correspondence::PointLocator;
use glam::{DMat3, DVec3};
use typed_index_collections::{TiVec, ti_vec};

/// The number of points that are taken on each mesh, about. Chosen by hand.
const COUNT: usize = 60_000;

/// The number of passes. A third changes nothing that can be seen (cat-lion).
const PASSES: usize = 2;

/// The weight of a vertex's way from its image, beside distances from tangent planes. Chosen by hand.
const STAY: f64 = 0.05;

/// The weight of the difference of neighbours' ways. With 0.02 or less faces are tangled that were not (cat-lion).
const EVEN: f64 = 0.1;

/// The largest distance of a nearest point from the image with which it counts, in mean edges. Chosen by hand.
const SLIDE: f64 = 2.0;

/// Each iteration lowers the energy, so that the last iterate is of use even where these are not enough.
const SOLVE: CgOptions = CgOptions { tolerance: 1e-4, max_iterations: 100 };

/// A point of the base whose distance from a plane is to be 0.
struct Plane {
    corners: [VertexId; 3],
    shares: [f64; 3],
    normal: DVec3,
    /// The distance of the point from the plane, along its normal.
    distance: f64,
    area: f64,
}

/// Fits the faces.
pub(super) fn fit(
    input: &WrapInput<'_>,
    weights: &TiVec<HalfedgeId, f64>,
    locator: &PointLocator<'_>,
    positions: &mut TiVec<VertexId, DVec3>,
    monitor: &mut dyn Monitor,
) -> Result<(), Cancelled> {
    let begin = positions.clone();
    let scan = SurfaceIndex::new(input.scan);
    for pass in 0..PASSES {
        monitor.step(Step { fraction: pass as f64 / PASSES as f64, residual: None })?;
        let laid = input.base.with_positions(positions.clone());
        let planes = planes(input, locator, &scan, &laid);
        let system = System::new(input.base, weights, &laid, planes);
        let moved: TiVec<VertexId, DVec3> = positions.iter().zip(&begin).map(|(p, q)| *p - *q).collect();
        let steps = system.steps(&moved);
        positions.iter_mut().zip(steps).filter(|(_, step)| step.is_finite()).for_each(|(p, step)| *p += step);
    }
    Ok(())
}

/// The distances that are to be 0, as the base lies now.
fn planes(
    input: &WrapInput<'_>,
    locator: &PointLocator<'_>,
    scan: &SurfaceIndex<'_>,
    laid: &SurfaceMesh,
) -> Vec<Plane> {
    let is_scan_skin = |f: FaceId| input.is_scan_skin(f);
    let is_base_skin = |f: FaceId| input.is_base_skin(f);
    let slide = SLIDE * laid.edges().map(|h| laid.length(h)).sum::<f64>() / laid.edge_count() as f64;
    let plane = |at: SurfacePoint, onto: DVec3, normal: DVec3, area: f64| Plane {
        corners: laid.triangles()[at.face],
        shares: at.barycentric,
        normal,
        distance: normal.dot(at.position(laid) - onto),
        area,
    };
    let mut planes = Vec::with_capacity(2 * COUNT);
    for sample in samples(laid, is_base_skin, COUNT, 2) {
        let image = locator.image(sample.point);
        if !is_scan_skin(image.face) {
            continue;
        }
        let (p, normal) = (sample.point.position(laid), scan.normal(image));
        let allowed = |point: SurfacePoint| is_scan_skin(point.face) && scan.normal(point).dot(normal) > 0.0;
        let found = scan.nearest_where(p, image.face, allowed).map_or(image, |nearest| nearest.point);
        let is_near = found.position(input.scan).distance(image.position(input.scan)) < slide;
        let onto = if is_near { found } else { image };
        planes.push(plane(sample.point, onto.position(input.scan), scan.normal(onto), sample.area));
    }
    let index = SurfaceIndex::new(laid);
    for sample in samples(input.scan, is_scan_skin, COUNT, 2) {
        let preimage = locator.preimage(sample.point);
        if !is_base_skin(preimage.face) {
            continue;
        }
        let (p, normal) = (sample.point.position(input.scan), scan.normal(sample.point));
        let allowed = |point: SurfacePoint| is_base_skin(point.face) && index.normal(point).dot(normal) > 0.0;
        let found = index.nearest_where(p, preimage.face, allowed).map_or(preimage, |nearest| nearest.point);
        let is_near = found.position(laid).distance(preimage.position(laid)) < slide;
        planes.push(plane(if is_near { found } else { preimage }, p, normal, sample.area));
    }
    planes
}

/// The normal equations of one pass.
struct System<'a> {
    base: &'a SurfaceMesh,
    planes: Vec<Plane>,
    /// The weight of each vertex's way.
    stay: TiVec<VertexId, f64>,
    /// The weight of the difference of the ways of each halfedge's ends.
    even: TiVec<HalfedgeId, f64>,
    diagonal: TiVec<VertexId, DMat3>,
}

impl<'a> System<'a> {
    fn new(
        base: &'a SurfaceMesh,
        weights: &TiVec<HalfedgeId, f64>,
        laid: &SurfaceMesh,
        planes: Vec<Plane>,
    ) -> Self {
        let areas = laid.vertex_areas();
        let mean = areas.iter().sum::<f64>() / areas.len() as f64;
        let stay: TiVec<VertexId, f64> = areas.iter().map(|area| STAY * (area + 1e-3 * mean)).collect();
        let even: TiVec<HalfedgeId, f64> = base
            .halfedges()
            .map(|h| EVEN * weights[h] * 0.5 * (areas[base.tail(h)] + areas[base.head(h)] + 1e-3 * mean))
            .collect();
        let mut diagonal: TiVec<VertexId, DMat3> = ti_vec![DMat3::ZERO; base.vertex_count()];
        for plane in &planes {
            let square = outer(plane.normal, plane.normal) * plane.area;
            for (&v, share) in plane.corners.iter().zip(plane.shares) {
                diagonal[v] += square * (share * share);
            }
        }
        for v in base.vertices() {
            let sum = stay[v] + base.star(v).map(|h| even[h]).sum::<f64>();
            diagonal[v] = (diagonal[v] + DMat3::from_diagonal(DVec3::splat(sum))).inverse();
        }
        Self { base, planes, stay, even, diagonal }
    }

    /// The steps that the vertices should make from their present places; `moved` are their steps so far, summed.
    fn steps(&self, moved: &TiVec<VertexId, DVec3>) -> Vec<DVec3> {
        let n = self.base.vertex_count();
        let mut right = vec![DVec3::ZERO; n];
        self.add_ways(moved.as_ref(), &mut right);
        for plane in &self.planes {
            let pull = plane.normal * (plane.area * plane.distance);
            plane.corners.iter().zip(plane.shares).for_each(|(v, share)| right[v.index()] += pull * share);
        }
        right.iter_mut().for_each(|r| *r = -*r);
        let mut steps = vec![DVec3::ZERO; n];
        // A solve that has not converged is no fault here, see above.
        let _ = CgWorkspace::default().solve(self, self, &right, &mut steps, &SOLVE);
        steps
    }

    /// Adds the gradient of the terms that keep the correspondence.
    fn add_ways(&self, x: &[DVec3], y: &mut [DVec3]) {
        for v in self.base.vertices() {
            let own = x[v.index()];
            let around = self.base.star(v).map(|h| (own - x[self.base.head(h).index()]) * self.even[h]);
            y[v.index()] += own * self.stay[v] + around.sum::<DVec3>();
        }
    }
}

impl LinearOperator<DVec3> for System<'_> {
    fn apply(&self, x: &[DVec3], y: &mut [DVec3]) {
        y.fill(DVec3::ZERO);
        self.add_ways(x, y);
        for plane in &self.planes {
            let at = plane.corners.map(VertexId::index);
            let step = x[at[0]] * plane.shares[0] + x[at[1]] * plane.shares[1] + x[at[2]] * plane.shares[2];
            let pull = plane.normal * (plane.area * plane.normal.dot(step));
            (0..3).for_each(|k| y[at[k]] += pull * plane.shares[k]);
        }
    }
}

impl Preconditioner<DVec3> for System<'_> {
    fn precondition(&self, x: &[DVec3], y: &mut [DVec3]) {
        y.iter_mut().zip(x).zip(&self.diagonal).for_each(|((y, x), inverse)| *y = *inverse * *x);
    }
}
