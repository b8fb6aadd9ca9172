//! One mesh's triangles in the shape of the other, and how near they come to it.

use super::cells::Cells;
use crate::export::vertex_image::Direction;
use crate::math::scalar::ln;
use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Step};
use crate::surface_map::correspondence::Correspondence;
use glam::DVec3;
use serde::Serialize;
use typed_index_collections::TiVec;

/// Measures of how near a mesh in the shape of another one comes to it. Lengths are in the units of the files.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShapeReport {
    /// Number of triangles of the mesh in the other's shape.
    pub faces: usize,
    /// Number of triangles of the other one.
    pub shape_faces: usize,
    /// The root of the other one's area, by which the distances are judged.
    pub size: f64,
    /// The distances from the mesh in the other's shape to the other.
    pub to_shape: Distances,
    /// The distances from the other to the mesh in its shape.
    pub from_shape: Distances,
    /// The larger of both largest distances: the Hausdorff distance, as far as samples tell.
    pub hausdorff: f64,
    /// The agreement of the normals.
    pub normals: NormalReport,
}

/// Distances from samples of one surface to another surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Distances {
    /// The largest distance, over all samples and vertices.
    pub largest: f64,
    /// The mean distance over the area.
    pub mean: f64,
    /// Number of samples on faces.
    pub samples: usize,
}

/// Differences of unit normals of faces that belong together by the map, over the area of the shape.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct NormalReport {
    /// The mean square length of the difference: 0 where all agree, 4 where all are opposite.
    pub mean_square: f64,
    /// 10 log10(4 / mean square), in decibels; `None` where all agree. 2 is the largest difference there may be.
    pub psnr: Option<f64>,
}

impl ShapeReport {
    /// The figures in a sentence.
    pub fn sentence(&self) -> String {
        let share = |distance: f64| 100.0 * distance / self.size;
        let normals = self.normals.psnr.map_or_else(|| "equal".to_owned(), |psnr| format!("{psnr:.1} dB"));
        format!(
            "Hausdorff distance {:.3e} ({:.3} % of the root of the area), mean distance {:.3e} there and {:.3e} back, PSNR of the \
             normals {normals}",
            self.hausdorff,
            share(self.hausdorff),
            self.to_shape.mean,
            self.from_shape.mean
        )
    }
}

/// The number of samples on the faces of a surface, about.
const SAMPLES: usize = 100_000;

/// The number of faces after which progress is reported.
const FACES_A_STEP: usize = 1 << 10;

/// The giving mesh (source of a direction) with its vertices at their images on the other one.
pub fn reshaped(meshes: [&SurfaceMesh; 2], map: &Correspondence, direction: Direction) -> SurfaceMesh {
    let from = direction.side();
    let images = map.vertex_images(meshes, from);
    let place = |(v, image): (VertexId, &Option<SurfacePoint>)| {
        // Every vertex has an image, as the check of a map makes sure.
        image.map_or(meshes[from].positions()[v], |point| point.position(meshes[from.other()]))
    };
    meshes[from].with_positions(images.iter_enumerated().map(place).collect())
}

/// Measures how near [`reshaped`] comes to the shape.
///
/// # Errors
/// [`Cancelled`].
pub fn shape_report(
    meshes: [&SurfaceMesh; 2],
    map: &Correspondence,
    direction: Direction,
    monitor: &mut dyn Monitor,
) -> Result<ShapeReport, Cancelled> {
    let shape = meshes[direction.side().other()];
    let mesh = reshaped(meshes, map, direction);
    let indices = [SurfaceIndex::new(&mesh), SurfaceIndex::new(shape)];
    let to_shape = distances(&mesh, &indices[1], &mut Portion::new(monitor, 0.0, 0.5))?;
    let from_shape = distances(shape, &indices[0], &mut Portion::new(monitor, 0.5, 1.0))?;
    Ok(ShapeReport {
        faces: mesh.face_count(),
        shape_faces: shape.face_count(),
        size: shape.area().sqrt(),
        to_shape,
        from_shape,
        hausdorff: to_shape.largest.max(from_shape.largest),
        normals: normals(meshes, map, direction, &mesh),
    })
}

/// Every face is cut into as many equal triangles, whose middles are the samples.
fn distances(
    from: &SurfaceMesh,
    onto: &SurfaceIndex<'_>,
    monitor: &mut dyn Monitor,
) -> Result<Distances, Cancelled> {
    let cuts = (1..=16).find(|n| n * n * from.face_count() >= SAMPLES).unwrap_or(16);
    let middles = middles(cuts);
    let (mut largest, mut sum, mut area) = (0.0_f64, 0.0, 0.0);
    for p in from.positions() {
        largest = largest.max(onto.nearest(*p).distance);
    }
    for f in from.faces() {
        if f.index() % FACES_A_STEP == 0 {
            monitor.step(Step { fraction: f.index() as f64 / from.face_count() as f64, residual: None })?;
        }
        let [p, q, r] = from.corners(f);
        let weight = from.face_area(f) / middles.len() as f64;
        for [u, v, w] in &middles {
            let distance = onto.nearest(p * *u + q * *v + r * *w).distance;
            largest = largest.max(distance);
            sum += weight * distance;
            area += weight;
        }
    }
    let mean = if area > 0.0 { sum / area } else { 0.0 };
    Ok(Distances { largest, mean, samples: middles.len() * from.face_count() })
}

/// Weights of the middles of the n^2 equal triangles that a triangle is cut into.
fn middles(n: usize) -> Vec<[f64; 3]> {
    let mut weights = Vec::with_capacity(n * n);
    let mut push = |i: usize, j: usize, third: f64| {
        let [u, v] = [i, j].map(|k| (k as f64 + third) / n as f64);
        weights.push([u, v, 1.0 - u - v]);
    };
    for i in 0..n {
        for j in 0..n - i {
            push(i, j, 1.0 / 3.0);
            if i + j + 1 < n {
                push(i, j, 2.0 / 3.0);
            }
        }
    }
    weights
}

/// Compares the normals of the faces that each triangle of the overlay lies in.
fn normals(
    meshes: [&SurfaceMesh; 2],
    map: &Correspondence,
    direction: Direction,
    mesh: &SurfaceMesh,
) -> NormalReport {
    let from = direction.side();
    let by_face = |mesh: &SurfaceMesh| -> TiVec<FaceId, DVec3> {
        let normal = |f| {
            let [p, q, r] = mesh.corners(f);
            (q - p).cross(r - p).normalize_or_zero()
        };
        mesh.faces().map(normal).collect()
    };
    let [moved, wanted] = [mesh, meshes[from.other()]].map(by_face);
    let (mut sum, mut whole) = (0.0, 0.0);
    let mut cells = Cells::new(meshes, map);
    for piece in &map.pieces {
        let area: f64 = cells.of(piece).iter().map(|cell| cell.areas[from.other()]).sum();
        sum += area * moved[piece.faces[from]].distance_squared(wanted[piece.faces[from.other()]]);
        whole += area;
    }
    let mean_square = if whole > 0.0 { sum / whole } else { 0.0 };
    let psnr = (mean_square > 0.0).then(|| 10.0 * ln(4.0 / mean_square) / std::f64::consts::LN_10);
    NormalReport { mean_square, psnr }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::vertex_image::Direction::{SourceToTarget, TargetToSource};
    use crate::monitor::Silent;
    use crate::transfer::tests::ball_on_egg;

    #[test]
    fn a_triangle_is_cut_evenly() {
        for n in [1, 2, 5] {
            let all = middles(n);
            assert_eq!(all.len(), n * n);
            let sum: DVec3 = all.iter().map(|w| DVec3::from(*w)).sum();
            assert!((sum / (n * n) as f64).distance(DVec3::splat(1.0 / 3.0)) < 1e-15);
            assert!(all.iter().flatten().all(|w| *w > 0.0));
        }
    }

    #[test]
    fn vertices_lie_on_the_shape_and_chords_leave_it_a_little() {
        let mapped = ball_on_egg();
        for direction in [SourceToTarget, TargetToSource] {
            let report = shape_report(mapped.meshes(), &mapped.map, direction, &mut Silent).unwrap();
            let mesh = reshaped(mapped.meshes(), &mapped.map, direction);
            let index = SurfaceIndex::new(mapped.meshes()[direction.side().other()]);
            assert!(mesh.positions().iter().all(|p| index.nearest(*p).distance < 1e-12));
            // A chord of an edge of 0.12 leaves a ball of radius 1 by 0.002.
            assert!(report.hausdorff > 1e-4 && report.hausdorff < 0.02, "{report:?}");
            assert!(report.to_shape.mean < report.hausdorff && report.from_shape.mean < report.hausdorff);
            assert!(report.to_shape.mean > 0.0 && report.to_shape.samples >= SAMPLES);
            let psnr = report.normals.psnr.unwrap();
            assert!(psnr > 25.0 && psnr < 60.0, "{psnr}");
            assert!(report.sentence().contains("dB"));
        }
    }

    #[test]
    fn decibels_tell_how_well_normals_agree() {
        let mapped = ball_on_egg();
        let target = &mapped.target;
        let flat = target
            .with_positions(target.positions().iter().map(|p| *p * DVec3::new(1.0, 1.0, 1e-3)).collect());
        let report =
            normals([&mapped.target, &mapped.target], &identity(&mapped.target), SourceToTarget, &flat);
        assert!(report.psnr.unwrap() < 10.0, "{report:?}");
        let same = normals([target, target], &identity(target), SourceToTarget, target);
        assert_eq!(same, NormalReport { mean_square: 0.0, psnr: None });
    }

    /// The map of a mesh to itself.
    fn identity(mesh: &SurfaceMesh) -> Correspondence {
        use crate::mesh::Place;
        use crate::surface_map::correspondence::MappedPiece;
        let piece = |f: FaceId| MappedPiece {
            faces: [f; 2],
            corners: 3 * f.index()..3 * f.index() + 3,
            map: glam::DMat2::IDENTITY,
            is_certain: true,
        };
        Correspondence {
            vertices: mesh.vertices().map(|v| [Place::Vertex(v); 2]).collect(),
            pieces: mesh.faces().map(piece).collect(),
            corners: mesh.triangles().iter().flatten().map(|v| v.0).collect(),
        }
    }
}
