//! Both parametrisations onto the cone surface, certified, on real pairs.

mod common;

use conemap::landmarks::Landmarks;
use conemap::layout::{self, LayoutOptions};
use conemap::monitor::Silent;
use conemap::surface_map::compose::{self, Parametrised};
use conemap::surface_map::flat_problem::RelaxOptions;
use conemap::surface_map::{ConeSurface, certify, distortion, initial, overlay};

#[test]
fn pairs_are_certified() {
    let Some(data) = common::data_folder("pairs_are_certified") else { return };
    let only = std::env::var("PAIR").ok();
    let mut failures = Vec::new();
    for name in common::pair_names(&data).into_iter().filter(|n| only.as_ref().is_none_or(|o| n.contains(o)))
    {
        let pair = common::read_pair(&data, &name);
        let landmarks =
            Landmarks::from_vertices(&pair.source, &pair.target, &common::vertex_pairs(&pair.file)).unwrap();
        let options = LayoutOptions { attempts: 1, ..LayoutOptions::default() };
        let layout = layout::joint([&pair.source, &pair.target], &landmarks, &options, &mut Silent).unwrap();
        let surface = ConeSurface::of_layout(&layout).unwrap();
        let mut ends = Vec::new();
        for side in [&layout.source, &layout.target] {
            let begun = std::time::Instant::now();
            let start = initial::embed(side, &surface, &initial::InitialOptions::default(), &mut Silent);
            let (start, report) = match start {
                Ok(start) => start,
                Err(error) => {
                    println!("{name}: {error} {:.2} s", begun.elapsed().as_secs_f64());
                    failures.push(name.clone());
                    continue;
                }
            };
            let started = begun.elapsed().as_secs_f64();
            let before = certify(side, &surface, &start);
            let (end, relaxed) =
                initial::relax(side, &surface, &start, &RelaxOptions::default(), &mut Silent).unwrap();
            let after = certify(side, &surface, &end);
            println!(
                "{name}: {} faces, start {started:.2} s, rescued {}, steps {}, cg {}, {:.3} -> {:.4}, {:.2} s, {before:?} {after:?}",
                side.mesh.face_count(),
                report.rescued_vertices,
                relaxed.energies.len(),
                relaxed.cg_iterations,
                relaxed.energies[0],
                relaxed.energies.last().unwrap(),
                begun.elapsed().as_secs_f64()
            );
            if !after.bijective {
                failures.push(name.clone());
            }
            ends.push(end);
        }
        if let [source, target] = &ends[..] {
            let source = Parametrised { patched: &layout.source, embedding: source };
            let target = Parametrised { patched: &layout.target, embedding: target };
            let begun = std::time::Instant::now();
            let locations =
                compose::locate(source, target, &surface).unwrap_or_else(|e| panic!("{name}: {e}"));
            let t1 = begun.elapsed().as_secs_f64();
            let overlay = overlay::overlay(source, target, &locations);
            let t2 = begun.elapsed().as_secs_f64();
            let d = distortion::distortion(source, target, &overlay);
            println!(
                "{name}: E {:.3} mean {:.3} median {:.3} p95 {:.2} max {:.1} areas {:.3e} {:.3e} defect {:.2e} pieces {} locate {t1:.2} overlay {t2:.2}",
                d.energy,
                d.mean,
                d.median,
                d.p95,
                d.max,
                d.source_area - 1.0,
                d.target_area - 1.0,
                overlay.area_defect,
                overlay.pieces.len()
            );
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}
