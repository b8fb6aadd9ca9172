//! The look of a glTF file's triangles: its vertices' colours, its materials' base colours, and the pictures that these lay on them by the
//! first texture coordinates.
//!
//! Nothing here refuses a mesh: parts that cannot be used are left out, with a remark.

use super::data_uri;
use super::gltf_container;
use super::gltf_document::Document;
use super::gltf_file::{Part, Reader, Scene, scene};
use super::look_remark::LookRemark;
use super::picture::media_type;
use crate::math::screen_light::screen_byte;
use crate::mesh::look::{CornerLook, MOST_PICTURES, PicturePlace, PolygonLook};
use crate::monitor::{Pulse, Silent};
use gltf::accessor::Dimensions;
use serde_json::Value;
use std::collections::BTreeMap;

/// The look that a file has, and remarks on the parts of it that cannot be used.
pub(super) fn read(bytes: &[u8]) -> (Option<PolygonLook>, Vec<LookRemark>) {
    let Ok(container) = gltf_container::split(bytes) else { return Default::default() };
    // Most files without a look are recognised before their triangles are read again.
    let says_something = ["COLOR_0", "TEXCOORD_0", "baseColorFactor"];
    let named = |name: &&str| container.json.windows(name.len()).any(|part| part == name.as_bytes());
    if !says_something.iter().any(named) {
        return Default::default();
    }
    let of_scene = || {
        let document = Document::read(container.json).ok()?;
        let reader = Reader::new(&document, container, bytes.len()).ok()?;
        let scene = scene(&reader, &mut Pulse::new(&mut Silent, usize::MAX)).ok()?;
        let root: Value = serde_json::from_slice(container.json).ok()?;
        Some(Looks { root: &root, buffer: &|number| reader.buffer(number), reader: &reader }.of(&scene))
    };
    of_scene().unwrap_or_default()
}

/// A document whose materials are looked up.
struct Looks<'a> {
    root: &'a Value,
    buffer: &'a dyn Fn(usize) -> Option<&'a [u8]>,
    reader: &'a Reader<'a>,
}

/// The look of a primitive.
#[derive(Default)]
struct PartLook {
    /// Linear red, green and blue of each vertex; empty where there are none.
    colours: Vec<[f32; 4]>,
    /// The place in the picture of each vertex, from the left upper corner down; empty where there are none.
    places: Vec<[f32; 4]>,
    /// Linear red, green and blue by which the whole is multiplied.
    factor: [f64; 3],
    /// The number of its image in the document.
    image: Option<usize>,
}

/// The pictures of a document that are used, in the order in which they were asked for.
#[derive(Default)]
pub(super) struct Used {
    /// The number among the pictures of each image that was asked for, by its number in the document; `None` for one that cannot be
    /// used.
    numbers: BTreeMap<usize, Option<u8>>,
    /// The pictures' files.
    pub(super) pictures: Vec<Vec<u8>>,
    /// Remarks on the parts of the look that cannot be used.
    pub(super) remarks: Vec<LookRemark>,
}

impl Used {
    /// The number of an image among the pictures; `None` where it cannot be used, on which there is one remark.
    pub(super) fn number(&mut self, image: usize, document: &Images<'_>) -> Option<u8> {
        if let Some(known) = self.numbers.get(&image) {
            return *known;
        }
        let found = if self.pictures.len() < MOST_PICTURES {
            document.picture(image)
        } else {
            Err(LookRemark::TooMany)
        };
        let number = match found {
            Ok(picture) => {
                self.pictures.push(picture);
                u8::try_from(self.pictures.len() - 1).ok()
            }
            Err(remark) => {
                if !self.remarks.contains(&remark) {
                    self.remarks.push(remark);
                }
                None
            }
        };
        self.numbers.insert(image, number);
        number
    }
}

/// The images of a document.
pub(super) struct Images<'a> {
    /// The document.
    pub(super) root: &'a Value,
    /// Its buffers by number.
    pub(super) buffer: &'a dyn Fn(usize) -> Option<&'a [u8]>,
}

impl Images<'_> {
    /// The file of a picture that is in the document.
    fn picture(&self, number: usize) -> Result<Vec<u8>, LookRemark> {
        let image = &self.root["images"][number];
        let name = || {
            let given =
                image["name"].as_str().or(image["uri"].as_str().filter(|uri| !uri.starts_with("data:")));
            given.map_or_else(|| format!("number {number}"), str::to_owned)
        };
        let uri = image["uri"].as_str();
        if uri.is_some_and(|uri| !uri.starts_with("data:")) {
            return Err(LookRemark::Missing { name: name() });
        }
        let bytes = match uri {
            Some(uri) => data_uri::data(uri).and_then(Result::ok),
            None => self.in_buffer(image),
        };
        let bytes = bytes
            .filter(|bytes| media_type(bytes).is_some())
            .ok_or_else(|| LookRemark::NoPicture { name: name() })?;
        LookRemark::too_large(&bytes, name).map_or(Ok(bytes), Err)
    }

    fn in_buffer(&self, image: &Value) -> Option<Vec<u8>> {
        let view = &self.root["bufferViews"][index(&image["bufferView"])?];
        let buffer = (self.buffer)(index(&view["buffer"])?)?;
        let begin = index(&view["byteOffset"]).unwrap_or(0);
        Some(buffer.get(begin..begin.checked_add(index(&view["byteLength"])?)?)?.to_vec())
    }
}

impl Looks<'_> {
    fn of(&self, scene: &Scene) -> (Option<PolygonLook>, Vec<LookRemark>) {
        let mut used = Used::default();
        let images = Images { root: self.root, buffer: self.buffer };
        let mut corners = Vec::with_capacity(scene.soup.polygons.len());
        let mut polygons = scene.soup.polygons.iter();
        for part in &scene.parts {
            let look = self.of_part(part, &mut used.remarks);
            let image = look.image.filter(|_| !look.places.is_empty());
            let picture = image.and_then(|image| used.number(image, &images));
            for polygon in polygons.by_ref().take(part.triangles) {
                let corner = |v: &u32| look.corner(*v as usize - part.first_vertex, picture);
                corners.push(polygon.iter().map(corner).collect());
            }
        }
        let says = |corner: &CornerLook| *corner != CornerLook::WHITE;
        let look = PolygonLook { corners, pictures: used.pictures };
        let has_look = look.corners.iter().flatten().any(says);
        (has_look.then_some(look), used.remarks)
    }

    fn of_part(&self, part: &Part, remarks: &mut Vec<LookRemark>) -> PartLook {
        let primitive = &self.root["meshes"][part.mesh]["primitives"][part.primitive];
        let material = index(&primitive["material"]).map(|number| &self.root["materials"][number]);
        let surface = material.map(|material| &material["pbrMetallicRoughness"]);
        let factor = surface.and_then(|surface| surface["baseColorFactor"].as_array());
        let factor = [0, 1, 2].map(|k| factor.and_then(|f| f.get(k)?.as_f64()).unwrap_or(1.0));
        let mut values = |name: &str, kinds: &[Dimensions]| {
            let number = index(&primitive["attributes"][name])?;
            let (kind, values) = self.reader.numbers(number, part.vertices)?;
            if !values.iter().flatten().all(|x| x.is_finite()) {
                let (mesh, primitive) = (part.mesh, part.primitive);
                let problem =
                    format!("{name} of primitive {primitive} of mesh {mesh} has values that are no numbers");
                remarks.push(LookRemark::Unusable { problem });
                return None;
            }
            kinds.contains(&kind).then_some(values)
        };
        let colours = values("COLOR_0", &[Dimensions::Vec3, Dimensions::Vec4]).unwrap_or_default();
        let places = values("TEXCOORD_0", &[Dimensions::Vec2]).unwrap_or_default();
        PartLook { colours, places, factor, image: surface.and_then(|surface| self.image_of(surface)) }
    }

    /// The image of a material's base colour. Only the first texture coordinates are read.
    fn image_of(&self, surface: &Value) -> Option<usize> {
        let texture = &surface["baseColorTexture"];
        let texture = Some(texture).filter(|texture| index(&texture["texCoord"]).unwrap_or(0) == 0);
        let texture = &self.root["textures"][index(&texture?["index"])?];
        index(&texture["extensions"]["EXT_texture_webp"]["source"]).or_else(|| index(&texture["source"]))
    }
}

impl PartLook {
    fn corner(&self, vertex: usize, picture: Option<u8>) -> CornerLook {
        let own = self.colours.get(vertex);
        let channel = |k: usize| screen_byte(self.factor[k] * own.map_or(1.0, |own| f64::from(own[k])));
        let place = |picture: u8| {
            let [u, down, ..] = *self.places.get(vertex)?;
            Some(PicturePlace { picture, at: [u, 1.0 - down] })
        };
        CornerLook { colour: [0, 1, 2].map(channel), place: picture.and_then(place) }
    }
}

pub(super) fn index(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}
