//! From where a defect is seen.

use super::defect::{Defect, Defects};
use glam::DVec3;

/// From where a defect is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlook {
    /// Its middle, or one of its points.
    pub place: DVec3,
    /// The unit direction from there to the viewer.
    pub normal: DVec3,
    /// The radius of a ball around the place that holds all of the defect.
    pub radius: f64,
}

/// The least length of the mean unit normal of a defect with which it tells a direction. Chosen by hand.
const CLEAR: f64 = 0.3;

impl Defects {
    /// Unit normals at the positions, weighted by area; zero where there is no face.
    pub fn normals(&self) -> Vec<DVec3> {
        let mut normals = vec![DVec3::ZERO; self.positions.len()];
        for triangle in &self.triangles {
            let [p, q, r] = triangle.map(|v| self.positions[v as usize]);
            triangle.iter().for_each(|&v| normals[v as usize] += (q - p).cross(r - p));
        }
        normals.into_iter().map(DVec3::normalize_or_zero).collect()
    }

    /// From where a defect is seen, `normals` being those of [`Self::normals`]; `None` for one without points.
    ///
    /// Its middle from ahead; where the surface goes all around it, as at a handle, its outermost point.
    pub fn outlook(&self, defect: &Defect, normals: &[DVec3]) -> Option<Outlook> {
        let corners = defect.faces.iter().flat_map(|&f| self.triangles[f as usize]);
        let points: Vec<u32> = defect.lines.iter().flatten().copied().chain(corners).collect();
        let at = |v: u32| self.positions[v as usize];
        let count = points.len().max(1) as f64;
        let middle = points.iter().map(|&v| at(v)).sum::<DVec3>() / count;
        let normal = points.iter().map(|&v| normals[v as usize]).sum::<DVec3>() / count;
        let (place, normal) = if normal.length() > CLEAR {
            (middle, normal)
        } else {
            let body = self.middle();
            let from_body = |v: u32| at(v).distance_squared(body);
            let outermost = *points.iter().max_by(|&&a, &&b| from_body(a).total_cmp(&from_body(b)))?;
            let way = at(outermost) - body;
            let normal = normals[outermost as usize];
            // For a surface whose faces look every way, the normal is the way out.
            (at(outermost), if normal.dot(way) > 0.0 { normal } else { way })
        };
        let radius = points.iter().map(|&v| at(v).distance(place)).fold(0.0, f64::max);
        Some(Outlook { place, normal: normal.normalize_or(DVec3::Z), radius })
    }

    /// The middle of all faces' corners.
    fn middle(&self) -> DVec3 {
        let corners = self.triangles.iter().flatten().map(|&v| self.positions[v as usize]);
        corners.sum::<DVec3>() / (3 * self.triangles.len()).max(1) as f64
    }
}
