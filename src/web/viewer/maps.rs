//! The parts of a map in the views.

use super::super::mesh_side;
use super::super::view_side::Side;
use super::canvas::Viewer;
use super::reading::{point, strips};
use crate::gpu::Mesh;
use crate::landmarks::MeshSide;
use crate::mesh::FaceId;
use crate::mesh::dressing::{Giver, carried};
use crate::scene::buffers::{Triangles, ribbons};
use crate::scene::looks::drawn;
use crate::scene::morph::{PackedBends, PackedWay, laid_on};
use crate::scene::{MapPicker, SurfaceVertex, seams};
use glam::{DVec3, Mat4, Vec2, Vec3};
use wasm_bindgen::prelude::*;

/// The numbers of a point.
fn three(numbers: &[f32], k: usize) -> [f32; 3] {
    [numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]]
}

/// A map's triangles as one side sees them, as [`Viewer::set_overlay`] takes them.
#[derive(Clone, Copy)]
pub(super) struct Overlay<'a> {
    pub(super) positions: &'a [f32],
    pub(super) normals: &'a [f32],
    pub(super) uvs: &'a [f32],
    pub(super) scale_places: &'a [f32],
    pub(super) triangles: &'a [u32],
    pub(super) images: &'a [f32],
    pub(super) image_normals: &'a [f32],
}

impl Viewer {
    /// The vertices of an overlay on a side; `None` where its arrays do not belong together, or a mesh is missing.
    pub(super) fn overlay_vertices(
        &self,
        side: MeshSide,
        overlay: Overlay<'_>,
    ) -> Option<Vec<SurfaceVertex>> {
        let Overlay { positions, normals, uvs, scale_places, triangles, images, image_normals } = overlay;
        let (target, own) = (self.sides[1].mesh.as_ref()?, self.sides[side].mesh.as_ref()?);
        let count = positions.len() / 3;
        let numbers = [normals.len(), images.len(), image_normals.len()];
        if numbers.iter().any(|n| *n != 3 * count)
            || uvs.len() != 2 * count
            || triangles.iter().any(|&v| v as usize >= count)
        {
            return None;
        }
        let hollows = own.hollows_at(positions, triangles);
        let vertex = |k: usize| SurfaceVertex {
            position: own.frame.place(point(three(positions, k))).to_array(),
            normal: three(normals, k),
            uv: [uvs[2 * k], uvs[2 * k + 1]],
            scale_place: scale_places.get(k).copied().unwrap_or(0.0),
            image: target.frame.place(point(three(images, k))).to_array(),
            image_normal: three(image_normals, k),
            hollow: hollows[k],
            bends: self.bends_at(side, k),
            ..SurfaceVertex::default()
        };
        Some((0..count).map(vertex).collect())
    }

    /// The offset of a point of the map from its straight way; only the source is morphed.
    fn bends_at(&self, side: MeshSide, point: usize) -> PackedBends {
        self.way.as_ref().filter(|_| side == MeshSide::Source).map(|way| way.at(point)).unwrap_or_default()
    }

    /// Patch lines on a side.
    pub(super) fn line_mesh(&self, side: MeshSide, points: &[f32], starts: &[u32]) -> Option<Mesh> {
        let mesh = self.sides[side].mesh.as_ref()?;
        let strips: Vec<Vec<Vec3>> = strips(points, starts)
            .into_iter()
            .map(|strip| strip.into_iter().map(|p| mesh.frame.place(p)).collect())
            .collect();
        let Triangles { vertices, indices } = ribbons(&strips);
        Some(self.renderer.line_mesh(&vertices, &indices))
    }
}

#[wasm_bindgen]
impl Viewer {
    /// Takes the map's triangles as one side sees them: positions and normals there, texture coordinates, the place of
    /// each point on the scale of colours (or none), and the images on the target.
    #[wasm_bindgen(js_name = setOverlay)]
    #[allow(clippy::too_many_arguments, reason = "typed arrays cannot be bundled")]
    pub fn set_overlay(
        &mut self,
        side: usize,
        positions: &[f32],
        normals: &[f32],
        uvs: &[f32],
        scale_places: &[f32],
        triangles: &[u32],
        images: &[f32],
        image_normals: &[f32],
    ) -> Result<(), JsValue> {
        let side = mesh_side(side)?;
        let overlay = Overlay { positions, normals, uvs, scale_places, triangles, images, image_normals };
        let Some(vertices) = self.overlay_vertices(side, overlay) else { return Ok(()) };
        let uploaded = self.renderer.surface_mesh(&vertices, triangles);
        if side == MeshSide::Source && self.way.is_none() {
            let (images, places): (Vec<Vec3>, Vec<Vec3>) =
                vertices.iter().map(|v| (Vec3::from_array(v.image), Vec3::from_array(v.position))).unzip();
            self.source_from_target = laid_on(&images, &places);
        }
        self.sides[side].overlay = Some(uploaded);
        Ok(())
    }

    /// Takes the map's triangles as one side sees them in the look of the giving side: positions and normals there, the places on the
    /// giver, the images on the target, and the giver's face of each triangle.
    #[wasm_bindgen(js_name = setCarriedLook)]
    #[allow(clippy::too_many_arguments, reason = "typed arrays cannot be bundled")]
    pub fn set_carried_look(
        &mut self,
        side: usize,
        giver: usize,
        positions: &[f32],
        normals: &[f32],
        places: &[f32],
        images: &[f32],
        image_normals: &[f32],
        triangles: &[u32],
        faces: &[u32],
    ) -> Result<(), JsValue> {
        let (side, giver) = (mesh_side(side)?, mesh_side(giver)?);
        let meshes = [side, giver, MeshSide::Target].map(|side| self.sides[side].mesh.as_ref());
        let [Some(own), Some(given), Some(target)] = meshes else { return Ok(()) };
        let Some(look) = given.look.as_deref() else { return Ok(()) };
        let count = positions.len() / 3;
        let numbers = [normals.len(), places.len(), images.len(), image_normals.len()];
        if numbers.iter().any(|n| *n != 3 * count) || triangles.iter().any(|&v| v as usize >= count) {
            return Ok(());
        }
        let hollows = own.hollows_at(positions, triangles);
        let vertex = |k: usize| SurfaceVertex {
            position: own.frame.place(point(three(positions, k))).to_array(),
            normal: three(normals, k),
            image: target.frame.place(point(three(images, k))).to_array(),
            image_normal: three(image_normals, k),
            hollow: hollows[k],
            bends: self.bends_at(side, k),
            ..SurfaceVertex::default()
        };
        let bare: Vec<SurfaceVertex> = (0..count).map(vertex).collect();
        let places: Vec<DVec3> = (0..count).map(|k| point(three(places, k))).collect();
        let faces: Vec<FaceId> = faces.iter().map(|face| FaceId(*face)).collect();
        let from = Giver { mesh: &given.checked.mesh, look };
        let dressed = carried(from, &places, triangles.as_chunks().0, &faces);
        let uploaded = self.renderer.dressed_mesh(drawn(&dressed, &bare));
        self.sides[side].carried = Some(uploaded);
        self.look_giver = Some(giver);
        Ok(())
    }

    /// Takes patch lines of one side: their points, and where each line starts among them, and one past the end.
    #[wasm_bindgen(js_name = setLines)]
    pub fn set_lines(&mut self, side: usize, points: &[f32], starts: &[u32]) -> Result<(), JsValue> {
        let side = mesh_side(side)?;
        if let Some(uploaded) = self.line_mesh(side, points, starts) {
            self.sides[side].lines = Some(uploaded);
        }
        Ok(())
    }

    /// Takes the seams of the texture as one side sees them, given by the map's triangles: positions there, and texture coordinates.
    #[wasm_bindgen(js_name = setSeams)]
    pub fn set_seams(
        &mut self,
        side: usize,
        positions: &[f32],
        uvs: &[f32],
        triangles: &[u32],
    ) -> Result<(), JsValue> {
        let side = mesh_side(side)?;
        let Some(mesh) = &self.sides[side].mesh else { return Ok(()) };
        let count = positions.len() / 3;
        if uvs.len() != 2 * count || triangles.iter().any(|&v| v as usize >= count) {
            return Ok(());
        }
        let place = |k: usize| mesh.frame.place(point(three(positions, k)));
        let places: Vec<Vec3> = (0..count).map(place).collect();
        let uvs: Vec<Vec2> = uvs.as_chunks().0.iter().map(|uv| Vec2::from_array(*uv)).collect();
        let seams = seams::seams(&places, &uvs, triangles.as_chunks().0);
        let Triangles { vertices, indices } = seams::drawn(&places, &seams);
        let uploaded = (!indices.is_empty()).then(|| self.renderer.marked_line_mesh(&vertices, &indices));
        self.sides[side].seams = uploaded;
        Ok(())
    }

    /// Takes the map to be asked by [`Viewer::probe`]: places of its points on both meshes, and its triangles.
    #[wasm_bindgen(js_name = setMap)]
    pub fn set_map(&mut self, source: &[f32], target: &[f32], triangles: &[u32]) {
        let points = |a: &[f32]| a.chunks_exact(3).map(|p| point([p[0], p[1], p[2]])).collect();
        let triangles = triangles.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        self.map = MapPicker::new([points(source), points(target)], triangles);
    }

    /// Shows the source's shape on its way to the target's: 0 the source's, 1 the target's, laid on it. Needs the source's overlay.
    /// Beyond 0 nothing is where the source's mesh has it, and the source's view shows no marks and picks nothing.
    #[wasm_bindgen(js_name = setMorph)]
    pub fn set_morph(&mut self, share: f32) {
        self.morph = share.clamp(0.0, 1.0);
    }

    /// Takes how the map's points are off straight lines on the way to the target's shape: 12 numbers a point, which with the range are
    /// those of `MorphWay` in the core's module, and the 16 numbers of the matrix, column by column, that lays the target on the source
    /// there. Overlays of the source that come next go that way.
    #[wasm_bindgen(js_name = setWay)]
    pub fn set_way(&mut self, laid: &[f32], range: f32, bends: &[i16]) {
        let Ok(laid) = <[f32; 16]>::try_from(laid) else { return };
        self.source_from_target = Mat4::from_cols_array(&laid);
        let points = bends.as_chunks::<4>().0.as_chunks::<3>().0.to_vec();
        self.way = Some(PackedWay { range, points });
    }

    /// Removes everything that a result has brought.
    #[wasm_bindgen(js_name = clearResult)]
    pub fn clear_result(&mut self) {
        self.sides.iter_mut().for_each(Side::clear_result);
        self.map = None;
        self.compared = None;
        self.look_giver = None;
        self.way = None;
        self.morph = 0.0;
    }
}
