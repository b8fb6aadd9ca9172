//! `conemap check`.

use crate::arguments::CheckArguments;
use crate::input::{self, Failure};
use crate::outputs;
use crate::told::print;
use conemap::mesh::check::{CheckedMesh, MeshFault, closed_genus_zero};
use conemap::mesh::repair::{ChangeReport, Gaps, RepairOptions, RepairRefusal, RepairedMesh, gaps, repaired};
use conemap::monitor::Silent;
use serde::Serialize;

/// Tells whether a mesh can be mapped, as it is or repaired; an error where it cannot.
pub fn run(arguments: &CheckArguments) -> Result<(), Failure> {
    // What cannot be written is found before the work is done.
    let out = arguments.out.as_deref().map(|out| Ok::<_, Failure>((out, input::format(out)?))).transpose()?;
    outputs::check([&arguments.mesh], arguments.out.iter().chain(&arguments.report).cloned())?;
    let soup = input::soup(&arguments.mesh)?;
    let fault = closed_genus_zero(&soup).err();
    let options = RepairOptions::from(arguments.repairs);
    let outcome = repaired(&soup, &options, &mut Silent);
    let gaps = if fault.is_some() { gaps(&soup, &options).ok().flatten() } else { None };
    // Both are tried, so that one that fails costs only itself.
    let written = match (out, &outcome) {
        (Some((out, format)), Ok(mesh)) => outputs::write(out, &format.write(&mesh.checked.mesh_in_file())),
        _ => Ok(()),
    };
    let report = CheckReport {
        gaps: gaps.map(Into::into),
        ..CheckReport::new(arguments.repair, fault.as_ref(), &outcome)
    };
    if let Some(path) = &arguments.report {
        outputs::write(path, &serde_json::to_vec_pretty(&report)?)?;
    }
    // On standard output the report stands in place of the sentences.
    if !arguments.report.as_deref().is_some_and(outputs::is_standard) {
        print(sentences(&report))?;
    }
    written?;
    let path = arguments.mesh.display();
    match (&report.refusal, &report.fault) {
        _ if report.can_be_mapped => Ok(()),
        (Some(refusal), _) if arguments.repair => Err(format!("{path}: {}", refusal.sentence).into()),
        (_, Some(fault)) => Err(format!("{path}: {}", fault.sentence).into()),
        _ => Err(format!("{path}: it cannot be mapped").into()),
    }
}

/// The report on a mesh, stable as JSON.
#[derive(Serialize)]
struct CheckReport {
    /// Whether the mesh can be mapped: as it is, or repaired where that was asked for.
    can_be_mapped: bool,
    /// Whether the repair was asked for; if not, `changes` tells what it would do.
    repaired: bool,
    /// The first fault of the mesh as it is.
    fault: Option<Fault>,
    /// Why it cannot be repaired.
    refusal: Option<Fault>,
    /// The changes of the repair; empty where there is none.
    changes: Vec<ChangeReport>,
    /// The gaps that `--join-within` may close; `null` where there are none.
    gaps: Option<GapReport>,
    /// Share of the repaired surface's area that is caps; `null` where the mesh cannot be repaired.
    cap_share: Option<f64>,
    /// Number of vertices of the repaired mesh.
    vertices: Option<usize>,
    /// Number of faces of the repaired mesh.
    faces: Option<usize>,
    /// The numbers in the file of its elements; `null` where they stay those of the file.
    numbers: Option<Numbers>,
}

/// Vertices on open edges beside each other.
#[derive(Serialize)]
struct GapReport {
    /// Number of vertices that the distance joins with others.
    vertices: usize,
    /// The distance, in the file's units.
    distance: f64,
}

impl From<Gaps> for GapReport {
    fn from(Gaps { vertices, distance }: Gaps) -> Self {
        Self { vertices, distance }
    }
}

/// A fault or a refusal.
#[derive(Serialize)]
struct Fault {
    /// The stable name of what is wrong.
    kind: &'static str,
    /// The sentence that says what it is, where, and what to do.
    sentence: String,
}

/// The numbers that elements of a repaired mesh have in outputs and reports: those of the file, from its number of vertices or
/// faces on for elements that the repair made.
#[derive(Serialize)]
struct Numbers {
    /// The number of each vertex of the repaired mesh.
    vertices: Vec<usize>,
    /// The number of each face of the repaired mesh.
    faces: Vec<usize>,
}

impl Numbers {
    /// The numbers of a mesh; `None` where all are the mesh's own, but for those that the repair made.
    fn of(checked: &CheckedMesh) -> Option<Self> {
        let vertices = checked.file_from_vertex();
        let faces: Vec<usize> = checked.mesh.faces().map(|f| checked.file_from_face(f).index()).collect();
        let own = |numbers: &[usize]| numbers.iter().enumerate().all(|(k, number)| k == *number);
        (!own(&vertices) || !own(&faces)).then_some(Self { vertices, faces })
    }
}

impl CheckReport {
    fn new(
        is_repair: bool,
        fault: Option<&MeshFault>,
        outcome: &Result<RepairedMesh, RepairRefusal>,
    ) -> Self {
        let mesh = outcome.as_ref().ok();
        let changes = mesh.map(|mesh| mesh.report.changes.iter().cloned().map(ChangeReport::from).collect());
        let refusal = outcome.as_ref().err();
        Self {
            can_be_mapped: fault.is_none() || is_repair && mesh.is_some(),
            repaired: is_repair,
            fault: fault.map(|fault| Fault { kind: fault.kind(), sentence: fault.to_string() }),
            refusal: refusal.map(|refusal| Fault { kind: refusal.kind(), sentence: refusal.to_string() }),
            changes: changes.unwrap_or_default(),
            gaps: None,
            cap_share: mesh.map(|mesh| mesh.report.cap_share),
            vertices: mesh.map(|mesh| mesh.checked.mesh.vertex_count()),
            faces: mesh.map(|mesh| mesh.checked.mesh.face_count()),
            numbers: mesh.and_then(|mesh| Numbers::of(&mesh.checked)),
        }
    }
}

/// The report in sentences.
fn sentences(report: &CheckReport) -> String {
    let first = match (&report.fault, &report.refusal) {
        (None, _) => "can be mapped as it is".to_owned(),
        (Some(_), None) if report.repaired => "can be mapped, repaired:".to_owned(),
        (Some(_), None) => {
            "can be mapped when it is repaired (--repair; conemap map does it by itself):".to_owned()
        }
        (Some(_), Some(refusal)) => format!("cannot be mapped, nor repaired: {}", refusal.sentence),
    };
    let changes = report.changes.iter().map(|change| format!("\n  {}{}", change.sentence, places(change)));
    let gaps = report.gaps.as_ref().map(|GapReport { vertices, distance }| {
        format!(
            "\n  {vertices} vertices on open edges lie near others at gaps: --join-within {distance:.1e} may close \
             these (in the file's units)"
        )
    });
    std::iter::once(first).chain(changes).chain(gaps).collect()
}

/// The first elements of a change.
fn places(change: &ChangeReport) -> String {
    let list = |name: &str, numbers: Vec<String>| {
        let more = if change.count > numbers.len() { ", ..." } else { "" };
        if numbers.is_empty() { String::new() } else { format!(": {name} {}{more}", numbers.join(", ")) }
    };
    let numbers = |elements: &[usize]| elements.iter().map(usize::to_string).collect::<Vec<_>>();
    let edges = change.edges.iter().map(|[a, b]| format!("{a}-{b}")).collect();
    let holes = change.holes.iter().map(|hole| {
        let first = hole.vertices.first().copied().unwrap_or_default();
        format!("{} edges from vertex {first}", hole.edges)
    });
    let handles = change.handles.iter().map(|handle| {
        let first = handle.vertices.first().copied().unwrap_or_default();
        let length = 100.0 * handle.loop_length;
        format!("{} edges from vertex {first} ({length:.2} % of the square root of the area)", handle.edges)
    });
    [
        list("vertices", numbers(&change.vertices)),
        list("edges", edges),
        // The number of faces is larger than that of the parts that were dropped.
        list(if change.kind == "dropped_parts" { "faces from" } else { "faces" }, numbers(&change.faces)),
        list("with", holes.collect()),
        list("with loops of", handles.collect()),
    ]
    .concat()
}
