//! Runs other programs in the project's folder.

use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// The project's folder.
pub fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The time after which a program is ended, unless it is a server: enough for a slow machine with an empty build folder.
const LIMIT: Duration = Duration::from_mins(40);

/// Runs a program in the project's folder and shows its output; fails where the program fails. The program gets no input. Where it takes
/// longer than `LIMIT`, it is ended with all processes that it has started.
pub fn run(program: &str, arguments: &[&str]) -> Result<(), String> {
    run_with(program, arguments, &[])
}

/// Runs a program as [`run`] does, with environment variables added.
pub fn run_with(program: &str, arguments: &[&str], variables: &[(&str, &str)]) -> Result<(), String> {
    run_within(LIMIT, program, arguments, variables)
}

/// Runs a program as [`run`] does, with a time limit of its own.
pub fn run_for(limit: Duration, program: &str, arguments: &[&str]) -> Result<(), String> {
    run_within(limit, program, arguments, &[])
}

/// Runs a program until it ends or the user ends it.
pub fn run_server(program: &str, arguments: &[&str]) -> Result<(), String> {
    let (mut command, said) = shown(program, arguments);
    judge(&said, command.status().map_err(|e| not_started(program, &e))?)
}

fn run_within(
    limit: Duration,
    program: &str,
    arguments: &[&str],
    variables: &[(&str, &str)],
) -> Result<(), String> {
    let (mut command, said) = shown(program, arguments);
    command.envs(variables.iter().copied()).stdin(Stdio::null());
    let mut child = command.spawn().map_err(|e| not_started(program, &e))?;
    let begun = Instant::now();
    while begun.elapsed() < limit {
        match child.try_wait() {
            Ok(Some(status)) => return judge(&said, status),
            Ok(None) => std::thread::sleep(Duration::from_millis(50)),
            Err(error) => return Err(format!("`{said}` could not be waited for ({error})")),
        }
    }
    end(&mut child);
    Err(format!("`{said}` was ended after {} minutes", limit.as_secs() / 60))
}

fn shown(program: &str, arguments: &[&str]) -> (Command, String) {
    let said = format!("{program} {}", arguments.join(" "));
    eprintln!("> {said}");
    let mut command = Command::new(program);
    command.args(arguments).current_dir(root());
    (command, said)
}

fn judge(said: &str, status: ExitStatus) -> Result<(), String> {
    if status.success() { Ok(()) } else { Err(format!("`{said}` failed ({status})")) }
}

fn not_started(program: &str, error: &std::io::Error) -> String {
    format!("{program} could not be started ({error})")
}

/// Ends a program and its descendants.
fn end(child: &mut Child) {
    for id in descendants(child.id()) {
        works("kill", &["-9", &id.to_string()]);
    }
    // `kill` fails where the program has ended by itself in the meantime.
    let _ = child.kill();
    let _ = child.wait();
}

/// The processes that a process has started, and those that they have started; empty where `ps` cannot tell.
fn descendants(ancestor: u32) -> Vec<u32> {
    let table = output_of("ps", &["-A", "-o", "pid=", "-o", "ppid="]).unwrap_or_default();
    let entry = |line: &str| {
        let mut numbers = line.split_whitespace().map(str::parse);
        Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
    };
    let processes: Vec<(u32, u32)> = table.lines().filter_map(entry).collect();
    let mut found = vec![ancestor];
    let mut next = 0;
    while let Some(&parent) = found.get(next) {
        found.extend(processes.iter().filter(|(_, of)| *of == parent).map(|(id, _)| *id));
        next += 1;
    }
    found.split_off(1)
}

/// Whether a program can be started with these arguments and succeeds; its output is dropped.
pub fn works(program: &str, arguments: &[&str]) -> bool {
    let mut command = Command::new(program);
    command
        .args(arguments)
        .current_dir(root())
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// What a program prints, without white space around it; `None` where the program fails.
pub fn output_of(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).current_dir(root()).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// Cargo, by the name under which it started this helper.
pub fn cargo() -> String {
    std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_hangs_is_ended_with_what_it_started() {
        let begun = Instant::now();
        let outcome =
            run_within(Duration::from_millis(300), "sh", &["-c", "sleep 4321 & sleep 4321; wait"], &[]);
        assert!(outcome.is_err_and(|sentence| sentence.contains("was ended")));
        assert!(begun.elapsed() < Duration::from_secs(30));
        // A process that was killed may be listed for a moment longer.
        let is_running = || {
            let running = output_of("ps", &["-A", "-o", "args="]).unwrap_or_default();
            running.lines().any(|line| line.starts_with("sleep 4321"))
        };
        while is_running() {
            assert!(begun.elapsed() < Duration::from_secs(30));
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    #[test]
    fn a_failing_program_is_named() {
        let outcome = run_within(Duration::from_secs(60), "sh", &["-c", "exit 3"], &[]);
        assert!(outcome.is_err_and(|sentence| sentence.contains("sh -c exit 3")));
    }
}
