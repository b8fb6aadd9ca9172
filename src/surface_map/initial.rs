//! The first parametrisation of a patched mesh onto the cone surface, coarse to fine.
//!
//! The mesh is coarsened down to the base domain, whose parametrisation is the charts themselves; then vertex by vertex
//! comes back, each into the kernel of its star, and the level is relaxed whenever the number of vertices has grown
//! fourfold. Every star is checked: positive triangles and one turn of 2 pi (positive areas alone admit double covers).

use super::charted::{Sight, corner, own_chart, seen, sight};
use super::cone_surface::ConeSurface;
use super::embedding::Embedding;
use super::flat_problem::{FlatProblem, FlatTriangle, RelaxOptions, RelaxReport};
use super::placement::Kernel;
use super::progressive::{ProgressiveMesh, holds};
use super::unknowns::Unknowns;
use super::{MapError, energy};
use crate::layout::PatchedMesh;
use crate::math::rigid2::Rigid2;
use crate::math::scalar::atan2;
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use glam::{DMat2, DVec2};
use std::f64::consts::TAU;
use typed_index_collections::{TiVec, ti_vec};

/// How the first parametrisation is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InitialOptions {
    /// A level is relaxed when its vertices have grown by this factor.
    pub growth: f64,
    /// How far a level is relaxed.
    pub level: RelaxOptions,
}

impl Default for InitialOptions {
    fn default() -> Self {
        Self { growth: 4.0, level: RelaxOptions::default() }
    }
}

/// What it took.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InitialReport {
    /// Levels that were relaxed.
    pub levels: usize,
    /// Vertices whose star had no kernel until its level was relaxed once more.
    pub rescued_vertices: usize,
}

/// A parametrisation with every triangle positive.
///
/// # Errors
/// [`MapError::NoStart`] where a vertex finds no place.
pub fn embed(
    patched: &PatchedMesh,
    surface: &ConeSurface,
    options: &InitialOptions,
    monitor: &mut dyn Monitor,
) -> Result<(Embedding, InitialReport), MapError> {
    let holds = holds(patched, &surface.base);
    let mut mesh = ProgressiveMesh::new(patched, &holds);
    let left = mesh.coarsen();
    if left > 0 {
        return Err(MapError::NotCoarsened { left });
    }
    let total = patched.mesh.vertex_count();
    let mut refinement = Refinement::new(mesh, surface, total);
    let mut report = InitialReport::default();
    let mut relaxed_at = refinement.mesh.mesh().live_vertices();
    while let Some(vertex) = refinement.restore() {
        if !refinement.place(vertex) {
            refinement.rescue(vertex, options, monitor)?;
            report.rescued_vertices += 1;
        }
        let live = refinement.mesh.mesh().live_vertices();
        if live as f64 >= options.growth * relaxed_at as f64 && live < total {
            monitor.step(Step { fraction: live as f64 / total as f64, residual: None })?;
            refinement.relax(&options.level, monitor)?;
            relaxed_at = live;
            report.levels += 1;
        }
    }
    let unknowns = Unknowns::new(patched, surface);
    let z: Vec<DVec2> = unknowns.free().iter().map(|&v| refinement.z[v]).collect();
    Ok((unknowns.embedding(&z), report))
}

/// Relaxes a valid parametrisation.
///
/// # Errors
/// [`MapError::Cancelled`].
pub fn relax(
    patched: &PatchedMesh,
    surface: &ConeSurface,
    start: &Embedding,
    options: &RelaxOptions,
    monitor: &mut dyn Monitor,
) -> Result<(Embedding, RelaxReport), MapError> {
    let unknowns = Unknowns::new(patched, surface);
    let mut z = unknowns.points(start);
    let report = unknowns.problem().relax(&mut z, options, monitor)?;
    Ok((unknowns.embedding(&z), report))
}

struct Refinement<'a> {
    mesh: ProgressiveMesh<'a>,
    surface: &'a ConeSurface,
    /// Own coordinates of the free vertices.
    z: TiVec<VertexId, DVec2>,
    /// The relaxation's number of each live free vertex.
    unknown: TiVec<VertexId, u32>,
    kernel: Kernel,
    star: Vec<DVec2>,
    star_triangles: Vec<FlatTriangle>,
}

impl<'a> Refinement<'a> {
    fn new(mesh: ProgressiveMesh<'a>, surface: &'a ConeSurface, total: usize) -> Self {
        Self {
            mesh,
            surface,
            z: ti_vec![DVec2::ZERO; total],
            unknown: ti_vec![u32::MAX; total],
            kernel: Kernel::default(),
            star: Vec::new(),
            star_triangles: Vec::new(),
        }
    }

    fn restore(&mut self) -> Option<VertexId> {
        self.mesh.restore()
    }

    /// Puts a restored vertex into the kernel of its star; `false` where there is none.
    fn place(&mut self, v: VertexId) -> bool {
        let Some(chart) = own_chart(self.mesh.hold(v)) else { return false };
        self.star.clear();
        self.star_triangles.clear();
        let mesh = &self.mesh;
        let at = mesh.position(v);
        for h in mesh.mesh().star(v) {
            let here = mesh.patch(h.face());
            let back = match sight(self.surface, mesh.hold(v), here) {
                Sight::Moved(motion) if here != chart => motion.inverse(),
                _ => Rigid2::IDENTITY,
            };
            let [p, q] = [mesh.mesh().tail(h.next()), mesh.mesh().tail(h.prev())];
            let [here_p, here_q] =
                [p, q].map(|w| back.apply(seen(self.surface, mesh.hold(w), self.z[w], here)));
            self.star.push(here_p);
            let corners = [
                super::flat_problem::Corner::Free(0, Rigid2::IDENTITY),
                super::flat_problem::Corner::Fixed(here_p),
                super::flat_problem::Corner::Fixed(here_q),
            ];
            let rest = [at, mesh.position(p), mesh.position(q)];
            self.star_triangles.push(FlatTriangle::with_rest(corners, rest));
        }
        let Some(centre) = self.kernel.centroid(&self.star) else { return false };
        let z = self.improved(centre);
        self.z[v] = z;
        self.turns_once(z)
    }

    /// Three Newton steps on the star's energy.
    fn improved(&self, start: DVec2) -> DVec2 {
        let energy_at = |z: DVec2| {
            self.star_triangles
                .iter()
                .try_fold(0.0, |sum, t| Some(sum + t.area * energy::density(&t.jacobian_at(z))?))
        };
        let (mut z, Some(mut least)) = (start, energy_at(start)) else { return start };
        for _ in 0..3 {
            let (slope, curvature) = self.star_derivatives(z);
            let mut step = -(curvature.inverse() * slope);
            for _ in 0..12 {
                if let Some(next) = energy_at(z + step)
                    && next < least
                {
                    z += step;
                    least = next;
                    break;
                }
                step *= 0.5;
            }
        }
        z
    }

    fn star_derivatives(&self, z: DVec2) -> (DVec2, DMat2) {
        let (mut slope, mut curvature) = (DVec2::ZERO, DMat2::ZERO);
        for t in &self.star_triangles {
            let j = t.jacobian_at(z);
            slope += energy::gradient(&j) * t.hats[0] * t.area;
            for term in energy::hessian(&j) {
                let pull = term.apply(t.hats[0]);
                curvature += DMat2::from_cols(pull * pull.x, pull * pull.y) * (term.weight * t.area);
            }
        }
        (slope, curvature)
    }

    /// Whether the triangles of the star are positive and turn around z once.
    fn turns_once(&self, z: DVec2) -> bool {
        let mut turn = 0.0;
        for k in 0..self.star.len() {
            let (p, q) = (self.star[k], self.star[(k + 1) % self.star.len()]);
            if signed_double_area(z, p, q) <= 0.0 {
                return false;
            }
            turn += atan2((p - z).perp_dot(q - z), (p - z).dot(q - z));
        }
        (turn - TAU).abs() < 1e-6
    }

    /// Relaxes the level without the vertex that found no place, then tries again.
    fn rescue(
        &mut self,
        v: VertexId,
        options: &InitialOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<(), MapError> {
        self.mesh.collapse_again();
        self.relax(&options.level, monitor)?;
        self.restore();
        if self.place(v) {
            return Ok(());
        }
        Err(MapError::NoStart { vertices: self.mesh.mesh().live_vertices() })
    }

    /// Relaxes the present level.
    fn relax(&mut self, options: &RelaxOptions, monitor: &mut dyn Monitor) -> Result<RelaxReport, Cancelled> {
        let mut free = Vec::new();
        for v in self.mesh.mesh().vertices() {
            if own_chart(self.mesh.hold(v)).is_some() {
                self.unknown[v] = free.len() as u32;
                free.push(v);
            }
        }
        let mut problem =
            FlatProblem::new(self.mesh.mesh().faces().map(|f| self.triangle(f)).collect(), free.len());
        let mut z: Vec<DVec2> = free.iter().map(|&v| self.z[v]).collect();
        let report = problem.relax(&mut z, options, monitor)?;
        free.iter().zip(z).for_each(|(&v, p)| self.z[v] = p);
        Ok(report)
    }

    fn triangle(&self, f: FaceId) -> FlatTriangle {
        let chart = self.mesh.patch(f);
        let vertices = self.mesh.mesh().corners(f);
        let corners = vertices.map(|v| corner(self.surface, self.mesh.hold(v), self.unknown[v], chart));
        FlatTriangle::with_rest(corners, vertices.map(|v| self.mesh.position(v)))
    }
}
