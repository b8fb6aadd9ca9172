//! The landmarks of one mesh from its file to its surface.

use super::problem::{Advice, ExchangeError};
use super::remark::Remark;
use super::surface::Surface;
use crate::io::landmark_file::LandmarkPoint;
use crate::io::landmark_formats::{MarkList, Spot};
use crate::landmarks::MeshSide;
use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{FaceId, SurfacePoint, VertexId};
use glam::DVec3;

/// The distance from the surface, in units of the square root of the area, from which on a landmark is reported. Chosen by hand.
const TOLD: f64 = 0.01;
/// From this distance on it is refused. Chosen by hand.
const REFUSED: f64 = 0.2;
/// Within this distance landmarks lie on a surface, where a way is sought to bring them there. Chosen by hand.
const FITS: f64 = 0.05;
/// Within this distance of a vertex a landmark is the vertex.
const AT_VERTEX: f64 = 1e-9;
/// At most so many remarks of one kind name their landmarks.
const NAMED: usize = 5;
/// At most so many landmarks are looked at for advice.
const LOOKED_AT: usize = 200;
/// Between millimetres, centimetres, decimetres, metres and inches.
const UNITS: [f64; 8] = [1000.0, 0.001, 10.0, 0.1, 100.0, 0.01, 25.4, 1.0 / 25.4];

/// A landmark on its mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedMark {
    /// Its name, empty for none.
    pub label: String,
    /// The point; `None` where its file says that it was not placed.
    pub point: Option<LandmarkPoint>,
    /// The distance of the point in the file from the surface, in the units of the mesh; 0 for a point that the file gives on the surface.
    pub distance: f64,
}

/// The landmarks of one mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct SideLandmarks {
    /// The landmarks in the order of their file.
    pub marks: Vec<PlacedMark>,
    /// Remarks on the landmarks.
    pub remarks: Vec<Remark>,
}

/// The data by which the landmarks of one list are placed.
struct Placement<'a> {
    surface: Surface<'a>,
    /// The square root of the mesh's area, in the units of its file.
    size: f64,
    /// The number in the file of each vertex of the mesh.
    numbers: Vec<usize>,
    /// The index of the surface; `None` where the list has no points in space.
    index: Option<SurfaceIndex<'a>>,
}

/// Brings the landmarks of a list, of the file of this number, onto their mesh.
///
/// # Errors
/// [`ExchangeError::MissingFace`] and [`ExchangeError::FarOff`].
pub(super) fn place(
    list: &MarkList,
    surface: Surface<'_>,
    side: MeshSide,
    file: usize,
) -> Result<SideLandmarks, ExchangeError> {
    let has_places = list.marks.iter().any(|mark| matches!(mark.spot, Some(Spot::InSpace(_))));
    let placement = Placement {
        surface,
        size: surface.size() * surface.mesh.frame.scale(),
        numbers: surface.mesh.file_from_vertex(),
        index: has_places.then(|| SurfaceIndex::new(&surface.mesh.mesh)),
    };
    let mut marks = Vec::with_capacity(list.marks.len());
    for (index, mark) in list.marks.iter().enumerate() {
        let label = mark.label.clone();
        marks.push(match mark.spot {
            None => PlacedMark { label, point: None, distance: 0.0 },
            Some(Spot::OnMesh(point)) => {
                let point = placement.on_mesh(point).map_err(|face| {
                    let faces = surface.mesh.file_faces();
                    ExchangeError::MissingFace { file, side, index, label: label.clone(), face, faces }
                })?;
                PlacedMark { label, point: Some(point), distance: 0.0 }
            }
            Some(Spot::InSpace(p)) => placement.nearest(label, placement.in_system(list, p)),
        });
    }
    placement.check_distances(list, &marks, side, file)?;
    let remarks = placement.remarks(&marks, side);
    Ok(SideLandmarks { marks, remarks })
}

impl Placement<'_> {
    /// A point of a face, as a vertex where it is one; the face's number where the mesh does not have it.
    fn on_mesh(&self, point: LandmarkPoint) -> Result<LandmarkPoint, u32> {
        let LandmarkPoint::OnFace { face, barycentric } = point else {
            return Ok(point);
        };
        let checked = self.surface.mesh;
        let Some(known) = checked.face_from_file(FaceId(face)) else {
            // The placing of landmarks reports a face that a repair dropped.
            return if (face as usize) < checked.file_faces() { Ok(point) } else { Err(face) };
        };
        let corners = checked.mesh.triangles()[known];
        let on_mesh = checked.with_file_corners(SurfacePoint { face: known, barycentric });
        let corner = on_mesh.barycentric.iter().position(|w| *w == 1.0);
        Ok(corner.and_then(|k| self.vertex(corners[k])).unwrap_or(point))
    }

    /// A vertex as landmark files write it; `None` of one that a repair made.
    fn vertex(&self, v: VertexId) -> Option<LandmarkPoint> {
        let number = self.numbers[v.index()];
        (number < self.surface.mesh.vertex_from_file.len()).then_some(LandmarkPoint::Vertex(number as u32))
    }

    /// In the coordinate system of the mesh's file.
    fn in_system(&self, list: &MarkList, p: DVec3) -> DVec3 {
        list.space.map_or(p, |space| space.to(self.surface.space, p))
    }

    /// The nearest point of the surface, as a vertex where it is one.
    fn nearest(&self, label: String, p: DVec3) -> PlacedMark {
        let Some(index) = &self.index else {
            return PlacedMark { label, point: None, distance: 0.0 };
        };
        let frame = self.surface.mesh.frame;
        let found = index.nearest(frame.on_mesh(p));
        let mesh = &self.surface.mesh.mesh;
        let at = found.point.position(mesh);
        let corners = mesh.triangles()[found.point.face];
        let vertex =
            corners.iter().find(|v| mesh.positions()[**v].distance(at) <= AT_VERTEX * self.surface.size());
        let on_face = || {
            let SurfacePoint { face, barycentric } = self.surface.mesh.on_file(found.point);
            LandmarkPoint::OnFace { face: face.0, barycentric }
        };
        let point = vertex.and_then(|v| self.vertex(*v)).unwrap_or_else(on_face);
        PlacedMark { label, point: Some(point), distance: found.distance * frame.scale() }
    }

    /// Refuses points that are far from the mesh, the farthest named.
    fn check_distances(
        &self,
        list: &MarkList,
        marks: &[PlacedMark],
        side: MeshSide,
        file: usize,
    ) -> Result<(), ExchangeError> {
        let limit = REFUSED * self.size;
        let far = |(_, mark): &(usize, &PlacedMark)| mark.distance > limit || mark.distance.is_nan();
        let farthest =
            marks.iter().enumerate().filter(far).max_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance));
        let Some((index, mark)) = farthest else {
            return Ok(());
        };
        Err(ExchangeError::FarOff {
            file,
            side,
            index,
            label: mark.label.clone(),
            distance: mark.distance,
            share: mark.distance / self.size,
            advice: self.advice(list),
        })
    }

    /// The way in which the points of a list would lie on the mesh.
    fn advice(&self, list: &MarkList) -> Option<Advice> {
        let index = self.index.as_ref()?;
        let in_space = list.marks.iter().filter_map(|mark| match mark.spot {
            Some(Spot::InSpace(p)) => Some(self.in_system(list, p)),
            _ => None,
        });
        let points: Vec<DVec3> = in_space.take(LOOKED_AT).collect();
        let fit = |turned: &dyn Fn(DVec3) -> DVec3| {
            let on_mesh = |p: &DVec3| self.surface.mesh.frame.on_mesh(turned(*p));
            points.iter().all(|p| index.nearest(on_mesh(p)).distance <= FITS * self.surface.size())
        };
        if fit(&crate::io::landmark_formats::half_turned) {
            return Some(Advice::HalfTurn);
        }
        UNITS.into_iter().find(|factor| fit(&|p| p * *factor)).map(Advice::Scale)
    }

    /// Remarks on the points that were not placed, and on those that are somewhat off the surface, the farthest first.
    fn remarks(&self, marks: &[PlacedMark], side: MeshSide) -> Vec<Remark> {
        let unplaced = marks.iter().enumerate().filter(|(_, mark)| mark.point.is_none());
        let unplaced: Vec<_> = unplaced
            .map(|(index, mark)| Remark::NotPlaced { side, index, label: mark.label.clone() })
            .collect();
        let mut off: Vec<_> =
            marks.iter().enumerate().filter(|(_, mark)| mark.distance > TOLD * self.size).collect();
        off.sort_by(|(_, a), (_, b)| b.distance.total_cmp(&a.distance));
        let off: Vec<_> = off
            .into_iter()
            .map(|(index, mark)| {
                let (label, distance) = (mark.label.clone(), mark.distance);
                Remark::OffSurface { side, index, label, distance, share: distance / self.size }
            })
            .collect();
        let mut remarks = Vec::new();
        for (mut all, off_surface) in [(unplaced, false), (off, true)] {
            let count = all.len().saturating_sub(NAMED);
            all.truncate(NAMED);
            remarks.append(&mut all);
            if count > 0 {
                remarks.push(Remark::More { side, count, off_surface });
            }
        }
        remarks
    }
}
