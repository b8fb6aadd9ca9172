//! The base domain of a map to be looked at: its triangles in the shape of both meshes, their cones, and what each triangle is on the
//! meshes, its patch.

use super::checked_job::Job;
use super::taken::TakenMap;
use crate::base_domain::BaseDomain;
use crate::landmarks::MeshSide;
use crate::map_file::FileMesh;
use crate::mesh::{FaceId, HalfedgeId, Place, SurfaceMesh};
use crate::pipeline::MapResult;
use crate::surface_map::flat_layout::{BorderPart, FlatDrawing, FlatLayout, TrianglesByChart};
use glam::DVec3;
use std::f64::consts::TAU;
use typed_index_collections::{TiVec, ti_vec};

/// The base domain of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct BasePicture {
    /// Its triangles: three cones each. The first cones are the landmarks, the others the program's own.
    pub triangles: Vec<[u32; 3]>,
    /// The number of the patch line of each triangle's side from corner k to k + 1.
    pub sides: Vec<[u32; 3]>,
    /// The base domain in the shape of the source and of the target.
    pub shapes: [BaseShape; 2],
}

/// The base domain with its cones on one mesh. Places are those of the checked mesh, not mirrored.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseShape {
    /// The places of its cones.
    pub cones: Vec<DVec3>,
    /// Angle defect of the plane triangles at each cone, in radians.
    pub curvatures: Vec<f64>,
    /// Corners of the parts of the mesh.
    pub points: Vec<DVec3>,
    /// The parts of the mesh as triangles of points, patch after patch in the order of the base triangles; none where they are not
    /// known. Faces are those of the checked mesh.
    pub patches: TrianglesByChart,
    /// The borders of the patches, piece by piece, from both sides; faces likewise, ends are numbers of points.
    pub borders: Vec<BorderPart>,
    /// The face of the checked mesh in the middle of each base triangle's patch; empty where patches are not known.
    pub middles: Vec<FaceId>,
}

impl Job {
    /// The base domain of a result of this job.
    pub fn base_picture(&self, result: &MapResult) -> BasePicture {
        let meshes = [&self.placed.source.mesh, &self.placed.target.mesh];
        let given = |side: MeshSide, p| self.meshes[side].as_given(p);
        let placed = [&self.placed.source, &self.placed.target];
        let checked = |side: MeshSide, f: FaceId| placed[side].face_origin[f];
        if let Some(picture) = result
            .flat_layout
            .as_ref()
            .and_then(|layout| BasePicture::of_layout(layout, meshes, given, checked))
        {
            return picture;
        }
        let landmarks = [&self.placed.landmarks.source, &self.placed.landmarks.target];
        let cones = MeshSide::BOTH
            .map(|side| landmarks[side].iter().map(|&v| given(side, meshes[side].positions()[v])).collect());
        BasePicture::bare(&result.base.mesh, cones)
    }
}

impl TakenMap<'_> {
    /// The base domain of the map; `None` where the map does not tell how it lies on the meshes.
    pub fn base_picture(&self) -> Option<BasePicture> {
        let layout = self.map().layout.as_ref()?;
        let [source, target] = self.meshes();
        let given = |side: MeshSide, p| [source, target][side].as_given(p);
        BasePicture::of_layout(layout, [source, target].map(FileMesh::mesh), given, |_, f| f)
    }
}

impl BasePicture {
    /// The base domain of a flat layout. `given` brings a place of a side's mapped mesh to the mesh as it was given, and `checked` brings a
    /// face to the face of the checked mesh that holds it. `None` where a cone lies nowhere.
    fn of_layout(
        layout: &FlatLayout,
        meshes: [&SurfaceMesh; 2],
        given: impl Fn(MeshSide, DVec3) -> DVec3,
        checked: impl Fn(MeshSide, FaceId) -> FaceId,
    ) -> Option<Self> {
        let base = &layout.base.mesh;
        let shape = |side: MeshSide| -> Option<BaseShape> {
            let drawing: &FlatDrawing = &layout.drawings[side];
            let place = |at: Place| given(side, at.surface_point(meshes[side]).position(meshes[side]));
            let cones: Option<Vec<DVec3>> = drawing.cones(base).into_iter().map(|at| at.map(place)).collect();
            let mut patches = drawing.triangles_by_chart(base.face_count());
            patches.faces.iter_mut().for_each(|f| *f = checked(side, *f));
            let mut borders = drawing.border_parts();
            borders.iter_mut().for_each(|part| part.face = checked(side, part.face));
            let middles = drawing.middle_faces(base.face_count());
            let middles = middles.into_iter().map(|f| checked(side, f)).collect();
            let points = drawing.vertices.iter().map(|vertex| place(vertex.place)).collect();
            Some(BaseShape { points, patches, borders, middles, ..BaseShape::bare(base, cones?) })
        };
        Some(Self::with_shapes(base, [shape(MeshSide::Source)?, shape(MeshSide::Target)?]))
    }

    /// A base domain with its cones at these places, without patches.
    fn bare(base: &SurfaceMesh, cones: [Vec<DVec3>; 2]) -> Self {
        Self::with_shapes(base, cones.map(|cones| BaseShape::bare(base, cones)))
    }

    fn with_shapes(base: &SurfaceMesh, shapes: [BaseShape; 2]) -> Self {
        let mut numbers: TiVec<HalfedgeId, u32> = ti_vec![0; 3 * base.face_count()];
        for (number, h) in base.edges().enumerate() {
            numbers[h] = number as u32;
            numbers[base.twin(h)] = number as u32;
        }
        Self {
            triangles: base.triangles().iter().map(|t| t.map(|v| v.0)).collect(),
            sides: base.faces().map(|f| f.halfedges().map(|h| numbers[h])).collect(),
            shapes,
        }
    }
}

impl BaseShape {
    /// A shape without patches; there is one place for each vertex of the base domain.
    fn bare(base: &SurfaceMesh, cones: Vec<DVec3>) -> Self {
        let shaped = BaseDomain { mesh: base.with_positions(cones.iter().copied().collect()) };
        Self {
            curvatures: shaped.cone_angles().into_iter().map(|angle| TAU - angle).collect(),
            cones,
            points: Vec::new(),
            patches: TrianglesByChart {
                triangles: Vec::new(),
                faces: Vec::new(),
                starts: vec![0; base.face_count() + 1],
            },
            borders: Vec::new(),
            middles: Vec::new(),
        }
    }
}
