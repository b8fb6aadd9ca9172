//! The same maps natively and as wasm.

use crate::run::{cargo, run, run_for};
use crate::{page, wasm};
use std::time::Duration;

/// Builds both and runs `benches/agreement.mjs` on the pair files of the command line, or on all of `../shared/data`; fails where a number
/// differs. In the profile of the tests: a number does not depend on the profile.
pub fn agree(rest: &[String]) -> Result<(), String> {
    page::ensure_packages()?;
    wasm::build(wasm::Optimised::Fully, wasm::Names::Removed)?;
    run(&cargo(), &["build"])?;
    let script = ["benches/agreement.mjs"].into_iter().chain(rest.iter().map(String::as_str));
    // Two maps of each of 34 pairs.
    run_for(Duration::from_mins(60), "node", &script.collect::<Vec<_>>())
}
