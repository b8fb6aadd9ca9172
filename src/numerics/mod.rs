//! Sparse matrices and linear solvers. Nothing here knows of meshes.

pub mod approximate_cholesky;
pub mod block_csr;
pub mod conjugate_gradients;
pub mod graph;
