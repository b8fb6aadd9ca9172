//! Which axis of a mesh's file points up.

use glam::{Mat3, Quat, Vec3};
use serde::{Deserialize, Serialize};

/// The axis of a mesh that points up on the screen.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub enum UpAxis {
    /// Along +x.
    #[serde(rename = "x")]
    X,
    /// Along -x.
    #[serde(rename = "-x")]
    MinusX,
    /// Along +y.
    #[default]
    #[serde(rename = "y")]
    Y,
    /// Along -y.
    #[serde(rename = "-y")]
    MinusY,
    /// Along +z.
    #[serde(rename = "z")]
    Z,
    /// Along -z.
    #[serde(rename = "-z")]
    MinusZ,
}

impl UpAxis {
    /// All six axes.
    pub const ALL: [Self; 6] = [Self::X, Self::MinusX, Self::Y, Self::MinusY, Self::Z, Self::MinusZ];

    /// The direction of the axis, of length 1.
    pub fn direction(self) -> Vec3 {
        match self {
            Self::X => Vec3::X,
            Self::MinusX => Vec3::NEG_X,
            Self::Y => Vec3::Y,
            Self::MinusY => Vec3::NEG_Y,
            Self::Z => Vec3::Z,
            Self::MinusZ => Vec3::NEG_Z,
        }
    }

    /// The direction to a viewer who sees the front: +z, but -y where z is up and y where it is down, as modelling programs have it.
    pub fn front(self) -> Vec3 {
        match self {
            Self::X | Self::MinusX | Self::Y | Self::MinusY => Vec3::Z,
            Self::Z => Vec3::NEG_Y,
            Self::MinusZ => Vec3::Y,
        }
    }

    /// Turns right, up and front, given as x, y and z, to the mesh's axes.
    pub fn basis(self) -> Quat {
        let (up, front) = (self.direction(), self.front());
        Quat::from_mat3(&Mat3::from_cols(up.cross(front), up, front))
    }

    /// The axis nearest to a direction.
    pub fn nearest(direction: Vec3) -> Self {
        let along = |axis: &Self| axis.direction().dot(direction);
        Self::ALL.into_iter().max_by(|a, b| along(a).total_cmp(&along(b))).unwrap_or_default()
    }

    /// The same axis the other way.
    pub fn reversed(self) -> Self {
        match self {
            Self::X => Self::MinusX,
            Self::MinusX => Self::X,
            Self::Y => Self::MinusY,
            Self::MinusY => Self::Y,
            Self::Z => Self::MinusZ,
            Self::MinusZ => Self::Z,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_basis_is_a_turn_that_takes_y_up_and_z_to_the_front() {
        for axis in UpAxis::ALL {
            let basis = axis.basis();
            assert!((basis.length() - 1.0).abs() < 1e-6);
            assert!((basis * Vec3::Y).distance(axis.direction()) < 1e-6);
            assert!((basis * Vec3::Z).distance(axis.front()) < 1e-6);
            assert_eq!(axis.reversed().direction(), -axis.direction());
            assert_eq!(UpAxis::nearest(axis.direction() + 0.3 * axis.front() + Vec3::splat(0.1)), axis);
        }
        assert_eq!(UpAxis::Y.basis(), Quat::IDENTITY);
    }

    #[test]
    fn the_names_are_those_of_the_page() {
        let names = UpAxis::ALL.map(|axis| serde_json::to_string(&axis).unwrap());
        assert_eq!(names, [r#""x""#, r#""-x""#, r#""y""#, r#""-y""#, r#""z""#, r#""-z""#]);
    }
}
