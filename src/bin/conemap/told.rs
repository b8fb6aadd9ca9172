//! What the program says on standard error, and the results that it prints on standard output.

use std::error::Error;
use std::fmt::Display;
use std::io::Write;

/// Says a line on standard error. Where that is closed or full nobody hears it, and nothing stops: it is never the result.
pub fn say(line: impl Display) {
    drop(writeln!(std::io::stderr(), "{line}"));
}

/// Prints a result on standard output; an error where it cannot be.
pub fn print(text: impl Display) -> Result<(), Box<dyn Error>> {
    let mut output = std::io::stdout().lock();
    let printed = writeln!(output, "{text}").and_then(|()| output.flush());
    printed.map_err(|e| format!("standard output: {e}").into())
}
