//! Every mesh of the data folder remeshed to half, once and twice its faces.

use crate::arguments::Arguments;
use crate::common;
use conemap::mesh::SurfaceMesh;
use conemap::monitor::Silent;
use conemap::remesh::{Options, remesh};
use cpu_time::ThreadTime;

/// The folders of the data folder whose meshes are remeshed.
const FOLDERS: [&str; 4] = ["sumner", "tosca", "shrec07", "single"];
/// The numbers of faces that are asked for, as multiples of the given mesh's number.
const SHARES: [f64; 3] = [0.5, 1.0, 2.0];

/// Prints the table; `--pairs FOLDER/NAME,...` chooses meshes by their names or the beginnings of their names. The distances between the new
/// mesh and the given one are in units of the new mesh's mean edge length.
pub fn data_meshes(arguments: &Arguments) {
    println!(
        "{:22} {:>7} {:>7} {:>7} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7}",
        "mesh", "wanted", "faces", "off", "rounds", "deviation", "least", "mean", "to", "from", "cpu s"
    );
    let (mut failed, mut done, begun) = (0, 0, ThreadTime::now());
    for name in names(arguments) {
        let surface = common::read_mesh(&arguments.data.join(&name).with_extension("off"));
        for share in SHARES {
            let line = line(&name, &surface, (share * surface.face_count() as f64) as usize);
            println!("{}", line.as_ref().unwrap_or_else(|failure| failure));
            (failed, done) = (failed + usize::from(line.is_err()), done + usize::from(line.is_ok()));
        }
    }
    println!("{done} remeshed, {failed} failed; cpu {:.1} s", begun.elapsed().as_secs_f64());
}

fn names(arguments: &Arguments) -> Vec<String> {
    let mut names = Vec::new();
    for folder in FOLDERS {
        let files = std::fs::read_dir(arguments.data.join(folder)).expect("a folder of meshes");
        let name = |file: std::path::PathBuf| Some(format!("{folder}/{}", file.file_stem()?.to_str()?));
        names.extend(files.filter_map(|entry| name(entry.ok()?.path())));
    }
    names.retain(|name| arguments.pairs.is_empty() || arguments.pairs.iter().any(|p| name.starts_with(p)));
    names.sort();
    names
}

fn line(name: &str, surface: &SurfaceMesh, wanted: usize) -> Result<String, String> {
    let begun = ThreadTime::now();
    let outcome = remesh(surface, &Options::to_faces(wanted), &mut Silent);
    let seconds = begun.elapsed().as_secs_f64();
    let report = outcome.map_err(|error| format!("{name:22} {wanted:7} FAILED: {error}"))?.report;
    let edge = report.edge_length.mean;
    Ok(format!(
        "{name:22} {wanted:7} {:7} {:6.2}% {:6} {:8.1}% {:8.1}° {:8.1}° {:9.3} {:9.3} {seconds:7.2}",
        report.faces,
        100.0 * (report.faces as f64 / wanted as f64 - 1.0),
        report.rounds,
        100.0 * report.edge_length.deviation / edge,
        report.min_angle,
        report.mean_min_angle,
        report.distance.to_original / edge,
        report.distance.from_original / edge,
    ))
}
