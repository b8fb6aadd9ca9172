//! Every test of the project.

use crate::run::{cargo, run, run_with};
use crate::{browser, page, wasm};
use std::time::Instant;

type Task = fn() -> Result<(), String>;

/// In this order, the quick ones first; all are run, and the failed ones are named at the end.
const TASKS: [(&str, Task); 7] = [
    ("formatting", formatting),
    ("build helper", helper),
    ("lints", lints),
    ("documentation", documentation),
    ("core", core),
    ("page", checks),
    ("browser", browser_tests),
];

/// The project's packages but this helper.
const PACKAGES: [&str; 4] = ["--package", "conemap", "--package", "conemap-verify"];

/// Runs every test.
pub fn test() -> Result<(), String> {
    wasm::ensure_target()?;
    page::ensure_packages()?;
    let mut failed = Vec::new();
    for (name, task) in TASKS {
        let begun = Instant::now();
        let outcome = task();
        let seconds = begun.elapsed().as_secs();
        match outcome {
            Ok(()) => eprintln!("== {name}: passed in {seconds} s"),
            Err(error) => {
                eprintln!("== {name}: {error}, after {seconds} s");
                failed.push(name);
            }
        }
    }
    println!("{} passed, {} failed", TASKS.len() - failed.len(), failed.len());
    if failed.is_empty() { Ok(()) } else { Err(format!("failed: {}", failed.join(", "))) }
}

fn formatting() -> Result<(), String> {
    run(&cargo(), &["fmt", "--all", "--check"])
}

fn helper() -> Result<(), String> {
    run(&cargo(), &["test", "--package", "xtask", "--profile", "tool"])
}

fn lints() -> Result<(), String> {
    run(&cargo(), &[&["clippy"][..], &PACKAGES, &["--all-targets", "--", "-D", "warnings"]].concat())?;
    // The core alone is built for wasm by the tests in Node.
    let web = [
        "clippy",
        "--lib",
        "--target",
        "wasm32-unknown-unknown",
        "--no-default-features",
        "--features",
        "web",
    ];
    run(&cargo(), &[&web[..], &["--", "-D", "warnings"]].concat())
}

fn documentation() -> Result<(), String> {
    let strict = [("RUSTDOCFLAGS", "-D warnings")];
    run_with(&cargo(), &[&["doc"][..], &PACKAGES, &["--no-deps", "--quiet"]].concat(), &strict)
}

fn core() -> Result<(), String> {
    // The library alone builds without the command line; the tests then run with it.
    run(&cargo(), &["check", "--lib", "--no-default-features"])?;
    run(&cargo(), &[&["test"][..], &PACKAGES].concat())
}

fn checks() -> Result<(), String> {
    page::build()?;
    run("npm", &["run", "--silent", "check"])?;
    run("npm", &["run", "--silent", "lint"])?;
    run("npm", &["run", "--silent", "unit"])
}

fn browser_tests() -> Result<(), String> {
    browser::test()
}
