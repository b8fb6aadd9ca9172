//! Visits the built page in browsers of other makers: Firefox, and WebKit as GNOME has it.

use crate::page;
use crate::run::{output_of, run, run_with, works};
use crate::wasm::Optimised;

/// The Debian packages that a visit needs, each with a program that it brings.
const PACKAGES: [(&str, &str); 3] =
    [("firefox-esr", "firefox-esr"), ("webkit2gtk-driver", "WebKitWebDriver"), ("xvfb", "xvfb-run")];

/// Builds the page and visits it in all three browsers. On Debian, missing browsers are installed first where the user is root.
pub fn build_and_visit() -> Result<(), String> {
    page::build(Optimised::Fully)?;
    install()?;
    visit("Chromium|Firefox|WebKit")
}

/// Visits the page that was built, in the browsers that are installed beside Chromium.
pub fn visit_others() -> Result<(), String> {
    let names = ["firefox-esr", "firefox", "WebKitWebDriver"];
    if names.into_iter().any(is_there) {
        visit("Firefox|WebKit")
    } else {
        eprintln!(
            "Neither Firefox nor WebKitWebDriver is installed: the page is not visited in them. \
             `cargo xtask browsers` installs both on Debian, as root."
        );
        Ok(())
    }
}

/// Visits the page in the browsers whose names match. The browsers draw by software, on a virtual screen where `xvfb-run` is installed.
fn visit(names: &str) -> Result<(), String> {
    let command = ["npm", "run", "--silent", "browsers", "--", "-t", names];
    let software = [("LIBGL_ALWAYS_SOFTWARE", "1")];
    if is_there("xvfb-run") {
        let screen = ["-a", "-s", "-screen 0 1400x900x24 +extension GLX"];
        run_with("xvfb-run", &[&screen[..], &command].concat(), &software)
    } else {
        run_with(command[0], &command[1..], &software)
    }
}

fn is_there(program: &str) -> bool {
    output_of("sh", &["-c", &format!("command -v {program}")]).is_some_and(|path| !path.is_empty())
}

fn install() -> Result<(), String> {
    let missing: Vec<&str> =
        PACKAGES.iter().filter(|(_, program)| !is_there(program)).map(|(package, _)| *package).collect();
    let is_root = output_of("id", &["-u"]).is_some_and(|id| id == "0");
    if missing.is_empty() || !is_root || !works("apt-get", &["--version"]) {
        return Ok(());
    }
    run("apt-get", &["update", "-qq"])?;
    let quiet = [("DEBIAN_FRONTEND", "noninteractive")];
    let arguments = ["install", "-y", "-qq", "libgl1-mesa-dri", "libegl1", "libgl1"];
    run_with("apt-get", &[&arguments[..], &missing].concat(), &quiet)
}
