//! Surfaces in the look of a mesh's file: its colours, and its picture by the places in it.

use super::SurfaceVertex;
use crate::mesh::closest_point::closest_in_triangle;
use crate::mesh::look::{CornerLook, Look};
use crate::mesh::{FaceId, SurfaceMesh};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// A mesh and its look, which it gives to what is drawn.
#[derive(Clone, Copy)]
pub struct Giver<'a> {
    /// The mesh.
    pub mesh: &'a SurfaceMesh,
    /// Its look.
    pub look: &'a Look,
}

/// Vertices and indices in a look. A vertex of the picture is made once for each look that it has in the triangles around it, as on
/// both sides of a seam.
#[derive(Default)]
struct Dressed {
    vertices: Vec<SurfaceVertex>,
    indices: Vec<u32>,
    known: FxHashMap<(u32, [u8; 4], [u32; 2]), u32>,
}

impl Dressed {
    fn push(&mut self, number: u32, bare: &SurfaceVertex, look: CornerLook) {
        let [r, g, b] = look.colour;
        let tint = [r, g, b, if look.place.is_some() { u8::MAX } else { 0 }];
        let uv = look.place.map_or([0.0; 2], |[u, v]| [u, 1.0 - v]);
        let next = self.vertices.len() as u32;
        let index = *self.known.entry((number, tint, uv.map(f32::to_bits))).or_insert(next);
        if index == next {
            self.vertices.push(SurfaceVertex { uv, tint, ..*bare });
        }
        self.indices.push(index);
    }
}

/// The mesh itself in its look; `bare` are its vertices as they are drawn without one.
pub fn dressed(giver: Giver<'_>, bare: &[SurfaceVertex]) -> (Vec<SurfaceVertex>, Vec<u32>) {
    let mut dressed = Dressed::default();
    for (corners, looks) in giver.mesh.triangles().iter().zip(&giver.look.corners) {
        for (v, look) in corners.iter().zip(looks) {
            if let Some(vertex) = bare.get(v.index()) {
                dressed.push(v.0, vertex, *look);
            }
        }
    }
    (dressed.vertices, dressed.indices)
}

/// The triangles of a map in the look of the mesh in whose faces they lie: `bare` are their vertices as they are drawn without it,
/// `places` where these are on the giver, and `faces` the giver's face of each triangle.
pub fn carried(
    giver: Giver<'_>,
    bare: &[SurfaceVertex],
    places: &[DVec3],
    triangles: &[[u32; 3]],
    faces: &[FaceId],
) -> (Vec<SurfaceVertex>, Vec<u32>) {
    let mut dressed = Dressed::default();
    for (triangle, &face) in triangles.iter().zip(faces) {
        if face.index() >= giver.mesh.face_count() {
            continue;
        }
        let corners = giver.mesh.corners(face);
        for &v in triangle {
            if let Some((vertex, place)) = bare.get(v as usize).zip(places.get(v as usize)) {
                dressed.push(v, vertex, giver.look.at(face, closest_in_triangle(*place, corners)));
            }
        }
    }
    (dressed.vertices, dressed.indices)
}

/// A picture of 8-bit colours with opacity, and its smaller copies, each half as wide and high, down to one pixel.
pub fn levels(width: u32, height: u32, pixels: Vec<u8>) -> Vec<(u32, u32, Vec<u8>)> {
    let mut levels = vec![(width, height, pixels)];
    while let Some((width, height, pixels)) = levels.last().filter(|(w, h, _)| *w > 1 || *h > 1) {
        let next = halved(*width, *height, pixels);
        levels.push(next);
    }
    levels
}

fn halved(width: u32, height: u32, pixels: &[u8]) -> (u32, u32, Vec<u8>) {
    let [wide, high] = [(width / 2).max(1), (height / 2).max(1)];
    let mut smaller = Vec::with_capacity(4 * (wide * high) as usize);
    for y in 0..high {
        for x in 0..wide {
            let of = |dx: u32, dy: u32| {
                let [x, y] = [(2 * x + dx).min(width - 1), (2 * y + dy).min(height - 1)];
                4 * (y * width + x) as usize
            };
            let four = [of(0, 0), of(1, 0), of(0, 1), of(1, 1)];
            for k in 0..4 {
                let sum: u32 = four.iter().map(|at| u32::from(pixels[at + k])).sum();
                smaller.push(((sum + 2) / 4) as u8);
            }
        }
    }
    (wide, high, smaller)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;

    /// A look with a seam: faces below the equator lie elsewhere in the picture.
    fn with_seam(mesh: &SurfaceMesh) -> Look {
        let corners = mesh.faces().map(|face| {
            let points = mesh.corners(face);
            let shift = if points.iter().map(|p| p.z).sum::<f64>() < 0.0 { 5.0 } else { 0.0 };
            points.map(|p| CornerLook { colour: [10, 20, 30], place: Some([p.x as f32 + shift, p.y as f32]) })
        });
        Look { corners: corners.collect(), picture: None }
    }

    fn bare(points: impl Iterator<Item = DVec3>) -> Vec<SurfaceVertex> {
        points
            .map(|p| SurfaceVertex { position: p.as_vec3().to_array(), ..SurfaceVertex::default() })
            .collect()
    }

    #[test]
    fn a_seam_parts_vertices_and_nothing_else() {
        let mesh = icosphere(2);
        let look = with_seam(&mesh);
        let (vertices, indices) =
            dressed(Giver { mesh: &mesh, look: &look }, &bare(mesh.positions().iter().copied()));
        assert_eq!(indices.len(), 3 * mesh.face_count());
        let parted = vertices.len() - mesh.vertex_count();
        assert!(parted > 0 && parted < mesh.vertex_count() / 2, "{parted}");
        for (index, corner) in indices.iter().zip(look.corners.iter().flatten()) {
            let vertex = vertices[*index as usize];
            let [u, v] = corner.place.unwrap();
            assert_eq!((vertex.uv, vertex.tint), ([u, 1.0 - v], [10, 20, 30, 255]));
        }
    }

    #[test]
    fn the_triangles_of_a_map_take_the_look_where_they_lie() {
        let mesh = icosphere(1);
        let look = with_seam(&mesh);
        // Every face in four; one triangle lies in no face.
        let (mut places, mut triangles, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        for face in mesh.faces() {
            let [a, b, c] = mesh.corners(face);
            let first = places.len() as u32;
            places.extend([a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)]);
            for t in [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]] {
                triangles.push(t.map(|k| first + k));
                faces.push(face);
            }
        }
        triangles.push([0, 1, 2]);
        faces.push(FaceId::from(mesh.face_count()));
        let giver = Giver { mesh: &mesh, look: &look };
        let (vertices, indices) = carried(giver, &bare(places.iter().copied()), &places, &triangles, &faces);
        assert_eq!(indices.len(), 12 * mesh.face_count());
        for (index, (triangle, face)) in
            indices.iter().zip(triangles.iter().zip(&faces).flat_map(|(t, f)| t.map(|v| (v, *f))))
        {
            let p = places[triangle as usize];
            let shift = look.corners[face][0].place.unwrap()[0] - mesh.corners(face)[0].x as f32;
            let [u, v] = vertices[*index as usize].uv;
            assert!((u - p.x as f32 - shift).abs() < 1e-5 && (1.0 - v - p.y as f32).abs() < 1e-5);
        }
    }

    #[test]
    fn smaller_copies_keep_the_mean() {
        let pixels: Vec<u8> = (0..16_u8).flat_map(|k| [16 * k, 255 - 16 * k, 7, 255]).collect();
        let levels = levels(4, 4, pixels);
        assert_eq!(levels.iter().map(|(w, h, _)| (*w, *h)).collect::<Vec<_>>(), [(4, 4), (2, 2), (1, 1)]);
        assert_eq!(levels[2].2, [120, 135, 7, 255]);
        let sizes = super::levels(5, 1, vec![9; 20]);
        assert_eq!(sizes.last().map(|(w, h, pixels)| (*w, *h, pixels.clone())), Some((1, 1, vec![9; 4])));
    }
}
