//! The header of a map file, as JSON.

use crate::mesh::mirror::TargetImage;
use crate::pipeline::DistortionReport;
use serde::{Deserialize, Serialize};

/// The header. Fields that are not known are left out of account.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Header {
    /// The program that wrote the file.
    pub generator: String,
    /// The names of what a reader must know beyond this version; it refuses what it does not.
    #[serde(default)]
    pub requires: Vec<String>,
    /// The source.
    pub source: MeshEntry,
    /// The target.
    pub target: MeshEntry,
    /// The image of the target that is mapped onto.
    #[serde(default)]
    pub target_image: TargetImage,
    /// The landmark file.
    pub landmarks: serde_json::Value,
    /// The choices of the run, as JSON.
    #[serde(default)]
    pub options: serde_json::Value,
    /// The map's numbers.
    pub summary: Summary,
    /// The places of the arrays in the file.
    pub sections: Vec<SectionEntry>,
}

/// A mesh that the map was made with.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct MeshEntry {
    /// The length of its file in bytes.
    pub bytes: u64,
    /// The SHA-256 of its file.
    pub sha256: String,
    /// The SHA-256 of the checked mesh.
    pub checked_sha256: String,
    /// Number of vertices of the file.
    pub vertices: u64,
    /// Number of triangles.
    pub faces: u64,
}

/// The map's numbers, as in the report's `distortion`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Integral of |J|^2 over the source plus |J^-1|^2 over the target; 4 for an isometry.
    pub energy: f64,
    /// Mean density over the source; 1 for an isometry.
    pub mean: f64,
    /// Half the sum of the means over source and target of the density's logarithm.
    pub mean_log: f64,
    /// The median of the density.
    pub median: f64,
    /// The 95 % quantile of the density.
    pub p95: f64,
    /// The maximum of the density.
    pub max: f64,
    /// Share of the area with a density above 20.
    pub dented: f64,
    /// L2 stretch of the texture coordinates; `null` where there are none.
    pub l2_stretch: Option<f64>,
}

impl From<&DistortionReport> for Summary {
    fn from(report: &DistortionReport) -> Self {
        let DistortionReport { energy, mean, mean_log, median, p95, max, dented, l2_stretch, .. } = *report;
        Self { energy, mean, mean_log, median, p95, max, dented, l2_stretch }
    }
}

/// The place of an array in the file.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct SectionEntry {
    /// The name of the section.
    pub name: String,
    /// The type of its elements.
    #[serde(rename = "type")]
    pub kind: SectionType,
    /// Number of its elements.
    pub count: u64,
    /// The way in which the array is stored.
    #[serde(default)]
    pub packing: Packing,
    /// The offset of its first byte from the end of the header.
    pub offset: u64,
    /// The length of the section as stored, in bytes.
    pub bytes: u64,
}

impl SectionEntry {
    /// The length once unpacked, in bytes; `None` for elements of a type that this version does not know.
    pub fn unpacked_size(&self) -> Option<u64> {
        let width = match self.kind {
            SectionType::U8 => 1,
            SectionType::U32 => 4,
            SectionType::F64 => 8,
            SectionType::Other => return None,
        };
        Some(self.count.saturating_mul(width))
    }
}

/// Type of the elements, little-endian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum SectionType {
    /// One byte.
    U8,
    /// Four bytes.
    U32,
    /// Eight bytes.
    F64,
    /// A type that this version does not know.
    #[serde(other)]
    Other,
}

/// The way in which a section is stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Packing {
    /// The section is stored as it is.
    #[default]
    None,
    /// The section is deflated with a zlib header and checksum (RFC 1950).
    Deflate,
    /// The section is packed in a way that this version does not know.
    #[serde(other)]
    Other,
}
