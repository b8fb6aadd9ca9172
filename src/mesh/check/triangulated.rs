//! Polygons cut into triangles.

use super::fault::{Elements, MAX_FACES, MeshFault};
use crate::math::triangle;
use crate::mesh::polygon::triangulate;
use crate::mesh::soup::PolygonSoup;
use glam::DVec3;

/// A triangle by three vertices of the file.
pub(crate) type Triangle = [u32; 3];

/// Triangles, and the polygon that each comes from.
///
/// # Errors
/// [`MeshFault::Empty`] or [`MeshFault::TooManyFaces`].
pub(crate) fn triangulated(soup: &PolygonSoup) -> Result<(Vec<Triangle>, Vec<usize>), MeshFault> {
    let faces: usize = soup.polygons.iter().map(|p| p.len().saturating_sub(2)).sum();
    if faces == 0 {
        return Err(MeshFault::Empty);
    }
    if faces > MAX_FACES {
        return Err(MeshFault::TooManyFaces { faces });
    }
    let (mut triangles, mut polygon_of) = (Vec::with_capacity(faces), Vec::with_capacity(faces));
    for (f, polygon) in soup.polygons.iter().enumerate() {
        triangulate(&soup.positions, polygon, &mut triangles);
        polygon_of.resize(triangles.len(), f);
    }
    Ok((triangles, polygon_of))
}

pub(super) fn check_degenerate(
    soup: &PolygonSoup,
    triangles: &[Triangle],
    polygon_of: &[usize],
) -> Result<(), MeshFault> {
    let degenerate = |t: &Triangle| is_degenerate(&soup.positions, t);
    let found = triangles.iter().enumerate().filter(|(_, t)| degenerate(t)).map(|(k, _)| polygon_of[k]);
    let faults: Elements<usize> = found.collect();
    if faults.count > 0 { Err(MeshFault::DegenerateFaces(faults)) } else { Ok(()) }
}

/// Whether a triangle has a vertex twice or no area.
pub(in crate::mesh) fn is_degenerate(positions: &[DVec3], t: &Triangle) -> bool {
    let [p, q, r] = t.map(|v| positions[v as usize]);
    let longest = p.distance_squared(q).max(q.distance_squared(r)).max(r.distance_squared(p));
    // A height below 2e-14 of the longest edge is a rounding of the coordinates.
    t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || triangle::area(p, q, r) <= 1e-14 * longest
}
