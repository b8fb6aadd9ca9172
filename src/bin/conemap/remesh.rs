//! `conemap remesh`.

use crate::arguments::RemeshArguments;
use crate::clock::Clock;
use crate::input::{self, Failure};
use crate::outputs;
use crate::told::say;
use conemap::monitor::Stage;
use conemap::remesh::{Options, remesh};
use serde_json::json;

/// Remeshes, and writes the mesh and its report.
pub fn run(arguments: &RemeshArguments) -> Result<(), Failure> {
    let out = &arguments.out;
    // What cannot be written is found before the work is done.
    let format = input::format(out)?;
    outputs::check([&arguments.mesh], std::iter::once(out).chain(&arguments.report).cloned())?;
    let checked = input::mesh(&arguments.mesh, arguments.faults)?;
    let crease_angle = arguments.crease_angle.to_radians();
    let options = Options { crease_angle, ..Options::to_faces(arguments.faces) };
    let mut clock = Clock::start_only(Stage::Remeshing);
    let outcome = remesh(&checked.mesh, &options, &mut clock);
    let seconds = clock.stop();
    let remeshed = outcome.map_err(|e| format!("{}: {e}", arguments.mesh.display()))?;
    let frame = checked.frame;
    let report = remeshed.report.scaled(frame.scale());
    let places = remeshed.mesh.positions().iter().map(|p| frame.in_file(*p)).collect();
    let mesh = remeshed.mesh.with_positions(places);
    // Both are tried, so that one that fails costs only itself.
    let written = outputs::write(out, &format.write(&mesh));
    if let Some(path) = &arguments.report {
        let mut value = serde_json::to_value(&report)?;
        value["seconds"] = json!(seconds);
        outputs::write(path, &serde_json::to_vec_pretty(&value)?)?;
    }
    say(format_args!(
        "{} faces, edges {:.3e} on the mean, least angle {:.1} degrees, largest distance {:.3e}",
        report.faces,
        report.edge_length.mean,
        report.min_angle,
        report.distance.from_original.max(report.distance.to_original)
    ));
    written
}
