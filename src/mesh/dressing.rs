//! Surfaces in the look of a mesh's file, for whoever draws or writes them: their points with the colours and places that they have there,
//! and their triangles by the picture that lies on them.

use super::closest_point::closest_in_triangle;
use super::look::{CornerLook, Look};
use super::{FaceId, SurfaceMesh};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// A mesh and its look, which is given to what is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Giver<'a> {
    /// The mesh.
    pub mesh: &'a SurfaceMesh,
    /// Its look.
    pub look: &'a Look,
}

/// A point of a surface, and how it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DressedPoint {
    /// The number of the point.
    pub point: u32,
    /// Its look in the triangles around it, or in some of them.
    pub look: CornerLook,
}

/// A surface in a look.
#[derive(Clone, Debug, Default)]
pub struct Dressed {
    /// The points with their looks: a point is there once for each look that it has in the triangles around it, as on both sides of
    /// a seam.
    pub vertices: Vec<DressedPoint>,
    /// Triples of vertices by the number of the picture on them; those without a picture come first.
    pub triangles: BTreeMap<Option<u8>, Vec<[u32; 3]>>,
}

/// A key that is equal for vertices that can be joined: point, colour, picture, and the bits of the place in the picture.
type LookKey = (u32, [u8; 3], Option<u8>, [u32; 2]);

/// A surface that is being dressed.
#[derive(Default)]
struct Wardrobe {
    dressed: Dressed,
    known: FxHashMap<LookKey, u32>,
}

impl Wardrobe {
    fn vertex(&mut self, point: u32, look: CornerLook) -> u32 {
        let place = look.place.unwrap_or_default();
        let key = (point, look.colour, look.place.map(|place| place.picture), place.at.map(f32::to_bits));
        let next = self.dressed.vertices.len() as u32;
        let index = *self.known.entry(key).or_insert(next);
        if index == next {
            self.dressed.vertices.push(DressedPoint { point, look });
        }
        index
    }

    fn push(&mut self, points: [u32; 3], looks: [CornerLook; 3]) {
        let corners = [0, 1, 2].map(|k| self.vertex(points[k], looks[k]));
        let [first, rest @ ..] = looks.map(|look| look.place.map(|place| place.picture));
        let picture = first.filter(|_| rest.iter().all(|other| *other == first));
        self.dressed.triangles.entry(picture).or_default().push(corners);
    }
}

/// The mesh itself in its look; its vertices are the points.
pub fn dressed(giver: Giver<'_>) -> Dressed {
    let mut wardrobe = Wardrobe::default();
    for (corners, looks) in giver.mesh.triangles().iter().zip(&giver.look.corners) {
        wardrobe.push(corners.map(|v| v.0), *looks);
    }
    wardrobe.dressed
}

/// The triangles of a map in the look of the mesh in whose faces they lie: `places` tells where their points are on the giver, and `faces`
/// the giver's face of each triangle. Triangles of points or faces that are not there are left out.
pub fn carried(giver: Giver<'_>, places: &[DVec3], triangles: &[[u32; 3]], faces: &[FaceId]) -> Dressed {
    let mut wardrobe = Wardrobe::default();
    for (triangle, &face) in triangles.iter().zip(faces) {
        let is_there = triangle.iter().all(|v| (*v as usize) < places.len());
        if face.index() >= giver.mesh.face_count() || !is_there {
            continue;
        }
        let corners = giver.mesh.corners(face);
        let look = |v: u32| giver.look.at(face, closest_in_triangle(places[v as usize], corners));
        wardrobe.push(*triangle, triangle.map(look));
    }
    wardrobe.dressed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::mesh::look::PicturePlace;

    /// A look with a seam: faces below the equator lie elsewhere in the picture, and those with the greatest x in another one.
    fn with_seam(mesh: &SurfaceMesh) -> Look {
        let corners = mesh.faces().map(|face| {
            let points = mesh.corners(face);
            let shift = if points.iter().map(|p| p.z).sum::<f64>() < 0.0 { 5.0 } else { 0.0 };
            let picture = u8::from(points.iter().map(|p| p.x).sum::<f64>() > 1.5);
            points.map(|p| CornerLook {
                colour: [10, 20, 30],
                place: Some(PicturePlace { picture, at: [p.x as f32 + shift, p.y as f32] }),
            })
        });
        Look { corners: corners.collect(), pictures: Vec::new() }
    }

    #[test]
    fn a_seam_parts_vertices_and_nothing_else() {
        let mesh = icosphere(2);
        let look = with_seam(&mesh);
        let dressed = dressed(Giver { mesh: &mesh, look: &look });
        let parted = dressed.vertices.len() - mesh.vertex_count();
        assert!(parted > 0 && parted < mesh.vertex_count() / 2, "{parted}");
        assert_eq!(dressed.triangles.keys().collect::<Vec<_>>(), [&Some(0), &Some(1)]);
        for picture in 0..2 {
            let of_picture =
                look.corners.iter_enumerated().filter(|(_, l)| l[0].place.unwrap().picture == picture);
            let found = &dressed.triangles[&Some(picture)];
            assert_eq!(found.len(), of_picture.clone().count());
            for (corners, (face, looks)) in found.iter().zip(of_picture) {
                for ((vertex, v), look) in corners.iter().zip(mesh.triangles()[face]).zip(looks) {
                    let expected = DressedPoint { point: v.0, look: *look };
                    assert_eq!(dressed.vertices[*vertex as usize], expected);
                }
            }
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
        triangles.extend([[0, 1, 2], [0, 1, places.len() as u32]]);
        faces.extend([FaceId::from(mesh.face_count()), FaceId(0)]);
        let dressed = carried(Giver { mesh: &mesh, look: &look }, &places, &triangles, &faces);
        let shown: Vec<[u32; 3]> = dressed.triangles.values().flatten().copied().collect();
        assert_eq!(shown.len(), 4 * mesh.face_count());
        for vertex in shown.into_iter().flatten().map(|v| dressed.vertices[v as usize]) {
            let face = FaceId(vertex.point / 6);
            let [x, y] = vertex.look.place.unwrap().at;
            let p = places[vertex.point as usize];
            let shift = look.corners[face][0].place.unwrap().at[0] - mesh.corners(face)[0].x as f32;
            assert!((x - p.x as f32 - shift).abs() < 1e-5 && (y - p.y as f32).abs() < 1e-5);
        }
    }
}
