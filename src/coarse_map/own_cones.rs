//! Cones of the program's own where the user gave few landmarks.
//!
//! A cone surface with few cones is a poor image of a body with many limbs, and a map over it gets stuck. So points are added
//! and carried to the target by the present map; the map is solved again with all as cones. Every round takes fresh points,
//! so that those of the round before are free to move.

use super::class_search::{ClassChoice, ClassSearchOptions, choose_class};
use super::error::CoarseMapError;
use super::landmarked_mesh::LandmarkedMesh;
use super::mesh_with_coarse::{self, MeshWithCoarse};
use super::multilevel::{CoarseMap, LevelImages, solve_fine};
use super::options::MultilevelOptions;
use crate::geodesic::distances;
use crate::landmark_suggestion::{Spread, farthest_points};
use crate::layout::SearchOptions;
use crate::mesh::closest_point::closest_point;
use crate::mesh::{SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Step};
use crate::surface_map::{ConeSurface, Embedding, MapError, certify};
use glam::DVec3;
use std::cell::OnceCell;
use std::sync::Arc;

/// Cones of the program's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnConeOptions {
    /// Points that are added; 0 turns them off.
    pub count: usize,
    /// With more landmarks than this none are added.
    pub most_landmarks: usize,
    /// A coarse map of less mean log density needs no help; 0 for an isometry.
    pub least_mean_log: f64,
    /// Sets of points, one after the other, at most.
    pub rounds: usize,
    /// Stops after this many sets without a gain.
    pub patience: usize,
    /// A gain lowers the mean log density by this share.
    pub least_gain: f64,
    /// The search for the layout with own points.
    pub search: SearchOptions,
}

impl Default for OwnConeOptions {
    fn default() -> Self {
        let search = SearchOptions { candidates: 2, twists: 2, ..SearchOptions::default() };
        Self {
            // Together with 12 of 33 landmarks about as many cones as with all. Rounds and gains were chosen by hand.
            count: 20,
            most_landmarks: 16,
            // That of a map of energy 4.01.
            least_mean_log: 0.0025,
            rounds: 6,
            patience: 2,
            least_gain: 0.02,
            search,
        }
    }
}

/// Owner of what the rounds make, which their maps borrow: each round fills a cell.
pub struct Rounds<T>(Vec<OnceCell<[T; 2]>>);

impl<T> Rounds<T> {
    /// Room for all rounds.
    pub fn new(options: &OwnConeOptions) -> Self {
        Self((0..options.rounds).map(|_| OnceCell::new()).collect())
    }
}

/// Owners of all that the rounds make.
#[derive(Clone, Copy)]
pub struct Owners<'a> {
    /// Of both meshes with own landmarks.
    pub meshes: &'a Rounds<LandmarkedMesh>,
    /// Of these meshes with their coarse levels.
    pub levels: &'a Rounds<MeshWithCoarse<'a>>,
}

/// Both meshes with own landmarks after the user's, and the coarse map of all.
pub struct OwnCones<'a> {
    full: &'a [LandmarkedMesh; 2],
    map: CoarseMap<'a>,
}

impl OwnCones<'_> {
    /// The map of the full meshes; `None` where it is not found or not certified.
    ///
    /// # Errors
    /// Cancellation only.
    pub fn refined(
        self,
        options: &MultilevelOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Refined>, Cancelled> {
        let Self { full, map } = self;
        let surface = map.surface.clone();
        let embeddings = match solve_fine(map, options, monitor) {
            Ok(embeddings) => embeddings,
            Err(MapError::Cancelled(stop)) => return Err(stop),
            Err(_) => return Ok(None),
        };
        let certified = |k: usize| certify(full[k].parametrised(&embeddings[k]), &surface).bijective;
        let bijective = certified(0) && certified(1);
        Ok(bijective.then(|| Refined { surface, embeddings, full: full.clone() }))
    }
}

/// The map of the full meshes with own landmarks.
pub struct Refined {
    /// The cone surface.
    pub surface: Arc<ConeSurface>,
    /// Both parametrisations.
    pub embeddings: [Embedding; 2],
    /// Both meshes with own landmarks after the user's.
    pub full: [LandmarkedMesh; 2],
}

/// Both meshes and their coarse map before own cones are added.
#[derive(Clone, Copy)]
pub struct Start<'a> {
    /// The meshes that the user gave.
    pub inputs: [&'a SurfaceMesh; 2],
    /// The meshes with the user's landmarks.
    pub full: &'a [LandmarkedMesh; 2],
    /// The coarse map with the user's landmarks alone.
    pub map: &'a CoarseMap<'a>,
    /// Vertices of the coarse levels.
    pub vertices: usize,
}

/// Adds own landmarks round by round, as long as they lower the mean log density of the coarse map; `None` where they do not.
///
/// Every round takes fresh points at their images under the best map so far.
///
/// # Errors
/// Cancellation only.
pub fn add<'a>(
    start: Start<'_>,
    owners: Owners<'a>,
    multilevel: &MultilevelOptions,
    own: &OwnConeOptions,
    monitor: &mut dyn Monitor,
) -> Result<Option<OwnCones<'a>>, Cancelled> {
    let Start { inputs, full, map, vertices } = start;
    if own.count == 0 || full[0].landmarks.len() > own.most_landmarks || map.mean_log < own.least_mean_log {
        return Ok(None);
    }
    let Some(mut images) = map.images() else { return Ok(None) };
    let mut best: Option<OwnCones<'a>> = None;
    let mut before: Vec<VertexId> = Vec::new();
    let mut without_gain = 0;
    for (round, (full_cell, levels_cell)) in owners.meshes.0.iter().zip(&owners.levels.0).enumerate() {
        let share = |done: f64| (round as f64 + done) / own.rounds as f64;
        if monitor.wants_result() || without_gain >= own.patience {
            break;
        }
        let placing = &mut Portion::new(monitor, share(0.0), share(0.1));
        let pairs = pairs(full, &images, &before, own.count, placing)?;
        let Some(with_own) = with(inputs, full, &pairs, placing)? else { break };
        without_gain += 1;
        before = pairs.iter().map(|pair| pair.source).collect();
        let with_own = full_cell.get_or_init(|| with_own);
        let coarsening = &mut Portion::new(monitor, share(0.1), share(0.1));
        let levels = mesh_with_coarse::both(with_own, vertices, multilevel.rims, coarsening)?;
        let levels = levels_cell.get_or_init(|| levels);
        let options = ClassSearchOptions { multilevel, search: &own.search, choice: ClassChoice::Best };
        let next = match choose_class(
            levels,
            options,
            &mut Portion::new(monitor, share(0.1), share(0.8)).unseen(),
        ) {
            Ok(chosen) => {
                finished(chosen.map, multilevel, &mut Portion::new(monitor, share(0.8), share(1.0)))?
            }
            Err(CoarseMapError::Cancelled(stop)) => return Err(stop),
            // No map with these points: others may do.
            Err(_) => continue,
        };
        let (mean_log, least) = (next.mean_log, best.as_ref().map_or(map.mean_log, |best| best.map.mean_log));
        let Some(next_images) = next.images().filter(|_| mean_log < least) else { continue };
        if mean_log < (1.0 - own.least_gain) * least {
            without_gain = 0;
        }
        monitor.preview(&next);
        images = next_images;
        best = Some(OwnCones { full: with_own, map: next });
    }
    Ok(best)
}

/// The chosen map relaxed to the end of its level.
fn finished<'a>(
    mut map: CoarseMap<'a>,
    options: &MultilevelOptions,
    monitor: &mut dyn Monitor,
) -> Result<CoarseMap<'a>, Cancelled> {
    match map.finish(options, monitor) {
        Err(MapError::Cancelled(stop)) => Err(stop),
        _ => Ok(map),
    }
}

/// Own points are at least this far from all others; the area is 1. 36 points spread evenly are 0.17 apart, so it only keeps points
/// from meeting on limbs.
const LEAST_DISTANCE: f64 = 0.03;

/// Nearer than this (in barycentric coordinates) to a side, an own point is put onto it: it may lie anywhere near, and a needle
/// would distort. Chosen by hand.
const SNAP: f64 = 0.15;

/// A point of the program's own, to be a landmark.
struct OwnPair {
    /// A vertex of the source with the user's landmarks.
    source: VertexId,
    /// Its image on the target.
    target: SurfacePoint,
}

/// At most `count` points of the source, far from the landmarks and from those of the round before, with their images on the
/// target.
fn pairs(
    full: &[LandmarkedMesh; 2],
    images: &LevelImages,
    before: &[VertexId],
    count: usize,
    monitor: &mut dyn Monitor,
) -> Result<Vec<OwnPair>, Cancelled> {
    let [source, target] = &images.levels;
    let weights = images.weights();
    let mesh = &source.mesh;
    let user: Vec<VertexId> = source.numbers(&full[0].landmarks).collect();
    let avoid: Vec<VertexId> = user
        .iter()
        .copied()
        .chain(before.iter().filter_map(|v| source.vertices.binary_search(v).ok()))
        .collect();
    let mut free = vec![true; mesh.vertex_count()];
    avoid.iter().for_each(|&v| free[v.index()] = false);
    mesh.vertices().filter(|&v| !weights[0].is_on_skin(mesh, v)).for_each(|v| free[v.index()] = false);
    // What the round before inserted around its own points is no vertex of the mesh with the user's landmarks alone.
    let known = full[0].refined.mesh.vertex_count();
    mesh.vertices().filter(|&v| source.vertices[v].index() >= known).for_each(|v| free[v.index()] = false);
    let wanted = Spread { count, least_distance: LEAST_DISTANCE };
    let chosen = farthest_points(mesh, distances(mesh, &avoid), wanted, |v| free[v.index()], monitor)?;
    let mut places: Vec<DVec3> =
        full[1].landmarks.iter().map(|&v| full[1].refined.mesh.positions()[v]).collect();
    let mut pairs = Vec::new();
    for v in chosen {
        // Each goes over all faces of the target.
        monitor.step(Step::default())?;
        let image = images.target_from_source[v];
        let place = image.position(&target.mesh);
        let is_taken = places.iter().any(|p| p.distance(place) < LEAST_DISTANCE);
        if is_taken || !weights[1].is_skin(image.face) {
            continue;
        }
        let [a, b, c] = target.mesh.corners(image.face);
        let point = snapped(closest_point(&full[1].refined.mesh, place, (b - a).cross(c - a)));
        // A coarse face of skin may have some cap under it.
        if !full[1].weights().is_skin(point.face) {
            continue;
        }
        places.push(place);
        pairs.push(OwnPair { source: source.vertices[v], target: point });
    }
    Ok(pairs)
}

/// The same point on a corner or a side that is near, so that no needles are made.
fn snapped(point: SurfacePoint) -> SurfacePoint {
    SurfacePoint::clamped(point.face, point.barycentric.map(|w| if w < SNAP { 0.0 } else { w }))
}

/// Both meshes with the pairs as landmarks after the user's; `None` where there are no pairs.
fn with(
    inputs: [&SurfaceMesh; 2],
    full: &[LandmarkedMesh; 2],
    pairs: &[OwnPair],
    monitor: &mut dyn Monitor,
) -> Result<Option<[LandmarkedMesh; 2]>, Cancelled> {
    if pairs.is_empty() {
        return Ok(None);
    }
    let at = |pair: &OwnPair| SurfacePoint::at_vertex(&full[0].refined.mesh, pair.source);
    let points: [Vec<SurfacePoint>; 2] =
        [pairs.iter().map(at).collect(), pairs.iter().map(|pair| pair.target).collect()];
    let mut side = |k: usize| {
        let Ok((mesh, vertices)) = full[k].with_points(inputs[k], &points[k]) else { return Ok(None) };
        monitor.step(Step::default())?;
        let mesh = mesh.with_room_around(inputs[k], &vertices);
        monitor.step(Step::default())?;
        Ok(mesh.ok().map(|mesh| (mesh, vertices)))
    };
    let (Some((mut source, from)), Some((mut target, onto))) = (side(0)?, side(1)?) else { return Ok(None) };
    for (s, t) in from.into_iter().zip(onto) {
        if !target.landmarks.contains(&t) {
            source.landmarks.push(s);
            target.landmarks.push(t);
        }
    }
    Ok(Some([source, target]))
}
