//! The look that a mesh file gives its surface: the colours of its vertices, and pictures with the places in them.
//!
//! Read are the vertices' colours of PLY files (`red`, `green`, `blue`) and of OBJ files (three numbers after the coordinates), texture
//! coordinates of both, the colours of vertices or faces of OFF files, and what a glTF file's materials say of their base colours.
//! The pictures of OBJ and PLY files come beside them: one, or a set of materials ([`super::material_set`]).

use super::gltf_look;
use super::look_remark::LookRemark;
use super::material_set::MaterialSet;
use super::obj;
use super::off;
use super::off_colours::{self, OffColours};
use super::reading::text;
use super::texture_coordinates::{self, TextureCoordinateError};
use super::vertex_table::{self, Column, NumberType, VertexTable};
use super::{Format, detect};
use crate::mesh::look::{CornerLook, PicturePlace, PolygonLook};
use crate::mesh::soup::PolygonSoup;

/// The look of a mesh, and remarks on the parts of it that cannot be used.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Appearance {
    /// The look of the file's polygons; `None` where nothing is said of it.
    pub look: Option<PolygonLook>,
    /// Remarks on the parts of the look that cannot be used and are left out.
    pub remarks: Vec<LookRemark>,
}

/// The look of the polygons of a mesh file, which were read from the same bytes. `companion` is the file that comes with it: a picture, or
/// the set of an OBJ file's materials.
pub fn read(bytes: &[u8], soup: &PolygonSoup, companion: Option<&[u8]>) -> Appearance {
    let mut appearance = match detect(bytes) {
        Some(Format::Gltf) => {
            let (look, remarks) = gltf_look::read(bytes);
            Appearance { look, remarks }
        }
        Some(Format::Ply) => of_ply(bytes, soup, &companion.map(MaterialSet::read).unwrap_or_default()),
        Some(Format::Obj) => of_obj(bytes, soup, &companion.map(MaterialSet::read).unwrap_or_default()),
        Some(Format::Off) => Appearance { look: of_off(bytes, soup), remarks: Vec::new() },
        Some(Format::Stl) | None => Appearance::default(),
    };
    appearance.look = appearance.look.filter(|look| look.corners.len() == soup.polygons.len());
    appearance
}

fn of_ply(bytes: &[u8], soup: &PolygonSoup, set: &MaterialSet) -> Appearance {
    let mut remarks = set.remarks.clone();
    let Ok(table) = vertex_table::of_ply(bytes, soup.positions.len()) else {
        return Appearance { look: None, remarks };
    };
    let colours = colours_of(&table);
    let places = texture_coordinates::of_table(&table, &soup.polygons);
    let is_usable = places.iter().flatten().flatten().all(|uv| uv.is_finite());
    if !is_usable {
        let problem = "texture coordinates have values that are no numbers".to_owned();
        remarks.push(LookRemark::Unusable { problem });
    }
    let place = |polygon: usize, k: usize| {
        let uv = places.as_ref().filter(|_| is_usable)?.get(polygon)?.get(k)?;
        Some(PicturePlace { picture: 0, at: uv.as_vec2().to_array() })
    };
    let colour = |_, v: usize| colours.as_ref().and_then(|colours| colours.get(v).copied());
    Appearance { look: joined(soup, colour, place, &set.pictures), remarks }
}

/// Colours by vertex; `None` where a channel is missing.
fn colours_of(table: &VertexTable) -> Option<Vec<[u8; 3]>> {
    let channel = |name: &str| table.columns.iter().find(|column| column.name == name);
    let channels = [channel("red")?, channel("green")?, channel("blue")?];
    let byte = |column: &Column, v: usize| {
        let value = column.values.get(v).copied().flatten().unwrap_or(1.0);
        // Real numbers are shares.
        let is_share = matches!(column.number_type, NumberType::Float | NumberType::Double);
        (if is_share { 255.0 * value } else { value }).round().clamp(0.0, 255.0) as u8
    };
    let count = channels[0].values.len();
    Some((0..count).map(|v| channels.map(|column| byte(column, v))).collect())
}

fn of_obj(bytes: &[u8], soup: &PolygonSoup, set: &MaterialSet) -> Appearance {
    let mut remarks = set.remarks.clone();
    let Ok(text) = text(bytes) else { return Appearance { look: None, remarks } };
    let colours = vertex_colours(&text).filter(|colours| colours.len() == soup.positions.len());
    let places = match texture_coordinates::of_obj(bytes) {
        Ok(places) => places,
        Err(TextureCoordinateError::None) => Vec::new(),
        Err(error) => {
            remarks.push(LookRemark::Unusable { problem: error.to_string() });
            Vec::new()
        }
    };
    let materials = set.by_polygon(&text);
    let place = |polygon: usize, k: usize| {
        let uv = places.get(polygon)?.corners.get(k).copied().flatten()?;
        // Without pictures the places are those in one that may come.
        let picture = if set.pictures.is_empty() { Some(0) } else { materials.get(polygon)?.picture };
        Some(PicturePlace { picture: picture?, at: uv.as_vec2().to_array() })
    };
    let colour = |polygon: usize, v: usize| match &colours {
        Some(colours) => colours.get(v).copied(),
        None => materials.get(polygon).map(|material| material.colour),
    };
    Appearance { look: joined(soup, colour, place, &set.pictures), remarks }
}

/// The colours behind the coordinates of an OBJ file's vertices, from the first vertex to the last one before a vertex without a
/// colour.
fn vertex_colours(text: &str) -> Option<Vec<[u8; 3]>> {
    let share = |word: Option<&str>| word?.parse::<f64>().ok().filter(|x| (0.0..=1.0).contains(x));
    let colour = |line: obj::WholeLine<'_>| {
        let mut words = line.words().skip(3);
        // A fourth number alone is a weight.
        let shares = [share(words.next())?, share(words.next())?, share(words.next())?];
        Some(shares.map(|x| (255.0 * x).round() as u8))
    };
    let colours: Vec<[u8; 3]> =
        obj::whole_lines(text).filter(|line| line.kind == "v").map_while(colour).collect();
    (!colours.is_empty()).then_some(colours)
}

fn of_off(bytes: &[u8], soup: &PolygonSoup) -> Option<PolygonLook> {
    if off::is_binary(bytes) {
        return None;
    }
    let colours = off_colours::read(&text(bytes).ok()?)?;
    let colour = |polygon: usize, v: usize| match &colours {
        OffColours::OfVertices(colours) => colours.get(v).copied(),
        OffColours::OfFaces(colours) => colours.get(polygon).copied(),
    };
    joined(soup, colour, |_, _| None, &[])
}

/// The colours by polygon and vertex (white where there is none) and the places by polygon and corner, joined to one look; `None`
/// where nothing is seen of them.
fn joined(
    soup: &PolygonSoup,
    colour: impl Fn(usize, usize) -> Option<[u8; 3]>,
    place: impl Fn(usize, usize) -> Option<PicturePlace>,
    pictures: &[Vec<u8>],
) -> Option<PolygonLook> {
    let corner = |polygon: usize, k: usize, v: usize| CornerLook {
        colour: colour(polygon, v).unwrap_or(CornerLook::WHITE.colour),
        place: place(polygon, k),
    };
    let corners = soup.polygons.iter().enumerate().map(|(number, polygon)| {
        polygon.iter().enumerate().map(|(k, v)| corner(number, k, *v as usize)).collect()
    });
    let corners: Vec<Vec<CornerLook>> = corners.collect();
    let says = |corner: &CornerLook| *corner != CornerLook::WHITE;
    let has_look = corners.iter().flatten().any(says);
    has_look.then(|| PolygonLook { corners, pictures: pictures.to_vec() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::picture::tests::png_that_announces;
    use crate::io::read_mesh;
    use serde_json::json;

    fn appearance(bytes: &[u8]) -> Appearance {
        read(bytes, &read_mesh(bytes).unwrap(), None)
    }

    fn of(bytes: &[u8]) -> Option<PolygonLook> {
        appearance(bytes).look
    }

    fn at(picture: u8, at: [f32; 2]) -> Option<PicturePlace> {
        Some(PicturePlace { picture, at })
    }

    fn coloured(colours: [[u8; 3]; 3]) -> Vec<Vec<CornerLook>> {
        vec![colours.map(|colour| CornerLook { colour, place: None }).to_vec()]
    }

    #[test]
    fn colours_of_vertices_are_read() {
        let expected = coloured([[255, 0, 51], [0, 255, 0], [0, 0, 255]]);
        let obj = "v 0 0 0 1 0 0.2\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n";
        assert_eq!(of(obj.as_bytes()).unwrap().corners, expected);
        let head = |kind: &str| {
            format!(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                 property {kind} red\nproperty {kind} green\nproperty {kind} blue\nelement face 1\n\
                 property list uchar int vertex_indices\nend_header\n"
            )
        };
        let bytes = head("uchar") + "0 0 0 255 0 51\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n";
        assert_eq!(of(bytes.as_bytes()).unwrap().corners, expected);
        let shares = head("float") + "0 0 0 1 0 0.2\n1 0 0 0 1 0\n0 1 0 0 0 1\n3 0 1 2\n";
        assert_eq!(of(shares.as_bytes()).unwrap().corners, expected);
        let off = "COFF\n3 1 0\n0 0 0 255 0 51 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n3 0 1 2\n";
        assert_eq!(of(off.as_bytes()).unwrap().corners, expected);
        let of_face = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0.2 0 1\n";
        assert_eq!(of(of_face.as_bytes()).unwrap().corners, coloured([[51, 0, 255]; 3]));
    }

    #[test]
    fn files_without_a_look_have_none() {
        for text in [
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            // Weights are no colours, nor are numbers beyond 1.
            "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n",
            "v 0 0 0 1 2 3\nv 1 0 0 1 2 3\nv 0 1 0 1 2 3\nf 1 2 3\n",
            "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        ] {
            assert_eq!(of(text.as_bytes()), None, "{text:?}");
        }
    }

    #[test]
    fn texture_coordinates_are_by_corner() {
        let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 0.5 1\nf 1/1 2/2 3/1\n";
        let places: Vec<_> =
            of(obj.as_bytes()).unwrap().corners[0].iter().map(|corner| corner.place).collect();
        assert_eq!(places, [at(0, [0.0, 0.0]), at(0, [0.5, 1.0]), at(0, [0.0, 0.0])]);
    }

    /// Two triangles of two materials: one with a picture, one of a base colour with colours at its vertices.
    fn gltf(picture: &str) -> Vec<u8> {
        let mut data: Vec<u8> = Vec::new();
        let floats = |data: &mut Vec<u8>, values: &[f32]| {
            let begin = data.len();
            values.iter().for_each(|x| data.extend(x.to_le_bytes()));
            json!({ "buffer": 0, "byteOffset": begin, "byteLength": data.len() - begin })
        };
        let views = [
            floats(&mut data, &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]),
            floats(&mut data, &[0.0, 0.0, 1.0, 0.0, 0.0, 0.25]),
            floats(&mut data, &[1.0, 1.0, 1.0, 1.0, 0.0, 0.5, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0]),
        ];
        let code = base64::Engine::encode(&base64::prelude::BASE64_STANDARD, &data);
        let accessor = |view: usize, kind: &str| json!({ "bufferView": view, "componentType": 5126, "count": 3, "type": kind });
        json!({
            "asset": { "version": "2.0" }, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [
                { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 },
                { "attributes": { "POSITION": 0, "COLOR_0": 2 }, "material": 1 },
            ] }],
            "materials": [
                { "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } },
                { "pbrMetallicRoughness": { "baseColorFactor": [1.0, 0.5, 1.0, 1.0] } },
            ],
            "textures": [{ "source": 0 }], "images": [{ "uri": picture }],
            "accessors": [accessor(0, "VEC3"), accessor(1, "VEC2"), accessor(2, "VEC4")],
            "bufferViews": views,
            "buffers": [{ "byteLength": data.len(), "uri": format!("data:;base64,{code}") }],
        })
        .to_string()
        .into_bytes()
    }

    fn data_uri(content: &[u8]) -> String {
        format!(
            "data:image/png;base64,{}",
            base64::Engine::encode(&base64::prelude::BASE64_STANDARD, content)
        )
    }

    #[test]
    fn materials_of_gltf_files_are_read() {
        let look = of(&gltf(&data_uri(b"\x89PNG and so on"))).unwrap();
        assert_eq!(look.pictures, [b"\x89PNG and so on"]);
        // The picture's rows go down, places go up.
        let places: Vec<_> = look.corners[0].iter().map(|corner| corner.place).collect();
        assert_eq!(places, [at(0, [0.0, 1.0]), at(0, [1.0, 1.0]), at(0, [0.0, 0.75])]);
        // Light of 0.5 and 0.25 is shown as 188 and 137.
        assert_eq!(look.corners[1], coloured([[255, 188, 255], [0, 137, 0], [255, 188, 255]])[0]);
    }

    #[test]
    fn each_material_keeps_its_picture() {
        let mut root: serde_json::Value = serde_json::from_slice(&gltf("")).unwrap();
        root["meshes"][0]["primitives"][1]["attributes"]["TEXCOORD_0"] = json!(1);
        root["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 1 });
        let webp = json!({ "extensions": { "EXT_texture_webp": { "source": 1 } }, "source": 0 });
        root["textures"] = json!([{ "source": 0 }, webp]);
        let [png, riff] = [data_uri(b"\x89PNG"), data_uri(b"RIFF....WEBP")];
        root["images"] = json!([{ "uri": png }, { "uri": riff }]);
        let look = of(root.to_string().as_bytes()).unwrap();
        assert_eq!(look.pictures, [&b"\x89PNG"[..], b"RIFF....WEBP"]);
        let numbers = look.corners.iter().map(|corners| corners[0].place.unwrap().picture);
        assert_eq!(numbers.collect::<Vec<_>>(), [0, 1]);
    }

    #[test]
    fn a_picture_that_is_none_is_left_out_and_told() {
        let told = |picture: &str| {
            let Appearance { look, remarks } = appearance(&gltf(picture));
            let look = look.unwrap();
            assert_eq!(look.pictures.len(), 0);
            assert!(look.corners.iter().flatten().all(|corner| corner.place.is_none()));
            remarks
        };
        assert_eq!(told("missing.png"), [LookRemark::Missing { name: "missing.png".into() }]);
        let name = "number 0".to_owned();
        assert_eq!(told(&data_uri(b"<script>")), [LookRemark::NoPicture { name: name.clone() }]);
        let large = png_that_announces([40_000, 30_000]);
        assert_eq!(told(&data_uri(&large)), [LookRemark::TooLarge { name, width: 40_000, height: 30_000 }]);
    }

    #[test]
    fn places_that_are_no_numbers_are_left_out_and_told() {
        let obj = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nvt nan 0\nf 1/1 2/1 3/1\n";
        let Appearance { look, remarks } = appearance(obj.as_bytes());
        assert_eq!(look.unwrap().corners, coloured([[255, 0, 0]; 3]));
        assert!(remarks[0].to_string().starts_with("its colours are incomplete: line 4: "), "{remarks:?}");
        let mut root: serde_json::Value = serde_json::from_slice(&gltf(&data_uri(b"\x89PNG"))).unwrap();
        let floats = [f32::NAN, 0.0, 1.0, 0.0, 0.0, 0.25];
        let bytes: Vec<u8> = floats.iter().flat_map(|x| x.to_le_bytes()).collect();
        root["buffers"].as_array_mut().unwrap().push(json!({ "byteLength": 24, "uri": data_uri(&bytes) }));
        root["bufferViews"][1] = json!({ "buffer": 1, "byteLength": 24 });
        let Appearance { look, remarks } = appearance(root.to_string().as_bytes());
        assert!(look.unwrap().corners[0].iter().all(|corner| corner.place.is_none()));
        let problem = "TEXCOORD_0 of primitive 0 of mesh 0 has values that are no numbers".into();
        assert_eq!(remarks, [LookRemark::Unusable { problem }]);
    }

    #[test]
    fn materials_that_come_with_an_obj_file_lay_several_pictures_on_it() {
        let obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl b\nf 1/1 2/1 3/1\nusemtl c\nf 1 2 3\nusemtl a\n\
                   f 1/1 2/1 3/1\n";
        let find = |name: &str| match name {
            "a.mtl" => Some(b"newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd b.png\nnewmtl c\nKd 1 0 0\n".to_vec()),
            name => Some(format!("\u{89}PNG {name}").chars().map(|c| c as u8).collect()),
        };
        let set = crate::io::material_set::packed(obj.as_bytes(), find).unwrap();
        let look = read(obj.as_bytes(), &read_mesh(obj.as_bytes()).unwrap(), Some(&set.bytes)).look.unwrap();
        assert_eq!(look.pictures, [b"\x89PNG a.png", b"\x89PNG b.png"]);
        let places: Vec<_> = look.corners.iter().map(|corners| corners[0].place).collect();
        assert_eq!(places, [at(1, [0.0; 2]), None, at(0, [0.0; 2])]);
        assert_eq!(look.corners[1], coloured([[255, 0, 0]; 3])[0]);
    }
}
