//! The base domain drawn on real pairs: every invariant that the later stages rely on.

mod common;

use conemap::layout::{self, LayoutOptions};
use conemap::monitor::Silent;
use std::f64::consts::TAU;

#[test]
fn every_pair_has_a_valid_layout() {
    let Some(data) = common::data_folder("every_pair_has_a_valid_layout") else { return };
    let options = LayoutOptions { attempts: 1, ..LayoutOptions::default() };
    for name in common::pair_names(&data) {
        let pair = common::read_pair(&data, &name);
        let landmarks = common::landmarks(&pair);
        let layout = layout::joint([&pair.source, &pair.target], &landmarks, &options, &mut Silent)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(layout.base.mesh.vertex_count(), landmarks.len(), "{name}");
        assert_eq!(layout.base.mesh.face_count(), 2 * landmarks.len() - 4, "{name}");
        for side in [&layout.source, &layout.target] {
            side.validate(&layout.base).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert!((side.mesh.area() - 1.0).abs() < 1e-9, "{name}");
        }
        let angles: f64 = layout.base.cone_angles().iter().sum();
        let defects = TAU * landmarks.len() as f64 - angles;
        assert!((defects - 2.0 * TAU).abs() < 1e-9, "Gauss-Bonnet of {name}: {defects}");
    }
}
