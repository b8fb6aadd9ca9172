//! `conemap verify`.

use crate::arguments::VerifyArguments;
use crate::input::{self, Failure};
use crate::outputs;
use crate::told::print;
use conemap::job::{MapFiles, Proof, ProofReport, prove};
use conemap::landmarks::MeshSide;
use serde::Serialize;
use std::ops::ControlFlow;
use std::time::Instant;

/// Proves a map, and tells what was found; an error where it is not proved.
pub fn run(arguments: &VerifyArguments) -> Result<(), Failure> {
    outputs::check(arguments.saved.files(), arguments.report.clone())?;
    let begun = Instant::now();
    let [map, source, target] = [&arguments.saved.map, &arguments.saved.source, &arguments.saved.target];
    let bytes = [input::bytes(map)?, input::mesh_bytes(source)?, input::mesh_bytes(target)?];
    let files = MapFiles { map: &bytes[0], source: &bytes[1], target: &bytes[2] };
    let outcome = prove(files, &mut |_| ControlFlow::Continue(()));
    if let Some(path) = &arguments.report {
        let report = Told { proof: ProofReport::of(&outcome), seconds: begun.elapsed().as_secs_f64() };
        outputs::write(path, &serde_json::to_vec_pretty(&report)?)?;
    }
    match outcome {
        Ok(proof) => {
            tell(&proof)?;
            if proof.is_exact() {
                Ok(())
            } else {
                Err(format!("{}: the map is not proved", map.display()).into())
            }
        }
        Err(error) => {
            let file = match error.side() {
                Some(MeshSide::Source) => source,
                Some(MeshSide::Target) => target,
                None => map,
            };
            Err(format!("{}: {error}", file.display()).into())
        }
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
            ", {others} inside faces within {:.1e} of the root of the mesh's area",
            landmarks.largest_distance
        ),
    };
    print(format_args!("landmarks: {} of {} pairs meet exactly{others}", landmarks.exact, landmarks.pairs))?;
    print(format_args!(
        "matrices: {} given; images by matrices are off by at most {:.1e} of the root of the target's area",
        matrices.given, matrices.largest_distance
    ))
}

/// What is known, stable as JSON.
#[derive(Serialize)]
struct Told {
    #[serde(flatten)]
    proof: ProofReport,
    seconds: f64,
}
