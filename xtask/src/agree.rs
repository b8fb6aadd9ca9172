//! `cargo xtask agree`: compares maps made natively and as wasm.

use crate::run::{cargo, run, run_for};
use crate::{page, wasm};
use std::time::Duration;

/// Builds the program and the wasm modules, and runs `benches/agreement.mjs` on the pair files of the command line, or on all of
/// `../shared/data`. Fails where a number differs. The program is built in the profile of the tests, on which no number depends.
pub fn agree(rest: &[String]) -> Result<(), String> {
    page::ensure_packages()?;
    wasm::build(wasm::Optimised::Fully, wasm::Names::Removed)?;
    run(&cargo(), &["build"])?;
    let script = ["benches/agreement.mjs"].into_iter().chain(rest.iter().map(String::as_str));
    // The limit leaves time for two maps of each of 34 pairs.
    run_for(Duration::from_mins(60), "node", &script.collect::<Vec<_>>())
}
