//! A small map for the tests of this room, a ball on an egg with other triangles, and what is true of values that are brought over and
//! back by it.

use super::cells::Cells;
use super::values::{Carrying, ValueCarrier, Values};
use crate::export::vertex_image::Direction::{self, SourceToTarget, TargetToSource};
use crate::landmarks::Landmarks;
use crate::math::scalar::sin;
use crate::mesh::generators::{icosphere, midpoint_subdivision, octahedron};
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Silent, Step};
use crate::pipeline::{MapInput, PipelineOptions, run};
use crate::surface_map::correspondence::Correspondence;
use glam::DVec3;
use std::sync::OnceLock;
use typed_index_collections::TiVec;

/// A map with its meshes.
pub struct Mapped {
    pub source: SurfaceMesh,
    pub target: SurfaceMesh,
    pub map: Correspondence,
}

impl Mapped {
    pub fn meshes(&self) -> [&SurfaceMesh; 2] {
        [&self.source, &self.target]
    }
}

/// The vertex farthest along each half-axis.
fn ends(mesh: &SurfaceMesh) -> Vec<VertexId> {
    let axes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let along = |axis: DVec3, v: VertexId| mesh.positions()[v].dot(axis);
    axes.map(|axis| mesh.vertices().max_by(|&v, &w| along(axis, v).total_cmp(&along(axis, w))).unwrap())
        .to_vec()
}

/// An octahedron of 2048 faces on the unit sphere.
pub fn ball() -> SurfaceMesh {
    let fine = (0..4).fold(octahedron(), |mesh, _| midpoint_subdivision(&mesh));
    let positions = fine.positions().iter().map(|p| p.normalize()).collect();
    fine.with_positions(positions)
}

/// An icosphere of 1280 faces, stretched.
pub fn egg() -> SurfaceMesh {
    let sphere = icosphere(3);
    let positions = sphere.positions().iter().map(|p| *p * DVec3::new(1.0, 1.3, 0.9)).collect();
    sphere.with_positions(positions)
}

/// The ball mapped onto the egg.
pub fn ball_on_egg() -> &'static Mapped {
    static MAP: OnceLock<Mapped> = OnceLock::new();
    MAP.get_or_init(|| {
        let (source, target) = (ball(), egg());
        let landmarks = Landmarks { source: ends(&source).into(), target: ends(&target).into() };
        let input = MapInput::new(&source, &target, &landmarks);
        let result = run(input, &PipelineOptions::default(), &mut Silent).unwrap();
        let map = result.correspondence.unwrap();
        Mapped { source, target, map }
    })
}

const ALL: [Carrying; 3] = [Carrying::Projection, Carrying::Mean, Carrying::Sample];

fn carried(mapped: &Mapped, direction: Direction, values: &Values, carrying: Carrying) -> Values {
    let carrier = ValueCarrier::new(mapped.meshes(), &mapped.map, direction);
    carrier.numbers(std::slice::from_ref(values), carrying, &mut Silent).unwrap().remove(0)
}

/// A wave over the surface.
fn smooth(mesh: &SurfaceMesh) -> Values {
    mesh.positions().iter().map(|p| sin(2.0 * p.x + 1.0) + p.y * p.z).collect()
}

fn range(values: &Values) -> f64 {
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    most - values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// The root of the mean square difference over the area, in units of the range.
fn difference(mesh: &SurfaceMesh, a: &Values, b: &Values) -> f64 {
    let areas = mesh.vertex_areas();
    let sum: f64 = mesh.vertices().map(|v| areas[v] * (a[v] - b[v]).powi(2)).sum();
    (sum / mesh.area()).sqrt() / range(a)
}

#[test]
fn a_smooth_function_comes_back() {
    let mapped = ball_on_egg();
    let given = smooth(&mapped.source);
    let error = |carrying| {
        let there = carried(mapped, SourceToTarget, &given, carrying);
        let back = carried(mapped, TargetToSource, &there, carrying);
        difference(&mapped.source, &given, &back)
    };
    let [projection, mean, sample] = ALL.map(error);
    println!("projection {projection:e}, mean {mean:e}, sample {sample:e}");
    assert!(projection < 0.005 && sample < 0.005, "{projection} {sample}");
    assert!(projection < sample && sample < mean, "{projection} {sample} {mean}");
}

#[test]
fn constants_and_sums_stay() {
    let mapped = ball_on_egg();
    let first: Values =
        mapped.target.positions().iter().map(|p| if p.x > 0.1 { 0.75 } else { 0.25 }).collect();
    let second: Values = first.iter().map(|w| 1.0 - w).collect();
    for carrying in ALL {
        let [a, b] = [&first, &second].map(|values| carried(mapped, TargetToSource, values, carrying));
        assert!(a.iter().zip(&b).all(|(p, q)| (p + q - 1.0).abs() < 1e-11), "{carrying:?}");
        let is_between = a.iter().all(|w| (0.25 - 1e-12..=0.75 + 1e-12).contains(w));
        assert!(is_between || carrying == Carrying::Projection, "{carrying:?}");
        // On both sides of the jump nothing is left but the value there.
        for (p, w) in mapped.source.positions().iter().zip(&a).filter(|(p, _)| p.x.abs() > 0.6) {
            let wanted = if p.x > 0.0 { 0.75 } else { 0.25 };
            assert!((w - wanted).abs() < 1e-2, "{carrying:?}: {w} at {p}");
        }
    }
}

#[test]
fn the_integral_is_kept_by_the_projection() {
    let mapped = ball_on_egg();
    let given = smooth(&mapped.target);
    let integral = |mesh: &SurfaceMesh, values: &Values| -> f64 {
        mesh.vertex_areas().iter().zip(values).map(|(area, value)| area * value).sum()
    };
    // Over the receiving mesh's area: the integral of what is given is summed over the overlay there.
    let mut cells = Cells::new(mapped.meshes(), &mapped.map);
    let mut wanted = 0.0;
    for piece in &mapped.map.pieces {
        let corners = mapped.target.triangles()[piece.faces[1]].map(|v| given[v]);
        for cell in cells.of(piece) {
            let middle = [0, 1, 2].map(|k| cell.weights[1].iter().map(|w| w[k]).sum::<f64>() / 3.0);
            wanted += cell.areas[0] * (0..3).map(|k| middle[k] * corners[k]).sum::<f64>();
        }
    }
    for carrying in [Carrying::Projection, Carrying::Mean] {
        let found = integral(&mapped.source, &carried(mapped, TargetToSource, &given, carrying));
        assert!((found - wanted).abs() < 1e-9, "{carrying:?}: {found} {wanted}");
    }
}

#[test]
fn labels_go_by_the_majority_of_area() {
    let mapped = ball_on_egg();
    // Which end of the egg: far from the border each vertex of the ball keeps its end.
    let label = |x: f64| if x > 0.0 { 7 } else { -3 };
    let labels: TiVec<VertexId, i64> = mapped.target.positions().iter().map(|p| label(p.x)).collect();
    let carrier = ValueCarrier::new(mapped.meshes(), &mapped.map, TargetToSource);
    for carrying in [Carrying::Projection, Carrying::Sample] {
        let found = carrier.labels(&labels, carrying, &mut Silent).unwrap();
        for (v, p) in mapped.source.positions().iter_enumerated().filter(|(_, p)| p.x.abs() > 0.3) {
            assert_eq!(found[v], label(p.x), "{carrying:?} at {p}");
        }
        assert!(found.iter().all(|l| [7, -3].contains(l)));
    }
}

#[test]
fn two_runs_agree_bit_for_bit() {
    let mapped = ball_on_egg();
    let given = smooth(&mapped.source);
    let [a, b] = [0, 1].map(|_| carried(mapped, SourceToTarget, &given, Carrying::Projection));
    assert!(a.iter().zip(&b).all(|(p, q)| p.to_bits() == q.to_bits()));
}

#[test]
fn who_asks_to_stop_is_heard() {
    struct Impatient;
    impl Monitor for Impatient {
        fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
            Err(Cancelled)
        }
    }
    let mapped = ball_on_egg();
    let carrier = ValueCarrier::new(mapped.meshes(), &mapped.map, SourceToTarget);
    let given = smooth(&mapped.source);
    assert!(carrier.numbers(&[given], Carrying::Mean, &mut Impatient).is_err());
    let labels = mapped.source.vertices().map(|_| 1).collect();
    assert_eq!(carrier.labels(&labels, Carrying::Mean, &mut Impatient), Err(Cancelled));
}
