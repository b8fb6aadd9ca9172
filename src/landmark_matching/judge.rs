//! The judgement of an assignment by the coarse map with its pairs as landmarks.

use super::options::MatchOptions;
use super::shape::Shape;
use crate::coarse_map::multilevel::{CoarseMap, LevelImages};
use crate::coarse_map::{LandmarkedMesh, brief_map};
use crate::landmarks::MeshSide;
use crate::math::barycentric::interpolated;
use crate::mesh::{SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Portion, unless_stopped};
use crate::registration::mean_fit::mean_fit;
use crate::registration::patch_fit::OrientedSurface;
use crate::registration::rigid_patches::{MappedLevel, WeightedLevel};
use typed_index_collections::TiSlice;

/// Measures of a coarse map.
#[derive(Clone, Copy)]
pub(super) struct Measures {
    /// Mean log density of the map; 0 for an isometry.
    pub(super) mean_log: f64,
    /// Mean difference of a point's and its image's mean distance to their surfaces, in units of the root of the area, with both bodies
    /// scaled so that these distances have the same mean: a stout body has short limbs for its area.
    pub(super) remoteness: f64,
    /// Mean difference of a point's and its image's height above their smoothed surfaces, in units of the root of the area.
    pub(super) relief: f64,
}

/// A coarse map with its measures.
pub(super) struct Judged {
    /// Those that tell whether it promises, too.
    pub(super) measures: Measures,
    /// How well patches of the source fit the target near their images when each is moved rigidly, 0 to 1.
    pub(super) patch_fit: f64,
    /// The map.
    pub(super) images: LevelImages,
}

/// Makes and measures the coarse map with the pairs as landmarks; `None` where there is none. A map that is not promising after its first
/// relaxation, a short one, is not relaxed any further.
pub(super) fn judge(
    shapes: [&Shape; 2],
    pairs: &[[VertexId; 2]],
    options: &MatchOptions,
    promises: impl Fn(&Measures) -> bool,
    monitor: &mut dyn Monitor,
) -> Result<Option<Judged>, Cancelled> {
    let vertices = MeshSide::BOTH.map(|side| pairs.iter().map(|pair| pair[side]).collect::<Vec<VertexId>>());
    let meshes = shapes.map(|shape| &shape.level.mesh);
    let [source, target] = &vertices;
    brief_map(meshes, [source, target], &options.brief, monitor, |full, mut map, monitor| {
        let mut judged = measured(shapes, full, &map);
        if judged.as_ref().is_some_and(|(first, _)| promises(first)) {
            let relaxed = unless_stopped(map.relax(&options.brief.relaxation, monitor))?;
            judged = relaxed.and_then(|_| measured(shapes, full, &map));
        }
        let Some((measures, images)) = judged else { return Ok(None) };
        let patch_fit = patch_fit(full, &images, options, &mut Portion::new(monitor, 1.0, 1.0))?;
        Ok(Some(Judged { measures, patch_fit, images }))
    })
}

/// The measures of a coarse map, and its images; `None` where a vertex has none.
fn measured(
    shapes: [&Shape; 2],
    full: &[LandmarkedMesh; 2],
    map: &CoarseMap<'_>,
) -> Option<(Measures, LevelImages)> {
    let images = map.images()?;
    let means = shapes.map(|shape| shape.mean_remoteness);
    let common = (means[0] * means[1]).sqrt();
    let remoteness = Field { of: |shape| &shape.remoteness, scales: means.map(|mean| common / mean) };
    let relief = Field { of: |shape| &shape.relief, scales: [1.0; 2] };
    let [remoteness, relief] =
        [remoteness, relief].map(|field| mean_difference(shapes, field, full, &images));
    Some((Measures { mean_log: map.mean_log, remoteness, relief }, images))
}

/// How well patches of the source fit the target near their images.
fn patch_fit(
    full: &[LandmarkedMesh; 2],
    images: &LevelImages,
    options: &MatchOptions,
    monitor: &mut dyn Monitor,
) -> Result<f64, Cancelled> {
    let [own, onto] = full.each_ref().map(|full| OrientedSurface::new(&full.refined.mesh));
    let weights = images.weights();
    let [source, target] = [0, 1].map(|k| WeightedLevel { level: &images.levels[k], weights: weights[k] });
    let seen = MappedLevel::new(source, target, images.target_from_source.iter().copied());
    mean_fit([&own, &onto], &seen, &options.patches, monitor)
}

/// Values at the vertices of each body's level, to be scaled by these factors.
#[derive(Clone, Copy)]
struct Field {
    of: fn(&Shape) -> &TiSlice<VertexId, f64>,
    scales: [f64; 2],
}

/// Mean difference of a field's value at a point of the source and at its image on the target.
fn mean_difference(
    shapes: [&Shape; 2],
    field: Field,
    full: &[LandmarkedMesh; 2],
    images: &LevelImages,
) -> f64 {
    let at = |side: MeshSide, v: VertexId| {
        let SurfacePoint { face, barycentric } =
            full[side].refined.vertex_origin[images.levels[side].vertices[v]];
        let corners = shapes[side].level.mesh.triangles()[face];
        let values = (field.of)(shapes[side]);
        field.scales[side] * interpolated(corners.map(|corner| values[corner]), barycentric)
    };
    let [source, target] = &images.levels;
    let areas = source.mesh.vertex_areas();
    let difference = |v: VertexId| {
        let SurfacePoint { face, barycentric } = images.target_from_source[v];
        let corners = target.mesh.triangles()[face];
        let image = interpolated(corners.map(|corner| at(MeshSide::Target, corner)), barycentric);
        (at(MeshSide::Source, v) - image).abs()
    };
    let sum: f64 = source.mesh.vertices().map(|v| areas[v] * difference(v)).sum();
    sum / areas.iter().sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::super::test_bodies::{four_footed, shape};
    use super::*;
    use crate::monitor::Silent;

    #[test]
    fn remoteness_is_compared_in_proportion() {
        let (shape, options) = (shape(&four_footed()), MatchOptions::default());
        let ends: Vec<VertexId> = shape.main(&options).iter().map(|&k| shape.marks[k].vertex).collect();
        let pairs: Vec<[VertexId; 2]> = ends.iter().map(|&v| [v; 2]).collect();
        let mut thin = shape.clone();
        thin.remoteness.iter_mut().for_each(|mean| *mean *= 1.3);
        let judged = |onto: &Shape| judge([&shape, onto], &pairs, &options, |_| true, &mut Silent);
        let mean = shape.mean_remoteness;
        let as_it_is = judged(&thin).unwrap().unwrap().measures.remoteness;
        thin.mean_remoteness *= 1.3;
        let in_proportion = judged(&thin).unwrap().unwrap().measures.remoteness;
        assert!(in_proportion < 0.1 * as_it_is && as_it_is > 0.1 * mean, "{in_proportion} {as_it_is}");
    }

    #[test]
    fn patches_fit_where_limbs_go_to_their_own() {
        let (shape, options) = (shape(&four_footed()), MatchOptions::default());
        let ends: Vec<VertexId> = shape.main(&options).iter().map(|&k| shape.marks[k].vertex).collect();
        let fit = |shift: usize| {
            let pairs: Vec<[VertexId; 2]> =
                (0..ends.len()).map(|k| [ends[k], ends[(k + shift) % ends.len()]]).collect();
            judge([&shape; 2], &pairs, &options, |_| true, &mut Silent).unwrap().unwrap().patch_fit
        };
        let (right, others) = (fit(0), [1, 2, 3].map(fit));
        assert!(right > 0.5 && others.iter().all(|other| *other < 0.6 * right), "{right} {others:?}");
    }

    #[test]
    fn only_what_promises_is_relaxed_to_the_end() {
        let (shape, options) = (shape(&four_footed()), MatchOptions::default());
        // Each end goes to the next: a map far from an isometry.
        let ends: Vec<VertexId> = shape.main(&options).iter().map(|&k| shape.marks[k].vertex).collect();
        let pairs: Vec<[VertexId; 2]> =
            (0..ends.len()).map(|k| [ends[k], ends[(k + 1) % ends.len()]]).collect();
        let judged = |promises: bool| {
            judge([&shape; 2], &pairs, &options, |_| promises, &mut Silent).unwrap().unwrap().measures
        };
        let [short, long] = [false, true].map(judged);
        assert!(long.mean_log < 0.98 * short.mean_log, "{} {}", long.mean_log, short.mean_log);
        // What promises is known before.
        let judged =
            judge([&shape; 2], &pairs, &options, |first| first.mean_log < short.mean_log, &mut Silent);
        assert_eq!(judged.unwrap().unwrap().measures.mean_log, short.mean_log);
    }
}
