//! Tables of many maps.

use crate::run::{cargo, run};

/// Runs a table of `benches/survey`; without a name it lists them.
pub fn survey(rest: &[String]) -> Result<(), String> {
    let table = ["bench", "--bench", "survey", "--"].into_iter().chain(rest.iter().map(String::as_str));
    run(&cargo(), &table.collect::<Vec<_>>())
}
