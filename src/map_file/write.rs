//! Maps to bytes.

use super::container::Sections;
use super::content::MapFile;
use super::file_mesh::FileMesh;
use super::header::{Header, MeshEntry};
use super::numbering::{exchanged_matrix, write_places};
use crate::base_domain::BaseDomain;
use crate::landmarks::MeshSide;
use crate::mesh::FaceId;
use crate::surface_map::correspondence::{Correspondence, TextureDrawing, matrix_of_corners};
use crate::surface_map::flat_layout::{FlatDrawing, FlatLayout};

/// Writes a map between two meshes. The same map gives the same bytes everywhere.
pub fn write(map: &MapFile, meshes: [&FileMesh; 2]) -> Vec<u8> {
    let mut sections = Sections::default();
    write_pieces(&mut sections, &map.correspondence, meshes);
    if let Some(texture) = &map.texture {
        write_texture(&mut sections, texture, meshes[1]);
    }
    if let Some(layout) = &map.layout {
        write_layout(&mut sections, layout, meshes);
    }
    write_base(&mut sections, "base", &map.base);
    let positions: Vec<f64> = map.base.mesh.positions().iter().flat_map(|p| p.to_array()).collect();
    sections.numbers("base.positions", &positions);
    sections.numbers("cones", &map.cones);
    // A value always has JSON.
    sections.bytes("report", &serde_json::to_vec(&map.report).unwrap_or_default());
    sections.into_file(Header {
        generator: concat!("conemap ", env!("CARGO_PKG_VERSION")).to_owned(),
        source: mesh_entry(meshes[0]),
        target: mesh_entry(meshes[1]),
        target_image: meshes[1].image(),
        landmarks: serde_json::to_value(&map.landmarks).unwrap_or_default(),
        options: map.options.clone(),
        summary: map.summary,
        ..Header::default()
    })
}

fn mesh_entry(mesh: &FileMesh) -> MeshEntry {
    MeshEntry {
        bytes: mesh.bytes() as u64,
        sha256: mesh.hash().to_string(),
        checked_sha256: mesh.checked_hash().to_string(),
        vertices: mesh.file_vertices() as u64,
        faces: mesh.mesh().face_count() as u64,
    }
}

fn write_pieces(sections: &mut Sections, map: &Correspondence, meshes: [&FileMesh; 2]) {
    for (side, name) in MeshSide::BOTH.into_iter().zip(["vertices.source", "vertices.target"]) {
        write_places(sections, name, meshes[side], map.vertices.iter().map(|places| places[side]));
    }
    let sizes: Vec<u32> = map.pieces.iter().map(|piece| piece.corners.len() as u32).collect();
    sections.integers("pieces.sizes", &sizes);
    sections.integers("pieces.corners", &map.corners);
    for (side, name) in MeshSide::BOTH.into_iter().zip(["pieces.source_faces", "pieces.target_faces"]) {
        sections.integers(name, &map.pieces.iter().map(|piece| piece.faces[side].0).collect::<Vec<_>>());
    }
    let (mut thin, mut matrices, mut uncertain) = (Vec::new(), Vec::new(), Vec::new());
    let mut rings = [Vec::new(), Vec::new()];
    for (number, piece) in map.pieces.iter().enumerate() {
        for (side, ring) in MeshSide::BOTH.into_iter().zip(&mut rings) {
            map.ring(meshes[side].mesh(), side, piece, ring);
        }
        if matrix_of_corners(&rings[0], &rings[1]).is_none() {
            thin.push(number as u32);
            matrices.extend(exchanged_matrix(meshes, piece.faces, piece.map).to_cols_array());
        }
        if !piece.is_certain {
            uncertain.push(number as u32);
        }
    }
    sections.integers("pieces.thin", &thin);
    sections.numbers("pieces.thin_matrices", &matrices);
    sections.integers("pieces.uncertain", &uncertain);
}

fn write_texture(sections: &mut Sections, texture: &TextureDrawing, target: &FileMesh) {
    write_places(sections, "texture.vertices", target, texture.vertices.iter().map(|v| v.place));
    let uvs: Vec<f64> = texture.vertices.iter().flat_map(|v| v.uv.to_array()).collect();
    sections.numbers("texture.uvs", &uvs);
    sections.integers("texture.triangles", texture.triangles.as_flattened());
    sections.integers("texture.faces", &numbers(&texture.faces));
}

fn write_layout(sections: &mut Sections, layout: &FlatLayout, meshes: [&FileMesh; 2]) {
    write_base(sections, "layout.base", &layout.base);
    sections.numbers("layout.lengths", &layout.lengths.raw);
    for (side, name) in MeshSide::BOTH.into_iter().zip(["layout.source", "layout.target"]) {
        write_drawing(sections, name, &layout.drawings[side], meshes[side]);
    }
}

fn write_base(sections: &mut Sections, name: &str, base: &BaseDomain) {
    let corners: Vec<u32> = base.mesh.triangles().iter().flatten().map(|v| v.0).collect();
    sections.integers(name, &corners);
}

fn write_drawing(sections: &mut Sections, name: &str, drawing: &FlatDrawing, mesh: &FileMesh) {
    write_places(sections, &format!("{name}.vertices"), mesh, drawing.vertices.iter().map(|v| v.place));
    let weights: Vec<f64> = drawing.vertices.iter().flat_map(|v| v.weights).collect();
    sections.numbers(&format!("{name}.weights"), &weights);
    let sizes: Vec<u32> = drawing.polygons.iter().map(|p| p.corners.len() as u32).collect();
    sections.integers(&format!("{name}.sizes"), &sizes);
    sections.integers(&format!("{name}.corners"), &drawing.corners);
    let faces: Vec<FaceId> = drawing.polygons.iter().map(|p| p.face).collect();
    sections.integers(&format!("{name}.faces"), &numbers(&faces));
    let charts: Vec<FaceId> = drawing.polygons.iter().map(|p| p.chart).collect();
    sections.integers(&format!("{name}.charts"), &numbers(&charts));
}

fn numbers(faces: &[FaceId]) -> Vec<u32> {
    faces.iter().map(|f| f.0).collect()
}
