//! Build helper of the project: `cargo xtask serve | build | test | browsers | compare | agree | survey | fuzz | torture | wasm`.

mod agree;
mod audit;
mod browser;
mod browsers;
mod compare;
mod deny;
mod fuzz;
mod licences;
mod page;
mod run;
mod suite;
mod survey;
mod torture;
mod wasm;

use std::process::ExitCode;

const USAGE: &str = "cargo xtask COMMAND
  serve   build the page, serve it and print its address
  build   build the page into dist/, to be put on any static web server; with --quick as the tests use it
  test    run the tests: formatting, lints, documentation, core, page, browser; with --all the long ones, too
  browsers visit the page in Chromium, Firefox and WebKit, which are installed where that is possible
  compare time whole maps, wasm in a browser against native: [--runs N] [PAIR.json ...], the demos without files
  agree   compare whole maps as wasm with native ones, number by number: [PAIR.json ...], all of ../shared/data without files
  survey  tables of many maps on the meshes of ../shared/data, or of --data FOLDER: TABLE [--pairs NAME,NAME] [--seeds N]; lists them without a name
  fuzz    read changed files by every reader: [--runs N] of each, from one [--seed S]
  torture map generated hostile geometry for [--minutes N], from one [--seed S]: the table of outcomes; --case KIND-SEED for one
  wasm    build only the wasm modules, into www/wasm/; with --names they keep the functions' names for profilers";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let command = arguments.next().unwrap_or_default();
    let rest: Vec<String> = arguments.collect();
    let outcome = match command.as_str() {
        "serve" => page::serve(&rest),
        "build" if rest == ["--quick"] => page::build(wasm::Optimised::ForTests),
        "build" => page::build(wasm::Optimised::Fully),
        "test" if rest == ["--all"] => suite::test(suite::Extent::All),
        "test" if rest.is_empty() => suite::test(suite::Extent::Usual),
        "browsers" if rest.is_empty() => browsers::build_and_visit(),
        "compare" => compare::compare(&rest),
        "agree" => agree::agree(&rest),
        "survey" => survey::survey(&rest),
        "fuzz" => fuzz::fuzz(&rest),
        "torture" => torture::torture(&rest),
        "wasm" if rest == ["--names"] => wasm::build(wasm::Optimised::Fully, wasm::Names::Kept),
        "wasm" => wasm::build(wasm::Optimised::Fully, wasm::Names::Removed),
        _ => Err(USAGE.to_owned()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(sentence) => {
            eprintln!("{sentence}");
            ExitCode::FAILURE
        }
    }
}
