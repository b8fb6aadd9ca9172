//! Takes the vertices that erased paths have left behind out of a refined mesh.
//!
//! Each path splits the edges that it crosses, and an erased path leaves its vertices. A layout that was found by twists would lie on
//! meshes with several times the vertices of one that was drawn at once, and its map would depend on the history of the drawing.

use super::refinable::RefinableMesh;
use crate::mesh::collapsible::{CollapsibleMesh, ShapeLimits};
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use typed_index_collections::TiVec;

/// Least double area, in units of the longest edge squared, of the triangles that a pass may make: well-shaped ones first. A path beside
/// a corner makes triangles of a thousandth; below the last limit the orientation would hang on rounding. Chosen by hand.
const SHAPES: [f64; 4] = [0.1, 1e-2, 1e-4, 1e-7];

/// Least cosine between a triangle's normals before and after: they lie in the plane of one input face.
const SAME_PLANE: f64 = 0.5;

impl RefinableMesh {
    /// Takes out the vertices that are neither the input's nor used, as far as each input face stays covered by triangles of its own.
    /// Returns the new number of every vertex that is left; the input's vertices keep theirs, and paths stay as they are.
    pub fn thin(&mut self) -> TiVec<VertexId, VertexId> {
        let mut left: Vec<VertexId> = self.positions.keys().filter(|&v| self.is_spare(v)).collect();
        if left.is_empty() {
            return self.positions.keys().collect();
        }
        let tails = self.faces.iter().flatten().copied().collect();
        let mut mesh = CollapsibleMesh::from_halfedges(tails, self.twins.clone(), self.outgoing.clone());
        for double_area in SHAPES {
            let limits = ShapeLimits { normal_cosine: SAME_PLANE, double_area };
            // The last vertex first: it was the last split.
            for &v in left.iter().rev() {
                if let Some(h) = self.way_out(&mesh, v, &limits) {
                    self.collapse(&mut mesh, h);
                }
            }
            left.retain(|&v| mesh.is_alive(v));
        }
        self.keep(&mesh)
    }

    /// Whether a vertex was made for a path and lies on none.
    fn is_spare(&self, v: VertexId) -> bool {
        // An input vertex is the place of itself.
        self.weights[v][0].0 != v && !self.used[v]
    }

    /// A halfedge from a vertex along which it can vanish: inside its input face, or along its input edge.
    fn way_out(&self, mesh: &CollapsibleMesh, v: VertexId, limits: &ShapeLimits) -> Option<HalfedgeId> {
        let origin = |h: HalfedgeId| self.face_origin[h.face()];
        let is_border = |h: &HalfedgeId| origin(*h) != origin(mesh.twin(*h));
        let borders = mesh.star(v).filter(is_border).count();
        let mut ways = mesh.star(v).filter(|h| borders == 0 || (borders == 2 && is_border(h)));
        ways.find(|&h| mesh.keeps_shape(h, &self.positions, limits) && mesh.link_condition(h))
    }

    /// Moves the start of `h`, which is on no path, into its end.
    fn collapse(&mut self, mesh: &mut CollapsibleMesh, h: HalfedgeId) {
        for g in [h, mesh.twin(h)] {
            // Two edges become one: that at the end of `h` may be on a path.
            let (out, back) = (mesh.twin(g.next()), mesh.twin(g.prev()));
            let on_path = self.on_path[out] || self.on_path[back];
            (self.on_path[out], self.on_path[back]) = (on_path, on_path);
        }
        mesh.collapse(h);
    }

    /// Becomes what is left, numbered in the old order; returns the new numbers of the vertices.
    fn keep(&mut self, mesh: &CollapsibleMesh) -> TiVec<VertexId, VertexId> {
        let (vertices, faces): (Vec<VertexId>, Vec<FaceId>) =
            (mesh.vertices().collect(), mesh.faces().collect());
        let mut numbers: TiVec<VertexId, VertexId> = self.positions.keys().collect();
        vertices.iter().enumerate().for_each(|(k, &v)| numbers[v] = VertexId::from(k));
        let mut face_numbers: TiVec<FaceId, FaceId> = self.faces.keys().collect();
        faces.iter().enumerate().for_each(|(k, &f)| face_numbers[f] = FaceId::from(k));
        let renumbered = |h: HalfedgeId| HalfedgeId::of(face_numbers[h.face()], h.corner());
        let halfedges = || faces.iter().flat_map(|f| f.halfedges());
        self.twins = halfedges().map(|h| renumbered(mesh.twin(h))).collect();
        self.on_path = halfedges().map(|h| self.on_path[h]).collect();
        self.outgoing = vertices.iter().map(|&v| renumbered(mesh.outgoing(v))).collect();
        self.faces = faces.iter().map(|&f| mesh.corners(f).map(|v| numbers[v])).collect();
        self.face_origin = faces.iter().map(|&f| self.face_origin[f]).collect();
        self.positions = vertices.iter().map(|&v| self.positions[v]).collect();
        self.weights = vertices.iter().map(|&v| self.weights[v]).collect();
        self.used = vertices.iter().map(|&v| self.used[v]).collect();
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::super::drawing::Drawing;
    use super::super::joint::{Ground, draw};
    use super::super::refinable::testing::assert_consistent;
    use super::super::twists::testing::figures;
    use super::super::variants::VARIANTS;
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;

    /// Faces with their least vertex first, sorted.
    fn faces(mesh: &RefinableMesh) -> Vec<[VertexId; 3]> {
        let mut faces: Vec<_> = mesh.faces.iter().copied().collect();
        for face in &mut faces {
            let least = (0..3).min_by_key(|&k| face[k]).unwrap();
            face.rotate_left(least);
        }
        faces.sort_unstable();
        faces
    }

    #[test]
    fn random_splits_are_undone() {
        let input = icosphere(1);
        let bare = RefinableMesh::new(&input, &[]);
        let mut mesh = bare.clone();
        for k in 0..100_u32 {
            mesh.split_edge(HalfedgeId(k * 7919 % mesh.twins.len() as u32));
        }
        let numbers = mesh.thin();
        assert_consistent(&mesh);
        assert_eq!(faces(&mesh), faces(&bare));
        assert!(input.vertices().all(|v| numbers[v] == v));
    }

    #[test]
    fn a_drawing_without_its_paths_is_the_input_again() {
        let (levels, landmarks) = figures();
        let empty = Drawing::new(&levels[0].mesh, &levels[1].mesh, &landmarks);
        let distances = empty.distances(&mut Silent).unwrap();
        let mut drawing = draw(&Ground::new(&empty, &distances), &VARIANTS[1], &mut Silent).unwrap();
        let whole = drawing.clone();
        let lengths = |drawing: &Drawing, s: usize| -> Vec<f64> {
            let mesh = &drawing.sides[s].mesh;
            let paths = drawing.sides[s].paths.iter();
            let length = |p: &Vec<VertexId>| {
                p.windows(2).for_each(|w| assert!(mesh.on_path[mesh.halfedge_between(w[0], w[1]).unwrap()]));
                p.windows(2).map(|w| mesh.positions[w[0]].distance(mesh.positions[w[1]])).sum()
            };
            paths.map(length).collect()
        };
        // Every other path goes, then the rest.
        for p in (0..drawing.ends.len()).rev().step_by(2) {
            drawing.erase(p);
        }
        drawing.thin();
        for s in 0..2 {
            let side = &drawing.sides[s];
            assert_consistent(&side.mesh);
            assert!(side.mesh.positions.len() < whole.sides[s].mesh.positions.len());
            assert_eq!(lengths(&drawing, s), side.lengths);
            let edges: usize = side.paths.iter().map(|p| p.len() - 1).sum();
            assert_eq!(side.mesh.on_path.iter().filter(|on| **on).count(), 2 * edges);
        }
        while !drawing.ends.is_empty() {
            drawing.erase(0);
        }
        drawing.thin();
        (0..2).for_each(|s| assert_eq!(faces(&drawing.sides[s].mesh), faces(&empty.sides[s].mesh)));
    }
}
