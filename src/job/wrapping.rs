//! The file of a base mesh, laid onto a scan: the source of a map in the place and shape of its target.

use super::taken::TakenMap;
use crate::io::moved::{self, MoveError, Normals};
use crate::io::{self, ReadError};
use crate::map_file::FileMesh;
use crate::math::disjoint_sets::DisjointSets;
use crate::math::scalar::max;
use crate::math::triangle::angle_at;
use crate::mesh::cap_faces::CapFaces;
use crate::monitor::{Cancelled, Monitor};
use crate::wrap::{Laid, LooseParts, WrapError, WrapInput, WrapReport, Wrapped, wrapped};
use glam::DVec3;
use serde::Serialize;
use std::collections::BTreeMap;

/// A base file with its vertices on the scan.
#[derive(Clone, Debug)]
pub struct WrappedFile {
    /// The contents of the file: that of the base, but for the places of its vertices.
    pub bytes: Vec<u8>,
    /// The place of each vertex of the file.
    pub positions: Vec<DVec3>,
    /// The way in which each vertex of the file was placed; `None` for those of loose parts.
    pub laid: Vec<Option<Laid>>,
    /// The numbers.
    pub report: WrappedFileReport,
}

/// The numbers of a wrapped file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WrappedFileReport {
    /// The numbers of the wrapped surface.
    #[serde(flatten)]
    pub surface: WrapReport,
    /// Triangles that look the wrong way, by their numbers in the triangulated file.
    pub flipped: Vec<u32>,
    /// Vertices that were laid on where the scan has no surface, by their numbers in the file.
    pub extended_vertices: Vec<usize>,
    /// Vertices of parts that the map does not know, which follow the surface near them as a whole.
    pub loose_vertices: usize,
    /// The file's polygons of four corners; `None` where it has none.
    pub quads: Option<QuadAngles>,
    /// Whether the file holds normals: they are those of the base as it was.
    pub has_old_normals: bool,
}

/// The angles of polygons of four corners, in degrees.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct QuadAngles {
    /// Number of these polygons.
    pub count: usize,
    /// The largest angle as given.
    pub largest_before: f64,
    /// The largest angle of the result.
    pub largest: f64,
    /// Number of polygons of the result with an angle of 180 degrees or more.
    pub hollow: usize,
}

/// Why a file cannot be wrapped.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WrapFileError {
    /// The bytes are not those of the map's source.
    #[error("this is not the file of the base that the map was made with")]
    OtherFile,
    /// The map leads to the mirror image of the scan.
    #[error(
        "the map goes to the scan's mirror image, on which the base would be inside out: mirror the base or the scan in its file"
    )]
    Mirrored,
    /// The base cannot be laid onto the scan.
    #[error(transparent)]
    Wrap(WrapError),
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file cannot be written.
    #[error(transparent)]
    Move(#[from] MoveError),
    /// The user asked to stop.
    #[error("{0}")]
    Stopped(Cancelled),
}

impl WrappedFileReport {
    /// The outcome of wrapping, in sentences.
    pub fn sentence(&self) -> String {
        let WrapReport { on_scan, extended, flipped_triangles, ref distance, .. } = self.surface;
        let [mean, p95] = [distance.to_scan.mean, distance.to_scan.p95].map(|share| 100.0 * share);
        let mut told = format!(
            "{on_scan} vertices lie on the scan, whose surface is {mean:.3} % of its size away in the mean and within {p95:.3} % in 95 %."
        );
        if extended > 0 {
            told += &format!(" {extended} vertices were laid on where the scan has no surface.");
        }
        if flipped_triangles > 0 {
            told += &format!(" {flipped_triangles} triangles look the wrong way: add landmarks there.");
        }
        if self.has_old_normals {
            told += " The normals in the file are still those of the base as it was.";
        }
        told
    }
}

impl From<WrapError> for WrapFileError {
    fn from(error: WrapError) -> Self {
        match error {
            WrapError::Stopped(stop) => Self::Stopped(stop),
            error => Self::Wrap(error),
        }
    }
}

impl TakenMap<'_> {
    /// Lays the map's source, whose file is given, onto its target.
    ///
    /// # Errors
    /// [`WrapFileError`].
    pub fn wrapped(
        &self,
        base_file: &[u8],
        normals: Normals,
        monitor: &mut dyn Monitor,
    ) -> Result<WrappedFile, WrapFileError> {
        let [base, scan] = self.meshes();
        if !base.is_of(base_file) {
            return Err(WrapFileError::OtherFile);
        }
        if scan.is_mirrored() {
            return Err(WrapFileError::Mirrored);
        }
        // A base that cannot be written is refused before the work is done.
        moved::check(base_file, normals)?;
        let caps = CapFaces { source: base.checked().caps(), target: scan.checked().caps() };
        let map = &self.map().correspondence;
        let input = WrapInput { base: base.mesh(), scan: scan.mesh(), map, caps };
        let wrapped = wrapped(&input, monitor)?;
        let before = &io::read_mesh(base_file)?.positions;
        let mut positions = file_positions(base, before, &wrapped);
        positions.iter_mut().for_each(|p| *p = scan.in_file(*p));
        let laid = base.checked().by_file_vertex(&wrapped.laid.raw);
        let is_extended = |(v, laid): (usize, &Option<Laid>)| (*laid == Some(Laid::Extended)).then_some(v);
        let bytes = moved::with_positions(base_file, &positions, normals)?;
        let report = WrappedFileReport {
            flipped: wrapped.flipped.iter().map(|&f| base.checked().file_from_face(f).0).collect(),
            extended_vertices: laid.iter().enumerate().filter_map(is_extended).collect(),
            loose_vertices: laid.iter().filter(|laid| laid.is_none()).count(),
            quads: QuadAngles::of(base.polygons(), [before, &positions]),
            has_old_normals: moved::has_normals(&bytes),
            surface: wrapped.report,
        };
        Ok(WrappedFile { bytes, positions, laid, report })
    }
}

/// The new places of the file's vertices on the scan's mesh: those of vertices that the map does not know part by part.
fn file_positions(base: &FileMesh, before: &[DVec3], wrapped: &Wrapped) -> Vec<DVec3> {
    let known = base.checked().by_file_vertex(&wrapped.positions.raw);
    let mut positions: Vec<DVec3> = known.iter().map(|p| p.unwrap_or_default()).collect();
    let mut loose = None;
    for part in loose_parts(base.polygons(), &known) {
        let moved = loose
            .get_or_insert_with(|| LooseParts::new(base.mesh(), &wrapped.positions))
            .moved(&part.iter().map(|&v| base.frame().on_mesh(before[v])).collect::<Vec<_>>());
        part.iter().zip(moved).for_each(|(&v, p)| positions[v] = p);
    }
    positions
}

/// The vertices that have no place yet, by part: those that polygons join; parts with polygons first.
fn loose_parts(polygons: &[Vec<u32>], known: &[Option<DVec3>]) -> Vec<Vec<usize>> {
    if known.iter().all(Option::is_some) {
        return Vec::new();
    }
    let mut sets = DisjointSets::new(known.len());
    let mut has_face = vec![false; known.len()];
    for polygon in polygons {
        let unknown = polygon.iter().map(|&v| v as usize).filter(|&v| known[v].is_none());
        let unknown: Vec<usize> = unknown.collect();
        unknown.iter().for_each(|&v| has_face[v] = true);
        unknown.windows(2).for_each(|pair| {
            sets.join(pair[0], pair[1]);
        });
    }
    let mut parts: BTreeMap<(bool, usize), Vec<usize>> = BTreeMap::new();
    for v in (0..known.len()).filter(|&v| known[v].is_none()) {
        parts.entry((!has_face[v], sets.root(v))).or_default().push(v);
    }
    parts.into_values().collect()
}

impl QuadAngles {
    fn of(polygons: &[Vec<u32>], [before, after]: [&[DVec3]; 2]) -> Option<Self> {
        let mut angles = Self { count: 0, largest_before: 0.0, largest: 0.0, hollow: 0 };
        for quad in polygons.iter().filter(|polygon| polygon.len() == 4) {
            angles.count += 1;
            let [was, is] = [before, after].map(|places| largest_angle(quad, places).to_degrees());
            angles.largest_before = max(angles.largest_before, was);
            angles.largest = max(angles.largest, is);
            angles.hollow += usize::from(is >= 180.0);
        }
        (angles.count > 0).then_some(angles)
    }
}

/// The largest inner angle of a polygon, in radians; seen along its mean normal, it may be more than 180 degrees.
fn largest_angle(polygon: &[u32], places: &[DVec3]) -> f64 {
    let n = polygon.len();
    let at = |k: usize| places[polygon[k % n] as usize];
    let origin = at(0);
    let normal: DVec3 = (0..n).map(|k| (at(k) - origin).cross(at(k + 1) - origin)).sum();
    let angle = |k: usize| {
        let [before, here, next] = [at(k + n - 1), at(k), at(k + 1)];
        let angle = angle_at(here, next, before);
        let is_hollow = (next - here).cross(before - here).dot(normal) < 0.0;
        if is_hollow { std::f64::consts::TAU - angle } else { angle }
    };
    (0..n).map(angle).fold(0.0, max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hollow_quads_have_an_angle_beyond_180_degrees() {
        let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let places = [at(0.0, 0.0), at(2.0, 0.0), at(2.0, 1.0), at(0.0, 1.0), at(0.5, 0.25)];
        let quads =
            |polygon: [u32; 4]| QuadAngles::of(&[polygon.to_vec(), vec![0, 1, 2]], [&places; 2]).unwrap();
        let angles = quads([0, 1, 2, 3]);
        assert!((angles.count, angles.hollow) == (1, 0) && (angles.largest - 90.0).abs() < 1e-12);
        let hollow = quads([0, 1, 4, 3]);
        assert!(hollow.largest > 190.0 && hollow.hollow == 1, "{hollow:?}");
        assert_eq!(QuadAngles::of(&[vec![0, 1, 2]], [&places; 2]), None);
    }

    #[test]
    fn loose_vertices_are_sorted_by_the_polygons_that_join_them() {
        let known: Vec<Option<DVec3>> = (0..9).map(|v| (v < 3).then_some(DVec3::ZERO)).collect();
        let polygons = [vec![0, 1, 2], vec![4, 6, 8], vec![7, 8, 6]];
        assert_eq!(loose_parts(&polygons, &known), [vec![4, 6, 7, 8], vec![3], vec![5]]);
    }
}
