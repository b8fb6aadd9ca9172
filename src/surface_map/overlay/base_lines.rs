//! The straight edges of the base domain drawn on a parametrised mesh.
//!
//! On the cone surface the edges of its charts are straight lines from cone to cone. Followed on source and target they are
//! lines that correspond under the map. Where the anchor of a landmark is right, the lines from it arrive at their landmarks after
//! their lengths; wrong anchors are found and corrected by lines that arrive.

use super::location::exit_edge;
use crate::certificate::Start;
use crate::landmarks::LandmarkId;
use crate::math::rigid2::{Rigid2, complex_mul};
use crate::math::scalar::{cos, sin};
use crate::math::triangle::signed_double_area;
use crate::mesh::face_weights::FaceWeights;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, SurfacePoint, VertexId};
use crate::surface_map::parametrisation::cone_surface::ConeSurface;
use crate::surface_map::parametrisation::embedding::{Anchor, Embedding, Parametrised};
use crate::surface_map::parametrisation::fan::{Fan, Wedge};
use glam::DVec2;
use std::sync::Arc;
use typed_index_collections::{TiSlice, TiVec};

/// One edge of a base face on a mesh.
#[derive(Clone, Debug)]
pub struct BaseLine {
    /// From landmark to landmark, one point on every edge that is crossed.
    pub points: Vec<SurfacePoint>,
    /// Distance between the end of the line and its landmark (the cone surface has area 1); infinite where the line misses it.
    pub end_error: f64,
    /// The anchor of the landmark at the end, as the line finds it; `None` where the line misses the landmark.
    pub arrival: Option<Anchor>,
    /// The line in each face that it passes, from the first to the last.
    pub sections: Vec<LineSection>,
}

/// A base line in one of the faces that it passes.
#[derive(Clone, Copy, Debug)]
pub struct LineSection {
    /// The face.
    pub face: FaceId,
    /// Both ends of the whole line in the plane of the face.
    pub ends: [DVec2; 2],
    /// The halfedge of the face that the line leaves through; `None` in the last face, where it ends at a corner.
    pub exit: Option<HalfedgeId>,
}

/// Corrects the anchors of an embedding that disagree with the others.
///
/// A plane's angle around a cone is known up to whole turns of the plane, which are not whole turns around the cone; an
/// anchor that was turned too far in one step is wrong. Lines that start at right anchors arrive, and determine the others.
pub fn mend_anchors(
    embedding: &mut Embedding,
    mesh: &SurfaceMesh,
    landmarks: &LandmarkVertices,
    surface: &ConeSurface,
) {
    let base = &surface.base;
    let all_arrive = |embedding: &Embedding, l: LandmarkId| {
        let side = Parametrised { mesh, landmark_vertices: landmarks, embedding, weights: FaceWeights::EVEN };
        base.star(l).all(|h| base_line(side, surface, h).arrival.is_some())
    };
    let mut right: TiVec<LandmarkId, bool> = base.landmarks().map(|l| all_arrive(embedding, l)).collect();
    let mut queue: Vec<LandmarkId> = base.landmarks().filter(|&l| right[l]).collect();
    if queue.len() == right.len() {
        return;
    }
    while let Some(l) = queue.pop() {
        for h in base.star(l) {
            let head = base.head(h);
            let side =
                Parametrised { mesh, landmark_vertices: landmarks, embedding, weights: FaceWeights::EVEN };
            if right[head] {
                continue;
            }
            if let Some(anchor) = base_line(side, surface, h).arrival {
                Arc::make_mut(&mut embedding.anchors)[head] = anchor;
                right[head] = true;
                queue.push(head);
            }
        }
    }
}

/// The mesh's vertex of each landmark.
type LandmarkVertices = TiSlice<LandmarkId, VertexId>;

/// Follows base halfedge `h` on a mesh.
pub fn base_line(side: Parametrised<'_>, surface: &ConeSurface, h: HalfedgeId) -> BaseLine {
    let base = &surface.base;
    let length = surface.lengths[h];
    let goal = side.landmark_vertices[base.head(h)];
    let corners = &side.embedding.corners;
    let start = start(side, surface, h);
    let mut line = BaseLine {
        points: vec![SurfacePoint::at_vertex(side.mesh, side.landmark_vertices[base.tail(h)])],
        end_error: f64::INFINITY,
        arrival: None,
        sections: Vec::new(),
    };
    let (mut face, mut motion) = (start.corner.face(), Rigid2::IDENTITY);
    let ends = [corners[start.corner], corners[start.corner] + start.direction * length];
    let mut entered = None;
    // A straight line crosses no face twice but around cones; the bound ends one that rounding keeps from arriving.
    for step in 0..side.mesh.face_count() + 1000 {
        let [p, q] = ends.map(|e| motion.apply(e));
        let arrival = [0, 1, 2].map(|k| HalfedgeId::of(face, k)).into_iter().find(|&c| {
            side.mesh.tail(c) == goal
                // Near enough that the line's end error can be stated, even if it is too large.
                && corners[c].distance(q) < 1e-3 * length
                && (step > 0 || c != start.corner)
        });
        if let Some(corner) = arrival {
            line.end_error = corners[corner].distance(q);
            // Far above rounding, and far below the distance of any other landmark.
            if line.end_error < 1e-6 * length {
                line.arrival =
                    Some(arrived(surface, h, corner, [corners[corner], corners[corner] + (p - q)]));
            }
            line.points.push(SurfacePoint::at_vertex(side.mesh, goal));
            line.sections.push(LineSection { face, ends: [p, q], exit: None });
            break;
        }
        let exit = if step == 0 {
            Some(start.corner.next())
        } else {
            exit_edge(side.embedding, face, [p, q], entered)
        };
        let Some(exit) = exit else { break };
        line.sections.push(LineSection { face, ends: [p, q], exit: Some(exit) });
        line.points.push(crossing(exit, [corners[exit], corners[exit.next()]], [p, q]));
        motion = side.embedding.transitions[exit].after(&motion);
        let twin = side.mesh.twin(exit);
        face = twin.face();
        entered = Some(twin);
    }
    line
}

/// The anchor at the end of base halfedge `h`, which arrives at a corner; `way_back` lies along it, from the corner on.
fn arrived(surface: &ConeSurface, h: HalfedgeId, corner: HalfedgeId, way_back: [DVec2; 2]) -> Anchor {
    let back = surface.base.mesh.twin(h);
    let chart = surface.charts[back.face()];
    let motion = Rigid2::between_segments([chart[back.corner()], chart[back.next().corner()]], way_back);
    Anchor { corner, chart: back.face(), motion }
}

/// The corner and the direction in which base halfedge `h` starts on a mesh, by the anchor of its landmark.
pub fn start(side: Parametrised<'_>, surface: &ConeSurface, h: HalfedgeId) -> Start {
    let landmark = surface.base.tail(h);
    let fan = Fan::new(surface, landmark);
    let angle = fan.angle_of(h).unwrap_or(0.0);
    let anchor = side.embedding.anchors[landmark];
    let past = |w: &Wedge| (angle - w.begin).rem_euclid(fan.total);
    let outside = |w: &Wedge| (past(w) - w.width).max(0.0);
    let wedge = fan.wedges(side, &anchor).min_by(|v, w| outside(v).total_cmp(&outside(w)));
    let corner = wedge.map_or(anchor.corner, |w| w.corner);
    let turn = wedge.map_or(0.0, |w| past(&w).min(w.width));
    let corners = &side.embedding.corners;
    let along = (corners[corner.next()] - corners[corner]).normalize_or(DVec2::X);
    Start { corner, direction: complex_mul(along, DVec2::new(cos(turn), sin(turn))) }
}

/// The point where the segment p q crosses the halfedge from a to b.
fn crossing(h: HalfedgeId, [a, b]: [DVec2; 2], [p, q]: [DVec2; 2]) -> SurfacePoint {
    let [sa, sb] = [a, b].map(|end| signed_double_area(p, q, end));
    let share = if sa == sb { 0.5 } else { (sa / (sa - sb)).clamp(0.0, 1.0) };
    SurfacePoint::on_halfedge(h, share)
}
