//! Tests of transfer on real meshes: values and motions of a horse are brought onto a camel.

use crate::common;
use conemap::export::vertex_image::Direction::{SourceToTarget, TargetToSource};
use conemap::math::scalar::sin;
use conemap::mesh::SurfaceMesh;
use conemap::monitor::Silent;
use conemap::pipeline::{GroundTruth, PipelineOptions, run};
use conemap::surface_map::correspondence::Correspondence;
use conemap::transfer::deformation::{DeformationTransfer, Shape};
use conemap::transfer::shape::shape_report;
use conemap::transfer::{Carrying, ValueCarrier, Values};
use glam::DVec3;
use std::path::Path;

tests![; long: values_and_poses_go_from_horse_to_camel];

/// A smooth function on the vertices: a wave over the body.
fn smooth(mesh: &SurfaceMesh) -> Values {
    let size = mesh.area().sqrt();
    let wave = |p: &DVec3| sin(6.0 * p.x / size) + sin(4.0 * p.y / size + 1.0) * sin(5.0 * p.z / size);
    mesh.positions().iter().map(wave).collect()
}

/// The error of a function after transfer there and back, in units of its range: the root of the mean square, and the largest.
fn round_trip(meshes: [&SurfaceMesh; 2], map: &Correspondence, carrying: Carrying) -> [f64; 2] {
    let given = smooth(meshes[0]);
    let carried = |direction, values: &Values| {
        let carrier = ValueCarrier::new(meshes, map, direction);
        carrier.numbers(std::slice::from_ref(values), carrying, &mut Silent).unwrap().remove(0)
    };
    let back = carried(TargetToSource, &carried(SourceToTarget, &given));
    let areas = meshes[0].vertex_areas();
    let off: f64 = meshes[0].vertices().map(|v| areas[v] * (given[v] - back[v]).powi(2)).sum();
    let largest = given.iter().zip(&back).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let [least, most] =
        given.iter().fold([f64::MAX, f64::MIN], |[least, most], x| [least.min(*x), most.max(*x)]);
    [(off / meshes[0].area()).sqrt() / (most - least), largest / (most - least)]
}

/// The length of every edge in a shape divided by its length in the mesh, sorted.
fn stretches(mesh: &SurfaceMesh, shape: &Shape) -> Vec<f64> {
    let length = |h| shape[mesh.tail(h)].distance(shape[mesh.head(h)]) / mesh.length(h);
    let mut all: Vec<f64> = mesh.edges().map(length).collect();
    all.sort_by(f64::total_cmp);
    all
}

fn values_and_poses_go_from_horse_to_camel(data: &Path) {
    let pair = common::read_pair(data, "horse-camel");
    let landmarks = common::landmarks(&pair);
    let input = pair.input(&landmarks, GroundTruth::Unknown);
    let map = run(input, &PipelineOptions::default(), &mut Silent).unwrap().correspondence.unwrap();
    let meshes = [&pair.source, &pair.target];

    let all = [Carrying::Projection, Carrying::Mean, Carrying::Sample];
    let [projection, mean, sample] = all.map(|carrying| round_trip(meshes, &map, carrying));
    assert!(projection[0] < 0.005 && sample[0] < 0.005, "{projection:?} {sample:?}");
    assert!(projection[0] < mean[0], "{projection:?} {mean:?}");

    let report = shape_report(meshes, &map, SourceToTarget, &mut Silent).unwrap();
    assert!(report.to_shape.mean < 0.002 * report.size && report.hausdorff < 0.1 * report.size, "{report:?}");

    let mut transfer = DeformationTransfer::new(meshes, &map, SourceToTarget, &mut Silent).unwrap();
    for name in ["horse-pose01", "horse-pose05"] {
        let pose = common::read_mesh(&data.join(format!("sumner/{name}.off")));
        let frame: Shape = pose.positions().iter().copied().collect();
        let moved = transfer.moved(&frame, &mut Silent).unwrap();
        let [horse, camel] = [stretches(&pair.source, &frame), stretches(&pair.target, &moved)];
        let at = |all: &[f64], share: f64| all[(share * (all.len() - 1) as f64) as usize];
        // The camel's edges are stretched as much as the horse's, and not more.
        assert!(at(&camel, 0.01) > 0.5 * at(&horse, 0.01) && at(&camel, 0.99) < 2.0 * at(&horse, 0.99));
        assert!((at(&camel, 0.5) - 1.0).abs() < 0.1);
        // The camel's landmarks move in the same directions as the horse's.
        let (mut dot, mut squares) = (0.0, [0.0; 2]);
        for (s, t) in landmarks.source.iter().zip(&landmarks.target) {
            let steps = [frame[*s] - pair.source.positions()[*s], moved[*t] - pair.target.positions()[*t]];
            dot += steps[0].dot(steps[1]);
            (0..2).for_each(|k| squares[k] += steps[k].length_squared());
        }
        let agreement = dot / (squares[0] * squares[1]).sqrt();
        assert!(agreement > 0.8, "{name}: {agreement}");
    }
}
