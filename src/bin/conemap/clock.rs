//! A monitor that tells progress on standard error, takes the time of each stage, and asks for the result when the time is
//! up or the user wants it.
//!
//! On a terminal a bar moves with the usual times of the stages; elsewhere each stage that is over is a line.

use crate::deadline::Deadline;
use conemap::monitor::{Cancelled, Monitor, PlannedStage, Progress, Stage, Step};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Tells progress and takes times.
pub struct Clock {
    /// Time from the start after which the run is to finish.
    time_limit: Option<Duration>,
    /// Whether the user wants the result now.
    interrupt: Option<Arc<AtomicBool>>,
    /// The deadline at which the program must have ended.
    deadline: Option<Deadline>,
    /// Whether the deadline has stopped the run.
    is_stopped: bool,
    /// The energy of the map that is being relaxed.
    energy: Option<f64>,
    begun: Instant,
    stage: Option<(Stage, Instant)>,
    seconds: BTreeMap<String, f64>,
    /// The progress bar; hidden where there is no terminal.
    bar: ProgressBar,
    progress: Progress,
}

/// The number of the bar's steps: a tenth of a percent each.
const BAR_STEPS: u64 = 1000;

/// The largest number of times a second that the bar is drawn.
const BAR_RATE: u8 = 15;

impl Clock {
    /// Starts now, with a bar where standard error is a terminal.
    pub fn start() -> Self {
        let target = if std::io::stderr().is_terminal() {
            ProgressDrawTarget::stderr_with_hz(BAR_RATE)
        } else {
            ProgressDrawTarget::hidden()
        };
        let bar = ProgressBar::with_draw_target(Some(BAR_STEPS), target);
        // The words are ours, so that the style is as good as a constant.
        if let Ok(style) = ProgressStyle::with_template("{bar:24} {percent:>3} %  {msg}") {
            bar.set_style(style);
        }
        Self {
            time_limit: None,
            interrupt: None,
            deadline: None,
            is_stopped: false,
            energy: None,
            begun: Instant::now(),
            stage: None,
            seconds: BTreeMap::new(),
            bar,
            progress: Progress::new(Vec::new()),
        }
    }

    /// Starts a run of one stage now.
    pub fn start_only(stage: Stage) -> Self {
        let mut clock = Self::start();
        clock.plan(vec![PlannedStage { stage, time: 1.0 }]);
        clock
    }

    /// The stages that the run will pass, by which the bar moves.
    pub fn plan(&mut self, stages: Vec<PlannedStage>) {
        self.progress = Progress::new(stages);
    }

    /// Asks for the result from `time_limit` on, counted from the start, or when `interrupt` is set.
    pub fn ask_for_result(&mut self, time_limit: Option<Duration>, interrupt: Option<Arc<AtomicBool>>) {
        (self.time_limit, self.interrupt) = (time_limit, interrupt);
    }

    /// Ends the program `time` after the start: with what is there at half of it, or without a map.
    pub fn end_within(&mut self, time: Duration) {
        self.deadline = Some(Deadline::set(self.begun, time));
    }

    /// Why the run has no map, where the deadline has stopped it.
    pub fn missed_deadline(&self) -> Option<String> {
        self.deadline.as_ref().filter(|_| self.is_stopped).map(Deadline::sentence)
    }

    /// Seconds by stage and `total`, up to now; the bar goes.
    pub fn stop(mut self) -> BTreeMap<String, f64> {
        self.leave();
        if let Some(deadline) = &self.deadline {
            deadline.tell("Writing the files");
        }
        self.seconds.insert("total".into(), self.begun.elapsed().as_secs_f64());
        std::mem::take(&mut self.seconds)
    }

    /// Lets others write to the terminal, the bar out of their way.
    pub fn suspend(&self, write: impl FnOnce()) {
        self.bar.suspend(write);
    }

    fn leave(&mut self) {
        if let Some((stage, begun)) = self.stage.take() {
            let seconds = begun.elapsed().as_secs_f64();
            *self.seconds.entry(stage.to_string()).or_default() += seconds;
            // Progress that nobody can read is not worth failing for.
            let told = || drop(writeln!(std::io::stderr(), "{stage:<20} {seconds:8.3} s"));
            self.bar.suspend(told);
        }
    }

    /// The stage, and the number that it brings down.
    fn tell(&mut self, stage: Stage, step: Step) {
        let number = match (self.energy, step.residual) {
            (Some(energy), _) => format!(", energy {energy:.3}"),
            (None, Some(residual)) => format!(", residual {residual:.3e}"),
            (None, None) => String::new(),
        };
        self.bar.set_message(format!("{}{number}", stage.sentence()));
        let share = self.progress.at(stage, step.fraction);
        self.bar.set_position((share * BAR_STEPS as f64) as u64);
    }
}

impl Drop for Clock {
    /// No bar is left behind, also where the run ends in an error.
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Monitor for Clock {
    fn enter(&mut self, stage: Stage) {
        self.leave();
        self.stage = Some((stage, Instant::now()));
        if let Some(deadline) = &self.deadline {
            deadline.tell(stage.sentence());
        }
        self.energy = None;
        self.tell(stage, Step::default());
    }

    fn map_energy(&mut self, energy: f64) {
        self.energy = Some(energy);
    }

    fn wants_result(&self) -> bool {
        self.time_limit.is_some_and(|limit| self.begun.elapsed() >= limit)
            || self.interrupt.as_ref().is_some_and(|asked| asked.load(Ordering::Relaxed))
            || self.deadline.as_ref().is_some_and(Deadline::wants_result)
    }

    fn has_time(&self) -> bool {
        let stage = self.stage.map(|(stage, _)| stage);
        self.deadline.as_ref().is_none_or(|deadline| deadline.has_time(stage))
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        if !self.bar.is_hidden()
            && let Some((stage, _)) = self.stage
        {
            self.tell(stage, step);
        }
        self.is_stopped |= self.deadline.as_ref().is_some_and(Deadline::is_over);
        if self.is_stopped { Err(Cancelled) } else { Ok(()) }
    }
}
