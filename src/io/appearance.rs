//! How a mesh file says that its surface looks: the colours of its vertices, and a picture with its places.
//!
//! Read are the vertices' colours of PLY files (`red`, `green`, `blue`) and of OBJ files (three numbers after the coordinates), texture
//! coordinates of both, the colours of vertices or faces of OFF files, and what a glTF file's materials say of their base colours.

use super::gltf_look;
use super::obj;
use super::off;
use super::off_colours::{self, OffColours};
use super::reading::text;
use super::texture_coordinates;
use super::vertex_table::{self, Column, NumberType, VertexTable};
use super::{Format, detect};
use crate::mesh::look::{CornerLook, PolygonLook};
use crate::mesh::soup::PolygonSoup;
use glam::DVec2;

/// The look that a mesh file gives to its polygons, which were read of the same bytes. `None` where it says nothing of it, or
/// nothing that can be used.
pub fn read(bytes: &[u8], soup: &PolygonSoup) -> Option<PolygonLook> {
    let look = match detect(bytes)? {
        Format::Gltf => gltf_look::read(bytes)?,
        Format::Ply => of_ply(bytes, soup)?,
        Format::Obj => of_obj(bytes, soup)?,
        Format::Off => of_off(bytes, soup)?,
        Format::Stl => return None,
    };
    (look.corners.len() == soup.polygons.len()).then_some(look)
}

fn of_ply(bytes: &[u8], soup: &PolygonSoup) -> Option<PolygonLook> {
    let table = vertex_table::of_ply(bytes, soup.positions.len()).ok()?;
    let colours = colours_of(&table);
    let places = texture_coordinates::of_table(&table, &soup.polygons);
    joined(soup, colours.as_deref(), places.as_deref())
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

fn of_obj(bytes: &[u8], soup: &PolygonSoup) -> Option<PolygonLook> {
    let text = text(bytes).ok()?;
    let mut colours = Vec::new();
    for line in obj::whole_lines(&text).filter(|line| line.kind == "v") {
        let mut words = line.words().skip(3);
        let share = |word: Option<&str>| word?.parse::<f64>().ok().filter(|x| (0.0..=1.0).contains(x));
        // A fourth number alone is a weight.
        let Some(colour) = share(words.next()).zip(share(words.next())).zip(share(words.next())) else {
            break;
        };
        let ((r, g), b) = colour;
        colours.push([r, g, b].map(|x| (255.0 * x).round() as u8));
    }
    let colours = (colours.len() == soup.positions.len()).then_some(colours);
    let places = texture_coordinates::read(bytes).ok();
    joined(soup, colours.as_deref(), places.as_deref())
}

fn of_off(bytes: &[u8], soup: &PolygonSoup) -> Option<PolygonLook> {
    if off::is_binary(bytes) {
        return None;
    }
    let faces = match off_colours::read(&text(bytes).ok()?)? {
        OffColours::OfVertices(colours) => return joined(soup, Some(&colours), None),
        OffColours::OfFaces(colours) => colours,
    };
    let corners = |(polygon, colour): (&Vec<u32>, &[u8; 3])| {
        vec![CornerLook { colour: *colour, place: None }; polygon.len()]
    };
    Some(PolygonLook { corners: soup.polygons.iter().zip(&faces).map(corners).collect(), picture: None })
}

/// Colours of vertices and texture coordinates of corners as one; `None` where neither is there.
fn joined(
    soup: &PolygonSoup,
    colours: Option<&[[u8; 3]]>,
    places: Option<&[Vec<DVec2>]>,
) -> Option<PolygonLook> {
    if colours.is_none() && places.is_none() {
        return None;
    }
    let corner = |polygon: usize, k: usize, v: usize| CornerLook {
        colour: colours.and_then(|colours| colours.get(v).copied()).unwrap_or([u8::MAX; 3]),
        place: places.and_then(|places| Some(places.get(polygon)?.get(k)?.as_vec2().to_array())),
    };
    let corners = soup.polygons.iter().enumerate().map(|(number, polygon)| {
        polygon.iter().enumerate().map(|(k, v)| corner(number, k, *v as usize)).collect()
    });
    Some(PolygonLook { corners: corners.collect(), picture: None })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::read_mesh;
    use serde_json::json;

    fn of(bytes: &[u8]) -> Option<PolygonLook> {
        read(bytes, &read_mesh(bytes).unwrap())
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
        assert_eq!(places, [Some([0.0, 0.0]), Some([0.5, 1.0]), Some([0.0, 0.0])]);
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

    #[test]
    fn materials_of_gltf_files_are_read() {
        let png = base64::Engine::encode(&base64::prelude::BASE64_STANDARD, b"\x89PNG and so on");
        let look = of(&gltf(&format!("data:image/png;base64,{png}"))).unwrap();
        assert_eq!(look.picture.as_deref(), Some(&b"\x89PNG and so on"[..]));
        // The picture's rows go down, places go up.
        let places: Vec<_> = look.corners[0].iter().map(|corner| corner.place).collect();
        assert_eq!(places, [Some([0.0, 1.0]), Some([1.0, 1.0]), Some([0.0, 0.75])]);
        // Light of 0.5 and 0.25 is shown as 188 and 137.
        assert_eq!(look.corners[1], coloured([[255, 188, 255], [0, 137, 0], [255, 188, 255]])[0]);
    }

    #[test]
    fn a_picture_that_is_none_is_left_out() {
        let look = of(&gltf("missing.png")).unwrap();
        assert_eq!(look.picture, None);
        assert!(look.corners.iter().flatten().all(|corner| corner.place.is_none()));
        let text = base64::Engine::encode(&base64::prelude::BASE64_STANDARD, b"<script>");
        assert_eq!(of(&gltf(&format!("data:image/png;base64,{text}"))).unwrap().picture, None);
    }
}
