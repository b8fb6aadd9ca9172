//! Vertices on the rims of caps that coarse levels keep.
//!
//! A small cap would vanish on a coarse level, and the other mesh's part that belongs under it would be mapped onto skin, from where it
//! hardly comes back on finer levels. So some vertices of each rim stay, about as far from each other as they can.

use crate::mesh::face_weights::FaceWeights;
use crate::mesh::rims::rims;
use crate::mesh::{SurfaceMesh, VertexId};

/// The numbers of vertices of rims that stay on a coarse level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RimOptions {
    /// Vertices of each rim, at most.
    pub each: usize,
    /// Vertices of all rims together, as a share of the level's vertices, 0 to 1; the longest rims come first.
    pub share: f64,
}

/// The vertices of rims that stay on a coarse level with `vertices` vertices.
pub fn kept_of_rims(
    mesh: &SurfaceMesh,
    weights: FaceWeights<'_>,
    options: RimOptions,
    vertices: usize,
) -> Vec<VertexId> {
    let most = (options.share * vertices as f64) as usize;
    let mut kept = Vec::new();
    for rim in rims(mesh, |f| !weights.is_skin(f)) {
        if kept.len() + options.each > most {
            break;
        }
        kept.extend(spread(mesh, &rim.vertices, options.each));
    }
    kept
}

/// At most `most` of the vertices, chosen as farthest points in space.
fn spread(mesh: &SurfaceMesh, vertices: &[VertexId], most: usize) -> Vec<VertexId> {
    let place = |v: VertexId| mesh.positions()[v];
    let mut chosen: Vec<VertexId> = vertices.first().copied().into_iter().take(most).collect();
    let mut nearest = vec![f64::INFINITY; vertices.len()];
    while chosen.len() < most.min(vertices.len()) {
        let last = place(chosen[chosen.len() - 1]);
        let mut far = 0;
        for (k, &v) in vertices.iter().enumerate() {
            nearest[k] = nearest[k].min(place(v).distance_squared(last));
            if nearest[k] > nearest[far] {
                far = k;
            }
        }
        chosen.push(vertices[far]);
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::FaceId;
    use crate::mesh::face_weights::FaceWeight;
    use crate::mesh::generators::icosphere;
    use typed_index_collections::TiVec;

    #[test]
    fn each_rim_keeps_vertices_all_around() {
        let ball = icosphere(4);
        let is_cap = |f: FaceId| {
            let middle = ball.corners(f).iter().sum::<glam::DVec3>() / 3.0;
            middle.z > 0.9 || middle.z < -0.7
        };
        let of_cap = FaceWeight { weight: 0.01, toll: 0.0 };
        let weights: TiVec<FaceId, FaceWeight> =
            ball.faces().map(|f| if is_cap(f) { of_cap } else { FaceWeight::SKIN }).collect();
        let weights = FaceWeights::new(Some(&weights));
        let options = RimOptions { each: 8, share: 0.25 };
        let kept = kept_of_rims(&ball, weights, options, 400);
        assert_eq!(kept.len(), 16);
        for height in [1.0, -1.0] {
            let rim: Vec<_> =
                kept.iter().map(|&v| ball.positions()[v]).filter(|p| p.z * height > 0.0).collect();
            assert_eq!(rim.len(), 8);
            // Every side of the rim must have one of the kept vertices.
            for k in 0..12 {
                let side = crate::math::golden::direction(k).extend(0.0);
                let reach = rim.iter().map(|p| p.dot(side)).fold(f64::NEG_INFINITY, f64::max);
                assert!(reach > 0.75 * rim[0].truncate().length(), "{reach}");
            }
        }
        // The longest rim where not all have room.
        let few = kept_of_rims(&ball, weights, options, 40);
        assert!(few.len() == 8 && few.iter().all(|&v| ball.positions()[v].z < 0.0));
        assert_eq!(kept_of_rims(&ball, FaceWeights::EVEN, options, 400), []);
        assert_eq!(kept_of_rims(&ball, weights, RimOptions { each: 0, ..options }, 400), []);
    }
}
