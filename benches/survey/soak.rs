//! The memory that one process holds while it makes many maps.

use crate::arguments::Arguments;
use crate::case::Case;
use crate::process_memory::held_mib;
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
        let Some(held) = held_mib(std::process::id()) else {
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
    if let (Some(warm), Some(held)) = (warm, held_mib(std::process::id())) {
        println!(
            "after {runs} maps {:+.1} MiB against {WARM} maps ({:+.1} %)",
            held - warm,
            100.0 * (held / warm - 1.0)
        );
    }
}
