//! The energies that are lowered: of a flat triangle, of a map between two surfaces, and of points held near places.

pub mod density;
pub mod map_energy;
pub mod point_constraint;
pub mod symmetric_dirichlet;
pub mod vertex_energy;
pub mod weighted_energy;
