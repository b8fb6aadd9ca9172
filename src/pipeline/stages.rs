//! The stages of a run, in their order, with their usual times.

use super::attempt::{has_own_cones, has_own_cones_of_poses};
use super::{Base, Method, PipelineOptions};
use crate::monitor::{PlannedStage, Stage};

impl PipelineOptions {
    /// The stages that a run with these options and this many landmarks passes, in their order: the two of the caller that reads the
    /// files ([`Stage::Landmarks`], [`Stage::Findings`]), then those of [`super::run`]. With many landmarks [`Stage::OwnCones`] is passed
    /// between poses of one body alone. Times are percents of a run, means over five pairs with 21 to 33 landmarks, three with 12 and three of
    /// the thesis' method (`cargo xtask survey stages`), and six of Tutte's.
    pub fn stages(&self, landmarks: usize) -> Vec<PlannedStage> {
        use Stage::*;
        let planned = |list: &[(Stage, f64)]| {
            list.iter().map(|&(stage, time)| PlannedStage { stage, time }).collect::<Vec<_>>()
        };
        let is_relaxed = self.relaxation == super::Relaxation::Full;
        let adds_cones = is_relaxed && has_own_cones(landmarks, self);
        let may_add_cones = is_relaxed && has_own_cones_of_poses(landmarks, self);
        match (self.method, adds_cones, may_add_cones) {
            (Method::Relaxed, false, false) => planned(&[
                (Landmarks, 1.0),
                (Findings, 5.0),
                (ClassSearch, if self.base == Base::Qem { 5.0 } else { 39.0 }),
                (Relaxation, 50.0),
                (Certificate, 0.2),
                (Composition, 0.8),
                (SourceConeMetric, 1.5),
                (TargetConeMetric, 1.5),
                (Transfer, 1.0),
            ]),
            // Whether there are poses is not known yet: the means of three pairs of poses, 34 % of whose time goes to cones, and five others.
            (Method::Relaxed, false, true) => planned(&[
                (Landmarks, 0.6),
                (Findings, 3.5),
                (ClassSearch, if self.base == Base::Qem { 3.5 } else { 24.0 }),
                (OwnCones, 18.0),
                (Relaxation, 48.0),
                (Certificate, 0.2),
                (Composition, 0.8),
                (SourceConeMetric, 1.5),
                (TargetConeMetric, 1.4),
                (Transfer, 2.0),
            ]),
            (Method::Relaxed, true, _) => planned(&[
                (Landmarks, 0.3),
                (Findings, 1.6),
                (ClassSearch, if self.base == Base::Qem { 2.0 } else { 14.0 }),
                (OwnCones, 62.0),
                (Relaxation, 20.0),
                (Certificate, 0.1),
                (Composition, 0.4),
                (SourceConeMetric, 0.5),
                (TargetConeMetric, 0.5),
                (Transfer, 0.6),
            ]),
            (Method::Thesis, ..) => planned(&[
                (Landmarks, 4.0),
                (Findings, 23.0),
                (BaseDomain, 42.0),
                (SourceConeMetric, 7.0),
                (TargetConeMetric, 6.5),
                (PatchwiseMap, 17.2),
                (Transfer, 0.3),
            ]),
            (Method::Tutte, ..) => planned(&[
                (Landmarks, 2.6),
                (Findings, 21.0),
                (BaseDomain, 40.0),
                (Certificate, 0.9),
                (Composition, 7.0),
                (SourceConeMetric, 6.0),
                (TargetConeMetric, 6.5),
                (Transfer, 16.0),
            ]),
        }
    }
}
