//! Previews of a map for the vertices, and in the coordinates, of the meshes as they were given.

use crate::landmarks::MeshSide;
use crate::mesh::SurfaceMesh;
use crate::monitor::{Cancelled, MapPreview, Monitor, Step};
use glam::DVec3;

/// The roles of source and target while the map is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Roles {
    /// As they were given.
    AsGiven,
    /// Exchanged for the work.
    Exchanged,
}

/// A monitor that translates previews to the meshes that were given, and passes everything else on.
pub(super) struct InGivenMeshes<'a> {
    monitor: &'a mut dyn Monitor,
    /// The meshes between which the map is made, its source first.
    meshes: [&'a SurfaceMesh; 2],
    roles: Roles,
}

impl<'a> InGivenMeshes<'a> {
    /// The monitor of a map from the first to the second mesh.
    pub(super) fn new(monitor: &'a mut dyn Monitor, meshes: [&'a SurfaceMesh; 2], roles: Roles) -> Self {
        Self { monitor, meshes, roles }
    }
}

/// A preview of a map between meshes of area 1 that refine given ones.
struct OfGivenMeshes<'a> {
    preview: &'a dyn MapPreview,
    meshes: [&'a SurfaceMesh; 2],
    roles: Roles,
}

impl MapPreview for OfGivenMeshes<'_> {
    fn images(&self, of: MeshSide) -> Option<Vec<DVec3>> {
        let of = match self.roles {
            Roles::AsGiven => of,
            Roles::Exchanged => of.other(),
        };
        let [from, onto] = [of, of.other()].map(|side| self.meshes[side]);
        let mut places = self.preview.images(of)?;
        // The first vertices of a refined mesh are those of the mesh itself.
        places.truncate(from.vertex_count());
        let unit = onto.area().sqrt();
        places.iter_mut().for_each(|place| *place *= unit);
        Some(places)
    }
}

impl Monitor for InGivenMeshes<'_> {
    fn wrapped(&self) -> Option<&dyn Monitor> {
        Some(self.monitor)
    }

    fn wrapped_mut(&mut self) -> Option<&mut dyn Monitor> {
        Some(self.monitor)
    }

    fn preview(&mut self, preview: &dyn MapPreview) {
        self.monitor.preview(&OfGivenMeshes { preview, meshes: self.meshes, roles: self.roles });
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        self.monitor.step(step)
    }
}
