//! The flat layout of a map: the base domain with a drawing of each mesh.

use super::drawing::{self, FlatDrawing};
use crate::base_domain::BaseDomain;
use crate::mesh::{Carrier, HalfedgeId};
use crate::monitor::{Cancelled, Monitor};
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::Parametrised;
use typed_index_collections::TiVec;

/// Both meshes on the flat triangles of their base domain.
#[derive(Clone, Debug)]
pub struct FlatLayout {
    /// The base domain: vertex k is landmark k, first those of the user, then the program's own cones. Its positions are not used.
    pub base: BaseDomain,
    /// Length of each base halfedge; twins agree, and the charts' areas sum to 1.
    pub lengths: TiVec<HalfedgeId, f64>,
    /// The source's drawing and the target's.
    pub drawings: [FlatDrawing; 2],
}

impl FlatLayout {
    /// Draws both meshes; `None` where, by rounding at coincident points, a base edge does not arrive or two of them cross.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn new(
        [source, target]: [Parametrised<'_>; 2],
        surface: &ConeSurface,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Self>, Cancelled> {
        let drawings = [drawing::draw(source, surface, monitor)?, drawing::draw(target, surface, monitor)?];
        let [Some(source), Some(target)] = drawings else { return Ok(None) };
        Ok(Some(Self {
            base: surface.base.clone(),
            lengths: surface.lengths.clone(),
            drawings: [source, target],
        }))
    }

    /// The same drawings with places on the meshes that their meshes refine.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn carried(&self, carriers: [Carrier<'_>; 2], monitor: &mut dyn Monitor) -> Result<Self, Cancelled> {
        let [source, target] = carriers;
        let drawings =
            [self.drawings[0].carried(source, monitor)?, self.drawings[1].carried(target, monitor)?];
        Ok(Self { base: self.base.clone(), lengths: self.lengths.clone(), drawings })
    }
}
