//! The thesis' patchwise map on real pairs: what it leaves out is told.

mod common;

use conemap::monitor::Silent;
use conemap::pipeline::{GroundTruth, Method, PipelineOptions, Warning, run};

#[test]
fn the_patchwise_map_of_cat_and_lion_tells_what_is_missing() {
    let Some(data) = common::data_folder("the_patchwise_map_of_cat_and_lion_tells_what_is_missing") else {
        return;
    };
    let pair = common::read_pair(&data, "cat-lion");
    let landmarks = common::landmarks(&pair);
    let input = pair.input(&landmarks, GroundTruth::Unknown);
    let options = PipelineOptions { method: Method::Thesis, ..PipelineOptions::default() };
    let result = run(input, &options, &mut Silent).unwrap();
    let report = &result.report;
    assert!(report.certificate.is_none());
    assert!((0.0..0.3).contains(&report.unmapped_share), "{}", report.unmapped_share);
    let unmapped = result.target_from_source.iter().filter(|image| image.is_none()).count();
    assert_eq!(report.unmapped_share, unmapped as f64 / pair.source.vertex_count() as f64);
    if unmapped > 0 {
        assert!(
            report.warnings.iter().any(|w| matches!(w, Warning::Unmapped { .. })),
            "{:?}",
            report.warnings
        );
    }
    assert!(report.distortion.mean >= 1.0 && report.distortion.mean.is_finite());
    for (&s, &t) in landmarks.source.iter().zip(&landmarks.target) {
        let image = result.target_from_source[s].expect("landmarks have images");
        let scale = pair.target.area().sqrt();
        assert!(image.position(&pair.target).distance(pair.target.positions()[t]) < 1e-9 * scale);
    }
    let common = &result.common;
    assert!(!common.triangles.is_empty() && common.triangles.len() <= pair.source.face_count());
    assert!(common.uvs.iter().all(|uv| uv.is_finite()));
}
