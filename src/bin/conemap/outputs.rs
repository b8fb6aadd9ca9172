//! The files of `conemap map --out`.

use crate::arguments::MapArguments;
use crate::input::{self, Failure};
use conemap::export;
use conemap::mesh::check::CheckedMesh;
use conemap::mesh::insertion::Insertion;
use conemap::mesh::mirror::{mirrored, mirrored_point};
use conemap::mesh::{FaceId, SurfacePoint};
use conemap::pipeline::MapResult;
use std::path::Path;

/// What the outputs refer to.
pub struct Inputs<'a> {
    /// Source and target with their landmarks.
    pub insertions: [&'a Insertion; 2],
    /// Source and target before landmarks were inserted.
    pub checked: [&'a CheckedMesh; 2],
    /// What the user asked for.
    pub arguments: &'a MapArguments,
}

impl Inputs<'_> {
    /// A point of the mapped source as one of the source's file.
    pub fn on_source_file(&self, point: SurfacePoint) -> SurfacePoint {
        self.checked[0].with_file_corners(self.insertions[0].on_original(point))
    }

    /// A point of the mapped target as one of the target's file, also where it was mirrored.
    pub fn on_target_file(&self, point: SurfacePoint) -> SurfacePoint {
        let point = self.insertions[1].on_original(point);
        let is_mirrored = self.arguments.mirror_target;
        self.checked[1].with_file_corners(if is_mirrored { mirrored_point(point) } else { point })
    }
}

/// Writes all files; everything is told of the files that the user gave, also where the target was mirrored.
pub fn write(folder: &Path, result: &MapResult, inputs: &Inputs<'_>) -> Result<(), Failure> {
    let ([source, target], [checked_source, _]) = (inputs.insertions, inputs.checked);
    let as_given = |p: SurfacePoint| inputs.on_target_file(p);
    let images = checked_source.by_file_vertex(&result.target_from_source.raw);
    let images: Vec<_> = images.into_iter().map(|image| image.flatten().map(as_given)).collect();
    let glb = export::glb::textured_source(&result.common, &result.common_vertex_distortion())?;
    input::write(&folder.join("source-with-target-texture.glb"), &glb)?;
    input::write(&folder.join("vertex-images.csv"), &export::csv::vertex_images(&images))?;
    let base =
        if inputs.arguments.mirror_target { mirrored(&result.base.mesh)? } else { result.base.mesh.clone() };
    input::write(&folder.join("base-domain.obj"), &export::obj::mesh(&base))?;
    if !result.triangle_distortion.is_empty() {
        let faces: [&dyn Fn(FaceId) -> FaceId; 2] = [&|f| source.face_origin[f], &|f| target.face_origin[f]];
        let by_triangle = export::csv::distortion(&result.triangle_distortion, faces);
        input::write(&folder.join("distortion.csv"), &by_triangle)?;
        let by_vertex = checked_source.by_file_vertex(&result.vertex_distortion.raw);
        input::write(&folder.join("vertex-distortion.csv"), &export::csv::vertex_distortion(&by_vertex))?;
    }
    Ok(())
}
