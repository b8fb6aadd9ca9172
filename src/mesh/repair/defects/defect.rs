//! The defects of a mesh, by kind.

use crate::mesh::FileFrame;
use crate::mesh::check::Triangle;
use glam::DVec3;
use serde::Serialize;
use std::fmt;

/// The largest number of defects of a kind that are given one by one; the others are counted.
pub const MOST_DEFECTS: usize = 1000;

/// The largest number of points of all lines of one kind; a line that would have more ends early.
pub const MOST_POINTS: usize = 100_000;

/// The kind of a defect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum DefectKind {
    /// A row of edges with one face: the rim of a hole, or of an open sheet.
    OpenRim,
    /// A row of edges with more than two faces.
    CrowdedEdges,
    /// A row of edges across which faces cannot be oriented alike: the surface is one-sided.
    OneSidedSeam,
    /// Faces that look to the other side than most of their part.
    TurnedPatch,
    /// A part of the surface beside the largest by area.
    LoosePart,
    /// The loop along which the repair would cut a handle, or has cut it.
    HandleLoop,
    /// A vertex where several parts of the surface only touch.
    PinchedVertex,
    /// A face that names a vertex twice or has no area.
    FaceWithoutArea,
    /// A face whose vertices another face has as well.
    DoubleFace,
    /// A surface that a repair made up to close a hole or a cut.
    Cap,
    /// A face at which a flow stopped, because the face would lose its area: not the mesh's fault.
    StopsFlow,
}

impl DefectKind {
    /// All kinds, in their order.
    pub const ALL: [Self; 11] = [
        Self::OpenRim,
        Self::CrowdedEdges,
        Self::OneSidedSeam,
        Self::TurnedPatch,
        Self::LoosePart,
        Self::HandleLoop,
        Self::PinchedVertex,
        Self::FaceWithoutArea,
        Self::DoubleFace,
        Self::Cap,
        Self::StopsFlow,
    ];

    /// The kind in words, for one defect and for several.
    fn words(self) -> [&'static str; 2] {
        match self {
            Self::OpenRim => ["open rim", "open rims"],
            Self::CrowdedEdges => {
                ["row of edges with more than two faces", "rows of edges with more than two faces"]
            }
            Self::OneSidedSeam => {
                ["seam where the surface is one-sided", "seams where the surface is one-sided"]
            }
            Self::TurnedPatch => ["patch that is turned over", "patches that are turned over"],
            Self::LoosePart => ["part beside the largest", "parts beside the largest"],
            Self::HandleLoop => ["handle", "handles"],
            Self::PinchedVertex => ["vertex where parts only touch", "vertices where parts only touch"],
            Self::FaceWithoutArea => ["face without area", "faces without area"],
            Self::DoubleFace => ["double face", "double faces"],
            Self::Cap => ["cap", "caps"],
            Self::StopsFlow => ["triangle that stops the flow", "triangles that stop the flow"],
        }
    }
}

/// One defect.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Defect {
    /// Lines along it, by numbers of [`Defects::positions`]; a closed one ends where it begins, and a place alone is a line of one
    /// point.
    pub lines: Vec<Vec<u32>>,
    /// The faces of the defect, by numbers of [`Defects::triangles`], rising.
    pub faces: Vec<u32>,
}

/// All defects of one kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DefectGroup {
    /// The kind of the defects.
    pub kind: DefectKind,
    /// The number of defects of the kind.
    pub count: usize,
    /// The first [`MOST_DEFECTS`] at most, the largest first but for vertices and single faces, which are in the file's order.
    pub defects: Vec<Defect>,
}

impl DefectGroup {
    /// A kind of which there are some, as far as they are given one by one.
    pub(super) fn new(kind: DefectKind, mut defects: Vec<Defect>) -> Option<Self> {
        let count = defects.len();
        defects.truncate(MOST_DEFECTS);
        let mut room = MOST_POINTS;
        for line in defects.iter_mut().flat_map(|defect| &mut defect.lines) {
            line.truncate(room);
            room -= line.len();
        }
        (count > 0).then_some(Self { kind, count, defects })
    }
}

impl fmt::Display for DefectGroup {
    /// As in "3 open rims".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [one, many] = self.kind.words();
        write!(f, "{} {}", self.count, if self.count == 1 { one } else { many })
    }
}

/// The defects of a mesh, with the places that are needed to show them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Defects {
    /// The way from the positions to the file's coordinates: that of the mesh which a repair makes of the file.
    pub frame: FileFrame,
    /// The file's vertices by their numbers there, then vertices of caps.
    pub positions: Vec<DVec3>,
    /// The triangulated file's faces by their numbers there, with vertices at one place joined and turned until neighbours agree
    /// and look outwards; then faces of caps.
    pub triangles: Vec<Triangle>,
    /// The number of positions that are the file's.
    pub file_vertices: usize,
    /// The kinds of which there are some, in their order.
    pub groups: Vec<DefectGroup>,
}

impl Defects {
    /// The defects of one kind; `None` where there are none.
    pub fn of(&self, kind: DefectKind) -> Option<&DefectGroup> {
        self.groups.iter().find(|group| group.kind == kind)
    }

    /// Triangles at which a flow stopped, each by its corners, and marked in its middle.
    pub fn of_stopped_flow(triangles: &[[DVec3; 3]]) -> Self {
        let mut found = Self::default();
        let mut stops = Vec::new();
        for &[a, b, c] in triangles {
            let first = found.positions.len() as u32;
            stops.push(Defect { lines: vec![vec![first + 3]], faces: vec![found.triangles.len() as u32] });
            found.positions.extend([a, b, c, (a + b + c) / 3.0]);
            found.triangles.push([first, first + 1, first + 2]);
        }
        found.add(DefectKind::StopsFlow, stops);
        found
    }

    /// Adds further defects of a kind.
    pub(super) fn add(&mut self, kind: DefectKind, defects: Vec<Defect>) {
        self.groups.extend(DefectGroup::new(kind, defects));
    }

    /// A defect in words, with a number of the file to find it by: "24 edges from vertex 812 on".
    pub fn label(&self, kind: DefectKind, defect: &Defect) -> String {
        let edges = || -> usize { defect.lines.iter().map(|line| line.len().saturating_sub(1)).sum() };
        let counted = |n: usize, one: &str| format!("{n} {one}{}", if n == 1 { "" } else { "s" });
        let vertex = defect.lines.iter().flatten().find(|v| (**v as usize) < self.file_vertices);
        let from = vertex.map_or(String::new(), |v| format!(" from vertex {v} on"));
        match (kind, vertex, defect.faces.first()) {
            (DefectKind::PinchedVertex, Some(v), _) => format!("vertex {v}"),
            (DefectKind::FaceWithoutArea | DefectKind::DoubleFace | DefectKind::StopsFlow, _, Some(face)) => {
                format!("face {face}")
            }
            (DefectKind::TurnedPatch | DefectKind::LoosePart, _, Some(face)) => {
                format!("{} from face {face} on", counted(defect.faces.len(), "face"))
            }
            (DefectKind::Cap, ..) => format!("{}, rim{from}", counted(defect.faces.len(), "face")),
            _ => format!("{}{from}", counted(edges(), "edge")),
        }
    }
}
