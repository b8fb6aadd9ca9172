//! Rigid registration of small patches of one surface to the other, for two poses of one body.
//!
//! An energy depends on lengths only, and between two poses the known map has not the least one. But most of the surface moves
//! rigidly: a patch of it fits its true image exactly, and no place beside it, as far as its relief (muscles, bones) shows. So patches
//! are registered to the other surface by rigid motions, starting from their images under the map ([`super::patch_fit`]). The place
//! of the patch's centre becomes a soft constraint of the vertex there ([`PointConstraint`]), in each direction as strong as relief
//! holds the patch. Patches that bend fit badly: with the mean square distance m a patch has the weight
//! (noise^2 / (noise^2 + m))^2. The patches are registered again after the map has followed. Those of full meshes that are not small may
//! bend a little ([`FullPatches`]).

use super::patch_fit::{FitOptions, Fitter, Nearest, OrientedSurface, PatchFit, PatchPoint};
use crate::math::scalar::max;
use crate::mesh::coarsening::Level;
use crate::mesh::face_weights::FaceWeights;
use crate::mesh::neighbours::Neighbours;
use crate::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use crate::surface_map::energy::point_constraint::PointConstraint;
use glam::{DMat2, DVec2, DVec3};
use nalgebra::Matrix2;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// Options of the registration of patches; lengths in units of the root of the area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidPatchOptions {
    /// Least number of vertices of a level on which patches are registered: coarser levels have no relief.
    pub least_vertices: usize,
    /// Registrations on every such level, each followed by a relaxation.
    pub rounds: usize,
    /// Registrations on full meshes, which begin near their optimum.
    pub full_rounds: usize,
    /// Patches of full meshes where neither is small.
    pub full: FullPatches,
    /// What is asked of patches on small full meshes before a map is settled by them.
    pub small: SmallMeshes,
    /// Distance between neighbouring points of the patches.
    pub spacing: f64,
    /// Radii of the patches around every point.
    pub radii: [f64; 2],
    /// Options of the registration of one patch.
    pub fit: FitOptions,
    /// Strength of the constraints: the energy, per unit of area, of a vertex whose distance from its fitted place is the shift that
    /// raises the mean square distance of its patch by noise^2.
    pub strength: f64,
    /// Energy, per unit of area, above which a constraint grows like the distance, not like its square.
    pub knee: f64,
    /// Share of their strength, 0 to 1, with which constraints hold the vertices of the full meshes at the places that registration has
    /// found, while the dents that the constraints have made relax.
    pub hold: f64,
}

/// Patches of full meshes: the map begins near the truth there, so that small ones that may bend do not leave it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FullPatches {
    /// Radii of the patches around every point.
    pub radii: [f64; 2],
    /// How stiff they are ([`FitOptions::stiffness`]).
    pub stiffness: f64,
}

/// What is asked of patches where one of the full meshes has few vertices: relief is crude there. Between two people, and on bodies without
/// relief, patches lead away from the known map then, between two poses of one body towards it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallMeshes {
    /// Number of vertices from which on a full mesh is not small.
    pub below: usize,
    /// How well the patches of each mesh fit the other, at least ([`Registered::fit`]): .14 to .67 between poses on meshes of 3,000 to 4,500
    /// vertices, .03 to .11 between two people.
    pub least_fit: f64,
    /// The mean log density of the map settled by patches relative to that of the map settled without them, at most: up to 1.49 between poses,
    /// 1.64 to 2.7 on a demo's figures without relief.
    pub most_strain: f64,
}

impl Default for RigidPatchOptions {
    fn default() -> Self {
        Self {
            // Where the true stretch of cat-cat1 is below 2 %, a rigid fit of patches of radius 0.08 has a median error of 0.1 %
            // of the root of the area. Spacing, noise, knee, hold and the rounds on the full meshes were tried on three pairs of
            // poses whose targets were remeshed (see docs/experiments.md), the patches of full meshes on these and as they are; the
            // others were chosen by hand, not measured at half and double.
            least_vertices: 1000,
            rounds: 2,
            full_rounds: 1,
            full: FullPatches { radii: [0.04, 0.07], stiffness: 1e-9 },
            small: SmallMeshes { below: 6000, least_fit: 0.12, most_strain: 1.6 },
            spacing: 0.014,
            radii: [0.05, 0.08],
            fit: FitOptions { max_steps: 5, damping: 5e-5, noise: 4e-4, stiffness: None },
            strength: 20.0,
            knee: 0.2,
            hold: 0.1,
        }
    }
}

impl RigidPatchOptions {
    /// The options on full meshes where neither is small.
    #[must_use]
    pub fn on_full(&self) -> Self {
        let fit = FitOptions { stiffness: Some(self.full.stiffness), ..self.fit };
        Self { radii: self.full.radii, fit, ..*self }
    }
}

/// Patches that were registered.
pub struct Registered {
    /// Constraints that draw vertices of the level to the places at which the patches around them fit.
    pub constraints: Vec<(VertexId, PointConstraint)>,
    /// How well the patches fit, from 0 to 1: the mean of noise^2 / (noise^2 + m) over the area and both radii, with the mean square
    /// distance m of a patch and the noise of the options; 0 for patches that were not fitted.
    pub fit: f64,
}

/// Points of a patch, at least: twice the six unknowns of a rigid motion.
const LEAST_POINTS: usize = 12;

/// Largest distance of a patch's fitted centre from its image by the map, in units of the root of the area: about the radius of a
/// patch. Chosen by hand.
const FARTHEST: f64 = 0.06;

/// A level with the weights of its faces.
#[derive(Clone, Copy)]
pub struct WeightedLevel<'a> {
    /// The level.
    pub level: &'a Level,
    /// The weights of its faces.
    pub weights: FaceWeights<'a>,
}

/// A level of one mesh with the images of its vertices on the other.
pub struct MappedLevel<'a> {
    /// The level.
    pub mesh: &'a SurfaceMesh,
    /// The full mesh's vertex of each vertex.
    pub vertices: &'a TiSlice<VertexId, VertexId>,
    /// The image of each vertex on the other mesh.
    pub images: TiVec<VertexId, DVec3>,
    /// For each vertex a vertex of the other full mesh near its image.
    pub near: TiVec<VertexId, VertexId>,
    /// Whether each vertex and its image are on skin: caps have no relief.
    pub is_on_skin: TiVec<VertexId, bool>,
}

impl<'a> MappedLevel<'a> {
    /// A level with its vertices' images, given as points of the other mesh's level.
    pub fn new(
        own: WeightedLevel<'a>,
        onto: WeightedLevel<'_>,
        points: impl Iterator<Item = SurfacePoint>,
    ) -> Self {
        let (Level { mesh, vertices, .. }, other) = (own.level, onto.level);
        let is_on_skin = mesh.vertices().map(|v| own.weights.is_on_skin(mesh, v)).collect();
        let mut level = Self { mesh, vertices, images: TiVec::new(), near: TiVec::new(), is_on_skin };
        for (v, point) in mesh.vertices().zip(points) {
            level.is_on_skin[v] &= onto.weights.is_skin(point.face);
            level.images.push(point.position(&other.mesh));
            level.near.push(other.vertices[point.heaviest_corner(&other.mesh)]);
        }
        level
    }
}

/// Patches between two questions to the monitor: some milliseconds.
pub(super) const ASKED_EVERY: usize = 64;

/// Registers patches around the vertices of a level to the other surface. Both areas are 1.
///
/// # Errors
/// [`Cancelled`].
pub fn register(
    [own, onto]: [&OrientedSurface<'_>; 2],
    level: &MappedLevel<'_>,
    options: &RigidPatchOptions,
    monitor: &mut dyn Monitor,
) -> Result<Registered, Cancelled> {
    monitor.step(Step::default())?;
    // Constraints of full meshes hold to the end, so they must not claim more than a coarse mesh tells.
    let is_full = level.vertices.len() == own.normals.len();
    let noise = if is_full { max(options.fit.noise, onto.roughness()) } else { options.fit.noise };
    let fit_options = &FitOptions { noise, ..options.fit };
    let weights = spread(own, level, options.spacing);
    let mut patches = Patches::new([own, onto], level, &weights);
    let (mut fitter, mut patch) = (Fitter::default(), Vec::new());
    let mut constraints = Vec::new();
    let (mut fitted, mut all) = (0.0, 0.0);
    for (k, v) in level.mesh.vertices().filter(|&v| weights[v] > 0.0).enumerate() {
        if k.is_multiple_of(ASKED_EVERY) {
            monitor.step(Step::default())?;
        }
        let mut sum = SummedFit::new(onto.normals[patches.near[v].vertex]);
        for radius in options.radii {
            patches.around(v, radius, &mut patch);
            all += weights[v];
            if let Some(fit) = fitted_near(&mut fitter, &patch, onto, fit_options) {
                sum.add(&fit, level.images[v], noise);
                fitted += weights[v] * trust(&fit, options.fit.noise);
            }
        }
        constraints
            .extend(sum.constraint(level.images[v], weights[v], options).map(|constraint| (v, constraint)));
    }
    Ok(Registered { constraints, fit: if all > 0.0 { fitted / all } else { 0.0 } })
}

/// The registration of a patch; `None` where it has too few points, no fit, or none near the image of its centre.
pub(super) fn fitted_near(
    fitter: &mut Fitter,
    patch: &[PatchPoint],
    onto: &OrientedSurface<'_>,
    options: &FitOptions,
) -> Option<PatchFit> {
    if patch.len() < LEAST_POINTS {
        return None;
    }
    let image = patch[0].image;
    fitter.fit(patch, onto, options).filter(|fit| fit.centre.distance(image) < FARTHEST)
}

/// How well a patch fits, from 0 to 1.
pub(super) fn trust(fit: &PatchFit, noise: f64) -> f64 {
    let square = noise * noise;
    square / (square + fit.misfit)
}

/// Samples vertices about `spacing` apart, or as far as the level's are; returns the area that each one stands for, 0 for vertices that
/// are not taken and for those on caps. One vertex is taken of each cell of a grid and each main direction of the normal.
pub(super) fn spread(
    own: &OrientedSurface<'_>,
    level: &MappedLevel<'_>,
    spacing: f64,
) -> TiVec<VertexId, f64> {
    let areas = level.mesh.vertex_areas();
    let cell = |v: VertexId| {
        let at = (level.mesh.positions()[v] / spacing).floor();
        let normal = own.normals[level.vertices[v]];
        let main = normal.abs().max_position();
        let direction = 2 * main + usize::from(normal[main] > 0.0);
        (at.to_array().map(|c| c as i64), direction, v)
    };
    let on_skin = level.mesh.vertices().filter(|&v| level.is_on_skin[v]);
    let mut cells: Vec<_> = on_skin.map(cell).collect();
    cells.sort_unstable();
    let mut weights: TiVec<VertexId, f64> = ti_vec![0.0; areas.len()];
    for group in cells.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        weights[group[0].2] = group.iter().map(|c| areas[c.2]).sum();
    }
    weights
}

/// The patches of one mesh.
pub(super) struct Patches<'a> {
    own: &'a OrientedSurface<'a>,
    level: &'a MappedLevel<'a>,
    neighbours: Neighbours,
    weights: &'a TiSlice<VertexId, f64>,
    /// For each vertex the vertex of the other full mesh that is nearest to its image.
    near: TiVec<VertexId, Nearest>,
    /// The centre of the last patch that reached a vertex, with its radius.
    reached: TiVec<VertexId, Option<(VertexId, u64)>>,
}

impl<'a> Patches<'a> {
    pub(super) fn new(
        [own, onto]: [&'a OrientedSurface<'a>; 2],
        level: &'a MappedLevel<'a>,
        weights: &'a TiSlice<VertexId, f64>,
    ) -> Self {
        // Every vertex is in many patches, which all start from here.
        let near = level.mesh.vertices().map(|v| onto.nearest(level.near[v], level.images[v])).collect();
        let neighbours = Neighbours::new(level.mesh);
        Self { own, level, neighbours, weights, near, reached: ti_vec![None; weights.len()] }
    }

    /// Fills `patch` with the points connected to `centre` within the radius, the centre first. Points whose images are far
    /// away or that face the other way are left out.
    pub(super) fn around(&mut self, centre: VertexId, radius: f64, patch: &mut Vec<PatchPoint>) {
        let Self { own, level, weights, .. } = *self;
        let positions = level.mesh.positions();
        let distance = |v: VertexId| positions[v].distance(positions[centre]);
        let mark = Some((centre, radius.to_bits()));
        let mut queue = vec![centre];
        self.reached[centre] = mark;
        let normal = own.normals[level.vertices[centre]];
        let mut next = 0;
        patch.clear();
        while let Some(&v) = queue.get(next) {
            next += 1;
            let own_normal = own.normals[level.vertices[v]];
            // A map of two poses stretches little: farther images lie across a fold, like normals more than 107 degrees apart.
            let near = level.images[v].distance(level.images[centre]) < 1.6 * radius;
            if weights[v] > 0.0 && near && own_normal.dot(normal) > -0.3 {
                let share = distance(v) / radius;
                let fading = (1.0 - share * share) * (1.0 - share * share);
                patch.push(PatchPoint {
                    position: positions[v],
                    normal: own_normal,
                    weight: weights[v] * fading,
                    image: level.images[v],
                    near: self.near[v],
                });
            }
            for &w in self.neighbours.of(v) {
                if self.reached[w] != mark && distance(w) < radius {
                    self.reached[w] = mark;
                    queue.push(w);
                }
            }
        }
    }
}

/// The sum of several patches' fits around one centre: a quadratic form of the centre's place in a tangent plane.
struct SummedFit {
    frame: [DVec3; 2],
    form: DMat2,
    slope: DVec2,
}

impl SummedFit {
    fn new(normal: DVec3) -> Self {
        let first = normal.any_orthonormal_vector();
        Self { frame: [first, normal.cross(first)], form: DMat2::ZERO, slope: DVec2::ZERO }
    }

    fn in_plane(&self, d: DVec3) -> DVec2 {
        DVec2::from(self.frame.map(|axis| axis.dot(d)))
    }

    fn add(&mut self, fit: &PatchFit, image: DVec3, noise: f64) {
        let trust = trust(fit, noise);
        let column = |axis: DVec3| self.in_plane(fit.hold * axis) * (trust * trust / (noise * noise));
        let form = DMat2::from_cols(column(self.frame[0]), column(self.frame[1]));
        self.slope += form * self.in_plane(fit.centre - image);
        self.form += form;
    }

    /// The constraint; `None` where no patch has a fit.
    fn constraint(&self, image: DVec3, area: f64, options: &RigidPatchOptions) -> Option<PointConstraint> {
        let [first, second] = self.frame;
        let factor = Matrix2::from(self.form).cholesky()?;
        let shift = factor.solve(&self.slope.into());
        let rows = factor.l() * (options.strength * area).sqrt();
        Some(PointConstraint {
            place: image + first * shift.x + second * shift.y,
            rows: [first * rows.m11 + second * rows.m21, second * rows.m22],
            knee: options.knee * area,
        })
    }
}

/// A surface with relief, and maps of it onto itself.
#[cfg(test)]
pub(super) mod testing {
    use super::*;
    use crate::math::scalar::{cos, sin};
    use crate::mesh::generators::icosphere;
    use glam::DQuat;

    /// A ball with hills, of area near 1.
    pub(in super::super) fn hilly() -> SurfaceMesh {
        let ball = icosphere(4);
        let hill =
            |p: &DVec3| *p * 0.28 * (1.0 + 0.03 * sin(11.0 * p.x) * cos(9.0 * p.y) + 0.03 * sin(10.0 * p.z));
        ball.with_positions(ball.positions().iter().map(hill).collect())
    }

    /// All vertices, each with its place turned by this as its image.
    pub(in super::super) fn turned<'a>(
        mesh: &'a SurfaceMesh,
        all: &'a TiSlice<VertexId, VertexId>,
        surface: &OrientedSurface<'_>,
        turn: DQuat,
    ) -> MappedLevel<'a> {
        let images: TiVec<VertexId, DVec3> = mesh.positions().iter().map(|&p| turn * p).collect();
        let near = images.iter_enumerated().map(|(v, p)| surface.nearest(v, *p).vertex).collect();
        let is_on_skin = ti_vec![true; all.len()];
        MappedLevel { mesh, vertices: all, images, near, is_on_skin }
    }
}

#[cfg(test)]
mod tests {
    use super::testing::{hilly, turned};
    use super::*;
    use crate::monitor::Silent;
    use glam::DQuat;

    /// All vertices, with images turned by a small angle about z.
    fn slid<'a>(
        mesh: &'a SurfaceMesh,
        all: &'a TiSlice<VertexId, VertexId>,
        surface: &OrientedSurface<'_>,
    ) -> MappedLevel<'a> {
        turned(mesh, all, surface, DQuat::from_rotation_z(0.02))
    }

    #[test]
    fn points_stand_for_the_whole_area() {
        let mesh = hilly();
        let all: TiVec<VertexId, VertexId> = mesh.vertices().collect();
        let surface = OrientedSurface::new(&mesh);
        let weights = spread(&surface, &slid(&mesh, &all, &surface), 0.04);
        assert!((weights.iter().sum::<f64>() - mesh.area()).abs() < 1e-12);
        let taken = weights.iter().filter(|w| **w > 0.0).count();
        assert!(taken > 300 && taken < 1500, "{taken}");
    }

    #[test]
    fn relief_draws_vertices_back_to_where_they_belong() {
        let mesh = hilly();
        let all: TiVec<VertexId, VertexId> = mesh.vertices().collect();
        let surface = OrientedSurface::new(&mesh);
        let level = slid(&mesh, &all, &surface);
        let options = RigidPatchOptions::default();
        let Registered { constraints: found, fit } =
            register([&surface, &surface], &level, &options, &mut Silent).unwrap();
        assert!(fit > 0.9, "{fit}");
        assert!(found.len() > 500, "{}", found.len());
        let mut errors: Vec<[f64; 2]> = found
            .iter()
            .map(|(v, constraint)| {
                let truth = mesh.positions()[*v];
                [constraint.place.distance(truth), level.images[*v].distance(truth)]
            })
            .collect();
        let mean = |k: usize| errors.iter().map(|e| e[k]).sum::<f64>() / errors.len() as f64;
        let means = [mean(0), mean(1)];
        errors.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert!(means[0] < 0.4 * means[1], "{means:?}");
        assert!(errors[errors.len() / 2][0] < 0.2 * means[1], "{means:?} {:?}", errors[errors.len() / 2]);
    }

    #[test]
    fn a_pull_knows_what_the_fits_know() {
        let mut sum = SummedFit::new(DVec3::Z);
        let hold = glam::DMat3::from_diagonal(DVec3::new(0.1, 0.02, 0.7));
        let centre = DVec3::new(0.01, 0.02, 0.0);
        sum.add(&PatchFit { centre, misfit: 0.0, hold }, DVec3::ZERO, 1e-3);
        let constraint = sum
            .constraint(DVec3::ZERO, 0.5, &RigidPatchOptions { strength: 2.0, ..Default::default() })
            .unwrap();
        assert!(constraint.place.distance(centre) < 1e-12);
        for (axis, held) in [(DVec3::X, 0.1), (DVec3::Y, 0.02), (DVec3::Z, 0.0)] {
            let square: f64 = constraint.rows.iter().map(|row| row.dot(axis) * row.dot(axis)).sum();
            assert!((square - held * 1e6).abs() < 1e-3, "{square}");
        }
        assert!(
            SummedFit::new(DVec3::Z).constraint(DVec3::ZERO, 1.0, &RigidPatchOptions::default()).is_none()
        );
    }
}
