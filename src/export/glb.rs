//! Textured meshes as binary glTF 2.0, with a checkerboard inside.

use crate::mesh::FileFrame;
use crate::surface_map::measures::transfer::CommonMesh;
use glam::{DVec2, DVec3};
use serde_json::json;

/// Squares of the checkerboard along one unit of texture coordinates (the whole surface has area 1 there).
const SQUARES: f64 = 24.0;

/// Why a file cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum GlbError {
    /// The texture could not be encoded.
    #[error("the texture could not be written: {0}")]
    Texture(#[from] png::EncodingError),
}

/// The source's surface with the target's texture, a morph target that turns it into the target's shape (positions and normals),
/// and a value by vertex as the attribute `_DISTORTION` where there are any. `frames` are those of source and target.
///
/// # Errors
/// [`GlbError`].
pub fn textured_source(
    common: &CommonMesh,
    distortion: &[f64],
    frames: [FileFrame; 2],
) -> Result<Vec<u8>, GlbError> {
    let node = NodePlace::of(&common.source_positions, frames[0]);
    let positions: Vec<f32> = flat(&node.local(&common.source_positions));
    let target_positions = node.target(&common.target_positions, frames);
    let normals: Vec<f32> = flat(&common.source_normals);
    let uvs: Vec<f32> = common.uvs.iter().flat_map(|uv| square_uvs(*uv)).collect();
    let indices: Vec<u8> = common.triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
    let image = checkerboard()?;
    let vertices = common.source_positions.len();
    let mut body = Body::default();
    // glTF 2.0 numbers things as OpenGL: 34962 ARRAY_BUFFER, 34963 ELEMENT_ARRAY_BUFFER, 5126 FLOAT, 5125 UNSIGNED_INT,
    // 10497 REPEAT, 9729 LINEAR, 9987 LINEAR_MIPMAP_LINEAR.
    let mut views = vec![
        body.push(&floats(&positions), Some(34962)),
        body.push(&floats(&normals), Some(34962)),
        body.push(&floats(&uvs), Some(34962)),
        body.push(&indices, Some(34963)),
        body.push(&image, None),
    ];
    let accessor = |view: usize, kind: &str| json!({ "bufferView": view, "componentType": 5126, "count": vertices, "type": kind });
    let bounded = |view: usize, values: &[f32]| {
        let [low, high] = bounds(values);
        let mut accessor = accessor(view, "VEC3");
        accessor["min"] = json!(low);
        accessor["max"] = json!(high);
        accessor
    };
    let first = bounded(0, &positions);
    let indices = json!({ "bufferView": 3, "componentType": 5125, "count": common.triangles.len() * 3, "type": "SCALAR" });
    let mut attributes = json!({ "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 });
    let mut accessors = vec![first, accessor(1, "VEC3"), accessor(2, "VEC2"), indices];
    if distortion.len() == vertices {
        let values: Vec<f32> = distortion.iter().map(|&d| d as f32).collect();
        views.push(body.push(&floats(&values), Some(34962)));
        attributes["_DISTORTION"] = json!(accessors.len());
        accessors.push(accessor(views.len() - 1, "SCALAR"));
    }
    // A morph target holds differences: with the weight 1 the sum is the target's.
    let morph = [difference(&target_positions, &positions), difference(&common.target_normals, &normals)];
    let targets = accessors.len();
    for (k, values) in morph.iter().enumerate() {
        let view = views.len();
        views.push(body.push(&floats(values), Some(34962)));
        accessors.push(if k == 0 { bounded(view, values) } else { accessor(view, "VEC3") });
    }
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "Conemap" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [node.json()],
        "meshes": [{
            "primitives": [{
                "attributes": attributes, "indices": 3, "material": 0,
                "targets": [{ "POSITION": targets, "NORMAL": targets + 1 }]
            }],
            "weights": [0.0],
            "extras": { "targetNames": ["target"] }
        }],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{ "byteLength": body.bytes.len() }],
    });
    lay_picture(&mut document, 4);
    Ok(assemble(document.to_string().into_bytes(), body.bytes))
}

/// Gives a document the material 0, on which the picture of a buffer view is repeated.
pub(super) fn lay_picture(document: &mut serde_json::Value, view: usize) {
    document["materials"] = json!([{ "pbrMetallicRoughness": {
        "baseColorTexture": { "index": 0 }, "metallicFactor": 0.0, "roughnessFactor": 0.8
    } }]);
    document["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    document["samplers"] = json!([{ "wrapS": 10497, "wrapT": 10497, "magFilter": 9729, "minFilter": 9987 }]);
    document["images"] = json!([{ "bufferView": view, "mimeType": "image/png" }]);
}

/// Where the node lies: a surface far from the origin has its own origin in the node, so that its positions keep all 24 bits of f32
/// for its shape.
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
        const FARTHEST: f64 = 4096.0;
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

/// Two squares of the board make one period of the texture.
pub(super) fn square_uvs(uv: DVec2) -> [f32; 2] {
    (uv * (0.5 * SQUARES)).to_array().map(|x| x as f32)
}

pub(super) fn flat(points: &[DVec3]) -> Vec<f32> {
    points.iter().flat_map(|p| p.to_array().map(|x| x as f32)).collect()
}

/// What is added to numbers in f32 to give points.
pub(super) fn difference(points: &[DVec3], from: &[f32]) -> Vec<f32> {
    let there = points.iter().flat_map(|p| p.to_array());
    there.zip(from).map(|(there, &here)| (there - f64::from(here)) as f32).collect()
}

pub(super) fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// Lowest and highest coordinates.
pub(super) fn bounds(positions: &[f32]) -> [[f32; 3]; 2] {
    let fold = |start: f32, pick: fn(f32, f32) -> f32| {
        positions
            .chunks_exact(3)
            .fold([start; 3], |m, p| [pick(m[0], p[0]), pick(m[1], p[1]), pick(m[2], p[2])])
    };
    [fold(f32::INFINITY, f32::min), fold(f32::NEG_INFINITY, f32::max)]
}

#[derive(Default)]
pub(super) struct Body {
    pub(super) bytes: Vec<u8>,
}

impl Body {
    /// Appends a view, aligned to 4 bytes.
    pub(super) fn push(&mut self, data: &[u8], target: Option<u32>) -> serde_json::Value {
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(data);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": data.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        view
    }
}

pub(super) fn assemble(mut document: Vec<u8>, body: Vec<u8>) -> Vec<u8> {
    document.resize(document.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + document.len() + 8 + body.len();
    let mut bytes = Vec::with_capacity(total);
    bytes.extend(b"glTF");
    bytes.extend(2_u32.to_le_bytes());
    bytes.extend((total as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", document), (b"BIN\0", body)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

/// Two by two squares, 64 pixels each.
pub(super) fn checkerboard() -> Result<Vec<u8>, png::EncodingError> {
    const SIZE: u32 = 128;
    let shade =
        |x: u32, y: u32| if (x < SIZE / 2) == (y < SIZE / 2) { [240, 240, 235] } else { [52, 98, 140] };
    let pixels: Vec<u8> = (0..SIZE * SIZE).flat_map(|k| shade(k % SIZE, k / SIZE)).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIZE, SIZE);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::read_mesh;
    use crate::mesh::generators::octahedron;

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
        for distortion in [&[][..], &[1.0, 1.5, 2.0, 1.0, 1.25, 3.0]] {
            let bytes = textured_source(&common, distortion, [FileFrame::default(); 2]).unwrap();
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
        let bytes = textured_source(&common, &[], [FileFrame::default(); 2]).unwrap();
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
