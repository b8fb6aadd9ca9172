//! What own cones are added to.

use super::OwnConeOptions;
use super::limb_ends::LimbEnds;
use crate::coarse_map::multilevel::{CoarseMap, LevelImages};
use crate::coarse_map::{LandmarkedMesh, MultilevelOptions};
use crate::mesh::SurfaceMesh;
use crate::monitor::{Cancelled, Monitor};
use std::cell::OnceCell;

/// Both meshes and their coarse map before own cones are added, and the options.
#[derive(Clone, Copy)]
pub struct OwnConeInput<'a> {
    /// The meshes that the user gave.
    pub inputs: [&'a SurfaceMesh; 2],
    /// The meshes with the user's landmarks.
    pub full: &'a [LandmarkedMesh; 2],
    /// The coarse map with the user's landmarks alone.
    pub map: &'a CoarseMap<'a>,
    /// Vertices of the coarse levels.
    pub vertices: usize,
    /// Whether patches of both meshes are known to fit each other ([`on_finer_level`](super::on_finer_level)).
    pub is_one_body: bool,
    /// Options of the coarse maps.
    pub multilevel: &'a MultilevelOptions,
    /// Options of the own cones.
    pub own: &'a OwnConeOptions,
}

/// An input that own cones are added to, with what every way to add them needs.
pub struct Start<'a> {
    pub(super) input: OwnConeInput<'a>,
    /// The options of these bodies.
    pub(super) own: OwnConeOptions,
    /// The images under the coarse map.
    pub(super) images: LevelImages,
    /// Ends of limbs without a landmark, once they are asked for.
    ends: OnceCell<LimbEnds>,
}

impl<'a> Start<'a> {
    /// `None` where own cones are not asked for, where the map is nearly an isometry, and where it gives no images.
    pub fn new(input: OwnConeInput<'a>) -> Option<Self> {
        let OwnConeInput { map, own, is_one_body, .. } = input;
        if own.count == 0 || map.mean_log < own.least_mean_log {
            return None;
        }
        let own = if is_one_body { own.of_poses() } else { *own };
        Some(Self { input, own, images: map.images()?, ends: OnceCell::new() })
    }

    /// Both meshes with the user's landmarks.
    pub fn full(&self) -> &'a [LandmarkedMesh; 2] {
        self.input.full
    }

    /// Mean log density of the coarse map without own cones.
    pub fn mean_log(&self) -> f64 {
        self.input.map.mean_log
    }

    /// Whether ends of limbs are looked for.
    pub fn looks_for_ends(&self) -> bool {
        self.own.ends > 0
    }

    /// Whether points far from all others are added: where there are few landmarks, and between two poses of one body.
    pub(super) fn has_far_points(&self) -> bool {
        let OwnConeInput { full, is_one_body, .. } = self.input;
        is_one_body || full[0].landmarks.len() <= self.own.most_landmarks
    }

    /// The number of ends of limbs that are farther than `distance` from all landmarks, of at most as many as the options say: that of the
    /// mesh with fewer. The area is 1.
    ///
    /// # Errors
    /// Cancellation only.
    pub fn unmarked_ends(&self, distance: f64, monitor: &mut dyn Monitor) -> Result<usize, Cancelled> {
        Ok(self.ends(monitor)?.unmarked(distance))
    }

    /// Ends of limbs without a landmark.
    pub(super) fn ends(&self, monitor: &mut dyn Monitor) -> Result<&LimbEnds, Cancelled> {
        if let Some(known) = self.ends.get() {
            return Ok(known);
        }
        let found = LimbEnds::find(self.input.full, &self.images, self.own.ends, monitor)?;
        Ok(self.ends.get_or_init(|| found))
    }
}
