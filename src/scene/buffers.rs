//! Vertex data, centred and scaled to radius 1.

use super::morph::PackedBends;
use super::shading::Shading;
use crate::mesh::generators::icosphere;
use crate::mesh::{SurfaceMesh, VertexId};
use glam::{DVec3, Vec3};

/// A vertex of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct SurfaceVertex {
    /// Position, in scene coordinates.
    pub position: [f32; 3],
    /// Unit normal.
    pub normal: [f32; 3],
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// A place on the scale of colours, from 0 to 1.
    pub scale_place: f32,
    /// The place on the target that the map takes it to, in the target's scene coordinates.
    pub image: [f32; 3],
    /// The target's unit normal there.
    pub image_normal: [f32; 3],
    /// The degree to which the vertex lies in a hollow (positive) or on a ridge (negative), from -1 to 1.
    pub hollow: f32,
    /// The vertex's colour in a look, red, green and blue as a screen shows them; the fourth number is 255 where the picture is
    /// laid on it, or else 0.
    pub tint: [u8; 4],
    /// The offset of the vertex from its straight way to the image, and its rotation there.
    pub bends: PackedBends,
}

/// A corner of the ribbon that draws a line segment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct LineVertex {
    /// This end of the segment.
    pub position: [f32; 3],
    /// The other end.
    pub other: [f32; 3],
    /// Which side of the direction to the other end: positive or negative; of size 1 at the segment's begin and 2 at its end, where
    /// that direction is reversed.
    pub side: f32,
}

/// A mark over the picture: a pin, or a ring around a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct PinInstance {
    /// The place, in scene coordinates.
    pub base: [f32; 3],
    /// Linear red, green, blue.
    pub colour: [f32; 3],
    /// Radius of the head or the ring, in pixels.
    pub radius: f32,
    /// From the place to the middle of the head, in pixels.
    pub stem: f32,
    /// The style of the pin: 0 full, 1 an outline, 2 a ring.
    pub kind: f32,
}

/// A ball.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct MarkerInstance {
    /// Centre, in scene coordinates.
    pub centre: [f32; 3],
    /// Radius, in scene units.
    pub radius: f32,
    /// Linear red, green, blue.
    pub colour: [f32; 3],
}

/// The way from input coordinates to scene coordinates: a shift and a scaling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    centre: DVec3,
    scale: f64,
}

impl Frame {
    /// Centres the bounding box and scales the farthest vertex to distance 1.
    pub fn of(mesh: &SurfaceMesh) -> Self {
        Self::around(mesh.positions().iter().copied())
    }

    /// The frame of any points, centred and scaled in the same way.
    pub fn around(points: impl Iterator<Item = DVec3> + Clone) -> Self {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = points.clone().fold(start, |(l, h), p| (l.min(p), h.max(p)));
        let centre = 0.5 * (low + high);
        let radius = points.map(|p| p.distance(centre)).fold(0.0, f64::max);
        Self { centre, scale: 1.0 / radius.max(f64::MIN_POSITIVE) }
    }

    /// A point in scene coordinates.
    pub fn place(&self, p: DVec3) -> Vec3 {
        self.exact_place(p).as_vec3()
    }

    /// A point in scene coordinates, in full precision.
    pub fn exact_place(&self, p: DVec3) -> DVec3 {
        (p - self.centre) * self.scale
    }

    /// A scene point in input coordinates.
    pub fn unplace(&self, p: Vec3) -> DVec3 {
        p.as_dvec3() / self.scale + self.centre
    }
}

/// Vertices of one kind, and which of them make triangles, three by three.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles<V> {
    /// The vertices.
    pub vertices: Vec<V>,
    /// Triples of vertices.
    pub indices: Vec<u32>,
}

/// A plain mesh with smooth normals; each vertex is its own image.
pub fn surface(mesh: &SurfaceMesh, shading: &Shading, frame: &Frame) -> Triangles<SurfaceVertex> {
    let vertex = |v: VertexId| {
        let position = frame.place(mesh.positions()[v]).to_array();
        let normal = shading.normals[v.index()];
        SurfaceVertex {
            position,
            normal,
            uv: [0.0; 2],
            image: position,
            image_normal: normal,
            hollow: shading.hollows[v.index()],
            ..SurfaceVertex::default()
        }
    };
    let indices = mesh.triangles().iter().flatten().map(|v| v.0).collect();
    Triangles { vertices: mesh.vertices().map(vertex).collect(), indices }
}

/// Triangles of points, each in its own light.
pub fn facets(points: &[Vec3], triangles: &[[u32; 3]]) -> Triangles<SurfaceVertex> {
    let corners = |triangle: &[u32; 3]| {
        let [p, q, r] = triangle.map(|v| points[v as usize]);
        let normal = (q - p).cross(r - p).normalize_or(Vec3::Z).to_array();
        [p, q, r].map(|position| SurfaceVertex {
            position: position.to_array(),
            normal,
            ..SurfaceVertex::default()
        })
    };
    let vertices: Vec<SurfaceVertex> = triangles.iter().flat_map(corners).collect();
    let indices = (0..vertices.len() as u32).collect();
    Triangles { vertices, indices }
}

/// The edges of a closed mesh, each once.
pub fn edges(points: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec<Vec3>> {
    let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    // On a closed mesh each edge is run once in either direction.
    sides.filter(|[a, b]| a < b).map(|side| side.map(|v| points[v as usize]).to_vec()).collect()
}

/// Ribbons along line strips: four vertices and six indices a segment.
pub fn ribbons(strips: &[Vec<Vec3>]) -> Triangles<LineVertex> {
    let (mut vertices, mut indices) = (Vec::new(), Vec::new());
    for segment in strips.iter().flat_map(|strip| strip.windows(2)) {
        let [a, b] = [segment[0].to_array(), segment[1].to_array()];
        let first = vertices.len() as u32;
        for (position, other, side) in [(a, b, 1.0), (a, b, -1.0), (b, a, -2.0), (b, a, 2.0)] {
            vertices.push(LineVertex { position, other, side });
        }
        indices.extend([0, 1, 2, 2, 1, 3].map(|k| first + k));
    }
    Triangles { vertices, indices }
}

/// The unit ball; its vertices are places.
pub fn unit_ball() -> Triangles<[f32; 3]> {
    let sphere = icosphere(2);
    let vertices = sphere.positions().iter().map(|p| p.as_vec3().to_array()).collect();
    Triangles { vertices, indices: sphere.triangles().iter().flatten().map(|v| v.0).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frame_is_invertible_and_bounds_the_mesh() {
        let sphere = icosphere(2);
        let moved =
            sphere.with_positions(sphere.positions().iter().map(|p| *p * 40.0 + DVec3::splat(7.0)).collect());
        let frame = Frame::of(&moved);
        for p in moved.positions() {
            let placed = frame.place(*p);
            assert!(placed.length() <= 1.0 + 1e-6);
            assert!(frame.unplace(placed).distance(*p) < 1e-4);
        }
        let Triangles { vertices, indices } = surface(&moved, &Shading::of(&moved), &frame);
        assert_eq!((vertices.len(), indices.len()), (162, 960));
    }

    #[test]
    fn facets_are_the_triangles_and_edges_their_sides() {
        let sphere = icosphere(2);
        let points: Vec<Vec3> = sphere.positions().iter().map(|p| p.as_vec3()).collect();
        let triangles: Vec<[u32; 3]> = sphere.triangles().iter().map(|t| t.map(|v| v.0)).collect();
        let Triangles { vertices, indices } = facets(&points, &triangles);
        assert_eq!((vertices.len(), indices.len()), (960, 960));
        for corner in &vertices {
            // The normal of a small triangle of the unit ball is nearly its place.
            assert!(Vec3::from_array(corner.normal).dot(Vec3::from_array(corner.position)) > 0.95);
        }
        assert_eq!(edges(&points, &triangles).len(), 480);
    }

    #[test]
    fn a_strip_of_three_points_has_two_ribbons() {
        let Triangles { vertices, indices } = ribbons(&[vec![Vec3::ZERO, Vec3::X, Vec3::ONE]]);
        assert_eq!((vertices.len(), indices.len()), (8, 12));
    }
}
