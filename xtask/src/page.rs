//! Builds and serves the page: installs its node packages, and runs Vite.

use crate::run::{output_of, root, run, run_server};
use crate::wasm;

/// Builds the page and serves it; the rest of the command line goes to the server (`--port 8080`, `--host`).
pub fn serve(rest: &[String]) -> Result<(), String> {
    build(wasm::Optimised::Fully)?;
    let mut arguments = vec!["vite", "preview"];
    arguments.extend(rest.iter().map(String::as_str));
    run_server("npx", &arguments)
}

/// Builds the page into `dist/`.
pub fn build(optimised: wasm::Optimised) -> Result<(), String> {
    ensure_packages()?;
    wasm::build(optimised, wasm::Names::Removed)?;
    run("npx", &["vite", "build"])
}

/// Installs the node packages of `package-lock.json` where they are missing or older than it.
pub fn ensure_packages() -> Result<(), String> {
    let version = output_of("node", &["--version"]);
    let major =
        version.as_deref().and_then(|v| v.trim_start_matches('v').split('.').next()?.parse::<u32>().ok());
    if major.is_none_or(|major| major < 20) {
        let found = version.unwrap_or_else(|| "none".to_owned());
        return Err(format!(
            "Node 20 or newer is needed (found: {found}): install it from https://nodejs.org"
        ));
    }
    let changed = |path: &str| root().join(path).metadata().and_then(|data| data.modified()).ok();
    // npm writes `node_modules/.package-lock.json` when it has installed everything.
    let (wanted, installed) = (changed("package-lock.json"), changed("node_modules/.package-lock.json"));
    if installed.is_some() && installed >= wanted { Ok(()) } else { run("npm", &["ci"]) }
}
