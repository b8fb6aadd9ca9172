//! Landmarks as users click them: inside the faces beside a vertex.
#![allow(dead_code, reason = "every test binary uses another part")]

use conemap::math::random::SplitMix;
use conemap::mesh::{SurfaceMesh, SurfacePoint};

/// Moves each point, which is a vertex, to a random point of a random face beside it.
pub fn moved(mesh: &SurfaceMesh, points: &[SurfacePoint], random: &mut Random) -> Vec<SurfacePoint> {
    let place = |point: &SurfacePoint| {
        let v = mesh.triangles()[point.face][corner(point)];
        let faces: Vec<_> = mesh.star(v).map(|h| h.face()).collect();
        let face = faces[(random.share() * faces.len() as f64) as usize];
        let (a, b) = (random.share().sqrt(), random.share());
        SurfacePoint { face, barycentric: [1.0 - a, a * (1.0 - b), a * b] }
    };
    points.iter().map(place).collect()
}

/// The corner of its face at which a point lies that is a vertex: 0, 1 or 2.
pub fn corner(vertex: &SurfacePoint) -> usize {
    (0..3).find(|&k| vertex.barycentric[k] > 0.5).expect("a vertex")
}

/// A generator of random clicks.
pub struct Random(SplitMix);

impl Random {
    /// A generator that gives the same numbers for the same seed.
    pub fn new(seed: u64) -> Self {
        // Neighbouring seeds are spread far apart: otherwise the draws of one seed would be those of the next one, shifted.
        Self(SplitMix::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5bf0_3635))
    }

    /// A random number, uniform in [0, 1).
    pub fn share(&mut self) -> f64 {
        self.0.unit()
    }
}
