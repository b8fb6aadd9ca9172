//! The common subdivision as one mesh with positions on both surfaces, and images of vertices.

use crate::mesh::normals::vertex_normals;
use crate::mesh::{Carrier, FaceFrame, FaceId, HalfedgeId, RefinedMesh, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Pulse, Step};
use crate::surface_map::overlay::Overlay;
use crate::surface_map::overlay::location::{Locations, barycentric};
use crate::surface_map::parametrisation::embedding::Parametrised;
use glam::{DVec2, DVec3};
use rustc_hash::{FxBuildHasher, FxHashMap};
use typed_index_collections::TiVec;

/// The common subdivision: one triangulation drawn on both surfaces, with the target's texture.
#[derive(Clone, Debug, Default)]
pub struct CommonMesh {
    /// Position on the source, in its input coordinates.
    pub source_positions: Vec<DVec3>,
    /// Position on the target, in its input coordinates.
    pub target_positions: Vec<DVec3>,
    /// Smooth unit normal of the source.
    pub source_normals: Vec<DVec3>,
    /// Smooth unit normal of the target.
    pub target_normals: Vec<DVec3>,
    /// The target's texture coordinates; a point on a seam occurs once per side.
    pub uvs: Vec<DVec2>,
    /// Counter-clockwise triples.
    pub triangles: Vec<[u32; 3]>,
    /// The piece of the overlay that holds each triangle; for [`mapped_mesh`] the source's face.
    pub pieces: Vec<u32>,
    /// The face of the source's and of the target's input mesh in which each triangle lies; empty for [`mapped_mesh`].
    pub faces: Vec<[FaceId; 2]>,
}

impl CommonMesh {
    /// The distance between the images of each vertex under this map and under another one, such as the true one, in units of the root of the
    /// target's area.
    pub fn distances_to(&self, image: impl Fn(DVec3) -> DVec3) -> Vec<f64> {
        let double_area = |corners: &[u32; 3]| {
            let [p, q, r] = corners.map(|v| self.target_positions[v as usize]);
            (q - p).cross(r - p).length()
        };
        let scale = (0.5 * self.triangles.iter().map(double_area).sum::<f64>()).sqrt().recip();
        let places = self.source_positions.iter().zip(&self.target_positions);
        places.map(|(s, t)| image(*s).distance(*t) * scale).collect()
    }

    /// Values by triangle averaged at the vertices, by area on the source.
    pub fn vertex_averages(&self, by_triangle: &[f64]) -> Vec<f64> {
        let mut sums = vec![[0.0_f64; 2]; self.source_positions.len()];
        for (corners, value) in self.triangles.iter().zip(by_triangle) {
            let [p, q, r] = corners.map(|v| self.source_positions[v as usize]);
            let area = (q - p).cross(r - p).length();
            for &v in corners {
                let sum: &mut [f64; 2] = &mut sums[v as usize];
                sum[0] += area * value;
                sum[1] += area;
            }
        }
        sums.into_iter().map(|[value, area]| if area > 0.0 { value / area } else { 1.0 }).collect()
    }
}

/// One of the two surfaces with its input mesh.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    /// The mesh that the user gave.
    pub input: &'a SurfaceMesh,
    /// Its refinement.
    pub refined: &'a RefinedMesh,
}

impl<'a> Surface<'a> {
    /// The carrier from places of the refinement to places of the mesh that the user gave; `frame` is [`RefinedMesh::frame`].
    pub fn carrier(&self, frame: &'a dyn Fn(FaceId) -> FaceFrame) -> Carrier<'a> {
        Carrier { from: &self.refined.mesh, onto: self.input, frame }
    }
}

fn blend3<T: Copy + std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T>>(
    values: [T; 3],
    w: [f64; 3],
) -> T {
    values[0] * w[0] + values[1] * w[1] + values[2] * w[2]
}

/// The image of every source input vertex as a point of the target's input mesh.
pub fn vertex_images(
    [source, target]: [Parametrised<'_>; 2],
    target_surface: Surface<'_>,
    locations: &Locations,
    vertices: usize,
) -> TiVec<VertexId, SurfacePoint> {
    let image = |v: usize| {
        let point = barycentric(source, target, &locations.by_vertex[VertexId::from(v)]);
        target_surface.refined.on_input(target_surface.input, point)
    };
    (0..vertices).map(image).collect()
}

/// Positions, normals and texture coordinates at the corners of a refined face.
struct FaceValues {
    positions: [DVec3; 3],
    normals: [DVec3; 3],
    uvs: [DVec2; 3],
}

fn face_values(
    surface: Surface<'_>,
    normals: &TiVec<VertexId, DVec3>,
    uvs: Option<&TiVec<HalfedgeId, DVec2>>,
    face: FaceId,
) -> FaceValues {
    let rows = surface.refined.origins_in_face(surface.input, face);
    let input_face = surface.refined.face_origin[face];
    let corner_normals = surface.input.triangles()[input_face].map(|v| normals[v]);
    let corners = surface.input.corners(input_face);
    let corner_uvs = uvs.map_or([DVec2::ZERO; 3], |uvs| input_face.halfedges().map(|h| uvs[h]));
    FaceValues {
        positions: rows.map(|w| blend3(corners, w)),
        normals: rows.map(|w| blend3(corner_normals, w)),
        uvs: rows.map(|w| blend3(corner_uvs, w)),
    }
}

/// Pieces between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 2048;

/// The overlay as one mesh; a corner is shared by the pieces around it, once per side of a texture seam.
///
/// `target_uvs` are texture coordinates by corner of the target's input mesh.
///
/// # Errors
/// [`Cancelled`].
pub fn common_mesh(
    [source, target]: [Surface<'_>; 2],
    overlay: &Overlay,
    target_uvs: &TiVec<HalfedgeId, DVec2>,
    monitor: &mut dyn Monitor,
) -> Result<CommonMesh, Cancelled> {
    let normals = [vertex_normals(source.input), vertex_normals(target.input)];
    monitor.step(Step::default())?;
    let values = |s: Surface<'_>, n, uvs| s.refined.mesh.faces().map(|f| face_values(s, n, uvs, f)).collect();
    let source_values: TiVec<FaceId, FaceValues> = values(source, &normals[0], None);
    monitor.step(Step::default())?;
    let target_values: TiVec<FaceId, FaceValues> = values(target, &normals[1], Some(target_uvs));
    monitor.step(Step::default())?;
    // With room for all vertices and an eighth on top for seams: a table that grows takes long, in silence.
    let mut shared = FxHashMap::with_capacity_and_hasher(overlay.vertex_count * 9 / 8, FxBuildHasher);
    let mut mesh = CommonMesh::default();
    let mut ring = Vec::new();
    let mut pulse = Pulse::new(monitor, ASKED_EVERY);
    for (number, piece) in overlay.pieces.iter().enumerate() {
        pulse.beat()?;
        let (s, t) = (&source_values[piece.source_face], &target_values[piece.target_face]);
        let faces =
            [source.refined.face_origin[piece.source_face], target.refined.face_origin[piece.target_face]];
        ring.clear();
        for point in &overlay.points[piece.points.clone()] {
            let position = blend3(s.positions, point.source);
            let uv = blend3(t.uvs, point.target);
            // Texture coordinates that differ by less than 1e-8 are copies of one corner, up to rounding.
            let key = (point.vertex, (uv * 1e8).round().to_array().map(|x| x as i64));
            let next = mesh.uvs.len() as u32;
            let index = *shared.entry(key).or_insert(next);
            if index == next {
                mesh.source_positions.push(position);
                mesh.target_positions.push(blend3(t.positions, point.target));
                mesh.source_normals.push(blend3(s.normals, point.source).normalize_or(DVec3::Z));
                mesh.target_normals.push(blend3(t.normals, point.target).normalize_or(DVec3::Z));
                mesh.uvs.push(uv);
            }
            ring.push(index);
        }
        for k in 2..ring.len() {
            let triangle = [ring[0], ring[k - 1], ring[k]];
            if triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0] {
                mesh.triangles.push(triangle);
                mesh.pieces.push(number as u32);
                mesh.faces.push(faces);
            }
        }
    }
    Ok(mesh)
}

/// The source's triangles whose corners all have images, with the target's texture at the images.
///
/// A vertex has one texture coordinate, that of its image's face, so that the texture is smeared over triangles whose images
/// lie on both sides of a seam.
pub fn mapped_mesh(
    source: &SurfaceMesh,
    target: &SurfaceMesh,
    images: &TiVec<VertexId, Option<SurfacePoint>>,
    target_uvs: &TiVec<HalfedgeId, DVec2>,
) -> CommonMesh {
    let normals = [vertex_normals(source), vertex_normals(target)];
    let mut number: TiVec<VertexId, Option<u32>> = images.iter().map(|_| None).collect();
    let mut mesh = CommonMesh::default();
    for (v, image) in images.iter_enumerated() {
        let Some(SurfacePoint { face, barycentric }) = *image else { continue };
        number[v] = Some(mesh.uvs.len() as u32);
        mesh.source_positions.push(source.positions()[v]);
        mesh.target_positions.push(blend3(target.corners(face), barycentric));
        mesh.source_normals.push(normals[0][v]);
        let corners = target.triangles()[face].map(|c| normals[1][c]);
        mesh.target_normals.push(blend3(corners, barycentric).normalize_or(DVec3::Z));
        let corners = face.halfedges().map(|h| target_uvs[h]);
        mesh.uvs.push(blend3(corners, barycentric));
    }
    for (f, corners) in source.triangles().iter_enumerated() {
        if let [Some(a), Some(b), Some(c)] = corners.map(|v| number[v]) {
            mesh.triangles.push([a, b, c]);
            mesh.pieces.push(f.0);
        }
    }
    mesh
}
