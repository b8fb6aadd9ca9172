//! Flows by each discrete conformal structure: each demo's meshes flow to flat metrics with the cones of the target's base domain.

use crate::arguments::Arguments;
use crate::case::Case;
use conemap::base_domain;
use conemap::cone_metric::atlas::flat_atlas;
use conemap::cone_metric::{FlowError, FlowOptions, Scheme, base_domain_curvature, flow};
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use cpu_time::ProcessTime;
use typed_index_collections::{TiVec, ti_vec};

/// Prints each demo's flows by each structure (`--pairs NAME,...`: only the demos whose names begin so).
pub fn table(arguments: &Arguments) {
    println!(
        "{:20} {:18} {:6} {:>5} {:>5} {:>15} {:>11} {:>7}  stopped at",
        "demo", "structure", "mesh", "steps", "cg", "curvature error", "L2 stretch", "cpu s"
    );
    for case in arguments.demos().into_iter().map(Case::of_demo) {
        if let Err(error) = tell(&case) {
            println!("{:20} FAILED: {error}", case.name);
        }
    }
}

/// Prints the lines of both meshes by each structure.
fn tell(case: &Case) -> Result<(), String> {
    let placed = case.placed()?;
    let input = Case::input(&placed);
    let landmarks = [&input.landmarks.source, &input.landmarks.target];
    let base =
        base_domain::simplify(input.target, &landmarks[1].raw, &mut Silent).map_err(|e| e.to_string())?;
    let goal = base_domain_curvature(input.target.vertex_count(), &landmarks[1].raw, &base);
    let sides = [("source", input.source, landmarks[0]), ("target", input.target, landmarks[1])];
    for scheme in Scheme::ALL {
        for (name, mesh, own) in sides {
            let mut curvature: TiVec<VertexId, f64> = ti_vec![0.0; mesh.vertex_count()];
            own.iter().zip(landmarks[1]).for_each(|(&v, &t)| curvature[v] = goal[t]);
            let line = flowed(mesh, &own.raw, &curvature, scheme)?;
            println!("{:20} {:18} {name:6} {line}", case.name, format!("{scheme:?}"));
        }
    }
    Ok(())
}

/// Makes one flow and returns its figures as a line; a flow that does not converge has no stretch.
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
