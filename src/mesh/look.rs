//! The look of the corners of a mesh's faces: colours, and places in the pictures that are laid over the mesh.

use super::check::CheckedMesh;
use super::packing::{PackedError, Packer, Unpacker};
use super::soup::PolygonSoup;
use super::{FaceId, VertexId};
use glam::DVec3;
use typed_index_collections::TiVec;

/// The look of one corner of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CornerLook {
    /// Red, green and blue as a screen shows them (sRGB); the picture's colours are multiplied by them.
    pub colour: [u8; 3],
    /// The place of the corner in a picture; `None` where no picture is laid on the face.
    pub place: Option<PicturePlace>,
}

/// A place in one of a look's pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PicturePlace {
    /// The number of the picture.
    pub picture: u8,
    /// The place: the picture's left lower corner is (0, 0) and its right upper one (1, 1); beyond these the picture repeats.
    pub at: [f32; 2],
}

/// The largest number of pictures that are told apart.
pub const MOST_PICTURES: usize = u8::MAX as usize;

impl CornerLook {
    /// The look of a white corner without a picture.
    pub const WHITE: Self = Self { colour: [u8::MAX; 3], place: None };
    /// The look of corners of faces that no file has, as those of caps.
    pub const MADE_UP: Self = Self { colour: [0x8a, 0x8a, 0x8a], place: None };
}

/// The look of a mesh as its file gives it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonLook {
    /// The look of each polygon of the file at its corners.
    pub corners: Vec<Vec<CornerLook>>,
    /// The files of the pictures (PNG, JPEG or WebP), at most [`MOST_PICTURES`]; none where they are not there.
    pub pictures: Vec<Vec<u8>>,
}

/// The look of a checked mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Look {
    /// The look of each face at its corners.
    pub corners: TiVec<FaceId, [CornerLook; 3]>,
    /// The files of the pictures (PNG, JPEG or WebP), at most [`MOST_PICTURES`]; none where they are not there.
    pub pictures: Vec<Vec<u8>>,
}

/// The number that stands for no picture in packed looks.
const NO_PICTURE: u8 = u8::MAX;

impl PolygonLook {
    /// The look of a mesh that was made of the file's polygons; `place` tells where its vertices are in the file. Faces that a repair made
    /// are grey. `None` where the numbers of polygons or corners do not fit.
    pub fn by_face(
        self,
        soup: &PolygonSoup,
        mesh: &CheckedMesh,
        place: impl Fn(VertexId) -> DVec3,
    ) -> Option<Look> {
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
        Some(Look { corners: corners.collect(), pictures: self.pictures })
    }
}

impl Look {
    /// Whether there is anything to see without another picture: the file's own, or a colour that is not white.
    pub fn is_coloured(&self) -> bool {
        let is_white = |corner: &CornerLook| corner.colour == CornerLook::WHITE.colour;
        // What a repair made up has no colour of the file.
        let says_nothing = |corner: &CornerLook| is_white(corner) || *corner == CornerLook::MADE_UP;
        !self.pictures.is_empty() || !self.corners.iter().flatten().all(says_nothing)
    }

    /// The look at a point of a face, given by barycentric coordinates: its colour, and its place in a picture. The look of a face
    /// is blended between its corners.
    pub fn at(&self, face: FaceId, weights: [f64; 3]) -> CornerLook {
        let Some(corners) = self.corners.get(face) else { return CornerLook::MADE_UP };
        let blend = |value: &dyn Fn(&CornerLook) -> f64| {
            corners.iter().zip(weights).map(|(corner, weight)| weight * value(corner)).sum::<f64>()
        };
        let channel = |k: usize| blend(&|corner| f64::from(corner.colour[k])).round().clamp(0.0, 255.0) as u8;
        let along = |k: usize| blend(&|corner| f64::from(corner.place.unwrap_or_default().at[k])) as f32;
        let [first, rest @ ..] = corners.map(|corner| corner.place.map(|place| place.picture));
        let picture = first.filter(|_| rest.iter().all(|other| *other == first));
        let place = picture.map(|picture| PicturePlace { picture, at: [0, 1].map(along) });
        CornerLook { colour: [0, 1, 2].map(channel), place }
    }

    /// Adds the whole look to a packer.
    pub fn pack(&self, packer: &mut Packer) {
        let corners = || self.corners.iter().flatten();
        let colours: Vec<u32> = corners()
            .map(|corner| {
                let [r, g, b] = corner.colour;
                u32::from_le_bytes([r, g, b, corner.place.map_or(NO_PICTURE, |place| place.picture)])
            })
            .collect();
        packer.wholes(colours.into_iter());
        let places: Vec<f32> = corners().flat_map(|corner| corner.place.unwrap_or_default().at).collect();
        packer.singles(places.into_iter());
        packer.count(self.pictures.len());
        self.pictures.iter().for_each(|picture| packer.bytes(picture));
    }

    /// Takes back from an unpacker the look of a mesh with this number of faces, as [`Self::pack`] has added it.
    ///
    /// # Errors
    /// [`PackedError`] where it is the look of a mesh with another number of faces.
    pub fn unpack(unpacker: &mut Unpacker<'_>, faces: usize) -> Result<Self, PackedError> {
        let (colours, places) = (unpacker.wholes()?, unpacker.singles()?);
        let count = unpacker.count()?;
        if colours.len() != 3 * faces || places.len() != 6 * faces || count > MOST_PICTURES {
            return Err(PackedError::new("the look is that of another mesh"));
        }
        let corner = |k: usize| {
            let [r, g, b, picture] = colours[k].to_le_bytes();
            let place = PicturePlace { picture, at: [places[2 * k], places[2 * k + 1]] };
            CornerLook { colour: [r, g, b], place: (picture != NO_PICTURE).then_some(place) }
        };
        let corners = (0..faces).map(|face| [0, 1, 2].map(|k| corner(3 * face + k))).collect();
        let pictures =
            (0..count).map(|_| Ok(unpacker.bytes()?.to_vec())).collect::<Result<_, PackedError>>()?;
        Ok(Self { corners, pictures })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::check::closed_genus_zero;
    use crate::mesh::generators::icosphere;
    use crate::mesh::repair::{RepairOptions, repaired};
    use crate::monitor::Silent;

    /// A look by place: the colour and the place in the picture tell where a corner is.
    fn of_place(p: DVec3) -> CornerLook {
        let byte = |x: f64| (127.0 + 100.0 * x).round() as u8;
        let place = PicturePlace { picture: 1, at: [p.x as f32, p.y as f32] };
        CornerLook { colour: [byte(p.x), byte(p.y), byte(p.z)], place: Some(place) }
    }

    fn look_of(soup: &PolygonSoup) -> PolygonLook {
        let corner = |v: &u32| of_place(soup.positions[*v as usize]);
        PolygonLook {
            corners: soup.polygons.iter().map(|polygon| polygon.iter().map(corner).collect()).collect(),
            pictures: vec![vec![1, 2, 3], Vec::new()],
        }
    }

    fn in_file(checked: &CheckedMesh) -> impl Fn(VertexId) -> DVec3 {
        |v| checked.frame.in_file(checked.mesh.positions()[v])
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
        let look = look_of(&soup).by_face(&soup, &checked, in_file(&checked)).unwrap();
        for (face, corners) in checked.mesh.triangles().iter_enumerated() {
            for (v, corner) in corners.iter().zip(look.corners[face]) {
                assert_eq!(corner, of_place(checked.frame.in_file(checked.mesh.positions()[*v])));
            }
        }
        let mut short = look_of(&soup);
        short.corners[2].pop();
        assert_eq!(short.by_face(&soup, &checked, in_file(&checked)), None);
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
        let look = look_of(&soup).by_face(&soup, &checked, in_file(&checked)).unwrap();
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
        let look = look_of(&soup).by_face(&soup, &checked, in_file(&checked)).unwrap();
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
