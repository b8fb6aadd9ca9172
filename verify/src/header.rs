//! The part of a map file's header that the proof reads.

use serde::Deserialize;

/// The header, without what the proof does not need.
#[derive(Debug, Deserialize)]
pub struct Header {
    #[serde(default)]
    pub requires: Vec<String>,
    pub source: MeshEntry,
    pub target: MeshEntry,
    #[serde(default)]
    pub target_image: TargetImage,
    pub landmarks: LandmarkList,
    pub sections: Vec<SectionEntry>,
}

/// A mesh that the map was made with.
#[derive(Debug, Deserialize)]
pub struct MeshEntry {
    pub checked_sha256: String,
}

/// Whether the map goes to the target or to its mirror image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TargetImage {
    #[default]
    AsGiven,
    Mirrored,
}

/// Corresponding points, the source's first.
#[derive(Debug, Deserialize)]
pub struct LandmarkList {
    pub pairs: Vec<[LandmarkPoint; 2]>,
}

/// A vertex, or a point of a face.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum LandmarkPoint {
    Vertex(u32),
    OnFace { face: u32, barycentric: [f64; 3] },
}

/// The place and the type of a section.
#[derive(Debug, Deserialize)]
pub struct SectionEntry {
    pub name: String,
    #[serde(rename = "type")]
    pub kind: String,
    pub count: u64,
    #[serde(default)]
    pub packing: Option<String>,
    pub offset: u64,
    pub bytes: u64,
}

impl SectionEntry {
    /// The section's length once unpacked, in bytes; 0 for elements of a type that is not known.
    pub fn unpacked_bytes(&self) -> u64 {
        let width = match self.kind.as_str() {
            "u8" => 1,
            "u32" => 4,
            "f64" => 8,
            _ => 0,
        };
        self.count.saturating_mul(width)
    }
}
