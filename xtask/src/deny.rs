//! Checks the crates that are built in against `deny.toml`: by `cargo deny` where it is installed, or else by the project's own check.

use crate::licences;
use crate::run::{cargo, run, works};

/// Fails where a crate has a licence or a source that `deny.toml` does not allow, is named without its version, or has a known weakness.
/// Crates in several versions are listed. Where `cargo deny` is not installed, only licences and sources are judged, and crates in several
/// versions listed. Where its database of weaknesses can't be fetched, the function prints that, and does not judge them.
pub fn check() -> Result<(), String> {
    if !works(&cargo(), &["deny", "--version"]) {
        return licences::check();
    }
    run(&cargo(), &["deny", "check", "licenses", "bans", "sources"])?;
    if !works(&cargo(), &["deny", "fetch", "db"]) {
        eprintln!("the crates were not compared with known weaknesses: their database can't be fetched");
        return Ok(());
    }
    run(&cargo(), &["deny", "check", "--disable-fetch", "advisories"])
}
