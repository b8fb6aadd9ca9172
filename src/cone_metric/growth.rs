//! A flat cone metric laid out in the plane by region growing (thesis fig. 3.8): from a seed face over the whole surface, each face
//! isometrically beside one that is there.
//!
//! Where the grown region meets itself both sides agree, unless they enclose a cone. The edges across which no face was placed form a tree
//! that spans the vertices of a sphere; without its branches that end at no cone it joins the cones, and the layout is cut along it.
//! The tree is found by counting alone: near a nearly flat cone the two sides of the cut differ by less than rounding.

use super::atlas::{Development, develop, mesh_displacements};
use super::metric::ConeMetric;
use crate::math::scalar::exp;
use crate::math::triangle::{area_from_lengths, signed_double_area};
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use glam::DVec2;
use typed_index_collections::{TiVec, ti_vec};

/// A cone with less curvature than this, in radians, is flat: the flow ends with errors below 1e-8.
const FLAT: f64 = 1e-6;

/// A mesh with a flat cone metric of area 1, to be laid out from any of its faces.
#[derive(Clone, Debug)]
pub struct FlatSurface {
    /// The displacement along each halfedge of the mesh, in a frame of its face.
    along: TiVec<HalfedgeId, DVec2>,
    /// Radius of each vertex's circle; the circles at both ends of an edge with inversive distance 1 touch.
    radii: TiVec<VertexId, f64>,
    is_cone: TiVec<VertexId, bool>,
}

/// A mesh in the plane.
#[derive(Clone, Debug)]
pub struct PlaneLayout {
    /// Points of the plane; a vertex on the cut has several.
    pub points: Vec<DVec2>,
    /// The vertex at each of these points.
    pub vertices: Vec<VertexId>,
    /// The number of the point at which each halfedge starts in its face.
    pub corners: TiVec<HalfedgeId, u32>,
    /// The faces in the order in which they were placed.
    pub order: Vec<FaceId>,
    /// The number, in that order, of the first face of each ring around the seed, and one past the end.
    pub rings: Vec<usize>,
    /// Whether the layout is cut along the edge; twins agree.
    pub cut: TiVec<HalfedgeId, bool>,
    /// Faces that lie turned over: straight edges of the mesh cross there in the flat metric.
    pub inverted_faces: usize,
}

impl FlatSurface {
    /// The flat surface of a metric, scaled to area 1; vertices with a target curvature (radians) other than 0 are cones.
    pub fn new(metric: &ConeMetric, target_curvature: &TiVec<VertexId, f64>) -> Self {
        let lengths = metric.lengths();
        let area: f64 = metric
            .triangulation
            .faces()
            .map(|f| {
                let [a, b, c] = f.halfedges().map(|h| lengths[h]);
                area_from_lengths(a, b, c)
            })
            .sum();
        let scale = 1.0 / area.sqrt();
        Self {
            along: mesh_displacements(metric).into_iter().map(|d| d * scale).collect(),
            radii: metric.log_radii.iter().map(|&u| exp(u) * scale).collect(),
            is_cone: target_curvature.iter().map(|k| k.abs() > FLAT).collect(),
        }
    }

    /// Radius of each vertex's circle, in the units of the plane.
    pub fn radii(&self) -> &TiVec<VertexId, f64> {
        &self.radii
    }

    /// Lays the whole mesh out in the plane, grown from a face.
    pub fn grown_from(&self, mesh: &SurfaceMesh, seed: FaceId) -> PlaneLayout {
        let uncut = ti_vec![false; self.along.len()];
        let Development { corners: places, order, rings, joined } = develop(mesh, &self.along, &uncut, seed);
        let cut = self.cut_beside(mesh, &joined);
        let mut layout = PlaneLayout {
            points: Vec::with_capacity(mesh.vertex_count()),
            vertices: Vec::with_capacity(mesh.vertex_count()),
            corners: ti_vec![u32::MAX; places.len()],
            order,
            rings,
            cut,
            inverted_faces: 0,
        };
        for k in 0..layout.order.len() {
            let halfedges = layout.order[k].halfedges();
            let [p, q, r] = halfedges.map(|h| places[h]);
            layout.inverted_faces += usize::from(signed_double_area(p, q, r) <= 0.0);
            for h in halfedges {
                layout.number(mesh, h, &places);
            }
        }
        layout
    }

    /// The edges that no face was placed across, without the branches that end at no cone.
    fn cut_beside(&self, mesh: &SurfaceMesh, joined: &TiVec<HalfedgeId, bool>) -> TiVec<HalfedgeId, bool> {
        let mut cut: TiVec<HalfedgeId, bool> = joined.iter().map(|&is_joined| !is_joined).collect();
        let mut degrees: TiVec<VertexId, u32> = ti_vec![0; mesh.vertex_count()];
        mesh.halfedges().filter(|&h| cut[h]).for_each(|h| degrees[mesh.tail(h)] += 1);
        let is_end = |degrees: &TiVec<VertexId, u32>, v: VertexId| degrees[v] == 1 && !self.is_cone[v];
        let mut ends: Vec<VertexId> = mesh.vertices().filter(|&v| is_end(&degrees, v)).collect();
        while let Some(v) = ends.pop() {
            let Some(h) = mesh.star(v).find(|&h| cut[h]) else { continue };
            (cut[h], cut[mesh.twin(h)]) = (false, false);
            let next = mesh.head(h);
            degrees[v] -= 1;
            degrees[next] -= 1;
            if is_end(&degrees, next) {
                ends.push(next);
            }
        }
        cut
    }
}

impl PlaneLayout {
    /// Gives the corner at a halfedge's start, and all corners around its vertex up to the cut, one number.
    fn number(&mut self, mesh: &SurfaceMesh, h: HalfedgeId, places: &TiVec<HalfedgeId, DVec2>) {
        if self.corners[h] != u32::MAX {
            return;
        }
        let number = self.points.len() as u32;
        self.points.push(places[h]);
        self.vertices.push(mesh.tail(h));
        // Counter-clockwise over the last edge of each face, then clockwise over the first.
        let mut g = h;
        loop {
            self.corners[g] = number;
            let over = g.prev();
            g = mesh.twin(over);
            if self.cut[over] || self.corners[g] != u32::MAX {
                break;
            }
        }
        let mut g = h;
        while !self.cut[g] {
            g = mesh.twin(g).next();
            if self.corners[g] != u32::MAX {
                break;
            }
            self.corners[g] = number;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cone_metric::{FlowOptions, flow, uniform_curvature};
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;
    use glam::DVec3;

    #[test]
    fn from_every_seed_the_layout_is_isometric_and_cut_along_a_tree_that_joins_the_cones() {
        let sphere = icosphere(3);
        let squash = |p: &DVec3| DVec3::new(p.x * 2.5, p.y, p.z * (0.3 + 0.2 * p.x));
        let mesh = sphere.with_positions(sphere.positions().iter().map(squash).collect());
        let cones = [0, 40, 300, 500, 641].map(VertexId);
        let target = uniform_curvature(mesh.vertex_count(), &cones);
        let (metric, _) = flow(&mesh, &target, &FlowOptions::default(), &mut Silent).unwrap();
        let surface = FlatSurface::new(&metric, &target);
        for seed in [0, 77, 600, 1279].map(FaceId) {
            let layout = surface.grown_from(&mesh, seed);
            assert_eq!(layout.order[0], seed);
            assert_eq!(layout.rings[..2], [0, 1]);
            assert_eq!(layout.rings.last(), Some(&mesh.face_count()));
            let mut faces = layout.order.clone();
            faces.sort_unstable();
            assert!(faces.iter().copied().eq(mesh.faces()));

            let at = |h: HalfedgeId| layout.points[layout.corners[h] as usize];
            for h in mesh.halfedges() {
                assert_eq!(layout.vertices[layout.corners[h] as usize], mesh.tail(h));
                // One number stands for every place of the corners that share it.
                assert!((at(h).distance(at(h.next())) - surface.along[h].length()).abs() < 1e-6);
                let t = mesh.twin(h);
                let is_one = layout.corners[h] == layout.corners[t.next()];
                assert!(is_one || layout.cut[h], "joined edges have one place");
            }
            // A tree with the cones as its only ends: the sphere without it is a disk.
            let degree = |v: VertexId| mesh.star(v).filter(|&h| layout.cut[h]).count();
            let ends: Vec<_> = mesh.vertices().filter(|&v| degree(v) == 1).collect();
            assert!(ends.iter().all(|v| cones.contains(v)));
            assert!(cones.iter().all(|&v| degree(v) > 0));
            let edges = mesh.edges().filter(|&h| layout.cut[h]).count();
            let vertices = mesh.vertices().filter(|&v| degree(v) > 0).count();
            assert_eq!(edges + 1, vertices);
            assert_eq!(layout.points.len(), mesh.vertex_count() - vertices + 2 * edges);

            let doubled: f64 = mesh
                .faces()
                .map(|f| {
                    let [p, q, r] = f.halfedges().map(at);
                    signed_double_area(p, q, r)
                })
                .sum();
            assert!((0.5 * doubled - 1.0).abs() < 1e-6);
        }
    }
}
