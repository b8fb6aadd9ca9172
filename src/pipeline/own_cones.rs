//! Cones of the program's own where the user gave few landmarks.
//!
//! A cone surface with few cones is a poor image of a body with many limbs, and a map over it gets stuck. So points are added
//! and carried to the target by the present map; the map is solved again with all as cones. Every round takes fresh points,
//! so that those of the round before are free to move.

use super::class_search::choose_class;
use super::options::PipelineOptions;
use super::relaxed::{Full, parametrised};
use super::{ClassChoice, PipelineError};
use crate::geodesic::distances;
use crate::landmark_suggestion::farthest_points;
use crate::mesh::closest_point::closest_point;
use crate::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor};
use crate::surface_map::multilevel::{CoarseMap, LevelImages, MultilevelOptions, Side, solve_fine};
use crate::surface_map::{ConeSurface, Embedding, MapError, certify};
use glam::DVec3;
use std::cell::OnceCell;
use std::sync::Arc;

/// What the rounds make and their maps borrow: each round fills a cell.
pub(super) struct Rounds<T>(Vec<OnceCell<[T; 2]>>);

impl<T> Rounds<T> {
    /// Room for all rounds.
    pub(super) fn new(options: &PipelineOptions) -> Self {
        Self((0..options.own_cones.rounds).map(|_| OnceCell::new()).collect())
    }
}

/// Both meshes with own landmarks after the user's, and the coarse map of all.
pub(super) struct OwnCones<'a> {
    full: &'a [Full; 2],
    map: CoarseMap<'a>,
}

impl OwnCones<'_> {
    /// The map of the full meshes; `None` where it is not found or not certified.
    ///
    /// # Errors
    /// Cancellation only.
    pub(super) fn refined(
        self,
        (options, monitor): (&MultilevelOptions, &mut dyn Monitor),
    ) -> Result<Option<Refined>, Cancelled> {
        let Self { full, map } = self;
        let surface = map.surface.clone();
        let embeddings = match solve_fine(map, (options, monitor)) {
            Ok(embeddings) => embeddings,
            Err(MapError::Cancelled(stop)) => return Err(stop),
            Err(_) => return Ok(None),
        };
        let certified = |k: usize| certify(parametrised(&full[k], &embeddings[k]), &surface).bijective;
        let bijective = certified(0) && certified(1);
        Ok(bijective.then(|| Refined { surface, embeddings, full: full.clone() }))
    }
}

/// The map of the full meshes with own landmarks.
pub(super) struct Refined {
    pub(super) surface: Arc<ConeSurface>,
    pub(super) embeddings: [Embedding; 2],
    pub(super) full: [Full; 2],
}

/// Adds own landmarks round by round, as long as they lower the mean log density of the coarse map; `None` where they do not.
///
/// Every round takes fresh points at their images under the best map so far.
///
/// # Errors
/// Cancellation only.
pub(super) fn add<'a>(
    (inputs, full, map): ([&SurfaceMesh; 2], &[Full; 2], &CoarseMap<'_>),
    (fulls, all_sides): (&'a Rounds<Full>, &'a Rounds<Side<'a>>),
    (vertices, options): (usize, &PipelineOptions),
    monitor: &mut dyn Monitor,
) -> Result<Option<OwnCones<'a>>, Cancelled> {
    let own = &options.own_cones;
    if own.count == 0 || full[0].landmarks.len() > own.most_landmarks || map.mean_log < own.least_mean_log {
        return Ok(None);
    }
    let Some(mut images) = map.images() else { return Ok(None) };
    let mut best: Option<OwnCones<'a>> = None;
    let mut before: Vec<VertexId> = Vec::new();
    let mut without_gain = 0;
    for (full_cell, sides_cell) in fulls.0.iter().zip(&all_sides.0) {
        if monitor.wants_result() {
            break;
        }
        let pairs = pairs(full, &images, (&before, own.count), monitor)?;
        let Some(with_own) = with(inputs, full, &pairs).filter(|_| without_gain < own.patience) else {
            break;
        };
        without_gain += 1;
        before = pairs.iter().map(|pair| pair.0).collect();
        let with_own = full_cell.get_or_init(|| with_own);
        let sides = sides_cell.get_or_init(|| {
            [0, 1].map(|k| Side::new(&with_own[k].refined.mesh, &with_own[k].landmarks, vertices))
        });
        let next = match choose_class(sides, (&options.multilevel, &own.search, ClassChoice::Best), monitor) {
            Ok(chosen) => finished(chosen.map, (&options.multilevel, &mut *monitor))?,
            Err(PipelineError::Cancelled(stop)) => return Err(stop),
            // No map with these points: others may do.
            Err(_) => continue,
        };
        let (mean_log, least) = (next.mean_log, best.as_ref().map_or(map.mean_log, |best| best.map.mean_log));
        let Some(next_images) = next.images().filter(|_| mean_log < least) else { continue };
        if mean_log < (1.0 - own.least_gain) * least {
            without_gain = 0;
        }
        images = next_images;
        best = Some(OwnCones { full: with_own, map: next });
    }
    Ok(best)
}

/// The chosen map relaxed to the end of its level.
fn finished<'a>(
    mut map: CoarseMap<'a>,
    (options, monitor): (&MultilevelOptions, &mut dyn Monitor),
) -> Result<CoarseMap<'a>, Cancelled> {
    match map.finish((options, monitor)) {
        Err(MapError::Cancelled(stop)) => Err(stop),
        _ => Ok(map),
    }
}

/// Own points are at least this far from all others; the area is 1.
const LEAST_DISTANCE: f64 = 0.03;

/// Nearer than this (in barycentric coordinates) to a side, an own point is put onto it.
const SNAP: f64 = 0.15;

/// At most `count` points of the source, far from the landmarks and from those of the round before, with their images on the
/// target.
fn pairs(
    full: &[Full; 2],
    images: &LevelImages,
    (before, count): (&[VertexId], usize),
    monitor: &mut dyn Monitor,
) -> Result<Vec<(VertexId, SurfacePoint)>, Cancelled> {
    let [source, target] = &images.levels;
    let mesh = &source.mesh;
    let user: Vec<VertexId> = source.numbers(&full[0].landmarks).collect();
    let avoid: Vec<VertexId> = user
        .iter()
        .copied()
        .chain(before.iter().filter_map(|v| source.vertices.binary_search(v).ok()))
        .collect();
    let mut free = vec![true; mesh.vertex_count()];
    avoid.iter().for_each(|&v| free[v.index()] = false);
    let wanted = (count, LEAST_DISTANCE);
    let chosen = farthest_points((mesh, distances(mesh, &avoid)), wanted, |v| free[v.index()], monitor)?;
    let mut places: Vec<DVec3> =
        full[1].landmarks.iter().map(|&v| full[1].refined.mesh.positions()[v]).collect();
    let mut pairs = Vec::new();
    for v in chosen {
        let image = images.target_from_source[v];
        let place = image.position(&target.mesh);
        if places.iter().any(|p| p.distance(place) < LEAST_DISTANCE) {
            continue;
        }
        let [a, b, c] = target.mesh.corners(image.face);
        let point = snapped(closest_point(&full[1].refined.mesh, place, (b - a).cross(c - a)));
        places.push(place);
        pairs.push((source.vertices[v], point));
    }
    Ok(pairs)
}

/// The same point on a corner or a side that is near, so that no needles are made.
fn snapped(point: SurfacePoint) -> SurfacePoint {
    let kept = point.barycentric.map(|w| if w < SNAP { 0.0 } else { w });
    let sum: f64 = kept.iter().sum();
    SurfacePoint { barycentric: kept.map(|w| w / sum), ..point }
}

/// Both meshes with the pairs as landmarks after the user's; `None` where there are no pairs.
fn with(
    inputs: [&SurfaceMesh; 2],
    full: &[Full; 2],
    pairs: &[(VertexId, SurfacePoint)],
) -> Option<[Full; 2]> {
    if pairs.is_empty() {
        return None;
    }
    let at = |pair: &(VertexId, SurfacePoint)| SurfacePoint::at_vertex(&full[0].refined.mesh, pair.0);
    let points: [Vec<SurfacePoint>; 2] =
        [pairs.iter().map(at).collect(), pairs.iter().map(|pair| pair.1).collect()];
    let side = |k: usize| full[k].with_landmarks(inputs[k], &points[k]).ok();
    let ((mut source, from), (mut target, onto)) = (side(0)?, side(1)?);
    for (s, t) in from.into_iter().zip(onto) {
        if !target.landmarks.contains(&t) {
            source.landmarks.push(s);
            target.landmarks.push(t);
        }
    }
    Some([source, target])
}
