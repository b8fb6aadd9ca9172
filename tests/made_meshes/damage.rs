//! Random faults of meshes, by seed.

use conemap::math::random::SplitMix;
use conemap::mesh::SurfaceMesh;
use conemap::mesh::generators::{icosphere, octahedron, tetrahedron, torus};
use conemap::mesh::soup::PolygonSoup;
use glam::DVec3;

/// Adds the vertices, moved by `place`, and polygons of another soup.
pub fn add(soup: &mut PolygonSoup, other: &PolygonSoup, place: impl Fn(DVec3) -> DVec3) {
    let first = soup.positions.len() as u32;
    soup.positions.extend(other.positions.iter().map(|&p| place(p)));
    soup.polygons.extend(other.polygons.iter().map(|p| p.iter().map(|v| v + first).collect::<Vec<_>>()));
}

/// Removes all polygons that have a corner within a distance of a place.
pub fn punch(soup: &mut PolygonSoup, place: DVec3, radius: f64) {
    let positions = &soup.positions;
    soup.polygons.retain(|p| !p.iter().any(|&v| positions[v as usize].distance(place) < radius));
}

/// A source of random faults of polygon soups.
pub struct Damage(SplitMix);

impl Damage {
    /// The source of a seed.
    pub fn new(seed: u64) -> Self {
        Self(SplitMix::new(seed))
    }

    /// A whole number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.0.unit() * n as f64) as usize).min(n - 1)
    }

    /// True with this probability.
    pub fn chance(&mut self, share: f64) -> bool {
        self.0.unit() < share
    }

    /// A small good mesh; one in six is of genus 1.
    fn mesh(&mut self) -> SurfaceMesh {
        match self.below(6) {
            0 => octahedron(),
            1 => icosphere(1),
            2 => torus(5 + self.below(9), 4 + self.below(6)),
            _ => icosphere(2),
        }
    }

    fn holes(&mut self, soup: &mut PolygonSoup) {
        for _ in 0..self.below(4) {
            let at = soup.positions[self.below(soup.positions.len())];
            let radius = 0.6 * self.0.unit();
            punch(soup, at, radius);
        }
    }

    fn missing_faces(&mut self, soup: &mut PolygonSoup) {
        let share = 0.1 * self.0.unit();
        soup.polygons.retain(|_| !self.chance(share));
    }

    fn turned_patches(&mut self, soup: &mut PolygonSoup) {
        let at = soup.positions[self.below(soup.positions.len())];
        let radius = 1.5 * self.0.unit();
        for polygon in &mut soup.polygons {
            if soup.positions[polygon[0] as usize].distance(at) < radius {
                polygon.reverse();
            }
        }
    }

    fn doubled_faces(&mut self, soup: &mut PolygonSoup) {
        for _ in 0..self.below(6) {
            if !soup.polygons.is_empty() {
                let mut copy = soup.polygons[self.below(soup.polygons.len())].clone();
                if self.chance(0.5) {
                    copy.reverse();
                }
                soup.polygons.push(copy);
            }
        }
    }

    /// Merges random vertices.
    fn pinches(&mut self, soup: &mut PolygonSoup) {
        for _ in 0..self.below(3) {
            let [a, b] = [0; 2].map(|_| self.below(soup.positions.len()) as u32);
            soup.polygons.iter_mut().flatten().filter(|v| **v == a).for_each(|v| *v = b);
        }
    }

    /// Gives some polygons vertices of their own.
    fn torn_faces(&mut self, soup: &mut PolygonSoup) {
        let share = self.0.unit();
        for k in 0..soup.polygons.len() {
            if self.chance(share) {
                for c in 0..3 {
                    let v = soup.polygons[k][c] as usize;
                    soup.polygons[k][c] = soup.positions.len() as u32;
                    soup.positions.push(soup.positions[v]);
                }
            }
        }
    }

    fn specks(&mut self, soup: &mut PolygonSoup) {
        let at = soup.positions[self.below(soup.positions.len())];
        add(soup, &PolygonSoup::from(&tetrahedron()), |p| at * 1.5 + 0.02 * p);
    }

    /// Divides faces at the middle of an edge whose neighbour on the other side stays whole, and adds the face without area between them.
    fn corners_on_edges(&mut self, soup: &mut PolygonSoup) {
        for _ in 0..1 + self.below(3) {
            if soup.polygons.is_empty() {
                return;
            }
            let k = self.below(soup.polygons.len());
            let [a, b, c] = soup.polygons[k][..] else { return };
            let middle = soup.positions.len() as u32;
            soup.positions.push(0.5 * (soup.positions[a as usize] + soup.positions[b as usize]));
            soup.polygons[k] = vec![a, middle, c];
            soup.polygons.extend([vec![middle, b, c], vec![a, b, middle]]);
        }
    }

    /// Adds a face on three random vertices, such as a wall across the inside.
    fn walls(&mut self, soup: &mut PolygonSoup) {
        let corners = [0; 3].map(|_| self.below(soup.positions.len()) as u32);
        soup.polygons.push(corners.to_vec());
    }

    /// The soup of a small mesh with one to four faults.
    pub fn soup(&mut self) -> PolygonSoup {
        let mut soup = PolygonSoup::from(&self.mesh());
        let faults = 1 + self.below(4);
        self.break_it(&mut soup, faults);
        soup
    }

    /// Adds a number of faults to a soup of triangles around the origin.
    pub fn break_it(&mut self, soup: &mut PolygonSoup, faults: usize) {
        let kinds: [fn(&mut Self, &mut PolygonSoup); 9] = [
            Self::holes,
            Self::missing_faces,
            Self::turned_patches,
            Self::doubled_faces,
            Self::pinches,
            Self::torn_faces,
            Self::specks,
            Self::corners_on_edges,
            Self::walls,
        ];
        for _ in 0..faults {
            kinds[self.below(kinds.len())](self, soup);
        }
    }
}
