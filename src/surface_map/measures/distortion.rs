//! Distortion: measures of how far the map is from an isometry.
//!
//! On each piece of the overlay the map is affine with singular values s1, s2 (both surfaces scaled to area 1).

use super::coverage::{Coverage, SkinAreas};
use crate::math::matrix2::squares;
use crate::math::quantile::{Weighted, quantile, sort_asking};
use crate::math::scalar::{ln, max, min};
use crate::math::triangle::lay_out;
use crate::mesh::cap_faces::CapFaces;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Pulse, Step};
use crate::surface_map::energy::symmetric_dirichlet::SymmetricDirichlet;
use crate::surface_map::overlay::{Overlay, OverlayPoint, Piece};
use crate::surface_map::parametrisation::embedding::Parametrised;
use crate::surface_map::parametrisation::rest_triangle::rest_jacobian;
use glam::{DMat2, DVec2, DVec3};
use std::convert::Infallible;
use typed_index_collections::{TiVec, ti_vec};

/// Distortion where the map is affine, with singular values s1 and s2 and both areas 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LocalDistortion {
    /// (s1^2 + s2^2 + s1^-2 + s2^-2) / 4; 1 for an isometry, more otherwise.
    pub density: f64,
    /// (s1 / s2 + s2 / s1) / 2; 1 where angles are kept, more otherwise.
    pub angle: f64,
    /// s1 s2, the image's area over the area; 1 where areas are kept.
    pub area: f64,
}

impl LocalDistortion {
    /// The distortion of a map with the Jacobian `j`, whose determinant is positive.
    pub(in crate::surface_map) fn of(j: &DMat2) -> Self {
        Self::new(squares(j), j.determinant())
    }

    /// The distortion for a Jacobian with |J|^2 = `squares` and the positive determinant `det`.
    fn new(squares: f64, det: f64) -> Self {
        Self { density: SymmetricDirichlet::of(squares, det), angle: 0.5 * squares / det, area: det }
    }
}

/// Distortion of the map source -> target, both areas 1. Where meshes have caps it is that of skin onto skin, both parts of area 1.
#[derive(Clone, Debug, Default)]
pub struct Distortion {
    /// Integral of |J|^2 over the source plus |J^-1|^2 over the target; 4 for an isometry.
    pub energy: f64,
    /// Area-weighted mean over the source of (s1^2 + s2^2 + s1^-2 + s2^-2) / 4; 1 for an isometry.
    pub mean: f64,
    /// Half the sum of the area-weighted means of the density's logarithm over the source and over the target; 0 for an
    /// isometry. It tells two maps apart where the energy does not: that is 4 for every conformal map.
    pub mean_log: f64,
    /// The density's area-weighted median over the source.
    pub median: f64,
    /// The density's area-weighted 95 % quantile over the source.
    pub p95: f64,
    /// The density's maximum, without pieces that rounding may have made.
    pub max: f64,
    /// The share of the area with a density above [`DENTED`], of the source or of the target, whichever is larger.
    pub dented: f64,
    /// The pieces of largest density, the worst first, at most [`WORST`]; without pieces that rounding may have made, and
    /// empty for maps given by images.
    pub worst: Vec<WorstPiece>,
    /// Sum of the pieces' areas on the source (1 up to rounding).
    pub source_area: f64,
    /// Sum of the pieces' areas on the target (1 up to rounding).
    pub target_area: f64,
    /// The shares of the skin that are mapped onto skin; `None` where no mesh has caps.
    pub coverage: Option<Coverage>,
    /// The density averaged around each vertex of the refined source; not a number where no skin around it is mapped onto skin.
    pub by_vertex: TiVec<VertexId, f64>,
    /// The distortion on each piece of the overlay; empty for maps given by images.
    pub by_piece: Vec<LocalDistortion>,
}

/// The density above which a texture looks dented. Chosen by hand.
pub const DENTED: f64 = 20.0;

/// Number of worst pieces in the result, at most: as many as one looks at. Chosen by hand.
pub const WORST: usize = 10;

/// One of the pieces of the overlay with the largest densities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPiece {
    /// Its density.
    pub density: f64,
    /// Its area on the source, whose area is 1.
    pub area: f64,
    /// The middle of the piece on the refined source.
    pub source: SurfacePoint,
    /// The same point on the refined target.
    pub target: SurfacePoint,
}

/// Whether a piece of area `area` of two triangles on the cone surface is larger than rounding.
///
/// The density of a piece is that of its two triangles' Jacobians, whatever its size, and as exact as these; but where the
/// triangles only touch, rounding decides whether they share a piece. Coordinates on the cone surface are of order 1,
/// and where two ways lead to the same corner they differ by up to 7e-15 (34 test pairs, most by less than 2e-15): that moves
/// a side of length l by an area of 7e-15 l. Larger pieces are certain. Integrals count them all.
pub(in crate::surface_map) fn is_certain(area: f64, triangles: [&[DVec2; 3]; 2]) -> bool {
    let longest = |t: &[DVec2; 3]| max(max(t[0].distance(t[1]), t[1].distance(t[2])), t[2].distance(t[0]));
    area > 1e-14 * min(longest(triangles[0]), longest(triangles[1]))
}

/// Measures the map on its overlay.
///
/// # Errors
/// [`Cancelled`].
pub fn distortion(
    sides: [Parametrised<'_>; 2],
    overlay: &Overlay,
    monitor: &mut dyn Monitor,
) -> Result<Distortion, Cancelled> {
    skin_distortion(sides, overlay, CapFaces::default(), monitor)
}

/// Pieces measured between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 16_384;

/// Measures the map on the pieces that are skin on both meshes, and the share of the skin that these are.
///
/// # Errors
/// [`Cancelled`].
pub fn skin_distortion(
    [source, target]: [Parametrised<'_>; 2],
    overlay: &Overlay,
    caps: CapFaces<'_>,
    monitor: &mut dyn Monitor,
) -> Result<Distortion, Cancelled> {
    let to_source = |f: FaceId| rest_jacobian(source, f);
    let to_target = |f: FaceId| rest_jacobian(target, f);
    let source_maps: TiVec<FaceId, DMat2> = source.mesh.faces().map(to_source).collect();
    let target_inverses: TiVec<FaceId, DMat2> = target.mesh.faces().map(|f| to_target(f).inverse()).collect();
    let areas = |piece: &Piece| {
        let (a, b) = (&source_maps[piece.source_face], &target_inverses[piece.target_face]);
        [piece.area / a.determinant(), piece.area * b.determinant()]
    };
    let is_skin = |piece: &Piece| caps.are_skin([piece.source_face, piece.target_face]);
    let skin =
        caps.any().then(|| SkinAreas::of(overlay.pieces.iter().map(|piece| (is_skin(piece), areas(piece)))));
    monitor.step(Step::default())?;
    let mut tally = Tally::new(source.mesh, overlay.pieces.len(), skin);
    let mut pulse = Pulse::new(monitor, ASKED_EVERY);
    for piece in &overlay.pieces {
        pulse.beat()?;
        let (a, b) = (&source_maps[piece.source_face], &target_inverses[piece.target_face]);
        let rotation = piece.motion.turn();
        let j = *b * rotation * *a;
        match is_skin(piece) {
            [true, true] => tally.add(piece.source_face, &j, areas(piece)),
            _ => tally.leave_out(&j),
        }
    }
    monitor.step(Step::default())?;
    let worst = worst_pieces([source, target], overlay, &tally);
    monitor.step(Step::default())?;
    tally.finish(source.mesh, worst, || monitor.step(Step::default()))
}

fn worst_pieces(
    [source, target]: [Parametrised<'_>; 2],
    overlay: &Overlay,
    tally: &Tally,
) -> Vec<WorstPiece> {
    let is_certain = |k: usize| {
        let piece = &overlay.pieces[k];
        let triangles =
            [source.embedding.triangle(piece.source_face), target.embedding.triangle(piece.target_face)];
        is_certain(piece.area, [&triangles[0], &triangles[1]])
    };
    tally.worst(is_certain, |k| {
        let piece = &overlay.pieces[k];
        let corners = &overlay.points[piece.points.clone()];
        let middle = |of: fn(&OverlayPoint) -> [f64; 3]| {
            let sum = corners.iter().map(|corner| DVec3::from(of(corner))).sum::<DVec3>();
            (sum / corners.len() as f64).to_array()
        };
        [
            SurfacePoint { face: piece.source_face, barycentric: middle(|corner| corner.source) },
            SurfacePoint { face: piece.target_face, barycentric: middle(|corner| corner.target) },
        ]
    })
}

/// The measures of a map while they are summed over its pieces; where there are caps, over those of skin on skin.
pub(in crate::surface_map) struct Tally {
    result: Distortion,
    /// The density of each piece, its weight the area on the source.
    densities: Vec<Weighted>,
    /// Numbers of the pieces that were left out, in ascending order.
    left_out: Vec<usize>,
    /// The units of area, source first: the area of skin that is mapped onto skin.
    units: [f64; 2],
    /// Area of dented pieces on the source and on the target.
    dented: [f64; 2],
    /// On each face of the source: the integral of the density, and the area.
    faces: TiVec<FaceId, [f64; 2]>,
}

impl Tally {
    /// Begins the measures of a map from this mesh with this number of pieces; `skin` are its areas where a mesh has caps.
    pub(in crate::surface_map) fn new(source: &SurfaceMesh, pieces: usize, skin: Option<SkinAreas>) -> Self {
        let coverage = skin.map(|skin| skin.coverage());
        Self {
            result: Distortion { coverage, ..Distortion::default() },
            left_out: Vec::new(),
            units: skin.map_or([1.0; 2], |skin| skin.shared()),
            densities: Vec::with_capacity(pieces),
            dented: [0.0; 2],
            faces: ti_vec![[0.0; 2]; source.face_count()],
        }
    }

    /// Adds the next piece: its source face, its Jacobian and its areas on the source and on the target.
    pub(in crate::surface_map) fn add(&mut self, face: FaceId, j: &DMat2, areas: [f64; 2]) {
        let scale = self.scale();
        let (squares, det) = (squares(j) * scale, j.determinant() * scale);
        let areas = [0, 1].map(|k| areas[k] / self.units[k]);
        let [source_area, target_area] = areas;
        let inverse_squares = squares / (det * det);
        let density = 0.25 * (squares + inverse_squares);
        let result = &mut self.result;
        result.by_piece.push(LocalDistortion::new(squares, det));
        result.energy += squares * source_area + inverse_squares * target_area;
        result.source_area += source_area;
        result.target_area += target_area;
        result.mean_log += 0.5 * ln(density) * (source_area + target_area);
        if density > DENTED {
            (0..2).for_each(|k| self.dented[k] += areas[k]);
        }
        self.densities.push(Weighted { value: density, weight: source_area });
        self.faces[face][0] += density * source_area;
        self.faces[face][1] += source_area;
    }

    /// Leaves the next piece, which has the Jacobian `j`, out of the sums: it is not skin on both meshes.
    pub(in crate::surface_map) fn leave_out(&mut self, j: &DMat2) {
        let scale = self.scale();
        self.left_out.push(self.densities.len());
        self.densities.push(Weighted { value: 1.0, weight: 0.0 });
        self.result.by_piece.push(LocalDistortion::new(squares(j) * scale, j.determinant() * scale));
    }

    /// The factor of squared Jacobians when the skin of both meshes is scaled to area 1.
    fn scale(&self) -> f64 {
        self.units[0] / self.units[1]
    }

    /// The [`WORST`] pieces of largest density among those that are there for certain, with their middles on both meshes.
    pub(in crate::surface_map) fn worst(
        &self,
        is_certain: impl Fn(usize) -> bool,
        middles: impl Fn(usize) -> [SurfacePoint; 2],
    ) -> Vec<WorstPiece> {
        let is_skin = |k: usize| self.left_out.binary_search(&k).is_err();
        let exceeds =
            |k: usize, other: usize| self.densities[k].value.total_cmp(&self.densities[other].value).is_gt();
        // In descending order of density, equal ones by number.
        let mut worst: Vec<usize> = Vec::with_capacity(WORST + 1);
        for k in 0..self.densities.len() {
            let is_among = worst.len() < WORST || exceeds(k, worst[WORST - 1]);
            if is_among && is_skin(k) && is_certain(k) {
                worst.insert(worst.partition_point(|&other| !exceeds(k, other)), k);
                worst.truncate(WORST);
            }
        }
        worst
            .into_iter()
            .map(|k| {
                let Weighted { value: density, weight: area } = self.densities[k];
                let [source, target] = middles(k);
                WorstPiece { density, area, source, target }
            })
            .collect()
    }

    /// Computes all measures after the last piece; calls `ask` now and then.
    ///
    /// # Errors
    /// That of `ask`.
    pub(in crate::surface_map) fn finish<E>(
        self,
        source: &SurfaceMesh,
        worst: Vec<WorstPiece>,
        mut ask: impl FnMut() -> Result<(), E>,
    ) -> Result<Distortion, E> {
        let Self { mut result, densities, dented, faces, .. } = self;
        result.summarise(densities, &mut ask)?;
        ask()?;
        result.max = worst.first().map_or(1.0, |piece| piece.density);
        result.dented = max(dented[0] / result.source_area, dented[1] / result.target_area);
        result.worst = worst;
        result.by_vertex = vertex_averages(source, &faces);
        ask()?;
        Ok(result)
    }
}

/// Measures a map given by the images of vertices, on the source's faces with three images; each is mapped affinely onto the
/// triangle of its images in space. Image triangles flatter than 1e-7 of the root of the target's area are left out: their shape is
/// rounding, but the flattest of them would decide the mean.
///
/// Integrals run over the mapped part only, whose areas are `source_area` and `target_area`. There are no values by vertex.
pub fn image_distortion(
    source: &SurfaceMesh,
    target: &SurfaceMesh,
    images: &TiVec<VertexId, Option<SurfacePoint>>,
) -> Distortion {
    let scales = [source, target].map(|mesh| 1.0 / mesh.area().sqrt());
    let mut result = Distortion::default();
    let (mut logs, mut dented) = ([0.0; 2], [0.0; 2]);
    let mut densities = Vec::new();
    for (f, corners) in source.triangles().iter_enumerated() {
        let [Some(a), Some(b), Some(c)] = corners.map(|v| images[v]) else { continue };
        let from = in_plane(source.corners(f), scales[0]);
        let onto = in_plane([a, b, c].map(|p| p.position(target)), scales[1]);
        let j = onto * from.inverse();
        let det = j.determinant();
        let longest =
            onto.x_axis.length().max(onto.y_axis.length()).max((onto.x_axis - onto.y_axis).length());
        let flat = onto.determinant() <= 1e-7 * longest;
        if flat || det.is_nan() {
            continue;
        }
        let squares = squares(&j);
        let inverse_squares = squares / (det * det);
        let areas = [0.5 * from.determinant(), 0.5 * onto.determinant()];
        let density = 0.25 * (squares + inverse_squares);
        result.energy += squares * areas[0] + inverse_squares * areas[1];
        result.source_area += areas[0];
        result.target_area += areas[1];
        (0..2).for_each(|k| logs[k] += ln(density) * areas[k]);
        if density > DENTED {
            (0..2).for_each(|k| dented[k] += areas[k]);
        }
        densities.push(Weighted { value: density, weight: areas[0] });
    }
    result.dented = max(dented[0] / result.source_area, dented[1] / result.target_area);
    result.mean_log = 0.5 * (logs[0] / result.source_area + logs[1] / result.target_area);
    let Ok(()) = result.summarise(densities, || Ok::<_, Infallible>(()));
    result
}

/// The edge vectors from corner 0 of a triangle in its own plane, scaled.
pub(in crate::surface_map) fn in_plane([p, q, r]: [DVec3; 3], scale: f64) -> DMat2 {
    let [_, q, r] = lay_out([p.distance(q), q.distance(r), r.distance(p)].map(|length| length * scale));
    DMat2::from_cols(q, r)
}

impl Distortion {
    /// Fills in mean, quantiles and maximum of densities, weighted by the source areas.
    fn summarise<E>(
        &mut self,
        mut densities: Vec<Weighted>,
        ask: impl FnMut() -> Result<(), E>,
    ) -> Result<(), E> {
        self.mean = densities.iter().map(|d| d.value * d.weight).sum::<f64>() / self.source_area;
        sort_asking(&mut densities, ask)?;
        self.median = quantile(&densities, 0.5);
        self.p95 = quantile(&densities, 0.95);
        self.max = densities.last().map_or(1.0, |d| d.value);
        Ok(())
    }
}

fn vertex_averages(mesh: &SurfaceMesh, faces: &TiVec<FaceId, [f64; 2]>) -> TiVec<VertexId, f64> {
    let mut sums = ti_vec![[0.0_f64; 2]; mesh.vertex_count()];
    for (f, corners) in mesh.triangles().iter_enumerated() {
        for &v in corners {
            let sum: &mut [f64; 2] = &mut sums[v];
            sum[0] += faces[f][0];
            sum[1] += faces[f][1];
        }
    }
    sums.into_iter().map(|[d, a]| d / a).collect()
}

#[cfg(test)]
mod tests {
    use super::{LocalDistortion, is_certain};
    use glam::DVec2;

    #[test]
    fn measures_of_a_diagonal_jacobian() {
        let (s1, s2) = (2.0, 0.25);
        let local = LocalDistortion::new(s1 * s1 + s2 * s2, s1 * s2);
        assert_eq!(local.density, (4.0 + 0.0625 + 0.25 + 16.0) / 4.0);
        assert_eq!((local.angle, local.area), ((8.0 + 0.125) / 2.0, 0.5));
        assert_eq!(LocalDistortion::new(2.0, 1.0), LocalDistortion { density: 1.0, angle: 1.0, area: 1.0 });
    }

    #[test]
    fn a_piece_as_thin_as_rounding_is_not_certain() {
        let triangle = [DVec2::ZERO, DVec2::new(0.01, 0.0), DVec2::new(0.0, 0.01)];
        assert!(!is_certain(0.01 * 5e-15, [&triangle, &triangle]));
        assert!(is_certain(0.01 * 1e-13, [&triangle, &triangle]));
    }
}
