//! A checked mesh as bytes, from the instance of the program that has read it to the one that shows it.
//!
//! Reading checks again what is quick to check: every number against its count, twins against each other, and one fan around every vertex,
//! so that no walk over the mesh leaves it.

use super::check::{CheckedMesh, RepairedFaces};
use super::packing::{PackedError, Packer, Unpacker};
use super::{FaceId, FileFrame, HalfedgeId, SurfaceMesh, VertexId};
use typed_index_collections::TiVec;

/// The number that stands for no vertex.
const NONE: u32 = u32::MAX;

impl FileFrame {
    pub(super) fn pack(&self, packer: &mut Packer) {
        packer.real(self.scale());
        packer.places(std::iter::once(self.origin()));
    }

    pub(super) fn unpack(unpacker: &mut Unpacker<'_>) -> Result<Self, PackedError> {
        let scale = unpacker.real()?;
        match unpacker.places()?[..] {
            [origin] if scale > 0.0 => Ok(Self::new(scale, origin)),
            _ => Err(PackedError::new("a frame is none")),
        }
    }
}

impl CheckedMesh {
    /// Adds the whole mesh to a packer.
    pub fn pack(&self, packer: &mut Packer) {
        let Self { mesh, frame, vertex_from_file, turned, repaired_faces } = self;
        frame.pack(packer);
        packer.places(mesh.positions().iter().copied());
        packer.triples(mesh.triangles().iter().map(|corners| corners.map(|v| v.0)));
        packer.wholes((0..3 * mesh.face_count()).map(|h| mesh.twin(HalfedgeId::from(h)).0));
        packer.wholes(vertex_from_file.iter().map(|v| v.map_or(NONE, |v| v.0)));
        packer.flags(turned.iter().copied());
        packer.count(usize::from(repaired_faces.is_some()));
        if let Some(RepairedFaces { in_file, number, is_cap }) = repaired_faces {
            packer.count(*in_file);
            packer.wholes(number.iter().copied());
            packer.flags(is_cap.iter().copied());
        }
    }

    /// Takes back from an unpacker the mesh that [`Self::pack`] has added.
    ///
    /// # Errors
    /// [`PackedError`] where the numbers make no closed mesh.
    pub fn unpack(unpacker: &mut Unpacker<'_>) -> Result<Self, PackedError> {
        let frame = FileFrame::unpack(unpacker)?;
        let positions: TiVec<VertexId, _> = unpacker.places()?.into();
        let triangles = unpacker.triples()?;
        let faces: TiVec<FaceId, _> = triangles.into_iter().map(|corners| corners.map(VertexId)).collect();
        let twins: TiVec<HalfedgeId, _> = unpacker.wholes()?.into_iter().map(HalfedgeId).collect();
        let mesh = SurfaceMesh::from_twins(positions, faces, twins)
            .map_err(|_| PackedError::new("the triangles make no closed mesh"))?;
        let numbers = unpacker.wholes()?;
        if numbers.iter().any(|&v| v != NONE && v as usize >= mesh.vertex_count()) {
            return Err(PackedError::new("a vertex of the file is none of the mesh"));
        }
        let vertex_from_file = numbers.into_iter().map(|v| (v != NONE).then_some(VertexId(v))).collect();
        let turned: TiVec<FaceId, bool> = unpacker.flags()?.into();
        let repaired_faces = if unpacker.count()? == 0 { None } else { Some(repaired_faces(unpacker)?) };
        let lengths = repaired_faces.as_ref().map(|faces| [faces.number.len(), faces.is_cap.len()]);
        if [turned.len()].into_iter().chain(lengths.into_iter().flatten()).any(|n| n != mesh.face_count()) {
            return Err(PackedError::new("the marks of faces are not as many as the faces"));
        }
        Ok(Self { mesh, frame, vertex_from_file, turned, repaired_faces })
    }
}

fn repaired_faces(unpacker: &mut Unpacker<'_>) -> Result<RepairedFaces, PackedError> {
    let in_file = unpacker.count()?;
    Ok(RepairedFaces { in_file, number: unpacker.wholes()?.into(), is_cap: unpacker.flags()?.into() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::check::closed_genus_zero;
    use crate::mesh::generators::icosphere;
    use crate::mesh::repair::{RepairOptions, repaired};
    use crate::mesh::soup::PolygonSoup;
    use crate::monitor::Silent;
    use glam::DVec3;

    /// A ball far from the origin with a vertex that no face uses, and some faces turned.
    fn soup() -> PolygonSoup {
        let ball = icosphere(2);
        let far = DVec3::new(3e9, -1e9, 0.5);
        let places = ball.positions().iter().map(|p| *p * 0.001 + far);
        let mut polygons: Vec<Vec<u32>> =
            ball.triangles().iter().map(|t| t.iter().map(|v| v.0 + 1).collect()).collect();
        polygons.iter_mut().step_by(5).for_each(|polygon| polygon.reverse());
        PolygonSoup {
            positions: [far].into_iter().chain(places).collect(),
            polygons,
            ..PolygonSoup::default()
        }
    }

    fn packed(checked: &CheckedMesh) -> Vec<u8> {
        let mut packer = Packer::default();
        checked.pack(&mut packer);
        packer.into_bytes()
    }

    fn unpacked(bytes: &[u8]) -> Result<CheckedMesh, PackedError> {
        let mut unpacker = Unpacker::new(bytes);
        let checked = CheckedMesh::unpack(&mut unpacker)?;
        unpacker.end()?;
        Ok(checked)
    }

    fn assert_same(a: &CheckedMesh, b: &CheckedMesh) {
        assert_eq!((a.frame, &a.vertex_from_file, &a.turned), (b.frame, &b.vertex_from_file, &b.turned));
        let faces = |checked: &CheckedMesh| {
            checked.repaired_faces.as_ref().map(|f| (f.in_file, f.number.clone(), f.is_cap.clone()))
        };
        assert_eq!(faces(a), faces(b));
        assert_eq!((a.mesh.positions(), a.mesh.triangles()), (b.mesh.positions(), b.mesh.triangles()));
        assert!(a.mesh.halfedges().all(|h| a.mesh.twin(h) == b.mesh.twin(h)));
        assert!(a.mesh.vertices().all(|v| a.mesh.outgoing(v) == b.mesh.outgoing(v)));
    }

    #[test]
    fn a_mesh_comes_back_as_it_was() {
        let checked = closed_genus_zero(&soup()).unwrap();
        assert!(!checked.frame.is_the_files() && checked.turned_faces() > 0);
        assert_same(&unpacked(&packed(&checked)).unwrap(), &checked);
    }

    #[test]
    fn a_repaired_mesh_keeps_its_caps_and_numbers() {
        let mut soup = soup();
        soup.polygons.drain(3..9);
        let checked = repaired(&soup, &RepairOptions::default(), &mut Silent).unwrap().checked;
        assert!(checked.has_caps());
        assert_same(&unpacked(&packed(&checked)).unwrap(), &checked);
    }

    #[test]
    fn whatever_number_is_changed_no_walk_leaves_the_mesh() {
        let ball = icosphere(0);
        let polygons = ball.triangles().iter().map(|t| t.iter().map(|v| v.0).collect()).collect();
        let positions = ball.positions().iter().copied().collect();
        let checked =
            closed_genus_zero(&PolygonSoup { positions, polygons, ..PolygonSoup::default() }).unwrap();
        let bytes = packed(&checked);
        let mut refused = 0;
        for at in 0..bytes.len() {
            for change in [1, 128] {
                let mut changed = bytes.clone();
                changed[at] ^= change;
                match unpacked(&changed) {
                    Ok(CheckedMesh { mesh, .. }) => {
                        let corners: usize = mesh.vertices().map(|v| mesh.star(v).count()).sum();
                        assert_eq!(corners, 3 * mesh.face_count());
                    }
                    Err(_) => refused += 1,
                }
            }
            assert!(unpacked(&bytes[..at]).is_err());
        }
        // Every number of a corner or a twin but its place in space.
        assert!(refused > 1000, "{refused}");
    }
}
