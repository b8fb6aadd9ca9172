//! Tests of borders that correspond: a body and a bent copy, whose true map is known, both without a leg, compared with maps that treat the
//! cuts as holes in the data.

use crate::common::farthest_points;
use crate::cutting::{Cuts, Kept, Open, Plane, rim_distances};
use crate::fixtures;
use conemap::landmarks::Landmarks;
use conemap::mesh::{FaceId, SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{
    BorderCase, Borders, CapFaces, GroundTruth, MapInput, MapResult, PipelineOptions, Warning, run,
};
use glam::DVec3;
use typed_index_collections::TiVec;

/// A horse and the same horse bent sideways along its length; vertex i corresponds to vertex i.
struct Poses {
    meshes: [SurfaceMesh; 2],
    leg: Cuts,
    head: Cuts,
    /// Vertices far from each other that no cut takes away.
    landmarks: Vec<VertexId>,
}

impl Poses {
    fn new() -> Self {
        let horse = conemap::demo::build("horse-cat").unwrap().source;
        let bent = fixtures::bent(&horse);
        let height = |v: &VertexId| horse.positions()[*v].y;
        let end = |upwards: f64| {
            horse.vertices().max_by(|a, b| (upwards * height(a)).total_cmp(&(upwards * height(b)))).unwrap()
        };
        let cut = |upwards: f64| {
            let end = end(upwards);
            let normal = DVec3::Y * upwards;
            Cuts::new(&horse, &[(Plane { point: horse.positions()[end] - 0.5 * normal, normal }, end)])
        };
        let (leg, head) = (cut(-1.0), cut(1.0));
        let is_left = |v: &VertexId| !leg.is_beyond(*v) && !head.is_beyond(*v);
        let landmarks = farthest_points(&horse, 24).into_iter().filter(is_left).collect();
        Self { meshes: [horse, bent], leg, head, landmarks }
    }

    fn cut(&self, cuts: [&Cuts; 2]) -> [Open; 2] {
        [0, 1].map(|k| Open::new(cuts[k].cut(&self.meshes[k], Kept::Body, 1)))
    }

    fn map(&self, sides: [&Open; 2], borders: Borders) -> MapResult {
        let on = |side: &Open| self.landmarks.iter().map(|v| side.vertex(v.0)).collect();
        let landmarks = Landmarks { source: on(sides[0]), target: on(sides[1]) };
        let input = MapInput {
            source: &sides[0].checked.mesh,
            target: &sides[1].checked.mesh,
            landmarks: &landmarks,
            ground_truth: GroundTruth::Unknown,
            caps: CapFaces { source: sides[0].checked.caps(), target: sides[1].checked.caps() },
        };
        let result =
            run(input, &PipelineOptions { borders, ..PipelineOptions::default() }, &mut Silent).unwrap();
        assert!(result.report.certificate.as_ref().unwrap().bijective);
        result
    }
}

#[test]
fn rim_goes_to_rim_where_both_meshes_end_there() {
    let poses = Poses::new();
    let sides = poses.cut([&poses.leg; 2]);
    let [source, target] = &sides;
    let unknown = poses.map([source, target], Borders::Missing);
    let guessed = poses.map([source, target], Borders::Guess);
    let [without, with] = [&unknown, &guessed].map(|result| rim_distances(&sides, result));
    assert!(with[0] < 0.003 && with[0] < 0.7 * without[0], "{with:?} {without:?}");
    let hidden = |result: &MapResult| result.report.coverage.as_ref().unwrap().hidden;
    assert!(hidden(&guessed) < 0.8 * hidden(&unknown), "{} {}", hidden(&guessed), hidden(&unknown));
    let [energy, free] = [&guessed, &unknown].map(|result| result.report.distortion.energy);
    assert!(energy < 1.02 * free, "{energy} {free}");

    // The report says which rims were taken to correspond, and that this was guessed.
    let told = unknown.report.borders.as_ref().unwrap();
    assert_eq!((told.case, told.asked, told.rims.len()), (BorderCase::Missing, Borders::Missing, 0));
    let told = guessed.report.borders.as_ref().unwrap();
    assert_eq!((told.case, told.asked, told.rims.len()), (BorderCase::Corresponding, Borders::Guess, 1));
    assert!(told.rims[0].misfit < 0.03, "{told:?}");
    assert_eq!(told.rims[0].source.vertices, source.cut.rim.len());
    let is_warning = |w: &Warning| matches!(w, Warning::GuessedBorders { rims: 1 });
    assert!(guessed.report.warnings.iter().any(is_warning), "{:?}", guessed.report.warnings);
    assert!(!unknown.report.warnings.iter().any(is_warning));

    // Exchanged meshes give the inverse map.
    let back = poses.map([target, source], Borders::Guess).report;
    assert!((back.distortion.energy / energy - 1.0).abs() < 1e-9);
    let exchanged = back.borders.as_ref().unwrap();
    assert_eq!(exchanged.rims[0].source, told.rims[0].target);
    assert_eq!(exchanged.rims[0].target, told.rims[0].source);
}

#[test]
fn cuts_at_different_limbs_are_not_guessed_to_correspond() {
    let poses = Poses::new();
    let sides = poses.cut([&poses.leg, &poses.head]);
    let told = poses.map([&sides[0], &sides[1]], Borders::Guess).report.borders.unwrap();
    assert_eq!((told.case, told.rims.len()), (BorderCase::Missing, 0));
}

#[test]
fn closed_meshes_are_mapped_bit_for_bit_alike_whatever_is_said_of_borders() {
    let case = fixtures::demo("sphere-tetrahedron");
    let no_cap: [TiVec<FaceId, bool>; 2] =
        [&case.source, &case.target].map(|mesh| mesh.faces().map(|_| false).collect());
    let map = |borders: Borders, caps: CapFaces<'_>| {
        let input = MapInput { caps, ..MapInput::new(&case.source, &case.target, &case.landmarks) };
        run(input, &PipelineOptions { borders, ..PipelineOptions::default() }, &mut Silent).unwrap()
    };
    let usual = map(Borders::Guess, CapFaces::default());
    assert!(usual.report.borders.is_none() && usual.report.coverage.is_none());
    let marked = CapFaces { source: Some(&no_cap[0]), target: Some(&no_cap[1]) };
    for (borders, caps) in [
        (Borders::Missing, CapFaces::default()),
        (Borders::Corresponding, CapFaces::default()),
        (Borders::Guess, marked),
    ] {
        let other = map(borders, caps);
        assert_eq!(other.report.distortion, usual.report.distortion, "{borders:?}");
        assert_eq!(other.target_from_source, usual.target_from_source, "{borders:?}");
        assert!(other.report.borders.is_none_or(|told| told.case == BorderCase::Missing));
    }
}
