//! Sparse matrices and solvers. Knows no mesh.

pub mod approximate_cholesky;
pub mod block_csr;
pub mod graph;
pub mod laplacian;
