//! Finds a Chromium for the browser tests: the one that is installed, or else the system's package, or else Playwright's own, which are
//! installed.

use crate::run::{output_of, run, run_with, works};
use crate::suite::Extent;

/// Names under which a Chromium may be on the PATH.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/// Runs the browser tests on the built page. Tests tagged `@long` run only where all are asked for. Tests tagged `@alone`, which measure
/// times, run one after the other when the rest is done.
pub fn test(extent: Extent) -> Result<(), String> {
    let variables: Vec<(&str, String)> =
        chromium()?.into_iter().map(|program| ("CHROMIUM", program)).collect();
    let variables: Vec<(&str, &str)> =
        variables.iter().map(|(name, value)| (*name, value.as_str())).collect();
    let chosen: &[&str] = match extent {
        Extent::Usual => &["--grep-invert", "@long"],
        Extent::All => &[],
    };
    let tests = |of: &[&str]| run_with("npm", &[&["test", "--"], of, chosen].concat(), &variables);
    let together = tests(&["--project", "together"]);
    let alone = tests(&["--project", "alone", "--workers", "1"]);
    together.and(alone)
}

/// The Chromium to use; `None` for Playwright's own.
pub fn chromium() -> Result<Option<String>, String> {
    if let Some(program) = installed() {
        return Ok(Some(program));
    }
    eprintln!("No Chromium was found (CHROMIUM may name one): it is installed now.");
    let is_root = output_of("id", &["-u"]).is_some_and(|id| id == "0");
    if is_root && works("apt-get", &["--version"]) {
        // The package brings the libraries that Chromium needs. Where it cannot be installed, Playwright's Chromium may still run.
        if let Err(sentence) = install_package() {
            eprintln!("{sentence}");
        }
        if let Some(program) = installed() {
            return Ok(Some(program));
        }
    }
    run("npx", &["playwright", "install", "chromium"]).map(|()| None).map_err(|error| {
        format!("the browser tests need Chromium: install it, so that `chromium` is on the PATH ({error})")
    })
}

/// A Chromium that is installed and starts: the one that `CHROMIUM` names, or one on the PATH.
fn installed() -> Option<String> {
    let named = std::env::var("CHROMIUM").ok();
    let paths = named.into_iter().chain(NAMES.iter().filter_map(|name| {
        let path = output_of("sh", &["-c", &format!("command -v {name}")])?;
        (!path.is_empty()).then_some(path)
    }));
    // On some systems a program of that name is there, but only prints how to install Chromium.
    paths.into_iter().find(|path| works(path, &["--version"]))
}

fn install_package() -> Result<(), String> {
    run("apt-get", &["update", "-qq"])?;
    let quiet = [("DEBIAN_FRONTEND", "noninteractive")];
    run_with("apt-get", &["install", "-y", "-qq", "chromium"], &quiet)
}
