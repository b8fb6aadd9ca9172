//! `conemap wrap`.

use crate::arguments::WrapArguments;
use crate::input::{self, Failure};
use crate::map::{self, Asked};
use crate::outputs;
use crate::told::say;
use conemap::io::detect;
use conemap::io::moved;
use conemap::job::{Normals, ReadOptions, WrappedFileReport};
use conemap::wrap::DistanceFigures;
use serde_json::json;

/// Maps the base onto the scan, and writes it laid there.
pub fn run(arguments: &WrapArguments) -> Result<(), Failure> {
    let base = input::bytes(&arguments.base)?;
    // What cannot be written is found before the work is done.
    let normals = if arguments.drop_normals { Normals::Dropped } else { Normals::Kept };
    check_files(arguments, &base, normals)?;
    let WrapArguments { base: file, scan, scan_landmarks, landmarks, out, report, .. } = arguments;
    let inputs = [file, scan, landmarks].into_iter().chain(scan_landmarks);
    outputs::check(inputs, report.iter().chain([out]).cloned())?;
    let asked = Asked {
        meshes: [&arguments.base, &arguments.scan],
        landmarks: std::iter::once(&arguments.landmarks).chain(&arguments.scan_landmarks).collect(),
        options: ReadOptions { mesh_faults: arguments.faults.into(), ..ReadOptions::default() },
        choices: arguments.choices,
        time_limit: arguments.time_limit,
        deadline: None,
    };
    let mut clock = asked.clock();
    let job = asked.read(&mut clock)?;
    let mut result = asked.map(&job, &mut clock)?;
    let map = job.map_file(&result, &arguments.choices);
    let map = map.ok_or(
        "a base is laid on by a map with pieces (by the method `relaxed`, and not without an overlay)",
    )?;
    let wrapped = job.taken(&map).wrapped(&base, normals, &mut clock)?;
    result.report.set_seconds(clock.stop());
    map::tell(&result);
    tell(&wrapped.report);
    outputs::write(&arguments.out, &wrapped.bytes)?;
    if let Some(path) = &arguments.report {
        let report = json!({ "map": result.report, "wrap": wrapped.report });
        outputs::write(path, &serde_json::to_vec_pretty(&report)?)?;
    }
    Ok(())
}

/// Whether the base can be written with other places, and the name of the result has its format's ending.
fn check_files(arguments: &WrapArguments, base: &[u8], normals: Normals) -> Result<(), Failure> {
    moved::check(base, normals).map_err(|error| format!("{}: {error}", arguments.base.display()))?;
    let endings = detect(base).map_or(&[][..], |format| format.endings());
    let ending = arguments.out.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    if endings.iter().any(|known| known.eq_ignore_ascii_case(ending)) {
        return Ok(());
    }
    let wanted = endings.join(" or .");
    Err(format!(
        "{}: the result has the base's format, so its name must end in .{wanted}",
        arguments.out.display()
    )
    .into())
}

fn tell(report: &WrappedFileReport) {
    let surface = &report.surface;
    say(format_args!(
        "wrapped: {} vertices on the scan, {} laid on where it has no surface, {} of loose parts",
        surface.on_scan, surface.extended, report.loose_vertices
    ));
    let told = |name: &str, figures: &DistanceFigures| {
        let [mean, p95, max] = [figures.mean, figures.p95, figures.max].map(|share| 100.0 * share);
        say(format_args!(
            "{name}: mean {mean:.3} %, 95 % within {p95:.3} %, largest {max:.2} % of the scan's size"
        ));
    };
    told("distance to the scan", &surface.distance.to_scan);
    told("distance from the scan", &surface.distance.from_scan);
    if let Some(quads) = &report.quads {
        say(format_args!(
            "{} quads: largest angle {:.1} degrees, {:.1} in the base as given; {} with one of 180 degrees or more",
            quads.count, quads.largest, quads.largest_before, quads.hollow
        ));
    }
    if surface.flipped_triangles > 0 {
        say(format_args!(
            "warning: {} triangles look the wrong way: see `flipped` in the report, and add landmarks there",
            surface.flipped_triangles
        ));
    }
    if report.has_old_normals {
        say(format_args!(
            "warning: the normals in the file are those of the base as given: let the program that opens it make new ones, or, \
             of an OBJ file, leave them out by --drop-normals"
        ));
    }
}
