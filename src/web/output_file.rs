//! The files of a map by their names.

use super::failure;
use crate::job::{MORPH_FILE, OutputKind, TakenMap};
use crate::monitor::Silent;
use wasm_bindgen::prelude::*;

/// One file of a map by its name.
pub(super) fn file(map: TakenMap<'_>, name: &str) -> Result<Vec<u8>, JsValue> {
    if name == MORPH_FILE {
        return map.morph_glb(&mut Silent).map_err(|e| failure("export", e));
    }
    let kind = OutputKind::of(name).filter(|kind| map.kinds().contains(kind));
    let kind = kind.ok_or_else(|| failure("export", format!("this map gives no file \"{name}\"")))?;
    map.output(kind).map_err(|e| failure("export", e))
}
