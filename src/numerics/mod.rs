//! Sparse matrices and solvers. Knows no mesh.

pub mod approximate_cholesky;
pub mod block_csr;
pub mod conjugate_gradients;
pub mod graph;
