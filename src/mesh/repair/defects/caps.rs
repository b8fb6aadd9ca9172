//! The caps of a repaired mesh, listed as defects of their own kind.

use super::chains::chains;
use super::defect::{Defect, DefectKind, Defects};
use crate::mesh::check::CheckedMesh;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use rustc_hash::FxHashMap;

impl Defects {
    /// The defects of a file with the caps of the mesh that was made of it.
    #[must_use]
    pub fn with_caps(mut self, checked: &CheckedMesh) -> Self {
        let Some(is_cap) = checked.caps() else { return self };
        let mesh = &checked.mesh;
        let numbers = checked.file_from_vertex();
        let mut added: FxHashMap<VertexId, u32> = FxHashMap::default();
        let mut seen = vec![false; mesh.face_count()];
        let mut caps = Vec::new();
        for start in mesh.faces().filter(|&f| is_cap[f]) {
            if std::mem::replace(&mut seen[start.index()], true) {
                continue;
            }
            let (mut stack, mut faces, mut rim): (_, Vec<FaceId>, Vec<[u32; 2]>) =
                (vec![start], vec![], vec![]);
            while let Some(face) = stack.pop() {
                faces.push(face);
                for k in 0..3 {
                    let halfedge = HalfedgeId::of(face, k);
                    let beyond = mesh.twin(halfedge).face();
                    if !is_cap[beyond] {
                        let ends = [mesh.tail(halfedge), mesh.head(halfedge)];
                        rim.push(ends.map(|v| self.number(v, &numbers, checked, &mut added)));
                    } else if !std::mem::replace(&mut seen[beyond.index()], true) {
                        stack.push(beyond);
                    }
                }
            }
            faces.sort_unstable();
            let first = self.triangles.len() as u32;
            for face in &faces {
                let corners = mesh.triangles()[*face];
                let corners = corners.map(|v| self.number(v, &numbers, checked, &mut added));
                self.triangles.push(corners);
            }
            caps.push(Defect { lines: chains(&rim), faces: (first..self.triangles.len() as u32).collect() });
        }
        caps.sort_by_key(|cap| std::cmp::Reverse(cap.faces.len()));
        self.add(DefectKind::Cap, caps);
        self
    }

    /// The number of a vertex of the repaired mesh, which becomes a position where the file has none for it.
    fn number(
        &mut self,
        v: VertexId,
        numbers: &[usize],
        checked: &CheckedMesh,
        added: &mut FxHashMap<VertexId, u32>,
    ) -> u32 {
        let in_file = numbers[v.index()];
        if in_file < self.file_vertices {
            return in_file as u32;
        }
        *added.entry(v).or_insert_with(|| {
            self.positions.push(checked.mesh.positions()[v]);
            self.positions.len() as u32 - 1
        })
    }
}
