//! Compares the cones of the base domain with equal cones (thesis fig. 4.15 to 4.18). Maps are made by the thesis' method, whose map
//! depends on the cones.

use crate::arguments::Arguments;
use crate::case::{Case, Limit};
use conemap::cone_metric::atlas::flat_atlas;
use conemap::cone_metric::{FlowOptions, flow};
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{Cones, MapResult, Method, PipelineOptions, run};
use typed_index_collections::{TiVec, ti_vec};

/// Maps each demo with either kind of cones (`--pairs NAME,...`: only the demos whose names begin so).
pub fn table(arguments: &Arguments) {
    println!(
        "{:20} {:12} {:>29} {:>7} {:>9} {:>15} {:>9} {:>8} {:>9}",
        "demo", "cones", "L2 stretch S T", "steps", "cg", "curvature error", "E", "mean log", "unmapped"
    );
    for case in arguments.demos().into_iter().map(Case::of_demo) {
        for (cones, variant) in [(Cones::BaseDomain, "base domain"), (Cones::Uniform, "uniform")] {
            let options = PipelineOptions { method: Method::Thesis, cones, ..arguments.options.clone() };
            let told = told(&case, &options, arguments.time_limit);
            println!(
                "{:20} {variant:12} {}",
                case.name,
                told.unwrap_or_else(|error| format!("FAILED: {error}"))
            );
        }
    }
}

/// The figures of a map and of the flows of both meshes, as a line.
fn told(case: &Case, options: &PipelineOptions, seconds: f64) -> Result<String, String> {
    let placed = case.placed()?;
    let input = Case::input(&placed);
    let result = run(input, options, &mut Limit::new(seconds)).map_err(|e| e.to_string())?;
    let stretch = |mesh: &SurfaceMesh, landmarks: &[VertexId]| {
        stretch(mesh, landmarks, &result.cone_curvatures, &options.flow)
    };
    let source = stretch(input.source, &input.landmarks.source.raw)?;
    let target = stretch(input.target, &input.landmarks.target.raw)?;
    Ok(line([source, target], &result))
}

/// The L2 stretch of a mesh's flat metric with these curvatures at the landmarks; 1 for an isometry.
fn stretch(
    mesh: &SurfaceMesh,
    landmarks: &[VertexId],
    cones: &[f64],
    options: &FlowOptions,
) -> Result<f64, String> {
    let mut curvature: TiVec<VertexId, f64> = ti_vec![0.0; mesh.vertex_count()];
    landmarks.iter().zip(cones).for_each(|(&v, &cone)| curvature[v] = cone);
    let (metric, _) = flow(mesh, &curvature, options, &mut Silent).map_err(|e| e.to_string())?;
    let atlas = flat_atlas(mesh, &metric, landmarks, &mut Silent).map_err(|e| e.to_string())?;
    Ok(atlas.l2_stretch)
}

fn line([source, target]: [f64; 2], result: &MapResult) -> String {
    let report = &result.report;
    let flows = [&report.cone_metric.source, &report.cone_metric.target];
    let [steps, iterations, errors] = [
        flows.map(|flow| flow.as_ref().map_or("-".into(), |f| f.newton_steps.to_string())),
        flows.map(|flow| flow.as_ref().map_or("-".into(), |f| f.cg_iterations.to_string())),
        flows.map(|flow| flow.as_ref().map_or("-".into(), |f| format!("{:.0e}", f.max_curvature_error))),
    ]
    .map(|both| both.join(" "));
    let distortion = &report.distortion;
    format!(
        "{source:14.3} {target:14.3} {steps:>7} {iterations:>9} {errors:>15} {:9.4} {:8.4} {:8.3}%",
        distortion.energy,
        distortion.mean_log,
        100.0 * report.unmapped_share
    )
}
