//! The way of a map's source to its target's shape, for views and as a file.

use super::taken::TakenMap;
use crate::export::glb::GlbError;
use crate::export::morph_glb::{MorphingMesh, morphing_source};
use crate::landmarks::MeshSide;
use crate::map_file::FileMesh;
use crate::math::rigid3::{Rigid3, laid_on};
use crate::mesh::{FaceId, VertexId};
use crate::monitor::Monitor;
use crate::transfer::deformation::{DeformationError, Shape};
use crate::transfer::morph::{MorphPoints, Way, way};
use glam::DVec3;

/// The usual name of the file of [`TakenMap::morph_glb`].
pub const MORPH_FILE: &str = "source-to-target.glb";

/// The ratio of sizes from which two meshes are taken to have other units, so that the target gets the source's size. Chosen by
/// hand.
const OTHER_UNITS: f64 = 8.0;

/// Why there is no way from the source's shape to the target's.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MorphError {
    /// The map goes to the mirror image: nothing that turns becomes it.
    #[error("the map goes to the mirror image of the target, which the source cannot turn into")]
    Mirrored,
    /// A vertex has no image.
    #[error("vertex {vertex} of the source has no image")]
    NoImage {
        /// The vertex's number in the source's file.
        vertex: usize,
    },
    /// Points, triangles and faces that do not belong together.
    #[error("{points} points have {images} images, and {triangles} triangles {faces} faces")]
    Counts {
        /// Number of places on the source.
        points: usize,
        /// Number of places on the target.
        images: usize,
        /// Number of triangles of points.
        triangles: usize,
        /// Number of faces of triangles.
        faces: usize,
    },
    /// The shapes between were not found.
    #[error(transparent)]
    Deformation(#[from] DeformationError),
    /// The file could not be written.
    #[error(transparent)]
    Glb(#[from] GlbError),
}

/// A map's points as they are drawn, in the coordinates of the checked meshes, not mirrored.
#[derive(Clone, Copy, Debug)]
pub struct DrawnPoints<'a> {
    /// The places of the points on the source and on the target.
    pub places: [&'a [DVec3]; 2],
    /// Triangles of points.
    pub triangles: &'a [[u32; 3]],
    /// The face of the source that each triangle lies in.
    pub faces: &'a [FaceId],
}

/// A way with what it was made between.
#[derive(Clone, Debug)]
pub struct DrawnWay {
    /// The drawn places of the points on the source.
    pub begins: Vec<DVec3>,
    /// Their drawn places on the target, laid on the source.
    pub ends: Vec<DVec3>,
    /// The rigid motion that laid them there, after they were drawn.
    pub laid: Rigid3,
    /// The way between.
    pub way: Way,
}

impl TakenMap<'_> {
    /// The way of points from the source to the target, which is laid on the source by the rigid motion that brings all points nearest to
    /// their partners. `draw` takes places of the checked source and target to those in which they are drawn: rigid motions and scalings.
    ///
    /// # Errors
    /// [`MorphError`].
    pub fn way(
        &self,
        points: DrawnPoints<'_>,
        draw: [&dyn Fn(DVec3) -> DVec3; 2],
        monitor: &mut dyn Monitor,
    ) -> Result<DrawnWay, MorphError> {
        let DrawnPoints { places, triangles, faces } = points;
        if self.meshes()[1].is_mirrored() {
            return Err(MorphError::Mirrored);
        }
        if places[0].len() != places[1].len() || triangles.len() != faces.len() {
            return Err(MorphError::Counts {
                points: places[0].len(),
                images: places[1].len(),
                triangles: triangles.len(),
                faces: faces.len(),
            });
        }
        let [begins, drawn] = [0, 1].map(|k| places[k].iter().map(|p| draw[k](*p)).collect::<Vec<DVec3>>());
        let laid = laid_on(&drawn, &begins);
        let ends: Vec<DVec3> = drawn.iter().map(|p| laid.apply(*p)).collect();
        let mesh = self.surfaces()[0];
        let mesh = mesh.with_positions(mesh.positions().iter().map(|p| draw[0](*p)).collect());
        let image = |(v, place): (usize, Option<DVec3>)| {
            let vertex = self.meshes()[0].vertex_number(VertexId::from(v));
            place.map(|p| laid.apply(draw[1](p))).ok_or(MorphError::NoImage { vertex })
        };
        let end = self
            .vertex_places(MeshSide::Source)
            .into_iter()
            .enumerate()
            .map(image)
            .collect::<Result<Shape, _>>()?;
        let points = MorphPoints { positions: &begins, images: &ends, triangles, faces };
        let way = way(&mesh, &end, points, monitor)?;
        Ok(DrawnWay { begins, ends, laid, way })
    }

    /// The source on its way to the target's shape as GLB, with an animation that plays it. The target is laid on the source, in the source's units.
    ///
    /// # Errors
    /// [`MorphError`].
    pub fn morph_glb(&self, monitor: &mut dyn Monitor) -> Result<Vec<u8>, MorphError> {
        let common = self.common();
        let faces: Vec<FaceId> = common.faces.iter().map(|[source, _]| *source).collect();
        let points = DrawnPoints {
            places: [&common.source_positions, &common.target_positions],
            triangles: &common.triangles,
            faces: &faces,
        };
        let scale = target_scale(self.meshes());
        let drawn = self.way(points, [&|p| p, &|p| p * scale], monitor)?;
        let turned = |n: &DVec3| drawn.laid.rotation * *n;
        let mesh = MorphingMesh {
            positions: [&drawn.begins, &drawn.ends],
            normals: [&common.source_normals, &common.target_normals.iter().map(turned).collect::<Vec<_>>()],
            bends: &drawn.way.bends,
            turns: &drawn.way.turns,
        };
        Ok(morphing_source(&mesh, self.meshes()[0].frame(), &self.skin(&common)?))
    }
}

/// The factor from lengths of the checked target to lengths in the units of the checked source.
fn target_scale(meshes: [&FileMesh; 2]) -> f64 {
    let [source, target] = meshes.map(|mesh| mesh.mesh().area().sqrt());
    let in_files = meshes[1].frame().scale() / meshes[0].frame().scale();
    let ratio = target * in_files / source;
    if (1.0 / OTHER_UNITS..=OTHER_UNITS).contains(&ratio) { in_files } else { source / target }
}
