//! The base domain drawn on real pairs: every invariant that the later stages rely on.

mod common;

use conemap::landmarks::Landmarks;
use conemap::layout::{self, LayoutOptions};
use conemap::monitor::Silent;

#[test]
fn every_pair_has_a_valid_layout() {
    let Some(data) = common::data_folder("every_pair_has_a_valid_layout") else { return };
    for name in common::pair_names(&data) {
        let pair = common::read_pair(&data, &name);
        let landmarks =
            Landmarks::from_vertices(&pair.source, &pair.target, &common::vertex_pairs(&pair.file)).unwrap();
        let options = LayoutOptions { attempts: 1, ..LayoutOptions::default() };
        let begun = std::time::Instant::now();
        let layout = layout::joint([&pair.source, &pair.target], &landmarks, &options, &mut Silent)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        println!(
            "{name}: detour {:.2}, worst {:.2}, {:.2} s",
            layout.report.detour,
            layout.report.worst_stretch,
            begun.elapsed().as_secs_f64()
        );
        layout.source.validate(&layout.base).unwrap_or_else(|e| panic!("{name}: source: {e}"));
        layout.target.validate(&layout.base).unwrap_or_else(|e| panic!("{name}: target: {e}"));
        assert!((layout.source.mesh.area() - 1.0).abs() < 1e-9);
        let angles: f64 = layout.base.cone_angles().iter().sum();
        let defects = std::f64::consts::TAU * landmarks.len() as f64 - angles;
        assert!((defects - 2.0 * std::f64::consts::TAU).abs() < 1e-9, "Gauss-Bonnet of {name}: {defects}");
    }
}
