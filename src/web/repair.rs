//! Meshes as they come, repaired.

use super::failure;
use super::loaded_mesh::LoadedMesh;
use crate::io;
use crate::io::appearance::{self, Appearance};
use crate::io::landmark_formats::Space;
use crate::mesh::VertexId;
use crate::mesh::check::CheckedMesh;
use crate::mesh::look::Look;
use crate::mesh::repair::{ChangeReport, RepairOptions, RepairRefusal, RepairReport, RepairedMesh, repaired};
use crate::monitor::Silent;
use serde_json::{Value, json};
use wasm_bindgen::prelude::*;

/// A mesh file that was read and, where it had to be, repaired.
#[wasm_bindgen]
pub struct MeshReport {
    checked: Option<CheckedMesh>,
    look: Option<Look>,
    /// Remarks on the parts of the mesh's look that cannot be used.
    remarks: Vec<String>,
    report: RepairReport,
    /// The coordinate system that its file names.
    space: Space,
}

#[wasm_bindgen]
impl MeshReport {
    /// The mesh; it can be taken once, and leaves the report's sentences.
    ///
    /// # Errors
    /// `{"code": "mesh", "message"}` the second time.
    #[wasm_bindgen(js_name = takeMesh)]
    pub fn take_mesh(&mut self) -> Result<LoadedMesh, JsValue> {
        let checked = self.checked.take().ok_or_else(|| failure("mesh", "the mesh was taken before"))?;
        Ok(LoadedMesh::new(checked, self.space, self.look.take()))
    }

    /// The repairs, in a sentence without a full stop ("2 holes were capped (0.4 % of the area), 13 duplicate vertices were joined"); empty
    /// where the mesh was good as given.
    pub fn sentence(&self) -> String {
        let report = &self.report;
        if report.fault.is_some() { report.sentence() } else { String::new() }
    }

    /// Remarks on the parts of the mesh's look that cannot be used, each a sentence without a full stop.
    pub fn remarks(&self) -> Vec<String> {
        self.remarks.clone()
    }

    /// The report as JSON `{"fault": {"kind", "sentence"} | null, "changes": [...], "capShare"}`; a change has `kind`, `sentence`,
    /// `count`, the first `vertices`, `edges`, `faces`, `holes` or `handles` by their numbers in the file, and `area_share`.
    pub fn report(&self) -> String {
        let report = &self.report;
        let fault =
            report.fault.as_ref().map(|fault| json!({ "kind": fault.kind(), "sentence": fault.to_string() }));
        let changes: Vec<ChangeReport> = report.changes.iter().cloned().map(ChangeReport::from).collect();
        json!({ "fault": fault, "changes": changes, "capShare": report.cap_share }).to_string()
    }
}

/// Reads a mesh file of any known format and repairs what does not change its shape, holes being capped, and what is allowed.
///
/// `allowed` is JSON: `{"parts": "largest-alone", "handles": "cut"}`, each left out where it is not allowed. `companion` is what comes with it
/// for its look: a picture, or what [`pack_materials`](super::files::pack_materials) has packed.
///
/// # Errors
/// `{"code": "file" | "mesh" | "options", "message"}`, and where a repair that was not allowed would help, `"offer"` with it: `{"kind":
/// "cut-handles", "handles", "longest"}` (the length of the longest loop in units of the square root of the area) or `{"kind":
/// "keep-largest", "parts", "share"}` (of the largest part in the area).
#[wasm_bindgen(js_name = repairMesh)]
pub fn repair_mesh(bytes: &[u8], allowed: &str, companion: Option<Vec<u8>>) -> Result<MeshReport, JsValue> {
    let options: RepairOptions = serde_json::from_str(allowed).map_err(|e| failure("options", e))?;
    let soup = io::read_mesh(bytes).map_err(|e| failure("file", e))?;
    let mesh = repaired(&soup, &options, &mut Silent).map_err(|refusal| {
        let value = json!({ "code": "mesh", "message": refusal.to_string(), "offer": offer(&refusal) });
        JsValue::from_str(&value.to_string())
    })?;
    let RepairedMesh { checked, report } = mesh;
    let Appearance { look, remarks } = appearance::read(bytes, &soup, companion.as_deref());
    let place = |v: VertexId| checked.frame.in_file(checked.mesh.positions()[v]);
    let look = look.and_then(|look| look.by_face(&soup, &checked, place));
    let remarks = remarks.iter().map(ToString::to_string).collect();
    Ok(MeshReport { checked: Some(checked), look, remarks, report, space: Space::of_mesh(bytes) })
}

/// The repair that would help.
fn offer(refusal: &RepairRefusal) -> Value {
    match refusal {
        RepairRefusal::Handles(handles) => {
            let longest = handles.iter().map(|handle| handle.loop_length).fold(0.0, f64::max);
            json!({ "kind": "cut-handles", "handles": handles.len(), "longest": longest })
        }
        RepairRefusal::Parts { count, area_share } => {
            json!({ "kind": "keep-largest", "parts": count, "share": 1.0 - area_share })
        }
        _ => Value::Null,
    }
}
