//! Meshes that are cut by planes, as at a neck.
#![allow(dead_code, reason = "every test binary uses another part")]

use conemap::landmarks::MeshSide;
use conemap::math::scalar::{cos, sin};
use conemap::mesh::check::CheckedMesh;
use conemap::mesh::repair::{RepairOptions, repaired};
use conemap::mesh::soup::PolygonSoup;
use conemap::mesh::{FaceId, SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::MapResult;
use glam::DVec3;
use std::collections::BTreeMap;
use typed_index_collections::TiVec;

/// A plane; points on the side of its normal are beyond it.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    pub point: DVec3,
    pub normal: DVec3,
}

impl Plane {
    /// The plane through the first vertex and the middle of the others that is as perpendicular as possible to the direction from these to
    /// the end; with only one vertex, the plane through it that is perpendicular to that direction.
    pub fn across(mesh: &SurfaceMesh, through: &[u32], end: u32) -> Self {
        let place = |v: u32| mesh.positions()[VertexId(v)];
        let first = place(through[0]);
        let others = &through[1..];
        if others.is_empty() {
            return Self { point: first, normal: (place(end) - first).normalize() };
        }
        let last = others.iter().map(|&v| place(v)).sum::<DVec3>() / others.len() as f64;
        let (point, along) = ((first + last) / 2.0, (last - first).normalize());
        let way = place(end) - point;
        Self { point, normal: (way - along * way.dot(along)).normalize() }
    }

    /// The plane nearest to some points by least squares; its normal points to the side of `end`.
    pub fn nearest(points: &[DVec3], end: DVec3) -> Self {
        let point = points.iter().sum::<DVec3>() / points.len() as f64;
        let mut normal = DVec3::ZERO;
        // The normal is the direction in which the points have the least spread, among 20,000 directions all around.
        let mut least = f64::INFINITY;
        for k in 0..20_000 {
            let z = 1.0 - (k as f64 + 0.5) / 10_000.0;
            let (around, round) = (2.399_963_229_728_653 * k as f64, (1.0 - z * z).max(0.0).sqrt());
            let axis = DVec3::new(round * cos(around), round * sin(around), z);
            let spread: f64 = points.iter().map(|p| (*p - point).dot(axis).powi(2)).sum();
            if spread < least {
                (least, normal) = (spread, axis);
            }
        }
        Self { point, normal: if (end - point).dot(normal) < 0.0 { -normal } else { normal } }
    }

    /// The plane moved along its normal.
    pub fn moved(self, distance: f64) -> Self {
        Self { point: self.point + self.normal * distance, ..self }
    }
}

/// The parts of a mesh that are cut off: for each cut the connected part beyond its plane that holds its end.
pub struct Cuts {
    /// The cut that each vertex is beyond; `None` for vertices that stay with the body.
    beyond: TiVec<VertexId, Option<usize>>,
    /// For each edge that is cut, the place of the cut: the share of the edge from the end with the smaller number.
    shares: BTreeMap<[VertexId; 2], f64>,
}

/// A mesh that was cut.
pub struct CutMesh {
    /// The vertices of the mesh, unused ones too, and after them those of the rims.
    pub soup: PolygonSoup,
    /// The vertices of each edge of the rims.
    pub rim: Vec<[u32; 2]>,
}

/// A mesh that was cut, and capped.
pub struct Open {
    pub cut: CutMesh,
    pub checked: CheckedMesh,
}

/// The part of a mesh that is kept when it is cut: the body, or the ends that the planes cut off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    Body,
    Ends,
}

impl Cuts {
    /// The cuts by planes, each with a vertex beyond it.
    pub fn new(mesh: &SurfaceMesh, planes: &[(Plane, VertexId)]) -> Self {
        let mut beyond: TiVec<VertexId, Option<usize>> = mesh.vertices().map(|_| None).collect();
        for (number, (plane, end)) in planes.iter().enumerate() {
            let height = |v: VertexId| (mesh.positions()[v] - plane.point).dot(plane.normal);
            assert!(height(*end) > 0.0, "the end lies beyond its plane");
            let mut stack = vec![*end];
            beyond[*end] = Some(number);
            while let Some(v) = stack.pop() {
                for w in mesh.star(v).map(|h| mesh.head(h)) {
                    if beyond[w].is_none() && height(w) > 0.0 {
                        beyond[w] = Some(number);
                        stack.push(w);
                    }
                }
            }
        }
        let mut shares = BTreeMap::new();
        for h in mesh.edges() {
            let mut ends = [mesh.tail(h), mesh.head(h)];
            ends.sort_unstable();
            let cut = match ends.map(|v| beyond[v]) {
                [Some(cut), None] | [None, Some(cut)] => cut,
                _ => continue,
            };
            let (plane, _) = planes[cut];
            let [a, b] = ends.map(|v| (mesh.positions()[v] - plane.point).dot(plane.normal));
            // An edge is not cut too near its ends, so that no needles arise.
            shares.insert(ends, (a / (a - b)).clamp(0.05, 0.95));
        }
        Self { beyond, shares }
    }

    /// The images of the rims' vertices under a map of the vertices, as if the map were linear along the edges that are cut.
    pub fn rim_under(&self, image: impl Fn(VertexId) -> DVec3) -> Vec<DVec3> {
        self.shares.iter().map(|([a, b], &share)| image(*a).lerp(image(*b), share)).collect()
    }

    pub fn is_beyond(&self, v: VertexId) -> bool {
        self.beyond[v].is_some()
    }

    /// Whether any corner of a face is beyond a cut.
    pub fn touches(&self, mesh: &SurfaceMesh, f: FaceId) -> bool {
        mesh.triangles()[f].iter().any(|&v| self.is_beyond(v))
    }

    /// Cuts a mesh with the connectivity of the one that the cuts were made for, and divides each edge of a rim into `parts`.
    pub fn cut(&self, mesh: &SurfaceMesh, kept: Kept, parts: u32) -> CutMesh {
        let mut positions: Vec<DVec3> = mesh.positions().iter().copied().collect();
        let mut numbers = BTreeMap::new();
        for (ends, &share) in &self.shares {
            let [a, b] = ends.map(|v| mesh.positions()[v]);
            numbers.insert(*ends, positions.len() as u32);
            positions.push(a.lerp(b, share));
        }
        let is_kept = |v: VertexId| self.is_beyond(v) == (kept == Kept::Ends);
        let (mut polygons, mut rim) = (Vec::new(), Vec::new());
        for corners in mesh.triangles() {
            let mut ring: Vec<u32> = Vec::new();
            for k in 0..3 {
                let (v, w) = (corners[k], corners[(k + 1) % 3]);
                if is_kept(v) {
                    ring.push(v.0);
                }
                if is_kept(v) != is_kept(w) {
                    let mut ends = [v, w];
                    ends.sort_unstable();
                    ring.push(numbers[&ends]);
                }
            }
            if ring.len() < 3 {
                continue;
            }
            let is_new = |v: u32| v as usize >= mesh.vertex_count();
            let edge = (0..ring.len()).find(|&k| is_new(ring[k]) && is_new(ring[(k + 1) % ring.len()]));
            let Some(edge) = edge else {
                polygons.push(ring);
                continue;
            };
            // The edge of the rim from the last vertex to the first.
            let turn = (edge + 1) % ring.len();
            ring.rotate_left(turn);
            let (first, last) = (ring[0], ring[ring.len() - 1]);
            let mut line = vec![last];
            for k in 1..parts {
                let [a, b] = [last, first].map(|v| positions[v as usize]);
                line.push(positions.len() as u32);
                positions.push(a.lerp(b, f64::from(k) / f64::from(parts)));
            }
            line.push(first);
            rim.extend(line.windows(2).map(|ends| [ends[0], ends[1]]));
            if parts == 1 {
                polygons.push(ring);
                continue;
            }
            let apex = ring[1];
            polygons.extend(line.windows(2).map(|ends| vec![apex, ends[0], ends[1]]));
            if ring.len() > 3 {
                polygons.push(ring[1..].to_vec());
            }
        }
        CutMesh { soup: PolygonSoup { positions, polygons, joined_with: Vec::new() }, rim }
    }
}

impl CutMesh {
    /// The vertices of the rims.
    pub fn rim_vertices(&self) -> Vec<u32> {
        let mut vertices: Vec<u32> = self.rim.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    }

    /// The distance of a point from the nearest place of the rims.
    pub fn distance_to_rim(&self, p: DVec3) -> f64 {
        let to_edge = |ends: &[u32; 2]| {
            let [a, b] = ends.map(|v| self.soup.positions[v as usize]);
            let share = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            p.distance(a.lerp(b, share))
        };
        self.rim.iter().map(to_edge).fold(f64::INFINITY, f64::min)
    }
}

impl Open {
    pub fn new(cut: CutMesh) -> Self {
        let repaired = repaired(&cut.soup, &RepairOptions::default(), &mut Silent);
        Self { checked: repaired.expect("a cut mesh can be capped").checked, cut }
    }

    /// The vertex of the capped mesh that corresponds to a vertex of the cut mesh.
    pub fn vertex(&self, v: u32) -> VertexId {
        self.checked.vertex_from_file[v as usize].expect("the vertex was not cut off")
    }
}

/// The distance of the rims' images from the other mesh's rims, in units of the root of that mesh's area: the mean along the rims and the
/// largest value, each for the direction of the map in which it is larger.
pub fn rim_distances(sides: &[Open; 2], result: &MapResult) -> [f64; 2] {
    let map = result.correspondence.as_ref().expect("a map of two meshes has pieces");
    let meshes: [&SurfaceMesh; 2] = [&sides[0].checked.mesh, &sides[1].checked.mesh];
    let mut worst = [0.0_f64; 2];
    for side in MeshSide::BOTH {
        let (own, other) = (&sides[side], &sides[side.other()]);
        let images = map.vertex_images(meshes, side);
        let onto = meshes[side.other()];
        let unit = 1.0 / onto.area().sqrt();
        let far = |v: u32| {
            let image = images[own.vertex(v)].expect("every vertex has an image");
            unit * other.cut.distance_to_rim(image.position(onto))
        };
        let (mut sum, mut length, mut largest) = (0.0, 0.0, 0.0_f64);
        for ends in &own.cut.rim {
            let [a, b] = ends.map(|v| own.cut.soup.positions[v as usize]);
            let [from, to] = ends.map(far);
            sum += 0.5 * (from + to) * a.distance(b);
            length += a.distance(b);
            largest = largest.max(from).max(to);
        }
        worst = [worst[0].max(sum / length), worst[1].max(largest)];
    }
    worst
}
