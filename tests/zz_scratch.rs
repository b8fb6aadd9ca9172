#![allow(missing_docs)]
mod common;
use conemap::landmarks::Landmarks;
use conemap::layout::{self, LayoutOptions};
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use std::time::Instant;

pub fn coarsen(mesh: &SurfaceMesh, keep: &[VertexId], count: usize) -> (SurfaceMesh, Vec<VertexId>) {
    let l = conemap::mesh::coarsening::Level::coarse(mesh, keep, count);
    let at = |v: &VertexId| VertexId::from(l.vertices.iter().position(|w| w == v).unwrap());
    let k = keep.iter().map(at).collect();
    (l.mesh, k)
}

pub fn coarse_pair(
    data: &std::path::Path,
    name: &str,
    count: usize,
) -> (SurfaceMesh, SurfaceMesh, Landmarks) {
    let pair = common::read_pair(data, name);
    let l = common::landmarks(&pair);
    let (s, ls) = coarsen(&pair.source, &l.source, count);
    let (t, lt) = coarsen(&pair.target, &l.target, count);
    (s, t, Landmarks { source: ls, target: lt })
}

#[test]
fn timing() {
    let data = common::data_folder("x").unwrap();
    for name in ["horse-camel", "cat-lion", "shrec07-383-397"] {
        let (s, t, l) = coarse_pair(&data, name, 1500);
        println!("{name} {} {} {}", s.vertex_count(), t.vertex_count(), l.len());
        for attempts in [1, 6] {
            let now = Instant::now();
            let r = layout::joint(
                [&s, &t],
                &l,
                &LayoutOptions { attempts, good_detour: 0.0, rank: 0 },
                &mut Silent,
            )
            .unwrap();
            println!("{attempts}: {:?} {:?}", now.elapsed(), r.report);
        }
    }
}
