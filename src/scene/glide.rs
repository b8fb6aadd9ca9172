//! A smooth way of a camera from where it stands to where it is to stand.

use super::pose::Pose;

/// A way that began at a pose; its end is the camera's own pose, which may move meanwhile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glide {
    /// The pose at the beginning of the way.
    pub from: Pose,
    /// When the way began, in milliseconds.
    pub begin: f64,
    /// The time that the way takes, in milliseconds.
    pub duration: f64,
}

impl Glide {
    /// Whether the end is reached.
    pub fn is_over(&self, now: f64) -> bool {
        now - self.begin >= self.duration
    }

    /// The pose on the way to `end`: fast at first, slow at last. A point that both ends see at one place stays there where only
    /// the distance and the target change.
    pub fn at(&self, now: f64, end: Pose) -> Pose {
        if self.is_over(now) {
            return end;
        }
        let left = 1.0 - ((now - self.begin) / self.duration).clamp(0.0, 1.0) as f32;
        let share = 1.0 - left * left * left;
        Pose {
            turn: self.from.turn.slerp(end.turn, share),
            target: self.from.target.lerp(end.target, share),
            distance: self.from.distance + (end.distance - self.from.distance) * share,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::camera::Camera;
    use glam::{Vec2, Vec3};

    #[test]
    fn it_begins_where_it_was_and_ends_where_it_should() {
        let mut camera = Camera::default();
        let glide = Glide { from: camera.pose(), begin: 1000.0, duration: 180.0 };
        camera.orbit(Vec2::new(0.4, 0.1));
        let end = camera.pose();
        assert!(glide.at(1000.0, end).eye().distance(glide.from.eye()) < 1e-4);
        assert_eq!(glide.at(1180.0, end), end);
        assert!(!glide.is_over(1179.0) && glide.is_over(1180.0));
        let ways = [0.0, 60.0, 120.0, 180.0].map(|t| glide.at(1000.0 + t, end).eye().distance(end.eye()));
        assert!(ways.windows(2).all(|w| w[1] < w[0]));
        // A glide without duration, as where motion is not wanted, is over at once.
        assert_eq!(Glide { duration: 0.0, ..glide }.at(1000.0, end), end);
    }

    #[test]
    fn the_point_under_the_pointer_stays_all_the_way() {
        let mut camera = Camera::default();
        let p = Vec3::new(0.2, 0.5, 0.3);
        let glide = Glide { from: camera.pose(), begin: 0.0, duration: 100.0 };
        camera.zoom_about(p, 0.3);
        let seen = |pose: Pose| pose.project(p, 1.2).unwrap().truncate();
        for t in [0.0, 13.0, 50.0, 99.0] {
            assert!(seen(glide.at(t, camera.pose())).distance(seen(glide.from)) < 1e-4);
        }
    }
}
