//! A monitor whose stages never go back.

use super::{Cancelled, Monitor, Stage, Step};

/// Passes everything on, but for a share of a stage that falls: a loop that only asks whether to stop reports 0, also in the middle of a
/// stage, and is passed on with the share reported before.
pub struct Rising<'a> {
    monitor: &'a mut dyn Monitor,
    stage: Option<Stage>,
    /// The largest share of the stage so far.
    done: f64,
}

impl<'a> Rising<'a> {
    /// Wraps a monitor.
    pub fn new(monitor: &'a mut dyn Monitor) -> Self {
        Self { monitor, stage: None, done: 0.0 }
    }
}

impl Monitor for Rising<'_> {
    fn wrapped(&self) -> Option<&dyn Monitor> {
        Some(self.monitor)
    }

    fn wrapped_mut(&mut self) -> Option<&mut dyn Monitor> {
        Some(self.monitor)
    }

    fn enter(&mut self, stage: Stage) {
        if self.stage.replace(stage) != Some(stage) {
            self.done = 0.0;
        }
        self.monitor.enter(stage);
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        self.done = self.done.max(step.fraction);
        self.monitor.step(Step { fraction: self.done, ..step })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A monitor that keeps all reports.
    #[derive(Default)]
    struct Recorder(Vec<(Option<Stage>, f64)>);

    impl Monitor for Recorder {
        fn enter(&mut self, stage: Stage) {
            self.0.push((Some(stage), 0.0));
        }

        fn step(&mut self, step: Step) -> Result<(), Cancelled> {
            self.0.push((None, step.fraction));
            Ok(())
        }
    }

    #[test]
    fn a_question_tells_no_share_and_a_stage_begins_at_its_own() {
        let mut recorder = Recorder::default();
        let mut rising = Rising::new(&mut recorder);
        let told = |fraction| Step { fraction, residual: None };
        rising.enter(Stage::Relaxation);
        for step in [told(0.2), Step::default(), told(0.5), told(0.4)] {
            rising.step(step).unwrap();
        }
        rising.enter(Stage::Relaxation);
        rising.step(Step::default()).unwrap();
        rising.enter(Stage::Composition);
        rising.step(told(0.1)).unwrap();
        let [relaxation, composition] = [Stage::Relaxation, Stage::Composition].map(|s| (Some(s), 0.0));
        let of = |fraction| (None, fraction);
        let first = [relaxation, of(0.2), of(0.2), of(0.5), of(0.5), relaxation, of(0.5)];
        assert_eq!(recorder.0, [&first[..], &[composition, of(0.1)]].concat());
    }
}
