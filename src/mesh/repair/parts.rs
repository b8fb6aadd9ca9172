//! Loose parts go.

use super::draft::{Draft, across, edges, parts};
use super::options::Parts;
use super::refusal::RepairRefusal;
use crate::mesh::check::Elements;

/// The parts that were dropped.
pub(super) struct DroppedParts {
    /// Number of these parts.
    pub parts: usize,
    /// The faces of the file in these parts.
    pub faces: Elements<usize>,
    /// The share of the area before that these parts had.
    pub area_share: f64,
}

/// The share of the area below which parts together are specks. Chosen by hand.
const SPECKS: f64 = 0.01;

/// The part of largest area alone, and what went; nothing where there is one part.
///
/// # Errors
/// [`RepairRefusal::Parts`] where more than specks would go and only specks may.
pub(super) fn largest(draft: Draft, allowed: Parts) -> Result<(Draft, Option<DroppedParts>), RepairRefusal> {
    let part = parts(draft.faces.len(), &across(&draft.faces, &edges(&draft.faces)));
    let count = part.iter().max().map_or(0, |last| last + 1);
    if count < 2 {
        return Ok((draft, None));
    }
    let areas = areas(&draft, &part);
    // The first part is taken of equal ones.
    let largest = (0..count).rev().max_by(|&a, &b| areas[a].total_cmp(&areas[b])).unwrap_or(0);
    let area_share = 1.0 - areas[largest] / areas.iter().sum::<f64>();
    if area_share >= SPECKS && allowed == Parts::LargestAndSpecks {
        return Err(RepairRefusal::Parts { count, area_share });
    }
    let goes = |f: &usize| part[*f] != largest;
    let faces: Elements<usize> =
        (0..part.len()).filter(goes).filter_map(|f| draft.faces[f].number()).collect();
    let kept: Vec<_> = (0..part.len()).filter(|f| !goes(f)).map(|f| draft.faces[f]).collect();
    Ok((draft.with_faces(kept), Some(DroppedParts { parts: count - 1, faces, area_share })))
}

/// The area of each part.
pub(super) fn areas(draft: &Draft, part: &[usize]) -> Vec<f64> {
    let mut areas = vec![0.0; part.iter().max().map_or(0, |last| last + 1)];
    for (face, &p) in draft.faces.iter().zip(part) {
        areas[p] += draft.face_area(face);
    }
    areas
}
