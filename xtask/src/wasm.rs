//! The wasm module: built by cargo, made ready for the browser by wasm-bindgen at the version of Cargo.lock, which is a
//! library of this helper.

use crate::run::{cargo, output_of, root, run};
use std::process::ExitCode;

const TARGET: &str = "wasm32-unknown-unknown";

/// Builds `www/wasm/conemap.js`, its types and `conemap_bg.wasm`.
pub fn build() -> Result<(), String> {
    build_with(&["--remove-name-section"])
}

/// The same with the names of all functions, for profilers.
pub fn build_named() -> Result<(), String> {
    build_with(&[])
}

fn build_with(options: &[&str]) -> Result<(), String> {
    ensure_target()?;
    // As a cdylib alone: with an rlib beside it cargo would leave out link-time optimisation.
    let build = ["rustc", "--lib", "--crate-type", "cdylib", "--target", TARGET, "--profile", "web"];
    run(&cargo(), &[&build[..], &["--no-default-features", "--features", "web"]].concat())?;
    let module = target_folder().join(TARGET).join("web/conemap.wasm");
    let folder = root().join("www/wasm");
    let arguments = [&["wasm-bindgen", "--target", "web"], options, &["--out-dir"]].concat();
    let arguments = arguments.into_iter().map(Into::into);
    let arguments = arguments.chain([folder.into_os_string(), module.into_os_string()]);
    wasm_bindgen_cli::wasm_bindgen::run_cli_with_args(arguments)
        .map_err(|e| format!("wasm-bindgen failed: {e:#}"))
}

/// Runs a wasm test binary in Node: cargo's runner for the wasm target.
pub fn test_runner(arguments: Vec<String>) -> ExitCode {
    let arguments = std::iter::once("wasm-bindgen-test-runner".to_owned()).chain(arguments);
    match wasm_bindgen_cli::wasm_bindgen_test_runner::run_cli_with_args(arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error:#}");
            ExitCode::FAILURE
        }
    }
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
