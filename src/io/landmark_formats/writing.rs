//! Landmarks as a file of any format but the program's own, which is written from its pairs.

use super::content::SurfaceMarks;
use super::{
    Holds, LandmarkFormat, LandmarkWriteError, comma_separated, fcsv, idav, meshlab, nts, slicer_json, tps,
    wrap,
};

/// Writes the landmarks of one mesh, or of source and target, which must then be as many.
///
/// # Errors
/// [`LandmarkWriteError`] where the format does not hold so many meshes. The program's own format holds pairs and is written by
/// [`crate::io::landmark_file::write`].
pub fn write(format: LandmarkFormat, sides: &[SurfaceMarks]) -> Result<Vec<u8>, LandmarkWriteError> {
    let first = match (format.holds(), sides) {
        (Holds::One | Holds::OneOrBoth, [side]) => side,
        (Holds::OneOrBoth, [side, _]) => side,
        (Holds::One, _) => return Err(LandmarkWriteError::OnlyOneMesh(format)),
        _ => return Err(LandmarkWriteError::OnlyBothMeshes(format)),
    };
    Ok(match format {
        LandmarkFormat::Conemap => return Err(LandmarkWriteError::OnlyBothMeshes(format)),
        LandmarkFormat::SlicerJson => slicer_json::write(sides),
        LandmarkFormat::Fcsv => fcsv::write(first),
        LandmarkFormat::Wrap => wrap::write(first),
        LandmarkFormat::MeshLab => meshlab::write(first),
        LandmarkFormat::Idav => idav::write(first),
        LandmarkFormat::Tps => tps::write(sides),
        LandmarkFormat::Nts => nts::write(sides),
        LandmarkFormat::Csv => comma_separated::write(sides),
    })
}
