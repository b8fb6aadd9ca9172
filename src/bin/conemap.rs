//! The command line: `conemap check`, `map`, `match`, `wrap`, `query`, `report`, `verify`, `export`, `transfer`, `suggest`, `flow`,
//! `landmarks`, `remesh` and `demo`.
//!
//! Progress and errors go to standard error; the exit code is 0 only for a converged, certified result.

#[path = "conemap/arguments.rs"]
mod arguments;
#[path = "conemap/check.rs"]
mod check;
#[path = "conemap/clock.rs"]
mod clock;
#[path = "conemap/deadline.rs"]
mod deadline;
#[path = "conemap/demo.rs"]
mod demo;
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
#[path = "conemap/matching.rs"]
mod matching;
#[path = "conemap/outputs.rs"]
mod outputs;
#[path = "conemap/query.rs"]
mod query;
#[path = "conemap/remesh.rs"]
mod remesh;
#[path = "conemap/saved.rs"]
mod saved;
#[path = "conemap/suggest.rs"]
mod suggest;
#[path = "conemap/told.rs"]
mod told;
#[path = "conemap/transfer.rs"]
mod transfer;
#[path = "conemap/verify.rs"]
mod verify;
#[path = "conemap/wrap.rs"]
mod wrap;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = arguments::Arguments::parse();
    let outcome = match &arguments.command {
        arguments::Command::Check(options) => check::run(options),
        arguments::Command::Map(options) => map::run(options),
        arguments::Command::Match(options) => matching::run(options),
        arguments::Command::Wrap(options) => wrap::run(options),
        arguments::Command::Query(options) => query::run(options),
        arguments::Command::Report(options) => saved::report(options),
        arguments::Command::Verify(options) => verify::run(options),
        arguments::Command::Export(options) => saved::export(options),
        arguments::Command::Transfer(options) => transfer::run(options),
        arguments::Command::Suggest(options) => suggest::run(options),
        arguments::Command::Flow(options) => flow::run(options),
        arguments::Command::Landmarks(options) => landmarks::run(options),
        arguments::Command::Remesh(options) => remesh::run(options),
        arguments::Command::Demo(options) => demo::run(options),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            told::say(format_args!("conemap: {error}"));
            ExitCode::FAILURE
        }
    }
}
