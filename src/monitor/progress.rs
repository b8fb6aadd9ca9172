//! The progress of a run: stages and their fractions as one share of the whole.

use super::Stage;

/// A stage with its usual share of the time of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedStage {
    /// The stage.
    pub stage: Stage,
    /// Its usual time, in any unit that the other stages of the plan share.
    pub time: f64,
}

/// Turns stages and their fractions into one share of the whole run, which never falls.
#[derive(Clone, Debug)]
pub struct Progress {
    plan: Vec<PlannedStage>,
    total: f64,
    share: f64,
}

impl Progress {
    /// Nothing is done yet of a run that passes the stages of `plan` in their order.
    pub fn new(plan: Vec<PlannedStage>) -> Self {
        let total = plan.iter().map(|planned| planned.time).sum();
        Self { plan, total, share: 0.0 }
    }

    /// The share of the run that is done, 0 to 1, when `fraction` of a stage is done. A stage that is not in the plan changes
    /// nothing.
    pub fn at(&mut self, stage: Stage, fraction: f64) -> f64 {
        if let Some(place) = self.plan.iter().position(|planned| planned.stage == stage) {
            let before: f64 = self.plan[..place].iter().map(|planned| planned.time).sum();
            let within = self.plan[place].time * fraction.clamp(0.0, 1.0);
            self.share = self.share.max((before + within) / self.total);
        }
        self.share
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn progress() -> Progress {
        let planned = |(stage, time)| PlannedStage { stage, time };
        let plan = [(Stage::Landmarks, 1.0), (Stage::Relaxation, 6.0), (Stage::Certificate, 3.0)];
        Progress::new(plan.map(planned).to_vec())
    }

    #[test]
    fn shares_add_up_over_the_stages() {
        let mut progress = progress();
        assert!(progress.at(Stage::Landmarks, 0.0).abs() < 1e-15);
        assert!((progress.at(Stage::Landmarks, 1.0) - 0.1).abs() < 1e-15);
        assert!((progress.at(Stage::Relaxation, 0.5) - 0.4).abs() < 1e-15);
        assert!((progress.at(Stage::Certificate, 1.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_share_never_falls() {
        let mut progress = progress();
        progress.at(Stage::Relaxation, 0.5);
        for (stage, fraction) in [(Stage::Relaxation, 0.1), (Stage::Landmarks, 1.0), (Stage::Remeshing, 0.9)]
        {
            assert!((progress.at(stage, fraction) - 0.4).abs() < 1e-15, "{stage}");
        }
    }

    #[test]
    fn fractions_out_of_range_stay_inside_their_stage() {
        let mut progress = progress();
        assert!((progress.at(Stage::Relaxation, 7.0) - 0.7).abs() < 1e-15);
        assert!(progress.at(Stage::Certificate, f64::NAN) <= 1.0);
    }
}
