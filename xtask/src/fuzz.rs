//! Readers on changed files.

use crate::run::{cargo, run_with};

/// Runs every reader on many changed files: `--runs` of each, all from one `--seed`.
pub fn fuzz(rest: &[String]) -> Result<(), String> {
    const TEST: [&str; 8] = [
        "test",
        "--release",
        "--test",
        "hostile",
        "--",
        "--ignored",
        "--nocapture",
        "many_changed_files_are_answered",
    ];
    let mut variables = Vec::new();
    for pair in rest.chunks(2) {
        let (variable, number) = match pair {
            [name, number] if name == "--runs" => ("CONEMAP_FUZZ_RUNS", number),
            [name, number] if name == "--seed" => ("CONEMAP_FUZZ_SEED", number),
            _ => return Err("cargo xtask fuzz [--runs N] [--seed S]".to_owned()),
        };
        number.parse::<u64>().map_err(|_| format!("{number}: a whole number is needed"))?;
        variables.push((variable, number.as_str()));
    }
    run_with(&cargo(), &TEST, &variables)
}
