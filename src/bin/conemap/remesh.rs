//! `conemap remesh`.

use crate::arguments::RemeshArguments;
use crate::clock::Clock;
use crate::input::{self, Failure};
use conemap::monitor::Stage;
use conemap::remesh::{Options, remesh};
use serde_json::json;

/// Remeshes, and writes the mesh and its report.
pub fn run(arguments: &RemeshArguments) -> Result<(), Failure> {
    let out = &arguments.out;
    // Asked before the work is done.
    let format = input::format(out)?;
    let checked = input::mesh(&arguments.mesh, arguments.faults)?;
    let crease_angle = arguments.crease_angle.to_radians();
    let options = Options { crease_angle, ..Options::to_faces(arguments.faces) };
    let mut clock = Clock::start_only(Stage::Remeshing);
    let outcome = remesh(&checked.mesh, &options, &mut clock);
    let seconds = clock.stop();
    let remeshed = outcome.map_err(|e| format!("{}: {e}", arguments.mesh.display()))?;
    input::write(out, &format.write(&remeshed.mesh))?;
    if let Some(path) = &arguments.report {
        let mut value = serde_json::to_value(&remeshed.report)?;
        value["seconds"] = json!(seconds);
        input::write(path, &serde_json::to_vec_pretty(&value)?)?;
    }
    let report = &remeshed.report;
    eprintln!(
        "{} faces, edges {:.4} on the mean, least angle {:.1} degrees, largest distance {:.3e}",
        report.faces,
        report.edge_length.mean,
        report.min_angle,
        report.distance.from_original.max(report.distance.to_original)
    );
    Ok(())
}
