//! The mirror plane of a surface: the plane whose reflection takes the surface nearest to itself.
//!
//! Points are sampled evenly on the surface. Planes through its centre with many normals are tried with a few of them, and the best are
//! refined by Gauss-Newton steps: each reflected point is drawn to the tangent plane of the nearest point that faces the same way (Chen &
//! Medioni 1991), with a weight that falls with its distance, so that a bent limb does not tilt the plane of the trunk. A body
//! of revolution has many planes, of which one is found. Bodies without a mirror plane have a best one, too, with a large misfit.

use crate::math::mirror_plane::MirrorPlane;
use crate::math::random::SplitMix;
use crate::math::rigid3::outer;
use crate::math::scalar::{max, min};
use crate::mesh::generators::icosphere;
use crate::mesh::surface_index::{Nearest, SurfaceIndex};
use crate::mesh::{FaceId, SurfaceMesh};
use crate::monitor::{Cancelled, Monitor, Portion, Step};
use glam::{DMat3, DVec3};

/// Sample points by which directions are compared and planes first refined. Chosen by hand.
const COARSE_SAMPLES: usize = 200;
/// Sample points by which the last plane is refined and misfits are measured. Chosen by hand.
const SAMPLES: usize = 1000;

/// Number of directions whose planes are refined: before that a second, rougher symmetry, as of front and back, may have the smaller
/// misfit. Chosen by hand.
const REFINED: usize = 6;

/// Steps of a refinement, at most; usually ten are enough. Chosen by hand.
const MOST_STEPS: usize = 25;

/// A refinement ends when a step is shorter than this, in radians and in units of the size (the root of the area). Chosen by hand.
const STILL: f64 = 1e-7;

/// Largest step, in radians and in units of the size: tangent planes do not approximate the surface farther away. Chosen by hand.
const LARGEST_STEP: f64 = 0.1;

/// Least knee of the robust weights, in units of the size: about the noise of a scan. Chosen by hand.
const NOISE: f64 = 1e-3;

/// Distances above this, in units of the size, count as this when directions are compared: a point of another part of the body must not
/// decide. Chosen by hand.
const FAR: f64 = 0.15;

/// Largest misfit of a mirror plane, as a share of the mean distance from it. Measured on the meshes of the tests and the
/// demos: bodies that stand straight have at most 0.08, a galloping horse 0.22 and a rearing one 0.24; two hands have 0.25 and 0.30, since
/// palm and back of a flat hand lie near each other, and bodies bent to one side have 0.36 to 0.63.
const LARGEST_SHARE: f64 = 0.245;

/// Largest misfit of a mirror plane, in units of the size: head and tail are far from a plane across a long body, so that the share alone
/// is no sufficient test. The largest of the bodies that have a mirror plane is a rabbit's 0.024.
const LARGEST_MISFIT: f64 = 0.025;

/// A plane with the misfit of its reflection of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// The plane.
    pub plane: MirrorPlane,
    /// Mean distance of the reflected surface from the surface, in units of the root of its area.
    pub misfit: f64,
    /// Mean distance of the surface from the plane, in units of the root of its area.
    pub reach: f64,
}

impl Mirror {
    /// Whether the misfit is small enough for a mirror plane of the surface.
    pub fn fits(&self) -> bool {
        self.misfit <= min(LARGEST_MISFIT, LARGEST_SHARE * self.reach)
    }
}

/// The plane of least misfit, whether it [fits](Mirror::fits) or not; `None` for a surface without area.
///
/// # Errors
/// [`Cancelled`].
pub fn best_mirror(mesh: &SurfaceMesh, monitor: &mut dyn Monitor) -> Result<Option<Mirror>, Cancelled> {
    let Some(body) = Body::new(mesh) else { return Ok(None) };
    let few = body.spread(COARSE_SAMPLES);
    let directions = directions();
    let mut tried = Vec::with_capacity(directions.len());
    for (k, &direction) in directions.iter().enumerate() {
        let fraction = 0.4 * k as f64 / directions.len() as f64;
        monitor.step(Step { fraction, residual: None })?;
        let plane = MirrorPlane::across(direction, body.centre);
        tried.extend(plane.map(|plane| (body.misfit(plane, &few, FAR), plane)));
    }
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    let many = body.spread(SAMPLES);
    let mut best: Option<Mirror> = None;
    for (k, (_, plane)) in tried.into_iter().take(REFINED).enumerate() {
        let share = |k: usize| 0.4 + 0.6 * k as f64 / REFINED as f64;
        let plane = body.refined(plane, &few, &mut Portion::new(monitor, share(k), share(k + 1)))?;
        let mirror = body.mirror(plane, &many);
        if best.is_none_or(|best| mirror.misfit < best.misfit) {
            best = Some(mirror);
        }
    }
    let Some(Mirror { plane, .. }) = best else { return Ok(None) };
    let plane = body.refined(plane, &many, &mut Portion::new(monitor, 1.0, 1.0))?;
    Ok(Some(body.mirror(plane, &many)))
}

/// The misfit of a given plane; `None` for a surface without area.
pub fn mirror_of(mesh: &SurfaceMesh, plane: MirrorPlane) -> Option<Mirror> {
    let body = Body::new(mesh)?;
    Some(body.mirror(plane, &body.spread(SAMPLES)))
}

/// Normals of the planes that are tried: the axes, since many bodies are aligned with them, and half of the vertices of a ball, which are
/// eight degrees apart.
fn directions() -> Vec<DVec3> {
    let ball = icosphere(2);
    let half = ball.positions().iter().copied().filter(|p| (p.z, p.y, p.x) > (0.0, 0.0, 0.0));
    [DVec3::X, DVec3::Y, DVec3::Z].into_iter().chain(half).collect()
}

/// A point of the surface.
#[derive(Clone, Copy)]
struct Sample {
    position: DVec3,
    normal: DVec3,
    face: FaceId,
}

/// A surface whose mirror is looked for.
struct Body<'a> {
    index: SurfaceIndex<'a>,
    centre: DVec3,
    /// The root of its area.
    size: f64,
}

impl<'a> Body<'a> {
    fn new(mesh: &'a SurfaceMesh) -> Option<Self> {
        let centre = mesh.centre()?;
        Some(Self { index: SurfaceIndex::new(mesh), centre, size: mesh.area().sqrt() })
    }

    /// Samples `count` points, each for an equal share of the area.
    fn spread(&self, count: usize) -> Vec<Sample> {
        let mesh = self.index.mesh();
        let share = self.size * self.size / count as f64;
        let mut random = SplitMix::new(1);
        let (mut samples, mut before) = (Vec::with_capacity(count), 0.0);
        for face in mesh.faces() {
            let [a, b, c] = mesh.corners(face);
            let normal = (b - a).cross(c - a);
            let until = before + 0.5 * normal.length();
            while samples.len() < count && (samples.len() as f64 + 0.5) * share < until {
                // Uniform on the triangle (Osada et al. 2002).
                let root = random.unit().sqrt();
                let along = random.unit();
                let position = a * (1.0 - root) + (b * (1.0 - along) + c * along) * root;
                samples.push(Sample { position, normal: normal.normalize_or_zero(), face });
            }
            before = until;
        }
        samples
    }

    /// The point of the surface nearest to the mirror image of a sample, of those that face the same way; the search begins at `near`.
    fn image(&self, plane: MirrorPlane, sample: &Sample, near: FaceId) -> Nearest {
        self.index.nearest_facing(plane.reflected(sample.position), plane.turned(sample.normal), near)
    }

    /// Mean distance of the samples' mirror images from the surface, in units of the size; none counts more than `most`.
    fn misfit(&self, plane: MirrorPlane, samples: &[Sample], most: f64) -> f64 {
        let distance =
            |sample: &Sample| min(self.image(plane, sample, sample.face).distance / self.size, most);
        samples.iter().map(distance).sum::<f64>() / max(samples.len() as f64, 1.0)
    }

    /// A plane with its misfit.
    fn mirror(&self, plane: MirrorPlane, samples: &[Sample]) -> Mirror {
        let heights = samples.iter().map(|sample| plane.height(sample.position).abs() / self.size);
        let reach = heights.sum::<f64>() / max(samples.len() as f64, 1.0);
        Mirror { plane, misfit: self.misfit(plane, samples, f64::INFINITY), reach }
    }

    /// Refines a plane to one of least misfit near it.
    fn refined(
        &self,
        mut plane: MirrorPlane,
        samples: &[Sample],
        monitor: &mut dyn Monitor,
    ) -> Result<MirrorPlane, Cancelled> {
        let mut near: Vec<FaceId> = samples.iter().map(|sample| sample.face).collect();
        for k in 0..MOST_STEPS {
            monitor.step(Step { fraction: k as f64 / MOST_STEPS as f64, residual: None })?;
            let images: Vec<Nearest> =
                samples.iter().zip(&near).map(|(sample, &near)| self.image(plane, sample, near)).collect();
            near.iter_mut().zip(&images).for_each(|(near, image)| *near = image.point.face);
            let Some((next, length)) = self.step(plane, samples, &images) else { break };
            plane = next;
            if length < STILL {
                break;
            }
        }
        Ok(plane)
    }

    /// The plane after a Gauss-Newton step, and the length of the step; `None` where there is none.
    ///
    /// The image of p is p' = p - 2 h n with the height h = n (p - c) - s above the plane, c the centre. The normal turns to n + x u + y v,
    /// u and v across it, and the plane is shifted by z: then p' moves by -2 (u (p - c) n + h u) x, likewise for y, and by 2 n z.
    fn step(&self, plane: MirrorPlane, samples: &[Sample], images: &[Nearest]) -> Option<(MirrorPlane, f64)> {
        let normal = plane.normal();
        let (u, v) = normal.any_orthonormal_pair();
        let knee = self.knee(images);
        let (mut matrix, mut right) = (DMat3::ZERO, DVec3::ZERO);
        for (sample, image) in samples.iter().zip(images) {
            let tangent = self.index.normal(image.point);
            let foot = image.point.position(self.index.mesh());
            let (p, height) =
                ((sample.position - self.centre) / self.size, plane.height(sample.position) / self.size);
            let off = tangent.dot(plane.reflected(sample.position) - foot) / self.size;
            let turn = |w: DVec3| -2.0 * tangent.dot(w.dot(p) * normal + height * w);
            let row = DVec3::new(turn(u), turn(v), 2.0 * tangent.dot(normal));
            let weight = weight(image.distance / self.size, knee);
            matrix += outer(row, row) * weight;
            right -= row * (weight * off);
        }
        // The planes of a body of revolution may turn about its axis: without damping the matrix would be singular.
        let damping = 1e-9 * (matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z);
        let damped = matrix + DMat3::from_diagonal(DVec3::splat(damping));
        let step = (damped.inverse() * right).clamp_length_max(LARGEST_STEP);
        if !step.is_finite() {
            return None;
        }
        let shift = (step.z - plane.height(self.centre) / self.size) * self.size;
        let turned = (normal + step.x * u + step.y * v).try_normalize()?;
        Some((MirrorPlane::across(turned, self.centre + shift * turned)?, step.length()))
    }

    /// The distance at which weights begin to fall, in units of the size: one and a half times the median.
    fn knee(&self, images: &[Nearest]) -> f64 {
        let mut distances: Vec<f64> = images.iter().map(|image| image.distance / self.size).collect();
        distances.sort_by(f64::total_cmp);
        max(1.5 * distances.get(distances.len() / 2).copied().unwrap_or(0.0), NOISE)
    }
}

/// The weight of a point at a distance from the surface (Geman & McClure 1987).
fn weight(distance: f64, knee: f64) -> f64 {
    let ratio = distance / knee;
    let fall = 1.0 / (1.0 + ratio * ratio);
    fall * fall
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo;
    use crate::math::rigid3::small_turn;
    use crate::mesh::VertexId;
    use crate::monitor::Silent;

    fn best(mesh: &SurfaceMesh) -> Mirror {
        best_mirror(mesh, &mut Silent).unwrap().unwrap()
    }

    /// The demo's cat, symmetric in z, in any place and size.
    fn placed(turn: DMat3, size: f64, shift: DVec3) -> (SurfaceMesh, MirrorPlane) {
        let cat = demo::build("horse-cat").unwrap().target;
        let place = |p: DVec3| turn * p * size + shift;
        let known = MirrorPlane::across(turn * DVec3::Z, place(DVec3::ZERO)).unwrap();
        (cat.with_positions(cat.positions().iter().map(|&p| place(p)).collect()), known)
    }

    /// The difference of two planes: the sine of the angle between them, plus the difference of their distances from the middle of the
    /// surface, in units of the root of the area.
    fn apart(mesh: &SurfaceMesh, a: MirrorPlane, b: MirrorPlane) -> f64 {
        let middle = mesh.centre().unwrap();
        let shift = (a.height(middle).abs() - b.height(middle).abs()).abs() / mesh.area().sqrt();
        a.normal().cross(b.normal()).length() + shift
    }

    fn turns() -> [DMat3; 3] {
        [DVec3::ZERO, DVec3::new(0.4, -1.1, 0.3), DVec3::new(-1.3, 0.7, 0.9)].map(small_turn)
    }

    #[test]
    fn a_symmetric_body_gives_back_its_plane_wherever_it_stands() {
        for (turn, size) in turns().into_iter().zip([1.0, 40.0, 0.01]) {
            let (mesh, known) = placed(turn, size, DVec3::new(3.0, -7.0, 0.2) * size);
            let found = best(&mesh);
            assert!(found.fits() && found.misfit < 1e-3, "{found:?}");
            assert!(apart(&mesh, found.plane, known) < 1e-3, "{found:?} {known:?}");
            assert_eq!(found, best(&mesh));
        }
    }

    #[test]
    fn noise_moves_the_plane_by_less_than_itself() {
        let (mesh, known) = placed(turns()[1], 1.0, DVec3::ZERO);
        let (mut random, noise) = (SplitMix::new(9), 0.004 * mesh.area().sqrt());
        let shaken = |p: &DVec3| *p + noise * DVec3::from_array([0; 3].map(|_| 2.0 * random.unit() - 1.0));
        let rough = mesh.with_positions(mesh.positions().iter().map(shaken).collect());
        let found = best(&rough);
        assert!(found.fits() && found.misfit < 0.004, "{found:?}");
        assert!(apart(&mesh, found.plane, known) < 0.004, "{found:?} {known:?}");
    }

    #[test]
    fn a_bent_limb_does_not_tilt_the_plane_of_the_trunk() {
        // One galloping leg differs from the other.
        let horse = demo::build("horse-gallop").unwrap().target;
        let found = best(&horse);
        assert!(found.fits() && found.misfit > 0.005);
        assert!(found.plane.normal().cross(DVec3::Z).length() < 0.01, "{found:?}");
    }

    #[test]
    fn hands_and_bodies_bent_to_one_side_have_none() {
        let hands = demo::build("hands").unwrap();
        let bent = demo::build("horse-turning").unwrap().target;
        for mesh in [&hands.source, &hands.target, &bent] {
            let found = best(mesh);
            assert!(!found.fits(), "{found:?}");
            // What is said of a plane that somebody gives is what the search says of it.
            assert_eq!(mirror_of(mesh, found.plane), Some(found));
        }
    }

    #[test]
    fn head_and_tail_are_no_mirror_images() {
        let horse = demo::build("horse-cat").unwrap().source;
        let across =
            |axis| mirror_of(&horse, MirrorPlane::across(axis, horse.centre().unwrap()).unwrap()).unwrap();
        assert!(across(DVec3::Z).fits());
        assert!(!across(DVec3::X).fits() && !across(DVec3::Y).fits());
    }

    #[test]
    fn a_ball_has_one_of_its_planes_and_a_point_has_none() {
        let ball = icosphere(3);
        let found = best(&ball);
        assert!(found.fits() && found.misfit < 1e-3 && found.plane.height(DVec3::ZERO).abs() < 1e-3);
        let point = ball.with_positions(ball.vertices().map(|_: VertexId| DVec3::ONE).collect());
        assert_eq!(best_mirror(&point, &mut Silent).unwrap(), None);
    }

    #[test]
    fn the_search_ends_when_it_is_told_to() {
        struct Steps(usize);
        impl Monitor for Steps {
            fn step(&mut self, _: Step) -> Result<(), Cancelled> {
                self.0 = self.0.checked_sub(1).ok_or(Cancelled)?;
                Ok(())
            }
        }
        // While directions are tried, and while planes are refined.
        for steps in [10, 88] {
            assert_eq!(best_mirror(&icosphere(3), &mut Steps(steps)), Err(Cancelled));
        }
    }
}
