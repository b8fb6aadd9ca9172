//! Builds the wasm modules with cargo and makes them ready for the browser with wasm-bindgen, which is a library of this helper, in the
//! version that Cargo.lock names.

use crate::run::{cargo, output_of, root, run};
use wasm_bindgen_cli_support::Bindgen;

const TARGET: &str = "wasm32-unknown-unknown";

/// Whether a module keeps the names of its functions, which only profilers and traces need.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Names {
    Kept,
    Removed,
}

/// How far the compiler optimises the modules. Their results are the same to the last bit either way.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Optimised {
    /// Each module is compiled by itself and as a whole, as it is published.
    Fully,
    /// Both modules are compiled together, with one library, and not optimised as a whole (the profile `web-test`).
    ForTests,
}

/// A module: a package in `wasm/`, and the cargo profile that it is compiled by.
struct Module {
    name: &'static str,
    profile: &'static str,
}

/// The modules: the page's, which is needed at once and compiled to be small, and the core of the workers, which is compiled to be fast.
const MODULES: [Module; 2] =
    [Module { name: "page", profile: "web-page" }, Module { name: "core", profile: "web" }];

/// The cargo profile by which both modules are compiled together for the tests. Each then has the other's exports, too.
const TEST_PROFILE: &str = "web-test";

/// Builds the files of each module in `www/wasm/`: `NAME.js`, its types, and `NAME_bg.wasm`.
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

/// Compiles modules in one call of cargo. They then share one library, which has the features of all modules.
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

/// The folder into which cargo builds.
fn target_folder() -> std::path::PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), Into::into)
}
