//! The base domain's flat triangles on one sheet of paper.
//!
//! Triangles are unfolded along their sides as long as they do not overlap; where they would (more than a full turn lies around
//! some cones) a new island begins. Islands are set in rows on the unit square.

use crate::math::barycentric::interpolated;
use crate::math::rigid2::Rigid2;
use crate::math::triangle::{lay_out, signed_double_area};
use crate::mesh::{FaceId, HalfedgeId};
use crate::surface_map::flat_layout::FlatLayout;
use glam::DVec2;
use typed_index_collections::{TiVec, ti_vec};

/// The largest overlap of triangles that only touch, in units of the root of the whole area.
const TOUCH: f64 = 1e-9;
/// The room between islands, in the same units.
const MARGIN: f64 = 0.03;

/// The places of the corners of every base face, within the unit square and all at one scale.
#[derive(Clone, Debug)]
pub struct FlatSheet {
    /// The corners of each base face, counter-clockwise.
    pub corners: TiVec<FaceId, [DVec2; 3]>,
    /// The number of the island of each base face.
    pub islands: TiVec<FaceId, u32>,
    /// Height of what is used of the unit square.
    pub height: f64,
    /// Width of what is used of the unit square.
    pub width: f64,
}

impl FlatSheet {
    /// Lays out the base domain of a flat layout.
    pub fn new(layout: &FlatLayout) -> Self {
        let mut unfolding = Unfolding::new(layout);
        let mut islands = Vec::new();
        for f in layout.base.mesh.faces() {
            if unfolding.placed[f].is_none() {
                islands.push(unfolding.grow(f));
            }
        }
        unfolding.set(&islands)
    }

    /// The place on the sheet of a point of a base face.
    pub fn at(&self, chart: FaceId, weights: [f64; 3]) -> DVec2 {
        interpolated(self.corners[chart], weights)
    }
}

struct Unfolding<'a> {
    layout: &'a FlatLayout,
    placed: TiVec<FaceId, Option<[DVec2; 3]>>,
}

impl<'a> Unfolding<'a> {
    fn new(layout: &'a FlatLayout) -> Self {
        Self { layout, placed: ti_vec![None; layout.base.mesh.face_count()] }
    }

    fn chart(&self, f: FaceId) -> [DVec2; 3] {
        lay_out(f.halfedges().map(|h| self.layout.lengths[h]))
    }

    /// An island from a face on: always across the longest side at which there is room.
    fn grow(&mut self, first: FaceId) -> Vec<FaceId> {
        let mesh = &self.layout.base.mesh;
        self.placed[first] = Some(self.chart(first));
        let mut island = vec![first];
        let mut sides = first.halfedges().to_vec();
        loop {
            let longest = (0..sides.len()).max_by(|&a, &b| {
                let length = |k: usize| self.layout.lengths[sides[k]];
                length(a).total_cmp(&length(b)).then(sides[b].cmp(&sides[a]))
            });
            let Some(k) = longest else { break };
            let side = sides.swap_remove(k);
            let beyond = mesh.twin(side);
            if self.placed[beyond.face()].is_some() {
                continue;
            }
            let Some(triangle) = self.unfolded(side) else { continue };
            let is_free =
                island.iter().all(|&f| self.placed[f].is_none_or(|other| !overlap(&other, &triangle)));
            if is_free {
                self.placed[beyond.face()] = Some(triangle);
                island.push(beyond.face());
                sides.extend([beyond.next(), beyond.prev()]);
            }
        }
        island
    }

    /// The face beyond a side, turned to it.
    fn unfolded(&self, side: HalfedgeId) -> Option<[DVec2; 3]> {
        let here = self.placed[side.face()]?;
        let beyond = self.layout.base.mesh.twin(side);
        let chart = self.chart(beyond.face());
        let from = [chart[beyond.corner()], chart[beyond.next().corner()]];
        let onto = [here[side.next().corner()], here[side.corner()]];
        let motion = Rigid2::between_segments(from, onto);
        Some(chart.map(|p| motion.apply(p)))
    }

    /// Islands in rows, the highest first, scaled to the unit square.
    fn set(self, islands: &[Vec<FaceId>]) -> FlatSheet {
        let triangle = |f: FaceId| self.placed[f].unwrap_or_default();
        let bounds = |island: &[FaceId]| {
            let corners = || island.iter().flat_map(|&f| triangle(f));
            let low = corners().fold(DVec2::INFINITY, DVec2::min);
            [low, corners().fold(DVec2::NEG_INFINITY, DVec2::max) - low]
        };
        let boxes: Vec<[DVec2; 2]> = islands.iter().map(|island| bounds(island)).collect();
        let mut order: Vec<usize> = (0..islands.len()).collect();
        order.sort_by(|&a, &b| boxes[b][1].y.total_cmp(&boxes[a][1].y).then(a.cmp(&b)));
        let area: f64 = boxes.iter().map(|[_, size]| (size.x + MARGIN) * (size.y + MARGIN)).sum();
        let widest = boxes.iter().map(|[_, size]| size.x + MARGIN).fold(0.0, f64::max);
        let row_width = area.sqrt().max(widest);
        let (mut at, mut row, mut width) = (DVec2::splat(MARGIN), 0.0_f64, 0.0_f64);
        let mut shifts = vec![DVec2::ZERO; islands.len()];
        for k in order {
            let [low, size] = boxes[k];
            if at.x > MARGIN && at.x + size.x > row_width {
                at = DVec2::new(MARGIN, at.y + row + MARGIN);
                row = 0.0;
            }
            shifts[k] = at - low;
            at.x += size.x + MARGIN;
            row = row.max(size.y);
            width = width.max(at.x);
        }
        let size = DVec2::new(width, at.y + row + MARGIN);
        let scale = 1.0 / size.max_element();
        let faces = self.layout.base.mesh.face_count();
        let mut sheet = FlatSheet {
            corners: ti_vec![[DVec2::ZERO; 3]; faces],
            islands: ti_vec![0; faces],
            width: size.x * scale,
            height: size.y * scale,
        };
        for (k, island) in islands.iter().enumerate() {
            for &f in island {
                sheet.corners[f] = triangle(f).map(|p| (p + shifts[k]) * scale);
                sheet.islands[f] = k as u32;
            }
        }
        sheet
    }
}

/// Whether two counter-clockwise triangles overlap by more than [`TOUCH`].
fn overlap(a: &[DVec2; 3], b: &[DVec2; 3]) -> bool {
    let is_apart = |a: &[DVec2; 3], b: &[DVec2; 3]| {
        (0..3).any(|k| {
            let (p, q) = (a[k], a[(k + 1) % 3]);
            b.iter().all(|&r| signed_double_area(p, q, r) <= TOUCH * p.distance(q))
        })
    };
    !is_apart(a, b) && !is_apart(b, a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base_domain::BaseDomain;
    use crate::mesh::generators::{icosphere, tetrahedron};
    use crate::surface_map::flat_layout::FlatDrawing;

    #[test]
    fn islands_keep_lengths_and_do_not_overlap() {
        for mesh in [tetrahedron(), icosphere(0), icosphere(1)] {
            let lengths = mesh.halfedges().map(|h| mesh.length(h)).collect();
            let layout = FlatLayout {
                base: BaseDomain { mesh },
                lengths,
                drawings: [FlatDrawing::default(), FlatDrawing::default()],
            };
            let sheet = FlatSheet::new(&layout);
            let scale = |h: HalfedgeId| {
                let corners = sheet.corners[h.face()];
                corners[h.corner()].distance(corners[h.next().corner()]) / layout.lengths[h]
            };
            let first = scale(HalfedgeId(0));
            let faces: Vec<FaceId> = layout.base.mesh.faces().collect();
            for h in layout.base.mesh.halfedges() {
                assert!((scale(h) / first - 1.0).abs() < 1e-9);
            }
            for (i, &f) in faces.iter().enumerate() {
                for p in sheet.corners[f] {
                    assert!(p.min_element() >= 0.0 && p.x <= sheet.width && p.y <= sheet.height);
                }
                for &g in &faces[..i] {
                    assert!(!overlap(&sheet.corners[f], &sheet.corners[g]), "{f:?} {g:?}");
                }
            }
            assert!((sheet.width.max(sheet.height) - 1.0).abs() < 1e-12);
        }
    }
}
