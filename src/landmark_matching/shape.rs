//! A body in the matching: a coarse level of area 1 with its tips, and a descriptor of each tip.

use super::agreement::{Rank, ranks};
use super::inversions::inversions;
use super::options::MatchOptions;
use super::pair::PairOrigin;
use super::persistence::peaks;
use super::relief::relief;
use crate::geodesic::{ManyDistances, distances};
use crate::math::scalar::ln;
use crate::mesh::coarsening::Level;
use crate::mesh::mirror::mirrored;
use crate::mesh::{SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, Step};
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// Shares of the area whose enclosing radii are the descriptor of a tip: from the tip of a toe to the whole body. Chosen by hand.
const SHARES: [f64; 10] = [0.003, 0.006, 0.0125, 0.025, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0];

/// Marks nearer to each other than this are at the same place; the area is 1. Chosen by hand.
const SAME_PLACE: f64 = 0.12;

/// Tips whose log radii differ by less than this in the mean may be partners. Chosen by hand.
const ALIKE: f64 = 0.15;

/// Places at which the user is asked for pairs where nothing fits. Chosen by hand.
const PLACES: usize = 3;

/// A mesh with its given landmarks.
#[derive(Clone, Copy)]
pub(super) struct Body<'a> {
    pub(super) mesh: &'a SurfaceMesh,
    pub(super) given: &'a [VertexId],
    /// Whether each vertex may be a landmark; `None` where all may.
    pub(super) may_mark: Option<&'a TiSlice<VertexId, bool>>,
}

/// A body in the matching: its coarse level with its marks.
#[derive(Clone)]
pub(super) struct Shape {
    /// The level, of area 1; its vertices are numbered on the full mesh.
    pub(super) level: Level,
    /// The factor from lengths of the full mesh to those of the level.
    scale: f64,
    pub(super) areas: TiVec<VertexId, f64>,
    /// Mean distance of each vertex to the whole surface.
    pub(super) remoteness: TiVec<VertexId, f64>,
    /// The mean of that over the surface.
    pub(super) mean_remoteness: f64,
    /// Height of each vertex above the smoothed surface.
    pub(super) relief: TiVec<VertexId, f64>,
    /// The given landmarks in their order, then the tips, the most persistent first.
    pub(super) marks: Vec<Mark>,
    pub(super) given: usize,
    /// Whether each vertex of the level may be a landmark; `None` where all may.
    may_mark: Option<TiVec<VertexId, bool>>,
}

/// A given landmark or a tip.
#[derive(Clone)]
pub(super) struct Mark {
    pub(super) vertex: VertexId,
    /// The persistence of a tip, or of the tip that a given landmark stands for; 0 for other given landmarks.
    pub(super) persistence: f64,
    /// The distance of each vertex to the mark.
    pub(super) field: TiVec<VertexId, f64>,
    /// The descriptor: logarithms of the radii that enclose the shares of the area.
    radii: [f64; SHARES.len()],
    /// On the body and on each of its images under inversions: the rank of each mark in the cyclic order in which shortest paths leave this
    /// mark for all others.
    pub(super) ranks: Vec<Vec<Rank>>,
}

impl Mark {
    /// Mean difference of the descriptors of two marks.
    pub(super) fn difference(&self, other: &Self) -> f64 {
        let pairs = self.radii.iter().zip(&other.radii);
        pairs.map(|(a, b)| (a - b).abs()).sum::<f64>() / SHARES.len() as f64
    }
}

impl Shape {
    /// Computes the coarse level and the marks of a body.
    pub(super) fn new(
        body: Body<'_>,
        options: &MatchOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let Body { mesh, given, may_mark } = body;
        let (level, scale) =
            unit_level(mesh, given, options.level_vertices, &mut Portion::new(monitor, 0.0, 0.1))?;
        let areas = level.mesh.vertex_areas();
        let remoteness =
            remoteness(&level.mesh, &areas, options.samples, &mut Portion::new(monitor, 0.1, 0.9))?;
        let sum: f64 = areas.iter().zip(&remoteness).map(|(area, mean)| area * mean).sum();
        let mean_remoteness = sum / areas.iter().sum::<f64>();
        let relief = relief(&level.mesh);
        let held: Vec<VertexId> = level.numbers(given).collect();
        let tips = peaks(&level.mesh, &remoteness, options.least_persistence);
        let fields: Vec<_> = held.iter().map(|&v| distances(&level.mesh, &[v])).collect();
        let may_mark = may_mark.map(|may| level.vertices.iter().map(|&v| may[v]).collect());
        let given = held.len();
        let mut shape = Self {
            level,
            scale,
            areas,
            remoteness,
            mean_remoteness,
            relief,
            marks: Vec::new(),
            given,
            may_mark,
        };
        for (v, field) in held.into_iter().zip(fields) {
            shape.add(v, 0.0, field);
        }
        for peak in tips {
            if shape.marks.len() >= shape.given + options.most_tips {
                break;
            }
            let given = shape.marks[..shape.given].iter_mut();
            if let Some(mark) = given
                .filter(|mark| mark.field[peak.vertex] < SAME_PLACE)
                .min_by(|a, b| a.field[peak.vertex].total_cmp(&b.field[peak.vertex]))
            {
                // It stands for the tip. The more persistent peaks come first.
                if mark.persistence == 0.0 {
                    mark.persistence = peak.persistence;
                }
                continue;
            }
            let Some(vertex) = shape.allowed(peak.vertex) else { continue };
            let field = distances(&shape.level.mesh, &[vertex]);
            shape.add(vertex, peak.persistence, field);
        }
        shape.order();
        Ok(shape)
    }

    /// The body's mirror image, with the same marks; `None` where its level has none.
    pub(super) fn mirrored(&self) -> Option<Self> {
        let level = Level { mesh: mirrored(&self.level.mesh).ok()?, ..self.level.clone() };
        let mut image = Self { level, ..self.clone() };
        // Orders are reversed.
        image
            .marks
            .iter_mut()
            .flat_map(|mark| mark.ranks.iter_mut().flatten())
            .for_each(|rank| *rank = !*rank);
        Some(image)
    }

    /// Whether a vertex may be a landmark.
    pub(super) fn may(&self, v: VertexId) -> bool {
        self.may_mark.as_ref().is_none_or(|may| may[v])
    }

    /// The vertex nearest to a tip that may be a landmark and is none yet; `None` where there is none within [`SAME_PLACE`].
    fn allowed(&self, tip: VertexId) -> Option<VertexId> {
        let may = |v: VertexId| self.may(v) && self.marks.iter().all(|mark| mark.vertex != v);
        if may(tip) {
            return Some(tip);
        }
        let field = distances(&self.level.mesh, &[tip]);
        let near = self.level.mesh.vertices().filter(|&v| may(v) && field[v] < SAME_PLACE);
        near.min_by(|a, b| field[*a].total_cmp(&field[*b]))
    }

    fn add(&mut self, vertex: VertexId, persistence: f64, field: TiVec<VertexId, f64>) {
        let radii = radii(&self.areas, &field);
        self.marks.push(Mark { vertex, persistence, field, radii, ranks: Vec::new() });
    }

    fn order(&mut self) {
        let vertices: Vec<VertexId> = self.marks.iter().map(|mark| mark.vertex).collect();
        for mark in &mut self.marks {
            mark.ranks.push(ranks(&self.level.mesh, mark.vertex, &mark.field, &vertices));
        }
        for image in &inversions(&self.level.mesh) {
            let distances = ManyDistances::on(image);
            for mark in &mut self.marks {
                mark.ranks.push(ranks(image, mark.vertex, &distances.to(mark.vertex), &vertices));
            }
        }
    }

    /// Distance between two marks.
    pub(super) fn distance(&self, [a, b]: [usize; 2]) -> f64 {
        0.5 * (self.marks[a].field[self.marks[b].vertex] + self.marks[b].field[self.marks[a].vertex])
    }

    /// For each mark the one that stands for its place: of several toes of a foot, or fingers of a hand, the most persistent.
    pub(super) fn places(&self) -> Vec<usize> {
        let mut places: Vec<usize> = Vec::new();
        for mark in 0..self.marks.len() {
            let stands = |&other: &usize| places[other] == other && self.distance([mark, other]) < SAME_PLACE;
            let place = (0..mark).find(stands).unwrap_or(mark);
            places.push(place);
        }
        places
    }

    /// A vertex of the level as one of the full mesh.
    pub(super) fn on_mesh(&self, v: VertexId) -> VertexId {
        self.level.vertices[v]
    }

    /// The origin of pairs with a mark.
    pub(super) fn origin(&self, mark: usize) -> PairOrigin {
        if mark < self.given { PairOrigin::Given } else { PairOrigin::Tips }
    }

    /// A coarser level of this level, scaled to the unit of the full mesh.
    pub(super) fn in_units_of_mesh(&self, level: &SurfaceMesh) -> SurfaceMesh {
        level.with_positions(level.positions().iter().map(|&p| p / self.scale).collect())
    }

    /// For each mark the number of the tip with nearly the same descriptor, as left and right foot have; partners name each other.
    pub(super) fn partners(&self) -> Vec<Option<usize>> {
        let nearest = |a: usize| {
            let others = self.tips().filter(|&b| self.is_tip(a) && b != a);
            let differences = others.map(|b| (self.marks[a].difference(&self.marks[b]), b));
            let least = differences.min_by(|a, b| a.0.total_cmp(&b.0));
            least.filter(|least| least.0 < ALIKE).map(|least| least.1)
        };
        let nearest: Vec<Option<usize>> = (0..self.marks.len()).map(nearest).collect();
        (0..self.marks.len()).map(|a| nearest[a].filter(|&b| nearest[b] == Some(a))).collect()
    }

    /// Three vertices of the full mesh at which landmarks would help most: the most persistent tips, then points far from them; fewer where
    /// no more vertices may be landmarks.
    pub(super) fn far_places(&self) -> Vec<VertexId> {
        let mut places: Vec<VertexId> =
            self.marks[self.given..].iter().take(PLACES).map(|mark| mark.vertex).collect();
        let held = self.marks[..self.given].iter().map(|mark| mark.vertex);
        let mut seeds: Vec<VertexId> = places.iter().copied().chain(held).collect();
        while places.len() < PLACES {
            let field = distances(&self.level.mesh, &seeds);
            let may = |v: &VertexId| self.may(*v) && !seeds.contains(v);
            let far = self.level.mesh.vertices().filter(may).max_by(|a, b| field[*a].total_cmp(&field[*b]));
            let Some(far) = far else { break };
            places.push(far);
            seeds.push(far);
        }
        places.into_iter().map(|v| self.on_mesh(v)).collect()
    }

    /// The numbers of the tips, with those of the given landmarks that stand for one.
    pub(super) fn tips(&self) -> impl Iterator<Item = usize> + Clone {
        (0..self.marks.len()).filter(|&k| self.is_tip(k))
    }

    /// Whether a mark is a tip, or a given landmark that stands for one.
    pub(super) fn is_tip(&self, mark: usize) -> bool {
        self.marks[mark].persistence > 0.0
    }

    /// The numbers of the main tips, with those of the given landmarks that stand for one.
    pub(super) fn main(&self, options: &MatchOptions) -> Vec<usize> {
        self.tips().filter(|&k| self.marks[k].persistence >= options.main_persistence).collect()
    }
}

/// A level scaled to area 1, with its scale.
fn unit_level(
    mesh: &SurfaceMesh,
    held: &[VertexId],
    vertices: usize,
    monitor: &mut dyn Monitor,
) -> Result<(Level, f64), Cancelled> {
    let mut level = Level::coarse(mesh, held, vertices, monitor)?;
    let scale = 1.0 / level.mesh.area().sqrt();
    level.mesh = level.mesh.with_positions(level.mesh.positions().iter().map(|&p| p * scale).collect());
    Ok((level, scale))
}

/// Mean distance of every vertex to the surface: to farthest points, each weighted by the area that is nearest to it.
fn remoteness(
    mesh: &SurfaceMesh,
    areas: &TiVec<VertexId, f64>,
    samples: usize,
    monitor: &mut dyn Monitor,
) -> Result<TiVec<VertexId, f64>, Cancelled> {
    let mut nearest: TiVec<VertexId, (f64, usize)> = ti_vec![(f64::INFINITY, 0); mesh.vertex_count()];
    let distances = ManyDistances::on(mesh);
    let mut fields = Vec::with_capacity(samples);
    let mut sample = VertexId(0);
    for k in 0..samples.min(mesh.vertex_count()) {
        monitor.step(Step { fraction: k as f64 / samples as f64, residual: None })?;
        let field = distances.to(sample);
        for (near, &d) in nearest.iter_mut().zip(&field) {
            if d < near.0 {
                *near = (d, k);
            }
        }
        fields.push(field);
        let farthest = mesh.vertices().max_by(|a, b| nearest[*a].0.total_cmp(&nearest[*b].0));
        sample = farthest.unwrap_or(sample);
    }
    let mut weights = vec![0.0; fields.len()];
    mesh.vertices().for_each(|v| weights[nearest[v].1] += areas[v]);
    let total: f64 = weights.iter().sum();
    let mean = |v: VertexId| fields.iter().zip(&weights).map(|(field, w)| w * field[v]).sum::<f64>() / total;
    Ok(mesh.vertices().map(mean).collect())
}

/// Logarithms of the radii around a mark that enclose shares of the area.
fn radii(areas: &TiVec<VertexId, f64>, field: &TiVec<VertexId, f64>) -> [f64; SHARES.len()] {
    let mut order: Vec<VertexId> = field.keys().collect();
    order.sort_by(|a, b| field[*a].total_cmp(&field[*b]));
    let total: f64 = areas.iter().sum();
    let mut radii = [0.0; SHARES.len()];
    let (mut within, mut next, mut before) = (0.0, 0, [0.0; 2]);
    for v in order {
        within += areas[v] / total;
        while next < SHARES.len() && within >= SHARES[next].min(1.0 - 1e-9) {
            // Between two vertices the area grows in proportion: on a coarse level a toe has few vertices.
            let share = (SHARES[next] - before[0]) / (within - before[0]);
            let radius = before[1] + share.clamp(0.0, 1.0) * (field[v] - before[1]);
            radii[next] = ln(radius.max(1e-3));
            next += 1;
        }
        before = [within, field[v]];
    }
    radii
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;

    #[test]
    fn of_near_marks_the_first_stands_for_their_place() {
        let mesh = icosphere(3);
        let beside = mesh.head(mesh.outgoing(VertexId(0)));
        let away = mesh.positions()[VertexId(0)];
        let distance = |v: &VertexId| mesh.positions()[*v].distance(away);
        let far = mesh.vertices().max_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
        let body = Body { mesh: &mesh, given: &[VertexId(0), far, beside], may_mark: None };
        let shape = Shape::new(body, &MatchOptions::default(), &mut Silent).unwrap();
        assert_eq!(shape.places()[..3], [0, 1, 0]);
    }

    #[test]
    fn places_that_are_asked_for_may_be_marked() {
        let mesh = icosphere(3);
        let given = [VertexId(0)];
        let places = |may: &dyn Fn(VertexId) -> bool| {
            let may_mark: TiVec<VertexId, bool> = mesh.vertices().map(may).collect();
            let body = Body { mesh: &mesh, given: &given, may_mark: Some(&may_mark) };
            Shape::new(body, &MatchOptions::default(), &mut Silent).unwrap().far_places()
        };
        assert_eq!(places(&|_| true).len(), 3);
        let near = |v: VertexId| mesh.positions()[v].distance(mesh.positions()[given[0]]) < 1.0;
        assert!(places(&|_| true).iter().any(|&v| !near(v)));
        let found = places(&near);
        assert!(found.len() == 3 && found.iter().all(|&v| near(v)), "{found:?}");
        assert_eq!(places(&|v| v == given[0] || v == VertexId(7)), [VertexId(7)]);
    }
}
