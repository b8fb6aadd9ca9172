//! The rims of both meshes that correspond, as those of two bodies that were cut at the neck do.
//!
//! Where a mesh lacks data, the surface under its caps is unknown. Where both surfaces end at the same place, rim corresponds to rim and
//! cap to cap, and skin over a cap pays a toll ([`crate::mesh::face_weights`]). The user may say which case it is. Otherwise it is guessed:
//! two large rims correspond if the landmarks are as far from the one as from the other, and no rim fits either of them better.

use super::{Borders, MapInput, PipelineOptions};
use crate::coarse_map::MultilevelOptions;
use crate::geodesic::distances;
use crate::landmarks::MeshSide;
use crate::math::scalar::{exp, ln, min};
use crate::mesh::face_weights::FaceWeight;
use crate::mesh::rims::{Rim, rims};
use crate::mesh::{FaceId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use serde::Serialize;
use typed_index_collections::{TiSlice, TiVec};

/// Rims that are compared, of each mesh: the longest. Chosen by hand.
const MOST_RIMS: usize = 12;
/// Least length of a large rim, in units of the root of the mesh's area: smaller holes are gaps in the data. Chosen by hand.
const LARGE: f64 = 0.15;
/// Added to distances before ratios are taken, in units of the root of the area, so that near landmarks count little. As in
/// `landmark_fit`.
const SOFTENING: f64 = 0.08;
/// Largest misfit of rims that correspond: the mean absolute log ratio of the landmarks' distances. Two animals cut at the same place of
/// the neck have 0.06 to 0.11, two poses of one 0.02 to 0.04; cuts that are 4 % of the root of the area apart have 0.14 to 0.24.
const FITTING: f64 = 0.15;
/// Largest log ratio of the lengths of rims that correspond. Chosen by hand.
const ALIKE: f64 = 0.8;

/// The kind of the rims of holes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum BorderCase {
    /// Data is missing: the surface under caps is unknown.
    Missing,
    /// Both surfaces end there: rim corresponds to rim and cap to cap.
    Corresponding,
}

/// The kind of the rims of holes in a run, and the rims that correspond.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct BordersReport {
    /// The kind that was taken.
    pub case: BorderCase,
    /// The user's choice.
    pub asked: Borders,
    /// The rims that correspond, the best fit first. The surface under all other caps is taken for unknown.
    pub rims: Vec<RimPairReport>,
}

/// Two rims that correspond.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct RimPairReport {
    /// The rim of the source.
    pub source: RimReport,
    /// The rim of the target.
    pub target: RimReport,
    /// Mean absolute log ratio of the landmarks' distances to both rims, with larger weights for near landmarks; 0 where they are equal.
    pub misfit: f64,
}

/// A rim.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct RimReport {
    /// A vertex of it, 0-based.
    pub vertex: usize,
    /// Number of its vertices.
    pub vertices: usize,
    /// Its length, in units of the root of the mesh's area, caps included.
    pub length: f64,
}

impl BordersReport {
    /// The same with source and target exchanged.
    pub(super) fn exchanged(mut self) -> Self {
        self.rims.iter_mut().for_each(|pair| std::mem::swap(&mut pair.source, &mut pair.target));
        self
    }

    /// The same with other numbers of vertices; `number` gets the mesh and the number.
    #[must_use]
    pub fn renumbered(mut self, number: impl Fn(MeshSide, usize) -> usize) -> Self {
        for pair in &mut self.rims {
            for (side, rim) in MeshSide::BOTH.into_iter().zip([&mut pair.source, &mut pair.target]) {
                rim.vertex = number(side, rim.vertex);
            }
        }
        self
    }
}

/// The weights of the faces of both meshes, with the report of their borders.
pub(super) struct CountedCaps {
    /// The weights of each mesh's faces, the source first; `None` where all faces count like skin.
    pub(super) weights: [Option<TiVec<FaceId, FaceWeight>>; 2],
    /// `None` where not both meshes have caps that count less than skin, unless rims were said to correspond.
    pub(super) report: Option<BordersReport>,
}

/// The weights of the faces of both meshes. Exchanging source and target exchanges them.
///
/// # Errors
/// [`Cancelled`].
pub(super) fn counted_caps(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<CountedCaps, Cancelled> {
    let MultilevelOptions { cap_weight, border_toll, .. } = options.multilevel;
    let caps = [input.caps.source, input.caps.target]
        .map(|is_cap| is_cap.filter(|is_cap| cap_weight < 1.0 && is_cap.raw.contains(&true)));
    let mut weights = caps.map(|is_cap| is_cap.map(|is_cap| of_unknown(is_cap, cap_weight)));
    let asked = options.borders;
    let missing = BordersReport { case: BorderCase::Missing, asked, rims: Vec::new() };
    let ([Some(source), Some(target)], [Some(on_source), Some(on_target)]) = (caps, &mut weights) else {
        return Ok(CountedCaps { weights, report: (asked == Borders::Corresponding).then_some(missing) });
    };
    let mut told = Vec::new();
    if asked != Borders::Missing {
        let source = Borderline::new(input.source, source, &input.landmarks.source.raw, monitor)?;
        let target = Borderline::new(input.target, target, &input.landmarks.target.raw, monitor)?;
        for RimPair { numbers: [s, t], misfit } in corresponding([&source, &target], asked) {
            for (weights, rim) in [(&mut *on_source, &source.rims[s]), (&mut *on_target, &target.rims[t])] {
                rim.rim.cap.iter().for_each(|&f| weights[f].toll = border_toll);
            }
            told.push(RimPairReport { source: source.rims[s].told(), target: target.rims[t].told(), misfit });
        }
    }
    let report = match told.is_empty() {
        true => missing,
        false => BordersReport { case: BorderCase::Corresponding, asked, rims: told },
    };
    Ok(CountedCaps { weights, report: Some(report) })
}

/// The weights of the faces of a mesh where the surface under its caps is unknown.
fn of_unknown(is_cap: &TiSlice<FaceId, bool>, cap_weight: f64) -> TiVec<FaceId, FaceWeight> {
    let cap = FaceWeight { weight: cap_weight, toll: 0.0 };
    is_cap.iter().map(|&is_cap| if is_cap { cap } else { FaceWeight::SKIN }).collect()
}

/// The longest rims of a mesh.
struct Borderline {
    rims: Vec<MeasuredRim>,
}

/// A rim with the quantities by which it is compared.
struct MeasuredRim {
    rim: Rim,
    /// Its length, in units of the root of the mesh's area.
    length: f64,
    /// The softened logarithm of each landmark's distance to the rim.
    log_distances: Vec<f64>,
}

impl Borderline {
    fn new(
        mesh: &SurfaceMesh,
        is_cap: &TiSlice<FaceId, bool>,
        landmarks: &[VertexId],
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let unit = 1.0 / mesh.area().sqrt();
        let mut measured = Vec::new();
        for rim in rims(mesh, |f| is_cap[f]).into_iter().take(MOST_RIMS) {
            monitor.step(Step::default())?;
            let away = distances(mesh, &rim.vertices);
            let log_distances = landmarks.iter().map(|&v| ln(away[v] * unit + SOFTENING)).collect();
            measured.push(MeasuredRim { length: rim.length * unit, rim, log_distances });
        }
        Ok(Self { rims: measured })
    }
}

impl MeasuredRim {
    fn is_large(&self) -> bool {
        self.length >= LARGE
    }

    /// Mean absolute log ratio of the landmarks' distances, with larger weights for near landmarks.
    fn misfit(&self, other: &Self) -> f64 {
        let (mut sum, mut total) = (0.0, 0.0);
        for (&a, &b) in self.log_distances.iter().zip(&other.log_distances) {
            let weight = 1.0 / exp(min(a, b));
            sum += weight * (a - b).abs();
            total += weight;
        }
        sum / total
    }

    fn told(&self) -> RimReport {
        let Rim { vertices, .. } = &self.rim;
        RimReport { vertex: vertices[0].index(), vertices: vertices.len(), length: self.length }
    }
}

/// Two rims that correspond.
struct RimPair {
    /// Their numbers among the rims of the source and of the target.
    numbers: [usize; 2],
    misfit: f64,
}

/// The rims that correspond, the best fit first. Where the user says that borders correspond, large rims are paired whatever their misfit.
fn corresponding([source, target]: [&Borderline; 2], borders: Borders) -> Vec<RimPair> {
    let mut pairs = Vec::new();
    for (s, from) in source.rims.iter().enumerate() {
        for (t, onto) in target.rims.iter().enumerate() {
            let misfit = from.misfit(onto);
            let fits = misfit <= FITTING && (ln(from.length) - ln(onto.length)).abs() <= ALIKE;
            let are_large = from.is_large() && onto.is_large();
            let may_be = match borders {
                Borders::Missing => false,
                Borders::Guess => are_large && fits,
                Borders::Corresponding => are_large || fits,
            };
            if may_be && !misfit.is_nan() {
                pairs.push(RimPair { numbers: [s, t], misfit });
            }
        }
    }
    pairs.sort_by(|a, b| a.misfit.total_cmp(&b.misfit));
    let mut taken: Vec<RimPair> = Vec::new();
    for pair in pairs {
        if (0..2).all(|k| taken.iter().all(|other| other.numbers[k] != pair.numbers[k])) {
            taken.push(pair);
        }
    }
    taken
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmarks::Landmarks;
    use crate::mesh::generators::icosphere;
    use crate::monitor::Silent;
    use crate::pipeline::{CapFaces, GroundTruth};
    use glam::DVec3;

    /// A ball with caps around points, each within a cosine.
    fn caps(ball: &SurfaceMesh, around: &[(DVec3, f64)]) -> TiVec<FaceId, bool> {
        let middle = |f: FaceId| ball.corners(f).iter().sum::<DVec3>().normalize();
        ball.faces().map(|f| around.iter().any(|(p, cosine)| middle(f).dot(*p) > *cosine)).collect()
    }

    /// The borders of two balls with caps, and the tolls of their faces that are not 0, as shares of all faces.
    fn told(
        ball: &SurfaceMesh,
        is_cap: [&TiVec<FaceId, bool>; 2],
        borders: Borders,
    ) -> (BordersReport, [f64; 2]) {
        let around = |p: DVec3| {
            let nearest = |a: &VertexId, b: &VertexId| {
                ball.positions()[*a].dot(p).total_cmp(&ball.positions()[*b].dot(p))
            };
            ball.vertices().max_by(nearest).unwrap().0
        };
        let pairs: Vec<[u32; 2]> = (0..12)
            .map(|k| around(crate::math::golden::direction(k).extend(0.1 * (k % 5) as f64)))
            .map(|v| [v, v])
            .collect();
        let landmarks = Landmarks::from_vertices(ball, ball, &pairs).unwrap();
        let input = MapInput {
            source: ball,
            target: ball,
            landmarks: &landmarks,
            ground_truth: GroundTruth::Unknown,
            caps: CapFaces { source: Some(is_cap[0]), target: Some(is_cap[1]) },
        };
        let options = PipelineOptions { borders, ..PipelineOptions::default() };
        let CountedCaps { weights, report } = counted_caps(input, &options, &mut Silent).unwrap();
        let tolled = weights.map(|weights| {
            let weights = weights.unwrap();
            assert!(weights.iter().all(|w| w.toll == 0.0 || w.toll == options.multilevel.border_toll));
            weights.iter().filter(|w| w.toll > 0.0).count() as f64 / weights.len() as f64
        });
        (report.unwrap(), tolled)
    }

    #[test]
    fn large_rims_with_landmarks_that_agree_are_guessed_to_correspond() {
        let ball = icosphere(4);
        let (above, small) = ((DVec3::Z, 0.8), (DVec3::NEG_Z, 0.998));
        let both = caps(&ball, &[above, small]);
        let (report, tolled) = told(&ball, [&both, &both], Borders::Guess);
        assert_eq!((report.case, report.rims.len()), (BorderCase::Corresponding, 1));
        assert!(report.rims[0].misfit < 1e-12 && report.rims[0].source.length > LARGE);
        // The cap above: a tenth of the ball.
        assert!(tolled.iter().all(|share| (0.08..0.12).contains(share)), "{tolled:?}");
        // Small ones that fit count where the user says so.
        let (report, more) = told(&ball, [&both, &both], Borders::Corresponding);
        assert!(report.rims.len() == 2 && more[0] > tolled[0], "{report:?}");
        let (report, none) = told(&ball, [&both, &both], Borders::Missing);
        assert_eq!((report.case, none), (BorderCase::Missing, [0.0; 2]));
    }

    #[test]
    fn rims_at_different_places_correspond_only_where_the_user_says_so() {
        let ball = icosphere(4);
        let (above, beside) = (caps(&ball, &[(DVec3::Z, 0.8)]), caps(&ball, &[(DVec3::X, 0.8)]));
        let (report, tolled) = told(&ball, [&above, &beside], Borders::Guess);
        assert_eq!((report.case, tolled), (BorderCase::Missing, [0.0; 2]));
        let (report, _) = told(&ball, [&above, &beside], Borders::Corresponding);
        assert_eq!((report.case, report.rims.len()), (BorderCase::Corresponding, 1));
        assert!(report.rims[0].misfit > 2.0 * FITTING, "{report:?}");
    }
}
