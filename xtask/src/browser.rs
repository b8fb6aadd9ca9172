//! A Chromium for the browser tests: the one that is there, else Playwright's own, else the system's package.

use crate::run::{output_of, run, works};
use std::path::Path;

/// Where the tests look before they take Playwright's own.
const SYSTEM: &str = "/usr/bin/chromium";

/// Runs the browser tests on the built page.
pub fn test() -> Result<(), String> {
    ensure_chromium()?;
    run("npm", &["test"])
}

fn ensure_chromium() -> Result<(), String> {
    if Path::new(SYSTEM).exists() || works("npx", &["playwright", "install", "chromium"]) {
        return Ok(());
    }
    let is_root = output_of("id", &["-u"]).is_some_and(|id| id == "0");
    if is_root && works("apt-get", &["--version"]) {
        run("apt-get", &["update", "-qq"])?;
        run("apt-get", &["install", "-y", "-qq", "chromium"])?;
    }
    let sentence = || format!("the browser tests need Chromium: install it so that {SYSTEM} exists");
    Path::new(SYSTEM).exists().then_some(()).ok_or_else(sentence)
}
