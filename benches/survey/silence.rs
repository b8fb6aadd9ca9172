//! The silences of a run: how long it asks its monitor nothing, stage by stage, from the first byte read. They are measured on balls of
//! 5,000 to 328,000 faces, on pairs by name, and on single meshes by path, which are mapped onto bent copies of themselves.

use crate::arguments::Arguments;
use crate::job_files::files;
use crate::judged_job::mapped;
use crate::watch::Watch;
use conemap::monitor::Stage;
use std::time::Instant;

/// Prints the longest silence of each stage, in processor time.
pub fn table(arguments: &Arguments) {
    let names = ["ball-4", "ball-5", "ball-6", "ball-7"].map(str::to_owned).to_vec();
    let names = if arguments.pairs.is_empty() { names } else { arguments.pairs.clone() };
    for name in names {
        let files = files(arguments, &name);
        let (begun, mut watch) = (Instant::now(), Watch::new(arguments));
        let outcome = mapped(&files, &mut watch);
        watch.longest();
        let seconds = begun.elapsed().as_secs_f64();
        match outcome {
            Ok(mapped) => {
                let faces = &mapped.report().faces;
                println!("{name} ({} and {} faces): a map in {seconds:.1} s", faces.source, faces.target);
            }
            Err(outcome) => println!("{name}: {outcome:?} in {seconds:.1} s"),
        }
        for (stage, (silence, questions)) in &watch.by_stage {
            let stage = stage.map_or("before the first stage", Stage::sentence);
            println!("  {stage:44} {:8.0} ms, {questions} questions", 1000.0 * silence.as_secs_f64());
        }
    }
}
