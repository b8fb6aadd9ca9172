//! The numbers of a run, stable as JSON.

use super::flows::Flows;
use super::{BordersReport, FindingReport, MapInput, Warning};
use crate::base_domain::BaseDomain;
use crate::cone_metric::FlowReport;
use crate::mesh::SurfacePoint;
use crate::monitor::Stage;
use crate::surface_map::measures::coverage::Coverage;
use crate::surface_map::measures::distortion::{Distortion, WorstPiece};
use crate::surface_map::measures::ground_truth::GroundTruthError;
use serde::Serialize;
use std::collections::BTreeMap;

/// The numbers of a run. Fields that a method does not have are `null`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct Report {
    /// Size of the base domain.
    pub base_domain: BaseDomainReport,
    /// The search for the class of the map; `null` where there is no certificate.
    pub layout: Option<LayoutSearchReport>,
    /// Points that the program added as cones of its own and held on the finer levels, see
    /// [`super::OwnConeOptions`]; not counted in `base_domain`.
    pub own_landmarks: usize,
    /// Both flows.
    pub cone_metric: ConeMetricsReport,
    /// The independent check of bijectivity; `null` for the thesis' method, which is not bijective, and for that
    /// of Tutte where rounding keeps it from being so.
    pub certificate: Option<CertificateReport>,
    /// Distortion of the map; of skin onto skin where holes were closed by caps.
    pub distortion: DistortionReport,
    /// The shares of the skin that are mapped onto skin, where holes were closed by caps; `null` where no mesh has caps, and where there is
    /// no overlay.
    pub coverage: Option<CoverageReport>,
    /// The kind of the rims of holes; `null` where not both meshes have holes, unless the user said that rims correspond, and for the
    /// methods that map patch by patch.
    pub borders: Option<BordersReport>,
    /// Share of the source's vertices without an image; 0 for the relaxed map.
    pub unmapped_share: f64,
    /// Distance to the true images in units of sqrt(target area), where the truth is known.
    pub ground_truth: Option<GroundTruthReport>,
    /// Whether the monitor asked for a result before the map was relaxed as far as usual
    /// ([`crate::monitor::Monitor::wants_result`]); it is valid all the same.
    pub stopped_early: bool,
    /// Triangles of the two input meshes.
    pub faces: FacesReport,
    /// Findings about the landmarks before the map was made; filled by the caller.
    pub findings: Vec<FindingReport>,
    /// Warnings about the result.
    #[cfg_attr(all(feature = "web", target_arch = "wasm32"), tsify(type = "WarningReport[]"))]
    pub warnings: Vec<Warning>,
    /// Wall-clock seconds by stage, and `total`; filled by the caller, which has a clock.
    #[cfg_attr(all(feature = "web", target_arch = "wasm32"), tsify(type = "Record<string, number>"))]
    pub seconds: BTreeMap<String, f64>,
}

/// Size of the base domain.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct BaseDomainReport {
    /// One vertex per landmark.
    pub vertices: usize,
    /// 2 vertices - 4.
    pub faces: usize,
}

/// The search for the class of the map among the ways to draw the base domain.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct LayoutSearchReport {
    /// Layouts that were judged by their coarse map.
    pub judged: usize,
    /// Mean log density of the best other class relative to the class chosen, on the finest level on which both were judged;
    /// `null` where no other is close. Near 1 the other is as good.
    pub rival: Option<f64>,
    /// Twists that were made after the best order of drawing was found.
    pub twists: usize,
    /// Mean log density (see [`DistortionReport::mean_log`]) of the coarse map by which the class was chosen; 0 for an isometry.
    pub mean_log: Option<f64>,
    /// Mean log density of the next best class.
    pub runner_up: Option<f64>,
    /// The largest ratio of a path of the layout to the shortest one between its landmarks.
    pub path_stretch: f64,
}

/// Both flows.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct ConeMetricsReport {
    /// The source's flow; `null` where it could not begin.
    pub source: Option<ConeMetricReport>,
    /// The target's flow; `null` where it could not begin.
    pub target: Option<ConeMetricReport>,
}

/// One flow.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct ConeMetricReport {
    /// Accepted Newton steps.
    pub newton_steps: usize,
    /// Conjugate gradient iterations of all steps.
    pub cg_iterations: usize,
    /// Edge flips of all steps.
    pub edge_flips: usize,
    /// Largest |target - curvature| at the end, in radians.
    pub max_curvature_error: f64,
    /// Largest |target - curvature| before the first step and after each step, in radians.
    pub residuals: Vec<f64>,
    /// Wall-clock seconds.
    pub seconds: f64,
}

/// The independent check of bijectivity.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct CertificateReport {
    /// Whether both parametrisations are homeomorphisms.
    pub bijective: bool,
    /// Triangles of both parametrised meshes, all of them checked.
    pub triangles: usize,
    /// Triangles that are not positively oriented.
    pub flipped_triangles: usize,
    /// Largest difference of an angle sum from 2 pi (or the cone angle), in radians.
    pub max_angle_sum_error: f64,
    /// Largest distance of a landmark's image from its landmark, in units of sqrt(area).
    pub max_landmark_error: f64,
}

/// Distortion of the map, both areas scaled to 1.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct DistortionReport {
    /// Integral of |J|^2 over the source plus |J^-1|^2 over the target; 4 for an isometry.
    pub energy: f64,
    /// Area-weighted mean over the source of (s1^2 + s2^2 + s1^-2 + s2^-2) / 4; 1 for an isometry.
    pub mean: f64,
    /// Half the sum of the area-weighted means of this density's logarithm over the source and over the target; 0 for an isometry.
    pub mean_log: f64,
    /// The density's area-weighted median over the source.
    pub median: f64,
    /// The density's area-weighted 95 % quantile over the source.
    pub p95: f64,
    /// The density's maximum, without pieces that rounding may have made.
    pub max: f64,
    /// Share of the area with a density above 20, of the source or of the target, whichever is larger: dents that one sees in
    /// a texture.
    pub dented: f64,
    /// The pieces of the overlay with the largest density, at most ten, the worst first; none for the thesis' method.
    pub worst: Vec<WorstPieceReport>,
    /// L2 stretch of the target's texture coordinates (Sander et al. 2001); 1 for an isometry, `null` where there is no texture.
    pub l2_stretch: Option<f64>,
}

/// Shares, by area, of the skin (the surface without the caps over holes) that are mapped onto skin; 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct CoverageReport {
    /// Share of the source's skin whose image is skin.
    pub source: f64,
    /// Share of the target's skin whose preimage is skin.
    pub target: f64,
    /// Share of the skin that is mapped onto a cap: the mean of both meshes.
    pub hidden: f64,
}

impl From<&Coverage> for CoverageReport {
    fn from(coverage: &Coverage) -> Self {
        Self { source: coverage.source, target: coverage.target, hidden: coverage.hidden() }
    }
}

impl CoverageReport {
    /// A sentence for the user.
    pub fn sentence(&self) -> String {
        format!(
            "{:.2} % of the source's skin lies on the target's skin, and {:.2} % of the target's skin has some of the source's; the \
             rest lies in caps",
            100.0 * self.source,
            100.0 * self.target
        )
    }
}

/// A piece of the overlay of large density.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct WorstPieceReport {
    /// Its density.
    pub density: f64,
    /// Its share of the source's area.
    pub area: f64,
    /// Its middle on the source.
    pub source: PlaceReport,
    /// The same point on the target.
    pub target: PlaceReport,
}

/// A point of one of the input meshes.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct PlaceReport {
    /// Face, 0-based.
    pub face: usize,
    /// Weights of its corners.
    pub barycentric: [f64; 3],
}

impl From<SurfacePoint> for PlaceReport {
    fn from(point: SurfacePoint) -> Self {
        Self { face: point.face.index(), barycentric: point.barycentric }
    }
}

impl From<PlaceReport> for SurfacePoint {
    fn from(place: PlaceReport) -> Self {
        Self { face: place.face.into(), barycentric: place.barycentric }
    }
}

impl From<&WorstPiece> for WorstPieceReport {
    fn from(piece: &WorstPiece) -> Self {
        let WorstPiece { density, area, source, target } = *piece;
        Self { density, area, source: source.into(), target: target.into() }
    }
}

impl DistortionReport {
    /// Replaces the places of the worst pieces by those that `places` (source, target) gives on other meshes.
    pub fn replace_worst(&mut self, places: [&dyn Fn(SurfacePoint) -> SurfacePoint; 2]) {
        for piece in &mut self.worst {
            for (place, elsewhere) in [&mut piece.source, &mut piece.target].into_iter().zip(places) {
                *place = elsewhere(place.clone().into()).into();
            }
        }
    }

    /// The numbers of a measured map.
    pub fn new(measured: &Distortion, l2_stretch: Option<f64>) -> Self {
        Self {
            energy: measured.energy,
            mean: measured.mean,
            mean_log: measured.mean_log,
            median: measured.median,
            p95: measured.p95,
            max: measured.max,
            dented: measured.dented,
            worst: measured.worst.iter().map(WorstPieceReport::from).collect(),
            l2_stretch,
        }
    }
}

/// Distance to the true images, in units of sqrt(target area).
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct GroundTruthReport {
    /// Mean over the source's vertices.
    pub mean: f64,
    /// 95 % quantile.
    pub p95: f64,
    /// Maximum.
    pub max: f64,
}

impl From<GroundTruthError> for GroundTruthReport {
    fn from(GroundTruthError { mean, p95, max }: GroundTruthError) -> Self {
        Self { mean, p95, max }
    }
}

/// Triangles of the two input meshes.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct FacesReport {
    /// Triangles of the source.
    pub source: usize,
    /// Triangles of the target.
    pub target: usize,
}

impl Report {
    /// Takes over wall-clock seconds by stage and `total`.
    pub fn set_seconds(&mut self, seconds: BTreeMap<String, f64>) {
        let of = |stage: Stage| seconds.get(&stage.to_string()).copied().unwrap_or_default();
        let ConeMetricsReport { source, target } = &mut self.cone_metric;
        for (flow, stage) in [(source, Stage::SourceConeMetric), (target, Stage::TargetConeMetric)] {
            if let Some(flow) = flow {
                flow.seconds = of(stage);
            }
        }
        self.seconds = seconds;
    }

    /// The part of the report that does not depend on the map.
    pub(super) fn of_inputs(input: MapInput<'_>, base: &BaseDomain, flows: &Flows) -> Self {
        let [source, target] =
            flows.reports.each_ref().map(|report| report.as_ref().map(ConeMetricReport::from));
        Self {
            base_domain: BaseDomainReport {
                vertices: base.mesh.vertex_count(),
                faces: base.mesh.face_count(),
            },
            cone_metric: ConeMetricsReport { source, target },
            faces: FacesReport { source: input.source.face_count(), target: input.target.face_count() },
            ..Self::default()
        }
    }
}

impl From<&FlowReport> for ConeMetricReport {
    fn from(report: &FlowReport) -> Self {
        Self {
            newton_steps: report.newton_steps,
            cg_iterations: report.cg_iterations,
            edge_flips: report.edge_flips,
            max_curvature_error: report.max_curvature_error,
            residuals: report.residuals.clone(),
            seconds: 0.0,
        }
    }
}
