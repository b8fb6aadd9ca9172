//! How the corners of a mesh's faces look: colours, and places in a picture that is laid over the mesh.

use super::check::CheckedMesh;
use super::packing::{PackedError, Packer, Unpacker};
use super::soup::PolygonSoup;
use super::{FaceId, VertexId};
use typed_index_collections::TiVec;

/// How one corner of a face looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CornerLook {
    /// Red, green and blue as a screen shows them (sRGB); the picture's colours are multiplied by them.
    pub colour: [u8; 3],
    /// Where it lies in the picture, whose left lower corner is (0, 0) and whose right upper one is (1, 1); beyond, the picture repeats.
    /// `None` where no picture is laid on the face.
    pub place: Option<[f32; 2]>,
}

impl CornerLook {
    /// White, without a picture.
    pub const WHITE: Self = Self { colour: [u8::MAX; 3], place: None };
    /// Of faces that no file has, as those of caps.
    pub const MADE_UP: Self = Self { colour: [0x8a, 0x8a, 0x8a], place: None };
}

/// The look of a mesh as its file gives it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonLook {
    /// By polygon of the file and its corners.
    pub corners: Vec<Vec<CornerLook>>,
    /// The picture's file (PNG or JPEG), where the mesh file holds it.
    pub picture: Option<Vec<u8>>,
}

/// The look of a checked mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    /// By face, corner by corner.
    pub corners: TiVec<FaceId, [CornerLook; 3]>,
    /// The picture's file (PNG or JPEG), where the mesh file holds it.
    pub picture: Option<Vec<u8>>,
}

impl PolygonLook {
    /// The look of a mesh that was made of the file's polygons. Faces that a repair made are grey. `None` where the numbers of
    /// polygons or corners do not fit.
    pub fn by_face(self, soup: &PolygonSoup, mesh: &CheckedMesh) -> Option<Look> {
        let fits = |(polygon, corners): (&Vec<u32>, &Vec<CornerLook>)| polygon.len() == corners.len();
        if self.corners.len() != soup.polygons.len() || !soup.polygons.iter().zip(&self.corners).all(fits) {
            return None;
        }
        // The polygon of each face of the triangulated file: one of n corners has n - 2.
        let faces = soup
            .polygons
            .iter()
            .zip(0_u32..)
            .flat_map(|(polygon, number)| std::iter::repeat_n(number, polygon.len().saturating_sub(2)));
        let polygon_of_face: Vec<u32> = faces.collect();
        let place = |v: VertexId| mesh.frame.in_file(mesh.mesh.positions()[v]);
        let corners = mesh.mesh.faces().map(|face| {
            let number = polygon_of_face.get(mesh.file_from_face(face).index());
            let Some(number) = number.map(|number| *number as usize) else { return [CornerLook::MADE_UP; 3] };
            // Vertices may have been joined and split since: corners are known by where they are.
            mesh.mesh.triangles()[face].map(|v| {
                let distance = |corner: &u32| soup.positions[*corner as usize].distance_squared(place(v));
                let nearest = soup.polygons[number]
                    .iter()
                    .zip(&self.corners[number])
                    .min_by(|(a, _), (b, _)| distance(a).total_cmp(&distance(b)));
                nearest.map_or(CornerLook::MADE_UP, |(_, look)| *look)
            })
        });
        Some(Look { corners: corners.collect(), picture: self.picture })
    }
}

impl Look {
    /// Whether there is anything to see without another picture: the file's own, or a colour that is not white.
    pub fn is_coloured(&self) -> bool {
        let is_white = |corner: &CornerLook| corner.colour == CornerLook::WHITE.colour;
        // What a repair made up has no colour of the file.
        let says_nothing = |corner: &CornerLook| is_white(corner) || *corner == CornerLook::MADE_UP;
        self.picture.is_some() || !self.corners.iter().flatten().all(says_nothing)
    }

    /// The look at a point of a face, given by barycentric coordinates: its colour, and its place in the picture. The look of a face
    /// is blended between its corners.
    pub fn at(&self, face: FaceId, weights: [f64; 3]) -> CornerLook {
        let Some(corners) = self.corners.get(face) else { return CornerLook::MADE_UP };
        let blend = |value: &dyn Fn(&CornerLook) -> f64| {
            corners.iter().zip(weights).map(|(corner, weight)| weight * value(corner)).sum::<f64>()
        };
        let channel = |k: usize| blend(&|corner| f64::from(corner.colour[k])).round().clamp(0.0, 255.0) as u8;
        let along = |k: usize| blend(&|corner| f64::from(corner.place.unwrap_or_default()[k])) as f32;
        let has_place = corners.iter().all(|corner| corner.place.is_some());
        CornerLook { colour: [0, 1, 2].map(channel), place: has_place.then(|| [0, 1].map(along)) }
    }

    /// All of it.
    pub fn pack(&self, packer: &mut Packer) {
        let corners = || self.corners.iter().flatten();
        let colours: Vec<u32> = corners()
            .map(|corner| {
                let [r, g, b] = corner.colour;
                u32::from_le_bytes([r, g, b, u8::from(corner.place.is_some())])
            })
            .collect();
        packer.wholes(colours.into_iter());
        let places: Vec<f32> = corners().flat_map(|corner| corner.place.unwrap_or_default()).collect();
        packer.singles(places.into_iter());
        packer.bytes(self.picture.as_deref().unwrap_or_default());
    }

    /// The look of so many faces that [`Self::pack`] took.
    ///
    /// # Errors
    /// [`PackedError`] where it is of another number of faces.
    pub fn unpack(unpacker: &mut Unpacker<'_>, faces: usize) -> Result<Self, PackedError> {
        let (colours, places) = (unpacker.wholes()?, unpacker.singles()?);
        let picture = unpacker.bytes()?;
        if colours.len() != 3 * faces || places.len() != 6 * faces {
            return Err(PackedError::new("the look is that of another mesh"));
        }
        let corner = |k: usize| {
            let [r, g, b, has_place] = colours[k].to_le_bytes();
            CornerLook {
                colour: [r, g, b],
                place: (has_place != 0).then(|| [places[2 * k], places[2 * k + 1]]),
            }
        };
        let corners = (0..faces).map(|face| [0, 1, 2].map(|k| corner(3 * face + k))).collect();
        Ok(Self { corners, picture: (!picture.is_empty()).then(|| picture.to_vec()) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::check::closed_genus_zero;
    use crate::mesh::generators::icosphere;
    use crate::mesh::repair::{RepairOptions, repaired};
    use crate::monitor::Silent;
    use glam::DVec3;

    /// A look by place: the colour and the place in the picture tell where a corner is.
    fn of_place(p: DVec3) -> CornerLook {
        let byte = |x: f64| (127.0 + 100.0 * x).round() as u8;
        CornerLook { colour: [byte(p.x), byte(p.y), byte(p.z)], place: Some([p.x as f32, p.y as f32]) }
    }

    fn look_of(soup: &PolygonSoup) -> PolygonLook {
        let corner = |v: &u32| of_place(soup.positions[*v as usize]);
        PolygonLook {
            corners: soup.polygons.iter().map(|polygon| polygon.iter().map(corner).collect()).collect(),
            picture: Some(vec![1, 2, 3]),
        }
    }

    /// A cube of quads.
    fn cube() -> PolygonSoup {
        let positions = (0..8).map(|k| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64));
        let polygons = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        PolygonSoup {
            positions: positions.collect(),
            polygons: polygons.iter().map(|polygon| polygon.to_vec()).collect(),
            joined_with: Vec::new(),
        }
    }

    #[test]
    fn corners_keep_their_looks_through_triangles_and_turns() {
        let mut soup = cube();
        // One face looks inwards.
        soup.polygons[3].reverse();
        let checked = closed_genus_zero(&soup).unwrap();
        let look = look_of(&soup).by_face(&soup, &checked).unwrap();
        for (face, corners) in checked.mesh.triangles().iter_enumerated() {
            for (v, corner) in corners.iter().zip(look.corners[face]) {
                assert_eq!(corner, of_place(checked.frame.in_file(checked.mesh.positions()[*v])));
            }
        }
        let mut short = look_of(&soup);
        short.corners[2].pop();
        assert_eq!(short.by_face(&soup, &checked), None);
    }

    #[test]
    fn what_a_repair_made_is_grey_and_the_rest_stays() {
        let ball = icosphere(2);
        let mut polygons: Vec<Vec<u32>> =
            ball.triangles().iter().map(|t| t.iter().map(|v| v.0).collect()).collect();
        polygons.drain(5..7);
        let soup = PolygonSoup {
            positions: ball.positions().iter().copied().collect(),
            polygons,
            ..PolygonSoup::default()
        };
        let checked = repaired(&soup, &RepairOptions::default(), &mut Silent).unwrap().checked;
        let look = look_of(&soup).by_face(&soup, &checked).unwrap();
        let made =
            look.corners.iter_enumerated().filter(|(_, corners)| **corners == [CornerLook::MADE_UP; 3]);
        assert!(made.clone().count() > 0 && made.clone().all(|(face, _)| checked.is_cap(face)));
        for (face, corners) in checked.mesh.triangles().iter_enumerated().filter(|(f, _)| !checked.is_cap(*f))
        {
            for (v, corner) in corners.iter().zip(look.corners[face]) {
                assert_eq!(corner, of_place(checked.frame.in_file(checked.mesh.positions()[*v])));
            }
        }
    }

    #[test]
    fn looks_are_blended_and_come_back_from_their_bytes() {
        let soup = cube();
        let checked = closed_genus_zero(&soup).unwrap();
        let look = look_of(&soup).by_face(&soup, &checked).unwrap();
        let face = FaceId(4);
        assert_eq!(look.at(face, [0.0, 1.0, 0.0]), look.corners[face][1]);
        let [p, q, r] = checked.mesh.corners(face);
        let middle = look.at(face, [0.25, 0.25, 0.5]);
        assert_eq!(middle.place, of_place(0.25 * (p + q) + 0.5 * r).place);
        let mut packer = Packer::default();
        look.pack(&mut packer);
        let bytes = packer.into_bytes();
        let unpack = |faces| Look::unpack(&mut Unpacker::new(&bytes), faces);
        assert_eq!(unpack(12), Ok(look));
        assert!(unpack(11).is_err());
    }
}
