//! Bounds on a drawing: vertices of its refined meshes, steps of its searches, detours of its paths.
//!
//! Landmarks in a senseless order make paths wind around each other, and each path that winds makes the next ones longer: refined
//! meshes and searches would grow exponentially with the number of landmarks. So a drawing ends where it has become larger than
//! any that leads to a map. All bounds are counted, so that the same input ends at the same place everywhere.

/// The largest sizes of a drawing.
///
/// Among 544 first drawings of the 34 test pairs the largest has 11 times the vertices of its level and takes 230 steps of searches for each
/// landmark and vertex, and no detour is above 0.31 for each path; drawings that are judged have a third of that at most. With 33
/// landmarks of cat and lion in random order the least of 20 drawings has 13 times the vertices, 33 steps and a detour of 0.54.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// Vertices of the refined source and target.
    vertices: [usize; 2],
    /// Nodes that the searches of one drawing settle.
    pub steps: usize,
    /// Sum of the detours of its paths ([`super::LayoutReport::detour`]): no useful map comes of a drawing of long detours.
    pub detour: f64,
}

/// Vertices of a refined mesh for each vertex of its level, at most. Chosen by hand.
const VERTEX_GROWTH: usize = 16;
/// Factor of sqrt(landmarks * vertices) in the number of vertices that a drawing may add to a level: all paths together cross a number of
/// edges that grows so. On fine levels this is the smaller of both bounds. Chosen by hand.
const PATH_GROWTH: f64 = 200.0;
/// Steps of the searches of one drawing for each landmark and each vertex of the level. Chosen by hand.
const STEPS: usize = 250;
/// The detour that a layout may have whatever its number of paths. Chosen by hand.
const FREE_DETOUR: f64 = 12.0;
/// The further detour that it may have for each path. Chosen by hand.
const DETOUR_OF_PATH: f64 = 0.25;
/// Length of a path relative to the shortest that is no detour: 10 % is left to paths over vertices and midpoints for giving way.
/// Chosen by hand.
const GIVING_WAY: f64 = 1.1;

/// The detour of a path that is `stretch` times as long as the shortest one: what exceeds the length left for giving way.
pub fn detour(stretch: f64) -> f64 {
    (stretch - GIVING_WAY).max(0.0)
}

/// Landmarks times vertices of a level, at most: as many distances are kept of each mesh, in 8 bytes each, 320 MB. Chosen by hand.
pub const MOST_DISTANCES: usize = 40_000_000;

impl Bounds {
    /// The bounds of drawings with this many landmarks on levels with this many vertices.
    pub fn new(landmarks: usize, vertices: [usize; 2]) -> Self {
        let of_mesh = |vertices: usize| {
            let of_paths = (PATH_GROWTH * ((landmarks * vertices) as f64).sqrt()) as usize;
            (VERTEX_GROWTH * vertices).min(vertices + of_paths)
        };
        Self {
            vertices: vertices.map(of_mesh),
            steps: STEPS * landmarks * vertices[0].max(vertices[1]),
            detour: FREE_DETOUR + DETOUR_OF_PATH * (3 * landmarks) as f64,
        }
    }

    /// Whether the refined meshes may have this many vertices.
    pub fn has_room_for(&self, vertices: [usize; 2]) -> bool {
        vertices.iter().zip(&self.vertices).all(|(count, most)| count <= most)
    }
}

/// Landmarks that an error names, at most. Chosen by hand.
const NAMED: usize = 4;

/// The landmarks with more than half as much blame as the worst, the worst first, at most four; none without blame.
pub fn worst(blame: &[f64]) -> Vec<usize> {
    let most = blame.iter().copied().fold(0.0, f64::max);
    let mut near: Vec<usize> = (0..blame.len()).filter(|&k| 2.0 * blame[k] > most).collect();
    near.sort_by(|&a, &b| blame[b].total_cmp(&blame[a]));
    near.truncate(NAMED);
    near
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fine_levels_have_less_room_for_each_vertex() {
        let room = |vertices: usize| Bounds::new(33, [vertices; 2]).vertices[0] as f64 / vertices as f64;
        assert_eq!(room(594), 16.0);
        assert!(room(160_000) > 2.0 && room(160_000) < 5.0, "{}", room(160_000));
        assert!(Bounds::new(4, [500, 600]).has_room_for([500, 600]));
        assert!(!Bounds::new(4, [500, 600]).has_room_for([500, 16 * 600 + 1]));
    }

    #[test]
    fn the_worst_are_named_in_their_order() {
        assert_eq!(worst(&[0.0, 3.0, 5.0, 2.0, 2.6]), [2, 1, 4]);
        assert_eq!(worst(&[1.0; 9]), [0, 1, 2, 3]);
        assert!(worst(&[0.0; 5]).is_empty() && worst(&[]).is_empty());
    }
}
