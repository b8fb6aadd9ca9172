//! The options of a repair.

use serde::{Deserialize, Serialize};

/// The options of a repair. A name or a value that is not known is an error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct RepairOptions {
    /// The distance within which vertices on open edges are joined, in the file's units; 0 for exactly equal places.
    pub join_within: f64,
    /// Says which parts may stay and go.
    pub parts: Parts,
    /// Says what becomes of handles.
    pub handles: Handles,
}

impl RepairOptions {
    /// Allows every repair, but that vertices are joined at equal places only. A mesh that is repaired with less is repaired alike
    /// with these options: each of them only allows what would be refused without it.
    pub fn everything() -> Self {
        Self { join_within: 0.0, parts: Parts::LargestAlone, handles: Handles::Cut }
    }
}

/// The treatment of handles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Handles {
    /// A surface that has handles is refused: to cut them changes its shape.
    #[default]
    Refused,
    /// Handles are cut along their shortest loops, and closed.
    Cut,
}

/// Which parts may stay and go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Parts {
    /// The largest part by area stays; the others go where they have less than 1 % of the area together.
    #[default]
    LargestAndSpecks,
    /// The largest part by area stays, whatever the others are.
    LargestAlone,
}
