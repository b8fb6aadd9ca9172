//! Images of the source's vertices under several maps, at each vertex those of the map that distorts the surface around it least.
//!
//! Of two maps each may be the better one somewhere: one turns a leg, the other an arm. Where two coarse maps of poses are farther apart
//! than [`ELSEWHERE`], the one that distorts less around the vertex is the nearer one to the truth for nine tenths of the distance (see
//! docs/experiments.md).

use crate::coarse_map::multilevel::LevelImages;
use crate::math::scalar::{ln, max};
use crate::mesh::closest_point::closest_point;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use glam::DVec3;
use typed_index_collections::{TiSlice, TiVec};

/// Images that are nearer to each other than this are taken for the same; the area is 1. Half the length of a coarse level's edges.
const ELSEWHERE: f64 = 0.03;

/// The distortion around a vertex is that of the faces whose centres are within this distance; the area is 1. About the girth of a thin
/// limb; 0.07 and 0.14 were tried (see docs/experiments.md).
const AROUND: f64 = 0.1;

/// A map is worse than another one where its mean log density is above this many times the other one's around the vertices whose images are elsewhere.
/// On finer levels of three pairs of poses, 24 maps of three rounds each, it is 2.7 and 5.2 times where a leg was turned again, 1.05 where one turned
/// back by half.
const WORSE: f64 = 1.3;

/// Least ratio of areas whose distortion is told apart: triangles whose corners have one image have the area 0.
const LEAST_AREA: f64 = 1e-6;

/// The share of the vertices of the first map's source level, 0 to 1, whose images under both maps are different ones, of those that the other
/// source level has as well; 1 where there are none. The maps are between levels of the same two meshes.
pub fn share_elsewhere([one, other]: [&LevelImages; 2]) -> f64 {
    let (mut all, mut elsewhere) = (0, 0);
    for vertex in common([one, other]) {
        all += 1;
        elsewhere += usize::from(vertex.is_elsewhere);
    }
    if all > 0 { elsewhere as f64 / all as f64 } else { 1.0 }
}

/// A vertex that the source levels of two maps have.
struct Common {
    /// Its number on the source mesh.
    full: VertexId,
    /// Its numbers on both levels.
    on_levels: [VertexId; 2],
    /// Whether its images under both maps are different ones.
    is_elsewhere: bool,
}

/// The vertices that the source levels of both maps have.
fn common<'a>([one, other]: [&'a LevelImages; 2]) -> impl Iterator<Item = Common> + 'a {
    let place = |map: &LevelImages, v: VertexId| map.target_from_source[v].position(&map.levels[1].mesh);
    one.levels[0].vertices.iter_enumerated().filter_map(move |(v, &full)| {
        let w = other.levels[0].vertices.binary_search(&full).ok()?;
        let is_elsewhere = place(one, v).distance(place(other, w)) > ELSEWHERE;
        Some(Common { full, on_levels: [v, w], is_elsewhere })
    })
}

/// Maps of coarse levels of the same two meshes.
pub(super) struct SeenMaps {
    /// The number of the source's vertices without own points: a vertex with a larger number is another one in every round.
    known: usize,
    maps: Vec<SeenMap>,
}

struct SeenMap {
    images: LevelImages,
    /// The mean log density around each vertex of the source level.
    around: TiVec<VertexId, f64>,
}

impl SeenMaps {
    /// No maps yet, of levels of a source with this many vertices.
    pub(super) fn new(known: usize) -> Self {
        Self { known, maps: Vec::new() }
    }

    /// Adds a map, where there is one.
    pub(super) fn extend(&mut self, images: Option<LevelImages>) {
        if let Some(images) = images {
            self.add(images);
        }
    }

    /// Adds a map.
    pub(super) fn add(&mut self, images: LevelImages) {
        let around = mean_log_around(&images);
        self.maps.push(SeenMap { images, around });
    }

    /// The number of maps.
    pub(super) fn count(&self) -> usize {
        self.maps.len()
    }

    /// The number of the last map, or of an earlier one, from the given number on, that distorts less where their images are elsewhere ([`WORSE`]);
    /// `None` where there is none.
    pub(super) fn last_good(&self, first: usize) -> Option<usize> {
        let last = self.maps.len().checked_sub(1).filter(|&last| last >= first)?;
        let better = |kept: usize, earlier: usize| if self.is_worse(kept, earlier) { earlier } else { kept };
        Some((first..last).rev().fold(last, better))
    }

    /// Whether a map distorts clearly more than another one where the images of both are elsewhere.
    fn is_worse(&self, one: usize, other: usize) -> bool {
        let [one, other] = [one, other].map(|k| &self.maps[k]);
        let mut sums = [0.0; 2];
        for Common { full, on_levels: [v, w], is_elsewhere } in common([&one.images, &other.images]) {
            let around = [one.around[v], other.around[w]];
            if is_elsewhere && full.index() < self.known && around.iter().all(|log| log.is_finite()) {
                sums = [sums[0] + around[0], sums[1] + around[1]];
            }
        }
        sums[0] > WORSE * sums[1]
    }

    /// The levels of the last map that was added; each vertex has its image under the map that distorts least around it. `None` where there
    /// is no map.
    pub(super) fn best_images(&self) -> Option<LevelImages> {
        let (last, others) = self.maps.split_last()?;
        let [source, target] = &last.images.levels;
        let best = |v: VertexId| {
            let own = last.images.target_from_source[v];
            let full = source.vertices[v];
            if full.index() >= self.known {
                return own;
            }
            let place = own.position(&target.mesh);
            let (mut least, mut image) = (last.around[v], own);
            for other in others {
                let [level, onto] = &other.images.levels;
                let Ok(w) = level.vertices.binary_search(&full) else { continue };
                if other.around[w] >= least {
                    continue;
                }
                let at = other.images.target_from_source[w];
                let there = at.position(&onto.mesh);
                if there.distance(place) > ELSEWHERE {
                    let [a, b, c] = onto.mesh.corners(at.face);
                    least = other.around[w];
                    image = closest_point(&target.mesh, there, (b - a).cross(c - a));
                }
            }
            image
        };
        let images: TiVec<VertexId, SurfacePoint> = source.mesh.vertices().map(best).collect();
        Some(last.images.with_images(images))
    }
}

/// A face with its centre, its area, and the logarithm of its distortion density.
struct Distorted {
    centre: DVec3,
    area: f64,
    log_density: f64,
}

/// The mean log density by area around each vertex of the source level; infinite where there is no skin.
pub(super) fn mean_log_around(images: &LevelImages) -> TiVec<VertexId, f64> {
    let [source, target] = &images.levels;
    let mesh = &source.mesh;
    let [weights, _] = images.weights();
    let places: TiVec<VertexId, DVec3> =
        images.target_from_source.iter().map(|at| at.position(&target.mesh)).collect();
    let distorted = |f: FaceId| Distorted {
        centre: mesh.corners(f).iter().sum::<DVec3>() / 3.0,
        area: mesh.face_area(f),
        log_density: log_density(mesh, f, &places),
    };
    let faces: Vec<Distorted> = mesh.faces().filter(|&f| weights.is_skin(f)).map(distorted).collect();
    let around = |place: &DVec3| {
        let near = faces.iter().filter(|face| face.centre.distance_squared(*place) < AROUND * AROUND);
        let add =
            |[area, sum]: [f64; 2], face: &Distorted| [area + face.area, sum + face.area * face.log_density];
        let [area, sum] = near.fold([0.0; 2], add);
        if area > 0.0 { sum / area } else { f64::INFINITY }
    };
    mesh.positions().iter().map(around).collect()
}

/// The logarithm of the distortion density of the linear map of a face to the triangle of its corners' places; 0 for an isometry.
fn log_density(mesh: &SurfaceMesh, f: FaceId, places: &TiSlice<VertexId, DVec3>) -> f64 {
    let from = flat(mesh.corners(f));
    let onto = flat(mesh.triangles()[f].map(|v| places[v]));
    let [along, across] = [onto.side / from.side, onto.height / from.height];
    let shear = (onto.foot - along * from.foot) / from.height;
    let area = max(along * across, LEAST_AREA);
    let squares = max(along * along + across * across + shear * shear, 2.0 * area);
    ln(max(squares * (1.0 + 1.0 / (area * area)) / 4.0, 1.0))
}

/// A triangle laid flat.
struct Flat {
    /// The length of its first side.
    side: f64,
    /// The place of the third corner's foot along that side.
    foot: f64,
    /// The height of the third corner above it.
    height: f64,
}

fn flat([a, b, c]: [DVec3; 3]) -> Flat {
    let (first, last) = (b - a, c - a);
    let side = first.length();
    Flat { side, foot: first.dot(last) / side, height: first.cross(last).length() / side }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::coarsening::Level;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;
    use glam::DQuat;

    /// A long body of area 1 onto itself, the half where `z` has the sign wrung: turned about the axis more and more, from the middle to half
    /// a turn at 0.2.
    fn wrung(level: &Level, sign: f64) -> LevelImages {
        let mesh = &level.mesh;
        let image = |p: &DVec3| {
            let share = (sign * p.z / 0.2).clamp(0.0, 1.0);
            let place = DQuat::from_rotation_z(share * std::f64::consts::PI) * *p;
            closest_point(mesh, place, place * DVec3::new(1.0, 1.0, 0.04))
        };
        LevelImages::of_skin([level.clone(), level.clone()], mesh.positions().iter().map(image).collect())
    }

    /// A coarse level of a long body of area 1, with the number of vertices of the body.
    fn long_body() -> (Level, usize) {
        let ball = icosphere(4);
        let long =
            ball.with_positions(ball.positions().iter().map(|p| *p * DVec3::new(0.2, 0.2, 1.0)).collect());
        let scale = long.area().sqrt().recip();
        let mesh = long.with_positions(long.positions().iter().map(|p| *p * scale).collect());
        let tips = [VertexId(0), VertexId(1)];
        (Level::coarse(&mesh, &tips, 600, &mut Silent).unwrap(), mesh.vertex_count())
    }

    /// The largest distance of a vertex from its image, near the middle, where the body is wrung.
    fn off(images: &LevelImages) -> f64 {
        let mesh = &images.levels[0].mesh;
        let wrung = mesh.vertices().filter(|v| (0.05..0.15).contains(&mesh.positions()[*v].z.abs()));
        let off = |v: VertexId| images.target_from_source[v].position(mesh).distance(mesh.positions()[v]);
        wrung.map(off).fold(0.0, f64::max)
    }

    #[test]
    fn images_are_elsewhere_on_the_half_that_is_wrung() {
        let (level, _) = long_body();
        let [up, down] = [1.0, -1.0].map(|sign| wrung(&level, sign));
        let itself = LevelImages::of_itself(&level);
        let share = |one: &LevelImages, other: &LevelImages| share_elsewhere([one, other]);
        assert_eq!(share(&up, &up), 0.0);
        assert_eq!(share(&itself, &up), share(&up, &itself));
        // About the axis and near the middle hardly anything moves.
        let [above, below] = [share(&itself, &up), share(&itself, &down)];
        assert!((0.3..0.5).contains(&above) && (above - below).abs() < 0.02, "{above} {below}");
        assert!((share(&up, &down) - above - below).abs() < 1e-12);
    }

    #[test]
    fn triangles_of_the_same_shape_have_the_density_of_their_scale() {
        let ball = icosphere(1);
        for scale in [0.5_f64, 1.0, 3.0] {
            let turn = DQuat::from_rotation_x(0.7);
            let places: TiVec<VertexId, DVec3> =
                ball.positions().iter().map(|p| turn * (*p * scale)).collect();
            let density = (scale * scale + 1.0 / (scale * scale)) / 2.0;
            assert!(ball.faces().all(|f| (log_density(&ball, f, &places) - ln(density)).abs() < 1e-12));
        }
        let flat: TiVec<VertexId, DVec3> = ball.positions().iter().map(|_| DVec3::X).collect();
        assert!(ball.faces().all(|f| log_density(&ball, f, &flat) > 10.0));
    }

    #[test]
    fn of_two_maps_that_wring_one_half_each_the_other_halves_are_taken() {
        let (level, known) = long_body();
        let mut seen = SeenMaps::new(known);
        assert!(seen.best_images().is_none());
        let [up, down] = [1.0, -1.0].map(|sign| wrung(&level, sign));
        assert!(off(&up) > 0.1 && off(&down) > 0.1);
        seen.add(up.clone());
        assert_eq!(seen.best_images().unwrap().target_from_source, up.target_from_source);
        seen.add(down);
        let best = off(&seen.best_images().unwrap());
        assert!(best <= ELSEWHERE, "{best}");
    }
    #[test]
    fn a_later_map_is_left_where_it_wrings_what_an_earlier_one_does_not() {
        let (level, known) = long_body();
        let mut seen = SeenMaps::new(known);
        assert_eq!(seen.last_good(0), None);
        let itself = LevelImages::of_itself(&level);
        seen.add(itself.clone());
        seen.add(wrung(&level, 1.0));
        assert_eq!(seen.last_good(0), Some(0));
        // Of maps before the first one that is asked for none is taken.
        assert_eq!(seen.last_good(1), Some(1));
        // Each of both wrings another half.
        seen.add(wrung(&level, -1.0));
        assert_eq!((seen.last_good(0), seen.last_good(1)), (Some(0), Some(2)));
        seen.add(itself);
        assert_eq!((seen.last_good(0), seen.last_good(4)), (Some(3), None));
    }
}
