//! `cargo xtask test`: the tests of the project.

use crate::run::{cargo, run, run_with};
use crate::wasm::Optimised;
use crate::{audit, browser, browsers, deny, page, wasm};
use std::time::Instant;

type Task<'a> = Box<dyn FnOnce() -> Outcome + 'a>;
type Outcome = Result<(), String>;

/// The project's packages without this helper.
const PACKAGES: [&str; 4] = ["--package", "conemap", "--package", "conemap-verify"];

/// Which tests are run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// All tests but the long ones, which are shown as ignored. They take some fifteen minutes on two processors from an empty build folder.
    Usual,
    /// All tests.
    All,
}

/// Runs the tests, the quick ones first. A failure does not keep the others from running; the failed ones are named at the end.
///
/// While the lints and the core's tests run, which leave one processor idle at times, the page is built and its types and lints are checked.
pub fn test(extent: Extent) -> Outcome {
    wasm::ensure_target()?;
    page::ensure_packages()?;
    std::thread::scope(|scope| {
        let optimised = if extent == Extent::All { Optimised::Fully } else { Optimised::ForTests };
        let page = scope
            .spawn(move || page::build(optimised).map(|()| script("check").and_then(|()| script("lint"))));
        let built = || page.join().unwrap_or_else(|_| Err("the build of the page panicked".into()));
        all([
            ("formatting", Box::new(formatting)),
            ("build helper", Box::new(helper)),
            ("lints", Box::new(move || lints(extent))),
            ("documentation", Box::new(documentation)),
            ("core", Box::new(move || core(extent))),
            // The page's tests come after the core's, since they compare the page's maps with those that the core's tests have left.
            ("page", Box::new(move || built().and_then(|told| told.and(script("unit"))))),
            ("browser", Box::new(move || browser::test(extent))),
            ("other browsers", Box::new(browsers::visit_others)),
        ])
    })
}

fn all(tasks: [(&str, Task<'_>); 8]) -> Outcome {
    let count = tasks.len();
    let mut failed = Vec::new();
    for (name, task) in tasks {
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
    println!("{} passed, {} failed", count - failed.len(), failed.len());
    if failed.is_empty() { Ok(()) } else { Err(format!("failed: {}", failed.join(", "))) }
}

fn formatting() -> Outcome {
    run(&cargo(), &["fmt", "--all", "--check"])
}

fn helper() -> Outcome {
    run(&cargo(), &["test", "--package", "xtask", "--profile", "tool"])
}

/// Lints the packages. The wasm boundary is linted only where all tests are asked for, since that compiles the libraries once more.
fn lints(extent: Extent) -> Outcome {
    deny::check()?;
    audit::check()?;
    run(&cargo(), &[&["clippy"][..], &PACKAGES, &["--all-targets", "--", "-D", "warnings"]].concat())?;
    if extent == Extent::Usual {
        return Ok(());
    }
    let web = [
        "clippy",
        "--lib",
        "--target",
        "wasm32-unknown-unknown",
        "--no-default-features",
        "--features",
        "web-page,web-core",
    ];
    run(&cargo(), &[&web[..], &["--", "-D", "warnings"]].concat())
}

fn documentation() -> Outcome {
    let strict = [("RUSTDOCFLAGS", "-D warnings")];
    run_with(&cargo(), &[&["doc"][..], &PACKAGES, &["--no-deps", "--quiet"]].concat(), &strict)
}

fn core(extent: Extent) -> Outcome {
    run(&cargo(), &[&["test", "--no-fail-fast"][..], &PACKAGES].concat())?;
    if extent == Extent::Usual {
        return Ok(());
    }
    // The library must build without the command line.
    run(&cargo(), &["check", "--lib", "--no-default-features"])?;
    run(&cargo(), &["test", "--test", "made_meshes", "--test", "real_meshes", "--", "--ignored"])
}

/// Runs a script of `package.json`.
fn script(name: &str) -> Outcome {
    run("npm", &["run", "--silent", name])
}
