//! Sparse matrices and solvers. Knows no mesh.
