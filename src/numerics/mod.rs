//! Sparse matrices and solvers. Knows no mesh.

pub mod block_csr;
