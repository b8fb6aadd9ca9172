//! Flat metrics with prescribed cones, conformal to a mesh: target curvature and the discrete Ricci flow.
//!
//! One formula serves a family of discrete conformal structures ([`crate::math::decorated`]). The main method keeps the
//! triangulation weighted Delaunay while the radii change: then the energy is convex on all of R^V and Newton converges
//! (Bobenko & Lutz 2023; for vertex scaling Gillespie, Springborn & Crane 2021).

pub mod atlas;
mod flow;
mod growth;
mod metric;
mod record;
mod scheme;
pub mod target;

pub use flow::{FlowError, FlowOptions, FlowReport, flow, recorded_flow};
pub use growth::{FlatSurface, PlaneLayout};
pub use metric::ConeMetric;
pub use record::{FlowMoment, FlowRecord};
pub use scheme::Scheme;
pub use target::{TargetError, base_domain_curvature, check_defect, listed_curvature, uniform_curvature};
