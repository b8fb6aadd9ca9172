//! The tests on real meshes, which are not part of the project and lie beside it (`../shared/data`). In a plain checkout each test is shown
//! as ignored, by its name; where the folder exists, a missing file fails the tests that read it, and they name it. The long tests are
//! ignored unless asked for (`--include-ignored`, `cargo xtask test --all`).
#![allow(clippy::unwrap_used, reason = "a failing helper is a failing test")]
#![allow(clippy::print_stderr, reason = "says once why tests are ignored")]

use libtest_mimic::{Arguments, Failed, Trial};
use std::path::Path;
use std::process::ExitCode;

#[path = "../common/classes.rs"]
mod classes;
#[path = "../common/clicked.rs"]
mod clicked;
#[cfg(feature = "cli")]
#[path = "../common/command_line.rs"]
mod command_line;
#[path = "../common/mod.rs"]
mod common;
#[path = "../common/cutting.rs"]
mod cutting;
#[path = "../common/distance_bounds.rs"]
mod distance_bounds;
#[path = "../common/ends.rs"]
mod ends;
#[path = "../common/fit.rs"]
mod fit;
#[path = "../common/other_triangles.rs"]
mod other_triangles;
#[path = "../common/points.rs"]
mod points;
#[path = "../common/punching.rs"]
mod punching;
#[path = "../common/quads.rs"]
mod quads;
#[path = "../common/remeshing.rs"]
mod remeshing;
#[path = "../common/shrec07.rs"]
mod shrec07;
#[path = "../common/theorems.rs"]
mod theorems;

/// The tests of a module, by their functions' names, and after `long:` those that take too long for every run. The compiler warns of a
/// function that is left out, since it is unused.
macro_rules! tests {
    ($($name:ident),* $(,)? $(; long: $($long:ident),+ $(,)?)?) => {
        pub fn tests() -> Vec<crate::Test> {
            vec![
                $(crate::Test { name: stringify!($name), run: $name, length: crate::Length::Short },)*
                $($(crate::Test { name: stringify!($long), run: $long, length: crate::Length::Long },)+)?
            ]
        }
    };
}

mod bad_input;
mod base;
mod borders;
#[cfg(feature = "cli")]
mod cli;
mod clicks;
mod data;
mod few;
mod flow;
mod geodesic;
mod landmark_fit;
mod landmark_matching;
mod layout;
mod limbs;
mod map;
mod mirror;
mod pipeline;
mod poses;
mod remesh;
mod repair;
mod search;
mod thesis;
mod transfer;
mod wrap;

/// A test of a module.
pub struct Test {
    name: &'static str,
    /// Takes the data folder; fails by a panic.
    run: fn(&Path),
    length: Length,
}

/// Whether a test is part of every run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Length {
    /// The test is part of every run.
    Short,
    /// The test runs only where all tests are asked for.
    Long,
}

/// The tests by module, the longest first: they are begun in this order.
fn modules() -> Vec<(&'static str, Vec<Test>)> {
    vec![
        ("base", base::tests()),
        ("borders", borders::tests()),
        ("landmark_fit", landmark_fit::tests()),
        ("landmark_matching", landmark_matching::tests()),
        ("pipeline", pipeline::tests()),
        ("few", few::tests()),
        ("layout", layout::tests()),
        ("poses", poses::tests()),
        ("transfer", transfer::tests()),
        ("map", map::tests()),
        ("search", search::tests()),
        ("limbs", limbs::tests()),
        ("clicks", clicks::tests()),
        ("wrap", wrap::tests()),
        ("flow", flow::tests()),
        ("thesis", thesis::tests()),
        ("remesh", remesh::tests()),
        #[cfg(feature = "cli")]
        ("cli", cli::tests()),
        ("mirror", mirror::tests()),
        ("repair", repair::tests()),
        ("geodesic", geodesic::tests()),
        ("bad_input", bad_input::tests()),
        ("data", data::tests()),
    ]
}

fn trial(module: &str, test: Test) -> Trial {
    let run = move || -> Result<(), Failed> {
        (test.run)(&common::data_path());
        Ok(())
    };
    let ignored = !common::has_data() || test.length == Length::Long;
    Trial::test(format!("{module}::{}", test.name), run).with_ignored_flag(ignored)
}

fn main() -> ExitCode {
    let mut arguments = Arguments::from_args();
    let named = modules()
        .into_iter()
        .flat_map(|(module, tests)| tests.into_iter().map(move |test| trial(module, test)));
    let trials: Vec<Trial> = named.collect();
    if !common::has_data() && !arguments.list {
        // Flags that ask for ignored tests have no effect without the meshes.
        (arguments.ignored, arguments.include_ignored) = (false, false);
        eprintln!(
            "the {} tests on real meshes are ignored: ../shared/data is not part of a plain checkout",
            trials.len()
        );
    }
    libtest_mimic::run(&arguments, trials).exit_code()
}
