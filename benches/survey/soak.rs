//! The memory that one process holds while it makes many maps.

use crate::arguments::Arguments;
use crate::case::Case;
use conemap::monitor::Silent;

/// The number of maps where the command line says nothing else (`--seeds`).
const RUNS: u64 = 200;
/// The number of maps after which the memory should no longer grow.
const WARM: u64 = 10;

/// Maps the small demos in turn, and prints the memory that the process holds after each tenth of the runs.
pub fn table(arguments: &Arguments) {
    let runs = if arguments.seeds > 1 { arguments.seeds } else { RUNS };
    let cases = ["horse-cat", "poses", "sphere-tetrahedron"].map(Case::of_demo);
    let mut warm = None;
    println!("{:>6} {:>12}  of {} demos in turn", "maps", "MiB held", cases.len());
    for count in 1..=runs {
        let case = &cases[(count - 1) as usize % cases.len()];
        if let Err(error) = case.run(&arguments.options, &mut Silent) {
            println!("{count:>6} {}: {error}", case.name);
        }
        let Some(held) = resident_mib() else {
            println!("this system does not tell what a process holds: use one with /proc");
            return;
        };
        if count == WARM {
            warm = Some(held);
        }
        if count == WARM || count % runs.div_ceil(10) == 0 {
            println!("{count:>6} {held:>12.1}");
        }
    }
    if let (Some(warm), Some(held)) = (warm, resident_mib()) {
        println!(
            "after {runs} maps {:+.1} MiB against {WARM} maps ({:+.1} %)",
            held - warm,
            100.0 * (held / warm - 1.0)
        );
    }
}

/// The memory that this process holds, in MiB; `None` where the system does not tell.
fn resident_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? / 1024.0)
}
