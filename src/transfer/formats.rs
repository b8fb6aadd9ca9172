//! The formats in which values and curves are written that were brought over, by the endings of their files' names.

use serde::Deserialize;

/// The file formats of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum ValueFormat {
    /// A table with commas.
    Csv,
    /// The receiving mesh with the values as vertex properties.
    Ply,
}

impl ValueFormat {
    /// All formats.
    pub const ALL: [Self; 2] = [Self::Csv, Self::Ply];

    /// The ending of its files' names, without the dot.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Ply => "ply",
        }
    }
}

/// The file formats of curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum CurveFormat {
    /// Points on faces, which can be brought back.
    Json,
    /// The same as a table.
    Csv,
    /// Lines in space, for other programs.
    Obj,
}

impl CurveFormat {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Json, Self::Csv, Self::Obj];

    /// The ending of its files' names, without the dot.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Json => "json",
            Self::Csv => "csv",
            Self::Obj => "obj",
        }
    }
}
