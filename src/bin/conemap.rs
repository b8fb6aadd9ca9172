//! The command line: `conemap check`, `map`, `query`, `report`, `export`, `transfer`, `suggest`, `flow`, `landmarks` and `remesh`.
//!
//! Progress and errors go to standard error; the exit code is 0 only for a converged, certified result.
#![allow(clippy::print_stderr, reason = "a command line prints")]

#[path = "conemap/arguments.rs"]
mod arguments;
#[path = "conemap/check.rs"]
mod check;
#[path = "conemap/clock.rs"]
mod clock;
#[path = "conemap/flow.rs"]
mod flow;
#[path = "conemap/input.rs"]
mod input;
#[path = "conemap/interrupt.rs"]
mod interrupt;
#[path = "conemap/landmarks.rs"]
mod landmarks;
#[path = "conemap/map.rs"]
mod map;
#[path = "conemap/query.rs"]
mod query;
#[path = "conemap/remesh.rs"]
mod remesh;
#[path = "conemap/saved.rs"]
mod saved;
#[path = "conemap/suggest.rs"]
mod suggest;
#[path = "conemap/transfer.rs"]
mod transfer;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = arguments::Arguments::parse();
    let outcome = match &arguments.command {
        arguments::Command::Check(options) => check::run(options),
        arguments::Command::Map(options) => map::run(options),
        arguments::Command::Query(options) => query::run(options),
        arguments::Command::Report(options) => saved::report(options),
        arguments::Command::Export(options) => saved::export(options),
        arguments::Command::Transfer(options) => transfer::run(options),
        arguments::Command::Suggest(options) => suggest::run(options),
        arguments::Command::Flow(options) => flow::run(options),
        arguments::Command::Landmarks(options) => landmarks::run(options),
        arguments::Command::Remesh(options) => remesh::run(options),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("conemap: {error}");
            ExitCode::FAILURE
        }
    }
}
