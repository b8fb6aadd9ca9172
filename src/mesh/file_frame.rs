//! The place and the size that a mesh has in its file.
//!
//! Formulas take products of up to six coordinates and differences of near ones, and pictures have 24 bits. So a mesh that is
//! far from the origin, or whose size is far from 1, is moved and scaled when it is checked. Both are exact: the scale is a power
//! of two, and what is subtracted is at most twice and at least half of each coordinate (Sterbenz's lemma), so that the file's
//! coordinates come back bit for bit.

use super::soup::PolygonSoup;
use glam::DVec3;
use std::borrow::Cow;

/// From a mesh's coordinates to those of its file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FileFrame {
    /// The length 1 of the mesh in the file's units: a power of two.
    scale: f64,
    /// The place of the mesh's origin in the file.
    origin: DVec3,
}

impl Default for FileFrame {
    /// The mesh has the coordinates of its file.
    fn default() -> Self {
        Self { scale: 1.0, origin: DVec3::ZERO }
    }
}

/// The usual sizes, which are left alone, lie between one over this and this.
const USUAL_SIZE: f64 = (1 << 20) as f64;
/// The distance of a mesh from the origin, in units of its size, up to which it is left where it is.
const USUAL_DISTANCE: f64 = 1024.0;

impl FileFrame {
    /// The frame with this scale, a power of two, and this origin.
    pub(super) fn new(scale: f64, origin: DVec3) -> Self {
        Self { scale, origin }
    }

    /// The frame of the vertices that polygons use.
    pub(super) fn of(soup: &PolygonSoup) -> Self {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for p in soup.polygons.iter().flatten().filter_map(|v| soup.positions.get(*v as usize)) {
            (low, high) = (low.min(*p), high.max(*p));
        }
        let size = (high - low).max_element();
        if !(size.is_normal() && size.is_sign_positive()) {
            return Self::default();
        }
        let is_usual = (1.0 / USUAL_SIZE..=USUAL_SIZE).contains(&size);
        let middle = 0.5 * low + 0.5 * high;
        let is_far = middle.abs().cmpgt(DVec3::splat(USUAL_DISTANCE * size));
        Self {
            scale: if is_usual { 1.0 } else { power_of_two_below(size) },
            origin: DVec3::select(is_far, middle, DVec3::ZERO),
        }
    }

    /// Whether the mesh has the file's coordinates.
    pub fn is_the_files(&self) -> bool {
        *self == Self::default()
    }

    /// The length 1 of the mesh in the file's units.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// The place of the mesh's origin in the file.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// A place of the mesh as one of the file.
    pub fn in_file(&self, p: DVec3) -> DVec3 {
        p * self.scale + self.origin
    }

    /// A place of the file as one of the mesh.
    pub fn on_mesh(&self, p: DVec3) -> DVec3 {
        (p - self.origin) / self.scale
    }

    /// The polygons with the mesh's coordinates.
    pub(super) fn soup<'a>(&self, soup: &'a PolygonSoup) -> Cow<'a, PolygonSoup> {
        if self.is_the_files() {
            return Cow::Borrowed(soup);
        }
        let positions = soup.positions.iter().map(|p| self.on_mesh(*p)).collect();
        let (polygons, joined_with) = (soup.polygons.clone(), soup.joined_with.clone());
        Cow::Owned(PolygonSoup { positions, polygons, joined_with })
    }
}

/// The largest power of two that is not above a positive normal number.
fn power_of_two_below(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & (0x7ff << 52))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    fn soup(factor: f64, shift: DVec3) -> PolygonSoup {
        let mut random = SplitMix::new(5);
        let mut number = || random.unit() - 0.5;
        let positions = (0..99).map(|_| DVec3::new(number(), number(), number()) * factor + shift).collect();
        let polygons = (0..33).map(|k| vec![3 * k, 3 * k + 1, 3 * k + 2]).collect();
        PolygonSoup { positions, polygons, joined_with: Vec::new() }
    }

    #[test]
    fn the_files_coordinates_come_back_bit_for_bit() {
        let near = DVec3::new(1e8, -3e7, 0.2);
        for (factor, shift) in [
            (1e-90, DVec3::ZERO),
            (1e90, DVec3::ZERO),
            (1.0, near),
            (1e-60, 1e-50 * near),
            (1e-310, DVec3::ZERO),
        ] {
            let soup = soup(factor, shift);
            let frame = FileFrame::of(&soup);
            let moved = frame.soup(&soup);
            for (p, on_mesh) in soup.positions.iter().zip(&moved.positions) {
                assert_eq!(frame.in_file(*on_mesh), *p);
                assert!(factor < 1e-300 || on_mesh.abs().max_element() < 1100.0, "{on_mesh}");
            }
        }
    }

    #[test]
    fn usual_meshes_are_left_alone() {
        for (factor, shift) in [(1.0, DVec3::ZERO), (1000.0, DVec3::splat(5e4)), (0.01, DVec3::X)] {
            assert!(FileFrame::of(&soup(factor, shift)).is_the_files());
        }
        let mut unused = soup(1.0, DVec3::ZERO);
        unused.positions.push(DVec3::splat(1e99));
        assert!(FileFrame::of(&unused).is_the_files());
    }
}
