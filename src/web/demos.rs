//! Demos as files, for the page and for the workers of maps.

use crate::io::landmark_file::{self, LandmarkFile, LandmarkPoint};
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
    source: Vec<u8>,
    target: Vec<u8>,
    landmarks: Vec<u8>,
}

#[wasm_bindgen]
impl DemoFiles {
    /// The source as OBJ.
    pub fn source(&self) -> Vec<u8> {
        self.source.clone()
    }

    /// The target as OBJ.
    pub fn target(&self) -> Vec<u8> {
        self.target.clone()
    }

    /// The landmark file.
    pub fn landmarks(&self) -> Vec<u8> {
        self.landmarks.clone()
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
    Some(DemoFiles {
        source: export::obj::mesh(&demo.source),
        target: export::obj::mesh(&demo.target),
        landmarks: landmark_file::write(&file),
    })
}
