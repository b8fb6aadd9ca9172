//! The relaxation of the map: its own energy from source to target is lowered.
//!
//! The energy is that of the composed map on its overlay, E = sum over pieces of |J|^2 dA_S + |J^-1|^2 dA_T, with a small
//! share of the flat energy as a barrier. One side moves at a time. On a piece the map is C A with A the Jacobian of the
//! moving triangle and C that of the target's inverse; when the moving side's edges sweep over the other side, the pieces'
//! areas change too, which adds the jump of the density over each edge to the gradient (Reynolds' transport theorem).

use super::evaluation::{CountedEnergy, Evaluation};
use crate::landmarks::MeshSide;
use crate::math::matrix2::cofactor;
use crate::mesh::{FaceId, VertexId};
use crate::monitor::{Cancelled, Monitor, OrStop, Portion, Pulse, Step, unless_stopped};
use crate::surface_map::energy::density::Density;
use crate::surface_map::energy::map_energy::MapEnergy;
use crate::surface_map::energy::point_constraint::PointConstraint;
use crate::surface_map::overlay::location::{Locations, Locator};
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::{Embedding, Parametrised};
use crate::surface_map::parametrisation::problem::{
    Derivatives, FaceHessian, FlatProblem, NewtonSystem, unrotate,
};
use crate::surface_map::parametrisation::rest_triangle::{Corner, rest_jacobian};
use crate::surface_map::parametrisation::unknowns::Unknowns;
use glam::{DMat2, DVec2};
use typed_index_collections::TiVec;

/// Options of the relaxation of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapRelaxationOptions {
    /// Rounds, at most; in each both meshes move one step.
    pub max_rounds: usize,
    /// Stops when a round lowers the energy by less than this share.
    pub relative_decrease: f64,
    /// Weight of the flat energy.
    pub barrier: f64,
    /// The energy of the map.
    pub energy: MapEnergy,
}

impl Default for MapRelaxationOptions {
    fn default() -> Self {
        // Without a barrier triangles collapse; 0.1 costs 1 to 2 % of energy where the cone surface is a poor image
        // (horse-camel). Rounds and decrease: chosen by hand, not measured at half and double.
        Self { max_rounds: 20, relative_decrease: 5e-4, barrier: 0.03, energy: MapEnergy::SMOOTH }
    }
}

/// The constrained vertices of each mesh, the source first, each vertex with its place on the other mesh.
pub type Constraints<'a> = [&'a [(VertexId, PointConstraint)]; 2];

/// A relaxed map.
pub struct Relaxed<'a> {
    relaxation: Relaxation<'a>,
    /// The energy of the map and its constraints before the first and after each step; 4 for an isometry without constraints.
    /// Empty where source and target have no overlay.
    pub energies: Vec<f64>,
}

impl Relaxed<'_> {
    /// Both parametrisations.
    pub fn into_embeddings(self) -> [Embedding; 2] {
        self.relaxation.embeddings
    }

    /// Steps tried whose linear system was not solved to its tolerance.
    pub fn inexact_steps(&self) -> usize {
        self.relaxation.problems.iter().map(FlatProblem::inexact_steps).sum()
    }

    /// Half the sum of the area-weighted means of the density's logarithm over both surfaces: 0 for an isometry, infinite
    /// without an overlay.
    pub fn mean_log(&self) -> f64 {
        match self.energies.is_empty() {
            true => f64::INFINITY,
            false => self.relaxation.present.mean_log(),
        }
    }

    /// The energy of the map, without constraints; infinite without an overlay.
    pub fn energy(&self, energy: MapEnergy) -> f64 {
        match self.energies.is_empty() {
            true => f64::INFINITY,
            false => self.relaxation.present.integral(energy),
        }
    }

    /// The areas, on the source and on the target, of the pieces that are skin on both ([`crate::mesh::face_weights`]); 0 without an
    /// overlay.
    pub fn skin_areas(&self) -> [f64; 2] {
        let [moving, still] = self.relaxation.present.skin_areas();
        match self.relaxation.moving {
            MeshSide::Source => [moving, still],
            MeshSide::Target => [still, moving],
        }
    }

    /// Median over both surfaces of the distortion ([`MapEnergy::distortion`] with equal areas), by area; not a number without an
    /// overlay.
    pub fn median(&self) -> f64 {
        self.relaxation.present.median(MapEnergy::POSES)
    }
}

/// Pieces between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 32_768;

/// Share of the diagonal that is added to the Hessian at first; adapted after every step. Chosen by hand.
const FIRST_DAMPING: f64 = 0.03;

/// Whether an edge of the mesh joins two landmarks, so that no nudge moves it.
fn has_fixed_edges(side: &Parametrised<'_>) -> bool {
    let landmarks = side.landmark_vertices;
    landmarks.iter().any(|&v| side.mesh.star(v).any(|h| landmarks.contains(&side.mesh.head(h))))
}

/// Attempts to nudge a start that has no overlay; growing sixfold the nudges end at 5e-5 of the shortest edge. Chosen by hand.
const NUDGES: usize = 8;

/// Relative residual of the linear solves: the Hessian changes from step to step, so exact solutions are not worth their
/// iterations. Chosen by hand.
const LINEAR_TOLERANCE: f64 = 0.03;

/// Lowers the energy of the map by moving both parametrisations in turn; both stay valid at every step. Ends after
/// the first round when the monitor wants a result: one round removes most of the distortion that new vertices brought.
///
/// # Errors
/// [`Cancelled`].
pub fn relax<'a>(
    sides: [Parametrised<'a>; 2],
    surface: &'a ConeSurface,
    options: &'a MapRelaxationOptions,
    monitor: &mut dyn Monitor,
) -> Result<Relaxed<'a>, Cancelled> {
    relax_constrained(sides, surface, [&[], &[]], options, monitor)
}

/// Lowers the energy of the map with soft constraints on vertices of both meshes.
///
/// While one mesh moves, only its own constraints count, so that the steps of both meshes lower slightly different energies.
///
/// # Errors
/// [`Cancelled`].
pub fn relax_constrained<'a>(
    sides: [Parametrised<'a>; 2],
    surface: &'a ConeSurface,
    constraints: Constraints<'a>,
    options: &'a MapRelaxationOptions,
    monitor: &mut dyn Monitor,
) -> Result<Relaxed<'a>, Cancelled> {
    monitor.step(Step::default())?;
    let mut relaxation = Relaxation::new(sides, surface, constraints, options, monitor)?;
    let mut energies = Vec::new();
    if !relaxation.begin(&mut Portion::new(monitor, 0.0, 0.0))? {
        return Ok(Relaxed { relaxation, energies });
    }
    energies.push(relaxation.energy());
    monitor.relaxation_begins();
    monitor.map_energy(relaxation.energy());
    for round in 0..options.max_rounds {
        let before = relaxation.energy();
        for _ in 0..2 {
            let fraction = round as f64 / options.max_rounds as f64;
            monitor.step(Step { fraction, residual: Some(relaxation.energy()) })?;
            if round > 0 && monitor.wants_result() {
                break;
            }
            if relaxation.step(&mut Portion::new(monitor, fraction, fraction))? {
                energies.push(relaxation.energy());
                monitor.map_energy(relaxation.energy());
            }
            relaxation.exchange_roles(monitor)?;
        }
        let after = relaxation.energy();
        if before - after < options.relative_decrease * after {
            break;
        }
    }
    Ok(Relaxed { relaxation, energies })
}

/// Directions that are tried for a step: the Newton direction, and the same with the vertices held that make the energy rise.
const ATTEMPTS: usize = 4;

/// Faces whose corners are held for a step, at most: one to four where a vertex beside a dent stops all others; thirty and more where
/// both meshes coincide, whose energy has a kink in every direction. Chosen on a few steps of either kind.
const MOST_RISERS: usize = 8;

/// A line along which the energy may fall.
struct Line<'a> {
    start: &'a [DVec2],
    step: &'a [DVec2],
    /// The gradient of the energy at its start.
    slope: &'a [DVec2],
}

/// Where a line leads.
enum Outcome {
    /// To a lower energy; the state there was accepted.
    Lower,
    /// To a higher one, also after the shortest part of the step; the trial is there.
    Higher,
    /// Nowhere: the line goes up from its start, or both meshes have no overlay there.
    NoWay,
}

/// A relaxation under way: one of both meshes moves over the other.
struct Relaxation<'a> {
    sides: [Parametrised<'a>; 2],
    surface: &'a ConeSurface,
    constraints: Constraints<'a>,
    options: &'a MapRelaxationOptions,
    map_energy: MapEnergy,
    unknowns: [Unknowns<'a>; 2],
    problems: [FlatProblem; 2],
    /// The present parametrisations.
    embeddings: [Embedding; 2],
    /// The parametrisations that are tried.
    trials: [Embedding; 2],
    /// The Jacobian of each face of each mesh from its plane to its rest plane.
    inverses: [TiVec<FaceId, DMat2>; 2],
    damping: [f64; 2],
    /// The mesh that moves.
    moving: MeshSide,
    locator: Locator,
    locations: Locations,
    present: Evaluation,
    trial: Evaluation,
}

/// Calls `make` for the source, then for the target, and asks the monitor after each.
fn of_both<T>(monitor: &mut dyn Monitor, make: impl Fn(MeshSide) -> T) -> Result<[T; 2], Cancelled> {
    let of_source = make(MeshSide::Source);
    monitor.step(Step::default())?;
    let of_target = make(MeshSide::Target);
    monitor.step(Step::default())?;
    Ok([of_source, of_target])
}

/// The derivatives of the energy by the Jacobian and the corners of one moving face.
#[derive(Clone, Copy)]
struct FaceDerivatives {
    by_jacobian: DMat2,
    by_corner: [DVec2; 3],
}

impl FaceDerivatives {
    const ZERO: Self = Self { by_jacobian: DMat2::ZERO, by_corner: [DVec2::ZERO; 3] };
}

impl<'a> Relaxation<'a> {
    fn new(
        sides: [Parametrised<'a>; 2],
        surface: &'a ConeSurface,
        constraints: Constraints<'a>,
        options: &'a MapRelaxationOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let unknowns = of_both(monitor, |of| Unknowns::new(sides[of]))?;
        let problems = [unknowns[0].problem(monitor)?, unknowns[1].problem(monitor)?];
        let embeddings = sides.map(|side| side.embedding.clone());
        let inverses = of_both(monitor, |of| {
            sides[of].mesh.faces().map(|f| rest_jacobian(sides[of], f).inverse()).collect()
        })?;
        Ok(Self {
            sides,
            surface,
            constraints,
            options,
            map_energy: options.energy,
            unknowns,
            problems,
            trials: embeddings.clone(),
            embeddings,
            inverses,
            damping: [FIRST_DAMPING; 2],
            moving: MeshSide::Source,
            locator: Locator::default(),
            locations: Locations::default(),
            present: Evaluation::default(),
            trial: Evaluation::default(),
        })
    }

    /// Evaluates the start, nudged where source and target coincide; `false` where it has no overlay.
    fn begin(&mut self, monitor: &mut dyn Monitor) -> Result<bool, Cancelled> {
        let moving = self.moving;
        for attempt in 0..NUDGES {
            let z = self.unknowns[moving].nudged(&self.embeddings[moving], attempt);
            if self.evaluate(&z, monitor)? {
                self.accept();
                return Ok(true);
            }
        }
        // Only edges between landmarks can still coincide with vertices of the other mesh: nudges do not move them.
        if self.sides.iter().any(has_fixed_edges) { self.begin_with_both(monitor) } else { Ok(false) }
    }

    /// Evaluates the start with both meshes nudged, by different lengths: edges between landmarks of one mesh stay where they are, and
    /// may pass through vertices of the other.
    fn begin_with_both(&mut self, monitor: &mut dyn Monitor) -> Result<bool, Cancelled> {
        let (moving, other) = (self.moving, self.moving.other());
        let still = self.embeddings[other].clone();
        for attempt in 1..NUDGES {
            let z = self.unknowns[other].nudged(&still, attempt + 1);
            if self.problems[other].energy(&z).is_none() {
                continue;
            }
            self.unknowns[other].place(&z, &mut self.embeddings[other].corners);
            self.inverses[other] = self.problems[other].jacobians(&z).map(|j| j.inverse()).collect();
            let z = self.unknowns[moving].nudged(&self.embeddings[moving], attempt);
            if self.evaluate(&z, monitor)? {
                self.accept();
                return Ok(true);
            }
        }
        self.embeddings[other] = still;
        Ok(false)
    }

    /// Evaluates the moving side at z into `trial`; `false` where a triangle is not positive or there is no overlay.
    fn evaluate(&mut self, z: &[DVec2], monitor: &mut dyn Monitor) -> Result<bool, Cancelled> {
        let moving = self.moving;
        monitor.step(Step::default())?;
        let Some(flat) = self.problems[moving].energy(z) else { return Ok(false) };
        monitor.step(Step::default())?;
        self.unknowns[moving].place(z, &mut self.trials[moving].corners);
        let from = Parametrised { embedding: &self.trials[moving], ..self.sides[moving] };
        let onto = Parametrised { embedding: &self.embeddings[moving.other()], ..self.sides[moving.other()] };
        if let Err(error) = self.locator.fill([from, onto], self.surface, &mut self.locations, monitor) {
            error.or_stop()?;
            return Ok(false);
        }
        monitor.step(Step::default())?;
        if let Err(error) = self.trial.overlay.fill([from, onto], &self.locations, monitor) {
            error.or_stop()?;
            return Ok(false);
        }
        monitor.step(Step::default())?;
        let counted = self.counted();
        self.trial.measure(&self.problems[moving], z, &self.inverses[moving.other()], counted);
        let (unknowns, constraints) = (&self.unknowns[moving], self.constraints[moving]);
        monitor.step(Step::default())?;
        self.trial.constrain([from, onto], unknowns, constraints, &self.locations);
        self.trial.total = self.trial.energy + self.trial.constrained + self.options.barrier * flat;
        Ok(true)
    }

    /// The energy of the map, seen from the moving side.
    fn counted(&self) -> CountedEnergy<'a> {
        let weights = [self.moving, self.moving.other()].map(|k| self.sides[k].weights);
        CountedEnergy { energy: self.map_energy, weights }
    }

    /// One damped Newton step of the moving side; `false` where none lowers the energy.
    fn step(&mut self, monitor: &mut dyn Monitor) -> Result<bool, Cancelled> {
        let moving = self.moving;
        let z = self.unknowns[moving].points(&self.embeddings[moving]);
        let slope = self.gradient(&z, monitor)?;
        monitor.step(Step::default())?;
        let hessians = self.hessians(monitor)?;
        monitor.step(Step::default())?;
        let problem = &mut self.problems[moving];
        let derivatives = Derivatives {
            slope: &slope,
            barrier: self.options.barrier,
            by_triangle: &hessians,
            by_unknown: &self.present.constraint_hessians,
        };
        let system = NewtonSystem { damping: self.damping[moving], tolerance: LINEAR_TOLERANCE };
        let mut step = problem.direction(&z, &derivatives, system, monitor)?;
        for _ in 0..ATTEMPTS {
            match self.go(&Line { start: &z, step: &step, slope: &slope }, monitor)? {
                Outcome::Lower => return Ok(true),
                Outcome::NoWay => return Ok(false),
                Outcome::Higher if self.hold_risers(&mut step) => {}
                Outcome::Higher => return Ok(false),
            }
        }
        Ok(false)
    }

    /// Goes along a line as far as the energy falls.
    fn go(&mut self, line: &Line<'_>, monitor: &mut dyn Monitor) -> Result<Outcome, Cancelled> {
        let moving = self.moving;
        let Line { start, step, slope } = *line;
        let descent: f64 = -slope.iter().zip(step).map(|(g, d)| g.dot(*d)).sum::<f64>();
        if descent.is_nan() || descent <= 0.0 {
            return Ok(Outcome::NoWay);
        }
        // At most 0.9 of the way to the first triangle without area, then halvings until the energy falls by 1e-4 of what the
        // slope promises (Armijo); after seven of them the direction is no good. The damping falls to a third after a whole
        // step, and grows by as much as a step was shortened. Chosen by hand.
        let longest = (0.9 * self.problems[moving].first_degenerate(start, step)).min(1.0);
        let mut t = longest;
        let mut has_overlay = false;
        for _ in 0..8 {
            let trial: Vec<DVec2> = start.iter().zip(step).map(|(p, d)| *p + *d * t).collect();
            has_overlay = self.evaluate(&trial, monitor)?;
            if has_overlay && self.trial.total <= self.present.total - 1e-4 * t * descent {
                let damping = &mut self.damping[moving];
                *damping = if t == longest { (*damping / 3.0).max(1e-6) } else { *damping * longest / t };
                self.accept();
                return Ok(Outcome::Lower);
            }
            t *= 0.5;
        }
        Ok(if has_overlay { Outcome::Higher } else { Outcome::NoWay })
    }

    /// Keeps the corners of those faces where they are whose energies rise most in the trial: of the fewest faces that have half of all that
    /// rises. `false` where these are more than a few ([`MOST_RISERS`]).
    ///
    /// Where a limb without a landmark is squeezed into a dent, the density changes within a millionth of a length. A single vertex beside it
    /// may promise more than the whole energy, and then no part of the step lowers it, however short.
    fn hold_risers(&self, step: &mut [DVec2]) -> bool {
        let [before, after] = [&self.present, &self.trial].map(|seen| seen.by_face(self.map_energy));
        let rises = after.iter().zip(&before).map(|(after, before)| after - before).enumerate();
        let mut rises: Vec<(usize, f64)> = rises.filter(|(_, rise)| *rise > 0.0).collect();
        rises.sort_unstable_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let half = 0.5 * rises.iter().map(|(_, rise)| rise).sum::<f64>();
        let mut sum = 0.0;
        let lacks = |&(_, rise): &(usize, f64)| {
            let lacks = sum < half;
            sum += rise;
            lacks
        };
        let risers: Vec<_> = rises.into_iter().take_while(lacks).collect();
        if risers.is_empty() || risers.len() > MOST_RISERS {
            return false;
        }
        let triangles = self.problems[self.moving].triangles();
        for corner in risers.iter().flat_map(|(face, _)| &triangles[*face].corners) {
            if let Corner::Free(v, _) = corner {
                step[*v as usize] = DVec2::ZERO;
            }
        }
        true
    }

    fn accept(&mut self) {
        let moving = self.moving;
        std::mem::swap(&mut self.present, &mut self.trial);
        std::mem::swap(&mut self.embeddings[moving], &mut self.trials[moving]);
        self.embeddings[moving].normalise_anchors(self.surface);
        self.trials[moving].anchors = self.embeddings[moving].anchors.clone();
        self.inverses[moving] = self.present.jacobians.iter().map(DMat2::inverse).collect();
    }

    /// Lets the other mesh move, and evaluates the same overlay from there.
    fn exchange_roles(&mut self, monitor: &mut dyn Monitor) -> Result<(), Cancelled> {
        self.moving = self.moving.other();
        self.present.overlay.exchange_roles();
        let problem = &self.problems[self.moving];
        let z = self.unknowns[self.moving].points(&self.embeddings[self.moving]);
        let counted = self.counted();
        self.present.measure(problem, &z, &self.inverses[self.moving.other()], counted);
        let flat = problem.energy(&z).unwrap_or(f64::INFINITY);
        self.locate_constrained(monitor)?;
        self.present.total = self.present.energy + self.present.constrained + self.options.barrier * flat;
        Ok(())
    }

    /// Evaluates the constraints at the present state.
    fn locate_constrained(&mut self, monitor: &mut dyn Monitor) -> Result<(), Cancelled> {
        let moving = self.moving;
        let sides = [moving, moving.other()]
            .map(|k| Parametrised { embedding: &self.embeddings[k], ..self.sides[k] });
        let mut constraints = self.constraints[moving];
        if !constraints.is_empty() {
            let filled = self.locator.fill(sides, self.surface, &mut self.locations, monitor);
            if unless_stopped(filled)?.is_none() {
                constraints = &[];
            }
        }
        self.present.constrain(sides, &self.unknowns[moving], constraints, &self.locations);
        Ok(())
    }

    /// The energy of the map and its constraints, without the barrier; 4 for an isometry.
    fn energy(&self) -> f64 {
        (self.present.energy + self.present.constrained) / self.map_energy.unit()
    }

    /// The gradient of the energy and the barrier.
    fn gradient(&self, z: &[DVec2], monitor: &mut dyn Monitor) -> Result<Vec<DVec2>, Cancelled> {
        let problem = &self.problems[self.moving];
        let mut slope = vec![DVec2::ZERO; z.len()];
        problem.gradient(z, &mut slope);
        slope.iter_mut().for_each(|g| *g *= self.options.barrier);
        self.present.constraint_slopes.iter().for_each(|(v, own)| slope[*v as usize] += *own);
        monitor.step(Step::default())?;
        for (triangle, face) in problem.triangles().iter().zip(self.face_derivatives(monitor)?) {
            for k in 0..3 {
                if let Corner::Free(v, motion) = &triangle.corners[k] {
                    let pull = face.by_jacobian * triangle.hats[k] + face.by_corner[k];
                    slope[*v as usize] += unrotate(motion, pull);
                }
            }
        }
        Ok(slope)
    }

    fn face_derivatives(&self, monitor: &mut dyn Monitor) -> Result<Vec<FaceDerivatives>, Cancelled> {
        let Evaluation { overlay, jacobians, onto_rest, weights, .. } = &self.present;
        let mut faces = vec![FaceDerivatives::ZERO; jacobians.len()];
        let mut densities = Vec::with_capacity(onto_rest.len());
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        for ((piece, c), &counted) in overlay.pieces().iter().zip(onto_rest).zip(weights) {
            pulse.beat()?;
            let energy = self.map_energy.of_piece(counted);
            let t = piece.source_face.index();
            let a = &jacobians[t];
            let (det, j) = (a.determinant(), *c * *a);
            let density = energy.density(&j) / det;
            densities.push(density);
            // d(h / det A) at fixed area on the cone surface.
            let own = c.transpose() * energy.gradient(&j);
            faces[t].by_jacobian += (own - cofactor(a) * density) * (piece.area / det);
        }
        monitor.step(Step::default())?;
        self.add_sweeps(&densities, &mut faces);
        Ok(faces)
    }

    /// Adds the derivative of the pieces' areas: the jump of the density over each moving edge, times the area that the edge sweeps
    /// per motion of its ends.
    fn add_sweeps(&self, densities: &[f64], faces: &mut [FaceDerivatives]) {
        let corners = &self.embeddings[self.moving].corners;
        for segment in self.present.overlay.segments(self.sides[self.moving].mesh, MeshSide::Source) {
            let h = segment.halfedge;
            let along = (corners[h.next()] - corners[h]) * (segment.end - segment.begin);
            let jump = densities[segment.left as usize] - densities[segment.right as usize];
            let outwards = DVec2::new(along.y, -along.x) * jump;
            let middle = 0.5 * (segment.begin + segment.end);
            let by_corner = &mut faces[h.face().index()].by_corner;
            by_corner[h.corner()] += outwards * (1.0 - middle);
            by_corner[h.next().corner()] += outwards * middle;
        }
    }

    fn hessians(&self, monitor: &mut dyn Monitor) -> Result<Vec<FaceHessian>, Cancelled> {
        let Evaluation { overlay, jacobians, onto_rest, weights, .. } = &self.present;
        let mut hessians = vec![FaceHessian::ZERO; jacobians.len()];
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        for ((piece, c), &counted) in overlay.pieces().iter().zip(onto_rest).zip(weights) {
            pulse.beat()?;
            let energy = self.map_energy.of_piece(counted);
            let t = piece.source_face.index();
            let area = piece.area / jacobians[t].determinant();
            for term in energy.hessian(&(*c * jacobians[t])) {
                hessians[t].add(area * term.weight, &(c.transpose() * term.matrix()));
            }
        }
        Ok(hessians)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::landmarks::Landmarks;
    use crate::layout::{self, BaseLayout, LayoutOptions};
    use crate::math::scalar::sin;
    use crate::mesh::SurfaceMesh;
    use crate::mesh::face_weights::{FaceWeight, FaceWeights};
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;
    use crate::surface_map::certify;
    use crate::surface_map::parametrisation::initial::{self, InitialOptions};
    use glam::DVec3;
    use std::sync::Arc;

    fn nearest(mesh: &SurfaceMesh, p: DVec3) -> u32 {
        let distance = |v: &crate::mesh::VertexId| mesh.positions()[*v].distance(p);
        mesh.vertices().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap().0
    }

    pub fn sides<'a>(layout: &'a BaseLayout, embeddings: &'a [Embedding; 2]) -> [Parametrised<'a>; 2] {
        [layout.source.parametrised(&embeddings[0]), layout.target.parametrised(&embeddings[1])]
    }

    /// A ball onto a bent, stretched ball with other connectivity.
    pub fn example() -> (BaseLayout, Arc<ConeSurface>, [Embedding; 2]) {
        let (source, ball) = (icosphere(2), icosphere(3));
        let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
        let pairs: Vec<_> = axes.iter().map(|&p| [nearest(&source, p), nearest(&ball, p)]).collect();
        let bend = |p: &DVec3| DVec3::new(1.6 * p.x, p.y + 0.4 * p.x * p.x, p.z * (1.0 + 0.3 * p.y));
        let target = ball.with_positions(ball.positions().iter().map(bend).collect());
        let landmarks = Landmarks::from_vertices(&source, &target, &pairs).unwrap();
        let layout =
            layout::joint([&source, &target], &landmarks, &LayoutOptions::default(), &mut Silent).unwrap();
        let surface = Arc::new(ConeSurface::of_layout(&layout));
        let start = |side| initial::embed(side, &surface, &InitialOptions::default(), &mut Silent).unwrap().0;
        let embeddings = [start(&layout.source), start(&layout.target)];
        (layout, surface, embeddings)
    }

    #[test]
    fn the_gradient_with_its_transport_term_is_the_difference_quotient() {
        let (layout, surface, embeddings) = example();
        let options = MapRelaxationOptions {
            energy: MapEnergy { balance: 0.1, knee: 0.2 },
            ..MapRelaxationOptions::default()
        };
        // All skin; then caps on both, so that weights jump over edges of either mesh, and tolls at the same edges and at others.
        let caps = |mesh: &SurfaceMesh, axis: DVec3| -> TiVec<FaceId, FaceWeight> {
            let of = |f| {
                let within = |limit: f64| mesh.corners(f).iter().all(|p| p.dot(axis) > limit);
                let toll = [within(0.0), within(0.3)].map(|is_within| if is_within { 0.6 } else { 0.0 });
                FaceWeight { weight: if within(0.0) { 0.01 } else { 1.0 }, toll: toll[0] + toll[1] }
            };
            mesh.faces().map(of).collect()
        };
        let weights = [caps(&layout.source.mesh, DVec3::X), caps(&layout.target.mesh, DVec3::Y)];
        let [source, target] = sides(&layout, &embeddings);
        let capped = [
            Parametrised { weights: FaceWeights::new(Some(&weights[0])), ..source },
            Parametrised { weights: FaceWeights::new(Some(&weights[1])), ..target },
        ];
        for sides in [[source, target], capped] {
            let relaxation = Relaxation::new(sides, &surface, [&[], &[]], &options, &mut Silent).unwrap();
            gradient_is_quotient(relaxation, &embeddings[0]);
        }
    }

    fn gradient_is_quotient(mut relaxation: Relaxation<'_>, moving: &Embedding) {
        assert!(relaxation.begin(&mut Silent).unwrap());
        let z = relaxation.unknowns[0].points(moving);
        let slope = relaxation.gradient(&z, &mut Silent).unwrap();
        for seed in 1..6 {
            let wave = |k: usize, phase: f64| 0.02 * sin(f64::from(seed) * 1.7 * k as f64 + phase);
            let direction: Vec<_> = (0..z.len()).map(|k| DVec2::new(wave(k, 0.0), wave(k, 1.0))).collect();
            let mut at = |h: f64| {
                let moved: Vec<_> = z.iter().zip(&direction).map(|(p, d)| *p + *d * h).collect();
                assert!(relaxation.evaluate(&moved, &mut Silent).unwrap());
                relaxation.trial.total
            };
            let quotient = (at(1e-4) - at(-1e-4)) / 2e-4;
            let exact: f64 = slope.iter().zip(&direction).map(|(g, d)| g.dot(*d)).sum();
            assert!((quotient - exact).abs() < 1e-3 * exact.abs().max(0.01), "{quotient} {exact}");
        }
    }

    #[test]
    fn corners_of_the_faces_that_rise_are_held() {
        let (layout, surface, embeddings) = example();
        let options = MapRelaxationOptions { max_rounds: 60, relative_decrease: 1e-9, ..Default::default() };
        let relaxed = relax(sides(&layout, &embeddings), &surface, &options, &mut Silent).unwrap();
        let mut relaxation = relaxed.relaxation;
        let moving = relaxation.moving;
        let z = relaxation.unknowns[moving].points(&relaxation.embeddings[moving]);
        for k in 0..z.len() {
            let mut moved = z.clone();
            moved[k] += DVec2::splat(5e-3);
            assert!(relaxation.evaluate(&moved, &mut Silent).unwrap());
            assert!(relaxation.trial.total > relaxation.present.total);
            let mut step = vec![DVec2::ONE; z.len()];
            assert!(relaxation.hold_risers(&mut step));
            let held = step.iter().filter(|d| **d == DVec2::ZERO).count();
            assert!(step[k] == DVec2::ZERO && held < 8, "{held} of {} held", z.len());
        }
    }

    /// A monitor that keeps the reported energies: `None` where a relaxation begins.
    #[derive(Default)]
    struct Listener(Vec<Option<f64>>);

    impl Monitor for Listener {
        fn relaxation_begins(&mut self) {
            self.0.push(None);
        }
        fn map_energy(&mut self, energy: f64) {
            self.0.push(Some(energy));
        }
        fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
            Ok(())
        }
    }

    #[test]
    fn the_energy_falls_and_the_map_stays_certified() {
        let (layout, surface, embeddings) = example();
        let options = MapRelaxationOptions::default();
        let mut told = Listener::default();
        let relaxed = relax(sides(&layout, &embeddings), &surface, &options, &mut told).unwrap();
        let expected: Vec<_> =
            std::iter::once(None).chain(relaxed.energies.iter().copied().map(Some)).collect();
        assert_eq!(told.0, expected);
        assert!(relaxed.energies.len() > 2, "{:?}", relaxed.energies);
        assert_eq!(relaxed.inexact_steps(), 0);
        let (first, last) = (relaxed.energies[0], relaxed.energies[relaxed.energies.len() - 1]);
        assert!(last < first && last > 4.0 - 1e-9, "{:?}", relaxed.energies);
        assert!(
            sides(&layout, &relaxed.into_embeddings())
                .into_iter()
                .all(|side| certify(side, &surface).bijective)
        );
    }
}
