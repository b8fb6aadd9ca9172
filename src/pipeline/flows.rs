//! The cone metrics of both meshes, and the texture coordinates made from the target's.

use super::{Cones, MapInput, PipelineError, PipelineOptions, Warning};
use crate::base_domain::BaseDomain;
use crate::cone_metric::atlas::{FlatAtlas, flat_atlas};
use crate::cone_metric::{
    ConeMetric, FlatSurface, FlowError, FlowOptions, FlowRecord, FlowReport, Scheme, base_domain_curvature,
    flow, recorded_flow, uniform_curvature,
};
use crate::landmarks::{Landmarks, MeshSide};
use crate::mesh::{HalfedgeId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Rising, Stage, if_time};
use glam::DVec2;
use typed_index_collections::{TiVec, ti_vec};

/// The results of both flows.
pub(super) struct Flows {
    /// Curvature of each landmark's cone, in radians.
    pub cones: Vec<f64>,
    /// The report of each mesh's flow, the source first; `None` where the flow could not begin.
    pub reports: [Option<FlowReport>; 2],
    /// The target's texture coordinates; `None` where its flow did not converge.
    target_atlas: Option<FlatAtlas>,
    faces: usize,
}

impl Flows {
    /// Runs both flows.
    ///
    /// # Errors
    /// The first flow that fails, or cancellation.
    pub fn new(
        input: MapInput<'_>,
        base: &BaseDomain,
        options: &PipelineOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, PipelineError> {
        let (_, source) =
            metric_of(MeshSide::Source, input, base, options, monitor).map_err(PipelineError::source_flow)?;
        let (metric, target) =
            metric_of(MeshSide::Target, input, base, options, monitor).map_err(PipelineError::target_flow)?;
        let atlas = flat_atlas(input.target, &metric, &input.landmarks.target.raw, monitor)?;
        Ok(Self {
            cones: cones(input, base, options),
            target_atlas: Some(atlas),
            reports: [Some(source), Some(target)],
            faces: input.target.face_count(),
        })
    }

    /// Runs both flows after the map is made: a flow that fails, or for which there is no time, becomes a warning, and the target's costs the
    /// texture.
    ///
    /// # Errors
    /// Cancellation only.
    pub fn beside_a_map(
        input: MapInput<'_>,
        base: &BaseDomain,
        options: &PipelineOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<(Self, Vec<Warning>), Cancelled> {
        let mut warnings = Vec::new();
        let mut tried = |side, monitor: &mut dyn Monitor| {
            let made = if_time(monitor, |monitor| match metric_of(side, input, base, options, monitor) {
                Err(FlowError::Cancelled(stop)) => Err(stop),
                outcome => Ok(outcome),
            });
            match made? {
                Some(Ok((metric, report))) => return Ok((Some(metric), Some(report))),
                None => warnings.push(Warning::NoTimeForConeMetric { side }),
                Some(Err(error)) => {
                    warnings.push(Warning::NoConeMetric { side, reason: error.to_string() });
                    if let FlowError::NotConverged { report, .. } = error {
                        return Ok((None, Some(*report)));
                    }
                }
            }
            Ok((None, None))
        };
        let (_, source) = tried(MeshSide::Source, &mut *monitor)?;
        let (metric, target) = tried(MeshSide::Target, &mut *monitor)?;
        let target_atlas = match &metric {
            Some(metric) => {
                let landmarks = &input.landmarks.target.raw;
                let atlas = if_time(monitor, |monitor| flat_atlas(input.target, metric, landmarks, monitor))?;
                if atlas.is_none() {
                    warnings.push(Warning::NoTimeForConeMetric { side: MeshSide::Target });
                }
                atlas
            }
            None => None,
        };
        let flows = Self {
            cones: cones(input, base, options),
            target_atlas,
            reports: [source, target],
            faces: input.target.face_count(),
        };
        Ok((flows, warnings))
    }

    /// Texture coordinates by corner of the target; all 0 where there are none.
    pub fn texture(&self) -> TiVec<HalfedgeId, DVec2> {
        match &self.target_atlas {
            Some(atlas) => atlas.corner_uvs.clone(),
            None => ti_vec![DVec2::ZERO; 3 * self.faces],
        }
    }

    /// L2 stretch of the texture coordinates; 1 for an isometry.
    pub fn l2_stretch(&self) -> Option<f64> {
        self.target_atlas.as_ref().map(|atlas| atlas.l2_stretch)
    }
}

/// Records the flows of both meshes to the curvatures `cones` (radians) at the landmarks. Log factors have the area-weighted mean 0.
///
/// # Errors
/// [`PipelineError::SourceFlow`] or [`PipelineError::TargetFlow`] where no metric has these curvatures, or cancellation. A flow that does not
/// converge is recorded as far as it came.
pub fn recorded_flows(
    input: MapInput<'_>,
    cones: &[f64],
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<[FlowRecord; 2], PipelineError> {
    on_both(input, cones, monitor, |mesh, curvature, monitor| {
        Ok(recorded_flow(mesh, curvature, &options.flow, monitor)?.centred(&mesh.vertex_areas()))
    })
}

/// Both meshes with flat metrics that have the curvatures `cones` (radians) at the landmarks, to be laid out in the plane.
///
/// # Errors
/// [`PipelineError::SourceFlow`] or [`PipelineError::TargetFlow`], or cancellation.
pub fn flat_surfaces(
    input: MapInput<'_>,
    cones: &[f64],
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<[FlatSurface; 2], PipelineError> {
    on_both(input, cones, monitor, |mesh, curvature, monitor| {
        let (metric, _) = flow(mesh, curvature, &options.flow, monitor)?;
        Ok(FlatSurface::new(&metric, curvature))
    })
}

/// Calls `flowed` for both meshes with target curvatures `cones` (radians) at the landmarks, 0 elsewhere.
fn on_both<T>(
    input: MapInput<'_>,
    cones: &[f64],
    monitor: &mut dyn Monitor,
    flowed: impl Fn(&SurfaceMesh, &TiVec<VertexId, f64>, &mut dyn Monitor) -> Result<T, FlowError>,
) -> Result<[T; 2], PipelineError> {
    let monitor = &mut Rising::new(monitor);
    let mut of_side = |stage, mesh: &SurfaceMesh, landmarks: &[VertexId]| {
        monitor.enter(stage);
        let mut curvature: TiVec<VertexId, f64> = ti_vec![0.0; mesh.vertex_count()];
        for (&v, &cone) in landmarks.iter().zip(cones) {
            curvature[v] = cone;
        }
        flowed(mesh, &curvature, monitor)
    };
    let Landmarks { source, target } = input.landmarks;
    Ok([
        of_side(Stage::SourceConeMetric, input.source, &source.raw).map_err(PipelineError::source_flow)?,
        of_side(Stage::TargetConeMetric, input.target, &target.raw).map_err(PipelineError::target_flow)?,
    ])
}

/// The flat cone metric of one of both meshes.
fn metric_of(
    side: MeshSide,
    input: MapInput<'_>,
    base: &BaseDomain,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<(ConeMetric, FlowReport), FlowError> {
    let (stage, mesh, landmarks) = match side {
        MeshSide::Source => (Stage::SourceConeMetric, input.source, &input.landmarks.source.raw),
        MeshSide::Target => (Stage::TargetConeMetric, input.target, &input.landmarks.target.raw),
    };
    monitor.enter(stage);
    cone_metric(mesh, landmarks, base, options, monitor)
}

/// Target curvature of each landmark, in radians.
fn cones(input: MapInput<'_>, base: &BaseDomain, options: &PipelineOptions) -> Vec<f64> {
    let target = &input.landmarks.target.raw;
    let goal = curvature(input.target, target, base, options.cones);
    target.iter().map(|&v| goal[v]).collect()
}

/// Target curvature of each vertex, in radians.
fn curvature(
    mesh: &SurfaceMesh,
    landmarks: &[VertexId],
    base: &BaseDomain,
    cones: Cones,
) -> TiVec<VertexId, f64> {
    match cones {
        Cones::BaseDomain => base_domain_curvature(mesh.vertex_count(), landmarks, base),
        Cones::Uniform => uniform_curvature(mesh.vertex_count(), landmarks),
    }
}

/// The flat cone metric of a mesh with its landmarks.
pub(super) fn cone_metric(
    mesh: &SurfaceMesh,
    landmarks: &[VertexId],
    base: &BaseDomain,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<(ConeMetric, FlowReport), FlowError> {
    let curvature = curvature(mesh, landmarks, base, options.cones);
    match flow(mesh, &curvature, &options.flow, monitor) {
        // Inversive distances of very thin triangles are lost in rounding; vertex scaling has no circles that could be too small.
        Err(FlowError::NotConverged { .. }) if options.flow.scheme == Scheme::Inversive => {
            let scaling = FlowOptions { scheme: Scheme::VertexScaling, ..options.flow };
            flow(mesh, &curvature, &scaling, monitor)
        }
        flown => flown,
    }
}
