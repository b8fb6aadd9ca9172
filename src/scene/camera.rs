//! An orbiting camera over a surface that is centred at the origin and scaled to radius 1.

use glam::{Mat4, Vec2, Vec3, Vec4};

/// Vertical angle of a wide view, in radians: 34 degrees, with little perspective.
const FIELD_OF_VIEW: f32 = 0.6;

/// Looks at a target from a direction given by two angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Angle around the vertical, in radians.
    pub yaw: f32,
    /// Angle above the horizon, in radians, within +-1.5.
    pub pitch: f32,
    /// Distance from the target.
    pub distance: f32,
    /// The point looked at.
    pub target: Vec3,
}

/// A line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it enters the view's depth.
    pub origin: Vec3,
    /// Unit direction.
    pub direction: Vec3,
}

impl Default for Camera {
    fn default() -> Self {
        // From ahead, a little from the right and from above; from 4 radii the whole unit ball is seen.
        Self { yaw: 0.6, pitch: 0.25, distance: 4.0, target: Vec3::ZERO }
    }
}

impl Camera {
    /// Where the camera is.
    pub fn eye(&self) -> Vec3 {
        let (sin_yaw, cos_yaw) = self.yaw.sin_cos();
        let (sin_pitch, cos_pitch) = self.pitch.sin_cos();
        self.target + self.distance * Vec3::new(sin_yaw * cos_pitch, sin_pitch, cos_yaw * cos_pitch)
    }

    /// World to clip space; depth 0 to 1.
    pub fn view_projection(&self, aspect: f32) -> Mat4 {
        // A tall view must still hold the whole surface.
        let field = 2.0 * ((0.5 * FIELD_OF_VIEW).tan() / aspect.min(1.0)).atan();
        // The far plane lies behind the surface, of radius 1, wherever the target is moved (3 at most).
        let near = 0.02 * self.distance;
        let projection =
            glam::camera::rh::proj::directx::perspective(field, aspect, near, self.distance + 10.0);
        projection * glam::camera::rh::view::look_at_mat4(self.eye(), self.target, Vec3::Y)
    }

    /// Moves and comes near enough that the points fill the given share of the view; the direction stays.
    pub fn fit(&mut self, points: &[Vec3], aspect: f32, share: f32) {
        // Each pass brings the size nearer to the wanted share; perspective makes it no more than nearly exact.
        for _ in 0..20 {
            let seen = points.iter().filter_map(|p| self.project(*p, aspect));
            let start = (Vec2::INFINITY, Vec2::NEG_INFINITY);
            let (low, high) = seen.fold(start, |(l, h), p| (l.min(p.truncate()), h.max(p.truncate())));
            if !low.is_finite() || !high.is_finite() {
                return;
            }
            let middle = 0.5 * (low + high);
            self.pan(Vec2::new(-0.5 * aspect * middle.x, 0.5 * middle.y) / aspect.min(1.0));
            let extent = 0.5 * (high - low).max_element();
            self.distance = (self.distance * extent / share).clamp(0.15, 20.0);
        }
    }

    /// Turns by a drag in units of the view's height.
    pub fn orbit(&mut self, drag: Vec2) {
        self.yaw -= 4.0 * drag.x;
        self.pitch = (self.pitch + 4.0 * drag.y).clamp(-1.5, 1.5);
    }

    /// Moves sideways so that the surface follows a drag in units of the view's height.
    pub fn pan(&mut self, drag: Vec2) {
        let back = (self.eye() - self.target).normalize();
        let right = Vec3::Y.cross(back).normalize();
        let up = back.cross(right);
        let scale = 2.0 * self.distance * (0.5 * FIELD_OF_VIEW).tan();
        self.target += (up * drag.y - right * drag.x) * scale;
        self.target = self.target.clamp_length_max(3.0);
    }

    /// Multiplies the distance, between 0.15 radii, where triangles are large, and 20, where the surface is small.
    pub fn zoom(&mut self, factor: f32) {
        self.distance = (self.distance * factor).clamp(0.15, 20.0);
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

    /// Where a point is seen, from (-1, -1) to (1, 1), with its depth; `None` behind the camera.
    pub fn project(&self, p: Vec3, aspect: f32) -> Option<Vec3> {
        let clip = self.view_projection(aspect) * p.extend(1.0);
        (clip.w > 0.0).then(|| clip.truncate() / clip.w)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fitted_view_is_filled_and_centred() {
        let points: Vec<Vec3> =
            (0..40).map(|k| Vec3::new(0.9 * (k as f32).sin(), 0.2 * (k as f32 * 0.7).cos(), 0.3)).collect();
        for aspect in [0.5, 1.0, 2.0] {
            let mut camera = Camera::default();
            camera.fit(&points, aspect, 0.8);
            let seen: Vec<Vec3> = points.iter().map(|p| camera.project(*p, aspect).unwrap()).collect();
            let reach = |f: fn(&Vec3) -> f32| {
                let values = seen.iter().map(f);
                values.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
            };
            let (x, y) = (reach(|p| p.x), reach(|p| p.y));
            assert!((x.0 + x.1).abs() < 0.05 && (y.0 + y.1).abs() < 0.05, "{x:?} {y:?}");
            assert!((0.5 * (x.1 - x.0).max(y.1 - y.0) - 0.8).abs() < 0.05, "{x:?} {y:?}");
        }
    }

    #[test]
    fn the_ray_through_a_projected_point_meets_it() {
        let mut camera = Camera::default();
        camera.orbit(Vec2::new(0.3, -0.1));
        camera.pan(Vec2::new(0.1, 0.2));
        let p = Vec3::new(0.3, -0.4, 0.5);
        for aspect in [0.5, 1.7] {
            let seen = camera.project(p, aspect).unwrap();
            let Ray { origin, direction } = camera.ray(seen.truncate(), aspect);
            assert!((p - origin).cross(direction).length() < 1e-3);
        }
    }
}
