//! Remarks on landmarks that were read.

use crate::landmarks::MeshSide;
use std::fmt;

/// A remark on landmarks that were read. Landmarks are counted from 1 in words, from 0 in fields.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Remark {
    /// A landmark that its file says was not placed.
    NotPlaced {
        /// The mesh.
        side: MeshSide,
        /// The landmark, 0-based in its list.
        index: usize,
        /// Its name.
        label: String,
    },
    /// A landmark that was far from the surface.
    OffSurface {
        /// The mesh.
        side: MeshSide,
        /// The landmark, 0-based in its list.
        index: usize,
        /// Its name.
        label: String,
        /// Its distance in the units of the mesh.
        distance: f64,
        /// The distance in units of the square root of the mesh's area.
        share: f64,
    },
    /// More landmarks of the kinds above, beside those that were named.
    More {
        /// The mesh.
        side: MeshSide,
        /// The number of landmarks.
        count: usize,
        /// Whether they were far from the surface, and not left out.
        off_surface: bool,
    },
    /// The labels of the two lists differ.
    PairedByOrder,
    /// There are not as many labels as pairs.
    LabelCount {
        /// Labels.
        labels: usize,
        /// Pairs.
        pairs: usize,
    },
    /// The file has entries that mean nothing here.
    UnknownEntries {
        /// Their names.
        names: Vec<String>,
    },
    /// A file names another mesh than the one given.
    OtherMesh {
        /// The mesh.
        side: MeshSide,
        /// The name in the file.
        named: String,
        /// The name of the file given.
        given: String,
    },
    /// A file names the two meshes given the other way round.
    ExchangedMeshes,
}

impl Remark {
    /// A stable word for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::NotPlaced { .. } | Self::More { off_surface: false, .. } => "not_placed",
            Self::OffSurface { .. } | Self::More { off_surface: true, .. } => "off_surface",
            Self::PairedByOrder => "paired_by_order",
            Self::LabelCount { .. } => "label_count",
            Self::UnknownEntries { .. } => "unknown_entries",
            Self::OtherMesh { .. } => "other_mesh",
            Self::ExchangedMeshes => "exchanged_meshes",
        }
    }
}

/// Unknown entries of a file that are named in one sentence, at most.
const MOST_NAMES: usize = 5;

/// A landmark's number and name in words.
pub(super) struct Named<'a> {
    index: usize,
    label: &'a str,
}

impl<'a> Named<'a> {
    pub(super) fn new(index: &usize, label: &'a str) -> Self {
        Self { index: *index, label }
    }
}

impl fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "landmark {}", self.index + 1)?;
        if self.label.is_empty() {
            return Ok(());
        }
        write!(f, " (\"{}\")", short(self.label))
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPlaced { side, index, label } => {
                let mark = Named::new(index, label);
                write!(f, "{mark} of the {side} has no position in its file and is left out")
            }
            Self::OffSurface { side, index, label, distance, share } => {
                let mark = Named::new(index, label);
                write!(
                    f,
                    "{mark} of the {side} lies {} off the surface, {:.1} % of the mesh's size: it is put on the nearest point",
                    Short(*distance),
                    100.0 * share
                )
            }
            Self::More { side, count, off_surface } => {
                let what = if *off_surface { "lie so far off the surface" } else { "have no position" };
                write!(f, "{count} more landmarks of the {side} {what}")
            }
            Self::PairedByOrder => {
                f.write_str("the labels of source and target differ: the landmarks are paired by their order")
            }
            Self::LabelCount { labels, pairs } => {
                write!(
                    f,
                    "the file has {labels} labels for {pairs} pairs: names may stand at other pairs than theirs"
                )
            }
            Self::UnknownEntries { names } => {
                let told: Vec<_> =
                    names.iter().take(MOST_NAMES).map(|name| format!("\"{}\"", short(name))).collect();
                let more = names.len().saturating_sub(MOST_NAMES);
                let more = if more > 0 { format!(" and {more} more") } else { String::new() };
                write!(
                    f,
                    "the landmark file has entries that are not known and not used: {}{more}",
                    told.join(", ")
                )
            }
            Self::OtherMesh { side, named, given } => {
                let [named, given] = [named, given].map(|name| short(name));
                write!(
                    f,
                    "the file was made for the {side} \"{named}\", and \"{given}\" is given: its numbers may mean other places"
                )
            }
            Self::ExchangedMeshes => f.write_str(
                "the file was made for these meshes the other way round: exchange source and target",
            ),
        }
    }
}

/// The first characters of a name, without those that steer terminals.
fn short(name: &str) -> String {
    name.chars().take(60).filter(|c| !c.is_control()).collect()
}

/// A length with four significant digits.
pub(super) struct Short(pub(super) f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded: f64 = format!("{:.3e}", self.0).parse().unwrap_or(self.0);
        if self.0 == 0.0 || (1e-3..1e6).contains(&self.0) {
            write!(f, "{rounded}")
        } else {
            write!(f, "{rounded:e}")
        }
    }
}
