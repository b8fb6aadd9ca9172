//! `--deadline`: the program ends by then, with a map or with a sentence.
//!
//! From half of the time on the run is to finish with what it has, and what it makes beside a whole map is left out where it would take
//! too long; at the deadline its monitor stops it. Where the program is busy
//! with something that asks no monitor, such as a disk, it ends by itself a little later.

use crate::told::say;
use conemap::monitor::Stage;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The share of the time after which the run is to finish: on the largest meshes, finishing takes about as long as what comes
/// before.
const FINISH_FROM: f64 = 0.5;

/// The share of the time after which the cone metrics are left out, beside a map that is whole: what comes after them needs the rest.
/// Chosen by hand.
const METRICS_UNTIL: f64 = 0.75;

/// The share of the time after which the map is written without its overlay. Chosen by hand.
const PARTS_UNTIL: f64 = 0.9;

/// The time after the deadline at which the program ends by itself; two seconds are promised.
const GRACE: Duration = Duration::from_millis(1500);

/// The exit code of a program without a map.
const FAILED: i32 = 1;

/// When the program must have ended, and what it does meanwhile.
pub struct Deadline {
    begun: Instant,
    time: Duration,
    doing: Arc<Mutex<&'static str>>,
}

impl Deadline {
    /// Ends the program `time` after `begun`, or a little later.
    pub fn set(begun: Instant, time: Duration) -> Self {
        let doing = Arc::new(Mutex::new("Reading the files"));
        let watched = doing.clone();
        std::thread::spawn(move || {
            std::thread::sleep(time.saturating_add(GRACE).saturating_sub(begun.elapsed()));
            let doing = *watched.lock().unwrap_or_else(PoisonError::into_inner);
            say(format_args!("conemap: {}", sentence(time, doing)));
            std::process::exit(FAILED);
        });
        Self { begun, time, doing }
    }

    /// Sets the text for what the program does from now on.
    pub fn tell(&self, doing: &'static str) {
        *self.doing.lock().unwrap_or_else(PoisonError::into_inner) = doing;
    }

    /// Whether the run is to finish.
    pub fn wants_result(&self) -> bool {
        self.begun.elapsed() >= self.time.mul_f64(FINISH_FROM)
    }

    /// Whether there is time for what a stage makes beside the map.
    pub fn has_time(&self, stage: Option<Stage>) -> bool {
        let until = match stage {
            Some(Stage::SourceConeMetric | Stage::TargetConeMetric) => METRICS_UNTIL,
            _ => PARTS_UNTIL,
        };
        self.begun.elapsed() < self.time.mul_f64(until)
    }

    /// Whether the time is up.
    pub fn is_over(&self) -> bool {
        self.begun.elapsed() >= self.time
    }

    /// Why there is no map once the time is up.
    pub fn sentence(&self) -> String {
        sentence(self.time, *self.doing.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

fn sentence(time: Duration, doing: &str) -> String {
    format!(
        "no map within the deadline of {} s; it passed during the stage \"{doing}\". Give more time, or meshes of fewer faces \
         (`conemap remesh`)",
        time.as_secs_f64()
    )
}
