//! The skin of the triangles of a GLB: the look of a mesh's file with its own pictures, byte for byte, or a checkerboard.

use crate::io::picture::media_type;
use crate::math::screen_light::light_of;
use crate::mesh::dressing::Dressed;
use crate::mesh::look::CornerLook;
use crate::surface_map::measures::transfer::CommonMesh;

/// The number of squares of the checkerboard along one unit of texture coordinates (the whole surface has area 1 there).
const SQUARES: f64 = 24.0;

/// A surface with what lies on it. A point of it is there once for each look that it has around it.
#[derive(Clone, Debug)]
pub struct Skin {
    /// The point of each vertex.
    points: Vec<u32>,
    /// The place of each vertex in the picture, from the left upper corner down.
    pub(super) uvs: Vec<[f32; 2]>,
    /// The light of each vertex; empty where all is white.
    pub(super) colours: Vec<[f32; 3]>,
    /// Its triangles by what lies on them.
    pub(super) parts: Vec<SkinPart>,
    /// The picture (PNG) for programs that do not read another one's format.
    pub(super) fallback: Vec<u8>,
}

/// Triangles with the same picture on them.
#[derive(Clone, Debug)]
pub(super) struct SkinPart {
    /// The file of the picture.
    pub(super) picture: Option<Vec<u8>>,
    /// Triples of vertices.
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Skin {
    /// A checkerboard over the texture coordinates of a map.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn checkerboard(common: &CommonMesh) -> Result<Self, png::EncodingError> {
        // Two squares of the board make one period of the texture.
        let uv = |uv: &glam::DVec2| (*uv * (0.5 * SQUARES)).to_array().map(|x| x as f32);
        let picture = checkerboard()?;
        Ok(Self {
            points: (0..common.uvs.len() as u32).collect(),
            uvs: common.uvs.iter().map(uv).collect(),
            colours: Vec::new(),
            parts: vec![SkinPart { picture: Some(picture.clone()), triangles: common.triangles.clone() }],
            fallback: picture,
        })
    }

    /// A look with its pictures; what lies on a picture that is not there has its colour alone.
    ///
    /// # Errors
    /// Where the picture for programs that do not read another one's format cannot be written.
    pub fn of_look(dressed: &Dressed, pictures: &[Vec<u8>]) -> Result<Self, png::EncodingError> {
        let looks = || dressed.vertices.iter().map(|vertex| vertex.look);
        let uv = |look: CornerLook| look.place.map_or([0.0; 2], |place| [place.at[0], 1.0 - place.at[1]]);
        let light = |look: CornerLook| look.colour.map(|byte| light_of(byte) as f32);
        let is_white = looks().all(|look| look.colour == CornerLook::WHITE.colour);
        let file = |number: &u8| pictures.get(usize::from(*number)).filter(|file| media_type(file).is_some());
        let part = |(picture, triangles): (&Option<u8>, &Vec<[u32; 3]>)| SkinPart {
            picture: picture.as_ref().and_then(file).cloned(),
            triangles: triangles.clone(),
        };
        Ok(Self {
            points: dressed.vertices.iter().map(|vertex| vertex.point).collect(),
            uvs: looks().map(uv).collect(),
            colours: if is_white { Vec::new() } else { looks().map(light).collect() },
            parts: dressed.triangles.iter().map(part).collect(),
            fallback: checkerboard()?,
        })
    }

    /// The values of points as values of vertices.
    pub(super) fn gathered<T: Copy>(&self, values: &[T]) -> Vec<T> {
        self.points.iter().map(|point| values[*point as usize]).collect()
    }
}

/// The picture of a checkerboard: two by two squares, each 64 pixels wide.
fn checkerboard() -> Result<Vec<u8>, png::EncodingError> {
    // The width and height in pixels.
    const SIZE: u32 = 128;
    let shade =
        |x: u32, y: u32| if (x < SIZE / 2) == (y < SIZE / 2) { [240, 240, 235] } else { [52, 98, 140] };
    let pixels: Vec<u8> = (0..SIZE * SIZE).flat_map(|k| shade(k % SIZE, k / SIZE)).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIZE, SIZE);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(bytes)
}
