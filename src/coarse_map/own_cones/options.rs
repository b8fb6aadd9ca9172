//! Options of the program's own cones.

use crate::layout::SearchOptions;

/// Options of the program's own cones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnConeOptions {
    /// Points that are added in each round, beside further ones in gaps; 0 for none, and for no ends of limbs either.
    pub count: usize,
    /// Further points are added as long as one is farther than this from all others; the root of the area is 1.
    pub gap: f64,
    /// Points that are added in each round with those in gaps, at most.
    pub most: usize,
    /// Ends of limbs that are looked at on each mesh, at most, the most remote; 0 for none.
    pub ends: usize,
    /// Other points than ends of limbs are added where there are at most this many landmarks.
    pub most_landmarks: usize,
    /// Between two poses of one body they are added where there are at most this many.
    pub most_pose_landmarks: usize,
    /// Points are added only where the mean log density of the coarse map is at least this; 0 for an isometry.
    pub least_mean_log: f64,
    /// Rounds, each with another set of points, at most, beside those with ends of limbs.
    pub rounds: usize,
    /// Stops after this many rounds without a gain.
    pub patience: usize,
    /// Further rounds between two poses of one body with few landmarks, whose points are placed by maps of the first level on which patches are
    /// registered; 0 for none.
    pub pose_rounds: usize,
    /// Rounds after these, whose points are placed by the map of a finer level still; 0 for none.
    pub finer_rounds: usize,
    /// Least number of vertices of that finer level.
    pub finer_vertices: usize,
    /// The share by which a gain lowers the mean log density.
    pub least_gain: f64,
    /// Options of the search for the layout with own points.
    pub search: SearchOptions,
}

impl Default for OwnConeOptions {
    fn default() -> Self {
        let search = SearchOptions { candidates: 2, twists: 2, ..SearchOptions::default() };
        Self {
            // With 12 of 33 landmarks that makes about as many cones as all 33. Rounds and gains were chosen by hand.
            count: 20,
            // With 20 points bodies of many long limbs, as ants and spiders, have gaps of .16 to .18, and four-footed animals with 12 landmarks
            // .12 to .14. With gaps of .12 at most E of the former falls by up to 12 % (see docs/experiments.md).
            gap: 0.12,
            most: 40,
            ends: 12,
            most_landmarks: 16,
            // Of sixteen maps between poses of people with 33 landmarks eight had a limb or the head turned, 0.6 to 2.4 % of the root of
            // the area from the truth on the mean; with own cones none has. More than 40 landmarks were not tried.
            most_pose_landmarks: 40,
            // The mean log density of a map of energy 4.01.
            least_mean_log: 0.0025,
            rounds: 8,
            patience: 2,
            // With four and one, and with two and three, fourteen maps between poses were farther from the truth than with three and two; with
            // finer levels of 1200 vertices two of three pairs were, for a twentieth less time (see docs/experiments.md).
            pose_rounds: 3,
            finer_rounds: 2,
            finer_vertices: 2000,
            least_gain: 0.02,
            search,
        }
    }
}

impl OwnConeOptions {
    /// The number of rounds with points far from all others, at most.
    pub(super) fn all_rounds(&self) -> usize {
        self.rounds + self.rounds_of_poses()
    }

    /// The number of rounds on finer levels, at most.
    pub(super) fn rounds_of_poses(&self) -> usize {
        self.pose_rounds + self.finer_rounds
    }

    /// The options for ends of limbs. Twists change nothing for them on 28 pairs of animals, beyond what another drawing changes; with one
    /// drawing in place of two a tail was left in a dent on one of 102 pairs with clicked landmarks.
    pub(super) fn untwisted(&self) -> SearchOptions {
        SearchOptions { twists: 0, ..self.search }
    }

    /// The options for poses with many landmarks: what finer rounds gain was seen with few landmarks alone.
    pub(super) fn of_poses(&self) -> Self {
        Self { pose_rounds: 0, finer_rounds: 0, ..*self }
    }

    /// The options for points whose class is known.
    pub(super) fn drawn_once(&self) -> SearchOptions {
        SearchOptions { candidates: 1, ..self.untwisted() }
    }
}
