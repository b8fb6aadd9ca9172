//! `conemap suggest`.

use crate::arguments::SuggestArguments;
use crate::clock::Clock;
use crate::input::{self, Failure};
use crate::told::print;
use conemap::landmark_suggestion::{Suggestion, kept, suggest};
use conemap::monitor::{Monitor, Stage};
use serde_json::json;

/// Prints vertices of a mesh that are worth a landmark, as JSON.
pub fn run(arguments: &SuggestArguments) -> Result<(), Failure> {
    let checked = input::mesh(&arguments.mesh, arguments.faults)?;
    let mut clock = Clock::start_only(Stage::Suggestion);
    clock.enter(Stage::Suggestion);
    let numbers = checked.file_from_vertex();
    let mut marked = Vec::new();
    for &v in &arguments.beside {
        marked.push(checked.numbered_vertex(v).map_err(|e| format!("--beside: {e}"))?);
    }
    marked.sort_unstable();
    marked.dedup();
    let found = suggest(&checked.mesh, &marked, arguments.count, &mut clock)?;
    clock.stop();
    // What a repair made up has no number in the file, and takes no landmark.
    let found = kept(&found, |v| numbers[v.index()] < checked.vertex_from_file.len());
    let entry = |s: &Suggestion| {
        let partner = s.partner.map(|k| numbers[found[k].vertex.index()]);
        json!({ "vertex": numbers[s.vertex.index()], "reason": s.reason, "partner": partner })
    };
    let entries: Vec<_> = found.iter().map(entry).collect();
    print(serde_json::to_string_pretty(&json!({ "suggestions": entries }))?)
}
