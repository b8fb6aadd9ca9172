//! The map of two coarse meshes, refined to the full meshes.
//!
//! The base domain is drawn on coarse levels of both meshes, where everything costs milliseconds. Their parametrisations are
//! relaxed, the points that the drawing added are removed again, and the vertices of the full meshes are restored level by
//! level, while the energy of the map itself is lowered on every level. So the full meshes start near the optimum, and are
//! never cut along the drawing.

use super::landmarked_mesh::LandmarkedMesh;
use super::layout_points::{PatchedParametrisation, without_layout_points};
use super::mesh_with_coarse::MeshWithCoarse;
use super::options::MultilevelOptions;
use super::rim_draws::{BorderLine, RimDrawOptions, border_lines, draws};
use super::skin::Skin;
use crate::landmarks::{LandmarkId, MeshSide};
use crate::layout::{BaseLayout, PatchedMesh};
use crate::mesh::coarsening::Level;
use crate::mesh::face_weights::{FaceWeight, FaceWeights};
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, OrStop, Portion, Silent, Step, unless_stopped};
use crate::registration::patch_fit::OrientedSurface;
use crate::registration::rigid_patches::{self, MappedLevel, RigidPatchOptions, SmallMeshes, WeightedLevel};
use crate::surface_map::MapError;
use crate::surface_map::energy::map_energy::MapEnergy;
use crate::surface_map::energy::point_constraint::PointConstraint;
use crate::surface_map::overlay::base_lines::mend_anchors;
use crate::surface_map::overlay::location::{Location, barycentric, locate};
use crate::surface_map::overlay::overlay;
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::{Embedding, Parametrised};
use crate::surface_map::parametrisation::initial::{self, InitialOptions};
use crate::surface_map::parametrisation::level::{ParametrisedLevel, Placing, Snapshot};
use crate::surface_map::relaxation::dent_energy::DentEnergy;
use crate::surface_map::relaxation::dents::{self, DentOptions};
use crate::surface_map::relaxation::map_relaxation::{self, MapRelaxationOptions, Relaxed};
use glam::DVec3;
use std::sync::Arc;
use typed_index_collections::TiVec;

/// A map of two coarse levels: both with their parametrisations onto one cone surface.
#[derive(Clone)]
pub struct CoarseMap<'a> {
    /// The cone surface of its layout.
    pub surface: Arc<ConeSurface>,
    levels: [ParametrisedLevel<'a>; 2],
    /// Half the sum of the means over both coarse levels of the logarithm of the distortion density; 0 for an isometry.
    pub mean_log: f64,
    /// Median distortion of both coarse levels by area; 1 for an isometry.
    pub median: f64,
    /// The areas, on the source's and on the target's level, of the pieces that are skin on both.
    skin_areas: [f64; 2],
    /// The energy that is lowered on finer levels.
    energy: MapEnergy,
    /// How well patches of each mesh fitted the other when they were registered last, from 0 to 1; 1 where they never were.
    patch_fit: [f64; 2],
    /// The constrained vertices of each full mesh, the source first, each vertex with its place on the other mesh.
    constraints: [Vec<(VertexId, PointConstraint)>; 2],
    full: [&'a SurfaceMesh; 2],
    /// Where vertices of each mesh are put when they return.
    placing: [Placing; 2],
    skins: [Option<&'a Skin<'a>>; 2],
}

/// A scale that is off by less than this is kept: 1 % moves the rim of a patch that is registered rigidly by less than the noise that
/// the fit allows for. Chosen by hand.
const RIGHT_SCALE: f64 = 0.01;

/// Patches of two poses of one body, and of two people, fit better than this where they are registered first, on levels of about 1,000
/// vertices: .21 on a cat and two horses, .06 to .11 on people in two poses, .03 to .10 on two people but on one of them (.026), of whom the map
/// then comes nearer to the truth as well. Those of a cat and a lion have .018 to .025 on one of both sides.
const ONE_BODY: f64 = 0.028;

/// Makes the map of two coarse levels from a layout drawn on them, and relaxes it by `options.judge`.
///
/// # Errors
/// [`MapError::NoStart`], [`MapError::LayoutPoints`]: another layout or a finer level may help.
pub fn solve_coarse<'a>(
    meshes: &'a [MeshWithCoarse<'a>; 2],
    layout: &BaseLayout,
    options: &MultilevelOptions,
    monitor: &mut dyn Monitor,
) -> Result<CoarseMap<'a>, MapError> {
    let surface = Arc::new(ConeSurface::of_layout(layout));
    let levels = parametrised_levels(meshes, layout, &surface, options, monitor)?;
    let mut map = CoarseMap {
        surface,
        levels,
        mean_log: f64::INFINITY,
        median: f64::INFINITY,
        skin_areas: [1.0; 2],
        energy: options.fine.energy,
        patch_fit: [1.0; 2],
        constraints: Default::default(),
        full: [meshes[0].full, meshes[1].full],
        placing: [meshes[0].placing, meshes[1].placing],
        skins: [meshes[0].skin.as_ref(), meshes[1].skin.as_ref()],
    };
    map.relax(&options.judge, monitor)?;
    Ok(map)
}

/// Parametrises both coarse levels over the cone surface of a layout, each relaxed by itself, without the points that the layout added.
///
/// # Errors
/// [`MapError::NoStart`], [`MapError::LayoutPoints`].
pub(super) fn parametrised_levels<'a>(
    meshes: &'a [MeshWithCoarse<'a>; 2],
    layout: &BaseLayout,
    surface: &Arc<ConeSurface>,
    options: &MultilevelOptions,
    monitor: &mut dyn Monitor,
) -> Result<[ParametrisedLevel<'a>; 2], MapError> {
    let mut level = |mesh: &'a MeshWithCoarse<'a>, patched: &PatchedMesh| {
        let (start, _) = initial::embed(patched, surface, &options.initial, monitor)?;
        let (relaxed, _) = initial::relax(patched.parametrised(&start), surface, &options.relax, monitor)?;
        let parametrisation = PatchedParametrisation { surface, embedding: &relaxed };
        without_layout_points(mesh, patched, parametrisation, &options.relax, monitor)
    };
    Ok([level(&meshes[0], &layout.source)?, level(&meshes[1], &layout.target)?])
}

impl CoarseMap<'_> {
    /// Relaxes the chosen coarse map, and again by [`MapEnergy::POSES`] where it is between two poses of one body: where it distorts little, and
    /// costs little E that way.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    pub fn finish(&mut self, options: &MultilevelOptions, monitor: &mut dyn Monitor) -> Result<(), MapError> {
        let energy = self.relax(&options.coarse, &mut Portion::new(monitor, 0.0, 0.5))?;
        if self.median < options.pose_median && self.mean_log < options.pose_mean_log {
            let as_two_bodies = self.clone();
            self.energy = MapEnergy::POSES;
            let poses = MapRelaxationOptions { energy: self.energy, ..options.coarse };
            let energy_as_poses = self.relax(&poses, &mut Portion::new(monitor, 0.5, 1.0))?;
            if energy_as_poses > options.pose_cost * energy {
                *self = as_two_bodies;
            }
        }
        Ok(())
    }

    /// Whether it is between two poses of one body, as [`Self::finish`] finds.
    pub fn is_of_poses(&self) -> bool {
        self.energy == MapEnergy::POSES
    }

    /// Whether it is between two poses of one body, or of two as alike as people are, as far as patches that were registered tell.
    pub fn is_of_one_body(&self) -> bool {
        self.is_of_poses() && self.patch_fit.iter().all(|fit| *fit >= ONE_BODY)
    }

    /// The factor by which to scale the target so that the skin that both meshes share has the same area on both; `None` where no mesh
    /// has caps, or where the factor is within 1 % of 1.
    ///
    /// Both meshes are scaled to area 1 with their caps. So a mesh of which more is missing than of the other is too large. The map of
    /// the shared skin tells the right scale, since the energy depends little on scale.
    pub fn better_scale(&self) -> Option<f64> {
        let [source, target] = self.skin_areas;
        let factor = (source / target).sqrt();
        let is_off = factor.is_finite() && (factor - 1.0).abs() > RIGHT_SCALE;
        (is_off && self.skins.iter().any(Option::is_some)).then_some(factor)
    }

    /// The present levels with the images of the source level's vertices; `None` where a vertex cannot be located on the target.
    pub fn images(&self) -> Option<LevelImages> {
        let present = self.present();
        let [source, target] = [0, 1].map(|k| present[k].parametrised());
        let locations = locate(source, target, &self.surface, &mut Silent).ok()?;
        let target_from_source =
            locations.by_vertex.iter().map(|at| barycentric(source, target, at)).collect();
        let [source, target] = present;
        let weights = [source.weights, target.weights];
        let landmarks = [source.landmarks, target.landmarks];
        Some(LevelImages { levels: [source.level, target.level], landmarks, weights, target_from_source })
    }

    /// The present level of a mesh with the images of its vertices; `None` where a vertex cannot be located.
    pub(super) fn placed(&self, of: MeshSide) -> Option<PlacedLevel<'_>> {
        let present = self.present();
        let [from, onto] = [of, of.other()].map(|side| present[side].parametrised());
        let locations = locate(from, onto, &self.surface, &mut Silent).ok()?;
        let image = |at: &Location| barycentric(from, onto, at).position(onto.mesh);
        let images = locations.by_vertex.iter().map(image).collect();
        let [source, target] = present;
        let level = match of {
            MeshSide::Source => source.level,
            MeshSide::Target => target.level,
        };
        Some(PlacedLevel { level, images, full: self.full[of], onto: self.full[of.other()] })
    }

    fn present(&self) -> [PresentLevel; 2] {
        [0, 1].map(|k| {
            let Snapshot { level, mut embedding } = self.levels[k].snapshot();
            let landmarks: TiVec<LandmarkId, VertexId> =
                level.numbers(&self.levels[k].landmark_vertices()).collect();
            mend_anchors(&mut embedding, &level.mesh, &landmarks, &self.surface);
            let weights = self.skins[k].map(|skin| skin.on_level(&level));
            PresentLevel { level, landmarks, embedding, weights }
        })
    }

    /// Lowers the energy of the map of the coarse levels and measures it. Returns E, 4 for an isometry, whichever energy was lowered.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    pub fn relax(
        &mut self,
        options: &MapRelaxationOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<f64, MapError> {
        let measure = |relaxed: &Relaxed<'_>| {
            (relaxed.mean_log(), relaxed.median(), relaxed.skin_areas(), relaxed.energy(MapEnergy::PLAIN))
        };
        let energy;
        (self.mean_log, self.median, self.skin_areas, energy) = self.lower(options, monitor, measure)?;
        Ok(energy)
    }

    /// Whether both present levels have at least this many vertices.
    fn have(&self, vertices: usize) -> bool {
        self.levels.iter().all(|level| level.mesh().live_vertices() >= vertices)
    }

    fn is_full(&self) -> bool {
        self.levels.iter().all(ParametrisedLevel::is_full)
    }

    /// Registers patches and lowers the energy with their constraints, `rounds` times; then the constraints hold the vertices where
    /// they are, since constraints to other places would dent the small triangles of finer levels.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    fn register_patches(
        &mut self,
        options: &RigidPatchOptions,
        rounds: usize,
        fine: &MapRelaxationOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<(), MapError> {
        let surfaces = self.full.map(OrientedSurface::new);
        let surfaces = [&surfaces[0], &surfaces[1]];
        for round in 0..rounds {
            if monitor.wants_result() {
                break;
            }
            let share = |round: usize| round as f64 / rounds as f64;
            let part = &mut Portion::new(monitor, share(round), share(round + 1));
            let mut fit = self.patch_fit;
            self.look(part, |side, seen, constraints, monitor| {
                let patches = &mut Portion::new(monitor, 0.0, 0.0);
                let surfaces = [side, side.other()].map(|side| surfaces[side]);
                let found = rigid_patches::register(surfaces, seen, options, patches)?;
                fit[side] = found.fit;
                let of_full = |(v, constraint)| (seen.vertices[v], constraint);
                *constraints = found.constraints.into_iter().map(of_full).collect();
                Ok(())
            })?;
            self.patch_fit = fit;
            if !self.is_of_one_body() {
                return Ok(());
            }
            // A few steps before patches are registered again. Chosen by hand, not measured at half and double.
            self.lower(&MapRelaxationOptions { max_rounds: 4, ..*fine }, part, |_| ())?;
        }
        self.look(monitor, |_, seen, constraints, _| {
            for (v, constraint) in constraints {
                if let Ok(v) = seen.vertices.binary_search(v) {
                    constraint.place = seen.images[v];
                }
            }
            Ok(())
        })?;
        Ok(())
    }

    /// Lowers the energy of the map of the present levels; between two poses of one body patches are registered, too.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    fn settle(
        &mut self,
        options: &MultilevelOptions,
        is_finest: bool,
        monitor: &mut dyn Monitor,
    ) -> Result<(), MapError> {
        let fine = &MapRelaxationOptions { energy: self.energy, ..options.fine };
        let patches = &options.rigid_patches;
        if self.energy != MapEnergy::POSES || !self.have(patches.least_vertices) {
            return self.settle_freely(fine, is_finest, monitor).map(|_| ());
        }
        if !is_finest {
            self.lower(fine, &mut Portion::new(monitor, 0.0, 0.5), |_| ())?;
            let part = &mut Portion::new(monitor, 0.5, 1.0);
            self.register_patches(patches, patches.rounds, fine, part)?;
            return if self.is_of_one_body() {
                Ok(())
            } else {
                self.settle_two_bodies(options, monitor).map(|_| ())
            };
        }
        if self.have(patches.small.below) {
            return self.settle_by_patches(&patches.on_full(), options, monitor).map(|_| ());
        }
        self.settle_small(options, monitor)
    }

    /// Settles the map of full meshes of which one is small by patches; without them where they fit badly or strain the map.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    fn settle_small(
        &mut self,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<(), MapError> {
        let fine = &MapRelaxationOptions { energy: self.energy, ..options.fine };
        let SmallMeshes { least_fit, most_strain, .. } = options.rigid_patches.small;
        let mut free = self.clone();
        let unstrained = free.settle_freely(fine, true, &mut Portion::new(monitor, 0.0, 0.4))?;
        let part = &mut Portion::new(monitor, 0.4, 1.0);
        let mean_log = self.settle_by_patches(&options.rigid_patches, options, part)?;
        if self.patch_fit.iter().any(|fit| *fit < least_fit) || mean_log > most_strain * unstrained {
            *self = free;
        }
        Ok(())
    }

    /// Lowers the energy of the map of the present levels, on the full meshes without constraints; returns the mean log density.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    fn settle_freely(
        &mut self,
        fine: &MapRelaxationOptions,
        is_finest: bool,
        monitor: &mut dyn Monitor,
    ) -> Result<f64, MapError> {
        if is_finest {
            // Constraints from coarser levels would dent the small triangles of the full meshes.
            self.constraints = Default::default();
        }
        self.lower(fine, monitor, |relaxed| relaxed.mean_log())
    }

    /// Registers patches of the full meshes and lowers the energy of the map with what is kept of their constraints; returns the mean log
    /// density.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    fn settle_by_patches(
        &mut self,
        patches: &RigidPatchOptions,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<f64, MapError> {
        let fine = &MapRelaxationOptions { energy: self.energy, ..options.fine };
        // Registered first: without the registration's pull the map of the full meshes drifts from the known map to the least energy.
        self.register_patches(patches, patches.full_rounds, fine, &mut Portion::new(monitor, 0.0, 0.5))?;
        if !self.is_of_one_body() {
            return self.settle_two_bodies(options, monitor);
        }
        for (_, constraint) in self.constraints.iter_mut().flatten() {
            constraint.rows = constraint.rows.map(|row| row * patches.hold.sqrt());
        }
        self.lower(fine, &mut Portion::new(monitor, 0.5, 1.0), |relaxed| relaxed.mean_log())
    }

    /// Lowers the energy of the map of the present levels, and from now on, as that of two bodies: they only seemed to be one. Returns the
    /// mean log density.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    fn settle_two_bodies(
        &mut self,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<f64, MapError> {
        self.energy = options.fine.energy;
        self.constraints = Default::default();
        self.lower(&options.fine, &mut Portion::new(monitor, 1.0, 1.0), |relaxed| relaxed.mean_log())
    }

    /// Lowers the energy of the present levels with constraints that draw corresponding rims to each other. Other constraints stay.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    fn draw_rims(
        &mut self,
        lines: &[Vec<BorderLine>; 2],
        options: &RimDrawOptions,
        fine: &MapRelaxationOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<(), MapError> {
        let fine = &MapRelaxationOptions { energy: self.energy, ..*fine };
        let held = self.constraints.clone();
        for round in 0..options.rounds {
            if monitor.wants_result() {
                break;
            }
            let share = |round: usize| round as f64 / options.rounds as f64;
            let part = &mut Portion::new(monitor, share(round), share(round + 1));
            part.step(Step::default())?;
            self.look(part, |side, seen, constraints, _| {
                constraints.clone_from(&held[side]);
                constraints.extend(draws(&lines[side], &lines[side.other()], seen, options.strength));
                Ok(())
            })?;
            self.lower(fine, part, |_| ())?;
        }
        self.constraints = held;
        Ok(())
    }

    /// The rims of both meshes that correspond; `None` where there are none.
    fn border_lines(&self) -> Option<[Vec<BorderLine>; 2]> {
        let lines = [0, 1]
            .map(|k| self.skins[k].map_or_else(Vec::new, |skin| border_lines(self.full[k], skin.weights())));
        (!lines.iter().any(Vec::is_empty)).then_some(lines)
    }

    /// Restores vertices of both meshes until each level has grown by `options.growth`; `false` where both are full.
    fn grow(&mut self, options: &MultilevelOptions, monitor: &mut dyn Monitor) -> Result<bool, MapError> {
        let mut grown = false;
        for (level, placing) in self.levels.iter_mut().zip(self.placing) {
            let live = level.mesh().live_vertices();
            let goal = options.next_level(live, level.full_vertices());
            grown |= goal > live;
            let quiet = InitialOptions { growth: f64::INFINITY, placing, ..options.initial };
            monitor.step(Step::default())?;
            initial::refine(level, goal, &quiet, monitor)?;
        }
        Ok(grown)
    }

    /// The progress, from 0 to 1, after each finer level is done. A level is taken to need time in proportion to its vertices.
    fn level_shares(&self, options: &MultilevelOptions) -> Vec<f64> {
        let mut live = self.levels.each_ref().map(|level| level.mesh().live_vertices());
        let full = self.levels.each_ref().map(ParametrisedLevel::full_vertices);
        let mut sums: Vec<f64> = Vec::new();
        while live != full {
            let next = [0, 1].map(|k| options.next_level(live[k], full[k]));
            // Levels that cannot refine any further end the loop here.
            if next == live {
                break;
            }
            live = next;
            sums.push(sums.last().copied().unwrap_or(0.0) + (live[0] + live[1]) as f64);
        }
        let total = sums.last().copied().unwrap_or(1.0);
        sums.into_iter().map(|sum| sum / total).collect()
    }

    /// Refines the map to the next finer level and judges it there; `false` where there is none.
    ///
    /// # Errors
    /// [`MapError::NoStart`], [`MapError::Cancelled`].
    pub fn judge_finer(
        &mut self,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<bool, MapError> {
        let grown = self.grow(options, monitor)?;
        if grown {
            self.relax(&options.decide, monitor)?;
        }
        Ok(grown)
    }

    /// Goes on to the next level and lowers the energy there, with the rims that correspond drawn to each other; `false` where both are full.
    ///
    /// # Errors
    /// [`MapError::NoStart`], [`MapError::Cancelled`].
    fn settle_next(
        &mut self,
        lines: Option<&[Vec<BorderLine>; 2]>,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<bool, MapError> {
        if !self.grow(options, &mut Portion::new(monitor, 0.0, 0.1))? {
            return Ok(false);
        }
        // A round of draws takes about as long as the level without them.
        let rounds = if lines.is_some() { options.rim_draws.rounds } else { 0 };
        let settled = 0.1 + 0.9 / (1 + rounds) as f64;
        self.settle(options, self.is_full(), &mut Portion::new(monitor, 0.1, settled))?;
        if let Some(lines) = lines {
            let drawing = &mut Portion::new(monitor, settled, 1.0);
            self.draw_rims(lines, &options.rim_draws, &options.fine, drawing)?;
        }
        Ok(true)
    }

    /// Goes on to the first level that has at least this many vertices, or to the last one before the full meshes, settles the map on all levels
    /// up to there and measures it; `false` where that is the present level.
    ///
    /// # Errors
    /// [`MapError::NoStart`], [`MapError::Cancelled`].
    pub(super) fn refine_to(
        &mut self,
        least: usize,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<bool, MapError> {
        let lines = self.border_lines();
        let mut is_finer = false;
        let is_between = |level: &ParametrisedLevel<'_>| {
            let full = level.full_vertices();
            options.next_level(level.mesh().live_vertices(), full) < full
        };
        while !self.have(least)
            && self.levels.iter().all(is_between)
            && self.settle_next(lines.as_ref(), options, monitor)?
        {
            is_finer = true;
        }
        if is_finer {
            let as_it_is = MapRelaxationOptions { energy: self.energy, max_rounds: 0, ..options.fine };
            self.mean_log = self.lower(&as_it_is, monitor, |seen| seen.mean_log())?;
        }
        Ok(is_finer)
    }

    /// Repairs the dents of the map of the present levels.
    ///
    /// # Errors
    /// [`MapError::Cancelled`].
    fn heal(&mut self, options: &DentOptions, monitor: &mut dyn Monitor) -> Result<(), MapError> {
        let present = self.present();
        let [source, target] = [0, 1].map(|k| present[k].parametrised());
        monitor.step(Step::default())?;
        let locations = match locate(source, target, &self.surface, monitor) {
            Ok(locations) => locations,
            Err(error) => return Ok(error.or_stop().map(drop)?),
        };
        monitor.step(Step::default())?;
        let overlay = match overlay(source, target, &locations, monitor) {
            Ok(overlay) => overlay,
            Err(error) => return Ok(error.or_stop().map(drop)?),
        };
        let brink = if self.energy == MapEnergy::POSES { options.pose_brink } else { options.brink };
        let energy = DentEnergy { energy: self.energy, brink };
        let healed = dents::heal([source, target], &self.surface, &overlay, options, energy, monitor)?;
        for (k, embedding) in healed.iter().flatten().enumerate() {
            monitor.step(Step::default())?;
            self.levels[k].adopt(&present[k].level, embedding);
        }
        Ok(())
    }

    /// Calls `show` for each mesh, 0 the source: its number, its level with the images of its vertices, and its constraints.
    ///
    /// # Errors
    /// [`Cancelled`], or the error of `show`.
    fn look(
        &mut self,
        monitor: &mut dyn Monitor,
        mut show: impl FnMut(
            MeshSide,
            &MappedLevel<'_>,
            &mut Vec<(VertexId, PointConstraint)>,
            &mut dyn Monitor,
        ) -> Result<(), Cancelled>,
    ) -> Result<(), Cancelled> {
        let present = self.present();
        for side in MeshSide::BOTH {
            let [from, onto] = [side, side.other()].map(|side| present[side].parametrised());
            let [level, other] = [side, side.other()].map(|side| present[side].weighted());
            let Some(locations) = unless_stopped(locate(from, onto, &self.surface, monitor))? else {
                continue;
            };
            let points = locations.by_vertex.iter().map(|at| barycentric(from, onto, at));
            let seen = MappedLevel::new(level, other, points);
            show(side, &seen, &mut self.constraints[side], monitor)?;
        }
        Ok(())
    }

    /// Lowers the energy of the map of the present levels. Returns the result of `look` on the relaxed map.
    fn lower<T>(
        &mut self,
        options: &MapRelaxationOptions,
        monitor: &mut dyn Monitor,
        look: impl FnOnce(&Relaxed<'_>) -> T,
    ) -> Result<T, MapError> {
        let present = self.present();
        let parametrised = [0, 1].map(|k| present[k].parametrised());
        let constraints = [0, 1].map(|k| on_level(&self.constraints[k], &present[k].level));
        let constraints = [&constraints[0][..], &constraints[1][..]];
        let relaxed =
            map_relaxation::relax_constrained(parametrised, &self.surface, constraints, options, monitor)?;
        let seen = look(&relaxed);
        monitor.step(Step::default())?;
        let embeddings = relaxed.into_embeddings();
        for k in 0..2 {
            monitor.step(Step::default())?;
            self.levels[k].adopt(&present[k].level, &embeddings[k]);
        }
        Ok(seen)
    }
}

/// The constraints of those vertices that are in a level, by its numbers.
fn on_level(constraints: &[(VertexId, PointConstraint)], level: &Level) -> Vec<(VertexId, PointConstraint)> {
    let number = |(v, constraint): &(VertexId, PointConstraint)| {
        Some((level.vertices.binary_search(v).ok()?, *constraint))
    };
    constraints.iter().filter_map(number).collect()
}

/// The present level of one mesh with its parametrisation.
struct PresentLevel {
    level: Level,
    landmarks: TiVec<LandmarkId, VertexId>,
    embedding: Embedding,
    /// The weights of its faces; `None` where all are skin.
    weights: Option<TiVec<FaceId, FaceWeight>>,
}

impl PresentLevel {
    fn parametrised(&self) -> Parametrised<'_> {
        Parametrised {
            mesh: &self.level.mesh,
            landmark_vertices: &self.landmarks,
            embedding: &self.embedding,
            weights: FaceWeights::new(self.weights.as_deref()),
        }
    }

    fn weighted(&self) -> WeightedLevel<'_> {
        WeightedLevel { level: &self.level, weights: FaceWeights::new(self.weights.as_deref()) }
    }
}

/// A level of one mesh with the images of its vertices on the other.
pub(super) struct PlacedLevel<'a> {
    pub level: Level,
    /// The image of each vertex of the level on the other mesh's level.
    pub images: TiVec<VertexId, DVec3>,
    /// The full mesh of the level.
    pub full: &'a SurfaceMesh,
    /// The other full mesh.
    pub onto: &'a SurfaceMesh,
}

/// The map of two levels, given by the images of the source level's vertices.
#[derive(Clone)]
pub struct LevelImages {
    /// Source and target level.
    pub levels: [Level; 2],
    /// The vertex of each landmark on each level: the user's, then those of own cones.
    landmarks: [TiVec<LandmarkId, VertexId>; 2],
    /// The weights of the faces of each; `None` where all are skin.
    weights: [Option<TiVec<FaceId, FaceWeight>>; 2],
    /// The image of each vertex of the source level on the target level.
    pub target_from_source: TiVec<VertexId, SurfacePoint>,
}

impl LevelImages {
    /// A level onto itself, all of it skin.
    #[cfg(test)]
    pub(super) fn of_itself(level: &Level) -> Self {
        let at = |v| SurfacePoint::at_vertex(&level.mesh, v);
        Self::of_skin([level.clone(), level.clone()], level.mesh.vertices().map(at).collect())
    }

    /// Two levels, all of them skin.
    #[cfg(test)]
    pub(super) fn of_skin(levels: [Level; 2], target_from_source: TiVec<VertexId, SurfacePoint>) -> Self {
        Self { levels, landmarks: Default::default(), weights: [None, None], target_from_source }
    }

    /// The same levels with these vertices of the full meshes as landmarks.
    #[cfg(test)]
    pub(super) fn with_landmarks(self, full: [&[VertexId]; 2]) -> Self {
        let landmarks = [0, 1].map(|k| self.levels[k].numbers(full[k]).collect());
        Self { landmarks, ..self }
    }

    /// The same levels with other images.
    pub(super) fn with_images(&self, target_from_source: TiVec<VertexId, SurfacePoint>) -> Self {
        Self { target_from_source, ..self.clone() }
    }

    /// The level's vertices of the landmarks that a full mesh has, which are the first.
    pub fn landmarks_of(&self, side: MeshSide, full: &LandmarkedMesh) -> &[VertexId] {
        &self.landmarks[side].raw[..full.landmarks.len()]
    }

    /// The weights of the faces of the source and of the target level.
    pub fn weights(&self) -> [FaceWeights<'_>; 2] {
        self.weights.each_ref().map(|weights| FaceWeights::new(weights.as_deref()))
    }
}

/// Refines a coarse map to the full meshes: restores all vertices and relaxes level by level.
///
/// # Errors
/// [`MapError::NoStart`].
pub fn solve_fine(
    mut map: CoarseMap<'_>,
    options: &MultilevelOptions,
    monitor: &mut dyn Monitor,
) -> Result<[Embedding; 2], MapError> {
    let mut ends = map.level_shares(options).into_iter();
    let lines = map.border_lines();
    let mut done = 0.0;
    loop {
        let from = done;
        done = ends.next().unwrap_or(1.0);
        let level = &mut Portion::new(monitor, from, done);
        if !map.settle_next(lines.as_ref(), options, level)? {
            break;
        }
        if !map.is_full() {
            level.preview(&map);
        }
    }
    map.heal(&options.dents, &mut Portion::new(monitor, 1.0, 1.0))?;
    monitor.step(Step { fraction: 1.0, residual: None })?;
    let source = map.levels[0].snapshot().embedding;
    monitor.step(Step { fraction: 1.0, residual: None })?;
    Ok([source, map.levels[1].snapshot().embedding])
}

#[cfg(test)]
mod tests {
    use super::super::class_search::{ClassChoice, ClassSearchOptions, choose_class};
    use super::super::{LandmarkedMesh, coarse_levels};
    use super::*;
    use crate::demo::{self, Demo};
    use crate::layout::SearchOptions;
    use crate::math::scalar::sin;
    use crate::mesh::insertion::insert;

    /// The mean distance of the images of a level's vertices from their true places.
    fn off(map: &CoarseMap<'_>, truth: &[DVec3], scale: f64) -> f64 {
        let images = map.images().unwrap();
        let [source, target] = &images.levels;
        let off = |v: VertexId| {
            let image = images.target_from_source[v].position(&target.mesh);
            truth.get(source.vertices[v].index()).map(|&place| image.distance(scale * place))
        };
        let all: Vec<f64> = source.mesh.vertices().filter_map(off).collect();
        all.iter().sum::<f64>() / all.len() as f64
    }

    /// Both meshes with the landmarks of a demo.
    fn landmarked(meshes: [&SurfaceMesh; 2], demo: &Demo) -> [LandmarkedMesh; 2] {
        [0, 1].map(|k| {
            let landmarks: Vec<VertexId> = demo.landmarks.iter().map(|pair| VertexId(pair[k])).collect();
            LandmarkedMesh::new(meshes[k], &landmarks).unwrap()
        })
    }

    /// The relaxed map of two coarse levels whose layout is drawn once.
    fn drawn_once<'a>(levels: &'a [MeshWithCoarse<'a>; 2], options: &MultilevelOptions) -> CoarseMap<'a> {
        let search = &SearchOptions { candidates: 1, twists: 0, ..SearchOptions::default() };
        let class = ClassSearchOptions { multilevel: options, search, choice: ClassChoice::Best };
        let mut map = choose_class(levels, class, &mut Silent).unwrap().map;
        map.finish(options, &mut Silent).unwrap();
        map
    }

    #[test]
    fn a_map_between_poses_that_is_refined_to_a_finer_level_is_nearer_to_the_truth() {
        let demo = demo::build("horse-turning").unwrap();
        let full = landmarked([&demo.source, &demo.target], &demo);
        let options = &MultilevelOptions::default();
        let levels = coarse_levels(&full, 600, options.rims, &mut Silent).unwrap();
        let map = drawn_once(&levels, options);
        assert!(map.is_of_poses());

        let mut finer = map.clone();
        assert!(finer.refine_to(2000, options, &mut Silent).unwrap());
        assert!(finer.is_of_one_body());
        let sizes = finer.images().unwrap().levels.map(|level| level.mesh.vertex_count());
        assert!(sizes.iter().all(|size| (2000..2500).contains(size)), "{sizes:?}");
        let scale = 1.0 / demo.target.area().sqrt();
        let [before, after] = [&map, &finer].map(|map| off(map, demo.truth.as_ref().unwrap(), scale));
        assert!(after < 0.75 * before, "{before} and {after}");

        // The full meshes are left to the last refinement.
        let mut last = finer;
        assert!(last.refine_to(usize::MAX, options, &mut Silent).unwrap());
        let sizes = last.images().unwrap().levels.map(|level| level.mesh.vertex_count());
        assert!((0..2).all(|k| 2 * sizes[k] <= full[k].refined.mesh.vertex_count()), "{sizes:?}");
        assert!(!last.refine_to(usize::MAX, options, &mut Silent).unwrap());
    }

    #[test]
    fn a_body_with_other_relief_is_no_pose_on_finer_levels() {
        let demo = demo::build("horse-turning").unwrap();
        let scale = demo.target.area().sqrt();
        let bump = |p: &DVec3| {
            let wave = (*p * (80.0 / scale)).to_array().map(sin);
            *p + DVec3::new(wave[1], wave[2], wave[0]) * (0.005 * scale)
        };
        let bumpy = demo.target.with_positions(demo.target.positions().iter().map(bump).collect());
        let full = landmarked([&demo.source, &bumpy], &demo);
        let options = &MultilevelOptions::default();
        let levels = coarse_levels(&full, 600, options.rims, &mut Silent).unwrap();
        let map = drawn_once(&levels, options);
        assert!(map.is_of_poses() && map.is_of_one_body());
        let mut finer = map;
        assert!(finer.refine_to(1000, options, &mut Silent).unwrap());
        assert!(!finer.is_of_poses(), "{:?}", finer.patch_fit);
        assert!(finer.constraints.iter().all(Vec::is_empty));
    }
    #[test]
    fn images_have_a_vertex_of_their_level_for_each_landmark_near_an_edge() {
        let demo = demo::build("horse-turning").unwrap();
        let full = [(0, &demo.source), (1, &demo.target)].map(|(k, mesh)| {
            let near_edge = |pair: &[u32; 2]| {
                let h = mesh.outgoing(VertexId(pair[k]));
                let mut barycentric = [0.0; 3];
                barycentric[h.corner()] = 0.5;
                barycentric[h.next().corner()] = 0.4992;
                barycentric[h.prev().corner()] = 0.0008;
                SurfacePoint { face: h.face(), barycentric }
            };
            let points: Vec<SurfacePoint> = demo.landmarks.iter().map(near_edge).collect();
            let inserted = insert(mesh, &points).unwrap();
            LandmarkedMesh::new(&inserted.mesh, &inserted.vertices).unwrap()
        });
        assert!(full.iter().all(LandmarkedMesh::has_stand_ins));
        let options = &MultilevelOptions::default();
        let levels = coarse_levels(&full, 600, options.rims, &mut Silent).unwrap();
        let images = drawn_once(&levels, options).images().unwrap();
        for side in MeshSide::BOTH {
            let (mesh, level) = (&full[side].refined.mesh, &images.levels[side].mesh);
            for (&v, &w) in full[side].landmarks.iter().zip(images.landmarks_of(side, &full[side])) {
                assert!(mesh.positions()[v].distance(level.positions()[w]) < 1e-4);
            }
        }
    }
}
