//! `cargo xtask survey`: prints tables of many maps.

use crate::run::{cargo, run};

/// Prints a table of `benches/survey`; without a name it lists the tables.
pub fn survey(rest: &[String]) -> Result<(), String> {
    let table = ["bench", "--bench", "survey", "--"].into_iter().chain(rest.iter().map(String::as_str));
    run(&cargo(), &table.collect::<Vec<_>>())
}
