//! Cones of the program's own where the user gave few landmarks.
//!
//! A cone surface with few cones is a poor image of a body with many limbs, and a map over it gets stuck. So points are added
//! and carried to the target by the present map; the map is solved again with all as cones. Every round takes fresh points,
//! so that those of the round before are free to move.

use super::PipelineError;
use super::options::PipelineOptions;
use super::relaxed::{Coarse, Full, parametrised, searched};
use crate::landmark_suggestion::{distances, farthest_points};
use crate::layout::BaseLayout;
use crate::mesh::closest_point::closest_point;
use crate::mesh::insertion::insert;
use crate::mesh::{RefinedMesh, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor};
use crate::surface_map::multilevel::{CoarseMap, LevelImages, Side, solve_coarse, solve_fine};
use crate::surface_map::{ConeSurface, Embedding, MapError, certify};
use glam::DVec3;
use std::sync::Arc;

/// Both meshes with own landmarks after the user's, and the layout of all.
pub(super) struct OwnCones {
    full: [Full; 2],
    layout: BaseLayout,
    /// Of the coarse map.
    energy: f64,
}

impl OwnCones {
    /// The map of the full meshes; `None` where it is not found or not certified.
    ///
    /// # Errors
    /// Cancellation only.
    pub(super) fn refined(
        self,
        (vertices, options): (usize, &PipelineOptions),
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Refined>, Cancelled> {
        let sides = sides(&self.full, vertices);
        let solved =
            solve_coarse(&sides, &self.layout, (&options.multilevel, &mut *monitor)).and_then(|mut map| {
                map.finish(&sides, (&options.multilevel, &mut *monitor))?;
                let surface = map.surface.clone();
                Ok((surface, solve_fine(map, &sides, (&options.multilevel, monitor))?))
            });
        drop(sides);
        let (surface, embeddings) = match solved {
            Ok(solved) => solved,
            Err(MapError::Cancelled(stop)) => return Err(stop),
            Err(_) => return Ok(None),
        };
        let certified = |k: usize| certify(parametrised(&self.full[k], &embeddings[k]), &surface).bijective;
        let bijective = certified(0) && certified(1);
        Ok(bijective.then_some(Refined { surface, embeddings, full: self.full }))
    }
}

/// The map of the full meshes with own landmarks.
pub(super) struct Refined {
    pub(super) surface: Arc<ConeSurface>,
    pub(super) embeddings: [Embedding; 2],
    pub(super) full: [Full; 2],
}

fn sides(full: &[Full; 2], vertices: usize) -> [Side<'_>; 2] {
    [0, 1].map(|k| Side::new(&full[k].refined.mesh, &full[k].landmarks, vertices))
}

/// Adds own landmarks round by round, as long as they lower the energy of the coarse map; `None` where they do not.
///
/// Every round takes fresh points at their images under the best map so far.
///
/// # Errors
/// Cancellation only.
pub(super) fn add(
    (full, user_sides): (&[Full; 2], &[Side<'_>; 2]),
    map: &CoarseMap<'_>,
    (vertices, options): (usize, &PipelineOptions),
    monitor: &mut dyn Monitor,
) -> Result<Option<OwnCones>, PipelineError> {
    let own = &options.own_cones;
    if own.count == 0 || full[0].landmarks.len() > own.most_landmarks || map.judged < own.least_energy {
        return Ok(None);
    }
    let Some(mut images) = map.images(user_sides) else { return Ok(None) };
    let mut best: Option<OwnCones> = None;
    let mut before: Vec<VertexId> = Vec::new();
    let mut without_gain = 0;
    for _ in 0..own.rounds {
        if monitor.wants_result() {
            break;
        }
        let pairs = pairs(full, &images, &before, own.count);
        let Some(with_own) = with(full, &pairs).filter(|_| without_gain < own.patience) else { break };
        without_gain += 1;
        before = pairs.iter().map(|pair| pair.0).collect();
        let sides = sides(&with_own, vertices);
        let next = match searched(&sides, (&options.multilevel, &own.search), monitor) {
            Ok(next) => next,
            Err(PipelineError::Cancelled(stop)) => return Err(stop.into()),
            // No map with these points: others may do.
            Err(_) => continue,
        };
        let Coarse { layout, map: next, .. } = next;
        let (energy, least) = (next.judged, best.as_ref().map_or(map.judged, |best| best.energy));
        let Some(next_images) = next.images(&sides).filter(|_| energy < least) else { continue };
        if energy < (1.0 - own.least_gain) * least {
            without_gain = 0;
        }
        images = next_images;
        drop(sides);
        best = Some(OwnCones { full: with_own, layout, energy });
    }
    Ok(best)
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
    before: &[VertexId],
    count: usize,
) -> Vec<(VertexId, SurfacePoint)> {
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
    let chosen = farthest_points(mesh, distances(mesh, &avoid), (count, LEAST_DISTANCE), |v| free[v.index()]);
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
    pairs
}

/// The same point on a corner or a side that is near, so that no needles are made.
fn snapped(point: SurfacePoint) -> SurfacePoint {
    let kept = point.barycentric.map(|w| if w < SNAP { 0.0 } else { w });
    let sum: f64 = kept.iter().sum();
    SurfacePoint { barycentric: kept.map(|w| w / sum), ..point }
}

/// Both meshes with the pairs as landmarks after the user's; `None` where there are no pairs.
fn with(full: &[Full; 2], pairs: &[(VertexId, SurfacePoint)]) -> Option<[Full; 2]> {
    let points: Vec<SurfacePoint> = pairs.iter().map(|pair| pair.1).collect();
    let target: &SurfaceMesh = &full[1].refined.mesh;
    let inserted = insert(target, &points).ok().filter(|_| !pairs.is_empty())?;
    let mut landmarks = [full[0].landmarks.clone(), full[1].landmarks.clone()];
    for (&(s, _), &t) in pairs.iter().zip(&inserted.vertices) {
        if !landmarks[1].contains(&t) {
            landmarks[0].push(s);
            landmarks[1].push(t);
        }
    }
    let origin = |v: VertexId| inserted.on_original(SurfacePoint::at_vertex(&inserted.mesh, v));
    let refined = RefinedMesh {
        vertex_origin: inserted.mesh.vertices().map(origin).collect(),
        face_origin: inserted.face_origin.clone(),
        mesh: inserted.mesh,
    };
    let [first, second] = landmarks;
    Some([Full { refined: full[0].refined.clone(), landmarks: first }, Full { refined, landmarks: second }])
}
