//! The flat layout of a map: the base domain with a drawing of each mesh.

use super::drawing::{self, FlatDrawing};
use crate::base_domain::BaseDomain;
use crate::mesh::{Carrier, HalfedgeId};
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::Parametrised;
use typed_index_collections::TiVec;

/// Both meshes on the flat triangles of their base domain.
#[derive(Clone, Debug)]
pub struct FlatLayout {
    /// The base domain: vertex k is landmark k, after those of the user the program's own. Its positions mean nothing here.
    pub base: BaseDomain,
    /// Length of each base halfedge; twins agree, and the whole has area 1.
    pub lengths: TiVec<HalfedgeId, f64>,
    /// The source's drawing and the target's.
    pub drawings: [FlatDrawing; 2],
}

impl FlatLayout {
    /// Draws both meshes; `None` where rounding at coincident points leaves a line lost or crossed.
    pub fn new(sides: [Parametrised<'_>; 2], surface: &ConeSurface) -> Option<Self> {
        let [source, target] = sides.map(|side| drawing::draw(side, surface));
        Some(Self {
            base: surface.base.clone(),
            lengths: surface.lengths.clone(),
            drawings: [source?, target?],
        })
    }

    /// The same drawings told of the meshes that their meshes refine.
    #[must_use]
    pub fn carried(&self, carriers: [Carrier<'_>; 2]) -> Self {
        let drawings = [0, 1].map(|k| self.drawings[k].carried(carriers[k]));
        Self { base: self.base.clone(), lengths: self.lengths.clone(), drawings }
    }
}
