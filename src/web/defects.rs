//! The defects of a mesh for the page: a list, and the buffers that the views draw.

use super::failure;
use crate::mesh::packing::{PackedError, Unpacker};
use crate::mesh::repair::{DefectGroup, Defects};
use crate::scene::defects::Look;
use glam::DVec3;
use serde_json::{Value, json};
use wasm_bindgen::prelude::*;

/// The largest number of defects of one kind that are listed.
const LISTED: usize = 50;

/// The defects of a mesh, or those that it had before it was repaired.
#[wasm_bindgen]
pub struct MeshDefects {
    pub(super) defects: Defects,
    /// Unit normals at the positions of the mesh.
    pub(super) normals: Vec<DVec3>,
}

impl MeshDefects {
    fn unpacked(bytes: &[u8]) -> Result<Self, PackedError> {
        let mut unpacker = Unpacker::new(bytes);
        let defects = Defects::unpack(&mut unpacker)?;
        unpacker.end()?;
        Ok(Self { normals: defects.normals(), defects })
    }
}

#[wasm_bindgen]
impl MeshDefects {
    /// Number of faces that are drawn: the triangulated file's.
    #[wasm_bindgen(getter, js_name = faceCount)]
    pub fn face_count(&self) -> usize {
        self.defects.triangles.len()
    }

    /// The kinds of which there are some, as JSON `[{"kind", "sentence", "count", "drawn", "labels", "colour", "stroke", "fill",
    /// "sign"}]`: `sentence` as in "3 open rims", `labels` of the first 50, `colour` as style sheets write it, `stroke` of lines
    /// (`solid`, `dashed`, `dotted`, `dash-dot`, `double`), `fill` of faces (`stripes`, `grid`, `dots`, `bars`) and `sign` of
    /// places (`diamond`, `cross`) null where the kind has none.
    pub fn list(&self) -> String {
        let group = |group: &DefectGroup| {
            let look = Look::of(group.kind);
            let label = |defect| self.defects.label(group.kind, defect);
            let labels: Vec<String> = group.defects.iter().take(LISTED).map(label).collect();
            json!({
                "kind": group.kind,
                "sentence": group.to_string(),
                "count": group.count,
                "drawn": group.defects.len(),
                "labels": labels,
                "colour": format!("#{:06x}", look.colour),
                "stroke": look.stroke,
                "fill": look.fill,
                "sign": look.sign,
            })
        };
        Value::from(self.defects.groups.iter().map(group).collect::<Vec<_>>()).to_string()
    }
}

/// The defects that another instance of this build has packed.
///
/// # Errors
/// `{"code": "packed", "message"}` where the bytes are no such thing.
#[wasm_bindgen(js_name = unpackDefects)]
pub fn unpack_defects(bytes: &[u8]) -> Result<MeshDefects, JsValue> {
    MeshDefects::unpacked(bytes).map_err(|e| failure("packed", e))
}
