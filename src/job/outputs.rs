//! The files that a job gives.

use super::{Job, TargetImage};
use crate::export;
use crate::export::glb::GlbError;
use crate::mesh::FaceId;
use crate::mesh::mirror::mirrored;
use crate::pipeline::MapResult;

/// A file that a job gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFile {
    /// Its name.
    pub name: &'static str,
    /// Its contents.
    pub bytes: Vec<u8>,
}

impl Job {
    /// All files of a result of this job, the places in them those of the job's files.
    ///
    /// # Errors
    /// [`GlbError`].
    pub fn outputs(&self, result: &MapResult) -> Result<Vec<OutputFile>, GlbError> {
        let mut files = vec![
            OutputFile { name: "source-with-target-texture.glb", bytes: self.textured_source(result)? },
            OutputFile { name: "vertex-images.csv", bytes: self.vertex_images(result) },
            OutputFile { name: "base-domain.obj", bytes: self.base_domain(result) },
        ];
        if !result.triangle_distortion.is_empty() {
            let bytes = self.triangle_distortion(result);
            files.push(OutputFile { name: "distortion.csv", bytes });
            let bytes = self.vertex_distortion(result);
            files.push(OutputFile { name: "vertex-distortion.csv", bytes });
        }
        Ok(files)
    }

    /// The source with the target's texture, as GLB.
    ///
    /// # Errors
    /// [`GlbError`].
    pub fn textured_source(&self, result: &MapResult) -> Result<Vec<u8>, GlbError> {
        export::glb::textured_source(&result.common, &result.common_vertex_distortion())
    }

    /// The image of each vertex of the source's file, as CSV; where the target has caps, with a column that tells whether the image
    /// lies in one.
    pub fn vertex_images(&self, result: &MapResult) -> Vec<u8> {
        let images = self.meshes[0].by_file_vertex(&result.target_from_source.raw);
        let on_target = |point| self.placed.target.on_original(point).face;
        let in_cap: Vec<bool> = images
            .iter()
            .map(|image| image.flatten().is_some_and(|point| self.meshes[1].is_cap(on_target(point))))
            .collect();
        let on_file = |point| self.on_target_file(point);
        let images: Vec<_> = images.into_iter().map(|image| image.flatten().map(on_file)).collect();
        if self.meshes[1].has_caps() {
            export::csv::vertex_images_with_caps(&images, &in_cap)
        } else {
            export::csv::vertex_images(&images)
        }
    }

    /// The base domain at the target as given, as OBJ.
    pub fn base_domain(&self, result: &MapResult) -> Vec<u8> {
        let base = &result.base.mesh;
        match self.target_image {
            TargetImage::AsGiven => export::obj::mesh(base),
            // A mirror image has the connectivity of its mesh, so it never fails.
            TargetImage::Mirrored => export::obj::mesh(mirrored(base).as_ref().unwrap_or(base)),
        }
    }

    /// Distortion of each triangle of the textured GLB, as CSV.
    pub fn triangle_distortion(&self, result: &MapResult) -> Vec<u8> {
        let numbers: [&dyn Fn(FaceId) -> FaceId; 2] =
            [&|f| self.meshes[0].file_from_face(self.placed.source.face_origin[f]), &|f| {
                self.meshes[1].file_from_face(self.placed.target.face_origin[f])
            }];
        export::csv::distortion(&result.triangle_distortion, numbers)
    }

    /// Distortion around each vertex of the source's file, as CSV.
    pub fn vertex_distortion(&self, result: &MapResult) -> Vec<u8> {
        export::csv::vertex_distortion(&self.meshes[0].by_file_vertex(&result.vertex_distortion.raw))
    }
}
