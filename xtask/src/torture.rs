//! `cargo xtask torture`: maps generated hostile geometry.

use crate::run::{cargo, run_for};
use std::time::Duration;

const USAGE: &str = "cargo xtask torture [--hours N | --minutes N] [--seed S] [--kinds NAME,NAME], or --case KIND-SEED for one of them";

/// Maps generated hostile cases for some minutes and prints the table of outcomes (`benches/survey/torture.rs`). Fails on a panic, a broken
/// bound and a map that `conemap_verify` rejects. The program is built in the profile of the tests, whose assertions find more faults.
pub fn torture(rest: &[String]) -> Result<(), String> {
    let mut arguments = vec!["test", "--bench", "survey", "--"];
    if let [option, name] = rest
        && option == "--case"
    {
        arguments.extend(["torture-case", "--pairs", name]);
        return run_for(Duration::from_mins(60), &cargo(), &arguments);
    }
    arguments.push("torture");
    let mut minutes = 10;
    for pair in rest.chunks(2) {
        match pair {
            [option, number] if option == "--minutes" => minutes = whole(option, number)?,
            [option, number] if option == "--hours" => minutes = whole(option, number)?.saturating_mul(60),
            [option, number] if option == "--seed" => {
                whole(option, number)?;
                arguments.extend([option.as_str(), number]);
            }
            [option, names] if option == "--kinds" => arguments.extend(["--pairs", names]),
            _ => return Err(USAGE.to_owned()),
        }
    }
    let told = minutes.to_string();
    arguments.extend(["--minutes", &told]);
    // Forty minutes more are left for the build and the last case.
    run_for(Duration::from_mins(u64::from(minutes) + 40), &cargo(), &arguments)
}

fn whole(option: &str, number: &str) -> Result<u32, String> {
    number.parse().map_err(|_| format!("{option} {number}: a whole number is needed"))
}
