//! Energies: of a flat triangle, of a map between two surfaces, and of vertices held near given places.

pub mod density;
pub mod map_energy;
pub mod point_constraint;
pub mod symmetric_dirichlet;
pub mod vertex_energy;
pub mod weighted_energy;
