//! A cap is faired: its vertices become those of a membrane over the rim, or, of a small hole, of a thin plate that goes on as the
//! surface around (Kobbelt, Campagna, Vorsatz & Seidel 1998, "Interactive multi-resolution modeling on arbitrary meshes").
//!
//! With weights w = 1 / length of the edges before, the Laplacian of a vertex is the weighted mean of its neighbours less itself. A
//! membrane has none inside; a thin plate has the least sum of squares over the inside and the rim.

use super::patch::Patch;
use crate::monitor::{Cancelled, Monitor, Step};
use crate::numerics::conjugate_gradients::{CgOptions, CgWorkspace, LinearOperator, Preconditioner};
use glam::DVec3;

/// The largest ratio of a plate's area to the membrane's: beyond it, the surface around leads the plate astray. Chosen by hand.
const PLATE_AREA: f64 = 1.5;

/// Which surface a cap becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fairness {
    /// The cap is stretched over the rim, as that of a large hole.
    Membrane,
    /// The cap goes on smoothly over the rim, as that of a small hole.
    Plate,
}

/// Fairs a cap; `around` are the places of each rim vertex' neighbours in the surface around. A result with flat or folded triangles
/// is not taken.
///
/// # Errors
/// [`Cancelled`].
pub(super) fn fair(
    patch: &mut Patch,
    around: &[Vec<DVec3>],
    fairness: Fairness,
    monitor: &mut dyn Monitor,
) -> Result<(), Cancelled> {
    if patch.points.len() == patch.rim {
        return Ok(());
    }
    let system = System { stencils: stencils(patch, around), rim: patch.rim };
    monitor.step(Step::default())?;
    move_if(patch, &system.membrane_steps(&patch.points, monitor)?, |_| true);
    if fairness == Fairness::Plate {
        let area = patch.area();
        let steps = system.plate_steps(&patch.points, monitor)?;
        move_if(patch, &steps, |patch| patch.area() <= PLATE_AREA * area);
    }
    Ok(())
}

/// Moves the inner vertices, where the cap is sound and as wanted then.
fn move_if(patch: &mut Patch, steps: &[DVec3], is_wanted: impl Fn(&Patch) -> bool) {
    let before = patch.points.clone();
    let rim = patch.rim;
    patch.points[rim..].iter_mut().zip(steps).for_each(|(p, step)| *p += *step);
    if !patch.points.iter().all(|p| p.is_finite()) || !patch.is_sound() || !is_wanted(patch) {
        patch.points = before;
    }
}

/// The weighted mean of a vertex' neighbours: those of the cap, and what the surface around adds.
struct Stencil {
    /// Neighbours in the cap with their weights; all weights, with those around, sum to 1.
    neighbours: Vec<(u32, f64)>,
    /// Weighted sum of the neighbours in the surface around.
    around: DVec3,
    /// The sum of the weights before they were made to sum to 1.
    whole: f64,
}

fn stencils(patch: &Patch, around: &[Vec<DVec3>]) -> Vec<Stencil> {
    let mut pairs: Vec<[u32; 2]> = Vec::with_capacity(6 * patch.triangles.len());
    for t in &patch.triangles {
        pairs.extend([[t[0], t[1]], [t[1], t[2]], [t[2], t[0]], [t[1], t[0]], [t[2], t[1]], [t[0], t[2]]]);
    }
    pairs.sort_unstable();
    pairs.dedup();
    let none = |_| Stencil { neighbours: Vec::new(), around: DVec3::ZERO, whole: 0.0 };
    let mut stencils: Vec<Stencil> = patch.points.iter().map(none).collect();
    let weight = |p: DVec3, q: DVec3| 1.0 / p.distance(q).max(f64::MIN_POSITIVE);
    for [a, b] in pairs {
        let w = weight(patch.points[a as usize], patch.points[b as usize]);
        stencils[a as usize].neighbours.push((b, w));
    }
    for (v, stencil) in stencils.iter_mut().enumerate() {
        let outside = around.get(v).map_or(&[][..], Vec::as_slice);
        let outside: Vec<(DVec3, f64)> = outside.iter().map(|&p| (p, weight(patch.points[v], p))).collect();
        let whole = stencil.neighbours.iter().map(|(_, w)| w).sum::<f64>()
            + outside.iter().map(|(_, w)| w).sum::<f64>();
        stencil.neighbours.iter_mut().for_each(|(_, w)| *w /= whole);
        stencil.whole = whole;
        stencil.around = outside.iter().map(|(p, w)| *p * (w / whole)).sum();
    }
    stencils
}

/// Each iteration lowers the energy, so that the last iterate is of use even where these are not enough.
const SOLVE: CgOptions = CgOptions { tolerance: 1e-6, max_iterations: 500 };

/// The inverses of the diagonal's entries.
struct Diagonal(Vec<f64>);

impl Preconditioner<f64> for Diagonal {
    fn precondition(&self, x: &[f64], y: &mut [f64]) {
        y.iter_mut().zip(x).zip(&self.0).for_each(|((y, x), d)| *y = x * d);
    }
}

/// The stencils of all vertices of a cap; the unknowns are steps of the inner vertices, x[i] of vertex rim + i.
struct System {
    stencils: Vec<Stencil>,
    rim: usize,
}

/// The energy of a membrane: the Laplacians of the inner vertices, times their weights, which makes the matrix symmetric.
struct Membrane<'a>(&'a System);

/// The least sum of squares of the Laplacians of all vertices, in its normal equations.
struct Plate<'a>(&'a System);

impl System {
    /// Laplacian of a vertex for steps of the inner vertices.
    fn laplacian(&self, v: usize, x: &[f64]) -> f64 {
        let step = |v: usize| v.checked_sub(self.rim).map_or(0.0, |i| x[i]);
        let mean: f64 = self.stencils[v].neighbours.iter().map(|&(n, w)| w * step(n as usize)).sum();
        mean - step(v)
    }

    /// Laplacian of a vertex where it is.
    fn laplacian_now(&self, v: usize, points: &[DVec3]) -> DVec3 {
        let stencil = &self.stencils[v];
        let mean: DVec3 = stencil.neighbours.iter().map(|&(n, w)| w * points[n as usize]).sum();
        mean + stencil.around - points[v]
    }

    /// y = the transposed map from steps to Laplacians of all vertices.
    fn transposed(&self, values: impl Iterator<Item = f64>, y: &mut [f64]) {
        y.fill(0.0);
        for ((v, stencil), value) in self.stencils.iter().enumerate().zip(values) {
            if let Some(i) = v.checked_sub(self.rim) {
                y[i] -= value;
            }
            for &(n, w) in &stencil.neighbours {
                if let Some(i) = (n as usize).checked_sub(self.rim) {
                    y[i] += w * value;
                }
            }
        }
    }

    /// The steps to the membrane.
    fn membrane_steps(&self, points: &[DVec3], monitor: &mut dyn Monitor) -> Result<Vec<DVec3>, Cancelled> {
        let inner = self.rim..points.len();
        let diagonal = Diagonal(inner.clone().map(|v| 1.0 / self.stencils[v].whole).collect());
        let right: Vec<DVec3> =
            inner.map(|v| self.stencils[v].whole * self.laplacian_now(v, points)).collect();
        steps(&Membrane(self), &diagonal, &right, monitor)
    }

    /// The steps to the plate.
    fn plate_steps(&self, points: &[DVec3], monitor: &mut dyn Monitor) -> Result<Vec<DVec3>, Cancelled> {
        let inside = points.len() - self.rim;
        let mut diagonal = vec![1.0; inside];
        for (n, w) in self.stencils.iter().flat_map(|stencil| &stencil.neighbours) {
            if let Some(i) = (*n as usize).checked_sub(self.rim) {
                diagonal[i] += w * w;
            }
        }
        let diagonal = Diagonal(diagonal.into_iter().map(|d| 1.0 / d).collect());
        let laplacians: Vec<DVec3> = (0..points.len()).map(|v| self.laplacian_now(v, points)).collect();
        let mut right = vec![DVec3::ZERO; inside];
        for axis in 0..3 {
            let mut y = vec![0.0; inside];
            self.transposed(laplacians.iter().map(|l| -l[axis]), &mut y);
            right.iter_mut().zip(&y).for_each(|(p, y)| p[axis] = *y);
        }
        steps(&Plate(self), &diagonal, &right, monitor)
    }
}

impl LinearOperator<f64> for Membrane<'_> {
    fn apply(&self, x: &[f64], y: &mut [f64]) {
        let Self(system) = self;
        for (i, y) in y.iter_mut().enumerate() {
            let v = system.rim + i;
            *y = -system.stencils[v].whole * system.laplacian(v, x);
        }
    }
}

impl LinearOperator<f64> for Plate<'_> {
    fn apply(&self, x: &[f64], y: &mut [f64]) {
        let Self(system) = self;
        system.transposed((0..system.stencils.len()).map(|v| system.laplacian(v, x)), y);
    }
}

/// Solves for the three coordinates.
fn steps(
    operator: &impl LinearOperator<f64>,
    diagonal: &Diagonal,
    right: &[DVec3],
    monitor: &mut dyn Monitor,
) -> Result<Vec<DVec3>, Cancelled> {
    let mut found = vec![DVec3::ZERO; right.len()];
    let mut workspace = CgWorkspace::default();
    for axis in 0..3 {
        let b: Vec<f64> = right.iter().map(|p| p[axis]).collect();
        let mut x = vec![0.0; b.len()];
        // A solve that does not converge is no fault here, see above.
        let mut answer = Ok(());
        let _ = workspace.solve_while(operator, diagonal, &b, &mut x, &SOLVE, || {
            answer = monitor.step(Step::default());
            answer.is_ok()
        });
        answer?;
        found.iter_mut().zip(&x).for_each(|(p, x)| p[axis] = *x);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::scalar::{cos, sin};
    use crate::monitor::Silent;
    use rustc_hash::FxHashSet;
    use std::f64::consts::TAU;

    /// A fan over a circle of radius 0.4 on the unit sphere, with its middle out of place, and the next circle of the sphere.
    fn hole_of_a_ball() -> (Patch, Vec<Vec<DVec3>>) {
        let n = 24;
        let circle = |radius: f64, k: usize| {
            let a = TAU * k as f64 / n as f64;
            DVec3::new(radius * cos(a), radius * sin(a), (1.0 - radius * radius).sqrt())
        };
        let mut points: Vec<DVec3> = (0..n).map(|k| circle(0.4, k)).collect();
        points.push(DVec3::new(0.1, -0.2, 0.3));
        let fan = (0..n as u32).map(|k| [k, (k + 1) % n as u32, n as u32]).collect();
        let around = (0..n).map(|k| [0, 1].map(|step| circle(0.5, (k + step) % n)).to_vec());
        (Patch::new(points, n, fan, FxHashSet::default()), around.collect())
    }

    #[test]
    fn a_membrane_is_flat_over_a_flat_rim_and_a_plate_goes_on_as_the_ball() {
        let heights = [Fairness::Membrane, Fairness::Plate].map(|fairness| {
            let (mut patch, around) = hole_of_a_ball();
            crate::mesh::repair::caps::refinement::refine(&mut patch, &[0.1; 24], &mut Silent).unwrap();
            assert!(patch.points.len() > 40);
            fair(&mut patch, &around, fairness, &mut Silent).unwrap();
            assert!(patch.is_sound());
            let inner = patch.points[patch.rim..].iter();
            inner.map(|p| p.z).fold(0.0, f64::max)
        });
        let rim = (1.0_f64 - 0.16).sqrt();
        assert!((heights[0] - rim).abs() < 1e-6, "{heights:?}");
        assert!((heights[1] - 1.0).abs() < 0.03, "{heights:?}");
    }
}
