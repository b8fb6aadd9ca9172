//! A small map file with all parts that one may hold: the identity of a mesh, written by the program.

use conemap::base_domain::BaseDomain;
use conemap::io::landmark_file::{LandmarkFile, LandmarkPoint};
use conemap::map_file::{FileMesh, MapFile, Summary, write};
use conemap::mesh::{FaceId, HalfedgeId, Place, SurfaceMesh};
use conemap::surface_map::correspondence::{Correspondence, MappedPiece, TextureDrawing, TextureVertex};
use conemap::surface_map::flat_layout::{FlatDrawing, FlatLayout, FlatPolygon, FlatVertex};
use glam::{DMat2, DVec2};

/// The bytes of the map file.
pub fn bytes(file: &FileMesh) -> Vec<u8> {
    let mesh = file.mesh();
    let map = MapFile {
        correspondence: pieces(mesh),
        texture: Some(texture(mesh)),
        layout: Some(layout(mesh)),
        base: BaseDomain { mesh: mesh.clone() },
        cones: vec![0.5; 4],
        landmarks: LandmarkFile {
            pairs: (0..4).map(|v| [LandmarkPoint::Vertex(v); 2]).collect(),
            ..LandmarkFile::default()
        },
        options: serde_json::json!({ "method": "relaxed" }),
        summary: Summary { energy: 4.0, ..Summary::default() },
        report: serde_json::json!({ "faces": { "source": mesh.face_count() } }),
    };
    write(&map, [file; 2])
}

/// The pieces of the identity: the faces, of which two are cut from a point on their common edge to the opposite corners, and a piece
/// without area along another edge.
fn pieces(mesh: &SurfaceMesh) -> Correspondence {
    let halfedge = HalfedgeId::of(FaceId(3), 1);
    let mut vertices: Vec<[Place; 2]> = mesh.vertices().map(|v| [Place::Vertex(v); 2]).collect();
    let new = vertices.len() as u32;
    vertices.push([Place::on_edge(mesh, halfedge, 0.3); 2]);
    let mut rings: Vec<(FaceId, Vec<u32>)> = Vec::new();
    for (face, corners) in mesh.triangles().iter_enumerated() {
        match [halfedge, mesh.twin(halfedge)].into_iter().find(|h| h.face() == face) {
            Some(h) => {
                let [tail, head, apex] = [h, h.next(), h.prev()].map(|h| mesh.tail(h).0);
                rings.extend([(face, vec![tail, new, apex]), (face, vec![new, head, apex])]);
            }
            None => rings.push((face, corners.iter().map(|v| v.0).collect())),
        }
    }
    let side = mesh.triangles()[FaceId(0)];
    rings.push((FaceId(0), vec![side[0].0, side[1].0]));
    let mut map = Correspondence { vertices, ..Correspondence::default() };
    for (face, ring) in rings {
        let begin = map.corners.len();
        map.corners.extend(ring);
        let corners = begin..map.corners.len();
        let is_certain = face != FaceId(5);
        map.pieces.push(MappedPiece { faces: [face; 2], corners, map: DMat2::IDENTITY, is_certain });
    }
    map
}

fn texture(mesh: &SurfaceMesh) -> TextureDrawing {
    let uv = |v: usize| DVec2::new(v as f64 * 0.01, 1.0 / (1.0 + v as f64));
    let vertex = |v: conemap::mesh::VertexId| TextureVertex { place: Place::Vertex(v), uv: uv(v.index()) };
    TextureDrawing {
        vertices: mesh.vertices().map(vertex).collect(),
        triangles: mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect(),
        faces: mesh.faces().collect(),
    }
}

fn layout(mesh: &SurfaceMesh) -> FlatLayout {
    let mut drawing = FlatDrawing::default();
    for (face, corners) in mesh.triangles().iter_enumerated() {
        let begin = drawing.corners.len();
        for (k, &v) in corners.iter().enumerate() {
            let mut weights = [0.0; 3];
            weights[k] = 1.0;
            drawing.corners.push(drawing.vertices.len() as u32);
            drawing.vertices.push(FlatVertex { place: Place::Vertex(v), weights });
        }
        drawing.polygons.push(FlatPolygon { face, chart: face, corners: begin..drawing.corners.len() });
    }
    FlatLayout {
        lengths: mesh.halfedges().map(|h| mesh.length(h)).collect(),
        base: BaseDomain { mesh: mesh.clone() },
        drawings: [drawing.clone(), drawing],
    }
}
