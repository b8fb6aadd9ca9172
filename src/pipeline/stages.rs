//! The stages of a run, in their order, with their usual times.

use super::relaxed::has_own_cones;
use super::{Base, Method, PipelineOptions};
use crate::monitor::{PlannedStage, Stage};

impl PipelineOptions {
    /// The stages that a run with these options and that many landmarks passes, in their order: those of [`super::run`] after the
    /// two of whoever reads the files ([`Stage::Landmarks`], [`Stage::Findings`]). Their times are shares in percent.
    pub fn stages(&self, landmarks: usize) -> Vec<PlannedStage> {
        use Stage::*;
        let planned = |list: &[(Stage, f64)]| {
            list.iter().map(|&(stage, time)| PlannedStage { stage, time }).collect::<Vec<_>>()
        };
        match (self.method, has_own_cones(landmarks, self)) {
            (Method::Relaxed, false) => planned(&[
                (Landmarks, 1.0),
                (Findings, 1.0),
                (ClassSearch, if self.base == Base::Qem { 5.0 } else { 20.0 }),
                (Relaxation, 60.0),
                (Certificate, 1.0),
                (Composition, 2.0),
                (SourceConeMetric, 5.0),
                (TargetConeMetric, 5.0),
                (Transfer, 5.0),
            ]),
            (Method::Relaxed, true) => planned(&[
                (Landmarks, 1.0),
                (Findings, 1.0),
                (ClassSearch, if self.base == Base::Qem { 5.0 } else { 20.0 }),
                (OwnCones, 20.0),
                (Relaxation, 40.0),
                (Certificate, 1.0),
                (Composition, 2.0),
                (SourceConeMetric, 5.0),
                (TargetConeMetric, 5.0),
                (Transfer, 5.0),
            ]),
            (Method::Thesis, _) => planned(&[
                (Landmarks, 1.0),
                (Findings, 1.0),
                (BaseDomain, 40.0),
                (SourceConeMetric, 10.0),
                (TargetConeMetric, 10.0),
                (PatchwiseMap, 30.0),
                (Transfer, 10.0),
            ]),
        }
    }
}
