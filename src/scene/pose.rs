//! The pose of a camera, and its projection.

use glam::{Mat4, Quat, Vec2, Vec3, Vec4};

/// Vertical angle of a wide view, in radians: 34 degrees, with little perspective.
const FIELD_OF_VIEW: f32 = 0.6;

/// The pose of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Turns the camera's axes, which are right, up and back to the viewer, to the scene's.
    pub turn: Quat,
    /// The point in the middle of the view.
    pub target: Vec3,
    /// Distance from the eye to the target.
    pub distance: f32,
}

/// A line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The point where the ray enters the view's depth.
    pub origin: Vec3,
    /// Unit direction.
    pub direction: Vec3,
}

impl Pose {
    /// The place of the eye.
    pub fn eye(&self) -> Vec3 {
        self.target + self.distance * self.back()
    }

    /// Right on the screen, of length 1.
    pub fn right(&self) -> Vec3 {
        self.turn * Vec3::X
    }

    /// Up on the screen, of length 1.
    pub fn up(&self) -> Vec3 {
        self.turn * Vec3::Y
    }

    /// From the screen to the viewer, of length 1.
    pub fn back(&self) -> Vec3 {
        self.turn * Vec3::Z
    }

    /// World to clip space; depth 0 to 1. `aspect` is the view's width by its height.
    pub fn view_projection(&self, aspect: f32) -> Mat4 {
        // A tall view must still hold the whole surface.
        let field = 2.0 * half_height(aspect).atan();
        // The far plane lies behind the surface, of radius 1, wherever the target is moved (3 at most).
        let near = 0.02 * self.distance;
        let projection =
            glam::camera::rh::proj::directx::perspective(field, aspect, near, self.distance + 10.0);
        projection * Mat4::from_rotation_translation(self.turn, self.eye()).inverse()
    }

    /// The ray through a point of the view. `at` runs from (-1, -1) bottom left to (1, 1).
    pub fn ray(&self, at: Vec2, aspect: f32) -> Ray {
        let inverse = self.view_projection(aspect).inverse();
        let unproject = |depth: f32| {
            let p = inverse * Vec4::new(at.x, at.y, depth, 1.0);
            p.truncate() / p.w
        };
        let origin = unproject(0.0);
        Ray { origin, direction: (unproject(1.0) - origin).normalize() }
    }

    /// The place of a point in the view, from (-1, -1) to (1, 1), with its depth; `None` behind the camera.
    pub fn project(&self, p: Vec3, aspect: f32) -> Option<Vec3> {
        let clip = self.view_projection(aspect) * p.extend(1.0);
        (clip.w > 0.0).then(|| clip.truncate() / clip.w)
    }

    /// The point that is seen at `at` in the plane through the target, parallel to the screen.
    pub fn in_target_plane(&self, at: Vec2, aspect: f32) -> Vec3 {
        let half = self.distance * half_height(aspect);
        self.target + (self.right() * at.x * aspect + self.up() * at.y) * half
    }

    /// Height of the view where a point is, in scene units.
    pub fn height_at(&self, p: Vec3, aspect: f32) -> f32 {
        2.0 * (self.eye() - p).dot(self.back()).max(0.0) * half_height(aspect)
    }
}

/// Half the height of the view at distance 1.
fn half_height(aspect: f32) -> f32 {
    (0.5 * FIELD_OF_VIEW).tan() / aspect.min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose() -> Pose {
        let turn = Quat::from_rotation_y(0.7) * Quat::from_rotation_x(-0.3) * Quat::from_rotation_z(0.4);
        Pose { turn, target: Vec3::new(0.1, -0.2, 0.3), distance: 3.0 }
    }

    #[test]
    fn the_ray_through_a_projected_point_meets_it() {
        let p = Vec3::new(0.3, -0.4, 0.5);
        for aspect in [0.5, 1.7] {
            let seen = pose().project(p, aspect).unwrap();
            let Ray { origin, direction } = pose().ray(seen.truncate(), aspect);
            assert!((p - origin).cross(direction).length() < 1e-3);
        }
    }

    #[test]
    fn points_of_the_target_plane_are_seen_where_they_were_asked_for() {
        for aspect in [0.5, 1.7] {
            for at in [Vec2::ZERO, Vec2::new(0.6, -0.8)] {
                let p = pose().in_target_plane(at, aspect);
                assert!(pose().project(p, aspect).unwrap().truncate().distance(at) < 1e-4);
                assert!((p - pose().target).dot(pose().back()).abs() < 1e-5);
            }
            // The plane is as high as the distance between the middles of its lower and its upper edge.
            let edge = |y: f32| pose().in_target_plane(Vec2::new(0.0, y), aspect);
            assert!((pose().height_at(pose().target, aspect) - edge(-1.0).distance(edge(1.0))).abs() < 1e-4);
        }
    }

    #[test]
    fn the_eye_sees_the_target_in_the_middle() {
        let seen = pose().project(pose().target, 1.3).unwrap();
        assert!(seen.truncate().length() < 1e-5 && (0.0..1.0).contains(&seen.z));
        assert!((pose().eye().distance(pose().target) - 3.0).abs() < 1e-5);
    }
}
