//! The share of a run's time that each stage takes, compared with the share by which progress bars move.

use crate::arguments::Arguments;
use crate::case::Case;
use conemap::monitor::{Cancelled, Monitor, Stage, Step};
use conemap::pipeline::PipelineOptions;
use cpu_time::ThreadTime;
use std::collections::BTreeMap;

/// A monitor that measures the processor time of each stage.
#[derive(Default)]
struct StageTimes {
    stage: Option<(Stage, ThreadTime)>,
    seconds: BTreeMap<Stage, f64>,
}

impl StageTimes {
    fn leave(&mut self) {
        if let Some((stage, begun)) = self.stage.take() {
            *self.seconds.entry(stage).or_default() += begun.elapsed().as_secs_f64();
        }
    }
}

impl Monitor for StageTimes {
    fn enter(&mut self, stage: Stage) {
        self.leave();
        self.stage = Some((stage, ThreadTime::now()));
    }

    fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
        Ok(())
    }
}

/// Prints the mean share of each stage over the pairs, and the share that the program tells (`PipelineOptions::stages`).
pub fn shares(arguments: &Arguments) {
    let mut sums: BTreeMap<Stage, f64> = BTreeMap::new();
    let names = arguments.names();
    let mut landmarks = 0;
    for name in &names {
        let case = Case::of_pair(arguments, name);
        landmarks = landmarks.max(case.points[0].len());
        let mut times = StageTimes::default();
        if let Err(error) = case.run(&arguments.options, &mut times) {
            println!("{name}: {error}");
            continue;
        }
        times.leave();
        let total: f64 = times.seconds.values().sum();
        for (stage, seconds) in times.seconds {
            *sums.entry(stage).or_default() += seconds / total;
        }
    }
    let all: f64 = sums.values().sum();
    println!("stage                 measured    told");
    for planned in told(&arguments.options, landmarks) {
        let measured = sums.get(&planned.0).copied().unwrap_or_default() / all;
        println!("{:20} {:8.1} % {:6.1} %", planned.0.to_string(), 100.0 * measured, 100.0 * planned.1);
    }
}

/// The shares that the program tells for the stages after the files are read.
fn told(options: &PipelineOptions, landmarks: usize) -> Vec<(Stage, f64)> {
    let plan = options.stages(landmarks);
    let total: f64 = plan.iter().map(|planned| planned.time).sum();
    plan.into_iter().map(|planned| (planned.stage, planned.time / total)).collect()
}
