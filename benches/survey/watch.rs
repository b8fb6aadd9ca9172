//! A monitor that measures its silences: how long the run asks it nothing. It takes the processor time of its thread, so that other
//! programs on the machine do not count.

use crate::arguments::Arguments;
use conemap::monitor::{Cancelled, Monitor, Stage, Step};
use cpu_time::ThreadTime;
use std::backtrace::Backtrace;
use std::collections::BTreeMap;
use std::time::Duration;

/// The shortest silence that is printed with the calls that ended it, where that is asked for (`--depth 2`).
const LONG: Duration = Duration::from_millis(40);

/// A monitor that keeps the longest silence of each stage.
pub struct Watch {
    last: ThreadTime,
    stage: Option<Stage>,
    /// The longest silence of each stage and its number of questions; the key `None` stands for the time before the first stage.
    pub by_stage: BTreeMap<Option<Stage>, (Duration, usize)>,
    traces: bool,
}

impl Watch {
    /// Starts the clock.
    pub fn new(arguments: &Arguments) -> Self {
        Self { last: ThreadTime::now(), stage: None, by_stage: BTreeMap::new(), traces: arguments.depth > 1 }
    }

    /// The longest silence so far, which may be the one that this call ends, and the sentence of its stage.
    pub fn longest(&mut self) -> (&'static str, Duration) {
        self.told();
        let longest = self.by_stage.iter().max_by_key(|(_, (silence, _))| *silence);
        longest.map_or(("", Duration::ZERO), |(stage, (silence, _))| {
            (stage.map_or("before the first stage", Stage::sentence), *silence)
        })
    }

    fn told(&mut self) {
        let silence = self.last.elapsed();
        let (longest, questions) = self.by_stage.entry(self.stage).or_default();
        if self.traces && silence >= LONG {
            println!("    {:.0} ms before {}", 1000.0 * silence.as_secs_f64(), calls());
        }
        *longest = (*longest).max(silence);
        *questions += 1;
        self.last = ThreadTime::now();
    }
}

/// The five innermost places of the core that lead here, the innermost first, by file and line: the build keeps no names of inlined functions.
fn calls() -> String {
    let trace = Backtrace::force_capture().to_string();
    let places = trace.lines().filter_map(|line| line.trim().strip_prefix("at ./src/"));
    let of_core = places.filter(|place| !place.starts_with("monitor/"));
    of_core.take(5).collect::<Vec<_>>().join(" < ")
}

impl Monitor for Watch {
    fn enter(&mut self, stage: Stage) {
        self.told();
        self.stage = Some(stage);
    }

    fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
        self.told();
        Ok(())
    }
}
