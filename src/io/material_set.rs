//! The materials of an OBJ file with their pictures as one file, so that they go along with the mesh: a GLB without a mesh, whose
//! materials have the names that the OBJ file calls them by.
//!
//! Read are `newmtl`, `Kd` and `map_Kd` of the files that `mtllib` names. A picture that is not found stays in the set by its name alone.

use super::gltf_container;
use super::gltf_look::{Images, Used, index};
use super::gltf_parts::{Packer, glb};
use super::look_remark::LookRemark;
use super::obj::{WholeLine, whole_lines};
use super::picture::media_type;
use super::reading::text;
use super::{Format, detect};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// The materials of an OBJ file as one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PackedMaterials {
    /// The contents of the file.
    pub bytes: Vec<u8>,
    /// The number of pictures that the materials name and that were found.
    pub found: usize,
}

/// The materials of an OBJ file with the files that they name, which `find` gives by name; `None` where they name no pictures.
pub fn packed(mesh: &[u8], find: impl Fn(&str) -> Option<Vec<u8>>) -> Option<PackedMaterials> {
    if detect(mesh) != Some(Format::Obj) {
        return None;
    }
    let mut set = SetWriter { find: &find, materials: Vec::new(), images: Vec::new() };
    for name in libraries(&text(mesh).ok()?) {
        if let Some(content) = found(&name, &find) {
            set.add_library(&name, &text(&content).unwrap_or_default());
        }
    }
    let found = set.images.iter().filter(|(_, content)| content.is_some()).count();
    if set.images.is_empty() { None } else { Some(PackedMaterials { bytes: set.into_bytes()?, found }) }
}

/// The words of a line as one name.
fn rest(line: &WholeLine<'_>) -> String {
    line.words().collect::<Vec<_>>().join(" ")
}

/// The files of materials that an OBJ file names before its first face, one in a line.
fn libraries(mesh: &str) -> Vec<String> {
    let head = whole_lines(mesh).take_while(|line| line.kind != "f");
    head.filter(|line| line.kind == "mtllib").map(|line| rest(&line).replace('\\', "/")).collect()
}

/// The file that is called so, or by the bare name without folders.
fn found(path: &str, find: &dyn Fn(&str) -> Option<Vec<u8>>) -> Option<Vec<u8>> {
    find(path).or_else(|| find(path.rsplit('/').next().filter(|bare| *bare != path)?))
}

/// The name of a picture behind its options: words that begin with a dash, and the numbers and switches after them.
fn picture_name(line: &WholeLine<'_>) -> String {
    let mut words = line.words().peekable();
    while words.peek().is_some_and(|word| word.starts_with('-')) {
        let has_word = words.next().is_some_and(|option| matches!(option, "-imfchan" | "-type"));
        words.next_if(|_| has_word);
        while words.next_if(|word| word.parse::<f64>().is_ok() || matches!(*word, "on" | "off")).is_some() {}
    }
    words.collect::<Vec<_>>().join(" ").replace('\\', "/")
}

/// A set as it grows.
struct SetWriter<'a> {
    find: &'a dyn Fn(&str) -> Option<Vec<u8>>,
    materials: Vec<Value>,
    /// The pictures by name; `None` for those that were not found.
    images: Vec<(String, Option<Vec<u8>>)>,
}

impl SetWriter<'_> {
    fn add_library(&mut self, name: &str, content: &str) {
        let folder = name.rfind('/').map_or("", |end| &name[..=end]).to_owned();
        for line in whole_lines(content) {
            match &*line.kind.to_ascii_lowercase() {
                "newmtl" => self.materials.push(json!({ "name": rest(&line), "extras": {} })),
                "kd" => {
                    let numbers: Vec<f64> = line.words().map_while(|word| word.parse().ok()).collect();
                    let colour = <[f64; 3]>::try_from(numbers).ok();
                    if let Some(colour) = colour.filter(|colour| colour.iter().all(|x| x.is_finite())) {
                        self.tell("colour", json!(colour));
                    }
                }
                "map_kd" => {
                    let image = self.image(&folder, &picture_name(&line));
                    self.tell("image", json!(image));
                }
                _ => {}
            }
        }
    }

    /// Adds an entry to the last material.
    fn tell(&mut self, key: &str, value: Value) {
        if let Some(material) = self.materials.last_mut() {
            material["extras"][key] = value;
        }
    }

    /// The number of the picture of this name, which is looked for in the folder first.
    fn image(&mut self, folder: &str, name: &str) -> usize {
        let known = self.images.iter().position(|(known, _)| known == name);
        known.unwrap_or_else(|| {
            let beside = format!("{folder}{name}");
            let content = found(&beside, self.find).or_else(|| found(name, self.find));
            self.images.push((name.to_owned(), content));
            self.images.len() - 1
        })
    }

    /// The file of the set; `None` where it is larger than a file may be.
    fn into_bytes(self) -> Option<Vec<u8>> {
        let mut packer = Packer::default();
        let (mut views, mut images) = (Vec::new(), Vec::new());
        for (name, content) in &self.images {
            let Some(content) = content else {
                images.push(json!({ "uri": name }));
                continue;
            };
            let begin = packer.add(content).ok()?;
            images.push(json!({
                "bufferView": views.len(), "name": name, "mimeType": media_type(content).unwrap_or("image/png")
            }));
            views.push(json!({ "buffer": 0, "byteOffset": begin, "byteLength": content.len() }));
        }
        let mut root = Map::new();
        root.insert("asset".into(), json!({ "version": "2.0" }));
        root.insert("materials".into(), Value::Array(self.materials));
        root.insert("images".into(), Value::Array(images));
        root.insert("bufferViews".into(), Value::Array(views));
        root.insert("buffers".into(), json!([{ "byteLength": packer.bytes.len() }]));
        glb(&root, packer.bytes).ok()
    }
}

/// The contents of a file that comes with a mesh file: the materials of an OBJ file, or one picture.
#[derive(Clone, Debug, Default)]
pub(super) struct MaterialSet {
    by_name: BTreeMap<String, Material>,
    /// The files of the pictures.
    pub(super) pictures: Vec<Vec<u8>>,
    /// Remarks on the parts of the materials that cannot be used.
    pub(super) remarks: Vec<LookRemark>,
}

/// The properties of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Material {
    /// The colour of polygons without a picture, as a screen shows it.
    pub(super) colour: [u8; 3],
    /// The number of its picture.
    pub(super) picture: Option<u8>,
}

impl Material {
    /// A white material with the first picture.
    const FIRST: Self = Self { colour: [u8::MAX; 3], picture: Some(0) };
    /// A white material without a picture.
    const BARE: Self = Self { picture: None, ..Self::FIRST };
}

impl MaterialSet {
    /// Reads the set that [`packed`] has made, or takes a picture alone.
    pub(super) fn read(companion: &[u8]) -> Self {
        let remarked = |remark: LookRemark| Self { remarks: vec![remark], ..Self::default() };
        let name = || "that came with it".to_owned();
        if let Some(remark) = LookRemark::too_large(companion, name) {
            return remarked(remark);
        }
        if media_type(companion).is_some() {
            return Self { pictures: vec![companion.to_vec()], ..Self::default() };
        }
        let set = || {
            let container = gltf_container::split(companion).ok()?;
            let root: Value = serde_json::from_slice(container.json).ok()?;
            Some(Self::of_document(&root, container.binary.unwrap_or_default()))
        };
        set().unwrap_or_else(|| remarked(LookRemark::NoPicture { name: name() }))
    }

    fn of_document(root: &Value, binary: &[u8]) -> Self {
        let mut used = Used::default();
        let images = Images { root, buffer: &|number| (number == 0).then_some(binary) };
        let mut by_name = BTreeMap::new();
        for material in root["materials"].as_array().map(Vec::as_slice).unwrap_or_default() {
            let told = &material["extras"];
            let picture = index(&told["image"]).and_then(|image| used.number(image, &images));
            let share = |k: usize| told["colour"][k].as_f64().unwrap_or(1.0);
            let channel = |k: usize| (255.0 * share(k)).round().clamp(0.0, 255.0) as u8;
            let colour = if picture.is_some() { [u8::MAX; 3] } else { [0, 1, 2].map(channel) };
            let name = material["name"].as_str().unwrap_or_default().to_owned();
            by_name.insert(name, Material { colour, picture });
        }
        Self { by_name, pictures: used.pictures, remarks: used.remarks }
    }

    /// The material of each polygon of an OBJ file. A picture alone lies on all polygons.
    pub(super) fn by_polygon(&self, mesh: &str) -> Vec<Material> {
        let first = if self.pictures.is_empty() { Material::BARE } else { Material::FIRST };
        let mut current = first;
        let mut polygons = Vec::new();
        for line in whole_lines(mesh) {
            match line.kind {
                "usemtl" if !self.by_name.is_empty() => {
                    current = self.by_name.get(&rest(&line)).copied().unwrap_or(Material::BARE);
                }
                "f" => polygons.push(current),
                _ => {}
            }
        }
        polygons
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::picture::tests::png_that_announces;
    use crate::math::random::SplitMix;

    const MESH: &str = "# by hand\r\nmtllib my skins.mtl\r\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n\
        usemtl coat of fur\nf 1/1 2/1 3/1\nusemtl eye\nf 1 2 3\nusemtl nose\nf 1 2 3\nusemtl lost\nf 1/1 2/1 3/1\n";
    const MATERIALS: &str = "newmtl  coat of  fur\nKd 1 0 0\n  map_kd -s 1 1 1 -blendu on a coat.png\nnewmtl nose\n\
        Kd 0 0.2 1 # blue\nnewmtl eye\nmap_Kd C:\\pictures\\eye.jpg\nnewmtl tail\nmap_Kd -imfchan l a coat.png\nmap_Bump b.png\n\
        newmtl lost\nKd 0.4 0.4 0.4\nmap_Kd lost.png\n";
    const PNG: &[u8] = b"\x89PNG and so on";
    const JPEG: &[u8] = b"\xff\xd8\xff\xe0 and so on";

    fn find(name: &str) -> Option<Vec<u8>> {
        match name {
            "my skins.mtl" => Some(MATERIALS.into()),
            "a coat.png" => Some(PNG.into()),
            "eye.jpg" => Some(JPEG.into()),
            _ => None,
        }
    }

    #[test]
    fn a_set_tells_the_material_of_each_polygon() {
        let packed = packed(MESH.as_bytes(), find).unwrap();
        assert_eq!(packed.found, 2);
        let set = MaterialSet::read(&packed.bytes);
        assert_eq!(set.pictures, [PNG, JPEG]);
        assert_eq!(set.remarks, [LookRemark::Missing { name: "lost.png".into() }]);
        let bare = |colour| Material { colour, picture: None };
        let of = |picture| Material { colour: [u8::MAX; 3], picture: Some(picture) };
        let expected = [of(0), of(0), of(1), bare([0, 51, 255]), bare([102; 3])];
        assert_eq!(set.by_polygon(MESH), expected);
    }

    #[test]
    fn files_beside_the_library_come_first_and_files_that_are_no_pictures_are_told() {
        let find = |name: &str| match name {
            "skins/a.mtl" => Some(b"newmtl a\nmap_Kd coat.png\n".to_vec()),
            "skins/coat.png" => Some(b"no picture".to_vec()),
            "coat.png" => Some(PNG.to_vec()),
            _ => None,
        };
        let packed = packed(b"mtllib skins\\a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", find).unwrap();
        let set = MaterialSet::read(&packed.bytes);
        assert_eq!(set.pictures.len(), 0);
        assert_eq!(set.remarks, [LookRemark::NoPicture { name: "coat.png".into() }]);
    }

    #[test]
    fn meshes_without_pictures_have_no_set() {
        assert_eq!(
            packed(b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", |_| Some(
                b"newmtl a\nKd 1 0 0".into()
            )),
            None
        );
        assert_eq!(packed(MESH.as_bytes(), |_| None), None);
        assert_eq!(packed(b"OFF\n4 4 6\n", find), None);
    }

    #[test]
    fn damaged_sets_never_panic() {
        let bytes = packed(MESH.as_bytes(), find).unwrap().bytes;
        let mut random = SplitMix::new(5);
        let mut number = |below: usize| (random.unit() * below as f64) as usize;
        for _ in 0..3000 {
            let mut damaged = bytes.clone();
            for _ in 0..number(6) {
                let place = number(damaged.len());
                damaged[place] = number(256) as u8;
            }
            let set = MaterialSet::read(&damaged);
            let is_there =
                |material: &Material| material.picture.is_none_or(|k| usize::from(k) < set.pictures.len());
            assert!(set.by_polygon(MESH).iter().all(is_there));
        }
    }

    #[test]
    fn a_picture_alone_lies_on_all_and_anything_else_is_told() {
        let all = MaterialSet::read(PNG).by_polygon(MESH);
        assert_eq!(all, [Material::FIRST; 5]);
        for bytes in [&b""[..], b"<script>", b"glTF", &packed(MESH.as_bytes(), find).unwrap().bytes[..40]] {
            let set = MaterialSet::read(bytes);
            assert_eq!(set.by_polygon(MESH), [Material::BARE; 5]);
            assert_eq!(set.remarks, [LookRemark::NoPicture { name: "that came with it".into() }]);
        }
        let set = MaterialSet::read(&png_that_announces([70_000, 2_000]));
        let name = "that came with it".to_owned();
        assert_eq!(set.remarks, [LookRemark::TooLarge { name, width: 70_000, height: 2_000 }]);
        assert_eq!(set.pictures.len(), 0);
    }
}
