//! Textured meshes as binary glTF 2.0.

use super::glb_document::GlbDocument;
use super::skin::Skin;
use crate::mesh::FileFrame;
use crate::surface_map::measures::transfer::CommonMesh;
use glam::DVec3;
use serde_json::json;

/// Why a file cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum GlbError {
    /// The texture could not be encoded.
    #[error("the texture could not be written: {0}")]
    Texture(#[from] png::EncodingError),
}

/// The source's surface in a skin of its points, with a morph target that turns it into the target's shape (positions and normals), and a
/// value by point as the attribute `_DISTORTION` where there are any. `frames` are those of source and target.
pub fn textured_source(
    common: &CommonMesh,
    distortion: &[f64],
    frames: [FileFrame; 2],
    skin: &Skin,
) -> Vec<u8> {
    let node = NodePlace::of(&common.source_positions, frames[0]);
    let vectors = |values: &[DVec3]| flat(&skin.gathered(values));
    let positions = vectors(&node.local(&common.source_positions));
    let normals = vectors(&common.source_normals);
    let mut document = GlbDocument::default();
    let mut attributes = json!({
        "POSITION": document.places(&positions),
        "NORMAL": document.attribute(&normals, "VEC3", 3)
    });
    if distortion.len() == common.source_positions.len() {
        let values: Vec<f32> = skin.gathered(distortion).into_iter().map(|d| d as f32).collect();
        attributes["_DISTORTION"] = json!(document.attribute(&values, "SCALAR", 1));
    }
    // A morph target holds differences: with the weight 1 the sum is the target's.
    let moves = difference(&skin.gathered(&node.target(&common.target_positions, frames)), &positions);
    let turns = difference(&skin.gathered(&common.target_normals), &normals);
    let targets = json!([{
        "POSITION": document.places(&moves),
        "NORMAL": document.attribute(&turns, "VEC3", 3)
    }]);
    let mesh = json!({
        "primitives": document.primitives(skin, &attributes, &targets),
        "weights": [0.0],
        "extras": { "targetNames": ["target"] }
    });
    document.into_glb(node.json(), mesh, None)
}

/// The place of the node: a surface far from the origin has its own origin in the node, so that its positions keep all 24 bits of f32 for
/// its shape.
pub(super) struct NodePlace {
    /// The node's origin, in the source's coordinates.
    origin: DVec3,
    frame: FileFrame,
}

impl NodePlace {
    pub(super) fn of(positions: &[DVec3], frame: FileFrame) -> Self {
        let [low, high] = box_of(positions);
        let (middle, size) = (0.5 * (low + high), (high - low).max_element());
        let is_far = middle.abs().max_element() > size && middle.is_finite();
        Self { origin: if is_far { middle } else { DVec3::ZERO }, frame }
    }

    pub(super) fn local(&self, positions: &[DVec3]) -> Vec<DVec3> {
        positions.iter().map(|p| *p - self.origin).collect()
    }

    /// The target's positions: where it lies, or, where that is too far from the source or of a size too different for f32, moved
    /// to the source in its own units.
    fn target(&self, positions: &[DVec3], [source, target]: [FileFrame; 2]) -> Vec<DVec3> {
        // The farthest that the target may lie from the origin, in units of its own size: f32 then has half of its 24 bits for the shape.
        const FARTHEST: f64 = 4096.0;
        // The largest ratio of both meshes' scales. Chosen by hand.
        const RATIO: f64 = (1 << 12) as f64;
        if source == target {
            return self.local(positions);
        }
        let [low, high] = box_of(positions);
        let (size, ratio) = ((high - low).max_element(), target.scale() / source.scale());
        let in_place = |p: &DVec3| source.on_mesh(target.in_file(*p)) - self.origin;
        if (1.0 / RATIO..=RATIO).contains(&ratio)
            && positions.iter().all(|p| in_place(p).abs().max_element() <= FARTHEST * size * ratio)
        {
            return positions.iter().map(in_place).collect();
        }
        let middle = 0.5 * (low + high);
        positions.iter().map(|p| *p - middle).collect()
    }

    pub(super) fn json(&self) -> serde_json::Value {
        let mut node = json!({ "mesh": 0, "name": "source" });
        let translation = self.frame.in_file(self.origin);
        if translation != DVec3::ZERO {
            node["translation"] = json!(translation.to_array());
        }
        if self.frame.scale() != 1.0 {
            let scale = self.frame.scale();
            node["scale"] = json!([scale, scale, scale]);
        }
        node
    }
}

/// The lowest and the highest coordinates.
fn box_of(positions: &[DVec3]) -> [DVec3; 2] {
    let corners = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    positions.iter().fold(corners, |[low, high], p| [low.min(*p), high.max(*p)])
}

pub(super) fn flat(points: &[DVec3]) -> Vec<f32> {
    points.iter().flat_map(|p| p.to_array().map(|x| x as f32)).collect()
}

/// The differences, in f32, that give points when they are added to numbers in f32.
pub(super) fn difference(points: &[DVec3], from: &[f32]) -> Vec<f32> {
    let there = points.iter().flat_map(|p| p.to_array());
    there.zip(from).map(|(there, &here)| (there - f64::from(here)) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::read_mesh;
    use crate::mesh::generators::octahedron;
    use glam::DVec2;

    /// The JSON of a GLB, and where its binary chunk begins.
    fn document(bytes: &[u8]) -> (serde_json::Value, usize) {
        let length = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
        (serde_json::from_slice(&bytes[20..20 + length]).unwrap(), 28 + length)
    }

    /// Triples of an accessor of a GLB.
    fn triples(bytes: &[u8], accessor: &serde_json::Value) -> Vec<[f32; 3]> {
        let (document, binary) = document(bytes);
        let accessor = &document["accessors"][accessor.as_u64().unwrap() as usize];
        assert_eq!((&accessor["type"], &accessor["componentType"]), (&json!("VEC3"), &json!(5126)));
        let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let begin = binary + view["byteOffset"].as_u64().unwrap() as usize;
        let values = bytes[begin..begin + view["byteLength"].as_u64().unwrap() as usize].chunks_exact(4);
        let values: Vec<f32> = values.map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        assert_eq!(values.len() as u64, 3 * accessor["count"].as_u64().unwrap());
        values.as_chunks::<3>().0.to_vec()
    }

    /// Positions and normals with the morph target's whole weight.
    fn morphed(bytes: &[u8]) -> [Vec<[f32; 3]>; 2] {
        let mesh = &document(bytes).0["meshes"][0];
        assert_eq!((&mesh["weights"], &mesh["extras"]["targetNames"]), (&json!([0.0]), &json!(["target"])));
        let primitive = &mesh["primitives"][0];
        ["POSITION", "NORMAL"].map(|name| {
            let base = triples(bytes, &primitive["attributes"][name]);
            let added = triples(bytes, &primitive["targets"][0][name]);
            base.iter().zip(added).map(|(p, d)| [0, 1, 2].map(|k| p[k] + d[k])).collect()
        })
    }

    #[test]
    fn the_reader_reads_it_back() {
        let mesh = octahedron();
        let positions: Vec<_> = mesh.positions().iter().copied().collect();
        let target: Vec<DVec3> = positions.iter().map(|p: &DVec3| *p * 1.5 + DVec3::X).collect();
        let common = CommonMesh {
            source_normals: positions.clone(),
            target_positions: target,
            target_normals: positions.iter().map(|p| -*p).collect(),
            uvs: vec![DVec2::ZERO; 6],
            triangles: mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect(),
            pieces: (0..8).collect(),
            faces: Vec::new(),
            source_positions: positions,
        };
        let skin = Skin::checkerboard(&common).unwrap();
        for distortion in [&[][..], &[1.0, 1.5, 2.0, 1.0, 1.25, 3.0]] {
            let bytes = textured_source(&common, distortion, [FileFrame::default(); 2], &skin);
            let soup = read_mesh(&bytes).unwrap();
            assert_eq!((soup.positions.len(), soup.polygons.len()), (6, 8));
            let named = bytes.windows(11).any(|word| word == b"_DISTORTION");
            assert_eq!(named, !distortion.is_empty());
            let values: Vec<u8> = distortion.iter().flat_map(|&d| (d as f32).to_le_bytes()).collect();
            assert!(bytes.windows(values.len().max(1)).any(|part| part == values) || values.is_empty());
            let singles = |points: &[DVec3]| -> Vec<[f32; 3]> {
                points.iter().map(|p| p.to_array().map(|x| x as f32)).collect()
            };
            let expected = [singles(&common.target_positions), singles(&common.target_normals)];
            assert_eq!(morphed(&bytes), expected);
        }
    }

    #[test]
    fn a_shape_far_from_the_origin_keeps_the_bits_of_f32() {
        let mesh = octahedron();
        let shift = DVec3::new(1e8, -2e8, 3.0);
        let places = |factor: f64| -> Vec<DVec3> {
            mesh.positions().iter().map(|p| *p * DVec3::new(0.3, 0.7, 1.1) * factor + shift).collect()
        };
        let common = CommonMesh {
            source_normals: places(1.0),
            target_positions: places(2.0),
            target_normals: places(1.0),
            uvs: vec![DVec2::ZERO; 6],
            triangles: mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect(),
            pieces: (0..8).collect(),
            faces: Vec::new(),
            source_positions: places(1.0),
        };
        let bytes =
            textured_source(&common, &[], [FileFrame::default(); 2], &Skin::checkerboard(&common).unwrap());
        let soup = read_mesh(&bytes).unwrap();
        // f64 at 2e8 has steps of 3e-8.
        for (read, given) in soup.positions.iter().zip(&common.source_positions) {
            assert!((*read - *given).abs().max_element() <= 1e-7, "{read} {given}");
        }
        let [places, _] = morphed(&bytes);
        for (p, given) in places.iter().zip(&common.target_positions) {
            let there = DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2])) + shift;
            assert!((there - *given).abs().max_element() < 5e-7, "{there} {given}");
        }
    }
}
