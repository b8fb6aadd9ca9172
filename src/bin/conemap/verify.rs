//! `conemap verify`.

use crate::arguments::VerifyArguments;
use crate::input::Failure;
use crate::outputs;
use crate::saved::SavedFiles;
use crate::told::print;
use conemap::job::{Proof, ProofReport, prove};
use serde::Serialize;
use std::ops::ControlFlow;
use std::time::Instant;

/// Proves a map, and tells what was found; an error where it is not proved.
pub fn run(arguments: &VerifyArguments) -> Result<(), Failure> {
    outputs::check(arguments.saved.files(), arguments.report.clone())?;
    let begun = Instant::now();
    let files = SavedFiles::read(&arguments.saved)?;
    let outcome = prove(files.bytes(), &mut |_| ControlFlow::Continue(()));
    if let Some(path) = &arguments.report {
        let report = TimedProof { proof: ProofReport::of(&outcome), seconds: begun.elapsed().as_secs_f64() };
        outputs::write(path, &serde_json::to_vec_pretty(&report)?)?;
    }
    // On standard output the report stands in place of the sentences.
    let is_told = !arguments.report.as_deref().is_some_and(outputs::is_standard);
    match outcome {
        Ok(proof) => {
            if is_told {
                tell(&proof)?;
            }
            if proof.is_exact() { Ok(()) } else { Err(files.told(None, &"the map is not proved")) }
        }
        Err(error) => Err(files.told(error.side(), &error)),
    }
}

fn tell(proof: &Proof) -> Result<(), Failure> {
    let Proof { faces, vertices, pieces, segments, signs, landmarks, matrices, .. } = proof;
    print(proof.sentence())?;
    print(format_args!("faces: {} of the source, {} of the target", faces[0], faces[1]))?;
    print(format_args!("pieces: {pieces} with {vertices} vertices, {segments} of them without inside"))?;
    print(format_args!("determinants: {} signs, {} of them by integers", signs.signs, signs.by_integers))?;
    let others = match landmarks.pairs - landmarks.exact {
        0 => String::new(),
        others => format!(
            ", {others} on edges or inside faces within {:.1e} of the root of the mesh's area",
            landmarks.largest_distance
        ),
    };
    print(format_args!("landmarks: {} of {} pairs meet exactly{others}", landmarks.exact, landmarks.pairs))?;
    print(format_args!(
        "matrices: {} given; images by matrices are off by at most {:.1e} of the root of the target's area",
        matrices.given, matrices.largest_distance
    ))
}

/// The report on a proof, stable as JSON.
#[derive(Serialize)]
struct TimedProof {
    #[serde(flatten)]
    proof: ProofReport,
    seconds: f64,
}
