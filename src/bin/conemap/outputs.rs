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

/// Writes all files; everything is told of the files that the user gave, also where the target was mirrored.
pub fn write(folder: &Path, result: &MapResult, inputs: &Inputs<'_>) -> Result<(), Failure> {
    let ([source, target], [checked_source, checked_target]) = (inputs.insertions, inputs.checked);
    let mirror = inputs.arguments.mirror_target;
    let as_given = |p: SurfacePoint| {
        let point = target.on_original(p);
        checked_target.with_file_corners(if mirror { mirrored_point(point) } else { point })
    };
    let images = checked_source.by_file_vertex(&result.target_from_source.raw);
    let images: Vec<_> = images.into_iter().map(|image| image.flatten().map(as_given)).collect();
    let glb = export::glb::textured_source(&result.common, &result.common_vertex_distortion())?;
    input::write(&folder.join("source-with-target-texture.glb"), &glb)?;
    input::write(&folder.join("vertex-images.csv"), &export::csv::vertex_images(&images))?;
    let base = if mirror { mirrored(&result.base.mesh)? } else { result.base.mesh.clone() };
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
