//! A monitor that tells progress on standard error and takes the time of each stage.

use conemap::monitor::{Cancelled, Monitor, Stage, Step};
use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::time::Instant;

/// Tells progress and takes times.
pub struct Clock {
    begun: Instant,
    stage: Option<(Stage, Instant)>,
    seconds: BTreeMap<String, f64>,
    terminal: bool,
}

impl Clock {
    /// Starts now.
    pub fn start() -> Self {
        let terminal = std::io::stderr().is_terminal();
        Self { begun: Instant::now(), stage: None, seconds: BTreeMap::new(), terminal }
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
            *self.seconds.entry(name(stage)).or_default() += seconds;
            self.line(&format!("{:<20} {seconds:8.3} s\n", name(stage)));
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
    }

    fn step(&mut self, step: Step) -> Result<(), Cancelled> {
        if self.terminal
            && let Some((stage, _)) = self.stage
        {
            let residual = step.residual.map_or_else(String::new, |r| format!("  {r:.3e}"));
            self.line(&format!("{:<20} {:5.1} %{residual}", name(stage), 100.0 * step.fraction));
        }
        Ok(())
    }
}

/// The stage's name as in the report.
pub fn name(stage: Stage) -> String {
    match serde_json::to_value(stage) {
        Ok(serde_json::Value::String(name)) => name,
        _ => format!("{stage:?}"),
    }
}
