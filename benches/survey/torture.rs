//! Generated hostile geometry: every case must end in a certified map that `conemap_verify` proves, too, or in a typed error, within bounds of
//! time and memory.
//!
//! Each case runs in a process of its own, which ends itself where it takes more processor time or memory than its number of faces allows. A
//! panic, a broken bound and a map that `conemap_verify` rejects are findings, and with a finding the command fails.

use crate::arguments::Arguments;
use crate::hostile_geometry::{Kind, Size, case};
use crate::judged_job::{Files, Outcome, mapped};
use crate::process_memory::peak_mib;
use crate::watch::Watch;
use cpu_time::ProcessTime;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The seconds of processor time that every case may take, and the seconds that each face of both meshes adds.
const SECONDS: [f64; 2] = [120.0, 1e-3];
/// The memory in MiB that every case may take, and the MiB that each face of both meshes adds.
const MIB: [f64; 2] = [400.0, 0.01];

/// The exit code of a process that broke a bound.
const BROKE_BOUND: i32 = 9;

/// Runs cases of all kinds in turn until the time is over, then prints their outcomes by kind.
pub fn table(arguments: &Arguments) {
    let kinds: Vec<Kind> = Kind::ALL.into_iter().filter(|kind| is_asked_for(*kind, arguments)).collect();
    let begun = Instant::now();
    let limit = Duration::from_secs_f64(60.0 * arguments.minutes);
    let mut sums: BTreeMap<Kind, Sum> = BTreeMap::new();
    let mut findings = Vec::new();
    let mut errors = BTreeMap::new();
    'time: for seed in arguments.seed.. {
        for &kind in &kinds {
            if begun.elapsed() > limit {
                break 'time;
            }
            let name = format!("{}-{seed}", kind.name());
            let told = in_a_process(&name);
            let sum = sums.entry(kind).or_default();
            sum.add(&told);
            if told["outcome"] == "error" {
                let of = |field: &str| told[field].as_str().unwrap_or_default().to_owned();
                errors.entry(of("error")).or_insert_with(|| (name.clone(), of("sentence")));
            }
            if told["outcome"] == "finding" {
                let line = format!("{name}: {}", told["sentence"].as_str().unwrap_or_default());
                println!("FINDING {line}");
                findings.push(line);
            }
        }
    }
    print_table(&sums, arguments, begun.elapsed());
    for (error, (name, sentence)) in &errors {
        println!("{error}: first {name}: {sentence}");
    }
    println!(
        "{} findings; a case may take {} s of processor time and {} ms a face, {} MiB and {} KiB a face",
        findings.len(),
        SECONDS[0],
        1000.0 * SECONDS[1],
        MIB[0],
        1024.0 * MIB[1]
    );
    if !findings.is_empty() {
        findings.iter().for_each(|line| println!("FINDING {line}"));
        println!("one of them again: cargo xtask torture --case NAME");
        std::process::exit(1);
    }
}

fn is_asked_for(kind: Kind, arguments: &Arguments) -> bool {
    arguments.pairs.is_empty() || arguments.pairs.iter().any(|name| name == kind.name())
}

/// Runs the named cases in this process; each prints a line of JSON.
pub fn cases(arguments: &Arguments) {
    for name in &arguments.pairs {
        let (kind, seed) = name.rsplit_once('-').expect("KIND-SEED");
        let kind = Kind::of(kind).expect("a known kind");
        let seed: u64 = seed.parse().expect("a whole number");
        let files = case(kind, seed, Size::Any);
        let faces = files.meshes.iter().map(|mesh| mesh.face_count()).sum::<usize>();
        let files = Files::from(files);
        std::thread::spawn(move || keep_bounds(faces));
        let mut watch = Watch::new(arguments);
        let mapped = mapped(&files, &mut watch);
        let (stage, silence) = watch.longest();
        let outcome = mapped.map_or_else(|outcome| outcome, |mapped| mapped.judged(&files));
        let mut told = told_of(&outcome);
        told["faces"] = json!(faces);
        told["seconds"] = json!(ProcessTime::now().as_duration().as_secs_f64());
        told["silence"] = json!(silence.as_secs_f64());
        told["stage"] = json!(stage);
        told["mib"] = json!(peak_mib(std::process::id()));
        println!("{told}");
    }
}

/// Ends the process as soon as it has taken more time or memory than a case of so many faces may.
fn keep_bounds(faces: usize) {
    let [seconds, mib] = [SECONDS, MIB].map(|[least, each]| least + each * faces as f64);
    loop {
        std::thread::sleep(Duration::from_millis(50));
        let taken = ProcessTime::now().as_duration().as_secs_f64();
        let held = peak_mib(std::process::id()).unwrap_or(0.0);
        if taken > seconds || held > mib {
            println!(
                "{}",
                json!({
                    "outcome": "finding",
                    "sentence": format!("{faces} faces took {taken:.0} s of processor time, {held:.0} MiB"),
                    "seconds": taken,
                    "mib": held,
                })
            );
            std::process::exit(BROKE_BOUND);
        }
    }
}

fn told_of(outcome: &Outcome) -> Value {
    match outcome {
        Outcome::Proved => json!({ "outcome": "proved" }),
        Outcome::ProvedWithinRounding { triangles } => {
            json!({ "outcome": "rounded", "triangles": triangles })
        }
        Outcome::Certified { without_file } => json!({ "outcome": without_file }),
        Outcome::Refused { name, sentence } => {
            json!({ "outcome": "error", "error": name, "sentence": sentence })
        }
        Outcome::Stopped => {
            json!({ "outcome": "finding", "sentence": "it was stopped, and nobody asked for it" })
        }
        Outcome::Wrong(why) => json!({ "outcome": "finding", "sentence": why }),
    }
}

/// Runs a case in a process of its own and returns the JSON that it prints; a panic is a finding.
fn in_a_process(name: &str) -> Value {
    let program = std::env::current_exe().expect("this program");
    let output = Command::new(program)
        .args(["torture-case", "--pairs", name])
        .stdin(Stdio::null())
        .output()
        .expect("a process");
    let printed = String::from_utf8_lossy(&output.stdout);
    let told = printed.lines().last().and_then(|line| serde_json::from_str(line).ok());
    match (told, output.status.code()) {
        (Some(told), Some(0 | BROKE_BOUND)) => told,
        _ => {
            let said = String::from_utf8_lossy(&output.stderr);
            let said: Vec<&str> = said.lines().filter(|line| !line.is_empty()).take(3).collect();
            json!({ "outcome": "finding", "sentence": format!("{}: {}", output.status, said.join(" ")) })
        }
    }
}

/// The outcomes of the cases of a kind.
#[derive(Default)]
struct Sum {
    count: usize,
    by_outcome: BTreeMap<String, usize>,
    errors: BTreeMap<String, usize>,
    /// The largest processor time of a case, in seconds.
    seconds: f64,
    /// The longest silence of a monitor, in seconds, and the stage it fell in.
    silence: (f64, String),
    /// The largest memory of a case, in MiB.
    mib: f64,
}

impl Sum {
    fn add(&mut self, told: &Value) {
        self.count += 1;
        let text = |field: &str| told[field].as_str().unwrap_or_default().to_owned();
        *self.by_outcome.entry(text("outcome")).or_default() += 1;
        if told["outcome"] == "error" {
            *self.errors.entry(text("error")).or_default() += 1;
        }
        let number = |field: &str| told[field].as_f64().unwrap_or(0.0);
        self.seconds = self.seconds.max(number("seconds"));
        self.mib = self.mib.max(number("mib"));
        if number("silence") > self.silence.0 {
            self.silence = (number("silence"), text("stage"));
        }
    }

    fn of(&self, outcome: &str) -> usize {
        self.by_outcome.get(outcome).copied().unwrap_or(0)
    }
}

fn print_table(sums: &BTreeMap<Kind, Sum>, arguments: &Arguments, took: Duration) {
    println!(
        "\n{:13} {:>6} {:>7} {:>8} {:>9} {:>11} {:>7} {:>9} {:>10} {:>9}  {:34} errors",
        "kind",
        "cases",
        "proved",
        "rounded",
        "repaired",
        "no overlay",
        "errors",
        "longest s",
        "silence ms",
        "peak MiB",
        "longest silence in"
    );
    for (kind, sum) in sums {
        let errors: Vec<String> = sum.errors.iter().map(|(name, count)| format!("{count} {name}")).collect();
        println!(
            "{:13} {:6} {:7} {:8} {:9} {:11} {:7} {:9.1} {:10.0} {:9.0}  {:34} {}",
            kind.name(),
            sum.count,
            sum.of("proved"),
            sum.of("rounded"),
            sum.of("repaired"),
            sum.of("no overlay"),
            sum.of("error"),
            sum.seconds,
            1000.0 * sum.silence.0,
            sum.mib,
            sum.silence.1,
            errors.join(", ")
        );
    }
    let (count, minutes) = (sums.values().map(|sum| sum.count).sum::<usize>(), took.as_secs_f64() / 60.0);
    println!("{count} cases in {minutes:.0} minutes from seed {}", arguments.seed);
}
