//! A monitor that tells progress on standard error, takes the time of each stage, and asks for the result when the time is
//! up or the user wants it.

use conemap::monitor::{Cancelled, Monitor, Stage, Step};
use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Tells progress and takes times.
pub struct Clock {
    /// From then on the run is to finish.
    time_limit: Option<Duration>,
    /// Whether the user wants the result now.
    interrupt: Option<Arc<AtomicBool>>,
    /// Of the map that is being relaxed.
    energy: Option<f64>,
    begun: Instant,
    stage: Option<(Stage, Instant)>,
    seconds: BTreeMap<String, f64>,
    terminal: bool,
}

impl Clock {
    /// Starts now.
    pub fn start() -> Self {
        let terminal = std::io::stderr().is_terminal();
        Self {
            time_limit: None,
            interrupt: None,
            energy: None,
            begun: Instant::now(),
            stage: None,
            seconds: BTreeMap::new(),
            terminal,
        }
    }

    /// Asks for the result from `time_limit` on, counted from the start, or when `interrupt` is set.
    pub fn ask_for_result(&mut self, time_limit: Option<Duration>, interrupt: Option<Arc<AtomicBool>>) {
        (self.time_limit, self.interrupt) = (time_limit, interrupt);
    }

    /// Seconds by stage and `total`, up to now.
    pub fn stop(mut self) -> BTreeMap<String, f64> {
        self.leave();
        self.seconds.insert("total".into(), self.begun.elapsed().as_secs_f64());
        self.seconds
    }

    fn leave(&mut self) {
        if let Some((stage, begun)) = self.stage.take() {
            let seconds = begun.elapsed().as_secs_f64();
            *self.seconds.entry(stage.to_string()).or_default() += seconds;
            self.line(&format!("{stage:<20} {seconds:8.3} s\n"));
        }
    }

    /// Takes the line of progress away, before others are written.
    pub fn clear(&self) {
        if self.terminal {
            self.line("");
        }
    }

    fn line(&self, text: &str) {
        let start = if self.terminal { "\r\x1b[K" } else { "" };
        let mut stderr = std::io::stderr();
        // Progress that nobody can read is not worth failing for.
        let _ = write!(stderr, "{start}{text}").and_then(|()| stderr.flush());
    }
}

impl Monitor for Clock {
    fn enter(&mut self, stage: Stage) {
        self.leave();
        self.stage = Some((stage, Instant::now()));
        self.energy = None;
    }

    fn map_energy(&mut self, energy: f64) {
        self.energy = Some(energy);
    }

    fn wants_result(&self) -> bool {
        self.time_limit.is_some_and(|limit| self.begun.elapsed() >= limit)
            || self.interrupt.as_ref().is_some_and(|asked| asked.load(Ordering::Relaxed))
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        if self.terminal
            && let Some((stage, _)) = self.stage
        {
            let residual = match (self.energy, step.residual) {
                (Some(energy), _) => format!("  energy {energy:.3}"),
                (None, Some(residual)) => format!("  {residual:.3e}"),
                (None, None) => String::new(),
            };
            self.line(&format!("{stage:<20} {:5.1} %{residual}", 100.0 * step.fraction));
        }
        Ok(())
    }
}
