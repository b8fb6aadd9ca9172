//! Gaps: vertices on open edges that lie beside each other and are not joined, since they are not at the same place.

use super::draft::edges;
use super::joining::joined;
use super::options::RepairOptions;
use super::order::drafted;
use crate::math::scalar::{max, min};
use crate::mesh::FileFrame;
use crate::mesh::check::MeshFault;
use crate::mesh::soup::PolygonSoup;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// Vertices beside each other that a distance would join ([`RepairOptions::join_within`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaps {
    /// Number of vertices on open edges with another one within the distance that no open edge joins them with.
    pub vertices: usize,
    /// The distance that is proposed, in the file's units: twice the largest of these vertices to their nearest.
    pub distance: f64,
}

/// The widest gap that is told, in units of the length of an open edge that is longer than a quarter of them: a distance of that
/// size joins vertices across gaps before those along them. Chosen by hand.
const WIDEST: f64 = 0.25;
/// A vertex among more than so many others lies in a crowd, at no gap: corners of faces that meet at one vertex are fewer.
const MOST_COMPARED: usize = 64;

/// The gaps of a soup that the repair leaves; `None` where it has none.
///
/// # Errors
/// [`MeshFault`] for a soup without faces, or too many.
pub fn gaps(soup: &PolygonSoup, options: &RepairOptions) -> Result<Option<Gaps>, MeshFault> {
    let frame = FileFrame::of(soup);
    let draft = joined(drafted(&frame.soup(soup))?, options.join_within / frame.scale());
    let edges = edges(&draft.faces).into_iter().filter(|edge| edge.halfedges.len() == 1);
    let open: FxHashSet<[u32; 2]> = edges.map(|edge| edge.ends).collect();
    let at = |v: u32| draft.positions[v as usize];
    let mut lengths: Vec<f64> = open.iter().map(|&[a, b]| at(a).distance(at(b))).collect();
    lengths.sort_by(f64::total_cmp);
    let widest = WIDEST * lengths.get(lengths.len() / 4).copied().unwrap_or_default();
    if widest <= 0.0 {
        return Ok(None);
    }
    let mut vertices: Vec<u32> = open.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let cell = |p: DVec3| (p / widest).floor().to_array().map(|x| x as i64);
    let mut cells: FxHashMap<[i64; 3], Vec<u32>> = FxHashMap::default();
    vertices.iter().for_each(|&v| cells.entry(cell(at(v))).or_default().push(v));
    let nearest = |v: u32| {
        let [x, y, z] = cell(at(v));
        let beside = (0..27).map(|k| {
            [x.saturating_add(k % 3 - 1), y.saturating_add(k / 3 % 3 - 1), z.saturating_add(k / 9 - 1)]
        });
        let near: Vec<u32> =
            beside.filter_map(|at| cells.get(&at)).flatten().copied().take(MOST_COMPARED + 1).collect();
        if near.len() > MOST_COMPARED {
            return None;
        }
        let others = near.iter().filter(|&&w| w != v && !open.contains(&[v.min(w), v.max(w)]));
        others.map(|&w| at(v).distance(at(w))).reduce(min).filter(|distance| *distance <= widest)
    };
    let found: Vec<f64> = vertices.iter().filter_map(|&v| nearest(v)).collect();
    let largest = found.iter().copied().reduce(max).filter(|distance| *distance > 0.0);
    Ok(largest.map(|largest| Gaps { vertices: found.len(), distance: 2.0 * largest * frame.scale() }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::scalar::{cos, sin};
    use std::f64::consts::TAU;

    /// Triangles around a common edge, which are near each other as blades of a fan are.
    #[test]
    fn a_crowd_of_vertices_is_no_gap() {
        let count = 4000;
        let blade = |k: u32| {
            let angle = TAU * f64::from(k) / f64::from(count);
            DVec3::new(cos(angle), sin(angle), 0.5)
        };
        let fan = PolygonSoup {
            positions: [DVec3::ZERO, DVec3::Z].into_iter().chain((0..count).map(blade)).collect(),
            polygons: (0..count).map(|k| vec![0, 1, k + 2]).collect(),
            ..PolygonSoup::default()
        };
        assert_eq!(gaps(&fan, &RepairOptions::default()), Ok(None));
    }
}
