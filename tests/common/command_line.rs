//! Runs of the command line as a program of its own.
#![allow(dead_code, reason = "every test binary uses another part")]

use crate::common;
use conemap::io::{self, landmark_file};
use conemap::mesh::VertexId;
use conemap::mesh::check::closed_genus_zero;
use serde_json::Value;
use std::ffi::OsStr;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Makes an empty folder for one test.
pub fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).unwrap();
    }
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

pub fn conemap<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    Command::new(env!("CARGO_BIN_EXE_conemap")).args(arguments).output().unwrap()
}

pub fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

pub fn json(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

/// Lines `vertex angle_defect` with equal defects.
pub fn cones(vertices: &[VertexId]) -> String {
    let defect = 4.0 * std::f64::consts::PI / vertices.len() as f64;
    vertices.iter().fold(String::from("# vertex angle_defect\n"), |mut text, v| {
        writeln!(text, "{} {defect}", v.0).unwrap();
        text
    })
}

/// Runs `map` with all outputs and checks them.
pub fn map_and_check([source, target, pairs]: [&Path; 3], folder: &Path) {
    let (out, report_file) = (folder.join("out"), folder.join("reports/report.json"));
    let output = conemap([
        OsStr::new("map"),
        source.as_os_str(),
        target.as_os_str(),
        OsStr::new("--landmarks"),
        pairs.as_os_str(),
        OsStr::new("--out"),
        out.as_os_str(),
        OsStr::new("--report"),
        report_file.as_os_str(),
    ]);
    assert!(output.status.success(), "{}", errors(&output));
    assert!(errors(&output).contains("certified bijective: 0 of "), "{}", errors(&output));

    let report = json(&report_file);
    let fields = common::json_fields(&report);
    let (seconds, fields): (Vec<_>, Vec<_>) = fields.into_iter().partition(|f| f.starts_with("seconds."));
    let mut expected = common::REPORT_FIELDS.to_vec();
    expected.sort_unstable();
    assert_eq!(fields, expected);
    for stage in ["class_search", "source_cone_metric", "target_cone_metric", "relaxation", "total"] {
        assert!(seconds.contains(&format!("seconds.{stage}")), "{seconds:?}");
    }
    assert_eq!(report["certificate"]["bijective"], true);
    assert!(report["cone_metric"]["target"]["seconds"].as_f64().unwrap() > 0.0);

    let read = |path: &Path| io::read_mesh(&std::fs::read(path).unwrap()).unwrap();
    let source_mesh = closed_genus_zero(&read(source)).unwrap().mesh;
    let glb = read(&out.join("source-with-target-texture.glb"));
    assert!(glb.polygons.len() >= source_mesh.face_count());
    let base = closed_genus_zero(&read(&out.join("base-domain.obj"))).unwrap().mesh;
    let landmarks = landmark_file::read(&std::fs::read(pairs).unwrap()).unwrap().pairs.len();
    assert_eq!(base.vertex_count(), landmarks);
    let csv = std::fs::read_to_string(out.join("vertex-images.csv")).unwrap();
    assert_eq!(csv.lines().count(), 1 + source_mesh.vertex_count());
    assert!(csv.lines().all(|line| line.split(',').count() == 8 && !line.ends_with(',')));
    check_distortion(&out, [source_mesh.vertex_count(), glb.polygons.len()]);
    // The landmarks of real pairs fit, but may leave a limb out.
    let findings = report["findings"].as_array().unwrap();
    assert!(findings.iter().all(|f| f["kind"] == "unmarked_limbs"), "{findings:?}");
    let faces = |side: &str| report["faces"][side].as_u64().unwrap();
    let checked = report["certificate"]["triangles"].as_u64().unwrap();
    // There are more triangles where the program inserted own cones.
    assert!(checked >= faces("source") + faces("target"), "{checked}");
}

/// Checks the files of distortion: no density and no angle distortion is below 1, no triangle is turned, and there are at least as many
/// triangles as were welded from the GLB.
fn check_distortion(out: &Path, [vertices, triangles]: [usize; 2]) {
    let rows = |name: &str| -> Vec<Vec<f64>> {
        let text = std::fs::read_to_string(out.join(name)).unwrap();
        text.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect()
    };
    let by_triangle = rows("distortion.csv");
    assert!(by_triangle.len() >= triangles, "{} {triangles}", by_triangle.len());
    for row in &by_triangle {
        let [_, _, _, density, angle, area] = row[..] else { panic!("{row:?}") };
        assert!(density > 1.0 - 1e-12 && angle > 1.0 - 1e-12 && area > 0.0, "{row:?}");
    }
    let by_vertex = rows("vertex-distortion.csv");
    assert_eq!(by_vertex.len(), vertices);
    assert!(by_vertex.iter().all(|row| row[1] > 1.0 - 1e-12));
}

/// Runs the program and returns its output; fails after a minute of wall time.
pub fn conemap_in_a_minute<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_conemap"));
    let mut child = command.args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let begun = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begun.elapsed() > Duration::from_secs(60) {
            child.kill().unwrap();
            panic!("{command:?} did not end");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    child.wait_with_output().unwrap()
}

/// Checks that the flow on the fixed triangulation of a mesh fails, with an exit code, a sentence and a report that say so, and that it
/// converges with flips.
pub fn a_failed_flow_reports(mesh: &Path, vertices: &[VertexId], folder: &Path) {
    let (list, report_file) = (folder.join("cones.txt"), folder.join("report.json"));
    std::fs::write(&list, cones(vertices)).unwrap();
    let arguments = |scheme: &'static str| {
        let flags = ["flow", "--scheme", scheme, "--cones"].map(OsStr::new);
        [&flags[..], &[list.as_os_str(), OsStr::new("--report"), report_file.as_os_str(), mesh.as_os_str()]]
            .concat()
    };
    let output = conemap(arguments("fixed-triangulation"));
    assert_eq!(output.status.code(), Some(1));
    assert!(errors(&output).contains("did not converge"), "{}", errors(&output));
    let report = json(&report_file);
    assert_eq!(report["converged"], false);
    assert!(report["cone_metric"]["residuals"].as_array().unwrap().len() > 1);

    let output = conemap(arguments("inversive"));
    assert!(output.status.success(), "{}", errors(&output));
    assert_eq!(json(&report_file)["converged"], true);
}
