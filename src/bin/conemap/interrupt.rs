//! Ctrl-C: the first time the run is to finish with what it has, the second time the program ends.

use crate::told::say;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The exit code of a program that was ended by Ctrl-C.
const INTERRUPTED: i32 = 130;

/// The flag that the first Ctrl-C sets; `None` where the system lets nobody listen, and Ctrl-C ends the program.
pub fn listen() -> Option<Arc<AtomicBool>> {
    let asked = Arc::new(AtomicBool::new(false));
    let flag = asked.clone();
    let heard = move || {
        if flag.swap(true, Ordering::Relaxed) {
            // Nothing is written before the run has ended.
            std::process::exit(INTERRUPTED);
        }
        say("\nfinishing with the best map so far; Ctrl-C again ends without one");
    };
    ctrlc::set_handler(heard).is_ok().then_some(asked)
}
