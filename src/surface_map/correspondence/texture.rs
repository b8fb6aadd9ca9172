//! Texture coordinates of the target, and the pieces as one textured triangulation of both meshes.

use super::pieces::Correspondence;
use crate::landmarks::MeshSide;
use crate::math::barycentric::interpolated;
use crate::mesh::normals::vertex_normals;
use crate::mesh::{Carrier, FaceId, HalfedgeId, Place, SurfaceMesh, VertexId};
use crate::surface_map::measures::transfer::CommonMesh;
use glam::{DMat2, DVec2, DVec3};
use rustc_hash::FxHashMap;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// Texture coordinates on the target: triangles inside its faces, affine on each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureDrawing {
    /// Corners of triangles; a place on a seam occurs once per side.
    pub vertices: Vec<TextureVertex>,
    /// Triples of numbers in `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// The face of the target that holds each triangle; together they cover every face.
    pub faces: Vec<FaceId>,
}

/// A corner of a texture triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureVertex {
    /// Its place on the target.
    pub place: Place,
    /// Its texture coordinates.
    pub uv: DVec2,
}

impl TextureDrawing {
    /// Texture coordinates by corner of a mesh, with places on the mesh that it refines.
    pub fn of_corners(carrier: Carrier<'_>, uvs: &TiSlice<HalfedgeId, DVec2>) -> Self {
        let mut drawing = Self::default();
        let mut numbers = FxHashMap::default();
        for (f, corners) in carrier.from.triangles().iter_enumerated() {
            let frame = (carrier.frame)(f);
            drawing.faces.push(frame.face);
            drawing.triangles.push([0, 1, 2].map(|k| {
                let uv = uvs[HalfedgeId::of(f, k)];
                let next = drawing.vertices.len() as u32;
                let number = *numbers.entry((corners[k], uv.to_array().map(f64::to_bits))).or_insert(next);
                if number == next {
                    drawing
                        .vertices
                        .push(TextureVertex { place: carrier.place(Place::Vertex(corners[k])), uv });
                }
                number
            }));
        }
        drawing
    }

    /// The numbers of the triangles in each face of the target, which has `faces` faces.
    fn by_face(&self, faces: usize) -> TiVec<FaceId, Vec<u32>> {
        let mut inside: TiVec<FaceId, Vec<u32>> = ti_vec![Vec::new(); faces];
        for (k, &face) in self.faces.iter().enumerate() {
            inside[face].push(k as u32);
        }
        inside
    }
}

/// A texture triangle: texture coordinates as an affine function of barycentric coordinates 1 and 2 in its face.
struct Patch {
    origin: DVec2,
    /// From barycentric coordinates in the face to those in the triangle.
    inside: DMat2,
    uvs: [DVec2; 3],
}

impl Patch {
    fn new(drawing: &TextureDrawing, target: &SurfaceMesh, number: u32) -> Option<Self> {
        let face = drawing.faces[number as usize];
        let corners = drawing.triangles[number as usize].map(|v| drawing.vertices[v as usize]);
        let at = |k: usize| corners[k].place.weights_in(target, face).map(|[_, x, y]| DVec2::new(x, y));
        let [p, q, r] = [at(0)?, at(1)?, at(2)?];
        let inside = DMat2::from_cols(q - p, r - p).inverse();
        inside.is_finite().then_some(Self { origin: p, inside, uvs: corners.map(|c| c.uv) })
    }

    fn weights(&self, place: DVec2) -> [f64; 3] {
        let w = self.inside * (place - self.origin);
        [1.0 - w.x - w.y, w.x, w.y]
    }

    fn uv(&self, place: DVec2) -> DVec2 {
        interpolated(self.uvs, self.weights(place))
    }
}

/// The texture triangle that holds the middle of a piece.
fn patch_of(drawing: &TextureDrawing, inside: &[u32], target: &SurfaceMesh, ring: &[DVec2]) -> Option<Patch> {
    let middle = ring.iter().sum::<DVec2>() / ring.len() as f64;
    let depth = |patch: &Patch| patch.weights(middle).into_iter().fold(f64::INFINITY, f64::min);
    let patches = inside.iter().filter_map(|&k| Patch::new(drawing, target, k));
    patches.max_by(|a, b| depth(a).total_cmp(&depth(b)))
}

/// Both meshes with their vertex normals.
struct Surfaces<'a> {
    meshes: [&'a SurfaceMesh; 2],
    normals: [TiVec<VertexId, DVec3>; 2],
}

impl Surfaces<'_> {
    fn normal(&self, side: MeshSide, place: Place) -> DVec3 {
        let point = place.surface_point(self.meshes[side]);
        let normals = self.meshes[side].triangles()[point.face].map(|v| self.normals[side][v]);
        interpolated(normals, point.barycentric).normalize_or(DVec3::Z)
    }
}

/// The pieces as one triangle mesh; a corner is shared by the pieces around it, once per side of a texture seam. Without a texture all
/// texture coordinates are 0.
pub fn common_mesh(
    meshes: [&SurfaceMesh; 2],
    map: &Correspondence,
    texture: Option<&TextureDrawing>,
) -> CommonMesh {
    let surfaces = Surfaces { meshes, normals: meshes.map(vertex_normals) };
    let inside = texture.map(|drawing| drawing.by_face(meshes[1].face_count()));
    let mut shared = FxHashMap::default();
    let mut mesh = CommonMesh::default();
    let (mut ring, mut places) = (Vec::new(), Vec::new());
    for (number, piece) in map.pieces.iter().enumerate() {
        map.ring(meshes[1], MeshSide::Target, piece, &mut places);
        let triangles = inside.as_ref().map(|inside| &inside[piece.faces[1]][..]);
        let patch = texture
            .zip(triangles)
            .and_then(|(drawing, inside)| patch_of(drawing, inside, meshes[1], &places));
        ring.clear();
        for (&vertex, &place) in map.corners[piece.corners.clone()].iter().zip(&places) {
            let uv = patch.as_ref().map_or(DVec2::ZERO, |patch| patch.uv(place));
            // Texture coordinates that differ by less than 1e-8 are copies of one corner, up to rounding.
            let key = (vertex, (uv * 1e8).round().to_array().map(|x| x as i64));
            let next = mesh.uvs.len() as u32;
            let index = *shared.entry(key).or_insert(next);
            if index == next {
                let [source, target] = map.vertices[vertex as usize];
                mesh.source_positions.push(source.position(meshes[0]));
                mesh.target_positions.push(target.position(meshes[1]));
                mesh.source_normals.push(surfaces.normal(MeshSide::Source, source));
                mesh.target_normals.push(surfaces.normal(MeshSide::Target, target));
                mesh.uvs.push(uv);
            }
            ring.push(index);
        }
        push_fan(&mut mesh, &ring, number as u32, piece.faces);
    }
    mesh
}

/// Adds the triangles of a piece to the mesh, without those that have a corner twice.
fn push_fan(mesh: &mut CommonMesh, ring: &[u32], piece: u32, faces: [FaceId; 2]) {
    for k in 2..ring.len() {
        let triangle = [ring[0], ring[k - 1], ring[k]];
        if triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0] {
            mesh.triangles.push(triangle);
            mesh.pieces.push(piece);
            mesh.faces.push(faces);
        }
    }
}
