//! The changes of a repair, in counts, numbers of the file and sentences.

use crate::mesh::check::{Count, Elements, MeshFault};
use glam::DVec3;
use serde::Serialize;
use std::fmt;

/// The changes that a repair made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RepairReport {
    /// The first fault of the mesh as given; `None` where there was none and nothing was repaired.
    pub fault: Option<MeshFault>,
    /// The changes in the order in which they were made.
    pub changes: Vec<Change>,
    /// Share of the repaired surface's area that is caps.
    pub cap_share: f64,
}

/// One kind of change, with how many elements, and the first few of them by their numbers in the file.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(into = "ChangeReport")]
#[non_exhaustive]
pub enum Change {
    /// Vertices at one place became one.
    JoinedVertices(Elements<usize>),
    /// Vertices that no face of the file uses were left out.
    UnusedVertices(Elements<usize>),
    /// Faces without area were dropped.
    DegenerateFaces {
        /// The faces that were dropped.
        dropped: Elements<usize>,
        /// The neighbours that were cut in two where a corner lay on their edge.
        recut: Elements<usize>,
    },
    /// One of the faces with the same vertices stayed, or none of two that looked opposite ways.
    DuplicateFaces(Elements<usize>),
    /// Edges with more than two faces were cut, and the faces paired.
    SplitEdges(Elements<[usize; 2]>),
    /// Vertices where several parts of the surface touched became one for each part.
    SplitVertices(Elements<usize>),
    /// Faces were turned over, to agree with their neighbours and to look outwards.
    TurnedFaces(Elements<usize>),
    /// Loose parts were dropped.
    DroppedParts {
        /// Number of these parts.
        parts: usize,
        /// The faces of these parts.
        faces: Elements<usize>,
        /// The share of the area before that these parts had.
        area_share: f64,
    },
    /// Holes were closed.
    CappedHoles {
        /// The holes, the longest first.
        holes: Elements<Hole>,
        /// Number of faces of all caps.
        faces: usize,
        /// The share of the repaired surface's area that these caps have.
        area_share: f64,
    },
    /// Handles were cut, and closed.
    CutHandles {
        /// The handles, as they were cut one after the other: the one with the shortest loop first.
        handles: Elements<Handle>,
        /// Number of faces that closed them.
        faces: usize,
        /// The share of the repaired surface's area that these faces have.
        area_share: f64,
    },
}

/// A hole that was closed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hole {
    /// Number of edges of its rim.
    pub edges: usize,
    /// The length of its rim in units of the square root of the repaired surface's area.
    pub rim_length: f64,
    /// The share of the repaired surface's area that its cap has.
    pub area_share: f64,
    /// At most ten vertices of its rim in a row, by their numbers in the file.
    pub vertices: Vec<usize>,
}

/// A handle, and what to cut it along the shortest loop comes to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Handle {
    /// Number of edges of the loop.
    pub edges: usize,
    /// The length of the loop in units of the square root of the area of the surface that was cut.
    pub loop_length: f64,
    /// Number of faces that close the surface on both sides of the cut.
    pub faces: usize,
    /// The share that these faces have of the area of the surface that was cut.
    pub area_share: f64,
    /// The vertices of the loop, by their numbers in the file; from its number of vertices on where the loop passes over a cap.
    pub vertices: Vec<usize>,
    /// The places of these vertices, in the file's units.
    #[serde(skip)]
    pub places: Vec<DVec3>,
}

/// A change as reports tell it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChangeReport {
    /// The change's stable name.
    pub kind: &'static str,
    /// The change in words.
    pub sentence: String,
    /// The number of elements of the kind that the name says.
    pub count: usize,
    /// The first of these elements, if they are vertices.
    pub vertices: Vec<usize>,
    /// The first edges.
    pub edges: Vec<[usize; 2]>,
    /// The first faces.
    pub faces: Vec<usize>,
    /// The longest holes.
    pub holes: Vec<Hole>,
    /// The first handles.
    pub handles: Vec<Handle>,
    /// The share of the area that was dropped or added; `null` where the area stays.
    pub area_share: Option<f64>,
}

impl Change {
    /// A stable name for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::JoinedVertices(_) => "joined_vertices",
            Self::UnusedVertices(_) => "unused_vertices",
            Self::DegenerateFaces { .. } => "degenerate_faces",
            Self::DuplicateFaces(_) => "duplicate_faces",
            Self::SplitEdges(_) => "split_edges",
            Self::SplitVertices(_) => "split_vertices",
            Self::TurnedFaces(_) => "turned_faces",
            Self::DroppedParts { .. } => "dropped_parts",
            Self::CappedHoles { .. } => "capped_holes",
            Self::CutHandles { .. } => "cut_handles",
        }
    }

    /// The number of elements that were changed: vertices, faces, edges, parts, holes or handles.
    pub fn count(&self) -> usize {
        match self {
            Self::JoinedVertices(e) | Self::UnusedVertices(e) | Self::SplitVertices(e) => e.count,
            Self::DuplicateFaces(e) | Self::TurnedFaces(e) => e.count,
            Self::DegenerateFaces { dropped, .. } => dropped.count,
            Self::SplitEdges(e) => e.count,
            Self::DroppedParts { parts, .. } => *parts,
            Self::CappedHoles { holes, .. } => holes.count,
            Self::CutHandles { handles, .. } => handles.count,
        }
    }
}

impl fmt::Display for Change {
    /// A part of a sentence, without numbers of elements: "2 holes were capped (0.4 % of the area)".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (one, many) = match self {
            Self::JoinedVertices(_) => ("duplicate vertex was joined", "duplicate vertices were joined"),
            Self::UnusedVertices(_) => ("unused vertex was left out", "unused vertices were left out"),
            Self::DegenerateFaces { .. } => {
                ("face without area was dropped", "faces without area were dropped")
            }
            Self::DuplicateFaces(_) => ("double face was dropped", "double faces were dropped"),
            Self::SplitEdges(_) => {
                ("edge with more than two faces was cut", "edges with more than two faces were cut")
            }
            Self::SplitVertices(_) => {
                ("vertex where parts only touched was split", "vertices where parts only touched were split")
            }
            Self::TurnedFaces(_) => ("face was turned over", "faces were turned over"),
            Self::DroppedParts { .. } => ("loose part was dropped", "loose parts were dropped"),
            Self::CappedHoles { .. } => ("hole was capped", "holes were capped"),
            Self::CutHandles { .. } => ("handle was cut and closed", "handles were cut and closed"),
        };
        write!(f, "{}", Count::new(&self.count(), one, many))?;
        match self {
            Self::DroppedParts { area_share, .. }
            | Self::CappedHoles { area_share, .. }
            | Self::CutHandles { area_share, .. } => {
                write!(f, " ({} % of the area)", percent(*area_share))
            }
            _ => Ok(()),
        }
    }
}

/// A share in percent, with as many digits as say something.
pub(super) fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent >= 9.95 {
        format!("{percent:.0}")
    } else if percent >= 0.095 {
        format!("{percent:.1}")
    } else if percent >= 0.0095 {
        format!("{percent:.2}")
    } else {
        "less than 0.01".to_owned()
    }
}

impl From<Change> for ChangeReport {
    fn from(change: Change) -> Self {
        let (kind, sentence, count) = (change.kind(), change.to_string(), change.count());
        let (mut vertices, mut edges, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        let (mut holes, mut handles, mut area_share) = (Vec::new(), Vec::new(), None);
        match change {
            Change::JoinedVertices(e) | Change::UnusedVertices(e) | Change::SplitVertices(e) => {
                vertices = e.first;
            }
            Change::DuplicateFaces(e) | Change::TurnedFaces(e) => faces = e.first,
            Change::DegenerateFaces { dropped, .. } => faces = dropped.first,
            Change::SplitEdges(e) => edges = e.first,
            Change::DroppedParts { faces: e, area_share: share, .. } => {
                (faces, area_share) = (e.first, Some(share));
            }
            Change::CappedHoles { holes: e, area_share: share, .. } => {
                (holes, area_share) = (e.first, Some(share));
            }
            Change::CutHandles { handles: e, area_share: share, .. } => {
                (handles, area_share) = (e.first, Some(share));
            }
        }
        Self { kind, sentence, count, vertices, edges, faces, holes, handles, area_share }
    }
}

impl RepairReport {
    /// All changes in one sentence; empty where there are none.
    pub fn sentence(&self) -> String {
        let changes: Vec<String> = self.changes.iter().map(Change::to_string).collect();
        changes.join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_told_in_one_sentence_and_with_their_elements() {
        let hole = Hole { edges: 5, rim_length: 0.1, area_share: 0.004, vertices: vec![7, 8, 9, 10, 11] };
        let report = RepairReport {
            fault: None,
            changes: vec![
                Change::JoinedVertices((20..33).collect()),
                Change::TurnedFaces([4].into_iter().collect()),
                Change::CappedHoles {
                    holes: [hole.clone()].into_iter().collect(),
                    faces: 3,
                    area_share: 0.004,
                },
            ],
            cap_share: 0.004,
        };
        assert_eq!(
            report.sentence(),
            "13 duplicate vertices were joined, 1 face was turned over, 1 hole was capped (0.4 % of the area)"
        );
        let [joined, turned, capped] = &report.changes[..] else { panic!() };
        let joined = serde_json::to_value(joined).unwrap();
        assert_eq!((&joined["kind"], &joined["count"]), (&"joined_vertices".into(), &13.into()));
        assert_eq!(joined["vertices"], serde_json::json!([20, 21, 22, 23, 24, 25, 26, 27, 28, 29]));
        assert_eq!(ChangeReport::from(turned.clone()).faces, [4]);
        let capped = ChangeReport::from(capped.clone());
        assert_eq!((capped.holes, capped.area_share), (vec![hole], Some(0.004)));
    }

    #[test]
    fn small_shares_are_not_nothing() {
        let words = [0.1234, 0.0123, 0.001, 0.00001, 0.0].map(percent);
        assert_eq!(words, ["12", "1.2", "0.1", "less than 0.01", "less than 0.01"]);
    }
}
