//! The wasm module: built by cargo, made ready for the browser by wasm-bindgen at the version of Cargo.lock, which is a
//! library of this helper.

use crate::run::{cargo, output_of, root, run};
use wasm_bindgen_cli_support::Bindgen;

const TARGET: &str = "wasm32-unknown-unknown";

/// What becomes of the functions' names, which only profilers and traces need.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Names {
    Kept,
    Removed,
}

/// Builds `www/wasm/conemap.js`, its types and `conemap_bg.wasm`.
pub fn build(names: Names) -> Result<(), String> {
    ensure_target()?;
    // As a cdylib alone: with an rlib beside it cargo would leave out link-time optimisation.
    let build = ["rustc", "--lib", "--crate-type", "cdylib", "--target", TARGET, "--profile", "web"];
    run(&cargo(), &[&build[..], &["--no-default-features", "--features", "web"]].concat())?;
    let module = target_folder().join(TARGET).join("web/conemap.wasm");
    bind(&module, names).map_err(|e| format!("wasm-bindgen failed: {e:#}"))
}

fn bind(module: &std::path::Path, names: Names) -> Result<(), impl std::fmt::Display> {
    let mut bindgen = Bindgen::new();
    bindgen.input_path(module).typescript(true).remove_name_section(names == Names::Removed);
    bindgen.web(true)?.generate(root().join("www/wasm"))
}

/// Has rustup install the wasm target where it is missing.
pub fn ensure_target() -> Result<(), String> {
    let library = output_of("rustc", &["--print", "target-libdir", "--target", TARGET]);
    if library.is_some_and(|folder| std::path::Path::new(&folder).is_dir()) {
        return Ok(());
    }
    run("rustup", &["target", "add", TARGET]).map_err(|e| {
        format!("the Rust target {TARGET} is missing: install it with `rustup target add {TARGET}` ({e})")
    })
}

/// Where cargo builds.
fn target_folder() -> std::path::PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), Into::into)
}
