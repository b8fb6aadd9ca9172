//! Other maps of the same meshes and landmarks, with which a map is compared.

use super::{Cones, Method, PipelineOptions, Relaxation};
use serde::{Deserialize, Serialize};

/// Another map of the same meshes and landmarks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum OtherMap {
    /// The map that relaxation begins with, in the same class: certified, each mesh relaxed by itself.
    Start,
    /// The thesis' patchwise map over flat metrics whose cones are all alike.
    EqualCones,
    /// The thesis' patchwise map over flat metrics with the cones of the base domain.
    Patchwise,
    /// Patch by patch over straight triangles, each by Tutte's embedding.
    Tutte,
}

impl PipelineOptions {
    /// The options of another map, to be compared with one that is made with these.
    #[must_use]
    pub fn of_other(self, other: OtherMap) -> Self {
        let patchwise = |cones| Self { method: Method::Thesis, cones, ..self.clone() };
        match other {
            OtherMap::Start => Self { method: Method::Relaxed, relaxation: Relaxation::None, ..self },
            OtherMap::EqualCones => patchwise(Cones::Uniform),
            OtherMap::Patchwise => patchwise(Cones::BaseDomain),
            OtherMap::Tutte => Self { method: Method::Tutte, ..self },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo;
    use crate::landmarks::Landmarks;
    use crate::mesh::VertexId;
    use crate::monitor::Silent;
    use crate::pipeline::{MapInput, MapResult, run};

    fn map_of(name: &str, other: Option<OtherMap>) -> MapResult {
        let demo = demo::build(name).unwrap();
        let landmarks = Landmarks::from_vertices(&demo.source, &demo.target, &demo.landmarks).unwrap();
        let options = PipelineOptions::default();
        let options = other.map_or(options.clone(), |other| options.of_other(other));
        run(MapInput::new(&demo.source, &demo.target, &landmarks), &options, &mut Silent).unwrap()
    }

    #[test]
    fn relaxation_begins_with_a_certified_map_of_the_same_class_and_lowers_its_energy() {
        let [relaxed, start] = [None, Some(OtherMap::Start)].map(|other| map_of("horse-cat", other).report);
        assert!(start.certificate.as_ref().unwrap().bijective);
        assert!(start.unmapped_share == 0.0 && start.own_landmarks == 0);
        let mean_log = |report: &crate::pipeline::Report| report.layout.as_ref().unwrap().mean_log;
        assert_eq!(mean_log(&relaxed), mean_log(&start));
        let [before, after] = [&start, &relaxed].map(|report| report.distortion.energy);
        assert!(before > 1.05 * after && after > 4.0, "{before} {after}");
    }

    #[test]
    fn straight_patches_make_a_certified_map_of_larger_energy_over_the_layout_of_the_patchwise_map() {
        let [relaxed, tutte, patchwise] =
            [None, Some(OtherMap::Tutte), Some(OtherMap::Patchwise)].map(|other| map_of("horse-cat", other));
        assert!(tutte.report.certificate.as_ref().unwrap().bijective);
        assert!(tutte.report.unmapped_share == 0.0 && !tutte.triangle_distortion.is_empty());
        assert_eq!(tutte.base.mesh.triangles(), patchwise.base.mesh.triangles());
        let demo = demo::build("horse-cat").unwrap();
        for [from, onto] in demo.landmarks {
            let image = tutte.target_from_source[VertexId(from)].unwrap().position(&demo.target);
            assert!(image.distance(demo.target.positions()[VertexId(onto)]) < 1e-12);
        }
        let [worse, better] = [&tutte, &relaxed].map(|map| &map.report.distortion);
        assert!(
            worse.energy > 1.3 * better.energy && worse.mean_log > better.mean_log,
            "{worse:?} {better:?}"
        );
    }

    #[test]
    fn patchwise_maps_have_the_cones_that_they_are_named_by() {
        let curvatures = |other| map_of("sphere-tetrahedron", Some(other)).cone_curvatures;
        let (equal, own) = (curvatures(OtherMap::EqualCones), curvatures(OtherMap::Patchwise));
        let share = 4.0 * std::f64::consts::PI / equal.len() as f64;
        assert!(equal.iter().all(|cone| (cone - share).abs() < 1e-12));
        assert!(own.iter().any(|cone| (cone - share).abs() > 1e-3));
    }
}
