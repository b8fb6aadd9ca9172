//! Binary glTF 2.0 as it grows: numbers one after the other, and what tells where they are.

use super::skin::Skin;
use crate::io::picture::{WEBP, media_type};
use serde_json::{Value, json};

/// Appends a view, aligned to 4 bytes.
fn push(bytes: &mut Vec<u8>, data: impl Iterator<Item = u8>, target: Option<u32>) -> Value {
    let offset = bytes.len();
    bytes.extend(data);
    let length = bytes.len() - offset;
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let mut view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": length });
    if let Some(target) = target {
        view["target"] = json!(target);
    }
    view
}

/// A document as it grows.
#[derive(Default)]
pub(super) struct GlbDocument {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    materials: Vec<Value>,
    textures: Vec<Value>,
    images: Vec<Value>,
    has_webp: bool,
}

// glTF 2.0 numbers things as OpenGL: 34962 ARRAY_BUFFER, 34963 ELEMENT_ARRAY_BUFFER, 5126 FLOAT, 5125 UNSIGNED_INT,
// 10497 REPEAT, 9729 LINEAR, 9987 LINEAR_MIPMAP_LINEAR.
impl GlbDocument {
    fn view(&mut self, data: impl Iterator<Item = u8>, target: Option<u32>) -> usize {
        self.views.push(push(&mut self.bytes, data, target));
        self.views.len() - 1
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Numbers by vertex.
    pub(super) fn attribute(&mut self, values: &[f32], kind: &str, width: usize) -> usize {
        let view = self.view(floats(values), Some(34962));
        self.accessor(
            json!({ "bufferView": view, "componentType": 5126, "count": values.len() / width, "type": kind }),
        )
    }

    /// Adds places by vertex with their bounds.
    pub(super) fn places(&mut self, values: &[f32]) -> usize {
        let number = self.attribute(values, "VEC3", 3);
        let [low, high] = bounds(values);
        self.accessors[number]["min"] = json!(low);
        self.accessors[number]["max"] = json!(high);
        number
    }

    /// Numbers of an animation.
    pub(super) fn numbers(&mut self, values: &[f32]) -> usize {
        let view = self.view(floats(values), None);
        let [low, high] = [f32::min, f32::max].map(|pick| values.iter().copied().reduce(pick));
        self.accessor(json!({
            "bufferView": view, "componentType": 5126, "count": values.len(), "type": "SCALAR",
            "min": [low], "max": [high]
        }))
    }

    fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let view = self.view(triangles.iter().flatten().flat_map(|i| i.to_le_bytes()), Some(34963));
        let count = 3 * triangles.len();
        self.accessor(json!({ "bufferView": view, "componentType": 5125, "count": count, "type": "SCALAR" }))
    }

    /// The primitives of a mesh in a skin, one for each of its parts, each with a material of its own. `attributes` and morph `targets` are
    /// those of all vertices.
    pub(super) fn primitives(&mut self, skin: &Skin, attributes: &Value, targets: &Value) -> Vec<Value> {
        let has_pictures = skin.parts.iter().any(|part| part.picture.is_some());
        let uvs = has_pictures.then(|| self.attribute(skin.uvs.as_flattened(), "VEC2", 2));
        let has_colours = !skin.colours.is_empty();
        let colours = has_colours.then(|| self.attribute(skin.colours.as_flattened(), "VEC3", 3));
        let primitive = |part: &super::skin::SkinPart| {
            let mut attributes = attributes.clone();
            if let Some(uvs) = uvs.filter(|_| part.picture.is_some()) {
                attributes["TEXCOORD_0"] = json!(uvs);
            }
            if let Some(colours) = colours {
                attributes["COLOR_0"] = json!(colours);
            }
            let indices = self.indices(&part.triangles);
            let material = self.material(part.picture.as_deref(), &skin.fallback);
            json!({ "attributes": attributes, "indices": indices, "material": material, "targets": targets })
        };
        skin.parts.iter().map(primitive).collect()
    }

    /// A material with a picture; programs that do not read the picture's format get the other one.
    fn material(&mut self, picture: Option<&[u8]>, fallback: &[u8]) -> usize {
        let mut surface = json!({ "metallicFactor": 0.0, "roughnessFactor": 0.8 });
        if let Some(picture) = picture {
            let mut texture = json!({ "sampler": 0 });
            if media_type(picture) == Some(WEBP) {
                self.has_webp = true;
                texture["extensions"] = json!({ "EXT_texture_webp": { "source": self.image(picture) } });
                texture["source"] = json!(self.image(fallback));
            } else {
                texture["source"] = json!(self.image(picture));
            }
            surface["baseColorTexture"] = json!({ "index": self.textures.len() });
            self.textures.push(texture);
        }
        self.materials.push(json!({ "pbrMetallicRoughness": surface }));
        self.materials.len() - 1
    }

    fn image(&mut self, picture: &[u8]) -> usize {
        let view = self.view(picture.iter().copied(), None);
        let kind = media_type(picture).unwrap_or("image/png");
        self.images.push(json!({ "bufferView": view, "mimeType": kind }));
        self.images.len() - 1
    }

    /// The file with a node and its mesh, and an animation where there is one.
    pub(super) fn into_glb(self, node: Value, mesh: Value, animation: Option<Value>) -> Vec<u8> {
        let mut document = json!({
            "asset": { "version": "2.0", "generator": "Conemap" },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [node],
            "meshes": [mesh],
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.bytes.len() }],
            "materials": self.materials,
        });
        if let Some(animation) = animation {
            document["animations"] = json!([animation]);
        }
        if !self.textures.is_empty() {
            let sampler = json!({ "wrapS": 10497, "wrapT": 10497, "magFilter": 9729, "minFilter": 9987 });
            document["samplers"] = json!([sampler]);
            document["textures"] = Value::Array(self.textures);
            document["images"] = Value::Array(self.images);
        }
        if self.has_webp {
            document["extensionsUsed"] = json!(["EXT_texture_webp"]);
        }
        assemble(document.to_string().into_bytes(), self.bytes)
    }
}

fn floats(values: &[f32]) -> impl Iterator<Item = u8> {
    values.iter().flat_map(|x| x.to_le_bytes())
}

/// Lowest and highest coordinates.
fn bounds(positions: &[f32]) -> [[f32; 3]; 2] {
    let fold = |start: f32, pick: fn(f32, f32) -> f32| {
        positions
            .chunks_exact(3)
            .fold([start; 3], |m, p| [pick(m[0], p[0]), pick(m[1], p[1]), pick(m[2], p[2])])
    };
    [fold(f32::INFINITY, f32::min), fold(f32::NEG_INFINITY, f32::max)]
}

/// Puts what a file has before its binary chunk in front of the chunk's bytes, which are most of it and are not copied.
fn assemble(mut document: Vec<u8>, mut body: Vec<u8>) -> Vec<u8> {
    document.resize(document.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + document.len() + 8 + body.len();
    let mut head = Vec::with_capacity(total - body.len());
    head.extend(b"glTF");
    head.extend(2_u32.to_le_bytes());
    head.extend((total as u32).to_le_bytes());
    head.extend((document.len() as u32).to_le_bytes());
    head.extend(b"JSON");
    head.extend(document);
    head.extend((body.len() as u32).to_le_bytes());
    head.extend(b"BIN\0");
    body.splice(0..0, head);
    body
}
