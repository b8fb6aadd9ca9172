//! A monitor that measures how long nobody asks it, in processor time of its thread, so that other programs do not count.

use crate::arguments::Arguments;
use conemap::monitor::{Cancelled, Monitor, Stage, Step};
use cpu_time::ThreadTime;
use std::backtrace::Backtrace;
use std::collections::BTreeMap;
use std::time::Duration;

/// Silences from here on are told with the calls that ended them, where that is asked for (`--depth 2`).
const LONG: Duration = Duration::from_millis(40);

/// The silences of a run.
pub struct Watch {
    last: ThreadTime,
    stage: Option<Stage>,
    /// By stage the longest silence and the number of questions; without a stage what came before the first.
    pub by_stage: BTreeMap<Option<Stage>, (Duration, usize)>,
    traces: bool,
}

impl Watch {
    /// From now on.
    pub fn new(arguments: &Arguments) -> Self {
        Self { last: ThreadTime::now(), stage: None, by_stage: BTreeMap::new(), traces: arguments.depth > 1 }
    }

    /// The longest silence, with the sentence of its stage; the last one ends now.
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

/// The places of the core that lead here, the innermost first: the build keeps lines, and not the names of what was put into its callers.
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
