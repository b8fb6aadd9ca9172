//! `conemap flow`.

use crate::arguments::FlowArguments;
use crate::clock::Clock;
use crate::input::{self, Failure};
use crate::outputs;
use conemap::cone_metric::{FlowError, FlowOptions, check_defect, flow, listed_curvature};
use conemap::mesh::check::CheckedMesh;
use conemap::monitor::{Monitor, Stage};
use conemap::pipeline::ConeMetricReport;
use serde_json::json;
use std::collections::BTreeMap;

/// Runs one flow and writes its report; an error where it did not converge.
pub fn run(arguments: &FlowArguments) -> Result<(), Failure> {
    outputs::check([&arguments.mesh, &arguments.cones], arguments.report.clone())?;
    let checked = input::mesh(&arguments.mesh, arguments.faults)?;
    let mesh = &checked.mesh;
    let cones = cones(arguments, &checked)?;
    let curvature = listed_curvature(mesh.vertex_count(), &cones)?;
    let options = FlowOptions { scheme: arguments.scheme, ..FlowOptions::default() };
    let mut clock = Clock::start_only(Stage::SourceConeMetric);
    clock.enter(Stage::SourceConeMetric);
    let outcome = flow(mesh, &curvature, &options, &mut clock);
    let seconds = clock.stop();
    let (report, failure) = match outcome {
        Ok((_, report)) => (report, None),
        Err(FlowError::NotConverged { best, report }) => {
            let failure = FlowError::NotConverged { best, report: report.clone() };
            (*report, Some(failure))
        }
        Err(error @ FlowError::Target(_)) => {
            return Err(format!("{}: {error}", arguments.cones.display()).into());
        }
        Err(error) => return Err(error.into()),
    };
    if let Some(path) = &arguments.report {
        let total = seconds.get("total").copied().unwrap_or_default();
        let flow = ConeMetricReport { seconds: total, ..ConeMetricReport::from(&report) };
        let stops: Vec<u32> = report.degenerate_faces.iter().map(|&f| checked.file_from_face(f).0).collect();
        let value = json!({
            "converged": failure.is_none(),
            "cone_metric": flow,
            "faces": mesh.face_count(),
            "degenerate_faces": stops,
        });
        outputs::write(path, &serde_json::to_vec_pretty(&value)?)?;
    }
    failure.map_or(Ok(()), |error| Err(error.into()))
}

/// Reads lines `vertex angle_defect`, with no vertex on two of them.
fn cones(arguments: &FlowArguments, checked: &CheckedMesh) -> Result<Vec<(usize, f64)>, Failure> {
    let path = arguments.cones.display();
    let text =
        String::from_utf8(input::bytes(&arguments.cones)?).map_err(|_| format!("{path}: it is not text"))?;
    let mut cones = Vec::new();
    let mut lines = BTreeMap::new();
    for (line, content) in
        text.lines().enumerate().map(|(i, l)| (i + 1, l.split('#').next().unwrap_or_default()))
    {
        let words: Vec<_> = content.split_whitespace().collect();
        let parsed = match words[..] {
            [] => continue,
            [vertex, defect] => vertex.parse::<usize>().ok().zip(defect.parse::<f64>().ok()),
            _ => None,
        };
        let (vertex, defect) = parsed.ok_or_else(|| {
            format!("{path}, line {line}: expected `vertex angle_defect`, found \"{content}\"")
        })?;
        let v = checked.numbered_vertex(vertex).map_err(|e| format!("{path}, line {line}: {e}"))?;
        check_defect(vertex, defect).map_err(|e| format!("{path}, line {line}: {e}"))?;
        if let Some(first) = lines.insert(v, line) {
            return Err(
                format!("{path}, line {line}: vertex {vertex} has an angle defect on line {first}").into()
            );
        }
        cones.push((v.index(), defect));
    }
    Ok(cones)
}
