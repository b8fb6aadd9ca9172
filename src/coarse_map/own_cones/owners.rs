//! Storage for the meshes and the levels of rounds of own cones, which outlives the maps that borrow them.

use super::OwnConeOptions;
use crate::coarse_map::{LandmarkedMesh, MeshWithCoarse};
use std::cell::OnceCell;

/// Storage for the meshes or levels of all rounds, which their maps borrow: each round fills one cell.
pub struct Rounds<T>(Vec<OnceCell<[T; 2]>>);

impl<T> Rounds<T> {
    /// Empty storage for all rounds.
    pub fn new(options: &OwnConeOptions) -> Self {
        // Each round with ends of limbs has half as many as the one before.
        let with_ends = usize::BITS - options.ends.leading_zeros();
        Self((0..with_ends as usize + options.all_rounds()).map(|_| OnceCell::new()).collect())
    }
}

/// Storage for the meshes and the levels of all rounds.
#[derive(Clone, Copy)]
pub struct Owners<'a> {
    /// Both meshes with own landmarks.
    pub meshes: &'a Rounds<LandmarkedMesh>,
    /// These meshes with their coarse levels.
    pub levels: &'a Rounds<MeshWithCoarse<'a>>,
}

/// The cells of both that are not filled yet, round by round.
pub(super) type Cells<'a> = std::iter::Zip<
    std::slice::Iter<'a, OnceCell<[LandmarkedMesh; 2]>>,
    std::slice::Iter<'a, OnceCell<[MeshWithCoarse<'a>; 2]>>,
>;

impl<'a> Owners<'a> {
    pub(super) fn cells(self) -> Cells<'a> {
        self.meshes.0.iter().zip(&self.levels.0)
    }
}
