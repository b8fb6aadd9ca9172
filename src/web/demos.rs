//! Demos as files, for the page and for the workers of maps.

#[cfg(feature = "web-page")]
use super::{failure, loaded_mesh::LoadedMesh, mesh_side};
use crate::io::landmark_file::{self, LandmarkFile, LandmarkPoint};
#[cfg(feature = "web-page")]
use crate::io::landmark_formats::Space;
use crate::mesh::SurfaceMesh;
#[cfg(feature = "web-page")]
use crate::mesh::{check::closed_genus_zero, soup::PolygonSoup};
use crate::{demo, export};
use serde_json::json;
use wasm_bindgen::prelude::*;

/// All demos as JSON `[{id, title, sentence}]`.
#[wasm_bindgen(js_name = demoList)]
pub fn demo_list() -> String {
    let entry = |d: &demo::DemoInfo| json!({ "id": d.id, "title": d.title, "sentence": d.sentence });
    serde_json::Value::from(demo::list().iter().map(entry).collect::<Vec<_>>()).to_string()
}

/// A demo as files.
#[wasm_bindgen]
pub struct DemoFiles {
    meshes: [SurfaceMesh; 2],
    landmarks: Vec<u8>,
}

#[wasm_bindgen]
impl DemoFiles {
    /// The source as OBJ.
    pub fn source(&self) -> Vec<u8> {
        export::obj::mesh(&self.meshes[0])
    }

    /// The target as OBJ.
    pub fn target(&self) -> Vec<u8> {
        export::obj::mesh(&self.meshes[1])
    }

    /// The landmark file.
    pub fn landmarks(&self) -> Vec<u8> {
        self.landmarks.clone()
    }
}

#[cfg(feature = "web-page")]
#[wasm_bindgen]
impl DemoFiles {
    /// One of the meshes, 0 the source and 1 the target: what reading its file would give, without the core.
    ///
    /// # Errors
    /// `{"code": "mesh", "message"}` where the demo is none that can be mapped.
    pub fn mesh(&self, side: usize) -> Result<LoadedMesh, JsValue> {
        let mesh = &self.meshes[mesh_side(side)?];
        let checked = closed_genus_zero(&PolygonSoup::from(mesh)).map_err(|e| failure("mesh", e))?;
        // The coordinate system of files that name none.
        Ok(LoadedMesh::new(checked, Space::Lps, None))
    }
}

/// Builds a demo; `undefined` for an unknown id.
#[wasm_bindgen(js_name = buildDemo)]
pub fn build_demo(id: &str) -> Option<DemoFiles> {
    let demo = demo::build(id)?;
    let file = LandmarkFile {
        pairs: demo.landmarks.iter().map(|pair| pair.map(LandmarkPoint::Vertex)).collect(),
        labels: Some(demo.labels),
        ..LandmarkFile::default()
    };
    Some(DemoFiles { meshes: [demo.source, demo.target], landmarks: landmark_file::write(&file) })
}
