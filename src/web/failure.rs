//! The start of the module when it is loaded, and its errors.

use serde_json::json;
use wasm_bindgen::prelude::*;

/// Runs once when the module is loaded.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|panic| {
        console_error_panic_hook::hook(panic);
        // The page reads the sentence there (`failureOf`): the browser's own error says no more than that something broke off.
        let _ = js_sys::Reflect::set(&js_sys::global(), &"conemapPanic".into(), &panic.to_string().into());
    }));
}

/// An error as the page takes it: a string of JSON `{"code", "message"}`.
pub(super) fn failure(code: &str, message: impl std::fmt::Display) -> JsValue {
    JsValue::from_str(&json!({ "code": code, "message": message.to_string() }).to_string())
}
