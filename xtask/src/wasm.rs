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
    /// In parts, which take both processors, and both modules from one library.
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

/// One profile for both modules, which are compiled together: each then has the other's exports, too.
const TEST_PROFILE: &str = "web-test";

/// Builds, of each module, `www/wasm/NAME.js`, its types and `NAME_bg.wasm`.
pub fn build(optimised: Optimised, names: Names) -> Result<(), String> {
    ensure_target()?;
    if optimised == Optimised::ForTests {
        compile(&MODULES.map(|module| module.name), TEST_PROFILE)?;
        return MODULES.iter().try_for_each(|module| make_ready(module.name, TEST_PROFILE, names));
    }
    MODULES.iter().try_for_each(|Module { name, profile }| {
        compile(&[name], profile)?;
        make_ready(name, profile, names)
    })
}

/// Compiles modules at once: then they share one library, which has the features of all of them.
fn compile(names: &[&str], profile: &str) -> Result<(), String> {
    let packages: Vec<String> = names.iter().map(|name| format!("--package=conemap-{name}")).collect();
    let packages: Vec<&str> = packages.iter().map(String::as_str).collect();
    run(&cargo(), &[&["build", "--target", TARGET, "--profile", profile][..], &packages].concat())
}

fn make_ready(name: &str, profile: &str, names: Names) -> Result<(), String> {
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
