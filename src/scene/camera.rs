//! A camera that a user turns, moves and brings nearer to a surface centred at the origin and scaled to radius 1.
//!
//! Its direction is given by angles about the mesh's up axis, so that meshes stay upright while they are turned and two cameras over meshes
//! with different up axes can be turned alike.

use super::pose::Pose;
use super::up_axis::UpAxis;
use crate::math::rigid3::laid_on;
use glam::{DQuat, EulerRot, Quat, Vec2, Vec3};
use serde::Deserialize;
use std::f32::consts::{FRAC_PI_2, PI, TAU};

/// The least and the largest distance, in radii of the surface: at the least one single triangles of the finest meshes are large,
/// at the largest one the surface is small.
const DISTANCES: [f32; 2] = [0.01, 20.0];

/// The largest distance of the target from the middle of the surface, in radii of the surface.
const FARTHEST_TARGET: f32 = 3.0;

/// The angle by which a drag as long as the view is high turns, in radians.
const TURN: f32 = 4.0;

/// The number of numbers that a camera is kept as.
const KEPT: usize = 10;

/// The distance from which a single place is looked at, in radii of the surface, where the camera is farther away.
const CLOSE_UP: f32 = 1.4;

/// The distance from which something small is seen with what lies around it, in units of its own radius.
const ROOM: f32 = 5.0;

/// The least distance to which the camera comes by itself, in radii of the surface.
const NEAREST: f32 = 0.12;

/// The least number of pairs of points that tell how one body lies to another.
pub const LEAST_TO_TURN: usize = 3;

/// A direction to look from.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "lowercase")]
pub enum LookFrom {
    /// From ahead.
    Front,
    /// From behind.
    Back,
    /// From the viewer's right of the front view.
    Right,
    /// From the viewer's left of the front view.
    Left,
    /// From above.
    Top,
    /// From below.
    Bottom,
}

/// Looks at a target from a direction given by angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The mesh's axis that the angles refer to.
    pub up: UpAxis,
    /// Angle around the up axis, in radians; 0 from the front, a quarter turn from the right.
    pub yaw: f32,
    /// Angle above the horizon, in radians, a quarter turn at most.
    pub pitch: f32,
    /// The angle by which the picture is turned counter-clockwise, in radians.
    pub roll: f32,
    /// Distance from the target.
    pub distance: f32,
    /// The point looked at.
    pub target: Vec3,
    /// The point that stays where it is when the camera turns.
    pub pivot: Vec3,
}

impl Default for Camera {
    fn default() -> Self {
        // From ahead, a little from the right and from above; from 4 radii the whole unit ball is seen.
        Self {
            up: UpAxis::Y,
            yaw: 0.6,
            pitch: 0.25,
            roll: 0.0,
            distance: 4.0,
            target: Vec3::ZERO,
            pivot: Vec3::ZERO,
        }
    }
}

impl Camera {
    /// The first look at a mesh with this up axis.
    pub fn first(up: UpAxis) -> Self {
        Self { up, ..Self::default() }
    }

    /// The camera as numbers to be kept: yaw, pitch, roll, distance, target and pivot. The up axis is the mesh's.
    pub fn to_numbers(self) -> [f32; KEPT] {
        let ([a, b, c], [d, e, f]) = (self.target.to_array(), self.pivot.to_array());
        [self.yaw, self.pitch, self.roll, self.distance, a, b, c, d, e, f]
    }

    /// The camera of kept numbers over a mesh with this up axis; `None` where they are not the numbers of a camera.
    pub fn from_numbers(up: UpAxis, numbers: &[f32]) -> Option<Self> {
        let [yaw, pitch, roll, distance, a, b, c, d, e, f] = *<&[f32; KEPT]>::try_from(numbers).ok()?;
        let (target, pivot) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
        Self { up, yaw, pitch, roll, distance, target, pivot }.bounded()
    }

    /// The camera with angles, distance and points within their bounds; `None` where a number is not finite.
    fn bounded(self) -> Option<Self> {
        let numbers = [self.yaw, self.pitch, self.roll, self.distance];
        let finite =
            numbers.iter().all(|x| x.is_finite()) && self.target.is_finite() && self.pivot.is_finite();
        finite.then(|| Self {
            yaw: self.yaw.rem_euclid(TAU),
            pitch: self.pitch.clamp(-FRAC_PI_2, FRAC_PI_2),
            roll: self.roll.rem_euclid(TAU),
            distance: self.distance.clamp(DISTANCES[0], DISTANCES[1]),
            target: self.target.clamp_length_max(FARTHEST_TARGET),
            pivot: self.pivot.clamp_length_max(FARTHEST_TARGET),
            ..self
        })
    }

    /// The pose of the camera.
    pub fn pose(&self) -> Pose {
        Pose { turn: self.turn(), target: self.target, distance: self.distance }
    }

    fn turn(&self) -> Quat {
        self.up.basis()
            * Quat::from_rotation_y(self.yaw)
            * Quat::from_rotation_x(-self.pitch)
            * Quat::from_rotation_z(-self.roll)
    }

    /// Turns about the pivot by a drag in units of the view's height, y up: the surface follows the pointer.
    pub fn orbit(&mut self, drag: Vec2) {
        let drag = Vec2::from_angle(-self.roll).rotate(drag) * TURN;
        self.turned_about(self.pivot, |camera| {
            camera.yaw = (camera.yaw - drag.x).rem_euclid(TAU);
            camera.pitch = (camera.pitch - drag.y).clamp(-FRAC_PI_2, FRAC_PI_2);
        });
    }

    /// Turns the picture counter-clockwise about a point, in radians.
    pub fn roll_about(&mut self, centre: Vec3, angle: f32) {
        self.turned_about(centre, |camera| camera.roll = (camera.roll + angle).rem_euclid(TAU));
    }

    /// Changes angles while a point stays where it is seen.
    fn turned_about(&mut self, centre: Vec3, change: impl FnOnce(&mut Self)) {
        let before = self.turn();
        change(self);
        let by = self.turn() * before.inverse();
        self.target = (centre + by * (self.target - centre)).clamp_length_max(FARTHEST_TARGET);
    }

    /// Moves sideways so that the target's surroundings follow a drag in units of the view's height, y up.
    pub fn pan(&mut self, drag: Vec2, aspect: f32) {
        let pose = self.pose();
        let height = pose.height_at(self.target, aspect);
        self.target -= (pose.right() * drag.x + pose.up() * drag.y) * height;
        self.target = self.target.clamp_length_max(FARTHEST_TARGET);
    }

    /// Multiplies the distance to a point, which stays where it is seen.
    pub fn zoom_about(&mut self, point: Vec3, factor: f32) {
        let distance = (self.distance * factor).clamp(DISTANCES[0], DISTANCES[1]);
        let factor = distance / self.distance;
        self.distance = distance;
        self.target = (point + (self.target - point) * factor).clamp_length_max(FARTHEST_TARGET);
    }

    /// Moves and comes near enough that the points fill the given share of the view; the direction stays.
    pub fn fit(&mut self, points: &[Vec3], aspect: f32, share: f32) {
        self.pivot = Vec3::ZERO;
        self.target = Vec3::ZERO;
        self.distance = Self::default().distance;
        // Each pass brings the size nearer to the wanted share; perspective makes it no more than nearly exact.
        for _ in 0..20 {
            let pose = self.pose();
            let seen = points.iter().filter_map(|p| pose.project(*p, aspect));
            let start = (Vec2::INFINITY, Vec2::NEG_INFINITY);
            let (low, high) = seen.fold(start, |(l, h), p| (l.min(p.truncate()), h.max(p.truncate())));
            if !low.is_finite() || !high.is_finite() {
                return;
            }
            let middle = 0.5 * (low + high);
            self.pan(Vec2::new(-0.5 * aspect * middle.x, -0.5 * middle.y), aspect);
            let extent = 0.5 * (high - low).max_element();
            self.distance = (self.distance * extent / share).clamp(DISTANCES[0], DISTANCES[1]);
        }
    }

    /// Looks from one of six sides, the up axis up; target and distance stay.
    pub fn look_from(&mut self, from: LookFrom) {
        let (yaw, pitch) = match from {
            LookFrom::Front => (0.0, 0.0),
            LookFrom::Back => (PI, 0.0),
            LookFrom::Right => (FRAC_PI_2, 0.0),
            LookFrom::Left => (1.5 * PI, 0.0),
            LookFrom::Top => (0.0, FRAC_PI_2),
            LookFrom::Bottom => (0.0, -FRAC_PI_2),
        };
        (self.yaw, self.pitch, self.roll) = (yaw, pitch, 0.0);
    }

    /// The turn that lays points nearest to their partners on another body; `None` where fewer than three pairs tell how it lies.
    pub fn turn_onto(points: &[Vec3], partners: &[Vec3]) -> Option<Quat> {
        let [from, onto] = [points, partners].map(|all| all.iter().map(|p| p.as_dvec3()).collect::<Vec<_>>());
        let turn = (from.len() >= LEAST_TO_TURN).then(|| laid_on(&from, &onto).rotation);
        turn.map(|turn| DQuat::from_mat3(&turn).as_quat())
    }

    /// Looks at its body as `other` looks at its own, where `turn` takes that body to this one. The axis nearest to the one that is up there
    /// points up; target and distance stay.
    pub fn look_like(&mut self, other: &Self, turn: Quat) {
        self.up = UpAxis::nearest(turn * other.up.direction());
        let seen = self.up.basis().inverse() * turn * other.turn();
        let (yaw, down, left) = seen.to_euler(EulerRot::YXZ);
        (self.yaw, self.pitch, self.roll) = (yaw.rem_euclid(TAU), -down, (-left).rem_euclid(TAU));
    }

    /// Makes another axis of the mesh point up; the angles stay, and the picture is upright.
    pub fn set_up(&mut self, up: UpAxis) {
        self.up = up;
        self.roll = 0.0;
    }

    /// Looks at a place of the surface from ahead of it, `normal` being the surface's there, and turns about it from now on.
    pub fn face(&mut self, place: Vec3, normal: Vec3) {
        let local = self.up.basis().inverse() * normal;
        if local.x.abs() + local.z.abs() > 1e-3 {
            self.yaw = local.x.atan2(local.z).rem_euclid(TAU);
        }
        // The camera does not look exactly from above or below, where one could not tell how the body stands.
        self.pitch = local.y.clamp(-1.0, 1.0).asin().clamp(-1.2, 1.2);
        self.roll = 0.0;
        self.distance = self.distance.min(CLOSE_UP);
        self.target = place;
        self.pivot = place;
    }

    /// Looks at everything within a distance of a place, from ahead of it, and turns about the place from now on.
    pub fn face_around(&mut self, place: Vec3, normal: Vec3, radius: f32) {
        self.face(place, normal);
        self.distance = (ROOM * radius).clamp(NEAREST, Self::default().distance);
    }

    /// Turns about a point from now on, and brings it to the middle of the view.
    pub fn centre_on(&mut self, point: Vec3) {
        self.pivot = point;
        self.target = point;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const P: Vec3 = Vec3::new(0.3, -0.4, 0.5);

    fn seen(camera: &Camera, p: Vec3) -> Vec2 {
        camera.pose().project(p, 1.4).unwrap().truncate()
    }

    /// A camera that was moved in every way.
    fn moved() -> Camera {
        let mut camera = Camera::first(UpAxis::Z);
        camera.orbit(Vec2::new(0.3, -0.1));
        camera.pan(Vec2::new(0.1, 0.2), 1.4);
        camera.roll_about(camera.pivot, 0.5);
        camera.zoom_about(P, 0.7);
        camera
    }

    #[test]
    fn the_up_axis_is_up_on_the_screen() {
        for up in UpAxis::ALL {
            let camera = Camera::first(up);
            let way = seen(&camera, up.direction() * 0.5) - seen(&camera, -up.direction() * 0.5);
            assert!(way.y > 0.1 && way.x.abs() < 1e-5);
        }
    }

    #[test]
    fn two_bodies_are_seen_alike_whatever_is_up_in_their_files() {
        let other = moved();
        for turn in [
            Quat::IDENTITY,
            Quat::from_rotation_z(1.5),
            Quat::from_rotation_x(2.5) * Quat::from_rotation_y(-1.0),
        ] {
            for up in UpAxis::ALL {
                let mut camera = Camera::first(up);
                let points = [P, Vec3::X, Vec3::ZERO, Vec3::NEG_Y];
                let partners = points.map(|p| turn * p + P);
                camera.look_like(&other, Camera::turn_onto(&points, &partners).unwrap());
                let [own, as_other] = [camera, other].map(|camera| camera.pose());
                for (a, b) in [
                    (own.right(), as_other.right()),
                    (own.up(), as_other.up()),
                    (own.back(), as_other.back()),
                ] {
                    assert!(a.distance(turn * b) < 1e-5, "{up:?} {turn}");
                }
                assert_eq!(Some(camera), Camera::from_numbers(camera.up, &camera.to_numbers()));
                // The nearest of six directions is at most so far away.
                let upwards = turn * other.up.direction();
                assert!(camera.up.direction().dot(upwards) > 3.0_f32.sqrt().recip() - 1e-6, "{up:?} {turn}");
            }
        }
    }

    #[test]
    fn two_pairs_do_not_tell_how_a_body_lies() {
        assert_eq!(Camera::turn_onto(&[P, Vec3::X], &[P, Vec3::Y]), None);
    }

    #[test]
    fn the_eye_is_where_the_angles_say() {
        let camera = Camera { yaw: 0.5, pitch: 0.2, ..Camera::default() };
        let (sin_yaw, cos_yaw) = 0.5_f32.sin_cos();
        let (sin_pitch, cos_pitch) = 0.2_f32.sin_cos();
        let eye = 4.0 * Vec3::new(sin_yaw * cos_pitch, sin_pitch, cos_yaw * cos_pitch);
        assert!(camera.pose().eye().distance(eye) < 1e-5);
    }

    #[test]
    fn the_surface_follows_a_drag_and_the_pivot_stays() {
        for roll in [0.0, 0.5, 2.0] {
            let mut camera = Camera { pivot: P, ..Camera::default() };
            camera.roll_about(P, roll);
            let ahead = P + 0.1 * camera.pose().back();
            let before = (seen(&camera, P), seen(&camera, ahead));
            let drag = Vec2::new(0.01, 0.004);
            camera.orbit(drag);
            assert!(seen(&camera, P).distance(before.0) < 1e-4);
            let way = seen(&camera, ahead) - before.1;
            assert!(
                Vec2::new(way.x * 1.4, way.y).normalize().dot(drag.normalize()) > 0.98,
                "{way} for {drag}"
            );
        }
    }

    #[test]
    fn a_roll_turns_the_picture_counter_clockwise_about_its_centre() {
        let mut camera = moved();
        let other = P + 0.2 * camera.pose().right();
        let before = seen(&camera, P);
        camera.roll_about(P, 0.3);
        assert!(seen(&camera, P).distance(before) < 1e-4);
        let way = seen(&camera, other) - seen(&camera, P);
        assert!((way.y.atan2(way.x * 1.4) - 0.3).abs() < 0.01);
    }

    #[test]
    fn the_point_under_the_pointer_stays_when_the_camera_comes_nearer() {
        let mut camera = moved();
        let before = seen(&camera, P);
        for factor in [0.5, 0.1, 1e-6, 3.0, 1e3] {
            let distance = camera.distance;
            let target = camera.target;
            camera.zoom_about(P, factor);
            // Far out the bound of the target wins.
            if camera.target.length() < FARTHEST_TARGET - 1e-3 {
                assert!(seen(&camera, P).distance(before) < 2e-3);
            }
            assert!((DISTANCES[0]..=DISTANCES[1]).contains(&camera.distance));
            assert!(camera.distance != distance || camera.target.distance(target) < 1e-5);
        }
    }

    #[test]
    fn the_target_follows_a_pan() {
        for aspect in [0.6, 1.5] {
            let mut camera = moved();
            let p = camera.target;
            camera.pan(Vec2::new(0.1, -0.2), aspect);
            let at = camera.pose().project(p, aspect).unwrap();
            // A height is 2 in y, and in x by the aspect less.
            assert!((at.truncate() - Vec2::new(0.2 / aspect, -0.4)).length() < 1e-3, "{at}");
        }
    }

    #[test]
    fn a_fitted_camera_sees_all_and_fills_the_view() {
        let corners: Vec<Vec3> =
            (0..8).map(|k| Vec3::new((k & 1) as f32, (k >> 1 & 1) as f32, (k >> 2) as f32) - 0.5).collect();
        for aspect in [0.5, 1.0, 2.0] {
            let mut camera = moved();
            camera.fit(&corners, aspect, 0.82);
            let most = corners
                .iter()
                .map(|p| camera.pose().project(*p, aspect).unwrap().truncate().abs().max_element());
            let most = most.fold(0.0, f32::max);
            assert!((0.8..0.84).contains(&most), "{most}");
        }
    }

    #[test]
    fn six_sides_look_along_six_axes() {
        for up in UpAxis::ALL {
            let back = |from| {
                let mut camera = Camera::first(up);
                camera.look_from(from);
                camera.pose().back()
            };
            let right = up.direction().cross(up.front());
            for (from, axis) in [
                (LookFrom::Front, up.front()),
                (LookFrom::Back, -up.front()),
                (LookFrom::Right, right),
                (LookFrom::Left, -right),
                (LookFrom::Top, up.direction()),
                (LookFrom::Bottom, -up.direction()),
            ] {
                assert!(back(from).distance(axis) < 1e-5, "{up:?} {from:?}");
            }
        }
    }

    #[test]
    fn a_faced_place_is_in_the_middle_and_turned_to_the_viewer() {
        let normal = Vec3::new(-0.5, 0.3, -0.8).normalize();
        let mut camera = moved();
        camera.face(P, normal);
        assert!(seen(&camera, P).length() < 1e-4);
        assert!(camera.pose().back().distance(normal) < 1e-4);
        camera.face(P, Vec3::Z);
        assert!(camera.pose().back().dot(Vec3::Z) > 0.9);
    }

    #[test]
    fn what_is_kept_of_a_camera_brings_it_back() {
        let camera = moved();
        let back = Camera::from_numbers(UpAxis::Z, &camera.to_numbers()).unwrap();
        assert!(back.pose().eye().distance(camera.pose().eye()) < 1e-4);
        assert!(Camera::from_numbers(UpAxis::Z, &[1.0; 6]).is_none());
        assert!(Camera { yaw: f32::NAN, ..camera }.bounded().is_none());
        assert_eq!(Camera { pitch: 9.0, ..camera }.bounded().unwrap().pitch, FRAC_PI_2);
    }
}
