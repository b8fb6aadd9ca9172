//! Limbs without a landmark.

use super::tips;
use crate::geodesic::{distances, distances_within};
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Step};
use std::f64::consts::PI;
use std::ops::Range;

/// A tip is marked where a landmark is nearer than this, in units of the root of the area. Chosen by hand.
const MARKED: f64 = 0.18;

/// Share of a flat disc's area below which the disc around a tip is that of a limb. Chosen by hand.
const THIN: f64 = 0.3;

/// Ends of limbs that no landmark marks, the most remote first: tips around which some disc without a landmark has less than
/// 0.3 of a flat one's area, as on a limb much longer than thick, and not on a ball or a bump. Without landmarks all
/// tips count.
///
/// The limits were set by the test pairs: tails without a landmark are at 0.22 and less, ears and muzzles at 0.3 and more. Short
/// limbs (less than 0.18 of the root of the area from end to landmark) are not found.
///
/// # Errors
/// [`Cancelled`].
pub fn unmarked_limbs(
    mesh: &SurfaceMesh,
    landmarks: &[VertexId],
    monitor: &mut dyn Monitor,
) -> Result<Vec<VertexId>, Cancelled> {
    let to_landmark = distances(mesh, landmarks);
    let areas = mesh.vertex_areas().raw;
    let marked = MARKED * mesh.area().sqrt();
    let tips = tips(mesh, marked, &mut Portion::new(monitor, 0.0, TIPS_SHARE))?;
    let mut unmarked = Vec::new();
    let monitor = &mut Portion::new(monitor, TIPS_SHARE, 1.0);
    for (k, &tip) in tips.iter().enumerate() {
        monitor.step(Step { fraction: k as f64 / tips.len() as f64, residual: None })?;
        if landmarks.is_empty() || thinnest(mesh, &areas, tip, marked..to_landmark[tip]) < THIN {
            unmarked.push(tip);
        }
    }
    Ok(unmarked)
}

/// The share of the time that the tips take: they need 32 distances over the whole mesh, a disc less than one.
const TIPS_SHARE: f64 = 0.8;

/// The least ratio of the area of a geodesic disc around a vertex to that of a flat disc, over a range of radii; infinite for an empty
/// range.
fn thinnest(mesh: &SurfaceMesh, areas: &[f64], centre: VertexId, radii: Range<f64>) -> f64 {
    if radii.is_empty() {
        return f64::INFINITY;
    }
    let field = distances_within(mesh, &[centre], radii.end);
    let mut order: Vec<usize> = (0..areas.len()).filter(|&v| field.raw[v] < radii.end).collect();
    order.sort_by(|&a, &b| field.raw[a].total_cmp(&field.raw[b]));
    let (mut within, mut least) = (0.0, f64::INFINITY);
    for v in order {
        within += areas[v];
        let radius = field.raw[v];
        if radius >= radii.start {
            least = f64::min(least, within / (PI * radius * radius));
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;

    #[test]
    fn a_limb_is_missed_when_its_landmark_is_taken_away() {
        let demo = demo::build("horse-cat").unwrap();
        let all: Vec<VertexId> = demo.landmarks.iter().map(|pair| VertexId(pair[0])).collect();
        assert_eq!(unmarked_limbs(&demo.source, &all, &mut Silent).unwrap(), []);
        for name in ["left fore", "right hind", "tail"] {
            let named = |label: &&String| label.starts_with(name);
            let (gone, kept): (Vec<_>, Vec<_>) =
                all.iter().zip(&demo.labels).partition(|(_, label)| named(label));
            let kept: Vec<VertexId> = kept.into_iter().map(|(v, _)| *v).collect();
            let found = unmarked_limbs(&demo.source, &kept, &mut Silent).unwrap();
            let near = |v: VertexId| {
                let p = demo.source.positions()[v];
                gone.iter().any(|(w, _)| demo.source.positions()[**w].distance(p) < 0.25)
            };
            assert!(found.len() == 1 && near(found[0]), "{name}: {found:?}");
        }
    }

    #[test]
    fn a_ball_has_no_limbs() {
        let ball = icosphere(3);
        assert_eq!(unmarked_limbs(&ball, &[0, 100, 200, 300].map(VertexId), &mut Silent).unwrap(), []);
    }
}
