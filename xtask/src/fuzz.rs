//! `cargo xtask fuzz`: tries the readers on changed files.

use crate::run::{cargo, run_with};

/// Has every reader (with `--reader NAME` only one) read `--runs` changed files, which all come from one `--seed`.
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
        let whole = |number: &str| {
            number.parse::<u64>().map(drop).map_err(|_| format!("{number}: a whole number is needed"))
        };
        let (variable, value) = match pair {
            [name, number] if name == "--runs" => whole(number).map(|()| ("CONEMAP_FUZZ_RUNS", number))?,
            [name, number] if name == "--seed" => whole(number).map(|()| ("CONEMAP_FUZZ_SEED", number))?,
            [name, reader] if name == "--reader" => ("CONEMAP_FUZZ_READER", reader),
            _ => return Err("cargo xtask fuzz [--runs N] [--seed S] [--reader NAME]".to_owned()),
        };
        variables.push((variable, value.as_str()));
    }
    run_with(&cargo(), &TEST, &variables)
}
