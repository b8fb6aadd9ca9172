//! The look that a map carries: the target's own colours and pictures, or the source's where the target has none.

use crate::export::skin::Skin;
use crate::io::appearance::{self, Appearance};
use crate::io::{LookRemark, read_mesh};
use crate::landmarks::MeshSide;
use crate::map_file::FileMesh;
use crate::mesh::dressing::{Giver, carried};
use crate::mesh::look::Look;
use crate::mesh::{FaceId, VertexId};
use crate::surface_map::measures::transfer::CommonMesh;
use glam::DVec3;

/// The contents of the files that say how a mesh looks.
#[derive(Clone, Copy, Debug)]
pub struct LookFiles<'a> {
    /// The mesh file.
    pub mesh: &'a [u8],
    /// The file that comes with the mesh: a picture, or the set of an OBJ file's materials ([`crate::io::material_set`]).
    pub companion: Option<&'a [u8]>,
}

/// The look that a map carries.
#[derive(Clone, Debug, Default)]
pub struct MapLook {
    /// The mesh that gives it, and its look; `None` where neither mesh has colours.
    giver: Option<(MeshSide, Look)>,
    /// Remarks on the parts of the looks of source and target that cannot be used.
    pub remarks: [Vec<LookRemark>; 2],
}

impl MapLook {
    /// Reads the look of the target, or that of the source where the target has no colours. Files that are not those of the meshes say
    /// nothing.
    pub(super) fn read(meshes: [&FileMesh; 2], files: [LookFiles<'_>; 2]) -> Self {
        let mut map_look = Self::default();
        for side in [MeshSide::Target, MeshSide::Source] {
            let (look, remarks) = look_of(meshes[side], files[side]);
            map_look.remarks[side] = remarks;
            if let Some(look) = look.filter(Look::is_coloured) {
                map_look.giver = Some((side, look));
                break;
            }
        }
        map_look
    }

    /// The skin of the triangles of a map between these meshes: the look, or a checkerboard where there is none, or where it is not known
    /// in which faces the triangles lie.
    pub(super) fn skin(
        &self,
        common: &CommonMesh,
        meshes: [&FileMesh; 2],
    ) -> Result<Skin, png::EncodingError> {
        let Some((side, look)) = self.giver.as_ref().filter(|_| !common.faces.is_empty()) else {
            return Skin::checkerboard(common);
        };
        let side = *side;
        let faces: Vec<FaceId> = common.faces.iter().map(|faces| faces[side]).collect();
        // Back to the mapped mesh, which may be a mirror image.
        let on_mesh = |p: &DVec3| meshes[side].as_given(*p);
        let places = [&common.source_positions, &common.target_positions][side];
        let places: Vec<DVec3> = places.iter().map(on_mesh).collect();
        let giver = Giver { mesh: meshes[side].mesh(), look };
        Skin::of_look(&carried(giver, &places, &common.triangles, &faces), &look.pictures)
    }
}

/// The look of a mapped mesh by its files.
fn look_of(mesh: &FileMesh, files: LookFiles<'_>) -> (Option<Look>, Vec<LookRemark>) {
    let soup = read_mesh(files.mesh).ok().filter(|_| mesh.is_of(files.mesh));
    let Some(soup) = soup else { return (None, Vec::new()) };
    let Appearance { look, remarks } = appearance::read(files.mesh, &soup, files.companion);
    let place = |v: VertexId| mesh.in_file(mesh.mesh().positions()[v]);
    (look.and_then(|look| look.by_face(&soup, mesh.checked(), place)), remarks)
}
