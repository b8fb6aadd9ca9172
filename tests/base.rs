//! Base domains by quadric error simplification, drawn on both meshes of every real pair, in both directions.

mod common;

use conemap::base_domain;
use conemap::landmarks::Landmarks;
use conemap::layout::{self, LayoutError};
use conemap::monitor::Silent;

#[test]
fn every_simplified_base_domain_is_drawn_or_refused() {
    let Some(data) = common::data_folder("every_simplified_base_domain_is_drawn_or_refused") else { return };
    let (mut drawn, mut tried) = (0, 0);
    for name in common::pair_names(&data) {
        let pair = common::read_pair(&data, &name);
        let pairs = common::vertex_pairs(&pair.file);
        let swapped: Vec<_> = pairs.iter().map(|&[s, t]| [t, s]).collect();
        for (way, source, target, pairs) in [
            ("forwards", &pair.source, &pair.target, &pairs),
            ("backwards", &pair.target, &pair.source, &swapped),
        ] {
            tried += 1;
            let landmarks = Landmarks::from_vertices(source, target, pairs).unwrap();
            let base = base_domain::simplify(target, &landmarks.target, &mut Silent)
                .unwrap_or_else(|e| panic!("{name} {way}: {e}"));
            match layout::from_base([source, target], &landmarks, &base, &mut Silent) {
                Ok(layout) => {
                    drawn += 1;
                    for side in [&layout.source, &layout.target] {
                        side.validate(&layout.base).unwrap_or_else(|e| panic!("{name} {way}: {e}"));
                    }
                }
                Err(LayoutError::NoPath { .. } | LayoutError::Patches(_)) => {}
                Err(error) => panic!("{name} {way}: {error}"),
            }
        }
    }
    assert!(drawn > 0, "none of {tried} base domains was drawn");
}
