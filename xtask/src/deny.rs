//! What may be built in, as `deny.toml` says: by `cargo deny` where it is installed, else by the project's own check.

use crate::licences;
use crate::run::{cargo, run, works};

/// Fails where a crate has a licence or a source that `deny.toml` does not allow, is named without its version, or has a known weakness. Several
/// versions of one crate are told. Where `cargo deny` is not installed only licences, sources and versions are judged; where its database of
/// weaknesses can't be fetched, that is said, and they are not.
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
