//! What the ends of a body are to its left and right: twins, as two ears are, or on the middle line, as a nose is.
//!
//! Which of ear, nose and crown sticks out most differs from body to body, so that ends of one head taken by their size are exchanged
//! easily, and a long neck of one draws the other's face along. That ears are two and a nose is one is the same on all of them.

use super::reflection::Reflection;
use super::search::{Assignment, Tables};
use super::shape::Shape;
use crate::math::scalar::ln;

/// Twins have such a mean log ratio of distances to mirrored marks at most: feet of sixteen animals have up to 0.06.
const MIRRORED: f64 = 0.06;
/// Twins are nearer to each other than this, in units of the root of the area, and to the end on the middle line that belongs to them.
const NEAR: f64 = 0.5;
/// Twins go to twins where the mean log ratio of their distances to the limbs is below this: those of a head not to those of a tail.
const FITS: f64 = 0.4;
/// Log ratios of persistence count so little beside those of distances: where there are two horns and two ears.
const PERSISTENCE: f64 = 0.01;
/// Ways to take twins to twins that are judged, at most.
const MOST: usize = 2;

/// The ends of a body beside the limbs that have a left and a right.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Roles {
    /// Left and right limbs.
    limbs: Vec<[usize; 2]>,
    /// Ends that mirror each other, in no order.
    pub(super) twins: Vec<[usize; 2]>,
    /// Ends on the middle line, the most persistent first.
    pub(super) middle: Vec<usize>,
}

impl Roles {
    /// The roles of all tips; none where there are no left and right limbs. `main`: the numbers of the main tips.
    pub(super) fn new(shape: &Shape, reflection: Option<&Reflection>, main: &[usize]) -> Self {
        let Some(reflection) = reflection else { return Self::default() };
        let is_limb = |pair: &&[usize; 2]| pair.iter().all(|k| main.contains(k));
        let limbs: Vec<[usize; 2]> = reflection.pairs.iter().filter(is_limb).copied().collect();
        if limbs.is_empty() {
            return Self::default();
        }
        let tips = shape.given..shape.marks.len();
        let others: Vec<usize> = tips.filter(|k| !limbs.iter().flatten().any(|limb| limb == k)).collect();
        let mut pairs: Vec<(f64, [usize; 2])> = Vec::new();
        for (k, &b) in others.iter().enumerate() {
            for &a in &others[..k] {
                let sides = [a, b].map(|k| to_sides(shape, &limbs, k));
                let cost = off_mirror(shape, &limbs, [a, b]);
                // Each mirrors the other better than itself: a nose and one of two ears do not.
                let own = [a, b].map(|k| off_mirror(shape, &limbs, [k; 2]));
                let mirrors = cost < MIRRORED && cost < own[0].min(own[1]);
                if sides[0] * sides[1] < 0.0 && mirrors && shape.distance([a, b]) < NEAR {
                    let ratio = ln(shape.marks[a].persistence / shape.marks[b].persistence).abs();
                    pairs.push((cost + PERSISTENCE * ratio, [a, b]));
                }
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut roles = Self { limbs, ..Self::default() };
        for (_, pair) in pairs {
            if !pair.iter().any(|&k| roles.is_twin(k)) {
                roles.twins.push(pair);
            }
        }
        let on_middle = |k: &usize| !roles.is_twin(*k) && off_mirror(shape, &roles.limbs, [*k; 2]) < MIRRORED;
        roles.middle = others.into_iter().filter(on_middle).collect();
        roles
    }

    pub(super) fn is_twin(&self, mark: usize) -> bool {
        self.twins.iter().flatten().any(|&k| k == mark)
    }

    /// The most persistent end on the middle line near twins.
    fn between(&self, shape: &Shape, twins: [usize; 2]) -> Option<usize> {
        let is_near = |k: &&usize| twins.iter().all(|&twin| shape.distance([**k, twin]) < NEAR);
        self.middle.iter().find(is_near).copied()
    }
}

/// Mean log ratio of the distances of two marks to mirrored limbs; 0 for twins of a symmetric body.
fn off_mirror(shape: &Shape, limbs: &[[usize; 2]], [a, b]: [usize; 2]) -> f64 {
    let ratio = |x: usize, y: usize| (ln(shape.distance([a, x])) - ln(shape.distance([b, y]))).abs();
    let sum: f64 = limbs.iter().map(|&[l, r]| 0.5 * (ratio(l, r) + ratio(r, l))).sum();
    sum / limbs.len() as f64
}

/// Mean log ratio of a mark's distances to the second of both limbs and to the first: above 0 on the side of the first.
fn to_sides(shape: &Shape, limbs: &[[usize; 2]], mark: usize) -> f64 {
    let ratio = |&[l, r]: &[usize; 2]| ln(shape.distance([mark, r])) - ln(shape.distance([mark, l]));
    limbs.iter().map(ratio).sum::<f64>() / limbs.len() as f64
}

/// How many twins of the source go to twins of the target, and how many ends on the middle line of one body to one of twins of the
/// other.
pub(super) fn kept([source, target]: [&Roles; 2], pairs: &[[usize; 2]]) -> [usize; 2] {
    let image = |s: usize| pairs.iter().find(|pair| pair[0] == s).map(|pair| pair[1]);
    let goes = |&&[a, b]: &&[usize; 2]| {
        let images = [image(a), image(b)];
        target.twins.iter().any(|&[x, y]| images == [Some(x), Some(y)] || images == [Some(y), Some(x)])
    };
    let mixes = |&&[s, t]: &&[usize; 2]| {
        (source.middle.contains(&s) && target.is_twin(t)) || (source.is_twin(s) && target.middle.contains(&t))
    };
    [source.twins.iter().filter(goes).count(), pairs.iter().filter(mixes).count()]
}

/// An assignment with twins taken to twins on the same side, and the end on the middle line that belongs to them to that of the others;
/// the ways that fit best. None where either body has no twins, or limbs go to no limbs.
pub(super) fn with_twins(tables: &Tables<'_>, from: &Assignment) -> Vec<Assignment> {
    let [source, target] = &tables.roles;
    let image = |s: usize| from.pairs.iter().find(|pair| pair[0] == s).map(|pair| pair[1]);
    let limbs: Vec<[[usize; 2]; 2]> =
        source.limbs.iter().filter_map(|&[l, r]| Some([[l, r], [image(l)?, image(r)?]])).collect();
    if limbs.is_empty() {
        return Vec::new();
    }
    let of_side = [0, 1].map(|side: usize| limbs.iter().map(|limb| limb[side]).collect::<Vec<_>>());
    let on_limbs: Vec<[usize; 2]> = limbs.iter().flat_map(|[[a, b], [x, y]]| [[*a, *x], [*b, *y]]).collect();
    let ordered = |side: usize, [a, b]: [usize; 2]| {
        let side_of = |mark: usize| to_sides(tables.shapes[side], &of_side[side], mark);
        if side_of(a) < side_of(b) { [b, a] } else { [a, b] }
    };
    let mut found: Vec<(f64, Vec<[usize; 2]>)> = Vec::new();
    for &twins in &source.twins {
        for &others in &target.twins {
            let ([a, b], [x, y]) = (ordered(0, twins), ordered(1, others));
            let misfit = [[a, x], [b, y]].map(|pair| tables.mean_misfit(pair, &on_limbs));
            let middle =
                source.between(tables.shapes[0], twins).zip(target.between(tables.shapes[1], others));
            if misfit[0].max(misfit[1]) < FITS {
                let group = middle.map(|(m, n)| [m, n]).into_iter().chain([[a, x], [b, y]]).collect();
                found.push((misfit[0] + misfit[1], group));
            }
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let with = |(_, group): (f64, Vec<[usize; 2]>)| {
        let given = tables.shapes[0].given;
        let is_new = |pair: &[usize; 2]| group.iter().any(|new| new[0] == pair[0] || new[1] == pair[1]);
        let kept = from.pairs.iter().enumerate().filter(|(k, pair)| *k < given || !is_new(pair));
        let pairs: Vec<[usize; 2]> = kept.map(|(_, pair)| *pair).chain(group.iter().copied()).collect();
        Assignment { between: from.between, ..tables.assignment(&pairs) }
    };
    found.into_iter().take(MOST).map(with).collect()
}

#[cfg(test)]
mod tests {
    use super::super::options::MatchOptions;
    use super::super::shape::Body;
    use super::*;
    use crate::math::scalar::exp;
    use crate::mesh::SurfaceMesh;
    use crate::mesh::generators::icosphere;
    use crate::mesh::mirror::mirrored;
    use crate::monitor::Silent;
    use glam::{DQuat, DVec3};

    /// Four feet, the hind ones nearer to each other, and a tail.
    const LIMBS: [DVec3; 5] = [
        DVec3::new(0.5, 0.6, -0.7),
        DVec3::new(0.5, -0.6, -0.7),
        DVec3::new(-0.6, 0.4, -0.8),
        DVec3::new(-0.6, -0.4, -0.8),
        DVec3::new(-1.0, 0.0, 0.3),
    ];
    /// A nose and two ears.
    const HEAD: [DVec3; 3] =
        [DVec3::new(1.0, 0.0, 0.2), DVec3::new(0.5, 0.6, 0.75), DVec3::new(0.5, -0.6, 0.75)];

    /// A ball with limbs and a head, symmetric about the plane y = 0.
    fn body() -> SurfaceMesh {
        let ball = icosphere(4);
        let bump = |p: DVec3, end: DVec3| exp(-40.0 * p.distance_squared(end.normalize()));
        let height = |p: DVec3| {
            let limbs = LIMBS.iter().map(|&end| 2.0 * bump(p, end)).sum::<f64>();
            1.0 + limbs + HEAD.iter().zip([1.0, 0.6, 0.6]).map(|(&end, h)| h * bump(p, end)).sum::<f64>()
        };
        ball.with_positions(ball.positions().iter().map(|&p| height(p) * p).collect())
    }

    fn shape(mesh: &SurfaceMesh) -> Shape {
        let body = Body { mesh, given: &[], may_mark: None };
        Shape::new(body, &MatchOptions::default(), &mut Silent).unwrap()
    }

    /// By mark which end of the body it is, of the limbs first; 8 for none. The mesh has the vertices of [`body`].
    fn ends(shape: &Shape) -> Vec<usize> {
        let ends: Vec<DVec3> = LIMBS.iter().chain(&HEAD).map(|end| end.normalize()).collect();
        let ball = icosphere(4);
        let end = |mark: usize| {
            let p = ball.positions()[shape.on_mesh(shape.marks[mark].vertex)];
            ends.iter().position(|end| end.distance(p) < 0.25).unwrap_or(8)
        };
        (0..shape.marks.len()).map(end).collect()
    }

    /// The ends that are twins, in order.
    fn twin_ends(tables: &Tables<'_>, side: usize) -> Vec<usize> {
        let ends = ends(tables.shapes[side]);
        let mut twins: Vec<usize> = tables.roles[side].twins.iter().flatten().map(|&k| ends[k]).collect();
        twins.sort_unstable();
        twins
    }

    #[test]
    fn ears_are_twins_however_the_body_is_turned_and_scaled() {
        let mesh = body();
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -1.0).normalize(), 1.1);
        let moved = mesh.with_positions(mesh.positions().iter().map(|&p| 7.0 * (turn * p)).collect());
        let shapes = [shape(&mesh), shape(&moved)];
        let tables = Tables::new([&shapes[0], &shapes[1]], &MatchOptions::default());
        for side in 0..2 {
            assert_eq!(twin_ends(&tables, side), [6, 7], "{:?}", tables.roles[side]);
            let ends = ends(&shapes[side]);
            let nose = ends.iter().position(|&end| end == 5).unwrap();
            assert!(tables.roles[side].middle.contains(&nose), "{:?}", tables.roles[side]);
        }
    }

    /// Takes limbs to the same limbs and checks where the head goes.
    fn check_head(onto: &SurfaceMesh, limb: impl Fn(usize) -> usize) {
        let mesh = body();
        let shapes = [shape(&mesh), shape(onto)];
        let tables = Tables::new([&shapes[0], &shapes[1]], &MatchOptions::default());
        let ends = [ends(&shapes[0]), ends(&shapes[1])];
        let mark = |side: usize, end: usize| ends[side].iter().position(|&e| e == end).unwrap();
        // The nose begins on an ear.
        let mut pairs: Vec<[usize; 2]> = (0..5).map(|end| [mark(0, end), mark(1, limb(end))]).collect();
        pairs.push([mark(0, 5), mark(1, 6)]);
        let from = tables.assignment(&pairs);
        assert_eq!([from.twins, from.mixed], [0, 1]);
        let found = with_twins(&tables, &from);
        let of_ends = |pairs: &[[usize; 2]]| {
            let mut of: Vec<[usize; 2]> = pairs.iter().map(|&[s, t]| [ends[0][s], ends[1][t]]).collect();
            of.sort_unstable();
            of
        };
        let wanted: Vec<[usize; 2]> = (0..8).map(|end| [end, limb(end)]).collect();
        assert_eq!(of_ends(&found[0].pairs), wanted);
        assert_eq!([found[0].twins, found[0].mixed], [1, 0]);
    }

    #[test]
    fn a_head_goes_onto_itself() {
        check_head(&body(), |end| end);
    }

    #[test]
    fn on_exchanged_limbs_ears_are_exchanged() {
        check_head(&body(), |end| [1, 0, 3, 2, 4, 5, 7, 6][end]);
    }

    #[test]
    fn on_the_mirror_image_each_ear_stays_on_its_side() {
        // Vertices keep their numbers, so that an end of the mirror image is that of the body.
        check_head(&mirrored(&body()).unwrap(), |end| end);
    }

    #[test]
    fn what_is_kept_does_not_depend_on_the_direction() {
        let one = Roles { limbs: vec![[0, 1]], twins: vec![[2, 3]], middle: vec![4, 5] };
        let other = Roles { limbs: vec![[0, 1]], twins: vec![[4, 5]], middle: vec![2] };
        for pairs in [vec![[2, 5], [3, 4], [4, 2]], vec![[2, 2], [4, 4], [5, 5]], vec![[2, 4], [3, 6]]] {
            let back: Vec<[usize; 2]> = pairs.iter().map(|&[s, t]| [t, s]).collect();
            assert_eq!(kept([&one, &other], &pairs), kept([&other, &one], &back), "{pairs:?}");
        }
        assert_eq!(kept([&one, &other], &[[2, 5], [3, 4], [4, 2]]), [1, 0]);
        assert_eq!(kept([&one, &other], &[[2, 2], [4, 4], [5, 5]]), [0, 3]);
    }
}
