//! The memory that a map takes for each face of its meshes, from the first byte read to the last file written.

use crate::arguments::Arguments;
use crate::job_files::files;
use crate::judged_job::mapped;
use crate::process_memory::peak_mib;
use conemap::job::{LEAST_MEMORY, MEMORY_PER_FACE};
use conemap::monitor::Silent;
use std::process::Command;

/// Prints a line for each ball of 5,000 to 82,000 faces, or for the pairs and meshes that are named. Each is mapped in a process of its
/// own, so that the largest memory of the process is that of this map.
pub fn table(arguments: &Arguments) {
    let names = ["ball-4", "ball-5", "ball-6"].map(str::to_owned).to_vec();
    let names = if arguments.pairs.is_empty() { names } else { arguments.pairs.clone() };
    println!("{:24} {:>9} {:>9} {:>12} {:>12}", "meshes", "faces", "MiB", "KiB a face", "foretold MiB");
    for name in names {
        let program = std::env::current_exe().expect("this program");
        let status =
            Command::new(program).args(["memory-case", "--pairs", &name]).status().expect("a process");
        if !status.success() {
            println!("{name:24} {status}");
        }
    }
}

/// Maps the named meshes in this process and prints their lines.
pub fn case(arguments: &Arguments) {
    for name in &arguments.pairs {
        let files = files(arguments, name);
        let before = peak_mib(std::process::id());
        let mapped = match mapped(&files, &mut Silent) {
            Ok(mapped) => mapped,
            Err(outcome) => return println!("{name:24} {outcome:?}"),
        };
        let written: usize = mapped.outputs().map(|file| file.bytes.len()).sum();
        let faces = mapped.report().faces.source + mapped.report().faces.target;
        let (Some(before), Some(peak)) = (before, peak_mib(std::process::id())) else {
            return println!("this system does not tell what a process holds: use one with /proc");
        };
        let taken = peak - before;
        let foretold = (LEAST_MEMORY + MEMORY_PER_FACE * faces as u64) as f64 / 1024.0 / 1024.0;
        println!(
            "{name:24} {faces:>9} {taken:>9.0} {:>12.1} {foretold:>12.0}  with {:.0} MiB of files",
            1024.0 * taken / faces as f64,
            written as f64 / 1024.0 / 1024.0
        );
    }
}
