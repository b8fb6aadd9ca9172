//! The distances between the laid base and the scan, on the skin that both have.

use super::input::WrapInput;
use super::samples::{Sample, samples};
use crate::math::quantile::{Weighted, quantile, sort_by_value};
use crate::math::scalar::max;
use crate::mesh::surface_index::SurfaceIndex;
use crate::mesh::{FaceId, SurfaceMesh};
use crate::surface_map::correspondence::PointLocator;
use serde::Serialize;

/// The number of points that are measured on each mesh, about. More of them make the mean exacter and take longer. Chosen by hand.
const COUNT: usize = 100_000;

/// Distances from points of one surface, spread evenly over it, to another surface, in units of the root of the area of the scan's
/// skin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DistanceFigures {
    /// The mean distance.
    pub mean: f64,
    /// The 95 % quantile of the distance, by area.
    pub p95: f64,
    /// The largest distance: one side of the Hausdorff distance.
    pub max: f64,
}

/// Distances both ways, on skin whose partner is skin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WrapDistances {
    /// The distances from the laid base to the scan.
    pub to_scan: DistanceFigures,
    /// The distances from the scan to the laid base.
    pub from_scan: DistanceFigures,
}

impl WrapDistances {
    /// Measures the laid base, given with its new places.
    pub(super) fn new(input: &WrapInput<'_>, laid: &SurfaceMesh, locator: &PointLocator<'_>) -> Self {
        let scan_skin = |f: FaceId| input.is_scan_skin(f);
        let base_skin = |f: FaceId| input.is_base_skin(f);
        let unit = 1.0
            / input
                .scan
                .faces()
                .filter(|&f| scan_skin(f))
                .map(|f| input.scan.face_area(f))
                .sum::<f64>()
                .sqrt();
        let on_laid = samples(laid, base_skin, COUNT, 2);
        let on_scan = samples(input.scan, scan_skin, COUNT, 2);
        let (to_scan, to_laid) = (SurfaceIndex::new(input.scan), SurfaceIndex::new(laid));
        let distance_to_scan = |sample: &Sample| {
            let image = locator.image(sample.point);
            if !scan_skin(image.face) {
                return None;
            }
            let p = sample.point.position(laid);
            to_scan
                .nearest_where(p, image.face, |point| scan_skin(point.face))
                .map(|nearest| nearest.distance)
        };
        let distance_to_laid = |sample: &Sample| {
            let preimage = locator.preimage(sample.point);
            if !base_skin(preimage.face) {
                return None;
            }
            let p = sample.point.position(input.scan);
            to_laid
                .nearest_where(p, preimage.face, |point| base_skin(point.face))
                .map(|nearest| nearest.distance)
        };
        Self {
            to_scan: DistanceFigures::of(&on_laid, distance_to_scan, unit),
            from_scan: DistanceFigures::of(&on_scan, distance_to_laid, unit),
        }
    }
}

impl DistanceFigures {
    fn of(samples: &[Sample], distance: impl Fn(&Sample) -> Option<f64>, unit: f64) -> Self {
        let measured = |sample: &Sample| {
            distance(sample).map(|distance| Weighted { value: unit * distance, weight: sample.area })
        };
        let mut all: Vec<Weighted> = samples.iter().filter_map(measured).collect();
        sort_by_value(&mut all);
        let area: f64 = all.iter().map(|w| w.weight).sum();
        Self {
            mean: all.iter().map(|w| w.value * w.weight).sum::<f64>() / area,
            p95: quantile(&all, 0.95),
            max: all.iter().map(|w| w.value).fold(0.0, max),
        }
    }
}
