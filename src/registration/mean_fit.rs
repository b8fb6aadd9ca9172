//! A measure of a map: how well patches of one surface fit the other where the map takes them.
//!
//! Lengths hardly tell the front of a body from its back. But where the map is right a patch fits its image nearly as well as a rigid motion
//! allows, on the same body in another pose and on another body of its kind, and where it is wrong it does not. Patches slide to where they fit
//! best, so that a coarse map, which is a little off, will do.

use super::patch_fit::{FitOptions, Fitter, OrientedSurface};
use super::rigid_patches::{ASKED_EVERY, MappedLevel, Patches, fitted_near, spread, trust};
use crate::monitor::{Cancelled, Monitor, Step};

/// Options of the measure of how well a map's patches fit; lengths in units of the root of the area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanFitOptions {
    /// Distance between neighbouring points of the patches.
    pub spacing: f64,
    /// One of so many points, at least 1, is the centre of a patch.
    pub every: usize,
    /// Radius of the patches.
    pub radius: f64,
    /// Options of the registration of one patch.
    pub fit: FitOptions,
}

/// How well patches of a level fit the other surface near their images, from 0 to 1: the mean of noise^2 / (noise^2 + m) over the area, with the mean
/// square distance m of a patch; 0 for patches that are not fitted. Both areas are 1.
///
/// # Errors
/// [`Cancelled`].
pub fn mean_fit(
    [own, onto]: [&OrientedSurface<'_>; 2],
    level: &MappedLevel<'_>,
    options: &MeanFitOptions,
    monitor: &mut dyn Monitor,
) -> Result<f64, Cancelled> {
    let weights = spread(own, level, options.spacing);
    let mut patches = Patches::new([own, onto], level, &weights);
    let (mut fitter, mut patch) = (Fitter::default(), Vec::new());
    let (mut fitted, mut all) = (0.0, 0.0);
    let points = level.mesh.vertices().filter(|&v| weights[v] > 0.0);
    for (k, v) in points.step_by(options.every).enumerate() {
        if k.is_multiple_of(ASKED_EVERY) {
            monitor.step(Step::default())?;
        }
        patches.around(v, options.radius, &mut patch);
        all += weights[v];
        if let Some(fit) = fitted_near(&mut fitter, &patch, onto, &options.fit) {
            fitted += weights[v] * trust(&fit, options.fit.noise);
        }
    }
    Ok(if all > 0.0 { fitted / all } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::super::rigid_patches::testing::{hilly, turned};
    use super::*;
    use crate::mesh::VertexId;
    use crate::monitor::Silent;
    use glam::{DQuat, DVec3};
    use typed_index_collections::TiVec;

    const OPTIONS: MeanFitOptions = MeanFitOptions {
        spacing: 0.03,
        every: 3,
        radius: 0.15,
        fit: FitOptions { max_steps: 8, damping: 1e-4, noise: 1e-3, stiffness: None },
    };

    /// The fit of the hilly ball to itself where each vertex goes to that nearest to its place turned by this.
    fn fit_of_turned(turn: DQuat) -> f64 {
        let mesh = hilly();
        let surface = OrientedSurface::new(&mesh);
        let all: TiVec<VertexId, VertexId> = mesh.vertices().collect();
        let level = turned(&mesh, &all, &surface, turn);
        mean_fit([&surface; 2], &level, &OPTIONS, &mut Silent).unwrap()
    }

    #[test]
    fn patches_fit_where_they_belong_also_from_a_little_beside_and_nowhere_else() {
        let fit =
            |angle: f64| fit_of_turned(DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), angle));
        let (exact, beside, elsewhere) = (fit(0.0), fit(0.03), fit(1.5));
        assert!(exact > 0.99 && beside > 0.9 && elsewhere < 0.4, "{exact} {beside} {elsewhere}");
    }
}
