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
}

impl PipelineOptions {
    /// The options of another map in the place of one that is made with these.
    #[must_use]
    pub fn of_other(self, other: OtherMap) -> Self {
        let patchwise = |cones| Self { method: Method::Thesis, cones, ..self.clone() };
        match other {
            OtherMap::Start => Self { method: Method::Relaxed, relaxation: Relaxation::None, ..self },
            OtherMap::EqualCones => patchwise(Cones::Uniform),
            OtherMap::Patchwise => patchwise(Cones::BaseDomain),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo;
    use crate::landmarks::Landmarks;
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
    fn patchwise_maps_have_the_cones_that_they_are_named_by() {
        let curvatures = |other| map_of("sphere-tetrahedron", Some(other)).cone_curvatures;
        let (equal, own) = (curvatures(OtherMap::EqualCones), curvatures(OtherMap::Patchwise));
        let share = 4.0 * std::f64::consts::PI / equal.len() as f64;
        assert!(equal.iter().all(|cone| (cone - share).abs() < 1e-12));
        assert!(own.iter().any(|cone| (cone - share).abs() > 1e-3));
    }
}
