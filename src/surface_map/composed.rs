//! The true relaxation: least distortion of the map itself, source to target.
//!
//! The energy is that of the composed map on its overlay, E = sum over pieces of |J|^2 dA_S + |J^-1|^2 dA_T, with a small
//! share of the flat energy as a barrier. One side moves at a time. On a piece the map is C A with A the Jacobian of the
//! moving triangle and C that of the target's inverse; when the moving side's edges sweep over the other side, the pieces'
//! areas change too, which adds the jump of the density over each edge to the gradient (Reynolds' transport theorem).

use super::compose::{Parametrised, locate};
use super::cone_surface::ConeSurface;
use super::embedding::Embedding;
use super::energy::{HessianTerm, two_sided_density, two_sided_gradient, two_sided_hessian};
use super::flat_problem::{FlatProblem, rest_jacobian, unrotate};
use super::overlay::{Overlay, Overlayer, Piece, SideOf};
use super::unknowns::Unknowns;
use crate::mesh::{FaceId, HalfedgeId};
use crate::monitor::{Cancelled, Monitor, Step};
use glam::{DMat2, DVec2};
use typed_index_collections::TiVec;

/// How far the true relaxation goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComposedOptions {
    /// Rounds of one step on either side, at most.
    pub max_rounds: usize,
    /// Stops when a round lowers the energy by less than this share.
    pub relative_decrease: f64,
    /// Weight of the flat energy.
    pub barrier: f64,
}

impl Default for ComposedOptions {
    fn default() -> Self {
        Self { max_rounds: 20, relative_decrease: 1e-3, barrier: 0.1 }
    }
}

/// What the true relaxation did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ComposedReport {
    /// E before the first and after each step; 4 for an isometry. Without the barrier.
    pub energies: Vec<f64>,
}

/// Share of the diagonal that is added to the Hessian at first.
const FIRST_DAMPING: f64 = 0.03;

/// Lowers the energy of the map by moving both parametrisations in turn; both stay valid at every step.
///
/// # Errors
/// [`Cancelled`].
pub fn relax(
    sides: [Parametrised<'_>; 2],
    surface: &ConeSurface,
    options: &ComposedOptions,
    monitor: &mut dyn Monitor,
) -> Result<([Embedding; 2], ComposedReport), Cancelled> {
    let unknowns = sides.map(Unknowns::new);
    let mut problems = [unknowns[0].problem(), unknowns[1].problem()];
    let mut embeddings = sides.map(|side| side.embedding.clone());
    let mut report = ComposedReport::default();
    let mut overlayer = Overlayer::default();
    let mut damping = [FIRST_DAMPING; 2];
    for round in 0..options.max_rounds {
        let before = report.energies.last().copied().unwrap_or(f64::INFINITY);
        for moving in 0..2 {
            let fraction = round as f64 / options.max_rounds as f64;
            monitor.step(Step { fraction, residual: report.energies.last().copied() })?;
            let fixed = Parametrised { embedding: &embeddings[1 - moving], ..sides[1 - moving] };
            let present = Parametrised { embedding: &embeddings[moving], ..sides[moving] };
            let side = Moving::new(&unknowns[moving], present, fixed, (surface, options));
            let start = unknowns[moving].points(&embeddings[moving]);
            let own = (&mut problems[moving], &mut damping[moving]);
            let Some((z, energies)) = side.step(own, &mut overlayer, start) else {
                continue;
            };
            if report.energies.is_empty() {
                report.energies.push(energies[0]);
            }
            report.energies.push(energies[1]);
            unknowns[moving].place(&z, &mut embeddings[moving].corners);
            embeddings[moving].normalise_anchors(surface);
        }
        let after = report.energies.last().copied().unwrap_or(before);
        if before - after < options.relative_decrease * after && round > 0 {
            break;
        }
    }
    Ok((embeddings, report))
}

/// One side that moves over the other.
struct Moving<'a> {
    unknowns: &'a Unknowns<'a>,
    /// Where it started.
    moving: Parametrised<'a>,
    surface: &'a ConeSurface,
    fixed: Parametrised<'a>,
    /// Of each fixed face the Jacobian from its chart to its rest plane.
    fixed_inverses: TiVec<FaceId, DMat2>,
    options: &'a ComposedOptions,
}

/// The overlay at some state with what derivatives need.
struct State {
    embedding: Embedding,
    overlay: Overlay,
    /// C of each piece: from the plane of the moving face's chart to the rest plane of the fixed face.
    onto_rest: Vec<DMat2>,
    /// E.
    energy: f64,
    /// E and the barrier.
    total: f64,
}

impl<'a> Moving<'a> {
    fn new(
        unknowns: &'a Unknowns<'a>,
        moving: Parametrised<'a>,
        fixed: Parametrised<'a>,
        (surface, options): (&'a ConeSurface, &'a ComposedOptions),
    ) -> Self {
        let inverse = |f: FaceId| rest_jacobian(fixed, f).inverse();
        let fixed_inverses = fixed.mesh.faces().map(inverse).collect();
        Self { unknowns, moving, surface, fixed, fixed_inverses, options }
    }

    /// One Newton step: the new state, or the old one where no step lowers the energy, with E before and after. `None` where
    /// there is no overlay to begin with.
    fn step(
        &self,
        (problem, damping): (&mut FlatProblem, &mut f64),
        overlayer: &mut Overlayer,
        z: Vec<DVec2>,
    ) -> Option<(Vec<DVec2>, [f64; 2])> {
        let state = self.state(problem, overlayer, &z)?;
        let slope = self.gradient(problem, &z, &state);
        let jacobians: TiVec<FaceId, DMat2> =
            self.moving.mesh.faces().map(|f| problem.jacobian(f.index(), &z)).collect();
        let terms = state.overlay.pieces.iter().zip(&state.onto_rest).flat_map(|(piece, c)| {
            let a = &jacobians[piece.source_face];
            let area = piece.area / a.determinant();
            let terms = two_sided_hessian(&(*c * *a));
            terms.map(|term| (piece.source_face.index(), area, pulled_back(&term, c)))
        });
        let barrier = self.options.barrier;
        let step = problem.direction(&z, (barrier, *damping), terms, (&slope, 0.03));
        let descent: f64 = -slope.iter().zip(&step).map(|(g, d)| g.dot(*d)).sum::<f64>();
        if descent.is_nan() || descent <= 0.0 {
            return Some((z, [state.energy; 2]));
        }
        let mut t = (0.9 * problem.first_degenerate(&z, &step)).min(1.0);
        let longest = t;
        for _ in 0..8 {
            let trial: Vec<DVec2> = z.iter().zip(&step).map(|(p, d)| *p + *d * t).collect();
            if let Some(next) = self.state(problem, overlayer, &trial)
                && next.total <= state.total - 1e-4 * t * descent
            {
                *damping = if t == longest { (*damping / 3.0).max(1e-6) } else { *damping * longest / t };
                return Some((trial, [state.energy, next.energy]));
            }
            t *= 0.5;
        }
        Some((z, [state.energy; 2]))
    }

    /// The overlay and energy at z; `None` where a triangle is not positive or there is no overlay.
    fn state(&self, problem: &FlatProblem, overlayer: &mut Overlayer, z: &[DVec2]) -> Option<State> {
        let flat = problem.energy(z)?;
        let mut embedding = self.moving.embedding.clone();
        self.unknowns.place(z, &mut embedding.corners);
        let moving = Parametrised { embedding: &embedding, ..self.moving };
        let locations = locate(moving, self.fixed, self.surface).ok()?;
        let mut overlay = Overlay::default();
        overlayer.fill([moving, self.fixed], &locations, &mut overlay).ok()?;
        let onto = |piece: &Piece| {
            self.fixed_inverses[piece.target_face]
                * DMat2::from_cols(piece.motion.rotation, piece.motion.rotation.perp())
        };
        let onto_rest: Vec<DMat2> = overlay.pieces.iter().map(onto).collect();
        let mut energy = 0.0;
        for (piece, c) in overlay.pieces.iter().zip(&onto_rest) {
            let t = piece.source_face.index();
            let a = problem.jacobian(t, z);
            energy += piece.area / a.determinant() * two_sided_density(&(*c * a));
        }
        Some(State { total: energy + self.options.barrier * flat, embedding, overlay, onto_rest, energy })
    }

    /// The gradient of E and the barrier.
    fn gradient(&self, problem: &FlatProblem, z: &[DVec2], state: &State) -> Vec<DVec2> {
        let mut slope = vec![DVec2::ZERO; z.len()];
        problem.gradient(z, &mut slope);
        slope.iter_mut().for_each(|g| *g *= self.options.barrier);
        for (piece, c) in state.overlay.pieces.iter().zip(&state.onto_rest) {
            let t = piece.source_face.index();
            let a = problem.jacobian(t, z);
            let det = a.determinant();
            let density = two_sided_density(&(*c * a)) / det;
            // d(h / det A) at fixed area on the cone surface.
            let cofactor =
                DMat2::from_cols(DVec2::new(a.y_axis.y, -a.y_axis.x), DVec2::new(-a.x_axis.y, a.x_axis.x));
            let by_jacobian =
                (c.transpose() * two_sided_gradient(&(*c * a))) * (1.0 / det) - cofactor * (density / det);
            let sweep = self.sweep(state, piece);
            for k in 0..3 {
                if let Some((v, motion)) = problem.free_corner(t, k) {
                    let hat = problem.triangles()[t].hats[k];
                    let pull = by_jacobian * hat * piece.area + sweep[k] * density;
                    slope[v] += unrotate(&motion, pull);
                }
            }
        }
        slope
    }

    /// For each corner of the moving face the area that the piece gains per motion of the corner, through its sides on the
    /// face's own edges.
    fn sweep(&self, state: &State, piece: &Piece) -> [DVec2; 3] {
        let points = &state.overlay.points[piece.points.clone()];
        let corners = [0, 1, 2].map(|k| state.embedding.corners[HalfedgeId::of(piece.source_face, k)]);
        let place = |w: &[f64; 3]| corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2];
        let mut sweep = [DVec2::ZERO; 3];
        for k in 0..points.len() {
            let (p, q) = (&points[k].source, &points[(k + 1) % points.len()].source);
            if points[k].side == SideOf::Source {
                let along = place(q) - place(p);
                let outwards = DVec2::new(along.y, -along.x);
                for c in 0..3 {
                    sweep[c] += outwards * (0.5 * (p[c] + q[c]));
                }
            }
        }
        sweep
    }
}

/// A term with respect to C A as a term with respect to A.
fn pulled_back(term: &HessianTerm, c: &DMat2) -> HessianTerm {
    HessianTerm { left: term.left.map(|u| c.transpose() * u), ..*term }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmarks::Landmarks;
    use crate::layout::{self, BaseLayout, LayoutOptions};
    use crate::math::scalar::sin;
    use crate::mesh::SurfaceMesh;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;
    use crate::surface_map::certify;
    use crate::surface_map::initial::{self, InitialOptions};
    use glam::DVec3;
    use std::sync::Arc;

    fn nearest(mesh: &SurfaceMesh, p: DVec3) -> u32 {
        let distance = |v: &crate::mesh::VertexId| mesh.positions()[*v].distance(p);
        mesh.vertices().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap().0
    }

    fn sides<'a>(layout: &'a BaseLayout, embeddings: &'a [Embedding; 2]) -> [Parametrised<'a>; 2] {
        [layout.source.parametrised(&embeddings[0]), layout.target.parametrised(&embeddings[1])]
    }

    /// A ball onto a bent, stretched ball with other connectivity.
    fn example() -> (BaseLayout, Arc<ConeSurface>, [Embedding; 2]) {
        let (source, ball) = (icosphere(2), icosphere(3));
        let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
        let pairs: Vec<_> = axes.iter().map(|&p| [nearest(&source, p), nearest(&ball, p)]).collect();
        let bend = |p: &DVec3| DVec3::new(1.6 * p.x, p.y + 0.4 * p.x * p.x, p.z * (1.0 + 0.3 * p.y));
        let target = ball.with_positions(ball.positions().iter().map(bend).collect());
        let landmarks = Landmarks::from_vertices(&source, &target, &pairs).unwrap();
        let layout =
            layout::joint([&source, &target], &landmarks, &LayoutOptions::default(), &mut Silent).unwrap();
        let surface = Arc::new(ConeSurface::of_layout(&layout).unwrap());
        let start = |side| initial::embed(side, &surface, &InitialOptions::default(), &mut Silent).unwrap().0;
        let embeddings = [start(&layout.source), start(&layout.target)];
        (layout, surface, embeddings)
    }

    #[test]
    fn the_gradient_with_its_transport_term_is_the_difference_quotient() {
        let (layout, surface, embeddings) = example();
        let options = ComposedOptions::default();
        let [source, target] = sides(&layout, &embeddings);
        let unknowns = Unknowns::new(source);
        let problem = unknowns.problem();
        let side = Moving::new(&unknowns, source, target, (&surface, &options));
        let z = unknowns.points(&embeddings[0]);
        let mut overlayer = Overlayer::default();
        let slope = side.gradient(&problem, &z, &side.state(&problem, &mut overlayer, &z).unwrap());
        for seed in 1..6 {
            let wave = |k: usize, phase: f64| 0.02 * sin(f64::from(seed) * 1.7 * k as f64 + phase);
            let direction: Vec<_> = (0..z.len()).map(|k| DVec2::new(wave(k, 0.0), wave(k, 1.0))).collect();
            let mut at = |h: f64| {
                let moved: Vec<_> = z.iter().zip(&direction).map(|(p, d)| *p + *d * h).collect();
                side.state(&problem, &mut overlayer, &moved).unwrap().total
            };
            let quotient = (at(1e-4) - at(-1e-4)) / 2e-4;
            let exact: f64 = slope.iter().zip(&direction).map(|(g, d)| g.dot(*d)).sum();
            assert!((quotient - exact).abs() < 1e-3 * exact.abs().max(0.01), "{quotient} {exact}");
        }
    }

    #[test]
    fn the_energy_falls_and_the_map_stays_certified() {
        let (layout, surface, embeddings) = example();
        let options = ComposedOptions::default();
        let (relaxed, report) = relax(sides(&layout, &embeddings), &surface, &options, &mut Silent).unwrap();
        assert!(report.energies.len() > 2, "{:?}", report.energies);
        let (first, last) = (report.energies[0], report.energies[report.energies.len() - 1]);
        assert!(last < first && last > 4.0 - 1e-9, "{:?}", report.energies);
        assert!(sides(&layout, &relaxed).into_iter().all(|side| certify(side, &surface).bijective));
    }
}
