//! Both meshes drawn on the base domain's flat triangles, cut along their sides.
//!
//! On the cone surface the base domain's triangles (charts) are flat and source and target lie over each other: a point and its
//! image have the same coordinates. Here each mesh is cut along the straight sides of the charts, by combinatorics: a side crosses
//! the mesh's edges in order, and the parts of a face between crossings lie in one chart each.

mod cutting;
mod drawing;
mod layout;

pub use drawing::{BorderPart, FlatDrawing, FlatPolygon, FlatVertex, TrianglesByChart};
pub use layout::FlatLayout;
