//! The look of a glTF file's triangles: its vertices' colours, its materials' base colours, and one picture laid over them by the first
//! texture coordinates. Where materials have several pictures, that of the most triangles is taken; the others keep their base colours.
//!
//! Nothing here refuses a mesh: what cannot be used is left out.

use super::data_uri;
use super::gltf_container;
use super::gltf_document::Document;
use super::gltf_file::{Part, Reader, Scene, scene};
use crate::math::scalar::pow;
use crate::mesh::look::{CornerLook, PolygonLook};
use crate::monitor::{Pulse, Silent};
use gltf::accessor::Dimensions;
use serde_json::Value;

/// What a file says of its look; `None` where that is nothing.
pub(super) fn read(bytes: &[u8]) -> Option<PolygonLook> {
    let container = gltf_container::split(bytes).ok()?;
    // Most files without a look are told from others before their triangles are read again.
    let says_something = ["COLOR_0", "TEXCOORD_0", "baseColorFactor"];
    let named = |name: &&str| container.json.windows(name.len()).any(|part| part == name.as_bytes());
    if !says_something.iter().any(named) {
        return None;
    }
    let document = Document::read(container.json).ok()?;
    let reader = Reader::new(&document, container, bytes.len()).ok()?;
    let scene = scene(&reader, &mut Pulse::new(&mut Silent, usize::MAX)).ok()?;
    let root: Value = serde_json::from_slice(container.json).ok()?;
    Looks { root: &root, reader: &reader }.of(&scene)
}

/// A document whose materials are looked up.
struct Looks<'a> {
    root: &'a Value,
    reader: &'a Reader<'a>,
}

/// The look of a primitive.
#[derive(Default)]
struct PartLook {
    /// Linear red, green and blue by vertex; empty where there are none.
    colours: Vec<[f32; 4]>,
    /// By vertex, down from the left upper corner; empty where there are none.
    places: Vec<[f32; 4]>,
    /// Linear red, green and blue of the whole.
    factor: [f64; 3],
    /// The number of its picture.
    picture: Option<usize>,
}

impl Looks<'_> {
    fn of(&self, scene: &Scene) -> Option<PolygonLook> {
        let parts: Vec<(Part, PartLook)> =
            scene.parts.iter().map(|part| (*part, self.of_part(part))).collect();
        let chosen = most_used(&parts);
        let picture = chosen.and_then(|number| self.picture(number));
        let chosen = chosen.filter(|_| picture.is_some());
        let mut corners = Vec::with_capacity(scene.soup.polygons.len());
        let mut polygons = scene.soup.polygons.iter();
        for (part, look) in &parts {
            for polygon in polygons.by_ref().take(part.triangles) {
                let corner = |v: &u32| look.corner(*v as usize - part.first_vertex, chosen);
                corners.push(polygon.iter().map(corner).collect());
            }
        }
        let says = |corner: &CornerLook| *corner != CornerLook::WHITE;
        corners.iter().flatten().any(says).then_some(PolygonLook { corners, picture })
    }

    fn of_part(&self, part: &Part) -> PartLook {
        let primitive = &self.root["meshes"][part.mesh]["primitives"][part.primitive];
        let material = index(&primitive["material"]).map(|number| &self.root["materials"][number]);
        let surface = material.map(|material| &material["pbrMetallicRoughness"]);
        let factor = surface.and_then(|surface| surface["baseColorFactor"].as_array());
        let factor = [0, 1, 2].map(|k| factor.and_then(|f| f.get(k)?.as_f64()).unwrap_or(1.0));
        let values = |name: &str, kinds: &[Dimensions]| {
            let number = index(&primitive["attributes"][name])?;
            let (kind, values) = self.reader.numbers(number, part.vertices)?;
            (kinds.contains(&kind) && values.iter().flatten().all(|x| x.is_finite())).then_some(values)
        };
        let texture = surface.map(|surface| &surface["baseColorTexture"]);
        // Only the first texture coordinates are read.
        let texture = texture.filter(|texture| index(&texture["texCoord"]).unwrap_or(0) == 0);
        let texture = texture.and_then(|texture| index(&texture["index"]));
        let picture = texture.and_then(|number| index(&self.root["textures"][number]["source"]));
        PartLook {
            colours: values("COLOR_0", &[Dimensions::Vec3, Dimensions::Vec4]).unwrap_or_default(),
            places: values("TEXCOORD_0", &[Dimensions::Vec2]).unwrap_or_default(),
            factor,
            picture,
        }
    }

    /// The file of a picture that is in the document.
    fn picture(&self, number: usize) -> Option<Vec<u8>> {
        let image = &self.root["images"][number];
        let bytes = match image["uri"].as_str() {
            Some(uri) => data_uri::data(uri)?.ok()?,
            None => {
                let view = &self.root["bufferViews"][index(&image["bufferView"])?];
                let buffer = self.reader.buffer(index(&view["buffer"])?)?;
                let begin = index(&view["byteOffset"]).unwrap_or(0);
                buffer.get(begin..begin.checked_add(index(&view["byteLength"])?)?)?.to_vec()
            }
        };
        is_picture(&bytes).then_some(bytes)
    }
}

impl PartLook {
    fn corner(&self, vertex: usize, chosen: Option<usize>) -> CornerLook {
        let own = self.colours.get(vertex);
        let channel = |k: usize| screen_byte(self.factor[k] * own.map_or(1.0, |own| f64::from(own[k])));
        let is_pictured = chosen.is_some() && self.picture == chosen;
        let place = self.places.get(vertex).filter(|_| is_pictured);
        CornerLook { colour: [0, 1, 2].map(channel), place: place.map(|[u, down, ..]| [*u, 1.0 - down]) }
    }
}

/// The picture that lies on the most triangles, the first one of several.
fn most_used(parts: &[(Part, PartLook)]) -> Option<usize> {
    let mut counts: Vec<(usize, usize)> = Vec::new();
    for (part, look) in parts {
        let Some(picture) = look.picture.filter(|_| !look.places.is_empty()) else { continue };
        match counts.iter_mut().find(|(number, _)| *number == picture) {
            Some((_, count)) => *count += part.triangles,
            None => counts.push((picture, part.triangles)),
        }
    }
    let most = counts.iter().map(|(_, count)| *count).max()?;
    counts.iter().find(|(_, count)| *count == most).map(|(number, _)| *number)
}

fn index(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}

/// Whether bytes begin as a picture that browsers show.
pub(super) fn is_picture(bytes: &[u8]) -> bool {
    let is_webp = bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP");
    bytes.starts_with(b"\x89PNG") || bytes.starts_with(b"\xff\xd8\xff") || is_webp
}

/// A share of light as a screen's number (sRGB).
fn screen_byte(light: f64) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let screen = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * pow(light, 1.0 / 2.4) - 0.055 };
    (255.0 * screen).round() as u8
}
