//! The base domain drawn on both meshes: corresponding paths between landmarks, corresponding patches.
//!
//! The edges of the base domain become paths of mesh edges on refined copies of both meshes (edges and faces that a
//! path crosses are split), non-crossing, with the same cyclic order at every landmark on both sides. The patches
//! between them are discs, one per base face (Kraevoy & Sheffer 2004). A spanning tree is drawn first, because a tree
//! never separates; then the shortest and straightest of the pairs not yet adjacent. Several orders are tried and the
//! one with the least detours is kept.

mod candidates;
mod drawing;
mod geodesics;
mod isotopy;
mod joint;
mod patches;
mod path_search;
mod refinable;
mod search;
mod twists;

use crate::base_domain::BaseDomain;
use crate::landmarks::Landmarks;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor};
use drawing::Drawing;
use joint::{Ground, Variant};
use typed_index_collections::TiVec;

pub use candidates::{Candidate, Candidates};
pub use geodesics::LandmarkDistances;
pub use isotopy::same_class;
pub use patches::PatchFault;
pub use search::{Judge, Judged, Origin, SearchOptions, SearchReport, neighbours, search, untwist};

/// The base domain and its drawing on both meshes.
#[derive(Clone, Debug)]
pub struct BaseLayout {
    /// The base domain, its landmarks at the target's positions.
    pub base: BaseDomain,
    /// The drawing on the source.
    pub source: PatchedMesh,
    /// The drawing on the target.
    pub target: PatchedMesh,
    /// How straight the paths are.
    pub report: LayoutReport,
}

/// A mesh refined along the paths of the base domain and cut into its patches.
#[derive(Clone, Debug)]
pub struct PatchedMesh {
    /// The refined mesh, scaled to area 1. Its first vertices are the input mesh's vertices in their order.
    pub mesh: SurfaceMesh,
    /// Where each refined vertex lies on the input mesh.
    pub vertex_origin: TiVec<VertexId, SurfacePoint>,
    /// The input face that contains each refined face.
    pub face_origin: TiVec<FaceId, FaceId>,
    /// The base face whose patch contains each refined face.
    pub face_patch: TiVec<FaceId, FaceId>,
    /// The refined mesh's vertex of each landmark (= vertex of the base domain).
    pub landmark_vertices: TiVec<VertexId, VertexId>,
    /// For each base halfedge the refined vertices of its path, both landmarks included; a twin's path is the reverse.
    /// Consecutive vertices are joined by mesh edges, and the patch of the halfedge's face lies on the left.
    pub paths: TiVec<HalfedgeId, Vec<VertexId>>,
}

/// How straight the paths of a layout are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LayoutReport {
    /// Sum over all paths of both meshes of max(0, length / shortest length - 1.1): 0 for straight layouts.
    pub detour: f64,
    /// The largest length / shortest length.
    pub worst_stretch: f64,
    /// Attempts made.
    pub attempts: usize,
}

/// In which order the spanning tree is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeOrder {
    /// Longest edge first.
    LongestFirst,
    /// Layer by layer from the leaves.
    LeavesFirst,
    /// Shortest edge first.
    ShortestFirst,
}

/// How a layout is searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayoutOptions {
    /// Orders of drawing that are tried at most, 1 to 16.
    pub attempts: usize,
    /// A layout with at most this detour ([`LayoutReport::detour`]) is taken at once.
    pub good_detour: f64,
}

impl Default for LayoutOptions {
    fn default() -> Self {
        Self { attempts: 6, good_detour: 0.5 }
    }
}

/// Why no layout was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// No path inside the sectors.
    #[error("no path was found between landmarks {} and {}", landmarks[0], landmarks[1])]
    NoPath {
        /// The landmarks, 0-based.
        landmarks: [usize; 2],
    },
    /// Every pair was tried.
    #[error("the layout stopped at {paths} of {wanted} paths")]
    Stuck {
        /// Paths drawn.
        paths: usize,
        /// Paths of a triangulation.
        wanted: usize,
    },
    /// No layout has a map.
    #[error("no map was found for any of {layouts} layouts{}", around(near))]
    NoMap {
        /// Layouts judged.
        layouts: usize,
        /// Landmarks around which most of them failed, 0-based, the worst first; empty where that is not known.
        near: Vec<usize>,
    },
    /// The paths do not bound discs.
    #[error("the patches are not valid: {0}")]
    Patches(#[from] PatchFault),
}

/// Where layouts failed, in words; landmarks are counted from 1.
fn around(near: &[usize]) -> String {
    match near {
        [] => String::new(),
        [one] => {
            format!("; they fail around landmark {} (the first is 1): move it, or leave it out", one + 1)
        }
        more => {
            let names: Vec<String> = more.iter().map(|k| (k + 1).to_string()).collect();
            format!(
                "; they fail around the landmarks {} (the first is 1): check whether these are exchanged, or so near to \
                 each other that no triangles are between them, and move one or leave it out",
                names.join(", ")
            )
        }
    }
}

/// The orders of drawing, the best on average first.
const VARIANTS: [Variant; 16] = {
    use TreeOrder::{LeavesFirst, LongestFirst, ShortestFirst};
    const fn plain(order: TreeOrder, midpoint_penalty: f64) -> Variant {
        Variant { order, midpoint_penalty, perturbation: 0.0, seed: 0 }
    }
    const fn perturbed(order: TreeOrder, perturbation: f64, seed: u64) -> Variant {
        Variant { order, midpoint_penalty: 1.0, perturbation, seed }
    }
    [
        plain(LongestFirst, 1.0),
        plain(LeavesFirst, 1.0),
        plain(LongestFirst, 1.3),
        plain(LeavesFirst, 1.3),
        plain(ShortestFirst, 1.0),
        plain(ShortestFirst, 1.3),
        perturbed(LongestFirst, 0.3, 1),
        perturbed(LeavesFirst, 0.3, 2),
        perturbed(ShortestFirst, 0.3, 3),
        perturbed(LongestFirst, 0.3, 4),
        perturbed(LeavesFirst, 0.6, 5),
        perturbed(LongestFirst, 0.6, 6),
        perturbed(ShortestFirst, 0.6, 7),
        perturbed(LeavesFirst, 0.6, 8),
        perturbed(LongestFirst, 1.0, 9),
        perturbed(LeavesFirst, 1.0, 10),
    ]
};

/// Plans the base domain on both meshes at once and draws it.
///
/// # Errors
/// [`LayoutError`] when no order of drawing ends in a triangulation.
pub fn joint(
    meshes: [&SurfaceMesh; 2],
    landmarks: &Landmarks,
    options: &LayoutOptions,
    monitor: &mut dyn Monitor,
) -> Result<BaseLayout, LayoutError> {
    let empty = Drawing::new(meshes[0], meshes[1], landmarks);
    let distances = LandmarkDistances::of_drawing(&empty);
    let ground = Ground { empty: &empty, distances: &distances };
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
        let report = report(&drawing, &distances);
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
    let distances = LandmarkDistances::of_drawing(&empty);
    let drawing = joint::draw_base(&Ground { empty: &empty, distances: &distances }, base, monitor)?;
    let report = report(&drawing, &distances);
    Ok(patches::finish(drawing, base.clone(), meshes, report)?)
}

fn report(drawing: &Drawing, distances: &LandmarkDistances) -> LayoutReport {
    let mut report = LayoutReport { attempts: 1, ..LayoutReport::default() };
    for (path, &ends) in drawing.ends.iter().enumerate() {
        for (side, geodesic) in drawing.sides.iter().zip(distances.between(ends)) {
            let stretch = side.lengths[path] / geodesic;
            report.detour += (stretch - 1.1).max(0.0);
            report.worst_stretch = report.worst_stretch.max(stretch);
        }
    }
    report
}
