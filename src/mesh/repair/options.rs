//! What a repair may do.

/// What a repair may do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RepairOptions {
    /// Vertices on open edges are joined where they are within this distance, in the file's units; 0 for exactly equal places.
    pub join_within: f64,
    /// Which parts may stay and go.
    pub parts: Parts,
    /// What becomes of handles.
    pub handles: Handles,
}

/// What becomes of handles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Handles {
    /// A surface that has some is refused: to cut them changes its shape.
    #[default]
    Refused,
    /// They are cut along their shortest loops, and closed.
    Cut,
}

/// Which parts may stay and go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Parts {
    /// The largest part by area stays; the others go where they have less than 1 % of the area together.
    #[default]
    LargestAndSpecks,
    /// The largest part by area stays, whatever the others are.
    LargestAlone,
}
