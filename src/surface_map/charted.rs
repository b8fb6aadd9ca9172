//! Vertices as seen from the charts: which motion takes a vertex's own coordinates into the plane of a face.
//!
//! An interior vertex has coordinates in its patch's chart, a path vertex in the chart on the left of its path's smaller
//! halfedge. Faces keep their patch, so a vertex is seen from at most two charts.

use super::cone_surface::ConeSurface;
use super::flat_problem::Corner;
use super::progressive::Hold;
use crate::math::rigid2::Rigid2;
use crate::mesh::FaceId;
use glam::DVec2;

/// How a held vertex is seen from a chart.
#[derive(Clone, Copy, Debug)]
pub enum Sight {
    /// Its own coordinates under a motion.
    Moved(Rigid2),
    /// A cone, at a corner of the chart.
    Cone(DVec2),
}

/// The chart in which a free vertex has its coordinates; `None` for landmarks.
pub fn own_chart(hold: Hold) -> Option<FaceId> {
    match hold {
        Hold::Landmark(_) => None,
        Hold::Path(h) => Some(h.face()),
        Hold::Interior(patch) => Some(patch),
    }
}

/// How a vertex is seen from the chart of a face beside it.
pub fn sight(surface: &ConeSurface, hold: Hold, chart: FaceId) -> Sight {
    match hold {
        Hold::Landmark(landmark) => {
            let corners = surface.base.mesh.triangles()[chart];
            let k = corners.iter().position(|&v| v == landmark).unwrap_or(0);
            Sight::Cone(surface.charts[chart][k])
        }
        Hold::Path(h) if h.face() != chart => Sight::Moved(surface.transitions[h]),
        Hold::Path(_) | Hold::Interior(_) => Sight::Moved(Rigid2::IDENTITY),
    }
}

/// The point that a vertex with own coordinates `z` is at, in the chart of a face beside it.
pub fn seen(surface: &ConeSurface, hold: Hold, z: DVec2, chart: FaceId) -> DVec2 {
    match sight(surface, hold, chart) {
        Sight::Moved(motion) => motion.apply(z),
        Sight::Cone(p) => p,
    }
}

/// The corner of a flat problem for a vertex whose unknown has number `unknown`.
pub fn corner(surface: &ConeSurface, hold: Hold, unknown: u32, chart: FaceId) -> Corner {
    match sight(surface, hold, chart) {
        Sight::Moved(motion) => Corner::Free(unknown, motion),
        Sight::Cone(p) => Corner::Fixed(p),
    }
}
