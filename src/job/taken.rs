//! The results of a map with pieces: all its files, and answers about points.

use super::look::MapLook;
use crate::export;
use crate::export::glb::GlbError;
use crate::export::skin::Skin;
use crate::export::vertex_image::{self, Direction, PointImage};
use crate::landmarks::MeshSide;
use crate::map_file::{self, FileMesh, MapFile};
use crate::mesh::cap_faces::CapFaces;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint};
use crate::pipeline::{DistortionReport, TriangleDistortion};
use crate::surface_map::correspondence::{self, PointLocator};
use crate::surface_map::measures::distortion::Distortion;
use crate::surface_map::measures::transfer::CommonMesh;
use glam::DVec3;

/// A file that a map gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputKind {
    /// The map itself, from which all others can be made.
    Map,
    /// The source in the look that the map carries, or a checkerboard, with the target's shape as morph target.
    Glb,
    /// The image of each source vertex.
    SourceImagesCsv,
    /// The same as JSON.
    SourceImagesJson,
    /// The point of the source that each target vertex comes from.
    TargetImagesCsv,
    /// The same as JSON.
    TargetImagesJson,
    /// The source's vertices and polygons in the target's shape.
    SourceShapeObj,
    /// The same as PLY.
    SourceShapePly,
    /// The target's vertices and polygons in the source's shape.
    TargetShapeObj,
    /// The same as PLY.
    TargetShapePly,
    /// Distortion of each triangle of the GLB.
    Distortion,
    /// Distortion around each source vertex.
    VertexDistortion,
    /// The base domain at the target.
    BaseDomain,
    /// Both meshes on the flat base domain, as a drawing.
    LayoutSvg,
    /// The source cut along the flat layout, with its texture coordinates.
    LayoutSourceObj,
    /// The target cut along the flat layout, with its texture coordinates.
    LayoutTargetObj,
}

impl OutputKind {
    /// All kinds of outputs.
    pub const ALL: [Self; 16] = [
        Self::Map,
        Self::Glb,
        Self::SourceImagesCsv,
        Self::SourceImagesJson,
        Self::TargetImagesCsv,
        Self::TargetImagesJson,
        Self::SourceShapeObj,
        Self::SourceShapePly,
        Self::TargetShapeObj,
        Self::TargetShapePly,
        Self::Distortion,
        Self::VertexDistortion,
        Self::BaseDomain,
        Self::LayoutSvg,
        Self::LayoutSourceObj,
        Self::LayoutTargetObj,
    ];

    /// The usual name of its file.
    pub fn file_name(self) -> &'static str {
        match self {
            Self::Map => "map.conemap",
            Self::Glb => "source-with-target-texture.glb",
            Self::SourceImagesCsv => "vertex-images.csv",
            Self::SourceImagesJson => "vertex-images.json",
            Self::TargetImagesCsv => "target-vertex-images.csv",
            Self::TargetImagesJson => "target-vertex-images.json",
            Self::SourceShapeObj => "source-in-target-shape.obj",
            Self::SourceShapePly => "source-in-target-shape.ply",
            Self::TargetShapeObj => "target-in-source-shape.obj",
            Self::TargetShapePly => "target-in-source-shape.ply",
            Self::Distortion => "distortion.csv",
            Self::VertexDistortion => "vertex-distortion.csv",
            Self::BaseDomain => "base-domain.obj",
            Self::LayoutSvg => "layout.svg",
            Self::LayoutSourceObj => "layout-source.obj",
            Self::LayoutTargetObj => "layout-target.obj",
        }
    }

    /// The output with this file name.
    pub fn of(file_name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.file_name() == file_name)
    }
}

/// Whether maps between two meshes have a map file: not those of repaired meshes, whose numbers are not those of their files.
pub(super) fn have_map_file(meshes: [&FileMesh; 2]) -> bool {
    !meshes.into_iter().any(FileMesh::is_repaired)
}

/// A map with both meshes.
#[derive(Clone, Copy, Debug)]
pub struct TakenMap<'a> {
    meshes: [&'a FileMesh; 2],
    map: &'a MapFile,
    look: Option<&'a MapLook>,
}

impl<'a> TakenMap<'a> {
    /// A map between these meshes, for which it was made or read.
    pub fn new(meshes: [&'a FileMesh; 2], map: &'a MapFile) -> Self {
        Self { meshes, map, look: None }
    }

    /// The same map, whose files carry a look that was read for its meshes.
    #[must_use]
    pub fn wearing(self, look: &'a MapLook) -> Self {
        Self { look: Some(look), ..self }
    }

    /// The files that there are: those of the flat layout are missing where there is none, and the map file where a mesh was
    /// repaired, so that it is not that of its file.
    pub fn kinds(&self) -> Vec<OutputKind> {
        let needs_layout = |kind: &OutputKind| {
            matches!(kind, OutputKind::LayoutSvg | OutputKind::LayoutSourceObj | OutputKind::LayoutTargetObj)
        };
        let is_there = |kind: &OutputKind| match kind {
            OutputKind::Map => self.has_map_file(),
            _ => self.map.layout.is_some() || !needs_layout(kind),
        };
        OutputKind::ALL.into_iter().filter(is_there).collect()
    }

    /// Whether there is a map file.
    pub fn has_map_file(&self) -> bool {
        have_map_file(self.meshes)
    }

    /// A file; empty where [`Self::kinds`] does not have it.
    ///
    /// # Errors
    /// [`GlbError`].
    pub fn output(&self, kind: OutputKind) -> Result<Vec<u8>, GlbError> {
        use Direction::{SourceToTarget, TargetToSource};
        Ok(match kind {
            OutputKind::Map => map_file::write(self.map, self.meshes),
            OutputKind::Glb => self.textured_source()?,
            OutputKind::SourceImagesCsv => {
                vertex_image::csv(SourceToTarget, &self.vertex_images(SourceToTarget))
            }
            OutputKind::SourceImagesJson => {
                vertex_image::json(SourceToTarget, &self.vertex_images(SourceToTarget))
            }
            OutputKind::TargetImagesCsv => {
                vertex_image::csv(TargetToSource, &self.vertex_images(TargetToSource))
            }
            OutputKind::TargetImagesJson => {
                vertex_image::json(TargetToSource, &self.vertex_images(TargetToSource))
            }
            OutputKind::SourceShapeObj => {
                self.shape(SourceToTarget, |p, faces| export::obj::polygons(p, faces))
            }
            OutputKind::SourceShapePly => self.shape(SourceToTarget, export::ply::polygons),
            OutputKind::TargetShapeObj => {
                self.shape(TargetToSource, |p, faces| export::obj::polygons(p, faces))
            }
            OutputKind::TargetShapePly => self.shape(TargetToSource, export::ply::polygons),
            OutputKind::Distortion => {
                let [source, target] = self.meshes.map(FileMesh::checked);
                let numbers: [&dyn Fn(FaceId) -> FaceId; 2] =
                    [&|f| source.file_from_face(f), &|f| target.file_from_face(f)];
                export::csv::distortion(&self.triangle_distortion(), numbers, self.caps())
            }
            OutputKind::VertexDistortion => {
                let by_vertex = self.measured().by_vertex;
                let by_vertex = self.meshes[0].checked().by_file_vertex(&by_vertex.raw);
                // Around a vertex whose skin all lies in caps there is nothing to measure.
                let is_measured = |density: &Option<f64>| density.filter(|density| !density.is_nan());
                export::csv::vertex_distortion(&by_vertex.iter().map(is_measured).collect::<Vec<_>>())
            }
            OutputKind::BaseDomain => export::obj::mesh(&self.map.base.mesh),
            OutputKind::LayoutSvg => self.map.layout.as_ref().map(export::layout::svg).unwrap_or_default(),
            OutputKind::LayoutSourceObj => self.layout_obj(MeshSide::Source),
            OutputKind::LayoutTargetObj => self.layout_obj(MeshSide::Target),
        })
    }

    /// The content of its map file.
    pub fn map(&self) -> &'a MapFile {
        self.map
    }

    /// Both meshes with what is known of their files.
    pub fn meshes(&self) -> [&'a FileMesh; 2] {
        self.meshes
    }

    /// The meshes that are mapped.
    pub fn surfaces(&self) -> [&'a SurfaceMesh; 2] {
        self.meshes.map(FileMesh::mesh)
    }

    /// The image of each vertex of the source's file, or the point of the source that each vertex of the target's file comes from.
    pub fn vertex_images(&self, direction: Direction) -> Vec<Option<PointImage>> {
        let from = direction.side();
        let images = self.map.correspondence.vertex_images(self.surfaces(), from);
        let images = self.meshes[from].checked().by_file_vertex(&images.raw);
        images.into_iter().map(|image| image.flatten().map(|point| self.told(from.other(), point))).collect()
    }

    /// The place of each vertex of a mapped mesh on the other one, not mirrored; `None` for one that no piece has.
    pub fn vertex_places(&self, from: MeshSide) -> Vec<Option<DVec3>> {
        let onto = self.meshes[from.other()];
        let images = self.map.correspondence.vertex_images(self.surfaces(), from);
        let place = |point: SurfacePoint| onto.as_given(point.position(onto.mesh()));
        images.into_iter().map(|image| image.map(place)).collect()
    }

    /// The images of points; both are in the files' numbers. The faces must exist.
    pub fn images(&self, direction: Direction, points: &[SurfacePoint]) -> Vec<PointImage> {
        let from = direction.side();
        let locator = PointLocator::new(self.surfaces(), &self.map.correspondence);
        let image = |point: &SurfacePoint| {
            let point = self.meshes[from].on_mesh(*point);
            self.told(from.other(), locator.carried(from, point))
        };
        points.iter().map(image).collect()
    }

    /// A point of one of the mapped meshes as its file tells it.
    fn told(&self, side: MeshSide, point: SurfacePoint) -> PointImage {
        let mesh = self.meshes[side];
        PointImage {
            point: mesh.on_file(point),
            position: mesh.in_file(point.position(mesh.mesh())),
            in_cap: mesh.checked().has_caps().then(|| mesh.checked().is_cap(point.face)),
        }
    }

    /// The measures of the map, from its pieces alone; places are those of the files.
    pub fn distortion(&self) -> DistortionReport {
        let mut report = DistortionReport::new(&self.measured(), self.map.summary.l2_stretch);
        report.replace_worst([&|p| self.meshes[0].on_file(p), &|p| self.meshes[1].on_file(p)]);
        report
    }

    fn caps(&self) -> CapFaces<'a> {
        let [source, target] = self.meshes.map(|mesh| mesh.checked().caps());
        CapFaces { source, target }
    }

    fn measured(&self) -> Distortion {
        correspondence::distortion(self.surfaces(), &self.map.correspondence, self.caps())
    }

    /// The pieces as one mesh, in the coordinates of the checked meshes, not mirrored.
    pub fn common(&self) -> CommonMesh {
        let mut common =
            correspondence::common_mesh(self.surfaces(), &self.map.correspondence, self.map.texture.as_ref());
        for vectors in [&mut common.target_positions, &mut common.target_normals] {
            vectors.iter_mut().for_each(|p| *p = self.meshes[1].as_given(*p));
        }
        common
    }

    /// Distortion of each triangle of [`Self::common`].
    fn triangle_distortion(&self) -> Vec<TriangleDistortion> {
        // The rest of the common mesh, which is large, is dropped before the pieces are measured.
        let pieces = self.common().pieces;
        let by_piece = self.measured().by_piece;
        let local = |&piece: &u32| {
            let [source_face, target_face] = self.map.correspondence.pieces[piece as usize].faces;
            TriangleDistortion { source_face, target_face, local: by_piece[piece as usize] }
        };
        pieces.iter().map(local).collect()
    }

    /// Distortion around each vertex of a common mesh of this map.
    pub fn common_distortion(&self, common: &CommonMesh) -> Vec<f64> {
        let measured = self.measured();
        let densities: Vec<f64> =
            common.pieces.iter().map(|&piece| measured.by_piece[piece as usize].density).collect();
        common.vertex_averages(&densities)
    }

    fn textured_source(&self) -> Result<Vec<u8>, GlbError> {
        let common = self.common();
        let (distortion, skin) = (self.common_distortion(&common), self.skin(&common)?);
        Ok(export::glb::textured_source(&common, &distortion, self.meshes.map(FileMesh::frame), &skin))
    }

    /// The skin of the triangles of the map: the look that it carries, or a checkerboard.
    pub(super) fn skin(&self, common: &CommonMesh) -> Result<Skin, GlbError> {
        Ok(match self.look {
            Some(look) => look.skin(common, self.meshes)?,
            None => Skin::checkerboard(common)?,
        })
    }

    /// The polygons of one file with its vertices at their images on the other mesh. A vertex that no face uses is put where the
    /// first image is.
    fn shape(&self, direction: Direction, write: fn(&[DVec3], &[Vec<u32>]) -> Vec<u8>) -> Vec<u8> {
        let images = self.vertex_images(direction);
        let first = images.iter().flatten().next().map_or(DVec3::ZERO, |image| image.position);
        let positions: Vec<DVec3> = images.iter().map(|image| image.map_or(first, |i| i.position)).collect();
        let polygons = self.meshes[direction.side()].polygons();
        // The outside stays outside where the map goes to a mirror image.
        if self.meshes[1].is_mirrored() {
            let turned: Vec<Vec<u32>> = polygons.iter().map(|p| p.iter().rev().copied().collect()).collect();
            return write(&positions, &turned);
        }
        write(&positions, polygons)
    }

    fn layout_obj(&self, side: MeshSide) -> Vec<u8> {
        let Some(layout) = &self.map.layout else { return Vec::new() };
        let (mesh, drawing) = (self.meshes[side], &layout.drawings[side]);
        export::layout::obj(layout, drawing, |v| {
            mesh.in_file(drawing.vertices[v].place.position(mesh.mesh()))
        })
    }

    /// The sides of the flat base domain on the source and on the target, as line strips in the coordinates of the checked
    /// meshes, not mirrored.
    pub fn patch_lines(&self) -> [Vec<Vec<DVec3>>; 2] {
        let Some(layout) = &self.map.layout else { return [Vec::new(), Vec::new()] };
        MeshSide::BOTH.map(|side| {
            let mesh = self.meshes[side];
            let lines = layout.drawings[side].side_lines(&layout.base.mesh);
            let place = |v: &u32| {
                mesh.as_given(layout.drawings[side].vertices[*v as usize].place.position(mesh.mesh()))
            };
            lines.iter().map(|line| line.iter().map(place).collect()).collect()
        })
    }
}
