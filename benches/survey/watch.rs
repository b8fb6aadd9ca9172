//! A monitor that measures how long nobody asks it, in processor time of its thread, so that other programs do not count.

use conemap::monitor::{Cancelled, Monitor, Stage, Step};
use cpu_time::ThreadTime;
use std::collections::BTreeMap;
use std::time::Duration;

/// The silences of a run.
pub struct Watch {
    last: ThreadTime,
    stage: Option<Stage>,
    /// By stage the longest silence and the number of questions; without a stage what came before the first.
    pub by_stage: BTreeMap<Option<Stage>, (Duration, usize)>,
}

impl Watch {
    /// From now on.
    pub fn new() -> Self {
        Self { last: ThreadTime::now(), stage: None, by_stage: BTreeMap::new() }
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
        let (longest, questions) = self.by_stage.entry(self.stage).or_default();
        *longest = (*longest).max(self.last.elapsed());
        *questions += 1;
        self.last = ThreadTime::now();
    }
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
