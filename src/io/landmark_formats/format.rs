//! The formats of landmark files: the only list of their names and endings.

use serde::Serialize;
use std::fmt;

/// Landmark file formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum LandmarkFormat {
    /// The program's own pairs, JSON.
    Conemap,
    /// 3D Slicer's markups, JSON.
    SlicerJson,
    /// 3D Slicer's list of fiducial points.
    Fcsv,
    /// Faceform Wrap's points on triangles, JSON.
    Wrap,
    /// MeshLab's picked points, XML.
    #[serde(rename = "meshlab")]
    MeshLab,
    /// Points of the IDAV Landmark Editor.
    Idav,
    /// Specimens of the tps programs and of geomorph.
    Tps,
    /// Matrix of NTSYSpc and of geomorph.
    Nts,
    /// A table with a header line.
    Csv,
}

/// The meshes whose landmarks a written file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum Holds {
    /// A file always holds landmarks of both meshes.
    Both,
    /// A file holds landmarks of one mesh.
    One,
    /// A file holds landmarks of one mesh or of both, as is wanted.
    OneOrBoth,
}

impl LandmarkFormat {
    /// All formats.
    pub const ALL: [Self; 9] = [
        Self::Conemap,
        Self::SlicerJson,
        Self::Fcsv,
        Self::Wrap,
        Self::MeshLab,
        Self::Idav,
        Self::Tps,
        Self::Nts,
        Self::Csv,
    ];

    /// All formats in words.
    pub const NAMES: &str =
        "Conemap JSON, Slicer .mrk.json or .fcsv, Wrap JSON, MeshLab .pp, IDAV .pts, .tps, .nts or CSV";

    /// The word by which users choose it.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Conemap => "conemap",
            Self::SlicerJson => "slicer-json",
            Self::Fcsv => "fcsv",
            Self::Wrap => "wrap",
            Self::MeshLab => "meshlab",
            Self::Idav => "idav",
            Self::Tps => "tps",
            Self::Nts => "nts",
            Self::Csv => "csv",
        }
    }

    /// The format of a word.
    pub fn of_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.id() == id)
    }

    /// The format that the ending of a file's name says; the longest ending counts.
    pub fn of_name(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        let matching = |format: &Self| name.ends_with(&format!(".{}", format.ending()));
        let dta = name.ends_with(".dta").then_some(Self::Nts);
        // The last of equally long ones is taken, so that Wrap's ending means the program's own.
        Self::ALL.into_iter().rev().filter(matching).max_by_key(|format| format.ending().len()).or(dta)
    }

    /// The ending of its files' names, without the first dot. Wrap's is shared with the program's own.
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Conemap | Self::Wrap => "json",
            Self::SlicerJson => "mrk.json",
            Self::Fcsv => "fcsv",
            Self::MeshLab => "pp",
            Self::Idav => "pts",
            Self::Tps => "tps",
            Self::Nts => "nts",
            Self::Csv => "csv",
        }
    }

    /// The meshes whose landmarks a written file holds.
    pub const fn holds(self) -> Holds {
        match self {
            Self::Conemap => Holds::Both,
            Self::Fcsv | Self::Wrap | Self::MeshLab | Self::Idav => Holds::One,
            Self::SlicerJson | Self::Tps | Self::Nts | Self::Csv => Holds::OneOrBoth,
        }
    }
}

impl fmt::Display for LandmarkFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Conemap => "Conemap JSON",
            Self::SlicerJson => "Slicer markups",
            Self::Fcsv => "Slicer fiducial",
            Self::Wrap => "Wrap point",
            Self::MeshLab => "MeshLab point",
            Self::Idav => "IDAV point",
            Self::Tps => "TPS",
            Self::Nts => "NTS",
            Self::Csv => "CSV",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_endings_lead_back_to_their_format() {
        for format in LandmarkFormat::ALL {
            assert_eq!(LandmarkFormat::of_id(format.id()), Some(format));
            assert_eq!(serde_json::to_value(format).unwrap(), format.id());
            let of_name = LandmarkFormat::of_name(&format!("a.b.{}", format.ending().to_uppercase()));
            assert_eq!(of_name.map(LandmarkFormat::ending), Some(format.ending()));
        }
        assert_eq!(LandmarkFormat::of_name("head.mrk.json"), Some(LandmarkFormat::SlicerJson));
        assert_eq!(LandmarkFormat::of_name("json"), None);
    }
}
