//! The input of a wrap: the base, the scan and the map between them.

use crate::mesh::cap_faces::CapFaces;
use crate::mesh::{FaceId, SurfaceMesh};
use crate::surface_map::correspondence::Correspondence;

/// A map from a base mesh to a scan, both closed, with the marks of what closed them.
#[derive(Clone, Copy, Debug)]
pub struct WrapInput<'a> {
    /// The base: the map's source.
    pub base: &'a SurfaceMesh,
    /// The scan: the map's target.
    pub scan: &'a SurfaceMesh,
    /// The map between them.
    pub map: &'a Correspondence,
    /// Which faces of both were made up to close holes.
    pub caps: CapFaces<'a>,
}

impl WrapInput<'_> {
    pub(super) fn is_base_skin(&self, face: FaceId) -> bool {
        !self.caps.source.is_some_and(|caps| caps[face])
    }

    pub(super) fn is_scan_skin(&self, face: FaceId) -> bool {
        !self.caps.target.is_some_and(|caps| caps[face])
    }
}
