//! Which of the two meshes: the source or the target.

use serde::{Deserialize, Serialize};
use std::ops::{Index, IndexMut};

/// One of the two meshes. It indexes pairs `[of the source, of the target]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum MeshSide {
    /// The source.
    Source,
    /// The target.
    Target,
}

impl MeshSide {
    /// The source, then the target.
    pub const BOTH: [Self; 2] = [Self::Source, Self::Target];

    /// The other mesh.
    #[inline]
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Source => Self::Target,
            Self::Target => Self::Source,
        }
    }
}

impl<T> Index<MeshSide> for [T; 2] {
    type Output = T;

    #[inline]
    fn index(&self, side: MeshSide) -> &T {
        &self[side as usize]
    }
}

impl<T> IndexMut<MeshSide> for [T; 2] {
    #[inline]
    fn index_mut(&mut self, side: MeshSide) -> &mut T {
        &mut self[side as usize]
    }
}

impl std::fmt::Display for MeshSide {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Source => "source",
            Self::Target => "target",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_source_is_first_in_every_pair() {
        let mut names = MeshSide::BOTH.map(|side| side.to_string());
        assert_eq!((&*names[MeshSide::Source], &*names[MeshSide::Target]), ("source", "target"));
        names[MeshSide::Target].push('s');
        assert_eq!(names, ["source", "targets"]);
        assert!(MeshSide::BOTH.iter().all(|&side| side != side.other() && side == side.other().other()));
    }
}
