//! One mesh's texture baked into a picture over the other mesh's own texture coordinates.
//!
//! Every texel of the picture whose middle lies in a face's triangle of the texture plane is a point of the surface; its image under the map
//! has texture coordinates on the giving mesh, and the colour there is interpolated between the four nearest pixels. No vertex is
//! in between, so that no seam of either mesh is smeared. Around the charts the colours are carried on by some texels, so
//! that interpolation at their borders finds no gap.

use super::mapped_files::MappedFiles;
use crate::export::vertex_image::Direction;
use crate::io::picture::Picture;
use crate::map_file::FileMesh;
use crate::math::barycentric::{interpolated, shares};
use crate::math::triangle::signed_double_area;
use crate::mesh::{FaceId, SurfacePoint};
use crate::monitor::{Cancelled, Monitor, Step};
use crate::surface_map::correspondence::PointLocator;
use glam::DVec2;
use typed_index_collections::TiVec;

/// Texture coordinates of the corners of each face of a mesh.
pub type FaceUvs = TiVec<FaceId, [DVec2; 3]>;

/// A texture, and where it and its copy lie on the meshes.
#[derive(Clone, Copy, Debug)]
pub struct GivenTexture<'a> {
    /// Texture coordinates of the source and of the target.
    pub uvs: [&'a FaceUvs; 2],
    /// The giving mesh's texture.
    pub picture: &'a Picture,
}

/// The options of baking a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BakeOptions {
    /// The direction: from which mesh to which.
    pub direction: Direction,
    /// Number of texels in a row and in a column.
    pub size: usize,
    /// Number of texels by which colours are carried on beyond the charts.
    pub border: usize,
}

/// Why a texture cannot be baked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BakeError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The texture coordinates are not those of the mesh's polygons.
    #[error("face {face} of the file has no texture coordinates for all of its corners")]
    Corners {
        /// The number of the polygon.
        face: usize,
    },
    /// Texture coordinates of the receiving mesh lie outside the picture.
    #[error(
        "face {face} has the texture coordinates {uv}: those of the mesh that receives a texture must be from 0 to 1"
    )]
    Outside {
        /// The number of the triangle.
        face: usize,
        /// The texture coordinates of a corner.
        uv: DVec2,
    },
    /// Charts overlap many times.
    #[error("the texture coordinates cover the picture {times:.1} times: charts must not overlap")]
    Overlap {
        /// The sum of the areas of all triangles in the texture plane.
        times: f64,
    },
}

/// The number of times that charts may cover the picture: mirrored halves share their charts in some models. Chosen by hand.
const MOST_COVERED: f64 = 4.0;

/// The distance by which texture coordinates may leave the picture, by rounding.
const ROUNDING: f64 = 1e-6;

/// The number of faces after which progress is reported.
const FACES_A_STEP: usize = 1 << 10;

/// Texture coordinates by face of a mesh from those of its file's polygons, corner by corner.
///
/// # Errors
/// [`BakeError::Corners`].
pub fn face_uvs(mesh: &FileMesh, corners: &[Vec<DVec2>]) -> Result<FaceUvs, BakeError> {
    let mut uvs = FaceUvs::with_capacity(mesh.mesh().face_count());
    for (number, polygon) in mesh.polygons().iter().enumerate() {
        let fault = BakeError::Corners { face: number };
        let given = corners.get(number).filter(|given| given.len() == polygon.len()).ok_or(fault.clone())?;
        for _ in 2..polygon.len() {
            let face = FaceId::from(uvs.len());
            let triangle = mesh.mesh().triangles().get(face).ok_or(fault.clone())?;
            let mut found = [DVec2::ZERO; 3];
            for (uv, v) in found.iter_mut().zip(triangle) {
                let v = mesh.vertex_number(*v);
                let corner = polygon.iter().position(|c| *c as usize == v).ok_or(fault.clone())?;
                *uv = given[corner];
            }
            uvs.push(found);
        }
    }
    Ok(uvs)
}

/// The picture over the receiving mesh's texture coordinates that shows the giving mesh's texture. Texels
/// that no chart reaches are transparent.
///
/// # Errors
/// [`BakeError`].
pub fn baked(
    mapped: MappedFiles<'_>,
    texture: GivenTexture<'_>,
    options: BakeOptions,
    monitor: &mut dyn Monitor,
) -> Result<Picture, BakeError> {
    let giver = options.direction.side();
    let receiver = giver.other();
    let [given, receiving] = [texture.uvs[giver], texture.uvs[receiver]];
    check_charts(receiving)?;
    let locator = PointLocator::new(mapped.meshes(), mapped.map);
    let mut texels: Vec<Option<[u8; 4]>> = vec![None; options.size * options.size];
    for (face, corners) in receiving.iter_enumerated() {
        if face.index() % FACES_A_STEP == 0 {
            let fraction = face.index() as f64 / receiving.len() as f64;
            monitor.step(Step { fraction, residual: None })?;
        }
        // Rows go down, v goes up.
        let corners = corners.map(|uv| DVec2::new(uv.x, 1.0 - uv.y) * options.size as f64);
        for_each_texel(corners, options.size, |texel, barycentric| {
            let colour = &mut texels[texel];
            if colour.is_none() {
                let point = SurfacePoint::clamped(face, barycentric);
                let image = locator.carried(receiver, point);
                let uv = interpolated(given[image.face], image.barycentric);
                *colour = Some(colour_at(texture.picture, uv));
            }
        });
    }
    (0..options.border).for_each(|_| carry_on(&mut texels, options.size));
    let pixels = texels.into_iter().map(Option::unwrap_or_default).collect();
    Ok(Picture { width: options.size, height: options.size, pixels })
}

/// Whether the charts lie in the picture and hardly overlap, so that they take no more time than the picture is large.
fn check_charts(uvs: &FaceUvs) -> Result<(), BakeError> {
    let mut times = 0.0;
    for (face, corners) in uvs.iter_enumerated() {
        let is_inside = |uv: &&DVec2| uv.min_element() >= -ROUNDING && uv.max_element() <= 1.0 + ROUNDING;
        if let Some(uv) = corners.iter().find(|uv| !is_inside(uv)) {
            return Err(BakeError::Outside { face: face.index(), uv: *uv });
        }
        times += 0.5 * signed_double_area(corners[0], corners[1], corners[2]).abs();
    }
    if times > MOST_COVERED { Err(BakeError::Overlap { times }) } else { Ok(()) }
}

/// The texels whose middles lie in a triangle, with their weights there.
fn for_each_texel(corners: [DVec2; 3], size: usize, mut visit: impl FnMut(usize, [f64; 3])) {
    let double_area = signed_double_area(corners[0], corners[1], corners[2]);
    if double_area == 0.0 {
        return;
    }
    let rows = corners.map(|p| p.y);
    let [top, bottom] =
        [rows.into_iter().fold(f64::MAX, f64::min), rows.into_iter().fold(f64::MIN, f64::max)];
    for row in texels_between(top, bottom, size) {
        // Where the row's middle line crosses the triangle.
        let y = row as f64 + 0.5;
        let (mut left, mut right) = (f64::MAX, f64::MIN);
        for k in 0..3 {
            let (p, q) = (corners[k], corners[(k + 1) % 3]);
            if p.y.min(q.y) <= y && y <= p.y.max(q.y) {
                let t = if p.y == q.y { 0.0 } else { (y - p.y) / (q.y - p.y) };
                let x = p.x + (q.x - p.x) * t;
                let ends = if p.y == q.y { [p.x, q.x] } else { [x, x] };
                left = ends.into_iter().fold(left, f64::min);
                right = ends.into_iter().fold(right, f64::max);
            }
        }
        for column in texels_between(left, right, size) {
            let middle = DVec2::new(column as f64 + 0.5, y);
            visit(row * size + column, shares(corners, middle).map(|share| share / double_area));
        }
    }
}

/// Numbers of the texels whose middles lie between two coordinates.
fn texels_between(from: f64, to: f64, size: usize) -> std::ops::Range<usize> {
    // A cast of a negative number gives 0.
    let first = (from - 0.5).ceil() as usize;
    let end = ((to - 0.5).floor() + 1.0) as usize;
    first.min(size)..end.min(size)
}

/// The colour of a picture at texture coordinates, interpolated between pixels; the picture repeats beyond its borders.
fn colour_at(picture: &Picture, uv: DVec2) -> [u8; 4] {
    let at = |x: f64, count: usize| {
        let x = (x - x.floor()) * count as f64 - 0.5;
        let low = x.floor();
        let wrapped = |k: f64| (k as i64).rem_euclid(count as i64) as usize;
        ([wrapped(low), wrapped(low + 1.0)], x - low)
    };
    let (columns, right) = at(uv.x, picture.width);
    let (rows, down) = at(1.0 - uv.y, picture.height);
    let pixel = |row: usize, column: usize| picture.pixels[rows[row] * picture.width + columns[column]];
    let [a, b, c, d] = [pixel(0, 0), pixel(0, 1), pixel(1, 0), pixel(1, 1)];
    [0, 1, 2, 3].map(|k| {
        let [a, b, c, d] = [a[k], b[k], c[k], d[k]].map(f64::from);
        let value = (a * (1.0 - right) + b * right) * (1.0 - down) + (c * (1.0 - right) + d * right) * down;
        value.round() as u8
    })
}

/// Gives texels without a colour the mean of their neighbours that have one.
fn carry_on(texels: &mut [Option<[u8; 4]>], size: usize) {
    let before = texels.to_vec();
    let around = |k: usize| k.saturating_sub(1)..=(k + 1).min(size - 1);
    for row in 0..size {
        for column in 0..size {
            if before[row * size + column].is_some() {
                continue;
            }
            let cells = around(row).flat_map(|r| around(column).map(move |c| r * size + c));
            let (mut sum, mut count) = ([0_u32; 4], 0);
            for colour in cells.filter_map(|cell| before[cell]) {
                (0..4).for_each(|k| sum[k] += u32::from(colour[k]));
                count += 1;
            }
            if count > 0 {
                texels[row * size + column] = Some(sum.map(|s| ((s + count / 2) / count) as u8));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::obj;
    use crate::export::vertex_image::Direction::{SourceToTarget, TargetToSource};
    use crate::mesh::SurfaceMesh;
    use crate::monitor::Silent;
    use crate::transfer::tests::ball_on_egg;

    /// Every face in a cell of a grid of its own.
    fn atlas(mesh: &SurfaceMesh) -> FaceUvs {
        let n = (mesh.face_count() as f64).sqrt().ceil();
        let cell = |f: FaceId| {
            let corner = DVec2::new((f.index() as f64) % n, (f.index() as f64 / n).floor());
            [[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]].map(|at| (corner + DVec2::from(at)) / n)
        };
        mesh.faces().map(cell).collect()
    }

    /// Red grows with x, green with y.
    fn shades(mesh: &SurfaceMesh) -> FaceUvs {
        let uv = |p: glam::DVec3| DVec2::new(0.5 + 0.3 * p.x, 0.5 + 0.3 * p.y);
        mesh.faces().map(|f| mesh.corners(f).map(uv)).collect()
    }

    fn gradient(size: usize) -> Picture {
        let level = |k: usize| ((k as f64 + 0.5) / size as f64 * 255.0).round() as u8;
        let pixel = |k: usize| [level(k % size), level(size - 1 - k / size), 0, 255];
        Picture { width: size, height: size, pixels: (0..size * size).map(pixel).collect() }
    }

    #[test]
    fn every_texel_has_the_colour_at_its_image() {
        let mapped = ball_on_egg();
        let files = mapped.meshes().map(|mesh| FileMesh::read(&obj::mesh(mesh)).unwrap());
        let files = MappedFiles { files: files.each_ref(), map: &mapped.map };
        let meshes = mapped.meshes();
        let locator = PointLocator::new(meshes, &mapped.map);
        for direction in [TargetToSource, SourceToTarget] {
            let (giver, receiver) = (direction.side(), direction.side().other());
            let (given, charts) = (shades(meshes[giver]), atlas(meshes[receiver]));
            let mut uvs = [&charts; 2];
            uvs[giver] = &given;
            let options = BakeOptions { direction, size: 512, border: 2 };
            let picture =
                baked(files, GivenTexture { uvs, picture: &gradient(256) }, options, &mut Silent).unwrap();
            for f in meshes[receiver].faces() {
                let middle = charts[f].iter().sum::<DVec2>() / 3.0;
                let [column, row] = [middle.x, 1.0 - middle.y].map(|x| (x * 512.0) as usize);
                // The texel's own middle, in the face.
                let texel = DVec2::new((column as f64 + 0.5) / 512.0, 1.0 - (row as f64 + 0.5) / 512.0);
                let weights = crate::math::barycentric::clamped_in(charts[f], texel);
                let point = SurfacePoint { face: f, barycentric: weights };
                let image = locator.carried(receiver, point);
                let p = image.position(meshes[giver]);
                let found = picture.pixels[row * 512 + column];
                for (level, x) in [(found[0], p.x), (found[1], p.y)] {
                    let wanted = 255.0 * (0.5 + 0.3 * x);
                    assert!((f64::from(level) - wanted).abs() < 1.1, "{direction:?} {f:?}: {level} {wanted}");
                }
                assert_eq!(found[3], 255);
            }
        }
    }

    #[test]
    fn charts_that_cannot_be_are_refused() {
        let mapped = ball_on_egg();
        let mut charts = atlas(&mapped.source);
        assert_eq!(check_charts(&charts), Ok(()));
        charts[FaceId(7)][1].x = 1.5;
        assert!(matches!(check_charts(&charts), Err(BakeError::Outside { face: 7, .. })));
        let whole: FaceUvs = mapped.source.faces().map(|_| [DVec2::ZERO, DVec2::X, DVec2::Y]).collect();
        assert_eq!(check_charts(&whole), Err(BakeError::Overlap { times: 1024.0 }));
    }

    #[test]
    fn triangles_that_share_a_side_cover_every_texel() {
        let mut count = vec![0; 64];
        for corners in [[[0.0, 0.0], [8.0, 0.0], [8.0, 8.0]], [[0.0, 0.0], [8.0, 8.0], [0.0, 8.0]]] {
            for_each_texel(corners.map(DVec2::from), 8, |texel, weights| {
                count[texel] += 1;
                assert!(
                    weights.iter().all(|w| *w >= -1e-12) && (weights.iter().sum::<f64>() - 1.0).abs() < 1e-12
                );
            });
        }
        assert!(count.iter().all(|n| *n == 1 || *n == 2));
        assert_eq!(count.iter().filter(|n| **n == 2).count(), 8, "the diagonal is on both");
    }

    #[test]
    fn colours_are_carried_on_by_the_border() {
        let mut texels = vec![None; 25];
        texels[12] = Some([200, 100, 0, 255]);
        carry_on(&mut texels, 5);
        assert_eq!(texels.iter().flatten().count(), 9);
        assert!(texels.iter().flatten().all(|colour| *colour == [200, 100, 0, 255]));
        carry_on(&mut texels, 5);
        assert_eq!(texels.iter().flatten().count(), 25);
    }

    #[test]
    fn corners_of_polygons_become_corners_of_faces() {
        // A pyramid whose square is cut into triangles.
        let text = "v 0 0 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv 0.5 0.5 1\nf 1 2 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n";
        let mesh = FileMesh::read(text.as_bytes()).unwrap();
        let mark = |polygon: usize, corner: usize| DVec2::new(polygon as f64, corner as f64);
        let corners: Vec<Vec<DVec2>> = mesh
            .polygons()
            .iter()
            .enumerate()
            .map(|(k, p)| (0..p.len()).map(|c| mark(k, c)).collect())
            .collect();
        let uvs = face_uvs(&mesh, &corners).unwrap();
        for (f, triangle) in mesh.mesh().triangles().iter_enumerated() {
            let polygon = f.index().saturating_sub(1);
            for (uv, v) in uvs[f].iter().zip(triangle) {
                assert_eq!(uv.x, polygon as f64);
                assert_eq!(mesh.polygons()[polygon][uv.y as usize] as usize, mesh.vertex_number(*v));
            }
        }
        assert_eq!(face_uvs(&mesh, &corners[..4]), Err(BakeError::Corners { face: 4 }));
    }
}
