//! The JSON of a glTF file as far as a mesh needs it, checked before anything of it is followed: numbers of elements, the
//! tree of nodes, ranges of bytes, kinds.
//!
//! The library `gltf` looks numbers up before it knows that they are there, and makes much of small elements. So it follows
//! only what was checked here, and gets no more than accessors, views and buffers (`super::gltf_library`).

use serde::Deserialize;

/// The largest number of nodes; a file with more is refused, and a scene with one surface has a few.
const MAX_NODES: usize = 100_000;

/// The root.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase", default)]
#[derive(Default)]
pub(super) struct Document {
    asset: Asset,
    scene: Option<usize>,
    scenes: Vec<Scene>,
    pub(super) nodes: Vec<Node>,
    pub(super) meshes: Vec<Mesh>,
    pub(super) accessors: Vec<Accessor>,
    pub(super) buffer_views: Vec<View>,
    pub(super) buffers: Vec<Buffer>,
    extensions_required: Vec<String>,
    extensions_used: Vec<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Asset {
    version: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Scene {
    nodes: Vec<usize>,
}

/// A node. Boxed, since a file may have many that have nothing.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Node {
    children: Vec<usize>,
    pub(super) mesh: Option<usize>,
    pub(super) matrix: Option<Box<[f64; 16]>>,
    pub(super) translation: Option<Box<[f64; 3]>>,
    pub(super) rotation: Option<Box<[f64; 4]>>,
    pub(super) scale: Option<Box<[f64; 3]>>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Mesh {
    pub(super) primitives: Vec<Primitive>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Primitive {
    #[serde(default)]
    pub(super) attributes: Attributes,
    pub(super) indices: Option<usize>,
    #[serde(default = "triangles")]
    pub(super) mode: u32,
}

/// The mode of primitives that name none.
const fn triangles() -> u32 {
    4
}

#[derive(Debug, Default, Deserialize)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    pub(super) position: Option<usize>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<usize>,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) component_type: u32,
    pub(super) count: u64,
    #[serde(rename = "type")]
    pub(super) kind: String,
    #[serde(default)]
    pub(super) normalized: bool,
    pub(super) sparse: Option<Box<Sparse>>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Sparse {
    pub(super) count: u64,
    pub(super) indices: SparsePart,
    pub(super) values: SparsePart,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparsePart {
    pub(super) buffer_view: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) component_type: Option<u32>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct View {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: u64,
    pub(super) byte_length: u64,
    pub(super) byte_stride: Option<u64>,
}

/// A buffer.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    /// The number of bytes that the buffer should have.
    pub(super) byte_length: u64,
    /// The address of the contents; in the binary part of a GLB where there is none.
    pub(super) uri: Option<String>,
}

impl Document {
    /// Reads the JSON, and checks what can be checked without following it.
    pub(super) fn read(json: &[u8]) -> Result<Self, String> {
        let document: Self = serde_json::from_slice(json).map_err(|e| format!("it cannot be read: {e}"))?;
        let version = &document.asset.version;
        if !version.is_empty() && !version.starts_with("2.") {
            let short: String = version.chars().take(20).collect();
            return Err(format!("it is of glTF version {short}; only version 2 is read: export it anew"));
        }
        document.extensions_required.iter().try_for_each(|name| check_extension(name))?;
        if document.nodes.len() > MAX_NODES {
            return Err(format!("it has {} nodes; the limit is {MAX_NODES}", document.nodes.len()));
        }
        Ok(document)
    }

    /// Whether positions may be whole numbers.
    pub(super) fn is_quantised(&self) -> bool {
        self.extensions_required.iter().any(|name| name == "KHR_mesh_quantization")
    }

    /// The scene's nodes in their order with the number of the node above each; every node at most once.
    pub(super) fn tree(&self) -> Result<Vec<(usize, Option<usize>)>, String> {
        let scene = match self.scene {
            Some(number) => self.scenes.get(number).ok_or("its scene is not there")?,
            None => self.scenes.first().ok_or("it has no scene")?,
        };
        let mut is_met = vec![false; self.nodes.len()];
        let mut tree = Vec::new();
        let mut waiting: Vec<(usize, Option<usize>)> = scene.nodes.iter().rev().map(|n| (*n, None)).collect();
        while let Some((number, above)) = waiting.pop() {
            let node = self
                .nodes
                .get(number)
                .ok_or_else(|| format!("it names node {number}, which is not there"))?;
            if std::mem::replace(&mut is_met[number], true) {
                return Err(format!("node {number} is met twice: its nodes must form a tree"));
            }
            tree.push((number, above));
            waiting.extend(node.children.iter().rev().map(|child| (*child, Some(number))));
            // Each node waits once, unless some are named more often.
            if waiting.len() > self.nodes.len() {
                return Err("its nodes do not form a tree: some are named twice".into());
            }
        }
        Ok(tree)
    }

    /// Checks an accessor down to the bytes that it names; `sizes` are the sizes of the buffers in bytes.
    pub(super) fn check_accessor(&self, number: usize, sizes: &[Option<usize>]) -> Result<(), String> {
        let named = |problem: String| format!("accessor {number} {problem}");
        let accessor = self.accessors.get(number).ok_or_else(|| named("is not there".into()))?;
        let size = accessor.element_size().map_err(named)?;
        if accessor.count == 0 {
            return Err(named("has no elements".into()));
        }
        if let Some(view) = accessor.buffer_view {
            self.check_range(view, [accessor.byte_offset, accessor.count, size], sizes).map_err(named)?;
        } else if accessor.sparse.is_none() {
            let is_packed = self.extensions_used.iter().find(|name| packing(name).is_some());
            return Err(named(match is_packed.and_then(|name| packing(name)) {
                Some(way) => format!("has no data: {}", packed_by(way)),
                None => "has no data".into(),
            }));
        }
        let Some(sparse) = &accessor.sparse else { return Ok(()) };
        let index_size = match sparse.indices.component_type {
            Some(5121) => 1,
            Some(5123) => 2,
            Some(5125) => 4,
            _ => return Err(named("has sparse elements that are not numbered by whole numbers".into())),
        };
        let all = sizes.iter().flatten().sum::<usize>() as u64;
        if accessor.buffer_view.is_none() && accessor.count > all {
            return Err(named(format!("announces {} elements, more than the file can hold", accessor.count)));
        }
        for (part, size) in [(&sparse.indices, index_size), (&sparse.values, size)] {
            self.check_range(part.buffer_view, [part.byte_offset, sparse.count, size], sizes)
                .map_err(named)?;
        }
        Ok(())
    }

    /// Checks that elements lie in their view, and the view in its buffer.
    fn check_range(
        &self,
        view: usize,
        [offset, count, size]: [u64; 3],
        sizes: &[Option<usize>],
    ) -> Result<(), String> {
        let view = self.buffer_views.get(view).ok_or("names a view that is not there")?;
        let buffer = sizes.get(view.buffer).ok_or("lies in a buffer that is not there")?;
        let buffer = buffer.ok_or_else(|| format!("lies in buffer {}, which has no data", view.buffer))?;
        let view_end = view.byte_offset.checked_add(view.byte_length);
        if view_end.is_none_or(|end| end > buffer as u64) {
            return Err("reaches past the end of its buffer: the file may be cut off".into());
        }
        let stride = view.byte_stride.unwrap_or(size);
        if stride < size || stride > 252.max(size) {
            return Err(format!("has elements of {size} bytes every {stride} bytes"));
        }
        let last = count.saturating_sub(1).checked_mul(stride);
        let end = last.and_then(|last| last.checked_add(size)).and_then(|end| end.checked_add(offset));
        if count > 0 && end.is_none_or(|end| end > view.byte_length) {
            return Err("reaches past the end of its view: the file may be cut off".into());
        }
        Ok(())
    }
}

impl Accessor {
    /// The size of one element in bytes.
    fn element_size(&self) -> Result<u64, String> {
        let component = match self.component_type {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
            5125 | 5126 => 4,
            other => return Err(format!("has components of the unknown type {other}")),
        };
        match self.kind.as_str() {
            "SCALAR" => Ok(component),
            "VEC2" => Ok(2 * component),
            "VEC3" => Ok(3 * component),
            "VEC4" => Ok(4 * component),
            other => {
                let short: String = other.chars().take(20).collect();
                Err(format!("has the type {short}: positions must be VEC3 and indices SCALAR"))
            }
        }
    }
}

/// The name of the method by which an extension packs the shape; `None` where it does not.
fn packing(name: &str) -> Option<&'static str> {
    match name {
        "KHR_draco_mesh_compression" => Some("Draco"),
        "EXT_meshopt_compression" | "KHR_meshopt_compression" => Some("meshopt"),
        _ => None,
    }
}

fn packed_by(way: &str) -> String {
    format!("its shape is packed by {way}, which cannot be read: export it without compression")
}

/// Refuses extensions that change the shape, by name; those of materials, pictures, lights and characters do not.
fn check_extension(name: &str) -> Result<(), String> {
    // The names, or their beginnings, of extensions that do not change the shape.
    const WITHOUT_SHAPE: [&str; 12] = [
        "KHR_materials_",
        "KHR_texture_",
        "EXT_texture_",
        "KHR_lights_",
        "EXT_lights_",
        "KHR_mesh_quantization",
        "KHR_animation_",
        "KHR_xmp",
        "KHR_audio",
        "MSFT_texture_",
        "VRM",
        "EXT_structural_metadata",
    ];
    if let Some(way) = packing(name) {
        return Err(format!("{} ({name})", packed_by(way)));
    }
    if WITHOUT_SHAPE.iter().any(|start| name.starts_with(start)) {
        return Ok(());
    }
    let short: String = name.chars().take(60).filter(|c| !c.is_control()).collect();
    Err(format!("it requires the extension {short}, which is not known here: export it without"))
}
