//! Surfaces in the look of a mesh's file as they are drawn, and pictures in all sizes.

use super::SurfaceVertex;
use crate::mesh::dressing::{Dressed, DressedPoint};
use std::ops::Range;

/// A surface in a look as it is drawn.
#[derive(Clone, Debug, Default)]
pub struct DressedSurface {
    /// The vertices of the surface.
    pub vertices: Vec<SurfaceVertex>,
    /// Triples of vertices, picture after picture.
    pub indices: Vec<u32>,
    /// The indices on which each picture lies; `None` for no picture.
    pub runs: Vec<(Option<u8>, Range<u32>)>,
}

/// A surface in a look; `bare` are its points as they are drawn without it.
pub fn drawn(dressed: &Dressed, bare: &[SurfaceVertex]) -> DressedSurface {
    let vertex = |at: &DressedPoint| {
        let bare = bare.get(at.point as usize).copied().unwrap_or_default();
        let [r, g, b] = at.look.colour;
        let tint = [r, g, b, if at.look.place.is_some() { u8::MAX } else { 0 }];
        let uv = at.look.place.map_or([0.0; 2], |place| [place.at[0], 1.0 - place.at[1]]);
        SurfaceVertex { uv, tint, ..bare }
    };
    let mut surface = DressedSurface {
        vertices: dressed.vertices.iter().map(vertex).collect(),
        ..DressedSurface::default()
    };
    for (picture, triangles) in &dressed.triangles {
        let begin = surface.indices.len() as u32;
        surface.indices.extend_from_slice(triangles.as_flattened());
        surface.runs.push((*picture, begin..surface.indices.len() as u32));
    }
    surface
}

/// A picture of 8-bit colours with opacity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pixels {
    /// Pixels in a row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Red, green, blue and opacity, row after row.
    pub bytes: Vec<u8>,
}

/// A picture and its smaller copies, each half as wide and high, down to one pixel.
pub fn levels(picture: Pixels) -> Vec<Pixels> {
    let mut levels = vec![picture];
    while let Some(last) = levels.last().filter(|level| level.width > 1 || level.height > 1) {
        let next = halved(last);
        levels.push(next);
    }
    levels
}

fn halved(&Pixels { width, height, ref bytes }: &Pixels) -> Pixels {
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
                let sum: u32 = four.iter().map(|at| u32::from(bytes[at + k])).sum();
                smaller.push(((sum + 2) / 4) as u8);
            }
        }
    }
    Pixels { width: wide, height: high, bytes: smaller }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::look::{CornerLook, PicturePlace};

    #[test]
    fn each_picture_has_a_run_of_its_own() {
        let place = |picture, at| Some(PicturePlace { picture, at });
        let point = |point, place| DressedPoint { point, look: CornerLook { colour: [1, 2, 3], place } };
        let vertices = vec![point(1, place(0, [0.25, 0.0])), point(0, place(2, [0.0, 1.0])), point(1, None)];
        let triangles = [(None, vec![[2; 3]]), (Some(0), vec![[0; 3], [0; 3]]), (Some(2), vec![[1; 3]])];
        let bare = [0.5, 1.5].map(|x| SurfaceVertex { position: [x; 3], ..SurfaceVertex::default() });
        let surface = drawn(&Dressed { vertices, triangles: triangles.into() }, &bare);
        assert_eq!(surface.runs, [(None, 0..3), (Some(0), 3..9), (Some(2), 9..12)]);
        assert_eq!(surface.indices, [2, 2, 2, 0, 0, 0, 0, 0, 0, 1, 1, 1]);
        let told: Vec<_> = surface.vertices.iter().map(|v| (v.position[0], v.uv, v.tint)).collect();
        let expected = [
            (1.5, [0.25, 1.0], [1, 2, 3, 255]),
            (0.5, [0.0, 0.0], [1, 2, 3, 255]),
            (1.5, [0.0, 0.0], [1, 2, 3, 0]),
        ];
        assert_eq!(told, expected);
    }

    #[test]
    fn smaller_copies_keep_the_mean() {
        let bytes: Vec<u8> = (0..16_u8).flat_map(|k| [16 * k, 255 - 16 * k, 7, 255]).collect();
        let levels = levels(Pixels { width: 4, height: 4, bytes });
        assert_eq!(levels.iter().map(|l| (l.width, l.height)).collect::<Vec<_>>(), [(4, 4), (2, 2), (1, 1)]);
        assert_eq!(levels[2].bytes, [120, 135, 7, 255]);
        let row = super::levels(Pixels { width: 5, height: 1, bytes: vec![9; 20] });
        assert_eq!(row.last(), Some(&Pixels { width: 1, height: 1, bytes: vec![9; 4] }));
    }
}
