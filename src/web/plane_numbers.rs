//! A plane as the page has it.

use crate::landmark_suggestion::MirrorPlane;
#[cfg(feature = "web-core")]
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A plane in the numbers of the mesh.
#[derive(Deserialize, Serialize)]
pub(super) struct PlaneNumbers {
    normal: [f64; 3],
    through: [f64; 3],
}

impl PlaneNumbers {
    /// The numbers of a plane.
    #[cfg(feature = "web-core")]
    pub(super) fn of(plane: &MirrorPlane) -> Self {
        let normal = plane.normal();
        let through = normal * -plane.height(DVec3::ZERO);
        Self { normal: normal.to_array(), through: through.to_array() }
    }

    /// The plane; `None` where the numbers are none.
    #[cfg(feature = "web-page")]
    pub(super) fn plane(&self) -> Option<MirrorPlane> {
        MirrorPlane::across(self.normal.into(), self.through.into())
    }
}
