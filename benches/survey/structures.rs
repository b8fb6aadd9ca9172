//! The family of flows: each discrete conformal structure on each demo, to the cones of the target's base domain.

use crate::arguments::Arguments;
use crate::case::Case;
use conemap::base_domain;
use conemap::cone_metric::atlas::flat_atlas;
use conemap::cone_metric::{FlowError, FlowOptions, Scheme, base_domain_curvature, flow};
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use cpu_time::ProcessTime;
use typed_index_collections::{TiVec, ti_vec};

/// Each demo's flows by each structure (`--pairs NAME,...`: of those that begin so).
pub fn table(arguments: &Arguments) {
    println!(
        "{:20} {:18} {:6} {:>5} {:>5} {:>15} {:>11} {:>7}  stopped at",
        "demo", "structure", "mesh", "steps", "cg", "curvature error", "L2 stretch", "cpu s"
    );
    for case in arguments.demos().into_iter().map(Case::of_demo) {
        for scheme in Scheme::ALL {
            match told(&case, scheme) {
                Ok(lines) => lines.iter().for_each(|line| println!("{:20} {line}", case.name)),
                Err(error) => println!("{:20} {scheme:?} FAILED: {error}", case.name),
            }
        }
    }
}

/// The lines of both meshes.
fn told(case: &Case, scheme: Scheme) -> Result<[String; 2], String> {
    let placed = case.placed()?;
    let input = Case::input(&placed);
    let landmarks = [&input.landmarks.source, &input.landmarks.target];
    let base = base_domain::simplify(input.target, landmarks[1], &mut Silent).map_err(|e| e.to_string())?;
    let goal = base_domain_curvature(input.target.vertex_count(), landmarks[1], &base);
    let line = |name: &str, mesh: &SurfaceMesh, own: &[VertexId]| -> Result<String, String> {
        let mut curvature: TiVec<VertexId, f64> = ti_vec![0.0; mesh.vertex_count()];
        own.iter().zip(landmarks[1]).for_each(|(&v, &t)| curvature[v] = goal[t]);
        Ok(format!("{:18} {name:6} {}", format!("{scheme:?}"), flowed(mesh, own, &curvature, scheme)?))
    };
    Ok([line("source", input.source, landmarks[0])?, line("target", input.target, landmarks[1])?])
}

/// What one flow came to.
fn flowed(
    mesh: &SurfaceMesh,
    landmarks: &[VertexId],
    curvature: &TiVec<VertexId, f64>,
    scheme: Scheme,
) -> Result<String, String> {
    let options = FlowOptions { scheme, ..FlowOptions::default() };
    let begun = ProcessTime::now();
    let outcome = flow(mesh, curvature, &options, &mut Silent);
    let seconds = begun.elapsed().as_secs_f64();
    let (report, stretch) = match outcome {
        Ok((metric, report)) => {
            let atlas = flat_atlas(mesh, &metric, landmarks, &mut Silent).map_err(|e| e.to_string())?;
            (report, format!("{:.4}", atlas.l2_stretch))
        }
        Err(FlowError::NotConverged { report, .. }) => (*report, "-".into()),
        Err(error) => return Err(error.to_string()),
    };
    let stops: Vec<String> = report.degenerate_faces.iter().map(|f| f.index().to_string()).collect();
    Ok(format!(
        "{:5} {:5} {:15.0e} {stretch:>11} {seconds:7.2}  {}",
        report.newton_steps,
        report.cg_iterations,
        report.max_curvature_error,
        stops.join(" ")
    ))
}
