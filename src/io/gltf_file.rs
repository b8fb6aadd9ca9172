//! glTF 2.0: all triangles of the scene in world coordinates, joined at equal coordinates. Vertices are numbered as the
//! elements of the primitives' positions, one primitive after another as the scene names them.
//!
//! Buffers are the binary part of a GLB or data URIs; [`super::gltf_parts`] brings those of other files in. Accessors are read here with their bounds checked in u64.

use super::problem::{Place, Problem};
use super::reading::weld;
use crate::mesh::soup::PolygonSoup;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::{DMat4, DVec3, DVec4};
use gltf::accessor::{DataType, Dimensions};
use gltf::mesh::Mode;
use gltf::{Accessor, Gltf, Node, Primitive, Semantic};
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::BTreeMap;

/// Nodes deeper than this are refused: the scene is a tree, unless someone wants to hurt us.
const MAX_DEPTH: usize = 64;
/// Corners in all, so that a small file with many instances cannot ask for much memory.
const MAX_CORNERS: usize = 60_000_000;

pub(super) fn read(bytes: &[u8]) -> Result<PolygonSoup, Problem> {
    let header = |problem: String| (Place::Header, problem);
    check_positions(bytes).map_err(header)?;
    let gltf = Gltf::from_slice(bytes).map_err(|e| header(format!("it cannot be read: {e}")))?;
    let buffers = buffers(&gltf).map_err(header)?;
    let mut reader = Reader { buffers, soup: PolygonSoup::default() };
    let scene = gltf.default_scene().or_else(|| gltf.scenes().next());
    let scene = scene.ok_or_else(|| header("it has no scene".into()))?;
    for node in scene.nodes() {
        reader.add_node(&node, &DMat4::IDENTITY, 0).map_err(header)?;
    }
    let soup = reader.soup;
    if soup.polygons.is_empty() {
        return Err(header("its scene has no triangles".into()));
    }
    Ok(weld(soup))
}

/// Refuses positions that name no accessor: the library looks them up before it checks that they are there.
fn check_positions(bytes: &[u8]) -> Result<(), String> {
    #[derive(Deserialize)]
    struct Root {
        #[serde(default)]
        accessors: Vec<IgnoredAny>,
        #[serde(default)]
        meshes: Vec<Mesh>,
    }
    #[derive(Deserialize)]
    struct Mesh {
        #[serde(default)]
        primitives: Vec<Attributes>,
    }
    #[derive(Deserialize)]
    struct Attributes {
        #[serde(default)]
        attributes: BTreeMap<String, usize>,
    }
    let unreadable = |e: &dyn std::fmt::Display| format!("it cannot be read: {e}");
    let root: Root = if bytes.starts_with(b"glTF") {
        let glb = gltf::Glb::from_slice(bytes).map_err(|e| unreadable(&e))?;
        serde_json::from_slice(&glb.json).map_err(|e| unreadable(&e))?
    } else {
        serde_json::from_slice(bytes).map_err(|e| unreadable(&e))?
    };
    let mut primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let is_missing = |primitive: &Attributes| {
        primitive.attributes.get("POSITION").is_some_and(|number| *number >= root.accessors.len())
    };
    if primitives.any(is_missing) { Err("a primitive's positions are not there".into()) } else { Ok(()) }
}

fn buffers(gltf: &Gltf) -> Result<Vec<Vec<u8>>, String> {
    let load = |buffer: gltf::Buffer<'_>| match buffer.source() {
        gltf::buffer::Source::Bin => gltf.blob.clone().ok_or_else(|| "its binary part is missing".to_owned()),
        gltf::buffer::Source::Uri(uri) => {
            let data = uri.strip_prefix("data:").and_then(|rest| rest.split_once(";base64,"));
            let (_, code) = data.ok_or_else(|| {
                let short: String = uri.chars().take(40).collect();
                format!("its data is in another file ({short}): give that file too, or export it as GLB")
            })?;
            STANDARD.decode(code).map_err(|e| format!("its embedded buffer is damaged: {e}"))
        }
    };
    gltf.buffers().map(load).collect()
}

/// The triangles read so far, and the buffers from which they come.
struct Reader {
    buffers: Vec<Vec<u8>>,
    soup: PolygonSoup,
}

impl Reader {
    /// Adds a node and all below it; `depth` nodes lie above it.
    fn add_node(&mut self, node: &Node<'_>, parent: &DMat4, depth: usize) -> Result<(), String> {
        if depth > MAX_DEPTH {
            return Err("its nodes are nested too deeply".into());
        }
        let columns = node.transform().matrix().map(|c| DVec4::from_array(c.map(f64::from)));
        let world = *parent * DMat4::from_cols(columns[0], columns[1], columns[2], columns[3]);
        if let Some(mesh) = node.mesh() {
            for primitive in mesh.primitives() {
                self.add_primitive(&primitive, &world)?;
            }
        }
        node.children().try_for_each(|child| self.add_node(&child, &world, depth + 1))
    }

    fn add_primitive(&mut self, primitive: &Primitive<'_>, world: &DMat4) -> Result<(), String> {
        if primitive.mode() != Mode::Triangles {
            return Ok(());
        }
        let Self { buffers, soup } = self;
        let accessor = primitive.get(&Semantic::Positions).ok_or("a primitive has no positions")?;
        let start = soup.positions.len();
        soup.positions.extend(positions(&accessor, buffers)?.into_iter().map(|p| world.transform_point3(p)));
        let indices = match primitive.indices() {
            Some(accessor) => indices(&accessor, buffers)?,
            None => (0..(soup.positions.len() - start) as u32).collect(),
        };
        if soup.positions.len() + indices.len() + 3 * soup.polygons.len() > MAX_CORNERS {
            return Err(format!("it has more than {MAX_CORNERS} corners"));
        }
        let corner = |i: u32| i.saturating_add(start as u32);
        soup.polygons.extend(indices.chunks_exact(3).map(|t| t.iter().map(|&i| corner(i)).collect()));
        Ok(())
    }
}

fn positions(accessor: &Accessor<'_>, buffers: &[Vec<u8>]) -> Result<Vec<DVec3>, String> {
    if (accessor.data_type(), accessor.dimensions()) != (DataType::F32, Dimensions::Vec3) {
        return Err("its positions are not three floats each".into());
    }
    let float = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let point = |b: &[u8]| DVec3::new(float(&b[..4]), float(&b[4..8]), float(&b[8..12]));
    Ok(elements(accessor, buffers, 12)?.map(point).collect())
}

fn indices(accessor: &Accessor<'_>, buffers: &[Vec<u8>]) -> Result<Vec<u32>, String> {
    if accessor.dimensions() != Dimensions::Scalar {
        return Err("its indices are not single numbers".into());
    }
    match accessor.data_type() {
        DataType::U8 => Ok(elements(accessor, buffers, 1)?.map(|b| u32::from(b[0])).collect()),
        DataType::U16 => {
            Ok(elements(accessor, buffers, 2)?.map(|b| u32::from(u16::from_le_bytes([b[0], b[1]]))).collect())
        }
        DataType::U32 => Ok(elements(accessor, buffers, 4)?
            .map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]))
            .collect()),
        _ => Err("its indices are not whole numbers".into()),
    }
}

/// The bytes of each element of an accessor.
fn elements<'a>(
    accessor: &Accessor<'_>,
    buffers: &'a [Vec<u8>],
    size: usize,
) -> Result<impl Iterator<Item = &'a [u8]>, String> {
    if accessor.sparse().is_some() {
        return Err("it has sparse accessors: export it without them".into());
    }
    let view = accessor.view().ok_or("an accessor has no data")?;
    let buffer = buffers.get(view.buffer().index()).ok_or("a buffer is missing")?;
    let stride = view.stride().unwrap_or(size).max(1);
    let begin = view.offset() as u64 + accessor.offset() as u64;
    let count = accessor.count() as u64;
    let last = count.checked_sub(1).and_then(|n| n.checked_mul(stride as u64)).unwrap_or(0);
    let end =
        begin.checked_add(last).and_then(|e| e.checked_add(size as u64)).ok_or("an accessor is too large")?;
    if count > 0 && end > buffer.len() as u64 {
        return Err("an accessor reaches past the end of its buffer: the file may be cut off".into());
    }
    let begin = begin as usize;
    Ok((0..accessor.count()).map(move |k| &buffer[begin + k * stride..begin + k * stride + size]))
}
