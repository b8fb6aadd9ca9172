//! Vertices at one place become one, along open edges.
//!
//! Elsewhere the surface is closed, and two vertices at one place are two sheets that touch: they stay apart.

use super::draft::{Draft, edges};
use crate::math::disjoint_sets::DisjointSets;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// The draft with vertices on open edges joined where they are within a distance of each other; 0 for exactly equal places.
pub(super) fn joined(draft: Draft, within: f64) -> Draft {
    let mut open: Vec<u32> = edges(&draft.faces)
        .iter()
        .filter(|edge| edge.halfedges.len() == 1)
        .flat_map(|edge| edge.ends)
        .collect();
    open.sort_unstable();
    open.dedup();
    let mut sets = DisjointSets::new(draft.positions.len());
    if within > 0.0 {
        join_near(&draft.positions, &open, within, &mut sets);
    } else {
        join_equal(&draft.positions, &open, &mut sets);
    }
    // The vertex with the least number stands for a set.
    let mut least: FxHashMap<usize, u32> = FxHashMap::default();
    let stands: FxHashMap<u32, u32> =
        open.iter().map(|&v| (v, *least.entry(sets.root(v as usize)).or_insert(v))).collect();
    let mut draft = draft;
    for v in draft.faces.iter_mut().flat_map(|face| &mut face.corners) {
        *v = stands.get(v).copied().unwrap_or(*v);
    }
    draft
}

fn join_equal(positions: &[DVec3], open: &[u32], sets: &mut DisjointSets) {
    let mut first_at = FxHashMap::default();
    for &v in open {
        // Adding 0 makes -0 and 0 the same bits.
        let key = (positions[v as usize] + DVec3::ZERO).to_array().map(f64::to_bits);
        let first = *first_at.entry(key).or_insert(v);
        sets.join(v as usize, first as usize);
    }
}

/// Joins by a grid whose cells are as large as the distance.
fn join_near(positions: &[DVec3], open: &[u32], within: f64, sets: &mut DisjointSets) {
    // Cells beyond the range of i64 become one: more vertices are compared, and none is missed.
    let cell = |p: DVec3| (p / within).floor().to_array().map(|x| x as i64);
    let mut cells: FxHashMap<[i64; 3], Vec<u32>> = FxHashMap::default();
    for &v in open {
        let p = positions[v as usize];
        let [x, y, z] = cell(p);
        for step in 0..27 {
            let [dx, dy, dz] = [step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1];
            let beside = [x.saturating_add(dx), y.saturating_add(dy), z.saturating_add(dz)];
            for &w in cells.get(&beside).into_iter().flatten() {
                if positions[w as usize].distance(p) <= within {
                    sets.join(v as usize, w as usize);
                }
            }
        }
        cells.entry([x, y, z]).or_default().push(v);
    }
}
