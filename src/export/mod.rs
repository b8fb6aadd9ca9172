//! Results to bytes.

pub mod csv;
pub mod glb;
pub mod obj;
