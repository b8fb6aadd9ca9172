//! The mesh between the given one and the new one, and which triangles it may have.

use super::creases::Creases;
use crate::math::scalar::{max, min};
use crate::mesh::closest_point::closest_in_triangle;
use crate::mesh::coarsening::Level;
use crate::mesh::collapsible::CollapsibleMesh;
use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint, VertexId};
use glam::DVec3;
use typed_index_collections::TiVec;

/// A mesh over the given surface.
pub(super) struct Working<'a> {
    pub original: &'a SurfaceIndex<'a>,
    pub mesh: CollapsibleMesh,
    pub places: TiVec<VertexId, Place>,
    pub creases: Creases,
}

/// The place of a vertex.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub position: DVec3,
    /// The given surface's unit normal there.
    pub normal: DVec3,
    /// A face of the given surface that is near.
    pub near: FaceId,
}

/// Measures of how well triangles approximate the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// The least cosine between a triangle's normal and the mean of the surface's at its corners.
    facing: f64,
    /// The least ratio of double area to longest side squared; 0.87 for an equilateral triangle.
    roundness: f64,
}

/// The least cosine (75 degrees) with which a triangle may turn freely. Chosen by hand.
const FACING: f64 = 0.25;
/// The least ratio (about 6 degrees) with which a triangle may become thinner. Chosen by hand.
const ROUNDNESS: f64 = 0.1;

impl Fit {
    /// The fit of no triangle.
    pub const BEST: Self = Self { facing: 1.0, roundness: 1.0 };

    /// The fit of a triangle.
    pub fn of([a, b, c]: [Place; 3]) -> Self {
        let (p, q, r) = (a.position, b.position, c.position);
        let cross = (q - p).cross(r - p);
        let double_area = cross.length();
        let longest = max(max(p.distance_squared(q), q.distance_squared(r)), r.distance_squared(p));
        if double_area <= 0.0 {
            return Self { facing: -1.0, roundness: 0.0 };
        }
        let mean = (a.normal + b.normal + c.normal).normalize_or_zero();
        Self { facing: cross.dot(mean) / double_area, roundness: double_area / longest }
    }

    /// The worse of both fits, in either number.
    pub fn worse(self, other: Self) -> Self {
        Self { facing: min(self.facing, other.facing), roundness: min(self.roundness, other.roundness) }
    }

    /// Whether triangles may take the place of others: they are good, or no worse.
    pub fn may_replace(self, before: Self) -> bool {
        self.facing >= min(before.facing, FACING) && self.roundness >= min(before.roundness, ROUNDNESS)
    }
}

impl<'a> Working<'a> {
    /// The working mesh that is the given surface's own.
    pub fn new(original: &'a SurfaceIndex<'a>, creases: Creases) -> Self {
        let surface = original.mesh();
        let place = |v: VertexId| {
            let point = SurfacePoint::at_vertex(surface, v);
            let normal = original.normal(point);
            Place { position: surface.positions()[v], normal, near: point.face }
        };
        let places = surface.vertices().map(place).collect();
        Self { original, mesh: CollapsibleMesh::new(surface), places, creases }
    }

    /// Number of triangles.
    pub fn face_count(&self) -> usize {
        // 2 E = 3 F, and V - E + F never changes.
        let euler = self.original.mesh().euler_characteristic();
        (2 * (self.mesh.live_vertices() as i64 - euler)).unsigned_abs() as usize
    }

    /// The mesh, numbered without gaps.
    pub fn into_mesh(self) -> SurfaceMesh {
        let positions: TiVec<VertexId, DVec3> = self.places.iter().map(|place| place.position).collect();
        Level::of(&self.mesh, &positions).mesh
    }

    /// Each edge's halfedge of the lower number.
    pub fn edges(&self) -> impl Iterator<Item = HalfedgeId> + '_ {
        let halfedges = self.mesh.faces().flat_map(|f| f.halfedges());
        halfedges.filter(|&h| h < self.mesh.twin(h))
    }

    /// Length of an edge.
    pub fn length(&self, h: HalfedgeId) -> f64 {
        let [a, b] = [self.mesh.tail(h), self.mesh.head(h)].map(|v| self.places[v].position);
        a.distance(b)
    }

    /// Whether a halfedge's edge is sharp.
    pub fn is_sharp(&self, h: HalfedgeId) -> bool {
        self.creases.chain([self.mesh.tail(h), self.mesh.head(h)]).is_some()
    }

    /// The fit of the triangles around a vertex as they would be with it elsewhere.
    pub fn fit_around(&self, v: VertexId, place: Place) -> Fit {
        let fan = self.mesh.star(v).map(|h| {
            let across = [self.mesh.head(h), self.mesh.tail(h.prev())].map(|w| self.places[w]);
            Fit::of([place, across[0], across[1]])
        });
        fan.fold(Fit::BEST, Fit::worse)
    }
}

/// From a point to a triangle.
pub(super) fn distance(p: DVec3, corners: [DVec3; 3]) -> f64 {
    let weights = closest_in_triangle(p, corners);
    p.distance(corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2])
}
