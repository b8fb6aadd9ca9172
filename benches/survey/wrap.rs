//! Bases laid onto scans, from file to file: the bases have quads and texture coordinates, the scans have holes.

use crate::arguments::Arguments;
use crate::case::Limit;
use crate::common;
use crate::punching::remove_around;
use crate::quads::obj_with_quads;
use conemap::export::obj;
use conemap::io::landmark_file;
use conemap::job::{Job, JobFiles, Normals, ReadOptions, WrappedFile};
use conemap::landmark_exchange::GivenFile;
use conemap::mesh::{FaceId, SurfaceMesh, VertexId};
use conemap::pipeline::Choices;
use cpu_time::ThreadTime;
use typed_index_collections::TiVec;

/// The holes that are punched into a scan.
struct Punch {
    name: &'static str,
    /// The landmarks of the pair around which the scan is punched, each with the share of the scan's area that is removed there.
    around: &'static [(usize, f64)],
}

const PUNCHES: [Punch; 9] = [
    Punch { name: "clean", around: &[] },
    Punch { name: "at 12", around: &[(12, 0.1)] },
    Punch { name: "at 3", around: &[(3, 0.1)] },
    Punch { name: "at 4", around: &[(4, 0.1)] },
    Punch { name: "at 20", around: &[(20, 0.1)] },
    Punch { name: "at 0", around: &[(0, 0.1)] },
    Punch { name: "at 7", around: &[(7, 0.1)] },
    Punch { name: "two places", around: &[(6, 0.05), (17, 0.05)] },
    Punch { name: "four places", around: &[(2, 0.025), (9, 0.025), (14, 0.025), (21, 0.025)] },
];

/// The pair files that are used, each with its base and its scan.
const PAIRS: [(&str, [&str; 2]); 6] = [
    ("cat-lion", ["cat", "lion"]),
    ("cat-dog", ["cat", "dog"]),
    ("horse-camel", ["horse", "camel"]),
    ("cat-lion", ["lion", "cat"]),
    ("cat-dog", ["dog", "cat"]),
    ("horse-camel", ["camel", "horse"]),
];

/// Wraps each base onto each scan, whole and with each set of holes.
pub fn bases(arguments: &Arguments) {
    println!(
        "{:14} {:12} {:>8} {:>8} {:>8} {:>23} {:>23} {:>4} {:>15} {:>6}",
        "pair",
        "holes",
        "covered",
        "on scan",
        "extended",
        "to scan: mean 95 max",
        "from: mean 95 max",
        "flip",
        "quads: was, is",
        "cpu s"
    );
    let wanted = |name: &str| arguments.variants.is_empty() || arguments.variants.iter().any(|v| v == name);
    let is_asked = |[base, scan]: [&str; 2]| {
        let name = format!("{base}-{scan}");
        arguments.pairs.is_empty() || arguments.pairs.iter().any(|p| name.starts_with(p.as_str()))
    };
    let pairs: Vec<_> = PAIRS.into_iter().filter(|(_, ends)| is_asked(*ends)).collect();
    let cases = pairs.iter().flat_map(|pair| PUNCHES.iter().map(move |punch| (pair, punch)));
    let queue: std::collections::VecDeque<_> = cases.filter(|(_, punch)| wanted(punch.name)).collect();
    let queue = std::sync::Mutex::new(queue);
    std::thread::scope(|scope| {
        for _ in 0..arguments.jobs.max(1) {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().expect("a queue").pop_front();
                    let Some(((pair, ends), punch)) = next else { break };
                    let begun = ThreadTime::now();
                    let outcome = wrapped(arguments, (pair, *ends), punch);
                    let seconds = begun.elapsed().as_secs_f64();
                    println!("{:14} {:12} {}", ends.join("-"), punch.name, line(&outcome, seconds));
                }
            });
        }
    });
}

/// Writes the files, reads them as a user's files, maps the base onto the scan and wraps it.
fn wrapped(
    arguments: &Arguments,
    (file, ends): (&str, [&str; 2]),
    punch: &Punch,
) -> Result<WrappedFile, String> {
    let mut pair = common::read_pair(&arguments.data, file);
    if !file.starts_with(ends[0]) {
        std::mem::swap(&mut pair.source, &mut pair.target);
        pair.file.pairs.iter_mut().for_each(|ends| ends.reverse());
    }
    let base = obj_with_quads(&pair.source, |_| true);
    let pairs = common::vertex_pairs(&pair.file);
    let mut is_gone: TiVec<FaceId, bool> = pair.target.faces().map(|_| false).collect();
    for &(landmark, share) in punch.around {
        let centre = VertexId(pairs[landmark][1]);
        remove_around(&pair.target, centre, share, &mut is_gone);
    }
    let is_left = |v: u32| pair.target.star(VertexId(v)).any(|h| !is_gone[h.face()]);
    let left = pair.file.pairs.iter().zip(&pairs).filter(|(_, [_, v])| is_left(*v)).map(|(p, _)| *p);
    pair.file.pairs = left.collect();
    (pair.file.labels, pair.file.ground_truth) = (None, None);
    let landmarks = landmark_file::write(&pair.file);
    let scan = scan(&pair.target, &is_gone);
    let files = JobFiles {
        source: &base,
        target: &scan,
        landmarks: &[GivenFile { name: "pairs.json", bytes: &landmarks }],
    };
    let mut limit = Limit::new(arguments.time_limit);
    let job = Job::read(files, ReadOptions::default(), &mut limit).map_err(|e| e.to_string())?;
    let result = job.run(&arguments.options, &mut limit).map_err(|e| e.to_string())?;
    let map = job.map_file(&result, &Choices::default()).ok_or("no pieces")?;
    let wrapped = job.taken(&map).wrapped(&base, Normals::Kept, &mut limit).map_err(|e| e.to_string())?;
    let lines = |bytes: &[u8]| -> Vec<Vec<u8>> {
        bytes.split(|b| *b == b'\n').filter(|line| !line.starts_with(b"v ")).map(<[u8]>::to_vec).collect()
    };
    assert!(lines(&wrapped.bytes) == lines(&base), "a line that is no vertex changed");
    Ok(wrapped)
}

/// The file of a scan without the removed faces.
fn scan(mesh: &SurfaceMesh, is_gone: &TiVec<FaceId, bool>) -> Vec<u8> {
    let left = mesh.triangles().iter_enumerated().filter(|(f, _)| !is_gone[*f]);
    obj::polygons(mesh.positions().as_ref(), left.map(|(_, corners)| corners.map(|v| v.0)))
}

fn line(outcome: &Result<WrappedFile, String>, seconds: f64) -> String {
    let file = match outcome {
        Ok(file) => file,
        Err(error) => return format!("FAILED: {error}"),
    };
    let report = &file.report.surface;
    let percent = |figures: &conemap::wrap::DistanceFigures| {
        let [mean, p95, max] = [figures.mean, figures.p95, figures.max].map(|share| 100.0 * share);
        format!("{mean:8.4} {p95:7.4} {max:6.2}")
    };
    let quads =
        file.report.quads.map_or(String::new(), |q| format!("{:.1} {:.1}", q.largest_before, q.largest));
    format!(
        "{:7.2}% {:8} {:8} {:>23} {:>23} {:4} {quads:>15} {seconds:6.1}",
        100.0 * report.covered,
        report.on_scan,
        report.extended,
        percent(&report.distance.to_scan),
        percent(&report.distance.from_scan),
        report.flipped_triangles
    )
}
