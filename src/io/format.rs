//! The formats of mesh files: the only list of their names and endings.

use std::fmt;

/// Mesh file formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// Object File Format.
    Off,
    /// Stanford PLY, text or binary.
    Ply,
    /// Stereolithography, text or binary.
    Stl,
    /// glTF 2.0, binary or text with embedded buffers.
    Gltf,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 5] = [Self::Obj, Self::Off, Self::Ply, Self::Stl, Self::Gltf];

    /// All formats in words.
    pub const NAMES: &str = "OBJ, OFF, PLY, STL, GLB or glTF";

    /// The endings of its files' names, without the dot, the usual one first.
    pub const fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Obj => &["obj"],
            Self::Off => &["off"],
            Self::Ply => &["ply"],
            Self::Stl => &["stl"],
            Self::Gltf => &["glb", "gltf"],
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Obj => "OBJ",
            Self::Off => "OFF",
            Self::Ply => "PLY",
            Self::Stl => "STL",
            Self::Gltf => "glTF",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_in_words_are_those_of_the_endings() {
        let words = Format::NAMES.replace(" or ", ", ").to_lowercase();
        let endings: Vec<_> = Format::ALL.into_iter().flat_map(Format::endings).copied().collect();
        assert_eq!(words.split(", ").collect::<Vec<_>>(), endings);
    }
}
