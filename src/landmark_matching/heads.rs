//! Assignments changed so that twins go to twins, as ears to ears, and the end between them, as the nose, to the one between the others.

use super::roles::to_sides;
use super::search::{Assignment, Tables};
use crate::landmarks::MeshSide;

/// Largest mean log ratio of the distances to the limbs at which twins may go to twins: those of a head do not go to those of a tail.
/// Chosen by hand.
const FITS: f64 = 0.4;
/// Ways to take twins to twins that are judged, at most. Chosen by hand.
const MOST: usize = 2;

/// The assignment `from`, changed so that some twins go to twins on the same side, and the end on the middle line near them to that near
/// the others; the [`MOST`] changes that fit best. None where either body has no twins, or `from` takes no limbs to limbs.
pub(super) fn with_twins(tables: &Tables<'_>, from: &Assignment) -> Vec<Assignment> {
    let given = tables.shapes[0].given;
    let [source, target] = &tables.roles;
    let image = |s: usize| from.pairs.iter().find(|pair| pair[0] == s).map(|pair| pair[1]);
    let limbs: Vec<[[usize; 2]; 2]> =
        source.limbs.iter().filter_map(|&[l, r]| Some([[l, r], [image(l)?, image(r)?]])).collect();
    if limbs.is_empty() {
        return Vec::new();
    }
    let limbs_of = MeshSide::BOTH.map(|side| limbs.iter().map(|limb| limb[side]).collect::<Vec<_>>());
    let on_limbs: Vec<[usize; 2]> = limbs.iter().flat_map(|[[a, b], [x, y]]| [[*a, *x], [*b, *y]]).collect();
    let ordered = |side: MeshSide, [a, b]: [usize; 2]| {
        let to_sides = |mark: usize| to_sides(tables.shapes[side], &limbs_of[side], mark);
        if to_sides(a) < to_sides(b) { [b, a] } else { [a, b] }
    };
    let mut found: Vec<(f64, Vec<[usize; 2]>)> = Vec::new();
    for &twins in &source.twins {
        for &others in &target.twins {
            let ([a, b], [x, y]) = (ordered(MeshSide::Source, twins), ordered(MeshSide::Target, others));
            let misfit = [[a, x], [b, y]].map(|pair| tables.mean_misfit(pair, &on_limbs));
            let middle =
                source.between(tables.shapes[0], twins).zip(target.between(tables.shapes[1], others));
            let group = middle.map(|(m, n)| [m, n]).into_iter().chain([[a, x], [b, y]]);
            let mut group: Vec<[usize; 2]> = group.collect();
            let contradicts = |&[s, t]: &[usize; 2]| s != t && (s < given || t < given);
            if misfit[0].max(misfit[1]) < FITS && !group.iter().any(contradicts) {
                group.retain(|pair| pair[0] >= given);
                found.push((misfit[0] + misfit[1], group));
            }
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let with = |(_, group): (f64, Vec<[usize; 2]>)| {
        let is_new = |pair: &[usize; 2]| group.iter().any(|new| new[0] == pair[0] || new[1] == pair[1]);
        let kept = from.pairs.iter().enumerate().filter(|(k, pair)| *k < given || !is_new(pair));
        let pairs: Vec<[usize; 2]> = kept.map(|(_, pair)| *pair).chain(group.iter().copied()).collect();
        tables.changed(from, &pairs)
    };
    found.into_iter().take(MOST).map(with).collect()
}

#[cfg(test)]
mod tests {
    use super::super::likeness::uncrossed;
    use super::super::options::MatchOptions;
    use super::super::roles::{Roles, kept};
    use super::super::shape::Shape;
    use super::super::test_bodies::{ball_with_ends, shape};
    use super::*;
    use crate::mesh::SurfaceMesh;
    use crate::mesh::generators::icosphere;
    use crate::mesh::mirror::mirrored;
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
        let limbs = LIMBS.iter().map(|&end| (end, 2.0));
        let ends: Vec<(DVec3, f64)> = limbs.chain(HEAD.into_iter().zip([1.0, 0.6, 0.6])).collect();
        ball_with_ends(&ends, 40.0)
    }

    /// The end of the body that each mark is: the limbs come first in the numbers, and 8 stands for none. The mesh has the vertices of
    /// [`body`].
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
    fn twin_ends(tables: &Tables<'_>, side: MeshSide) -> Vec<usize> {
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
        for side in MeshSide::BOTH {
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
        let mark = |side: MeshSide, end: usize| ends[side].iter().position(|&e| e == end).unwrap();
        let pair = |end, onto| [mark(MeshSide::Source, end), mark(MeshSide::Target, onto)];
        // The nose begins on an ear.
        let mut pairs: Vec<[usize; 2]> = (0..5).map(|end| pair(end, limb(end))).collect();
        pairs.push(pair(5, 6));
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
    fn a_nose_at_an_ear_is_crossed() {
        let mesh = body();
        let shape = shape(&mesh);
        let tables = Tables::new([&shape; 2], &MatchOptions::default());
        let ends = ends(&shape);
        let mark = |end: usize| ends.iter().position(|&e| e == end).unwrap();
        let with = |head: &[[usize; 2]]| {
            let limbs = (0..5).map(|end| [end; 2]);
            let pairs = limbs.chain(head.iter().copied()).map(|pair| pair.map(mark));
            tables.assignment(&pairs.collect::<Vec<_>>())
        };
        for right in [with(&[[5, 5]]), with(&[[6, 6]]), with(&[[6, 7], [7, 6]])] {
            assert_eq!((right.crossed, uncrossed(&tables, &right)), (0, Vec::new()));
        }
        let crossed = with(&[[5, 6]]);
        assert_eq!(crossed.crossed, 1);
        let changes = uncrossed(&tables, &crossed);
        assert_eq!(changes.len(), 2);
        assert!(
            changes[0].pairs.contains(&[mark(5); 2]) && changes[0].pairs.len() == 7,
            "{:?}",
            changes[0].pairs
        );
        assert!(changes[0].pairs.contains(&[mark(6); 2]) || changes[0].pairs.contains(&[mark(7), mark(6)]));
        assert_eq!(changes[1].pairs.len(), 5);
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
