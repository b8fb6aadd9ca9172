//! The mass matrix of the piecewise linear functions of a mesh: M_ij is the integral of phi_i phi_j.

use crate::mesh::{FaceId, SurfaceMesh, VertexId};
use crate::numerics::conjugate_gradients::{LinearOperator, Preconditioner};
use typed_index_collections::{TiVec, ti_vec};

/// A mass matrix, face by face.
pub struct Mass<'a> {
    mesh: &'a SurfaceMesh,
    /// The integrals of the products of the hat functions of corners 00, 11, 22, 01, 12, 20 over each face.
    faces: TiVec<FaceId, [f64; 6]>,
}

impl<'a> Mass<'a> {
    /// The mass matrix of a mesh in which nothing is integrated yet.
    pub fn zero(mesh: &'a SurfaceMesh) -> Self {
        Self { mesh, faces: ti_vec![[0.0; 6]; mesh.face_count()] }
    }

    /// Adds integrals over a part of a face, in the order 00, 11, 22, 01, 12, 20 of its corners.
    pub fn add(&mut self, face: FaceId, products: [f64; 6]) {
        self.faces[face].iter_mut().zip(products).for_each(|(sum, product)| *sum += product);
    }

    /// The sums of its rows: the integral of each hat function.
    pub fn lumped(&self) -> TiVec<VertexId, f64> {
        let mut sums = vec![0.0; self.mesh.vertex_count()];
        self.apply(&vec![1.0; self.mesh.vertex_count()], &mut sums);
        sums.into()
    }

    /// Its diagonal as a preconditioner: what is left has its eigenvalues between 1/2 and 2 (Wathen 1987).
    pub fn diagonal(&self) -> Diagonal {
        let mut diagonal = vec![0.0; self.mesh.vertex_count()];
        for (f, corners) in self.mesh.triangles().iter_enumerated() {
            (0..3).for_each(|k| diagonal[corners[k].index()] += self.faces[f][k]);
        }
        Diagonal(diagonal)
    }
}

impl LinearOperator<f64> for Mass<'_> {
    fn apply(&self, x: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        for (m, corners) in self.faces.iter().zip(self.mesh.triangles()) {
            let [a, b, c] = corners.map(VertexId::index);
            y[a] += m[0] * x[a] + m[3] * x[b] + m[5] * x[c];
            y[b] += m[3] * x[a] + m[1] * x[b] + m[4] * x[c];
            y[c] += m[5] * x[a] + m[4] * x[b] + m[2] * x[c];
        }
    }
}

/// A diagonal matrix.
pub struct Diagonal(Vec<f64>);

impl Preconditioner<f64> for Diagonal {
    fn precondition(&self, x: &[f64], y: &mut [f64]) {
        for ((y, x), d) in y.iter_mut().zip(x).zip(&self.0) {
            *y = if *d > 0.0 { x / d } else { *x };
        }
    }
}
