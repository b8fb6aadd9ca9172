//! The way of the source's shape to the target's, which was laid on the source: every point goes to its image, straight at first, and
//! bent once the bends are known.

use crate::math::bends::{KEYS, weights};
use crate::math::rigid3::{self, Rigid3};
use glam::{DVec3, Mat4, Vec3};
use std::f64::consts::PI;

/// The rigid motion that brings points nearest to their partners in the sense of least squares.
pub fn laid_on(points: &[Vec3], partners: &[Vec3]) -> Mat4 {
    let [points, partners] =
        [points, partners].map(|all| all.iter().map(|p| p.as_dvec3()).collect::<Vec<_>>());
    matrix(&rigid3::laid_on(&points, &partners))
}

/// A rigid motion as a matrix.
pub fn matrix(motion: &Rigid3) -> Mat4 {
    let columns = [0, 1, 2].map(|k| motion.rotation.col(k).as_vec3().extend(0.0));
    Mat4::from_cols(columns[0], columns[1], columns[2], motion.translation.as_vec3().extend(1.0))
}

/// A point's bends and its turn in 24 bytes, where 32767 stands for 1: by key the bend in units of the way's range, and with the first, second
/// and third of them x, y and z of the turn in units of [`TURN_RANGE`].
pub type PackedBends = [[i16; 4]; KEYS.len()];

/// The largest turn that is packed, in radians; beyond it only shading is wrong.
pub const TURN_RANGE: f64 = 4.0 * PI;

/// The weights of the bends at a time from 0 to 1.
pub fn bend_weights(time: f32) -> [f32; KEYS.len()] {
    weights(f64::from(time)).map(|weight| weight as f32)
}

/// The offsets of points from their straight ways, packed for the graphics card.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PackedWay {
    /// The largest coordinate of a bend, in scene units.
    pub range: f32,
    /// The packed bends and turn of each point.
    pub points: Vec<PackedBends>,
}

impl PackedWay {
    /// Packs bends at the [`KEYS`], in scene units, and turns over the whole way, whose direction is the axis and whose length is
    /// the angle in radians; one of each for every point.
    pub fn new(bends: &[[DVec3; KEYS.len()]], turns: &[DVec3]) -> Self {
        let largest = |most: f64, bend: &DVec3| most.max(bend.abs().max_element());
        let range = bends.iter().flatten().fold(0.0, largest).max(f64::from(f32::MIN_POSITIVE)) as f32;
        let share = |value: f64, range: f64| (value / range * f64::from(i16::MAX)).round() as i16;
        let point = |(bends, turn): (&[DVec3; KEYS.len()], &DVec3)| -> PackedBends {
            std::array::from_fn(|k| {
                let [x, y, z] = bends[k].to_array().map(|value| share(value, f64::from(range)));
                [x, y, z, share(turn[k], TURN_RANGE)]
            })
        };
        Self { range, points: bends.iter().zip(turns).map(point).collect() }
    }

    /// The packed bends of a point; zero for a number that no point has.
    pub fn at(&self, point: usize) -> PackedBends {
        self.points.get(point).copied().unwrap_or_default()
    }

    /// The offset of a point of a triangle from its straight way at a time from 0 to 1.
    pub fn bend(&self, corners: [u32; 3], share: [f64; 3], time: f32) -> Vec3 {
        let by_key = weights(f64::from(time));
        let at = |v: u32| -> DVec3 {
            let packed = self.at(v as usize);
            let key = |k: usize| {
                let [x, y, z, _] = packed[k].map(f64::from);
                DVec3::new(x, y, z) * by_key[k]
            };
            (0..KEYS.len()).map(key).sum()
        };
        let sum: DVec3 = (0..3).map(|k| at(corners[k]) * share[k]).sum();
        (sum * (f64::from(self.range) / f64::from(i16::MAX))).as_vec3()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use glam::Quat;

    #[test]
    fn bends_are_unpacked_as_they_were() {
        let bends =
            [[DVec3::X * 3.0, DVec3::Y, DVec3::new(-0.1, 0.2, -3.0)], [DVec3::Z; 3], [DVec3::ZERO; 3]];
        let way = PackedWay::new(&bends, &[DVec3::new(PI, 0.0, -PI), DVec3::ZERO, DVec3::ZERO]);
        assert_eq!(way.range, 3.0);
        assert_eq!(way.points[0].map(|key| key[3]), [8192, 0, -8192]);
        for (k, key) in KEYS.into_iter().enumerate() {
            let there = bends[0][k] * 0.25 + bends[1][k] * 0.75;
            assert!(
                way.bend([0, 1, 2], [0.25, 0.75, 0.0], key as f32).as_dvec3().distance(there) < 1e-4,
                "{key}"
            );
        }
        assert_eq!(way.bend([0, 1, 2], [0.2, 0.3, 0.5], 1.0), Vec3::ZERO);
        // Nothing is packed of a way that is straight.
        assert_eq!(PackedWay::new(&[[DVec3::ZERO; 3]], &[DVec3::ZERO]).points, [[[0; 4]; 3]]);
    }

    #[test]
    fn a_moved_shape_is_found_again_however_it_was_turned() {
        let ball = icosphere(2);
        let shape: Vec<Vec3> = ball
            .positions()
            .iter()
            .map(|p| p.as_vec3() * Vec3::new(1.0, 0.6, 0.3) + 0.1 * p.as_vec3().x.abs())
            .collect();
        for k in 0..12 {
            let angle = 0.55 * k as f32;
            let turn = Quat::from_axis_angle(Vec3::new(1.0, k as f32 - 5.0, 0.3).normalize(), angle);
            let shift = Vec3::new(0.2, -0.4, 1.0);
            let moved: Vec<Vec3> = shape.iter().map(|p| turn * *p + shift).collect();
            let motion = laid_on(&shape, &moved);
            for (p, q) in shape.iter().zip(&moved) {
                assert!(motion.transform_point3(*p).distance(*q) < 1e-4, "{k}");
            }
        }
    }
}
