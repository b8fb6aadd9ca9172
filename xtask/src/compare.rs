//! `cargo xtask compare`: compares the time of whole maps as wasm in a browser with that of the native program.

use crate::run::{cargo, run, run_with};
use crate::{browser, page, wasm};

/// Builds the program and the wasm modules, and runs `benches/wasm.mjs` on the pair files of the command line, or on the demos.
pub fn compare(rest: &[String]) -> Result<(), String> {
    page::ensure_packages()?;
    wasm::build(wasm::Optimised::Fully, wasm::Names::Removed)?;
    run(&cargo(), &["build", "--release"])?;
    let chromium = browser::chromium()?;
    let variables: Vec<(&str, &str)> =
        chromium.iter().map(|program| ("CHROMIUM", program.as_str())).collect();
    let script = ["benches/wasm.mjs"].into_iter().chain(rest.iter().map(String::as_str));
    run_with("node", &script.collect::<Vec<_>>(), &variables)
}
