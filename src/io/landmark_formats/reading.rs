//! A landmark file of any format.

use super::content::{Content, MarkList};
use super::{
    LandmarkFormat, LandmarkReadError, MAX_BYTES, comma_separated, detect, fcsv, idav, meshlab, nts,
    slicer_json, tps, wrap,
};
use crate::io::{landmark_file, reading};

/// Reads a landmark file of any known format; the name decides where the content allows several.
///
/// # Errors
/// [`LandmarkReadError`] that names the line or the point.
pub fn read(name: &str, bytes: &[u8]) -> Result<(LandmarkFormat, Content), LandmarkReadError> {
    if bytes.len() > MAX_BYTES {
        return Err(LandmarkReadError::TooLarge { bytes: bytes.len() });
    }
    let text = reading::text(bytes);
    // Bytes that are no text are refused by their format, or belong to none.
    let bytes = text.as_deref().map_or(bytes, str::as_bytes);
    let format = match detect(name, bytes) {
        Some(format) => format,
        // Its error shows what the file should look like.
        None if LandmarkFormat::of_name(name) == Some(LandmarkFormat::Conemap) => LandmarkFormat::Conemap,
        None => return Err(LandmarkReadError::UnknownFormat),
    };
    let lists = match format {
        LandmarkFormat::Conemap => return Ok((format, Content::Pairs(landmark_file::read(bytes)?))),
        LandmarkFormat::SlicerJson => slicer_json::read(bytes),
        LandmarkFormat::Fcsv => fcsv::read(bytes),
        LandmarkFormat::Wrap => wrap::read(bytes),
        LandmarkFormat::MeshLab => meshlab::read(bytes),
        LandmarkFormat::Idav => idav::read(bytes),
        LandmarkFormat::Tps => tps::read(bytes),
        LandmarkFormat::Nts => nts::read(bytes),
        LandmarkFormat::Csv => comma_separated::read(bytes),
    };
    let lists = lists.map_err(|(place, problem)| LandmarkReadError::Malformed { format, place, problem })?;
    Ok((format, content(format, lists)?))
}

/// One or two lists.
fn content(format: LandmarkFormat, lists: Vec<MarkList>) -> Result<Content, LandmarkReadError> {
    if lists.iter().all(|list| list.marks.is_empty()) {
        return Err(LandmarkReadError::Empty { format });
    }
    let count = lists.len();
    let names: Vec<_> =
        lists.iter().take(10).map(|list| list.name.chars().take(40).collect::<String>()).collect();
    match <[MarkList; 2]>::try_from(lists) {
        Ok(sides) => Ok(Content::Sides(sides)),
        Err(mut lists) if count == 1 => Ok(Content::Side(lists.swap_remove(0))),
        Err(_) => Err(LandmarkReadError::TooManyLists { format, count, names: names.join(", ") }),
    }
}
