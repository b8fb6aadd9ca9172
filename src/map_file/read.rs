//! Bytes to maps.

use super::container::{Container, fault};
use super::content::MapFile;
use super::error::{MapFileError, SectionProblem};
use super::file_mesh::FileMesh;
use super::header::{Header, MeshEntry};
use super::numbering::{exchanged_matrix, expect_below, expect_count, read_places};
use crate::base_domain::BaseDomain;
use crate::io::landmark_file::{self, LandmarkFile, LandmarkPoint};
use crate::landmarks::MeshSide;
use crate::mesh::mirror::TargetImage;
use crate::mesh::{FaceId, HalfedgeId, SurfaceMesh, VertexId};
use crate::surface_map::correspondence::{
    Correspondence, MappedPiece, TextureDrawing, TextureVertex, check, matrix_of_corners,
};
use crate::surface_map::flat_layout::{FlatDrawing, FlatLayout, FlatPolygon, FlatVertex};
use glam::{DMat2, DVec2, DVec3};
use std::ops::Range;
use typed_index_collections::TiVec;

/// The largest number of corners of a piece: two triangles share a polygon of six.
const MOST_CORNERS: usize = 16;
/// The largest number of cones of a base domain: the landmarks of a file and the program's own.
const MOST_CONES: usize = 2 * landmark_file::MAX_PAIRS;
/// The largest number of pairs of a texture triangle and a piece in the same face: each piece is compared with all triangles of its
/// face. Faces are only cut at landmarks, so that there are a few triangles for each piece.
const MOST_PAIRS_IN_FACES: u64 = 1 << 28;
/// The largest texture coordinate: beyond it, triangles of pictures have no digits left.
const LARGEST_UV: f64 = 1e6;

/// Which image of its target a map file is made for: the meshes that [`read`] takes must be that.
///
/// # Errors
/// [`MapFileError`] of the header.
pub fn target_image(bytes: &[u8]) -> Result<TargetImage, MapFileError> {
    Ok(Container::open(bytes)?.header.target_image)
}

/// A mesh that a map file was made with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WantedMesh {
    /// The name of its file, where the landmarks tell it; it is only text.
    pub name: Option<String>,
    /// [`super::Hash::of_checked`] of the mesh, in hexadecimal digits, if the file is sound.
    pub checked_hash: String,
}

/// The source and the target that a map file was made with, by its header alone.
///
/// # Errors
/// [`MapFileError`] of the header.
pub fn wanted_meshes(bytes: &[u8]) -> Result<[WantedMesh; 2], MapFileError> {
    let Header { source, target, landmarks, .. } = Container::open(bytes)?.header;
    let named = |key: &str| landmarks.get(key).and_then(|name| name.as_str()).map(str::to_owned);
    let wanted = |key, entry: MeshEntry| WantedMesh { name: named(key), checked_hash: entry.checked_sha256 };
    Ok([wanted("source", source), wanted("target", target)])
}

/// Reads a map between two meshes, the target mirrored where [`target_image`] says so.
///
/// # Errors
/// [`MapFileError`], the first fault of the file, or the mesh that it was not made with.
pub fn read(bytes: &[u8], meshes: [&FileMesh; 2]) -> Result<MapFile, MapFileError> {
    let container = Container::open(bytes)?;
    let header = &container.header;
    check_mesh(MeshSide::Source, &header.source, meshes[0])?;
    check_mesh(MeshSide::Target, &header.target, meshes[1])?;
    if header.target_image != meshes[1].image() {
        let problem = "it tells another image of the target".to_owned();
        return Err(MapFileError::Header { problem });
    }
    let landmarks = landmark_file::read(header.landmarks.to_string().as_bytes())
        .map_err(|e| MapFileError::Header { problem: e.to_string() })?;
    check_landmarks(&landmarks, meshes)?;
    let correspondence = read_pieces(&container, meshes)?;
    check(meshes.map(FileMesh::mesh), &correspondence)?;
    let texture = container
        .has("texture.uvs")
        .then(|| read_texture(&container, meshes[1], &correspondence))
        .transpose()?;
    let layout = container.has("layout.base").then(|| read_layout(&container, meshes)).transpose()?;
    Ok(MapFile {
        correspondence,
        texture,
        layout,
        base: read_base_domain(&container)?,
        cones: container.numbers("cones")?,
        landmarks,
        options: header.options.clone(),
        summary: header.summary,
        report: read_report(&container)?,
    })
}

/// The checked mesh decides; the file's own bytes may differ, as where a comment was changed.
fn check_mesh(side: MeshSide, entry: &MeshEntry, mesh: &FileMesh) -> Result<(), MapFileError> {
    if entry.checked_sha256 == mesh.checked_hash().to_string() {
        return Ok(());
    }
    let wanted = entry.sha256.chars().take(64).collect();
    Err(MapFileError::OtherMesh { side, found: mesh.hash().to_string(), wanted })
}

/// Whether the landmarks' vertices and faces exist.
fn check_landmarks(file: &LandmarkFile, meshes: [&FileMesh; 2]) -> Result<(), MapFileError> {
    for (pair, points) in file.pairs.iter().enumerate() {
        for (mesh, point) in meshes.into_iter().zip(points) {
            let exists = match *point {
                LandmarkPoint::Vertex(v) => mesh.checked().numbered_vertex(v as usize).is_ok(),
                LandmarkPoint::OnFace { face, .. } => (face as usize) < mesh.mesh().face_count(),
            };
            if !exists {
                let problem = format!(
                    "landmark pair {} (the first is 1) names a point that its mesh has not",
                    pair + 1
                );
                return Err(MapFileError::Header { problem });
            }
        }
    }
    Ok(())
}

fn read_report(container: &Container<'_>) -> Result<serde_json::Value, MapFileError> {
    let text = container.bytes("report")?;
    serde_json::from_slice(&text).map_err(|_| fault("report", None, SectionProblem::Json))
}

fn read_pieces(container: &Container<'_>, meshes: [&FileMesh; 2]) -> Result<Correspondence, MapFileError> {
    let [source, target] = [("vertices.source", meshes[0]), ("vertices.target", meshes[1])];
    let source_places = read_places(container, source.0, source.1)?;
    let target_places = read_places(container, target.0, target.1)?;
    expect_count("vertices.target.kinds", target_places.len(), source_places.len())?;
    let vertices: Vec<_> = source_places.into_iter().zip(target_places).map(|(s, t)| [s, t]).collect();
    let sizes = container.integers("pieces.sizes")?;
    let corners = container.integers("pieces.corners")?;
    expect_below("pieces.corners", &corners, vertices.len())?;
    expect_below("pieces.sizes", &sizes, MOST_CORNERS + 1)?;
    let ranges = ranges("pieces.sizes", &sizes, corners.len())?;
    let source_faces =
        read_faces(container, "pieces.source_faces", ranges.len(), meshes[0].mesh().face_count())?;
    let target_faces =
        read_faces(container, "pieces.target_faces", ranges.len(), meshes[1].mesh().face_count())?;
    let pieces = ranges.into_iter().zip(source_faces.into_iter().zip(target_faces));
    let piece = |(corners, (source, target))| MappedPiece {
        faces: [source, target],
        corners,
        map: DMat2::ZERO,
        is_certain: true,
    };
    let mut map = Correspondence { vertices, pieces: pieces.map(piece).collect(), corners };
    for k in increasing(container, "pieces.uncertain", map.pieces.len())? {
        map.pieces[k as usize].is_certain = false;
    }
    read_matrices(container, meshes, &mut map)?;
    Ok(map)
}

/// The matrices: from the corners where these tell them, otherwise as given.
fn read_matrices(
    container: &Container<'_>,
    meshes: [&FileMesh; 2],
    map: &mut Correspondence,
) -> Result<(), MapFileError> {
    let thin = increasing(container, "pieces.thin", map.pieces.len())?;
    let entries = container.numbers("pieces.thin_matrices")?;
    expect_count("pieces.thin_matrices", entries.len(), 4 * thin.len())?;
    let mut given = thin.iter().zip(entries.chunks_exact(4)).peekable();
    let mut rings = [Vec::new(), Vec::new()];
    for number in 0..map.pieces.len() {
        let piece = &map.pieces[number];
        let stored = given.next_if(|(k, _)| **k as usize == number);
        let matrix = match stored {
            Some((_, m)) => {
                exchanged_matrix(meshes, piece.faces, DMat2::from_cols_array(&[m[0], m[1], m[2], m[3]]))
            }
            None => {
                for (side, ring) in MeshSide::BOTH.into_iter().zip(&mut rings) {
                    map.ring(meshes[side].mesh(), side, piece, ring);
                }
                let is_whole = rings.iter().all(|ring| ring.len() == piece.corners.len());
                // Pieces with corners elsewhere are refused by the check, which names them.
                let own = if is_whole { matrix_of_corners(&rings[0], &rings[1]) } else { Some(DMat2::ZERO) };
                let missing = || fault("pieces.thin", None, SectionProblem::NoMatrix { piece: number });
                own.ok_or_else(missing)?
            }
        };
        map.pieces[number].map = matrix;
    }
    Ok(())
}

/// A section of numbers that grow, all below a limit.
fn increasing(container: &Container<'_>, name: &str, limit: usize) -> Result<Vec<u32>, MapFileError> {
    let values = container.integers(name)?;
    expect_below(name, &values, limit)?;
    match values.windows(2).position(|pair| pair[0] >= pair[1]) {
        Some(index) => {
            let problem =
                SectionProblem::Range { value: values[index].into(), limit: values[index + 1].into() };
            Err(fault(name, Some(index), problem))
        }
        None => Ok(values),
    }
}

/// The range of each polygon's corners among all corners.
fn ranges(name: &str, sizes: &[u32], corners: usize) -> Result<Vec<Range<usize>>, MapFileError> {
    let mut ranges = Vec::with_capacity(sizes.len());
    let mut begin = 0_usize;
    for (index, &size) in sizes.iter().enumerate() {
        let end = begin.saturating_add(size as usize);
        if end > corners {
            let problem = SectionProblem::Range { value: end as u64, limit: corners as u64 + 1 };
            return Err(fault(name, Some(index), problem));
        }
        ranges.push(begin..end);
        begin = end;
    }
    if begin == corners {
        Ok(ranges)
    } else {
        Err(fault(name, None, SectionProblem::Count { found: begin, expected: corners }))
    }
}

/// A section of face numbers, one for each of `count` elements.
fn read_faces(
    container: &Container<'_>,
    name: &str,
    count: usize,
    limit: usize,
) -> Result<Vec<FaceId>, MapFileError> {
    let values = container.integers(name)?;
    expect_count(name, values.len(), count)?;
    expect_below(name, &values, limit)?;
    Ok(values.into_iter().map(FaceId).collect())
}

fn read_texture(
    container: &Container<'_>,
    target: &FileMesh,
    map: &Correspondence,
) -> Result<TextureDrawing, MapFileError> {
    let places = read_places(container, "texture.vertices", target)?;
    let uvs = container.numbers("texture.uvs")?;
    expect_count("texture.uvs", uvs.len(), 2 * places.len())?;
    if let Some(index) = uvs.iter().position(|uv| uv.abs() > LARGEST_UV) {
        return Err(fault("texture.uvs", Some(index), SectionProblem::Number { value: uvs[index] }));
    }
    let corners = container.integers("texture.triangles")?;
    expect_below("texture.triangles", &corners, places.len())?;
    let (triangles, rest) = corners.as_chunks::<3>();
    expect_count("texture.triangles", corners.len(), corners.len() - rest.len())?;
    let faces = read_faces(container, "texture.faces", triangles.len(), target.mesh().face_count())?;
    check_crowds(&faces, map, target.mesh().face_count())?;
    let vertices = places.into_iter().zip(uvs.chunks_exact(2));
    let vertex = |(place, uv): (_, &[f64])| TextureVertex { place, uv: DVec2::new(uv[0], uv[1]) };
    Ok(TextureDrawing { vertices: vertices.map(vertex).collect(), triangles: triangles.to_vec(), faces })
}

/// Whether texture triangles and pieces that share a face of the target are few enough to compare all of them.
pub(super) fn check_crowds(
    triangles: &[FaceId],
    map: &Correspondence,
    faces: usize,
) -> Result<(), MapFileError> {
    let mut inside: TiVec<FaceId, u64> = vec![0; faces].into();
    triangles.iter().for_each(|&face| inside[face] += 1);
    let pairs = map.pieces.iter().map(|piece| inside[piece.faces[1]]).sum();
    if pairs <= MOST_PAIRS_IN_FACES {
        return Ok(());
    }
    let problem = SectionProblem::Crowded { pairs, limit: MOST_PAIRS_IN_FACES };
    Err(fault("texture.faces", None, problem))
}

fn read_layout(container: &Container<'_>, meshes: [&FileMesh; 2]) -> Result<FlatLayout, MapFileError> {
    let base = read_base(container, "layout.base")?;
    let lengths = container.numbers("layout.lengths")?;
    expect_count("layout.lengths", lengths.len(), 3 * base.mesh.face_count())?;
    check_lengths(&base, &lengths)?;
    let drawings = [
        read_drawing(container, "layout.source", meshes[0], &base)?,
        read_drawing(container, "layout.target", meshes[1], &base)?,
    ];
    Ok(FlatLayout { base, lengths: TiVec::from(lengths), drawings })
}

/// The base domain at the target.
fn read_base_domain(container: &Container<'_>) -> Result<BaseDomain, MapFileError> {
    let base = read_base(container, "base")?;
    let numbers = container.numbers("base.positions")?;
    expect_count("base.positions", numbers.len(), 3 * base.mesh.vertex_count())?;
    let positions = numbers.chunks_exact(3).map(DVec3::from_slice).collect();
    Ok(BaseDomain { mesh: base.mesh.with_positions(positions) })
}

/// The triangles of a base domain, without positions.
fn read_base(container: &Container<'_>, name: &str) -> Result<BaseDomain, MapFileError> {
    let corners = container.integers(name)?;
    let (triangles, rest) = corners.as_chunks::<3>();
    expect_count(name, corners.len(), corners.len() - rest.len())?;
    // A triangulation of the sphere with n triangles has n / 2 + 2 vertices.
    let vertices = triangles.len() / 2 + 2;
    if vertices > MOST_CONES {
        let problem = SectionProblem::Range { value: vertices as u64, limit: MOST_CONES as u64 + 1 };
        return Err(fault(name, None, problem));
    }
    expect_below(name, &corners, vertices)?;
    let faces = triangles.iter().map(|t| t.map(VertexId)).collect();
    let mesh = SurfaceMesh::from_triangles(vec![DVec3::ZERO; vertices].into(), faces).ok();
    let sphere = mesh.filter(|mesh| mesh.euler_characteristic() == 2);
    sphere.map(|mesh| BaseDomain { mesh }).ok_or_else(|| fault(name, None, SectionProblem::Base))
}

/// Whether the base domain's triangles are triangles: positive lengths, the longest below the sum of the others.
fn check_lengths(base: &BaseDomain, lengths: &[f64]) -> Result<(), MapFileError> {
    let wrong = |h: HalfedgeId| {
        fault("layout.lengths", Some(h.index()), SectionProblem::Number { value: lengths[h.index()] })
    };
    for h in base.mesh.halfedges() {
        let [a, b, c] = [h, h.next(), h.prev()].map(|x| lengths[x.index()]);
        let is_triangle = a > 0.0 && a < b + c && a < 1e6;
        let twin = lengths[base.mesh.twin(h).index()];
        if !is_triangle || (a - twin).abs() > 1e-9 * a {
            return Err(wrong(h));
        }
    }
    Ok(())
}

fn read_drawing(
    container: &Container<'_>,
    name: &str,
    mesh: &FileMesh,
    base: &BaseDomain,
) -> Result<FlatDrawing, MapFileError> {
    let [vertices, weights_name, sizes_name, corners_name, faces, charts] =
        ["vertices", "weights", "sizes", "corners", "faces", "charts"].map(|part| format!("{name}.{part}"));
    let places = read_places(container, &vertices, mesh)?;
    let weights = container.numbers(&weights_name)?;
    expect_count(&weights_name, weights.len(), 3 * places.len())?;
    let sound = |w: &&[f64]| w.iter().all(|w| *w >= 0.0) && (w.iter().sum::<f64>() - 1.0).abs() <= 1e-9;
    if let Some(index) = weights.chunks_exact(3).position(|w| !sound(&w)) {
        return Err(fault(&weights_name, Some(index), SectionProblem::Weights));
    }
    let sizes = container.integers(&sizes_name)?;
    let corners = container.integers(&corners_name)?;
    expect_below(&corners_name, &corners, places.len())?;
    let ranges = ranges(&sizes_name, &sizes, corners.len())?;
    let faces = read_faces(container, &faces, ranges.len(), mesh.mesh().face_count())?;
    let charts = read_faces(container, &charts, ranges.len(), base.mesh.face_count())?;
    let polygons = ranges.into_iter().zip(faces.into_iter().zip(charts));
    let polygon = |(corners, (face, chart))| FlatPolygon { face, chart, corners };
    let vertex = |(place, w): (_, &[f64])| FlatVertex { place, weights: [w[0], w[1], w[2]] };
    Ok(FlatDrawing {
        vertices: places.into_iter().zip(weights.chunks_exact(3)).map(vertex).collect(),
        polygons: polygons.map(polygon).collect(),
        corners,
    })
}
