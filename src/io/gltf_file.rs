//! glTF 2.0: all triangles of the scene in world coordinates, joined at equal coordinates. Vertices are numbered as the
//! elements of the primitives' positions, one primitive after another as the scene names them.
//!
//! Buffers are the binary part of a GLB or data URIs; [`super::gltf_parts`] brings those of other files in. Everything is
//! checked by [`super::gltf_document`] before it is followed. Nodes are placed in f64, so that a shape far from the origin
//! keeps the digits that its file has.

use super::data_uri;
use super::gltf_container::{self, Container};
use super::gltf_document::{Buffer, Document, Node, Primitive};
use super::gltf_library;
use super::problem::{Place, Unread};
use super::reading::weld;
use crate::mesh::soup::PolygonSoup;
use crate::monitor::Pulse;
use glam::{DMat4, DQuat, DVec3};
use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};
use gltf::mesh::Mode;
use std::borrow::Cow;

/// The largest number of corners of the whole scene.
const MAX_CORNERS: usize = 60_000_000;
/// The number of corners that a file may have beyond its number of bytes, so that a small one with many copies cannot ask for much
/// memory.
const CORNERS_OF_COPIES: usize = 500_000;

pub(super) fn read(bytes: &[u8], pulse: &mut Pulse<'_>) -> Result<PolygonSoup, Unread> {
    let container = gltf_container::split(bytes)?;
    let document = Document::read(container.json)?;
    let scene = scene(&Reader::new(&document, container, bytes.len())?, pulse)?;
    Ok(weld(scene.soup, pulse)?)
}

impl From<String> for Unread {
    /// A problem of the file as a whole: its elements have no lines.
    fn from(problem: String) -> Self {
        Self::Problem((Place::Header, problem))
    }
}

/// The triangles of the scene, before vertices are joined.
pub(super) fn scene(reader: &Reader<'_>, pulse: &mut Pulse<'_>) -> Result<Scene, Unread> {
    let document = reader.document;
    let mut scene = Scene::default();
    let mut places = vec![DMat4::IDENTITY; document.nodes.len()];
    for (number, above) in document.tree()? {
        let node = &document.nodes[number];
        let own = placement(node)
            .ok_or_else(|| format!("node {number} is placed by numbers that cannot be used"))?;
        places[number] = above.map_or(own, |above| places[above] * own);
        if let Some(mesh) = node.mesh {
            reader.add_mesh(mesh, &places[number], &mut scene, pulse)?;
        }
    }
    if scene.soup.polygons.is_empty() {
        return Err("its scene has no triangles".to_owned().into());
    }
    Ok(scene)
}

/// The transform from a node's coordinates to those of the node above; `None` where its numbers are not finite.
fn placement(node: &Node) -> Option<DMat4> {
    let matrix = match &node.matrix {
        Some(columns) => DMat4::from_cols_array(columns),
        None => {
            let translation = node.translation.as_deref().map_or(DVec3::ZERO, |&t| DVec3::from(t));
            let scale = node.scale.as_deref().map_or(DVec3::ONE, |&s| DVec3::from(s));
            let rotation = node.rotation.as_deref().map(|&q| DQuat::from_array(q));
            let rotation =
                rotation.filter(|q| q.length_squared() > 0.0).map_or(DQuat::IDENTITY, DQuat::normalize);
            DMat4::from_scale_rotation_translation(scale, rotation, translation)
        }
    };
    matrix.is_finite().then_some(matrix)
}

/// The contents of the buffers, cut to the lengths that the file tells; `None` for one without data, as some extensions have it.
fn buffers<'a>(buffers: &[Buffer], binary: Option<&'a [u8]>) -> Result<Vec<Option<Cow<'a, [u8]>>>, String> {
    let load = |(number, buffer): (usize, &Buffer)| {
        let mut content: Cow<'a, [u8]> = match &buffer.uri {
            // Only the first may be the binary part.
            None => match binary.filter(|_| number == 0) {
                Some(binary) => binary.into(),
                None => return Ok(None),
            },
            Some(uri) => {
                let decoded = data_uri::data(uri).ok_or_else(|| {
                    let short: String = uri.chars().take(40).filter(|c| !c.is_control()).collect();
                    format!("its data is in another file ({short}): give that file too, or export it as GLB")
                })?;
                decoded.map_err(|e| format!("its embedded buffer is damaged: {e}"))?.into()
            }
        };
        let there = content.len();
        let wanted = usize::try_from(buffer.byte_length).ok().filter(|wanted| *wanted <= there);
        let wanted = wanted.ok_or_else(|| {
            format!(
                "buffer {number} should have {} bytes and has {there}: the file may be cut off",
                buffer.byte_length
            )
        })?;
        match &mut content {
            Cow::Borrowed(content) => *content = &content[..wanted],
            Cow::Owned(content) => content.truncate(wanted),
        }
        Ok(Some(content))
    };
    buffers.iter().enumerate().map(load).collect()
}

/// The triangles read so far.
#[derive(Default)]
pub(super) struct Scene {
    pub(super) soup: PolygonSoup,
    /// The parts of the file from which the polygons come, in their order.
    pub(super) parts: Vec<Part>,
    /// Number of positions and indices that were read for them.
    corners: usize,
}

/// The triangles of one primitive as one node places it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// The number of its mesh.
    pub(super) mesh: usize,
    /// Its number in the mesh.
    pub(super) primitive: usize,
    /// The number of its first vertex in the scene.
    pub(super) first_vertex: usize,
    /// Number of its vertices.
    pub(super) vertices: usize,
    /// Number of its triangles.
    pub(super) triangles: usize,
}

/// A document with the contents of its buffers.
pub(super) struct Reader<'a> {
    document: &'a Document,
    library: gltf::Document,
    buffers: Vec<Option<Cow<'a, [u8]>>>,
    sizes: Vec<Option<usize>>,
    most_corners: usize,
}

impl<'a> Reader<'a> {
    /// The reader of a file with this number of bytes.
    pub(super) fn new(
        document: &'a Document,
        container: Container<'a>,
        file_bytes: usize,
    ) -> Result<Self, String> {
        let buffers = buffers(&document.buffers, container.binary)?;
        Ok(Self {
            sizes: buffers.iter().map(|buffer| buffer.as_ref().map(|content| content.len())).collect(),
            library: gltf_library::of(document),
            most_corners: MAX_CORNERS.min(file_bytes.saturating_add(CORNERS_OF_COPIES)),
            document,
            buffers,
        })
    }

    /// The contents of a buffer.
    pub(super) fn buffer(&self, number: usize) -> Option<&[u8]> {
        self.buffers.get(number)?.as_deref()
    }

    fn add_mesh(
        &self,
        number: usize,
        world: &DMat4,
        scene: &mut Scene,
        pulse: &mut Pulse<'_>,
    ) -> Result<(), Unread> {
        let mesh = self.document.meshes.get(number);
        let mesh = mesh.ok_or_else(|| format!("it names mesh {number}, which is not there"))?;
        for (k, primitive) in mesh.primitives.iter().enumerate() {
            let [vertices, triangles] = [scene.soup.positions.len(), scene.soup.polygons.len()];
            self.add_primitive(primitive, world, scene, pulse).map_err(|unread| match unread {
                Unread::Problem((_, problem)) => format!("primitive {k} of mesh {number}: {problem}").into(),
                stopped => stopped,
            })?;
            scene.parts.push(Part {
                mesh: number,
                primitive: k,
                first_vertex: vertices,
                vertices: scene.soup.positions.len() - vertices,
                triangles: scene.soup.polygons.len() - triangles,
            });
        }
        Ok(())
    }

    fn add_primitive(
        &self,
        primitive: &Primitive,
        world: &DMat4,
        scene: &mut Scene,
        pulse: &mut Pulse<'_>,
    ) -> Result<(), Unread> {
        let mode = mode(primitive.mode)?;
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            // A primitive that gives no corners counts too, as it takes time.
            return Ok(self.count(1, scene)?);
        }
        let accessor =
            self.accessor(primitive.attributes.position.ok_or_else(|| "it has no positions".to_owned())?)?;
        let indices = primitive.indices.map(|number| self.accessor(number)).transpose()?;
        self.count(1 + accessor.count() + indices.as_ref().map_or(0, Accessor::count), scene)?;
        let PolygonSoup { positions, polygons, .. } = &mut scene.soup;
        let start = positions.len() as u32;
        for p in self.positions(&accessor)? {
            pulse.beat()?;
            positions.push(world.transform_point3(p));
        }
        let indices = match indices {
            Some(indices) => self.indices(&indices, accessor.count())?,
            None => (0..accessor.count() as u32).collect(),
        };
        if mode == Mode::Triangles && indices.len() % 3 != 0 {
            return Err(format!(
                "its {} corners do not make whole triangles: the file may be cut off",
                indices.len()
            )
            .into());
        }
        for t in triangles(mode, &indices) {
            pulse.beat()?;
            polygons.push(t.map(|i| start + i).to_vec());
        }
        Ok(())
    }

    fn count(&self, corners: usize, scene: &mut Scene) -> Result<(), String> {
        scene.corners = scene.corners.saturating_add(corners);
        if scene.corners > self.most_corners {
            let most = self.most_corners;
            return Err(format!("the scene has more than {most} corners with all copies of its meshes"));
        }
        Ok(())
    }

    /// An accessor, checked.
    fn accessor(&self, number: usize) -> Result<Accessor<'_>, String> {
        self.document.check_accessor(number, &self.sizes)?;
        self.library.accessors().nth(number).ok_or_else(|| format!("accessor {number} is not there"))
    }

    fn positions(&self, accessor: &Accessor<'_>) -> Result<Vec<DVec3>, String> {
        if accessor.dimensions() != Dimensions::Vec3 {
            let (number, kind) = (accessor.index(), type_name(accessor.dimensions()));
            return Err(format!(
                "accessor {number} has the type {kind}: positions must be VEC3 and indices SCALAR"
            ));
        }
        let kind = accessor.data_type();
        if kind != DataType::F32 && !self.document.is_quantised() {
            return Err("its positions are not floats".into());
        }
        let divisor = if accessor.normalized() { normal_divisor(kind) } else { 1.0 };
        let point = |bytes: &[u8]| {
            let of_axis = |k: usize| component(kind, &bytes[k * kind.size()..]);
            let p = DVec3::new(of_axis(0), of_axis(1), of_axis(2)) / divisor;
            // The least number of a signed type is as good as its neighbour.
            if accessor.normalized() { p.max(DVec3::NEG_ONE) } else { p }
        };
        Ok(self.elements(accessor)?.iter().map(|bytes| point(bytes)).collect())
    }

    /// The elements of an accessor, which must be `count`, each as four numbers: those that the accessor's type has, then zeros. Whole numbers
    /// that stand for shares become numbers from 0 to 1. `None` where the accessor cannot be used, or has another number of elements.
    pub(super) fn numbers(&self, number: usize, count: usize) -> Option<(Dimensions, Vec<[f32; 4]>)> {
        let accessor = self.accessor(number).ok().filter(|accessor| accessor.count() == count)?;
        let kind = accessor.data_type();
        let divisor = if accessor.normalized() { normal_divisor(kind) } else { 1.0 };
        let numbers = |bytes: &&[u8]| {
            let mut numbers = [0.0; 4];
            for (x, b) in numbers.iter_mut().zip(bytes.chunks_exact(kind.size())) {
                *x = (component(kind, b) / divisor) as f32;
            }
            numbers
        };
        Some((accessor.dimensions(), self.elements(&accessor).ok()?.iter().map(numbers).collect()))
    }

    /// Indices below `vertices`.
    fn indices(&self, accessor: &Accessor<'_>, vertices: usize) -> Result<Vec<u32>, String> {
        let kind = accessor.data_type();
        if accessor.dimensions() != Dimensions::Scalar
            || !matches!(kind, DataType::U8 | DataType::U16 | DataType::U32)
        {
            return Err("its indices are not whole numbers".into());
        }
        let index = |bytes: &&[u8]| {
            let index = component(kind, bytes) as u32;
            if (index as usize) < vertices {
                Ok(index)
            } else {
                Err(format!("it names vertex {index}, but has {vertices} vertices"))
            }
        };
        self.elements(accessor)?.iter().map(index).collect()
    }

    /// The bytes of each element of an accessor that was checked; sparse ones are in place.
    fn elements(&self, accessor: &Accessor<'_>) -> Result<Vec<&[u8]>, String> {
        const ZERO: [u8; 16] = [0; 16];
        let size = accessor.size();
        let mut elements = match accessor.view() {
            Some(view) => self.range(&view, accessor.offset(), [accessor.count(), size])?,
            None => vec![&ZERO[..size]; accessor.count()],
        };
        let Some(sparse) = accessor.sparse() else { return Ok(elements) };
        let (indices, values) = (sparse.indices(), sparse.values());
        let kind = match indices.index_type() {
            gltf::accessor::sparse::IndexType::U8 => DataType::U8,
            gltf::accessor::sparse::IndexType::U16 => DataType::U16,
            gltf::accessor::sparse::IndexType::U32 => DataType::U32,
        };
        let count = sparse.count();
        let at = self.range(&indices.view(), indices.offset(), [count, kind.size()])?;
        let values = self.range(&values.view(), values.offset(), [count, size])?;
        for (index, value) in at.into_iter().zip(values) {
            let index = component(kind, index) as usize;
            *elements.get_mut(index).ok_or_else(|| format!("sparse element {index} is not there"))? = value;
        }
        Ok(elements)
    }

    /// Elements of a view that was checked.
    fn range(
        &self,
        view: &gltf::buffer::View<'_>,
        offset: usize,
        [count, size]: [usize; 2],
    ) -> Result<Vec<&[u8]>, String> {
        let buffer = self.buffers.get(view.buffer().index()).and_then(Option::as_deref);
        let begin = view.offset() + offset;
        let stride = view.stride().unwrap_or(size);
        let element = |k: usize| buffer?.get(begin + k * stride..begin + k * stride + size);
        (0..count).map(|k| element(k).ok_or_else(|| "an element is not there".to_owned())).collect()
    }
}

/// The mode in which corners follow one another.
fn mode(number: u32) -> Result<Mode, String> {
    Ok(match number {
        0 => Mode::Points,
        1 => Mode::Lines,
        2 => Mode::LineLoop,
        3 => Mode::LineStrip,
        4 => Mode::Triangles,
        5 => Mode::TriangleStrip,
        6 => Mode::TriangleFan,
        _ => return Err(format!("its mode {number} is unknown")),
    })
}

/// Triangles of a list, a strip or a fan. A strip joins its parts by triangles with a corner twice, which are none.
fn triangles(mode: Mode, indices: &[u32]) -> Box<dyn Iterator<Item = [u32; 3]> + '_> {
    let is_whole = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    match mode {
        Mode::TriangleStrip => {
            let turned =
                |(k, t): (usize, &[u32])| if k % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] };
            Box::new(indices.windows(3).enumerate().map(turned).filter(is_whole))
        }
        Mode::TriangleFan => {
            let first = indices.first().copied().unwrap_or_default();
            let rest = indices.get(1..).unwrap_or_default();
            Box::new(rest.windows(2).map(move |pair| [first, pair[0], pair[1]]).filter(is_whole))
        }
        _ => Box::new(indices.as_chunks::<3>().0.iter().copied()),
    }
}

/// The name of a type as files write it.
fn type_name(dimensions: Dimensions) -> &'static str {
    match dimensions {
        Dimensions::Scalar => "SCALAR",
        Dimensions::Vec2 => "VEC2",
        Dimensions::Vec3 => "VEC3",
        Dimensions::Vec4 => "VEC4",
        Dimensions::Mat2 => "MAT2",
        Dimensions::Mat3 => "MAT3",
        Dimensions::Mat4 => "MAT4",
    }
}

/// A number of an accessor.
fn component(kind: DataType, b: &[u8]) -> f64 {
    match (kind, b) {
        (DataType::I8, &[a, ..]) => f64::from(i8::from_le_bytes([a])),
        (DataType::U8, &[a, ..]) => f64::from(a),
        (DataType::I16, &[a, b, ..]) => f64::from(i16::from_le_bytes([a, b])),
        (DataType::U16, &[a, b, ..]) => f64::from(u16::from_le_bytes([a, b])),
        (DataType::U32, &[a, b, c, d, ..]) => f64::from(u32::from_le_bytes([a, b, c, d])),
        (DataType::F32, &[a, b, c, d, ..]) => f64::from(f32::from_le_bytes([a, b, c, d])),
        _ => f64::NAN,
    }
}

/// The number that stands for 1 in the whole numbers of a type.
fn normal_divisor(kind: DataType) -> f64 {
    match kind {
        DataType::I8 => f64::from(i8::MAX),
        DataType::U8 => f64::from(u8::MAX),
        DataType::I16 => f64::from(i16::MAX),
        DataType::U16 => f64::from(u16::MAX),
        DataType::U32 => f64::from(u32::MAX),
        DataType::F32 => 1.0,
    }
}
