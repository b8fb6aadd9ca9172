//! The relief of a body: how far each point stands out of the surface smoothed by the flow of heat.
//!
//! Distances along a surface hardly tell the front of a body from its back, or the upper side of a hand from the palm: a map that exchanges
//! them is nearly as isometric as the right one. Chest, knees and nose stand out on one side only.

use crate::math::triangle::cotangent_between;
use crate::mesh::normals::vertex_normals;
use crate::mesh::{SurfaceMesh, VertexId};
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
    /// Neighbours of each vertex with their weight.
    rows: Vec<Vec<(u32, f64)>>,
    diagonal: Vec<f64>,
}

impl Heat {
    fn new(mesh: &SurfaceMesh, time: f64) -> Self {
        let masses = mesh.vertex_areas().into_iter().collect::<Vec<f64>>();
        let mut rows: Vec<Vec<(u32, f64)>> = vec![Vec::new(); masses.len()];
        let mut diagonal = masses.clone();
        for corners in mesh.triangles() {
            for k in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
                let [p, q, r] = [a, b, c].map(|v| mesh.positions()[v]);
                let cotangent = cotangent_between(p - r, q - r);
                // Triangles without area carry no heat.
                let w = if cotangent.is_finite() { 0.5 * time * cotangent.clamp(-1e3, 1e3) } else { 0.0 };
                for (v, other) in [(a, b), (b, a)] {
                    rows[v.index()].push((other.0, w));
                    diagonal[v.index()] += w;
                }
            }
        }
        Self { masses, rows, diagonal }
    }
}

impl LinearOperator<DVec3> for Heat {
    fn apply(&self, x: &[DVec3], y: &mut [DVec3]) {
        for (k, out) in y.iter_mut().enumerate() {
            let flows: DVec3 = self.rows[k].iter().map(|&(j, w)| w * x[j as usize]).sum();
            *out = self.diagonal[k] * x[k] - flows;
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
