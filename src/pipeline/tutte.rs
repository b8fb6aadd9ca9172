//! The map patch by patch over straight triangles, as it was made before maps were relaxed as a whole.
//!
//! The layout is that of the thesis' method. Points with equal barycentric coordinates in corresponding triangles correspond: with both
//! meshes over one cone surface this is one parametrisation followed by the inverse of the other, certified and composed as the relaxed map
//! is. Where a limb without a landmark shrinks below rounding the map is not certified; then it is given by the images of the source's
//! vertices, as far as they have one.

use super::flows::Flows;
use super::parametrise::{Parametrisation, certified};
use super::relaxed::composed;
use super::thesis::{draw, result, unmapped};
use super::{MapInput, MapResult, PipelineError, PipelineOptions, Warning};
use crate::coarse_map::LandmarkedMesh;
use crate::layout::{BaseLayout, SearchReport};
use crate::monitor::{Monitor, Portion, Stage, Step};
use crate::patchwise::straight_map;
use crate::surface_map::parametrisation::tutte::{embed_patches, nudged};
use crate::surface_map::{Certificate, ConeSurface, Embedding};
use std::sync::Arc;

/// Draws the base domain, maps each patch onto its triangle, and makes the result.
pub(super) fn run(
    input: MapInput<'_>,
    options: &PipelineOptions,
    monitor: &mut dyn Monitor,
) -> Result<MapResult, PipelineError> {
    monitor.enter(Stage::BaseDomain);
    let layout = draw(input, options, &mut Portion::new(monitor, 0.0, 0.9))?;
    let straight = StraightPatches::new(layout, &mut Portion::new(monitor, 0.9, 1.0))?;
    match straight.certified(monitor) {
        Ok(proven) => {
            let map = composed(input, &straight.parametrisation(proven), options, monitor)?;
            // Where patches shrink limbs to tiny faces, the corners of pieces are less exact than the check of a correspondence demands.
            Ok(MapResult { correspondence: None, flat_layout: None, ..map })
        }
        Err(PipelineError::NotCertified(certificate)) => {
            straight.at_vertices(input, &certificate, options, monitor)
        }
        Err(error) => Err(error),
    }
}

/// Both meshes with their patches on straight triangles.
struct StraightPatches {
    layout: BaseLayout,
    surface: Arc<ConeSurface>,
    embeddings: [Embedding; 2],
}

/// Both parametrisations where they are certified.
struct Proven {
    sides: [LandmarkedMesh; 2],
    embeddings: [Embedding; 2],
    certificate: Certificate,
}

impl StraightPatches {
    fn new(layout: BaseLayout, monitor: &mut dyn Monitor) -> Result<Self, PipelineError> {
        let surface = Arc::new(ConeSurface::of_layout(&layout));
        let source = embed_patches(&layout.source, &surface, &mut Portion::new(monitor, 0.0, 0.5))?;
        let target = embed_patches(&layout.target, &surface, &mut Portion::new(monitor, 0.5, 1.0))?;
        Ok(Self { layout, surface, embeddings: [source, target] })
    }

    /// The parametrisations, nudged so that they have an overlay, with their certificate.
    fn certified(&self, monitor: &mut dyn Monitor) -> Result<Proven, PipelineError> {
        let told = Step { fraction: 1.0, residual: None };
        let BaseLayout { source, target, .. } = &self.layout;
        let from = nudged(source.parametrised(&self.embeddings[0]), 1);
        monitor.step(told)?;
        let onto = nudged(target.parametrised(&self.embeddings[1]), 2);
        monitor.step(told)?;
        let from_mesh = LandmarkedMesh::patched(source);
        monitor.step(told)?;
        let (sides, embeddings) = ([from_mesh, LandmarkedMesh::patched(target)], [from, onto]);
        let parametrised = [0, 1].map(|k| sides[k].parametrised(&embeddings[k]));
        let certificate = certified(parametrised, &self.surface, monitor)?;
        Ok(Proven { sides, embeddings, certificate })
    }

    fn parametrisation(self, proven: Proven) -> Parametrisation {
        Parametrisation {
            layout: self.layout,
            search: SearchReport::default(),
            surface: self.surface,
            sides: proven.sides,
            embeddings: proven.embeddings,
            certificate: proven.certificate,
            stopped_early: false,
            borders: None,
        }
    }

    /// The map at the source's vertices, where it is not certified, with a warning that names the faults.
    fn at_vertices(
        self,
        input: MapInput<'_>,
        certificate: &Certificate,
        options: &PipelineOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<MapResult, PipelineError> {
        monitor.enter(Stage::Composition);
        let Self { layout, surface, embeddings: [source, target] } = &self;
        let inputs = [input.source, input.target];
        let corners = [&*source.corners, &*target.corners];
        let map = straight_map(layout, inputs, &surface.charts, corners, monitor)?;
        let (flows, missing) = Flows::beside_a_map(input, &layout.base, options, monitor)?;
        monitor.enter(Stage::Transfer);
        monitor.step(Step::default())?;
        let refused = Warning::NotCertified { reason: certificate.to_string() };
        let warnings = [Some(refused), unmapped(&map)].into_iter().flatten().chain(missing).collect();
        Ok(result(input, self.layout, &flows, map, warnings))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmarks::Landmarks;
    use crate::math::scalar::{cos, sin};
    use crate::mesh::generators::icosphere;
    use crate::mesh::{FaceId, SurfaceMesh, VertexId};
    use crate::monitor::Silent;
    use crate::pipeline::Report;
    use glam::DVec3;
    use std::f64::consts::TAU;
    use typed_index_collections::TiVec;

    #[test]
    fn a_sphere_is_mapped_onto_itself_by_the_identity() {
        let sphere = icosphere(3);
        let pairs: Vec<_> = (0..12).map(|k| [k, k]).collect();
        let landmarks = Landmarks::from_vertices(&sphere, &sphere, &pairs).unwrap();
        let input = MapInput::new(&sphere, &sphere, &landmarks);
        let result = run(input, &PipelineOptions::default(), &mut Silent).unwrap();
        for (v, image) in result.target_from_source.iter_enumerated() {
            let off = image.unwrap().position(&sphere).distance(sphere.positions()[v]);
            assert!(off < 1e-8, "{v:?}: {off:e}");
        }
        let Report { distortion, warnings, unmapped_share, .. } = result.report;
        assert!((distortion.energy - 4.0).abs() < 1e-6 && warnings.is_empty(), "{distortion:?} {warnings:?}");
        assert_eq!(unmapped_share, 0.0);
    }

    /// A tube of rings of twelve vertices, closed by a tip at either end, and landmarks at the lower one.
    fn tube(rings: usize) -> (SurfaceMesh, Vec<[u32; 2]>) {
        const AROUND: usize = 12;
        let ring = |at: usize, k: usize| VertexId::from(AROUND * at + k % AROUND);
        let mut positions: TiVec<VertexId, DVec3> = TiVec::new();
        for at in 0..rings {
            for k in 0..AROUND {
                let angle = (k as f64 + 0.5 * at as f64) * TAU / AROUND as f64;
                positions.push(DVec3::new(cos(angle), sin(angle), 0.45 * at as f64));
            }
        }
        let [below, above] = [-0.4, 0.45 * rings as f64].map(|z| positions.push_and_get_key(DVec3::Z * z));
        let mut faces: TiVec<FaceId, [VertexId; 3]> = TiVec::new();
        for k in 0..AROUND {
            faces.push([below, ring(0, k + 1), ring(0, k)]);
            faces.push([above, ring(rings - 1, k), ring(rings - 1, k + 1)]);
            for at in 1..rings {
                faces.push([ring(at - 1, k), ring(at - 1, k + 1), ring(at, k)]);
                faces.push([ring(at - 1, k + 1), ring(at, k + 1), ring(at, k)]);
            }
        }
        let landmarks = [below, ring(2, 0), ring(2, 4), ring(2, 8)].map(|v| [v.0, v.0]);
        (SurfaceMesh::from_triangles(positions, faces).unwrap(), landmarks.to_vec())
    }

    #[test]
    fn a_limb_that_shrinks_below_rounding_is_told_and_has_no_image_at_its_end() {
        for (rings, is_short) in [(20, true), (150, false)] {
            let (tube, pairs) = tube(rings);
            let landmarks = Landmarks::from_vertices(&tube, &tube, &pairs).unwrap();
            let input = MapInput::new(&tube, &tube, &landmarks);
            let MapResult { report, target_from_source, .. } =
                run(input, &PipelineOptions::default(), &mut Silent).unwrap();
            let is_told =
                report.warnings.iter().any(|warning| matches!(warning, Warning::NotCertified { .. }));
            assert_eq!(
                (report.certificate.is_some(), is_told),
                (is_short, !is_short),
                "{:?}",
                report.warnings
            );
            if !is_short {
                assert!((0.1..0.9).contains(&report.unmapped_share), "{}", report.unmapped_share);
                let tips = [0, rings / 6].map(|ring| target_from_source[VertexId::from(12 * ring)]);
                assert!(tips.iter().all(Option::is_some), "{tips:?}");
            }
        }
    }
}
