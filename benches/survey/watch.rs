//! A monitor that measures how long nobody asks it, in processor time of its thread, so that other programs do not count.

use conemap::monitor::{Cancelled, Monitor, Stage, Step};
use cpu_time::ThreadTime;
use std::backtrace::Backtrace;
use std::collections::BTreeMap;
use std::time::Duration;

/// The silences of a run.
pub struct Watch {
    last: ThreadTime,
    stage: Option<Stage>,
    /// By stage the longest silence and the number of questions; without a stage what came before the first.
    pub by_stage: BTreeMap<Option<Stage>, (Duration, usize)>,
    /// Silences from here on are told with the calls that ended them.
    traced: Option<Duration>,
}

impl Watch {
    /// From now on.
    pub fn new() -> Self {
        Self { last: ThreadTime::now(), stage: None, by_stage: BTreeMap::new(), traced: None }
    }

    /// The same, and silences of this length are told with the calls that ended them.
    pub fn tracing(self, from: Duration) -> Self {
        Self { traced: Some(from), ..self }
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
        if self.traced.is_some_and(|from| silence >= from) {
            println!("    {:.0} ms before {}", 1000.0 * silence.as_secs_f64(), calls());
        }
        *longest = (*longest).max(silence);
        *questions += 1;
        self.last = ThreadTime::now();
    }
}

/// The calls of the core that lead here, the innermost first.
fn calls() -> String {
    let trace = Backtrace::force_capture().to_string();
    let names = trace.lines().filter_map(|line| line.trim().split_once(": ").map(|(_, name)| name));
    let of_core = names.filter(|name| name.starts_with("conemap::") && !name.contains("monitor"));
    of_core.take(5).map(|name| name.trim_start_matches("conemap::")).collect::<Vec<_>>().join(" < ")
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
