//! The relief of a body: how far each point stands out of the surface smoothed by the flow of heat.
//!
//! Distances along a surface hardly tell the front of a body from its back, or the upper side of a hand from the palm: a map that exchanges
//! them is nearly as isometric as the right one. Chest, knees and nose stand out on one side only.

use crate::mesh::normals::vertex_normals;
use crate::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use crate::numerics::conjugate_gradients::{CgOptions, CgWorkspace, LinearOperator, Preconditioner};
use glam::DVec3;
use typed_index_collections::TiVec;

/// Accuracy of the smoothed surface, far below that of a level.
const SOLVE: CgOptions = CgOptions { tolerance: 1e-6, max_iterations: 1000 };

/// The width over which the surface is smoothed, in units of the root of the area.
const WIDTH: f64 = 0.2;

/// The height of each vertex above the surface that heat has smoothed for the time [`WIDTH`]², for a mesh of area 1: positive where the
/// surface is convex. A smoothing that does not converge is used as far as it came.
pub(super) fn relief(mesh: &SurfaceMesh) -> TiVec<VertexId, f64> {
    let system = Heat::new(mesh, WIDTH * WIDTH);
    let centre = mesh.positions().iter().sum::<DVec3>() / mesh.vertex_count() as f64;
    let b: Vec<DVec3> =
        mesh.positions().iter().zip(&system.masses).map(|(&p, &m)| m * (p - centre)).collect();
    let mut smooth = vec![DVec3::ZERO; b.len()];
    let _ = CgWorkspace::default().solve(&system, &system, &b, &mut smooth, &SOLVE);
    let normals = vertex_normals(mesh);
    mesh.vertices().map(|v| (mesh.positions()[v] - centre - smooth[v.index()]).dot(normals[v])).collect()
}

/// A step of the flow of heat: masses plus the time times the cotan Laplacian.
struct Heat {
    masses: Vec<f64>,
    /// Ends and weight of each edge.
    edges: Vec<([usize; 2], f64)>,
    diagonal: Vec<f64>,
}

impl Heat {
    fn new(mesh: &SurfaceMesh, time: f64) -> Self {
        let masses = mesh.vertex_areas().raw;
        // Triangles without area carry no heat.
        let half = |h: HalfedgeId| {
            let cotangent = mesh.cotangent(h);
            if cotangent.is_finite() { 0.5 * time * cotangent.clamp(-1e3, 1e3) } else { 0.0 }
        };
        let ends = |h: HalfedgeId| [mesh.tail(h), mesh.head(h)].map(VertexId::index);
        let edges: Vec<_> = mesh.edges().map(|h| (ends(h), half(h) + half(mesh.twin(h)))).collect();
        let mut diagonal = masses.clone();
        for (ends, weight) in &edges {
            ends.iter().for_each(|&v| diagonal[v] += weight);
        }
        Self { masses, edges, diagonal }
    }
}

impl LinearOperator<DVec3> for Heat {
    fn apply(&self, x: &[DVec3], y: &mut [DVec3]) {
        for (out, (mass, &x)) in y.iter_mut().zip(self.masses.iter().zip(x)) {
            *out = *mass * x;
        }
        for &([a, b], weight) in &self.edges {
            let flow = weight * (x[a] - x[b]);
            y[a] += flow;
            y[b] -= flow;
        }
    }
}

impl Preconditioner<DVec3> for Heat {
    fn precondition(&self, x: &[DVec3], y: &mut [DVec3]) {
        for (k, out) in y.iter_mut().enumerate() {
            *out = x[k] / self.diagonal[k].max(self.masses[k]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::test_bodies::ball_with_ends;
    use super::*;
    use crate::mesh::generators::icosphere;
    use glam::DQuat;

    fn of_area_one(mesh: &SurfaceMesh) -> SurfaceMesh {
        let scale = 1.0 / mesh.area().sqrt();
        mesh.with_positions(mesh.positions().iter().map(|&p| p * scale).collect())
    }

    #[test]
    fn a_ball_stands_out_everywhere_by_what_heat_takes_from_its_radius() {
        let ball = of_area_one(&icosphere(4));
        let radius = ball.positions()[VertexId(0)].length();
        // Coordinates are eigenfunctions of the Laplacian, with the eigenvalue 2 / radius².
        let smooth = radius / (1.0 + 2.0 * WIDTH * WIDTH / (radius * radius));
        for height in relief(&ball) {
            assert!((height - (radius - smooth)).abs() < 0.01 * radius, "{height} {radius} {smooth}");
        }
    }

    #[test]
    fn what_stands_out_does_so_however_the_body_is_turned() {
        let front = DVec3::new(0.2, 0.9, -0.3).normalize();
        let body = of_area_one(&ball_with_ends(&[(front, 0.3)], 10.0));
        let turn = DQuat::from_axis_angle(DVec3::new(2.0, 1.0, 1.0).normalize(), 2.0);
        let turned = body.with_positions(body.positions().iter().map(|&p| turn * p + DVec3::X).collect());
        let [found, after] = [relief(&body), relief(&turned)];
        assert!(found.iter().zip(&after).all(|(a, b)| (a - b).abs() < 1e-5));
        let highest = body.vertices().max_by(|a, b| found[*a].total_cmp(&found[*b])).unwrap();
        assert!(body.positions()[highest].normalize().dot(front) > 0.9);
    }
}
