//! The wasm modules: built by cargo, made ready for the browser by wasm-bindgen at the version of Cargo.lock, which is a
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

/// How much is done for a module's size and speed; its results are the same to the last bit.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Optimised {
    /// As a whole, as it is published.
    Fully,
    /// In parts, which take both processors.
    ForTests,
}

/// A module: a package in `wasm/`, with the profile that it is compiled by.
struct Module {
    name: &'static str,
    profile: &'static str,
}

/// What the page needs at once, small; and what the workers of maps need, fast.
const MODULES: [Module; 2] =
    [Module { name: "page", profile: "web-page" }, Module { name: "core", profile: "web" }];

/// One profile for both modules, which share what they have in common.
const TEST_PROFILE: &str = "web-test";

/// Builds, of each module, `www/wasm/NAME.js`, its types and `NAME_bg.wasm`.
pub fn build(optimised: Optimised, names: Names) -> Result<(), String> {
    ensure_target()?;
    MODULES.iter().try_for_each(|Module { name, profile }| match optimised {
        Optimised::Fully => build_one(name, profile, names),
        Optimised::ForTests => build_one(name, TEST_PROFILE, names),
    })
}

fn build_one(name: &str, profile: &str, names: Names) -> Result<(), String> {
    let package = format!("conemap-{name}");
    run(&cargo(), &["build", "--package", &package, "--target", TARGET, "--profile", profile])?;
    let module = target_folder().join(TARGET).join(format!("{profile}/conemap_{name}.wasm"));
    bind(&module, name, names).map_err(|e| format!("wasm-bindgen failed: {e:#}"))
}

fn bind(module: &std::path::Path, name: &str, names: Names) -> Result<(), impl std::fmt::Display> {
    let mut bindgen = Bindgen::new();
    bindgen.input_path(module).out_name(name).typescript(true).remove_name_section(names == Names::Removed);
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
