//! The way from the source's shape to the target's: how much edges change their lengths half-way, on straight lines and on the bent way,
//! and how closely one, two or three keys follow the bent way.

use crate::arguments::Arguments;
use crate::case::Case;
use conemap::landmarks::MeshSide;
use conemap::math::rigid3::laid_on;
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::run;
use conemap::transfer::deformation::Shape;
use conemap::transfer::morph::Morph;
use cpu_time::ThreadTime;
use glam::DVec3;
use typed_index_collections::TiSlice;

/// The times of the keys that are tried: one, two and three keys, evenly spaced.
const TRIED: [&[f64]; 3] = [&[0.5], &[1.0 / 3.0, 2.0 / 3.0], &[0.25, 0.5, 0.75]];
/// The times at which the way by keys is compared with the exact one.
const BETWEEN: [f64; 6] = [0.125, 0.375, 0.45, 0.55, 0.625, 0.875];

/// Prints a line for each demo's way from source to target (`--pairs NAME,...`: only the demos whose names begin so).
pub fn table(arguments: &Arguments) {
    println!(
        "edges of half-way shapes against the mean of both ends' lengths, in %: mean, 99 % quantile, largest"
    );
    println!(
        "off the exact way between keys, in % of the source's diagonal, by one, two and three keys; cpu s of three keys"
    );
    println!(
        "{:20} {:>7} {:>21} {:>21} {:>20} {:>6}",
        "demo", "faces", "straight", "bent", "off by keys", "cpu s"
    );
    for case in arguments.demos().into_iter().map(Case::of_demo) {
        match line(arguments, &case) {
            Ok(line) => println!("{:20} {line}", case.name),
            Err(error) => println!("{:20} FAILED: {error}", case.name),
        }
    }
}

fn line(arguments: &Arguments, case: &Case) -> Result<String, String> {
    let placed = case.placed()?;
    let input = Case::input(&placed);
    let result = run(input, &arguments.options, &mut Silent).map_err(|e| e.to_string())?;
    let map = result.correspondence.ok_or("the map has no pieces")?;
    let images = map.vertex_images([input.source, input.target], MeshSide::Source);
    let places: Option<Vec<DVec3>> =
        images.iter().map(|image| Some(image.as_ref()?.position(input.target))).collect();
    let places = places.ok_or("a vertex has no image")?;
    let mesh = input.source;
    let laid = laid_on(&places, &mesh.positions().raw);
    let end: Shape = places.iter().map(|p| laid.apply(*p)).collect();
    let begun = ThreadTime::now();
    let mut morph = Morph::new(mesh, &end);
    let mut bends = |time: f64| morph.bends(time, &mut Silent).map_err(|e| e.to_string());
    let tried = TRIED.iter().map(|keys| keys.iter().map(|key| bends(*key)).collect::<Result<Vec<_>, _>>());
    let tried = tried.collect::<Result<Vec<_>, _>>()?;
    // The keys that are tried take six solves, and three keys take half as many.
    let seconds = 0.5 * begun.elapsed().as_secs_f64();
    let exact = BETWEEN.iter().map(|time| bends(*time)).collect::<Result<Vec<_>, _>>()?;
    let half = |bend: &dyn Fn(VertexId) -> DVec3| -> Shape {
        mesh.vertices().map(|v| mesh.positions()[v].lerp(end[v], 0.5) + bend(v)).collect()
    };
    let straight = edge_errors(mesh, &end, &half(&|_| DVec3::ZERO));
    let bent = edge_errors(mesh, &end, &half(&|v| tried[0][0][v]));
    let off: Vec<String> = TRIED
        .iter()
        .zip(&tried)
        .map(|(keys, bends)| format!("{:.3}", 100.0 * off_by_keys(keys, bends, &exact) / diagonal(mesh)))
        .collect();
    Ok(format!("{:7} {straight} {bent} {:>20} {seconds:6.2}", mesh.face_count(), off.join(" ")))
}

/// The largest distance between the bends interpolated from the keys and the exact bends.
fn off_by_keys(keys: &[f64], bends: &[Shape], exact: &[Shape]) -> f64 {
    let mut most = 0.0_f64;
    for (&time, exact) in BETWEEN.iter().zip(exact) {
        let weight = |k: usize| {
            let ends = time * (1.0 - time) / (keys[k] * (1.0 - keys[k]));
            let others = (0..keys.len()).filter(|&j| j != k);
            others.fold(ends, |product, j| product * (time - keys[j]) / (keys[k] - keys[j]))
        };
        for (v, there) in exact.iter_enumerated() {
            let mixed: DVec3 = bends.iter().enumerate().map(|(k, bend)| bend[v] * weight(k)).sum();
            most = most.max(mixed.distance(*there));
        }
    }
    most
}

/// The relative difference between an edge's length and the mean of its lengths at both ends: mean, 99 % quantile and largest, in per cent.
fn edge_errors(mesh: &SurfaceMesh, end: &Shape, shape: &Shape) -> String {
    let off = |h| {
        let length = |points: &TiSlice<VertexId, DVec3>| points[mesh.tail(h)].distance(points[mesh.head(h)]);
        let mean = 0.5 * (length(mesh.positions()) + length(end));
        if mean > 0.0 { 100.0 * (length(shape) / mean - 1.0).abs() } else { 0.0 }
    };
    let mut all: Vec<f64> = mesh.edges().map(off).collect();
    all.sort_by(f64::total_cmp);
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    format!("{mean:6.2} {:7.1} {:6.1}", all[all.len() * 99 / 100], all[all.len() - 1])
}

fn diagonal(mesh: &SurfaceMesh) -> f64 {
    let corners = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let [low, high] = mesh.positions().iter().fold(corners, |[low, high], p| [low.min(*p), high.max(*p)]);
    high.distance(low)
}
