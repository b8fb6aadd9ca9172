//! The landmarks that people begin with: mostly ends of limbs.

use conemap::geodesic::distances;
use conemap::mesh::{SurfaceMesh, VertexId};

/// The numbers of as many landmarks of a mesh as wanted: first the one whose distances to all others along the surface have the largest sum, then
/// each time the one that is farthest from those before.
pub fn ends(mesh: &SurfaceMesh, landmarks: &[VertexId], count: usize) -> Vec<usize> {
    let fields: Vec<_> = landmarks.iter().map(|&v| distances(mesh, &[v])).collect();
    let farthest =
        |far: &dyn Fn(usize) -> f64| (0..landmarks.len()).max_by(|&a, &b| far(a).total_cmp(&far(b)));
    let to_all = |k: usize| fields.iter().map(|field| field[landmarks[k]]).sum();
    let mut chosen: Vec<usize> = farthest(&to_all).into_iter().collect();
    while chosen.len() < count.min(landmarks.len()) {
        let to_chosen =
            |k: usize| chosen.iter().map(|&c| fields[c][landmarks[k]]).fold(f64::INFINITY, f64::min);
        chosen.extend(farthest(&to_chosen));
    }
    chosen
}

/// The partners, as left and right ears, that both are among the chosen landmarks, by their places there.
pub fn partners_among(chosen: &[usize], partners: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let place = |k: usize| chosen.iter().position(|&c| c == k);
    partners.iter().filter_map(|&[a, b]| Some([place(a)?, place(b)?])).collect()
}
