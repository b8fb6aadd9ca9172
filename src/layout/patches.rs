//! The patches of a finished drawing: one disc of refined faces for each base face, found by flood fill, and checked.

use super::base_layout::{BaseLayout, LayoutReport, PatchedMesh};
use super::drawing::{Drawing, MeshWithPaths};
use crate::base_domain::BaseDomain;
use crate::landmarks::{LandmarkId, Landmarks};
use crate::mesh::{FaceId, HalfedgeId, MeshError, RefinedMesh, SurfaceMesh, VertexId};
use typed_index_collections::{TiVec, ti_vec};

/// A fault of the patches of a drawing.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PatchFault {
    /// The rotation system does not make a triangulation, or a refined mesh is not manifold.
    #[error("{0}")]
    NotManifold(#[from] MeshError),
    /// A base edge has no path.
    #[error("base edge {}-{} has no path", landmarks[0], landmarks[1])]
    MissingPath {
        /// Its landmarks.
        landmarks: [usize; 2],
    },
    /// Two consecutive vertices of a path are not neighbours, or a path vertex lies on two paths.
    #[error("the path of base halfedge {halfedge} is broken at vertex {vertex}")]
    BrokenPath {
        /// The base halfedge.
        halfedge: usize,
        /// The refined vertex.
        vertex: usize,
    },
    /// A face is in no patch, or the face on the left of a path is in another patch.
    #[error("face {face} is not in the patch its border says")]
    WrongPatch {
        /// The refined face.
        face: usize,
    },
    /// A patch is not a disc.
    #[error("patch {patch} has Euler characteristic {euler} instead of 1")]
    NotADisc {
        /// The base face.
        patch: usize,
        /// V - E + F of the closed patch.
        euler: i64,
    },
    /// An edge inside a patch joins two border vertices.
    #[error("edge {}-{} bridges a patch", edge[0], edge[1])]
    Bridge {
        /// Its ends.
        edge: [usize; 2],
    },
}

/// The base domain of a drawing: the faces of its rotation system, landmarks at the target's positions.
pub(super) fn base_of(
    drawing: &Drawing,
    target: &SurfaceMesh,
    landmarks: &Landmarks,
) -> Result<BaseDomain, PatchFault> {
    let positions = landmarks.target.iter().map(|&v| target.positions()[v]).collect();
    let mut faces = TiVec::new();
    for (i, around) in drawing.rotation.iter_enumerated() {
        let neighbour = |k: usize| {
            let [a, b] = drawing.ends[around[k % around.len()]];
            if a == i { b } else { a }
        };
        for k in 0..around.len() {
            let (j, l) = (neighbour(k), neighbour(k + 1));
            if i < j && i < l {
                faces.push([i, j, l].map(|landmark| VertexId(landmark.0)));
            }
        }
    }
    Ok(BaseDomain { mesh: SurfaceMesh::from_triangles(positions, faces)? })
}

/// Finishes a drawing: splits bridges, fills the patches and checks both meshes.
pub(super) fn finish(
    drawing: Drawing,
    base: BaseDomain,
    inputs: [&SurfaceMesh; 2],
    report: LayoutReport,
) -> Result<BaseLayout, PatchFault> {
    let Drawing { sides: [source, target], ends, .. } = drawing;
    let source = patched(source, &ends, &base, inputs[0])?;
    let target = patched(target, &ends, &base, inputs[1])?;
    source.validate(&base)?;
    target.validate(&base)?;
    Ok(BaseLayout { base, source, target, report })
}

fn patched(
    mut side: MeshWithPaths,
    ends: &[[LandmarkId; 2]],
    base: &BaseDomain,
    input: &SurfaceMesh,
) -> Result<PatchedMesh, PatchFault> {
    side.mesh.split_bridges();
    let paths = paths_by_halfedge(&side, ends, base)?;
    let origin = |v: usize| side.mesh.origin(VertexId::from(v), input);
    let vertex_origin = (0..side.mesh.positions.len()).map(origin).collect();
    let mesh = SurfaceMesh::from_triangles(side.mesh.positions, side.mesh.faces)?;
    let face_patch = flood(&mesh, &paths, &side.mesh.on_path, base)?;
    Ok(PatchedMesh {
        mesh,
        vertex_origin,
        face_origin: side.mesh.face_origin,
        face_patch,
        landmark_vertices: side.landmarks,
        paths,
    })
}

fn paths_by_halfedge(
    side: &MeshWithPaths,
    ends: &[[LandmarkId; 2]],
    base: &BaseDomain,
) -> Result<TiVec<HalfedgeId, Vec<VertexId>>, PatchFault> {
    let mut paths = ti_vec![Vec::new(); base.mesh.face_count() * 3];
    for (path, &[i, j]) in ends.iter().enumerate() {
        let missing = PatchFault::MissingPath { landmarks: [i, j].map(usize::from) };
        let h = base.mesh.halfedge_between(VertexId(i.0), VertexId(j.0)).ok_or(missing)?;
        paths[h].clone_from(&side.paths[path]);
        paths[base.mesh.twin(h)] = side.paths[path].iter().rev().copied().collect();
    }
    match base.mesh.halfedges().find(|&h| paths[h].is_empty()) {
        Some(h) => {
            let landmarks = [base.mesh.tail(h), base.mesh.head(h)].map(usize::from);
            Err(PatchFault::MissingPath { landmarks })
        }
        None => Ok(paths),
    }
}

/// Marks a face that no patch has reached.
const UNKNOWN: FaceId = FaceId(u32::MAX);

fn flood(
    mesh: &SurfaceMesh,
    paths: &TiVec<HalfedgeId, Vec<VertexId>>,
    on_path: &TiVec<HalfedgeId, bool>,
    base: &BaseDomain,
) -> Result<TiVec<FaceId, FaceId>, PatchFault> {
    let mut patch = ti_vec![UNKNOWN; mesh.face_count()];
    let mut stack = Vec::new();
    for b in base.mesh.faces() {
        let border = HalfedgeId::of(b, 0);
        let broken = PatchFault::BrokenPath { halfedge: border.index(), vertex: paths[border][0].index() };
        let seed = mesh.halfedge_between(paths[border][0], paths[border][1]).ok_or(broken)?.face();
        stack.push(seed);
        while let Some(f) = stack.pop() {
            if patch[f] != UNKNOWN {
                continue;
            }
            patch[f] = b;
            for k in 0..3 {
                let h = HalfedgeId::of(f, k);
                if !on_path[h] {
                    stack.push(mesh.twin(h).face());
                }
            }
        }
    }
    match patch.iter().position(|&b| b == UNKNOWN) {
        Some(face) => Err(PatchFault::WrongPatch { face }),
        None => Ok(patch),
    }
}

impl PatchedMesh {
    /// The refinement without its patches.
    pub fn refined(&self) -> RefinedMesh {
        RefinedMesh {
            mesh: self.mesh.clone(),
            vertex_origin: self.vertex_origin.clone(),
            face_origin: self.face_origin.clone(),
        }
    }

    /// Checks everything that the later stages rely on.
    ///
    /// # Errors
    /// The first [`PatchFault`] found: a broken or crossing path, a face in a wrong patch, a patch that is not a disc, an
    /// edge that bridges a patch.
    pub fn validate(&self, base: &BaseDomain) -> Result<(), PatchFault> {
        let border = self.check_paths(base)?;
        self.check_borders(base, &border)?;
        self.check_discs(base)
    }

    /// Checks that paths are chains of edges that meet at landmarks only; returns which halfedges they use.
    fn check_paths(&self, base: &BaseDomain) -> Result<TiVec<HalfedgeId, bool>, PatchFault> {
        let mut border = ti_vec![false; self.mesh.face_count() * 3];
        let mut used = ti_vec![false; self.mesh.vertex_count()];
        self.landmark_vertices.iter().for_each(|&v| used[v] = true);
        for h in base.mesh.halfedges() {
            let path = &self.paths[h];
            let fault = |v: VertexId| PatchFault::BrokenPath { halfedge: h.index(), vertex: v.index() };
            let ends = [base.tail(h), base.head(h)].map(|l| self.landmark_vertices[l]);
            if path.len() < 2 || [path[0], path[path.len() - 1]] != ends {
                return Err(fault(ends[0]));
            }
            if h < base.mesh.twin(h) {
                for &v in &path[1..path.len() - 1] {
                    if std::mem::replace(&mut used[v], true) {
                        return Err(fault(v));
                    }
                }
            }
            for pair in path.windows(2) {
                let edge = self.mesh.halfedge_between(pair[0], pair[1]).ok_or_else(|| fault(pair[0]))?;
                border[edge] = true;
                if self.face_patch[edge.face()] != h.face() {
                    return Err(PatchFault::WrongPatch { face: edge.face().index() });
                }
            }
        }
        Ok(border)
    }

    /// Checks that patches change at borders only and that no inner edge bridges two border vertices.
    fn check_borders(&self, base: &BaseDomain, border: &TiVec<HalfedgeId, bool>) -> Result<(), PatchFault> {
        let mut on_border = ti_vec![false; self.mesh.vertex_count()];
        base.mesh.halfedges().for_each(|h| self.paths[h].iter().for_each(|&v| on_border[v] = true));
        for h in self.mesh.halfedges().filter(|&h| !border[h]) {
            let (a, b) = (self.mesh.tail(h), self.mesh.head(h));
            if self.face_patch[h.face()] != self.face_patch[self.mesh.twin(h).face()] {
                return Err(PatchFault::WrongPatch { face: h.face().index() });
            }
            if on_border[a] && on_border[b] {
                return Err(PatchFault::Bridge { edge: [a.index(), b.index()] });
            }
        }
        Ok(())
    }

    /// Checks that every patch is a disc: V - E + F = 1 and connected by construction of the flood.
    fn check_discs(&self, base: &BaseDomain) -> Result<(), PatchFault> {
        let mut faces: TiVec<FaceId, i64> = ti_vec![0; base.mesh.face_count()];
        let mut inner_corners: TiVec<FaceId, i64> = ti_vec![0; base.mesh.face_count()];
        let mut border_edges: TiVec<FaceId, i64> = ti_vec![0; base.mesh.face_count()];
        let mut on_border = ti_vec![false; self.mesh.vertex_count()];
        for h in base.mesh.halfedges() {
            self.paths[h].iter().for_each(|&v| on_border[v] = true);
            border_edges[h.face()] += self.paths[h].len() as i64 - 1;
        }
        self.face_patch.iter().for_each(|&p| faces[p] += 1);
        for v in self.mesh.vertices().filter(|&v| !on_border[v]) {
            inner_corners[self.face_patch[self.mesh.outgoing(v).face()]] += 1;
        }
        for patch in base.mesh.faces() {
            // The border is a closed curve of as many vertices as edges.
            let vertices = inner_corners[patch] + border_edges[patch];
            let edges = (3 * faces[patch] + border_edges[patch]) / 2;
            let euler = vertices - edges + faces[patch];
            if euler != 1 {
                return Err(PatchFault::NotADisc { patch: patch.index(), euler });
            }
        }
        Ok(())
    }
}
