//! The seams of the texture that a map carries, as lines to be drawn. A triangulation has each point of a seam once for either side of it.

use super::buffers::{Triangles, ribbons};
use super::colours::linear;
use super::defects::{MarkedLineVertex, marked};
use glam::{Vec2, Vec3};
use rustc_hash::FxHashMap;

/// The red in which the plane shows the cut, too.
const BOUNDARY: u32 = 0xd0_1818;

/// Texture coordinates that differ by less are the same: flat metrics close up around a vertex but for what their flow left over.
const SAME: f32 = 1e-5;

/// The seams of a closed surface, each given once as an edge by its ends: the two triangles at such an edge have different texture
/// coordinates.
pub fn seams(places: &[Vec3], uvs: &[Vec2], triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut first = FxHashMap::default();
    let mut first_there =
        |(k, place): (u32, &Vec3)| *first.entry(place.to_array().map(f32::to_bits)).or_insert(k);
    let one: Vec<u32> = (0..).zip(places).map(&mut first_there).collect();
    let sides = || triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let ends = |side: [u32; 2]| side.map(|v| one[v as usize]);
    let of_ends: FxHashMap<[u32; 2], [u32; 2]> = sides().map(|side| (ends(side), side)).collect();
    let is_seam = |&[a, b]: &[u32; 2]| {
        let [start, end] = ends([a, b]);
        let Some(&[c, d]) = of_ends.get(&[end, start]) else { return false };
        let differ = |v: u32, w: u32| uvs[v as usize].distance(uvs[w as usize]) > SAME;
        start < end && (differ(a, d) || differ(b, c))
    };
    sides().filter(is_seam).collect()
}

/// Sides between points as red ribbons.
pub fn drawn(places: &[Vec3], sides: &[[u32; 2]]) -> Triangles<MarkedLineVertex> {
    let strips: Vec<Vec<Vec3>> = sides.iter().map(|side| side.map(|v| places[v as usize]).to_vec()).collect();
    marked(ribbons(&strips), linear(BOUNDARY), 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cone_metric::atlas::flat_atlas;
    use crate::cone_metric::{FlowOptions, flow, uniform_curvature};
    use crate::mesh::generators::icosphere;
    use crate::mesh::{FaceId, VertexId};
    use crate::monitor::Silent;

    #[test]
    fn the_seams_of_a_flat_texture_are_its_cut_and_join_the_landmarks() {
        let ball = icosphere(3);
        let landmarks: Vec<VertexId> = [0, 100, 300, 500, 641].map(VertexId).to_vec();
        let target = uniform_curvature(ball.vertex_count(), &landmarks);
        let (metric, _) = flow(&ball, &target, &FlowOptions::default(), &mut Silent).unwrap();
        let atlas = flat_atlas(&ball, &metric, &landmarks, &mut Silent).unwrap();
        // Every triangle by itself.
        let corners = || ball.faces().flat_map(FaceId::halfedges);
        let places: Vec<Vec3> = corners().map(|h| ball.positions()[ball.tail(h)].as_vec3()).collect();
        let uvs: Vec<Vec2> = corners().map(|h| atlas.corner_uvs[h].as_vec2()).collect();
        let triangles: Vec<[u32; 3]> =
            (0..ball.face_count() as u32).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
        let found = seams(&places, &uvs, &triangles);
        let cut = ball.edges().filter(|&h| atlas.cut[h]).count();
        assert_eq!(found.len(), cut);
        let is_end = |v: VertexId| {
            let at = ball.positions()[v].as_vec3();
            found.iter().flatten().any(|&k| places[k as usize] == at)
        };
        assert!(landmarks.iter().all(|&v| is_end(v)));
        let Triangles { vertices, indices } = drawn(&places, &found);
        assert_eq!((vertices.len(), indices.len()), (4 * cut, 6 * cut));
    }

    #[test]
    fn a_texture_without_seams_has_none() {
        let ball = icosphere(2);
        let places: Vec<Vec3> = ball.positions().iter().map(|p| p.as_vec3()).collect();
        let triangles: Vec<[u32; 3]> = ball.triangles().iter().map(|t| t.map(|v| v.0)).collect();
        assert!(seams(&places, &vec![Vec2::ZERO; places.len()], &triangles).is_empty());
    }
}
