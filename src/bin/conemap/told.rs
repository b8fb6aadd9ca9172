//! What the program says on standard error, and the results that it prints on standard output.
//!
//! Names and labels come from files of strangers: characters that would control a terminal are written as escapes.

use std::error::Error;
use std::fmt::Display;
use std::io::Write;

/// Says a line on standard error. Where that is closed or full nobody hears it, and nothing stops: it is never the result.
pub fn say(line: impl Display) {
    drop(writeln!(std::io::stderr(), "{}", harmless(&line.to_string())));
}

/// Prints a result on standard output; an error where it cannot be.
pub fn print(text: impl Display) -> Result<(), Box<dyn Error>> {
    let mut output = std::io::stdout().lock();
    let printed = writeln!(output, "{}", harmless(&text.to_string())).and_then(|()| output.flush());
    printed.map_err(|e| format!("standard output: {e}").into())
}

/// The text with control characters, but ends of lines and tabs, and marks that turn the direction of writing as their escapes.
fn harmless(text: &str) -> String {
    let steers = |c: char| {
        (c.is_control() && !matches!(c, '\n' | '\t'))
            || matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let mut told = String::with_capacity(text.len());
    for c in text.chars() {
        if steers(c) { told.extend(c.escape_unicode()) } else { told.push(c) }
    }
    told
}

#[cfg(test)]
mod tests {
    use super::harmless;

    #[test]
    fn what_would_steer_a_terminal_is_written_as_its_escape() {
        assert_eq!(harmless("left ear\n\tnäse"), "left ear\n\tnäse");
        assert_eq!(harmless("\u{1b}[2Jgone\r\u{9b}1m\u{202e}"), "\\u{1b}[2Jgone\\u{d}\\u{9b}1m\\u{202e}");
    }
}
