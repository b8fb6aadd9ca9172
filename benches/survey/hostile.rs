//! Shapes and landmarks made to break the program: every case is to end in a certified map or in a sentence, in bounded time and memory.
//!
//! Each case runs in a process of its own, whose largest memory is read while it runs (on Linux).

use crate::arguments::Arguments;
use crate::process_memory::peak_mib;
use crate::watch::Watch;
use conemap::job::{Job, JobFiles, ReadOptions};
use conemap::landmark_exchange::GivenFile;
use conemap::monitor::Cancelled;
use conemap::pipeline::PipelineOptions;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Runs all cases, one after the other.
pub fn table(arguments: &Arguments) {
    println!(
        "{:22} {:>8} {:>9} {:>10}  {:34} outcome",
        "case", "seconds", "peak MiB", "silence ms", "longest silence of the monitor in"
    );
    for case in cases(arguments) {
        let name = name(&case);
        let program = std::env::current_exe().expect("this program");
        let child = Command::new(program)
            .args(["hostile-case", "--pairs", &name])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("a process");
        let begun = Instant::now();
        let (peak, told) = watched(child, Duration::from_secs_f64(arguments.time_limit));
        println!("{name:22} {:8.1} {peak:9.0} {}", begun.elapsed().as_secs_f64(), told.trim_end());
    }
}

/// Runs one case in this process and prints what `table` reads: the longest silence of the monitor, its stage, and the outcome.
pub fn case(arguments: &Arguments) {
    for case in cases(arguments).into_iter().filter(|case| name(case) == arguments.pairs[0]) {
        let mut watch = Watch::new(arguments);
        let outcome = mapped(&arguments.data, &case, &mut watch);
        let (stage, longest) = watch.longest();
        println!("{:10.0}  {stage:34} {outcome}", 1000.0 * longest.as_secs_f64());
    }
}

/// The landmark files of the cases that are asked for.
fn cases(arguments: &Arguments) -> Vec<PathBuf> {
    let folder = arguments.data.join("hostile/shapes");
    let entries = std::fs::read_dir(folder).expect("the folder of hostile shapes");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "json"));
    files.retain(|path| {
        arguments.pairs.is_empty() || arguments.pairs.iter().any(|wanted| name(path).starts_with(wanted))
    });
    files.sort();
    files
}

fn name(case: &Path) -> String {
    case.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

/// The paths of both meshes of a case, which the name of its landmark file tells.
fn meshes(name: &str) -> [String; 2] {
    let shape = |name: &str| format!("hostile/shapes/{}.off", if name == "sph" { "ico4" } else { name });
    let itself = |name: &str| [shape(name), shape(name)];
    match name {
        "adj-tri-pose" => ["horse", "horse-pose05"].map(|mesh| format!("sumner/{mesh}.off")),
        "adj-tri-self" => ["horse", "horse"].map(|mesh| format!("sumner/{mesh}.off")),
        "cat-lion-permuted33" => ["cat", "lion"].map(|mesh| format!("sumner/{mesh}.off")),
        "neighbours-self" => itself("ico3"),
        "ico1-16" => ["ico1", "ico1bent"].map(shape),
        "ico2-60" => ["ico2", "ico2bent"].map(shape),
        "cube-cube8" => itself("cube"),
        "octa-octa6" => itself("octa"),
        _ if name.starts_with("sphere-perm-") => itself("ico4"),
        // SOURCE-TARGET: the first hyphen separates the shapes, whose own names may hold another ("sliver1e-06").
        _ => {
            let (source, target) = name.split_once('-').unwrap_or((name, name));
            [shape(source), shape(target)]
        }
    }
}

fn mapped(data: &Path, case: &Path, monitor: &mut Watch) -> String {
    let read =
        |path: &Path| std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let [source, target] = meshes(&name(case)).map(|mesh| read(&data.join(mesh)));
    let landmarks = read(case);
    let landmarks = [GivenFile { name: "landmarks", bytes: &landmarks }];
    let files = JobFiles { source: &source, target: &target, landmarks: &landmarks };
    let job = match Job::read(files, ReadOptions::default(), monitor) {
        Ok(job) => job,
        Err(error) => return error.to_string(),
    };
    if job.findings(monitor).is_err() {
        return Cancelled.to_string();
    }
    match job.run(&PipelineOptions::default(), monitor) {
        Ok(result) => {
            let report = &result.report;
            let certified = report.certificate.as_ref().is_some_and(|certificate| certificate.bijective);
            let overlay = if result.correspondence.is_some() { "" } else { ", NO OVERLAY" };
            format!(
                "{}, E {:.3}, worst {:.1e}{overlay}",
                if certified { "certified" } else { "NOT CERTIFIED" },
                report.distortion.energy,
                report.distortion.max
            )
        }
        Err(error) => error.to_string(),
    }
}

/// Waits for a process, which is killed at the limit, and returns its largest memory in MiB and what it prints.
fn watched(mut child: Child, limit: Duration) -> (f64, String) {
    let begun = Instant::now();
    let mut peak = f64::NAN;
    let mut cut = false;
    while child.try_wait().expect("a process").is_none() {
        peak = peak.max(peak_mib(child.id()).unwrap_or(f64::NAN));
        cut = begun.elapsed() > limit;
        if cut {
            child.kill().expect("a process that runs");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    let output = child.wait_with_output().expect("what it prints");
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    match (cut, output.status.success()) {
        (true, _) => (peak, format!("{:10}  {:34} TIME LIMIT", "", "")),
        (_, false) => (peak, format!("{:10}  {:34} ENDED WITH {}", "", "", output.status)),
        _ => (peak, told),
    }
}
