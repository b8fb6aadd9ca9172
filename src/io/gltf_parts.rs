//! glTF files whose buffers and textures are files of their own: the names of these files, and all of them packed into one GLB.

use super::data_uri;
use super::picture::media_type;
use super::reading::unmarked;
use super::{Format, MAX_BYTES, Place, ReadError, detect};
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// The files that a glTF file names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GltfParts {
    /// The names of buffers, without which the file cannot be read.
    pub buffers: Vec<String>,
    /// The names of pictures of its textures.
    pub images: Vec<String>,
}

impl GltfParts {
    /// Whether the file names no other.
    pub fn is_empty(&self) -> bool {
        self.buffers.is_empty() && self.images.is_empty()
    }
}

/// A glTF file packed with its parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PackedGltf {
    /// A GLB that needs no other file.
    pub bytes: Vec<u8>,
    /// Pictures that were not found and are left out.
    pub missing_images: Vec<String>,
}

/// The files that a mesh file names, decoded from their addresses; none for other formats and for files that cannot be read.
pub fn parts_of(bytes: &[u8]) -> GltfParts {
    let Some(root) = text_gltf(bytes) else {
        return GltfParts::default();
    };
    let names = |list: &str| entries(&root, list).iter().filter_map(external_name).collect();
    GltfParts { buffers: names("buffers"), images: names("images") }
}

/// Packs a glTF file and the files that it names, which `find` gives by name, into one GLB; what it holds itself stays.
///
/// # Errors
/// [`ReadError::Malformed`] with the names of the buffers that were not found or are too short, [`ReadError::TooLarge`].
pub fn packed<'a>(bytes: &[u8], find: impl Fn(&str) -> Option<&'a [u8]>) -> Result<PackedGltf, ReadError> {
    let malformed =
        |problem: String| ReadError::Malformed { format: Format::Gltf, place: Place::Header, problem };
    let mut root = text_gltf(bytes).ok_or_else(|| malformed("it is no glTF text file".into()))?;
    let mut packer = Packer::default();
    let missing: Vec<_> = parts_of(bytes).buffers.into_iter().filter(|name| find(name).is_none()).collect();
    if !missing.is_empty() {
        return Err(malformed(format!(
            "its data is in other files that are missing: {}",
            missing.join(", ")
        )));
    }
    let mut starts = Vec::new();
    // A file that several buffers name is packed once.
    let mut packed = BTreeMap::new();
    for buffer in entries(&root, "buffers") {
        let name = external_name(buffer);
        let content = match &name {
            Some(name) => find(name).unwrap_or_default().into(),
            None => Cow::Owned(embedded(buffer).map_err(malformed)?),
        };
        let announced = buffer.get("byteLength").and_then(Value::as_u64).unwrap_or(0);
        if announced > content.len() as u64 {
            let name = name.unwrap_or_else(|| "its embedded buffer".to_owned());
            let problem = format!("{name} has {} bytes of {announced}: it may be cut off", content.len());
            return Err(malformed(problem));
        }
        let start = match name.as_ref().and_then(|name| packed.get(name)) {
            Some(start) => *start,
            None => packer.add(&content)?,
        };
        packed.extend(name.map(|name| (name, start)));
        starts.push(start);
    }
    move_views(&mut root, &starts).map_err(malformed)?;
    let missing_images = pack_images(&mut root, &mut packer, find)?;
    root.insert("buffers".into(), json!([{ "byteLength": packer.bytes.len() }]));
    Ok(PackedGltf { bytes: glb(&root, packer.bytes)?, missing_images })
}

/// The root of a glTF file in text form.
fn text_gltf(bytes: &[u8]) -> Option<Map<String, Value>> {
    if bytes.len() > MAX_BYTES || bytes.starts_with(b"glTF") || detect(bytes) != Some(Format::Gltf) {
        return None;
    }
    serde_json::from_slice(&unmarked(bytes)).ok()
}

fn entries<'a>(root: &'a Map<String, Value>, list: &str) -> &'a [Value] {
    root.get(list).and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default()
}

/// The name of the file in which a buffer or picture is; `None` where it is in the file itself.
fn external_name(entry: &Value) -> Option<String> {
    let uri = entry.get("uri")?.as_str()?;
    (!uri.starts_with("data:")).then(|| decoded(uri))
}

/// An address with its `%20` and the like as the bytes they stand for.
fn decoded(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        let digits = tail.get(..2).and_then(|digits| std::str::from_utf8(digits).ok());
        let code = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        match (first, code) {
            (b'%', Some(code)) => {
                bytes.push(code);
                rest = &tail[2..];
            }
            _ => {
                bytes.push(first);
                rest = tail;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The contents of a buffer that is in the file itself.
fn embedded(buffer: &Value) -> Result<Vec<u8>, String> {
    let uri = buffer.get("uri").and_then(Value::as_str).ok_or("a buffer has no data")?;
    let decoded = data_uri::data(uri).ok_or("an embedded buffer is not in base64")?;
    decoded.map_err(|e| format!("its embedded buffer is damaged: {e}"))
}

/// The one buffer of a GLB.
#[derive(Default)]
pub(super) struct Packer {
    pub(super) bytes: Vec<u8>,
}

impl Packer {
    /// Adds content and returns the offset at which it begins: a multiple of 4, as accessors need it.
    pub(super) fn add(&mut self, content: &[u8]) -> Result<usize, ReadError> {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let start = self.bytes.len();
        if start + content.len() > MAX_BYTES {
            return Err(ReadError::TooLarge { bytes: start + content.len() });
        }
        self.bytes.extend_from_slice(content);
        Ok(start)
    }
}

/// Views of any buffer become views of the one buffer.
fn move_views(root: &mut Map<String, Value>, starts: &[usize]) -> Result<(), String> {
    let Some(Value::Array(views)) = root.get_mut("bufferViews") else {
        return Ok(());
    };
    for view in views.iter_mut().filter_map(Value::as_object_mut) {
        let number = view.get("buffer").and_then(Value::as_u64).and_then(|n| usize::try_from(n).ok());
        let start = number.and_then(|n| starts.get(n)).ok_or("a view names a buffer that is not there")?;
        let offset = view.get("byteOffset").and_then(Value::as_u64).unwrap_or(0);
        view.insert("buffer".into(), json!(0));
        view.insert("byteOffset".into(), json!(offset.saturating_add(*start as u64)));
    }
    Ok(())
}

/// Pictures of other files become views; the names of those that were not found.
fn pack_images<'a>(
    root: &mut Map<String, Value>,
    packer: &mut Packer,
    find: impl Fn(&str) -> Option<&'a [u8]>,
) -> Result<Vec<String>, ReadError> {
    let mut views = entries(root, "bufferViews").to_vec();
    let mut packed = BTreeMap::new();
    let mut missing = Vec::new();
    let Some(Value::Array(images)) = root.get_mut("images") else {
        return Ok(missing);
    };
    for image in images {
        let Some(name) = external_name(image) else { continue };
        let Some(content) = find(&name) else {
            missing.push(name);
            continue;
        };
        let start = match packed.get(&name) {
            Some(start) => *start,
            None => packer.add(content)?,
        };
        packed.insert(name.clone(), start);
        let kind = media_type(content).unwrap_or("image/png");
        views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": content.len() }));
        *image = json!({ "bufferView": views.len() - 1, "mimeType": kind, "name": name });
    }
    root.insert("bufferViews".into(), Value::Array(views));
    Ok(missing)
}

/// The two chunks of a GLB.
pub(super) fn glb(root: &Map<String, Value>, mut buffer: Vec<u8>) -> Result<Vec<u8>, ReadError> {
    let mut text = serde_json::to_vec(root).unwrap_or_default();
    text.resize(text.len().next_multiple_of(4), b' ');
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let total = 12 + 8 + text.len() + 8 + buffer.len();
    if total > MAX_BYTES {
        return Err(ReadError::TooLarge { bytes: total });
    }
    let mut bytes = Vec::with_capacity(total);
    bytes.extend_from_slice(b"glTF");
    for word in [2, total as u32, text.len() as u32] {
        bytes.extend_from_slice(&word.to_le_bytes());
    }
    bytes.extend_from_slice(b"JSON");
    bytes.extend_from_slice(&text);
    bytes.extend_from_slice(&(buffer.len() as u32).to_le_bytes());
    bytes.extend_from_slice(b"BIN\0");
    bytes.extend_from_slice(&buffer);
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::read_mesh;
    use crate::math::random::SplitMix;

    /// A tetrahedron: positions in one file, indices in another, and a texture.
    fn parts() -> (String, Vec<u8>, Vec<u8>) {
        let p: [f32; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let positions = p.iter().flat_map(|x| x.to_le_bytes()).collect();
        // The length is not a multiple of 4, so that the next part has to move.
        let indices = vec![9, 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];
        let text = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
            "accessors":[{"bufferView":1,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
                {"bufferView":0,"byteOffset":1,"componentType":5121,"count":12,"type":"SCALAR"}],
            "bufferViews":[{"buffer":0,"byteLength":13},{"buffer":1,"byteLength":48}],
            "images":[{"uri":"skin%20of%20cat.png"},{"uri":"lost.jpg"}],
            "buffers":[{"byteLength":13,"uri":"a/indices.bin"},{"byteLength":48,"uri":"positions.bin"}]}"#;
        (text.to_owned(), positions, indices)
    }

    #[test]
    fn a_gltf_file_is_read_with_the_files_that_it_names() {
        let (text, positions, indices) = parts();
        let names = parts_of(text.as_bytes());
        assert_eq!(names.buffers, ["a/indices.bin", "positions.bin"]);
        assert_eq!(names.images, ["skin of cat.png", "lost.jpg"]);
        let alone = read_mesh(text.as_bytes()).unwrap_err().to_string();
        assert!(alone.contains("a/indices.bin"), "{alone}");
        let png = b"\x89PNG picture".as_slice();
        let find = |name: &str| match name {
            "a/indices.bin" => Some(&indices[..]),
            "positions.bin" => Some(&positions[..]),
            "skin of cat.png" => Some(png),
            _ => None,
        };
        let file = packed(text.as_bytes(), find).unwrap();
        assert_eq!(file.missing_images, ["lost.jpg"]);
        let soup = read_mesh(&file.bytes).unwrap();
        assert_eq!(soup.positions.len(), 4);
        assert_eq!(soup.polygons, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]].map(|t| t.to_vec()));
        assert!(file.bytes.windows(png.len()).any(|window| window == png));
        // What needs nothing names nothing.
        assert!(parts_of(&file.bytes).is_empty());
        assert!(parts_of(b"OFF\n4 4 6\n").is_empty());
    }

    #[test]
    fn embedded_buffers_are_packed_as_they_are_read() {
        let (text, positions, indices) = parts();
        use base64::Engine;
        let engine = base64::engine::general_purpose::URL_SAFE_NO_PAD;
        let uri = format!("data:application/octet-stream;base64,{}", engine.encode(&indices));
        let text = text.replace("a/indices.bin", &uri);
        let find = |name: &str| (name == "positions.bin").then_some(&positions[..]);
        let file = packed(text.as_bytes(), find).unwrap();
        assert_eq!(read_mesh(&file.bytes).unwrap().polygons.len(), 4);
    }

    #[test]
    fn missing_and_short_parts_are_named() {
        let (text, positions, indices) = parts();
        let says = |find: &dyn Fn(&str) -> Option<Vec<u8>>| {
            let files: Vec<_> =
                parts_of(text.as_bytes()).buffers.into_iter().map(|name| (find(&name), name)).collect();
            let find = |wanted: &str| {
                files.iter().find(|(_, name)| name == wanted).and_then(|(content, _)| content.as_deref())
            };
            packed(text.as_bytes(), find).unwrap_err().to_string()
        };
        assert_eq!(
            says(&|_| None),
            "glTF file, header: its data is in other files that are missing: a/indices.bin, positions.bin"
        );
        let short = says(&|name| {
            Some(if name == "positions.bin" { positions[..40].to_vec() } else { indices.clone() })
        });
        assert_eq!(short, "glTF file, header: positions.bin has 40 bytes of 48: it may be cut off");
    }

    #[test]
    fn damaged_files_never_panic() {
        let (text, positions, indices) = parts();
        let mut random = SplitMix::new(3);
        let mut number = |below: usize| (random.unit() * below as f64) as usize;
        for _ in 0..3000 {
            let mut bytes = text.clone().into_bytes();
            for _ in 0..number(4) {
                let place = number(bytes.len());
                bytes[place] = number(256) as u8;
            }
            let _ = parts_of(&bytes);
            let find = |name: &str| Some(if name.contains("pos") { &positions[..] } else { &indices[..] });
            if let Ok(file) = packed(&bytes, find) {
                let _ = read_mesh(&file.bytes);
            }
        }
    }
}
