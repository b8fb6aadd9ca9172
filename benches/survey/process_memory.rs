//! The memory that a process holds, as Linux tells it under /proc.

/// The most memory that a process has held so far, in MiB; `None` where the system does not tell.
pub fn peak_mib(process: u32) -> Option<f64> {
    mib(process, "VmHWM:")
}

/// The memory that a process holds now, in MiB; `None` where the system does not tell.
pub fn held_mib(process: u32) -> Option<f64> {
    mib(process, "VmRSS:")
}

/// A line of the file `status` of a process, which gives KiB, in MiB.
fn mib(process: u32, field: &str) -> Option<f64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with(field))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? / 1024.0)
}
