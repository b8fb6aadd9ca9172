//! Both parametrisations onto the cone surface, certified, and their composition, on real pairs.
#![allow(clippy::unwrap_used, reason = "a failing helper is a failing test")]

mod common;

use conemap::layout::{self, LayoutOptions};
use conemap::mesh::{FaceId, SurfaceMesh, SurfacePoint};
use conemap::monitor::Silent;
use conemap::surface_map::measures::distortion;
use conemap::surface_map::measures::queries::PointMap;
use conemap::surface_map::overlay::location;
use conemap::surface_map::parametrisation::initial::{self, InitialOptions};
use conemap::surface_map::parametrisation::problem::FlatRelaxOptions;
use conemap::surface_map::{ConeSurface, Parametrised, certify, overlay};
use std::sync::Arc;

/// Poses of one animal, cats and lions, landmarks few and many, slivers, long limbs.
const PAIRS: [&str; 7] = [
    "cat-lion",
    "horse-camel",
    "horse-horse05",
    "shrec07-381-400",
    "shrec07-385-397",
    "shrec07-392-394",
    "shrec07-397-400",
];

#[test]
fn pairs_are_certified() {
    let Some(data) = common::data_folder("pairs_are_certified") else { return };
    PAIRS.iter().for_each(|name| is_certified(&common::read_pair(&data, name)));
}

fn is_certified(pair: &common::Pair) {
    let name = &pair.name;
    let landmarks = common::landmarks(pair);
    let options = LayoutOptions { attempts: 1, ..LayoutOptions::default() };
    let layout = layout::joint([&pair.source, &pair.target], &landmarks, &options, &mut Silent).unwrap();
    let surface = Arc::new(ConeSurface::of_layout(&layout).unwrap());
    let [source, target] = [&layout.source, &layout.target].map(|side| {
        let (start, _) = initial::embed(side, &surface, &InitialOptions::default(), &mut Silent)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let before = certify(side.parametrised(&start), &surface);
        assert!(before.bijective, "{name}: the start: {before:?}");
        let (end, report) =
            initial::relax(side.parametrised(&start), &surface, &FlatRelaxOptions::default(), &mut Silent)
                .unwrap();
        let after = certify(side.parametrised(&end), &surface);
        assert!(after.bijective && after.flipped_triangles == 0, "{name}: {after:?}");
        assert!(report.energies.is_sorted_by(|a, b| a >= b), "{name}: {:?}", report.energies);
        end
    });
    let source = layout.source.parametrised(&source);
    let target = layout.target.parametrised(&target);
    let locations = location::locate(source, target, &surface).unwrap_or_else(|e| panic!("{name}: {e}"));
    let overlay = overlay::overlay(source, target, &locations).unwrap_or_else(|e| panic!("{name}: {e}"));
    let measured = distortion::distortion(source, target, &overlay);
    // The pieces of the overlay cover both surfaces once, face by face.
    assert!(
        overlay.source_area_defect < 1e-9 && overlay.shifts == 0,
        "{name}: {}",
        overlay.source_area_defect
    );
    // Slivers of 0.01 degrees on the horse: 4.5e-10.
    assert!(overlay.target_area_defect < 1e-8, "{name}: {}", overlay.target_area_defect);
    assert!((measured.source_area - 1.0).abs() < 1e-9, "{name}: {}", measured.source_area);
    assert!((measured.target_area - 1.0).abs() < 1e-9, "{name}: {}", measured.target_area);
    returns(name, [source, target], &overlay);
    assert!(measured.energy >= 4.0 && measured.mean >= 1.0, "{name}: {}", measured.energy);
}

/// Source -> target -> source and back: 2000 points either way, by a generator with a fixed seed.
fn returns(name: &str, [source, target]: [Parametrised<'_>; 2], overlay: &overlay::Overlay) {
    let map = PointMap::new(source, target, overlay);
    let [from, onto] = [source, target].map(|side| side.mesh);
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut point = |mesh: &SurfaceMesh| {
        let face = FaceId::from((random() * mesh.face_count() as f64) as usize);
        let (u, v) = (random(), random());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        SurfacePoint { face, barycentric: [1.0 - u - v, u, v] }
    };
    let mut worst = 0.0_f64;
    for _ in 0..2000 {
        let (p, q) = (point(from), point(onto));
        let back = map.source_from_target(map.target_from_source(p));
        worst = worst.max(back.position(from).distance(p.position(from)));
        let there = map.target_from_source(map.source_from_target(q));
        worst = worst.max(there.position(onto).distance(q.position(onto)));
    }
    assert!(worst < 1e-9, "{name}: {worst}");
}
