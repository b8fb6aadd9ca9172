//! Layouts without a search for the class: planned on both meshes at once, or drawn for a given base domain.

use super::base_layout::{BaseLayout, LayoutReport};
use super::drawing::Drawing;
use super::error::LayoutError;
use super::joint::{self, Ground};
use super::patches;
use super::variants::VARIANTS;
use crate::base_domain::BaseDomain;
use crate::landmarks::Landmarks;
use crate::mesh::SurfaceMesh;
use crate::monitor::Monitor;

/// Options of [`joint()`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayoutOptions {
    /// Orders of drawing that are tried at most, 1 to 16.
    pub attempts: usize,
    /// A layout with at most this detour ([`LayoutReport::detour`]) is taken at once.
    pub good_detour: f64,
}

impl Default for LayoutOptions {
    fn default() -> Self {
        // Only the thesis' method takes a layout without a judge. Chosen by hand, not measured at half and double.
        Self { attempts: 6, good_detour: 0.5 }
    }
}

/// Plans the base domain on both meshes at once and draws it.
///
/// # Errors
/// [`LayoutError`] when no order of drawing ends in a triangulation, or there are too few landmarks.
pub fn joint(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    options: &LayoutOptions,
    monitor: &mut dyn Monitor,
) -> Result<BaseLayout, LayoutError> {
    LayoutError::unless_enough(landmarks)?;
    let empty = Drawing::new(meshes[0], meshes[1], landmarks);
    let distances = empty.distances(monitor)?;
    let ground = Ground::new(&empty, &distances);
    let mut found: Vec<(Drawing, LayoutReport)> = Vec::new();
    let mut failure = LayoutError::Stuck { paths: 0, wanted: 3 * landmarks.len() - 6 };
    let mut attempts = 0;
    for variant in VARIANTS.iter().take(options.attempts.max(1)) {
        attempts += 1;
        let drawing = match joint::draw(&ground, variant, monitor) {
            Ok(drawing) => drawing,
            Err(LayoutError::Cancelled(stop)) => return Err(stop.into()),
            Err(error) => {
                failure = error;
                continue;
            }
        };
        let report = LayoutReport::of(&drawing, &distances);
        let good = report.detour <= options.good_detour;
        found.push((drawing, report));
        if good {
            break;
        }
    }
    found.sort_by(|a, b| a.1.detour.total_cmp(&b.1.detour));
    let (drawing, mut report) = found.into_iter().next().ok_or(failure)?;
    report.attempts = attempts;
    let base = patches::base_of(&drawing, meshes[1], landmarks)?;
    Ok(patches::finish(drawing, base, meshes, report)?)
}

/// Draws a given base domain (its vertex k is landmark k) on both meshes.
///
/// # Errors
/// [`LayoutError`] when one of its edges finds no path.
pub fn from_base(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    base: &BaseDomain,
    monitor: &mut dyn Monitor,
) -> Result<BaseLayout, LayoutError> {
    let empty = Drawing::new(meshes[0], meshes[1], landmarks);
    let distances = empty.distances(monitor)?;
    let drawing = joint::draw_base(&Ground::new(&empty, &distances), base, monitor)?;
    let report = LayoutReport::of(&drawing, &distances);
    Ok(patches::finish(drawing, base.clone(), meshes, report)?)
}
