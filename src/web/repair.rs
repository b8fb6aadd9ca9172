//! Meshes as they come, repaired.

use super::failure;
use super::files::LoadedMesh;
use crate::io;
use crate::io::landmark_formats::Space;
use crate::mesh::repair::{ChangeReport, RepairOptions, RepairedMesh, repaired};
use crate::monitor::Silent;
use serde_json::json;
use wasm_bindgen::prelude::*;

/// A mesh file that was read and, where it had to be, repaired.
#[wasm_bindgen]
pub struct MeshReport {
    mesh: RepairedMesh,
    /// The coordinate system that its file names.
    space: Space,
}

#[wasm_bindgen]
impl MeshReport {
    /// The mesh.
    pub fn mesh(&self) -> LoadedMesh {
        LoadedMesh { checked: self.mesh.checked.clone(), space: self.space }
    }

    /// What was repaired, in a sentence without a full stop ("2 holes were capped (0.4 % of the area), 13 duplicate vertices were
    /// joined"); empty where the mesh was good as given.
    pub fn sentence(&self) -> String {
        let report = &self.mesh.report;
        if report.fault.is_some() { report.sentence() } else { String::new() }
    }

    /// The report as JSON `{"fault": {"kind", "sentence"} | null, "changes": [...], "capShare"}`; a change has `kind`, `sentence`,
    /// `count`, the first `vertices`, `edges`, `faces` or `holes` by their numbers in the file, and `area_share`.
    pub fn report(&self) -> String {
        let report = &self.mesh.report;
        let fault =
            report.fault.as_ref().map(|fault| json!({ "kind": fault.kind(), "sentence": fault.to_string() }));
        let changes: Vec<ChangeReport> = report.changes.iter().cloned().map(ChangeReport::from).collect();
        json!({ "fault": fault, "changes": changes, "capShare": report.cap_share }).to_string()
    }
}

/// Reads a mesh file of any known format and repairs what does not change its shape; holes are capped.
///
/// # Errors
/// `{"code": "file" | "mesh", "message"}`.
#[wasm_bindgen(js_name = repairMesh)]
pub fn repair_mesh(bytes: &[u8]) -> Result<MeshReport, JsValue> {
    let soup = io::read_mesh(bytes).map_err(|e| failure("file", e))?;
    let mesh = repaired(&soup, &RepairOptions::default(), &mut Silent).map_err(|e| failure("mesh", e))?;
    Ok(MeshReport { mesh, space: Space::of_mesh(bytes) })
}
