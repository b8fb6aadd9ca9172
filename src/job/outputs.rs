//! The files that a job gives.

use super::checked_job::Job;
use super::look::MapLook;
use super::taken::{OutputKind, TakenMap};
use crate::base_domain::BaseDomain;
use crate::export;
use crate::export::glb::GlbError;
use crate::export::skin::Skin;
use crate::export::vertex_image::{self, Direction, PointImage};
use crate::map_file::{FileMesh, MapFile};
use crate::mesh::mirror::mirrored;
use crate::mesh::{Carrier, FaceFrame, FaceId};
use crate::monitor::Silent;
use crate::pipeline::{Choices, MapResult};
use crate::surface_map::correspondence::TextureDrawing;

/// A file that a job gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFile {
    /// Its name.
    pub name: &'static str,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// The files of a result, each made when it is asked for: so one can be written and dropped before the next is made.
#[must_use]
pub struct OutputFiles<'a> {
    job: &'a Job,
    result: &'a MapResult,
    look: &'a MapLook,
    /// `None` for a map without pieces.
    map: Option<MapFile>,
    kinds: std::vec::IntoIter<OutputKind>,
}

impl Iterator for OutputFiles<'_> {
    /// A file, or why it cannot be made.
    type Item = Result<OutputFile, GlbError>;

    fn next(&mut self) -> Option<Self::Item> {
        let kind = self.kinds.next()?;
        let bytes = match &self.map {
            Some(map) => self.job.taken(map).wearing(self.look).output(kind),
            None => self.job.bare_output(self.result, kind),
        };
        Some(bytes.map(|bytes| OutputFile { name: kind.file_name(), bytes }))
    }
}

impl Job {
    /// The content of the map file of a result of this job; `None` where the map has no pieces: for other methods than the relaxed one, and where
    /// there is no overlay.
    pub fn map_file(&self, result: &MapResult, choices: &Choices) -> Option<MapFile> {
        let on_file = result.correspondence.as_ref()?;
        let placed = [&self.placed.source, &self.placed.target];
        let frames: [&dyn Fn(FaceId) -> FaceFrame; 2] = [&|f| placed[0].frame(f), &|f| placed[1].frame(f)];
        let carriers =
            [0, 1].map(|k| Carrier { from: &placed[k].mesh, onto: self.meshes[k].mesh(), frame: frames[k] });
        Some(MapFile {
            correspondence: on_file.carried(carriers, &mut Silent).ok()?,
            texture: result.texture.as_ref().map(|uvs| TextureDrawing::of_corners(carriers[1], uvs)),
            layout: result.flat_layout.as_ref().and_then(|layout| layout.carried(carriers, &mut Silent).ok()),
            base: self.base_as_given(result),
            cones: result.cone_curvatures.clone(),
            landmarks: self.landmarks.clone(),
            // Choices and reports always have JSON.
            options: serde_json::to_value(choices).unwrap_or_default(),
            summary: (&result.report.distortion).into(),
            report: serde_json::to_value(&result.report).unwrap_or_default(),
        })
    }

    /// A map file of this job with its meshes: the files and answers that it gives.
    pub fn taken<'a>(&'a self, map: &'a MapFile) -> TakenMap<'a> {
        TakenMap::new(self.meshes.each_ref(), map)
    }

    /// All files of a result of this job, the places in them those of the job's files; `look` is what the map carries.
    pub fn outputs<'a>(
        &'a self,
        result: &'a MapResult,
        choices: &Choices,
        look: &'a MapLook,
    ) -> OutputFiles<'a> {
        let map = self.map_file(result, choices);
        let kinds = match &map {
            Some(map) => self.taken(map).kinds(),
            None => vec![OutputKind::Glb, OutputKind::SourceImagesCsv, OutputKind::BaseDomain],
        };
        OutputFiles { job: self, result, look, map, kinds: kinds.into_iter() }
    }

    /// A file of a result without pieces; empty for other kinds than those three that there are.
    fn bare_output(&self, result: &MapResult, kind: OutputKind) -> Result<Vec<u8>, GlbError> {
        Ok(match kind {
            OutputKind::Glb => self.bare_glb(result)?,
            OutputKind::SourceImagesCsv => self.vertex_images(result),
            OutputKind::BaseDomain => self.base_domain(result),
            _ => Vec::new(),
        })
    }

    /// The source in the look that a result of this job carries, as GLB; a checkerboard where the map has no pieces.
    ///
    /// # Errors
    /// [`GlbError`].
    pub fn glb(&self, result: &MapResult, choices: &Choices, look: &MapLook) -> Result<Vec<u8>, GlbError> {
        match self.map_file(result, choices) {
            Some(map) => self.taken(&map).wearing(look).output(OutputKind::Glb),
            None => self.bare_glb(result),
        }
    }

    /// The source with a checkerboard over the target's texture coordinates.
    fn bare_glb(&self, result: &MapResult) -> Result<Vec<u8>, GlbError> {
        let mut common = result.common.clone();
        for vectors in [&mut common.target_positions, &mut common.target_normals] {
            vectors.iter_mut().for_each(|p| *p = self.meshes[1].as_given(*p));
        }
        let frames = self.meshes.each_ref().map(FileMesh::frame);
        let skin = Skin::checkerboard(&common)?;
        Ok(export::glb::textured_source(&common, &result.common_vertex_distortion(), frames, &skin))
    }

    /// The image of each vertex of the source's file, as CSV; where the target has caps, with a column that tells whether the image
    /// lies in one.
    pub fn vertex_images(&self, result: &MapResult) -> Vec<u8> {
        let target = &self.placed.target.mesh;
        let images = self.meshes[0].checked().by_file_vertex(&result.target_from_source.raw);
        let image = |point| PointImage {
            point: self.on_target_file(point),
            position: self.meshes[1].in_file(point.position(target)),
            in_cap: self.in_cap_of_target(self.placed.target.on_original(point).face),
        };
        let images: Vec<_> = images.into_iter().map(|point| point.flatten().map(image)).collect();
        vertex_image::csv(Direction::SourceToTarget, &images)
    }

    /// Whether a face of the target is part of a cap; `None` where the target has none.
    fn in_cap_of_target(&self, face: FaceId) -> Option<bool> {
        let target = self.meshes[1].checked();
        target.has_caps().then(|| target.is_cap(face))
    }

    /// The base domain at the target as given, as OBJ.
    pub fn base_domain(&self, result: &MapResult) -> Vec<u8> {
        export::obj::mesh(&self.base_as_given(result).mesh)
    }

    fn base_as_given(&self, result: &MapResult) -> BaseDomain {
        let base = &result.base.mesh;
        // A mirror image has the connectivity of its mesh, so it never fails.
        let image = if self.meshes[1].is_mirrored() { mirrored(base).ok() } else { None };
        let mesh = image.unwrap_or_else(|| base.clone());
        let frame = self.meshes[1].frame();
        if frame.is_the_files() {
            return BaseDomain { mesh };
        }
        BaseDomain { mesh: mesh.with_positions(mesh.positions().iter().map(|p| frame.in_file(*p)).collect()) }
    }
}
